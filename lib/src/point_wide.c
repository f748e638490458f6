#include "point_wide.h"

void pel_i_wide_set(uint32_t *wide, unsigned limbs, uint32_t value)
{
    for (unsigned i = 1; i < limbs; i++) {
        wide[i] = 0;
    }
    wide[0] = value;
}

/* Adds value * 2^(32 * place). */
static void add_at(uint32_t *wide, unsigned place, uint64_t value)
{
    while (value != 0) {
        const uint64_t sum = (uint64_t)wide[place] + (uint32_t)value;
        wide[place] = (uint32_t)sum;
        value = (value >> 32) + (sum >> 32);
        place++;
    }
}

/* In place, from the highest limb down: the products of a limb go to its own place and above, where
 * everything has been multiplied already. */
void pel_i_wide_multiply(uint32_t *wide, unsigned limbs, uint64_t factor)
{
    const uint32_t low = (uint32_t)factor;
    const uint32_t high = (uint32_t)(factor >> 32);

    for (unsigned i = limbs; i-- > 0;) {
        const uint64_t limb = wide[i];
        wide[i] = 0;
        add_at(wide, i, limb * low);
        add_at(wide, i + 1, limb * high);
    }
}

int pel_i_wide_not_over(const uint32_t *a, const uint32_t *b, unsigned limbs)
{
    unsigned i = limbs - 1;

    while (i > 0 && a[i] == b[i]) {
        i--;
    }
    return a[i] <= b[i];
}

uint32_t pel_i_divide(uint64_t numerator, uint64_t divisor)
{
    uint32_t quotient = 0;

    for (unsigned bit = 32; bit-- > 0;) {
        if ((numerator >> bit) >= divisor) {
            numerator -= divisor << bit;
            quotient |= (uint32_t)1 << bit;
        }
    }
    return quotient;
}
