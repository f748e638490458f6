/*
 * The row kernels of neighbourhoods for x86: those of row_filter.h, bit for bit, for each
 * instruction set. count is at least the bytes of a vector: PEL_ROW_LANES_...; what does not fill
 * the last vector is done twice.
 */
#ifndef PEL_ROW_FILTER_X86_H
#define PEL_ROW_FILTER_X86_H

#include "row/row_filter.h"

#if defined(__GNUC__) && defined(__x86_64__)
#define PEL_ROW_FILTER_X86 1

enum { PEL_ROW_LANES_SSSE3 = 16, PEL_ROW_LANES_AVX2 = 32 };

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

PEL_ROW_FILTERS(ssse3);
PEL_ROW_FILTERS(avx2);
#endif

#endif
