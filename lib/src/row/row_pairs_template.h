/*
 * Pixels and their labels where a block of them is two vectors. The file that includes this one
 * says, beyond the words of row_classify_template.h,
 *     everywhere(bytes)        16 bytes in every 16 of a vector
 *     MOVED(last, here)        what lies a byte before `here` if `last` lies before it
 *     eights                   exchanges what lies second and third of four 8 bytes, if there are
 *                              as many: what unpacking does to every 16 bytes for themselves
 *     are_apart(a, b)          whether no bit is set in both
 *     equal_bytes(a, b)        a bit for each byte in which they are equal
 *
 * Neither U and V nor Y are ever put in the order of the picture: as long as a block has the same
 * order in all of them it is enough to do so with the labels.
 */

/* ---- Blocks of labels ---------------------------------------------------------------------- */

enum { BLOCK = 2 * LANES };

typedef struct block {
    vec left, right;
} block;

INLINE block load_block(const uint8_t *labels)
{
    const block b = {load(labels), load(labels + LANES)};
    return b;
}

INLINE vec last_of(block b)
{
    return b.right;
}

INLINE uint64_t both_sides(uint64_t left, uint64_t right)
{
    return left | right << LANES;
}

INLINE uint64_t equal_before(vec last, block b)
{
    return both_sides(equal_bytes(MOVED(last, b.left), b.left),
                      equal_bytes(MOVED(b.left, b.right), b.right));
}

INLINE uint64_t zeros_of(block b)
{
    const vec zero = V(set1_epi8)(0);
    return both_sides(equal_bytes(b.left, zero), equal_bytes(b.right, zero));
}

/* Places of lowest bits, as labels and where there is none. */
INLINE void store_places(uint8_t *labels, block places, vec none)
{
    store(labels, V(sub_epi8)(places.left, none));
    store(labels + LANES, V(sub_epi8)(places.right, none));
}

INLINE block no_places(vec none)
{
    const block b = {none, none};
    return b;
}

INLINE uint64_t nowhere_of(block places)
{
    return both_sides((uint32_t)V(movemask_epi8)(places.left),
                      (uint32_t)V(movemask_epi8)(places.right));
}

/* ---- Pixels -------------------------------------------------------------------------------- */

/* A row and its classes: what lies in memory, and what the loops hold in registers; there are not
 * enough of these for all tables. Packed 4:2:2 begins at `bytes`; in `order`, every 16 bytes become
 * 4 U, 4 V, 8 Y. `doubt`: by the high nibble of Y, the classes for which the low one decides. */
typedef struct row {
    const uint8_t *nibbles, *constants;
    const pel_row_pairs *src;
    const uint8_t *bytes;
    vec order, nibble, doubt;
} row;

INLINE row row_of(const uint8_t *nibbles, const pel_row_pairs *src)
{
    const uint8_t *const c = src->u < src->v ? src->u : src->v;
    const uint8_t *const constant = constants();
    const vec nibble = everywhere(load16(constant + OF_NIBBLE));
    const row r = {nibbles,
                   constant,
                   src,
                   src->y < c ? src->y : c,
                   nibble,
                   nibble,
                   BITS(andnot)(BITS(and)(table_of(nibbles, PEL_NIBBLES_ABOVE),
                                          table_of(nibbles, PEL_NIBBLES_BELOW)),
                                table_of(nibbles, PEL_NIBBLES_ROUGH))};
    return r;
}

INLINE row packed_row_of(const uint8_t *nibbles, const pel_row_pairs *src)
{
    static const uint8_t orders[4][16] = {{1, 5, 9, 13, 3, 7, 11, 15, 0, 2, 4, 6, 8, 10, 12, 14},
                                          {3, 7, 11, 15, 1, 5, 9, 13, 0, 2, 4, 6, 8, 10, 12, 14},
                                          {0, 4, 8, 12, 2, 6, 10, 14, 1, 3, 5, 7, 9, 11, 13, 15},
                                          {2, 6, 10, 14, 0, 4, 8, 12, 1, 3, 5, 7, 9, 11, 13, 15}};
    row r = row_of(nibbles, src);
    const unsigned y_second = r.bytes < src->y, v_first = src->v < src->u;

    r.order = everywhere(load16(orders[2 * y_second + v_first]));
    return r;
}

/* The first and the second half of a block's Y, and what they are made of where bytes are packed;
 * its U and its V, of which the first 8 of every 16 belong to the first half. */
typedef struct pixels {
    vec first, second, others[2], u, v;
} pixels;

INLINE pixels packed_pixels(const row *r, size_t x)
{
    const uint8_t *const bytes = r->bytes + 2 * x;
    const vec a = V(shuffle_epi8)(load(bytes), r->order);
    const vec b = V(shuffle_epi8)(load(bytes + LANES), r->order);
    const vec c = V(shuffle_epi8)(load(bytes + 2 * LANES), r->order);
    const vec d = V(shuffle_epi8)(load(bytes + 3 * LANES), r->order);
    const vec ab = V(unpacklo_epi32)(a, b), cd = V(unpacklo_epi32)(c, d);
    const pixels p = {a, c, {b, d}, V(unpacklo_epi64)(ab, cd), V(unpackhi_epi64)(ab, cd)};
    return p;
}

INLINE pixels planar_pixels(const row *r, size_t x)
{
    const pel_row_pairs *const src = r->src;
    const vec first = load(src->y + x), second = load(src->y + x + LANES);
    pixels p = {first, second, {first, second}, first, second};

    if (src->c_step == 1) {
        p.u = eights(load(src->u + x / 2));
        p.v = eights(load(src->v + x / 2));
    } else if (src->c_step == 2) {
        const int v_first = src->v < src->u;
        const __m128i pairs = _mm_setr_epi8(0, 2, 4, 6, 8, 10, 12, 14, 1, 3, 5, 7, 9, 11, 13, 15);
        const vec order = everywhere(_mm_xor_si128(pairs, _mm_set1_epi8((char)(v_first ? 1 : 0))));
        const uint8_t *const bytes = (v_first ? src->v : src->u) + x;
        const vec a = V(shuffle_epi8)(load(bytes), order);
        const vec b = V(shuffle_epi8)(load(bytes + LANES), order);
        p.u = V(unpacklo_epi64)(a, b);
        p.v = V(unpackhi_epi64)(a, b);
    } else { /* gray */
        p.u = V(set1_epi8)((char)*src->u);
        p.v = V(set1_epi8)((char)*src->v);
    }
    return p;
}

/* Half a block on its way to labels: Y, its high nibbles, and the classes of its chroma that these
 * leave. */
typedef struct half {
    vec luma, high, rough;
} half;

INLINE half half_of(const row *r, vec luma, vec chroma)
{
    const vec high = high_nibbles(r->nibble, luma);
    const half h = {luma, high, BITS(and)(V(shuffle_epi8)(rough_table(r->nibbles), high), chroma)};
    return h;
}

/* The classes for which the low nibbles of Y decide. */
INLINE vec doubts_of(const row *r, half h)
{
    return BITS(and)(V(shuffle_epi8)(r->doubt, h.high), h.rough);
}

INLINE vec masks_of_half(const row *r, half h)
{
    return masks_of(r->nibbles, r->nibble, h.luma, h.high, h.rough);
}

INLINE vec places_of_half(const row *r, int is_packed, vec masks)
{
    const vec places = places_of_lowest(r->constants, r->nibble, masks);
    return is_packed ? eights(places) : places;
}

/* The labels of a block of pixels, less one; 0 if none of them is in a class by its chroma alone,
 * as most are: then `places` are not written. */
INLINE int places_at(const row *r, int is_packed, size_t x, block *places)
{
    const uint8_t *const of_u = r->nibbles + PEL_NIBBLES_CHANNEL;
    const uint8_t *const of_v = of_u + PEL_NIBBLES_CHANNEL;
    const pixels p = is_packed ? packed_pixels(r, x) : planar_pixels(r, x);
    const vec high_u = high_nibbles(r->nibble, p.u), high_v = high_nibbles(r->nibble, p.v);
    vec u = V(shuffle_epi8)(rough_table(of_u), high_u);
    vec v = V(shuffle_epi8)(rough_table(of_v), high_v);
    half left, right;
    vec doubts;

    if (are_apart(u, v)) {
        return 0;
    }
    u = masks_of(of_u, r->nibble, p.u, high_u, u);
    v = masks_of(of_v, r->nibble, p.v, high_v, v);
    if (are_apart(u, v)) {
        return 0;
    }
    u = BITS(and)(u, v);
    left = half_of(r, is_packed ? V(unpackhi_epi64)(p.first, p.others[0]) : p.first,
                   V(unpacklo_epi8)(u, u));
    right = half_of(r, is_packed ? V(unpackhi_epi64)(p.second, p.others[1]) : p.second,
                    V(unpackhi_epi8)(u, u));
    doubts = BITS(or)(doubts_of(r, left), doubts_of(r, right));
    if (!are_apart(doubts, doubts)) {
        left.rough = masks_of_half(r, left);
        right.rough = masks_of_half(r, right);
    }
    places->left = places_of_half(r, is_packed, left.rough);
    places->right = places_of_half(r, is_packed, right.rough);
    return 1;
}
