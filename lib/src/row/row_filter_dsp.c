/*
 * Row kernels of neighbourhoods for the DSP instructions of Armv7E-M and Armv8-M: four pixels of a
 * row are a word, and its even and its odd bytes two lanes of 16 bits each. Elsewhere this file is
 * empty, unless PEL_ROW_DSP_EMULATED asks for the same in plain C: for tests.
 *
 * A step takes in the columns x + 1 .. x + 4 and yields the results x .. x + 3, so that nothing is
 * read beyond the column x + 4, which is at most `count`. Lanes are called by the columns that they
 * hold, lower one first. Those that the next step needs are kept swapped, 31 for the columns x + 1
 * and x + 3: then the lower lane is the one to the left of the next step's, one instruction pairs
 * it with the upper lane of that, and additions turn the lanes back on their way.
 */
#include "row/row_filter_dsp.h"

#if PEL_ROW_DSP

#include "row/row_dsp.h"
#include "row/row_filter.h"

PEL_DSP void copy16(const uint8_t *src, uint8_t *dst)
{
    const uint32_t a = load4(src), b = load4(src + 4), c = load4(src + 8), d = load4(src + 12);

    store4(dst, a);
    store4(dst + 4, b);
    store4(dst + 8, c);
    store4(dst + 12, d);
}

void pel_row_copy_dsp(const uint8_t *restrict src, uint16_t count, uint8_t *restrict dst)
{
    const uint8_t *const end = src + (count & ~63u), *const end16 = src + (count & ~15u);

    while (src != end) {
        copy16(src, dst);
        copy16(src + 16, dst + 16);
        copy16(src + 32, dst + 32);
        copy16(src + 48, dst + 48);
        src = opaque(src + 64);
        dst += 64;
    }
    while (src != end16) {
        copy16(src, dst);
        src = opaque(src + 16);
        dst += 16;
    }
    for (unsigned i = 0; i < (count & 15u); i++) {
        dst[i] = src[i];
    }
}

/* The rows from column x on: what is left goes the plain way. */
static void find_rest(const uint8_t *const rows[], unsigned x, const uint8_t *rest[3])
{
    for (unsigned i = 0; i < 3; i++) {
        rest[i] = rows[i] + x;
    }
}

/* Where a step reads and writes. */
typedef struct places {
    const uint8_t *a, *b, *c;
    uint8_t *out;
} places;

/* x: the column to begin with. */
PEL_DSP places places_at(const uint8_t *const rows[], int x, uint8_t *out)
{
    places at;

    at.a = rows[0] + x;
    at.b = rows[1] + x;
    at.c = rows[2] + x;
    at.out = out;
    return at;
}

PEL_DSP uint32_t next4(const uint8_t **at)
{
    const uint32_t word = load4(*at);
    *at = opaque(*at + 4);
    return word;
}

PEL_DSP void put4(places *at, uint32_t word)
{
    store4(at->out, word);
    at->out = opaque_to_write(at->out + 4);
}

/* ---- Gauss --------------------------------------------------------------------------------- */

/* The sums 1 2 1 of columns, at most 1020; columns 3 and 1 have 4 more: every result takes two of
 * them, or one twice, and that makes the half which the division by 16 needs. */
typedef struct gauss_lanes {
    uint32_t c31, c42;
} gauss_lanes;

PEL_DSP gauss_lanes gauss_step(places *at, gauss_lanes before, uint32_t upper_bytes)
{
    const uint32_t a = next4(&at->a), b = next4(&at->b), c = next4(&at->c);
    gauss_lanes now;
    uint32_t c02, first, second;

    now.c31 = add_bytes_20(add_bytes_20(UINT32_C(0x00040004), a), c);
    now.c31 = add_bytes_20(add_bytes_20(now.c31, b), b);
    now.c42 = add_bytes_31(add_bytes_31(add_bytes_31(bytes_31(a), c), b), b);
    c02 = lower_and_upper(before.c42, now.c42);
    first = add_swapped(lower_and_upper(before.c31, now.c31) + 2 * c02, now.c31);
    second = add_swapped(add_swapped_twice(c02, now.c31), now.c42);
    put4(at, add_bytes_02(second << 4 & upper_bytes, first >> 4));
    return now;
}

static uint32_t gauss_column(const uint8_t *const rows[], int x)
{
    return rows[0][x] + 2u * rows[1][x] + rows[2][x];
}

void pel_row_gauss3_dsp(const uint8_t *const rows[], uint16_t count, uint8_t *restrict out)
{
    const uint8_t *const end = out + (count & ~15u), *rest[3];
    const uint32_t upper_bytes = in_register(UINT32_C(0xFF00FF00));
    places at = places_at(rows, 1, out);
    gauss_lanes even, odd;

    even.c31 = gauss_column(rows, -1) + 4;
    even.c42 = gauss_column(rows, 0);
    while (at.out != end) { /* by turns, so that nothing is to be moved */
        odd = gauss_step(&at, even, upper_bytes);
        even = gauss_step(&at, odd, upper_bytes);
        odd = gauss_step(&at, even, upper_bytes);
        even = gauss_step(&at, odd, upper_bytes);
    }
    if (count & 8) {
        odd = gauss_step(&at, even, upper_bytes);
        (void)gauss_step(&at, odd, upper_bytes);
    }
    if (count & 7) {
        find_rest(rows, count & ~7u, rest);
        pel_row_gauss3(rest, count & 7, at.out);
    }
}

/* ---- Gradients ----------------------------------------------------------------------------- */

/*
 * |gx| + |gy| is the larger one of |gx + gy| and |gx - gy|, and these are twice differences of sums
 * of two by two pixels: with such sums of the columns x and x + 1, upper(x) of the upper two rows
 * and lower(x) of the lower two, gx + gy = 2 (lower(x) - upper(x - 1)), gx - gy = 2 (upper(x) -
 * lower(x - 1)).
 */
typedef struct sobel_rows {
    uint32_t column42; /* sums of two pixels of a column, at most 510 */
    uint32_t square31; /* of it and the one to its right, at most 1020 */
} sobel_rows;

typedef struct sobel_lanes {
    sobel_rows upper, lower;
} sobel_lanes;

/* |a - b| */
PEL_DSP uint32_t distance(uint32_t a, uint32_t b)
{
    return subtract_to_zero(a, b) + subtract_to_zero(b, a);
}

/* Half of |gx| + |gy|, at most 255. */
PEL_DSP uint32_t half_size(uint32_t lower, uint32_t upper_left, uint32_t upper, uint32_t lower_left)
{
    const uint32_t one = distance(lower, upper_left), other = distance(upper, lower_left);
    return limited_lanes(one + subtract_to_zero(other, one));
}

PEL_DSP sobel_lanes sobel_step(places *at, sobel_lanes before)
{
    const uint32_t a = next4(&at->a), b = next4(&at->b), c = next4(&at->c);
    const uint32_t upper31 = add_bytes_20(bytes_20(a), b), lower31 = add_bytes_20(bytes_20(c), b);
    sobel_lanes now;
    uint32_t upper02, lower02, first, second;

    now.upper.column42 = add_bytes_31(bytes_31(a), b);
    now.lower.column42 = add_bytes_31(bytes_31(c), b);
    now.upper.square31 = upper31 + now.upper.column42;
    now.lower.square31 = lower31 + now.lower.column42;
    upper02 = lower_and_upper(before.upper.column42, now.upper.column42);
    upper02 = add_swapped(upper02, upper31);
    lower02 = lower_and_upper(before.lower.column42, now.lower.column42);
    lower02 = add_swapped(lower02, lower31);
    first = half_size(lower02, lower_and_upper(before.upper.square31, now.upper.square31), upper02,
                      lower_and_upper(before.lower.square31, now.lower.square31));
    second = half_size(now.lower.square31, swapped(upper02), now.upper.square31, swapped(lower02));
    put4(at, doubled_bytes(first | (second >> 8 | second << 24)));
    return now;
}

/* The sums of the columns -1 and 0 of two rows. */
static sobel_rows sobel_begin(const uint8_t *a, const uint8_t *b)
{
    sobel_rows rows;

    rows.column42 = (uint32_t)a[0] + b[0];
    rows.square31 = rows.column42 + a[-1] + b[-1];
    return rows;
}

void pel_row_gradient_abs_dsp(const uint8_t *const rows[], uint16_t count, uint8_t *restrict out)
{
    const uint8_t *const end = out + (count & ~7u), *rest[3];
    places at = places_at(rows, 1, out);
    sobel_lanes even, odd;

    even.upper = sobel_begin(rows[0], rows[1]);
    even.lower = sobel_begin(rows[1], rows[2]);
    while (at.out != end) {
        odd = sobel_step(&at, even);
        even = sobel_step(&at, odd);
    }
    if (count & 7) {
        find_rest(rows, count & ~7u, rest);
        pel_row_gradient_abs(rest, count & 7, at.out);
    }
}

/* ---- Kernels ------------------------------------------------------------------------------- */

/* Taps times 2^(8 - shift), so that the shift is the same for all kernels and comes with the limits
 * for nothing; as products of two pixels take them: the outer two of each row, the middle ones. */
typedef struct tap_pairs {
    uint32_t outer[3];
    uint32_t upper_and_own, lower;
} tap_pairs;

static uint32_t pair_of(int32_t low, int32_t high)
{
    return lower_lanes((uint32_t)low, (uint32_t)high);
}

static tap_pairs pairs_of(const int8_t *tap, unsigned shift)
{
    const int32_t factor = (int32_t)1 << (8 - shift);
    tap_pairs pairs;

    pairs.outer[0] = pair_of(tap[0] * factor, tap[2] * factor);
    pairs.outer[1] = pair_of(tap[3] * factor, tap[5] * factor);
    pairs.outer[2] = pair_of(tap[6] * factor, tap[8] * factor);
    pairs.upper_and_own = pair_of(tap[1] * factor, tap[4] * factor);
    pairs.lower = pair_of(tap[7] * factor, 0);
    return pairs;
}

PEL_DSP uint32_t next4_of2(const uint8_t **at)
{
    const uint32_t word = load4(*at);
    *at = opaque(*at + 2);
    return word;
}

/* Two results from the columns x - 1 .. x + 2: with four the registers run out. sum + start is less
 * than 2^28. */
PEL_DSP void kernel3_step(places *at, const tap_pairs *taps, int32_t start)
{
    uint32_t word = next4_of2(&at->a), even = bytes_02(word), odd = bytes_13(word);
    int32_t first = add_products(even, taps->outer[0], start);
    int32_t second = add_products(odd, taps->outer[0], start);

    first = add_low_low(odd, taps->upper_and_own, first);
    second = add_high_low(even, taps->upper_and_own, second);
    in_order();
    word = next4_of2(&at->b);
    even = bytes_02(word);
    odd = bytes_13(word);
    first = add_products(even, taps->outer[1], first);
    second = add_products(odd, taps->outer[1], second);
    first = add_low_high(odd, taps->upper_and_own, first);
    second = add_high_high(even, taps->upper_and_own, second);
    in_order();
    word = next4_of2(&at->c);
    even = bytes_02(word);
    odd = bytes_13(word);
    first = add_products(even, taps->outer[2], first);
    second = add_products(odd, taps->outer[2], second);
    first = add_low_low(odd, taps->lower, first);
    second = add_high_low(even, taps->lower, second);
    at->out[0] = (uint8_t)limited_256th(first);
    at->out[1] = (uint8_t)limited_256th(second);
    at->out += 2;
}

void pel_row_kernel3_dsp(const uint8_t *const rows[], const int8_t *tap, const pel_row_scale *scale,
                         uint16_t count, uint8_t *restrict out)
{
    const uint8_t *const end = out + (count & ~7u), *rest[3];
    tap_pairs taps;
    places at;
    int32_t bias, start;

    if (scale->divisor != 0 || scale->flip != 0 || scale->shift > 8) {
        pel_row_kernel3(rows, tap, scale, count, out);
        return;
    }
    taps = pairs_of(tap, scale->shift);
    bias = scale->bias + (int32_t)(scale->start >> scale->shift);
    start = bias * 256 + (scale->shift == 0 ? 0 : 128);
    at = places_at(rows, -1, out);
    while (at.out != end) {
        kernel3_step(&at, &taps, start);
        kernel3_step(&at, &taps, start);
        kernel3_step(&at, &taps, start);
        kernel3_step(&at, &taps, start);
    }
    for (unsigned i = count & 6; i > 0; i -= 2) {
        kernel3_step(&at, &taps, start);
    }
    if (count & 1) {
        find_rest(rows, count - 1u, rest);
        pel_row_kernel3(rest, tap, scale, 1, at.out);
    }
}

#endif
