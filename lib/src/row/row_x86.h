/*
 * The row kernels that exist for x86, one name for each instruction set. They equal those of row.h
 * bit for bit. Those that return a count work on whole vectors only: they say how many elements
 * they did, the first ones, and the rest is for the caller.
 */
#ifndef PEL_ROW_X86_H
#define PEL_ROW_X86_H

#include "row/row.h"
#include "row/row_nibbles.h"

#if defined(__GNUC__) && defined(__x86_64__)
#define PEL_ROW_X86 1

uint16_t pel_row_classify_nibbles_avx2(const uint8_t *nibbles, const pel_row_pairs *src,
                                       uint16_t count, uint8_t *labels);
uint16_t pel_row_find_runs_avx2(const uint8_t *labels, uint16_t count, uint16_t *edges);
#endif

#endif
