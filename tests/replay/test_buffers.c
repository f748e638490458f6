/* Buffers: asked for, mapped, held by the caller, and let go of on every path. */
#include "scene.h"

#include <errno.h>
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

static void test_no_copy_is_made(void)
{
    capture_frame frame;
    int found = 0;

    scene_start();
    frame = scene_take();
    for (unsigned i = 0; i < REPLAY_MEMORIES; i++) {
        found |= world.memories[i].mapped && world.memories[i].bytes == frame.view.plane[0];
    }
    TEST_ASSERT_TRUE(found);
}

static void test_frames_that_are_held_survive_restarts(void)
{
    capture_frame held[2];

    scene_start();
    held[0] = scene_take();
    held[1] = scene_take();
    world.nodes[0].broken = 1;
    scene_frames(2);
    scene_check(&held[0]);
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_give_back(camera, &held[0]));
    /* And one that sets up anew: */
    world.nodes[0].broken = 1;
    replay_fail(&world, VIDIOC_STREAMON, 0, 1, EINVAL);
    scene_frames(2);
    scene_check(&held[1]);
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_give_back(camera, &held[1]));
    scene_frames(6);
    TEST_ASSERT_EQUAL_UINT64(2, scene_counts().restarts);
}

/* Also where the format must be set anew, which needs the old buffers to be gone. */
static void test_held_frame_on_a_kernel_that_keeps_mapped_buffers(void)
{
    for (int silent = 0; silent < 2; silent++) {
        capture_frame held;

        scene_end();
        scene_begin();
        world.nodes[0].keeps_mapped = 1;
        world.nodes[0].no_get_format = silent;
        scene_start();
        held = scene_take();
        world.nodes[0].broken = 1;
        replay_fail(&world, VIDIOC_STREAMON, 0, 1, EIO);
        scene_next(300, CAPTURE_ERR_BUSY);
        scene_check(&held);
        capture_give_back(camera, &held);
        scene_frames(3);
    }
}

static void test_buffer_that_the_driver_did_not_have(void)
{
    capture_frame held;

    scene_start();
    held = scene_take(); /* buffer 0 */
    world.nodes[0].bad_index = REPLAY_NOT_QUEUED;
    scene_frames(1);
    world.nodes[0].bad_index = REPLAY_NO_SUCH;
    scene_frames(1);
    TEST_ASSERT_EQUAL_UINT64(2, scene_counts().restarts);
    scene_check(&held);
}

static void test_failing_to_queue_restarts(void)
{
    static const int errors[] = {EIO, EINVAL, ENOMEM};
    capture_frame frame;

    scene_start();
    for (unsigned i = 0; i < 3; i++) {
        frame = scene_take();
        replay_fail(&world, VIDIOC_QBUF, 0, 1, errors[i]);
        TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_give_back(camera, &frame));
        scene_frames(6);
        TEST_ASSERT_EQUAL_UINT64(i + 1, scene_counts().restarts);
    }
}

static void test_caller_who_holds_everything(void)
{
    capture_frame held[4];

    scene_start();
    for (unsigned i = 0; i < 4; i++) {
        held[i] = scene_take();
    }
    scene_next(100, CAPTURE_ERR_ORDER);
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_give_back(camera, &held[2]));
    scene_frames(1);
    scene_check(&held[0]);
    scene_check(&held[1]);
    scene_check(&held[3]);
}

static void test_giving_back(void)
{
    capture_frame frame;
    capture_frame copy;

    scene_start();
    frame = scene_take();
    copy = frame;
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_give_back(camera, &frame));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_give_back(camera, &frame));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_give_back(camera, &copy));
    copy.slot = 12345678;
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_give_back(camera, &copy));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_give_back(camera, NULL));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_give_back(NULL, &copy));
    frame = scene_take();
    capture_stop(camera);
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_give_back(camera, &frame));
}

static void test_stop_releases_and_start_goes_on(void)
{
    for (unsigned i = 0; i < 3; i++) {
        capture_frame held;

        scene_start();
        scene_frames(2);
        held = scene_take();
        TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_stop(camera));
        TEST_ASSERT_EQUAL_UINT(0, replay_map_count(&world));
        TEST_ASSERT_EQUAL_UINT(0, replay_buffer_count(&world));
        TEST_ASSERT_EQUAL_UINT(0, replay_queued_count(&world));
        capture_give_back(camera, &held);
    }
    TEST_ASSERT_EQUAL_UINT64(9, scene_counts().frames);
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().restarts);
}

static void test_order_of_calls(void)
{
    capture_frame frame;

    scene_open();
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ORDER, capture_next(camera, 10, &frame));
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_stop(camera));
    scene_start();
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ORDER, capture_start(camera));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_next(camera, 10, NULL));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_next(NULL, 10, &frame));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_start(NULL));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_stop(NULL));
}

static void test_start_that_fails_can_be_tried_again(void)
{
    static const struct {
        unsigned long call;
        unsigned skip;
        int error;
        capture_status status;
    } cases[] = {
        {VIDIOC_REQBUFS, 0, EBUSY, CAPTURE_ERR_BUSY},
        {VIDIOC_REQBUFS, 0, ENOMEM, CAPTURE_ERR_SYSTEM},
        {VIDIOC_QUERYBUF, 0, EINVAL, CAPTURE_ERR_SYSTEM},
        {VIDIOC_QUERYBUF, 2, EINVAL, CAPTURE_ERR_SYSTEM},
        {REPLAY_MMAP, 0, ENOMEM, CAPTURE_ERR_SYSTEM},
        {REPLAY_MMAP, 3, EACCES, CAPTURE_ERR_ACCESS},
        {VIDIOC_QBUF, 0, EIO, CAPTURE_ERR_SYSTEM},
        {VIDIOC_QBUF, 3, EINVAL, CAPTURE_ERR_SYSTEM},
        {VIDIOC_STREAMON, 0, ENOSPC, CAPTURE_ERR_SYSTEM},
        {VIDIOC_STREAMON, 0, EIO, CAPTURE_ERR_SYSTEM},
    };

    scene_open();
    for (unsigned i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        replay_fail(&world, cases[i].call, cases[i].skip, 1, cases[i].error);
        TEST_ASSERT_EQUAL_INT(cases[i].status, capture_start(camera));
        TEST_ASSERT_TRUE(strlen(capture_error(camera)) > 20);
        TEST_ASSERT_EQUAL_UINT(0, replay_map_count(&world));
        TEST_ASSERT_EQUAL_UINT(0, replay_buffer_count(&world));
        TEST_ASSERT_EQUAL_UINT(0, replay_queued_count(&world));
        TEST_ASSERT_EQUAL_UINT(1, replay_open_count(&world));
    }
    scene_start();
    scene_frames(2);
}

static void test_bandwidth_is_explained(void)
{
    scene_open();
    replay_fail(&world, VIDIOC_STREAMON, 0, 1, ENOSPC);
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_SYSTEM, capture_start(camera));
    TEST_ASSERT_NOT_NULL(strstr(capture_error(camera), "bandwidth"));
}

static void test_buffers_that_cannot_hold_a_frame(void)
{
    world.nodes[0].buffer_cut = 1;
    scene_open();
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_SYSTEM, capture_start(camera));
    TEST_ASSERT_NOT_NULL(strstr(capture_error(camera), "too small"));
}

static void test_number_of_buffers(void)
{
    static const unsigned asked[] = {0, 2, 32, 4, 4, 8};
    static const unsigned least[] = {0, 0, 0, 6, 40, 0};
    static const unsigned most[] = {0, 0, 0, 32, 40, 3};
    static const unsigned got[] = {4, 2, 32, 6, 32, 3};

    for (unsigned i = 0; i < 6; i++) {
        scene_end();
        scene_begin();
        wish.buffers = asked[i];
        world.nodes[0].buffers_min = least[i];
        world.nodes[0].buffers_max = most[i];
        scene_start();
        TEST_ASSERT_EQUAL_UINT(got[i], scene_settings().buffers);
        TEST_ASSERT_EQUAL_UINT(got[i], replay_map_count(&world));
        scene_frames(5);
    }
}

static void test_driver_that_gives_no_buffers(void)
{
    world.nodes[0].buffers_max = 1;
    scene_start();
    TEST_ASSERT_EQUAL_UINT(1, scene_settings().buffers);
    scene_frames(3);
}

static void test_format_changed_behind_the_back(void)
{
    scene_open();
    world.nodes[0].width = 16; /* by another program */
    world.nodes[0].height = 8;
    scene_start();
    TEST_ASSERT_EQUAL_UINT(32, scene_settings().width);
    scene_frames(2);
    capture_stop(camera);
    world.nodes[0].force_width = 16;
    world.nodes[0].width = 16;
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_FORMAT, capture_start(camera));
    TEST_ASSERT_EQUAL_UINT(32, scene_settings().width);
}

static void test_stop_of_a_driver_that_does_not_stop(void)
{
    scene_start();
    scene_frames(1);
    replay_fail(&world, VIDIOC_STREAMOFF, 0, 1, EIO);
    replay_fail(&world, VIDIOC_REQBUFS, 0, 1, EIO);
    capture_stop(camera);
    TEST_ASSERT_EQUAL_UINT(0, replay_queued_count(&world));
    TEST_ASSERT_EQUAL_UINT(0, replay_buffer_count(&world));
    scene_start(); /* opened again without being asked */
    scene_frames(2);
    TEST_ASSERT_EQUAL_UINT64(1, scene_counts().reopens);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_no_copy_is_made);
    RUN_TEST(test_frames_that_are_held_survive_restarts);
    RUN_TEST(test_held_frame_on_a_kernel_that_keeps_mapped_buffers);
    RUN_TEST(test_buffer_that_the_driver_did_not_have);
    RUN_TEST(test_failing_to_queue_restarts);
    RUN_TEST(test_caller_who_holds_everything);
    RUN_TEST(test_giving_back);
    RUN_TEST(test_stop_releases_and_start_goes_on);
    RUN_TEST(test_order_of_calls);
    RUN_TEST(test_start_that_fails_can_be_tried_again);
    RUN_TEST(test_bandwidth_is_explained);
    RUN_TEST(test_buffers_that_cannot_hold_a_frame);
    RUN_TEST(test_number_of_buffers);
    RUN_TEST(test_driver_that_gives_no_buffers);
    RUN_TEST(test_format_changed_behind_the_back);
    RUN_TEST(test_stop_of_a_driver_that_does_not_stop);
    return UNITY_END();
}
