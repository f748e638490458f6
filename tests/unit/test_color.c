/*
 * Colour spaces, row by row. Expected values are computed by hand from the formulas of color.h; the
 * lines beside the tables show the unrounded numbers. That all 2^24 colours are exact is checked in
 * tests/oracle.
 */
#include "unity.h"

#include <pel.h>

void setUp(void)
{
}

void tearDown(void)
{
}

typedef struct pair {
    uint8_t from[3];
    uint8_t to[3];
} pair;

/* ---- RGB to YCbCr -------------------------------------------------------------------------- */

/* Y' = (299 R + 587 G + 114 B) / 1000, U = 128 + (B - Y') / 1.772, V = 128 + (R - Y') / 1.402. Four
 * corners of the colour cube have a chroma of exactly 255.5 or 0.5: halves go upward, then 256 is
 * limited to 255. */
static const pair full_colors[] = {
    {{0, 0, 0}, {0, 128, 128}},
    {{255, 255, 255}, {255, 128, 128}},
    {{128, 128, 128}, {128, 128, 128}},
    {{255, 0, 0}, {76, 85, 255}},    /*  76.245   84.972  255.5   */
    {{0, 255, 0}, {150, 44, 21}},    /* 149.685   43.528   21.235 */
    {{0, 0, 255}, {29, 255, 107}},   /*  29.07   255.5    107.265 */
    {{255, 255, 0}, {226, 1, 149}},  /* 225.93     0.5    148.735 */
    {{0, 255, 255}, {179, 171, 1}},  /* 178.755  171.028    0.5   */
    {{255, 0, 255}, {105, 212, 235}} /* 105.315  212.472  234.765 */
};

/* Y = 16 + 219/255 Y', U and V = 128 + 224/255 of the full-range difference from 128. */
static const pair limited_colors[] = {
    {{0, 0, 0}, {16, 128, 128}},        {{255, 255, 255}, {235, 128, 128}},
    {{128, 128, 128}, {126, 128, 128}}, /* 125.929 */
    {{255, 0, 0}, {81, 90, 240}},       /*  81.481   90.203  240.0   */
    {{0, 255, 0}, {145, 54, 34}},       /* 144.553   53.797   34.214 */
    {{0, 0, 255}, {41, 240, 110}},      /*  40.966  240.0    109.786 */
    {{255, 255, 0}, {210, 16, 146}},    /* 210.034   16.0    146.214 */
    {{0, 255, 255}, {170, 166, 16}},    /* 169.519  165.797   16.0   */
    {{255, 0, 255}, {106, 202, 222}}    /* 106.447  202.203  221.786 */
};

enum { COLORS = sizeof full_colors / sizeof full_colors[0] };

static void test_rgb_to_full_range(void)
{
    for (unsigned i = 0; i < COLORS; i++) {
        uint8_t yuv[3];
        TEST_ASSERT_EQUAL_INT(PEL_OK,
                              pel_rgb_to_ycbcr_row(full_colors[i].from, yuv, 1, PEL_RANGE_FULL));
        TEST_ASSERT_EQUAL_UINT8_ARRAY(full_colors[i].to, yuv, 3);
    }
}

static void test_rgb_to_limited_range(void)
{
    for (unsigned i = 0; i < COLORS; i++) {
        uint8_t yuv[3];
        TEST_ASSERT_EQUAL_INT(
            PEL_OK, pel_rgb_to_ycbcr_row(limited_colors[i].from, yuv, 1, PEL_RANGE_LIMITED));
        TEST_ASSERT_EQUAL_UINT8_ARRAY(limited_colors[i].to, yuv, 3);
    }
}

static void test_grays_have_no_chroma_in_either_range(void)
{
    for (unsigned gray = 0; gray < 256; gray++) {
        const uint8_t rgb[3] = {(uint8_t)gray, (uint8_t)gray, (uint8_t)gray};
        const uint8_t full[3] = {(uint8_t)gray, 128, 128};
        uint8_t yuv[3];
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_rgb_to_ycbcr_row(rgb, yuv, 1, PEL_RANGE_FULL));
        TEST_ASSERT_EQUAL_UINT8_ARRAY(full, yuv, 3);
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_rgb_to_ycbcr_row(rgb, yuv, 1, PEL_RANGE_LIMITED));
        TEST_ASSERT_EQUAL_UINT8(128, yuv[1]);
        TEST_ASSERT_EQUAL_UINT8(128, yuv[2]);
    }
}

/* ---- YCbCr to RGB -------------------------------------------------------------------------- */

/* R = Y + 1.402 (V - 128), B = Y + 1.772 (U - 128), G = (Y - 0.299 R - 0.114 B) / 0.587. */
static const pair full_back[] = {
    {{0, 128, 128}, {0, 0, 0}},
    {{255, 128, 128}, {255, 255, 255}},
    {{76, 85, 255}, {254, 0, 0}},       /* 254.054   0.103  -0.196 */
    {{150, 44, 21}, {0, 255, 1}},       /*  -0.014 255.320   1.152 */
    {{29, 255, 107}, {0, 0, 254}},      /*  -0.442   0.292 254.044 */
    {{100, 140, 110}, {75, 109, 121}},  /*  74.764 108.725 121.264 */
    {{255, 255, 255}, {255, 121, 255}}, /* 433.054 120.599 480.044: no colour of RGB, limited */
    {{0, 0, 0}, {0, 135, 0}}            /* -179.456 135.459 -226.816: likewise */
};

/* The same with 255/219 (Y - 16) and 255/224 of the chroma. */
static const pair limited_back[] = {
    {{16, 128, 128}, {0, 0, 0}},        {{235, 128, 128}, {255, 255, 255}},
    {{126, 128, 128}, {128, 128, 128}}, /* 128.082 */
    {{0, 128, 128}, {0, 0, 0}},         /* -18.630: under black */
    {{255, 128, 128}, {255, 255, 255}}, /* 278.288: over white */
    {{81, 90, 240}, {254, 0, 0}},       /* 254.440  -0.480  -0.970 */
    {{145, 54, 34}, {0, 255, 1}},       /*   0.179 255.615   0.930 */
    {{41, 240, 110}, {0, 0, 255}}       /*   0.381  -0.134 255.040 */
};

static void check_back(const pair *pairs, unsigned count, pel_range range)
{
    for (unsigned i = 0; i < count; i++) {
        uint8_t rgb[3];
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_ycbcr_to_rgb_row(pairs[i].from, rgb, 1, range));
        TEST_ASSERT_EQUAL_UINT8_ARRAY(pairs[i].to, rgb, 3);
    }
}

static void test_full_range_to_rgb(void)
{
    check_back(full_back, sizeof full_back / sizeof full_back[0], PEL_RANGE_FULL);
}

static void test_limited_range_to_rgb(void)
{
    check_back(limited_back, sizeof limited_back / sizeof limited_back[0], PEL_RANGE_LIMITED);
}

static void test_grays_come_back_unchanged_from_full_range(void)
{
    for (unsigned gray = 0; gray < 256; gray++) {
        const uint8_t yuv[3] = {(uint8_t)gray, 128, 128};
        const uint8_t expected[3] = {(uint8_t)gray, (uint8_t)gray, (uint8_t)gray};
        uint8_t rgb[3];
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_ycbcr_to_rgb_row(yuv, rgb, 1, PEL_RANGE_FULL));
        TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, rgb, 3);
    }
}

/* ---- Normalised RGB ------------------------------------------------------------------------ */

static void test_nrgb_of_known_colors(void)
{
    static const pair colors[] = {
        {{255, 0, 0}, {255, 0, 0}},
        {{1, 0, 0}, {255, 0, 0}}, /* dark red is as red as bright red */
        {{255, 255, 255}, {85, 85, 85}},
        {{10, 10, 10}, {85, 85, 85}},
        {{255, 255, 0}, {128, 128, 0}},  /* 127.5: halves upward */
        {{200, 100, 50}, {146, 73, 36}}, /* 145.714 72.857 36.429 */
        {{100, 50, 25}, {146, 73, 36}},  /* half the light, the same colour */
        {{0, 1, 254}, {0, 1, 254}}};
    for (unsigned i = 0; i < sizeof colors / sizeof colors[0]; i++) {
        uint8_t nrgb[3];
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_rgb_to_nrgb_row(colors[i].from, nrgb, 1, 0));
        TEST_ASSERT_EQUAL_UINT8_ARRAY(colors[i].to, nrgb, 3);
    }
}

static void test_nrgb_of_black_is_gray_and_never_a_division_by_zero(void)
{
    static const uint8_t black[3] = {0, 0, 0};
    static const uint8_t gray[3] = {85, 85, 85};
    uint8_t nrgb[3];
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_rgb_to_nrgb_row(black, nrgb, 1, 0));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(gray, nrgb, 3);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_rgb_to_nrgb_row(black, nrgb, 1, 30));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(gray, nrgb, 3);
}

static void test_nrgb_of_colors_darker_than_the_limit_is_gray(void)
{
    static const uint8_t rgb[6] = {30, 0, 0, 29, 0, 0};
    static const uint8_t expected[6] = {255, 0, 0, 85, 85, 85};
    uint8_t nrgb[6];
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_rgb_to_nrgb_row(rgb, nrgb, 2, 30));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, nrgb, 6);
}

static void test_nrgb_at_the_highest_limit_keeps_only_white(void)
{
    static const uint8_t rgb[6] = {255, 255, 255, 255, 255, 0};
    uint8_t nrgb[6];
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_rgb_to_nrgb_row(rgb, nrgb, 2, 765));
    for (unsigned i = 0; i < 6; i++) {
        TEST_ASSERT_EQUAL_UINT8(85, nrgb[i]);
    }
}

/* ---- HSV ----------------------------------------------------------------------------------- */

static void test_hsv_of_known_colors(void)
{
    static const pair colors[] = {
        {{0, 0, 0}, {0, 0, 0}},           {{255, 255, 255}, {0, 0, 255}},
        {{77, 77, 77}, {0, 0, 77}},       {{255, 0, 0}, {0, 255, 255}},
        {{255, 255, 0}, {43, 255, 255}},                                  /*  42.667 */
        {{0, 255, 0}, {85, 255, 255}},                                    /*  85.333 */
        {{0, 255, 255}, {128, 255, 255}}, {{0, 0, 255}, {171, 255, 255}}, /* 170.667 */
        {{255, 0, 255}, {213, 255, 255}},                                 /* 213.333 */
        {{200, 100, 50}, {14, 191, 200}},                                 /* 14.222, 191.25 */
        {{2, 1, 1}, {0, 128, 2}}, /* saturation 127.5: halves upward */
        {{1, 0, 0}, {0, 255, 1}}};
    for (unsigned i = 0; i < sizeof colors / sizeof colors[0]; i++) {
        uint8_t hsv[3];
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_rgb_to_hsv_row(colors[i].from, hsv, 1));
        TEST_ASSERT_EQUAL_UINT8_ARRAY(colors[i].to, hsv, 3);
    }
}

/* Just below red, hue 256 - 42.667 b / 255, ends at 255 and then is 0, never 256 or 1. */
static void test_hue_wraps_below_red(void)
{
    static const uint8_t rgb[9] = {255, 0, 4, 255, 0, 3, 255, 0, 2}; /* 255.33, 255.498, 255.67 */
    uint8_t hsv[9];
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_rgb_to_hsv_row(rgb, hsv, 3));
    TEST_ASSERT_EQUAL_UINT8(255, hsv[0]);
    TEST_ASSERT_EQUAL_UINT8(255, hsv[3]);
    TEST_ASSERT_EQUAL_UINT8(0, hsv[6]);
}

static void test_hue_within_an_arc_includes_both_ends(void)
{
    TEST_ASSERT_EQUAL_INT(1, pel_hue_within(10, 10, 20));
    TEST_ASSERT_EQUAL_INT(1, pel_hue_within(15, 10, 20));
    TEST_ASSERT_EQUAL_INT(1, pel_hue_within(20, 10, 20));
    TEST_ASSERT_EQUAL_INT(0, pel_hue_within(9, 10, 20));
    TEST_ASSERT_EQUAL_INT(0, pel_hue_within(21, 10, 20));
    TEST_ASSERT_EQUAL_INT(1, pel_hue_within(10, 10, 10));
    TEST_ASSERT_EQUAL_INT(0, pel_hue_within(11, 10, 10));
}

static void test_hue_within_an_arc_through_red(void)
{
    TEST_ASSERT_EQUAL_INT(1, pel_hue_within(250, 240, 10));
    TEST_ASSERT_EQUAL_INT(1, pel_hue_within(240, 240, 10));
    TEST_ASSERT_EQUAL_INT(1, pel_hue_within(255, 240, 10));
    TEST_ASSERT_EQUAL_INT(1, pel_hue_within(0, 240, 10));
    TEST_ASSERT_EQUAL_INT(1, pel_hue_within(10, 240, 10));
    TEST_ASSERT_EQUAL_INT(0, pel_hue_within(11, 240, 10));
    TEST_ASSERT_EQUAL_INT(0, pel_hue_within(239, 240, 10));
    TEST_ASSERT_EQUAL_INT(0, pel_hue_within(128, 240, 10));
}

static void test_hue_within_the_whole_circle(void)
{
    unsigned inside = 0;
    for (unsigned hue = 0; hue < 256; hue++) {
        inside += (unsigned)pel_hue_within((uint8_t)hue, 0, 255);
        inside += (unsigned)pel_hue_within((uint8_t)hue, 101, 100);
    }
    TEST_ASSERT_EQUAL_UINT(512, inside);
}

/* ---- What all rows share ------------------------------------------------------------------- */

typedef pel_status (*row_operator)(const uint8_t *src, uint8_t *dst, uint16_t width);

static pel_status to_full(const uint8_t *src, uint8_t *dst, uint16_t width)
{
    return pel_rgb_to_ycbcr_row(src, dst, width, PEL_RANGE_FULL);
}

static pel_status to_limited(const uint8_t *src, uint8_t *dst, uint16_t width)
{
    return pel_rgb_to_ycbcr_row(src, dst, width, PEL_RANGE_LIMITED);
}

static pel_status from_full(const uint8_t *src, uint8_t *dst, uint16_t width)
{
    return pel_ycbcr_to_rgb_row(src, dst, width, PEL_RANGE_FULL);
}

static pel_status from_limited(const uint8_t *src, uint8_t *dst, uint16_t width)
{
    return pel_ycbcr_to_rgb_row(src, dst, width, PEL_RANGE_LIMITED);
}

static pel_status to_nrgb(const uint8_t *src, uint8_t *dst, uint16_t width)
{
    return pel_rgb_to_nrgb_row(src, dst, width, 20);
}

static const row_operator operators[] = {to_full,      to_limited, from_full,
                                         from_limited, to_nrgb,    pel_rgb_to_hsv_row};

enum { OPERATORS = sizeof operators / sizeof operators[0], WIDTH = 37, CANARY = 0xa5 };

/* A row of colours without any pattern that a kernel could hide behind. */
static void fill_row(uint8_t *row)
{
    uint32_t state = 2463534242u;
    for (unsigned i = 0; i < 3 * WIDTH; i++) {
        state = state * 1664525u + 1013904223u;
        row[i] = (uint8_t)(state >> 24);
    }
}

static void test_a_row_is_its_pixels_one_by_one(void)
{
    uint8_t row[3 * WIDTH], whole[3 * WIDTH];
    fill_row(row);
    for (unsigned k = 0; k < OPERATORS; k++) {
        TEST_ASSERT_EQUAL_INT(PEL_OK, operators[k](row, whole, WIDTH));
        for (unsigned x = 0; x < WIDTH; x++) {
            uint8_t one[3];
            TEST_ASSERT_EQUAL_INT(PEL_OK, operators[k](&row[3 * x], one, 1));
            TEST_ASSERT_EQUAL_UINT8_ARRAY(one, &whole[3 * x], 3);
        }
    }
}

static void test_rows_may_be_converted_in_place(void)
{
    uint8_t row[3 * WIDTH], apart[3 * WIDTH];
    for (unsigned k = 0; k < OPERATORS; k++) {
        fill_row(row);
        TEST_ASSERT_EQUAL_INT(PEL_OK, operators[k](row, apart, WIDTH));
        TEST_ASSERT_EQUAL_INT(PEL_OK, operators[k](row, row, WIDTH));
        TEST_ASSERT_EQUAL_UINT8_ARRAY(apart, row, 3 * WIDTH);
    }
}

static void test_rows_write_exactly_their_width(void)
{
    uint8_t row[3 * WIDTH], out[3 * WIDTH + 2]; /* a canary on each side */
    fill_row(row);
    for (unsigned k = 0; k < OPERATORS; k++) {
        for (uint16_t width = 0; width <= WIDTH; width++) {
            for (unsigned i = 0; i < sizeof out; i++) {
                out[i] = CANARY;
            }
            TEST_ASSERT_EQUAL_INT(PEL_OK, operators[k](row, out + 1, width));
            TEST_ASSERT_EQUAL_HEX8(CANARY, out[0]);
            TEST_ASSERT_EQUAL_HEX8(CANARY, out[1 + 3 * width]);
        }
    }
}

static void test_null_pointers_are_refused(void)
{
    uint8_t row[3] = {1, 2, 3};
    for (unsigned k = 0; k < OPERATORS; k++) {
        TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, operators[k](NULL, row, 1));
        TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, operators[k](row, NULL, 1));
    }
}

static void test_unknown_ranges_are_refused_and_nothing_is_written(void)
{
    static const uint8_t untouched[3] = {CANARY, CANARY, CANARY};
    static const uint8_t src[3] = {1, 2, 3};
    uint8_t out[3] = {CANARY, CANARY, CANARY};
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_rgb_to_ycbcr_row(src, out, 1, (pel_range)2));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_ycbcr_to_rgb_row(src, out, 1, (pel_range)2));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(untouched, out, 3);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_rgb_to_full_range);
    RUN_TEST(test_rgb_to_limited_range);
    RUN_TEST(test_grays_have_no_chroma_in_either_range);
    RUN_TEST(test_full_range_to_rgb);
    RUN_TEST(test_limited_range_to_rgb);
    RUN_TEST(test_grays_come_back_unchanged_from_full_range);
    RUN_TEST(test_nrgb_of_known_colors);
    RUN_TEST(test_nrgb_of_black_is_gray_and_never_a_division_by_zero);
    RUN_TEST(test_nrgb_of_colors_darker_than_the_limit_is_gray);
    RUN_TEST(test_nrgb_at_the_highest_limit_keeps_only_white);
    RUN_TEST(test_hsv_of_known_colors);
    RUN_TEST(test_hue_wraps_below_red);
    RUN_TEST(test_hue_within_an_arc_includes_both_ends);
    RUN_TEST(test_hue_within_an_arc_through_red);
    RUN_TEST(test_hue_within_the_whole_circle);
    RUN_TEST(test_a_row_is_its_pixels_one_by_one);
    RUN_TEST(test_rows_may_be_converted_in_place);
    RUN_TEST(test_rows_write_exactly_their_width);
    RUN_TEST(test_null_pointers_are_refused);
    RUN_TEST(test_unknown_ranges_are_refused_and_nothing_is_written);
    return UNITY_END();
}
