/*
 * The picture of `pel bench --plot`: a panel for each input, a group of bars for each operator,
 * their length the logarithm of the nanoseconds per pixel; a black line where memcpy is.
 */
#ifndef BENCHPLOT_H
#define BENCHPLOT_H

#include "benchmeasure.h"

/* Its size: a panel for each input beside the names; for each operator BENCHPLOT_GAP and a bar for
 * each backend and one for OpenCV. */
enum {
    BENCHPLOT_LEFT = 120,
    BENCHPLOT_PANEL = 280,
    BENCHPLOT_RIGHT = 20, /* behind each panel */
    BENCHPLOT_TOP = 70,
    BENCHPLOT_BAR = 5,
    BENCHPLOT_GAP = 6,
    BENCHPLOT_BOTTOM = 20
};

typedef struct benchplot {
    const bench_figure
        *figures; /* by pictures, within them by operators, within them by backends */
    unsigned count;
    bench_backends backends; /* all that there can be */
    const char *opencv;      /* its version; NULL: none was measured */
    unsigned runs;
} benchplot;

/* Draws and writes it. 0, or -1 after a message. */
int benchplot_write(const char *path, const benchplot *plot);

#endif
