/* The label of a mask, for kernels that want it now and then. */
#ifndef PEL_ROW_LABEL_H
#define PEL_ROW_LABEL_H

#include "row/row.h"

/* Where the lowest set bit is found by an instruction or two. */
#if defined(__GNUC__) && (defined(__x86_64__) || defined(__i386__) || defined(__aarch64__) ||      \
                          (defined(__ARM_FEATURE_CLZ) && __ARM_ARCH >= 7))
#define PEL_HAS_CTZ 1
#else
#define PEL_HAS_CTZ 0
#endif

#if PEL_HAS_CTZ
static inline unsigned pel_i_lowest_bit(size_t bits)
{
    return (unsigned)(sizeof bits == 8 ? __builtin_ctzll(bits) : __builtin_ctz((unsigned)bits));
}
#endif

/* That of a mask that is not 0: 1 + the place of its lowest bit. */
static inline uint8_t pel_i_label(pel_class_mask mask)
{
#if PEL_HAS_CTZ
    return (uint8_t)(pel_i_lowest_bit(mask) + 1);
#else
    uint8_t label = 1;

    for (pel_class_mask bits = mask; (bits & 1) == 0; bits = (pel_class_mask)(bits >> 1)) {
        label++;
    }
    return label;
#endif
}

#endif
