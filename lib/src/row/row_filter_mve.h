/* Which kernels of row_filter.h have a version for Helium (MVE), and where these are there. */
#ifndef PEL_ROW_FILTER_MVE_H
#define PEL_ROW_FILTER_MVE_H

#include "row/row_filter.h"
#include "row/row_mve.h"

#if PEL_ROW_MVE
void pel_row_copy_mve(const uint8_t *src, uint16_t count, uint8_t *dst);
void pel_row_kernel3_mve(const uint8_t *const rows[], const int8_t *tap, const pel_row_scale *scale,
                         uint16_t count, uint8_t *out);
void pel_row_kernel3_s16_mve(const uint8_t *const rows[], const int8_t *tap,
                             const pel_row_scale *scale, uint16_t count, int16_t *out);
void pel_row_kernel5_mve(const uint8_t *const rows[], const int8_t *tap, const pel_row_scale *scale,
                         uint16_t count, uint8_t *out);
void pel_row_kernel5_s16_mve(const uint8_t *const rows[], const int8_t *tap,
                             const pel_row_scale *scale, uint16_t count, int16_t *out);
void pel_row_gauss3_mve(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_box3_mve(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_binomial5_mve(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_sobel_x_mve(const uint8_t *const rows[], uint16_t count, int16_t *out);
void pel_row_sobel_y_mve(const uint8_t *const rows[], uint16_t count, int16_t *out);
void pel_row_gradient_abs_mve(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_gradient_abs_s16_mve(const uint8_t *const rows[], uint16_t count, int16_t *out);
void pel_row_median3_mve(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_min3_mve(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_max3_mve(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_erode_labels3_mve(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_dilate_labels3_mve(const uint8_t *const rows[], uint16_t count, uint8_t *out);
#endif

#endif
