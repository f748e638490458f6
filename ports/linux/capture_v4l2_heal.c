/* What a camera does wrong while it streams, and how it is brought back. */
#include "v4l2_camera.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { REOPEN_PAUSE_MS = 100, RESTART_PAUSE_MS = 50, STUBBORN_MS = 3000 };

unsigned v4l2_return_ms(const capture *camera)
{
    const unsigned wished = camera->wish.return_ms;

    /* One that is there and was closed by us is opened again without being asked. */
    return v4l2_state(camera)->stubborn && wished < STUBBORN_MS ? STUBBORN_MS : wished;
}

void v4l2_lose(capture *camera)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);

    if (v4l2->lost) {
        return;
    }
    v4l2->lost = 1;
    v4l2->lost_us = v4l2_now_us(camera);
    v4l2->retry_us = 0;
    v4l2->restart_due = 0;
    v4l2->stubborn = 0;
    v4l2_device_close(&v4l2->device);
    v4l2_end_stream(camera, 1);
}

void v4l2_want_restart(capture *camera)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);

    if (!v4l2->restart_due) {
        v4l2->restart_due = 1;
        /* At once the first time; not in a tight loop if that does not help. */
        v4l2->retry_us =
            v4l2->failures == 0 ? 0 : v4l2_now_us(camera) + (uint64_t)RESTART_PAUSE_MS * 1000;
    }
}

void v4l2_trouble(capture *camera, const char *what, int error)
{
    v4l2_fail(camera, what, error);
    if (v4l2_status_of(error) == CAPTURE_ERR_GONE) {
        v4l2_lose(camera);
    } else {
        v4l2_want_restart(camera);
    }
}

/* ---- The device that comes back ------------------------------------------------------------ */

static int is_same_model(const capture *camera, const char *card, const char *driver)
{
    return strcmp(card, camera->settings.card) == 0 && strcmp(driver, camera->settings.driver) == 0;
}

/* The node that is the camera now: on the same bus, or, if the wish named no path, wherever there
 * is one of its name. 1 and *device set up to be opened. */
static int find_moved(capture *camera, v4l2_device *device)
{
    enum { LIST_MAX = 64 };
    const v4l2_camera *const v4l2 = v4l2_state(camera);
    capture_device *const list = (capture_device *)calloc(LIST_MAX, sizeof *list);
    const capture_device *found = NULL;
    int count;

    if (!list) {
        return 0;
    }
    count = v4l2_list(camera->calls, &camera->counts.interrupted, list, LIST_MAX);
    for (int i = 0; i < count && i < LIST_MAX; i++) {
        const int same =
            list[i].status == CAPTURE_OK && is_same_model(camera, list[i].card, list[i].driver);

        if (same && camera->settings.bus[0] && strcmp(list[i].bus, camera->settings.bus) == 0) {
            found = &list[i];
            break;
        }
        if (same && v4l2->named && !found) {
            found = &list[i];
        }
    }
    if (found) {
        memcpy(device->path, found->path, sizeof device->path);
    }
    free(list);
    return found != NULL;
}

static int open_again(capture *camera, v4l2_device *device)
{
    if (v4l2_device_open(device) != CAPTURE_OK) {
        return 0;
    }
    if (!is_same_model(camera, device->card, device->driver)) {
        v4l2_device_close(device);
        return 0;
    }
    return 1;
}

/* The settings of before: format and size exactly, rate and controls as far as they go. */
static capture_status set_again(capture *camera)
{
    const capture_status status = v4l2_confirm_format(camera);

    if (status != CAPTURE_OK) {
        return status;
    }
    v4l2_set_rate(camera);
    for (unsigned i = 0; i < camera->kept_count; i++) {
        v4l2_set(camera, camera->kept[i].id, camera->kept[i].value);
    }
    camera->error[0] = '\0';
    return CAPTURE_OK;
}

capture_status v4l2_reopen(capture *camera)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    v4l2_device device = v4l2->device;
    capture_status status;

    if (!open_again(camera, &device) &&
        !(find_moved(camera, &device) && open_again(camera, &device))) {
        return capture_fail(camera, CAPTURE_ERR_GONE, "%.200s: unplugged", v4l2->device.path);
    }
    v4l2->device = device;
    v4l2->allocated = 0; /* nothing outlives the closing */
    status = set_again(camera);
    if (status != CAPTURE_OK) {
        v4l2_device_close(&v4l2->device);
        memcpy(v4l2->device.path, camera->settings.path, sizeof v4l2->device.path);
        return status;
    }
    v4l2->lost = 0;
    v4l2->stubborn = 0;
    v4l2->restart_due = 0;
    memcpy(camera->settings.path, device.path, sizeof camera->settings.path);
    memcpy(camera->settings.bus, device.bus, sizeof camera->settings.bus);
    return CAPTURE_OK;
}

static void try_return(capture *camera)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    const uint64_t lost_us = v4l2->lost_us;
    const int stubborn = v4l2->stubborn;

    v4l2->retry_us = v4l2_now_us(camera) + (uint64_t)REOPEN_PAUSE_MS * 1000;
    if (v4l2_reopen(camera) == CAPTURE_OK && v4l2_begin_stream(camera) == CAPTURE_OK) {
        camera->counts.reopens++;
        return;
    }
    /* Not yet: it is still away since then. */
    v4l2_device_close(&v4l2->device);
    v4l2->lost = 1;
    v4l2->stubborn = stubborn;
    v4l2->lost_us = lost_us;
}

static capture_status wait_for_return(capture *camera, uint64_t deadline_us)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    const unsigned return_ms = v4l2_return_ms(camera);
    const uint64_t end_us = v4l2->lost_us + (uint64_t)return_ms * 1000;

    while (v4l2->lost) {
        const uint64_t now = v4l2_now_us(camera);

        if (now >= v4l2->retry_us && return_ms > 0) {
            try_return(camera);
        } else if (now >= end_us) {
            v4l2->gone = 1;
            return capture_fail(camera, CAPTURE_ERR_GONE, "%.200s: unplugged", v4l2->device.path);
        } else if (now >= deadline_us) {
            return CAPTURE_TIMEOUT;
        } else {
            const uint64_t until = v4l2->retry_us < end_us ? v4l2->retry_us : end_us;

            v4l2_pause(camera, REOPEN_PAUSE_MS, until < deadline_us ? until : deadline_us);
        }
    }
    return CAPTURE_OK;
}

/* ---- The stream that stands still ---------------------------------------------------------- */

/* First the gentle way, which keeps the buffers; if that was no help, all anew. */
static capture_status try_restart(capture *camera)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    capture_status status;

    v4l2->failures++;
    if (v4l2->failures == 1 && v4l2->count > 0) {
        status = v4l2_cycle_stream(camera);
    } else {
        v4l2_end_stream(camera, 1);
        if (v4l2->lost) {
            return CAPTURE_ERR_GONE;
        }
        status = v4l2_begin_stream(camera);
    }
    if (status == CAPTURE_OK) {
        v4l2->restart_due = 0;
        camera->counts.restarts++;
    } else if (status == CAPTURE_ERR_GONE) {
        v4l2_lose(camera);
    } else {
        v4l2->retry_us = v4l2_now_us(camera) + (uint64_t)RESTART_PAUSE_MS * 1000;
    }
    return status;
}

static capture_status restart(capture *camera, uint64_t deadline_us)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    capture_status status = CAPTURE_TIMEOUT;

    while (v4l2->restart_due && !v4l2->lost) {
        const uint64_t now = v4l2_now_us(camera);

        if (now >= v4l2->retry_us) {
            status = try_restart(camera);
        } else if (now >= deadline_us) {
            return status;
        } else {
            v4l2_pause(camera, RESTART_PAUSE_MS,
                       v4l2->retry_us < deadline_us ? v4l2->retry_us : deadline_us);
        }
    }
    return CAPTURE_OK;
}

capture_status v4l2_heal(capture *camera, uint64_t deadline_us)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    capture_status status = CAPTURE_OK;

    while (status == CAPTURE_OK && (v4l2->lost || v4l2->restart_due)) {
        status = v4l2->lost ? wait_for_return(camera, deadline_us) : restart(camera, deadline_us);
    }
    return status;
}
