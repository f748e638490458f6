/* The check behind "must not overlap". Private to the modules. */
#ifndef PEL_OVERLAP_H
#define PEL_OVERLAP_H

#include <stddef.h>
#include <stdint.h>

/* Whether two stretches of memory share a byte; an empty one shares none. */
static inline int pel_i_overlap(const void *a, size_t a_bytes, const void *b, size_t b_bytes)
{
    const uintptr_t a0 = (uintptr_t)a, b0 = (uintptr_t)b;
    return a0 < b0 ? a0 + a_bytes > b0 && b_bytes > 0 : b0 + b_bytes > a0 && a_bytes > 0;
}

#endif
