/*
 * Frames whose rows are filtered where they lie, without the copy into the ring of rows that lets
 * rows stream. Only where a vector backend makes a row faster than its copy. Private to filter_*.c.
 */
#ifndef PEL_FILTER_DIRECT_H
#define PEL_FILTER_DIRECT_H

#include "pel/filter.h"
#include "row/row_filter_x86.h"

/* Where results go: one of the two is set. The stride counts elements. */
typedef struct pel_filter_target {
    uint8_t *bytes;
    int16_t *words;
    ptrdiff_t stride;
} pel_filter_target;

/* Filters all of src, which lies apart from the target, with a filter that has begun and is used up
 * by it: 1. Or 0 if nothing was done, as rows are to be copied. */
#if defined(PEL_ROW_FILTER_X86)
int pel_i_filter_direct(const pel_filter *f, const pel_cview *src, const pel_filter_target *dst);
#else
static inline int pel_i_filter_direct(const pel_filter *f, const pel_cview *src,
                                      const pel_filter_target *dst)
{
    (void)f;
    (void)src;
    (void)dst;
    return 0;
}
#endif

#endif
