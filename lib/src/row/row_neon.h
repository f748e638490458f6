/*
 * The row kernels that exist for AArch64 with NEON. They equal those of row.h, row_filter.h and
 * row_point.h bit for bit. All AArch64 processors under an operating system have NEON: there is
 * nothing to ask them.
 */
#ifndef PEL_ROW_NEON_H
#define PEL_ROW_NEON_H

#include "row/row.h"
#include "row/row_nibbles.h"
#include "row/row_vectors.h"

#if defined(__GNUC__) && defined(__aarch64__) && defined(__ARM_NEON) &&                            \
    __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
#define PEL_ROW_NEON 1

enum { PEL_ROW_LANES_NEON = 16 };

/* Whole vectors only: says how many labels it did, the first ones; the rest is for the caller. */
uint16_t pel_row_classify_nibbles_neon(const uint8_t *nibbles, const pel_row_pairs *src,
                                       uint16_t count, uint8_t *labels);
uint16_t pel_row_find_runs_neon(const uint8_t *labels, uint16_t count, uint16_t *edges);

/* The last pixels, which fill no vector, by the boxes, which are those of the nibbles. */
uint16_t pel_row_classify_runs_neon(const uint8_t *nibbles, const pel_row_boxes *boxes,
                                    const pel_row_pairs *src, uint16_t count, uint8_t *labels,
                                    uint16_t *edges);

PEL_ROW_FILTERS(neon);
PEL_ROW_POINTS(neon);
void pel_row_map_neon(const uint8_t *src, uint16_t count, const uint8_t *table, uint8_t *dst);
#endif

#endif
