/*
 * Classification and the search for runs in the vectors of x86, whatever their width. The file that
 * includes this one says what the words mean:
 *     vec, LANES               a vector and its bytes
 *     V(op), BITS(op)          the intrinsic functions of its width
 *     everywhere(bytes)        16 bytes in every 16 of a vector
 *     MOVED(last, here, n)     what lies n bytes before `here` if `last` lies before it
 *     in_halves(low, high)     two half vectors from memory
 *     eights, fours            put the even of so many bytes before the odd: undo what unpacking
 *                              does to every 16 bytes for themselves
 *     twice(bytes)             each byte of the low half twice
 *     chroma_tables, chroma_tables_of, chroma_masks
 *                              the masks of classes by U and by V, both in the low half, from U in
 *                              the low and V in the high half
 *     are_apart(a, b)          whether no bit is set in both
 *     equal_bytes(a, b)        a bit for each byte in which they are equal
 *     put_edges                see row_edges_template.h
 *     ISA, INLINE, KERNEL      for what a function is compiled, what it is called
 *     APART                    never inlined, so that a loop has the registers for itself
 *
 * The last vector of a row ends where the row ends and so overlaps the one before it: its pixels
 * are classified twice, and their runs found once. An odd last pixel is left over.
 */

/* ---- Pixels -------------------------------------------------------------------------------- */

/* A row and its classes: what lies in memory, and what the loops hold in registers. There are not
 * enough of these for Y's nibble tables, too. Packed 4:2:2 begins at `bytes`; in `order`, every 16
 * bytes become 4 U, 4 V, 8 Y. */
typedef struct row {
    const uint8_t *nibbles, *constants;
    const pel_row_pairs *src;
    const uint8_t *bytes;
    vec order, nibble;
    chroma_tables chroma;
} row;

INLINE row row_of(const uint8_t *nibbles, const pel_row_pairs *src)
{
    const uint8_t *const c = src->u < src->v ? src->u : src->v;
    const uint8_t *const bytes = src->y < c ? src->y : c;
    const uint8_t *const constant = constants();
    const vec nibble = everywhere(load16(constant + OF_NIBBLE));
    const row r = {nibbles, constant, src, bytes, nibble, nibble, chroma_tables_of(nibbles)};
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

/* Half a vector of U before half a vector of V. */
INLINE vec planar_chroma(const pel_row_pairs *src, size_t x)
{
    __m128i pairs;

    if (src->c_step == 1) {
        return in_halves(src->u + x / 2, src->v + x / 2);
    }
    if (src->c_step == 2) {
        const int v_first = src->v < src->u;
        pairs = _mm_setr_epi8(0, 2, 4, 6, 8, 10, 12, 14, 1, 3, 5, 7, 9, 11, 13, 15);
        pairs = _mm_xor_si128(pairs, _mm_set1_epi8(v_first ? 1 : 0));
        return eights(V(shuffle_epi8)(load((v_first ? src->v : src->u) + x), everywhere(pairs)));
    }
    pairs = _mm_unpacklo_epi64(_mm_set1_epi8((char)*src->u), _mm_set1_epi8((char)*src->v));
    return eights(everywhere(pairs)); /* gray */
}

/* The labels of a vector of pixels; 0 if all of them are 0 by their chroma alone, which most are:
 * then `labels` is not written. */
INLINE int labels_at(const row *r, int is_packed, size_t x, vec *labels)
{
    vec a = r->order, b = a, luma;
    chroma c;
    tables t;

    if (is_packed) {
        a = V(shuffle_epi8)(load(r->bytes + 2 * x), r->order);
        b = V(shuffle_epi8)(load(r->bytes + 2 * x + LANES), r->order);
        c = chroma_masks(&r->chroma, r->nibble, fours(V(unpacklo_epi32)(a, b)));
    } else {
        c = chroma_masks(&r->chroma, r->nibble, planar_chroma(r->src, x));
    }
    if (are_apart(c.u, c.v)) {
        return 0;
    }
    luma = is_packed ? eights(V(unpackhi_epi64)(a, b)) : load(r->src->y + x);
    t = tables_of(r->nibbles);
    *labels = labels_of(r->constants, r->nibble,
                        BITS(and)(masks_of(&t, r->nibble, luma), twice(BITS(and)(c.u, c.v))));
    return 1;
}

/*
 * A row is done in two parts: the vectors that lie side by side, and, if they do not end with the
 * row, one that does and of which the first `skip` pixels have been there before.
 */
typedef struct part {
    size_t x, end;
    unsigned skip;
} part;

INLINE part first_part(size_t count)
{
    const part p = {0, count - count % LANES, 0};
    return p;
}

/* No part, which ends at 0, after the last one. */
INLINE part next_part(part p, size_t count)
{
    const part next = {count - LANES, p.end == count ? 0 : count,
                       LANES - (unsigned)(count % LANES)};
    return next;
}

/* ---- Labels -------------------------------------------------------------------------------- */

INLINE void classify_part(const row *r, int is_packed, part p, uint8_t *labels)
{
    for (size_t x = p.x; x < p.end; x += LANES) {
        vec found = V(set1_epi8)(0);
        (void)labels_at(r, is_packed, x, &found);
        store(labels + x, found);
    }
}

APART void classify_packed(const uint8_t *nibbles, const pel_row_pairs *src, part p,
                           uint8_t *labels)
{
    const row r = packed_row_of(nibbles, src);
    classify_part(&r, 1, p, labels);
}

APART void classify_planar(const uint8_t *nibbles, const pel_row_pairs *src, part p,
                           uint8_t *labels)
{
    const row r = row_of(nibbles, src);
    classify_part(&r, 0, p, labels);
}

ISA uint16_t KERNEL(classify_nibbles)(const uint8_t *nibbles, const pel_row_pairs *src,
                                      uint16_t count, uint8_t *labels)
{
    const uint16_t even = (uint16_t)(count & ~1u);

    if (count < LANES) {
        return 0;
    }
    for (part p = first_part(even); p.end != 0; p = next_part(p, even)) {
        if (src->y_step == 2) {
            classify_packed(nibbles, src, p, labels);
        } else {
            classify_planar(nibbles, src, p, labels);
        }
    }
    return even;
}

/* ---- Runs ---------------------------------------------------------------------------------- */

/* `edge` is the place of the next begin or end of a run; `inside` is 1 if the last label so far is
 * not 0. */
typedef struct run_writer {
    uint16_t *edge;
    uint64_t inside;
} run_writer;

/* The edges in a vector of labels behind the vector `last`, at the places that are in `keep`. */
INLINE run_writer add_labels(run_writer writer, vec last, vec here, size_t x, uint64_t keep)
{
    const uint64_t changes = ~equal_bytes(MOVED(last, here, 1), here) & keep;

    if (changes != 0) {
        const uint64_t nonzero = ~equal_bytes(V(set1_epi8)(0), here);
        writer.edge = put_edges(writer.edge, changes, nonzero, writer.inside, x);
        writer.inside = nonzero >> (LANES - 1) & 1;
    }
    return writer;
}

/* All places of a vector but the first ones. */
INLINE uint64_t places_from(unsigned skip)
{
    return ~UINT64_C(0) >> (64 - LANES) >> skip << skip;
}

/* Behind the vectors of a row: its odd last pixel, if there is one, and its end. */
INLINE uint16_t end_runs(run_writer writer, const uint8_t *labels, size_t done, size_t count,
                         const uint16_t *edges)
{
    const unsigned before = writer.inside != 0 ? labels[done - 1] : 0;
    const unsigned last = done < count ? labels[done] : before;

    if (last != before) {
        *writer.edge = (uint16_t)done;
        writer.edge += before != 0;
        *writer.edge = (uint16_t)done;
        writer.edge += last != 0;
    }
    if (last != 0) {
        *writer.edge++ = (uint16_t)count;
    }
    return (uint16_t)((size_t)(writer.edge - edges) / 2);
}

/* No part needs the labels before it: the first one begins with the row, and of the second one the
 * first pixel is skipped. Labels of background are not stored. */
INLINE run_writer runs_of_part(const row *r, int is_packed, part p, uint8_t *labels,
                               run_writer writer)
{
    const uint64_t keep = places_from(p.skip);
    vec last = V(set1_epi8)(0);

    for (size_t x = p.x; x < p.end; x += LANES) {
        vec found;
        if (labels_at(r, is_packed, x, &found)) {
            store(labels + x, found);
            writer = add_labels(writer, last, found, x, keep);
            last = found;
        } else if (writer.inside != 0) {
            *writer.edge++ = (uint16_t)(x + p.skip);
            writer.inside = 0;
            last = V(set1_epi8)(0);
        }
    }
    return writer;
}

APART run_writer runs_of_packed(const uint8_t *nibbles, const pel_row_pairs *src, part p,
                                uint8_t *labels, run_writer writer)
{
    const row r = packed_row_of(nibbles, src);
    return runs_of_part(&r, 1, p, labels, writer);
}

APART run_writer runs_of_planar(const uint8_t *nibbles, const pel_row_pairs *src, part p,
                                uint8_t *labels, run_writer writer)
{
    const row r = row_of(nibbles, src);
    return runs_of_part(&r, 0, p, labels, writer);
}

/* count >= LANES */
ISA uint16_t KERNEL(classify_runs)(const uint8_t *nibbles, const pel_row_boxes *boxes,
                                   const pel_row_pairs *src, uint16_t count, uint8_t *labels,
                                   uint16_t *edges)
{
    const size_t even = count & ~(size_t)1;
    run_writer writer = {edges, 0};

    for (part p = first_part(even); p.end != 0; p = next_part(p, even)) {
        if (src->y_step == 2) {
            writer = runs_of_packed(nibbles, src, p, labels, writer);
        } else {
            writer = runs_of_planar(nibbles, src, p, labels, writer);
        }
    }
    if (even < count) {
        const size_t c = even / 2 * src->c_step;
        const pel_row_pairs last = {src->y + even * src->y_step, src->u + c, src->v + c,
                                    src->y_step, src->c_step};
        pel_row_classify_pairs(boxes, &last, 1, labels + even);
    }
    return end_runs(writer, labels, even, count, edges);
}

/* count >= LANES */
ISA uint16_t KERNEL(find_runs)(const uint8_t *labels, uint16_t count, uint16_t *edges)
{
    run_writer writer = {edges, 0};
    vec last = V(set1_epi8)(0);

    for (part p = first_part(count); p.end != 0; p = next_part(p, count)) {
        for (size_t x = p.x; x < p.end; x += LANES) {
            const vec here = load(labels + x);
            writer = add_labels(writer, last, here, x, places_from(p.skip));
            last = here;
        }
    }
    return end_runs(writer, labels, count, count, edges);
}
