/*
 * The streaming calls of the filter module: how much memory is needed, what is refused and by which
 * name, that a refusal touches nothing, when rows are due and when they are ready, and that nothing
 * is written beside work and result. Frames are in test_filter_frames.c.
 */
#include "filter_room.h"

/* ---- Memory -------------------------------------------------------------------------------- */

static void test_bytes_of_a_3x3_filter_on_320_pixels(void)
{
    static uint8_t three_rows[PEL_FILTER_BYTES(320, 1)];
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(3 * 320 + 64, (uint32_t)sizeof three_rows);
    TEST_ASSERT_EQUAL_UINT32(3 * 322, (uint32_t)sizeof three_rows);
    TEST_ASSERT_LESS_THAN_UINT32(100, (uint32_t)sizeof(pel_filter));
}

static void test_macro_and_function_agree(void)
{
    static const uint16_t widths[] = {1, 2, 3, 5, 8, 320, 321, 640, 8191, 8192};
    for (unsigned i = 0; i < sizeof widths / sizeof widths[0]; i++) {
        for (unsigned radius = 1; radius <= 2; radius++) {
            const uint16_t w = widths[i];
            for (int border = 0; border <= PEL_BORDER_VALID; border++) {
                const size_t expected = border == PEL_BORDER_WRAP ? PEL_FILTER_BYTES_WRAP(w, radius)
                                                                  : PEL_FILTER_BYTES(w, radius);
                TEST_ASSERT_EQUAL_UINT32((uint32_t)expected,
                                         (uint32_t)pel_filter_bytes(w, radius, (pel_border)border));
            }
        }
    }
}

static void test_bytes_are_rows_with_pixels_on_either_side(void)
{
    TEST_ASSERT_EQUAL_UINT32(3 * 12, (uint32_t)pel_filter_bytes(10, 1, PEL_BORDER_CONSTANT));
    TEST_ASSERT_EQUAL_UINT32(4 * 12, (uint32_t)pel_filter_bytes(10, 1, PEL_BORDER_WRAP));
    TEST_ASSERT_EQUAL_UINT32(5 * 14, (uint32_t)pel_filter_bytes(10, 2, PEL_BORDER_CONSTANT));
    TEST_ASSERT_EQUAL_UINT32(7 * 14, (uint32_t)pel_filter_bytes(10, 2, PEL_BORDER_WRAP));
}

static void test_size_of_the_result(void)
{
    pel_filter_config config = kernel_config("gauss5");
    for (int border = 0; border < PEL_BORDER_VALID; border++) {
        config.border = (pel_border)border;
        TEST_ASSERT_EQUAL_UINT16(WIDTH, pel_filter_width(&config));
        TEST_ASSERT_EQUAL_UINT16(HEIGHT, pel_filter_height(&config));
    }
    config.border = PEL_BORDER_VALID;
    TEST_ASSERT_EQUAL_UINT16(WIDTH - 4, pel_filter_width(&config));
    TEST_ASSERT_EQUAL_UINT16(HEIGHT - 4, pel_filter_height(&config));
    config.op = pel_op_median; /* 3x3, whatever the kernel */
    TEST_ASSERT_EQUAL_UINT16(WIDTH - 2, pel_filter_width(&config));
    TEST_ASSERT_EQUAL_UINT16(HEIGHT - 2, pel_filter_height(&config));
}

/* ---- What begin refuses -------------------------------------------------------------------- */

static void expect_begin(pel_status expected, const pel_filter_config *config)
{
    union {
        pel_filter filter;
        uint8_t bytes[sizeof(pel_filter)];
    } place;
    fill(place.bytes, CANARY, sizeof place.bytes);
    TEST_ASSERT_EQUAL_INT(expected, pel_filter_begin(&place.filter, config));
    if (expected < 0) {
        /* One check: how many bytes the struct has differs from machine to machine. */
        uint32_t touched = 0;
        for (size_t i = 0; i < sizeof place.bytes; i++) {
            touched += place.bytes[i] != CANARY;
        }
        TEST_ASSERT_EQUAL_UINT32(0, touched);
        expect_untouched(work_room, sizeof work_room);
    }
}

static void test_begin_accepts_what_it_should(void)
{
    static pel_filter_op *const ops[] = {NULL, pel_op_median, pel_op_gradient};
    for (unsigned i = 0; i < 3; i++) {
        for (int border = 0; border <= PEL_BORDER_VALID; border++) {
            pel_filter_config config = config_of(ops[i], "sobel_x", (pel_border)border);
            expect_begin(PEL_OK, &config);
            expect_guards(config.work_bytes, 0);
            config.op_s16 = pel_op_gradient_s16;
            expect_begin(PEL_OK, &config);
        }
    }
}

static void test_begin_refuses_null_pointers(void)
{
    pel_filter filter;
    pel_filter_config config = kernel_config("box3");
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_filter_begin(NULL, &config));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_filter_begin(&filter, NULL));
    config.work = NULL;
    expect_begin(PEL_ERR_ARG, &config);
    config = kernel_config("box3");
    config.kernel = NULL;
    expect_begin(PEL_ERR_ARG, &config);
    config.op = pel_op_median;
    expect_begin(PEL_OK, &config);
}

/* Operators that give their kernel's divisor for their radius. */
static unsigned any_radius(const uint8_t *const rows[], uint16_t count,
                           const pel_filter_config *config, uint8_t *bytes)
{
    (void)rows, (void)count, (void)bytes;
    return config->kernel->divisor;
}

static unsigned any_radius_s16(const uint8_t *const rows[], uint16_t count,
                               const pel_filter_config *config, int16_t *words)
{
    (void)rows, (void)count, (void)words;
    return config->kernel->divisor;
}

static void expect_begin_with(pel_status expected, pel_filter_config *config, pel_filter_op *op,
                              pel_filter_op_s16 *op_s16)
{
    config->op = op;
    config->op_s16 = op_s16;
    setUp();
    expect_begin(expected, config);
}

static void test_begin_refuses_radii_that_it_cannot_do(void)
{
    pel_kernel kernel = {{0}, 1, 1, 0, 0, 0};
    pel_filter_config config = kernel_config("binomial5"); /* memory for radius 2 */
    config.kernel = &kernel;
    for (uint16_t radius = 0; radius <= 4; radius++) {
        const pel_status expected = radius == 1 || radius == 2 ? PEL_OK : PEL_ERR_ARG;
        kernel.divisor = radius;
        expect_begin_with(expected, &config, any_radius, NULL);
        expect_begin_with(expected, &config, NULL, any_radius_s16);
        expect_begin_with(expected, &config, any_radius, any_radius_s16);
        expect_begin_with(radius == 2 ? PEL_OK : PEL_ERR_ARG, &config, pel_op_binomial5,
                          any_radius_s16);
        expect_begin_with(radius == 1 ? PEL_OK : PEL_ERR_ARG, &config, any_radius,
                          pel_op_gradient_s16);
    }
}

/* An operator that writes which backend it is to use. */
static unsigned backend_of(const uint8_t *const rows[], uint16_t count,
                           const pel_filter_config *config, uint8_t *bytes)
{
    (void)rows;
    for (uint16_t x = 0; x < count; x++) {
        bytes[x] = (uint8_t)config->backend;
    }
    return 1;
}

static void test_begin_chooses_the_backend(void)
{
    for (unsigned wish = 0; wish < PEL_BACKEND_COUNT; wish++) {
        pel_filter_config config = kernel_config("box3");
        pel_filter filter;
        uint8_t row[32] = {0};
        config.op = backend_of;
        config.height = 1;
        config.backend = (pel_backend)wish;
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_begin(&filter, &config));
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_push(&filter, row));
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_pull(&filter, row));
        TEST_ASSERT_NOT_EQUAL(PEL_BACKEND_AUTO, row[0]);
        TEST_ASSERT_TRUE(pel_backend_available((pel_backend)row[0]));
    }
}

static void test_begin_refuses_unknown_backends(void)
{
    pel_filter_config config = kernel_config("box3");
    config.backend = PEL_BACKEND_COUNT;
    expect_begin(PEL_ERR_ARG, &config);
    config.backend = (pel_backend)-1;
    expect_begin(PEL_ERR_ARG, &config);
}

static void test_begin_refuses_unknown_borders(void)
{
    pel_filter_config config = kernel_config("box3");
    config = kernel_config("box3");
    config.border = (pel_border)(PEL_BORDER_VALID + 1);
    expect_begin(PEL_ERR_ARG, &config);
    config.border = (pel_border)-1;
    expect_begin(PEL_ERR_ARG, &config);
}

static void test_begin_refuses_kernels_out_of_range(void)
{
    pel_filter_config config = kernel_config("box3");
    pel_kernel kernel = *config.kernel;
    config.work_bytes = sizeof work_room - 2 * (size_t)GUARD;
    config.kernel = &kernel;
    expect_begin(PEL_OK, &config);
    setUp();
    kernel.radius = 0;
    expect_begin(PEL_ERR_ARG, &config);
    kernel.radius = 3;
    expect_begin(PEL_ERR_ARG, &config);
    kernel.radius = 255;
    expect_begin(PEL_ERR_ARG, &config);
    kernel.radius = 1;
    kernel.divisor = 32768u;
    expect_begin(PEL_ERR_ARG, &config);
    kernel.divisor = 65535u;
    expect_begin(PEL_ERR_ARG, &config);
    kernel.divisor = 9;
    kernel.shift = 16;
    expect_begin(PEL_ERR_ARG, &config);
    kernel.shift = 255;
    expect_begin(PEL_ERR_ARG, &config);
    kernel.shift = 15;
    kernel.divisor = 32767;
    expect_begin(PEL_OK, &config);
}

static void test_begin_refuses_wrap_without_the_last_rows(void)
{
    pel_filter_config config = config_of(NULL, "box3", PEL_BORDER_WRAP);
    expect_begin(PEL_OK, &config); /* radius 1 needs one row */
    setUp();
    config.last_rows[0] = NULL;
    expect_begin(PEL_ERR_ARG, &config);
    config = config_of(NULL, "gauss5", PEL_BORDER_WRAP);
    config.last_rows[1] = NULL;
    expect_begin(PEL_ERR_ARG, &config);
    config = config_of(NULL, "gauss5", PEL_BORDER_WRAP);
    config.last_rows[0] = NULL;
    expect_begin(PEL_ERR_ARG, &config);
}

static void expect_size(pel_status expected, const char *kernel, pel_border border, uint16_t width,
                        uint16_t height)
{
    pel_filter_config config = config_of(NULL, kernel, border);
    config.width = width;
    config.height = height;
    config.work_bytes = SIZE_MAX; /* larger than it is: no size is refused for want of memory */
    expect_begin(expected, &config);
}

static void test_begin_refuses_impossible_sizes(void)
{
    expect_size(PEL_ERR_RANGE, "box3", PEL_BORDER_REPLICATE, 0, 4);
    expect_size(PEL_ERR_RANGE, "box3", PEL_BORDER_REPLICATE, 4, 0);
    expect_size(PEL_ERR_RANGE, "box3", PEL_BORDER_REPLICATE, PEL_SIDE_MAX + 1, 4);
    expect_size(PEL_ERR_RANGE, "box3", PEL_BORDER_REPLICATE, 4, PEL_SIDE_MAX + 1);
    expect_size(PEL_ERR_RANGE, "box3", PEL_BORDER_REPLICATE, 65535u, 65535u);
    expect_size(PEL_OK, "box3", PEL_BORDER_REPLICATE, 1, 1);
    expect_size(PEL_OK, "gauss5", PEL_BORDER_REPLICATE, 1, PEL_SIDE_MAX);
}

static void test_begin_refuses_pictures_without_a_valid_pixel(void)
{
    expect_size(PEL_ERR_RANGE, "box3", PEL_BORDER_VALID, 2, 3);
    expect_size(PEL_ERR_RANGE, "box3", PEL_BORDER_VALID, 3, 2);
    expect_size(PEL_ERR_RANGE, "gauss5", PEL_BORDER_VALID, 4, 5);
    expect_size(PEL_ERR_RANGE, "gauss5", PEL_BORDER_VALID, 5, 4);
    expect_size(PEL_OK, "box3", PEL_BORDER_VALID, 3, 3);
    expect_size(PEL_OK, "gauss5", PEL_BORDER_VALID, 5, 5);
}

static void test_begin_refuses_too_little_memory(void)
{
    static const char *const names[] = {"box3", "gauss5"};
    for (unsigned i = 0; i < 2; i++) {
        for (int border = 0; border <= PEL_BORDER_VALID; border++) {
            pel_filter_config config = config_of(NULL, names[i], (pel_border)border);
            setUp();
            config.work_bytes--;
            expect_begin(PEL_ERR_SPACE, &config);
            config.work_bytes = 0;
            expect_begin(PEL_ERR_SPACE, &config);
        }
    }
}

/* ---- Pushing and pulling ------------------------------------------------------------------- */

static void expect_pull(pel_status expected, pel_filter *filter)
{
    const uint16_t row = filter->row;
    fill(out, CANARY, PIXELS);
    TEST_ASSERT_EQUAL_INT(expected, pel_filter_pull(filter, out));
    TEST_ASSERT_EQUAL_UINT16(expected == PEL_OK ? row + 1 : row, filter->row);
    if (expected != PEL_OK) {
        expect_untouched(out_room, sizeof out_room);
    }
}

static void test_rows_come_one_behind_and_two_at_the_end(void)
{
    const pel_filter_config config = kernel_config("identity");
    pel_filter filter;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_begin(&filter, &config));
    TEST_ASSERT_EQUAL_UINT16(0, filter.row);
    expect_pull(PEL_ERR_ORDER, &filter);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_push(&filter, picture));
    expect_pull(PEL_ERR_ORDER, &filter);
    for (unsigned y = 1; y < HEIGHT; y++) {
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_push(&filter, picture + y * WIDTH));
        TEST_ASSERT_EQUAL_INT(PEL_ERR_ORDER, pel_filter_push(&filter, picture));
        expect_pull(PEL_OK, &filter);
        TEST_ASSERT_EQUAL_UINT8_ARRAY(picture + (y - 1) * WIDTH, out, WIDTH);
        if (y + 1 < HEIGHT) {
            expect_pull(PEL_ERR_ORDER, &filter);
        }
    }
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ORDER, pel_filter_push(&filter, picture));
    expect_pull(PEL_OK, &filter);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(picture + (HEIGHT - 1) * WIDTH, out, WIDTH);
    expect_pull(PEL_ERR_ORDER, &filter);
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ORDER, pel_filter_push(&filter, picture));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ORDER, pel_filter_pull_s16(&filter, out_s16));
    TEST_ASSERT_EQUAL_INT16(CANARY, out_s16[0]);
    TEST_ASSERT_EQUAL_UINT16(HEIGHT, filter.row);
}

/* How many rows become ready with each push. */
static void expect_schedule(const char *kernel, pel_border border, const uint8_t *ready)
{
    const pel_filter_config config = config_of(NULL, kernel, border);
    pel_filter filter;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_begin(&filter, &config));
    for (unsigned y = 0; y < HEIGHT; y++) {
        unsigned pulled = 0;
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_push(&filter, picture + y * WIDTH));
        while (pel_filter_pull(&filter, out) == PEL_OK) {
            pulled++;
        }
        TEST_ASSERT_EQUAL_UINT(ready[y], pulled);
    }
    expect_guards(config.work_bytes, pel_filter_width(&config));
}

static void test_when_rows_are_ready(void)
{
    static const uint8_t small[HEIGHT] = {0, 1, 1, 1, 2}, small_valid[HEIGHT] = {0, 0, 1, 1, 1};
    static const uint8_t large[HEIGHT] = {0, 0, 1, 1, 3}, large_valid[HEIGHT] = {0, 0, 0, 0, 1};
    for (int border = 0; border < PEL_BORDER_VALID; border++) {
        setUp();
        expect_schedule("box3", (pel_border)border, small);
        setUp();
        expect_schedule("gauss5", (pel_border)border, large);
    }
    setUp();
    expect_schedule("box3", PEL_BORDER_VALID, small_valid);
    setUp();
    expect_schedule("gauss5", PEL_BORDER_VALID, large_valid);
}

static void test_null_rows_are_refused_and_change_nothing(void)
{
    const pel_filter_config config = kernel_config("identity");
    pel_filter filter;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_begin(&filter, &config));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_filter_push(&filter, NULL));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_filter_push(NULL, picture));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_push(&filter, picture));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_push(&filter, picture + WIDTH));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_filter_pull(&filter, NULL));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_filter_pull(NULL, out));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_filter_pull_s16(&filter, NULL));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_filter_pull_s16(NULL, out_s16));
    expect_pull(PEL_OK, &filter);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(picture, out, WIDTH);
}

static void test_a_new_begin_forgets_the_old_picture(void)
{
    const pel_filter_config config = kernel_config("shift_down");
    pel_filter filter;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_begin(&filter, &config));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_push(&filter, picture));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_push(&filter, picture));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_begin(&filter, &config));
    TEST_ASSERT_EQUAL_UINT16(0, filter.row);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_push(&filter, picture + 2 * WIDTH));
    expect_pull(PEL_ERR_ORDER, &filter);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_push(&filter, picture));
    expect_pull(PEL_OK, &filter);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(picture + 2 * WIDTH, out, WIDTH);
}

/* Which of the two pulls a config allows. */
static void expect_pulls(const pel_filter_config *config, int in_bytes, int in_words)
{
    pel_filter filter;
    setUp();
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_begin(&filter, config));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_push(&filter, picture));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_push(&filter, picture + WIDTH));
    if (!in_bytes) {
        expect_pull(PEL_ERR_FORMAT, &filter);
        TEST_ASSERT_EQUAL_UINT16(0, filter.row);
    }
    TEST_ASSERT_EQUAL_INT(in_words ? PEL_OK : PEL_ERR_FORMAT,
                          pel_filter_pull_s16(&filter, out_s16));
    TEST_ASSERT_EQUAL_INT16(CANARY, out_s16[in_words ? WIDTH : 0]);
    TEST_ASSERT_EQUAL_UINT16(in_words ? 1 : 0, filter.row);
    expect_pull(!in_bytes ? PEL_ERR_FORMAT : in_words ? PEL_ERR_ORDER : PEL_OK, &filter);
}

static void test_results_come_in_the_form_that_was_asked_for(void)
{
    pel_filter_config config = kernel_config("sobel_x");
    expect_pulls(&config, 1, 1);
    config.op = pel_op_gradient;
    expect_pulls(&config, 1, 0);
    config.op_s16 = pel_op_gradient_s16;
    expect_pulls(&config, 1, 1);
    config.op = NULL;
    expect_pulls(&config, 0, 1);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_bytes_of_a_3x3_filter_on_320_pixels);
    RUN_TEST(test_macro_and_function_agree);
    RUN_TEST(test_bytes_are_rows_with_pixels_on_either_side);
    RUN_TEST(test_size_of_the_result);
    RUN_TEST(test_begin_accepts_what_it_should);
    RUN_TEST(test_begin_refuses_null_pointers);
    RUN_TEST(test_begin_refuses_radii_that_it_cannot_do);
    RUN_TEST(test_begin_chooses_the_backend);
    RUN_TEST(test_begin_refuses_unknown_backends);
    RUN_TEST(test_begin_refuses_unknown_borders);
    RUN_TEST(test_begin_refuses_kernels_out_of_range);
    RUN_TEST(test_begin_refuses_wrap_without_the_last_rows);
    RUN_TEST(test_begin_refuses_impossible_sizes);
    RUN_TEST(test_begin_refuses_pictures_without_a_valid_pixel);
    RUN_TEST(test_begin_refuses_too_little_memory);
    RUN_TEST(test_rows_come_one_behind_and_two_at_the_end);
    RUN_TEST(test_when_rows_are_ready);
    RUN_TEST(test_null_rows_are_refused_and_change_nothing);
    RUN_TEST(test_a_new_begin_forgets_the_old_picture);
    RUN_TEST(test_results_come_in_the_form_that_was_asked_for);
    return UNITY_END();
}
