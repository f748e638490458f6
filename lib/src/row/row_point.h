/* The contract of the row kernels of point operations: a part of row.h, see there. */
#ifndef PEL_ROW_POINT_H
#define PEL_ROW_POINT_H

#include "pel/config.h"

/* bins[src[i * step]]++ for i < count. */
void pel_row_histogram(const uint8_t *src, unsigned step, uint16_t count, uint32_t *bins);

/* dst[i] = a[i] op b[i]; dst may be a or b. Sums and differences are limited to 0..255. */
void pel_row_add(const uint8_t *a, const uint8_t *b, uint16_t count, uint8_t *dst);
void pel_row_subtract(const uint8_t *a, const uint8_t *b, uint16_t count, uint8_t *dst);
void pel_row_absdiff(const uint8_t *a, const uint8_t *b, uint16_t count, uint8_t *dst);
void pel_row_min(const uint8_t *a, const uint8_t *b, uint16_t count, uint8_t *dst);
void pel_row_max(const uint8_t *a, const uint8_t *b, uint16_t count, uint8_t *dst);
void pel_row_and(const uint8_t *a, const uint8_t *b, uint16_t count, uint8_t *dst);
void pel_row_or(const uint8_t *a, const uint8_t *b, uint16_t count, uint8_t *dst);
void pel_row_xor(const uint8_t *a, const uint8_t *b, uint16_t count, uint8_t *dst);

/* dst[i] = round((a[i] * alpha + b[i] * (256 - alpha)) / 256), alpha 0..256; dst may be a or b. */
void pel_row_blend(const uint8_t *a, const uint8_t *b, uint16_t alpha_q8, uint16_t count,
                   uint8_t *dst);

/* sums[i] = above[i] + src[0] + ... + src[i], modulo 2^32; sums may be above. */
void pel_row_integral(const uint8_t *src, uint16_t count, const uint32_t *above, uint32_t *sums);

/* sums[i] += times * src[i], and sums[i] -= src[i]; the caller knows that they stay in 16 bits. */
void pel_row_columns_add(const uint8_t *src, uint16_t count, uint16_t times, uint16_t *sums);
void pel_row_columns_subtract(const uint8_t *src, uint16_t count, uint16_t *sums);

/* 255 where src[i] + c is over the rounded mean of the (2 radius + 1)^2 pixels around it, else 0.
 * columns[] are the sums of 2 radius + 1 pixels each; beyond its ends they repeat. count >= 1,
 * radius <= 127, |c| <= 255. dst may be src. */
void pel_row_over_mean(const uint8_t *src, const uint16_t *columns, uint16_t count, uint16_t radius,
                       int16_t c, uint8_t *dst);

/* Pixel X of dst is pixel floor(X * width_in / width_out) of src; of `channels` bytes. */
void pel_row_nearest(const uint8_t *src, uint16_t width_in, uint8_t channels, uint16_t width_out,
                     uint8_t *dst);

/* sums[X] += the `factor` pixels from factor * X on, channel by channel; and dst[i] = round(sums[i]
 * / area), area <= 65536. */
void pel_row_box_add(const uint8_t *src, uint16_t factor, uint8_t channels, uint16_t width_out,
                     uint32_t *sums);
void pel_row_box_mean(const uint32_t *sums, uint32_t area, uint16_t count, uint8_t *dst);

/* Where a result column lies between source columns: `weight` / 2048 of the way from x to x + 1. */
typedef struct pel_row_place {
    uint16_t x;
    uint16_t weight; /* 0..2048 */
} pel_row_place;

/* Two source rows between which results lie, `weight` / 2048 of the way from upper to lower. */
typedef struct pel_row_between {
    const uint8_t *upper, *lower;
    uint16_t last; /* the last column: has no right neighbour, is its own */
    uint16_t weight;
} pel_row_between;

/* The bilinear mean of four pixels, `count` times, from left to right; see point.h. */
void pel_row_bilinear(const pel_row_between *rows, const pel_row_place *places, uint8_t channels,
                      uint16_t count, uint8_t *dst);

/* A table of 256 entries, and whether it is a step: table[0] for 0 .. last_low, table[255] for the
 * rest. */
typedef struct pel_row_curve {
    const uint8_t *table;
    uint8_t is_step, last_low;
} pel_row_curve;

/* sums[c] += channel c of `count` pixels of three bytes; at most 65535 * 255 < 2^24. */
void pel_row_sum3(const uint8_t *src, uint16_t count, uint32_t sums[3]);

/* dst = round(src * gain / 256), at most 255, for `count` pixels of three bytes; dst may be src. */
void pel_row_gain3(const uint8_t *src, uint16_t count, const uint16_t gains_q8[3], uint8_t *dst);

#endif
