/*
 * The row kernels of two rows in the vectors of x86, whatever their width; the words mean what they
 * mean in row_filter_template.h.
 *
 * dst may be one of the sources, so what the last vector takes from them is computed before
 * anything is written.
 */

INLINE vec load(const uint8_t *bytes)
{
    return BITS(loadu)((const loose_vec *)(const void *)bytes);
}

INLINE void store(uint8_t *bytes, vec value)
{
    BITS(storeu)((loose_vec *)(void *)bytes, value);
}

/* The last vector may lie over the one before it. */
ISA void KERNEL(copy)(const uint8_t *src, uint16_t count, uint8_t *dst)
{
    const int end = count - LANES;

    for (int x = 0; x < end; x += LANES) {
        store(dst + x, load(src + x));
    }
    store(dst + end, load(src + end));
}

INLINE vec difference_of(vec a, vec b)
{
    return BITS(or)(V(subs_epu8)(a, b), V(subs_epu8)(b, a));
}

#define PAIRS(name, operation)                                                                     \
    ISA void KERNEL(name)(const uint8_t *a, const uint8_t *b, uint16_t count, uint8_t *dst)        \
    {                                                                                              \
        const int end = count - LANES;                                                             \
        const vec last = operation(load(a + end), load(b + end));                                  \
        for (int x = 0; x < end; x += LANES) {                                                     \
            store(dst + x, operation(load(a + x), load(b + x)));                                   \
        }                                                                                          \
        store(dst + end, last);                                                                    \
    }

PAIRS(add, V(adds_epu8))
PAIRS(subtract, V(subs_epu8))
PAIRS(absdiff, difference_of)
PAIRS(min, V(min_epu8))
PAIRS(max, V(max_epu8))
PAIRS(and, BITS(and))
PAIRS(or, BITS(or))
PAIRS(xor, BITS(xor))

/* At most 255 * 256 + 128: 16 bits without a sign. */
INLINE vec mixed(vec a, vec b, vec alpha, vec rest)
{
    const vec sum = V(add_epi16)(V(mullo_epi16)(a, alpha), V(mullo_epi16)(b, rest));
    return V(srli_epi16)(V(add_epi16)(sum, V(set1_epi16)(128)), 8);
}

INLINE vec blended(vec a, vec b, vec alpha, vec rest)
{
    const vec zero = BITS(setzero)();
    return V(packus_epi16)(
        mixed(V(unpacklo_epi8)(a, zero), V(unpacklo_epi8)(b, zero), alpha, rest),
        mixed(V(unpackhi_epi8)(a, zero), V(unpackhi_epi8)(b, zero), alpha, rest));
}

ISA void KERNEL(blend)(const uint8_t *a, const uint8_t *b, uint16_t alpha_q8, uint16_t count,
                       uint8_t *dst)
{
    const vec alpha = V(set1_epi16)((int16_t)alpha_q8);
    const vec rest = V(set1_epi16)((int16_t)(256 - alpha_q8));
    const int end = count - LANES;
    const vec last = blended(load(a + end), load(b + end), alpha, rest);

    for (int x = 0; x < end; x += LANES) {
        store(dst + x, blended(load(a + x), load(b + x), alpha, rest));
    }
    store(dst + end, last);
}
