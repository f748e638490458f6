/*
 * The pictures that the benchmark measures: made from a seed by integer arithmetic alone, so that
 * they are the same bytes everywhere and the figures of other programs on them can be compared.
 *
 *   synth   a smooth background with noise and 40 coloured discs and rectangles, 8 classes
 *   rand4   black or white at random in cells of 4 x 4 pixels, 1 class
 *   rand1   black or white at random in every pixel, 1 class: the worst that a run finder meets
 *
 * Other names are taken as files: a raw YUYV picture of the same size, classified by six boxes that
 * together cover most bright colours (the photographs).
 *
 * Shared by `pel bench` and by tests/bench, so that there is one recipe.
 */
#ifndef BENCHINPUT_H
#define BENCHINPUT_H

#include <pel.h>

#define BENCH_WIDTH_MAX 640
#define BENCH_HEIGHT_MAX 480
#define BENCH_FRAME_BYTES_MAX (2 * BENCH_WIDTH_MAX * BENCH_HEIGHT_MAX)

/* 1 if it is the name of a picture that is made, not of a file. */
int bench_is_made(const char *name);

/* Makes or reads a picture of width x height (640x480 or 320x240) as YUYV without padding; `frame`
 * has room for BENCH_FRAME_BYTES_MAX. 0 if done, -1 if there is no such file of that size. */
int bench_frame(const char *name, int width, int height, uint8_t *frame);

/* The boxes of the classes that go with it; returns how many there are. */
enum { BENCH_BOXES_MAX = 8 };
unsigned bench_box_list(const char *name, pel_color_box box[BENCH_BOXES_MAX]);

/* The same as tables. `boxes` need not be zeroed. */
void bench_boxes(const char *name, pel_boxes *boxes);

#endif
