/*
 * Row kernels for Helium (MVE): 32 pixels at a time, as 16 pairs. A mask table of 256 bytes is
 * looked up for 16 pixels by one gathering load; the masks of U and V, which pairs share, once for
 * 32. Elsewhere this file is empty.
 */
#include "row/row_mve.h"

#if PEL_ROW_MVE && PEL_CLASS_MAX == 8
#include <arm_mve.h>

enum { BLOCK = PEL_ROW_BLOCK_MVE };

#define INLINE __attribute__((always_inline)) static inline

/* ---- Pixels to masks ----------------------------------------------------------------------- */

/* How the bytes of a row lie: Y C Y D or C Y D Y, C D in a plane beside Y's, C and D in a plane
 * each, or all pixels of one C and D. OTHER is for the plain version. */
typedef enum layout { OTHER, LUMA_FIRST, CHROMA_FIRST, TWO_PLANES, THREE_PLANES, GRAY } layout;

/* A row and the tables of its bytes; C is that of U and V which comes first in memory. Packed
 * pixels begin at c. */
typedef struct source {
    const uint8_t *y, *c, *d;
    const uint8_t *of_y, *of_c, *of_d;
} source;

/* C and D of 32 pixels apart, and of Y those of the left and the right pixels of the pairs. */
typedef struct pixels {
    uint8x16_t left, right, c, d;
} pixels;

static source source_of(const pel_row_boxes *boxes, const pel_row_pairs *src)
{
    const int u_first = (uintptr_t)src->u < (uintptr_t)src->v;
    source s;

    s.y = src->y;
    s.c = u_first ? src->u : src->v;
    s.d = u_first ? src->v : src->u;
    s.of_y = boxes->y;
    s.of_c = u_first ? boxes->u : boxes->v;
    s.of_d = u_first ? boxes->v : boxes->u;
    return s;
}

static layout layout_of(const pel_row_pairs *src, const source *s)
{
    const uintptr_t y = (uintptr_t)s->y, c = (uintptr_t)s->c, apart = (uintptr_t)s->d - c;

    if (src->y_step == 2 && src->c_step == 4 && apart == 2) {
        return c == y + 1 ? LUMA_FIRST : c + 1 == y ? CHROMA_FIRST : OTHER;
    }
    if (src->y_step != 1) {
        return OTHER;
    }
    return src->c_step == 0                 ? GRAY
           : src->c_step == 1               ? THREE_PLANES
           : src->c_step == 2 && apart == 1 ? TWO_PLANES
                                            : OTHER;
}

/* The pixels from s on, and s moved on behind them. */
INLINE pixels next_pixels(source *s, layout how)
{
    pixels p;

    if (how == LUMA_FIRST) {
        const uint8x16x4_t all = vld4q_u8(s->y);
        p.left = all.val[0];
        p.c = all.val[1];
        p.right = all.val[2];
        p.d = all.val[3];
        s->y += 64;
    } else if (how == CHROMA_FIRST) {
        const uint8x16x4_t all = vld4q_u8(s->c);
        p.c = all.val[0];
        p.left = all.val[1];
        p.d = all.val[2];
        p.right = all.val[3];
        s->c += 64;
    } else {
        const uint8x16x2_t both = vld2q_u8(s->y);
        p.left = both.val[0];
        p.right = both.val[1];
        s->y += 32;
        if (how == TWO_PLANES) {
            const uint8x16x2_t chroma = vld2q_u8(s->c);
            p.c = chroma.val[0];
            p.d = chroma.val[1];
            s->c += 32;
        } else if (how == THREE_PLANES) {
            p.c = vld1q_u8(s->c);
            p.d = vld1q_u8(s->d);
            s->c += 16;
            s->d += 16;
        } else {
            p.c = vdupq_n_u8(*s->c);
            p.d = vdupq_n_u8(*s->d);
        }
    }
    return p;
}

INLINE uint8x16_t chroma_masks(const source *s, const pixels *p)
{
    return vandq_u8(vldrbq_gather_offset_u8(s->of_c, p->c), vldrbq_gather_offset_u8(s->of_d, p->d));
}

/* ---- Masks to labels ----------------------------------------------------------------------- */

/* The label of each mask: 1 + the place of its lowest bit. */
#define L1(high) high, 1, 2, 1, 3, 1, 2, 1, 4, 1, 2, 1, 3, 1, 2, 1
/* Not static, as assembly names it. */
__attribute__((used))
const uint8_t pel_row_label_of_mask[256] = {L1(0), L1(5), L1(6), L1(5), L1(7), L1(5), L1(6), L1(5),
                                            L1(8), L1(5), L1(6), L1(5), L1(7), L1(5), L1(6), L1(5)};
#undef L1

/* Elements of both in turn. In registers that are neighbours, as the instructions ask for: what
 * vst2q_u8 is made into brings them there by way of memory. */
INLINE void store_in_turn(uint8x16_t left, uint8x16_t right, uint8_t *labels)
{
    register uint8x16_t first __asm__("q0") = left;
    register uint8x16_t second __asm__("q1") = right;

    __asm__ volatile("vst20.8 {q0, q1}, [%2]\n\tvst21.8 {q0, q1}, [%2]"
                     :
                     : "t"(first), "t"(second), "r"(labels)
                     : "memory");
}

INLINE void put_labels(const source *s, const pixels *p, uint8x16_t chroma, uint8_t *labels)
{
    const uint8x16_t left = vandq_u8(chroma, vldrbq_gather_offset_u8(s->of_y, p->left));
    const uint8x16_t right = vandq_u8(chroma, vldrbq_gather_offset_u8(s->of_y, p->right));

    store_in_turn(vldrbq_gather_offset_u8(pel_row_label_of_mask, left),
                  vldrbq_gather_offset_u8(pel_row_label_of_mask, right), labels);
}

INLINE void classify(source s, layout how, uint8_t *labels, const uint8_t *end)
{
    while (labels != end) {
        const pixels p = next_pixels(&s, how);
        put_labels(&s, &p, chroma_masks(&s, &p), labels);
        labels += BLOCK;
    }
}

/* What is left of a row behind its first pixels. */
static pel_row_pairs rest_of(const pel_row_pairs *src, uint16_t done)
{
    pel_row_pairs rest = *src;

    rest.y += (size_t)done * src->y_step;
    rest.u += (size_t)(done / 2) * src->c_step;
    rest.v += (size_t)(done / 2) * src->c_step;
    return rest;
}

void pel_row_classify_pairs_mve(const pel_row_boxes *boxes, const pel_row_pairs *src,
                                uint16_t count, uint8_t *labels)
{
    const source s = source_of(boxes, src);
    const layout how = layout_of(src, &s);
    const uint16_t done = how == OTHER ? 0 : (uint16_t)(count - count % BLOCK);
    const uint8_t *const end = labels + done;
    const pel_row_pairs rest = rest_of(src, done);

    switch (how) {
    case LUMA_FIRST:
        classify(s, LUMA_FIRST, labels, end);
        break;
    case CHROMA_FIRST:
        classify(s, CHROMA_FIRST, labels, end);
        break;
    case TWO_PLANES:
        classify(s, TWO_PLANES, labels, end);
        break;
    case THREE_PLANES:
        classify(s, THREE_PLANES, labels, end);
        break;
    case GRAY:
        classify(s, GRAY, labels, end);
        break;
    case OTHER:
        break;
    }
    if (done < count) {
        pel_row_classify_pairs(boxes, &rest, (uint16_t)(count - done), labels + done);
    }
}

/* ---- Runs ---------------------------------------------------------------------------------- */

/* Where the next run begins and the next one ends, and the label so far. As every run that begins
 * ends before the next one begins, begins and ends are written apart from each other. */
typedef struct run_writer {
    uint16_t *begin, *end;
    uint32_t label;
} run_writer;

/* The elements before those of a vector, the first of which is `before`; the last one takes its
 * place. */
INLINE uint8x16_t one_before(uint8x16_t labels, uint32_t *before)
{
    __asm__("vshlc %q0, %1, #8" : "+t"(labels), "+r"(*before));
    return labels;
}

/* Bit i: whether elements i differ. One compiler doubts that the upper half of a predicate in a
 * core register is 0, another does not know the name of the predicate. */
INLINE uint32_t different(uint8x16_t a, uint8x16_t b)
{
#if defined(__clang__)
    return vcmpneq_u8(a, b);
#else
    uint32_t bits;
    __asm__("vcmp.i8 ne, %q1, %q2\n\tvmrs %0, p0" : "=r"(bits) : "t"(a), "t"(b) : "p0");
    return bits;
#endif
}

/* Writes x + the places of the bits, to every second place. */
INLINE uint16_t *put_places(uint16_t *edge, uint32_t bits, uint32_t x)
{
    __asm__("rbit %0, %0" : "+r"(bits));
    while (bits != 0) {
        const uint32_t place = (uint32_t)__builtin_clz(bits);
        __asm__ volatile("strh %1, [%0], #4" : "+r"(edge) : "r"(x + place) : "memory");
        bits &= ~(UINT32_C(0x80000000) >> place);
    }
    return edge;
}

/* Finds the changes of the label in a block. */
INLINE run_writer scan_block(run_writer writer, const uint8_t *labels, uint32_t x)
{
    const uint8x16_t first = vld1q_u8(labels), second = vld1q_u8(labels + 16);
    const uint32_t before = writer.label != 0;
    const uint8x16_t before_first = one_before(first, &writer.label);
    const uint8x16_t before_second = one_before(second, &writer.label);
    const uint32_t changes = different(first, before_first) | different(second, before_second)
                                                                  << 16;

    if (changes != 0) {
        const uint8x16_t none = vdupq_n_u8(0);
        const uint32_t inside = different(first, none) | different(second, none) << 16;
        writer.begin = put_places(writer.begin, changes & inside, x);
        writer.end = put_places(writer.end, changes & (inside << 1 | before), x);
    }
    return writer;
}

/* The last labels of a row, one by one, and its end. */
static run_writer find_runs_by_label(run_writer writer, const uint8_t *labels, unsigned x,
                                     unsigned count)
{
    for (; x <= count; x++) {
        const uint32_t label = x == count ? 0 : labels[x];
        if (label != writer.label) {
            *writer.begin = (uint16_t)x;
            *writer.end = (uint16_t)x;
            writer.begin += label != 0 ? 2 : 0;
            writer.end += writer.label != 0 ? 2 : 0;
            writer.label = label;
        }
    }
    return writer;
}

uint16_t pel_row_find_runs_mve(const uint8_t *labels, uint16_t count, uint16_t *edges)
{
    const unsigned done = count - count % (unsigned)BLOCK;
    run_writer writer = {edges, edges + 1, 0};

    for (unsigned x = 0; x < done; x += BLOCK) {
        writer = scan_block(writer, labels + x, x);
    }
    writer = find_runs_by_label(writer, labels, done, count);
    return (uint16_t)((size_t)(writer.begin - edges) / 2);
}

/*
 * From packed pixels to runs, in assembly: compilers keep too much in memory here. Most blocks are
 * background and told by their chroma alone. The others are labelled, and their changes looked for
 * in the labels; at most of these a run begins or ends, and one edge is written, but where labels
 * meet there are two.
 *
 *     r0   pixels                               r7   label so far
 *     r1   masks of Y                           r8   changes of the label, the first on top
 *     r2   masks of the first chroma byte       r9   end of the labels
 *     r3   masks of the second one              r10  the top bit
 *     r4   labels of the block, or its place    r11  bits, r12 too
 *     r5   labels of masks                      lr   blocks that are left
 *     r6   place of the next edge               [sp] r5, first edge, how many pixels
 *     q0 to q3  the bytes of the pixels         q4 to q6  masks, and labels one pixel before
 */

/* clang-format off */

#define ENTER \
    ".syntax unified; push {r4-r11, lr}; vpush {d8-d13}; add r9, r2, r1; mov r6, r3;" \
    "lsr lr, r1, #5; mov r10, r1; ldm r0, {r0, r1, r2, r3};" \
    "movw r5, #:lower16:pel_row_label_of_mask; movt r5, #:upper16:pel_row_label_of_mask;" \
    "movs r7, #0; push {r5, r6, r10}; mov r10, #0x80000000;"

#define NEXT_BLOCK(c, d) \
    "1: vld40.8 {q0, q1, q2, q3}, [r0]; vld41.8 {q0, q1, q2, q3}, [r0];" \
    "vld42.8 {q0, q1, q2, q3}, [r0]; vld43.8 {q0, q1, q2, q3}, [r0]!;" \
    "vldrb.u8 q4, [r2, " c "]; vldrb.u8 q5, [r3, " d "]; vand q4, q4, q5;" \
    "vaddv.u8 r12, q4; orrs r12, r7; beq 8f;"

#define LABEL_BLOCK(left, right) \
    "vldrb.u8 q5, [r1, " left "]; vldrb.u8 q6, [r1, " right "]; vand q5, q5, q4; vand q6, q6, q4;" \
    "vldrb.u8 q0, [r5, q5]; vldrb.u8 q1, [r5, q6]; sub r4, r9, lr, lsl #5;" \
    "vst20.8 {q0, q1}, [r4]; vst21.8 {q0, q1}, [r4]; vldrb.u8 q2, [r4]; vldrb.u8 q3, [r4, #16];"

/* r12: the label before the block; r8: bit i where pixel i differs from the one before. */
#define CHANGES \
    "mov r12, r7; vmov q5, q2; vshlc q5, r7, #8; vmov q6, q3; vshlc q6, r7, #8;" \
    "vcmp.i8 ne, q2, q5; vmrs r8, p0; vcmp.i8 ne, q3, q6; vmrs r11, p0;" \
    "orrs r8, r8, r11, lsl #16; beq 8f;"

/* r11: those of them where labels meet, that is, with a label before and behind. */
#define MEETINGS \
    "vcmp.i8 ne, q2, zr; vmrs r11, p0; vcmp.i8 ne, q3, zr; vmrs r4, p0;" \
    "orr r11, r11, r4, lsl #16; cmp r12, #1; adc r12, r11, r11; and r11, r11, r12;" \
    "ldr r4, [sp, #8]; sub r4, r4, lr, lsl #5; ands r11, r8; rbit r8, r8; bne 3f;"

#define PUT_EDGES \
    "2: clz r11, r8; add r12, r4, r11; strh r12, [r6], #2; lsr r11, r10, r11; bics r8, r11;" \
    "bne 2b; le lr, 1b; b 9f;" \
    "3: rbit r11, r11;" \
    "4: clz r12, r8; add r5, r4, r12; strh r5, [r6], #2; lsr r12, r10, r12;" \
    "tst r11, r12; it ne; strhne r5, [r6], #2; bics r8, r12; bne 4b; ldr r5, [sp];"

/* A run that is open ends behind the last pixel. */
#define LEAVE \
    "9: pop {r4, r5, r10}; cbz r7, 5f; strh r10, [r6], #2;" \
    "5: vpop {d8-d13}; subs r0, r6, r5; lsrs r0, r0, #2; pop {r4-r11, pc};"

#define FIND_RUNS(left, right, c, d) \
    __asm__(ENTER "wls lr, lr, 9f;" NEXT_BLOCK(c, d) LABEL_BLOCK(left, right) \
            CHANGES MEETINGS PUT_EDGES "8: le lr, 1b;" LEAVE)

/* clang-format on */

#define NAKED __attribute__((naked, noinline))
#define UNUSED __attribute__((unused))

NAKED uint16_t pel_row_runs_y_first_mve(UNUSED const pel_row_packed *row, UNUSED uint16_t count,
                                        UNUSED uint8_t *labels, UNUSED uint16_t *edges)
{
    FIND_RUNS("q0", "q2", "q1", "q3");
}

NAKED uint16_t pel_row_runs_y_second_mve(UNUSED const pel_row_packed *row, UNUSED uint16_t count,
                                         UNUSED uint8_t *labels, UNUSED uint16_t *edges)
{
    FIND_RUNS("q1", "q3", "q0", "q2");
}

uint16_t pel_row_classify_any_runs_mve(const pel_row_boxes *boxes, const pel_row_pairs *src,
                                       uint16_t count, uint8_t *labels, uint16_t *edges)
{
    const uint16_t done = (uint16_t)(count - count % BLOCK);
    const pel_row_pairs rest = rest_of(src, done);
    run_writer writer = {edges, edges + 1, 0};
    uint16_t *next;

    if (src->y_step != 2) {
        pel_row_classify_pairs_mve(boxes, src, count, labels);
        return pel_row_find_runs_mve(labels, count, edges);
    }
    if (done != 0) {
        next = edges + 2 * (size_t)pel_row_runs_of_blocks_mve(boxes, src, done, labels, edges);
        writer.begin = next;
        writer.end = next + 1;
        if (next != edges && next[-1] == done) { /* it may go on */
            writer.label = labels[next[-2]];
            writer.end = next - 1;
        }
    }
    pel_row_classify_pairs(boxes, &rest, (uint16_t)(count - done), labels + done);
    writer = find_runs_by_label(writer, labels, done, count);
    return (uint16_t)((size_t)(writer.begin - edges) / 2);
}

#else
typedef int nothing_here; /* an empty file is no C */
#endif
