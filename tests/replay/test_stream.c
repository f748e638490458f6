/* Frames out of a running stream, and each thing that may go wrong with it, alone. */
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

static void plan(const replay_kind *kinds, unsigned count)
{
    memcpy(world.nodes[0].plan, kinds, count * sizeof kinds[0]);
    world.nodes[0].plan_count = count;
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

static void test_damaged_buffers_do_not_hide_a_good_one(void)
{
    static const replay_kind kinds[] = {REPLAY_DAMAGED, REPLAY_SHORT, REPLAY_GOOD};
    capture_frame frame;

    plan(kinds, 3);
    scene_start();
    world.now_us += 150000; /* all three are there */
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

static void test_held_frame_on_a_kernel_that_keeps_mapped_buffers(void)
{
    capture_frame held;

    world.nodes[0].keeps_mapped = 1;
    scene_start();
    held = scene_take();
    world.nodes[0].broken = 1;
    replay_fail(&world, VIDIOC_STREAMON, 0, 1, EIO);
    scene_next(300, CAPTURE_ERR_BUSY);
    scene_check(&held);
    capture_give_back(camera, &held);
    scene_frames(3);
}

static void test_damaged_and_short_are_dropped_and_counted(void)
{
    static const replay_kind kinds[] = {REPLAY_GOOD,  REPLAY_DAMAGED, REPLAY_GOOD,    REPLAY_SHORT,
                                        REPLAY_SHORT, REPLAY_GOOD,    REPLAY_OVERLONG};

    plan(kinds, 7);
    scene_start();
    scene_frames(6);
    TEST_ASSERT_EQUAL_UINT64(2, scene_counts().damaged);
    TEST_ASSERT_EQUAL_UINT64(2, scene_counts().short_frames);
    TEST_ASSERT_EQUAL_UINT64(6, scene_counts().frames);
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().missed);
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().restarts);
}

static void test_short_by_one_byte(void)
{
    static const replay_kind kinds[] = {REPLAY_SHORT};

    plan(kinds, 1);
    world.nodes[0].stride_extra = 10;
    world.nodes[0].size_extra = 7;
    scene_start(); /* the first id is odd: short by one */
    scene_frames(1);
    TEST_ASSERT_EQUAL_UINT64(1, scene_counts().short_frames);
}

static void test_only_damaged_frames_are_a_timeout(void)
{
    uint64_t before;

    scene_start();
    world.nodes[0].damage = 1000;
    before = world.now_us;
    scene_next(500, CAPTURE_TIMEOUT);
    TEST_ASSERT_UINT64_WITHIN(40000, 500000, world.now_us - before);
    TEST_ASSERT_TRUE(scene_counts().damaged >= 14);
}

static void test_gaps_are_counted(void)
{
    static const replay_kind kinds[] = {REPLAY_GOOD, REPLAY_LOST,    REPLAY_LOST, REPLAY_GOOD,
                                        REPLAY_LOST, REPLAY_DAMAGED, REPLAY_LOST, REPLAY_GOOD};
    static const uint32_t missed[] = {0, 2, 2, 0};
    static const uint64_t sequence[] = {0, 3, 7, 8};

    plan(kinds, 8);
    scene_start();
    for (unsigned i = 0; i < 4; i++) {
        capture_frame frame = scene_take();

        TEST_ASSERT_EQUAL_UINT32(missed[i], frame.missed);
        TEST_ASSERT_EQUAL_UINT64(sequence[i], frame.sequence);
        capture_give_back(camera, &frame);
    }
    TEST_ASSERT_EQUAL_UINT64(4, scene_counts().missed);
    TEST_ASSERT_EQUAL_UINT64(1, scene_counts().damaged);
}

static void test_a_caller_that_is_slow_misses_frames(void)
{
    capture_frame frame;

    scene_start();
    scene_frames(1);
    world.now_us += 1000000; /* four wait in the queue, then about 26 find none */
    scene_frames(4);
    frame = scene_take();
    TEST_ASSERT_UINT32_WITHIN(2, 26, frame.missed);
    TEST_ASSERT_EQUAL_UINT64(frame.missed, scene_counts().missed);
}

static void test_sequence_wraps(void)
{
    static const replay_kind kinds[] = {REPLAY_GOOD, REPLAY_GOOD, REPLAY_LOST, REPLAY_GOOD};
    uint64_t last = 0;

    plan(kinds, 4);
    world.nodes[0].first_sequence = 0xFFFFFFFEu;
    scene_start();
    for (unsigned i = 0; i < 6; i++) {
        capture_frame frame = scene_take();

        TEST_ASSERT_EQUAL_UINT64(UINT64_C(0xFFFFFFFE) + i + (i >= 2), frame.sequence);
        TEST_ASSERT_TRUE(i == 0 || frame.sequence > last);
        last = frame.sequence;
        capture_give_back(camera, &frame);
    }
    TEST_ASSERT_EQUAL_UINT64(1, scene_counts().missed);
}

static void test_sequence_goes_on_after_a_restart(void)
{
    capture_frame frame;

    scene_start();
    scene_frames(5);
    world.nodes[0].broken = 1;
    frame = scene_take(); /* the driver's number is 0 again */
    TEST_ASSERT_EQUAL_UINT64(5, frame.sequence);
    TEST_ASSERT_EQUAL_UINT32(0, frame.missed);
}

static void test_driver_that_does_not_count(void)
{
    static const replay_kind kinds[] = {REPLAY_GOOD, REPLAY_LOST, REPLAY_GOOD};

    plan(kinds, 3);
    world.nodes[0].no_sequence = 1;
    scene_start();
    for (unsigned i = 0; i < 5; i++) {
        capture_frame frame = scene_take();

        TEST_ASSERT_EQUAL_UINT64(i, frame.sequence);
        capture_give_back(camera, &frame);
    }
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().missed);
}

/* Takes frames while the driver's clock wraps; the time between them must be true. */
static void check_clock(int64_t first_us, int64_t low_us, int64_t period_us)
{
    uint64_t last = 0;
    uint64_t made = 0;

    world.nodes[0].first_time_us = first_us - (int64_t)world.now_us;
    world.nodes[0].time_low_us = low_us;
    world.nodes[0].time_period_us = period_us;
    scene_start();
    for (unsigned i = 0; i < 90; i++) {
        const capture_settings settings = scene_settings();
        capture_frame frame = scene_take();
        uint32_t id;

        replay_check_frame(&world, &settings, &frame, &id);
        if (i > 0) {
            /* One microsecond for a period that is no whole number of them. */
            TEST_ASSERT_UINT64_WITHIN(1, replay_find(&world, id)->made_us - made,
                                      frame.timestamp_us - last);
        }
        made = replay_find(&world, id)->made_us;
        last = frame.timestamp_us;
        capture_give_back(camera, &frame);
    }
}

static void test_timestamp_wraps_at_31_bits_of_seconds(void)
{
    check_clock((INT64_C(1) << 31) * 1000000 - 1500000, 0, (INT64_C(1) << 31) * 1000000);
}

static void test_timestamp_wraps_at_32_bits_of_seconds(void)
{
    check_clock((INT64_C(1) << 31) * 1000000 - 1500000, -(INT64_C(1) << 31) * 1000000,
                (INT64_C(1) << 32) * 1000000);
}

static void test_timestamp_wraps_at_64_bits_of_nanoseconds(void)
{
    check_clock(INT64_C(9223372036854775) - 1500000, -INT64_C(9223372036854776),
                INT64_C(18446744073709552));
}

static void test_timestamp_never_goes_back(void)
{
    capture_frame frame;
    uint64_t last;

    scene_start();
    scene_frames(3);
    frame = scene_take();
    last = frame.timestamp_us;
    capture_give_back(camera, &frame);
    world.nodes[0].first_time_us -= 700000; /* somebody set the clock */
    frame = scene_take();
    TEST_ASSERT_EQUAL_UINT64(last, frame.timestamp_us);
    capture_give_back(camera, &frame);
    frame = scene_take();
    TEST_ASSERT_UINT64_WITHIN(10, 33333, frame.timestamp_us - last);
    capture_give_back(camera, &frame);
    world.nodes[0].broken = 1;
    world.nodes[0].first_time_us -= 10000000;
    last = frame.timestamp_us;
    frame = scene_take();
    TEST_ASSERT_TRUE(frame.timestamp_us >= last);
}

static void test_driver_without_a_clock(void)
{
    capture_frame frame;

    world.nodes[0].no_time = 1;
    scene_start();
    frame = scene_take();
    TEST_ASSERT_EQUAL_UINT64(world.now_us / 1000, frame.timestamp_us / 1000);
}

static void test_newest_skips_stale_frames(void)
{
    capture_frame frame;

    wish.newest = 1;
    scene_start();
    scene_frames(1);
    world.now_us += 115000; /* three more were made: 1, 2, 3 */
    frame = scene_take();
    TEST_ASSERT_EQUAL_UINT64(3, frame.sequence);
    TEST_ASSERT_EQUAL_UINT64(2, scene_counts().stale);
    TEST_ASSERT_EQUAL_UINT64(2, scene_counts().frames);
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().missed);
}

static void test_newest_passes_damaged_ones(void)
{
    static const replay_kind kinds[] = {REPLAY_GOOD, REPLAY_LOST, REPLAY_DAMAGED, REPLAY_GOOD,
                                        REPLAY_SHORT};
    capture_frame frame;

    plan(kinds, 5);
    wish.newest = 1;
    scene_start();
    world.now_us += 150000;
    frame = scene_take();
    TEST_ASSERT_EQUAL_UINT64(3, frame.sequence);
    TEST_ASSERT_EQUAL_UINT32(1, frame.missed);
    TEST_ASSERT_EQUAL_UINT64(1, scene_counts().stale);
    TEST_ASSERT_EQUAL_UINT64(1, scene_counts().damaged);
    TEST_ASSERT_EQUAL_UINT64(1, scene_counts().short_frames);
}

static void test_newest_keeps_what_it_has_when_the_device_fails(void)
{
    static const int errors[] = {EIO, ENODEV, EINVAL};

    for (unsigned i = 0; i < 3; i++) {
        capture_frame frame;

        scene_end();
        scene_begin();
        wish.newest = 1;
        scene_start();
        world.now_us += 40000;
        replay_fail(&world, VIDIOC_DQBUF, 1, 1, errors[i]);
        frame = scene_take();
        TEST_ASSERT_EQUAL_UINT64(0, frame.sequence);
        TEST_ASSERT_EQUAL_UINT64(1, scene_counts().frames);
        scene_check(&frame);
        TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_give_back(camera, &frame));
    }
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
    RUN_TEST(test_frames_arrive_in_order);
    RUN_TEST(test_no_copy_is_made);
    RUN_TEST(test_interrupted_calls_are_repeated);
    RUN_TEST(test_interrupted_wait_keeps_its_deadline);
    RUN_TEST(test_eagain_waits_within_the_deadline);
    RUN_TEST(test_eagain_for_ever_is_a_timeout);
    RUN_TEST(test_timeout_is_a_status);
    RUN_TEST(test_deadline_zero_takes_only_what_is_there);
    RUN_TEST(test_damaged_buffers_do_not_hide_a_good_one);
    RUN_TEST(test_stream_restarts_after_timeouts);
    RUN_TEST(test_timeouts_must_be_in_a_row);
    RUN_TEST(test_impatience_does_not_restart_a_slow_camera);
    RUN_TEST(test_eio_restarts);
    RUN_TEST(test_eio_for_ever_ends_with_the_deadline);
    RUN_TEST(test_stubborn_restart_sets_up_anew);
    RUN_TEST(test_frames_that_are_held_survive_restarts);
    RUN_TEST(test_held_frame_on_a_kernel_that_keeps_mapped_buffers);
    RUN_TEST(test_damaged_and_short_are_dropped_and_counted);
    RUN_TEST(test_short_by_one_byte);
    RUN_TEST(test_only_damaged_frames_are_a_timeout);
    RUN_TEST(test_gaps_are_counted);
    RUN_TEST(test_a_caller_that_is_slow_misses_frames);
    RUN_TEST(test_sequence_wraps);
    RUN_TEST(test_sequence_goes_on_after_a_restart);
    RUN_TEST(test_driver_that_does_not_count);
    RUN_TEST(test_timestamp_wraps_at_31_bits_of_seconds);
    RUN_TEST(test_timestamp_wraps_at_32_bits_of_seconds);
    RUN_TEST(test_timestamp_wraps_at_64_bits_of_nanoseconds);
    RUN_TEST(test_timestamp_never_goes_back);
    RUN_TEST(test_driver_without_a_clock);
    RUN_TEST(test_newest_skips_stale_frames);
    RUN_TEST(test_newest_passes_damaged_ones);
    RUN_TEST(test_newest_keeps_what_it_has_when_the_device_fails);
    RUN_TEST(test_poll_error_restarts);
    RUN_TEST(test_poll_failure_is_said);
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
