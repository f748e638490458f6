/* Waiting, time-outs, errors and restarts of a running stream, each alone. */
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

static void test_frames_arrive_in_order(void)
{
    scene_start();
    for (unsigned i = 0; i < 40; i++) {
        capture_frame frame = scene_take();

        TEST_ASSERT_EQUAL_UINT64(i, frame.sequence);
        TEST_ASSERT_EQUAL_UINT32(0, frame.missed);
        TEST_ASSERT_EQUAL_UINT(32 * 24 * 2, frame.byte_count);
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_cview_check(&frame.view));
        TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_give_back(camera, &frame));
    }
    TEST_ASSERT_EQUAL_UINT64(40, scene_counts().frames);
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().missed);
}

static void test_interrupted_calls_are_repeated(void)
{
    static const unsigned long calls[] = {
        REPLAY_OPEN,     VIDIOC_QUERYCAP, VIDIOC_ENUM_FMT, VIDIOC_ENUM_FRAMESIZES, VIDIOC_S_FMT,
        VIDIOC_G_FMT,    VIDIOC_G_PARM,   VIDIOC_REQBUFS,  VIDIOC_QUERYBUF,        VIDIOC_QBUF,
        VIDIOC_STREAMON, REPLAY_POLL,     VIDIOC_DQBUF,    VIDIOC_STREAMOFF};
    const unsigned count = sizeof calls / sizeof calls[0];

    for (unsigned i = 0; i < count; i++) {
        replay_fail(&world, calls[i], 0, 3, EINTR);
    }
    scene_start();
    scene_frames(10);
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_stop(camera));
    TEST_ASSERT_EQUAL_UINT64(3 * count, scene_counts().interrupted);
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().restarts);
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().missed);
}

static void test_interrupted_wait_keeps_its_deadline(void)
{
    uint64_t before;

    scene_start();
    world.nodes[0].stalled = 1;
    replay_fail(&world, REPLAY_POLL, 0, 20, EINTR);
    before = world.now_us;
    scene_next(300, CAPTURE_TIMEOUT);
    TEST_ASSERT_UINT64_WITHIN(2000, 300000, world.now_us - before);
    TEST_ASSERT_EQUAL_UINT64(20, scene_counts().interrupted);
}

static void test_eagain_waits_within_the_deadline(void)
{
    scene_start();
    replay_fail(&world, VIDIOC_DQBUF, 0, 5, EAGAIN);
    scene_frames(3);
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().timeouts);
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().restarts);
}

static void test_eagain_for_ever_is_a_timeout(void)
{
    uint64_t before;

    scene_start();
    world.nodes[0].stalled = 1;
    world.nodes[0].spurious = 1; /* says ready, has nothing */
    before = world.now_us;
    scene_next(200, CAPTURE_TIMEOUT);
    TEST_ASSERT_UINT64_WITHIN(3000, 200000, world.now_us - before);
}

static void test_timeout_is_a_status(void)
{
    uint64_t before;

    scene_start();
    scene_frames(2);
    world.nodes[0].stalled = 1;
    before = world.now_us;
    scene_next(120, CAPTURE_TIMEOUT);
    TEST_ASSERT_UINT64_WITHIN(2000, 120000, world.now_us - before);
    TEST_ASSERT_EQUAL_UINT64(1, scene_counts().timeouts);
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().restarts);
    world.nodes[0].stalled = 0;
    scene_frames(2);
}

static void test_deadline_zero_takes_only_what_is_there(void)
{
    const uint64_t before = world.now_us;
    capture_frame frame;

    scene_start();
    for (unsigned i = 0; i < 50; i++) {
        world.nodes[0].stalled = 1;
        scene_next(0, CAPTURE_TIMEOUT);
    }
    TEST_ASSERT_UINT64_WITHIN(2000, 1000, world.now_us - before);
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().timeouts);
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().restarts);
    world.nodes[0].stalled = 0;
    world.now_us += 100000;
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_next(camera, 0, &frame));
    scene_check(&frame);
}

static void test_stream_restarts_after_timeouts(void)
{
    wish.restart_after = 4;
    scene_start();
    scene_frames(3);
    world.nodes[0].stalled = 1;
    for (unsigned i = 0; i < 4; i++) {
        TEST_ASSERT_EQUAL_UINT64(0, scene_counts().restarts);
        scene_next(400, CAPTURE_TIMEOUT);
    }
    scene_frames(5);
    TEST_ASSERT_EQUAL_UINT64(1, scene_counts().restarts);
    TEST_ASSERT_EQUAL_UINT64(4, scene_counts().timeouts);
    TEST_ASSERT_EQUAL_UINT64(2, world.counts.stream_ons);
}

static void test_timeouts_must_be_in_a_row(void)
{
    scene_start();
    for (unsigned i = 0; i < 6; i++) {
        world.nodes[0].stalled = 1;
        scene_next(600, CAPTURE_TIMEOUT);
        scene_next(600, CAPTURE_TIMEOUT);
        world.nodes[0].stalled = 0;
        scene_frames(1);
    }
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().restarts);
}

static void test_impatience_does_not_restart_a_slow_camera(void)
{
    wish.rate_num = wish.rate_den = 1; /* one frame each second; restarts come after four */
    scene_start();
    scene_frames(1);
    for (unsigned i = 0; i < 90; i++) {
        scene_next(10, CAPTURE_TIMEOUT);
    }
    scene_frames(1);
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().restarts);
    TEST_ASSERT_EQUAL_UINT64(90, scene_counts().timeouts);
}

static void test_eio_restarts(void)
{
    scene_start();
    scene_frames(3);
    replay_fail(&world, VIDIOC_DQBUF, 0, 1, EIO);
    scene_frames(3);
    TEST_ASSERT_EQUAL_UINT64(1, scene_counts().restarts);
    world.nodes[0].broken = 1; /* until STREAMOFF */
    scene_frames(3);
    TEST_ASSERT_EQUAL_UINT64(2, scene_counts().restarts);
    TEST_ASSERT_EQUAL_UINT64(9, scene_counts().frames);
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().missed);
}

static void test_eio_for_ever_ends_with_the_deadline(void)
{
    uint64_t before;

    scene_start();
    replay_fail(&world, VIDIOC_STREAMON, 0, 1000000, EIO);
    world.nodes[0].broken = 1;
    before = world.now_us;
    scene_next(500, CAPTURE_ERR_SYSTEM);
    TEST_ASSERT_NOT_NULL(strstr(capture_error(camera), "VIDIOC_STREAMON"));
    TEST_ASSERT_UINT64_WITHIN(2000, 500000, world.now_us - before);
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().restarts);
    memset(world.faults, 0, sizeof world.faults);
    scene_frames(2);
    TEST_ASSERT_EQUAL_UINT64(1, scene_counts().restarts);
}

static void test_first_restart_keeps_the_buffers(void)
{
    scene_start();
    scene_frames(1);
    world.nodes[0].broken = 1;
    replay_fail(&world, VIDIOC_REQBUFS, 0, 1000, ENOMEM);
    scene_frames(2);
    TEST_ASSERT_EQUAL_UINT64(1, scene_counts().restarts);
    memset(world.faults, 0, sizeof world.faults);
}

static void test_restarts_that_do_not_help_come_slowly(void)
{
    scene_start();
    replay_fail(&world, VIDIOC_DQBUF, 0, 1000000, EIO); /* although the stream starts each time */
    scene_next(1000, CAPTURE_TIMEOUT);
    TEST_ASSERT_UINT64_WITHIN(5, 15, scene_counts().restarts);
    memset(world.faults, 0, sizeof world.faults);
    scene_frames(2);
}

static void test_stubborn_restart_sets_up_anew(void)
{
    unsigned requests;

    scene_start();
    scene_frames(1);
    /* The gentle restart does not help: the first QBUF after it fails. */
    world.nodes[0].broken = 1;
    replay_fail(&world, VIDIOC_QBUF, 0, 1, EINVAL);
    requests = (unsigned)world.counts.stream_ons;
    scene_frames(2);
    TEST_ASSERT_EQUAL_UINT64(requests + 1, world.counts.stream_ons);
    TEST_ASSERT_EQUAL_UINT64(1, scene_counts().restarts);
}

static void test_poll_error_restarts(void)
{
    scene_start();
    scene_frames(1);
    world.nodes[0].waiting_count = world.nodes[0].filled_count = 0; /* POLLERR, DQBUF: EAGAIN */
    for (unsigned i = 0; i < world.nodes[0].buffer_count; i++) {
        world.nodes[0].buffers[i].queued = 0;
    }
    scene_frames(2);
    TEST_ASSERT_EQUAL_UINT64(1, scene_counts().restarts);
}

static void test_poll_failure_is_said(void)
{
    scene_start();
    replay_fail(&world, REPLAY_POLL, 0, 1, ENOMEM);
    scene_next(100, CAPTURE_ERR_SYSTEM);
    scene_frames(1);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_frames_arrive_in_order);
    RUN_TEST(test_interrupted_calls_are_repeated);
    RUN_TEST(test_interrupted_wait_keeps_its_deadline);
    RUN_TEST(test_eagain_waits_within_the_deadline);
    RUN_TEST(test_eagain_for_ever_is_a_timeout);
    RUN_TEST(test_timeout_is_a_status);
    RUN_TEST(test_deadline_zero_takes_only_what_is_there);
    RUN_TEST(test_stream_restarts_after_timeouts);
    RUN_TEST(test_timeouts_must_be_in_a_row);
    RUN_TEST(test_impatience_does_not_restart_a_slow_camera);
    RUN_TEST(test_eio_restarts);
    RUN_TEST(test_eio_for_ever_ends_with_the_deadline);
    RUN_TEST(test_first_restart_keeps_the_buffers);
    RUN_TEST(test_restarts_that_do_not_help_come_slowly);
    RUN_TEST(test_stubborn_restart_sets_up_anew);
    RUN_TEST(test_poll_error_restarts);
    RUN_TEST(test_poll_failure_is_said);
    return UNITY_END();
}
