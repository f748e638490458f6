/* The inputs of `pel bench`: a picture in every form that an operator reads. */
#ifndef BENCHPICTURE_H
#define BENCHPICTURE_H

#include "benchinput.h"
#include "source.h"

/* What an operator reads, and what is copied beside it for comparison. */
typedef enum bench_form {
    BENCH_YUYV = 0, /* full range */
    BENCH_GRAY,     /* its Y */
    BENCH_RGB,      /* its colours */
    BENCH_LABELS,   /* what its classes make of it */
    BENCH_TURNED,   /* its Y turned by half a turn: the other one for two-picture jobs */
    BENCH_FORMS
} bench_form;

/* A zeroed one is empty. */
typedef struct bench_picture {
    char name[64];
    uint16_t width, height; /* both even */
    pel_color_box box[BENCH_BOXES_MAX];
    unsigned box_count;
    pel_boxes boxes;
    frame form[BENCH_FORMS];
} bench_picture;

/*
 * Makes a picture by its name (bench_is_made), or reads the first frame of a file, whose name
 * without folder and ending becomes that of the picture. Only the middle width x height is taken;
 * 0 0 stands for all of it, but an odd last column or row. 0, or -1 after a message.
 */
int benchpicture_make(const char *name, unsigned width, unsigned height, bench_picture *picture);
int benchpicture_read(const char *path, const source_options *options, unsigned width,
                      unsigned height, bench_picture *picture);

pel_cview benchpicture_view(const bench_picture *picture, bench_form form);

void benchpicture_free(bench_picture *picture);

#endif
