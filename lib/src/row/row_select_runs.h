/* Which version of the run finders runs: see row_select.h. */
#ifndef PEL_ROW_SELECT_RUNS_H
#define PEL_ROW_SELECT_RUNS_H

#include "row/row_select.h"

/* The versions of a kernel that the processor may have, for rows of as many pixels as LEAST
 * says. */
#if defined(PEL_ROW_X86)
/* In shorter rows plain C is through before the tables of a version from pixels to runs are set
 * up. */
enum { PEL_ROW_PIXELS_SSSE3 = 160, PEL_ROW_PIXELS_AVX2 = 96, PEL_ROW_PIXELS_AVX512 = 128 };

#define PEL_ROW_TRY_RUNS(name, LEAST, arguments)                                                   \
    if (backend >= PEL_BACKEND_AVX512 && count >= PEL_ROW_##LEAST##_AVX512) {                      \
        return pel_row_##name##_avx512 arguments;                                                  \
    }                                                                                              \
    if (backend >= PEL_BACKEND_AVX2 && count >= PEL_ROW_##LEAST##_AVX2) {                          \
        return pel_row_##name##_avx2 arguments;                                                    \
    }                                                                                              \
    if (backend >= PEL_BACKEND_SSSE3 && count >= PEL_ROW_##LEAST##_SSSE3) {                        \
        return pel_row_##name##_ssse3 arguments;                                                   \
    }
#elif defined(PEL_ROW_NEON)
#define PEL_ROW_TRY_RUNS(name, LEAST, arguments)                                                   \
    if (backend == PEL_BACKEND_NEON) {                                                             \
        return pel_row_##name##_neon arguments;                                                    \
    }
#else
#define PEL_ROW_TRY_RUNS(name, LEAST, arguments) (void)backend;
#endif

static inline uint16_t pel_i_row_find_runs(pel_backend backend, const uint8_t *labels,
                                           uint16_t count, uint16_t *edges)
{
    PEL_ROW_TRY_RUNS(find_runs, VECTOR, (labels, count, edges))
    return PEL_BEST_FIND_RUNS(labels, count, edges);
}

/* nibbles are those of the boxes; not looked at by SCALAR. */
static inline uint16_t pel_i_row_classify_runs(pel_backend backend, const uint8_t *nibbles,
                                               const pel_row_boxes *boxes, const pel_row_pairs *src,
                                               uint16_t count, uint8_t *labels, uint16_t *edges)
{
    (void)nibbles;
    PEL_ROW_TRY_RUNS(classify_runs, PIXELS, (nibbles, boxes, src, count, labels, edges))
    return PEL_BEST_CLASSIFY_RUNS(boxes, src, count, labels, edges);
}

#endif
