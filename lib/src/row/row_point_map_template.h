/*
 * Tables of 256 entries and gains in vectors of 16 or 32 bytes. Beside the words of
 * row_point_template.h:
 *
 *   is_zero(v)  whether all of it is 0
 *   ordered(v)  such that unpacking it with another one so ordered gives first the lower and then
 *               the upper halves of both; undone by itself
 */

/* ---- Tables that are a step ---------------------------------------------------------------- */

/* high where v is over last_low; xor `difference` elsewhere. */
INLINE vec stepped(vec v, vec last_low, vec difference, vec high)
{
    const vec not_over = V(cmpeq_epi8)(V(subs_epu8)(v, last_low), BITS(setzero)());
    return BITS(xor)(high, BITS(and)(not_over, difference));
}

/* Looks for the step by halves, as if there were one, then at every entry. */
ISA int KERNEL(find_step)(const uint8_t *table, uint8_t *last_low)
{
    static const uint8_t from_0[32] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10,
                                       11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21,
                                       22, 23, 24, 25, 26, 27, 28, 29, 30, 31};
    const uint8_t low = table[0];
    const vec high = V(set1_epi8)((char)table[255]);
    const vec difference = BITS(xor)(high, V(set1_epi8)((char)low));
    vec wrong = BITS(setzero)(), at = load(from_0), last;
    unsigned found = 0;

    if (table[128] != low && table[128] != table[255]) {
        return 0;
    }
    for (unsigned half = 128; half > 0; half /= 2) {
        found += table[found + half] == low ? half : 0;
    }
    last = V(set1_epi8)((char)found);
    for (unsigned i = 0; i < 256; i += LANES) {
        const vec wanted = stepped(at, last, difference, high);
        wrong = BITS(or)(wrong, BITS(xor)(wanted, load(table + i)));
        at = V(add_epi8)(at, V(set1_epi8)(LANES));
    }
    *last_low = (uint8_t)found;
    return is_zero(wrong);
}

ISA void KERNEL(step)(const pel_row_curve *curve, const uint8_t *src, uint16_t count, uint8_t *dst)
{
    const vec last_low = V(set1_epi8)((char)curve->last_low);
    const vec high = V(set1_epi8)((char)curve->table[255]);
    const vec difference = BITS(xor)(high, V(set1_epi8)((char)curve->table[0]));
    const int end = count - LANES;
    const vec last = stepped(load(src + end), last_low, difference, high);

    for (int x = 0; x < end; x += LANES) {
        store(dst + x, stepped(load(src + x), last_low, difference, high));
    }
    store(dst + end, last);
}

/* ---- White balance ------------------------------------------------------------------------- */

/* round(v * gain / 256), at most 255, for v << 8 in 16 bits: the upper half of the product is
 * v * gain / 256 cut off, and the highest bit of its lower half says how to round. */
INLINE vec gained(vec v_q8, vec gain)
{
    const vec round = V(srli_epi16)(V(mullo_epi16)(v_q8, gain), 15);
    const vec value = V(add_epi16)(V(mulhi_epu16)(v_q8, gain), round);
    return V(sub_epi16)(value, V(subs_epu16)(value, V(set1_epi16)(255)));
}

/* `low` and `high` are the gains of the lower and the upper half. */
INLINE vec balanced(vec bytes, vec low, vec high)
{
    const vec zero = BITS(setzero)();
    const vec v = ordered(bytes);
    return ordered(V(packus_epi16)(gained(V(unpacklo_epi8)(zero, v), low),
                                   gained(V(unpackhi_epi8)(zero, v), high)));
}

/* Gains repeat after three vectors, and 16 bits of a vector begin with one of three. */
ISA void KERNEL(gain3)(const uint8_t *src, uint16_t count, const uint16_t gains_q8[3], uint8_t *dst)
{
    enum { WORDS = LANES / 2 };
    uint16_t gains[WORDS + 2];
    vec from[3];
    uint16_t x = 0;

    for (unsigned i = 0; i < WORDS + 2; i++) {
        gains[i] = gains_q8[i % 3];
    }
    for (unsigned i = 0; i < 3; i++) {
        from[i] = load((const uint8_t *)(gains + i * WORDS % 3));
    }
    for (; x + LANES <= count; x += LANES) {
        const vec first = load(src), second = load(src + LANES), third = load(src + 2 * LANES);
        store(dst, balanced(first, from[0], from[1]));
        store(dst + LANES, balanced(second, from[2], from[0]));
        store(dst + 2 * LANES, balanced(third, from[1], from[2]));
        src += 3 * LANES;
        dst += 3 * LANES;
    }
    pel_row_gain3(src, (uint16_t)(count - x), gains_q8, dst);
}
