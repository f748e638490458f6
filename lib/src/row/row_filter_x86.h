/*
 * The row kernels of neighbourhoods for x86: those of row_filter.h, bit for bit, for each
 * instruction set. count is at least the bytes of a vector: PEL_ROW_LANES_...; what does not fill
 * the last vector is done twice.
 */
#ifndef PEL_ROW_FILTER_X86_H
#define PEL_ROW_FILTER_X86_H

#include "row/row_vectors.h"

#include <stddef.h>

#if defined(__GNUC__) && defined(__x86_64__)
#define PEL_ROW_FILTER_X86 1

enum { PEL_ROW_LANES_SSSE3 = 16, PEL_ROW_LANES_AVX2 = 32, PEL_ROW_LANES_AVX512 = 64 };

/*
 * Several rows of results at once, as many as `height`, which lie `stride` results apart, from as
 * many rows of pixels and two more: each is what the kernel of this name makes of three of them.
 */
#define PEL_ROW_ROWS(name, isa, pixel)                                                             \
    void pel_row_##name##_rows_##isa(const uint8_t *const rows[], uint16_t count, uint16_t height, \
                                     pixel *out, ptrdiff_t stride)
typedef struct pel_row_taps {
    const int8_t *tap;
    pel_row_scale scale;
} pel_row_taps;

#define PEL_ROW_FILTERS_ROWS(isa)                                                                  \
    PEL_ROW_ROWS(gauss3, isa, uint8_t);                                                            \
    PEL_ROW_ROWS(sobel_x, isa, int16_t);                                                           \
    PEL_ROW_ROWS(sobel_y, isa, int16_t);                                                           \
    PEL_ROW_ROWS(gradient_abs, isa, uint8_t);                                                      \
    PEL_ROW_ROWS(gradient, isa, uint8_t);                                                          \
    PEL_ROW_ROWS(median3, isa, uint8_t);                                                           \
    PEL_ROW_ROWS(min3, isa, uint8_t);                                                              \
    PEL_ROW_ROWS(max3, isa, uint8_t);                                                              \
    void pel_row_kernel3_rows_##isa(const uint8_t *const rows[], const pel_row_taps *taps,         \
                                    uint16_t count, uint16_t height, uint8_t *out,                 \
                                    ptrdiff_t stride)

PEL_ROW_FILTERS(ssse3);
PEL_ROW_FILTERS(avx2);
PEL_ROW_FILTERS(avx512);
PEL_ROW_FILTERS_ROWS(ssse3);
PEL_ROW_FILTERS_ROWS(avx2);
PEL_ROW_FILTERS_ROWS(avx512);
#endif

#endif
