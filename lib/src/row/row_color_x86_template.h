/*
 * Colours in the vectors of x86, whatever their width: the words of row_color_template.h. Besides
 * those of row_classify_template.h, the file that includes this one says what these mean:
 *     at_steps(bytes, step)    16 bytes in every 16 of a vector, from places `step` apart
 *     eight_at(bytes)          8 bytes in the lower half of every 16, from places 8 apart
 *
 * All of it works on every 16 bytes of a vector for themselves: 16 pixels lie side by side there.
 */
#include "row/row_nibbles_template.h"

typedef struct three {
    vec a, b, c;
} three;

INLINE vec shuffled(vec bytes, const uint8_t *order)
{
    return V(shuffle_epi8)(bytes, everywhere(load16(order)));
}

INLINE vec joined(three t, const uint8_t orders[3][16])
{
    return BITS(or)(BITS(or)(shuffled(t.a, orders[0]), shuffled(t.b, orders[1])),
                    shuffled(t.c, orders[2]));
}

/* ---- Three channels by turns --------------------------------------------------------------- */

enum { NO = 0x80 }; /* a byte of 0 */

/* For each channel what it takes from the three pieces of 16 bytes. */
static const uint8_t apart_orders[3][3][16] = {
    {{0, 3, 6, 9, 12, 15, NO, NO, NO, NO, NO, NO, NO, NO, NO, NO},
     {NO, NO, NO, NO, NO, NO, 2, 5, 8, 11, 14, NO, NO, NO, NO, NO},
     {NO, NO, NO, NO, NO, NO, NO, NO, NO, NO, NO, 1, 4, 7, 10, 13}},
    {{1, 4, 7, 10, 13, NO, NO, NO, NO, NO, NO, NO, NO, NO, NO, NO},
     {NO, NO, NO, NO, NO, 0, 3, 6, 9, 12, 15, NO, NO, NO, NO, NO},
     {NO, NO, NO, NO, NO, NO, NO, NO, NO, NO, NO, 2, 5, 8, 11, 14}},
    {{2, 5, 8, 11, 14, NO, NO, NO, NO, NO, NO, NO, NO, NO, NO, NO},
     {NO, NO, NO, NO, NO, 1, 4, 7, 10, 13, NO, NO, NO, NO, NO, NO},
     {NO, NO, NO, NO, NO, NO, NO, NO, NO, NO, 0, 3, 6, 9, 12, 15}}};

/* For each piece what it takes from the three channels. */
static const uint8_t turn_orders[3][3][16] = {
    {{0, NO, NO, 1, NO, NO, 2, NO, NO, 3, NO, NO, 4, NO, NO, 5},
     {NO, 0, NO, NO, 1, NO, NO, 2, NO, NO, 3, NO, NO, 4, NO, NO},
     {NO, NO, 0, NO, NO, 1, NO, NO, 2, NO, NO, 3, NO, NO, 4, NO}},
    {{NO, NO, 6, NO, NO, 7, NO, NO, 8, NO, NO, 9, NO, NO, 10, NO},
     {5, NO, NO, 6, NO, NO, 7, NO, NO, 8, NO, NO, 9, NO, NO, 10},
     {NO, 5, NO, NO, 6, NO, NO, 7, NO, NO, 8, NO, NO, 9, NO, NO}},
    {{NO, 11, NO, NO, 12, NO, NO, 13, NO, NO, 14, NO, NO, 15, NO, NO},
     {NO, NO, 11, NO, NO, 12, NO, NO, 13, NO, NO, 14, NO, NO, 15, NO},
     {10, NO, NO, 11, NO, NO, 12, NO, NO, 13, NO, NO, 14, NO, NO, 15}}};

INLINE three load3(const uint8_t *bytes)
{
    const three pieces = {at_steps(bytes, 48), at_steps(bytes + 16, 48), at_steps(bytes + 32, 48)};
    const three t = {joined(pieces, apart_orders[0]), joined(pieces, apart_orders[1]),
                     joined(pieces, apart_orders[2])};
    return t;
}

INLINE void store3(uint8_t *bytes, three t)
{
    put_steps(bytes, 48, joined(t, turn_orders[0]));
    put_steps(bytes + 16, 48, joined(t, turn_orders[1]));
    put_steps(bytes + 32, 48, joined(t, turn_orders[2]));
}

/* ---- Conversions --------------------------------------------------------------------------- */

/* Bytes in pairs, each pair times two coefficients, added up. */
INLINE vec weighted(vec bytes, int first, int second)
{
    return V(maddubs_epi16)(bytes, V(set1_epi16)((int16_t)((first & 0xFF) | second * 256)));
}

/* Full range, of 8 pixels in every 16 bytes: R and B by turns with G; see row_color.h. */
INLINE three ycbcr_words(vec r_g, vec b_g)
{
    const vec middle = V(set1_epi16)(257);
    const vec d = weighted(r_g, -1, 1), f = weighted(b_g, -1, 1);
    const vec by_d = V(mulhi_epi16)(d, V(set1_epi16)(PEL_ROW_BY_886));
    const vec by_f = V(mulhi_epi16)(f, V(set1_epi16)(PEL_ROW_BY_701));
    const vec rest = V(add_epi16)(weighted(r_g, 3, 3), weighted(b_g, 2, 0));
    const vec eighth = V(srli_epi16)(V(add_epi16)(rest, V(set1_epi16)(500)), 3);
    const vec whole = V(add_epi16)(weighted(r_g, 37, 73), weighted(b_g, 14, 0));
    const vec by_125 = V(set1_epi16)((int16_t)(PEL_ROW_BY_125 - 65536));
    const vec y = V(mulhi_epu16)(V(add_epi16)(whole, eighth), by_125);
    const three t = {V(srli_epi16)(y, 6),
                     V(srli_epi16)(V(add_epi16)(V(sub_epi16)(middle, f), by_d), 1),
                     V(srli_epi16)(V(add_epi16)(V(sub_epi16)(middle, d), by_f), 1)};
    return t;
}

INLINE three full_ycbcr(three rgb)
{
    const three low = ycbcr_words(V(unpacklo_epi8)(rgb.a, rgb.b), V(unpacklo_epi8)(rgb.c, rgb.b));
    const three high = ycbcr_words(V(unpackhi_epi8)(rgb.a, rgb.b), V(unpackhi_epi8)(rgb.c, rgb.b));
    const three t = {V(packus_epi16)(low.a, high.a), V(packus_epi16)(low.b, high.b),
                     V(packus_epi16)(low.c, high.c)};
    return t;
}

/* A channel of 8 pixels less 128, times 256 and times 3. */
typedef struct factors {
    vec by_256, by_3;
} factors;

INLINE factors factors_of(vec by_256)
{
    const factors f = {by_256, V(mulhi_epi16)(by_256, V(set1_epi16)(3 * 256))};
    return f;
}

/* What channel j gives to form i of 4 pixels, whose factors are `pairs`. */
INLINE vec plus_term(vec sum, vec pairs, const pel_row_form *form, unsigned i, unsigned j)
{
    const uint32_t high = (uint16_t)form->term[i][j][0], low = (uint16_t)form->term[i][j][1];
    if (high == 0 && low == 0) {
        return sum;
    }
    return V(add_epi32)(sum, V(madd_epi16)(pairs, V(set1_epi32)((int32_t)(high | low << 16))));
}

INLINE vec form_of(three pairs, const pel_row_form *form, unsigned i, vec *clear)
{
    vec sum = plus_term(V(set1_epi32)(form->offset[i]), pairs.a, form, i, 0);
    sum = plus_term(sum, pairs.b, form, i, 1);
    sum = plus_term(sum, pairs.c, form, i, 2);
    if (!form->is_exact[i]) {
        *clear = BITS(or)(*clear, clear_in(sum, V(set1_epi32)(PEL_ROW_FORM_DOUBT)));
    }
    return V(srai_epi32)(sum, PEL_ROW_FORM_BITS);
}

/* The forms of 8 pixels in every 16 bytes, less 128. */
INLINE three words_formed(factors a, factors b, factors c, const pel_row_form *form, vec *clear)
{
    const three low = {V(unpacklo_epi16)(a.by_256, a.by_3), V(unpacklo_epi16)(b.by_256, b.by_3),
                       V(unpacklo_epi16)(c.by_256, c.by_3)};
    const three high = {V(unpackhi_epi16)(a.by_256, a.by_3), V(unpackhi_epi16)(b.by_256, b.by_3),
                        V(unpackhi_epi16)(c.by_256, c.by_3)};
    const three t = {V(packs_epi32)(form_of(low, form, 0, clear), form_of(high, form, 0, clear)),
                     V(packs_epi32)(form_of(low, form, 1, clear), form_of(high, form, 1, clear)),
                     V(packs_epi32)(form_of(low, form, 2, clear), form_of(high, form, 2, clear))};
    return t;
}

INLINE three formed(three channels, const pel_row_form *form, int *doubt)
{
    const vec zero = BITS(setzero)(), half = V(set1_epi8)((char)-128);
    const vec a = BITS(xor)(channels.a, half), b = BITS(xor)(channels.b, half);
    const vec c = BITS(xor)(channels.c, half);
    vec clear = zero;
    const three low =
        words_formed(factors_of(V(unpacklo_epi8)(zero, a)), factors_of(V(unpacklo_epi8)(zero, b)),
                     factors_of(V(unpacklo_epi8)(zero, c)), form, &clear);
    const three high =
        words_formed(factors_of(V(unpackhi_epi8)(zero, a)), factors_of(V(unpackhi_epi8)(zero, b)),
                     factors_of(V(unpackhi_epi8)(zero, c)), form, &clear);
    const three t = {BITS(xor)(V(packs_epi16)(low.a, high.a), half),
                     BITS(xor)(V(packs_epi16)(low.b, high.b), half),
                     BITS(xor)(V(packs_epi16)(low.c, high.c), half)};
    *doubt = !is_zero(clear);
    return t;
}

/* ---- Pixels of 16 bits, mosaics, pairs ----------------------------------------------------- */

/* 16 pixels of two bytes in every 16 bytes of two vectors. */
typedef struct two {
    vec a, b;
} two;

INLINE two words_at(const uint8_t *bytes)
{
    const two t = {at_steps(bytes, 32), at_steps(bytes + 16, 32)};
    return t;
}

INLINE vec even_bytes(two t)
{
    const vec low = V(set1_epi16)(255);
    return V(packus_epi16)(BITS(and)(t.a, low), BITS(and)(t.b, low));
}

INLINE vec odd_bytes(two t)
{
    return V(packus_epi16)(V(srli_epi16)(t.a, 8), V(srli_epi16)(t.b, 8));
}

INLINE three rgb565_at(const uint8_t *bytes, unsigned low)
{
    const two t = words_at(bytes);
    const vec first = even_bytes(t), second = odd_bytes(t);
    const vec upper = low ? first : second, lower = low ? second : first;
    const vec top5 = V(set1_epi8)((char)-8), top6 = V(set1_epi8)((char)-4);
    const vec low2 = V(set1_epi8)(3), low3 = V(set1_epi8)(7), high3 = V(set1_epi8)((char)-32);
    const vec r = BITS(and)(upper, top5);
    const vec g_high = BITS(and)(V(slli_epi16)(upper, 5), high3);
    const vec g_low = BITS(andnot)(high3, V(srli_epi16)(lower, 3));
    const vec g = BITS(and)(BITS(or)(g_high, g_low), top6);
    const vec b = BITS(and)(V(slli_epi16)(lower, 3), top5);
    const three rgb = {BITS(or)(r, BITS(and)(V(srli_epi16)(r, 5), low3)),
                       BITS(or)(g, BITS(and)(V(srli_epi16)(g, 6), low2)),
                       BITS(or)(b, BITS(and)(V(srli_epi16)(b, 5), low3))};
    return rgb;
}

INLINE three bayer_at(const uint8_t *even, const uint8_t *odd, unsigned red)
{
    const two over = words_at(red & 2 ? odd : even), under = words_at(red & 2 ? even : odd);
    const vec o0 = even_bytes(over), o1 = odd_bytes(over);
    const vec u0 = even_bytes(under), u1 = odd_bytes(under);
    const three swapped = {o1, V(avg_epu8)(o0, u1), u0}, t = {o0, V(avg_epu8)(o1, u0), u1};
    return red & 1 ? swapped : t;
}

/* U V U V or V U V U: each of the first and of the second kind twice. */
INLINE three with_chroma(vec y, vec u_v, int v_first)
{
    static const uint8_t orders[2][16] = {{0, 0, 2, 2, 4, 4, 6, 6, 8, 8, 10, 10, 12, 12, 14, 14},
                                          {1, 1, 3, 3, 5, 5, 7, 7, 9, 9, 11, 11, 13, 13, 15, 15}};
    const three t = {y, shuffled(u_v, orders[v_first]), shuffled(u_v, orders[1 - v_first])};
    return t;
}

INLINE three pairs_at(const pel_row_pairs *src, size_t x)
{
    const int v_first = src->v < src->u;
    const uint8_t *const c = v_first ? src->v : src->u;

    if (src->y_step == 2) {
        const int y_first = src->y < c;
        const two t = words_at((y_first ? src->y : c) + 2 * x);
        const vec even = even_bytes(t), odd = odd_bytes(t);
        return with_chroma(y_first ? even : odd, y_first ? odd : even, v_first);
    }
    if (src->c_step == 2) {
        return with_chroma(load(src->y + x), load(c + x), v_first);
    }
    if (src->c_step == 1) {
        const vec u = eight_at(src->u + x / 2), v = eight_at(src->v + x / 2);
        const three t = {load(src->y + x), V(unpacklo_epi8)(u, u), V(unpacklo_epi8)(v, v)};
        return t;
    }
    const three gray = {load(src->y + x), V(set1_epi8)((char)*src->u), V(set1_epi8)((char)*src->v)};
    return gray;
}

/* ---- Classes ------------------------------------------------------------------------------- */

INLINE vec both(vec a, vec b)
{
    return BITS(and)(a, b);
}

/* The nibble tables of a channel. */
typedef struct tables {
    const uint8_t *channel;
    vec rough;
} tables;

INLINE tables tables_of(const uint8_t *channel)
{
    const tables t = {channel, rough_table(channel)};
    return t;
}

INLINE vec class_masks(const tables *t, vec values)
{
    const vec nibble = V(set1_epi8)(15), high = high_nibbles(nibble, values);
    return masks_of(t->channel, nibble, values, high, V(shuffle_epi8)(t->rough, high));
}

INLINE vec labels_of_masks(vec masks)
{
    const uint8_t *const constant = constants();
    return V(sub_epi8)(places_of_lowest(constant, V(set1_epi8)(15), masks), nowhere(constant));
}
