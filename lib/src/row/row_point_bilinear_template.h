/*
 * Bilinear means of gray in vectors of 16 bytes. Eight results lie between pixels of sixteen
 * neighbours as long as a picture shrinks to half at most: one shuffle of a row brings the
 * neighbours of all eight together. Beside the words of row_point_area_template.h:
 *
 *   shuffled(v, i)   v[i[k]] for every byte k; all i[k] < 16
 */

/* A product of less than 2^32 of 32 bits and 11 bits; `factor` has them twice. */
INLINE vec product_u32(vec v, vec factor)
{
    const vec carry = V(mulhi_epu16)(v, factor); /* its upper halves are 0: v < 2^19 */
    return V(add_epi32)(V(mullo_epi16)(v, factor), V(slli_epi32)(carry, 16));
}

/* 2048 - weight and weight of four places. */
INLINE vec both_weights(vec places)
{
    const vec low = V(set1_epi32)(0xFFFF);
    const vec left = V(sub_epi32)(V(set1_epi32)(2048), V(srli_epi32)(places, 16));
    return BITS(or)(left, BITS(andnot)(low, places));
}

/* From `base` on: the left neighbours of eight results, each followed by the right one. */
INLINE vec neighbours_of(vec first, vec second, int base)
{
    const vec low = V(set1_epi32)(0xFFFF);
    const vec x = V(packs_epi32)(BITS(and)(first, low), BITS(and)(second, low));
    const vec left = V(sub_epi16)(x, V(set1_epi16)((int16_t)base));
    const vec both = V(add_epi16)(BITS(or)(left, V(slli_epi16)(left, 8)), V(set1_epi16)(0x100));
    return V(min_epu8)(both, V(set1_epi8)(15)); /* the last column is its own right neighbour */
}

/* 2048 times the points between four pairs of pixels in 16 bits, in two rows, between which the
 * result lies. */
INLINE vec four_means(vec upper, vec lower, vec weights, const vec across[2])
{
    const vec above = product_u32(V(madd_epi16)(upper, weights), across[0]);
    const vec below = product_u32(V(madd_epi16)(lower, weights), across[1]);
    const vec half = V(set1_epi32)((int32_t)1 << 21);
    return V(srli_epi32)(V(add_epi32)(V(add_epi32)(above, below), half), 22);
}

/* Eight results; their neighbours are in the 16 pixels from `base` on. */
INLINE void eight_means(const pel_row_between *rows, const pel_row_place *places, int base,
                        uint8_t *dst)
{
    const vec across[2] = {V(set1_epi16)((int16_t)(2048 - rows->weight)),
                           V(set1_epi16)((int16_t)rows->weight)};
    const vec first = load((const uint8_t *)places), second = load((const uint8_t *)(places + 4));
    const vec pairs = neighbours_of(first, second, base);
    const halves upper = widened(shuffled(load(rows->upper + base), pairs));
    const halves lower = widened(shuffled(load(rows->lower + base), pairs));
    const vec low = four_means(upper.low, lower.low, both_weights(first), across);
    const vec high = four_means(upper.high, lower.high, both_weights(second), across);
    const vec words = V(packs_epi32)(low, high);
    store_half(dst, V(packus_epi16)(words, words));
}
