/*
 * Classification and the search for runs in the vectors of x86, whatever their width. The file that
 * includes this one says what the words mean:
 *     vec, LANES               a vector and its bytes
 *     V(op), BITS(op)          the intrinsic functions of its width
 *     everywhere(bytes)        16 bytes in every 16 of a vector
 *     MOVED(last, here, n)     what lies n bytes before `here` if `last` lies before it
 *     from_packed, to_doubled  see there; the order of bytes that packing two vectors leaves
 *     is_zero, both_same       whether a vector is 0; whether a pair equals another pair
 *     WORD, edge_bits          the edges of runs among so many pixels as bits
 *     lowest_place, bit_count  of 64 bits; of none, any place will do
 *     ISA, INLINE, KERNEL      for what a function is compiled, what it is called
 *
 * A block is two vectors of pixels, because these share one vector of U and one of V. The last
 * block of a row ends where the row ends and so overlaps the one before it: its pixels are
 * classified twice, and their runs found once. An odd last pixel is left over.
 */

enum { BLOCK = 2 * LANES };

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

typedef struct channels {
    tables y, first_c, second_c; /* of U and V the one that lies first in memory, then the other */
} channels;

INLINE vec table_at(const uint8_t *bytes)
{
    return everywhere(_mm_loadu_si128((const __m128i_u *)(const void *)bytes));
}

INLINE tables tables_of(const uint8_t *nibbles)
{
    const tables t = {table_at(nibbles + PEL_NIBBLES_ABOVE), table_at(nibbles + PEL_NIBBLES_FIRST),
                      table_at(nibbles + PEL_NIBBLES_BELOW), table_at(nibbles + PEL_NIBBLES_FROM),
                      table_at(nibbles + PEL_NIBBLES_TO)};
    return t;
}

INLINE channels channels_of(const uint8_t *nibbles, int v_first)
{
    const tables u = tables_of(nibbles + PEL_NIBBLES_CHANNEL);
    const tables v = tables_of(nibbles + 2 * PEL_NIBBLES_CHANNEL);
    const channels c = {tables_of(nibbles), v_first ? v : u, v_first ? u : v};
    return c;
}

/* The class masks of a vector of values. */
INLINE vec masks_of(const tables *t, vec values)
{
    const vec nibble = V(set1_epi8)(15);
    const vec low = BITS(and)(values, nibble);
    const vec high = BITS(and)(V(srli_epi16)(values, 4), nibble);
    const vec from = BITS(and)(V(shuffle_epi8)(t->first, high), V(shuffle_epi8)(t->from, low));
    const vec to = BITS(or)(V(shuffle_epi8)(t->below, high), V(shuffle_epi8)(t->to, low));
    return BITS(and)(BITS(or)(V(shuffle_epi8)(t->above, high), from), to);
}

/* 1 + the place of the lowest bit, 0 for none: of either nibble one less (255 for none), the
 * smaller of both, plus one. */
INLINE vec labels_of(vec masks)
{
    const vec nibble = V(set1_epi8)(15);
    const vec of_low = everywhere(_mm_setr_epi8(-1, 0, 1, 0, 2, 0, 1, 0, 3, 0, 1, 0, 2, 0, 1, 0));
    const vec of_high = everywhere(_mm_setr_epi8(-1, 4, 5, 4, 6, 4, 5, 4, 7, 4, 5, 4, 6, 4, 5, 4));
    const vec low = V(shuffle_epi8)(of_low, BITS(and)(masks, nibble));
    const vec high = V(shuffle_epi8)(of_high, BITS(and)(V(srli_epi16)(masks, 4), nibble));
    return V(sub_epi8)(V(min_epu8)(low, high), V(set1_epi8)(-1));
}

/* The even or the odd bytes of two vectors, those of every 16 side by side. */
INLINE vec even_bytes(vec a, vec b)
{
    const vec byte = V(set1_epi16)(255);
    return V(packus_epi16)(BITS(and)(a, byte), BITS(and)(b, byte));
}

INLINE vec odd_bytes(vec a, vec b)
{
    return V(packus_epi16)(V(srli_epi16)(a, 8), V(srli_epi16)(b, 8));
}

/* The masks of U and V together, from vectors in which they alternate. */
INLINE vec chroma_masks(const channels *c, vec a, vec b)
{
    return BITS(and)(masks_of(&c->first_c, even_bytes(a, b)),
                     masks_of(&c->second_c, odd_bytes(a, b)));
}

/* ---- Blocks -------------------------------------------------------------------------------- */

typedef enum layout { LUMA_EVEN, LUMA_ODD, PLANAR } layout;

/* A row: `luma` is its first byte where it is packed, else its Y. */
typedef struct pixels {
    const uint8_t *luma, *first_c, *second_c;
    size_t c_step;
} pixels;

/* Labels of the pixels of a block. */
typedef struct block {
    vec left, right;
} block;

/* Packed 4:2:2; 0 if the block is background by its chroma alone, most often. */
INLINE int packed_block(const channels *c, const uint8_t *src, layout order, block *labels)
{
    const vec p = load(src), q = load(src + LANES);
    const vec r = load(src + 2 * LANES), s = load(src + 3 * LANES);
    const int odd = order == LUMA_ODD;
    const vec chroma = chroma_masks(c, odd ? even_bytes(p, q) : odd_bytes(p, q),
                                    odd ? even_bytes(r, s) : odd_bytes(r, s));
    if (is_zero(chroma)) {
        return 0;
    }
    labels->left = masks_of(&c->y, odd ? odd_bytes(p, q) : even_bytes(p, q));
    labels->right = masks_of(&c->y, odd ? odd_bytes(r, s) : even_bytes(r, s));
    labels->left = BITS(and)(labels->left, V(unpacklo_epi8)(chroma, chroma));
    labels->right = BITS(and)(labels->right, V(unpackhi_epi8)(chroma, chroma));
    labels->left = from_packed(labels_of(labels->left));
    labels->right = from_packed(labels_of(labels->right));
    return 1;
}

/* The chroma masks of a block so that unpacking them gives each pixel its own. */
INLINE vec planar_chroma(const channels *c, const pixels *src, size_t pair)
{
    if (src->c_step == 2) {
        const uint8_t *const both = src->first_c + 2 * pair;
        return chroma_masks(c, load(both), load(both + LANES));
    }
    if (src->c_step == 1) {
        return to_doubled(BITS(and)(masks_of(&c->first_c, load(src->first_c + pair)),
                                    masks_of(&c->second_c, load(src->second_c + pair))));
    }
    return BITS(and)(masks_of(&c->first_c, V(set1_epi8)((char)*src->first_c)),
                     masks_of(&c->second_c, V(set1_epi8)((char)*src->second_c)));
}

INLINE int planar_block(const channels *c, const pixels *src, size_t x, block *labels)
{
    const vec chroma = planar_chroma(c, src, x / 2);

    if (is_zero(chroma)) {
        return 0;
    }
    labels->left =
        BITS(and)(masks_of(&c->y, load(src->luma + x)), V(unpacklo_epi8)(chroma, chroma));
    labels->right =
        BITS(and)(masks_of(&c->y, load(src->luma + x + LANES)), V(unpackhi_epi8)(chroma, chroma));
    labels->left = labels_of(labels->left);
    labels->right = labels_of(labels->right);
    return 1;
}

/* 0: all labels are 0, and `labels` is not written. */
INLINE int classified(const channels *c, const pixels *src, layout order, size_t x, block *labels)
{
    return order == PLANAR ? planar_block(c, src, x, labels)
                           : packed_block(c, src->luma + 2 * x, order, labels);
}

INLINE void store_block(uint8_t *labels, const block *b)
{
    store(labels, b->left);
    store(labels + LANES, b->right);
}

INLINE int v_is_first(const pel_row_pairs *src)
{
    return src->c_step > 1 && src->v < src->u;
}

INLINE layout layout_of(const pel_row_pairs *src)
{
    return src->y_step == 1 ? PLANAR : src->y < src->u && src->y < src->v ? LUMA_EVEN : LUMA_ODD;
}

INLINE pixels pixels_of(const pel_row_pairs *src, int v_first, layout order)
{
    const uint8_t *const first_c = v_first ? src->v : src->u;
    const pixels p = {order == LUMA_ODD ? first_c : src->y, first_c, v_first ? src->u : src->v,
                      src->c_step};
    return p;
}

/* ---- Labels -------------------------------------------------------------------------------- */

INLINE void classify_as(const uint8_t *nibbles, const pel_row_pairs *row, layout order,
                        size_t count, uint8_t *labels)
{
    const int v_first = v_is_first(row);
    const channels c = channels_of(nibbles, v_first);
    const pixels src = pixels_of(row, v_first, order);
    const block background = {V(set1_epi8)(0), V(set1_epi8)(0)};

    for (size_t x = 0; x < count; x += BLOCK) {
        block found = background;
        x = x + BLOCK <= count ? x : count - BLOCK;
        (void)classified(&c, &src, order, x, &found);
        store_block(labels + x, &found);
    }
}

ISA uint16_t KERNEL(classify_nibbles)(const uint8_t *nibbles, const pel_row_pairs *src,
                                      uint16_t count, uint8_t *labels)
{
    const uint16_t even = count < BLOCK ? 0 : (uint16_t)(count & ~1u);

    switch (layout_of(src)) {
    case LUMA_EVEN:
        classify_as(nibbles, src, LUMA_EVEN, even, labels);
        break;
    case LUMA_ODD:
        classify_as(nibbles, src, LUMA_ODD, even, labels);
        break;
    default:
        classify_as(nibbles, src, PLANAR, even, labels);
        break;
    }
    return even;
}

/* ---- Runs ---------------------------------------------------------------------------------- */

/* `edge` is the place of the next begin or end of a run, `label` that of the last pixel so far. */
typedef struct run_writer {
    uint16_t *edge;
    unsigned label;
} run_writer;

/*
 * Two bits for a pixel: a run ends before it, a run begins with it. `bits` is not 0. Four edges are
 * written whatever there are, so that few jumps depend on the picture. Up to three of them are
 * scratch, for which there is room: pixels 0 .. x-1 have 2 x - 1 edges at most.
 */
INLINE uint16_t *put_edges(uint16_t *edge, uint64_t bits, unsigned x)
{
    uint16_t *const end = edge + bit_count(bits);

    do {
        for (unsigned i = 0; i < 4; i++) {
            edge[i] = (uint16_t)(x + lowest_place(bits) / 2);
            bits &= bits - 1;
        }
        edge += 4;
    } while (bits != 0);
    return end;
}

/* The edges in a vector of labels, without those of its first `skip` pixels. */
INLINE uint16_t *add_vector(uint16_t *edge, vec before, vec here, unsigned x, int skip)
{
    for (int i = 0; i < LANES; i += WORD) {
        const int drop = skip - i;
        uint64_t bits = edge_bits(before, here, i);
        if (drop > 0) {
            bits &= drop < WORD ? ~UINT64_C(0) << 2 * drop : 0;
        }
        if (bits != 0) {
            edge = put_edges(edge, bits, x + (unsigned)i);
        }
    }
    return edge;
}

/* labels: those of the block, already stored. The first `skip` of them have been there before. */
INLINE run_writer add_block(run_writer writer, const block *b, const uint8_t *labels, size_t x,
                            int skip)
{
    const vec last = V(set1_epi8)((char)writer.label);
    const vec before_left = MOVED(last, b->left, 1);
    const vec before_right = MOVED(b->left, b->right, 1);

    if (skip > 0 || !both_same(before_left, b->left, before_right, b->right)) {
        writer.edge = add_vector(writer.edge, before_left, b->left, (unsigned)x, skip);
        writer.edge =
            add_vector(writer.edge, before_right, b->right, (unsigned)x + LANES, skip - LANES);
        writer.label = labels[BLOCK - 1];
    }
    return writer;
}

/* A pixel with a label, whatever it was before. */
INLINE run_writer add_pixel(run_writer writer, unsigned label, size_t x)
{
    if (label != writer.label) {
        *writer.edge = (uint16_t)x;
        writer.edge += writer.label != 0;
        *writer.edge = (uint16_t)x;
        writer.edge += label != 0;
        writer.label = label;
    }
    return writer;
}

/* Behind the vectors of a row: its odd last pixel, if there is one, and its end. */
INLINE uint16_t end_runs(run_writer writer, const uint8_t *labels, size_t done, size_t count,
                         const uint16_t *edges)
{
    if (done < count) {
        writer = add_pixel(writer, labels[done], done);
    }
    writer = add_pixel(writer, 0, count);
    return (uint16_t)((size_t)(writer.edge - edges) / 2);
}

INLINE run_writer runs_as(const uint8_t *nibbles, const pel_row_pairs *row, layout order,
                          size_t count, uint8_t *labels, uint16_t *edges)
{
    const int v_first = v_is_first(row);
    const channels c = channels_of(nibbles, v_first);
    const pixels src = pixels_of(row, v_first, order);
    run_writer writer = {edges, 0};

    for (size_t x = 0; x < count; x += BLOCK) {
        const size_t at = x + BLOCK <= count ? x : count - BLOCK;
        block found;
        if (classified(&c, &src, order, at, &found)) {
            store_block(labels + at, &found);
            writer = add_block(writer, &found, labels + at, at, (int)(x - at));
        } else {
            writer = add_pixel(writer, 0, x);
        }
    }
    return writer;
}

/* count >= BLOCK */
ISA uint16_t KERNEL(classify_runs)(const uint8_t *nibbles, const pel_row_boxes *boxes,
                                   const pel_row_pairs *src, uint16_t count, uint8_t *labels,
                                   uint16_t *edges)
{
    const size_t even = count & ~(size_t)1;
    run_writer writer;

    switch (layout_of(src)) {
    case LUMA_EVEN:
        writer = runs_as(nibbles, src, LUMA_EVEN, even, labels, edges);
        break;
    case LUMA_ODD:
        writer = runs_as(nibbles, src, LUMA_ODD, even, labels, edges);
        break;
    default:
        writer = runs_as(nibbles, src, PLANAR, even, labels, edges);
        break;
    }
    if (even < count) {
        const size_t c = even / 2 * src->c_step;
        const pel_row_pairs last = {src->y + even * src->y_step, src->u + c, src->v + c,
                                    src->y_step, src->c_step};
        pel_row_classify_pairs(boxes, &last, 1, labels + even);
    }
    return end_runs(writer, labels, even, count, edges);
}

/* count >= BLOCK */
ISA uint16_t KERNEL(find_runs)(const uint8_t *labels, uint16_t count, uint16_t *edges)
{
    run_writer writer = {edges, 0};

    for (size_t x = 0; x < count; x += BLOCK) {
        const size_t at = x + BLOCK <= count ? x : (size_t)count - BLOCK;
        const block b = {load(labels + at), load(labels + at + LANES)};
        writer = add_block(writer, &b, labels + at, at, (int)(x - at));
    }
    return end_runs(writer, labels, count, count, edges);
}
