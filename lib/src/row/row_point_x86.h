/*
 * The row kernels of two rows for x86: those of row_point.h, bit for bit, for each instruction set.
 * count is at least the bytes of a vector.
 */
#ifndef PEL_ROW_POINT_X86_H
#define PEL_ROW_POINT_X86_H

#include "row/row_point.h"

#if defined(__GNUC__) && defined(__x86_64__)
#define PEL_ROW_POINT_X86 1

enum { PEL_ROW_POINT_SSSE3 = 16, PEL_ROW_POINT_AVX2 = 32 };

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
                             uint16_t count, uint8_t *dst)

PEL_ROW_POINTS(ssse3);
PEL_ROW_POINTS(avx2);
#endif

#endif
