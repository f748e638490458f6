/*
 * Checks of the libcamera backend through capture.h:
 *     libcamera_check none      where no camera is: reasons instead of crashes
 *     libcamera_check vimc      with the kernel's vimc: frames by value, buffers, healing, controls
 *     libcamera_check unplug    with vimc, which it takes away while it streams
 * Last line: N passed, N failed[, N skipped]. Status 0: all held.
 *
 * vimc's sensor shows bars of 75 % (white, yellow, cyan, green, magenta, red, blue, black), with
 * text in the upper half. Its mosaic is mixed back to colours and enlarged three times, so that
 * inside a bar every byte is 0 or 75 % of 255.
 */
#include "capture.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static unsigned passed, failed, skipped;

__attribute__((format(printf, 2, 3))) static int check(int good, const char *format, ...)
{
    va_list arguments;

    printf("%s ", good ? "ok  " : "FAIL");
    va_start(arguments, format);
    vprintf(format, arguments);
    va_end(arguments);
    printf("\n");
    fflush(stdout);
    passed += good ? 1U : 0U;
    failed += good ? 0U : 1U;
    return good;
}

static void pause_ms(long ms)
{
    const struct timespec length = {ms / 1000, ms % 1000 * 1000000};

    nanosleep(&length, NULL);
}

static uint64_t now_us(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000U + (uint64_t)now.tv_nsec / 1000U;
}

static capture_wish wish_of(const char *device, const char *fourcc)
{
    capture_wish wish;

    memset(&wish, 0, sizeof wish);
    wish.backend = CAPTURE_LIBCAMERA;
    wish.device = device;
    wish.fourcc = fourcc ? capture_fourcc(fourcc) : 0;
    wish.width = 636;
    wish.height = 480;
    return wish;
}

static capture *open_started(const capture_wish *wish, const char *what)
{
    capture *camera = NULL;
    capture_status status = capture_open(wish, NULL, &camera);

    if (status >= 0) {
        status = capture_start(camera);
    }
    if (!check(status >= 0, "%s: opens and starts (%s)", what, capture_error(camera))) {
        capture_close(camera);
        return NULL;
    }
    return camera;
}

static capture_counts counts_of(const capture *camera)
{
    capture_counts counts;

    capture_get_counts(camera, &counts);
    return counts;
}

/* ---- Without a camera ---------------------------------------------------------------------- */

static void refuse(const capture_wish *wish, capture_status expected, const char *what)
{
    capture *camera = NULL;
    capture_frame frame;
    const capture_status status = capture_open(wish, NULL, &camera);

    check(status == expected && capture_error(camera)[0] != '\0', "%s is refused: %s (%s)", what,
          capture_status_name(status), capture_error(camera));
    check(capture_start(camera) == CAPTURE_ERR_ORDER && capture_stop(camera) == CAPTURE_OK &&
              capture_next(camera, 0, &frame) == CAPTURE_ERR_ORDER &&
              capture_controls(camera, NULL, 0) == CAPTURE_ERR_ORDER &&
              capture_modes(camera, NULL, 0) == CAPTURE_ERR_ORDER &&
              capture_control_id(camera, CAPTURE_EXPOSURE) == 0,
          "%s: nothing can be done with it", what);
    capture_close(camera);
}

static void group_none(void)
{
    capture_device devices[2];
    capture_wish wish = wish_of(NULL, NULL);
    const int count = capture_list(CAPTURE_LIBCAMERA, NULL, devices, 2);

    if (count > 0) {
        printf("a camera is here (%s)\n", devices[0].path);
        skipped++;
        return;
    }
    check(count == 0 || count == CAPTURE_ERR_SYSTEM, "the list is empty, or says why not: %d",
          count);
    for (int round = 0; round < 3; round++) { /* libcamera starts and ends each time */
        refuse(&wish, count == 0 ? CAPTURE_ERR_NONE : CAPTURE_ERR_SYSTEM, "the first camera");
        check(capture_list(CAPTURE_LIBCAMERA, NULL, NULL, 0) == count, "the list, once more");
    }
    wish.device = "no such camera";
    refuse(&wish, count == 0 ? CAPTURE_ERR_NONE : CAPTURE_ERR_SYSTEM, "a name");
    wish.device = "/dev/null";
    refuse(&wish, count == 0 ? CAPTURE_ERR_NONE : CAPTURE_ERR_SYSTEM, "a path");
    wish.width = 100000;
    refuse(&wish, CAPTURE_ERR_ARG, "a size");
}

/* ---- Pictures ------------------------------------------------------------------------------ */

enum { BARS = 8, EDGE_PX = 12, LEVEL = 191 /* 75 % of 255 = 191.25 */ };

/* R, G, B of a bar, `on` for those that shine. */
static void bar_color(unsigned bar, int rgb[3], int on)
{
    rgb[0] = bar & 2U ? 0 : on;
    rgb[1] = bar & 4U ? 0 : on;
    rgb[2] = bar & 1U ? 0 : on;
}

/* The bytes inside the bars of the lower third that differ by more than 1, and how many were
 * looked at; `red` is the place of red in a pixel's bytes, 0 or 2. */
static unsigned long wrong_bytes(const capture_frame *frame, unsigned red, unsigned long *seen)
{
    const unsigned width = frame->view.width;
    unsigned long wrong = 0;

    *seen = 0;
    for (unsigned y = frame->view.height * 2U / 3U; y < frame->view.height; y++) {
        const uint8_t *const row =
            frame->view.plane[0] + (ptrdiff_t)y * frame->view.stride_bytes[0];

        for (unsigned x = EDGE_PX; x + EDGE_PX < width; x++) {
            const unsigned bar = x * BARS / width;
            int rgb[3];

            if ((x - EDGE_PX) * BARS / width != bar || (x + EDGE_PX) * BARS / width != bar) {
                continue;
            }
            bar_color(bar, rgb, LEVEL);
            for (unsigned c = 0; c < 3; c++) {
                const int is = row[3 * x + (c == 1 ? 1 : c == 0 ? red : 2 - red)];

                wrong += abs(is - rgb[c]) > 1;
                ++*seen;
            }
        }
    }
    return wrong;
}

/* What the library makes of the frame's view, which says its byte order: R, G, B of each bar's
 * middle. */
static int reads_as_bars(const capture_frame *frame)
{
    const uint16_t y = (uint16_t)(frame->view.height - 4);
    const pel_crow row = pel_cview_row(&frame->view, y);

    for (unsigned bar = 0; bar < BARS; bar++) {
        const uint16_t x = (uint16_t)((2 * bar + 1) * frame->view.width / (2 * BARS));
        uint8_t is[3];
        int rgb[3];

        bar_color(bar, rgb, LEVEL);
        if (pel_crow_read_rgb(&row, x, 1, is) != PEL_OK || abs(is[0] - rgb[0]) > 1 ||
            abs(is[1] - rgb[1]) > 1 || abs(is[2] - rgb[2]) > 1) {
            return 0;
        }
    }
    return 1;
}

static void check_picture(const char *fourcc, pel_format format, unsigned red)
{
    const capture_wish wish = wish_of("Sensor B", fourcc);
    capture *const camera = open_started(&wish, fourcc);
    capture_settings settings;
    capture_frame frame;
    unsigned long seen = 0;

    if (!camera) {
        return;
    }
    capture_get_settings(camera, &settings);
    check(settings.fourcc == wish.fourcc && settings.format == format && settings.width == 636 &&
              settings.height == 480 && settings.bytes_per_line >= 3 * 636 &&
              settings.frame_bytes >= 480 * settings.bytes_per_line && !settings.compressed &&
              settings.rate_num == 0 && capture_changes(camera)[0] == '\0',
          "%s: settings as wished", fourcc);
    for (int i = 0; i < 3; i++) {
        if (!check(capture_next(camera, 5000, &frame) == CAPTURE_OK, "%s: a frame", fourcc)) {
            break;
        }
        const unsigned long wrong = wrong_bytes(&frame, red, &seen);

        check(wrong == 0 && seen > 200000, "%s: bars by value: %lu of %lu bytes wrong", fourcc,
              wrong, seen);
        check(frame.view.format == format && reads_as_bars(&frame) &&
                  pel_cview_check(&frame.view) == PEL_OK && frame.bytes == frame.view.plane[0] &&
                  frame.byte_count == (size_t)settings.bytes_per_line * 480,
              "%s: the view", fourcc);
        capture_give_back(camera, &frame);
    }
    capture_close(camera); /* without stop */
}

/* ---- Opening ------------------------------------------------------------------------------- */

static void check_list(void)
{
    capture_device devices[4];
    const int count = capture_list(CAPTURE_LIBCAMERA, NULL, devices, 4);

    check(count == 1 && strcmp(devices[0].path, "platform/vimc.0 Sensor B") == 0 &&
              strcmp(devices[0].card, "Sensor B") == 0 && devices[0].status == CAPTURE_OK,
          "the list: %d, %s, %s", count, count > 0 ? devices[0].path : "",
          count > 0 ? devices[0].card : "");
}

static capture_status status_of_open(capture_wish wish, const char *change)
{
    capture *camera = NULL;
    capture_status status = capture_open(&wish, NULL, &camera);

    if (change && !strstr(capture_changes(camera), change)) {
        printf("changes: '%s'\n", capture_changes(camera));
        status = CAPTURE_ERR_SYSTEM;
    }
    capture_close(camera);
    return status;
}

static void check_opening(void)
{
    capture_wish wish = wish_of("platform/vimc.0 Sensor B", "RGB3");

    check(status_of_open(wish, NULL) == CAPTURE_OK, "opened by its id");
    wish.device = "vimc";
    check(status_of_open(wish, NULL) == CAPTURE_OK, "opened by a part of its id");
    wish.device = NULL;
    check(status_of_open(wish, NULL) == CAPTURE_OK, "opened without a name");
    wish.device = "Sensor A";
    check(status_of_open(wish, NULL) == CAPTURE_ERR_NONE, "no camera of another name");
    wish = wish_of(NULL, "RGB3");
    wish.width = 640;
    check(status_of_open(wish, "size 640x480 became 636x480") == CAPTURE_CHANGED, "size changed");
    wish.width = wish.height = 0;
    check(status_of_open(wish, NULL) == CAPTURE_OK, "no size wished, none changed");
    wish = wish_of(NULL, "YUYV");
    check(status_of_open(wish, "format YUYV became RGB3") == CAPTURE_CHANGED, "format changed");
    wish = wish_of(NULL, "H264");
    check(status_of_open(wish, NULL) == CAPTURE_ERR_FORMAT, "a format that cannot be read");
    wish = wish_of(NULL, "RGB3");
    wish.rate_num = 30;
    wish.rate_den = 1;
    check(status_of_open(wish, "rate 30/1") == CAPTURE_CHANGED, "a rate cannot be chosen");
}

static void check_modes(const capture *other)
{
    const capture_wish wish = wish_of(NULL, "RGB3");
    capture_mode modes[8];
    capture_control controls[8];
    capture *camera = NULL;
    const capture_status status = capture_open(&wish, NULL, &camera);
    const int count = capture_modes(camera, modes, 8);

    check(other && status == CAPTURE_ERR_BUSY, "a second time: %s", capture_status_name(status));
    check(count == 2 && modes[0].readable && modes[1].readable &&
              (modes[0].fourcc == capture_fourcc("RGB3") ||
               modes[1].fourcc == capture_fourcc("RGB3")) &&
              modes[0].width_min == 48 && modes[0].width_max == 4096 && modes[0].height_max == 2160,
          "its modes can be listed all the same: %d", count);
    check(capture_controls(camera, controls, 8) == 3, "and its controls");
    capture_close(camera);
}

/* ---- Buffers ------------------------------------------------------------------------------- */

static void check_holding(capture *camera)
{
    capture_frame held[5];
    capture_frame copy;
    unsigned count = 0;
    unsigned same = 0;

    memset(held, 0, sizeof held);
    while (count < 4 && capture_next(camera, 5000, &held[count]) == CAPTURE_OK) {
        for (unsigned i = 0; i < count; i++) {
            same += held[i].bytes == held[count].bytes;
        }
        count++;
    }
    check(count == 4 && same == 0, "4 frames held at once, each in memory of its own");
    check(capture_next(camera, 1000, &held[4]) == CAPTURE_ERR_ORDER, "a fifth is refused: %s",
          capture_error(camera));
    copy = held[2];
    check(capture_give_back(camera, &held[2]) == CAPTURE_OK && held[2].slot == 0, "given back");
    check(capture_give_back(camera, &copy) == CAPTURE_ERR_ARG, "but not twice");
    check(capture_next(camera, 5000, &held[4]) == CAPTURE_OK && held[4].bytes == copy.bytes,
          "and is there again, in the same memory: nothing is copied");
    for (unsigned i = 0; i < 5; i++) {
        capture_give_back(camera, &held[i]);
    }
}

static void check_order(capture *camera)
{
    capture_frame frame;
    uint64_t sequence = 0;
    uint64_t time_us = 0;
    unsigned wrong = 0;
    unsigned count = 0;

    while (count < 10 && capture_next(camera, 5000, &frame) == CAPTURE_OK) {
        const uint64_t now = now_us();

        if (count > 0 &&
            (frame.sequence != sequence + 1 + frame.missed || frame.timestamp_us <= time_us)) {
            wrong++;
        }
        wrong += frame.timestamp_us > now || frame.timestamp_us + 5000000 < now;
        sequence = frame.sequence;
        time_us = frame.timestamp_us;
        count++;
        capture_give_back(camera, &frame);
    }
    check(count == 10 && wrong == 0, "%u frames in order and in time", count);
}

static void check_stop_start(capture *camera)
{
    capture_frame old;
    capture_frame frame;

    check(capture_next(camera, 5000, &old) == CAPTURE_OK && capture_stop(camera) == CAPTURE_OK &&
              capture_next(camera, 0, &frame) == CAPTURE_ERR_ORDER,
          "stopped with a frame out");
    check(capture_start(camera) == CAPTURE_OK, "started again");
    check(capture_give_back(camera, &old) == CAPTURE_OK, "the frame of before is taken back");
    check(capture_next(camera, 5000, &frame) == CAPTURE_OK && frame.sequence < 4,
          "counted from 0 again: %lu", (unsigned long)frame.sequence);
    capture_give_back(camera, &frame);
}

static void check_buffers(void)
{
    const capture_wish wish = wish_of(NULL, "RGB3");
    capture *const camera = open_started(&wish, "buffers");

    if (!camera) {
        return;
    }
    check_modes(camera);
    check_order(camera);
    check_holding(camera);
    check_stop_start(camera);
    check(counts_of(camera).damaged == 0 && counts_of(camera).short_frames == 0 &&
              counts_of(camera).restarts == 0 && counts_of(camera).timeouts == 0 &&
              counts_of(camera).frames == 17,
          "counted: %lu frames, nothing else", (unsigned long)counts_of(camera).frames);
    capture_close(camera);
}

static void check_newest(void)
{
    capture_wish wish = wish_of(NULL, "RGB3");
    capture_frame first;
    capture_frame second;
    capture *camera;

    wish.newest = 1;
    camera = open_started(&wish, "newest");
    if (!camera) {
        return;
    }
    if (check(capture_next(camera, 5000, &first) == CAPTURE_OK, "newest: a frame")) {
        const uint64_t before = counts_of(camera).stale;

        capture_give_back(camera, &first);
        pause_ms(2000); /* all four buffers are filled, then nothing more */
        const capture_status status = capture_next(camera, 5000, &second);
        const uint64_t stale = counts_of(camera).stale - before;

        check(status == CAPTURE_OK && stale == 3 && second.sequence >= first.sequence + 4,
              "newest: %lu stale frames were passed over, 3 is right", (unsigned long)stale);
        capture_give_back(camera, &second);
    }
    capture_close(camera);
}

/* ---- Healing ------------------------------------------------------------------------------- */

static void check_restart(void)
{
    capture_wish wish = wish_of(NULL, "RGB3");
    capture_frame held;
    capture_frame frame;
    capture *camera;
    uint64_t last = 0;

    wish.restart_after = 2;
    camera = open_started(&wish, "restart");
    if (!camera) {
        return;
    }
    while (capture_next(camera, 0, &frame) == CAPTURE_OK) {
        capture_give_back(camera, &frame);
    }
    check(counts_of(camera).timeouts == 0 && capture_error(camera)[0] == '\0',
          "restart: asking with deadline 0 is no time-out");
    check(capture_next(camera, 5000, &held) == CAPTURE_OK, "restart: a frame");
    last = held.sequence;
    for (int i = 0; i < 100 && counts_of(camera).restarts == 0; i++) {
        if (capture_next(camera, 1, &frame) == CAPTURE_OK) {
            last = frame.sequence;
            capture_give_back(camera, &frame);
        }
    }
    check(counts_of(camera).restarts == 1 && counts_of(camera).timeouts >= 2,
          "restart: after two time-outs in a row");
    unsigned long seen = 0;
    const unsigned long wrong = wrong_bytes(&held, 0, &seen);

    check(wrong == 0 && capture_give_back(camera, &held) == CAPTURE_OK,
          "restart: a frame that is held stays readable");
    const capture_status status = capture_next(camera, 5000, &frame);
    check(status == CAPTURE_OK && frame.sequence > last,
          "restart: frames go on, counted on: %lu after %lu", (unsigned long)frame.sequence,
          (unsigned long)last);
    capture_give_back(camera, &frame);
    check_order(camera);
    capture_close(camera);
}

/* ---- Controls ------------------------------------------------------------------------------ */

/* The mean byte of the black bar in the last row. */
static int black_level(capture *camera)
{
    capture_frame frame;
    int level = -1;

    for (int i = 0; i < 8; i++) { /* until the requests that were under way are through */
        if (capture_next(camera, 5000, &frame) != CAPTURE_OK) {
            return -1;
        }
        level =
            frame.view.plane[0][(ptrdiff_t)(frame.view.height - 2) * frame.view.stride_bytes[0] +
                                3 * (frame.view.width - 20)];
        capture_give_back(camera, &frame);
    }
    return level;
}

static void check_controls(void)
{
    const capture_wish wish = wish_of(NULL, "RGB3");
    capture *const camera = open_started(&wish, "controls");
    capture_control controls[8];
    uint32_t brightness = 0;
    int32_t actual = 0;
    int count;

    if (!camera) {
        return;
    }
    count = capture_controls(camera, controls, 8);
    for (int i = 0; i < count; i++) {
        if (strcmp(controls[i].name, "Brightness") == 0 && controls[i].min == -100 &&
            controls[i].max == 100 && controls[i].value == 0) {
            brightness = controls[i].id;
        }
    }
    check(count == 3 && brightness != 0, "controls: %d, fractions in hundredths", count);
    check(capture_control_id(camera, CAPTURE_EXPOSURE) == 0, "controls: this camera exposes not");
    check(capture_set(camera, brightness, 101, &actual) == CAPTURE_ERR_ARG &&
              capture_set(camera, 0xFFFF, 0, &actual) == CAPTURE_ERR_NONE,
          "controls: out of range, unknown");
    check(black_level(camera) == 0, "controls: black is black");
    check(capture_set(camera, brightness, 50, &actual) == CAPTURE_OK && actual == 50,
          "controls: set");
    /* 0.5 of the way from 128 to 255 and beyond is 192, which V4L2 adds to Y as 192 - 128; the
     * sensor's colours are sRGB, whose Y reaches from 0 to 255 as R, G and B do. */
    const int bright = black_level(camera);
    check(bright >= 63 && bright <= 65, "controls: black became %d, 64 is right", bright);
    check(capture_stop(camera) == CAPTURE_OK && capture_set(camera, brightness, 0, NULL) == 0 &&
              capture_start(camera) == CAPTURE_OK && black_level(camera) == 0,
          "controls: set while stopped, carried by the first request");
    capture_close(camera);
}

static void group_vimc(void)
{
    check_list();
    check_opening();
    check_picture("RGB3", PEL_RGB888, 0);
    check_picture("BGR3", PEL_BGR888, 2);
    check_buffers();
    check_newest();
    check_restart();
    check_controls();
}

/* ---- Taken away ---------------------------------------------------------------------------- */

static int take_away(void)
{
    FILE *const file = fopen("/sys/bus/platform/drivers/vimc/unbind", "we");

    return file && fputs("vimc.0", file) >= 0 && fclose(file) == 0;
}

/* Frames until the camera is gone, or the last status after `tries`. */
static capture_status until_gone(capture *camera, unsigned tries)
{
    capture_status status = CAPTURE_OK;
    capture_frame frame;

    for (unsigned i = 0; i < tries && status != CAPTURE_ERR_GONE; i++) {
        status = capture_next(camera, 200, &frame);
        if (status == CAPTURE_OK) {
            capture_give_back(camera, &frame);
        }
    }
    return status;
}

static void group_unplug(void)
{
    const capture_wish wish = wish_of(NULL, "RGB3");
    capture *const camera = open_started(&wish, "unplug");
    capture_frame held;
    capture_frame frame;
    unsigned long seen = 0;
    unsigned long wrong;

    if (!camera || !check(capture_next(camera, 5000, &held) == CAPTURE_OK, "unplug: a frame")) {
        capture_close(camera);
        return;
    }
    check(take_away(), "unplug: taken away");
    const capture_status status = until_gone(camera, 50);
    check(status == CAPTURE_ERR_GONE, "unplug: %s (%s)", capture_status_name(status),
          capture_error(camera));
    check(capture_next(camera, 10, &frame) == CAPTURE_ERR_GONE, "unplug: for good");
    wrong = wrong_bytes(&held, 0, &seen);
    check(wrong == 0 && capture_give_back(camera, &held) == CAPTURE_OK,
          "unplug: a frame that is held stays readable");
    check(capture_stop(camera) == CAPTURE_OK && capture_start(camera) == CAPTURE_ERR_GONE,
          "unplug: cannot be started");
    capture_close(camera);
    check(status_of_open(wish, NULL) < 0, "unplug: closed, and not opened again");
}

int main(int argc, char **argv)
{
    const char *const group = argc == 2 ? argv[1] : "";

    if (!capture_has_backend(CAPTURE_LIBCAMERA)) {
        printf("this build is without libcamera\n");
        skipped++;
    } else if (strcmp(group, "none") == 0) {
        group_none();
    } else if (strcmp(group, "vimc") == 0) {
        group_vimc();
    } else if (strcmp(group, "unplug") == 0) {
        group_unplug();
    } else {
        fprintf(stderr, "usage: libcamera_check none|vimc|unplug\n");
        return 2;
    }
    printf("%u passed, %u failed", passed, failed);
    printf(skipped ? ", %u skipped\n" : "\n", skipped);
    return failed > 0 || passed + skipped == 0;
}
