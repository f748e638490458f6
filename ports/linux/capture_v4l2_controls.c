/* Controls of V4L2 cameras. */
#include "v4l2_camera.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

enum { CONTROLS_MAX = 1024 }; /* a list that never ends is cut here */

/* The ids of a known control; the first that a camera has is taken. */
static const uint32_t known_ids[CAPTURE_KNOWN_COUNT][2] = {
    {0, 0},
    {V4L2_CID_EXPOSURE_ABSOLUTE, 0},
    {V4L2_CID_EXPOSURE_AUTO, 0},
    {V4L2_CID_GAIN, V4L2_CID_ANALOGUE_GAIN},
    {V4L2_CID_AUTOGAIN, 0},
    {V4L2_CID_WHITE_BALANCE_TEMPERATURE, 0},
    {V4L2_CID_AUTO_WHITE_BALANCE, 0},
    {V4L2_CID_POWER_LINE_FREQUENCY, 0},
};

static v4l2_device *device_of(const capture *camera)
{
    return &v4l2_state(camera)->device;
}

/* The status of a failed call on a control; a camera that is away is let go. */
static capture_status fail(capture *camera, const char *what, int error)
{
    const capture_status status = v4l2_fail(camera, what, error);

    if (status == CAPTURE_ERR_GONE) {
        v4l2_lose(camera);
    }
    return error == ERANGE ? CAPTURE_ERR_ARG : status;
}

static int read_info(capture *camera, uint32_t id, struct v4l2_queryctrl *info)
{
    memset(info, 0, sizeof *info);
    info->id = id;
    return v4l2_call(device_of(camera), VIDIOC_QUERYCTRL, info);
}

static int kind_of(uint32_t type)
{
    switch (type) {
    case V4L2_CTRL_TYPE_INTEGER:
        return CAPTURE_INTEGER;
    case V4L2_CTRL_TYPE_BOOLEAN:
        return CAPTURE_SWITCH;
    case V4L2_CTRL_TYPE_MENU:
    case V4L2_CTRL_TYPE_INTEGER_MENU:
        return CAPTURE_MENU;
    default:
        return -1;
    }
}

static int read_value(capture *camera, uint32_t id, int32_t *value)
{
    struct v4l2_control control;

    memset(&control, 0, sizeof control);
    control.id = id;
    if (v4l2_call(device_of(camera), VIDIOC_G_CTRL, &control)) {
        return -1;
    }
    *value = control.value;
    return 0;
}

/* Buttons, texts and what cannot be read back are none of ours. */
static int is_ours(const struct v4l2_queryctrl *info)
{
    return kind_of(info->type) >= 0 &&
           !(info->flags & (V4L2_CTRL_FLAG_DISABLED | V4L2_CTRL_FLAG_WRITE_ONLY));
}

static capture_known known_of(capture *camera, uint32_t id)
{
    for (int i = 1; i < CAPTURE_KNOWN_COUNT; i++) {
        if (known_ids[i][0] == id ||
            (known_ids[i][1] == id && v4l2_known(camera, (capture_known)i) == id)) {
            return (capture_known)i;
        }
    }
    return (capture_known)0;
}

/* 0 if the value cannot be read. */
static int describe(capture *camera, const struct v4l2_queryctrl *info, capture_control *control)
{
    memset(control, 0, sizeof *control);
    control->id = info->id;
    control->known = known_of(camera, info->id);
    capture_copy_text(control->name, sizeof control->name, (const char *)info->name,
                      sizeof info->name);
    control->kind = (capture_control_kind)kind_of(info->type);
    control->min = info->minimum;
    control->max = info->maximum;
    control->step = info->step;
    control->initial = info->default_value;
    control->read_only = (info->flags & V4L2_CTRL_FLAG_READ_ONLY) != 0;
    control->inactive = (info->flags & V4L2_CTRL_FLAG_INACTIVE) != 0;
    return read_value(camera, info->id, &control->value) == 0;
}

typedef struct control_list {
    capture_control *controls;
    size_t max, count;
} control_list;

static void add_control(capture *camera, control_list *list, const struct v4l2_queryctrl *info)
{
    capture_control control;

    if (!is_ours(info) || !describe(camera, info, &control)) {
        return;
    }
    if (list->count < list->max) {
        list->controls[list->count] = control;
    }
    list->count++;
}

/* Drivers that cannot be asked for the next control: the plain range of ids. */
static void list_by_number(capture *camera, control_list *list)
{
    struct v4l2_queryctrl info;

    for (uint32_t id = V4L2_CID_BASE; id < V4L2_CID_LASTP1; id++) {
        if (read_info(camera, id, &info) == 0) {
            add_control(camera, list, &info);
        }
    }
    for (uint32_t id = V4L2_CID_CAMERA_CLASS_BASE; id < V4L2_CID_CAMERA_CLASS_BASE + 40; id++) {
        if (read_info(camera, id, &info) == 0) {
            add_control(camera, list, &info);
        }
    }
}

int v4l2_controls(capture *camera, capture_control *controls, size_t max)
{
    control_list list = {controls, max, 0};
    struct v4l2_queryctrl info;
    uint32_t last = 0;
    unsigned seen = 0;

    while (seen < CONTROLS_MAX && read_info(camera, last | V4L2_CTRL_FLAG_NEXT_CTRL, &info) == 0 &&
           info.id > last) {
        add_control(camera, &list, &info);
        last = info.id;
        seen++;
    }
    if (seen == 0) {
        list_by_number(camera, &list);
    }
    if (read_info(camera, V4L2_CID_BASE, &info) && errno == ENODEV) {
        return fail(camera, "VIDIOC_QUERYCTRL", ENODEV);
    }
    return (int)list.count;
}

capture_status v4l2_query(capture *camera, uint32_t id, capture_control *control)
{
    struct v4l2_queryctrl info;

    if (read_info(camera, id, &info)) {
        return errno == EINVAL || errno == ENOTTY
                   ? capture_fail(camera, CAPTURE_ERR_NONE, "the camera has no such control")
                   : fail(camera, "VIDIOC_QUERYCTRL", errno);
    }
    if (!is_ours(&info)) {
        return capture_fail(camera, CAPTURE_ERR_NONE, "the camera has no such control");
    }
    return describe(camera, &info, control) ? CAPTURE_OK : fail(camera, "VIDIOC_G_CTRL", errno);
}

capture_status v4l2_menu_item(capture *camera, uint32_t id, int32_t index, char text[32])
{
    struct v4l2_queryctrl info;
    struct v4l2_querymenu item;

    if (read_info(camera, id, &info)) {
        return errno == ENODEV ? fail(camera, "VIDIOC_QUERYCTRL", errno)
                               : capture_fail(camera, CAPTURE_ERR_NONE, "no such control");
    }
    memset(&item, 0, sizeof item);
    item.id = id;
    item.index = (uint32_t)index;
    if (index < 0 || kind_of(info.type) != CAPTURE_MENU ||
        v4l2_call(device_of(camera), VIDIOC_QUERYMENU, &item)) {
        return capture_fail(camera, CAPTURE_ERR_ARG, "the menu has no item %ld", (long)index);
    }
    if (info.type == V4L2_CTRL_TYPE_INTEGER_MENU) {
        int64_t value; /* unaligned in the struct */

        memcpy(&value, &item.value, sizeof value);
        snprintf(text, 32, "%lld", (long long)value);
    } else {
        capture_copy_text(text, 32, (const char *)item.name, sizeof item.name);
    }
    return CAPTURE_OK;
}

capture_status v4l2_get(capture *camera, uint32_t id, int32_t *value)
{
    if (read_value(camera, id, value)) {
        return errno == EINVAL || errno == ENOTTY
                   ? capture_fail(camera, CAPTURE_ERR_NONE, "the camera has no such control")
                   : fail(camera, "VIDIOC_G_CTRL", errno);
    }
    return CAPTURE_OK;
}

capture_status v4l2_set(capture *camera, uint32_t id, int32_t value)
{
    struct v4l2_control control;

    memset(&control, 0, sizeof control);
    control.id = id;
    control.value = value;
    if (v4l2_call(device_of(camera), VIDIOC_S_CTRL, &control)) {
        return fail(camera, "VIDIOC_S_CTRL", errno);
    }
    return CAPTURE_OK;
}

uint32_t v4l2_known(capture *camera, capture_known known)
{
    for (unsigned i = 0; i < 2; i++) {
        struct v4l2_queryctrl info;
        const uint32_t id = known_ids[known][i];

        if (id != 0 && read_info(camera, id, &info) == 0 && is_ours(&info)) {
            return id;
        }
    }
    return 0;
}
