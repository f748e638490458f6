/*
 * Row kernels of neighbourhoods for Helium (MVE): 8 results of 16 bits or 16 of 8 bits at a time.
 * Elsewhere this file is empty.
 *
 * Most take in the columns x + 1 .. x + LANES and yield the results x .. x + LANES - 1; what they
 * need of the columns before stays from step to step in a core register, from which an instruction
 * shifts it into a vector. What does not fill the last vector is done twice.
 */
#include "row/row_filter_mve.h"

#include "row/row_filter_mve_lanes.h"

#if PEL_ROW_MVE

#define INLINE __attribute__((always_inline)) static inline

/*
 * The kernel of a name from its function for whole vectors, `name`(rows, count, out); rows of less
 * than one are for the plain version.
 */
#define KERNEL(name, radius, pixel, lanes)                                                         \
    void pel_row_##name##_mve(const uint8_t *const rows[], uint16_t count, pixel *out)             \
    {                                                                                              \
        const unsigned rest = count % (unsigned)(lanes), last = count - (unsigned)(lanes);         \
        if (count < (lanes)) {                                                                     \
            pel_row_##name(rows, count, out);                                                      \
            return;                                                                                \
        }                                                                                          \
        name(rows, count - rest, out);                                                             \
        if (rest != 0) {                                                                           \
            const window at_last = window_at(rows, radius, last);                                  \
            name(at_last.rows, lanes, out + last);                                                 \
        }                                                                                          \
    }

/* The lanes before those of a vector, the first of which is `before`; the last one takes its
 * place. */
INLINE uint16x8_t word_before(uint16x8_t lanes, uint32_t *before)
{
    __asm__("vshlc %q0, %1, #16" : "+t"(lanes), "+r"(*before));
    return lanes;
}

/* Two lanes before, likewise; of the two in `before` the upper half is the nearer one. */
INLINE uint16x8_t two_words_before(uint16x8_t lanes, uint32_t *before)
{
    __asm__("vshlc %q0, %1, #32" : "+t"(lanes), "+r"(*before));
    return lanes;
}

INLINE uint8x16_t byte_before(uint8x16_t lanes, uint32_t *before)
{
    __asm__("vshlc %q0, %1, #8" : "+t"(lanes), "+r"(*before));
    return lanes;
}

/* Of each lane the sum with the one before. */
INLINE uint16x8_t with_before(uint16x8_t lanes, uint32_t *before)
{
    return vaddq_u16(lanes, word_before(lanes, before));
}

void pel_row_copy_mve(const uint8_t *restrict src, uint16_t count, uint8_t *restrict dst)
{
    for (unsigned left = count / (4u * BYTES); left != 0; left--) {
        __asm__ volatile("vldrb.8 q0, [%0], #16\n\tvldrb.8 q1, [%0], #16\n\t"
                         "vldrb.8 q2, [%0], #16\n\tvldrb.8 q3, [%0], #16\n\t"
                         "vstrb.8 q0, [%1], #16\n\tvstrb.8 q1, [%1], #16\n\t"
                         "vstrb.8 q2, [%1], #16\n\tvstrb.8 q3, [%1], #16"
                         : "+r"(src), "+r"(dst)
                         :
                         : "q0", "q1", "q2", "q3", "memory");
    }
    if ((count & 63) != 0) {
        pel_row_copy(src, count & 63, dst);
    }
}

/* ---- Weighted sums ------------------------------------------------------------------------- */

/* At most 1020. */
INLINE uint16x8_t sums_121(const uint8_t *a, const uint8_t *b, const uint8_t *c)
{
    return vmlaq_n_u16(vaddq_u16(vldrbq_u16(a), vldrbq_u16(c)), vldrbq_u16(b), 2);
}

static uint32_t sum_121(const uint8_t *const rows[], int x)
{
    return rows[0][x] + 2u * rows[1][x] + rows[2][x];
}

/*
 * Two pixels to a lane. Of the columns x + 1 + 2 j and x + 2 + 2 j, in the lower and the upper byte
 * of lane j, the sums of the second come from upper bytes, those of the first from what these leave
 * of the sums of whole lanes, modulo 2^16. A result is a pair of columns and the next pair.
 */
static void gauss3(const uint8_t *const rows[], unsigned count, uint8_t *restrict out)
{
    const uint8_t *a = rows[0] + 1, *b = rows[1] + 1, *c = rows[2] + 1;
    uint32_t column = sum_121(rows, 0), pair = sum_121(rows, -1) + column;

    for (unsigned left = count / BYTES; left != 0; left--) {
        const uint8x16_t p = vld1q_u8(a), q = vld1q_u8(b), r = vld1q_u8(c);
        const uint16x8_t upper = vaddq_u16(vmovltq_u8(p), vmovltq_u8(r));
        const uint16x8_t second = vmlaq_n_u16(upper, vmovltq_u8(q), 2);
        const uint16x8_t both = vaddq_u16(vreinterpretq_u16_u8(p), vreinterpretq_u16_u8(r));
        const uint16x8_t twice = vmlaq_n_u16(both, vreinterpretq_u16_u8(q), 2);
        const uint16x8_t first = vmlaq_n_u16(twice, second, 0xFF00); /* -256 */
        const uint16x8_t pair0 = vaddq_u16(first, word_before(second, &column));
        const uint16x8_t pair1 = vaddq_u16(first, second);
        const uint16x8_t even = vaddq_u16(word_before(pair1, &pair), pair0);
        const uint16x8_t odd = vaddq_u16(pair0, pair1);
        const uint8x16_t low = vrshrnbq_n_u16(vreinterpretq_u8_u16(pair0), even, 4);
        vst1q_u8(out, vrshrntq_n_u16(low, odd, 4));
        a += BYTES;
        b += BYTES;
        c += BYTES;
        out += BYTES;
    }
}
KERNEL(gauss3, 1, uint8_t, BYTES)

/* n / 9 is n * 7282 >> 16 for all n up to 2299. */
static void box3(const uint8_t *const rows[], unsigned count, uint8_t *restrict out)
{
    const uint8_t *a = rows[0] + 1, *b = rows[1] + 1, *c = rows[2] + 1;
    const uint16x8_t ninth = vdupq_n_u16(7282);
    uint32_t sum = 0u + a[-1] + b[-1] + c[-1];
    uint32_t two = sum << 16 | (0u + a[-2] + b[-2] + c[-2]);

    for (unsigned left = count / WORDS; left != 0; left--) {
        const uint16x8_t s = vaddq_u16(vaddq_u16(vldrbq_u16(a), vldrbq_u16(c)), vldrbq_u16(b));
        const uint16x8_t nine = vaddq_u16(with_before(s, &sum), two_words_before(s, &two));
        vstrbq_u16(out, vmulhq_u16(vaddq_n_u16(nine, 4), ninth));
        a += WORDS;
        b += WORDS;
        c += WORDS;
        out += WORDS;
    }
}
KERNEL(box3, 1, uint8_t, WORDS)

/* 1 4 6 4 1 is 1 1 four times over. Sums: 4080 of a column, 8160, 16320, 32640, 65280. */
static uint32_t sum_14641(const uint8_t *const rows[], int x)
{
    return rows[0][x] + 4u * (rows[1][x] + rows[3][x]) + 6u * rows[2][x] + rows[4][x];
}

static void binomial5(const uint8_t *const rows[], unsigned count, uint8_t *restrict out)
{
    const uint8_t *a = rows[0] + 2, *b = rows[1] + 2, *c = rows[2] + 2;
    const uint8_t *d = rows[3] + 2, *e = rows[4] + 2;
    const uint32_t s2 = sum_14641(rows, -2), s1 = sum_14641(rows, -1);
    const uint32_t s0 = sum_14641(rows, 0);
    uint32_t one = sum_14641(rows, 1), two = one + s0, three = two + s0 + s1;
    uint32_t four = three + s0 + 2 * s1 + s2;

    for (unsigned left = count / WORDS; left != 0; left--) {
        const uint16x8_t outer = vaddq_u16(vldrbq_u16(a), vldrbq_u16(e));
        const uint16x8_t inner = vaddq_u16(vldrbq_u16(b), vldrbq_u16(d));
        const uint16x8_t s = vmlaq_n_u16(vmlaq_n_u16(outer, inner, 4), vldrbq_u16(c), 6);
        const uint16x8_t pairs = with_before(with_before(s, &one), &two);
        vstrbq_u16(out, vrshrq_n_u16(with_before(with_before(pairs, &three), &four), 8));
        a += WORDS;
        b += WORDS;
        c += WORDS;
        d += WORDS;
        e += WORDS;
        out += WORDS;
    }
}
KERNEL(binomial5, 2, uint8_t, WORDS)

/* ---- Gradients ----------------------------------------------------------------------------- */

/* Differences of columns, lower less upper, modulo 2^16. */
static uint32_t difference(const uint8_t *const rows[], int x)
{
    return ((uint32_t)rows[2][x] - rows[0][x]) & 0xFFFF;
}

/* What is known of the columns before, in lanes of 16 bits. */
typedef struct columns {
    uint32_t sums;             /* two, the nearer one above */
    uint32_t difference, pair; /* pair: of differences */
} columns;

INLINE columns columns_before(const uint8_t *const rows[])
{
    columns before;

    before.sums = sum_121(rows, 0) << 16 | sum_121(rows, -1);
    before.difference = difference(rows, 0);
    before.pair = (before.difference + difference(rows, -1)) & 0xFFFF;
    return before;
}

/* 1 2 1 of differences: pairs of pairs. */
INLINE int16x8_t gradient_y(uint16x8_t differences, columns *before)
{
    return with_sign(with_before(with_before(differences, &before->difference), &before->pair));
}

static void sobel_x(const uint8_t *const rows[], unsigned count, int16_t *restrict out)
{
    const uint8_t *a = rows[0] + 1, *b = rows[1] + 1, *c = rows[2] + 1;
    columns before = columns_before(rows);

    for (unsigned left = count / WORDS; left != 0; left--) {
        const uint16x8_t sums = sums_121(a, b, c);
        vst1q_s16(out, with_sign(vsubq_u16(sums, two_words_before(sums, &before.sums))));
        a += WORDS;
        b += WORDS;
        c += WORDS;
        out += WORDS;
    }
}
KERNEL(sobel_x, 1, int16_t, WORDS)

static void sobel_y(const uint8_t *const rows[], unsigned count, int16_t *restrict out)
{
    const uint8_t *a = rows[0] + 1, *c = rows[2] + 1;
    columns before = columns_before(rows);

    for (unsigned left = count / WORDS; left != 0; left--) {
        vst1q_s16(out, gradient_y(vsubq_u16(vldrbq_u16(c), vldrbq_u16(a)), &before));
        a += WORDS;
        c += WORDS;
        out += WORDS;
    }
}
KERNEL(sobel_y, 1, int16_t, WORDS)

/* |gx| + |gy| at the columns before a, b, c. */
INLINE uint16x8_t gradient_sizes(const uint8_t *a, const uint8_t *b, const uint8_t *c,
                                 columns *before)
{
    const uint16x8_t upper = vldrbq_u16(a), lower = vldrbq_u16(c);
    const uint16x8_t sums = vmlaq_n_u16(vaddq_u16(upper, lower), vldrbq_u16(b), 2);
    const uint16x8_t gx = vabdq_u16(sums, two_words_before(sums, &before->sums));
    const int16x8_t gy = gradient_y(vsubq_u16(lower, upper), before);

    return vaddq_u16(gx, without_sign(vabsq_s16(gy)));
}

static void gradient_abs(const uint8_t *const rows[], unsigned count, uint8_t *restrict out)
{
    const uint8_t *a = rows[0] + 1, *b = rows[1] + 1, *c = rows[2] + 1;
    const uint16x8_t most = vdupq_n_u16(255);
    columns before = columns_before(rows);

    for (unsigned left = count / WORDS; left != 0; left--) {
        vstrbq_u16(out, vminq_u16(gradient_sizes(a, b, c, &before), most));
        a += WORDS;
        b += WORDS;
        c += WORDS;
        out += WORDS;
    }
}
KERNEL(gradient_abs, 1, uint8_t, WORDS)

static void gradient_abs_s16(const uint8_t *const rows[], unsigned count, int16_t *restrict out)
{
    const uint8_t *a = rows[0] + 1, *b = rows[1] + 1, *c = rows[2] + 1;
    columns before = columns_before(rows);

    for (unsigned left = count / WORDS; left != 0; left--) {
        vst1q_s16(out, with_sign(gradient_sizes(a, b, c, &before)));
        a += WORDS;
        b += WORDS;
        c += WORDS;
        out += WORDS;
    }
}
KERNEL(gradient_abs_s16, 1, int16_t, WORDS)

/* ---- Order --------------------------------------------------------------------------------- */

/* The column before one, and the column before that, as byte_before takes them. */
typedef struct bytes_before {
    uint32_t near, far;
} bytes_before;

/* Of each lane and the two before it. */
#define OF_THREE(name, pick)                                                                       \
    INLINE uint8x16_t name(uint8x16_t here, bytes_before *before)                                  \
    {                                                                                              \
        const uint8x16_t near = byte_before(here, &before->near);                                  \
        return pick(pick(here, near), byte_before(near, &before->far));                            \
    }
OF_THREE(smallest_of_three, vminq_u8)
OF_THREE(largest_of_three, vmaxq_u8)

INLINE uint8x16_t middle_of(uint8x16_t a, uint8x16_t b, uint8x16_t c)
{
    return vmaxq_u8(vminq_u8(a, b), vminq_u8(vmaxq_u8(a, b), c));
}

INLINE uint8x16_t middle_of_three(uint8x16_t here, bytes_before *before)
{
    const uint8x16_t near = byte_before(here, &before->near);
    return middle_of(here, near, byte_before(near, &before->far));
}

/* The three of a column in order. */
static void sort_column(const uint8_t *const rows[], int x, uint8_t sorted[3])
{
    for (unsigned i = 0; i < 3; i++) {
        unsigned place = i;
        for (; place > 0 && sorted[place - 1] > rows[i][x]; place--) {
            sorted[place] = sorted[place - 1];
        }
        sorted[place] = rows[i][x];
    }
}

/* The columns 0 and -1, the place-th in order of each. */
static bytes_before ordered_before(const uint8_t *const rows[], unsigned place)
{
    uint8_t near[3], far[3];
    bytes_before before;

    sort_column(rows, 0, near);
    sort_column(rows, -1, far);
    before.near = near[place];
    before.far = far[place];
    return before;
}

static void min3(const uint8_t *const rows[], unsigned count, uint8_t *restrict out)
{
    const uint8_t *a = rows[0] + 1, *b = rows[1] + 1, *c = rows[2] + 1;
    bytes_before before = ordered_before(rows, 0);

    for (unsigned left = count / BYTES; left != 0; left--) {
        const uint8x16_t low = vminq_u8(vminq_u8(vld1q_u8(a), vld1q_u8(b)), vld1q_u8(c));
        vst1q_u8(out, smallest_of_three(low, &before));
        a += BYTES;
        b += BYTES;
        c += BYTES;
        out += BYTES;
    }
}
KERNEL(min3, 1, uint8_t, BYTES)

static void max3(const uint8_t *const rows[], unsigned count, uint8_t *restrict out)
{
    const uint8_t *a = rows[0] + 1, *b = rows[1] + 1, *c = rows[2] + 1;
    bytes_before before = ordered_before(rows, 2);

    for (unsigned left = count / BYTES; left != 0; left--) {
        const uint8x16_t high = vmaxq_u8(vmaxq_u8(vld1q_u8(a), vld1q_u8(b)), vld1q_u8(c));
        vst1q_u8(out, largest_of_three(high, &before));
        a += BYTES;
        b += BYTES;
        c += BYTES;
        out += BYTES;
    }
}
KERNEL(max3, 1, uint8_t, BYTES)

/* As in plain C: the largest low, the middle middle and the smallest high of the columns. */
static void median3(const uint8_t *const rows[], unsigned count, uint8_t *restrict out)
{
    const uint8_t *a = rows[0] + 1, *b = rows[1] + 1, *c = rows[2] + 1;
    bytes_before lows = ordered_before(rows, 0);
    bytes_before middles = ordered_before(rows, 1);
    bytes_before highs = ordered_before(rows, 2);

    for (unsigned left = count / BYTES; left != 0; left--) {
        const uint8x16_t p = vld1q_u8(a), q = vld1q_u8(b), third = vld1q_u8(c);
        const uint8x16_t smaller = vminq_u8(p, q), larger = vmaxq_u8(p, q);
        const uint8x16_t low = largest_of_three(vminq_u8(smaller, third), &lows);
        const uint8x16_t high = smallest_of_three(vmaxq_u8(larger, third), &highs);
        const uint8x16_t middle = vmaxq_u8(smaller, vminq_u8(larger, third));
        vst1q_u8(out, middle_of(low, high, middle_of_three(middle, &middles)));
        a += BYTES;
        b += BYTES;
        c += BYTES;
        out += BYTES;
    }
}
KERNEL(median3, 1, uint8_t, BYTES)

/* ---- Labels -------------------------------------------------------------------------------- */

/* 0 where a lane is 0, else 1. */
INLINE uint8x16_t is_set(uint8x16_t lanes)
{
    return vminq_u8(lanes, vdupq_n_u8(1));
}

/* Nine labels are equal where the smallest is the largest. */
static void erode_labels3(const uint8_t *const rows[], unsigned count, uint8_t *restrict out)
{
    const uint8_t *a = rows[0] + 1, *b = rows[1] + 1, *c = rows[2] + 1;
    bytes_before lows = ordered_before(rows, 0);
    bytes_before highs = ordered_before(rows, 2);

    for (unsigned left = count / BYTES; left != 0; left--) {
        const uint8x16_t p = vld1q_u8(a), q = vld1q_u8(b), third = vld1q_u8(c);
        const uint8x16_t low = smallest_of_three(vminq_u8(vminq_u8(p, q), third), &lows);
        const uint8x16_t high = largest_of_three(vmaxq_u8(vmaxq_u8(p, q), third), &highs);
        const uint8x16_t equal = vsubq_n_u8(is_set(vsubq_u8(high, low)), 1); /* 255 or 0 */
        vst1q_u8(out, vandq_u8(low, equal));
        a += BYTES;
        b += BYTES;
        c += BYTES;
        out += BYTES;
    }
}
KERNEL(erode_labels3, 1, uint8_t, BYTES)

/* With 1 less 0 is the largest, so that the smallest one is the smallest label. */
static void dilate_labels3(const uint8_t *const rows[], unsigned count, uint8_t *restrict out)
{
    const uint8_t *a = rows[0] + 1, *b = rows[1] + 1, *c = rows[2] + 1;
    bytes_before before = {255, 255};

    for (unsigned i = 0; i < 3; i++) {
        const uint8_t near = (uint8_t)(rows[i][0] - 1), far = (uint8_t)(rows[i][-1] - 1);
        before.near = near < before.near ? near : before.near;
        before.far = far < before.far ? far : before.far;
    }
    for (unsigned left = count / BYTES; left != 0; left--) {
        const uint8x16_t own = vld1q_u8(b - 1);
        const uint8x16_t p = vsubq_n_u8(vld1q_u8(a), 1), q = vsubq_n_u8(vld1q_u8(b), 1);
        const uint8x16_t low = vminq_u8(vminq_u8(p, q), vsubq_n_u8(vld1q_u8(c), 1));
        const uint8x16_t label = vaddq_n_u8(smallest_of_three(low, &before), 1);
        const uint8x16_t none = vsubq_n_u8(is_set(own), 1); /* 255 or 0 */
        vst1q_u8(out, vorrq_u8(own, vandq_u8(label, none)));
        a += BYTES;
        b += BYTES;
        c += BYTES;
        out += BYTES;
    }
}
KERNEL(dilate_labels3, 1, uint8_t, BYTES)

#else
typedef int nothing_here; /* an empty file is no C */
#endif
