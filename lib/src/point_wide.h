/* Integers that are wider than the compiler's, for results that are to be exact. Private. */
#ifndef PEL_POINT_WIDE_H
#define PEL_POINT_WIDE_H

#include <stdint.h>

/* An array of 32-bit limbs, the lowest first. The caller knows how many are enough. */

void pel_i_wide_set(uint32_t *wide, unsigned limbs, uint32_t value);

/* wide *= factor; the product must fit. */
void pel_i_wide_multiply(uint32_t *wide, unsigned limbs, uint64_t factor);

/* Whether a <= b, of the same number of limbs. */
int pel_i_wide_not_over(const uint32_t *a, const uint32_t *b, unsigned limbs);

/* floor(numerator / divisor), which must be under 2^32; without the helper that a 64-bit division
 * calls. divisor >= 1. */
uint32_t pel_i_divide(uint64_t numerator, uint64_t divisor);

#endif
