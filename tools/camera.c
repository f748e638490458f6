#include "camera.h"

#ifdef PEL_HAS_CAMERAS

#include <inttypes.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "camera_controls.h"
#include "pack.h"
#include "say.h"

/* Slow cameras in the dark take a second for a frame; port and user count time-outs of this. */
enum { DEADLINE_MS = 1000, PATIENCE_S = 10, LOCK_SETTLE = 30, COMMENT_BYTES = 1024 };

struct camera {
    camera_options options;
    capture *device;
    capture_settings settings;
    capture_frame held; /* given back before the next */
    int holds;
    frame decoded, converted;
    unsigned long frames, undecodable;
    uint64_t first_us, last_us;
    char comment[COMMENT_BYTES];
};

/* ---- Signals ------------------------------------------------------------------------------- */

static volatile sig_atomic_t interrupted;

static void take_signal(int number)
{
    (void)number;
    interrupted = 1;
}

int camera_was_interrupted(void)
{
    return interrupted != 0;
}

/* Once only: the second Ctrl-C has its usual effect. What is ignored (nohup) stays so. */
static void catch_signals(void)
{
    static const int signals[] = {SIGINT, SIGTERM};
    for (int i = 0; i < 2; i++) {
        struct sigaction old;
        struct sigaction action;
        memset(&action, 0, sizeof action);
        action.sa_handler = take_signal;
        action.sa_flags = (int)SA_RESETHAND | SA_RESTART; /* a frame that is written is ended */
        if (sigaction(signals[i], NULL, &old) == 0 && old.sa_handler != SIG_IGN) {
            sigaction(signals[i], &action, NULL);
        }
    }
}

/* ---- Opening ------------------------------------------------------------------------------- */

static const char *remedy(capture_status status)
{
    switch (status) {
    case CAPTURE_ERR_NONE:
        return "; 'pel cameras' lists those that are there";
    case CAPTURE_ERR_ACCESS:
        return "; cameras belong to the group 'video': 'sudo usermod -aG video $USER', then log in "
               "again";
    case CAPTURE_ERR_BUSY:
        return "; another program has it: 'fuser -v DEVICE' shows which";
    case CAPTURE_ERR_KIND:
        return "; 'pel cameras' lists what can be used";
    case CAPTURE_ERR_FORMAT:
        return "; 'pel cameras' lists the formats of each camera";
    case CAPTURE_ERR_GONE:
        return "; --reconnect SECONDS waits for its return";
    default:
        return "";
    }
}

int camera_refuse(const capture *device, const char *name, capture_status status)
{
    const char *error = capture_error(device);
    const char *tail = remedy(status);
    if (status == CAPTURE_ERR_BUSY && name && name[0] == '/') {
        return say_error(NULL, "%s; another program has it: 'fuser -v %s' shows which",
                         error[0] ? error : name, name);
    }
    if (error[0]) {
        return say_error(NULL, "%s%s", error, tail);
    }
    return say_error(name && name[0] ? name : "camera", "%s%s", capture_status_name(status), tail);
}

static const char *name_of(const camera *of)
{
    if (of->settings.path[0]) {
        return of->settings.path;
    }
    return of->options.wish.device ? of->options.wish.device : "camera";
}

static int fail(const camera *of, capture_status status)
{
    return camera_refuse(of->device, name_of(of), status);
}

static int open_device(camera *of)
{
    if (!capture_has_backend(of->options.wish.backend)) {
        return say_error("--backend", "this build has no libcamera: install libcamera-dev and "
                                      "configure again");
    }
    const capture_status status = capture_open(&of->options.wish, NULL, &of->device);
    if (!of->device) {
        return say_error("camera", "out of memory");
    }
    capture_get_settings(of->device, &of->settings);
    if (status < 0) {
        return fail(of, status);
    }
    if (status == CAPTURE_CHANGED) {
        say_error(name_of(of), "the camera does not do it all: %s", capture_changes(of->device));
    }
    return 0;
}

/* Skips the frames in which the automatics still move. */
static int settle(camera *of)
{
    const camera_options *options = &of->options;
    unsigned long left = options->has_settle ? options->settle : options->lock ? LOCK_SETTLE : 0;
    camera_frame skipped;
    for (; left > 0; left--) {
        if (camera_next(of, &skipped) <= 0) {
            return -1;
        }
    }
    return 0;
}

static int prepare(camera *of)
{
    const unsigned long count = of->options.count;
    const unsigned long milli_s = of->options.milli_s;
    if (open_device(of) || camera_controls_apply(of->device, name_of(of), &of->options)) {
        return -1;
    }
    const capture_status status = capture_start(of->device);
    if (status < 0) {
        return fail(of, status);
    }
    of->options.count = 0;
    of->options.milli_s = 0;
    if (settle(of)) {
        return -1;
    }
    if (of->options.lock) {
        camera_controls_lock(of->device, name_of(of));
    }
    of->options.count = count;
    of->options.milli_s = milli_s;
    of->frames = 0;
    return 0;
}

camera *camera_open(const camera_options *options)
{
    camera *made = calloc(1, sizeof *made);
    if (!made) {
        say_error("camera", "out of memory");
        return NULL;
    }
    catch_signals();
    made->options = *options;
    if (prepare(made)) {
        camera_close(made);
        return NULL;
    }
    return made;
}

void camera_close(camera *of)
{
    if (of) {
        if (of->undecodable > 0) {
            say_error(name_of(of), "%lu damaged JPEG frames were left out", of->undecodable);
        }
        capture_close(of->device);
        frame_free(&of->decoded);
        frame_free(&of->converted);
        free(of);
    }
}

/* ---- Frames -------------------------------------------------------------------------------- */

/* Waits for a frame: 1, 0 after a signal, -1 after a message. */
static int wait_frame(camera *from)
{
    const unsigned long returning = from->options.wish.return_ms / 1000;
    unsigned long patience = from->options.patience ? from->options.patience : PATIENCE_S;
    patience = patience > returning ? patience : returning + 1;
    for (unsigned long waited = 0; waited < patience && !interrupted; waited++) {
        const capture_status status = capture_next(from->device, DEADLINE_MS, &from->held);
        if (status == CAPTURE_OK) {
            from->holds = 1;
            return 1;
        }
        if (status != CAPTURE_TIMEOUT) {
            return interrupted ? 0 : fail(from, status);
        }
    }
    return interrupted ? 0
                       : say_error(name_of(from),
                                   "no frame for %lu seconds; is the camera connected well, and "
                                   "does the bus have room for size and rate?",
                                   patience);
}

/* The view of a compressed frame: 1, 0 if it is damaged, -1 after a message. */
static int decode(camera *from, pel_cview *view)
{
    const capture_settings *settings = &from->settings;
    if (frame_resize(&from->decoded, PEL_RGB888, PEL_RANGE_FULL, settings->width,
                     settings->height)) {
        return say_error(name_of(from), "out of memory");
    }
    const capture_status status = capture_decode(from->device, &from->held, &from->decoded.view);
    if (status == CAPTURE_ERR_FORMAT) {
        return 0;
    }
    *view = pel_view_to_read(&from->decoded.view);
    return status < 0 ? fail(from, status) : 1;
}

static int make_view(camera *from, pel_cview *view)
{
    *view = from->held.view;
    if (from->settings.compressed) {
        return decode(from, view);
    }
    if (from->options.has_range && pack_has_range(view->format) &&
        view->range != from->options.range) {
        if (pack_frame(name_of(from), view, view->format, from->options.range, &from->converted)) {
            return -1;
        }
        *view = pel_view_to_read(&from->converted.view);
    }
    return 1;
}

static void give_back(camera *from)
{
    if (from->holds) {
        capture_give_back(from->device, &from->held);
        from->holds = 0;
    }
}

int camera_next(camera *from, camera_frame *to)
{
    int made = 0;
    if (from->options.count > 0 && from->frames >= from->options.count) {
        return 0;
    }
    /* A camera that sends nothing but damage must come to an end, too. */
    for (unsigned tries = 0; made == 0; tries++) {
        give_back(from);
        const int got = interrupted ? 0 : wait_frame(from);
        if (got <= 0) {
            return got;
        }
        made = make_view(from, &to->view);
        from->undecodable += made == 0;
        if (made == 0 && tries >= 100) {
            return say_error(name_of(from), "nothing but damaged JPEG frames: %s",
                             capture_error(from->device));
        }
    }
    to->sequence = from->held.sequence;
    to->timestamp_us = from->held.timestamp_us;
    if (made > 0 && from->frames == 0) {
        from->first_us = to->timestamp_us;
    }
    if (from->options.milli_s > 0 &&
        to->timestamp_us - from->first_us >= 1000 * (uint64_t)from->options.milli_s) {
        return made < 0 ? -1 : 0;
    }
    from->last_us = to->timestamp_us;
    from->frames += made > 0;
    return made;
}

/* ---- What is known of it ------------------------------------------------------------------- */

const capture_settings *camera_settings(const camera *of)
{
    return &of->settings;
}

uint64_t camera_lost(const camera *of)
{
    capture_counts counts;
    capture_get_counts(of->device, &counts);
    return counts.missed + counts.stale + counts.damaged + counts.short_frames + of->undecodable;
}

unsigned long camera_rate_milli(const camera *of)
{
    const uint64_t span = of->last_us - of->first_us;
    return of->frames > 1 && span > 0
               ? (unsigned long)(((uint64_t)of->frames - 1) * 1000000000 / span)
               : 0;
}

const char *camera_comment(camera *of)
{
    const capture_settings *set = &of->settings;
    const char *changes = capture_changes(of->device);
    char code[16];
    char controls[320];
    capture_fourcc_text(set->fourcc, code);
    camera_controls_text(of->device, controls, sizeof controls);
    snprintf(of->comment, sizeof of->comment,
             "camera: %s (%s, %s) at %s\nformat: %s %ux%u, %" PRIu32 " bytes per line, %s range\n"
             "rate: %u/%u frames per second\ncontrols: %s\n%s%s%s%s",
             set->card, set->driver, set->bus, set->path, code, set->width, set->height,
             set->bytes_per_line, set->range == PEL_RANGE_FULL ? "full" : "limited", set->rate_num,
             set->rate_den, controls, of->options.lock ? "locked: yes\n" : "",
             changes[0] ? "changed by the driver: " : "", changes, changes[0] ? "\n" : "");
    return of->comment;
}

int camera_walk(const camera_options *options, walk_visit *visit, void *user)
{
    camera_frame got;
    unsigned long number = 0;
    int status = 0;
    camera *from = camera_open(options);
    if (!from) {
        return interrupted ? 0 : -1;
    }
    while ((status = camera_next(from, &got)) > 0) {
        if (visit(user, from->settings.path, number++, &got.view)) {
            status = -1;
            break;
        }
    }
    camera_close(from);
    return status;
}

#else

typedef int camera_empty; /* ISO C wants something in a file */

#endif
