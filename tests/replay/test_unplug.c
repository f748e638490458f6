/* Cameras that go away, and those that come back. */
#include "scene.h"

#include <errno.h>
#include <string.h>

#include <unity.h>

void setUp(void)
{
    scene_begin();
    wish.return_ms = 3000;
}

void tearDown(void)
{
    scene_end();
}

/* From now on it is away, for so many milliseconds (0: for ever). */
static void unplug(unsigned away_ms)
{
    world.nodes[0].back_after_us = (uint64_t)away_ms * 1000;
    replay_unplug(&world, &world.nodes[0]);
}

static void test_gone_for_good_closes(void)
{
    wish.return_ms = 0;
    scene_start();
    scene_frames(2);
    unplug(0);
    scene_next(1000, CAPTURE_ERR_GONE);
    TEST_ASSERT_NOT_NULL(strstr(capture_error(camera), "/dev/video0"));
    TEST_ASSERT_EQUAL_UINT(0, replay_open_count(&world));
    TEST_ASSERT_EQUAL_UINT(0, replay_map_count(&world));
    scene_next(1000, CAPTURE_ERR_GONE);
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_stop(camera));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_GONE, capture_start(camera));
}

static void test_does_not_wait_when_not_asked(void)
{
    uint64_t before;

    wish.return_ms = 0;
    scene_start();
    unplug(0);
    before = world.now_us;
    scene_next(60000, CAPTURE_ERR_GONE);
    TEST_ASSERT_TRUE(world.now_us - before < 1000);
}

static void test_comes_back_on_the_same_path(void)
{
    scene_start();
    scene_frames(3);
    unplug(700);
    scene_frames(5);
    TEST_ASSERT_EQUAL_UINT64(1, scene_counts().reopens);
    TEST_ASSERT_EQUAL_UINT64(8, scene_counts().frames);
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().missed);
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().restarts);
    TEST_ASSERT_EQUAL_UINT(32, scene_settings().width);
    TEST_ASSERT_EQUAL_UINT(1, replay_open_count(&world));
}

static void test_every_call_may_be_the_one_that_notices(void)
{
    static const unsigned long calls[] = {VIDIOC_DQBUF, VIDIOC_QBUF};

    for (unsigned i = 0; i < 2; i++) {
        capture_frame frame;

        scene_end();
        scene_begin();
        wish.return_ms = 3000;
        world.nodes[0].back_after_us = 500000;
        scene_start();
        frame = scene_take();
        replay_fail(&world, calls[i], 0, 1, ENODEV);
        TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_give_back(camera, &frame));
        scene_frames(3);
        TEST_ASSERT_EQUAL_UINT64(1, scene_counts().reopens);
    }
}

static void test_sequence_and_time_go_on(void)
{
    capture_frame frame;
    uint64_t time_us;

    scene_start();
    scene_frames(4);
    frame = scene_take();
    time_us = frame.timestamp_us;
    capture_give_back(camera, &frame);
    unplug(300);
    world.nodes[0].first_time_us = -100000000; /* its clock starts anew, far behind */
    frame = scene_take();
    TEST_ASSERT_EQUAL_UINT64(5, frame.sequence);
    TEST_ASSERT_TRUE(frame.timestamp_us >= time_us);
}

static void test_wait_ends_with_the_deadline_and_goes_on_later(void)
{
    uint64_t before;

    scene_start();
    unplug(1000);
    before = world.now_us;
    scene_next(400, CAPTURE_TIMEOUT);
    TEST_ASSERT_UINT64_WITHIN(5000, 400000, world.now_us - before);
    scene_next(0, CAPTURE_TIMEOUT);
    scene_next(400, CAPTURE_TIMEOUT);
    scene_frames(2);
    TEST_ASSERT_EQUAL_UINT64(2, scene_counts().timeouts);
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().restarts);
    TEST_ASSERT_EQUAL_UINT64(1, scene_counts().reopens);
}

static void test_wait_ends_with_patience(void)
{
    const uint64_t before = world.now_us;

    scene_start();
    unplug(0);
    scene_next(10000, CAPTURE_ERR_GONE);
    TEST_ASSERT_UINT64_WITHIN(120000, 3000000, world.now_us - before);
    world.nodes[0].present = 1; /* too late */
    scene_next(100, CAPTURE_ERR_GONE);
}

static void test_comes_back_under_another_number(void)
{
    scene_start();
    world.nodes[0].back_number = 4;
    unplug(200);
    scene_frames(2);
    TEST_ASSERT_EQUAL_STRING("/dev/video4", scene_settings().path);
    TEST_ASSERT_EQUAL_UINT64(1, scene_counts().reopens);
    world.nodes[0].back_number = 0; /* and again */
    unplug(200);
    scene_frames(2);
    TEST_ASSERT_EQUAL_STRING("/dev/video0", scene_settings().path);
}

static void test_named_camera_comes_back_on_another_bus(void)
{
    wish.device = "Replayed";
    scene_start();
    world.nodes[0].back_number = 4;
    unplug(200);
    world.nodes[0].bus = "usb-replay-2";
    scene_frames(2);
    TEST_ASSERT_EQUAL_STRING("/dev/video4", scene_settings().path);
    TEST_ASSERT_EQUAL_STRING("usb-replay-2", scene_settings().bus);
}

static void test_camera_of_a_path_is_not_sought_on_another_bus(void)
{
    scene_start();
    world.nodes[0].back_number = 4;
    unplug(200);
    world.nodes[0].bus = "usb-replay-2";
    scene_next(10000, CAPTURE_ERR_GONE);
}

static void test_other_camera_on_the_path_is_not_taken(void)
{
    scene_start();
    world.nodes[0].back_number = 1;
    unplug(1500);
    replay_add_camera(&world, 1, 0, "Impostor", "usb-9");
    scene_next(1000, CAPTURE_TIMEOUT);
    scene_frames(2);
    TEST_ASSERT_EQUAL_STRING("/dev/video1", scene_settings().path);
}

static void test_camera_with_another_format_is_not_taken(void)
{
    scene_start();
    scene_frames(1);
    world.nodes[0].back_force_width = 16;
    unplug(200);
    scene_next(10000, CAPTURE_ERR_GONE);
    TEST_ASSERT_EQUAL_UINT(32, scene_settings().width);
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().reopens);
}

static void test_camera_that_is_not_ready_at_once(void)
{
    scene_start();
    replay_fail(&world, REPLAY_OPEN, 1, 3, EACCES); /* its rights are set later */
    unplug(200);
    replay_fail(&world, VIDIOC_S_FMT, 0, 2, EIO);
    replay_fail(&world, VIDIOC_STREAMON, 0, 2, EIO);
    scene_frames(2);
    TEST_ASSERT_EQUAL_UINT64(1, scene_counts().reopens);
}

static void test_controls_are_set_again(void)
{
    int32_t value = 0;

    scene_start();
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_set(camera, V4L2_CID_GAIN, 77, NULL));
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_set(camera, V4L2_CID_GAIN, 78, NULL));
    unplug(200);
    scene_frames(1);
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_get(camera, V4L2_CID_GAIN, &value));
    TEST_ASSERT_EQUAL_INT32(78, value);
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_get(camera, V4L2_CID_EXPOSURE_ABSOLUTE, &value));
    TEST_ASSERT_EQUAL_INT32(2500, value); /* nobody had set it */
}

static void test_rate_is_set_again(void)
{
    wish.rate_num = 15;
    wish.rate_den = 1;
    scene_start();
    unplug(200);
    world.nodes[0].rate = 0;
    scene_frames(1);
    TEST_ASSERT_EQUAL_UINT(15, scene_settings().rate_num);
    TEST_ASSERT_EQUAL_UINT(15, world.nodes[0].rate);
}

static void test_frames_that_are_held_survive(void)
{
    capture_frame held[3];
    capture_frame copy;

    scene_start();
    held[0] = scene_take();
    held[1] = scene_take();
    unplug(200);
    held[2] = scene_take();
    scene_check(&held[0]);
    scene_check(&held[1]);
    copy = held[0];
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_give_back(camera, &held[0]));
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_give_back(camera, &copy)); /* not noticed, no harm */
    scene_frames(6);
    unplug(200);
    scene_frames(6);
    scene_check(&held[1]);
    scene_check(&held[2]);
    TEST_ASSERT_EQUAL_UINT64(2, scene_counts().reopens);
}

static void test_held_frames_of_before_count(void)
{
    capture_frame held[4];

    scene_start();
    for (unsigned i = 0; i < 4; i++) {
        held[i] = scene_take();
    }
    unplug(200);
    scene_next(1000, CAPTURE_ERR_ORDER);
    capture_give_back(camera, &held[0]);
    scene_frames(3);
    scene_check(&held[3]);
}

static void test_stop_and_start_around_the_absence(void)
{
    scene_start();
    scene_frames(1);
    unplug(500);
    scene_next(100, CAPTURE_TIMEOUT);
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_stop(camera));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_GONE, capture_start(camera));
    world.now_us += 1000000;
    scene_start();
    scene_frames(2);
    TEST_ASSERT_EQUAL_UINT64(1, scene_counts().reopens);
}

static void test_unplugged_while_it_starts(void)
{
    static const unsigned long calls[] = {VIDIOC_G_FMT, VIDIOC_REQBUFS,  VIDIOC_QUERYBUF,
                                          VIDIOC_QBUF,  VIDIOC_STREAMON, REPLAY_MMAP};

    for (unsigned i = 0; i < 6; i++) {
        scene_end();
        scene_begin();
        scene_open();
        replay_fail(&world, calls[i], 0, 1, ENODEV);
        TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_GONE, capture_start(camera));
        TEST_ASSERT_EQUAL_UINT(0, replay_open_count(&world));
    }
}

static void test_unplugged_while_it_stops(void)
{
    static const unsigned long calls[] = {VIDIOC_STREAMOFF, VIDIOC_REQBUFS};

    for (unsigned i = 0; i < 2; i++) {
        scene_end();
        scene_begin();
        scene_start();
        replay_fail(&world, calls[i], 0, 1, ENODEV);
        TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_stop(camera));
        TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_GONE, capture_start(camera));
    }
}

static void test_unplugged_while_a_control_is_set(void)
{
    static const unsigned long calls[] = {VIDIOC_QUERYCTRL, VIDIOC_G_CTRL, VIDIOC_S_CTRL};

    for (unsigned i = 0; i < 3; i++) {
        scene_end();
        scene_begin();
        wish.return_ms = 1000;
        world.nodes[0].back_after_us = 300000;
        scene_start();
        replay_fail(&world, calls[i], 0, 1, ENODEV);
        TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_GONE, capture_set(camera, V4L2_CID_GAIN, 3, NULL));
        scene_frames(2);
        TEST_ASSERT_EQUAL_UINT64(1, scene_counts().reopens);
    }
}

static void test_goes_away_again_and_again(void)
{
    world.nodes[0].unplug_after = 5;
    world.nodes[0].back_after_us = 350000;
    scene_start();
    for (unsigned i = 0; i < 30; i++) {
        world.nodes[0].unplug_after = 5;
        scene_frames(5);
    }
    TEST_ASSERT_TRUE(scene_counts().reopens >= 28);
    TEST_ASSERT_EQUAL_UINT64(150, scene_counts().frames);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_gone_for_good_closes);
    RUN_TEST(test_does_not_wait_when_not_asked);
    RUN_TEST(test_comes_back_on_the_same_path);
    RUN_TEST(test_every_call_may_be_the_one_that_notices);
    RUN_TEST(test_sequence_and_time_go_on);
    RUN_TEST(test_wait_ends_with_the_deadline_and_goes_on_later);
    RUN_TEST(test_wait_ends_with_patience);
    RUN_TEST(test_comes_back_under_another_number);
    RUN_TEST(test_named_camera_comes_back_on_another_bus);
    RUN_TEST(test_camera_of_a_path_is_not_sought_on_another_bus);
    RUN_TEST(test_other_camera_on_the_path_is_not_taken);
    RUN_TEST(test_camera_with_another_format_is_not_taken);
    RUN_TEST(test_camera_that_is_not_ready_at_once);
    RUN_TEST(test_controls_are_set_again);
    RUN_TEST(test_rate_is_set_again);
    RUN_TEST(test_frames_that_are_held_survive);
    RUN_TEST(test_held_frames_of_before_count);
    RUN_TEST(test_stop_and_start_around_the_absence);
    RUN_TEST(test_unplugged_while_it_starts);
    RUN_TEST(test_unplugged_while_it_stops);
    RUN_TEST(test_unplugged_while_a_control_is_set);
    RUN_TEST(test_goes_away_again_and_again);
    return UNITY_END();
}
