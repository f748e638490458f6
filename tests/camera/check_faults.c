/* Faults that the driver injects into its own replies, frames and clocks: each heals or is said,
 * and the counts are what was injected. */
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "knob.h"

/* ---- Refused calls ------------------------------------------------------------------------- */

/* The next call of that kind fails: opening or starting says which, and then all is well. */
static void check_refused(const char *device, const char *button, const char *call)
{
    const capture_wish wish = small_wish(device);
    capture *camera = NULL;
    char error[256];
    capture_status status =
        knob_set(device, button, 0) < 0 ? CAPTURE_OK : capture_open(&wish, NULL, &camera);
    if (status >= 0 && camera) {
        status = capture_start(camera);
    }
    snprintf(error, sizeof error, "%s", camera ? capture_error(camera) : "");
    check_in(status == CAPTURE_ERR_SYSTEM && strstr(error, call) != NULL, "setup-errors", call,
             "is said: %s, '%s'", capture_status_name(status), error);
    /* The same camera, without opening it anew. */
    status = camera ? capture_start(camera) : CAPTURE_ERR_ORDER;
    const series after = status < 0 ? (series){.status = status} : take(camera, 5, 2000);
    check_in(after.frames == 5, "setup-errors", call, "over when tried again: %u frames, %s",
             after.frames, told(after.status, camera));
    capture_close(camera);
}

void group_setup_errors(int count, char **arguments)
{
    (void)count;
    check_refused(arguments[0], "Inject VIDIOC_REQBUFS Error", "VIDIOC_REQBUFS");
    check_refused(arguments[0], "Inject VIDIOC_QBUF Error", "VIDIOC_QBUF");
    check_refused(arguments[0], "Inject VIDIOC_STREAMON Error", "VIDIOC_STREAMON");
}

/* ---- Faults of the stream ------------------------------------------------------------------ */

/* Presses the button between frames and returns what came before and after. */
static int disturb(capture *camera, const char *device, const char *button, series parts[2])
{
    parts[0] = take(camera, 10, 2000);
    if (parts[0].frames < 10 || knob_set(device, button, 0) < 0) {
        return 0;
    }
    parts[1] = take(camera, 20, 3000);
    return parts[1].frames == 20;
}

static void check_disturbed(const char *device, const char *button, const char *name,
                            int (*as_counted)(const capture_counts *))
{
    const capture_wish wish = small_wish(device);
    capture *camera = opened(&wish, name);
    series parts[2];
    capture_counts counts;
    if (!camera) {
        return;
    }
    memset(parts, 0, sizeof parts);
    const int flows = disturb(camera, device, button, parts);
    capture_get_counts(camera, &counts);
    check_in(flows, "stream-errors", name, "the stream goes on: %u frames, then %u, %s",
             parts[0].frames, parts[1].frames, told(parts[1].status, camera));
    check_in(as_counted(&counts) && counts.frames == 30 && counts.reopens == 0, "stream-errors",
             name, "is counted: %u damaged, %u restarts, %u frames", (unsigned)counts.damaged,
             (unsigned)counts.restarts, (unsigned)counts.frames);
    capture_close(camera);
}

static int one_damaged(const capture_counts *counts)
{
    return counts->damaged == 1 && counts->restarts == 0;
}

static int one_restart(const capture_counts *counts)
{
    return counts->damaged == 0 && counts->restarts == 1;
}

/* A buffer that the driver does not take back may cost a restart, but no frame is made up. */
static int at_most_a_restart(const capture_counts *counts)
{
    return counts->damaged == 0 && counts->restarts <= 1;
}

void group_stream_errors(int count, char **arguments)
{
    const char *device = arguments[0];
    (void)count;
    check_disturbed(device, "Inject V4L2_BUF_FLAG_ERROR", "a damaged frame", one_damaged);
    check_disturbed(device, "Inject Fatal Streaming Error", "a fatal error", one_restart);
    check_disturbed(device, "Inject VIDIOC_QBUF Error", "a refused buffer", at_most_a_restart);
}

/* ---- Frames that never come ---------------------------------------------------------------- */

void group_dropped(int count, char **arguments)
{
    const capture_wish wish = small_wish(arguments[0]);
    capture *camera = opened(&wish, "dropped");
    capture_counts before, after;
    (void)count;
    if (!camera) {
        return;
    }
    (void)take(camera, 5, 2000);
    capture_get_counts(camera, &before);
    (void)knob_set(arguments[0], "Percentage of Dropped Buffers", 60);
    const series some = take(camera, 40, 3000);
    (void)knob_set(arguments[0], "Percentage of Dropped Buffers", 0);
    capture_get_counts(camera, &after);
    const uint64_t span = some.last_sequence - some.first_sequence + 1;
    check(some.frames == 40 && some.out_of_order == 0, "dropped in order", "%u frames, %u wrong",
          some.frames, some.out_of_order);
    /* Of 100 ticks 60 are dropped at random: of those between 40 frames certainly more than 10. */
    check(some.missed > 10 && span == some.frames + some.missed, "dropped are missed",
          "%u frames of %u, %u said to be missed", some.frames, (unsigned)span,
          (unsigned)some.missed);
    check(after.missed - before.missed >= some.missed && after.damaged == 0 && after.restarts == 0,
          "dropped are counted", "%u", (unsigned)(after.missed - before.missed));
    capture_close(camera);
}

/* The driver's 32-bit sequence number passes 2^32; it begins 128 before. */
void group_wrap(int count, char **arguments)
{
    const capture_wish wish = small_wish(arguments[0]);
    (void)count;
    (void)knob_set(arguments[0], "Wrap Sequence Number", 1);
    capture *camera = opened(&wish, "wrap");
    if (camera) {
        const series all = take(camera, 200, 2000);
        check(all.frames == 200 && all.out_of_order == 0, "wrap in order", "%u frames, %u wrong",
              all.frames, all.out_of_order);
        /* How the port counts its first frame is its own affair; the span is not. */
        check(all.last_sequence - all.first_sequence == 199 + all.missed, "wrap is carried on",
              "from %llu to %llu, %u missed", (unsigned long long)all.first_sequence,
              (unsigned long long)all.last_sequence, (unsigned)all.missed);
        capture_counts counts;
        capture_get_counts(camera, &counts);
        check(counts.restarts == 0 && counts.missed < 100, "wrap does no harm", "%llu missed",
              (unsigned long long)counts.missed);
        capture_close(camera);
    }
    (void)knob_set(arguments[0], "Wrap Sequence Number", 0);
}

/* Frames for 18 seconds; how many are wrong, and how far the clocks of frames and of this program
 * are apart in the end. */
static series take_long(capture *camera, unsigned *wrong, int64_t *apart_us)
{
    const uint64_t start = now_ms();
    series part = take(camera, 1, 2000), all = part;
    const uint64_t first = now_ms();
    while (now_ms() - start < 18000u && part.status == CAPTURE_OK) {
        part = take(camera, 5, 2000);
        *wrong += part.out_of_order + (part.first_us < all.last_us ? 1u : 0u);
        all.frames += part.frames;
        all.last_us = part.last_us;
        all.status = part.status;
    }
    *apart_us = (int64_t)(all.last_us - all.first_us) - (int64_t)(now_ms() - first) * 1000;
    return all;
}

/* The driver's clock passes its end 16 seconds after the start. */
void group_clock(int count, char **arguments)
{
    const char *device = arguments[0], *which = arguments[1];
    capture_wish wish = small_wish(device);
    (void)count;
    wish.rate_num = 5;
    if (knob_choose(device, "Wrap Timestamp", which) < 0) {
        check_in(0, "clock", which, "the driver cannot");
        return;
    }
    capture *camera = opened(&wish, "clock");
    if (camera) {
        unsigned wrong = 0;
        int64_t apart_us = 0;
        const series all = take_long(camera, &wrong, &apart_us);
        check_in(all.frames >= 60 && wrong == 0 && all.status == CAPTURE_OK, "clock", which,
                 "%u frames, %u wrong, %s", all.frames, wrong, told(all.status, camera));
        check_in(apart_us > -1000000 && apart_us < 1000000, "clock goes on", which,
                 "%lld us from this program's", (long long)apart_us);
        capture_close(camera);
    }
    (void)knob_choose(device, "Wrap Timestamp", "None");
}
