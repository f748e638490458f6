/*
 * The declarations of the row kernels of neighbourhoods and of two rows for one instruction set:
 * those of row_filter.h and row_point.h, bit for bit. count is at least the bytes of a vector; what
 * does not fill the last vector is done twice.
 */
#ifndef PEL_ROW_VECTORS_H
#define PEL_ROW_VECTORS_H

#include "row/row_filter.h"
#include "row/row_point.h"

#define PEL_ROW_BYTES(name, isa)                                                                   \
    void pel_row_##name##_##isa(const uint8_t *const rows[], uint16_t count, uint8_t *out)
#define PEL_ROW_WORDS(name, isa)                                                                   \
    void pel_row_##name##_##isa(const uint8_t *const rows[], uint16_t count, int16_t *out)
#define PEL_ROW_TAPS(name, isa, pixel)                                                             \
    void pel_row_##name##_##isa(const uint8_t *const rows[], const int8_t *tap,                    \
                                const pel_row_scale *scale, uint16_t count, pixel *out)

#define PEL_ROW_FILTERS(isa)                                                                       \
    PEL_ROW_TAPS(kernel3, isa, uint8_t);                                                           \
    PEL_ROW_TAPS(kernel3_s16, isa, int16_t);                                                       \
    PEL_ROW_TAPS(kernel5, isa, uint8_t);                                                           \
    PEL_ROW_TAPS(kernel5_s16, isa, int16_t);                                                       \
    PEL_ROW_BYTES(gauss3, isa);                                                                    \
    PEL_ROW_BYTES(box3, isa);                                                                      \
    PEL_ROW_BYTES(binomial5, isa);                                                                 \
    PEL_ROW_WORDS(sobel_x, isa);                                                                   \
    PEL_ROW_WORDS(sobel_y, isa);                                                                   \
    PEL_ROW_BYTES(gradient_abs, isa);                                                              \
    PEL_ROW_WORDS(gradient_abs_s16, isa);                                                          \
    PEL_ROW_BYTES(gradient, isa);                                                                  \
    PEL_ROW_WORDS(gradient_s16, isa);                                                              \
    PEL_ROW_BYTES(median3, isa);                                                                   \
    PEL_ROW_BYTES(min3, isa);                                                                      \
    PEL_ROW_BYTES(max3, isa);                                                                      \
    PEL_ROW_BYTES(erode_labels3, isa);                                                             \
    PEL_ROW_BYTES(dilate_labels3, isa)

#define PEL_ROW_PAIR(name, isa)                                                                    \
    void pel_row_##name##_##isa(const uint8_t *a, const uint8_t *b, uint16_t count, uint8_t *dst)

#define PEL_ROW_POINTS(isa)                                                                        \
    PEL_ROW_PAIR(add, isa);                                                                        \
    PEL_ROW_PAIR(subtract, isa);                                                                   \
    PEL_ROW_PAIR(absdiff, isa);                                                                    \
    PEL_ROW_PAIR(min, isa);                                                                        \
    PEL_ROW_PAIR(max, isa);                                                                        \
    PEL_ROW_PAIR(and, isa);                                                                        \
    PEL_ROW_PAIR(or, isa);                                                                         \
    PEL_ROW_PAIR(xor, isa);                                                                        \
    void pel_row_blend_##isa(const uint8_t *a, const uint8_t *b, uint16_t alpha_q8,                \
                             uint16_t count, uint8_t *dst);                                        \
    void pel_row_copy_##isa(const uint8_t *src, uint16_t count, uint8_t *dst);                     \
    int pel_row_find_step_##isa(const uint8_t *table, uint8_t *last_low);                          \
    void pel_row_step_##isa(const pel_row_curve *curve, const uint8_t *src, uint16_t count,        \
                            uint8_t *dst);                                                         \
    void pel_row_integral_##isa(const uint8_t *src, uint16_t count, const uint32_t *above,         \
                                uint32_t *sums);                                                   \
    void pel_row_columns_add_##isa(const uint8_t *src, uint16_t count, uint16_t times,             \
                                   uint16_t *sums);                                                \
    void pel_row_columns_subtract_##isa(const uint8_t *src, uint16_t count, uint16_t *sums);       \
    void pel_row_over_mean_##isa(const uint8_t *src, const uint16_t *columns, uint16_t count,      \
                                 uint16_t radius, int16_t c, uint8_t *dst);                        \
    void pel_row_box_add2_##isa(const uint8_t *src, uint16_t width_out, uint32_t *sums);           \
    void pel_row_box_add4_##isa(const uint8_t *src, uint16_t width_out, uint32_t *sums);           \
    void pel_row_box_mean_##isa(const uint32_t *sums, uint32_t area, uint16_t count,               \
                                uint8_t *dst);                                                     \
    void pel_row_bilinear_##isa(const pel_row_between *rows, const pel_row_place *places,          \
                                uint16_t count, uint8_t *dst);                                     \
    void pel_row_gain3_##isa(const uint8_t *src, uint16_t count, const uint16_t gains_q8[3],       \
                             uint8_t *dst)

#endif
