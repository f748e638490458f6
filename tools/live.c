#include "live.h"

#include <stdio.h>
#include <unistd.h>

/* Control sequences of ECMA-48: to the upper left corner, and clear what is below. */
static const char start_again[] = "\033[H\033[J";

typedef struct in_place {
    walk_visit *visit;
    void *user;
} in_place;

static int visit_in_place(void *user, const char *path, unsigned long number, const pel_cview *view)
{
    const in_place *of = user;
    fputs(start_again, stdout);
    return of->visit(of->user, path, number, view);
}

int live_walk(const camera_options *options, report_style style, const classes *list,
              walk_visit *visit, void *user)
{
    in_place refreshed = {visit, user};
    camera_options wanted = *options;
#ifdef PEL_HAS_CAMERAS
    wanted.has_range = 1;
    wanted.range = list->range;
#else
    (void)list;
#endif
    if (style != REPORT_TABLE || !isatty(STDOUT_FILENO)) {
        return camera_walk(&wanted, visit, user);
    }
    setvbuf(stdout, NULL, _IOFBF, BUFSIZ); /* the whole table at once: it must not flicker */
    return camera_walk(&wanted, visit_in_place, &refreshed);
}
