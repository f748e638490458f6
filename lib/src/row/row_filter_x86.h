/*
 * The row kernels of neighbourhoods for x86: those of row_filter.h, bit for bit, for each
 * instruction set. count is at least the bytes of a vector: PEL_ROW_LANES_...; what does not fill
 * the last vector is done twice.
 */
#ifndef PEL_ROW_FILTER_X86_H
#define PEL_ROW_FILTER_X86_H

#include "row/row_vectors.h"

#if defined(__GNUC__) && defined(__x86_64__)
#define PEL_ROW_FILTER_X86 1

enum { PEL_ROW_LANES_SSSE3 = 16, PEL_ROW_LANES_AVX2 = 32, PEL_ROW_LANES_AVX512 = 64 };

PEL_ROW_FILTERS(ssse3);
PEL_ROW_FILTERS(avx2);
PEL_ROW_FILTERS(avx512);
#endif

#endif
