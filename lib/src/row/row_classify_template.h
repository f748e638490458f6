/*
 * Classification and the search for runs in the vectors of x86, whatever their width. The file that
 * includes this one says what the words mean:
 *     vec, LANES, V(op), BITS(op)
 *                              a vector, its bytes, and the intrinsic functions of its width
 *     block, BLOCK             the labels of so many pixels that are done in one step, 64 at most
 *     load_block               from memory
 *     last_of(block)           the vector that ends with its last label
 *     equal_before(last, b)    a bit for each label that is equal to the one before it; `last` lies
 *                              before the block
 *     zeros_of(block)          a bit for each label that is 0
 *     row, row_of, packed_row_of
 *                              what lies in memory or registers for a row of pixels
 *     places_at                the labels of a block of pixels, less one: the places of the lowest
 *                              bits of their masks, 255 for none
 *     nowhere_of(places), nowhere, store_places
 *                              a bit for each pixel that is nowhere; a vector of these; the places
 *                              become labels
 *     put_edges                see row_edges_template.h
 *     ISA, INLINE, KERNEL      for what a function is compiled, what it is called
 *     APART                    never inlined, so that a loop has the registers for itself
 *
 * The last block of a row ends where the row ends and so overlaps the one before it: its pixels are
 * classified twice, and their runs found once. An odd last pixel is left over.
 */

/*
 * A row is done in two parts: the blocks that lie side by side, and, if they do not end with the
 * row, one that does and of which the first `skip` pixels have been there before.
 */
typedef struct part {
    size_t x, end;
    unsigned skip;
} part;

INLINE part first_part(size_t count)
{
    const part p = {0, count - count % BLOCK, 0};
    return p;
}

/* No part, which ends at 0, after the last one. */
INLINE part next_part(part p, size_t count)
{
    const part next = {count - BLOCK, p.end == count ? 0 : count,
                       BLOCK - (unsigned)(count % BLOCK)};
    return next;
}

/* ---- Labels -------------------------------------------------------------------------------- */

INLINE void classify_part(const row *r, int is_packed, part p, uint8_t *labels)
{
    const vec none = nowhere(r->constants);

    for (size_t x = p.x; x < p.end; x += BLOCK) {
        block places = no_places(none);
        (void)places_at(r, is_packed, x, &places);
        store_places(labels + x, places, none);
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

    if (count < BLOCK) {
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

/* The edges in the block at x; the changes of the label are some. */
INLINE run_writer add_changes(run_writer writer, uint64_t changes, uint64_t nonzero, size_t x)
{
    writer.edge = put_edges(writer.edge, changes, nonzero, writer.inside, x);
    writer.inside = nonzero >> (BLOCK - 1) & 1;
    return writer;
}

/* All places of a block but the first ones. */
INLINE uint64_t places_from(unsigned skip)
{
    return ~UINT64_C(0) >> (64 - BLOCK) >> skip << skip;
}

/* Behind the blocks of a row: its end. */
INLINE uint16_t end_runs(run_writer writer, size_t count, const uint16_t *edges)
{
    *writer.edge = (uint16_t)count;
    return (uint16_t)((size_t)(writer.edge + writer.inside - edges) / 2);
}

/* Before that, the odd last pixel of a row, at x. */
APART run_writer add_odd_pixel(run_writer writer, const pel_row_boxes *boxes,
                               const pel_row_pairs *src, size_t x, uint8_t *labels)
{
    const unsigned before = writer.inside != 0 ? labels[writer.edge[-1]] : 0;
    const size_t c = x / 2 * src->c_step;
    const pel_row_pairs pixel = {src->y + x * src->y_step, src->u + c, src->v + c, src->y_step,
                                 src->c_step};

    pel_row_classify_pairs(boxes, &pixel, 1, labels + x);
    if (labels[x] != before) {
        *writer.edge = (uint16_t)x;
        writer.edge += before != 0;
        *writer.edge = (uint16_t)x;
        writer.inside = labels[x] != 0;
        writer.edge += writer.inside;
    }
    return writer;
}

/* Asks for packed pixels so many bytes before their turn that they are in the cache by then, also
 * where a page of memory ends, which processors do not look beyond. Behind the frame it does no
 * harm. */
INLINE void fetch_ahead(const row *r, size_t x)
{
    enum { AHEAD = 2048, LINE = 64 };
    const uintptr_t place = (uintptr_t)r->bytes + 2 * x + AHEAD;

    for (unsigned i = 0; i < 2 * BLOCK; i += LINE) {
        _mm_prefetch((const char *)(place + i), _MM_HINT_T0);
    }
}

/* No part needs the labels before it: the first one begins with the row, and of the second one the
 * first pixel is skipped. Labels are stored only where one of them begins a run. */
INLINE run_writer runs_of_part(const row *r, int is_packed, part p, uint8_t *labels,
                               run_writer writer)
{
    const uint64_t keep = places_from(p.skip);
    const vec none = nowhere(r->constants);
    vec last = none;

    for (size_t x = p.x; x < p.end; x += BLOCK) {
        block places;
        if (is_packed) {
            fetch_ahead(r, x);
        }
        if (places_at(r, is_packed, x, &places)) {
            const uint64_t changes = ~equal_before(last, places) & keep;
            if (changes != 0) {
                store_places(labels + x, places, none);
                writer = add_changes(writer, changes, ~nowhere_of(places), x);
            }
            last = last_of(places);
        } else if (writer.inside != 0) {
            *writer.edge++ = (uint16_t)(x + p.skip);
            writer.inside = 0;
            last = none;
        }
    }
    return writer;
}

INLINE uint16_t runs_of_row(const row *r, int is_packed, const pel_row_boxes *boxes, size_t count,
                            uint8_t *labels, uint16_t *edges)
{
    const size_t even = count & ~(size_t)1;
    run_writer writer = {edges, 0};

    for (part p = first_part(even); p.end != 0; p = next_part(p, even)) {
        writer = runs_of_part(r, is_packed, p, labels, writer);
    }
    if (even < count) {
        writer = add_odd_pixel(writer, boxes, r->src, even, labels);
    }
    return end_runs(writer, count, edges);
}

APART uint16_t runs_of_packed(const uint8_t *nibbles, const pel_row_boxes *boxes,
                              const pel_row_pairs *src, uint16_t count, uint8_t *labels,
                              uint16_t *edges)
{
    const row r = packed_row_of(nibbles, src);
    return runs_of_row(&r, 1, boxes, count, labels, edges);
}

APART uint16_t runs_of_planar(const uint8_t *nibbles, const pel_row_boxes *boxes,
                              const pel_row_pairs *src, uint16_t count, uint8_t *labels,
                              uint16_t *edges)
{
    const row r = row_of(nibbles, src);
    return runs_of_row(&r, 0, boxes, count, labels, edges);
}

/* count >= BLOCK */
ISA uint16_t KERNEL(classify_runs)(const uint8_t *nibbles, const pel_row_boxes *boxes,
                                   const pel_row_pairs *src, uint16_t count, uint8_t *labels,
                                   uint16_t *edges)
{
    return src->y_step == 2 ? runs_of_packed(nibbles, boxes, src, count, labels, edges)
                            : runs_of_planar(nibbles, boxes, src, count, labels, edges);
}

/* count >= BLOCK */
ISA uint16_t KERNEL(find_runs)(const uint8_t *labels, uint16_t count, uint16_t *edges)
{
    run_writer writer = {edges, 0};
    vec last = V(set1_epi8)(0);

    for (part p = first_part(count); p.end != 0; p = next_part(p, count)) {
        for (size_t x = p.x; x < p.end; x += BLOCK) {
            const block here = load_block(labels + x);
            const uint64_t changes = ~equal_before(last, here) & places_from(p.skip);
            if (changes != 0) {
                writer = add_changes(writer, changes, ~zeros_of(here), x);
            }
            last = last_of(here);
        }
    }
    return end_runs(writer, count, edges);
}
