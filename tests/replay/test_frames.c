/* What is delivered: no damaged frame, no wrong number, no wrong time. */
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

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_damaged_buffers_do_not_hide_a_good_one);
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
    return UNITY_END();
}
