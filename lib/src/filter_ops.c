/*
 * The operators of filter.h: each binds a row kernel to its name. One to a function, so that a
 * linker that drops unused functions keeps those that a program names.
 */
#include "pel/filter.h"

#include "row/row_filter_select.h"

#define OPERATOR(name, pixel, row_kernel, radius)                                                  \
    unsigned name(const uint8_t *const rows[], uint16_t count, const pel_filter_config *config,    \
                  pixel *out)                                                                      \
    {                                                                                              \
        if (count > 0) {                                                                           \
            row_kernel(config->backend, rows, count, out);                                         \
        }                                                                                          \
        return radius;                                                                             \
    }

OPERATOR(pel_op_gauss3, uint8_t, pel_i_row_gauss3, 1)
OPERATOR(pel_op_box3, uint8_t, pel_i_row_box3, 1)
OPERATOR(pel_op_binomial5, uint8_t, pel_i_row_binomial5, 2)
OPERATOR(pel_op_sobel_x_s16, int16_t, pel_i_row_sobel_x, 1)
OPERATOR(pel_op_sobel_y_s16, int16_t, pel_i_row_sobel_y, 1)
OPERATOR(pel_op_gradient_abs, uint8_t, pel_i_row_gradient_abs, 1)
OPERATOR(pel_op_gradient_abs_s16, int16_t, pel_i_row_gradient_abs_s16, 1)
OPERATOR(pel_op_gradient, uint8_t, pel_i_row_gradient, 1)
OPERATOR(pel_op_gradient_s16, int16_t, pel_i_row_gradient_s16, 1)
OPERATOR(pel_op_direction, uint8_t, pel_i_row_direction, 1)
OPERATOR(pel_op_median, uint8_t, pel_i_row_median3, 1)
OPERATOR(pel_op_min, uint8_t, pel_i_row_min3, 1)
OPERATOR(pel_op_max, uint8_t, pel_i_row_max3, 1)
OPERATOR(pel_op_majority, uint8_t, pel_i_row_majority3, 1)
OPERATOR(pel_op_erode_labels, uint8_t, pel_i_row_erode_labels3, 1)
OPERATOR(pel_op_dilate_labels, uint8_t, pel_i_row_dilate_labels3, 1)
