/*
 * Every one of the 2^24 colours against the formulas of color.h in exact rational arithmetic.
 *
 * Nothing here is taken from the library: each channel is a fraction n / d of 64-bit integers,
 * worked out from the formula as it is printed, rounded by its definition floor(n / d + 1/2) and
 * limited to 0..255.
 */
#include "check.h"

#include <pel.h>
#include <stdlib.h>

enum { WIDTH = 256 }; /* a row is the 256 values of the third channel */

/* floor(n / d + 1/2) = floor((2 n + d) / (2 d)), limited to 0..255; d > 0. */
static uint8_t rounded(int64_t n, int64_t d)
{
    const int64_t numerator = 2 * n + d;
    const int64_t value = numerator / (2 * d);

    if (numerator < 0) {
        return 0; /* under -1/2 plus a half: negative whichever way it is rounded, or 0 */
    }
    return (uint8_t)(value > 255 ? 255 : value);
}

/* ---- The formulas -------------------------------------------------------------------------- */

typedef void (*formula)(const uint8_t in[3], uint8_t out[3]);

/* Y' = S / 1000; (B - Y') / 1.772 = (1000 B - S) / 1772; (R - Y') / 1.402 = (1000 R - S) / 1402. */
static void rgb_to_full(const uint8_t in[3], uint8_t out[3])
{
    const int64_t s = 299 * in[0] + 587 * in[1] + 114 * in[2];

    out[0] = rounded(s, 1000);
    out[1] = rounded(128 * 1772 + 1000 * in[2] - s, 1772);
    out[2] = rounded(128 * 1402 + 1000 * in[0] - s, 1402);
}

static void rgb_to_limited(const uint8_t in[3], uint8_t out[3])
{
    const int64_t s = 299 * in[0] + 587 * in[1] + 114 * in[2];

    out[0] = rounded(16 * 1000 * 255 + 219 * s, 1000 * 255);
    out[1] = rounded(128 * 1772 * 255 + 224 * (1000 * in[2] - s), 1772 * 255);
    out[2] = rounded(128 * 1402 * 255 + 224 * (1000 * in[0] - s), 1402 * 255);
}

/*
 * From Y' = y / unit, B - Y' = 1.772 cb / unit, R - Y' = 1.402 cr / unit:
 * R and B directly, and G from 587 G = 1000 Y' - 299 R - 114 B.
 */
static void differences_to_rgb(int64_t y, int64_t cb, int64_t cr, int64_t unit, uint8_t out[3])
{
    const int64_t red = 1000 * y + 1402 * cr, blue = 1000 * y + 1772 * cb; /* 1/(1000 unit) */

    out[0] = rounded(red, 1000 * unit);
    out[1] = rounded(1000 * 1000 * y - 299 * red - 114 * blue, 587 * 1000 * unit);
    out[2] = rounded(blue, 1000 * unit);
}

static void full_to_rgb(const uint8_t in[3], uint8_t out[3])
{
    differences_to_rgb(in[0], in[1] - 128, in[2] - 128, 1, out);
}

/* Y' = (Y - 16) 255 / 219 and chroma times 255 / 224, over the common unit 219 * 224. */
static void limited_to_rgb(const uint8_t in[3], uint8_t out[3])
{
    differences_to_rgb((in[0] - 16) * 255 * 224, (in[1] - 128) * 255 * 219,
                       (in[2] - 128) * 255 * 219, 219 * 224, out);
}

static void nrgb_above(const uint8_t in[3], uint8_t out[3], int sum_min)
{
    const int sum = in[0] + in[1] + in[2];

    for (int c = 0; c < 3; c++) {
        out[c] = sum == 0 || sum < sum_min ? 85 : rounded(255 * in[c], sum);
    }
}

static void rgb_to_nrgb(const uint8_t in[3], uint8_t out[3])
{
    nrgb_above(in, out, 0);
}

static void rgb_to_nrgb_60(const uint8_t in[3], uint8_t out[3])
{
    nrgb_above(in, out, 60);
}

/*
 * The hexagon of Smith 1978: with m the smallest channel and d = max - m, hue goes through red (0),
 * yellow, green, cyan, blue, magenta in sixths of a turn; within a sixth the middle channel's share
 * (middle - m) / d tells how far, upward or downward. 256 / 6 units are a sixth.
 */
static uint8_t hexagon_hue(int r, int g, int b)
{
    int64_t sixths, d; /* the hue is sixths / d sixths of a turn */

    if (r >= g && g >= b) {
        sixths = g - b, d = r - b; /* red to yellow */
    } else if (g >= r && r >= b) {
        sixths = 2 * (g - b) - (r - b), d = g - b; /* yellow to green */
    } else if (g >= b && b >= r) {
        sixths = 2 * (g - r) + (b - r), d = g - r; /* green to cyan */
    } else if (b >= g && g >= r) {
        sixths = 4 * (b - r) - (g - r), d = b - r; /* cyan to blue */
    } else if (b >= r && r >= g) {
        sixths = 4 * (b - g) + (r - g), d = b - g; /* blue to magenta */
    } else {
        sixths = 6 * (r - g) - (b - g), d = r - g; /* magenta to red */
    }
    return (uint8_t)((2 * 256 * sixths + 6 * d) / (2 * 6 * d)); /* 256 is 0 again */
}

static void rgb_to_hsv(const uint8_t in[3], uint8_t out[3])
{
    const int r = in[0], g = in[1], b = in[2];
    int max = r, min = r;

    for (int c = 1; c < 3; c++) {
        max = in[c] > max ? in[c] : max;
        min = in[c] < min ? in[c] : min;
    }
    out[0] = max == min ? 0 : hexagon_hue(r, g, b);
    out[1] = max == 0 ? 0 : rounded(255 * (max - min), max);
    out[2] = (uint8_t)max;
}

/* ---- The library's operators, all of one shape --------------------------------------------- */

typedef pel_status (*row_operator)(const uint8_t *src, uint8_t *dst, uint16_t width);

static pel_status row_to_full(const uint8_t *src, uint8_t *dst, uint16_t width)
{
    return pel_rgb_to_ycbcr_row(src, dst, width, PEL_RANGE_FULL);
}

static pel_status row_to_limited(const uint8_t *src, uint8_t *dst, uint16_t width)
{
    return pel_rgb_to_ycbcr_row(src, dst, width, PEL_RANGE_LIMITED);
}

static pel_status row_from_full(const uint8_t *src, uint8_t *dst, uint16_t width)
{
    return pel_ycbcr_to_rgb_row(src, dst, width, PEL_RANGE_FULL);
}

static pel_status row_from_limited(const uint8_t *src, uint8_t *dst, uint16_t width)
{
    return pel_ycbcr_to_rgb_row(src, dst, width, PEL_RANGE_LIMITED);
}

static pel_status row_to_nrgb(const uint8_t *src, uint8_t *dst, uint16_t width)
{
    return pel_rgb_to_nrgb_row(src, dst, width, 0);
}

static pel_status row_to_nrgb_60(const uint8_t *src, uint8_t *dst, uint16_t width)
{
    return pel_rgb_to_nrgb_row(src, dst, width, 60);
}

/* ---- The comparison ------------------------------------------------------------------------ */

/* The 256 colours that start with a and b. */
static void colors_of(unsigned a, unsigned b, uint8_t row[3 * WIDTH])
{
    for (unsigned c = 0; c < WIDTH; c++) {
        row[3 * c] = (uint8_t)a;
        row[3 * c + 1] = (uint8_t)b;
        row[3 * c + 2] = (uint8_t)c;
    }
}

static int same(const uint8_t a[3], const uint8_t b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static void report(const char *name, const uint8_t in[3], const uint8_t got[3],
                   const uint8_t expected[3])
{
    printf("     %s of %u %u %u: %u %u %u, by definition %u %u %u\n", name, in[0], in[1], in[2],
           got[0], got[1], got[2], expected[0], expected[1], expected[2]);
}

static void compare_all(tally *checks, const char *name, row_operator operator, formula exact)
{
    uint64_t compared = 0, wrong = 0;

    for (unsigned ab = 0; ab < 65536; ab++) {
        uint8_t in[3 * WIDTH], out[3 * WIDTH];
        colors_of(ab >> 8, ab & 255, in);
        if (operator(in, out, WIDTH) != PEL_OK) {
            wrong++;
            continue;
        }
        for (unsigned x = 0; x < 3 * WIDTH; x += 3) {
            uint8_t expected[3];
            exact(in + x, expected);
            if (!same(out + x, expected) && wrong++ < 3) {
                report(name, in + x, out + x, expected);
            }
            compared++;
        }
    }
    check(checks, name, compared, wrong);
}

/* There and back: no channel of any RGB colour may be off by more than `bound`, and some colour
 * must need all of it, or the stated bound would be too loose. */
static void round_trip(tally *checks, const char *name, pel_range range, int bound)
{
    uint64_t compared = 0, wrong = 0;
    int worst[3] = {0, 0, 0};

    for (unsigned ab = 0; ab < 65536; ab++) {
        uint8_t in[3 * WIDTH], row[3 * WIDTH];
        colors_of(ab >> 8, ab & 255, in);
        if (pel_rgb_to_ycbcr_row(in, row, WIDTH, range) != PEL_OK ||
            pel_ycbcr_to_rgb_row(row, row, WIDTH, range) != PEL_OK) {
            wrong++;
        }
        for (unsigned i = 0; i < 3 * WIDTH; i++) {
            const int error = abs(row[i] - in[i]);
            worst[i % 3] = error > worst[i % 3] ? error : worst[i % 3];
            wrong += error > bound;
            compared++;
        }
    }
    printf("     %s: worst error R %d, G %d, B %d\n", name, worst[0], worst[1], worst[2]);
    wrong += worst[0] < bound && worst[1] < bound && worst[2] < bound;
    check(checks, name, compared, wrong);
}

int main(void)
{
    tally checks = {0, 0};

    compare_all(&checks, "RGB to YCbCr, full range", row_to_full, rgb_to_full);
    compare_all(&checks, "RGB to YCbCr, limited range", row_to_limited, rgb_to_limited);
    compare_all(&checks, "YCbCr to RGB, full range", row_from_full, full_to_rgb);
    compare_all(&checks, "YCbCr to RGB, limited range", row_from_limited, limited_to_rgb);
    compare_all(&checks, "RGB to normalised RGB", row_to_nrgb, rgb_to_nrgb);
    compare_all(&checks, "RGB to normalised RGB over a sum of 60", row_to_nrgb_60, rgb_to_nrgb_60);
    compare_all(&checks, "RGB to HSV", pel_rgb_to_hsv_row, rgb_to_hsv);
    round_trip(&checks, "RGB to YCbCr and back, full range, within 1", PEL_RANGE_FULL, 1);
    round_trip(&checks, "RGB to YCbCr and back, limited range, within 2", PEL_RANGE_LIMITED, 2);
    return checks_end(&checks);
}
