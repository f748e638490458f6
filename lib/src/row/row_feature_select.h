/* Which version of a row kernel of corners and edges runs: a part of row_select.h, see there. */
#ifndef PEL_ROW_FEATURE_SELECT_H
#define PEL_ROW_FEATURE_SELECT_H

#include "row/row_feature_vectors.h"
#include "row/row_select.h"

/* The versions of a kernel in vectors, a step of which is on x86 a vector of bytes divided by
 * `parts`; rows narrower than a step are for the next smaller one. */
#if defined(PEL_ROW_FEATURE_X86)
#define PEL_ROW_TRY_FEATURE(name, parts, arguments)                                                \
    if (backend >= PEL_BACKEND_AVX512 && count >= PEL_ROW_FEATURE_AVX512 / (parts)) {              \
        pel_row_##name##_avx512 arguments;                                                         \
        return;                                                                                    \
    }                                                                                              \
    if (backend >= PEL_BACKEND_AVX2 && count >= PEL_ROW_FEATURE_AVX2 / (parts)) {                  \
        pel_row_##name##_avx2 arguments;                                                           \
        return;                                                                                    \
    }                                                                                              \
    if (backend >= PEL_BACKEND_SSSE3 && count >= PEL_ROW_FEATURE_SSSE3 / (parts)) {                \
        pel_row_##name##_ssse3 arguments;                                                          \
        return;                                                                                    \
    }
#elif defined(PEL_ROW_NEON)
#define PEL_ROW_TRY_FEATURE(name, parts, arguments)                                                \
    if (backend == PEL_BACKEND_NEON && count >= PEL_ROW_LANES_NEON) {                              \
        pel_row_##name##_neon arguments;                                                           \
        return;                                                                                    \
    }
#else
#define PEL_ROW_TRY_FEATURE(name, parts, arguments) (void)backend;
#endif

static inline void pel_i_row_harris(pel_backend backend, const uint8_t *const rows[],
                                    uint16_t count, uint16_t k_q15, int32_t *responses)
{
    PEL_ROW_TRY_FEATURE(harris, 2, (rows, count, k_q15, responses))
    pel_row_harris(rows, count, k_q15, responses);
}

static inline void pel_i_row_shi_tomasi(pel_backend backend, const uint8_t *const rows[],
                                        uint16_t count, int32_t *responses)
{
    PEL_ROW_TRY_FEATURE(shi_tomasi, 2, (rows, count, responses))
    pel_row_shi_tomasi(rows, count, responses);
}

static inline void pel_i_row_fast9(pel_backend backend, const uint8_t *const rows[], uint16_t count,
                                   int16_t threshold, int32_t *responses)
{
    PEL_ROW_TRY_FEATURE(fast9, 1, (rows, count, threshold, responses))
    pel_row_fast9(rows, count, threshold, responses);
}

/* What does not fill a vector is left to plain C. */
static inline uint16_t pel_i_row_next_top(pel_backend backend, const int32_t *const rows[],
                                          uint16_t begin, uint16_t end, int32_t threshold, int kind)
{
#if defined(PEL_ROW_FEATURE_X86)
    if (backend >= PEL_BACKEND_AVX2) {
        return pel_row_next_top_avx2(rows, begin, end, threshold, kind);
    }
    if (backend == PEL_BACKEND_SSSE3) {
        return pel_row_next_top_ssse3(rows, begin, end, threshold, kind);
    }
#elif defined(PEL_ROW_NEON)
    if (backend == PEL_BACKEND_NEON) {
        return pel_row_next_top_neon(rows, begin, end, threshold, kind);
    }
#else
    (void)backend;
#endif
    return pel_row_next_top(rows, begin, end, threshold, kind);
}

static inline void pel_i_row_gradient_sector(pel_backend backend, const uint8_t *const rows[],
                                             uint16_t count, uint16_t *gradients)
{
    PEL_ROW_TRY_FEATURE(gradient_sector, 2, (rows, count, gradients))
    pel_row_gradient_sector(rows, count, gradients);
}

static inline void pel_i_row_thin(pel_backend backend, const uint16_t *const rows[], uint16_t count,
                                  uint16_t low, uint16_t high, uint8_t *out)
{
    PEL_ROW_TRY_FEATURE(thin, 2, (rows, count, low, high, out))
    pel_row_thin(rows, count, low, high, out);
}

#endif
