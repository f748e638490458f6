/*
 * The row kernels of point operations for x86: those of row_point.h, bit for bit, for each
 * instruction set. count is at least the bytes of a vector.
 */
#ifndef PEL_ROW_POINT_X86_H
#define PEL_ROW_POINT_X86_H

#include "row/row_vectors.h"

#if defined(__GNUC__) && defined(__x86_64__)
#define PEL_ROW_POINT_X86 1

enum { PEL_ROW_POINT_SSSE3 = 16, PEL_ROW_POINT_AVX2 = 32, PEL_ROW_POINT_AVX512 = 64 };

PEL_ROW_POINTS(ssse3);
PEL_ROW_POINTS(avx2);
void pel_row_map_avx512(const uint8_t *src, uint16_t count, const uint8_t *table, uint8_t *dst);
#endif

#endif
