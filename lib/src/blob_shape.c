/* What people want to read off a blob, computed from its sums. */
#include "pel/blobs.h"
#include "pel/fixed.h"

/* n / d with `bits` fraction bits, rounded to nearest, halves upward. n <= d, 0 < d <= 2^31. */
static uint32_t fraction(uint32_t n, uint32_t d, unsigned bits)
{
    uint32_t quotient = 0;

    for (unsigned i = 0; i < bits; i++) {
        n *= 2;
        quotient *= 2;
        if (n >= d) {
            n -= d;
            quotient++;
        }
    }
    return 2 * n >= d ? quotient + 1 : quotient;
}

static uint16_t limit_q15(uint32_t value)
{
    return (uint16_t)(value > 32767 ? 32767 : value);
}

static int32_t divide_q16(uint32_t sum, uint32_t area)
{
    return (int32_t)(((sum / area) << 16) + fraction(sum % area, area, 16));
}

void pel_blob_centroid_q16(const pel_blob *blob, int32_t *x_q16, int32_t *y_q16)
{
    const int known = blob && blob->area != 0;

    if (x_q16) {
        *x_q16 = known ? divide_q16(blob->sum_x, blob->area) : 0;
    }
    if (y_q16) {
        *y_q16 = known ? divide_q16(blob->sum_y, blob->area) : 0;
    }
}

/*
 * Second central moments times area^2: spread = c20 + c02, difference = |c20 - c02|, mixed =
 * |2 c11|, and the signs of the last two. area * sum_xx may pass 2^64, but what is left after
 * subtracting sum_x^2 does not: area * sum of (x - mean)^2 only grows with every pixel that is
 * added, so the full frame bounds it, (width^2 height)^2 / 12 < 2^63 within the sizes of
 * pel_blobs_begin; and unsigned arithmetic is exact modulo 2^64. mixed <= spread < 2^64. Moments
 * that were not measured give zeros.
 */
typedef struct axes {
    uint64_t spread, difference, mixed;
    int difference_negative, mixed_negative;
} axes;

static axes axes_of(const pel_blob *blob)
{
    axes a = {0, 0, 0, 0, 0};
    uint64_t area, sx, sy, c20, c02, c11;

    if (!blob || (blob->sum_xx == 0 && blob->sum_yy == 0)) { /* not measured, or the pixel (0, 0) */
        return a;
    }
    area = blob->area;
    sx = blob->sum_x;
    sy = blob->sum_y;
    c20 = area * blob->sum_xx - sx * sx;
    c02 = area * blob->sum_yy - sy * sy;
    c11 = area * blob->sum_xy - sx * sy;
    a.spread = c20 + c02;
    a.difference_negative = c20 < c02;
    a.difference = c20 < c02 ? c02 - c20 : c20 - c02;
    a.mixed_negative = c11 >> 63 != 0;
    a.mixed = 2 * (a.mixed_negative ? 0 - c11 : c11);
    return a;
}

/* How far a value must move right (or, negative, left) to lie in 2^(bits-1) <= value < 2^bits. */
static int shift_to(uint64_t value, int bits)
{
    int shift = 0;

    while (value >> shift >= (uint64_t)1 << bits) {
        shift++;
    }
    while (shift <= 0 && value << -shift < (uint64_t)1 << (bits - 1)) {
        shift--;
    }
    return shift;
}

static uint64_t shifted(uint64_t value, int shift)
{
    return shift >= 0 ? value >> shift : value << -shift;
}

int16_t pel_blob_angle_turn16(const pel_blob *blob)
{
    const axes a = axes_of(blob);
    const uint64_t longest = a.difference | a.mixed;
    int32_t x, y, twice;
    int shift;

    if (longest == 0) {
        return 0;
    }
    shift = shift_to(longest, 30);
    x = (int32_t)shifted(a.difference, shift);
    y = (int32_t)shifted(a.mixed, shift);
    twice = pel_atan2_turn16(a.mixed_negative ? -y : y, a.difference_negative ? -x : x);
    twice = pel_round_shift(twice, 1);
    return (int16_t)(twice == 16384 ? -16384 : twice); /* +90 degrees is the axis of -90 */
}

uint16_t pel_blob_roundness_q15(const pel_blob *blob)
{
    const axes a = axes_of(blob);
    uint64_t spread, difference, mixed;
    uint32_t root, sum, product_root;
    int shift;

    if (a.spread == 0) {
        return 32767;
    }
    /* The eigenvalues are spread -+ root, with root = hypot(difference, mixed) <= spread < 2^31. */
    shift = shift_to(a.spread, 31);
    spread = shifted(a.spread, shift);
    difference = shifted(a.difference, shift);
    mixed = shifted(a.mixed, shift);
    root = pel_isqrt64(difference * difference + mixed * mixed);
    if (root >= spread) {
        return 0;
    }
    sum = (uint32_t)spread + root; /* < 2^32 */
    product_root = pel_isqrt64((spread - root) * sum);
    return limit_q15(fraction(product_root / 2, sum / 2, 15));
}

uint16_t pel_blob_elongation_q15(const pel_blob *blob)
{
    return (uint16_t)(32767 - pel_blob_roundness_q15(blob));
}

uint16_t pel_blob_density_q15(const pel_blob *blob)
{
    const uint32_t box =
        blob ? (uint32_t)(blob->x1 - blob->x0) * (uint32_t)(blob->y1 - blob->y0) : 0;
    return box == 0 ? 0 : limit_q15(fraction(blob->area, box, 15));
}

static int within(uint16_t value, uint16_t min, uint16_t max)
{
    return value >= min && (max == 0 || value <= max);
}

int pel_blob_shape_passes(const void *limits, const pel_blob *blob)
{
    const pel_blob_shape *const shape = limits;

    if (!blob || !shape) {
        return blob != NULL;
    }
    return within(pel_blob_density_q15(blob), shape->density_min_q15, shape->density_max_q15) &&
           ((shape->elongation_min_q15 | shape->elongation_max_q15) == 0 ||
            within(pel_blob_elongation_q15(blob), shape->elongation_min_q15,
                   shape->elongation_max_q15));
}

uint16_t pel_blob_compactness_q15(const pel_blob *blob)
{
    const uint64_t square = blob ? (uint64_t)blob->perimeter * blob->perimeter : 0;
    int shift;
    uint32_t part_q16;

    if (square == 0) {
        return 0;
    }
    /* 16 area <= perimeter^2, with equality for squares; their compactness is pi / 4. */
    shift = shift_to(square, 31);
    part_q16 = fraction((uint32_t)shifted((uint64_t)blob->area * 16, shift),
                        (uint32_t)shifted(square, shift), 16);
    return limit_q15((uint32_t)pel_round_shift((int32_t)(part_q16 * 12868u), 15)); /* pi/8 in q15 */
}
