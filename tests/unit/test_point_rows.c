/*
 * Rows with rows, integral rows, the adaptive threshold, resizing. Expected values are computed by
 * hand from the formulas of point.h; every size and picture against exact fractions and OpenCV is
 * in tests/oracle.
 */
#include "unity.h"

#include <pel.h>
#include <pel/point.h>

static uint32_t work[160];

void setUp(void)
{
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

/* ---- Two rows ------------------------------------------------------------------------------ */

static void test_combine(void)
{
    static const uint8_t a[6] = {0, 200, 100, 255, 0xF0, 1};
    static const uint8_t b[6] = {0, 100, 200, 255, 0x3C, 255};
    static const uint8_t expected[PEL_COMBINE_OP_COUNT][6] = {
        {0, 255, 255, 255, 255, 255},    {0, 100, 0, 0, 0xB4, 0},
        {0, 100, 100, 0, 0xB4, 254},     {0, 100, 100, 255, 0x3C, 1},
        {0, 200, 200, 255, 0xF0, 255},   {0, 0x40, 0x40, 255, 0x30, 1},
        {0, 0xEC, 0xEC, 255, 0xFC, 255}, {0, 0xAC, 0xAC, 0, 0xCC, 254}};
    uint8_t out[6];

    for (unsigned op = 0; op < PEL_COMBINE_OP_COUNT; op++) {
        EXPECT(PEL_OK, pel_combine_row((pel_combine_op)op, a, b, 6, out));
        TEST_ASSERT_EQUAL_UINT8_ARRAY(expected[op], out, 6);
    }
    EXPECT(PEL_ERR_ARG, pel_combine_row(PEL_COMBINE_OP_COUNT, a, b, 6, out));
    EXPECT(PEL_ERR_ARG, pel_combine_row(PEL_COMBINE_ADD, NULL, b, 6, out));
    EXPECT(PEL_ERR_ARG, pel_combine_row(PEL_COMBINE_ADD, a, NULL, 6, out));
    EXPECT(PEL_ERR_ARG, pel_combine_row(PEL_COMBINE_ADD, a, b, 6, NULL));
}

static void test_combine_frames(void)
{
    uint8_t a[4] = {1, 2, 3, 4};
    uint8_t b[6] = {10, 20, 30, 40, 50, 60};
    static const uint8_t sum[4] = {11, 22, 33, 44};
    const pel_cview va = gray(a, 2, 2);
    pel_cview vb = gray(b, 2, 2);
    pel_view dst = gray_to_write(b, 2, 2);

    EXPECT(PEL_OK, pel_combine_frame(PEL_COMBINE_ADD, &va, &vb, &dst));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(sum, b, 4);
    EXPECT(PEL_ERR_ARG, pel_combine_frame(PEL_COMBINE_OP_COUNT, &va, &vb, &dst));
    vb = gray(b + 2, 2, 2);
    EXPECT(PEL_ERR_ARG, pel_combine_frame(PEL_COMBINE_ADD, &va, &vb, &dst));
    EXPECT(PEL_ERR_ARG, pel_blend_frame(128, &va, &vb, &dst));
    vb = gray(b, 2, 1);
    EXPECT(PEL_ERR_SPACE, pel_combine_frame(PEL_COMBINE_ADD, &va, &vb, &dst));
    vb = gray(b, 2, 2);
    EXPECT(PEL_ERR_ARG, pel_blend_frame(257, &va, &vb, &dst));
    EXPECT(PEL_OK, pel_blend_frame(256, &va, &vb, &dst));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(a, b, 4);
}

/* (a * 64 + b * 192) / 256 */
static void test_blend(void)
{
    static const uint8_t a[5] = {0, 255, 2, 0, 1};
    static const uint8_t b[5] = {0, 255, 0, 2, 0};
    static const uint8_t quarter[5] = {0, 255, 1, 2, 0}; /* 0.5 and 1.5 go upward */
    uint8_t out[5];

    EXPECT(PEL_OK, pel_blend_row(64, a, b, 5, out));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(quarter, out, 5);
    EXPECT(PEL_OK, pel_blend_row(0, a, b, 5, out));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(b, out, 5);
    EXPECT(PEL_OK, pel_blend_row(256, a, b, 5, out));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(a, out, 5);
    EXPECT(PEL_ERR_ARG, pel_blend_row(257, a, b, 5, out));
    EXPECT(PEL_ERR_ARG, pel_blend_row(1, a, b, 5, NULL));
}

/* ---- Integral ------------------------------------------------------------------------------ */

static void test_integral(void)
{
    static const uint8_t pixels[6] = {1, 2, 3, 4, 5, 255};
    static const uint32_t expected[12] = {0, 0, 0, 0, 0, 1, 3, 6, 0, 5, 12, 270};
    uint32_t sums[12];
    uint32_t row[4];
    const pel_cview src = gray(pixels, 3, 2);

    EXPECT(PEL_OK, pel_integral_frame(&src, sums, 4));
    TEST_ASSERT_EQUAL_UINT32_ARRAY(expected, sums, 12);
    TEST_ASSERT_EQUAL_UINT32(2 + 3 + 5 + 255, pel_integral_box(sums, sums + 8, 1, 3));
    TEST_ASSERT_EQUAL_UINT32(4, pel_integral_box(sums + 4, sums + 8, 0, 1));
    EXPECT(PEL_OK, pel_integral_row(NULL, 3, NULL, row));
    EXPECT(PEL_OK, pel_integral_row(pixels, 3, row, row));
    EXPECT(PEL_OK, pel_integral_row(pixels + 3, 3, row, row));
    TEST_ASSERT_EQUAL_UINT32_ARRAY(expected + 8, row, 4);
    EXPECT(PEL_ERR_SPACE, pel_integral_frame(&src, sums, 3));
    EXPECT(PEL_ERR_ARG, pel_integral_frame(&src, NULL, 4));
    EXPECT(PEL_ERR_ARG, pel_integral_row(NULL, 3, row, row));
    EXPECT(PEL_ERR_ARG, pel_integral_row(pixels, 3, row, NULL));
    EXPECT(PEL_ERR_RANGE, pel_integral_row(pixels, 0, row, row));
    EXPECT(PEL_ERR_RANGE, pel_integral_row(pixels, PEL_SIDE_MAX + 1, row, row));
}

/* The largest sum fits and the next one wraps; a box across the wrap is right. 8192 x 2057 is
 * refused before a pixel is read. */
static void test_integral_bounds(void)
{
    static const uint8_t white[2] = {255, 255};
    const uint32_t above[3] = {0, UINT32_MAX - 255, UINT32_MAX - 255};
    uint32_t sums[3];
    pel_cview src = gray(white, 1, 1);

    EXPECT(PEL_OK, pel_integral_row(white, 2, above, sums));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, sums[1]);
    TEST_ASSERT_EQUAL_UINT32(254, sums[2]);
    TEST_ASSERT_EQUAL_UINT32(255, pel_integral_box(above, sums, 1, 2));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX / 255, PEL_INTEGRAL_PIXELS_MAX);
    src.width = 8192;
    src.height = 2057;
    src.stride_bytes[0] = 8192;
    EXPECT(PEL_ERR_RANGE, pel_integral_frame(&src, sums, 8193));
}

/* ---- Adaptive threshold -------------------------------------------------------------------- */

static pel_adaptive_config adaptive_config(uint16_t width, uint16_t height, uint8_t radius,
                                           int16_t c)
{
    pel_adaptive_config config = {0};
    config.width = width;
    config.height = height;
    config.radius = radius;
    config.c = c;
    config.work = work;
    config.work_bytes = sizeof work;
    return config;
}

/* The sums of the 3 x 3 around each pixel, edges repeated: 78 55 32 / 55 40 25 / 32 25 18; means 9
 * 6 4 / 6 4 3 / 4 3 2. The 4 in the first row is over 32 / 9, but not over that rounded. */
static void test_adaptive_by_hand(void)
{
    static const uint8_t pixels[9] = {14, 5, 4, 5, 2, 2, 4, 2, 2};
    static const uint8_t over[9] = {255, 0, 0, 0, 0, 0, 0, 0, 0};
    static const uint8_t over_less_one[9] = {255, 0, 255, 0, 0, 0, 255, 0, 255};
    uint8_t out[9];
    const pel_cview src = gray(pixels, 3, 3);
    const pel_view dst = gray_to_write(out, 3, 3);
    pel_adaptive_config config = adaptive_config(0, 0, 1, 0);

    EXPECT(PEL_OK, pel_adaptive_frame(&config, &src, &dst));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(over, out, 9);
    config.c = 1; /* now also where a pixel equals its mean */
    EXPECT(PEL_OK, pel_adaptive_frame(&config, &src, &dst));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(over_less_one, out, 9);
}

/* White, with the largest radius: column sums of 255 * 255, over 255 columns. */
static void test_adaptive_extremes(void)
{
    uint8_t white[2] = {255, 255};
    uint8_t out[2] = {9, 9};
    pel_adaptive_config config = adaptive_config(2, 300, PEL_ADAPTIVE_RADIUS_MAX, 0);
    pel_adaptive adaptive;
    unsigned rows = 0;

    EXPECT(PEL_OK, pel_adaptive_begin(&adaptive, &config));
    for (unsigned y = 0; y < 300; y++) {
        EXPECT(PEL_OK, pel_adaptive_push(&adaptive, white));
        while (pel_adaptive_pull(&adaptive, out) == PEL_OK) {
            rows++;
            TEST_ASSERT_EQUAL_UINT8(0, out[0] | out[1]);
        }
        TEST_ASSERT_EQUAL_UINT32(y < 127 ? 0 : y < 299 ? y - 126 : 300, rows);
    }
    config.c = 1;
    config.height = 1;
    EXPECT(PEL_OK, pel_adaptive_begin(&adaptive, &config));
    EXPECT(PEL_OK, pel_adaptive_push(&adaptive, white));
    EXPECT(PEL_OK, pel_adaptive_pull(&adaptive, out));
    TEST_ASSERT_EQUAL_UINT8(255, out[0] & out[1]);
}

static void test_adaptive_out_of_turn(void)
{
    uint8_t row[2] = {0, 0};
    pel_adaptive_config config = adaptive_config(2, 2, 1, 0);
    pel_adaptive adaptive;

    EXPECT(PEL_OK, pel_adaptive_begin(&adaptive, &config));
    EXPECT(PEL_ERR_ORDER, pel_adaptive_pull(&adaptive, row));
    EXPECT(PEL_OK, pel_adaptive_push(&adaptive, row));
    EXPECT(PEL_ERR_ORDER, pel_adaptive_pull(&adaptive, row));
    EXPECT(PEL_OK, pel_adaptive_push(&adaptive, row));
    EXPECT(PEL_ERR_ORDER, pel_adaptive_push(&adaptive, row));
    EXPECT(PEL_ERR_ARG, pel_adaptive_pull(&adaptive, NULL));
    EXPECT(PEL_OK, pel_adaptive_pull(&adaptive, row));
    EXPECT(PEL_OK, pel_adaptive_pull(&adaptive, row));
    TEST_ASSERT_EQUAL_UINT16(2, adaptive.row);
    EXPECT(PEL_ERR_ORDER, pel_adaptive_pull(&adaptive, row));
    EXPECT(PEL_ERR_ARG, pel_adaptive_push(&adaptive, NULL));
}

/* Where nothing has to be aligned, as on AVR, no memory is misaligned. */
struct element {
    char before;
    uint16_t value;
};

static void test_adaptive_refuses(void)
{
    pel_adaptive adaptive;
    pel_adaptive_config config = adaptive_config(10, 10, 0, 0);

    EXPECT(PEL_ERR_ARG, pel_adaptive_begin(&adaptive, &config));
    config = adaptive_config(1, 1, 128, 0);
    EXPECT(PEL_ERR_ARG, pel_adaptive_begin(&adaptive, &config));
    config = adaptive_config(10, 10, 1, 256);
    EXPECT(PEL_ERR_ARG, pel_adaptive_begin(&adaptive, &config));
    config = adaptive_config(0, 10, 1, 0);
    EXPECT(PEL_ERR_RANGE, pel_adaptive_begin(&adaptive, &config));
    config = adaptive_config(10, PEL_SIDE_MAX + 1, 1, 0);
    EXPECT(PEL_ERR_RANGE, pel_adaptive_begin(&adaptive, &config));
    config = adaptive_config(10, 10, 2, 0);
    config.work_bytes = PEL_ADAPTIVE_BYTES(10, 2);
    EXPECT(PEL_OK, pel_adaptive_begin(&adaptive, &config));
    config.work_bytes--;
    EXPECT(PEL_ERR_SPACE, pel_adaptive_begin(&adaptive, &config));
    config = adaptive_config(10, 10, 2, 0);
    if (offsetof(struct element, value) > 1) {
        config.work = (uint8_t *)work + 1;
        EXPECT(PEL_ERR_ARG, pel_adaptive_begin(&adaptive, &config));
    }
    config.work = NULL;
    EXPECT(PEL_ERR_ARG, pel_adaptive_begin(&adaptive, &config));
    TEST_ASSERT_EQUAL_UINT32(320 * 5, PEL_ADAPTIVE_BYTES(320, 1));
    TEST_ASSERT_EQUAL_UINT32(PEL_ADAPTIVE_BYTES(641, 9), pel_adaptive_bytes(641, 9));
    TEST_ASSERT_LESS_THAN_UINT32(64, sizeof adaptive);
}

/* ---- Resizing ------------------------------------------------------------------------------ */

static pel_resize_config resize_config(pel_resize_method method)
{
    pel_resize_config config = {0};
    config.method = method;
    config.work = work;
    config.work_bytes = sizeof work;
    return config;
}

static void expect_resized(pel_resize_method method, const pel_cview *src, uint16_t width,
                           uint16_t height, const uint8_t *expected)
{
    uint8_t out[40];
    const pel_resize_config config = resize_config(method);
    const pel_view dst = gray_to_write(out, width, height);

    EXPECT(PEL_OK, pel_resize_frame(&config, src, &dst));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, out, (uint32_t)width * height);
}

/* floor(X * 5 / 3) = 0 1 3; floor(X * 3 / 5) = 0 0 1 1 2. */
static void test_nearest(void)
{
    static const uint8_t five[5] = {10, 11, 12, 13, 14};
    static const uint8_t shrunk[3] = {10, 11, 13};
    static const uint8_t three[3] = {10, 11, 12};
    static const uint8_t grown[10] = {10, 10, 11, 11, 12, 10, 10, 11, 11, 12};
    pel_cview src = gray(five, 5, 1);

    expect_resized(PEL_RESIZE_NEAREST, &src, 3, 1, shrunk);
    src = gray(five, 1, 5);
    expect_resized(PEL_RESIZE_NEAREST, &src, 1, 3, shrunk);
    src = gray(three, 3, 1);
    expect_resized(PEL_RESIZE_NEAREST, &src, 5, 2, grown);
}

/* 1 2 / 3 4: 2.5 goes upward. 0 0 / 0 1: 0.25. White stays white at the largest area. */
static void test_box(void)
{
    static const uint8_t pixels[8] = {1, 2, 0, 0, 3, 4, 0, 1};
    static const uint8_t expected[2] = {3, 0};
    static const uint8_t columns[4] = {2, 3, 0, 1}; /* of two: 2, 3, 0, 0.5 */
    pel_cview src = gray(pixels, 4, 2);
    pel_resize_config config = resize_config(PEL_RESIZE_BOX);
    pel_resize resize;
    uint8_t white[256];
    uint8_t out = 9;

    expect_resized(PEL_RESIZE_BOX, &src, 2, 1, expected);
    expect_resized(PEL_RESIZE_BOX, &src, 4, 1, columns);
    expect_resized(PEL_RESIZE_BOX, &src, 4, 2, pixels);
    for (unsigned i = 0; i < 256; i++) {
        white[i] = 255;
    }
    config.width_in = config.height_in = 256;
    config.width_out = config.height_out = 1;
    EXPECT(PEL_OK, pel_resize_begin(&resize, &config));
    for (unsigned y = 0; y < 256; y++) {
        EXPECT(PEL_ERR_ORDER, pel_resize_pull(&resize, &out));
        EXPECT(PEL_OK, pel_resize_push(&resize, white));
    }
    EXPECT(PEL_OK, pel_resize_pull(&resize, &out));
    TEST_ASSERT_EQUAL_UINT8(255, out);
}

/* 2 to 4 columns: centres at -1/4, 1/4, 3/4, 5/4. 4 to 2: at 1/2 and 5/2; 0 1 100 201: 0.5 and
 * 150.5. Two by two to one: the mean, 1.75. 2 to 3: at -1/6, 1/2, 7/6. */
static void test_bilinear(void)
{
    static const uint8_t two[2] = {0, 100};
    static const uint8_t four[4] = {0, 25, 75, 100};
    static const uint8_t square[8] = {0, 25, 75, 100, 0, 25, 75, 100};
    static const uint8_t three[3] = {0, 50, 100};
    static const uint8_t slope[4] = {0, 1, 100, 201};
    static const uint8_t halves[2] = {1, 151};
    static const uint8_t pixels[4] = {0, 1, 2, 4};
    static const uint8_t mean[1] = {2};
    static const uint8_t white[4] = {255, 255, 255, 255};
    static const uint8_t whiter[6] = {255, 255, 255, 255, 255, 255};
    pel_cview src = gray(two, 2, 1);

    expect_resized(PEL_RESIZE_BILINEAR, &src, 4, 1, four);
    expect_resized(PEL_RESIZE_BILINEAR, &src, 4, 2, square);
    expect_resized(PEL_RESIZE_BILINEAR, &src, 3, 1, three);
    expect_resized(PEL_RESIZE_BILINEAR, &src, 2, 1, two);
    src = gray(two, 1, 2);
    expect_resized(PEL_RESIZE_BILINEAR, &src, 1, 4, four);
    src = gray(slope, 4, 1);
    expect_resized(PEL_RESIZE_BILINEAR, &src, 2, 1, halves);
    src = gray(pixels, 2, 2);
    expect_resized(PEL_RESIZE_BILINEAR, &src, 1, 1, mean);
    src = gray(white, 2, 2);
    expect_resized(PEL_RESIZE_BILINEAR, &src, 3, 2, whiter);
}

static void test_resize_of_colors(void)
{
    static const uint8_t rgb[12] = {0, 100, 255, 100, 0, 255, 0, 100, 255, 100, 0, 255};
    static const uint8_t mean[3] = {50, 50, 255};
    uint8_t out[3];
    pel_resize_config config = resize_config(PEL_RESIZE_BOX);
    pel_cview src;
    pel_view dst;

    EXPECT(PEL_OK, pel_cview_init(rgb, PEL_RGB888, PEL_RANGE_FULL, 2, 2, 0, &src));
    EXPECT(PEL_OK, pel_view_init(out, PEL_RGB888, PEL_RANGE_FULL, 1, 1, 0, &dst));
    EXPECT(PEL_OK, pel_resize_frame(&config, &src, &dst));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(mean, out, 3);
    config.method = PEL_RESIZE_BILINEAR;
    EXPECT(PEL_OK, pel_resize_frame(&config, &src, &dst));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(mean, out, 3);
    config.method = PEL_RESIZE_NEAREST;
    EXPECT(PEL_OK, pel_resize_frame(&config, &src, &dst));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(rgb, out, 3);
    dst.format = PEL_BGR888;
    EXPECT(PEL_ERR_FORMAT, pel_resize_frame(&config, &src, &dst));
}

/* Rows come as soon as they can, and none is pushed over one that is needed. */
static void test_resize_out_of_turn(void)
{
    uint8_t row[4] = {1, 2, 3, 4};
    pel_resize_config config = resize_config(PEL_RESIZE_BILINEAR);
    pel_resize resize;

    config.width_in = config.width_out = 4;
    config.height_in = 3;
    config.height_out = 6; /* centres at -1/4, 1/4, 3/4, 5/4, 7/4, 9/4 */
    EXPECT(PEL_OK, pel_resize_begin(&resize, &config));
    EXPECT(PEL_OK, pel_resize_push(&resize, row));
    EXPECT(PEL_ERR_ORDER, pel_resize_pull(&resize, row));
    EXPECT(PEL_OK, pel_resize_push(&resize, row));
    for (unsigned y = 0; y < 3; y++) {
        EXPECT(PEL_ERR_ORDER, pel_resize_push(&resize, row));
        EXPECT(PEL_OK, pel_resize_pull(&resize, row));
    }
    EXPECT(PEL_ERR_ORDER, pel_resize_pull(&resize, row));
    EXPECT(PEL_OK, pel_resize_push(&resize, row));
    for (unsigned y = 3; y < 6; y++) {
        EXPECT(PEL_ERR_ORDER, pel_resize_push(&resize, row));
        EXPECT(PEL_OK, pel_resize_pull(&resize, row));
    }
    TEST_ASSERT_EQUAL_UINT16(6, resize.row);
    EXPECT(PEL_ERR_ORDER, pel_resize_pull(&resize, row));
    EXPECT(PEL_ERR_ORDER, pel_resize_push(&resize, row));
    EXPECT(PEL_ERR_ARG, pel_resize_push(&resize, NULL));
    EXPECT(PEL_ERR_ARG, pel_resize_pull(NULL, row));
}

static void expect_begin(pel_status expected, const pel_resize_config *config)
{
    pel_resize resize;
    EXPECT(expected, pel_resize_begin(&resize, config));
}

static void test_resize_refuses(void)
{
    pel_resize_config config = resize_config(PEL_RESIZE_BOX);

    config.width_in = config.height_in = 6;
    config.width_out = config.height_out = 3;
    expect_begin(PEL_OK, &config);
    config.width_out = 4;
    expect_begin(PEL_ERR_RANGE, &config);
    config.width_out = 3;
    config.height_out = 12;
    expect_begin(PEL_ERR_RANGE, &config);
    config.height_out = 0;
    expect_begin(PEL_ERR_RANGE, &config);
    config.width_in = config.height_in = 512; /* 262144 pixels to the mean */
    config.width_out = config.height_out = 1;
    expect_begin(PEL_ERR_RANGE, &config);
    config.method = PEL_RESIZE_NEAREST;
    expect_begin(PEL_OK, &config);
    config.width_in = PEL_SIDE_MAX + 1;
    expect_begin(PEL_ERR_RANGE, &config);
    config.width_in = 4;
    config.channels = 2;
    expect_begin(PEL_ERR_ARG, &config);
    config.channels = 4;
    expect_begin(PEL_ERR_ARG, &config);
    config.channels = 3;
    expect_begin(PEL_OK, &config);
    config.method = PEL_RESIZE_METHOD_COUNT;
    expect_begin(PEL_ERR_ARG, &config);
    config.method = PEL_RESIZE_NEAREST;
    if (offsetof(struct element, value) > 1) {
        config.work = (uint8_t *)work + 1;
        expect_begin(PEL_ERR_ARG, &config);
    }
    config.work = NULL;
    expect_begin(PEL_ERR_ARG, &config);
}

static void test_resize_frames_refused(void)
{
    uint8_t pixels[16] = {0};
    pel_resize_config config = resize_config(PEL_RESIZE_NEAREST);
    const pel_cview src = gray(pixels, 4, 2);
    pel_view dst = gray_to_write(pixels, 4, 2);

    EXPECT(PEL_ERR_ARG, pel_resize_frame(&config, &src, &dst));
    dst = gray_to_write(pixels + 7, 2, 2);
    EXPECT(PEL_ERR_ARG, pel_resize_frame(&config, &src, &dst));
    dst = gray_to_write(pixels + 8, 2, 2);
    EXPECT(PEL_OK, pel_resize_frame(&config, &src, &dst));
    EXPECT(PEL_ERR_ARG, pel_resize_frame(NULL, &src, &dst));
    EXPECT(PEL_ERR_ARG, pel_resize_frame(&config, NULL, &dst));
    EXPECT(PEL_ERR_ARG, pel_resize_frame(&config, &src, NULL));
}

/* Working memory of just the size that is asked for: a sanitizer sees the first byte beyond it. */
static void test_resize_in_exact_memory(void)
{
    static uint32_t exact[PEL_RESIZE_WORDS(PEL_RESIZE_BILINEAR_BYTES(4, 8, 1))];
    static const uint8_t slope[8] = {0, 40, 80, 120, 0, 40, 80, 120};
    static const uint8_t grown[8] = {0, 10, 30, 50, 70, 90, 110, 120};
    uint8_t out[24];
    const pel_cview src = gray(slope, 4, 2);
    const pel_view dst = gray_to_write(out, 8, 3);
    pel_resize_config config = resize_config(PEL_RESIZE_BILINEAR);

    config.work = exact;
    config.work_bytes = sizeof exact;
    TEST_ASSERT_EQUAL_UINT32(PEL_RESIZE_BILINEAR_BYTES(4, 8, 1), sizeof exact);
    EXPECT(PEL_OK, pel_resize_frame(&config, &src, &dst));
    for (unsigned y = 0; y < 3; y++) {
        TEST_ASSERT_EQUAL_UINT8_ARRAY(grown, out + 8 * y, 8);
    }
}

/* The macros, the function, and what begin asks for are the same. */
static void test_resize_memory(void)
{
    pel_resize_config config = resize_config(PEL_RESIZE_NEAREST);
    const size_t expected[PEL_RESIZE_METHOD_COUNT] = {PEL_RESIZE_NEAREST_BYTES(12, 3),
                                                      PEL_RESIZE_BOX_BYTES(6, 3),
                                                      PEL_RESIZE_BILINEAR_BYTES(12, 6, 3)};

    TEST_ASSERT_EQUAL_UINT32(36, expected[0]);
    TEST_ASSERT_EQUAL_UINT32(72, expected[1]);
    TEST_ASSERT_EQUAL_UINT32(72 + 24, expected[2]);
    config.channels = 3;
    config.width_in = config.height_in = 12;
    config.width_out = config.height_out = 6;
    for (unsigned m = 0; m < PEL_RESIZE_METHOD_COUNT; m++) {
        config.method = (pel_resize_method)m;
        TEST_ASSERT_EQUAL_UINT32(expected[m], pel_resize_bytes(&config));
        config.work_bytes = expected[m];
        expect_begin(PEL_OK, &config);
        config.work_bytes--;
        expect_begin(PEL_ERR_SPACE, &config);
    }
    config.method = PEL_RESIZE_METHOD_COUNT;
    TEST_ASSERT_EQUAL_UINT32(0, pel_resize_bytes(&config));
    TEST_ASSERT_EQUAL_UINT32(0, pel_resize_bytes(NULL));
    TEST_ASSERT_EQUAL_UINT32(3, PEL_RESIZE_WORDS(9));
    TEST_ASSERT_LESS_THAN_UINT32(80, sizeof(pel_resize));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_combine);
    RUN_TEST(test_combine_frames);
    RUN_TEST(test_blend);
    RUN_TEST(test_integral);
    RUN_TEST(test_integral_bounds);
    RUN_TEST(test_adaptive_by_hand);
    RUN_TEST(test_adaptive_extremes);
    RUN_TEST(test_adaptive_out_of_turn);
    RUN_TEST(test_adaptive_refuses);
    RUN_TEST(test_nearest);
    RUN_TEST(test_box);
    RUN_TEST(test_bilinear);
    RUN_TEST(test_resize_of_colors);
    RUN_TEST(test_resize_out_of_turn);
    RUN_TEST(test_resize_refuses);
    RUN_TEST(test_resize_frames_refused);
    RUN_TEST(test_resize_in_exact_memory);
    RUN_TEST(test_resize_memory);
    return UNITY_END();
}
