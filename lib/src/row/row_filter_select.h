/* Which version of a row kernel of neighbourhoods runs: a part of row_select.h, see there. */
#ifndef PEL_ROW_FILTER_SELECT_H
#define PEL_ROW_FILTER_SELECT_H

#include "row/row_filter_best.h"
#include "row/row_select.h"

/* pel_i_row_NAME(backend, rows, count, out); `plain` is what the compiler's flags chose. */
#define PEL_ROW_SELECT(name, pixel, plain)                                                         \
    static inline void pel_i_row_##name(pel_backend backend, const uint8_t *const rows[],          \
                                        uint16_t count, pixel *out)                                \
    {                                                                                              \
        (void)backend;                                                                             \
        plain(rows, count, out);                                                                   \
    }

PEL_ROW_SELECT(gauss3, uint8_t, PEL_BEST_GAUSS3)
PEL_ROW_SELECT(box3, uint8_t, pel_row_box3)
PEL_ROW_SELECT(binomial5, uint8_t, pel_row_binomial5)
PEL_ROW_SELECT(sobel_x, int16_t, pel_row_sobel_x)
PEL_ROW_SELECT(sobel_y, int16_t, pel_row_sobel_y)
PEL_ROW_SELECT(gradient_abs, uint8_t, PEL_BEST_GRADIENT_ABS)
PEL_ROW_SELECT(gradient_abs_s16, int16_t, pel_row_gradient_abs_s16)
PEL_ROW_SELECT(gradient, uint8_t, pel_row_gradient)
PEL_ROW_SELECT(gradient_s16, int16_t, pel_row_gradient_s16)
PEL_ROW_SELECT(direction, uint8_t, pel_row_direction)
PEL_ROW_SELECT(median3, uint8_t, pel_row_median3)
PEL_ROW_SELECT(min3, uint8_t, pel_row_min3)
PEL_ROW_SELECT(max3, uint8_t, pel_row_max3)
PEL_ROW_SELECT(majority3, uint8_t, pel_row_majority3)
PEL_ROW_SELECT(erode_labels3, uint8_t, pel_row_erode_labels3)
PEL_ROW_SELECT(dilate_labels3, uint8_t, pel_row_dilate_labels3)

/* pel_i_row_NAME(backend, rows, tap, scale, count, out) */
#define PEL_ROW_SELECT_KERNEL(name, pixel, plain)                                                  \
    static inline void pel_i_row_##name(pel_backend backend, const uint8_t *const rows[],          \
                                        const int8_t *tap, const pel_row_scale *scale,             \
                                        uint16_t count, pixel *out)                                \
    {                                                                                              \
        (void)backend;                                                                             \
        plain(rows, tap, scale, count, out);                                                       \
    }

PEL_ROW_SELECT_KERNEL(kernel3, uint8_t, PEL_BEST_KERNEL3)
PEL_ROW_SELECT_KERNEL(kernel3_s16, int16_t, pel_row_kernel3_s16)
PEL_ROW_SELECT_KERNEL(kernel5, uint8_t, pel_row_kernel5)
PEL_ROW_SELECT_KERNEL(kernel5_s16, int16_t, pel_row_kernel5_s16)

#endif
