/*
 * The contract of every inner loop.
 *
 * A row kernel sees bytes and counts, never a picture, a format or a border. It checks nothing: the
 * module that calls it has checked. Counts may be 0. Nothing is read or written outside the stated
 * elements; no alignment is asked for. Source and destination do not overlap unless it says so.
 *
 * row_c.c, row_classify_c.c and row_runs_c.c define them in plain C: that is the truth. A faster
 * version equals it bit for bit.
 */
#ifndef PEL_ROW_H
#define PEL_ROW_H

#include "pel/config.h"

/*
 * A row of pixels in which neighbours x = 2k and 2k+1 share a U and a V: pixel x has its Y at
 * y[x * y_step], its U at u[x / 2 * c_step], its V at v[x / 2 * c_step]. All YCbCr formats are this
 * with different steps. y_step 2 is for packed pairs: four bytes, every other one a Y, the rest U
 * and V in any order, c_step 4. y_step 1 is for planes; gray is this with c_step 0.
 */
typedef struct pel_row_pairs {
    const uint8_t *y, *u, *v;
    uint8_t y_step, c_step;
} pel_row_pairs;

/* The mask tables of a box classifier, 256 entries each. */
typedef struct pel_row_boxes {
    const pel_class_mask *y, *u, *v;
} pel_row_boxes;

/* A 3-D look-up table: the label of (y, u, v) is
 * cell[(y >> y_drop) << y_shift | (u >> u_drop) << u_shift | v >> v_drop]. */
typedef struct pel_row_lut {
    const uint8_t *cell;
    uint8_t y_drop, u_drop, v_drop;
    uint8_t y_shift, u_shift;
} pel_row_lut;

/* Pixels x .. x+count-1 of a row of pairs into separate Y, U and V. */
void pel_row_read_pairs(const pel_row_pairs *src, uint16_t x, uint16_t count, uint8_t *y,
                        uint8_t *u, uint8_t *v);

/* count pixels of three bytes into R G B; `first` is the offset of R: 0 for RGB, 2 for BGR. */
void pel_row_read_rgb24(const uint8_t *src, uint16_t count, unsigned first, uint8_t *rgb);

/* count pixels of 16 bits into R G B; `low` is the offset of the low byte: 0 or 1. */
void pel_row_read_rgb565(const uint8_t *src, uint16_t count, unsigned low, uint8_t *rgb);

/* count cells of 2 x 2 into R G B; `red` is the place of R in the cell: 0 top left, 1 top right, 2
 * bottom left, 3 bottom right; B lies across. G is the mean of the other two, halves upward. */
void pel_row_read_bayer(const uint8_t *even, const uint8_t *odd, uint16_t count, unsigned red,
                        uint8_t *rgb);

/* R G B into Y, U, V with `step` bytes from one to the next in each: exactly rounded, see color.h.
 * y, u, v may be the source. */
void pel_row_rgb_to_ycbcr(const uint8_t *rgb, uint16_t count, int limited, uint8_t *y, uint8_t *u,
                          uint8_t *v, unsigned step);

/* Y, U, V, each with `step` bytes from one to the next, into R G B: exactly rounded. rgb may
 * be y. */
void pel_row_ycbcr_to_rgb(const uint8_t *y, const uint8_t *u, const uint8_t *v, unsigned step,
                          uint16_t count, int limited, uint8_t *rgb);

/* R G B into normalised r g b and into H S V, see color.h. dst may be src. */
void pel_row_rgb_to_nrgb(const uint8_t *rgb, uint16_t count, uint16_t sum_min, uint8_t *nrgb);
void pel_row_rgb_to_hsv(const uint8_t *rgb, uint16_t count, uint8_t *hsv);

/* The label of a mask: 1 + the place of its lowest bit, 0 for no bit. */
uint8_t pel_row_label(pel_class_mask mask);

/* Labels of a row of pairs, of separate Y, U and V, by boxes or by a table. */
void pel_row_classify_pairs(const pel_row_boxes *boxes, const pel_row_pairs *src, uint16_t count,
                            uint8_t *labels);
void pel_row_classify(const pel_row_boxes *boxes, const uint8_t *y, const uint8_t *u,
                      const uint8_t *v, uint16_t count, uint8_t *labels);
void pel_row_classify_lut(const pel_row_lut *lut, const uint8_t *y, const uint8_t *u,
                          const uint8_t *v, uint16_t count, uint8_t *labels);

/* dst[i] = table[src[i]]; dst may be src. */
void pel_row_map(const uint8_t *src, uint16_t count, const uint8_t *table, uint8_t *dst);

/* The sum of count bytes, at most 2^13 * 255 < 2^21. */
uint32_t pel_row_sum(const uint8_t *src, uint16_t count);

/* The runs of equal, nonzero labels, from left to right, as x0, x1, x0, x1, ... (half-open);
 * returns how many runs. `edges` has room for 2 * (count + 1): what lies behind the last run is
 * scratch. */
uint16_t pel_row_find_runs(const uint8_t *labels, uint16_t count, uint16_t *edges);

/* Both in one: the runs of a row of pairs under boxes. labels[x0] of every run is its label; the
 * other labels are scratch, of which a version may write all, some or none. `edges` as above, with
 * room for 2 * (count + 1). */
uint16_t pel_row_classify_runs(const pel_row_boxes *boxes, const pel_row_pairs *src, uint16_t count,
                               uint8_t *labels, uint16_t *edges);

#endif
