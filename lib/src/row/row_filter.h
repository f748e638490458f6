/* The contract of the row kernels of neighbourhoods: a part of row.h, see there. */
#ifndef PEL_ROW_FILTER_H
#define PEL_ROW_FILTER_H

#include "pel/config.h"

/*
 * rows[0 .. 2r] are the rows from r above to r below; each pointer is at the pixel above, at or
 * below the first result, and r pixels on either side of the `count` ones may be read. r is 1
 * unless said.
 */

/* Sums of tap * pixel; taps row by row. The first for r = 1, the second for r = 2. */
void pel_row_correlate3(const uint8_t *const rows[], const int8_t *tap, uint16_t count,
                        int32_t *sums);
void pel_row_correlate5(const uint8_t *const rows[], const int8_t *tap, uint16_t count,
                        int32_t *sums);

/* The same sums for 1 2 1 squared, for nine ones, for Sobel x and y, and, with r = 2, for 1 4 6 4 1
 * squared. */
void pel_row_gauss3(const uint8_t *const rows[], uint16_t count, int32_t *sums);
void pel_row_box3(const uint8_t *const rows[], uint16_t count, int32_t *sums);
void pel_row_sobel_x(const uint8_t *const rows[], uint16_t count, int32_t *sums);
void pel_row_sobel_y(const uint8_t *const rows[], uint16_t count, int32_t *sums);
void pel_row_binomial5(const uint8_t *const rows[], uint16_t count, int32_t *sums);

/* |gx| + |gy|, floor(sqrt(gx^2 + gy^2)) and the direction in 1/256 of a turn, of Sobel. */
void pel_row_gradient_abs(const uint8_t *const rows[], uint16_t count, int32_t *sums);
void pel_row_gradient(const uint8_t *const rows[], uint16_t count, int32_t *sums);
void pel_row_direction(const uint8_t *const rows[], uint16_t count, uint8_t *out);

/* How a sum becomes a result: round(sum / (divisor << shift)) + bias, of |sum| if absolute. */
typedef struct pel_row_scale {
    int32_t bias;
    uint16_t divisor; /* 1..32767 */
    uint8_t shift;    /* 0..15 */
    uint8_t absolute;
} pel_row_scale;

/* Sums into results, limited to the type. |sum| <= 816000. */
void pel_row_scale_u8(const int32_t *sums, const pel_row_scale *scale, uint16_t count,
                      uint8_t *out);
void pel_row_scale_s16(const int32_t *sums, const pel_row_scale *scale, uint16_t count,
                       int16_t *out);

/* Median, smallest, largest of nine. */
void pel_row_median3(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_min3(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_max3(const uint8_t *const rows[], uint16_t count, uint8_t *out);

/* Of nine labels: the most frequent, the common one, the nearest; see filter.h. */
void pel_row_majority3(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_erode_labels3(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_dilate_labels3(const uint8_t *const rows[], uint16_t count, uint8_t *out);

#endif
