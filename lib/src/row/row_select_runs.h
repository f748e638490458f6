/* Which version of the run finder runs: see row_select.h. The blob finder takes the plain one. */
#ifndef PEL_ROW_SELECT_RUNS_H
#define PEL_ROW_SELECT_RUNS_H

#include "pel/backend.h"
#include "row/row.h"
#include "row/row_x86.h"

static inline uint16_t pel_i_row_find_runs(pel_backend backend, const uint8_t *labels,
                                           uint16_t count, uint16_t *edges)
{
    switch (backend) {
#if defined(PEL_ROW_X86)
    case PEL_BACKEND_AVX2:
        return pel_row_find_runs_avx2(labels, count, edges);
#endif
    default:
        return pel_row_find_runs(labels, count, edges);
    }
}

#endif
