/*
 * Row kernels in plain C, the truth that every faster version must equal: from labels to runs, and
 * from pixels to runs. Compiled for size, both are short loops over pixels; otherwise labels are
 * taken by words and pixels by pairs.
 */
#include "row/row_label.h"

#if defined(__GNUC__)
#define INLINE __attribute__((always_inline)) static inline
#define APART __attribute__((noinline)) static
#else
#define INLINE static inline
#define APART static
#endif

#if defined(__OPTIMIZE_SIZE__)
/* ---- Runs ---------------------------------------------------------------------------------- */

uint16_t pel_row_find_runs(const uint8_t *labels, uint16_t count, uint16_t *edges)
{
    uint16_t *edge = edges;
    unsigned before = 0;

    for (uint16_t x = 0; x <= count; x++) {
        const unsigned label = x < count ? labels[x] : 0;
        if (label != before) {
            if (before != 0) {
                *edge++ = x;
            }
            if (label != 0) {
                *edge++ = x;
            }
            before = label;
        }
    }
    return (uint16_t)((size_t)(edge - edges) / 2);
}

/* The mask changes at x, not always the label: one of its edges may be there. */
APART uint16_t *change(pel_class_mask before, pel_class_mask mask, uint16_t x, uint8_t *labels,
                       uint16_t *edge)
{
    const uint8_t label = mask != 0 ? pel_i_label(mask) : 0;

    if (before != 0) {
        if (label == labels[edge[-1]]) {
            return edge;
        }
        *edge++ = x;
    }
    if (label != 0) {
        *edge++ = x;
        labels[x] = label;
    }
    return edge;
}

/* Y is looked up only where the chroma is that of a class or a run is open. */
uint16_t pel_row_classify_runs(const pel_row_boxes *boxes, const pel_row_pairs *src, uint16_t count,
                               uint8_t *labels, uint16_t *edges)
{
    const pel_class_mask *const of_u = boxes->u, *const of_v = boxes->v;
    const uint8_t *u = src->u, *v = src->v;
    uint16_t *edge = edges;
    pel_class_mask before = 0;
    unsigned x = 0;

    while (x < count) {
        const pel_class_mask chroma = of_u[*u] & of_v[*v];
        u += src->c_step;
        v += src->c_step;
        if ((chroma | before) == 0) {
            x += 2;
            continue;
        }
        do {
            const pel_class_mask mask = chroma & boxes->y[src->y[x * src->y_step]];
            if (mask != before) {
                edge = change(before, mask, (uint16_t)x, labels, edge);
                before = mask;
            }
            x++;
        } while (x % 2 != 0 && x < count);
    }
    if (before != 0) {
        *edge++ = count;
    }
    return (uint16_t)((size_t)(edge - edges) / 2);
}

#else
/* ---- Runs ---------------------------------------------------------------------------------- */

/* A machine word of labels, to see at once that none of them differs from the run before. */
typedef size_t word;
enum { WORD_BYTES = sizeof(word) };

static inline word load_aligned(const uint8_t *labels)
{
#if defined(__GNUC__)
    word value;
    __builtin_memcpy(&value, __builtin_assume_aligned(labels, WORD_BYTES), WORD_BYTES);
    return value;
#else
    word value = 0;
    for (unsigned i = 0; i < WORD_BYTES; i++) {
        value |= (word)labels[i] << (8 * i);
    }
    return value;
#endif
}

/*
 * Runs lie in memory as x0, x1, x0, x1, ...: every change of the label writes one of these (a run
 * begins or ends) or two (a run ends and the next begins). `edge` is the place of the next one,
 * `label` the label so far, 0 outside runs.
 */
typedef struct run_writer {
    uint16_t *edge;
    word label;
} run_writer;

static inline run_writer change_label(run_writer writer, word label, unsigned x)
{
    writer.edge[0] = (uint16_t)x;
    writer.edge[1] = (uint16_t)x;
    writer.edge += (writer.label != 0) + (label != 0);
    writer.label = label;
    return writer;
}

static inline run_writer next_label(run_writer writer, word label, unsigned x)
{
    return label == writer.label ? writer : change_label(writer, label, x);
}

/* A word of labels that are not all equal to the one before it. Where finding the lowest set bit is
 * an instruction, only the changes are visited; elsewhere all labels are. */
#if PEL_HAS_CTZ && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
/* The top bit of every byte that is not 0. */
static inline word nonzero_bytes(word w)
{
    const word low7 = (word)-1 / 255 * 0x7F;
    return (((w & low7) + low7) | w) & ~low7;
}

static inline run_writer scan_word(run_writer writer, const uint8_t *labels, unsigned x)
{
    const word here = load_aligned(labels + x), before = here << 8 | writer.label;
    const word both = nonzero_bytes(here) & nonzero_bytes(before);
    word changes = nonzero_bytes(here ^ before);

    if ((changes & both) == 0) { /* every change is a begin or an end: no label meets another */
        do {
            *writer.edge++ = (uint16_t)(x + pel_i_lowest_bit(changes) / 8);
            changes &= changes - 1;
        } while (changes != 0);
        writer.label = here >> (8 * (WORD_BYTES - 1));
        return writer;
    }
    do {
        const unsigned place = x + pel_i_lowest_bit(changes) / 8;
        writer = change_label(writer, labels[place], place);
        changes &= changes - 1;
    } while (changes != 0);
    return writer;
}
#else
static inline run_writer scan_word(run_writer writer, const uint8_t *labels, unsigned x)
{
    for (const unsigned end = x + WORD_BYTES; x < end; x++) {
        writer = next_label(writer, labels[x], x);
    }
    return writer;
}
#endif

uint16_t pel_row_find_runs(const uint8_t *labels, uint16_t count, uint16_t *edges)
{
    const word ones = (word)-1 / 255;
    run_writer writer = {edges, 0};
    const uint8_t *at = labels;
    const uint8_t *const end = labels + count, *words_end;

    for (; at != end && (uintptr_t)at % WORD_BYTES != 0; at++) {
        writer = next_label(writer, *at, (unsigned)(at - labels));
    }
    words_end = end - (size_t)(end - at) % WORD_BYTES;
    for (; at != words_end; at += WORD_BYTES) {
        if (load_aligned(at) != writer.label * ones) {
            writer = scan_word(writer, labels, (unsigned)(at - labels));
        }
    }
    for (; at != end; at++) {
        writer = next_label(writer, *at, (unsigned)(at - labels));
    }
    writer = next_label(writer, 0, count);
    return (uint16_t)((size_t)(writer.edge - edges) / 2);
}

/* ---- From pixels to runs ------------------------------------------------------------------- */

/* Where the pairs of a row lie: the first Y of the four bytes of a packed pair is byte 0 or 1, the
 * chroma is the other two; or there is a row of Y, and chroma elsewhere. */
enum { Y_FIRST = 0, Y_SECOND = 1, PLANES = 2 };

typedef struct pair_row {
    const pel_class_mask *of_y, *of_u, *of_v;
    const uint8_t *first, *u, *v; /* first: the first packed pair, or Y */
    size_t c_step;
} pair_row;

/* The classes that the two pixels of a pair are in. */
typedef struct pair_masks {
    pel_class_mask left, right;
} pair_masks;

INLINE pel_class_mask chroma_mask(const pair_row *row, unsigned layout, const uint8_t *pair)
{
    if (layout == PLANES) {
        const size_t c = (size_t)(pair - row->first) / 2 * row->c_step;
        return row->of_u[row->u[c]] & row->of_v[row->v[c]];
    }
    return row->of_u[pair[1 - layout]] & row->of_v[pair[3 - layout]];
}

INLINE pair_masks luma_masks(const pair_row *row, unsigned layout, const uint8_t *pair,
                             pel_class_mask chroma)
{
    const uint8_t *const y = layout == PLANES ? pair : pair + layout;
    const pair_masks masks = {chroma & row->of_y[y[0]],
                              chroma & row->of_y[y[layout == PLANES ? 1 : 2]]};
    return masks;
}

/* Whether a pixel of a pair is in a class; only then *masks are set. */
INLINE int coloured(const pair_row *row, unsigned layout, const uint8_t *pair, pair_masks *masks)
{
    const pel_class_mask chroma = chroma_mask(row, layout, pair);

    if (chroma == 0) {
        return 0;
    }
    *masks = luma_masks(row, layout, pair, chroma);
    return masks->left != 0 || masks->right != 0;
}

/* The next pair with a pixel in a class, and its masks; NULL if there is none. Most pixels are
 * background, and most of those are told by their chroma alone. */
INLINE const uint8_t *skip_background(const pair_row *row, unsigned layout, const uint8_t *pair,
                                      const uint8_t *last_four, const uint8_t *last,
                                      pair_masks *masks)
{
    const unsigned step = layout == PLANES ? 2 : 4;

    for (; pair < last_four; pair += 4 * step) {
        if (coloured(row, layout, pair, masks)) {
            return pair;
        }
        if (coloured(row, layout, pair + step, masks)) {
            return pair + step;
        }
        if (coloured(row, layout, pair + 2 * step, masks)) {
            return pair + 2 * step;
        }
        if (coloured(row, layout, pair + 3 * step, masks)) {
            return pair + 3 * step;
        }
    }
    for (; pair <= last; pair += step) {
        if (coloured(row, layout, pair, masks)) {
            return pair;
        }
    }
    return NULL;
}

/* Two pixels meet that are in classes, but not in the same ones: if their labels differ, a run ends
 * and another begins at x. */
APART uint16_t *meet(pel_class_mask mask, size_t x, uint8_t *labels, uint16_t *edge)
{
    const uint8_t label = pel_i_label(mask);

    if (label != labels[edge[-1]]) {
        edge[0] = (uint16_t)x;
        edge[1] = (uint16_t)x;
        edge += 2;
        labels[x] = label;
    }
    return edge;
}

INLINE uint16_t *begin(pel_class_mask mask, size_t x, uint8_t *labels, uint16_t *edge)
{
    *edge = (uint16_t)x;
    labels[x] = pel_i_label(mask);
    return edge + 1;
}

/*
 * Two states, each with its own loop: outside of runs, pairs are skipped that are in no class;
 * inside, those whose pixels both have the masks of the pixel before. What happens at the others is
 * written once, with jumps to where it goes on: every copy of it would take registers from the
 * loops. Returns the next place for an edge: after an odd number of them the last run is open.
 */
INLINE uint16_t *runs_of_pairs(const pair_row *row, unsigned layout, size_t pairs, uint8_t *labels,
                               uint16_t *edge)
{
    const unsigned step = layout == PLANES ? 2 : 4;
    const uint8_t *pair = row->first;
    const uint8_t *const last = pair + (pairs - 1) * step;
    const uint8_t *const last_four = pairs < 4 ? pair : last - 3 * step;
    pel_class_mask before;
    pair_masks masks;
    size_t x;

outside:
    pair = skip_background(row, layout, pair, last_four, last, &masks);
    if (!pair) {
        return edge;
    }
    x = (size_t)(pair - row->first) / (step / 2);
    if (masks.left == 0) {
        goto begin_right;
    }
    edge = begin(masks.left, x, labels, edge);
    if (masks.right == masks.left) {
        goto inside;
    }
change_right:
    x = (size_t)(pair - row->first) / (step / 2);
    if (masks.right == 0) {
        *edge++ = (uint16_t)(x + 1);
        pair += step;
        goto outside;
    }
    edge = meet(masks.right, x + 1, labels, edge);
    goto inside;
change_left:
    x = (size_t)(pair - row->first) / (step / 2);
    if (masks.left != 0) {
        edge = meet(masks.left, x, labels, edge);
        if (masks.right != masks.left) {
            goto change_right;
        }
        goto inside;
    }
    *edge++ = (uint16_t)x;
    if (masks.right == 0) {
        pair += step;
        goto outside;
    }
begin_right:
    edge = begin(masks.right, x + 1, labels, edge);
inside:
    before = masks.right;
    for (pair += step; pair < last; pair += step) {
        masks = luma_masks(row, layout, pair, chroma_mask(row, layout, pair));
        if (masks.left != before) {
            goto change_left;
        }
        if (masks.right != before) {
            goto change_right;
        }
        pair += step;
        masks = luma_masks(row, layout, pair, chroma_mask(row, layout, pair));
        if (masks.left != before) {
            goto change_left;
        }
        if (masks.right != before) {
            goto change_right;
        }
    }
    if (pair == last) {
        masks = luma_masks(row, layout, pair, chroma_mask(row, layout, pair));
        if (masks.left != before) {
            goto change_left;
        }
        if (masks.right != before) {
            goto change_right;
        }
    }
    return edge;
}

/* Packed pairs: of the chroma bytes, the first may be U or V. */
INLINE uint16_t *runs_packed(const pel_row_boxes *boxes, const pel_row_pairs *src, unsigned layout,
                             size_t pairs, uint8_t *labels, uint16_t *edges)
{
    const int swap = src->v < src->u;
    const uint8_t *const chroma = swap ? src->v : src->u;
    const pair_row row = {boxes->y,
                          swap ? boxes->v : boxes->u,
                          swap ? boxes->u : boxes->v,
                          layout == Y_FIRST ? src->y : chroma,
                          NULL,
                          NULL,
                          0};
    return runs_of_pairs(&row, layout, pairs, labels, edges);
}
APART uint16_t *runs_y_first(const pel_row_boxes *boxes, const pel_row_pairs *src, size_t pairs,
                             uint8_t *labels, uint16_t *edges)
{
    return runs_packed(boxes, src, Y_FIRST, pairs, labels, edges);
}

APART uint16_t *runs_y_second(const pel_row_boxes *boxes, const pel_row_pairs *src, size_t pairs,
                              uint8_t *labels, uint16_t *edges)
{
    return runs_packed(boxes, src, Y_SECOND, pairs, labels, edges);
}

APART uint16_t *runs_planes(const pel_row_boxes *boxes, const pel_row_pairs *src, size_t pairs,
                            uint8_t *labels, uint16_t *edges)
{
    const pair_row row = {boxes->y, boxes->u, boxes->v, src->y, src->u, src->v, src->c_step};
    return runs_of_pairs(&row, PLANES, pairs, labels, edges);
}

/* The runs of the pairs, the last one perhaps left open. */
static uint16_t *find_in_pairs(const pel_row_boxes *boxes, const pel_row_pairs *src, size_t pairs,
                               uint8_t *labels, uint16_t *edges)
{
    if (src->y_step != 2) {
        return runs_planes(boxes, src, pairs, labels, edges);
    }
    return src->y < src->u && src->y < src->v ? runs_y_first(boxes, src, pairs, labels, edges)
                                              : runs_y_second(boxes, src, pairs, labels, edges);
}

/* The pixel behind the last pair. */
static uint16_t *add_single(pel_class_mask mask, uint16_t x, int open, uint8_t *labels,
                            uint16_t *edge)
{
    if (mask != 0) {
        return open ? meet(mask, x, labels, edge) : begin(mask, x, labels, edge);
    }
    if (open) {
        *edge++ = x;
    }
    return edge;
}

uint16_t pel_row_classify_runs(const pel_row_boxes *boxes, const pel_row_pairs *src, uint16_t count,
                               uint8_t *labels, uint16_t *edges)
{
    uint16_t *edge = count < 2 ? edges : find_in_pairs(boxes, src, count / 2, labels, edges);

    if (count % 2 != 0) {
        const size_t c = count / 2 * (size_t)src->c_step;
        const uint8_t y = src->y[(count - 1) * (size_t)src->y_step];
        edge = add_single(boxes->u[src->u[c]] & boxes->v[src->v[c]] & boxes->y[y],
                          (uint16_t)(count - 1), (edge - edges) % 2 != 0, labels, edge);
    }
    if ((edge - edges) % 2 != 0) {
        *edge++ = count;
    }
    return (uint16_t)((size_t)(edge - edges) / 2);
}
#endif
