/*
 * Tables, histograms, white balance. Expected values are computed by hand from the formulas of
 * point.h or come from the tables of a lecture on image processing; every size and picture against
 * exact fractions and OpenCV is in tests/oracle.
 */
#include "unity.h"

#include <pel.h>
#include <pel/point.h>

static uint8_t table[256];
static uint32_t bins[256];

void setUp(void)
{
    for (unsigned i = 0; i < 256; i++) {
        table[i] = 0x5A;
        bins[i] = 0;
    }
}

void tearDown(void)
{
}

#define EXPECT(status, call) TEST_ASSERT_EQUAL_INT(status, call)

static pel_cview gray(const uint8_t *pixels, uint16_t width, uint16_t height)
{
    pel_cview view;
    EXPECT(PEL_OK, pel_cview_init(pixels, PEL_GRAY8, PEL_RANGE_FULL, width, height, 0, &view));
    return view;
}

static pel_view gray_to_write(uint8_t *pixels, uint16_t width, uint16_t height)
{
    pel_view view;
    EXPECT(PEL_OK, pel_view_init(pixels, PEL_GRAY8, PEL_RANGE_FULL, width, height, 0, &view));
    return view;
}

/* ---- Tables -------------------------------------------------------------------------------- */

static const uint8_t gamma_in[8] = {1, 16, 32, 64, 128, 192, 254, 255};

/* 255 (in / 255)^0.4 and 255 (in / 255)^2.5. */
static const uint8_t gamma_brighter[8] = {28, 84, 111, 147, 194, 228, 255, 255};
static const uint8_t gamma_darker[8] = {0, 0, 1, 8, 46, 125, 253, 255};

static void expect_at(const uint8_t *in, const uint8_t *out, unsigned count)
{
    for (unsigned i = 0; i < count; i++) {
        TEST_ASSERT_EQUAL_UINT8(out[i], table[in[i]]);
    }
}

static void test_gamma_of_the_lecture(void)
{
    EXPECT(PEL_OK, pel_table_gamma_exponent(2, 5, table));
    expect_at(gamma_in, gamma_brighter, 8);
    EXPECT(PEL_OK, pel_table_gamma_exponent(5, 2, table));
    expect_at(gamma_in, gamma_darker, 8);
}

static void test_gamma_by_direction(void)
{
    EXPECT(PEL_OK, pel_table_gamma_brighten(5, 2, table));
    expect_at(gamma_in, gamma_brighter, 8);
    EXPECT(PEL_OK, pel_table_gamma_darken(5, 2, table));
    expect_at(gamma_in, gamma_darker, 8);
    EXPECT(PEL_OK, pel_table_gamma_brighten(3, 3, table));
    TEST_ASSERT_EQUAL_UINT8(16, table[16]);
    EXPECT(PEL_OK, pel_table_gamma_darken(5, 2, table));
    EXPECT(PEL_ERR_RANGE, pel_table_gamma_brighten(2, 5, table));
    EXPECT(PEL_ERR_RANGE, pel_table_gamma_darken(2, 5, table));
    expect_at(gamma_in, gamma_darker, 8); /* refused: untouched */
}

/* in^2 / 255 is never a half; sqrt(255 in) at 1: 15.97. The largest terms are the last of these. */
static void test_gamma_of_known_exponents(void)
{
    EXPECT(PEL_OK, pel_table_gamma_exponent(1, 1, table));
    for (unsigned i = 0; i < 256; i++) {
        TEST_ASSERT_EQUAL_UINT8(i, table[i]);
    }
    EXPECT(PEL_OK, pel_table_gamma_exponent(2, 1, table));
    for (uint32_t i = 0; i < 256; i++) {
        TEST_ASSERT_EQUAL_UINT8((2 * i * i + 255) / 510, table[i]);
    }
    EXPECT(PEL_OK, pel_table_gamma_exponent(32, 32, table));
    for (unsigned i = 0; i < 256; i++) {
        TEST_ASSERT_EQUAL_UINT8(i, table[i]);
    }
    EXPECT(PEL_OK, pel_table_gamma_exponent(1, 32, table)); /* 255 / 255^(1/32) = 214.46 */
    TEST_ASSERT_EQUAL_UINT8(0, table[0]);
    TEST_ASSERT_EQUAL_UINT8(214, table[1]);
    EXPECT(PEL_OK, pel_table_gamma_exponent(32, 1, table)); /* 255 (254/255)^32 = 224.87 */
    TEST_ASSERT_EQUAL_UINT8(0, table[200]);
    TEST_ASSERT_EQUAL_UINT8(225, table[254]);
    TEST_ASSERT_EQUAL_UINT8(255, table[255]);
}

static void test_gamma_refuses(void)
{
    EXPECT(PEL_ERR_ARG, pel_table_gamma_exponent(0, 1, table));
    EXPECT(PEL_ERR_ARG, pel_table_gamma_exponent(1, 0, table));
    EXPECT(PEL_ERR_ARG, pel_table_gamma_exponent(33, 1, table));
    EXPECT(PEL_ERR_ARG, pel_table_gamma_exponent(1, 33, table));
    EXPECT(PEL_ERR_ARG, pel_table_gamma_exponent(1, 1, NULL));
    EXPECT(PEL_ERR_ARG, pel_table_gamma_brighten(1, 0, table));
    EXPECT(PEL_ERR_ARG, pel_table_gamma_darken(33, 1, table));
    TEST_ASSERT_EQUAL_UINT8(0x5A, table[0]);
}

/* A contrast of 1.3 and a brightness of 40: 164 gives 253.2, 165 exactly 254.5, and 166 and all
 * above are over 255. */
static void test_linear_of_the_lecture(void)
{
    EXPECT(PEL_OK, pel_table_linear(13, 400, 10, table));
    TEST_ASSERT_EQUAL_UINT8(40, table[0]);
    TEST_ASSERT_EQUAL_UINT8(170, table[100]);
    TEST_ASSERT_EQUAL_UINT8(253, table[164]);
    for (unsigned i = 165; i < 256; i++) {
        TEST_ASSERT_EQUAL_UINT8(255, table[i]);
    }
    /* One less shows where the limit begins: 253.5 and 254.8 were 254.5 and 255.8. */
    EXPECT(PEL_OK, pel_table_linear(13, 390, 10, table));
    TEST_ASSERT_EQUAL_UINT8(254, table[165]);
    TEST_ASSERT_EQUAL_UINT8(255, table[166]);
}

/* 0.15 of 255 is 38.25. */
static void test_brightness_of_the_lecture(void)
{
    uint8_t exact[256];

    EXPECT(PEL_OK, pel_table_linear(100, 3825, 100, exact));
    EXPECT(PEL_OK, pel_table_brightness(38, table));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(exact, table, 256);
    TEST_ASSERT_EQUAL_UINT8(38, table[0]);
    TEST_ASSERT_EQUAL_UINT8(254, table[216]);
    TEST_ASSERT_EQUAL_UINT8(255, table[217]);
    TEST_ASSERT_EQUAL_UINT8(255, table[218]);
    EXPECT(PEL_OK, pel_table_brightness(-38, table));
    TEST_ASSERT_EQUAL_UINT8(0, table[37]);
    TEST_ASSERT_EQUAL_UINT8(1, table[39]);
    TEST_ASSERT_EQUAL_UINT8(217, table[255]);
}

/* Halves go upward on both sides of the pivot: -0.5 becomes 0, -1.5 becomes -1. */
static void test_contrast_around_pivot(void)
{
    static const uint8_t in[7] = {0, 125, 127, 128, 129, 131, 255};
    static const uint8_t out[7] = {64, 127, 128, 128, 129, 130, 192};

    EXPECT(PEL_OK, pel_table_contrast(1, 2, 128, table));
    expect_at(in, out, 7);
    EXPECT(PEL_OK, pel_table_contrast(512, 256, 100, table));
    TEST_ASSERT_EQUAL_UINT8(0, table[50]);
    TEST_ASSERT_EQUAL_UINT8(2, table[51]);
    TEST_ASSERT_EQUAL_UINT8(100, table[100]);
    TEST_ASSERT_EQUAL_UINT8(254, table[177]);
    TEST_ASSERT_EQUAL_UINT8(255, table[178]);
    EXPECT(PEL_OK, pel_table_contrast(-1, 1, 100, table));
    TEST_ASSERT_EQUAL_UINT8(200, table[0]);
    TEST_ASSERT_EQUAL_UINT8(0, table[200]);
}

static void test_linear_limits(void)
{
    const int32_t most = (int32_t)1 << 21;

    EXPECT(PEL_OK, pel_table_linear(most, (int32_t)1 << 29, (int32_t)1 << 30, table));
    TEST_ASSERT_EQUAL_UINT8(1, table[0]); /* a half */
    EXPECT(PEL_OK, pel_table_linear(-most, -((int32_t)1 << 29), 1, table));
    TEST_ASSERT_EQUAL_UINT8(0, table[255]);
    EXPECT(PEL_OK, pel_table_contrast(most, 1, 0, table));
    TEST_ASSERT_EQUAL_UINT8(255, table[255]);
    EXPECT(PEL_ERR_ARG, pel_table_linear(most + 1, 0, 1, table));
    EXPECT(PEL_ERR_ARG, pel_table_linear(-most - 1, 0, 1, table));
    EXPECT(PEL_ERR_ARG, pel_table_linear(1, ((int32_t)1 << 29) + 1, 1, table));
    EXPECT(PEL_ERR_ARG, pel_table_linear(1, 0, 0, table));
    EXPECT(PEL_ERR_ARG, pel_table_linear(1, 0, -1, table));
    EXPECT(PEL_ERR_ARG, pel_table_linear(1, 0, ((int32_t)1 << 30) + 1, table));
    EXPECT(PEL_ERR_ARG, pel_table_contrast(most + 1, 1, 0, table));
    EXPECT(PEL_ERR_ARG, pel_table_contrast(1, 0, 0, table));
    EXPECT(PEL_ERR_ARG, pel_table_contrast(1, most + 1, 0, table));
    EXPECT(PEL_ERR_ARG, pel_table_brightness(0, NULL));
    EXPECT(PEL_ERR_ARG, pel_table_threshold(0, NULL));
    EXPECT(PEL_ERR_ARG, pel_table_invert(NULL));
}

static void test_invert_and_threshold(void)
{
    EXPECT(PEL_OK, pel_table_invert(table));
    TEST_ASSERT_EQUAL_UINT8(255, table[0]);
    TEST_ASSERT_EQUAL_UINT8(55, table[200]);
    TEST_ASSERT_EQUAL_UINT8(0, table[255]);
    EXPECT(PEL_OK, pel_table_threshold(100, table));
    TEST_ASSERT_EQUAL_UINT8(0, table[100]);
    TEST_ASSERT_EQUAL_UINT8(255, table[101]);
    EXPECT(PEL_OK, pel_table_threshold(255, table));
    TEST_ASSERT_EQUAL_UINT8(0, table[255]);
}

static void test_table_on_frames(void)
{
    uint8_t pixels[6] = {0, 1, 2, 253, 254, 255};
    static const uint8_t inverted[6] = {255, 254, 253, 2, 1, 0};
    uint8_t out[7] = {9, 9, 9, 9, 9, 9, 9};
    pel_cview src = gray(pixels, 3, 2);
    pel_view dst = gray_to_write(out, 3, 2);

    EXPECT(PEL_OK, pel_table_invert(table));
    EXPECT(PEL_OK, pel_table_frame(table, &src, &dst));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(inverted, out, 6);
    TEST_ASSERT_EQUAL_UINT8(9, out[6]);
    dst = gray_to_write(pixels, 3, 2);
    EXPECT(PEL_OK, pel_table_frame(table, &src, &dst));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(inverted, pixels, 6);
    EXPECT(PEL_OK, pel_table_row(table, pixels, 6, pixels));
    TEST_ASSERT_EQUAL_UINT8(255, pixels[5]);
    EXPECT(PEL_ERR_ARG, pel_table_row(NULL, pixels, 6, pixels));
    EXPECT(PEL_ERR_ARG, pel_table_row(table, NULL, 6, pixels));
    EXPECT(PEL_ERR_ARG, pel_table_row(table, pixels, 6, NULL));
}

/* Every value in rows wide enough for any vector, twice. */
static void test_thresholds_on_every_backend(void)
{
    static uint8_t pixels[512], out[512];
    const pel_cview src = gray(pixels, 128, 4);
    const pel_view dst = gray_to_write(out, 128, 4);

    for (unsigned i = 0; i < 512; i++) {
        pixels[i] = (uint8_t)i;
    }
    EXPECT(PEL_OK, pel_table_threshold(99, table));
    for (unsigned b = 0; b < PEL_BACKEND_COUNT; b++) {
        for (unsigned i = 0; i < 512; i++) {
            out[i] = 7;
        }
        EXPECT(PEL_OK, pel_table_frame_with(table, &src, &dst, (pel_backend)b));
        for (unsigned i = 0; i < 512; i++) {
            TEST_ASSERT_EQUAL_UINT8(i % 256 > 99 ? 255 : 0, out[i]);
        }
        EXPECT(PEL_OK, pel_histogram_frame_with(&src, 0, bins, (pel_backend)b));
        for (unsigned i = 0; i < 256; i++) {
            TEST_ASSERT_EQUAL_UINT32(2, bins[i]);
        }
    }
}

/* What all frame forms check: overlap, size, format, null pointers. */
static void test_frames_that_are_refused(void)
{
    uint8_t pixels[24] = {0};
    uint8_t others[24];
    pel_cview src = gray(pixels, 3, 2);
    pel_view dst = gray_to_write(pixels + 1, 3, 2);

    EXPECT(PEL_OK, pel_table_invert(table));
    EXPECT(PEL_ERR_ARG, pel_table_frame(table, &src, &dst)); /* begins inside */
    dst = gray_to_write(pixels + 5, 3, 2);
    EXPECT(PEL_ERR_ARG, pel_table_frame(table, &src, &dst)); /* begins on the last byte */
    dst = gray_to_write(pixels + 6, 3, 2);
    EXPECT(PEL_OK, pel_table_frame(table, &src, &dst)); /* begins right behind */
    src = gray(pixels + 12, 3, 2);
    EXPECT(PEL_OK, pel_table_frame(table, &src, &dst)); /* ends right before */
    src = gray(pixels + 11, 3, 2);
    EXPECT(PEL_ERR_ARG, pel_table_frame(table, &src, &dst)); /* ends on the first byte */
    src = gray(pixels, 3, 2);
    dst = gray_to_write(others, 2, 2);
    EXPECT(PEL_ERR_SPACE, pel_table_frame(table, &src, &dst));
    dst = gray_to_write(others, 3, 2);
    dst.format = PEL_RGB888;
    dst.stride_bytes[0] = 9;
    EXPECT(PEL_ERR_FORMAT, pel_table_frame(table, &src, &dst));
    EXPECT(PEL_ERR_ARG, pel_table_frame(NULL, &src, &dst));
    EXPECT(PEL_ERR_ARG, pel_table_frame(table, NULL, &dst));
    EXPECT(PEL_ERR_ARG, pel_table_frame(table, &src, NULL));
    EXPECT(PEL_OK, pel_cview_init(pixels, PEL_YUYV, PEL_RANGE_FULL, 2, 2, 0, &src));
    EXPECT(PEL_OK, pel_view_init(others, PEL_YUYV, PEL_RANGE_FULL, 2, 2, 0, &dst));
    EXPECT(PEL_ERR_FORMAT, pel_table_frame(table, &src, &dst));
    TEST_ASSERT_EQUAL_UINT8(0, pixels[0]);
}

/* Two halves of one picture are apart, one upside down too; half a column more and they are not. */
static void test_parts_of_one_picture(void)
{
    uint8_t pixels[24];
    pel_view whole = gray_to_write(pixels, 8, 3);
    pel_view left, right;
    pel_cview src;

    for (unsigned i = 0; i < 24; i++) {
        pixels[i] = (uint8_t)i;
    }
    EXPECT(PEL_OK, pel_table_invert(table));
    EXPECT(PEL_OK, pel_view_crop(&whole, 0, 4, 0, 3, &left));
    EXPECT(PEL_OK, pel_view_crop(&whole, 4, 8, 0, 3, &right));
    src = pel_view_to_read(&left);
    EXPECT(PEL_OK, pel_table_frame(table, &src, &right));
    TEST_ASSERT_EQUAL_UINT8(255, pixels[4]);
    TEST_ASSERT_EQUAL_UINT8(255 - 19, pixels[23]);
    right.plane[0] += 16;
    right.stride_bytes[0] = -8;
    EXPECT(PEL_OK, pel_table_frame(table, &src, &right));
    TEST_ASSERT_EQUAL_UINT8(255, pixels[20]);
    TEST_ASSERT_EQUAL_UINT8(255 - 19, pixels[7]);
    right.plane[0]--;
    EXPECT(PEL_ERR_ARG, pel_table_frame(table, &src, &right));
    TEST_ASSERT_EQUAL_UINT8(19, pixels[19]);
}

/* ---- Histograms ---------------------------------------------------------------------------- */

static void test_histogram(void)
{
    static const uint8_t rgb[12] = {1, 2, 3, 1, 255, 3, 0, 2, 3, 1, 2, 255};
    uint32_t cumulative[256];
    pel_cview view;

    EXPECT(PEL_OK, pel_histogram_row(rgb, 1, 12, bins));
    TEST_ASSERT_EQUAL_UINT32(1, bins[0]);
    TEST_ASSERT_EQUAL_UINT32(3, bins[1]);
    TEST_ASSERT_EQUAL_UINT32(2, bins[255]);
    EXPECT(PEL_OK, pel_cview_init(rgb, PEL_RGB888, PEL_RANGE_FULL, 2, 2, 0, &view));
    EXPECT(PEL_OK, pel_histogram_frame(&view, 1, bins)); /* 2 255 2 2 */
    TEST_ASSERT_EQUAL_UINT32(0, bins[0]);
    TEST_ASSERT_EQUAL_UINT32(3, bins[2]);
    TEST_ASSERT_EQUAL_UINT32(1, bins[255]);
    EXPECT(PEL_OK, pel_histogram_cumulative(bins, cumulative));
    TEST_ASSERT_EQUAL_UINT32(0, cumulative[1]);
    TEST_ASSERT_EQUAL_UINT32(3, cumulative[2]);
    TEST_ASSERT_EQUAL_UINT32(3, cumulative[254]);
    TEST_ASSERT_EQUAL_UINT32(4, cumulative[255]);
    EXPECT(PEL_OK, pel_histogram_cumulative(bins, bins));
    TEST_ASSERT_EQUAL_UINT32_ARRAY(cumulative, bins, 256);
    EXPECT(PEL_ERR_ARG, pel_histogram_frame(&view, 3, bins));
    EXPECT(PEL_ERR_ARG, pel_histogram_frame(&view, 0, NULL));
    EXPECT(PEL_ERR_ARG, pel_histogram_row(rgb, 0, 12, bins));
    EXPECT(PEL_ERR_ARG, pel_histogram_row(NULL, 1, 12, bins));
    EXPECT(PEL_ERR_ARG, pel_histogram_cumulative(NULL, bins));
}

/* 1 2 3 4: mean 2.5, variance 1.25. 0 0 1: mean 1/3 (85.33 / 256), variance 2/9 (56.89 / 256). */
static void test_mean_and_variance(void)
{
    pel_histogram_stats stats;

    bins[1] = bins[2] = bins[3] = bins[4] = 1;
    EXPECT(PEL_OK, pel_histogram_measure(bins, &stats));
    TEST_ASSERT_EQUAL_UINT32(4, stats.count);
    TEST_ASSERT_EQUAL_UINT32(10, (uint32_t)stats.sum);
    TEST_ASSERT_EQUAL_UINT32(30, (uint32_t)stats.sum_squares);
    TEST_ASSERT_EQUAL_UINT32(640, stats.mean_q8);
    TEST_ASSERT_EQUAL_UINT32(320, stats.variance_q8);
    TEST_ASSERT_EQUAL_UINT8(1, stats.min);
    TEST_ASSERT_EQUAL_UINT8(4, stats.max);
    bins[1] = 1;
    bins[0] = 2;
    bins[2] = bins[3] = bins[4] = 0;
    EXPECT(PEL_OK, pel_histogram_measure(bins, &stats));
    TEST_ASSERT_EQUAL_UINT32(85, stats.mean_q8);
    TEST_ASSERT_EQUAL_UINT32(57, stats.variance_q8);
    TEST_ASSERT_EQUAL_UINT8(0, stats.min);
    TEST_ASSERT_EQUAL_UINT8(1, stats.max);
    bins[1] = 4; /* 0 0 1 1 1 1: mean 170.67 / 256 */
    EXPECT(PEL_OK, pel_histogram_measure(bins, &stats));
    TEST_ASSERT_EQUAL_UINT32(171, stats.mean_q8);
}

/* 2^26 values, half of them 0 and half 255: mean 127.5, variance 127.5^2 = 16256.25, the largest
 * there is. */
static void test_most_values(void)
{
    const uint32_t most = (uint32_t)1 << 26;
    pel_histogram_stats stats;
    uint8_t value;

    bins[0] = bins[255] = most / 2;
    EXPECT(PEL_OK, pel_histogram_measure(bins, &stats));
    TEST_ASSERT_EQUAL_UINT32(32640, stats.mean_q8);
    TEST_ASSERT_EQUAL_UINT32(4161600, stats.variance_q8);
    EXPECT(PEL_OK, pel_histogram_otsu(bins, &value));
    TEST_ASSERT_EQUAL_UINT8(0, value);
    bins[0]++;
    EXPECT(PEL_ERR_RANGE, pel_histogram_measure(bins, &stats));
    EXPECT(PEL_ERR_RANGE, pel_histogram_otsu(bins, &value));
    EXPECT(PEL_ERR_RANGE, pel_histogram_percentile(bins, 500, &value));
    EXPECT(PEL_ERR_RANGE, pel_table_equalize(bins, table));
    TEST_ASSERT_EQUAL_UINT8(0x5A, table[0]);
    bins[0] = 0;
    bins[255] = most;
    EXPECT(PEL_OK, pel_histogram_measure(bins, &stats));
    TEST_ASSERT_EQUAL_UINT32(65280, stats.mean_q8);
    TEST_ASSERT_EQUAL_UINT32(0, stats.variance_q8);
}

static void test_histograms_that_are_refused(void)
{
    pel_histogram_stats stats;
    uint8_t value = 77;

    EXPECT(PEL_ERR_ARG, pel_histogram_measure(bins, &stats)); /* no values */
    EXPECT(PEL_ERR_ARG, pel_histogram_otsu(bins, &value));
    EXPECT(PEL_ERR_ARG, pel_histogram_percentile(bins, 500, &value));
    EXPECT(PEL_ERR_ARG, pel_table_equalize(bins, table));
    bins[9] = 1;
    EXPECT(PEL_ERR_ARG, pel_histogram_percentile(bins, 1001, &value));
    EXPECT(PEL_ERR_ARG, pel_histogram_percentile(bins, 1000, NULL));
    EXPECT(PEL_ERR_ARG, pel_histogram_measure(NULL, &stats));
    EXPECT(PEL_ERR_ARG, pel_histogram_measure(bins, NULL));
    EXPECT(PEL_ERR_ARG, pel_histogram_otsu(bins, NULL));
    EXPECT(PEL_ERR_ARG, pel_table_equalize(bins, NULL));
    TEST_ASSERT_EQUAL_UINT8(77, value);
}

/* 5 7 7 9: half of the values do not exceed 7, a quarter 5, three quarters 7, more than that 9. */
static void test_percentile(void)
{
    static const uint16_t permille[7] = {0, 1, 250, 251, 750, 751, 1000};
    static const uint8_t expected[7] = {5, 5, 5, 7, 7, 9, 9};

    bins[5] = bins[9] = 1;
    bins[7] = 2;
    for (unsigned i = 0; i < 7; i++) {
        uint8_t value;
        EXPECT(PEL_OK, pel_histogram_percentile(bins, permille[i], &value));
        TEST_ASSERT_EQUAL_UINT8(expected[i], value);
    }
}

/* 0 1 2: both splits have 1 * 2 values and means 1.5 apart. 0 0 1 2 2 2: after 0, 2 * 4 * (7/4)^2 =
 * 24.5; after 1, 3 * 3 * (5/3)^2 = 25. */
static void test_otsu(void)
{
    uint8_t threshold = 99;

    bins[0] = bins[1] = bins[2] = 1;
    EXPECT(PEL_OK, pel_histogram_otsu(bins, &threshold));
    TEST_ASSERT_EQUAL_UINT8(0, threshold);
    bins[0] = 2;
    bins[2] = 3;
    EXPECT(PEL_OK, pel_histogram_otsu(bins, &threshold));
    TEST_ASSERT_EQUAL_UINT8(1, threshold);
    bins[0] = bins[1] = 0;
    EXPECT(PEL_OK, pel_histogram_otsu(bins, &threshold));
    TEST_ASSERT_EQUAL_UINT8(0, threshold); /* one value only */
    bins[200] = 1;
    EXPECT(PEL_OK, pel_histogram_otsu(bins, &threshold));
    TEST_ASSERT_EQUAL_UINT8(2, threshold);
}

/* 10 10 20 30: 255 * 1/2 = 127.5 for 20. */
static void test_equalize(void)
{
    static const uint8_t in[8] = {0, 9, 10, 19, 20, 29, 30, 255};
    static const uint8_t out[8] = {0, 0, 0, 0, 128, 128, 255, 255};

    bins[10] = 2;
    bins[20] = bins[30] = 1;
    EXPECT(PEL_OK, pel_table_equalize(bins, table));
    expect_at(in, out, 8);
    bins[20] = bins[30] = 0;
    EXPECT(PEL_OK, pel_table_equalize(bins, table));
    expect_at(in, in, 8);
}

/* ---- White balance ------------------------------------------------------------------------- */

/* Sums 100, 200, 50: G over channel is 2, 1, 4; (350 / 3) over channel 1.1667, 0.5833, 2.3333. */
static void test_gains(void)
{
    static const uint8_t rgb[6] = {40, 150, 0, 60, 50, 50};
    static const uint16_t patch[3] = {512, 256, 1024};
    static const uint16_t world[3] = {299, 149, 597};
    pel_rgb_sums sums = {{0, 0, 0}, 0};
    uint16_t gains[3] = {7, 7, 7};
    pel_cview bgr;

    EXPECT(PEL_OK, pel_rgb_sums_row(rgb, 2, &sums));
    TEST_ASSERT_EQUAL_UINT32(2, sums.count);
    EXPECT(PEL_OK, pel_gains_gray_patch(&sums, gains));
    TEST_ASSERT_EQUAL_UINT16_ARRAY(patch, gains, 3);
    EXPECT(PEL_OK, pel_gains_gray_world(&sums, gains));
    TEST_ASSERT_EQUAL_UINT16_ARRAY(world, gains, 3);
    EXPECT(PEL_OK, pel_cview_init(rgb, PEL_BGR888, PEL_RANGE_FULL, 1, 2, 0, &bgr));
    EXPECT(PEL_OK, pel_rgb_sums_frame(&bgr, &sums));
    TEST_ASSERT_EQUAL_UINT32(50, (uint32_t)sums.sum[0]);
    TEST_ASSERT_EQUAL_UINT32(200, (uint32_t)sums.sum[1]);
    TEST_ASSERT_EQUAL_UINT32(100, (uint32_t)sums.sum[2]);
    TEST_ASSERT_EQUAL_UINT32(2, sums.count);
}

static void test_gains_refused(void)
{
    static const uint8_t rgb[3] = {1, 2, 3};
    const uint32_t most = (uint32_t)1 << 26;
    pel_rgb_sums sums = {{1, 255, 255}, 1};
    uint16_t gains[3] = {7, 7, 7};

    EXPECT(PEL_OK, pel_gains_gray_patch(&sums, gains)); /* 255 * 256 */
    TEST_ASSERT_EQUAL_UINT16(65280, gains[0]);
    gains[0] = 7;
    sums.sum[1] = 256;
    EXPECT(PEL_ERR_RANGE, pel_gains_gray_patch(&sums, gains)); /* 65536 */
    sums.sum[2] = 0;
    EXPECT(PEL_ERR_RANGE, pel_gains_gray_world(&sums, gains));
    TEST_ASSERT_EQUAL_UINT16(7, gains[0]);
    EXPECT(PEL_ERR_ARG, pel_gains_gray_patch(NULL, gains));
    EXPECT(PEL_ERR_ARG, pel_gains_gray_world(&sums, NULL));
    sums.count = most - 1;
    EXPECT(PEL_OK, pel_rgb_sums_row(rgb, 1, &sums));
    EXPECT(PEL_ERR_RANGE, pel_rgb_sums_row(rgb, 1, &sums));
    TEST_ASSERT_EQUAL_UINT32(most, sums.count);
    EXPECT(PEL_ERR_ARG, pel_rgb_sums_row(NULL, 1, &sums));
}

/* The brightest picture there is: sums of 255 * 2^26. */
static void test_gains_at_the_bound(void)
{
    const uint64_t white = (uint64_t)255 << 26;
    const pel_rgb_sums sums = {{white, white, white}, (uint32_t)1 << 26};
    const uint16_t one[3] = {256, 256, 256};
    uint16_t gains[3];

    EXPECT(PEL_OK, pel_gains_gray_patch(&sums, gains));
    TEST_ASSERT_EQUAL_UINT16_ARRAY(one, gains, 3);
    EXPECT(PEL_OK, pel_gains_gray_world(&sums, gains));
    TEST_ASSERT_EQUAL_UINT16_ARRAY(one, gains, 3);
}

/* 100 * 2, 10 * 0.5, 200 * 1.5 limited; 1 * 0.498 and 1 * 0.5. */
static void test_white_balance(void)
{
    static const uint16_t gains[3] = {512, 128, 384};
    static const uint16_t thirds[3] = {127, 128, 65535};
    static const uint8_t expected[6] = {200, 5, 255, 0, 1, 0};
    static const uint8_t reversed[6] = {150, 5, 255, 0, 1, 0};
    uint8_t pixels[6] = {100, 10, 200, 0, 1, 0};
    uint8_t out[6];
    pel_cview src;
    pel_view dst;

    EXPECT(PEL_OK, pel_white_balance_row(gains, pixels, 2, out));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, out, 6);
    EXPECT(PEL_OK, pel_cview_init(pixels, PEL_BGR888, PEL_RANGE_FULL, 2, 1, 0, &src));
    EXPECT(PEL_OK, pel_view_init(pixels, PEL_BGR888, PEL_RANGE_FULL, 2, 1, 0, &dst));
    EXPECT(PEL_OK, pel_white_balance_frame(gains, &src, &dst));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(reversed, pixels, 6);
    pixels[0] = pixels[1] = 1;
    pixels[2] = 255;
    EXPECT(PEL_OK, pel_white_balance_row(thirds, pixels, 1, pixels));
    TEST_ASSERT_EQUAL_UINT8(0, pixels[0]);
    TEST_ASSERT_EQUAL_UINT8(1, pixels[1]);
    TEST_ASSERT_EQUAL_UINT8(255, pixels[2]);
    EXPECT(PEL_ERR_ARG, pel_white_balance_row(NULL, pixels, 1, out));
    EXPECT(PEL_ERR_ARG, pel_white_balance_row(gains, NULL, 1, out));
    src = gray(pixels, 2, 1);
    dst = gray_to_write(pixels, 2, 1);
    EXPECT(PEL_ERR_FORMAT, pel_white_balance_frame(gains, &src, &dst));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_gamma_of_the_lecture);
    RUN_TEST(test_gamma_by_direction);
    RUN_TEST(test_gamma_of_known_exponents);
    RUN_TEST(test_gamma_refuses);
    RUN_TEST(test_linear_of_the_lecture);
    RUN_TEST(test_brightness_of_the_lecture);
    RUN_TEST(test_contrast_around_pivot);
    RUN_TEST(test_linear_limits);
    RUN_TEST(test_invert_and_threshold);
    RUN_TEST(test_table_on_frames);
    RUN_TEST(test_thresholds_on_every_backend);
    RUN_TEST(test_frames_that_are_refused);
    RUN_TEST(test_parts_of_one_picture);
    RUN_TEST(test_histogram);
    RUN_TEST(test_mean_and_variance);
    RUN_TEST(test_most_values);
    RUN_TEST(test_histograms_that_are_refused);
    RUN_TEST(test_percentile);
    RUN_TEST(test_otsu);
    RUN_TEST(test_equalize);
    RUN_TEST(test_gains);
    RUN_TEST(test_gains_refused);
    RUN_TEST(test_gains_at_the_bound);
    RUN_TEST(test_white_balance);
    return UNITY_END();
}
