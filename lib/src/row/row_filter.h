/* The contract of the row kernels of neighbourhoods: a part of row.h, see there. */
#ifndef PEL_ROW_FILTER_H
#define PEL_ROW_FILTER_H

#include "pel/config.h"

/*
 * rows[0 .. 2r] are the rows from r above to r below; each pointer is at the pixel above, at or
 * below the first result, and r pixels on either side of the `count` ones may be read. r is 1
 * unless said.
 */

/* Copies count bytes. */
void pel_row_copy(const uint8_t *src, uint16_t count, uint8_t *dst);

/*
 * How a sum becomes a result: v = sum + start, which is positive; with flip = start, not 0, v below
 * it becomes 2 start - v, so that |sum| + start is left; v / divisor or, where that is 0,
 * v >> shift; + bias; limited to the type of the result. |sum| <= 816000 and v < 2^31.
 */
typedef struct pel_row_scale {
    uint32_t start, flip;
    uint32_t divisor;
    int32_t bias;
    uint8_t shift; /* 0..15 */
} pel_row_scale;

/* Sums of tap * pixel, scaled; taps row by row. The first two for r = 1, the others for r = 2. */
void pel_row_kernel3(const uint8_t *const rows[], const int8_t *tap, const pel_row_scale *scale,
                     uint16_t count, uint8_t *out);
void pel_row_kernel3_s16(const uint8_t *const rows[], const int8_t *tap, const pel_row_scale *scale,
                         uint16_t count, int16_t *out);
void pel_row_kernel5(const uint8_t *const rows[], const int8_t *tap, const pel_row_scale *scale,
                     uint16_t count, uint8_t *out);
void pel_row_kernel5_s16(const uint8_t *const rows[], const int8_t *tap, const pel_row_scale *scale,
                         uint16_t count, int16_t *out);

/* 1 2 1 squared / 16, nine ones / 9 and, with r = 2, 1 4 6 4 1 squared / 256, rounded to nearest,
 * halves upward. */
void pel_row_gauss3(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_box3(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_binomial5(const uint8_t *const rows[], uint16_t count, uint8_t *out);

/* Sobel's gradients gx and gy, |gx| + |gy|, floor(sqrt(gx^2 + gy^2)), in 8 bits limited to 255, and
 * the direction in 1/256 of a turn. */
void pel_row_sobel_x(const uint8_t *const rows[], uint16_t count, int16_t *out);
void pel_row_sobel_y(const uint8_t *const rows[], uint16_t count, int16_t *out);
void pel_row_gradient_abs(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_gradient_abs_s16(const uint8_t *const rows[], uint16_t count, int16_t *out);
void pel_row_gradient(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_gradient_s16(const uint8_t *const rows[], uint16_t count, int16_t *out);
void pel_row_direction(const uint8_t *const rows[], uint16_t count, uint8_t *out);

/* Median, smallest, largest of nine. */
void pel_row_median3(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_min3(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_max3(const uint8_t *const rows[], uint16_t count, uint8_t *out);

/* Of nine labels: the most frequent, the common one, the nearest; see filter.h. */
void pel_row_majority3(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_erode_labels3(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_dilate_labels3(const uint8_t *const rows[], uint16_t count, uint8_t *out);

#endif
