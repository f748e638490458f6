/*
 * Box classes in the vectors of x86, whatever their width: see row_classify_template.h.
 */

INLINE vec load(const uint8_t *bytes)
{
    return BITS(loadu)((const loose_vec *)(const void *)bytes);
}

INLINE void store(uint8_t *bytes, vec value)
{
    BITS(storeu)((loose_vec *)(void *)bytes, value);
}

/* ---- Box classes --------------------------------------------------------------------------- */

/* The nibble tables of a channel; see row_nibbles.h. */
typedef struct tables {
    vec above, first, below, from, to;
} tables;

INLINE __m128i load16(const uint8_t *bytes)
{
    return _mm_loadu_si128((const __m128i_u *)(const void *)bytes);
}

INLINE tables tables_of(const uint8_t *nibbles)
{
    const tables t = {everywhere(load16(nibbles + PEL_NIBBLES_ABOVE)),
                      everywhere(load16(nibbles + PEL_NIBBLES_FIRST)),
                      everywhere(load16(nibbles + PEL_NIBBLES_BELOW)),
                      everywhere(load16(nibbles + PEL_NIBBLES_FROM)),
                      everywhere(load16(nibbles + PEL_NIBBLES_TO))};
    return t;
}

/* The class masks of a vector of values; `nibble` is 15 everywhere. */
INLINE vec masks_of(const tables *t, vec nibble, vec values)
{
    const vec low = BITS(and)(values, nibble);
    const vec high = BITS(and)(V(srli_epi16)(values, 4), nibble);
    const vec from = BITS(and)(V(shuffle_epi8)(t->first, high), V(shuffle_epi8)(t->from, low));
    const vec to = BITS(or)(V(shuffle_epi8)(t->below, high), V(shuffle_epi8)(t->to, low));
    return BITS(and)(BITS(or)(V(shuffle_epi8)(t->above, high), from), to);
}

/* Constants that the compiler must load: it would else make them anew in every round of a loop. */
enum { OF_NIBBLE = 0, OF_LOW = 16, OF_HIGH = 32, OF_ONES = 48 };

INLINE const uint8_t *constants(void)
{
    static const uint8_t bytes[64] = {
        15,  15,  15,  15,  15,  15,  15,  15,  15,  15,  15,  15,  15,  15,  15,  15, /* nibble */
        255, 0,   1,   0,   2,   0,   1,   0,   3,   0,   1,   0,   2,   0,   1,   0,  /* low */
        255, 4,   5,   4,   6,   4,   5,   4,   7,   4,   5,   4,   6,   4,   5,   4,  /* high */
        255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255};
    const uint8_t *hidden = bytes;
    __asm__("" : "+r"(hidden));
    return hidden;
}

/* 1 + the place of the lowest bit, 0 for none: of either nibble one less (255 for none), the
 * smaller of both, plus one. */
INLINE vec labels_of(const uint8_t *constant, vec nibble, vec masks)
{
    const vec of_low = everywhere(load16(constant + OF_LOW));
    const vec of_high = everywhere(load16(constant + OF_HIGH));
    const vec low = V(shuffle_epi8)(of_low, BITS(and)(masks, nibble));
    const vec high = V(shuffle_epi8)(of_high, BITS(and)(V(srli_epi16)(masks, 4), nibble));
    return V(sub_epi8)(V(min_epu8)(low, high), everywhere(load16(constant + OF_ONES)));
}

/* Masks of chroma, by U and by V. */
typedef struct chroma {
    vec u, v;
} chroma;
