/*
 * Filters with a kernel: the named ones, rounding, limits, the largest sums. The other operators
 * are in test_filter_ops.c, the calls themselves in test_filter_calls.c, larger pictures in
 * test_filter_tables.c.
 */
#include "unity.h"

#include <pel.h>
#include <pel/filter.h>

static uint8_t work[PEL_FILTER_BYTES_WRAP(8, 2)];

void setUp(void)
{
}

void tearDown(void)
{
}

/* ---- One neighbourhood --------------------------------------------------------------------- */

static pel_filter_config valid_config(const pel_kernel *kernel)
{
    pel_filter_config config = {0};
    config.kernel = kernel;
    config.border = PEL_BORDER_VALID;
    config.work = work;
    config.work_bytes = sizeof work;
    return config;
}

static pel_cview square_view(const uint8_t *pixels, unsigned radius)
{
    const uint16_t side = (uint16_t)(2 * radius + 1);
    pel_cview view;
    TEST_ASSERT_EQUAL_INT(PEL_OK,
                          pel_cview_init(pixels, PEL_GRAY8, PEL_RANGE_FULL, side, side, 0, &view));
    return view;
}

static int16_t one_s16(const pel_kernel *kernel, const uint8_t *pixels)
{
    const pel_filter_config config = valid_config(kernel);
    const pel_cview view = square_view(pixels, kernel->radius);
    int16_t result = 12345;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_frame_s16(&config, &view, &result, 1));
    return result;
}

static uint8_t one_u8(const pel_kernel *kernel, const uint8_t *pixels)
{
    const pel_filter_config config = valid_config(kernel);
    const pel_cview view = square_view(pixels, kernel->radius);
    uint8_t result = 123;
    pel_view target;
    TEST_ASSERT_EQUAL_INT(PEL_OK,
                          pel_view_init(&result, PEL_GRAY8, PEL_RANGE_FULL, 1, 1, 0, &target));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_frame(&config, &view, &target));
    return result;
}

/* ---- Named kernels ------------------------------------------------------------------------- */

typedef struct named {
    const char *name;
    uint8_t radius;
    uint16_t divided_by;
    int8_t tap[25];
} named;

static const named kernels[] = {
    {"identity", 1, 1, {0, 0, 0, 0, 1, 0, 0, 0, 0}},
    {"box3", 1, 9, {1, 1, 1, 1, 1, 1, 1, 1, 1}},
    {"shift_left", 1, 1, {0, 0, 0, 0, 0, 1, 0, 0, 0}},
    {"shift_right", 1, 1, {0, 0, 0, 1, 0, 0, 0, 0, 0}},
    {"shift_up", 1, 1, {0, 0, 0, 0, 0, 0, 0, 1, 0}},
    {"shift_down", 1, 1, {0, 1, 0, 0, 0, 0, 0, 0, 0}},
    {"gauss3", 1, 16, {1, 2, 1, 2, 4, 2, 1, 2, 1}},
    {"binomial5", 2, 256, {1,  4, 6, 4,  1,  4,  16, 24, 16, 4, 6, 24, 36,
                           24, 6, 4, 16, 24, 16, 4,  1,  4,  6, 4, 1}},
    {"gauss5", 2, 256, {1,  3, 6, 3,  1,  3,  15, 25, 15, 3, 6, 25, 44,
                        25, 6, 3, 15, 25, 15, 3,  1,  3,  6, 3, 1}},
    {"sobel_x", 1, 1, {-1, 0, 1, -2, 0, 2, -1, 0, 1}},
    {"sobel_y", 1, 1, {-1, -2, -1, 0, 0, 0, 1, 2, 1}},
    {"scharr_x", 1, 1, {-3, 0, 3, -10, 0, 10, -3, 0, 3}},
    {"scharr_y", 1, 1, {-3, -10, -3, 0, 0, 0, 3, 10, 3}},
    {"prewitt_x", 1, 1, {-1, 0, 1, -1, 0, 1, -1, 0, 1}},
    {"prewitt_y", 1, 1, {-1, -1, -1, 0, 0, 0, 1, 1, 1}},
    {"laplacian", 1, 1, {0, 1, 0, 1, -4, 1, 0, 1, 0}},
    {"laplacian_negative", 1, 1, {0, -1, 0, -1, 4, -1, 0, -1, 0}},
    {"sharpen", 1, 9, {-1, -1, -1, -1, 17, -1, -1, -1, -1}},
    {"sharpen5", 1, 1, {0, -1, 0, -1, 5, -1, 0, -1, 0}},
    {"emboss", 1, 1, {-2, -1, 0, -1, 1, 1, 0, 1, 2}},
};

enum { KERNELS = sizeof kernels / sizeof kernels[0] };

static unsigned taps_of(const pel_kernel *kernel)
{
    return kernel->radius == 1 ? 9 : 25;
}

static void test_every_named_kernel_is_as_documented(void)
{
    for (unsigned i = 0; i < KERNELS; i++) {
        const named *expected = &kernels[i];
        const pel_kernel *kernel = pel_kernel_named(expected->name);
        TEST_ASSERT_NOT_NULL_MESSAGE(kernel, expected->name);
        TEST_ASSERT_EQUAL_UINT8_MESSAGE(expected->radius, kernel->radius, expected->name);
        TEST_ASSERT_EQUAL_INT8_ARRAY_MESSAGE(expected->tap, kernel->tap, taps_of(kernel),
                                             expected->name);
        TEST_ASSERT_EQUAL_UINT32_MESSAGE(expected->divided_by,
                                         (uint32_t)(kernel->divisor == 0 ? 1 : kernel->divisor)
                                             << kernel->shift,
                                         expected->name);
        TEST_ASSERT_EQUAL_INT16_MESSAGE(0, kernel->bias, expected->name);
        TEST_ASSERT_EQUAL_UINT8_MESSAGE(0, kernel->absolute, expected->name);
    }
}

static int same_text(const char *a, const char *b)
{
    while (*a != '\0' && *a == *b) {
        a++;
        b++;
    }
    return *a == *b;
}

static void test_the_names_are_listed_once_each(void)
{
    for (unsigned i = 0; i < KERNELS; i++) {
        const char *name = pel_kernel_name(i);
        unsigned found = 0;
        TEST_ASSERT_NOT_NULL(name);
        TEST_ASSERT_NOT_NULL_MESSAGE(pel_kernel_named(name), name);
        for (unsigned k = 0; k < KERNELS; k++) {
            found += same_text(pel_kernel_name(i), pel_kernel_name(k)) ? 1u : 0u;
        }
        TEST_ASSERT_EQUAL_UINT_MESSAGE(1, found, name);
    }
    TEST_ASSERT_NULL(pel_kernel_name(KERNELS));
    TEST_ASSERT_NULL(pel_kernel_name(KERNELS + 1));
    TEST_ASSERT_NULL(pel_kernel_name(65535u));
}

static void test_other_names_are_none(void)
{
    static const char *const names[] = {"",      "sobel",  "sobel_xx", "sobel_", "Sobel_x",
                                        "gauss", "box3 ",  " box3",    "box33",  "emboss\n",
                                        "shift", "sharpe", "sharpen6"};
    for (unsigned i = 0; i < sizeof names / sizeof names[0]; i++) {
        TEST_ASSERT_NULL_MESSAGE(pel_kernel_named(names[i]), names[i]);
    }
}

static void test_a_flipped_kernel_is_turned_by_half_a_turn(void)
{
    for (unsigned i = 0; i < KERNELS; i++) {
        const pel_kernel *kernel = pel_kernel_named(kernels[i].name);
        const pel_kernel flipped = pel_kernel_flipped(kernel);
        const unsigned taps = taps_of(kernel);
        TEST_ASSERT_EQUAL_UINT8(kernel->radius, flipped.radius);
        TEST_ASSERT_EQUAL_UINT16(kernel->divisor, flipped.divisor);
        TEST_ASSERT_EQUAL_UINT8(kernel->shift, flipped.shift);
        for (unsigned k = 0; k < taps; k++) {
            TEST_ASSERT_EQUAL_INT8(kernel->tap[taps - 1 - k], flipped.tap[k]);
        }
    }
}

static void test_flipping_keeps_division_bias_and_absolute(void)
{
    pel_kernel kernel = {{1, 2, 3, 4, 5, 6, 7, 8, -128}, 1, 77, 3, 1, -300};
    const pel_kernel flipped = pel_kernel_flipped(&kernel);
    static const int8_t turned[9] = {-128, 8, 7, 6, 5, 4, 3, 2, 1};
    TEST_ASSERT_EQUAL_INT8_ARRAY(turned, flipped.tap, 9);
    TEST_ASSERT_EQUAL_UINT16(77, flipped.divisor);
    TEST_ASSERT_EQUAL_UINT8(3, flipped.shift);
    TEST_ASSERT_EQUAL_UINT8(1, flipped.absolute);
    TEST_ASSERT_EQUAL_INT16(-300, flipped.bias);
}

/* A named kernel that is changed keeps its taps' meaning: nothing may rely on the old division. */
static void test_a_changed_copy_of_a_named_kernel(void)
{
    static const uint8_t pixels[9] = {10, 20, 30, 40, 50, 60, 70, 80, 200};
    pel_kernel gauss = *pel_kernel_named("gauss3");
    pel_kernel sobel = *pel_kernel_named("sobel_x");
    gauss.bias = 5; /* the sum: 10 + 40 + 30 + 80 + 200 + 120 + 70 + 160 + 200 = 910 */
    TEST_ASSERT_EQUAL_UINT8(57 + 5, one_u8(&gauss, pixels));
    gauss.shift = 0;
    gauss.divisor = 7;
    gauss.bias = 0;
    TEST_ASSERT_EQUAL_UINT8(130, one_u8(&gauss, pixels));
    sobel = pel_kernel_flipped(&sobel); /* -(30 - 10 + 2 (60 - 40) + 200 - 70) = -190 */
    TEST_ASSERT_EQUAL_INT16(-190, one_s16(&sobel, pixels));
    sobel.absolute = 1;
    TEST_ASSERT_EQUAL_INT16(190, one_s16(&sobel, pixels));
    TEST_ASSERT_EQUAL_UINT8(190, one_u8(&sobel, pixels));
}

/* ---- Moving the picture -------------------------------------------------------------------- */

static const uint8_t numbers[9] = {1, 2, 3, 4, 5, 6, 7, 8, 9};

static void expect_moved(const pel_kernel *kernel, pel_border border, const uint8_t *expected)
{
    pel_filter_config config = valid_config(kernel);
    const pel_cview source = square_view(numbers, 1);
    uint8_t results[9];
    pel_view target;
    config.border = border;
    TEST_ASSERT_EQUAL_INT(PEL_OK,
                          pel_view_init(results, PEL_GRAY8, PEL_RANGE_FULL, 3, 3, 0, &target));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_frame(&config, &source, &target));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, results, 9);
}

static void expect_numbers(const char *name, pel_border border, const uint8_t *expected)
{
    expect_moved(pel_kernel_named(name), border, expected);
}

static void test_identity_changes_nothing(void)
{
    for (int border = 0; border < PEL_BORDER_VALID; border++) {
        expect_numbers("identity", (pel_border)border, numbers);
    }
}

static void test_shifts_move_the_picture_where_they_say(void)
{
    static const uint8_t left[9] = {2, 3, 0, 5, 6, 0, 8, 9, 0};
    static const uint8_t right[9] = {0, 1, 2, 0, 4, 5, 0, 7, 8};
    static const uint8_t up[9] = {4, 5, 6, 7, 8, 9, 0, 0, 0};
    static const uint8_t down[9] = {0, 0, 0, 1, 2, 3, 4, 5, 6};
    expect_numbers("shift_left", PEL_BORDER_CONSTANT, left);
    expect_numbers("shift_right", PEL_BORDER_CONSTANT, right);
    expect_numbers("shift_up", PEL_BORDER_CONSTANT, up);
    expect_numbers("shift_down", PEL_BORDER_CONSTANT, down);
}

static void test_what_a_shift_brings_in_is_the_border(void)
{
    static const uint8_t replicate[9] = {1, 1, 2, 4, 4, 5, 7, 7, 8};
    static const uint8_t reflect101[9] = {2, 1, 2, 5, 4, 5, 8, 7, 8};
    static const uint8_t wrap[9] = {3, 1, 2, 6, 4, 5, 9, 7, 8};
    static const uint8_t wrap_down[9] = {7, 8, 9, 1, 2, 3, 4, 5, 6};
    static const uint8_t wrap_up[9] = {4, 5, 6, 7, 8, 9, 1, 2, 3};
    expect_numbers("shift_right", PEL_BORDER_REPLICATE, replicate);
    expect_numbers("shift_right", PEL_BORDER_SYMMETRIC, replicate);
    expect_numbers("shift_right", PEL_BORDER_REFLECT101, reflect101);
    expect_numbers("shift_right", PEL_BORDER_WRAP, wrap);
    expect_numbers("shift_down", PEL_BORDER_WRAP, wrap_down);
    expect_numbers("shift_up", PEL_BORDER_WRAP, wrap_up);
}

/* By two pixels, with a 5x5 kernel: here replicate and symmetric differ. */
static void test_two_pixels_to_the_right(void)
{
    static const uint8_t replicate[9] = {1, 1, 1, 4, 4, 4, 7, 7, 7};
    static const uint8_t symmetric[9] = {2, 1, 1, 5, 4, 4, 8, 7, 7};
    static const uint8_t reflect101[9] = {3, 2, 1, 6, 5, 4, 9, 8, 7};
    static const uint8_t wrap[9] = {2, 3, 1, 5, 6, 4, 8, 9, 7};
    static const uint8_t zero[9] = {0, 0, 1, 0, 0, 4, 0, 0, 7};
    pel_kernel kernel = {{0}, 2, 0, 0, 0, 0};
    kernel.tap[2 * 5] = 1;
    expect_moved(&kernel, PEL_BORDER_REPLICATE, replicate);
    expect_moved(&kernel, PEL_BORDER_SYMMETRIC, symmetric);
    expect_moved(&kernel, PEL_BORDER_REFLECT101, reflect101);
    expect_moved(&kernel, PEL_BORDER_WRAP, wrap);
    expect_moved(&kernel, PEL_BORDER_CONSTANT, zero);
}

static void test_two_pixels_down(void)
{
    static const uint8_t replicate[9] = {1, 2, 3, 1, 2, 3, 1, 2, 3};
    static const uint8_t symmetric[9] = {4, 5, 6, 1, 2, 3, 1, 2, 3};
    static const uint8_t reflect101[9] = {7, 8, 9, 4, 5, 6, 1, 2, 3};
    static const uint8_t wrap[9] = {4, 5, 6, 7, 8, 9, 1, 2, 3};
    static const uint8_t zero[9] = {0, 0, 0, 0, 0, 0, 1, 2, 3};
    pel_kernel kernel = {{0}, 2, 0, 0, 0, 0};
    kernel.tap[2] = 1;
    expect_moved(&kernel, PEL_BORDER_REPLICATE, replicate);
    expect_moved(&kernel, PEL_BORDER_SYMMETRIC, symmetric);
    expect_moved(&kernel, PEL_BORDER_REFLECT101, reflect101);
    expect_moved(&kernel, PEL_BORDER_WRAP, wrap);
    expect_moved(&kernel, PEL_BORDER_CONSTANT, zero);
}

/* A single pixel of value 1 under 25 taps of 1: itself 25 times, or 24 times what is around. */
static void test_a_5x5_kernel_on_a_single_pixel(void)
{
    static const uint8_t expected[PEL_BORDER_VALID] = {25, 25, 25, 25, 1 + 24 * 10};
    pel_kernel kernel;
    for (unsigned k = 0; k < 25; k++) {
        kernel.tap[k] = 1;
    }
    kernel.radius = 2;
    kernel.divisor = 1;
    kernel.shift = kernel.absolute = 0;
    kernel.bias = 0;
    for (int border = 0; border < PEL_BORDER_VALID; border++) {
        pel_filter_config config = valid_config(&kernel);
        uint8_t pixel = 1;
        pel_view view;
        pel_cview source;
        config.border = (pel_border)border;
        config.constant = 10;
        TEST_ASSERT_EQUAL_INT(PEL_OK,
                              pel_view_init(&pixel, PEL_GRAY8, PEL_RANGE_FULL, 1, 1, 0, &view));
        source = pel_view_to_read(&view);
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_frame(&config, &source, &view));
        TEST_ASSERT_EQUAL_UINT8(expected[border], pixel);
    }
}

/* ---- Rounding and limits ------------------------------------------------------------------- */

/* A kernel that multiplies by one number, and the result at a pixel of one value. */
static pel_kernel times(int8_t factor, uint16_t divisor, uint8_t shift)
{
    pel_kernel kernel = {{0}, 1, 0, 0, 0, 0};
    kernel.tap[4] = factor;
    kernel.divisor = divisor;
    kernel.shift = shift;
    return kernel;
}

static int16_t scaled_s16(const pel_kernel *kernel, uint8_t value)
{
    uint8_t pixels[9] = {0};
    pixels[4] = value;
    return one_s16(kernel, pixels);
}

static uint8_t scaled_u8(const pel_kernel *kernel, uint8_t value)
{
    uint8_t pixels[9] = {0};
    pixels[4] = value;
    return one_u8(kernel, pixels);
}

static void test_halves_are_rounded_upward(void)
{
    pel_kernel plus = times(1, 4, 0), minus = times(-1, 4, 0);
    TEST_ASSERT_EQUAL_INT16(0, scaled_s16(&plus, 1));
    TEST_ASSERT_EQUAL_INT16(1, scaled_s16(&plus, 2)); /* 0.5 */
    TEST_ASSERT_EQUAL_INT16(2, scaled_s16(&plus, 6)); /* 1.5 */
    TEST_ASSERT_EQUAL_INT16(3, scaled_s16(&plus, 10));
    TEST_ASSERT_EQUAL_INT16(0, scaled_s16(&minus, 1));
    TEST_ASSERT_EQUAL_INT16(0, scaled_s16(&minus, 2)); /* -0.5 */
    TEST_ASSERT_EQUAL_INT16(-1, scaled_s16(&minus, 3));
    TEST_ASSERT_EQUAL_INT16(-1, scaled_s16(&minus, 6)); /* -1.5 */
    TEST_ASSERT_EQUAL_INT16(-2, scaled_s16(&minus, 7));
}

static void test_a_shift_rounds_like_a_divisor(void)
{
    for (uint16_t value = 0; value < 256; value++) {
        const pel_kernel shifted = times(-1, 0, 3), divided = times(-1, 8, 0);
        const pel_kernel both = times(-1, 2, 2);
        const int16_t result = scaled_s16(&divided, (uint8_t)value);
        TEST_ASSERT_EQUAL_INT16(result, scaled_s16(&shifted, (uint8_t)value));
        TEST_ASSERT_EQUAL_INT16(result, scaled_s16(&both, (uint8_t)value));
    }
}

static void test_an_odd_divisor_never_meets_a_half(void)
{
    pel_kernel kernel = times(-1, 9, 0);
    TEST_ASSERT_EQUAL_INT16(0, scaled_s16(&kernel, 4));
    TEST_ASSERT_EQUAL_INT16(-1, scaled_s16(&kernel, 5));
    TEST_ASSERT_EQUAL_INT16(-1, scaled_s16(&kernel, 13));
    TEST_ASSERT_EQUAL_INT16(-2, scaled_s16(&kernel, 14));
}

static void test_divisor_0_stands_for_1(void)
{
    pel_kernel kernel = times(-3, 0, 0);
    TEST_ASSERT_EQUAL_INT16(-300, scaled_s16(&kernel, 100));
    kernel.shift = 1;
    TEST_ASSERT_EQUAL_INT16(-150, scaled_s16(&kernel, 100));
}

static void test_absolute_comes_before_the_division(void)
{
    pel_kernel kernel = times(-3, 8, 0); /* -12/8 is -1.5: rounds to -1, its size to 2 */
    TEST_ASSERT_EQUAL_INT16(-1, scaled_s16(&kernel, 4));
    kernel.absolute = 1;
    TEST_ASSERT_EQUAL_INT16(2, scaled_s16(&kernel, 4));
    kernel.bias = -10;
    TEST_ASSERT_EQUAL_INT16(-8, scaled_s16(&kernel, 4));
}

static void test_the_bias_comes_after_the_division(void)
{
    pel_kernel kernel = times(1, 2, 0);
    kernel.bias = 7;
    TEST_ASSERT_EQUAL_UINT8(9, scaled_u8(&kernel, 3)); /* 1.5 -> 2, + 7 */
    kernel.bias = -2;
    TEST_ASSERT_EQUAL_UINT8(0, scaled_u8(&kernel, 3));
    TEST_ASSERT_EQUAL_UINT8(1, scaled_u8(&kernel, 5));
}

static void test_eight_bits_are_limited_at_both_ends(void)
{
    pel_kernel kernel = times(2, 1, 0);
    TEST_ASSERT_EQUAL_UINT8(254, scaled_u8(&kernel, 127));
    TEST_ASSERT_EQUAL_UINT8(255, scaled_u8(&kernel, 128));
    TEST_ASSERT_EQUAL_UINT8(255, scaled_u8(&kernel, 255));
    kernel.tap[4] = -1;
    TEST_ASSERT_EQUAL_UINT8(0, scaled_u8(&kernel, 0));
    TEST_ASSERT_EQUAL_UINT8(0, scaled_u8(&kernel, 1));
    kernel.bias = 255;
    TEST_ASSERT_EQUAL_UINT8(254, scaled_u8(&kernel, 1));
    TEST_ASSERT_EQUAL_UINT8(0, scaled_u8(&kernel, 255));
    kernel.bias = 32767;
    TEST_ASSERT_EQUAL_UINT8(255, scaled_u8(&kernel, 255));
    kernel.bias = -32768;
    TEST_ASSERT_EQUAL_UINT8(0, scaled_u8(&kernel, 255));
}

/* Sobel / 8 + 128 as a picture: the largest gradient is 127.5, the smallest -127.5. */
static void test_a_signed_result_around_128(void)
{
    static const uint8_t rising[9] = {0, 9, 255, 0, 9, 255, 0, 9, 255};
    static const uint8_t falling[9] = {255, 9, 0, 255, 9, 0, 255, 9, 0};
    pel_kernel kernel = *pel_kernel_named("sobel_x");
    kernel.shift = 3;
    kernel.bias = 128;
    TEST_ASSERT_EQUAL_UINT8(255, one_u8(&kernel, rising));
    TEST_ASSERT_EQUAL_UINT8(1, one_u8(&kernel, falling));
}

/* ---- The largest sums ---------------------------------------------------------------------- */

static pel_kernel flat(int8_t even, int8_t odd, uint8_t radius, uint16_t divisor)
{
    pel_kernel kernel = {{0}, 1, 0, 0, 0, 0};
    kernel.radius = radius;
    kernel.divisor = divisor;
    for (unsigned k = 0; k < 25; k++) {
        kernel.tap[k] = k % 2 == 0 ? even : odd;
    }
    return kernel;
}

static void fill(uint8_t *pixels, uint8_t even, uint8_t odd)
{
    for (unsigned k = 0; k < 25; k++) {
        pixels[k] = k % 2 == 0 ? even : odd;
    }
}

/* 9 taps: 9 * -128 * 255 = -293760; 25 taps: -816000. Divided by 9 or 25 both are -32640. */
static void test_all_taps_at_their_least_on_white(void)
{
    for (uint8_t radius = 1; radius <= 2; radius++) {
        const uint16_t divisor = radius == 1 ? 9 : 25;
        pel_kernel kernel = flat(-128, -128, radius, divisor);
        uint8_t white[25];
        fill(white, 255, 255);
        TEST_ASSERT_EQUAL_INT16(-32640, one_s16(&kernel, white));
        TEST_ASSERT_EQUAL_UINT8(0, one_u8(&kernel, white));
        kernel.bias = -128;
        TEST_ASSERT_EQUAL_INT16(-32768, one_s16(&kernel, white));
        kernel.bias = -129;
        TEST_ASSERT_EQUAL_INT16(-32768, one_s16(&kernel, white));
        kernel.bias = 32767;
        TEST_ASSERT_EQUAL_INT16(127, one_s16(&kernel, white));
        TEST_ASSERT_EQUAL_UINT8(127, one_u8(&kernel, white));
        kernel.bias = 0;
        kernel.absolute = 1;
        TEST_ASSERT_EQUAL_INT16(32640, one_s16(&kernel, white));
        TEST_ASSERT_EQUAL_UINT8(255, one_u8(&kernel, white));
    }
}

/* 291465 / 9 = 809625 / 25 = 32385. */
static void test_all_taps_at_their_most_on_white(void)
{
    for (uint8_t radius = 1; radius <= 2; radius++) {
        pel_kernel kernel = flat(127, 127, radius, radius == 1 ? 9 : 25);
        uint8_t white[25];
        fill(white, 255, 255);
        TEST_ASSERT_EQUAL_INT16(32385, one_s16(&kernel, white));
        TEST_ASSERT_EQUAL_UINT8(255, one_u8(&kernel, white));
        kernel.bias = 382;
        TEST_ASSERT_EQUAL_INT16(32767, one_s16(&kernel, white));
        kernel.bias = 383;
        TEST_ASSERT_EQUAL_INT16(32767, one_s16(&kernel, white));
        kernel.bias = -32768;
        TEST_ASSERT_EQUAL_INT16(-383, one_s16(&kernel, white));
    }
}

static void test_undivided_sums_are_limited_to_16_bits(void)
{
    uint8_t white[25];
    fill(white, 255, 255);
    for (uint8_t radius = 1; radius <= 2; radius++) {
        pel_kernel least = flat(-128, -128, radius, 1), most = flat(127, 127, radius, 0);
        TEST_ASSERT_EQUAL_INT16(-32768, one_s16(&least, white));
        TEST_ASSERT_EQUAL_INT16(32767, one_s16(&most, white));
        least.absolute = 1;
        TEST_ASSERT_EQUAL_INT16(32767, one_s16(&least, white));
        most.bias = -32768;
        TEST_ASSERT_EQUAL_INT16(32767, one_s16(&most, white));
    }
}

/* 3x3: 5 taps of 127, 4 of -128; 5x5: 13 and 12. */
static void test_alternating_taps(void)
{
    pel_kernel small = flat(127, -128, 1, 5), large = flat(127, -128, 2, 13);
    uint8_t even[25], odd[25], white[25];
    fill(even, 255, 0);
    fill(odd, 0, 255);
    fill(white, 255, 255);
    TEST_ASSERT_EQUAL_INT16(32385, one_s16(&small, even)); /* 161925 / 5 */
    TEST_ASSERT_EQUAL_INT16(-26112, one_s16(&small, odd)); /* -130560 / 5 */
    TEST_ASSERT_EQUAL_INT16(6273, one_s16(&small, white)); /* 31365 / 5 */
    TEST_ASSERT_EQUAL_INT16(32385, one_s16(&large, even)); /* 421005 / 13 */
    TEST_ASSERT_EQUAL_INT16(-30129, one_s16(&large, odd)); /* -391680 / 13 */
    TEST_ASSERT_EQUAL_INT16(2256, one_s16(&large, white)); /* 29325 / 13 */
}

static void test_the_largest_division(void)
{
    pel_kernel kernel = flat(-128, -128, 2, 32767);
    uint8_t white[25];
    fill(white, 255, 255);
    TEST_ASSERT_EQUAL_INT16(-25, one_s16(&kernel, white)); /* -24.903 */
    kernel.shift = 5;
    TEST_ASSERT_EQUAL_INT16(-1, one_s16(&kernel, white)); /* -0.778 */
    kernel.shift = 15;
    TEST_ASSERT_EQUAL_INT16(0, one_s16(&kernel, white));
    kernel.divisor = 0;
    TEST_ASSERT_EQUAL_INT16(-25, one_s16(&kernel, white)); /* -24.902 */
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_named_kernel_is_as_documented);
    RUN_TEST(test_the_names_are_listed_once_each);
    RUN_TEST(test_other_names_are_none);
    RUN_TEST(test_a_flipped_kernel_is_turned_by_half_a_turn);
    RUN_TEST(test_flipping_keeps_division_bias_and_absolute);
    RUN_TEST(test_a_changed_copy_of_a_named_kernel);
    RUN_TEST(test_identity_changes_nothing);
    RUN_TEST(test_shifts_move_the_picture_where_they_say);
    RUN_TEST(test_what_a_shift_brings_in_is_the_border);
    RUN_TEST(test_two_pixels_to_the_right);
    RUN_TEST(test_two_pixels_down);
    RUN_TEST(test_a_5x5_kernel_on_a_single_pixel);
    RUN_TEST(test_halves_are_rounded_upward);
    RUN_TEST(test_a_shift_rounds_like_a_divisor);
    RUN_TEST(test_an_odd_divisor_never_meets_a_half);
    RUN_TEST(test_divisor_0_stands_for_1);
    RUN_TEST(test_absolute_comes_before_the_division);
    RUN_TEST(test_the_bias_comes_after_the_division);
    RUN_TEST(test_eight_bits_are_limited_at_both_ends);
    RUN_TEST(test_a_signed_result_around_128);
    RUN_TEST(test_all_taps_at_their_least_on_white);
    RUN_TEST(test_all_taps_at_their_most_on_white);
    RUN_TEST(test_undivided_sums_are_limited_to_16_bits);
    RUN_TEST(test_alternating_taps);
    RUN_TEST(test_the_largest_division);
    return UNITY_END();
}
