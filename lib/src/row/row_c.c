/* Row kernels in plain C, the truth that every faster version must equal: reading pixels, colours,
 * tables. From pixels to labels and runs: row_classify_c.c, row_runs_c.c. */
#include "row/row.h"

#include "pel/fixed.h"

/* ---- Reading pixels ------------------------------------------------------------------------ */

void pel_row_read_pairs(const pel_row_pairs *src, uint16_t x, uint16_t count, uint8_t *y,
                        uint8_t *u, uint8_t *v)
{
    const uint8_t *src_y = src->y + (size_t)x * src->y_step;

    for (uint16_t i = 0; i < count; i++) {
        const size_t c = (size_t)((x + (size_t)i) >> 1) * src->c_step;
        y[i] = *src_y;
        u[i] = src->u[c];
        v[i] = src->v[c];
        src_y += src->y_step;
    }
}

void pel_row_read_rgb24(const uint8_t *src, uint16_t count, unsigned first, uint8_t *rgb)
{
    for (uint16_t i = 0; i < count; i++) {
        rgb[0] = src[first];
        rgb[1] = src[1];
        rgb[2] = src[2 - first];
        rgb += 3;
        src += 3;
    }
}

/* 5 or 6 bits become 8 by repeating the top bits below: 0 stays 0 and the maximum becomes 255. */
void pel_row_read_rgb565(const uint8_t *src, uint16_t count, unsigned low, uint8_t *rgb)
{
    for (uint16_t i = 0; i < count; i++) {
        const unsigned pixel = (unsigned)src[low] | (unsigned)src[1 - low] << 8;
        const unsigned r = pixel >> 11, g = pixel >> 5 & 63, b = pixel & 31;
        rgb[0] = (uint8_t)(r << 3 | r >> 2);
        rgb[1] = (uint8_t)(g << 2 | g >> 4);
        rgb[2] = (uint8_t)(b << 3 | b >> 2);
        rgb += 3;
        src += 2;
    }
}

void pel_row_read_bayer(const uint8_t *even, const uint8_t *odd, uint16_t count, unsigned red,
                        uint8_t *rgb)
{
    for (uint16_t i = 0; i < count; i++) {
        const uint8_t cell[4] = {even[0], even[1], odd[0], odd[1]};
        rgb[0] = cell[red];
        rgb[1] = (uint8_t)((cell[red ^ 1u] + cell[red ^ 2u] + 1) >> 1);
        rgb[2] = cell[red ^ 3u];
        rgb += 3;
        even += 2;
        odd += 2;
    }
}

/* ---- Colour spaces ------------------------------------------------------------------------- */

/*
 * The formulas of color.h as fractions, each with 1/2 added so that the division's floor rounds:
 * full:    Y = S / 1000, S = 299 R + 587 G + 114 B <= 255000
 *          U = 128 + P / 1772, P = 886 B - 299 R - 587 G, |P| <= 225930
 *          V = 128 + Q / 1402, Q = 701 R - 587 G - 114 B, |Q| <= 178755
 * limited: Y = 16 + 73 S / 85000, U = 128 + 56 P / 112965, V = 128 + 112 Q / 178755
 * The largest numerator is 224 * 178755 + 257 * 178755 < 2^27.
 */
static uint8_t luma(uint32_t s, int limited)
{
    return limited ? (uint8_t)((73 * s + 16 * UINT32_C(85000) + 42500) / 85000)
                   : (uint8_t)((s + 500) / 1000);
}

static uint8_t chroma_blue(int32_t p, int limited)
{
    return limited ? (uint8_t)((uint32_t)(112 * p + INT32_C(257) * 112965) / (2 * UINT32_C(112965)))
                   : pel_saturate_u8((p + INT32_C(128) * 1772 + 886) / 1772);
}

static uint8_t chroma_red(int32_t q, int limited)
{
    return limited ? (uint8_t)((uint32_t)(224 * q + INT32_C(257) * 178755) / (2 * UINT32_C(178755)))
                   : pel_saturate_u8((q + INT32_C(128) * 1402 + 701) / 1402);
}

void pel_row_rgb_to_ycbcr(const uint8_t *rgb, uint16_t count, int limited, uint8_t *y, uint8_t *u,
                          uint8_t *v, unsigned step)
{
    for (uint16_t i = 0; i < count; i++) {
        const int32_t r = rgb[0], g = rgb[1], b = rgb[2];
        *y = luma((uint32_t)(299 * r + 587 * g + 114 * b), limited);
        *u = chroma_blue(886 * b - 299 * r - 587 * g, limited);
        *v = chroma_red(701 * r - 587 * g - 114 * b, limited);
        rgb += 3;
        y += step;
        u += step;
        v += step;
    }
}

/* floor(n / d) for d > 0; *rest = what is left, 0..d-1. */
static int32_t floor_div(int32_t n, int32_t d, int32_t *rest)
{
    int32_t quotient = n / d;

    *rest = n % d;
    if (*rest < 0) {
        *rest += d;
        quotient--;
    }
    return quotient;
}

/* n / d to nearest, limited to 0..255. |n| < 2^30. */
static uint8_t round_div_u8(int32_t n, int32_t d)
{
    return pel_saturate_u8(pel_round_div(n, d));
}

/* y, cb, cr: Y 0..255, U - 128, V - 128. The largest numerator is 209599 * 128 + 101004 * 128 +
 * 256 * 293500 < 2^27. */
static void full_to_rgb(int32_t y, int32_t cb, int32_t cr, uint8_t *rgb)
{
    rgb[0] = round_div_u8(500 * y + 701 * cr, 500);
    rgb[1] = round_div_u8(293500 * y - 209599 * cr - 101004 * cb, 293500);
    rgb[2] = round_div_u8(250 * y + 443 * cb, 250);
}

/*
 * Limited: Y' = (Y - 16) * 85/73, R = Y' + 35751/22400 cr, B = Y' + 22593/11200 cb,
 * G = Y' - (10689549 cr + 5151204 cb) / 13148800. The common denominator of G does not fit 32 bits,
 * so its two fractions are rounded together from their remainders. Largest: 15840753 * 128 < 2^31.
 */
static void limited_to_rgb(int32_t y, int32_t cb, int32_t cr, uint8_t *rgb)
{
    const int32_t one = INT32_C(73) * 13148800; /* < 2^30 */
    int32_t luma_rest, chroma_rest, fraction, carry;
    const int32_t luma_whole = floor_div(85 * (y - 16), 73, &luma_rest);
    const int32_t chroma_whole = floor_div(10689549 * cr + 5151204 * cb, 13148800, &chroma_rest);

    fraction = luma_rest * 13148800 - chroma_rest * 73; /* between -one and one */
    carry = fraction >= one / 2 ? 1 : fraction < -(one / 2) ? -1 : 0;
    rgb[0] = round_div_u8(INT32_C(85) * 22400 * (y - 16) + INT32_C(35751) * 73 * cr,
                          INT32_C(73) * 22400);
    rgb[1] = pel_saturate_u8(luma_whole - chroma_whole + carry);
    rgb[2] = round_div_u8(INT32_C(85) * 11200 * (y - 16) + INT32_C(22593) * 73 * cb,
                          INT32_C(73) * 11200);
}

void pel_row_ycbcr_to_rgb(const uint8_t *y, const uint8_t *u, const uint8_t *v, unsigned step,
                          uint16_t count, int limited, uint8_t *rgb)
{
    for (uint16_t i = 0; i < count; i++) {
        const int32_t luma_value = *y, cb = *u - 128, cr = *v - 128;
        if (limited) {
            limited_to_rgb(luma_value, cb, cr, rgb);
        } else {
            full_to_rgb(luma_value, cb, cr, rgb);
        }
        rgb += 3;
        y += step;
        u += step;
        v += step;
    }
}

/* 255 n / d to nearest, halves upward; n <= d <= 765. */
static uint8_t part_of_255(uint32_t n, uint32_t d)
{
    return (uint8_t)((510 * n + d) / (2 * d));
}

void pel_row_rgb_to_nrgb(const uint8_t *rgb, uint16_t count, uint16_t sum_min, uint8_t *nrgb)
{
    for (uint16_t i = 0; i < count; i++) {
        const uint32_t r = rgb[0], g = rgb[1], b = rgb[2], sum = r + g + b;
        const int dark = sum == 0 || sum < sum_min;
        nrgb[0] = dark ? 85 : part_of_255(r, sum);
        nrgb[1] = dark ? 85 : part_of_255(g, sum);
        nrgb[2] = dark ? 85 : part_of_255(b, sum);
        rgb += 3;
        nrgb += 3;
    }
}

/* The hue of a colour whose channels lie `spread` apart: which channel is largest gives the third
 * of the circle, the difference of the other two the place in it, in sixths / spread. */
static uint8_t hue(int32_t r, int32_t g, int32_t b, int32_t max, int32_t spread)
{
    int32_t sixths;

    if (max == r) {
        sixths = g >= b ? g - b : g - b + 6 * spread;
    } else if (max == g) {
        sixths = 2 * spread + b - r;
    } else {
        sixths = 4 * spread + r - g;
    }
    return (uint8_t)((256 * sixths + 3 * spread) / (6 * spread));
}

void pel_row_rgb_to_hsv(const uint8_t *rgb, uint16_t count, uint8_t *hsv)
{
    for (uint16_t i = 0; i < count; i++) {
        const int32_t r = rgb[0], g = rgb[1], b = rgb[2];
        const int32_t max = r > g ? (r > b ? r : b) : (g > b ? g : b);
        const int32_t min = r < g ? (r < b ? r : b) : (g < b ? g : b);
        hsv[0] = max == min ? 0 : hue(r, g, b, max, max - min);
        hsv[1] = max == 0 ? 0 : part_of_255((uint32_t)(max - min), (uint32_t)max);
        hsv[2] = (uint8_t)max;
        rgb += 3;
        hsv += 3;
    }
}

/* ---- Tables, sums --------------------------------------------------------------------------- */

void pel_row_map(const uint8_t *src, uint16_t count, const uint8_t *table, uint8_t *dst)
{
    for (uint16_t i = 0; i < count; i++) {
        dst[i] = table[src[i]];
    }
}

uint32_t pel_row_sum(const uint8_t *src, uint16_t count)
{
    uint32_t sum = 0;

    for (uint16_t i = 0; i < count; i++) {
        sum += src[i];
    }
    return sum;
}
