#include "knob.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

static int complain(const char *device, const char *what)
{
    printf("# %s: %s: %s\n", device, what, strerror(errno));
    return -1;
}

static int request(const char *device, unsigned long code, void *argument, const char *what)
{
    const int file = open(device, O_RDWR | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) {
        return complain(device, "open");
    }
    const int result = ioctl(file, code, argument);
    if (result < 0) {
        (void)complain(device, what);
    }
    close(file);
    return result < 0 ? -1 : 0;
}

static int find(int file, const char *name, struct v4l2_query_ext_ctrl *found)
{
    memset(found, 0, sizeof *found);
    found->id = V4L2_CTRL_FLAG_NEXT_CTRL;
    while (ioctl(file, VIDIOC_QUERY_EXT_CTRL, found) == 0) {
        if (strcmp(found->name, name) == 0) {
            return 0;
        }
        found->id |= V4L2_CTRL_FLAG_NEXT_CTRL;
    }
    return -1;
}

static int item_index(int file, const struct v4l2_query_ext_ctrl *control, const char *item)
{
    struct v4l2_querymenu menu;
    memset(&menu, 0, sizeof menu);
    menu.id = control->id;
    for (long long index = control->minimum; index <= control->maximum; index++) {
        menu.index = (__u32)index;
        if (ioctl(file, VIDIOC_QUERYMENU, &menu) == 0 && strcmp((char *)menu.name, item) == 0) {
            return (int)index;
        }
    }
    errno = ENOENT;
    return -1;
}

/* Sets to *value, or to the menu's item if there is one, or reads into *value. */
static int turn(const char *device, const char *name, const char *item, int set, int *value)
{
    struct v4l2_query_ext_ctrl control;
    struct v4l2_ext_control one;
    struct v4l2_ext_controls all;
    const int file = open(device, O_RDWR | O_NONBLOCK | O_CLOEXEC);
    int result = -1;
    if (file < 0) {
        return complain(device, name);
    }
    memset(&one, 0, sizeof one);
    memset(&all, 0, sizeof all);
    if (find(file, name, &control) == 0) {
        one.id = control.id;
        one.value = item ? item_index(file, &control, item) : *value;
        all.which = V4L2_CTRL_WHICH_CUR_VAL;
        all.count = 1;
        all.controls = &one;
        if (!item || one.value >= 0) {
            result = ioctl(file, set ? VIDIOC_S_EXT_CTRLS : VIDIOC_G_EXT_CTRLS, &all);
        }
    }
    if (result < 0) {
        (void)complain(device, name);
    }
    *value = one.value;
    close(file);
    return result;
}

int knob_set(const char *device, const char *name, int value)
{
    return turn(device, name, NULL, 1, &value);
}

int knob_get(const char *device, const char *name, int *value)
{
    return turn(device, name, NULL, 0, value);
}

int knob_choose(const char *device, const char *name, const char *item)
{
    int value = 0;
    return turn(device, name, item, 1, &value);
}

int knob_standard(const char *device, v4l2_std_id standard)
{
    return request(device, VIDIOC_S_STD, &standard, "VIDIOC_S_STD");
}

int knob_format(const char *device, struct v4l2_pix_format *format)
{
    struct v4l2_format whole;
    memset(&whole, 0, sizeof whole);
    whole.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    const int result = request(device, VIDIOC_G_FMT, &whole, "VIDIOC_G_FMT");
    *format = whole.fmt.pix;
    return result;
}

int knob_interval(const char *device, struct v4l2_fract *seconds_per_frame)
{
    struct v4l2_streamparm parameters;
    memset(&parameters, 0, sizeof parameters);
    parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    const int result = request(device, VIDIOC_G_PARM, &parameters, "VIDIOC_G_PARM");
    *seconds_per_frame = parameters.parm.capture.timeperframe;
    return result;
}
