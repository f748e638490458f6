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

INLINE __m128i load16(const uint8_t *bytes)
{
    return _mm_loadu_si128((const __m128i_u *)(const void *)bytes);
}

/* Constants that the compiler must load: it would else make them anew in every round of a loop. */
enum { OF_NIBBLE = 0, OF_LOW = 16, OF_HIGH = 32, OF_NONE = 48 };

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

INLINE vec high_nibbles(vec nibble, vec values)
{
    return BITS(and)(V(srli_epi16)(values, 4), nibble);
}

/* One of the nibble tables of a channel, see row_nibbles.h. */
INLINE vec table_of(const uint8_t *channel, unsigned which)
{
    return everywhere(load16(channel + which));
}

/* By the high nibble: the classes that may be, and are not if this table does not have them. */
INLINE vec rough_table(const uint8_t *channel)
{
    return table_of(channel, PEL_NIBBLES_ROUGH);
}

/* The class masks of values with these high nibbles, of which `rough` are left; `nibble` is 15
 * everywhere. */
INLINE vec masks_of(const uint8_t *channel, vec nibble, vec values, vec high, vec rough)
{
    const vec low = BITS(and)(values, nibble);
    const vec from = BITS(or)(V(shuffle_epi8)(table_of(channel, PEL_NIBBLES_ABOVE), high),
                              V(shuffle_epi8)(table_of(channel, PEL_NIBBLES_FROM), low));
    const vec to = BITS(or)(V(shuffle_epi8)(table_of(channel, PEL_NIBBLES_BELOW), high),
                            V(shuffle_epi8)(table_of(channel, PEL_NIBBLES_TO), low));
    return BITS(and)(rough, BITS(and)(from, to));
}

/* Labels less one: the place of the lowest bit, 255 for none; the smaller one of both nibbles'. */
INLINE vec places_of_lowest(const uint8_t *constant, vec nibble, vec masks)
{
    const vec of_low = everywhere(load16(constant + OF_LOW));
    const vec of_high = everywhere(load16(constant + OF_HIGH));
    const vec low = V(shuffle_epi8)(of_low, BITS(and)(masks, nibble));
    const vec high = V(shuffle_epi8)(of_high, high_nibbles(nibble, masks));
    return V(min_epu8)(low, high);
}

INLINE vec nowhere(const uint8_t *constant)
{
    return everywhere(load16(constant + OF_NONE));
}
