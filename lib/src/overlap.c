#include "overlap.h"

/* Distances are taken upward and wrap, so that memory may end at the last address. */
int pel_i_overlap(const void *a, size_t a_bytes, const void *b, size_t b_bytes)
{
    const uintptr_t a0 = (uintptr_t)a, b0 = (uintptr_t)b;
    return a_bytes > 0 && b_bytes > 0 && (b0 - a0 < a_bytes || a0 - b0 < b_bytes);
}
