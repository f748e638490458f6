/* The check behind "must not overlap". Private to the modules. */
#ifndef PEL_OVERLAP_H
#define PEL_OVERLAP_H

#include <stddef.h>
#include <stdint.h>

/* Whether two stretches of memory share a byte; an empty one shares none. */
int pel_i_overlap(const void *a, size_t a_bytes, const void *b, size_t b_bytes);

/* The same, where it is asked for every row: without a call, if not compiled for size. */
static inline int pel_i_overlap_now(const void *a, size_t a_bytes, const void *b, size_t b_bytes)
{
#if defined(__OPTIMIZE_SIZE__)
    return pel_i_overlap(a, a_bytes, b, b_bytes);
#else
    const uintptr_t a0 = (uintptr_t)a, b0 = (uintptr_t)b;
    return a_bytes > 0 && b_bytes > 0 && (b0 - a0 < a_bytes || a0 - b0 < b_bytes);
#endif
}

/*
 * Whether memory can hold elements of 2, 4 or 8 bytes. How they are aligned is up to the machine:
 * often to their size, but on AVR to nothing, and there an array of uint64_t may lie anywhere.
 */
struct pel_i_element2 {
    char before;
    uint16_t element;
};
struct pel_i_element4 {
    char before;
    uint32_t element;
};
struct pel_i_element8 {
    char before;
    uint64_t element;
};

static inline int pel_i_aligned2(const void *memory)
{
    return (uintptr_t)memory % offsetof(struct pel_i_element2, element) == 0;
}

static inline int pel_i_aligned4(const void *memory)
{
    return (uintptr_t)memory % offsetof(struct pel_i_element4, element) == 0;
}

static inline int pel_i_aligned8(const void *memory)
{
    return (uintptr_t)memory % offsetof(struct pel_i_element8, element) == 0;
}

#endif
