/* The front of all cameras: checks arguments, keeps what every backend needs, hands on. */
#include "backend.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BUFFERS_DEFAULT = 4, RESTART_DEFAULT = 3 };

static const struct capture_ops *ops_of(capture_backend backend)
{
    if (backend == CAPTURE_V4L2) {
        return capture_v4l2_ops();
    }
#ifdef CAPTURE_HAVE_LIBCAMERA
    if (backend == CAPTURE_LIBCAMERA) {
        return capture_libcamera_ops();
    }
#endif
    return NULL;
}

int capture_has_backend(capture_backend backend)
{
    return ops_of(backend) != NULL;
}

const char *capture_status_name(capture_status status)
{
    switch (status) {
    case CAPTURE_OK:
        return "ok";
    case CAPTURE_CHANGED:
        return "changed";
    case CAPTURE_TIMEOUT:
        return "timeout";
    case CAPTURE_ERR_ARG:
        return "argument";
    case CAPTURE_ERR_NONE:
        return "none";
    case CAPTURE_ERR_ACCESS:
        return "access";
    case CAPTURE_ERR_BUSY:
        return "busy";
    case CAPTURE_ERR_KIND:
        return "kind";
    case CAPTURE_ERR_FORMAT:
        return "format";
    case CAPTURE_ERR_GONE:
        return "gone";
    case CAPTURE_ERR_ORDER:
        return "order";
    case CAPTURE_ERR_SYSTEM:
        return "system";
    }
    return "unknown";
}

const char *capture_known_name(capture_known known)
{
    static const char names[CAPTURE_KNOWN_COUNT][24] = {
        "",          "exposure",      "auto_exposure",      "gain",
        "auto_gain", "white_balance", "auto_white_balance", "power_line",
    };
    const int index = (int)known;

    return index > 0 && index < CAPTURE_KNOWN_COUNT ? names[index] : NULL;
}

/* ---- Texts --------------------------------------------------------------------------------- */

capture_status capture_fail(capture *camera, capture_status status, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(camera->error, sizeof camera->error, format, arguments);
    va_end(arguments);
    return status;
}

void capture_note_change(capture *camera, const char *format, ...)
{
    const size_t used = strlen(camera->changes);
    const char *const separator = used > 0 ? "; " : "";
    const size_t start = used + strlen(separator);
    va_list arguments;

    if (start + 1 >= sizeof camera->changes) {
        return;
    }
    memcpy(camera->changes + used, separator, strlen(separator));
    va_start(arguments, format);
    vsnprintf(camera->changes + start, sizeof camera->changes - start, format, arguments);
    va_end(arguments);
}

void capture_copy_text(char *to, size_t to_bytes, const char *from, size_t from_bytes)
{
    size_t used = 0;

    while (used + 1 < to_bytes && used < from_bytes && from[used] != '\0') {
        const unsigned char byte = (unsigned char)from[used];

        to[used] = byte < 0x20 || byte == 0x7F ? '?' : from[used];
        used++;
    }
    to[used] = '\0';
}

const char *capture_changes(const capture *camera)
{
    return camera ? camera->changes : "";
}

const char *capture_error(const capture *camera)
{
    return camera ? camera->error : "";
}

/* ---- Opening and closing ------------------------------------------------------------------- */

static capture_status check_wish(capture *camera)
{
    const capture_wish *const wish = &camera->wish;

    if (wish->width > PEL_SIDE_MAX || wish->height > PEL_SIDE_MAX) {
        return capture_fail(camera, CAPTURE_ERR_ARG, "size %ux%u: a side has at most %d pixels",
                            wish->width, wish->height, PEL_SIDE_MAX);
    }
    if ((wish->rate_num == 0) != (wish->rate_den == 0)) {
        return capture_fail(camera, CAPTURE_ERR_ARG, "%u/%u is no frame rate", wish->rate_num,
                            wish->rate_den);
    }
    if (wish->buffers != 0 &&
        (wish->buffers < CAPTURE_BUFFERS_MIN || wish->buffers > CAPTURE_BUFFERS_MAX)) {
        return capture_fail(camera, CAPTURE_ERR_ARG, "%u buffers: there can be %d to %d",
                            wish->buffers, CAPTURE_BUFFERS_MIN, CAPTURE_BUFFERS_MAX);
    }
    if (wish->fourcc != 0 && wish->backend == CAPTURE_V4L2 &&
        !capture_format_of(wish->fourcc, NULL)) {
        char text[16];

        capture_fourcc_text(wish->fourcc, text);
        return capture_fail(camera, CAPTURE_ERR_FORMAT, "format %s cannot be read here", text);
    }
    return CAPTURE_OK;
}

static capture_status take_wish(capture *camera, const capture_wish *wish)
{
    camera->wish = *wish;
    camera->wish.device = NULL;
    if (wish->device && wish->device[0] != '\0') {
        if (strlen(wish->device) >= sizeof camera->device) {
            return capture_fail(camera, CAPTURE_ERR_ARG, "the name of the device is too long");
        }
        strcpy(camera->device, wish->device);
        camera->wish.device = camera->device;
    }
    return check_wish(camera);
}

capture_status capture_open(const capture_wish *wish, const struct v4l2_calls *calls,
                            capture **camera)
{
    capture *made;
    capture_status status;

    if (!camera) {
        return CAPTURE_ERR_ARG;
    }
    *camera = NULL;
    if (!wish) {
        return CAPTURE_ERR_ARG;
    }
    made = (capture *)calloc(1, sizeof *made);
    if (!made) {
        return CAPTURE_ERR_SYSTEM;
    }
    *camera = made;
    made->calls = calls ? calls : v4l2_system_calls();
    status = take_wish(made, wish);
    if (status != CAPTURE_OK) {
        return status;
    }
    if (made->wish.buffers == 0) {
        made->wish.buffers = BUFFERS_DEFAULT;
    }
    if (made->wish.restart_after == 0) {
        made->wish.restart_after = RESTART_DEFAULT;
    }
    made->ops = ops_of(wish->backend);
    if (!made->ops) {
        return capture_fail(made, CAPTURE_ERR_KIND, "this build has no such kind of cameras%s",
                            wish->backend == CAPTURE_LIBCAMERA ? " (libcamera)" : "");
    }
    status = made->ops->open(made);
    made->opened = status >= 0;
    return status;
}

void capture_close(capture *camera)
{
    if (!camera) {
        return;
    }
    capture_stop(camera);
    if (camera->ops) {
        camera->ops->close(camera);
    }
    free(camera);
}

void capture_get_settings(const capture *camera, capture_settings *settings)
{
    if (!settings) {
        return;
    }
    if (camera) {
        *settings = camera->settings;
    } else {
        memset(settings, 0, sizeof *settings);
    }
}

void capture_get_counts(const capture *camera, capture_counts *counts)
{
    if (!counts) {
        return;
    }
    if (camera) {
        *counts = camera->counts;
    } else {
        memset(counts, 0, sizeof *counts);
    }
}

/* ---- Frames -------------------------------------------------------------------------------- */

capture_status capture_start(capture *camera)
{
    capture_status status;

    if (!camera) {
        return CAPTURE_ERR_ARG;
    }
    if (!camera->opened || camera->started) {
        return capture_fail(camera, CAPTURE_ERR_ORDER,
                            camera->started ? "the camera has been started"
                                            : "the camera is not open");
    }
    camera->error[0] = '\0';
    status = camera->ops->start(camera);
    camera->started = status >= 0;
    return status;
}

capture_status capture_stop(capture *camera)
{
    if (!camera) {
        return CAPTURE_ERR_ARG;
    }
    if (!camera->started) {
        return CAPTURE_OK;
    }
    camera->started = 0;
    camera->error[0] = '\0';
    return camera->ops->stop(camera);
}

capture_status capture_next(capture *camera, unsigned deadline_ms, capture_frame *frame)
{
    if (!camera || !frame) {
        return CAPTURE_ERR_ARG;
    }
    memset(frame, 0, sizeof *frame);
    if (!camera->started) {
        return capture_fail(camera, CAPTURE_ERR_ORDER, "the camera has not been started");
    }
    camera->error[0] = '\0';
    return camera->ops->next(camera, deadline_ms, frame);
}

capture_status capture_give_back(capture *camera, capture_frame *frame)
{
    capture_status status;

    if (!camera || !frame) {
        return CAPTURE_ERR_ARG;
    }
    camera->error[0] = '\0';
    if (frame->slot == 0 || !camera->opened) {
        return capture_fail(camera, CAPTURE_ERR_ARG, "not a frame that is out");
    }
    status = camera->ops->give_back(camera, frame);
    if (status == CAPTURE_OK) {
        memset(frame, 0, sizeof *frame);
    }
    return status;
}

/* ---- Controls and modes -------------------------------------------------------------------- */

/* A camera that another program uses can be looked at, too. */
static capture_status check_open(capture *camera)
{
    if (!camera) {
        return CAPTURE_ERR_ARG;
    }
    camera->error[0] = '\0';
    if (!camera->opened && !camera->looking) {
        return capture_fail(camera, CAPTURE_ERR_ORDER, "the camera is not open");
    }
    return CAPTURE_OK;
}

int capture_controls(capture *camera, capture_control *controls, size_t max)
{
    const capture_status status = check_open(camera);

    if (status != CAPTURE_OK) {
        return status;
    }
    return camera->ops->controls(camera, controls, controls ? max : 0);
}

int capture_modes(capture *camera, capture_mode *modes, size_t max)
{
    const capture_status status = check_open(camera);

    if (status != CAPTURE_OK) {
        return status;
    }
    return camera->ops->modes(camera, modes, modes ? max : 0);
}

capture_status capture_menu_item(capture *camera, uint32_t id, int32_t index, char text[32])
{
    const capture_status status = check_open(camera);

    if (status != CAPTURE_OK) {
        return status;
    }
    if (!text) {
        return CAPTURE_ERR_ARG;
    }
    text[0] = '\0';
    return camera->ops->menu_item(camera, id, index, text);
}

capture_status capture_get(capture *camera, uint32_t id, int32_t *value)
{
    const capture_status status = check_open(camera);

    if (status != CAPTURE_OK) {
        return status;
    }
    return value ? camera->ops->get(camera, id, value) : CAPTURE_ERR_ARG;
}

uint32_t capture_control_id(capture *camera, capture_known known)
{
    if (check_open(camera) != CAPTURE_OK || !capture_known_name(known)) {
        return 0;
    }
    return camera->ops->known(camera, known);
}

/* For the device that comes back: the last value of each control, in the order of first use. */
static void keep(capture *camera, uint32_t id, int32_t value)
{
    unsigned i = 0;

    while (i < camera->kept_count && camera->kept[i].id != id) {
        i++;
    }
    if (i == CAPTURE_KEPT_MAX) {
        return;
    }
    if (i == camera->kept_count) {
        camera->kept_count++;
    }
    camera->kept[i].id = id;
    camera->kept[i].value = value;
}

static capture_status check_value(capture *camera, const capture_control *control, int32_t value)
{
    if (control->read_only) {
        return capture_fail(camera, CAPTURE_ERR_ARG, "%s can only be read", control->name);
    }
    if (value < control->min || value > control->max) {
        return capture_fail(camera, CAPTURE_ERR_ARG, "%s: %ld is not in %ld to %ld", control->name,
                            (long)value, (long)control->min, (long)control->max);
    }
    return CAPTURE_OK;
}

capture_status capture_set(capture *camera, uint32_t id, int32_t value, int32_t *actual)
{
    capture_control control;
    int32_t now = 0;
    capture_status status = check_open(camera);

    if (status == CAPTURE_OK) {
        status = camera->ops->query(camera, id, &control);
    }
    if (status == CAPTURE_OK) {
        status = check_value(camera, &control, value);
    }
    if (status == CAPTURE_OK) {
        status = camera->ops->set(camera, id, value);
    }
    if (status == CAPTURE_OK) {
        keep(camera, id, value);
        status = camera->ops->get(camera, id, &now);
    }
    if (status != CAPTURE_OK) {
        return status;
    }
    if (actual) {
        *actual = now;
    }
    if (now != value) {
        return capture_fail(camera, CAPTURE_CHANGED, "%s: %ld was asked for and is %ld",
                            control.name, (long)value, (long)now);
    }
    return CAPTURE_OK;
}

/* ---- What there is ------------------------------------------------------------------------- */

int capture_list(capture_backend backend, const struct v4l2_calls *calls, capture_device *devices,
                 size_t max)
{
    const struct capture_ops *const ops = ops_of(backend);

    if (!ops) {
        return CAPTURE_ERR_KIND;
    }
    return ops->list(calls ? calls : v4l2_system_calls(), devices, devices ? max : 0);
}
