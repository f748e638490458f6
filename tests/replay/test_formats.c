/* Negotiation: the best of what there is, and exactly what the driver set. */
#include "scene.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include <unity.h>

void setUp(void)
{
    scene_begin();
}

void tearDown(void)
{
    scene_end();
}

static void set_modes(const replay_mode *modes, unsigned count)
{
    memcpy(world.nodes[0].modes, modes, count * sizeof modes[0]);
    world.nodes[0].mode_count = count;
}

static void open_changed(const char *changes)
{
    TEST_ASSERT_EQUAL_INT_MESSAGE(CAPTURE_CHANGED, capture_open(&wish, &world.calls, &camera),
                                  capture_error(camera));
    TEST_ASSERT_EQUAL_STRING(changes, capture_changes(camera));
}

static void demand(uint32_t fourcc, unsigned width, unsigned height)
{
    const capture_settings settings = scene_settings();

    TEST_ASSERT_EQUAL_HEX32(fourcc, settings.fourcc);
    TEST_ASSERT_EQUAL_UINT(width, settings.width);
    TEST_ASSERT_EQUAL_UINT(height, settings.height);
}

/* What webcams have: raw up to a size, or slowly; the rest as JPEG. */
static const replay_mode webcam[] = {
    {V4L2_PIX_FMT_MJPEG, 1280, 720, 30},  {V4L2_PIX_FMT_MJPEG, 640, 480, 30},
    {V4L2_PIX_FMT_MJPEG, 1920, 1080, 30}, {V4L2_PIX_FMT_YUYV, 640, 480, 30},
    {V4L2_PIX_FMT_YUYV, 1280, 720, 10},   {V4L2_PIX_FMT_YUYV, 320, 240, 30},
    {V4L2_PIX_FMT_Y16, 640, 480, 60},
};

static void test_what_serves_best(void)
{
    static const struct {
        unsigned width, height, rate;
        uint32_t wished, fourcc;
        unsigned got_width, got_height, got_rate;
    } cases[] = {
        {0, 0, 0, 0, V4L2_PIX_FMT_YUYV, 640, 480, 30},
        {640, 480, 0, 0, V4L2_PIX_FMT_YUYV, 640, 480, 30},
        {320, 240, 0, 0, V4L2_PIX_FMT_YUYV, 320, 240, 30},
        {1280, 720, 0, 0, V4L2_PIX_FMT_YUYV, 1280, 720, 10},
        {1280, 720, 30, 0, V4L2_PIX_FMT_MJPEG, 1280, 720, 30},
        {1280, 720, 10, 0, V4L2_PIX_FMT_YUYV, 1280, 720, 10},
        {1920, 1080, 0, 0, V4L2_PIX_FMT_MJPEG, 1920, 1080, 30},
        {640, 480, 15, 0, V4L2_PIX_FMT_YUYV, 640, 480, 15},
        {640, 480, 0, V4L2_PIX_FMT_MJPEG, V4L2_PIX_FMT_MJPEG, 640, 480, 30},
        {1280, 0, 0, 0, V4L2_PIX_FMT_YUYV, 1280, 720, 10},
        {0, 240, 0, 0, V4L2_PIX_FMT_YUYV, 320, 240, 30},
    };

    for (unsigned i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        scene_end();
        scene_begin();
        set_modes(webcam, 7);
        wish.width = cases[i].width;
        wish.height = cases[i].height;
        wish.rate_num = cases[i].rate;
        wish.rate_den = cases[i].rate ? 1 : 0;
        wish.fourcc = cases[i].wished;
        scene_open();
        demand(cases[i].fourcc, cases[i].got_width, cases[i].got_height);
        TEST_ASSERT_EQUAL_UINT(cases[i].got_rate, scene_settings().rate_num);
        TEST_ASSERT_EQUAL_UINT(1, scene_settings().rate_den);
        TEST_ASSERT_EQUAL_STRING("", capture_changes(camera));
    }
}

static void test_what_became_of_a_wish_is_said(void)
{
    set_modes(webcam, 7);
    wish.width = 800;
    wish.height = 600;
    wish.rate_num = 60;
    wish.rate_den = 1;
    wish.fourcc = V4L2_PIX_FMT_UYVY;
    open_changed("format UYVY became YUYV; size 800x600 became 640x480; rate 60 became 30");
    demand(V4L2_PIX_FMT_YUYV, 640, 480);
}

static void test_driver_that_takes_another_size(void)
{
    world.nodes[0].force_width = 30;
    open_changed("size 32x24 became 30x24");
    TEST_ASSERT_EQUAL_UINT(60, scene_settings().bytes_per_line);
    scene_start();
    scene_frames(3);
}

static void test_driver_that_lies_about_the_size(void)
{
    world.nodes[0].force_width = 16;
    world.nodes[0].force_height = 8;
    world.nodes[0].format_lies = 1;
    open_changed("size 32x24 became 16x8");
    scene_start();
    scene_frames(3);
}

static void test_driver_that_takes_another_format(void)
{
    wish.fourcc = V4L2_PIX_FMT_YUYV;
    world.nodes[0].force_fourcc = V4L2_PIX_FMT_UYVY;
    open_changed("format YUYV became UYVY");
    scene_start();
    scene_frames(3);
}

static void test_driver_that_takes_a_format_that_cannot_be_read(void)
{
    world.nodes[0].force_fourcc = V4L2_PIX_FMT_Y16;
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_FORMAT, capture_open(&wish, &world.calls, &camera));
    TEST_ASSERT_EQUAL_UINT(0, replay_open_count(&world));
}

static void test_driver_that_ignores_the_rate(void)
{
    world.nodes[0].rate_ignored = 1;
    wish.rate_num = 15;
    wish.rate_den = 1;
    open_changed("rate 15 became 30");
}

static void test_driver_without_rates(void)
{
    world.nodes[0].no_parm = 1;
    world.nodes[0].no_rates = 1;
    scene_open();
    TEST_ASSERT_EQUAL_UINT(0, scene_settings().rate_den);
    capture_close(camera);
    wish.rate_num = 15;
    wish.rate_den = 1;
    open_changed("rate 15 became unknown");
}

static void test_fractions_of_rates(void)
{
    wish.rate_num = 30000;
    wish.rate_den = 1001;
    world.nodes[0].rate_ignored = 1;
    open_changed("rate 29.97 became 30");
}

static void test_size_is_kept_when_the_driver_fails_on_one_format(void)
{
    set_modes(webcam, 7);
    wish.width = 640;
    wish.height = 480;
    replay_fail(&world, VIDIOC_S_FMT, 0, 1, EINVAL); /* YUYV is refused */
    scene_open();
    demand(V4L2_PIX_FMT_MJPEG, 640, 480);
    TEST_ASSERT_EQUAL_INT(1, scene_settings().compressed);
}

/* ---- Enumeration that fails ---------------------------------------------------------------- */

static void test_nothing_is_enumerated(void)
{
    world.nodes[0].no_formats = world.nodes[0].no_sizes = world.nodes[0].no_rates = 1;
    scene_open();
    demand(V4L2_PIX_FMT_YUYV, 32, 24);
    TEST_ASSERT_EQUAL_INT(0, capture_modes(camera, NULL, 0));
    scene_start();
    scene_frames(2);
}

static void test_sizes_are_not_enumerated(void)
{
    capture_mode modes[4];

    world.nodes[0].no_sizes = 1;
    scene_open();
    demand(V4L2_PIX_FMT_YUYV, 32, 24);
    TEST_ASSERT_EQUAL_INT(2, capture_modes(camera, modes, 4));
    TEST_ASSERT_EQUAL_UINT(0, modes[0].width_max);
}

static void test_enumeration_fails_in_the_middle(void)
{
    static const unsigned long calls[] = {VIDIOC_ENUM_FMT, VIDIOC_ENUM_FRAMESIZES,
                                          VIDIOC_ENUM_FRAMEINTERVALS};

    for (unsigned i = 0; i < 3; i++) {
        for (unsigned skip = 0; skip < 3; skip++) {
            capture_status status;

            scene_end();
            scene_begin();
            replay_fail(&world, calls[i], skip, 1, EIO);
            status = capture_open(&wish, &world.calls, &camera);
            TEST_ASSERT_TRUE_MESSAGE(status >= 0, capture_error(camera));
            scene_start();
            scene_frames(1);
        }
    }
}

static void test_enumeration_without_end(void)
{
    world.nodes[0].endless = 1;
    scene_open();
    demand(V4L2_PIX_FMT_YUYV, 32, 24);
    TEST_ASSERT_TRUE(capture_modes(camera, NULL, 0) > 0);
}

static void test_sizes_in_steps(void)
{
    static const replay_mode mode = {V4L2_PIX_FMT_YUYV, 20, 8, 30};
    static const unsigned asked[][2] = {{32, 24}, {35, 26}, {1, 1}, {1000, 1000}, {160, 64}};
    static const unsigned got[][2] = {{32, 24}, {32, 24}, {20, 8}, {158, 64}, {158, 64}};

    for (unsigned i = 0; i < 5; i++) {
        scene_end();
        scene_begin();
        set_modes(&mode, 1);
        world.nodes[0].stepwise = 1;
        wish.width = asked[i][0];
        wish.height = asked[i][1];
        TEST_ASSERT_TRUE(capture_open(&wish, &world.calls, &camera) >= 0);
        /* 20 + 6n and 8 + 4n; of two that are as near the smaller. */
        demand(V4L2_PIX_FMT_YUYV, got[i][0], got[i][1]);
    }
}

static void test_odd_sizes_in_steps_are_passed_by(void)
{
    static const replay_mode mode = {V4L2_PIX_FMT_YUYV, 21, 8, 30}; /* 21 + 6n: always odd */

    set_modes(&mode, 1);
    world.nodes[0].stepwise = 1;
    world.nodes[0].force_width = 21;
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_FORMAT, capture_open(&wish, &world.calls, &camera));
}

static void test_driver_that_cannot_say_its_format(void)
{
    world.nodes[0].no_get_format = 1;
    scene_start();
    demand(V4L2_PIX_FMT_YUYV, 32, 24);
    scene_frames(2);
}

static void test_modes(void)
{
    capture_mode modes[10];

    set_modes(webcam, 7);
    wish.width = 640;
    wish.height = 480;
    scene_open();
    TEST_ASSERT_EQUAL_INT(7, capture_modes(camera, modes, 10));
    TEST_ASSERT_EQUAL_HEX32(V4L2_PIX_FMT_MJPEG, modes[0].fourcc);
    TEST_ASSERT_EQUAL_INT(1, modes[3].readable);
    TEST_ASSERT_EQUAL_UINT(640, modes[3].width_min);
    TEST_ASSERT_EQUAL_UINT(640, modes[3].width_max);
    TEST_ASSERT_EQUAL_UINT(30, modes[3].rate_num); /* the faster of 15 and 30 */
    TEST_ASSERT_EQUAL_UINT(1, modes[3].rate_den);
    TEST_ASSERT_EQUAL_UINT(10, modes[4].rate_num);
    TEST_ASSERT_EQUAL_INT(0, modes[6].readable); /* Y16 */
    TEST_ASSERT_EQUAL_STRING("Format 1", modes[3].description);
    memset(modes, 0x55, sizeof modes);
    TEST_ASSERT_EQUAL_INT(7, capture_modes(camera, modes, 2));
    TEST_ASSERT_EQUAL_HEX32(0x55555555, modes[2].fourcc);
}

/* ---- Bytes in memory ----------------------------------------------------------------------- */

static const uint32_t raw_formats[] = {
    V4L2_PIX_FMT_YUYV,   V4L2_PIX_FMT_UYVY,    V4L2_PIX_FMT_YVYU,   V4L2_PIX_FMT_VYUY,
    V4L2_PIX_FMT_NV12,   V4L2_PIX_FMT_YUV420,  V4L2_PIX_FMT_RGB24,  V4L2_PIX_FMT_BGR24,
    V4L2_PIX_FMT_RGB565, V4L2_PIX_FMT_RGB565X, V4L2_PIX_FMT_SRGGB8, V4L2_PIX_FMT_SGRBG8,
    V4L2_PIX_FMT_SGBRG8, V4L2_PIX_FMT_SBGGR8,  V4L2_PIX_FMT_GREY};
static const pel_format raw_views[] = {
    PEL_YUYV,        PEL_UYVY,        PEL_YVYU,        PEL_VYUY,        PEL_NV12,
    PEL_I420,        PEL_RGB888,      PEL_BGR888,      PEL_RGB565_LE,   PEL_RGB565_BE,
    PEL_BAYER8_RGGB, PEL_BAYER8_GRBG, PEL_BAYER8_GBRG, PEL_BAYER8_BGGR, PEL_GRAY8};

static void check_formats(uint32_t caps, unsigned padding, unsigned data_offset)
{
    for (unsigned i = 0; i < sizeof raw_formats / sizeof raw_formats[0]; i++) {
        const replay_mode mode = {raw_formats[i], 36, 24, 30};
        uint32_t stride;

        scene_end();
        scene_begin();
        set_modes(&mode, 1);
        world.nodes[0].caps = caps;
        world.nodes[0].stride_extra = padding;
        world.nodes[0].size_extra = 3 * padding;
        world.nodes[0].data_offset = data_offset;
        wish.width = 36;
        scene_start();
        demand(raw_formats[i], 36, 24);
        TEST_ASSERT_EQUAL_INT(raw_views[i], scene_settings().format);
        stride = pel_row_bytes(raw_views[i], 36) + padding;
        TEST_ASSERT_EQUAL_UINT32(stride, scene_settings().bytes_per_line);
        TEST_ASSERT_TRUE(scene_settings().frame_bytes >= stride * 24);
        scene_frames(6);
    }
}

static void test_every_format(void)
{
    check_formats(V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING, 0, 0);
}

static void test_every_format_with_padding(void)
{
    check_formats(V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING, 28, 0);
}

static void test_every_format_in_multi_planar_queues(void)
{
    check_formats(V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_STREAMING, 0, 0);
    check_formats(V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_STREAMING, 28, 64);
}

static void test_short_frames_of_every_format(void)
{
    for (unsigned i = 0; i < sizeof raw_formats / sizeof raw_formats[0]; i++) {
        const replay_mode mode = {raw_formats[i], 36, 24, 30};

        scene_end();
        scene_begin();
        set_modes(&mode, 1);
        world.nodes[0].plan[0] = REPLAY_SHORT; /* by one byte */
        world.nodes[0].plan_count = 1;
        world.nodes[0].stride_extra = 12;
        wish.width = 36;
        scene_start();
        scene_frames(2);
        TEST_ASSERT_EQUAL_UINT64(1, scene_counts().short_frames);
    }
}

static void test_last_row_without_padding(void)
{
    for (unsigned i = 0; i < sizeof raw_formats / sizeof raw_formats[0]; i++) {
        const replay_mode mode = {raw_formats[i], 36, 24, 30};

        scene_end();
        scene_begin();
        set_modes(&mode, 1);
        world.nodes[0].no_tail = 1;
        world.nodes[0].stride_extra = 12;
        wish.width = 36;
        scene_start();
        scene_frames(3);
        TEST_ASSERT_EQUAL_UINT64(0, scene_counts().short_frames);
    }
}

static void test_bytes_per_line_that_are_not_said(void)
{
    world.nodes[0].no_stride = 1;
    scene_start();
    TEST_ASSERT_EQUAL_UINT32(64, scene_settings().bytes_per_line);
    scene_frames(2);
}

static void test_bytes_per_line_that_cannot_be(void)
{
    world.nodes[0].mode_count = 1;
    world.nodes[0].stride_extra = (unsigned)-2; /* a pixel short */
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_FORMAT, capture_open(&wish, &world.calls, &camera));
}

static void test_fields_one_below_the_other(void)
{
    world.nodes[0].mode_count = 1;
    world.nodes[0].field = V4L2_FIELD_SEQ_TB;
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_FORMAT, capture_open(&wish, &world.calls, &camera));
    capture_close(camera);
    world.nodes[0].field = V4L2_FIELD_INTERLACED;
    scene_open();
}

static void test_range(void)
{
    static const struct {
        uint32_t fourcc, colorspace, quantization;
        pel_range range;
    } cases[] = {
        {V4L2_PIX_FMT_YUYV, V4L2_COLORSPACE_SRGB, V4L2_QUANTIZATION_DEFAULT, PEL_RANGE_LIMITED},
        {V4L2_PIX_FMT_YUYV, V4L2_COLORSPACE_JPEG, V4L2_QUANTIZATION_DEFAULT, PEL_RANGE_FULL},
        {V4L2_PIX_FMT_YUYV, V4L2_COLORSPACE_SMPTE170M, V4L2_QUANTIZATION_DEFAULT,
         PEL_RANGE_LIMITED},
        {V4L2_PIX_FMT_YUYV, V4L2_COLORSPACE_SRGB, V4L2_QUANTIZATION_FULL_RANGE, PEL_RANGE_FULL},
        {V4L2_PIX_FMT_YUYV, V4L2_COLORSPACE_JPEG, V4L2_QUANTIZATION_LIM_RANGE, PEL_RANGE_LIMITED},
        {V4L2_PIX_FMT_NV12, V4L2_COLORSPACE_REC709, V4L2_QUANTIZATION_DEFAULT, PEL_RANGE_LIMITED},
        {V4L2_PIX_FMT_RGB24, V4L2_COLORSPACE_SRGB, V4L2_QUANTIZATION_LIM_RANGE, PEL_RANGE_FULL},
        {V4L2_PIX_FMT_MJPEG, V4L2_COLORSPACE_SRGB, V4L2_QUANTIZATION_DEFAULT, PEL_RANGE_FULL},
    };

    for (unsigned i = 0; i < 2 * sizeof cases / sizeof cases[0]; i++) {
        const unsigned n = i / 2;
        const replay_mode mode = {cases[n].fourcc, 32, 24, 30};

        scene_end();
        scene_begin();
        set_modes(&mode, 1);
        if (i % 2 == 1) {
            world.nodes[0].caps = V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_STREAMING;
        }
        world.nodes[0].colorspace = cases[n].colorspace;
        world.nodes[0].quantization = cases[n].quantization;
        scene_start();
        TEST_ASSERT_EQUAL_INT(cases[n].range, scene_settings().range);
        scene_frames(1); /* the view has it, too */
    }
}

static void test_compressed_frames(void)
{
    static const replay_kind kinds[] = {REPLAY_GOOD, REPLAY_NO_MARK, REPLAY_SHORT, REPLAY_DAMAGED};

    wish.fourcc = V4L2_PIX_FMT_MJPEG;
    wish.width = 64;
    wish.height = 48;
    memcpy(world.nodes[0].plan, kinds, sizeof kinds);
    world.nodes[0].plan_count = 4;
    scene_start();
    TEST_ASSERT_EQUAL_INT(1, scene_settings().compressed);
    TEST_ASSERT_EQUAL_INT(PEL_RGB888, scene_settings().format);
    TEST_ASSERT_EQUAL_UINT32(0, scene_settings().bytes_per_line);
    scene_frames(5);
    TEST_ASSERT_EQUAL_UINT64(2, scene_counts().damaged);
    TEST_ASSERT_EQUAL_UINT64(1, scene_counts().short_frames);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_serves_best);
    RUN_TEST(test_what_became_of_a_wish_is_said);
    RUN_TEST(test_driver_that_takes_another_size);
    RUN_TEST(test_driver_that_lies_about_the_size);
    RUN_TEST(test_driver_that_takes_another_format);
    RUN_TEST(test_driver_that_takes_a_format_that_cannot_be_read);
    RUN_TEST(test_driver_that_ignores_the_rate);
    RUN_TEST(test_driver_without_rates);
    RUN_TEST(test_fractions_of_rates);
    RUN_TEST(test_size_is_kept_when_the_driver_fails_on_one_format);
    RUN_TEST(test_nothing_is_enumerated);
    RUN_TEST(test_sizes_are_not_enumerated);
    RUN_TEST(test_enumeration_fails_in_the_middle);
    RUN_TEST(test_enumeration_without_end);
    RUN_TEST(test_sizes_in_steps);
    RUN_TEST(test_odd_sizes_in_steps_are_passed_by);
    RUN_TEST(test_driver_that_cannot_say_its_format);
    RUN_TEST(test_modes);
    RUN_TEST(test_every_format);
    RUN_TEST(test_every_format_with_padding);
    RUN_TEST(test_every_format_in_multi_planar_queues);
    RUN_TEST(test_short_frames_of_every_format);
    RUN_TEST(test_last_row_without_padding);
    RUN_TEST(test_bytes_per_line_that_are_not_said);
    RUN_TEST(test_bytes_per_line_that_cannot_be);
    RUN_TEST(test_fields_one_below_the_other);
    RUN_TEST(test_range);
    RUN_TEST(test_compressed_frames);
    return UNITY_END();
}
