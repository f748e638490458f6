/*
 * Random lives of cameras: each is a camera with random habits, a caller with random wishes, and
 * random faults in every call. Whatever happens, no wrong frame is delivered, what is counted is
 * what was done, deadlines hold, a camera that is well again delivers again, and in the end nothing
 * is open, mapped, queued or allocated.
 *     random [LIVES [SEED]]        prints the seed; a life that fails prints its own
 */
#include "replay.h"

#include <errno.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HELD_MAX = 40 };

typedef struct held_frame {
    capture_frame frame;
    capture_settings settings; /* of when it was taken */
    uint32_t id;
} held_frame;

/* One life. */
typedef struct life {
    replay world;
    capture_wish wish;
    capture *camera;
    held_frame held[HELD_MAX];
    unsigned held_count;
    uint32_t last_id;
    uint64_t last_sequence, last_time_us;
    int any; /* a frame since the last start */
    uint64_t delivered, waits_in_vain;
    uint64_t starts;        /* done */
    uint64_t first_starts;  /* of them, the first on the device as it was opened */
    uint64_t reopen_starts; /* of them, those that opened a lost device again */
    int failing;            /* calls failed at random */
    int failed;
    uint64_t seed;
} life;

/* What the lives went through, so that a test that tests nothing is noticed. */
typedef struct totals {
    uint64_t lives, failed, opened, started;
    capture_counts counts;
} totals;

static life now;

#ifdef __GNUC__
__attribute__((format(printf, 1, 2)))
#endif
static void
fail(const char *format, ...)
{
    va_list arguments;

    printf("seed %" PRIu64 ": ", now.seed);
    va_start(arguments, format);
    vprintf(format, arguments);
    va_end(arguments);
    printf("\n");
    now.failed = 1;
}

static uint32_t below(uint32_t limit)
{
    return replay_random(&now.world) % limit;
}

static int chance(unsigned per_mille)
{
    return replay_chance(&now.world, per_mille);
}

/* ---- A random camera and a random wish ----------------------------------------------------- */

static const uint32_t formats[] = {
    V4L2_PIX_FMT_YUYV,   V4L2_PIX_FMT_UYVY, V4L2_PIX_FMT_NV12,  V4L2_PIX_FMT_YUV420,
    V4L2_PIX_FMT_RGB565, V4L2_PIX_FMT_GREY, V4L2_PIX_FMT_RGB24, V4L2_PIX_FMT_SGRBG8,
    V4L2_PIX_FMT_MJPEG,  V4L2_PIX_FMT_Y16,
};

static uint32_t random_format(void)
{
    return formats[below(sizeof formats / sizeof formats[0])];
}

static void make_modes(replay_node *node)
{
    node->mode_count = 1 + below(6);
    for (unsigned i = 0; i < node->mode_count; i++) {
        node->modes[i].fourcc = i > 0 && chance(600) ? node->modes[i - 1].fourcc : random_format();
        node->modes[i].width = 8 + below(14) * (chance(900) ? 2 : 1);
        node->modes[i].height = 4 + below(8) * (chance(900) ? 2 : 1);
        node->modes[i].rate = 1 + below(60);
    }
}

static void make_strange(replay_node *node)
{
    node->no_formats = chance(50);
    node->no_sizes = chance(50);
    node->no_rates = chance(50);
    node->endless = chance(5);
    node->stepwise = chance(100);
    node->no_get_format = chance(50);
    node->no_parm = chance(50);
    node->rate_ignored = chance(100);
    node->no_next_control = chance(50);
    node->force_fourcc = chance(50) ? random_format() : 0;
    node->force_width = chance(50) ? 8 + below(40) : 0;
    node->force_height = chance(50) ? 4 + below(20) : 0;
    node->format_lies = chance(100);
    node->stride_extra = chance(300) ? below(40) : 0;
    node->size_extra = chance(300) ? below(4000) : 0;
    node->no_stride = node->stride_extra == 0 && chance(50);
    node->quantization = below(3);
    node->buffers_min = chance(100) ? 1 + below(40) : 0;
    node->buffers_max = chance(100) ? 1 + below(40) : 0;
    node->buffers_max = node->buffers_max && node->buffers_max < node->buffers_min
                            ? node->buffers_min
                            : node->buffers_max;
    node->buffers_max = node->buffers_min > 32 ? 40 : node->buffers_max;
    node->buffer_cut = node->data_offset == 0 && chance(20) ? 1 + below(30) : 0;
    node->no_tail = node->buffer_cut == 0 && chance(200);
    node->keeps_mapped = chance(100);
    for (unsigned i = 0; i < node->control_count; i++) {
        node->controls[i].ignored = chance(200);
        node->controls[i].step = 1 + (int32_t)below(3);
    }
}

static void make_clock(replay_node *node)
{
    const int64_t wrap = (INT64_C(1) << 31) * 1000000;

    node->no_sequence = chance(50);
    node->first_sequence = chance(200) ? UINT32_MAX - below(20) : 0;
    node->no_time = chance(50);
    if (chance(200)) {
        node->first_time_us = wrap - (int64_t)now.world.now_us - (int64_t)below(3000000);
        node->time_low_us = chance(500) ? 0 : -wrap;
        node->time_period_us = wrap - node->time_low_us;
    }
}

static void make_faults(replay_node *node)
{
    const unsigned severity = below(4); /* 0: none at all */

    node->format_lies &= !node->no_get_format;
    if (severity == 0) {
        return;
    }
    now.world.interrupt = chance(500) ? below(100) : 0;
    now.world.fail = chance(500) ? below(10 * severity) : 0;
    /* A lie is found out by asking again; not where asking fails, too. */
    node->format_lies &= now.world.fail == 0;
    node->damage = chance(500) ? below(150 * severity) : 0;
    node->shorten = chance(500) ? below(100 * severity) : 0;
    node->lose = chance(500) ? below(150 * severity) : 0;
    node->unplug_after = chance(300) ? 1 + below(20) : 0;
    node->back_after_us = chance(800) ? below(3000000) : 0;
    node->back_number = chance(300) ? 1 + below(60) : node->number;
    node->back_force_width = chance(30) ? 8 + below(40) : 0;
}

static void make_wish(void)
{
    static const char *const devices[] = {"/dev/video0", "/dev/video0", "usb-replay-1",
                                          "Replayed",    NULL,          "Nobody"};
    capture_wish *const wish = &now.wish;

    memset(wish, 0, sizeof *wish);
    wish->device = devices[below(chance(100) ? 6 : 5)];
    wish->fourcc = chance(300) ? random_format() : 0;
    wish->width = chance(700) ? below(60) : 0;
    wish->height = chance(700) ? below(40) : 0;
    wish->rate_num = chance(400) ? 1 + below(60) : 0;
    wish->rate_den = wish->rate_num ? 1 + below(2) : 0;
    wish->buffers = chance(500) ? 2 + below(31) : 0;
    wish->newest = chance(300);
    wish->restart_after = below(5);
    wish->return_ms = chance(600) ? below(5000) : 0;
}

static void make_life(void)
{
    replay_node *const node = &now.world.nodes[0];

    if (chance(300)) {
        node->caps = V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_STREAMING;
        node->data_offset = below(3) * 32;
    }
    make_modes(node);
    if (chance(700)) {
        make_strange(node);
    }
    make_clock(node);
    make_faults(node);
    make_wish();
    if (chance(200)) {
        replay_add_camera(&now.world, 1, 1 + below(5), chance(500) ? "Replayed Twin" : "Other",
                          "usb-other");
        now.world.nodes[1].open_error = chance(500) ? EACCES : 0;
    }
}

/* ---- What the caller does ------------------------------------------------------------------ */

static void check_held(const held_frame *held)
{
    uint32_t id = 0;
    const char *const wrong = replay_check_frame(&now.world, &held->settings, &held->frame, &id);

    if (wrong || id != held->id) {
        fail("frame %" PRIu32 " while it is held: %s", held->id, wrong ? wrong : "overwritten");
    }
}

static void give_back(unsigned which)
{
    capture_status status;

    check_held(&now.held[which]);
    status = capture_give_back(now.camera, &now.held[which].frame);
    if (status != CAPTURE_OK) {
        fail("giving back: %s (%s)", capture_status_name(status), capture_error(now.camera));
    }
    now.held[which] = now.held[--now.held_count];
}

static void take_in(const capture_frame *frame)
{
    held_frame *const held = &now.held[now.held_count++];
    const char *wrong;

    held->frame = *frame;
    capture_get_settings(now.camera, &held->settings);
    wrong = replay_check_frame(&now.world, &held->settings, frame, &held->id);
    if (wrong) {
        fail("wrong frame: %s", wrong);
    }
    if (held->id <= now.last_id) {
        fail("frame %" PRIu32 " after frame %" PRIu32, held->id, now.last_id);
    }
    if (now.any && frame->sequence <= now.last_sequence) {
        fail("the sequence goes back");
    }
    if (now.any && frame->timestamp_us < now.last_time_us) {
        fail("time goes back");
    }
    now.last_id = held->id;
    now.last_sequence = frame->sequence;
    now.last_time_us = frame->timestamp_us;
    now.any = 1;
    now.delivered++;
}

static unsigned frame_ms(void)
{
    const unsigned rate = now.world.nodes[0].rate;

    return 1000 / (rate ? rate : 1) + 1;
}

/* Longest times of things that have no deadline of their own: opening, restarting. */
static void check_deadline(uint64_t before_us, unsigned deadline_ms)
{
    const uint64_t took_us = now.world.now_us - before_us;
    /* Interrupted waits and every call take some time, and a last attempt may begin in time. */
    const uint64_t allowed_us = (uint64_t)deadline_ms * 1000 + 40000 + 33 * 1000 * frame_ms();

    if (took_us > allowed_us) {
        fail("%" PRIu64 " us for a deadline of %u ms", took_us, deadline_ms);
    }
}

static capture_status next(unsigned deadline_ms)
{
    const uint64_t before_us = now.world.now_us;
    capture_frame frame;
    const capture_status status = capture_next(now.camera, deadline_ms, &frame);

    check_deadline(before_us, deadline_ms);
    if (status == CAPTURE_OK) {
        take_in(&frame);
    } else if (frame.bytes || frame.slot) {
        fail("a frame, and yet %s", capture_status_name(status));
    }
    now.waits_in_vain += status == CAPTURE_TIMEOUT && deadline_ms > 0;
    return status;
}

static int start(void)
{
    const uint64_t streams = now.world.counts.stream_ons;
    const uint64_t fresh = now.world.counts.first_stream_ons;
    capture_counts counts;
    uint64_t reopens;
    capture_status status;

    capture_get_counts(now.camera, &counts);
    reopens = counts.reopens;
    status = capture_start(now.camera);
    capture_get_counts(now.camera, &counts);
    if (status != CAPTURE_OK) {
        if (now.world.counts.stream_ons != streams) {
            fail("started, and yet %s", capture_status_name(status));
        }
        return 0;
    }
    now.any = 0;
    now.starts++;
    now.reopen_starts += counts.reopens - reopens;
    now.first_starts += now.world.counts.first_stream_ons - fresh - (counts.reopens - reopens);
    return 1;
}

/* Stopping lets go of all: frames that were held are no longer looked at. */
static void stop(void)
{
    capture_stop(now.camera);
    now.held_count = 0;
    if (replay_map_count(&now.world)) {
        fail("stopped, and yet %u maps", replay_map_count(&now.world));
    }
}

static void meddle(void)
{
    replay_node *const node = &now.world.nodes[0];

    switch (below(8)) {
    case 0:
        node->stalled = 1;
        break;
    case 1:
        node->broken = 1;
        break;
    case 2:
        node->spurious = !node->spurious;
        break;
    case 3:
        node->bad_index = chance(500) ? REPLAY_NO_SUCH : REPLAY_NOT_QUEUED;
        break;
    case 4:
        if (node->present && node->buffer_count == 0) { /* another program */
            node->width = 8 + 2 * below(10);
        }
        break;
    case 5:
        if (node->present) {
            replay_unplug(&now.world, node);
        }
        break;
    case 6:
        now.world.now_us += below(2000000);
        break;
    default:
        node->first_time_us -= (int64_t)below(5000000);
        break;
    }
}

static void use_controls(void)
{
    static const uint32_t ids[] = {V4L2_CID_GAIN, V4L2_CID_POWER_LINE_FREQUENCY,
                                   V4L2_CID_EXPOSURE_ABSOLUTE, V4L2_CID_HUE};
    capture_control controls[4];
    const uint32_t id = ids[below(4)];
    const int32_t value = (int32_t)below(120) - 5;
    int32_t actual = 0;
    char text[32];
    const capture_status status = capture_set(now.camera, id, value, &actual);

    if (status == CAPTURE_OK && actual != value) {
        fail("a control is %" PRId32 " and not %" PRId32 ", and that is not said", actual, value);
    }
    if (status == CAPTURE_CHANGED && actual == value) {
        fail("a control is as it was asked for, and that is complained of");
    }
    capture_controls(now.camera, controls, below(5));
    capture_menu_item(now.camera, id, (int32_t)below(5) - 1, text);
}

static void act(int *started)
{
    const unsigned what = below(100);

    if (chance(200)) { /* the caller is busy elsewhere */
        now.world.now_us += below(300000);
    }
    if (what < 4) {
        use_controls();
    } else if (what < 7) {
        stop();
        *started = 0;
    } else if (what < 11 && now.world.fail > 0) {
        meddle();
    } else if (what < 35 && now.held_count > 0) {
        give_back(below(now.held_count));
    } else if (*started && now.held_count < HELD_MAX) {
        static const unsigned deadlines[] = {0, 1, 20, 200, 1000};

        next(deadlines[below(5)]);
    } else if (!*started) {
        *started = start();
    }
}

/* ---- In the end ---------------------------------------------------------------------------- */

/* All is well again: then frames must come, unless the camera is away or was changed. */
static void check_recovery(int started)
{
    replay_node *const node = &now.world.nodes[0];
    capture_status status = CAPTURE_TIMEOUT;

    now.failing = now.world.fail > 0;
    now.world.interrupt = now.world.fail = 0;
    node->damage = node->shorten = node->lose = 0;
    node->spurious = node->bad_index = 0;
    node->unplug_after = 0;
    while (now.held_count > 0) {
        give_back(0);
    }
    if (!started) {
        return;
    }
    for (unsigned i = 0; i < 12 && status != CAPTURE_OK && status != CAPTURE_ERR_GONE; i++) {
        status = next(2500);
    }
    if (status == CAPTURE_OK) {
        give_back(0);
    } else if (status == CAPTURE_ERR_GONE) {
        /* Only of a camera that was away at some time, or that could not be stopped. */
        if (node->instance == 0 && !now.failing) {
            fail("gone, but it was never away: %s", capture_error(now.camera));
        }
    } else {
        fail("well again, but %s: %s", capture_status_name(status), capture_error(now.camera));
    }
}

static void equal(const char *what, uint64_t counted, uint64_t done)
{
    if (counted != done) {
        fail("%s: counted %" PRIu64 ", but it was %" PRIu64, what, counted, done);
    }
}

static void check_counts(totals *all)
{
    const replay_counts *const done = &now.world.counts;
    capture_counts counts;

    capture_get_counts(now.camera, &counts);
    equal("frames", counts.frames, now.delivered);
    equal("missed", counts.missed, done->missed);
    equal("stale", counts.stale, done->good - now.delivered);
    equal("damaged", counts.damaged, done->damaged);
    equal("short", counts.short_frames, done->short_frames);
    equal("timeouts", counts.timeouts, now.waits_in_vain);
    equal("interrupted", counts.interrupted, done->interrupted);
    equal("streams", now.starts + counts.restarts + counts.reopens - now.reopen_starts,
          done->stream_ons);
    equal("reopens", counts.reopens + now.first_starts, done->first_stream_ons);
    all->counts.frames += counts.frames;
    all->counts.missed += counts.missed;
    all->counts.stale += counts.stale;
    all->counts.damaged += counts.damaged;
    all->counts.short_frames += counts.short_frames;
    all->counts.timeouts += counts.timeouts;
    all->counts.interrupted += counts.interrupted;
    all->counts.restarts += counts.restarts;
    all->counts.reopens += counts.reopens;
}

static void check_nothing_left(void)
{
    equal("open descriptors", replay_open_count(&now.world), 0);
    equal("maps", replay_map_count(&now.world), 0);
    equal("queued buffers", replay_queued_count(&now.world), 0);
    equal("buffers", replay_buffer_count(&now.world), 0);
    equal("misuse", (uint64_t)now.world.misuse, 0);
}

static void live(uint64_t seed, totals *all)
{
    capture_status status;
    unsigned acts;
    int started;

    memset(&now, 0, sizeof now);
    now.seed = seed;
    replay_init(&now.world);
    now.world.random = seed;
    make_life();
    status = capture_open(&now.wish, &now.world.calls, &now.camera);
    if (status >= 0) {
        all->opened++;
        started = start();
        acts = below(120);
        for (unsigned i = 0; i < acts && !now.failed; i++) {
            act(&started);
        }
        check_recovery(started);
        all->started += now.starts > 0;
    } else if (capture_error(now.camera)[0] == '\0') {
        fail("%s without a reason", capture_status_name(status));
    }
    check_counts(all);
    capture_close(now.camera);
    check_nothing_left();
    replay_free(&now.world);
    all->lives++;
    all->failed += now.failed != 0;
}

/* 0 if any kind of event did not happen in many lives: then they test less than they seem to. */
static int is_eventful(const totals *all)
{
    const capture_counts *const counts = &all->counts;

    return all->lives < 1000 ||
           (all->started * 2 > all->lives && counts->frames > 10 * all->lives &&
            counts->missed > all->lives && counts->stale > all->lives / 10 &&
            counts->damaged > all->lives / 10 && counts->short_frames > all->lives / 10 &&
            counts->timeouts > all->lives / 10 && counts->interrupted > all->lives &&
            counts->restarts > all->lives / 10 && counts->reopens > all->lives / 20);
}

int main(int count, char **arguments)
{
    const uint64_t lives = count > 1 ? strtoull(arguments[1], NULL, 10) : 12000;
    const uint64_t seed = count > 2 ? strtoull(arguments[2], NULL, 10) : 1;
    totals all;

    memset(&all, 0, sizeof all);
    printf("seed %" PRIu64 ", %" PRIu64 " lives\n", seed, lives);
    for (uint64_t i = 0; i < lives && all.failed < 20; i++) {
        live(seed + i, &all);
    }
    printf("%" PRIu64 " opened, %" PRIu64 " started; frames %" PRIu64 ", missed %" PRIu64
           ", stale %" PRIu64 ", damaged %" PRIu64 ", short %" PRIu64 "\n",
           all.opened, all.started, all.counts.frames, all.counts.missed, all.counts.stale,
           all.counts.damaged, all.counts.short_frames);
    printf("time-outs %" PRIu64 ", interrupted %" PRIu64 ", restarts %" PRIu64 ", reopens %" PRIu64
           "\n",
           all.counts.timeouts, all.counts.interrupted, all.counts.restarts, all.counts.reopens);
    if (!is_eventful(&all)) {
        printf("too little happened\n");
        all.failed++;
    }
    printf("%" PRIu64 " passed, %" PRIu64 " failed\n", all.lives - all.failed, all.failed);
    return all.failed > 0 || all.lives == 0;
}
