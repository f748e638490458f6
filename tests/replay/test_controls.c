/* Controls: listed, set, and read back instead of believed. */
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

static replay_control *add(uint32_t id, uint32_t type)
{
    replay_control *const control = &world.nodes[0].controls[world.nodes[0].control_count++];

    control->id = id;
    control->type = type;
    control->min = 0;
    control->max = 10;
    control->step = 1;
    strcpy(control->name, "Added");
    return control;
}

static void test_list(void)
{
    capture_control controls[8];

    add(V4L2_CID_AUTO_WHITE_BALANCE, V4L2_CTRL_TYPE_BOOLEAN)->flags = V4L2_CTRL_FLAG_INACTIVE;
    add(V4L2_CID_BRIGHTNESS, V4L2_CTRL_TYPE_INTEGER)->flags = V4L2_CTRL_FLAG_READ_ONLY;
    add(V4L2_CID_DO_WHITE_BALANCE, V4L2_CTRL_TYPE_BUTTON);
    add(V4L2_CID_CONTRAST, V4L2_CTRL_TYPE_INTEGER)->flags = V4L2_CTRL_FLAG_DISABLED;
    add(V4L2_CID_CAMERA_CLASS, V4L2_CTRL_TYPE_CTRL_CLASS);
    scene_open();
    TEST_ASSERT_EQUAL_INT(5, capture_controls(camera, controls, 8));
    TEST_ASSERT_EQUAL_HEX32(V4L2_CID_BRIGHTNESS, controls[0].id); /* in the order of ids */
    TEST_ASSERT_EQUAL_INT(1, controls[0].read_only);
    TEST_ASSERT_EQUAL_INT(0, controls[0].known);
    TEST_ASSERT_EQUAL_INT(CAPTURE_AUTO_WHITE_BALANCE, controls[1].known);
    TEST_ASSERT_EQUAL_INT(CAPTURE_SWITCH, controls[1].kind);
    TEST_ASSERT_EQUAL_INT(1, controls[1].inactive);
    TEST_ASSERT_EQUAL_INT(CAPTURE_GAIN, controls[2].known);
    TEST_ASSERT_EQUAL_STRING("Gain", controls[2].name);
    TEST_ASSERT_EQUAL_INT32(0, controls[2].min);
    TEST_ASSERT_EQUAL_INT32(100, controls[2].max);
    TEST_ASSERT_EQUAL_INT32(1, controls[2].step);
    TEST_ASSERT_EQUAL_INT32(50, controls[2].initial);
    TEST_ASSERT_EQUAL_INT32(50, controls[2].value);
    TEST_ASSERT_EQUAL_INT(CAPTURE_POWER_LINE, controls[3].known);
    TEST_ASSERT_EQUAL_INT(CAPTURE_MENU, controls[3].kind);
    TEST_ASSERT_EQUAL_INT(CAPTURE_EXPOSURE, controls[4].known);
    memset(controls, 0x55, sizeof controls);
    TEST_ASSERT_EQUAL_INT(5, capture_controls(camera, controls, 2));
    TEST_ASSERT_EQUAL_HEX32(0x55555555, controls[2].id);
    TEST_ASSERT_EQUAL_INT(5, capture_controls(camera, NULL, 0));
}

static void test_driver_that_cannot_be_asked_for_the_next(void)
{
    capture_control controls[8];

    world.nodes[0].no_next_control = 1;
    scene_open();
    TEST_ASSERT_EQUAL_INT(3, capture_controls(camera, controls, 8));
    TEST_ASSERT_EQUAL_INT(CAPTURE_EXPOSURE, controls[2].known);
}

static void test_enumeration_that_fails(void)
{
    capture_control controls[8];

    scene_open();
    replay_fail(&world, VIDIOC_QUERYCTRL, 1, 1, EIO); /* after the first */
    TEST_ASSERT_TRUE(capture_controls(camera, controls, 8) <= 3);
    replay_fail(&world, VIDIOC_G_CTRL, 0, 1, EIO); /* one cannot be read */
    TEST_ASSERT_EQUAL_INT(2, capture_controls(camera, controls, 8));
    replay_fail(&world, VIDIOC_QUERYCTRL, 0, 1000, ENODEV);
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_GONE, capture_controls(camera, controls, 8));
}

static void test_known_ids(void)
{
    scene_open();
    TEST_ASSERT_EQUAL_HEX32(V4L2_CID_GAIN, capture_control_id(camera, CAPTURE_GAIN));
    TEST_ASSERT_EQUAL_HEX32(V4L2_CID_EXPOSURE_ABSOLUTE,
                            capture_control_id(camera, CAPTURE_EXPOSURE));
    TEST_ASSERT_EQUAL_HEX32(0, capture_control_id(camera, CAPTURE_AUTO_GAIN));
    TEST_ASSERT_EQUAL_HEX32(0, capture_control_id(camera, (capture_known)0));
    TEST_ASSERT_EQUAL_HEX32(0, capture_control_id(camera, CAPTURE_KNOWN_COUNT));
    TEST_ASSERT_EQUAL_HEX32(0, capture_control_id(NULL, CAPTURE_GAIN));
    add(V4L2_CID_ANALOGUE_GAIN, V4L2_CTRL_TYPE_INTEGER);
    TEST_ASSERT_EQUAL_HEX32(V4L2_CID_GAIN, capture_control_id(camera, CAPTURE_GAIN));
    world.nodes[0].controls[0].id = V4L2_CID_BRIGHTNESS; /* now there is only the other */
    TEST_ASSERT_EQUAL_HEX32(V4L2_CID_ANALOGUE_GAIN, capture_control_id(camera, CAPTURE_GAIN));
}

static void test_set_and_read_back(void)
{
    int32_t value = -1;

    scene_open();
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_set(camera, V4L2_CID_GAIN, 73, &value));
    TEST_ASSERT_EQUAL_INT32(73, value);
    TEST_ASSERT_EQUAL_INT32(73, world.nodes[0].controls[0].value);
    value = -1;
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_get(camera, V4L2_CID_GAIN, &value));
    TEST_ASSERT_EQUAL_INT32(73, value);
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_set(camera, V4L2_CID_GAIN, 0, NULL));
}

static void test_ignored_value_is_reported(void)
{
    int32_t value = -1;

    scene_open();
    world.nodes[0].controls[0].ignored = 1;
    TEST_ASSERT_EQUAL_INT(CAPTURE_CHANGED, capture_set(camera, V4L2_CID_GAIN, 73, &value));
    TEST_ASSERT_EQUAL_INT32(50, value);
    TEST_ASSERT_EQUAL_STRING("Gain: 73 was asked for and is 50", capture_error(camera));
}

static void test_rounded_value_is_reported(void)
{
    int32_t value = -1;

    scene_open();
    world.nodes[0].controls[0].step = 10;
    TEST_ASSERT_EQUAL_INT(CAPTURE_CHANGED, capture_set(camera, V4L2_CID_GAIN, 73, &value));
    TEST_ASSERT_EQUAL_INT32(70, value);
}

static void test_refusals(void)
{
    int32_t value = -1;

    scene_open();
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_set(camera, V4L2_CID_GAIN, 101, &value));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_set(camera, V4L2_CID_GAIN, -1, &value));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_NONE, capture_set(camera, V4L2_CID_HUE, 1, &value));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_NONE, capture_get(camera, V4L2_CID_HUE, &value));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_get(camera, V4L2_CID_GAIN, NULL));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_get(NULL, V4L2_CID_GAIN, &value));
    add(V4L2_CID_BRIGHTNESS, V4L2_CTRL_TYPE_INTEGER)->flags = V4L2_CTRL_FLAG_READ_ONLY;
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_set(camera, V4L2_CID_BRIGHTNESS, 1, &value));
    add(V4L2_CID_DO_WHITE_BALANCE, V4L2_CTRL_TYPE_BUTTON);
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_NONE,
                          capture_set(camera, V4L2_CID_DO_WHITE_BALANCE, 1, &value));
    TEST_ASSERT_EQUAL_INT32(-1, value);
    TEST_ASSERT_EQUAL_INT32(50, world.nodes[0].controls[0].value);
}

static void test_driver_that_refuses(void)
{
    static const int errors[] = {EBUSY, EACCES, ERANGE, EIO, EINVAL};
    static const capture_status statuses[] = {CAPTURE_ERR_BUSY, CAPTURE_ERR_ACCESS, CAPTURE_ERR_ARG,
                                              CAPTURE_ERR_SYSTEM, CAPTURE_ERR_SYSTEM};

    scene_open();
    for (unsigned i = 0; i < 5; i++) {
        world.nodes[0].controls[0].error = errors[i];
        TEST_ASSERT_EQUAL_INT(statuses[i], capture_set(camera, V4L2_CID_GAIN, 5, NULL));
        TEST_ASSERT_NOT_NULL(strstr(capture_error(camera), "VIDIOC_S_CTRL"));
    }
    world.nodes[0].controls[0].error = 0;
    replay_fail(&world, VIDIOC_G_CTRL, 1, 1, EIO); /* the reading back */
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_SYSTEM, capture_set(camera, V4L2_CID_GAIN, 5, NULL));
}

static void test_menu(void)
{
    char text[32];

    scene_open();
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK,
                          capture_menu_item(camera, V4L2_CID_POWER_LINE_FREQUENCY, 1, text));
    TEST_ASSERT_EQUAL_STRING("50 Hz", text);
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG,
                          capture_menu_item(camera, V4L2_CID_POWER_LINE_FREQUENCY, 3, text));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG,
                          capture_menu_item(camera, V4L2_CID_POWER_LINE_FREQUENCY, -1, text));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_menu_item(camera, V4L2_CID_GAIN, 0, text));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_NONE, capture_menu_item(camera, V4L2_CID_HUE, 0, text));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG,
                          capture_menu_item(camera, V4L2_CID_POWER_LINE_FREQUENCY, 1, NULL));
    TEST_ASSERT_EQUAL_STRING("", text);
}

static void test_while_streaming(void)
{
    scene_start();
    for (int32_t i = 0; i < 20; i++) {
        scene_frames(1);
        TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_set(camera, V4L2_CID_GAIN, i, NULL));
    }
    TEST_ASSERT_EQUAL_UINT64(0, scene_counts().missed);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_list);
    RUN_TEST(test_driver_that_cannot_be_asked_for_the_next);
    RUN_TEST(test_enumeration_that_fails);
    RUN_TEST(test_known_ids);
    RUN_TEST(test_set_and_read_back);
    RUN_TEST(test_ignored_value_is_reported);
    RUN_TEST(test_rounded_value_is_reported);
    RUN_TEST(test_refusals);
    RUN_TEST(test_driver_that_refuses);
    RUN_TEST(test_menu);
    RUN_TEST(test_while_streaming);
    return UNITY_END();
}
