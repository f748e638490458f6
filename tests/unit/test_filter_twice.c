/*
 * Opening and closing by two filters, one after the other: what they do to spots and gaps, how
 * much memory they need, and what is refused.
 */
#include "unity.h"

#include <pel.h>
#include <pel/filter.h>

enum { WIDTH = 7, HEIGHT = 6, PIXELS = WIDTH * HEIGHT, GUARD = 8, CANARY = 0xA5 };

/* A square of 3 x 3, a spot, and a line that leaves the picture. */
static const char drawing[PIXELS + 1] = "......#"
                                        ".###..#"
                                        ".###..#"
                                        ".###..."
                                        "......."
                                        ".....#.";

static const char opened[PIXELS + 1] = "......."
                                       ".###..."
                                       ".###..."
                                       ".###..."
                                       "......."
                                       ".......";

static uint8_t work_room[GUARD + PEL_FILTER_BYTES_WRAP(WIDTH, 1) + GUARD];
static uint8_t *const work = work_room + GUARD;
static uint8_t source[PIXELS];
static uint8_t out_room[GUARD + PIXELS + GUARD];
static uint8_t *const out = out_room + GUARD;

static void draw(const char *pixels, char white)
{
    for (unsigned i = 0; i < PIXELS; i++) {
        source[i] = pixels[i] == white ? 200 : 10;
    }
}

void setUp(void)
{
    for (unsigned i = 0; i < sizeof work_room; i++) {
        work_room[i] = CANARY;
    }
    for (unsigned i = 0; i < sizeof out_room; i++) {
        out_room[i] = CANARY;
    }
    draw(drawing, '#');
}

void tearDown(void)
{
}

static pel_filter_config config_of(pel_border border)
{
    pel_filter_config config = {0};
    config.border = border;
    config.work = work;
    config.work_bytes = PEL_FILTER_BYTES_WRAP(WIDTH, 1);
    return config;
}

static pel_cview source_view(void)
{
    pel_cview view;
    TEST_ASSERT_EQUAL_INT(
        PEL_OK, pel_cview_init(source, PEL_GRAY8, PEL_RANGE_FULL, WIDTH, HEIGHT, 0, &view));
    return view;
}

static pel_view target_view(uint8_t *pixels)
{
    pel_view view;
    TEST_ASSERT_EQUAL_INT(
        PEL_OK, pel_view_init(pixels, PEL_GRAY8, PEL_RANGE_FULL, WIDTH, HEIGHT, 0, &view));
    return view;
}

static void expect_picture(const char *expected, char white, const uint8_t *pixels)
{
    for (unsigned i = 0; i < PIXELS; i++) {
        TEST_ASSERT_EQUAL_UINT8(expected[i] == white ? 200 : 10, pixels[i]);
    }
}

static void expect_guards(void)
{
    TEST_ASSERT_EACH_EQUAL_UINT8(CANARY, work_room, GUARD);
    TEST_ASSERT_EACH_EQUAL_UINT8(CANARY, work + PEL_FILTER_BYTES_WRAP(WIDTH, 1), GUARD);
    TEST_ASSERT_EACH_EQUAL_UINT8(CANARY, out_room, GUARD);
    TEST_ASSERT_EACH_EQUAL_UINT8(CANARY, out + PIXELS, GUARD);
}

/* Outside is dark: the line at the edge is as thin as it looks. */
static void test_opening_removes_what_is_thinner_than_3_pixels(void)
{
    pel_filter_config config = config_of(PEL_BORDER_CONSTANT);
    const pel_cview from = source_view();
    const pel_view to = target_view(out);
    config.constant = 10;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_twice(&config, pel_op_min, pel_op_max, &from, &to));
    expect_picture(opened, '#', out);
    expect_guards();
}

/* The same in negative colours. */
static void test_closing_fills_what_is_thinner_than_3_pixels(void)
{
    pel_filter_config config = config_of(PEL_BORDER_CONSTANT);
    const pel_cview from = source_view();
    const pel_view to = target_view(out);
    config.constant = 200;
    draw(drawing, '.');
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_twice(&config, pel_op_max, pel_op_min, &from, &to));
    expect_picture(opened, '.', out);
    expect_guards();
}

static void test_the_order_makes_a_difference(void)
{
    pel_filter_config config = config_of(PEL_BORDER_CONSTANT);
    const pel_cview from = source_view();
    const pel_view to = target_view(out);
    config.constant = 10;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_twice(&config, pel_op_max, pel_op_min, &from, &to));
    TEST_ASSERT_EQUAL_UINT8(200, out[1 * WIDTH + 1]);
    TEST_ASSERT_EQUAL_UINT8(200, out[1 * WIDTH + 4]); /* the gap of two between square and line */
    TEST_ASSERT_EQUAL_UINT8(200, out[1 * WIDTH + 5]);
    TEST_ASSERT_EQUAL_UINT8(10, out[4 * WIDTH + 0]);
}

static void test_twice_in_place(void)
{
    pel_filter_config config = config_of(PEL_BORDER_CONSTANT);
    const pel_cview from = source_view();
    const pel_view to = target_view(source);
    config.constant = 10;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_twice(&config, pel_op_min, pel_op_max, &from, &to));
    expect_picture(opened, '#', source);
    expect_guards();
}

static void expect_refused(pel_status expected, const pel_filter_config *config,
                           pel_filter_op *first, pel_filter_op *second, const pel_cview *from,
                           const pel_view *to)
{
    TEST_ASSERT_EQUAL_INT(expected, pel_filter_twice(config, first, second, from, to));
    TEST_ASSERT_EACH_EQUAL_UINT8(CANARY, out_room, sizeof out_room);
    expect_guards();
}

static void test_twice_refuses_borders_that_it_cannot_do(void)
{
    pel_filter_config config = config_of(PEL_BORDER_VALID);
    const pel_cview from = source_view();
    const pel_view to = target_view(out);
    expect_refused(PEL_ERR_ARG, &config, pel_op_min, pel_op_max, &from, &to);
    config.border = (pel_border)17;
    expect_refused(PEL_ERR_ARG, &config, pel_op_min, pel_op_max, &from, &to);
}

/* NULL is the kernel. */
static void test_twice_with_a_kernel(void)
{
    pel_filter_config config = config_of(PEL_BORDER_WRAP);
    const pel_cview from = source_view();
    const pel_view to = target_view(out);
    config.kernel = pel_kernel_named("shift_left");
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_twice(&config, NULL, NULL, &from, &to));
    for (unsigned i = 0; i < PIXELS; i++) {
        const unsigned x = i % WIDTH;
        TEST_ASSERT_EQUAL_UINT8(source[i - x + (x + 2) % WIDTH], out[i]);
    }
    config.kernel = pel_kernel_named("shift_down");
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_twice(&config, pel_op_max, NULL, &from, &to));
    TEST_ASSERT_EQUAL_UINT8(200, out[0 * WIDTH + 6]); /* the spot below, from the other side */
    TEST_ASSERT_EQUAL_UINT8(10, out[0 * WIDTH + 2]);
    expect_guards();
}

static void test_twice_refuses_operators_that_it_cannot_do(void)
{
    pel_filter_config config = config_of(PEL_BORDER_REPLICATE);
    const pel_cview from = source_view();
    const pel_view to = target_view(out);
    expect_refused(PEL_ERR_ARG, &config, pel_op_min, NULL, &from, &to); /* no kernel */
    expect_refused(PEL_ERR_ARG, &config, NULL, pel_op_min, &from, &to);
    expect_refused(PEL_ERR_SPACE, &config, pel_op_min, pel_op_binomial5, &from, &to);
    expect_refused(PEL_ERR_SPACE, &config, pel_op_binomial5, pel_op_min, &from, &to);
}

static void test_twice_refuses_null_pointers_and_little_memory(void)
{
    pel_filter_config config = config_of(PEL_BORDER_REPLICATE);
    const pel_cview from = source_view();
    const pel_view to = target_view(out);
    expect_refused(PEL_ERR_ARG, NULL, pel_op_min, pel_op_max, &from, &to);
    expect_refused(PEL_ERR_ARG, &config, pel_op_min, pel_op_max, NULL, &to);
    expect_refused(PEL_ERR_ARG, &config, pel_op_min, pel_op_max, &from, NULL);
    config.work_bytes = PEL_FILTER_BYTES(WIDTH, 1) - 1;
    expect_refused(PEL_ERR_SPACE, &config, pel_op_min, pel_op_max, &from, &to);
    config = config_of(PEL_BORDER_REPLICATE);
    config.work = NULL;
    expect_refused(PEL_ERR_ARG, &config, pel_op_min, pel_op_max, &from, &to);
}

static void test_twice_refuses_other_sizes_formats_and_overlap(void)
{
    const pel_filter_config config = config_of(PEL_BORDER_REPLICATE);
    pel_cview from = source_view();
    pel_view to = target_view(out);
    to.height--;
    expect_refused(PEL_ERR_SPACE, &config, pel_op_min, pel_op_max, &from, &to);
    to = target_view(out);
    from.plane[0] = out + 1;
    expect_refused(PEL_ERR_ARG, &config, pel_op_min, pel_op_max, &from, &to);
    from.plane[0] = source;
    from.width = to.width = WIDTH - 1;
    from.format = PEL_BAYER8_RGGB;
    expect_refused(PEL_ERR_FORMAT, &config, pel_op_min, pel_op_max, &from, &to);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_opening_removes_what_is_thinner_than_3_pixels);
    RUN_TEST(test_closing_fills_what_is_thinner_than_3_pixels);
    RUN_TEST(test_the_order_makes_a_difference);
    RUN_TEST(test_twice_in_place);
    RUN_TEST(test_twice_with_a_kernel);
    RUN_TEST(test_twice_refuses_borders_that_it_cannot_do);
    RUN_TEST(test_twice_refuses_operators_that_it_cannot_do);
    RUN_TEST(test_twice_refuses_null_pointers_and_little_memory);
    RUN_TEST(test_twice_refuses_other_sizes_formats_and_overlap);
    return UNITY_END();
}
