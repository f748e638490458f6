/* Which version of a row kernel of neighbourhoods runs: a part of row_select.h, see there. */
#ifndef PEL_ROW_FILTER_SELECT_H
#define PEL_ROW_FILTER_SELECT_H

#include "row/row_filter_best.h"
#include "row/row_filter_x86.h"
#include "row/row_neon.h"
#include "row/row_select.h"

/* The versions of a kernel in vectors; rows narrower than one are for the next smaller one. */
#if defined(PEL_ROW_FILTER_X86) && !PEL_ROW_DSP
#define PEL_ROW_TRY(name, arguments)                                                               \
    if (backend >= PEL_BACKEND_AVX512 && count >= PEL_ROW_LANES_AVX512) {                          \
        pel_row_##name##_avx512 arguments;                                                         \
        return;                                                                                    \
    }                                                                                              \
    if (backend >= PEL_BACKEND_AVX2 && count >= PEL_ROW_LANES_AVX2) {                              \
        pel_row_##name##_avx2 arguments;                                                           \
        return;                                                                                    \
    }                                                                                              \
    if (backend >= PEL_BACKEND_SSSE3 && count >= PEL_ROW_LANES_SSSE3) {                            \
        pel_row_##name##_ssse3 arguments;                                                          \
        return;                                                                                    \
    }
#elif defined(PEL_ROW_NEON)
#define PEL_ROW_TRY(name, arguments)                                                               \
    if (backend == PEL_BACKEND_NEON && count >= PEL_ROW_LANES_NEON) {                              \
        pel_row_##name##_neon arguments;                                                           \
        return;                                                                                    \
    }
#else
#define PEL_ROW_TRY(name, arguments) (void)backend;
#endif

/* pel_i_row_NAME(backend, rows, count, out). `best` is the one that the compiler's flags chose. */
#define PEL_ROW_PLAIN(name, pixel)                                                                 \
    static inline void pel_i_row_##name(pel_backend backend, const uint8_t *const rows[],          \
                                        uint16_t count, pixel *out)                                \
    {                                                                                              \
        (void)backend;                                                                             \
        pel_row_##name(rows, count, out);                                                          \
    }
#define PEL_ROW_SELECT(name, pixel, best)                                                          \
    static inline void pel_i_row_##name(pel_backend backend, const uint8_t *const rows[],          \
                                        uint16_t count, pixel *out)                                \
    {                                                                                              \
        PEL_ROW_TRY(name, (rows, count, out))                                                      \
        best(rows, count, out);                                                                    \
    }

PEL_ROW_SELECT(gauss3, uint8_t, PEL_BEST_GAUSS3)
PEL_ROW_SELECT(box3, uint8_t, PEL_BEST(box3))
PEL_ROW_SELECT(binomial5, uint8_t, PEL_BEST(binomial5))
PEL_ROW_SELECT(sobel_x, int16_t, PEL_BEST(sobel_x))
PEL_ROW_SELECT(sobel_y, int16_t, PEL_BEST(sobel_y))
PEL_ROW_SELECT(gradient_abs, uint8_t, PEL_BEST_GRADIENT_ABS)
PEL_ROW_SELECT(gradient_abs_s16, int16_t, PEL_BEST(gradient_abs_s16))
PEL_ROW_SELECT(gradient, uint8_t, pel_row_gradient)
PEL_ROW_SELECT(gradient_s16, int16_t, pel_row_gradient_s16)
PEL_ROW_PLAIN(direction, uint8_t)
PEL_ROW_SELECT(median3, uint8_t, PEL_BEST_MEDIAN3)
PEL_ROW_SELECT(min3, uint8_t, PEL_BEST_MIN3)
PEL_ROW_SELECT(max3, uint8_t, PEL_BEST_MAX3)
PEL_ROW_PLAIN(majority3, uint8_t)
PEL_ROW_SELECT(erode_labels3, uint8_t, PEL_BEST(erode_labels3))
PEL_ROW_SELECT(dilate_labels3, uint8_t, PEL_BEST(dilate_labels3))

#if defined(PEL_ROW_FILTER_X86)
/* pel_i_row_NAME_rows(backend, rows, count, height, out, stride) */
#define PEL_ROW_SELECT_ROWS(name, pixel)                                                           \
    static inline void pel_i_row_##name##_rows(pel_backend backend, const uint8_t *const rows[],   \
                                               uint16_t count, uint16_t height, pixel *out,        \
                                               ptrdiff_t stride)                                   \
    {                                                                                              \
        PEL_ROW_TRY(name##_rows, (rows, count, height, out, stride))                               \
        for (unsigned y = 0; y < height; y++) {                                                    \
            pel_row_##name(rows + y, count, out + (ptrdiff_t)y * stride);                          \
        }                                                                                          \
    }

PEL_ROW_SELECT_ROWS(gauss3, uint8_t)
PEL_ROW_SELECT_ROWS(sobel_x, int16_t)
PEL_ROW_SELECT_ROWS(sobel_y, int16_t)
PEL_ROW_SELECT_ROWS(gradient_abs, uint8_t)
PEL_ROW_SELECT_ROWS(gradient, uint8_t)
PEL_ROW_SELECT_ROWS(median3, uint8_t)
PEL_ROW_SELECT_ROWS(min3, uint8_t)
PEL_ROW_SELECT_ROWS(max3, uint8_t)

static inline void pel_i_row_kernel3_rows(pel_backend backend, const uint8_t *const rows[],
                                          const pel_row_taps *taps, uint16_t count, uint16_t height,
                                          uint8_t *out, ptrdiff_t stride)
{
    PEL_ROW_TRY(kernel3_rows, (rows, taps, count, height, out, stride))
    for (unsigned y = 0; y < height; y++) {
        pel_row_kernel3(rows + y, taps->tap, &taps->scale, count, out + (ptrdiff_t)y * stride);
    }
}
#endif

/* pel_i_row_NAME(backend, rows, tap, scale, count, out) */
#define PEL_ROW_SELECT_KERNEL(name, pixel, best)                                                   \
    static inline void pel_i_row_##name(pel_backend backend, const uint8_t *const rows[],          \
                                        const int8_t *tap, const pel_row_scale *scale,             \
                                        uint16_t count, pixel *out)                                \
    {                                                                                              \
        PEL_ROW_TRY(name, (rows, tap, scale, count, out))                                          \
        best(rows, tap, scale, count, out);                                                        \
    }

PEL_ROW_SELECT_KERNEL(kernel3, uint8_t, PEL_BEST_KERNEL3)
PEL_ROW_SELECT_KERNEL(kernel3_s16, int16_t, PEL_BEST(kernel3_s16))
PEL_ROW_SELECT_KERNEL(kernel5, uint8_t, PEL_BEST(kernel5))
PEL_ROW_SELECT_KERNEL(kernel5_s16, int16_t, PEL_BEST(kernel5_s16))

#endif
