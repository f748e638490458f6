/*
 * Filters on whole frames: what is refused and by which name, that a refusal touches nothing, and
 * where source and target may lie.
 */
#include "filter_room.h"

/* ---- Frames -------------------------------------------------------------------------------- */

static pel_cview source_view(void)
{
    pel_cview view;
    TEST_ASSERT_EQUAL_INT(
        PEL_OK, pel_cview_init(picture, PEL_GRAY8, PEL_RANGE_FULL, WIDTH, HEIGHT, 0, &view));
    return view;
}

static pel_view target_view(uint16_t width, uint16_t height)
{
    pel_view view;
    TEST_ASSERT_EQUAL_INT(PEL_OK,
                          pel_view_init(out, PEL_GRAY8, PEL_RANGE_FULL, width, height, 0, &view));
    return view;
}

static void expect_frame(pel_status expected, const pel_filter_config *config,
                         const pel_cview *source, const pel_view *target)
{
    TEST_ASSERT_EQUAL_INT(expected, pel_filter_frame(config, source, target));
    if (expected < 0) {
        expect_untouched(out_room, sizeof out_room);
    }
    expect_guards(config == NULL ? 0 : sizeof work_room - 2 * GUARD, PIXELS);
}

static void test_frames_need_views_of_gray_pixels(void)
{
    const pel_filter_config config = kernel_config("box3");
    pel_cview source = source_view();
    pel_view target = target_view(WIDTH, HEIGHT);
    expect_frame(PEL_ERR_ARG, NULL, &source, &target);
    expect_frame(PEL_ERR_ARG, &config, NULL, &target);
    expect_frame(PEL_ERR_ARG, &config, &source, NULL);
    source.plane[0] = NULL;
    expect_frame(PEL_ERR_ARG, &config, &source, &target);
    source = source_view();
    target.plane[0] = NULL;
    expect_frame(PEL_ERR_ARG, &config, &source, &target);
    target = target_view(WIDTH, HEIGHT);
    source.format = PEL_BAYER8_RGGB;
    source.height = target.height = HEIGHT - 1;
    expect_frame(PEL_ERR_FORMAT, &config, &source, &target);
    source.format = PEL_GRAY8;
    target.format = PEL_BAYER8_RGGB;
    expect_frame(PEL_ERR_FORMAT, &config, &source, &target);
    target.format = PEL_GRAY8;
    expect_frame(PEL_OK, &config, &source, &target);
}

static void test_the_target_has_the_size_of_the_result(void)
{
    pel_filter_config config = kernel_config("box3");
    const pel_cview source = source_view();
    pel_view target = target_view(WIDTH - 1, HEIGHT);
    expect_frame(PEL_ERR_SPACE, &config, &source, &target);
    target = target_view(WIDTH, HEIGHT - 1);
    expect_frame(PEL_ERR_SPACE, &config, &source, &target);
    target = target_view(WIDTH - 2, HEIGHT - 2);
    expect_frame(PEL_ERR_SPACE, &config, &source, &target);
    config.border = PEL_BORDER_VALID;
    expect_frame(PEL_OK, &config, &source, &target);
    expect_guards(config.work_bytes, (WIDTH - 2) * (HEIGHT - 2));
    setUp();
    target = target_view(WIDTH - 1, HEIGHT - 2);
    expect_frame(PEL_ERR_SPACE, &config, &source, &target);
    target = target_view(WIDTH - 2, HEIGHT - 1);
    expect_frame(PEL_ERR_SPACE, &config, &source, &target);
}

static void test_frames_refuse_what_begin_refuses(void)
{
    const pel_cview source = source_view();
    const pel_view target = target_view(WIDTH, HEIGHT);
    pel_filter_config config = kernel_config("box3");
    config.kernel = NULL;
    expect_frame(PEL_ERR_ARG, &config, &source, &target);
    config = kernel_config("box3");
    config.work = NULL;
    expect_frame(PEL_ERR_ARG, &config, &source, &target);
    config = kernel_config("box3");
    config.op_s16 = pel_op_sobel_x_s16;
    config.op = pel_op_binomial5; /* another radius */
    expect_frame(PEL_ERR_ARG, &config, &source, &target);
    config.op = NULL; /* only 16 bits */
    expect_frame(PEL_ERR_FORMAT, &config, &source, &target);
    config = kernel_config("box3");
    config.work_bytes--;
    expect_frame(PEL_ERR_SPACE, &config, &source, &target);
    config = kernel_config("box3");
    config.border = PEL_BORDER_WRAP; /* needs more memory */
    expect_frame(PEL_ERR_SPACE, &config, &source, &target);
}

static void test_frames_fill_in_size_and_last_rows(void)
{
    pel_filter_config config = config_of(NULL, "shift_down", PEL_BORDER_WRAP);
    const pel_cview source = source_view();
    const pel_view target = target_view(WIDTH, HEIGHT);
    config.width = config.height = 1;
    config.last_rows[0] = config.last_rows[1] = NULL;
    expect_frame(PEL_OK, &config, &source, &target);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(picture + PIXELS - WIDTH, out, WIDTH);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(picture, out + WIDTH, PIXELS - WIDTH);
    expect_guards(config.work_bytes, PIXELS);
}

static void test_frames_in_place_and_overlapping(void)
{
    const pel_filter_config config = kernel_config("shift_down");
    pel_cview source = source_view();
    pel_view target = target_view(WIDTH, HEIGHT - 1);
    for (unsigned i = 0; i < PIXELS; i++) {
        out[i] = picture[i];
    }
    source.height = HEIGHT - 1;
    source.plane[0] = out;
    target.plane[0] = out + 1;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_filter_frame(&config, &source, &target));
    target.plane[0] = out + WIDTH;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_filter_frame(&config, &source, &target));
    source.plane[0] = out + WIDTH;
    target.plane[0] = out;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_filter_frame(&config, &source, &target));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(picture, out, PIXELS);
    source.plane[0] = out;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_frame(&config, &source, &target));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(picture, out, WIDTH);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(picture, out + WIDTH, (HEIGHT - 2) * WIDTH);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(picture + PIXELS - WIDTH, out + PIXELS - WIDTH, WIDTH);
    expect_guards(config.work_bytes, PIXELS);
}

static void expect_frame_s16(pel_status expected, const pel_filter_config *config,
                             const pel_cview *source, int16_t *target)
{
    TEST_ASSERT_EQUAL_INT(expected, pel_filter_frame_s16(config, source, target, WIDTH));
    for (unsigned i = 0; i < GUARD + PIXELS + GUARD; i++) {
        TEST_ASSERT_EQUAL_INT16(CANARY, out_s16_room[i]);
    }
}

static void test_frames_of_16_bits_refuse(void)
{
    pel_filter_config config = kernel_config("box3");
    pel_cview source = source_view();
    expect_frame_s16(PEL_ERR_ARG, NULL, &source, out_s16);
    expect_frame_s16(PEL_ERR_ARG, &config, NULL, out_s16);
    expect_frame_s16(PEL_ERR_ARG, &config, &source, NULL);
    config.op = pel_op_max;
    expect_frame_s16(PEL_ERR_FORMAT, &config, &source, out_s16);
    config = kernel_config("box3");
    config.work_bytes--;
    expect_frame_s16(PEL_ERR_SPACE, &config, &source, out_s16);
    config = kernel_config("box3");
    source.plane[0] = (const uint8_t *)out_s16; /* in place */
    expect_frame_s16(PEL_ERR_ARG, &config, &source, out_s16);
    source.format = PEL_BAYER8_RGGB;
    source.height = HEIGHT - 1;
    source.plane[0] = picture;
    expect_frame_s16(PEL_ERR_FORMAT, &config, &source, out_s16);
}

static void test_rows_of_16_bits_are_a_stride_apart(void)
{
    pel_filter_config config = kernel_config("identity");
    pel_cview source = source_view();
    source.width = 4;
    config.work_bytes = PEL_FILTER_BYTES(4, 1);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_frame_s16(&config, &source, out_s16, WIDTH));
    for (unsigned i = 0; i < PIXELS; i++) {
        TEST_ASSERT_EQUAL_INT16(i % WIDTH < 4 ? picture[i] : CANARY, out_s16[i]);
    }
    TEST_ASSERT_EQUAL_INT16(CANARY, out_s16[-1]);
    TEST_ASSERT_EQUAL_INT16(CANARY, out_s16[PIXELS]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_frames_need_views_of_gray_pixels);
    RUN_TEST(test_the_target_has_the_size_of_the_result);
    RUN_TEST(test_frames_refuse_what_begin_refuses);
    RUN_TEST(test_frames_fill_in_size_and_last_rows);
    RUN_TEST(test_frames_in_place_and_overlapping);
    RUN_TEST(test_frames_of_16_bits_refuse);
    RUN_TEST(test_rows_of_16_bits_are_a_stride_apart);
    return UNITY_END();
}
