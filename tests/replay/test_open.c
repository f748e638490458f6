/* Finding cameras, and letting nothing but cameras be opened. */
#include "scene.h"

#include <errno.h>
#include <fcntl.h>
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

/* Opens anew with the wish; demands the status. */
static void try_open(capture_status expected)
{
    capture_close(camera);
    TEST_ASSERT_EQUAL_STRING_MESSAGE(
        capture_status_name(expected),
        capture_status_name(capture_open(&wish, &world.calls, &camera)), capture_error(camera));
    if (expected < 0) {
        TEST_ASSERT_TRUE(capture_error(camera)[0] != '\0');
    }
}

static void add_others(void)
{
    replay_node *node = replay_add_camera(&world, 1, 1, "Replayed Camera", "usb-replay-1");

    node->caps = V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING; /* a camera's second node */
    node = replay_add_camera(&world, 2, 12, "Other", "platform:other");
    node->caps = V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_STREAMING;
    node = replay_add_camera(&world, 3, 7, "Codec", "platform:codec");
    node->caps = V4L2_CAP_VIDEO_M2M | V4L2_CAP_STREAMING;
    node = replay_add_camera(&world, 4, 3, "Locked", "usb-3");
    node->open_error = EACCES;
    node = replay_add_camera(&world, 5, 200, "Reader", "usb-5");
    node->caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_READWRITE; /* does not stream */
}

static void test_list(void)
{
    capture_device devices[8];

    add_others();
    TEST_ASSERT_EQUAL_INT(3, capture_list(CAPTURE_V4L2, &world.calls, devices, 8));
    TEST_ASSERT_EQUAL_STRING("/dev/video0", devices[0].path);
    TEST_ASSERT_EQUAL_STRING("Replayed Camera", devices[0].card);
    TEST_ASSERT_EQUAL_STRING("usb-replay-1", devices[0].bus);
    TEST_ASSERT_EQUAL_STRING("replay", devices[0].driver);
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, devices[0].status);
    TEST_ASSERT_EQUAL_STRING("/dev/video3", devices[1].path);
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ACCESS, devices[1].status);
    TEST_ASSERT_EQUAL_STRING("/dev/video12", devices[2].path);
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, devices[2].status);
    /* No room is no harm. */
    memset(devices, 0x55, sizeof devices);
    TEST_ASSERT_EQUAL_INT(3, capture_list(CAPTURE_V4L2, &world.calls, devices, 1));
    TEST_ASSERT_EQUAL_HEX8(0x55, devices[1].path[0]);
    TEST_ASSERT_EQUAL_INT(3, capture_list(CAPTURE_V4L2, &world.calls, NULL, 0));
    TEST_ASSERT_EQUAL_UINT(0, replay_open_count(&world));
}

static void test_list_of_nothing(void)
{
    world.nodes[0].present = 0;
    TEST_ASSERT_EQUAL_INT(0, capture_list(CAPTURE_V4L2, &world.calls, NULL, 0));
    wish.device = NULL;
    try_open(CAPTURE_ERR_NONE);
}

static void test_path(void)
{
    try_open(CAPTURE_OK);
    TEST_ASSERT_EQUAL_STRING("/dev/video0", scene_settings().path);
    TEST_ASSERT_EQUAL_STRING("Replayed Camera", scene_settings().card);
    TEST_ASSERT_EQUAL_HEX(O_RDWR | O_NONBLOCK | O_CLOEXEC,
                          world.last_open_flags & (O_ACCMODE | O_NONBLOCK | O_CLOEXEC));
    wish.device = "/dev/video9";
    try_open(CAPTURE_ERR_NONE);
}

static void test_bus_and_names(void)
{
    add_others();
    wish.device = "usb-replay-1";
    try_open(CAPTURE_OK);
    TEST_ASSERT_EQUAL_STRING("/dev/video0", scene_settings().path);
    wish.device = "Other";
    try_open(CAPTURE_OK);
    TEST_ASSERT_EQUAL_STRING("/dev/video12", scene_settings().path);
    wish.device = "played C";
    try_open(CAPTURE_OK);
    wish.device = "Nobody";
    try_open(CAPTURE_ERR_NONE);
    wish.device = "e"; /* both have one */
    try_open(CAPTURE_ERR_NONE);
    TEST_ASSERT_NOT_NULL(strstr(capture_error(camera), "/dev/video12"));
}

static void test_name_that_is_part_of_another(void)
{
    replay_add_camera(&world, 1, 1, "Replayed Camera 2", "usb-2");
    wish.device = "Replayed Camera";
    try_open(CAPTURE_OK);
    TEST_ASSERT_EQUAL_STRING("/dev/video0", scene_settings().path);
    wish.device = "Replayed";
    try_open(CAPTURE_ERR_NONE);
}

static void test_two_nodes_of_one_camera_are_no_doubt(void)
{
    replay_add_camera(&world, 1, 1, "Replayed Camera", "usb-replay-1");
    wish.device = "Replayed";
    try_open(CAPTURE_OK);
    TEST_ASSERT_EQUAL_STRING("/dev/video0", scene_settings().path);
    world.nodes[1].bus = "usb-2"; /* now they are two */
    try_open(CAPTURE_ERR_NONE);
}

static void test_first_camera(void)
{
    add_others();
    world.nodes[0].present = 0;
    wish.device = NULL;
    try_open(CAPTURE_OK); /* past the one that is locked */
    TEST_ASSERT_EQUAL_STRING("/dev/video12", scene_settings().path);
    world.nodes[2].present = 0;
    try_open(CAPTURE_ERR_ACCESS);
    TEST_ASSERT_NOT_NULL(strstr(capture_error(camera), "/dev/video3"));
}

static void test_first_camera_that_can_be_read(void)
{
    replay_add_camera(&world, 1, 1, "Second", "usb-2");
    world.nodes[0].modes[0].fourcc = V4L2_PIX_FMT_Y16;
    world.nodes[0].mode_count = 1;
    wish.device = NULL;
    try_open(CAPTURE_OK);
    TEST_ASSERT_EQUAL_STRING("/dev/video1", scene_settings().path);
    world.nodes[1].present = 0;
    try_open(CAPTURE_ERR_FORMAT);
}

static void test_what_is_no_camera(void)
{
    static const uint32_t caps[] = {
        V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING,
        V4L2_CAP_VIDEO_OUTPUT | V4L2_CAP_STREAMING,
        V4L2_CAP_VIDEO_CAPTURE,
        V4L2_CAP_VIDEO_M2M_MPLANE | V4L2_CAP_STREAMING,
    };

    for (unsigned i = 0; i < 4; i++) {
        world.nodes[0].caps = caps[i];
        try_open(CAPTURE_ERR_KIND);
        TEST_ASSERT_EQUAL_UINT(0, replay_open_count(&world));
    }
}

static void test_what_is_no_video_device_is_not_even_opened(void)
{
    world.nodes[0].not_a_device = 1;
    try_open(CAPTURE_ERR_KIND);
    TEST_ASSERT_EQUAL_INT(0, world.last_open_flags);
    world.nodes[0].not_a_device = 0;
    world.nodes[0].device_major = 10; /* a watchdog, for instance */
    try_open(CAPTURE_ERR_KIND);
    TEST_ASSERT_EQUAL_INT(0, world.last_open_flags);
}

static int (*plain_open)(void *user, const char *path, int flags);

static int exchange(void *user, const char *path, int flags)
{
    world.nodes[0].device_major = 10; /* between the look and the opening */
    return plain_open(user, path, flags);
}

static void test_what_is_exchanged_while_it_is_opened(void)
{
    plain_open = world.calls.open;
    world.calls.open = exchange;
    try_open(CAPTURE_ERR_KIND);
    TEST_ASSERT_TRUE(world.last_open_flags != 0);
    TEST_ASSERT_EQUAL_UINT(0, replay_open_count(&world));
}

static void test_reasons(void)
{
    static const struct {
        unsigned long call;
        int error;
        capture_status status;
    } cases[] = {
        {REPLAY_STAT, ENOENT, CAPTURE_ERR_NONE},     {REPLAY_STAT, EACCES, CAPTURE_ERR_ACCESS},
        {REPLAY_OPEN, EACCES, CAPTURE_ERR_ACCESS},   {REPLAY_OPEN, EPERM, CAPTURE_ERR_ACCESS},
        {REPLAY_OPEN, EBUSY, CAPTURE_ERR_BUSY},      {REPLAY_OPEN, ENODEV, CAPTURE_ERR_NONE},
        {REPLAY_OPEN, ENXIO, CAPTURE_ERR_NONE},      {REPLAY_OPEN, EMFILE, CAPTURE_ERR_SYSTEM},
        {REPLAY_FSTAT, EIO, CAPTURE_ERR_SYSTEM},     {VIDIOC_QUERYCAP, ENOTTY, CAPTURE_ERR_KIND},
        {VIDIOC_QUERYCAP, EINVAL, CAPTURE_ERR_KIND}, {VIDIOC_QUERYCAP, EIO, CAPTURE_ERR_SYSTEM},
        {VIDIOC_S_FMT, ENODEV, CAPTURE_ERR_GONE},
    };

    for (unsigned i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        world.nodes[0].present = 1;
        replay_fail(&world, cases[i].call, 0, 1, cases[i].error);
        try_open(cases[i].status);
        TEST_ASSERT_NOT_NULL(strstr(capture_error(camera), "/dev/video0"));
        TEST_ASSERT_EQUAL_UINT(0, replay_open_count(&world));
        TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ORDER, capture_start(camera));
        TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ORDER, capture_controls(camera, NULL, 0));
    }
}

static void test_busy_camera_can_be_looked_at(void)
{
    capture_mode modes[8];
    capture_control controls[8];
    int32_t value;

    replay_fail(&world, VIDIOC_S_FMT, 0, 100, EBUSY);
    try_open(CAPTURE_ERR_BUSY);
    TEST_ASSERT_EQUAL_STRING("Replayed Camera", scene_settings().card);
    TEST_ASSERT_EQUAL_INT(3, capture_modes(camera, modes, 8));
    TEST_ASSERT_EQUAL_INT(3, capture_controls(camera, controls, 8));
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_get(camera, controls[0].id, &value));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ORDER, capture_start(camera));
}

static void test_wishes_that_nobody_can_have(void)
{
    char path[CAPTURE_PATH_BYTES + 2];
    const capture_wish good = wish;

    wish.width = PEL_SIDE_MAX + 1;
    try_open(CAPTURE_ERR_ARG);
    wish = good;
    wish.rate_num = 30;
    try_open(CAPTURE_ERR_ARG);
    wish = good;
    wish.buffers = 1;
    try_open(CAPTURE_ERR_ARG);
    wish.buffers = 33;
    try_open(CAPTURE_ERR_ARG);
    wish = good;
    wish.fourcc = V4L2_PIX_FMT_H264;
    try_open(CAPTURE_ERR_FORMAT);
    wish = good;
    memset(path, 'a', sizeof path);
    path[0] = '/';
    path[sizeof path - 1] = '\0';
    wish.device = path;
    try_open(CAPTURE_ERR_ARG);
    wish = good;
    wish.backend = (capture_backend)7;
    try_open(CAPTURE_ERR_KIND);
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_KIND, capture_list((capture_backend)7, NULL, NULL, 0));
    TEST_ASSERT_FALSE(capture_has_backend((capture_backend)7));
    TEST_ASSERT_TRUE(capture_has_backend(CAPTURE_V4L2));
}

static void test_null(void)
{
    capture *none = (capture *)&world;

    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_open(NULL, &world.calls, &none));
    TEST_ASSERT_NULL(none);
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_open(&wish, &world.calls, NULL));
    capture_close(NULL);
    TEST_ASSERT_EQUAL_STRING("", capture_error(NULL));
    TEST_ASSERT_EQUAL_STRING("", capture_changes(NULL));
}

static void test_names(void)
{
    TEST_ASSERT_EQUAL_STRING("timeout", capture_status_name(CAPTURE_TIMEOUT));
    TEST_ASSERT_EQUAL_STRING("unknown", capture_status_name((capture_status)99));
    TEST_ASSERT_EQUAL_STRING("white_balance", capture_known_name(CAPTURE_WHITE_BALANCE));
    TEST_ASSERT_NULL(capture_known_name((capture_known)0));
    TEST_ASSERT_NULL(capture_known_name(CAPTURE_KNOWN_COUNT));
}

static void test_codes(void)
{
    char text[16];
    pel_format format;

    capture_fourcc_text(V4L2_PIX_FMT_YUYV, text);
    TEST_ASSERT_EQUAL_STRING("YUYV", text);
    capture_fourcc_text(V4L2_PIX_FMT_Y16, text);
    TEST_ASSERT_EQUAL_STRING("Y16", text);
    capture_fourcc_text(0x01020304, text);
    TEST_ASSERT_EQUAL_STRING("0x01020304", text);
    TEST_ASSERT_EQUAL_HEX32(V4L2_PIX_FMT_NV12, capture_fourcc("NV12"));
    TEST_ASSERT_EQUAL_HEX32(V4L2_PIX_FMT_Y16, capture_fourcc("Y16"));
    TEST_ASSERT_EQUAL_HEX32(0, capture_fourcc("YUYV2"));
    TEST_ASSERT_EQUAL_HEX32(0, capture_fourcc(""));
    TEST_ASSERT_EQUAL_HEX32(0, capture_fourcc("A\tB"));
    TEST_ASSERT_EQUAL_HEX32(0, capture_fourcc(NULL));
    TEST_ASSERT_EQUAL_INT(1, capture_format_of(V4L2_PIX_FMT_SBGGR8, &format));
    TEST_ASSERT_EQUAL_INT(PEL_BAYER8_BGGR, format);
    TEST_ASSERT_EQUAL_INT(2, capture_format_of(V4L2_PIX_FMT_MJPEG, &format));
    TEST_ASSERT_EQUAL_INT(PEL_RGB888, format);
    TEST_ASSERT_EQUAL_INT(0, capture_format_of(V4L2_PIX_FMT_H264, &format));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_list);
    RUN_TEST(test_list_of_nothing);
    RUN_TEST(test_path);
    RUN_TEST(test_bus_and_names);
    RUN_TEST(test_name_that_is_part_of_another);
    RUN_TEST(test_two_nodes_of_one_camera_are_no_doubt);
    RUN_TEST(test_first_camera);
    RUN_TEST(test_first_camera_that_can_be_read);
    RUN_TEST(test_what_is_no_camera);
    RUN_TEST(test_what_is_no_video_device_is_not_even_opened);
    RUN_TEST(test_what_is_exchanged_while_it_is_opened);
    RUN_TEST(test_reasons);
    RUN_TEST(test_busy_camera_can_be_looked_at);
    RUN_TEST(test_wishes_that_nobody_can_have);
    RUN_TEST(test_null);
    RUN_TEST(test_names);
    RUN_TEST(test_codes);
    return UNITY_END();
}
