/*
 * The row kernels from pixels to runs that exist for x86, one name for each instruction set. They
 * equal those of row.h bit for bit. classify_nibbles says how many pixels it did, the first ones,
 * and the rest is for the caller; the others take rows of a vector or more.
 */
#ifndef PEL_ROW_X86_H
#define PEL_ROW_X86_H

#include "row/row.h"
#include "row/row_nibbles.h"

#if defined(__GNUC__) && defined(__x86_64__)
#define PEL_ROW_X86 1

enum { PEL_ROW_VECTOR_SSSE3 = 32, PEL_ROW_VECTOR_AVX2 = 64, PEL_ROW_VECTOR_AVX512 = 64 };

#define PEL_ROW_KERNELS(isa)                                                                       \
    uint16_t pel_row_classify_nibbles_##isa(const uint8_t *nibbles, const pel_row_pairs *src,      \
                                            uint16_t count, uint8_t *labels);                      \
    uint16_t pel_row_classify_runs_##isa(const uint8_t *nibbles, const pel_row_boxes *boxes,       \
                                         const pel_row_pairs *src, uint16_t count,                 \
                                         uint8_t *labels, uint16_t *edges);                        \
    uint16_t pel_row_find_runs_##isa(const uint8_t *labels, uint16_t count, uint16_t *edges);

PEL_ROW_KERNELS(ssse3)
PEL_ROW_KERNELS(avx2)
PEL_ROW_KERNELS(avx512)
#undef PEL_ROW_KERNELS
#endif

#endif
