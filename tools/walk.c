#include "walk.h"

#include <stdio.h>
#include <string.h>

#include "pack.h"
#include "say.h"

static int visit_source(struct source *from, const char *path, unsigned long *number,
                        walk_visit *visit, void *user)
{
    frame picture = {0};
    const unsigned long first = *number;
    int got = 0;
    int result = 0;
    while (result == 0 && (got = source_next(from, &picture)) > 0) {
        const pel_cview view = pel_view_to_read(&picture.view);
        result = visit(user, path, *number, &view);
        ++*number;
    }
    frame_free(&picture);
    if (got < 0 || result != 0) {
        return -1;
    }
    return *number == first ? say_error(path, "holds no picture") : 0;
}

int walk_frames(char *const *paths, int count, const source_options *options, walk_visit *visit,
                void *user)
{
    unsigned long number = 0;
    int dashes = 0;
    for (int i = 0; i < count; i++) {
        dashes += strcmp(paths[i], "-") == 0;
        if (dashes > 1) {
            return say_error("-", "cannot be read twice");
        }
        struct source *opened = source_open(paths[i], options);
        if (!opened) {
            return -1;
        }
        const int result = visit_source(opened, paths[i], &number, visit, user);
        source_close(opened);
        if (result) {
            return -1;
        }
    }
    return 0;
}

int walk_check_range(const char *path, const pel_cview *view, const char *classes_path,
                     const classes *list)
{
    static const char *const names[] = {"full", "limited"};
    /* RGB and mosaics are converted to what the classes want. */
    if (!pack_has_range(view->format) || view->range == list->range) {
        return 0;
    }
    if (list->cells) {
        return say_error(
            path,
            "its colours have %s range, but %s is a table, and a table has full range: convert "
            "the picture to .ppm or .png with 'pel convert', or use the class file that the table "
            "was made from (raw frames: say --range full if that is what they are)",
            names[view->range], classes_path);
    }
    return say_error(
        path,
        "its colours have %s range, the classes of %s %s range; if those were made for "
        "such pictures, say so in that file with the line '#! range %s' (raw frames: say "
        "--range %s if that is what they are)",
        names[view->range], classes_path, names[list->range], names[view->range],
        names[list->range]);
}
