#include "scene.h"

#include <string.h>

#include <unity.h>

replay world;
capture *camera;
capture_wish wish;

void scene_begin(void)
{
    replay_init(&world);
    camera = NULL;
    memset(&wish, 0, sizeof wish);
    wish.device = "/dev/video0";
    wish.width = 32;
    wish.height = 24;
}

void scene_end(void)
{
    capture_close(camera);
    camera = NULL;
    TEST_ASSERT_EQUAL_UINT_MESSAGE(0, replay_open_count(&world), "open descriptors");
    TEST_ASSERT_EQUAL_UINT_MESSAGE(0, replay_map_count(&world), "maps");
    TEST_ASSERT_EQUAL_UINT_MESSAGE(0, replay_queued_count(&world), "queued buffers");
    TEST_ASSERT_EQUAL_UINT_MESSAGE(0, replay_buffer_count(&world), "buffers");
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, world.misuse, "misuse");
    replay_free(&world);
}

void scene_open(void)
{
    TEST_ASSERT_EQUAL_INT_MESSAGE(CAPTURE_OK, capture_open(&wish, &world.calls, &camera),
                                  capture_error(camera));
}

void scene_start(void)
{
    capture_status status;

    if (!camera) {
        scene_open();
    }
    status = capture_start(camera);
    TEST_ASSERT_EQUAL_INT_MESSAGE(CAPTURE_OK, status, capture_error(camera));
}

void scene_next(unsigned deadline_ms, capture_status expected)
{
    capture_frame frame;
    const capture_status status = capture_next(camera, deadline_ms, &frame);

    TEST_ASSERT_EQUAL_STRING_MESSAGE(capture_status_name(expected), capture_status_name(status),
                                     capture_error(camera));
    TEST_ASSERT_NULL(frame.bytes);
}

void scene_check(const capture_frame *frame)
{
    const capture_settings settings = scene_settings();
    uint32_t id;
    const char *const wrong = replay_check_frame(&world, &settings, frame, &id);

    TEST_ASSERT_NULL_MESSAGE(wrong, wrong);
}

capture_frame scene_take(void)
{
    capture_frame frame;
    const capture_status status = capture_next(camera, 1000, &frame);

    TEST_ASSERT_EQUAL_STRING_MESSAGE("ok", capture_status_name(status), capture_error(camera));
    scene_check(&frame);
    return frame;
}

void scene_frames(unsigned count)
{
    for (unsigned i = 0; i < count; i++) {
        capture_frame frame = scene_take();

        TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_give_back(camera, &frame));
        TEST_ASSERT_NULL(frame.bytes);
    }
}

capture_counts scene_counts(void)
{
    capture_counts counts;

    capture_get_counts(camera, &counts);
    return counts;
}

capture_settings scene_settings(void)
{
    capture_settings settings;

    capture_get_settings(camera, &settings);
    return settings;
}
