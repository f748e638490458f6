/* Row kernels in words of eight pixels: those of row.h and row_point.h, bit for bit. */
#ifndef PEL_ROW_POINT_WORDS_H
#define PEL_ROW_POINT_WORDS_H

#include "row/row.h"
#include "row/row_neon.h"
#include "row/row_point.h"
#include "row/row_point_x86.h"

#if defined(PEL_ROW_POINT_X86) || defined(PEL_ROW_NEON)
#define PEL_ROW_POINT_WORDS 1

void pel_row_map_words(const uint8_t *src, uint16_t count, const uint8_t *table, uint8_t *dst);
void pel_row_histogram_words(const uint8_t *src, uint16_t count, uint32_t *bins);
#endif

#endif
