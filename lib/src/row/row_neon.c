/* Row kernels for AArch64 with NEON: 32 pixels at a time. */
#include "row/row_neon.h"

#if defined(PEL_ROW_NEON)
#include <arm_neon.h>

#define INLINE __attribute__((always_inline)) static inline

/* ---- Box classes --------------------------------------------------------------------------- */

/* The nibble tables of a channel; see row_nibbles.h. */
typedef struct tables {
    uint8x16_t above, rough, below, from, to;
} tables;

INLINE tables tables_of(const uint8_t *nibbles)
{
    const tables t = {vld1q_u8(nibbles + PEL_NIBBLES_ABOVE), vld1q_u8(nibbles + PEL_NIBBLES_ROUGH),
                      vld1q_u8(nibbles + PEL_NIBBLES_BELOW), vld1q_u8(nibbles + PEL_NIBBLES_FROM),
                      vld1q_u8(nibbles + PEL_NIBBLES_TO)};
    return t;
}

/* The class masks of 16 values. */
INLINE uint8x16_t masks_of(const tables *t, uint8x16_t values)
{
    const uint8x16_t low = vandq_u8(values, vdupq_n_u8(15)), high = vshrq_n_u8(values, 4);
    const uint8x16_t from = vandq_u8(vqtbl1q_u8(t->rough, high), vqtbl1q_u8(t->from, low));
    const uint8x16_t to = vorrq_u8(vqtbl1q_u8(t->below, high), vqtbl1q_u8(t->to, low));
    return vandq_u8(vorrq_u8(vqtbl1q_u8(t->above, high), from), to);
}

/* 1 + the place of the lowest bit, 0 for none: the bits in front of it, the byte turned round, are
 * 8 where there is none. */
INLINE uint8x16_t labels_of(uint8x16_t masks)
{
    static const uint8_t label[16] = {1, 2, 3, 4, 5, 6, 7, 8, 0, 0, 0, 0, 0, 0, 0, 0};
    return vqtbl1q_u8(vld1q_u8(label), vclzq_u8(vrbitq_u8(masks)));
}

INLINE int any(uint8x16_t v)
{
    const uint64x2_t halves = vreinterpretq_u64_u8(v);
    return (vgetq_lane_u64(halves, 0) | vgetq_lane_u64(halves, 1)) != 0;
}

/* ---- Pixels -------------------------------------------------------------------------------- */

/* 32 pixels, those of even and of odd places apart, and what they share. */
typedef struct pixels {
    uint8x16_t even, odd, u, v;
} pixels;

typedef struct labels32 {
    uint8x16_t even, odd;
} labels32;

/* How a row of pairs lies in memory. */
typedef enum layout {
    Y_FIRST,  /* packed, a Y on the lowest byte */
    C_FIRST,  /* packed, a U or V on the lowest byte */
    PLANES,   /* three planes */
    TWO,      /* a plane of Y, one of U and V by turns */
    GRAY_ONLY /* one plane, one U and one V for all */
} layout;

/* A row of pairs as the loops take it. Where U and V lie by turns, the lower one is called u, and
 * its tables are those of u. */
typedef struct source {
    const uint8_t *y, *u, *v;
    tables of_y, of_u, of_v;
} source;

INLINE pixels pixels_at(const source *src, layout how, size_t x)
{
    pixels p;

    if (how == Y_FIRST || how == C_FIRST) {
        const uint8x16x4_t bytes = vld4q_u8((how == Y_FIRST ? src->y : src->u) + 2 * x);
        p.even = bytes.val[how == Y_FIRST ? 0 : 1];
        p.odd = bytes.val[how == Y_FIRST ? 2 : 3];
        p.u = bytes.val[how == Y_FIRST ? 1 : 0];
        p.v = bytes.val[how == Y_FIRST ? 3 : 2];
        return p;
    }
    const uint8x16x2_t luma = vld2q_u8(src->y + x);
    p.even = luma.val[0];
    p.odd = luma.val[1];
    if (how == PLANES) {
        p.u = vld1q_u8(src->u + x / 2);
        p.v = vld1q_u8(src->v + x / 2);
    } else if (how == TWO) {
        const uint8x16x2_t chroma = vld2q_u8(src->u + x);
        p.u = chroma.val[0];
        p.v = chroma.val[1];
    } else {
        p.u = vld1q_dup_u8(src->u);
        p.v = vld1q_dup_u8(src->v);
    }
    return p;
}

INLINE uint8x16_t chroma_masks(const source *src, const pixels *p)
{
    return vandq_u8(masks_of(&src->of_u, p->u), masks_of(&src->of_v, p->v));
}

/* The labels of pixels with these masks of their chroma. */
INLINE labels32 labels_under(const source *src, const pixels *p, uint8x16_t chroma)
{
    const labels32 found = {labels_of(vandq_u8(masks_of(&src->of_y, p->even), chroma)),
                            labels_of(vandq_u8(masks_of(&src->of_y, p->odd), chroma))};
    return found;
}

INLINE void store_labels(uint8_t *labels, labels32 found)
{
    vst1q_u8(labels, vzip1q_u8(found.even, found.odd));
    vst1q_u8(labels + 16, vzip2q_u8(found.even, found.odd));
}

static layout layout_of(const pel_row_pairs *src)
{
    if (src->y_step == 2) {
        return src->y < src->u && src->y < src->v ? Y_FIRST : C_FIRST;
    }
    return src->c_step == 1 ? PLANES : src->c_step == 2 ? TWO : GRAY_ONLY;
}

INLINE source source_of(const uint8_t *nibbles, const pel_row_pairs *src)
{
    const uint8_t *const of_u = nibbles + PEL_NIBBLES_CHANNEL;
    const uint8_t *const of_v = of_u + PEL_NIBBLES_CHANNEL;
    const int v_first = src->v < src->u && src->c_step > 1;
    const source s = {src->y,
                      v_first ? src->v : src->u,
                      v_first ? src->u : src->v,
                      tables_of(nibbles),
                      tables_of(v_first ? of_v : of_u),
                      tables_of(v_first ? of_u : of_v)};
    return s;
}

INLINE void classify(const source *given, layout how, size_t count, uint8_t *labels)
{
    const source src = *given;

    for (size_t x = 0; x < count; x += 32) {
        const pixels p = pixels_at(&src, how, x);
        const uint8x16_t chroma = chroma_masks(&src, &p);
        labels32 found = {vdupq_n_u8(0), vdupq_n_u8(0)};
        if (any(chroma)) {
            found = labels_under(&src, &p, chroma);
        }
        store_labels(labels + x, found);
    }
}

uint16_t pel_row_classify_nibbles_neon(const uint8_t *nibbles, const pel_row_pairs *src,
                                       uint16_t count, uint8_t *labels)
{
    const uint16_t whole = (uint16_t)(count & ~31u);
    const source s = source_of(nibbles, src);

    switch (layout_of(src)) {
    case Y_FIRST:
        classify(&s, Y_FIRST, whole, labels);
        break;
    case C_FIRST:
        classify(&s, C_FIRST, whole, labels);
        break;
    case PLANES:
        classify(&s, PLANES, whole, labels);
        break;
    case TWO:
        classify(&s, TWO, whole, labels);
        break;
    default:
        classify(&s, GRAY_ONLY, whole, labels);
        break;
    }
    return whole;
}

/* ---- Runs ---------------------------------------------------------------------------------- */

/* Where runs begin and end: begins to edges[0], [2], ..., ends to edges[1], [3], ... Both take
 * turns, so that each can be written for itself. */
typedef struct run_writer {
    uint16_t *begin, *end;
} run_writer;

/* Writes the places of the set bits, `from` higher, into every second element. */
INLINE uint16_t *put_places(uint32_t bits, size_t from, uint16_t *out)
{
    while (bits != 0) {
        *out = (uint16_t)(from + (unsigned)__builtin_ctz(bits));
        out += 2;
        bits &= bits - 1;
    }
    return out;
}

/* Bits 0..31: the begins among 32 places, bits 32..63: the ends. */
INLINE run_writer put_changes(run_writer writer, uint64_t changes, size_t x)
{
    writer.begin = put_places((uint32_t)changes, x, writer.begin);
    writer.end = put_places((uint32_t)(changes >> 32), x, writer.end);
    return writer;
}

/* Bytes 255 and 0 to bits: weighted by their place among eight, then added up. */
INLINE uint64_t bits_of(uint8x16_t begins_low, uint8x16_t begins_high, uint8x16_t ends_low,
                        uint8x16_t ends_high)
{
    const uint8x16_t bit = vreinterpretq_u8_u64(vdupq_n_u64(UINT64_C(0x8040201008040201)));
    const uint8x16_t begins = vpaddq_u8(vandq_u8(begins_low, bit), vandq_u8(begins_high, bit));
    const uint8x16_t ends = vpaddq_u8(vandq_u8(ends_low, bit), vandq_u8(ends_high, bit));
    const uint8x16_t both = vpaddq_u8(begins, ends);
    return vgetq_lane_u64(vreinterpretq_u64_u8(vpaddq_u8(both, both)), 0);
}

/* The same of even and odd places. */
INLINE uint64_t bits_of_turns(labels32 begins, labels32 ends)
{
    const uint8x16_t bit = vreinterpretq_u8_u32(vdupq_n_u32(UINT32_C(0xC0300C03)));
    const uint8x16_t is_even = vdupq_n_u8(0x55);
    const uint8x16_t first = vandq_u8(vbslq_u8(is_even, begins.even, begins.odd), bit);
    const uint8x16_t second = vandq_u8(vbslq_u8(is_even, ends.even, ends.odd), bit);
    const uint8x16_t both = vpaddq_u8(first, second);
    return vgetq_lane_u64(vreinterpretq_u64_u8(vpaddq_u8(both, both)), 0);
}

/* What is `label`, where it is not the `other` one. */
INLINE uint8x16_t entered(uint8x16_t label, uint8x16_t other)
{
    return vbicq_u8(vtstq_u8(label, label), vceqq_u8(label, other));
}

/* The places from `x` on, the label before them being `label`, and the end. */
static uint16_t finish_runs(const uint8_t *labels, unsigned x, uint16_t count, uint8_t label,
                            run_writer writer, const uint16_t *edges)
{
    for (; x <= count; x++) {
        const uint8_t next = x < count ? labels[x] : 0;
        if (next != label) {
            *writer.begin = (uint16_t)x;
            writer.begin += next != 0 ? 2 : 0;
            *writer.end = (uint16_t)x;
            writer.end += label != 0 ? 2 : 0;
            label = next;
        }
    }
    return (uint16_t)((size_t)(writer.begin - edges) / 2);
}

uint16_t pel_row_find_runs_neon(const uint8_t *labels, uint16_t count, uint16_t *edges)
{
    run_writer writer = {edges, edges + 1};
    uint8x16_t last = vdupq_n_u8(0);
    unsigned x = 0;

    for (; x + 32 <= count; x += 32) {
        const uint8x16_t low = vld1q_u8(labels + x), high = vld1q_u8(labels + x + 16);
        const uint8x16_t before_low = vextq_u8(last, low, 15);
        const uint8x16_t before_high = vextq_u8(low, high, 15);
        last = high;
        if (any(vorrq_u8(veorq_u8(low, before_low), veorq_u8(high, before_high)))) {
            const uint64_t changes = bits_of(entered(low, before_low), entered(high, before_high),
                                             entered(before_low, low), entered(before_high, high));
            writer = put_changes(writer, changes, x);
        }
    }
    return finish_runs(labels, x, count, vgetq_lane_u8(last, 15), writer, edges);
}

/* ---- Pixels to runs ------------------------------------------------------------------------ */

/* What is known between two pieces of a row. */
typedef struct run_state {
    run_writer writer;
    uint8x16_t last; /* the labels of odd places so far */
} run_state;

INLINE run_state runs_of(const source *given, layout how, size_t count, uint8_t *labels,
                         run_writer writer)
{
    const source src = *given;
    run_state state = {writer, vdupq_n_u8(0)};

    for (size_t x = 0; x < count; x += 32) {
        const pixels p = pixels_at(&src, how, x);
        const uint8x16_t chroma = chroma_masks(&src, &p);
        if (any(vorrq_u8(chroma, state.last))) {
            const labels32 here = labels_under(&src, &p, chroma);
            const labels32 before = {vextq_u8(state.last, here.odd, 15), here.even};
            const labels32 begins = {entered(here.even, before.even),
                                     entered(here.odd, before.odd)};
            const labels32 ends = {entered(before.even, here.even), entered(before.odd, here.odd)};
            store_labels(labels + x, here);
            state.writer = put_changes(state.writer, bits_of_turns(begins, ends), x);
            state.last = here.odd;
        }
    }
    return state;
}

INLINE run_state begin_runs(const source *s, layout how, size_t count, uint8_t *labels,
                            uint16_t *edges)
{
    const run_writer writer = {edges, edges + 1};

    switch (how) {
    case Y_FIRST:
        return runs_of(s, Y_FIRST, count, labels, writer);
    case C_FIRST:
        return runs_of(s, C_FIRST, count, labels, writer);
    case PLANES:
        return runs_of(s, PLANES, count, labels, writer);
    case TWO:
        return runs_of(s, TWO, count, labels, writer);
    default:
        return runs_of(s, GRAY_ONLY, count, labels, writer);
    }
}

uint16_t pel_row_classify_runs_neon(const uint8_t *nibbles, const pel_row_boxes *boxes,
                                    const pel_row_pairs *src, uint16_t count, uint8_t *labels,
                                    uint16_t *edges)
{
    const uint16_t whole = (uint16_t)(count & ~31u);
    const source s = source_of(nibbles, src);
    const run_state state = begin_runs(&s, layout_of(src), whole, labels, edges);
    pel_row_pairs rest = *src;

    rest.y += (size_t)whole * src->y_step;
    rest.u += (size_t)(whole / 2) * src->c_step;
    rest.v += (size_t)(whole / 2) * src->c_step;
    pel_row_classify_pairs(boxes, &rest, (uint16_t)(count - whole), labels + whole);
    return finish_runs(labels, whole, count, vgetq_lane_u8(state.last, 15), state.writer, edges);
}

#else
typedef int nothing_here; /* an empty file is no C */
#endif
