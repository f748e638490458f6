/*
 * What each filter operator makes of one neighbourhood, and what lies outside the picture.
 */
#include "unity.h"

#include <pel.h>
#include <pel/filter.h>

static uint8_t work[PEL_FILTER_BYTES(3, 1)];

void setUp(void)
{
}

void tearDown(void)
{
}

/* ---- One neighbourhood --------------------------------------------------------------------- */

static pel_filter_config valid_config(pel_filter_op *op, const pel_kernel *kernel)
{
    pel_filter_config config = {0};
    config.op = op;
    config.kernel = kernel;
    config.border = PEL_BORDER_VALID;
    config.work = work;
    config.work_bytes = sizeof work;
    return config;
}

static pel_cview square_view(const uint8_t *pixels)
{
    pel_cview view;
    TEST_ASSERT_EQUAL_INT(PEL_OK,
                          pel_cview_init(pixels, PEL_GRAY8, PEL_RANGE_FULL, 3, 3, 0, &view));
    return view;
}

static int16_t one_s16(pel_filter_op_s16 *op, const uint8_t *pixels)
{
    pel_filter_config config = valid_config(NULL, NULL);
    const pel_cview view = square_view(pixels);
    int16_t result = 12345;
    config.op_s16 = op;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_frame_s16(&config, &view, &result, 1));
    return result;
}

static uint8_t one_u8(pel_filter_op *op, const pel_kernel *kernel, const uint8_t *pixels)
{
    const pel_filter_config config = valid_config(op, kernel);
    const pel_cview view = square_view(pixels);
    uint8_t result = 123;
    pel_view target;
    TEST_ASSERT_EQUAL_INT(PEL_OK,
                          pel_view_init(&result, PEL_GRAY8, PEL_RANGE_FULL, 1, 1, 0, &target));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_frame(&config, &view, &target));
    return result;
}

/* ---- Operators ----------------------------------------------------------------------------- */

/* A neighbourhood and what an operator makes of it. */
typedef struct example {
    pel_filter_op *op;
    int16_t result;
    uint8_t pixels[9];
} example;

/* Of an operator that has both forms. */
typedef struct signed_example {
    pel_filter_op *op;
    pel_filter_op_s16 *op_s16;
    int16_t result;
    uint8_t pixels[9];
} signed_example;

static void expect_examples_u8(const example *examples, unsigned count)
{
    for (unsigned i = 0; i < count; i++) {
        const uint8_t result = one_u8(examples[i].op, NULL, examples[i].pixels);
        TEST_ASSERT_EQUAL_INT16(examples[i].result, result);
    }
}

#define EXPECT_ALL_U8(examples) expect_examples_u8(examples, sizeof examples / sizeof examples[0])

static void test_gradients(void)
{
    static const signed_example examples[] = {
        {pel_op_gradient_abs, pel_op_gradient_abs_s16, 0, {7, 7, 7, 7, 7, 7, 7, 7, 7}},
        {pel_op_gradient_abs, pel_op_gradient_abs_s16, 36, {0, 50, 9, 0, 99, 9, 0, 50, 9}},
        {pel_op_gradient_abs, pel_op_gradient_abs_s16, 36, {9, 9, 9, 50, 99, 50, 0, 0, 0}},
        {pel_op_gradient_abs, pel_op_gradient_abs_s16, 20, {0, 0, 0, 0, 0, 0, 10, 0, 0}},
        {pel_op_gradient_abs, pel_op_gradient_abs_s16, 254, {0, 0, 127, 0, 0, 0, 0, 0, 0}},
        {pel_op_gradient_abs, pel_op_gradient_abs_s16, 256, {0, 0, 128, 0, 0, 0, 0, 0, 0}},
        {pel_op_gradient_abs, pel_op_gradient_abs_s16, 1530, {0, 0, 255, 0, 77, 255, 0, 255, 255}},
        {pel_op_gradient, pel_op_gradient_s16, 0, {7, 7, 7, 7, 7, 7, 7, 7, 7}},
        {pel_op_gradient, pel_op_gradient_s16, 36, {0, 50, 9, 0, 99, 9, 0, 50, 9}},
        {pel_op_gradient, pel_op_gradient_s16, 36, {9, 9, 9, 50, 99, 50, 0, 0, 0}},
        {pel_op_gradient,
         pel_op_gradient_s16,
         14,
         {0, 0, 0, 0, 0, 0, 10, 0, 0}}, /* sqrt 200 = 14.14 */
        {pel_op_gradient, pel_op_gradient_s16, 10, {0, 0, 0, 0, 0, 3, 0, 4, 0}}, /* 6 and 8 */
        {pel_op_gradient,
         pel_op_gradient_s16,
         7,
         {0, 0, 7, 0, 0, 0, 0, 5, 0}}, /* 7 and 3: sqrt 58 = 7.6 */
        {pel_op_gradient,
         pel_op_gradient_s16,
         1140,
         {0, 0, 255, 0, 77, 255, 0, 255, 255}}, /* sqrt 1300500 */
    };
    for (unsigned i = 0; i < sizeof examples / sizeof examples[0]; i++) {
        const signed_example *e = &examples[i];
        TEST_ASSERT_EQUAL_INT16(e->result, one_s16(e->op_s16, e->pixels));
        TEST_ASSERT_EQUAL_UINT8(e->result > 255 ? 255 : e->result, one_u8(e->op, NULL, e->pixels));
    }
}

static void test_directions(void)
{
    static const example examples[] = {
        {pel_op_direction, 0, {0, 0, 9, 0, 0, 9, 0, 0, 9}},   /* brighter to the right */
        {pel_op_direction, 64, {0, 0, 0, 0, 0, 0, 9, 9, 9}},  /* below */
        {pel_op_direction, 128, {9, 0, 0, 9, 0, 0, 9, 0, 0}}, /* left */
        {pel_op_direction, 192, {9, 9, 9, 0, 0, 0, 0, 0, 0}}, /* above */
        {pel_op_direction, 32, {0, 0, 0, 0, 0, 0, 0, 0, 1}},  /* corners */
        {pel_op_direction, 96, {0, 0, 0, 0, 0, 0, 1, 0, 0}},
        {pel_op_direction, 160, {1, 0, 0, 0, 0, 0, 0, 0, 0}},
        {pel_op_direction, 224, {0, 0, 1, 0, 0, 0, 0, 0, 0}},
        {pel_op_direction, 0, {5, 5, 5, 5, 5, 5, 5, 5, 5}},          /* none */
        {pel_op_direction, 19, {0, 0, 255, 0, 0, 255, 0, 255, 255}}, /* 1020, 510: 18.89 */
        {pel_op_direction, 0, {0, 3, 255, 0, 0, 255, 0, 0, 255}},    /* 1020, -6: -0.24 */
        {pel_op_direction, 255, {0, 8, 255, 0, 0, 255, 0, 0, 255}},  /* 1020, -16: -0.64 */
    };
    EXPECT_ALL_U8(examples);
}

static void test_median_minimum_and_maximum(void)
{
    static const example examples[] = {
        {pel_op_median, 5, {9, 1, 8, 2, 7, 3, 6, 4, 5}},
        {pel_op_median, 0, {255, 0, 255, 0, 0, 0, 255, 0, 255}},
        {pel_op_median, 255, {255, 0, 255, 0, 255, 0, 255, 0, 255}},
        {pel_op_median, 10, {10, 10, 10, 10, 200, 10, 10, 10, 10}},
        {pel_op_min, 1, {9, 1, 8, 2, 7, 3, 6, 4, 5}},
        {pel_op_min, 0, {255, 255, 255, 255, 255, 255, 255, 255, 0}},
        {pel_op_min, 255, {255, 255, 255, 255, 255, 255, 255, 255, 255}},
        {pel_op_max, 9, {9, 1, 8, 2, 7, 3, 6, 4, 5}},
        {pel_op_max, 255, {0, 0, 0, 0, 0, 0, 255, 0, 0}},
        {pel_op_max, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0}},
    };
    EXPECT_ALL_U8(examples);
}

/* Background counts as a label like any other. */
static void test_majority(void)
{
    static const example examples[] = {
        {pel_op_majority, 3, {3, 1, 3, 2, 4, 3, 5, 6, 7}},
        {pel_op_majority, 2, {1, 1, 1, 1, 2, 2, 2, 2, 3}}, /* four each: the pixel's own */
        {pel_op_majority, 1, {1, 1, 1, 1, 3, 2, 2, 2, 2}}, /* four each: the smaller */
        {pel_op_majority, 1, {2, 2, 2, 2, 3, 1, 1, 1, 1}},
        {pel_op_majority, 0, {0, 0, 0, 0, 5, 7, 7, 7, 7}},
        {pel_op_majority, 7, {0, 0, 0, 7, 5, 7, 7, 7, 7}},
        {pel_op_majority, 5, {1, 2, 3, 4, 5, 6, 7, 8, 9}}, /* one each */
        {pel_op_majority, 255, {0, 255, 0, 255, 255, 255, 0, 255, 0}},
        {pel_op_majority, 128, {1, 1, 1, 128, 128, 128, 0, 0, 0}}, /* three each */
    };
    EXPECT_ALL_U8(examples);
}

static void test_labels_eroded_and_dilated(void)
{
    static const example examples[] = {
        {pel_op_erode_labels, 7, {7, 7, 7, 7, 7, 7, 7, 7, 7}},
        {pel_op_erode_labels, 255, {255, 255, 255, 255, 255, 255, 255, 255, 255}},
        {pel_op_erode_labels, 0, {7, 7, 7, 7, 7, 7, 7, 7, 8}},
        {pel_op_erode_labels, 0, {7, 7, 7, 7, 8, 7, 7, 7, 7}},
        {pel_op_erode_labels, 0, {0, 7, 7, 7, 7, 7, 7, 7, 7}},
        {pel_op_erode_labels, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0}},
        {pel_op_dilate_labels, 9, {1, 1, 1, 1, 9, 1, 1, 1, 1}}, /* own before others' */
        {pel_op_dilate_labels, 3, {5, 0, 0, 0, 0, 3, 0, 0, 8}},
        {pel_op_dilate_labels, 255, {0, 0, 0, 0, 0, 0, 0, 0, 255}},
        {pel_op_dilate_labels, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0}},
    };
    EXPECT_ALL_U8(examples);
}

/* Only the default of config.op looks at the kernel. */
static void test_other_operators_have_radius_1_whatever_the_kernel(void)
{
    static const uint8_t pixels[9] = {9, 1, 8, 2, 7, 3, 6, 4, 5};
    TEST_ASSERT_EQUAL_UINT8(5, one_u8(pel_op_median, pel_kernel_named("gauss5"), pixels));
}

/* ---- Operators that are kernels ------------------------------------------------------------ */

static const uint8_t hills[25] = {0,   3, 17,  255, 200, 9, 80, 44, 7, 255, 1,   90, 250,
                                  128, 5, 255, 255, 0,   0, 31, 77, 2, 6,   128, 254};

/* The whole picture of 5 x 5 by the taps, in 8 bits. */
static void filter_hills(const pel_filter_config *config, uint8_t *results)
{
    pel_cview from;
    pel_view to;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_cview_init(hills, PEL_GRAY8, PEL_RANGE_FULL, 5, 5, 0, &from));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_view_init(results, PEL_GRAY8, PEL_RANGE_FULL, 5, 5, 0, &to));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_frame(config, &from, &to));
}

static void expect_as_by_taps(pel_filter_op *op, const char *name)
{
    static uint8_t room[PEL_FILTER_BYTES(5, 2)];
    uint8_t by_op[25], by_taps[25];
    pel_filter_config config = {0};
    config.work = room;
    config.work_bytes = sizeof room;
    config.op = op;
    filter_hills(&config, by_op);
    config.op = NULL;
    config.kernel = pel_kernel_named(name);
    filter_hills(&config, by_taps);
    TEST_ASSERT_EQUAL_UINT8_ARRAY_MESSAGE(by_taps, by_op, 25, name);
}

static void test_smoothing_operators_are_the_named_kernels(void)
{
    static const uint8_t corner[9] = {255, 0, 0, 0, 0, 0, 0, 0, 0};
    expect_as_by_taps(pel_op_gauss3, "gauss3");
    expect_as_by_taps(pel_op_box3, "box3");
    expect_as_by_taps(pel_op_binomial5, "binomial5");
    TEST_ASSERT_EQUAL_UINT8(16, one_u8(pel_op_gauss3, NULL, corner)); /* 255 / 16 = 15.9 */
    TEST_ASSERT_EQUAL_UINT8(28, one_u8(pel_op_box3, NULL, corner));   /* 255 / 9 = 28.3 */
}

static void test_sobel_operators_keep_the_sign(void)
{
    static const uint8_t falling[9] = {255, 9, 0, 255, 9, 0, 255, 9, 0};
    static const uint8_t rising[9] = {0, 0, 0, 9, 9, 9, 255, 255, 254};
    TEST_ASSERT_EQUAL_INT16(-1020, one_s16(pel_op_sobel_x_s16, falling));
    TEST_ASSERT_EQUAL_INT16(0, one_s16(pel_op_sobel_y_s16, falling));
    TEST_ASSERT_EQUAL_INT16(-1, one_s16(pel_op_sobel_x_s16, rising));
    TEST_ASSERT_EQUAL_INT16(1019, one_s16(pel_op_sobel_y_s16, rising));
}

/* One of the caller's own: the header's example. */
static unsigned brighter_above(const uint8_t *const rows[], uint16_t count,
                               const pel_filter_config *config, uint8_t *out)
{
    (void)config;
    for (uint16_t x = 0; x < count; x++) {
        out[x] = rows[0][x] > rows[1][x] ? 255 : 0;
    }
    return 1;
}

static void test_an_operator_of_the_callers_own(void)
{
    static const uint8_t above[9] = {1, 5, 1, 9, 4, 9, 9, 9, 9}, below[9] = {9, 4, 9, 1, 5, 1};
    TEST_ASSERT_EQUAL_UINT8(255, one_u8(brighter_above, NULL, above));
    TEST_ASSERT_EQUAL_UINT8(0, one_u8(brighter_above, NULL, below));
}

/* ---- Borders ------------------------------------------------------------------------------- */

/* Places -2 * length .. 3 * length - 1 of rows of one to four pixels. */
enum { LENGTHS = 4 };

static const int8_t replicate_places[LENGTHS][20] = {
    {0, 0, 0, 0, 0},
    {0, 0, 0, 0, 0, 1, 1, 1, 1, 1},
    {0, 0, 0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2, 2, 2},
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 3, 3, 3, 3, 3, 3, 3, 3},
};
static const int8_t symmetric_places[LENGTHS][20] = {
    {0, 0, 0, 0, 0},
    {0, 1, 1, 0, 0, 1, 1, 0, 0, 1},
    {0, 1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0, 1, 2},
    {0, 1, 2, 3, 3, 2, 1, 0, 0, 1, 2, 3, 3, 2, 1, 0, 0, 1, 2, 3},
};
static const int8_t reflect101_places[LENGTHS][20] = {
    {0, 0, 0, 0, 0},
    {0, 1, 0, 1, 0, 1, 0, 1, 0, 1},
    {2, 1, 0, 1, 2, 1, 0, 1, 2, 1, 0, 1, 2, 1, 0},
    {2, 1, 0, 1, 2, 3, 2, 1, 0, 1, 2, 3, 2, 1, 0, 1, 2, 3, 2, 1},
};
static const int8_t wrap_places[LENGTHS][20] = {
    {0, 0, 0, 0, 0},
    {0, 1, 0, 1, 0, 1, 0, 1, 0, 1},
    {0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2},
    {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3},
};
static const int8_t no_places[LENGTHS][20] = {
    {-1, -1, 0, -1, -1},
    {-1, -1, -1, -1, 0, 1, -1, -1, -1, -1},
    {-1, -1, -1, -1, -1, -1, 0, 1, 2, -1, -1, -1, -1, -1, -1},
    {-1, -1, -1, -1, -1, -1, -1, -1, 0, 1, 2, 3, -1, -1, -1, -1, -1, -1, -1, -1},
};

static void expect_places(pel_border border, const int8_t expected[LENGTHS][20])
{
    for (int32_t length = 1; length <= LENGTHS; length++) {
        for (int32_t i = -2 * length; i < 3 * length; i++) {
            TEST_ASSERT_EQUAL_INT32(expected[length - 1][i + 2 * length],
                                    pel_border_index(i, length, border));
        }
    }
}

static void test_places_outside_short_rows(void)
{
    expect_places(PEL_BORDER_REPLICATE, replicate_places);
    expect_places(PEL_BORDER_SYMMETRIC, symmetric_places);
    expect_places(PEL_BORDER_REFLECT101, reflect101_places);
    expect_places(PEL_BORDER_WRAP, wrap_places);
    expect_places(PEL_BORDER_CONSTANT, no_places);
    expect_places(PEL_BORDER_VALID, no_places);
}

static void test_places_as_the_header_draws_them(void)
{
    TEST_ASSERT_EQUAL_INT32(0, pel_border_index(-2, 4, PEL_BORDER_REPLICATE));
    TEST_ASSERT_EQUAL_INT32(1, pel_border_index(-2, 4, PEL_BORDER_SYMMETRIC));
    TEST_ASSERT_EQUAL_INT32(2, pel_border_index(-2, 4, PEL_BORDER_REFLECT101));
    TEST_ASSERT_EQUAL_INT32(2, pel_border_index(-2, 4, PEL_BORDER_WRAP));
    TEST_ASSERT_EQUAL_INT32(3, pel_border_index(5, 4, PEL_BORDER_REPLICATE));
    TEST_ASSERT_EQUAL_INT32(2, pel_border_index(5, 4, PEL_BORDER_SYMMETRIC));
    TEST_ASSERT_EQUAL_INT32(1, pel_border_index(5, 4, PEL_BORDER_REFLECT101));
    TEST_ASSERT_EQUAL_INT32(1, pel_border_index(5, 4, PEL_BORDER_WRAP));
}

static void test_places_at_any_distance(void)
{
    TEST_ASSERT_EQUAL_INT32(0, pel_border_index(INT32_MIN, 8192, PEL_BORDER_REPLICATE));
    TEST_ASSERT_EQUAL_INT32(0, pel_border_index(INT32_MIN, 8192, PEL_BORDER_SYMMETRIC));
    TEST_ASSERT_EQUAL_INT32(32, pel_border_index(INT32_MIN, 8192, PEL_BORDER_REFLECT101));
    TEST_ASSERT_EQUAL_INT32(0, pel_border_index(INT32_MIN, 8192, PEL_BORDER_WRAP));
    TEST_ASSERT_EQUAL_INT32(-1, pel_border_index(INT32_MIN, 8192, PEL_BORDER_CONSTANT));
    TEST_ASSERT_EQUAL_INT32(8191, pel_border_index(INT32_MAX, 8192, PEL_BORDER_REPLICATE));
    TEST_ASSERT_EQUAL_INT32(0, pel_border_index(INT32_MAX, 8192, PEL_BORDER_SYMMETRIC));
    TEST_ASSERT_EQUAL_INT32(31, pel_border_index(INT32_MAX, 8192, PEL_BORDER_REFLECT101));
    TEST_ASSERT_EQUAL_INT32(8191, pel_border_index(INT32_MAX, 8192, PEL_BORDER_WRAP));
    TEST_ASSERT_EQUAL_INT32(-1, pel_border_index(INT32_MAX, 8192, PEL_BORDER_VALID));
    TEST_ASSERT_EQUAL_INT32(0, pel_border_index(INT32_MIN, 1, PEL_BORDER_REFLECT101));
}

/* Outside by 1 and by more than a row that is as long as the type allows. */
static void test_places_of_the_longest_row(void)
{
    const int32_t n = INT32_MAX;
    TEST_ASSERT_EQUAL_INT32(n - 1, pel_border_index(INT32_MIN, n, PEL_BORDER_SYMMETRIC));
    TEST_ASSERT_EQUAL_INT32(n - 3, pel_border_index(INT32_MIN, n, PEL_BORDER_REFLECT101));
    TEST_ASSERT_EQUAL_INT32(n - 1, pel_border_index(INT32_MIN, n, PEL_BORDER_WRAP));
    TEST_ASSERT_EQUAL_INT32(n - 1, pel_border_index(INT32_MAX, n, PEL_BORDER_SYMMETRIC));
    TEST_ASSERT_EQUAL_INT32(n - 2, pel_border_index(INT32_MAX, n, PEL_BORDER_REFLECT101));
    TEST_ASSERT_EQUAL_INT32(0, pel_border_index(INT32_MAX, n, PEL_BORDER_WRAP));
    TEST_ASSERT_EQUAL_INT32(7, pel_border_index(7, n, PEL_BORDER_WRAP));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_gradients);
    RUN_TEST(test_directions);
    RUN_TEST(test_median_minimum_and_maximum);
    RUN_TEST(test_majority);
    RUN_TEST(test_labels_eroded_and_dilated);
    RUN_TEST(test_other_operators_have_radius_1_whatever_the_kernel);
    RUN_TEST(test_smoothing_operators_are_the_named_kernels);
    RUN_TEST(test_sobel_operators_keep_the_sign);
    RUN_TEST(test_an_operator_of_the_callers_own);
    RUN_TEST(test_places_outside_short_rows);
    RUN_TEST(test_places_as_the_header_draws_them);
    RUN_TEST(test_places_at_any_distance);
    RUN_TEST(test_places_of_the_longest_row);
    return UNITY_END();
}
