/*
 * Row kernels of neighbourhoods for the DSP instructions of Armv7E-M and Armv8-M: four pixels of a
 * row are a word, and its even and its odd bytes two lanes of 16 bits each. Elsewhere this file is
 * empty, unless PEL_ROW_DSP_EMULATED asks for the same in plain C: for tests.
 *
 * A step takes in the columns x + 1 .. x + 4, of which `even` holds the first and third and `odd`
 * the second and fourth, and yields the results x .. x + 3: those at x and x + 2 lie in lanes
 * before those at x + 1 and x + 3. Of the step before only the upper lanes count, its last two
 * columns. So nothing is read beyond the column x + 4, which is at most `count`.
 */
#include "row/row_filter_dsp.h"

#if PEL_ROW_DSP

#include "row/row_filter.h"

#define LANES UINT32_C(0x00FF00FF)

#ifdef PEL_ROW_DSP_EMULATED

static uint32_t lane_u(uint32_t lanes, unsigned lane)
{
    return lanes >> 16 * lane & 0xFFFFu;
}

/* In each lane a - b, but not below 0. */
static uint32_t subtract_to_zero(uint32_t a, uint32_t b)
{
    uint32_t lanes = 0;

    for (unsigned i = 0; i < 2; i++) {
        const uint32_t x = lane_u(a, i), y = lane_u(b, i);
        lanes |= (x < y ? 0 : x - y) << 16 * i;
    }
    return lanes;
}

/* To `sum` the product of a lane that holds a pixel and of a half that holds a factor. */
static int32_t add_product(uint32_t lane, uint32_t factor, int32_t sum)
{
    return sum + (int32_t)lane * (factor > 0x7FFF ? (int32_t)factor - 0x10000 : (int32_t)factor);
}

static int32_t add_low_low(uint32_t lanes, uint32_t factors, int32_t sum)
{
    return add_product(lane_u(lanes, 0), lane_u(factors, 0), sum);
}

static int32_t add_low_high(uint32_t lanes, uint32_t factors, int32_t sum)
{
    return add_product(lane_u(lanes, 0), lane_u(factors, 1), sum);
}

static int32_t add_high_low(uint32_t lanes, uint32_t factors, int32_t sum)
{
    return add_product(lane_u(lanes, 1), lane_u(factors, 0), sum);
}

static int32_t add_high_high(uint32_t lanes, uint32_t factors, int32_t sum)
{
    return add_product(lane_u(lanes, 1), lane_u(factors, 1), sum);
}

static int32_t add_products(uint32_t lanes, uint32_t factors, int32_t sum)
{
    return add_high_high(lanes, factors, add_low_low(lanes, factors, sum));
}

/* To each lane the lower byte of the same half of a word. */
static uint32_t add_low_bytes(uint32_t lanes, uint32_t word)
{
    return lanes + (word & LANES);
}

/* In each lane a + b, but not above 65535. */
static uint32_t add_to_top(uint32_t a, uint32_t b)
{
    uint32_t lanes = 0;

    for (unsigned i = 0; i < 2; i++) {
        const uint32_t sum = lane_u(a, i) + lane_u(b, i);
        lanes |= (sum > 0xFFFF ? 0xFFFF : sum) << 16 * i;
    }
    return lanes;
}

#else

#include <arm_acle.h>

static inline uint32_t subtract_to_zero(uint32_t a, uint32_t b)
{
    return __uqsub16(a, b);
}

static inline uint32_t add_to_top(uint32_t a, uint32_t b)
{
    return __uqadd16(a, b);
}

static inline uint32_t add_low_bytes(uint32_t lanes, uint32_t word)
{
    return __uxtab16(lanes, word);
}

static inline int32_t add_products(uint32_t lanes, uint32_t factors, int32_t sum)
{
    return __smlad((int16x2_t)lanes, (int16x2_t)factors, sum);
}

static inline int32_t add_low_low(uint32_t lanes, uint32_t factors, int32_t sum)
{
    return __smlabb((int32_t)lanes, (int32_t)factors, sum);
}

static inline int32_t add_low_high(uint32_t lanes, uint32_t factors, int32_t sum)
{
    return __smlabt((int32_t)lanes, (int32_t)factors, sum);
}

static inline int32_t add_high_low(uint32_t lanes, uint32_t factors, int32_t sum)
{
    return __smlatb((int32_t)lanes, (int32_t)factors, sum);
}

static inline int32_t add_high_high(uint32_t lanes, uint32_t factors, int32_t sum)
{
    return __smlatt((int32_t)lanes, (int32_t)factors, sum);
}

#endif

/* Compilers make one load and one store of these. */
static inline uint32_t load4(const uint8_t *p)
{
    return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

static inline void store4(uint8_t *p, uint32_t word)
{
    p[0] = (uint8_t)word;
    p[1] = (uint8_t)(word >> 8);
    p[2] = (uint8_t)(word >> 16);
    p[3] = (uint8_t)(word >> 24);
}

void pel_row_copy_dsp(const uint8_t *restrict src, uint16_t count, uint8_t *restrict dst)
{
    const uint8_t *const end = src + (count & ~15u);

    while (src != end) {
        const uint32_t a = load4(src), b = load4(src + 4), c = load4(src + 8), d = load4(src + 12);
        store4(dst, a);
        store4(dst + 4, b);
        store4(dst + 8, c);
        store4(dst + 12, d);
        src += 16;
        dst += 16;
    }
    pel_row_copy(src, count & 15, dst);
}

/* The mask of a lane's lower byte, from memory: a compiler that sees a constant shifts and masks in
 * two instructions where one will do. */
static const volatile uint32_t low_bytes = LANES;

static inline uint32_t odd_of(uint32_t word, uint32_t mask)
{
    return word >> 8 & mask;
}

/* The lanes one pixel pair further to the left. */
static inline uint32_t shifted(uint32_t before, uint32_t lanes)
{
    return before >> 16 | lanes << 16;
}

/* Results, each limited to 255, as bytes: those of `first` at 0 and 2, of `second` at 1 and 3. What
 * has reached the top of its lane has 255 in its lower byte; the upper ones become 255 too. */
static inline uint32_t limited_bytes(uint32_t first, uint32_t second)
{
    return add_to_top(first, ~LANES) & (add_to_top(second, ~LANES) << 8 | 255);
}

/* The last count % 4 results of a row go the plain way. */
static int rest_of(const uint8_t *const rows[], uint16_t count, const uint8_t *rest[3])
{
    for (unsigned i = 0; i < 3; i++) {
        rest[i] = rows[i] + (count & ~3u);
    }
    return count & 3;
}

/* What is known of a pair of columns, by its lanes. */
typedef struct lanes2 {
    uint32_t even, odd;
} lanes2;

/* Where a step reads and writes. */
typedef struct places {
    const uint8_t *a, *b, *c;
    uint8_t *out;
} places;

static inline places first_places(const uint8_t *const rows[], uint8_t *out)
{
    places at;

    at.a = rows[0] + 1;
    at.b = rows[1] + 1;
    at.c = rows[2] + 1;
    at.out = out;
    return at;
}

static inline void advance(places *at)
{
    at->a += 4;
    at->b += 4;
    at->c += 4;
    at->out += 4;
}

/* ---- Gauss --------------------------------------------------------------------------------- */

/* The sums 1 2 1 of columns, at most 1020; those in even lanes have 4 more: every result takes two
 * of them, and that makes the half which the division by 16 needs. */
static inline lanes2 gauss_step(places *at, lanes2 before, uint32_t mask)
{
    const uint32_t a = load4(at->a), b = load4(at->b), c = load4(at->c);
    lanes2 sums;
    uint32_t even, odd, first, second;

    sums.even = add_low_bytes(add_low_bytes(UINT32_C(0x00040004), a), c) + 2 * (b & mask);
    sums.odd = odd_of(a, mask) + odd_of(c, mask) + 2 * odd_of(b, mask);
    even = shifted(before.even, sums.even);
    odd = shifted(before.odd, sums.odd);
    first = even + 2 * odd + sums.even;
    second = odd + 2 * sums.even + sums.odd;
    store4(at->out, (first >> 4 & mask) | (second << 4 & ~mask));
    advance(at);
    return sums;
}

static uint32_t gauss_column(const uint8_t *const rows[], int x)
{
    return rows[0][x] + 2u * rows[1][x] + rows[2][x];
}

void pel_row_gauss3_dsp(const uint8_t *const rows[], uint16_t count, uint8_t *restrict out)
{
    const uint8_t *const end = out + (count & ~3u), *rest[3];
    const uint32_t mask = low_bytes;
    places at = first_places(rows, out);
    lanes2 before;

    before.even = (gauss_column(rows, -1) + 4) << 16;
    before.odd = gauss_column(rows, 0) << 16;
    while (at.out != end) {
        before = gauss_step(&at, before, mask);
    }
    if (rest_of(rows, count, rest)) {
        pel_row_gauss3(rest, count & 3, at.out);
    }
}

/* ---- Gradients ----------------------------------------------------------------------------- */

/* Of columns: the sums 1 2 1, at most 1020, and the differences, lower less upper, plus 255. */
typedef struct sobel_lanes {
    lanes2 sum, difference;
} sobel_lanes;

static inline sobel_lanes sobel_columns(uint32_t a, uint32_t b, uint32_t c, uint32_t mask)
{
    const uint32_t upper_even = a & mask, upper_odd = odd_of(a, mask), lower_odd = odd_of(c, mask);
    sobel_lanes columns;

    columns.sum.even = add_low_bytes(upper_even, c) + 2 * (b & mask);
    columns.sum.odd = upper_odd + lower_odd + 2 * odd_of(b, mask);
    columns.difference.even = add_low_bytes(mask, c) - upper_even;
    columns.difference.odd = lower_odd + mask - upper_odd;
    return columns;
}

/* |right - left| + |down - 1020|; all at most 2040. */
static inline uint32_t sizes(uint32_t left, uint32_t right, uint32_t down)
{
    const uint32_t middle = UINT32_C(1020) * 0x00010001;

    return subtract_to_zero(left, right) + subtract_to_zero(right, left) +
           subtract_to_zero(middle, down) + subtract_to_zero(down, middle);
}

static inline sobel_lanes sobel_step(places *at, sobel_lanes before, uint32_t mask)
{
    const sobel_lanes now = sobel_columns(load4(at->a), load4(at->b), load4(at->c), mask);
    const lanes2 sum = now.sum, difference = now.difference;
    const uint32_t even = shifted(before.sum.even, sum.even);
    const uint32_t odd = shifted(before.sum.odd, sum.odd);
    const uint32_t two = shifted(before.difference.even + 2 * before.difference.odd,
                                 difference.even + 2 * difference.odd);
    const uint32_t one = shifted(before.difference.odd, difference.odd);
    const uint32_t first = sizes(even, sum.even, two + difference.even);
    const uint32_t second = sizes(odd, sum.odd, one + 2 * difference.even + difference.odd);

    store4(at->out, limited_bytes(first, second));
    advance(at);
    return now;
}

void pel_row_gradient_abs_dsp(const uint8_t *const rows[], uint16_t count, uint8_t *restrict out)
{
    const uint8_t *const end = out + (count & ~3u), *rest[3];
    const uint32_t mask = low_bytes;
    places at = first_places(rows, out);
    sobel_lanes before;

    before.sum.even = gauss_column(rows, -1) << 16;
    before.sum.odd = gauss_column(rows, 0) << 16;
    before.difference.even = (rows[2][-1] + 255u - rows[0][-1]) << 16;
    before.difference.odd = (rows[2][0] + 255u - rows[0][0]) << 16;
    while (at.out != end) {
        before = sobel_step(&at, before, mask);
    }
    if (rest_of(rows, count, rest)) {
        pel_row_gradient_abs(rest, count & 3, at.out);
    }
}

/* ---- Kernels ------------------------------------------------------------------------------- */

/* Taps as products of two pixels take them: the outer two of each row, and the middle ones. */
typedef struct tap_pairs {
    uint32_t outer[3];
    uint32_t upper_and_own, lower;
} tap_pairs;

static uint32_t pair_of(int8_t low, int8_t high)
{
    return ((uint32_t)low & 0xFFFFu) | (uint32_t)high << 16;
}

static tap_pairs pairs_of(const int8_t *tap)
{
    tap_pairs pairs;

    for (unsigned i = 0; i < 3; i++) {
        pairs.outer[i] = pair_of(tap[3 * i], tap[3 * i + 2]);
    }
    pairs.upper_and_own = pair_of(tap[1], tap[4]);
    pairs.lower = pair_of(tap[7], 0);
    return pairs;
}

static inline int32_t limited(int32_t value)
{
    return value < 0 ? 0 : value > 255 ? 255 : value;
}

/* Two results at a time: with more the registers run out. sum + start lies within 2^30 + 2^20; >>
 * keeps the sign with every compiler for these machines. */
static void kernel3_shifted(const uint8_t *const rows[], const int8_t *tap, int32_t start,
                            unsigned shift, uint16_t count, uint8_t *restrict out)
{
    const uint8_t *a = rows[0] - 1, *b = rows[1] - 1, *c = rows[2] - 1, *const end = out + count;
    const uint32_t mask = low_bytes;
    const tap_pairs taps = pairs_of(tap);

    while (out != end) {
        uint32_t word = load4(a), even = word & mask, odd = odd_of(word, mask);
        int32_t first = add_products(even, taps.outer[0], start);
        int32_t second = add_products(odd, taps.outer[0], start);
        first = add_low_low(odd, taps.upper_and_own, first);
        second = add_high_low(even, taps.upper_and_own, second);
        word = load4(b);
        even = word & mask;
        odd = odd_of(word, mask);
        first = add_products(even, taps.outer[1], first);
        second = add_products(odd, taps.outer[1], second);
        first = add_low_high(odd, taps.upper_and_own, first);
        second = add_high_high(even, taps.upper_and_own, second);
        word = load4(c);
        even = word & mask;
        odd = odd_of(word, mask);
        first = add_products(even, taps.outer[2], first);
        second = add_products(odd, taps.outer[2], second);
        first = add_low_low(odd, taps.lower, first);
        second = add_high_low(even, taps.lower, second);
        out[0] = (uint8_t)limited(first >> shift);
        out[1] = (uint8_t)limited(second >> shift);
        out += 2;
        a += 2;
        b += 2;
        c += 2;
    }
}

void pel_row_kernel3_dsp(const uint8_t *const rows[], const int8_t *tap, const pel_row_scale *scale,
                         uint16_t count, uint8_t *restrict out)
{
    const int32_t half = scale->shift == 0 ? 0 : (int32_t)1 << (scale->shift - 1);
    const int32_t bias = scale->bias + (int32_t)(scale->start >> scale->shift);
    const uint16_t even = count & 0xFFFEu;

    if (scale->divisor != 0 || scale->flip != 0) {
        pel_row_kernel3(rows, tap, scale, count, out);
        return;
    }
    kernel3_shifted(rows, tap, bias * ((int32_t)1 << scale->shift) + half, scale->shift, even, out);
    if (count != even) {
        const uint8_t *const rest[3] = {rows[0] + even, rows[1] + even, rows[2] + even};
        pel_row_kernel3(rest, tap, scale, 1, out + even);
    }
}

#endif
