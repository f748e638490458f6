/* Device nodes of V4L2: opened only if they are what they should be, and listed. */
#include "v4l2_camera.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/sysmacros.h>

enum { V4L2_MAJOR = 81, NODES_MAX = 256 };

int v4l2_call(v4l2_device *device, unsigned long request, void *argument)
{
    const struct v4l2_calls *const calls = device->calls;
    int result;

    if (device->fd < 0) {
        errno = ENODEV;
        return -1;
    }
    while ((result = calls->ioctl(calls->user, device->fd, request, argument)) < 0 &&
           errno == EINTR) {
        if (device->interrupted) {
            ++*device->interrupted;
        }
    }
    return result < 0 ? -1 : 0;
}

capture_status v4l2_status_of(int error)
{
    switch (error) {
    case ENODEV:
    case ENXIO:
        return CAPTURE_ERR_GONE;
    case EBUSY:
        return CAPTURE_ERR_BUSY;
    case EACCES:
    case EPERM:
        return CAPTURE_ERR_ACCESS;
    default:
        return CAPTURE_ERR_SYSTEM;
    }
}

const char *v4l2_reason(int error, char text[V4L2_REASON_BYTES])
{
    if (strerror_r(error, text, V4L2_REASON_BYTES)) {
        snprintf(text, V4L2_REASON_BYTES, "error %d", error);
    }
    return text;
}

static capture_status refuse(v4l2_device *device, capture_status status, const char *why)
{
    snprintf(device->error, sizeof device->error, "%.200s: %s", device->path, why);
    return status;
}

static capture_status refuse_errno(v4l2_device *device, int error)
{
    char reason[V4L2_REASON_BYTES];
    capture_status status = v4l2_status_of(error);

    if (error == ENOENT || error == ENOTDIR || status == CAPTURE_ERR_GONE) {
        status = CAPTURE_ERR_NONE;
    }
    return refuse(device, status, v4l2_reason(error, reason));
}

static int is_video_node(const struct stat *node)
{
    return S_ISCHR(node->st_mode) && major(node->st_rdev) == V4L2_MAJOR;
}

static int open_repeated(v4l2_device *device)
{
    const struct v4l2_calls *const calls = device->calls;
    int fd;

    while ((fd = calls->open(calls->user, device->path,
                             O_RDWR | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)) < 0 &&
           errno == EINTR) {
        if (device->interrupted) {
            ++*device->interrupted;
        }
    }
    return fd;
}

/* Looks before it opens, since opening alone makes some devices act, and once more at what was
 * opened, which nobody can exchange any more. */
static capture_status open_node(v4l2_device *device)
{
    const struct v4l2_calls *const calls = device->calls;
    struct stat node;

    memset(&node, 0, sizeof node);
    if (calls->stat(calls->user, device->path, &node)) {
        return refuse_errno(device, errno);
    }
    if (!is_video_node(&node)) {
        return refuse(device, CAPTURE_ERR_KIND, "not a video device");
    }
    device->fd = open_repeated(device);
    if (device->fd < 0) {
        return refuse_errno(device, errno);
    }
    memset(&node, 0, sizeof node);
    if (calls->fstat(calls->user, device->fd, &node)) {
        return refuse_errno(device, errno);
    }
    if (!is_video_node(&node)) {
        return refuse(device, CAPTURE_ERR_KIND, "not a video device");
    }
    return CAPTURE_OK;
}

static capture_status read_capability(v4l2_device *device)
{
    struct v4l2_capability capability;
    uint32_t caps;

    memset(&capability, 0, sizeof capability);
    if (v4l2_call(device, VIDIOC_QUERYCAP, &capability)) {
        return errno == ENOTTY || errno == EINVAL
                   ? refuse(device, CAPTURE_ERR_KIND, "not a video device")
                   : refuse_errno(device, errno);
    }
    capture_copy_text(device->card, sizeof device->card, (const char *)capability.card,
                      sizeof capability.card);
    capture_copy_text(device->driver, sizeof device->driver, (const char *)capability.driver,
                      sizeof capability.driver);
    capture_copy_text(device->bus, sizeof device->bus, (const char *)capability.bus_info,
                      sizeof capability.bus_info);
    /* device_caps speaks of this node, capabilities of all nodes of the hardware. */
    caps = capability.capabilities & V4L2_CAP_DEVICE_CAPS ? capability.device_caps
                                                          : capability.capabilities;
    if (!(caps & (V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_VIDEO_CAPTURE_MPLANE)) ||
        !(caps & V4L2_CAP_STREAMING)) {
        return refuse(device, CAPTURE_ERR_KIND, "a video device, but no camera that streams");
    }
    device->queue = caps & V4L2_CAP_VIDEO_CAPTURE ? V4L2_BUF_TYPE_VIDEO_CAPTURE
                                                  : V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE;
    return CAPTURE_OK;
}

capture_status v4l2_device_open(v4l2_device *device)
{
    capture_status status;

    device->fd = -1;
    device->error[0] = '\0';
    device->card[0] = device->driver[0] = device->bus[0] = '\0';
    status = open_node(device);
    if (status == CAPTURE_OK) {
        status = read_capability(device);
    }
    if (status != CAPTURE_OK) {
        v4l2_device_close(device);
    }
    return status;
}

void v4l2_device_close(v4l2_device *device)
{
    if (device->fd >= 0) {
        /* Not repeated after EINTR: Linux has let go of the number by then. */
        device->calls->close(device->calls->user, device->fd);
        device->fd = -1;
    }
}

int v4l2_list(const struct v4l2_calls *calls, uint64_t *interrupted, capture_device *devices,
              size_t max)
{
    size_t found = 0;

    for (unsigned number = 0; number < NODES_MAX; number++) {
        v4l2_device device;
        capture_status status;

        memset(&device, 0, sizeof device);
        device.calls = calls;
        device.interrupted = interrupted;
        snprintf(device.path, sizeof device.path, "/dev/video%u", number);
        status = v4l2_device_open(&device);
        v4l2_device_close(&device);
        if (status != CAPTURE_OK && status != CAPTURE_ERR_ACCESS && status != CAPTURE_ERR_BUSY) {
            continue;
        }
        if (found < max) {
            capture_device *const entry = &devices[found];

            memset(entry, 0, sizeof *entry);
            memcpy(entry->path, device.path, sizeof entry->path);
            memcpy(entry->card, device.card, sizeof entry->card);
            memcpy(entry->driver, device.driver, sizeof entry->driver);
            memcpy(entry->bus, device.bus, sizeof entry->bus);
            entry->status = status;
        }
        found++;
    }
    return (int)found;
}
