/* The contract of the row kernels of corners and edges: a part of row.h, see there. */
#ifndef PEL_ROW_FEATURE_H
#define PEL_ROW_FEATURE_H

#include "pel/config.h"

/*
 * rows[0 .. 2r] are the rows from r above to r below; each pointer is at the pixel above, at or
 * below the first result, and r pixels on either side of the `count` ones may be read.
 */

/* Responses as in feature.h; r = 2. k_q15 at most 8191. */
void pel_row_harris(const uint8_t *const rows[], uint16_t count, uint16_t k_q15,
                    int32_t *responses);
void pel_row_shi_tomasi(const uint8_t *const rows[], uint16_t count, int32_t *responses);

/* r = 3, threshold 1..254; 0 where there is no corner. */
void pel_row_fast9(const uint8_t *const rows[], uint16_t count, int16_t threshold,
                   int32_t *responses);

/* Which responses are tops among their neighbours; PEL_SUPPRESS_... of feature.h are the same. */
enum { PEL_ROW_TOP_FIRST = 0, PEL_ROW_TOP_STRICT = 1, PEL_ROW_TOP_ANY = 2 };

/* The first of begin .. end - 1 where the response is a top and at least `threshold`, which is 1 or
 * more; `end` if there is none. rows: the responses above, at and below, all under 2^31 - 1; r = 1.
 */
uint16_t pel_row_next_top(const int32_t *const rows[], uint16_t begin, uint16_t end,
                          int32_t threshold, int kind);

/* The magnitude |gx| + |gy| of Sobel and, from bit PEL_SECTOR_SHIFT on, across which neighbours the
 * edge is to be thinned; r = 1. */
enum {
    PEL_SECTOR_SHIFT = 12,
    PEL_SECTOR_SIDES = 0,   /* left and right */
    PEL_SECTOR_UPRIGHT = 1, /* above and below */
    PEL_SECTOR_FALLING = 2, /* upper left and lower right */
    PEL_SECTOR_RISING = 3   /* upper right and lower left */
};
void pel_row_gradient_sector(const uint8_t *const rows[], uint16_t count, uint16_t *gradients);

/* What an edge map holds; PEL_CANNY_... of feature.h are the same. */
enum { PEL_ROW_EDGE_NONE = 0, PEL_ROW_EDGE_WEAK = 128, PEL_ROW_EDGE_STRONG = 255 };

/* Thins three rows of such gradients and classifies what is left; r = 1. */
void pel_row_thin(const uint16_t *const rows[], uint16_t count, uint16_t low, uint16_t high,
                  uint8_t *out);

/* pel_canny_link_row. */
void pel_row_link(const uint8_t *above, const uint8_t *below, uint16_t count, uint8_t *row);

/*
 * Sums of Sobel's gradients g over pixels at p from a centre: g g and g (g p). Over 121 pixels at
 * most 5 away, with gx^2 <= 1040400 and |gx gy| <= 585225: xx and yy < 2^27, to_x and to_y < 2^30.
 */
typedef struct pel_row_pull {
    int32_t xx, xy, yy;
    int32_t to_x, to_y;
} pel_row_pull;

/* Adds the 2 radius + 1 pixels p = (-radius .. radius, py). Each row is at the middle of them; one
 * more on either side may be read. radius and |py| at most 5. */
void pel_row_pull_around(const uint8_t *const rows[], int16_t radius, int16_t py,
                         pel_row_pull *sums);

#endif
