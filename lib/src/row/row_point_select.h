/* Which version of a row kernel of point operations runs: a part of row_select.h, see there. */
#ifndef PEL_ROW_POINT_SELECT_H
#define PEL_ROW_POINT_SELECT_H

#include "row/row_neon.h"
#include "row/row_point_x86.h"
#include "row/row_select.h"

/* The versions of a kernel in vectors; rows narrower than one are for the next smaller one. */
#if defined(PEL_ROW_POINT_X86)
#define PEL_ROW_TRY_POINT(name, arguments)                                                         \
    if (backend >= PEL_BACKEND_AVX2 && count >= PEL_ROW_POINT_AVX2) {                              \
        pel_row_##name##_avx2 arguments;                                                           \
        return;                                                                                    \
    }                                                                                              \
    if (backend >= PEL_BACKEND_SSSE3 && count >= PEL_ROW_POINT_SSSE3) {                            \
        pel_row_##name##_ssse3 arguments;                                                          \
        return;                                                                                    \
    }
#elif defined(PEL_ROW_NEON)
#define PEL_ROW_TRY_POINT(name, arguments)                                                         \
    if (backend == PEL_BACKEND_NEON && count >= PEL_ROW_LANES_NEON) {                              \
        pel_row_##name##_neon arguments;                                                           \
        return;                                                                                    \
    }
#else
#define PEL_ROW_TRY_POINT(name, arguments) (void)backend;
#endif

/* pel_i_row_NAME(backend, a, b, count, dst) */
#define PEL_ROW_SELECT_PAIR(name)                                                                  \
    static inline void pel_i_row_##name(pel_backend backend, const uint8_t *a, const uint8_t *b,   \
                                        uint16_t count, uint8_t *dst)                              \
    {                                                                                              \
        PEL_ROW_TRY_POINT(name, (a, b, count, dst))                                                \
        pel_row_##name(a, b, count, dst);                                                          \
    }

PEL_ROW_SELECT_PAIR(add)
PEL_ROW_SELECT_PAIR(subtract)
PEL_ROW_SELECT_PAIR(absdiff)
PEL_ROW_SELECT_PAIR(min)
PEL_ROW_SELECT_PAIR(max)
PEL_ROW_SELECT_PAIR(and)
PEL_ROW_SELECT_PAIR(or)
PEL_ROW_SELECT_PAIR(xor)

static inline void pel_i_row_blend(pel_backend backend, const uint8_t *a, const uint8_t *b,
                                   uint16_t alpha_q8, uint16_t count, uint8_t *dst)
{
    PEL_ROW_TRY_POINT(blend, (a, b, alpha_q8, count, dst))
    pel_row_blend(a, b, alpha_q8, count, dst);
}

#endif
