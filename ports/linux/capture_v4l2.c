/* The V4L2 backend: finds and opens cameras, and takes frames out of their streams. */
#include "v4l2_camera.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

v4l2_camera *v4l2_state(const capture *camera)
{
    return (v4l2_camera *)camera->state;
}

uint64_t v4l2_now_us(const capture *camera)
{
    return camera->calls->now_us(camera->calls->user);
}

capture_status v4l2_fail(capture *camera, const char *what, int error)
{
    char reason[V4L2_REASON_BYTES];

    return capture_fail(camera, v4l2_status_of(error), "%.200s: %s: %s",
                        v4l2_state(camera)->device.path, what, v4l2_reason(error, reason));
}

/* ---- Finding a camera ---------------------------------------------------------------------- */

/* Several nodes on one bus with one name are one camera. */
static int is_same_camera(const capture_device *a, const capture_device *b)
{
    return strcmp(a->card, b->card) == 0 && strcmp(a->bus, b->bus) == 0;
}

/* How well a device answers to a name: 3 its bus, 2 its whole name, 1 a part of it, 0 not. */
static int match(const capture_device *device, const char *name)
{
    if (device->status != CAPTURE_OK) {
        return 0;
    }
    if (strcmp(device->bus, name) == 0) {
        return 3;
    }
    if (strcmp(device->card, name) == 0) {
        return 2;
    }
    return strstr(device->card, name) != NULL;
}

/* The best match of a name, which no other camera may equal. */
static capture_status find_named(capture *camera, const capture_device *list, int count,
                                 const capture_device **found)
{
    const char *const name = camera->wish.device;
    const capture_device *other = NULL;
    int best = 0;

    *found = NULL;
    for (int i = 0; i < count; i++) {
        const int quality = match(&list[i], name);

        if (quality > best) {
            best = quality;
            *found = &list[i];
            other = NULL;
        } else if (quality > 0 && quality == best && !is_same_camera(&list[i], *found)) {
            other = &list[i];
        }
    }
    if (!*found) {
        return capture_fail(camera, CAPTURE_ERR_NONE, "there is no camera \"%.200s\"", name);
    }
    if (other) {
        return capture_fail(camera, CAPTURE_ERR_NONE,
                            "\"%.100s\" is the name of %.50s and of %.50s: give the path", name,
                            (*found)->path, other->path);
    }
    return CAPTURE_OK;
}

/* ---- Opening ------------------------------------------------------------------------------- */

static void take_device_names(capture *camera)
{
    const v4l2_device *const device = &v4l2_state(camera)->device;
    capture_settings *const settings = &camera->settings;

    memcpy(settings->path, device->path, sizeof settings->path);
    memcpy(settings->card, device->card, sizeof settings->card);
    memcpy(settings->driver, device->driver, sizeof settings->driver);
    memcpy(settings->bus, device->bus, sizeof settings->bus);
}

static capture_status open_path(capture *camera, const char *path)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    capture_status status;

    snprintf(v4l2->device.path, sizeof v4l2->device.path, "%s", path);
    status = v4l2_device_open(&v4l2->device);
    take_device_names(camera);
    if (status != CAPTURE_OK) {
        return capture_fail(camera, status, "%s", v4l2->device.error);
    }
    status = v4l2_negotiate(camera);
    if (status == CAPTURE_ERR_BUSY) {
        camera->looking = 1; /* stays open for those who only want to know what it is */
    } else if (status < 0) {
        v4l2_device_close(&v4l2->device);
    }
    return status;
}

/* The first camera whose frames can be read. What kept the first ones from being it is said if
 * there is none. */
static capture_status open_first(capture *camera, const capture_device *list, int count)
{
    capture_status status = CAPTURE_ERR_NONE;

    for (int i = 0; i < count; i++) {
        status = open_path(camera, list[i].path);
        if (status != CAPTURE_ERR_FORMAT && status != CAPTURE_ERR_KIND &&
            status != CAPTURE_ERR_NONE && status != CAPTURE_ERR_ACCESS) {
            return status;
        }
    }
    if (count == 0) {
        return capture_fail(camera, CAPTURE_ERR_NONE, "there is no camera");
    }
    return status;
}

static capture_status open_listed(capture *camera)
{
    enum { LIST_MAX = 256 };
    capture_device *const list = (capture_device *)calloc(LIST_MAX, sizeof *list);
    const capture_device *found;
    capture_status status;
    int count;

    if (!list) {
        return capture_fail(camera, CAPTURE_ERR_SYSTEM, "not enough memory");
    }
    count = v4l2_list(camera->calls, &camera->counts.interrupted, list, LIST_MAX);
    if (camera->wish.device) {
        status = find_named(camera, list, count, &found);
        if (status == CAPTURE_OK) {
            status = open_path(camera, found->path);
        }
    } else {
        status = open_first(camera, list, count);
    }
    free(list);
    return status;
}

static capture_status v4l2_open(capture *camera)
{
    v4l2_camera *const v4l2 = (v4l2_camera *)calloc(1, sizeof *v4l2);

    if (!v4l2) {
        return capture_fail(camera, CAPTURE_ERR_SYSTEM, "not enough memory");
    }
    camera->state = v4l2;
    v4l2->device.calls = camera->calls;
    v4l2->device.interrupted = &camera->counts.interrupted;
    v4l2->device.fd = -1;
    camera->settings.buffers = camera->wish.buffers;
    if (camera->wish.device && camera->wish.device[0] == '/') {
        return open_path(camera, camera->wish.device);
    }
    v4l2->named = 1;
    return open_listed(camera);
}

static void v4l2_close(capture *camera)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);

    if (v4l2) {
        v4l2_device_close(&v4l2->device);
        free(v4l2);
        camera->state = NULL;
    }
}

/* ---- Streaming ----------------------------------------------------------------------------- */

static capture_status v4l2_start(capture *camera)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    const int was_lost = v4l2->lost;
    capture_status status = CAPTURE_OK;

    if (v4l2->gone || (v4l2->lost && v4l2_return_ms(camera) == 0)) {
        return capture_fail(camera, CAPTURE_ERR_GONE, "%.200s: unplugged", v4l2->device.path);
    }
    memset(&v4l2->track, 0, sizeof v4l2->track);
    v4l2->restart_due = 0;
    v4l2->failures = 0;
    if (v4l2->lost) {
        status = v4l2_reopen(camera);
    }
    if (status == CAPTURE_OK) {
        status = v4l2_begin_stream(camera);
        if (status == CAPTURE_ERR_GONE) {
            v4l2_lose(camera);
        }
    }
    if (status == CAPTURE_OK && was_lost) {
        camera->counts.reopens++;
    }
    return status;
}

static capture_status v4l2_stop(capture *camera)
{
    v4l2_end_stream(camera, 0);
    return CAPTURE_OK;
}

void v4l2_pause(capture *camera, unsigned most_ms, uint64_t until_us)
{
    const uint64_t now = v4l2_now_us(camera);
    const uint64_t left_ms = until_us > now ? (until_us - now + 999) / 1000 : 0;
    const int ms = (int)(left_ms < most_ms ? left_ms : most_ms);

    if (camera->calls->poll(camera->calls->user, NULL, 0, ms) < 0 && errno == EINTR) {
        camera->counts.interrupted++; /* callers look at the clock again */
    }
}

/* Waits for the driver to have something to say. CAPTURE_OK and *events; CAPTURE_TIMEOUT. */
static capture_status wait_for_events(capture *camera, uint64_t deadline_us, short *events)
{
    for (;;) {
        const uint64_t now = v4l2_now_us(camera);
        const uint64_t left_ms = deadline_us > now ? (deadline_us - now + 999) / 1000 : 0;
        struct pollfd fd;
        int ready;

        fd.fd = v4l2_state(camera)->device.fd;
        fd.events = POLLIN;
        fd.revents = 0;
        ready = camera->calls->poll(camera->calls->user, &fd, 1,
                                    left_ms < 3600000 ? (int)left_ms : 3600000);
        *events = fd.revents;
        if (ready > 0) {
            return CAPTURE_OK;
        }
        if (ready == 0 && v4l2_now_us(camera) >= deadline_us) {
            return CAPTURE_TIMEOUT;
        }
        if (ready < 0 && errno == EINTR) {
            camera->counts.interrupted++;
        } else if (ready < 0 && errno != EAGAIN) {
            return v4l2_fail(camera, "poll", errno);
        }
    }
}

/* How long a stream may be silent before time-outs restart it: impatient callers must not keep a
 * slow camera from ever giving its first frame. */
static uint64_t patience_us(const capture *camera)
{
    const capture_settings *const settings = &camera->settings;
    const uint64_t least_us = 1000000;
    const uint64_t four_frames_us =
        settings->rate_num > 0 ? UINT64_C(4000000) * settings->rate_den / settings->rate_num : 0;

    return four_frames_us > least_us ? four_frames_us : least_us;
}

static capture_status timed_out(capture *camera, unsigned deadline_ms)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);

    if (deadline_ms == 0) { /* nobody waited */
        return CAPTURE_TIMEOUT;
    }
    camera->counts.timeouts++;
    v4l2->quiet++;
    if (!v4l2->lost && v4l2->quiet >= camera->wish.restart_after &&
        v4l2_now_us(camera) - v4l2->heard_us >= patience_us(camera)) {
        v4l2_want_restart(camera);
    }
    return CAPTURE_TIMEOUT;
}

/* Exchanges the frame for newer ones as long as there are any. */
static void skip_to_newest(capture *camera, capture_frame *frame)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    v4l2_outcome outcome = V4L2_FRAME;

    for (unsigned i = 0; i < v4l2->count && outcome != V4L2_NOTHING && outcome != V4L2_TROUBLE &&
                         !v4l2->restart_due;
         i++) {
        v4l2_filled newer;

        outcome = v4l2_dequeue(camera, &newer);
        if (outcome == V4L2_FRAME) {
            const capture_frame stale = *frame;

            v4l2_hand_out(camera, &newer, frame);
            v4l2_give_back(camera, &stale);
            camera->counts.stale++;
        }
    }
}

static void deliver(capture *camera, const v4l2_filled *filled, capture_frame *frame)
{
    v4l2_track *const track = &v4l2_state(camera)->track;

    v4l2_hand_out(camera, filled, frame);
    if (camera->wish.newest) {
        skip_to_newest(camera, frame);
    }
    frame->missed = track->missed;
    track->missed = 0;
    camera->counts.frames++;
}

/* Takes what the driver has. CAPTURE_OK: a frame; CAPTURE_CHANGED: something happened, look again;
 * CAPTURE_TIMEOUT: nothing there. */
static capture_status take(capture *camera, short events, capture_frame *frame)
{
    v4l2_filled filled;

    switch (v4l2_dequeue(camera, &filled)) {
    case V4L2_FRAME:
        deliver(camera, &filled, frame);
        return CAPTURE_OK;
    case V4L2_NOTHING:
        if ((events & (POLLERR | POLLHUP)) && !(events & POLLIN)) {
            v4l2_trouble(camera, "the stream has stopped", EIO);
            return CAPTURE_CHANGED;
        }
        return CAPTURE_TIMEOUT;
    case V4L2_DROPPED:
    case V4L2_TROUBLE:
        break;
    }
    return CAPTURE_CHANGED;
}

/* One turn of looking for a frame; as `take`, or a status for the caller. */
static capture_status look(capture *camera, uint64_t deadline_us, capture_frame *frame)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    capture_status status = v4l2_heal(camera, deadline_us);
    short events = 0;

    if (status != CAPTURE_OK) {
        return status;
    }
    if (v4l2->held >= v4l2->count) {
        return capture_fail(camera, CAPTURE_ERR_ORDER, "every buffer is with the caller");
    }
    status = wait_for_events(camera, deadline_us, &events);
    if (status != CAPTURE_OK) {
        return status;
    }
    status = take(camera, events, frame);
    if (status == CAPTURE_TIMEOUT) { /* said to be ready, but was not */
        v4l2_pause(camera, 1, deadline_us);
        status = CAPTURE_CHANGED;
    }
    return status;
}

static capture_status v4l2_next(capture *camera, unsigned deadline_ms, capture_frame *frame)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    const uint64_t deadline_us = v4l2_now_us(camera) + (uint64_t)deadline_ms * 1000;
    unsigned late =
        0; /* turns after the deadline: to pass bad buffers that lie before a good one */
    capture_status status = CAPTURE_CHANGED;

    if (v4l2->gone) {
        return capture_fail(camera, CAPTURE_ERR_GONE, "%.200s: unplugged", v4l2->device.path);
    }
    while (status == CAPTURE_CHANGED) {
        status = look(camera, deadline_us, frame);
        if (status == CAPTURE_CHANGED && v4l2_now_us(camera) >= deadline_us &&
            ++late > CAPTURE_BUFFERS_MAX) {
            status = CAPTURE_TIMEOUT;
        }
    }
    return status == CAPTURE_TIMEOUT ? timed_out(camera, deadline_ms) : status;
}

static int list_cameras(const struct v4l2_calls *calls, capture_device *devices, size_t max)
{
    return v4l2_list(calls, NULL, devices, max);
}

const struct capture_ops *capture_v4l2_ops(void)
{
    static const struct capture_ops ops = {
        v4l2_open,      v4l2_close,    v4l2_start,     v4l2_stop,    v4l2_next,
        v4l2_give_back, v4l2_controls, v4l2_menu_item, v4l2_query,   v4l2_get,
        v4l2_set,       v4l2_known,    v4l2_modes,     list_cameras,
    };

    return &ops;
}
