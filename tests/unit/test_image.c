/*
 * Views: what the formats are, how a frame in memory is described, cropped and cut into rows. No
 * test here looks at a pixel; that the pixels come out right is in test_rows.c.
 */
#include "unity.h"

#include <pel.h>

enum { SIDE_MAX = PEL_SIDE_MAX };

void setUp(void)
{
}

void tearDown(void)
{
}

/* ---- The format table ---------------------------------------------------------------------- */

/* What each format is by its definition: bytes of a 4-pixel row in plane 0 and of a 4 x 4 frame,
 * the least width and height, pixels of mosaic per colour. */
typedef struct fact {
    const char *name;
    uint8_t row_bytes, frame_bytes, width_least, height_least, cell;
} fact;

static const fact facts[PEL_FORMAT_COUNT] = {
    [PEL_GRAY8] = {"GRAY8", 4, 16, 1, 1, 1},
    [PEL_YUYV] = {"YUYV", 8, 32, 2, 1, 1},
    [PEL_UYVY] = {"UYVY", 8, 32, 2, 1, 1},
    [PEL_YVYU] = {"YVYU", 8, 32, 2, 1, 1},
    [PEL_VYUY] = {"VYUY", 8, 32, 2, 1, 1},
    [PEL_NV12] = {"NV12", 4, 24, 2, 2, 1},
    [PEL_I420] = {"I420", 4, 24, 2, 2, 1},
    [PEL_RGB565_LE] = {"RGB565_LE", 8, 32, 1, 1, 1},
    [PEL_RGB565_BE] = {"RGB565_BE", 8, 32, 1, 1, 1},
    [PEL_RGB888] = {"RGB888", 12, 48, 1, 1, 1},
    [PEL_BGR888] = {"BGR888", 12, 48, 1, 1, 1},
    [PEL_BAYER8_RGGB] = {"BAYER8_RGGB", 4, 16, 2, 2, 2},
    [PEL_BAYER8_GRBG] = {"BAYER8_GRBG", 4, 16, 2, 2, 2},
    [PEL_BAYER8_GBRG] = {"BAYER8_GBRG", 4, 16, 2, 2, 2},
    [PEL_BAYER8_BGGR] = {"BAYER8_BGGR", 4, 16, 2, 2, 2},
};

static pel_format format_at(int index)
{
    return (pel_format)index;
}

static void test_every_format_has_its_name(void)
{
    for (int f = 0; f < PEL_FORMAT_COUNT; f++) {
        TEST_ASSERT_EQUAL_STRING(facts[f].name, pel_format_name(format_at(f)));
    }
    TEST_ASSERT_NULL(pel_format_name(PEL_FORMAT_COUNT));
    TEST_ASSERT_NULL(pel_format_name(format_at(-1)));
}

static void test_bytes_of_rows_and_frames(void)
{
    for (int f = 0; f < PEL_FORMAT_COUNT; f++) {
        TEST_ASSERT_EQUAL_UINT32(facts[f].row_bytes, pel_row_bytes(format_at(f), 4));
        TEST_ASSERT_EQUAL_UINT32(facts[f].frame_bytes, pel_frame_bytes(format_at(f), 4, 4));
    }
    TEST_ASSERT_EQUAL_UINT32(UINT32_C(640) * 480u * 3u / 2u, pel_frame_bytes(PEL_NV12, 640, 480));
    TEST_ASSERT_EQUAL_UINT32(UINT32_C(640) * 480u * 2u, pel_frame_bytes(PEL_YUYV, 640, 480));
}

static void test_odd_sizes_only_where_no_pixels_share_a_byte(void)
{
    for (int f = 0; f < PEL_FORMAT_COUNT; f++) {
        const int odd_width = pel_row_bytes(format_at(f), 3) != 0;
        const int odd_height = pel_frame_bytes(format_at(f), 4, 3) != 0;
        TEST_ASSERT_EQUAL_INT(facts[f].width_least == 1, odd_width);
        TEST_ASSERT_EQUAL_INT(facts[f].height_least == 1, odd_height);
    }
}

static void test_bytes_of_impossible_frames_are_zero(void)
{
    for (int f = 0; f < PEL_FORMAT_COUNT; f++) {
        TEST_ASSERT_EQUAL_UINT32(0, pel_row_bytes(format_at(f), 0));
        TEST_ASSERT_EQUAL_UINT32(0, pel_frame_bytes(format_at(f), 0, 4));
        TEST_ASSERT_EQUAL_UINT32(0, pel_frame_bytes(format_at(f), 4, 0));
        TEST_ASSERT_EQUAL_UINT32(0, pel_frame_bytes(format_at(f), SIDE_MAX + 2, 4));
        TEST_ASSERT_EQUAL_UINT32(0, pel_frame_bytes(format_at(f), 4, SIDE_MAX + 2));
        TEST_ASSERT_EQUAL_UINT32(0, pel_frame_bytes(format_at(f), 65534, 65534));
    }
    TEST_ASSERT_EQUAL_UINT32(0, pel_row_bytes(PEL_FORMAT_COUNT, 4));
    TEST_ASSERT_EQUAL_UINT32(0, pel_frame_bytes(PEL_FORMAT_COUNT, 4, 4));
}

static void test_bytes_of_the_largest_frame(void)
{
    TEST_ASSERT_EQUAL_UINT32(UINT32_C(3) * 8192u * 8192u,
                             pel_frame_bytes(PEL_RGB888, SIDE_MAX, SIDE_MAX));
    TEST_ASSERT_EQUAL_UINT32(UINT32_C(8192) * 8192u * 3u / 2u,
                             pel_frame_bytes(PEL_I420, SIDE_MAX, SIDE_MAX));
}

static void test_colours_of_a_mosaic_are_half_as_many_each_way(void)
{
    for (int f = 0; f < PEL_FORMAT_COUNT; f++) {
        TEST_ASSERT_EQUAL_UINT16(8 / facts[f].cell, pel_color_width(format_at(f), 8));
        TEST_ASSERT_EQUAL_UINT16(6 / facts[f].cell, pel_color_height(format_at(f), 6));
    }
}

/* ---- Describing frames --------------------------------------------------------------------- */

static uint8_t memory[256];

static void test_view_of_every_format_without_padding(void)
{
    for (int f = 0; f < PEL_FORMAT_COUNT; f++) {
        pel_view view;
        const pel_status status =
            pel_view_init(memory, format_at(f), PEL_RANGE_LIMITED, 4, 4, 0, &view);
        const pel_cview reading = pel_view_to_read(&view);
        TEST_ASSERT_EQUAL_INT(PEL_OK, status);
        TEST_ASSERT_EQUAL_PTR(memory, view.plane[0]);
        TEST_ASSERT_EQUAL_INT32(facts[f].row_bytes, view.stride_bytes[0]);
        TEST_ASSERT_EQUAL_UINT16(4, view.width);
        TEST_ASSERT_EQUAL_UINT16(4, view.height);
        TEST_ASSERT_EQUAL_INT(f, view.format);
        TEST_ASSERT_EQUAL_INT(PEL_RANGE_LIMITED, view.range);
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_cview_check(&reading));
    }
}

static void test_chroma_planes_lie_behind_the_y_plane(void)
{
    pel_view view;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_view_init(memory, PEL_NV12, PEL_RANGE_FULL, 4, 4, 0, &view));
    TEST_ASSERT_EQUAL_PTR(memory + 16, view.plane[1]);
    TEST_ASSERT_EQUAL_INT32(4, view.stride_bytes[1]);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_view_init(memory, PEL_I420, PEL_RANGE_FULL, 4, 4, 0, &view));
    TEST_ASSERT_EQUAL_PTR(memory + 16, view.plane[1]);
    TEST_ASSERT_EQUAL_PTR(memory + 20, view.plane[2]);
    TEST_ASSERT_EQUAL_INT32(2, view.stride_bytes[1]);
    TEST_ASSERT_EQUAL_INT32(2, view.stride_bytes[2]);
}

static void test_padding_moves_the_chroma_planes_too(void)
{
    pel_cview view;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_cview_init(memory, PEL_NV12, PEL_RANGE_FULL, 4, 4, 8, &view));
    TEST_ASSERT_EQUAL_PTR(memory + 32, view.plane[1]);
    TEST_ASSERT_EQUAL_INT32(8, view.stride_bytes[1]);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_cview_init(memory, PEL_I420, PEL_RANGE_FULL, 4, 4, 8, &view));
    TEST_ASSERT_EQUAL_PTR(memory + 32, view.plane[1]);
    TEST_ASSERT_EQUAL_PTR(memory + 40, view.plane[2]);
    TEST_ASSERT_EQUAL_INT32(4, view.stride_bytes[2]);
}

static void test_strides_shorter_than_a_row_are_refused(void)
{
    for (int f = 0; f < PEL_FORMAT_COUNT; f++) {
        const int32_t row = facts[f].row_bytes;
        pel_cview view;
        TEST_ASSERT_EQUAL_INT(
            PEL_OK, pel_cview_init(memory, format_at(f), PEL_RANGE_FULL, 4, 4, row, &view));
        TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, pel_cview_init(memory, format_at(f), PEL_RANGE_FULL, 4,
                                                            4, row - 1, &view));
        TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, pel_cview_init(memory, format_at(f), PEL_RANGE_FULL, 4,
                                                            4, 1 - row, &view));
    }
}

static void test_a_negative_stride_is_a_bottom_up_picture(void)
{
    pel_cview view;
    TEST_ASSERT_EQUAL_INT(
        PEL_OK, pel_cview_init(memory + 20, PEL_RGB888, PEL_RANGE_FULL, 3, 3, -10, &view));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_cview_check(&view));
    TEST_ASSERT_EQUAL_PTR(memory + 20, pel_cview_row(&view, 0).plane[0]);
    TEST_ASSERT_EQUAL_PTR(memory + 10, pel_cview_row(&view, 1).plane[0]);
    TEST_ASSERT_EQUAL_PTR(memory, pel_cview_row(&view, 2).plane[0]);
}

static void test_planar_frames_cannot_be_described_bottom_up_but_filled_in_by_hand(void)
{
    pel_cview view = {
        {memory + 12, memory + 20, NULL}, {-4, -4, 0}, 4, 4, PEL_NV12, PEL_RANGE_FULL};
    TEST_ASSERT_LESS_THAN_INT(
        0, pel_cview_init(memory + 12, PEL_NV12, PEL_RANGE_FULL, 4, 4, -4, &view));
    TEST_ASSERT_LESS_THAN_INT(
        0, pel_cview_init(memory + 12, PEL_I420, PEL_RANGE_FULL, 4, 4, -4, &view));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_cview_check(&view));
    TEST_ASSERT_EQUAL_PTR(memory, pel_cview_row(&view, 3).plane[0]);
    TEST_ASSERT_EQUAL_PTR(memory + 16, pel_cview_row(&view, 3).plane[1]);
}

static void test_odd_sizes_are_refused_where_pixels_share_chroma(void)
{
    for (int f = 0; f < PEL_FORMAT_COUNT; f++) {
        pel_cview view;
        const pel_status wide = facts[f].width_least == 1 ? PEL_OK : PEL_ERR_FORMAT;
        const pel_status high = facts[f].height_least == 1 ? PEL_OK : PEL_ERR_FORMAT;
        TEST_ASSERT_EQUAL_INT(wide,
                              pel_cview_init(memory, format_at(f), PEL_RANGE_FULL, 3, 4, 0, &view));
        TEST_ASSERT_EQUAL_INT(high,
                              pel_cview_init(memory, format_at(f), PEL_RANGE_FULL, 4, 3, 0, &view));
    }
}

static void test_empty_and_huge_sizes_are_refused(void)
{
    static const uint16_t bad[][2] = {
        {0, 4}, {4, 0}, {0, 0}, {SIDE_MAX + 2, 4}, {4, SIDE_MAX + 2}, {65534, 65534}};
    pel_cview view;
    for (int f = 0; f < PEL_FORMAT_COUNT; f++) {
        for (unsigned i = 0; i < sizeof bad / sizeof bad[0]; i++) {
            TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE,
                                  pel_cview_init(memory, format_at(f), PEL_RANGE_FULL, bad[i][0],
                                                 bad[i][1], 0, &view));
        }
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_cview_init(memory, format_at(f), PEL_RANGE_FULL, SIDE_MAX,
                                                     SIDE_MAX, 0, &view));
    }
}

static void test_wrong_arguments_are_refused_and_the_view_is_untouched(void)
{
    pel_view view = {{memory, NULL, NULL}, {77, 0, 0}, 1, 1, PEL_GRAY8, PEL_RANGE_FULL};
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG,
                          pel_view_init(NULL, PEL_GRAY8, PEL_RANGE_FULL, 4, 4, 0, &view));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG,
                          pel_view_init(memory, PEL_GRAY8, PEL_RANGE_FULL, 4, 4, 0, NULL));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG,
                          pel_view_init(memory, PEL_FORMAT_COUNT, PEL_RANGE_FULL, 4, 4, 0, &view));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG,
                          pel_view_init(memory, PEL_GRAY8, (pel_range)2, 4, 4, 0, &view));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE,
                          pel_view_init(memory, PEL_GRAY8, PEL_RANGE_FULL, 4, 4, 3, &view));
    TEST_ASSERT_EQUAL_INT32(77, view.stride_bytes[0]);
    TEST_ASSERT_EQUAL_UINT16(1, view.width);
}

static void test_check_refuses_what_a_caller_filled_in_wrongly(void)
{
    const pel_cview good = {
        {memory, memory + 16, memory + 20}, {4, 2, 2}, 4, 4, PEL_I420, PEL_RANGE_FULL};
    pel_cview view = good;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_cview_check(&view));
    view.plane[2] = NULL;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_cview_check(&view));
    view.format = PEL_NV12; /* which has no third plane, but a wider second one */
    TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, pel_cview_check(&view));
    view.stride_bytes[1] = -4;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_cview_check(&view));
    view = good;
    view.stride_bytes[2] = 1;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, pel_cview_check(&view));
    view = good;
    view.width = 3;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_FORMAT, pel_cview_check(&view));
    view = good;
    view.range = (pel_range)7;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_cview_check(&view));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_cview_check(NULL));
}

/* ---- Crops --------------------------------------------------------------------------------- */

static void test_a_crop_is_the_same_pixels(void)
{
    pel_view view, part;
    TEST_ASSERT_EQUAL_INT(PEL_OK,
                          pel_view_init(memory, PEL_RGB888, PEL_RANGE_FULL, 5, 5, 20, &view));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_view_crop(&view, 1, 4, 2, 3, &part));
    TEST_ASSERT_EQUAL_PTR(memory + 2 * 20 + 3, part.plane[0]);
    TEST_ASSERT_EQUAL_INT32(20, part.stride_bytes[0]);
    TEST_ASSERT_EQUAL_UINT16(3, part.width);
    TEST_ASSERT_EQUAL_UINT16(1, part.height);
    TEST_ASSERT_EQUAL_INT(PEL_RGB888, part.format);
}

static void test_a_crop_of_planes_moves_each_of_them(void)
{
    pel_cview view, part;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_cview_init(memory, PEL_I420, PEL_RANGE_FULL, 8, 8, 0, &view));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_cview_crop(&view, 2, 8, 4, 6, &part));
    TEST_ASSERT_EQUAL_PTR(memory + 4 * 8 + 2, part.plane[0]);
    TEST_ASSERT_EQUAL_PTR(memory + 64 + 2 * 4 + 1, part.plane[1]);
    TEST_ASSERT_EQUAL_PTR(memory + 80 + 2 * 4 + 1, part.plane[2]);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_cview_init(memory, PEL_NV12, PEL_RANGE_FULL, 8, 8, 0, &view));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_cview_crop(&view, 2, 8, 4, 6, &part));
    TEST_ASSERT_EQUAL_PTR(memory + 64 + 2 * 8 + 2, part.plane[1]);
}

static void test_a_view_may_be_cropped_in_place_and_upside_down(void)
{
    pel_cview view;
    TEST_ASSERT_EQUAL_INT(PEL_OK,
                          pel_cview_init(memory + 24, PEL_YUYV, PEL_RANGE_FULL, 4, 4, -8, &view));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_cview_crop(&view, 2, 4, 1, 4, &view));
    TEST_ASSERT_EQUAL_PTR(memory + 24 - 8 + 4, view.plane[0]);
    TEST_ASSERT_EQUAL_INT32(-8, view.stride_bytes[0]);
    TEST_ASSERT_EQUAL_UINT16(2, view.width);
    TEST_ASSERT_EQUAL_UINT16(3, view.height);
}

static void test_crops_keep_groups_of_pixels_together(void)
{
    for (int f = 0; f < PEL_FORMAT_COUNT; f++) {
        const pel_status odd_x = facts[f].width_least == 1 ? PEL_OK : PEL_ERR_FORMAT;
        const pel_status odd_y = facts[f].height_least == 1 ? PEL_OK : PEL_ERR_FORMAT;
        pel_cview view, part;
        pel_cview_init(memory, format_at(f), PEL_RANGE_FULL, 8, 8, 0, &view);
        TEST_ASSERT_EQUAL_INT(odd_x, pel_cview_crop(&view, 1, 4, 0, 8, &part));
        TEST_ASSERT_EQUAL_INT(odd_x, pel_cview_crop(&view, 0, 3, 0, 8, &part));
        TEST_ASSERT_EQUAL_INT(odd_y, pel_cview_crop(&view, 0, 8, 1, 4, &part));
        TEST_ASSERT_EQUAL_INT(odd_y, pel_cview_crop(&view, 0, 8, 0, 3, &part));
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_cview_crop(&view, 2, 4, 4, 6, &part));
    }
}

static void test_crops_outside_the_view_are_refused(void)
{
    static const uint16_t bad[][4] = {{2, 2, 0, 8},  {4, 2, 0, 8},    {0, 8, 6, 6},
                                      {0, 8, 6, 4},  {0, 10, 0, 8},   {0, 8, 0, 10},
                                      {8, 10, 0, 8}, {0, 65534, 0, 8}};
    pel_view view, part = {{NULL, NULL, NULL}, {0, 0, 0}, 99, 0, PEL_GRAY8, PEL_RANGE_FULL};
    pel_view_init(memory, PEL_YUYV, PEL_RANGE_FULL, 8, 8, 0, &view);
    for (unsigned i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        TEST_ASSERT_EQUAL_INT(
            PEL_ERR_RANGE, pel_view_crop(&view, bad[i][0], bad[i][1], bad[i][2], bad[i][3], &part));
    }
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_view_crop(NULL, 0, 2, 0, 2, &part));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_view_crop(&view, 0, 2, 0, 2, NULL));
    TEST_ASSERT_EQUAL_UINT16(99, part.width);
}

/* ---- Rows ---------------------------------------------------------------------------------- */

static void test_rows_of_shared_chroma(void)
{
    pel_cview view;
    pel_cview_init(memory, PEL_NV12, PEL_RANGE_FULL, 4, 4, 0, &view);
    for (uint16_t y = 0; y < 4; y++) {
        const pel_crow row = pel_cview_row(&view, y);
        TEST_ASSERT_EQUAL_PTR(memory + 4 * y, row.plane[0]);
        TEST_ASSERT_EQUAL_PTR(memory + 16 + 4 * (y / 2), row.plane[1]);
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_crow_check(&row));
    }
}

static void test_rows_of_a_mosaic_are_pairs(void)
{
    pel_cview view;
    pel_crow row;
    pel_cview_init(memory, PEL_BAYER8_GRBG, PEL_RANGE_FULL, 4, 4, 6, &view);
    row = pel_cview_row(&view, 1);
    TEST_ASSERT_EQUAL_PTR(memory + 12, row.plane[0]);
    TEST_ASSERT_EQUAL_PTR(memory + 18, row.plane[1]);
    TEST_ASSERT_EQUAL_UINT16(4, row.width);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_crow_check(&row));
}

static void test_rows_that_cannot_be_are_refused(void)
{
    pel_crow row = pel_crow_packed(memory, PEL_YUYV, PEL_RANGE_FULL, 4);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_crow_check(&row));
    row.width = 5;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_FORMAT, pel_crow_check(&row));
    row.width = 0;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, pel_crow_check(&row));
    row.width = SIDE_MAX + 2;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, pel_crow_check(&row));
    row.width = 4;
    row.plane[0] = NULL;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_crow_check(&row));
    row =
        pel_crow_packed(memory, PEL_BAYER8_RGGB, PEL_RANGE_FULL, 4); /* has only one of two rows */
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_crow_check(&row));
    row = pel_crow_packed(memory, PEL_FORMAT_COUNT, PEL_RANGE_FULL, 4);
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_crow_check(&row));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_crow_check(NULL));
}

/* The way from the first row to the last fits 32 bits, whatever the stride. */
static void test_strides_that_reach_too_far_are_refused(void)
{
    const uint8_t *const pixels = (const uint8_t *)"";
    pel_cview view;

    TEST_ASSERT_EQUAL_INT(
        PEL_OK, pel_cview_init(pixels, PEL_GRAY8, PEL_RANGE_FULL, 8, 4, INT32_MAX / 4, &view));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, pel_cview_init(pixels, PEL_GRAY8, PEL_RANGE_FULL, 8, 4,
                                                        INT32_MAX / 4 + 1, &view));
    TEST_ASSERT_EQUAL_INT(
        PEL_ERR_RANGE, pel_cview_init(pixels, PEL_GRAY8, PEL_RANGE_FULL, 8, 4, INT32_MIN, &view));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_cview_check(&view));
    view.stride_bytes[0] = -(INT32_MAX / 4) - 1;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, pel_cview_check(&view));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_format_has_its_name);
    RUN_TEST(test_bytes_of_rows_and_frames);
    RUN_TEST(test_odd_sizes_only_where_no_pixels_share_a_byte);
    RUN_TEST(test_bytes_of_impossible_frames_are_zero);
    RUN_TEST(test_bytes_of_the_largest_frame);
    RUN_TEST(test_colours_of_a_mosaic_are_half_as_many_each_way);
    RUN_TEST(test_view_of_every_format_without_padding);
    RUN_TEST(test_chroma_planes_lie_behind_the_y_plane);
    RUN_TEST(test_padding_moves_the_chroma_planes_too);
    RUN_TEST(test_strides_shorter_than_a_row_are_refused);
    RUN_TEST(test_a_negative_stride_is_a_bottom_up_picture);
    RUN_TEST(test_planar_frames_cannot_be_described_bottom_up_but_filled_in_by_hand);
    RUN_TEST(test_odd_sizes_are_refused_where_pixels_share_chroma);
    RUN_TEST(test_empty_and_huge_sizes_are_refused);
    RUN_TEST(test_wrong_arguments_are_refused_and_the_view_is_untouched);
    RUN_TEST(test_check_refuses_what_a_caller_filled_in_wrongly);
    RUN_TEST(test_a_crop_is_the_same_pixels);
    RUN_TEST(test_a_crop_of_planes_moves_each_of_them);
    RUN_TEST(test_a_view_may_be_cropped_in_place_and_upside_down);
    RUN_TEST(test_crops_keep_groups_of_pixels_together);
    RUN_TEST(test_crops_outside_the_view_are_refused);
    RUN_TEST(test_rows_of_shared_chroma);
    RUN_TEST(test_rows_of_a_mosaic_are_pairs);
    RUN_TEST(test_rows_that_cannot_be_are_refused);
    RUN_TEST(test_strides_that_reach_too_far_are_refused);
    return UNITY_END();
}
