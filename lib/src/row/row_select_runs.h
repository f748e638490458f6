/* Which version of the run finder runs: see row_select.h. The blob finder takes the plain one. */
#ifndef PEL_ROW_SELECT_RUNS_H
#define PEL_ROW_SELECT_RUNS_H

#include "row/row_select.h"

static inline uint16_t pel_i_row_find_runs(pel_backend backend, const uint8_t *labels,
                                           uint16_t count, uint16_t *edges)
{
    switch (backend) {
#if defined(PEL_ROW_X86)
    case PEL_BACKEND_AVX2:
        return pel_row_find_runs_avx2(labels, count, edges);
#endif
#if defined(PEL_ROW_NEON)
    case PEL_BACKEND_NEON:
        return pel_row_find_runs_neon(labels, count, edges);
#endif
    default:
        return pel_row_find_runs(labels, count, edges);
    }
}

/* nibbles are those of the boxes; not looked at by SCALAR. */
static inline uint16_t pel_i_row_classify_runs(pel_backend backend, const uint8_t *nibbles,
                                               const pel_row_boxes *boxes, const pel_row_pairs *src,
                                               uint16_t count, uint8_t *labels, uint16_t *edges)
{
    if (backend == PEL_BACKEND_SCALAR) {
        return pel_row_classify_runs(boxes, src, count, labels, edges);
    }
#if defined(PEL_ROW_NEON)
    if (backend == PEL_BACKEND_NEON) {
        return pel_row_classify_runs_neon(nibbles, boxes, src, count, labels, edges);
    }
#endif
    pel_i_row_classify_pairs(backend, nibbles, boxes, src, count, labels);
    return pel_i_row_find_runs(backend, labels, count, edges);
}

#endif
