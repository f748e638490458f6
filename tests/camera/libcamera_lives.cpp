/* Random lives of a camera behind the libcamera backend, with all that happens foretold. */
#include "libcamera_replay.hpp"

#include <cstdio>
#include <deque>
#include <vector>

static uint32_t random_state;

static uint32_t random_below(uint32_t limit)
{
    random_state = random_state * 1664525U + 1013904223U;
    return (random_state >> 8) % limit;
}

struct arrival {
    enum { good, damaged, short_frame } kind;
    uint32_t sequence;
};

struct story {
    capture *camera;
    bool newest;
    std::vector<capture_frame> held;
    std::deque<arrival> arrived; /* and not looked at */
    uint32_t sequence = 0;       /* the camera's next */
    bool present = true;
    bool known = false; /* a frame of this run was looked at: its number */
    uint32_t last = 0;
    capture_counts expected = {};
    bool any = false; /* delivered since the start: its number */
    uint64_t last_delivered = 0;
};

static void deliver_something(story *s)
{
    const uint32_t kind = random_below(8);
    arrival made = {arrival::good, 0};

    s->sequence += random_below(4) == 0 ? 1 + random_below(3) : 0;
    made.sequence = s->sequence++;
    if (kind == 0) {
        made.kind = arrival::damaged;
    } else if (kind == 1) {
        made.kind = arrival::short_frame;
    }
    if (fake_deliver(made.sequence,
                     kind == 0 ? libcamera::FrameMetadata::FrameError
                               : libcamera::FrameMetadata::FrameSuccess,
                     kind == 1 ? 5 : 0)) {
        s->arrived.push_back(made);
    }
}

/* What capture_next should do with what has arrived: true and the frame's low byte, or nothing. */
static bool expect_one(story *s, uint8_t *byte)
{
    bool found = false;

    while (!s->arrived.empty() && (s->newest || !found)) {
        const arrival one = s->arrived.front();

        s->arrived.pop_front();
        s->expected.missed += s->known ? one.sequence - s->last - 1 : 0;
        s->known = true;
        s->last = one.sequence;
        s->expected.damaged += one.kind == arrival::damaged;
        s->expected.short_frames += one.kind == arrival::short_frame;
        if (one.kind == arrival::good) {
            s->expected.stale += found;
            found = true;
            *byte = static_cast<uint8_t>(one.sequence);
        }
    }
    s->expected.frames += found;
    return found;
}

static bool take_one(story *s)
{
    capture_frame frame;
    uint8_t byte = 0;
    const bool expected = expect_one(s, &byte);
    const capture_status status = capture_next(s->camera, 0, &frame);

    if (status == CAPTURE_OK) {
        const bool right = expected && frame.bytes[0] == byte &&
                           frame.bytes == frame.view.plane[0] &&
                           (!s->any || frame.sequence > s->last_delivered);

        s->any = true;
        s->last_delivered = frame.sequence;
        s->held.push_back(frame);
        return right;
    }
    return !expected &&
           (status == CAPTURE_TIMEOUT || (status == CAPTURE_ERR_ORDER && s->held.size() >= 4));
}

static bool give_one(story *s)
{
    if (s->held.empty()) {
        return true;
    }
    const size_t which = random_below(static_cast<uint32_t>(s->held.size()));
    capture_frame frame = s->held[which];

    s->held.erase(s->held.begin() + static_cast<long>(which));
    return capture_give_back(s->camera, &frame) == CAPTURE_OK;
}

/* What had arrived is lost with the camera. */
static bool unplug_now(story *s)
{
    capture_frame frame;

    s->present = false;
    s->arrived.clear();
    fake_unplug();
    return capture_next(s->camera, 0, &frame) == CAPTURE_TIMEOUT;
}

/* The next call finds it. */
static bool return_now(story *s)
{
    capture_frame frame;

    s->present = true;
    s->sequence = random_below(3);
    s->known = false;
    s->expected.reopens++;
    fake_return();
    return capture_next(s->camera, 0, &frame) == CAPTURE_TIMEOUT;
}

static bool stop_and_start(story *s)
{
    s->arrived.clear();
    s->known = false;
    s->sequence = random_below(3);
    s->any = false;
    if (capture_stop(s->camera) != CAPTURE_OK || capture_start(s->camera) != CAPTURE_OK) {
        return false;
    }
    /* Frames of before are taken without complaint, and change nothing. */
    bool good = true;
    while (!s->held.empty()) {
        good = give_one(s) && good;
    }
    return good && fake_queue.size() == 4;
}

static bool step(story *s)
{
    const uint32_t choice = random_below(40);

    if (choice < 16) {
        if (s->present) {
            deliver_something(s);
        }
        return true;
    }
    if (choice < 28) {
        return take_one(s);
    }
    if (choice < 35) {
        return give_one(s);
    }
    if (choice < 37) {
        return !s->present || unplug_now(s);
    }
    if (choice < 39) {
        return s->present || return_now(s);
    }
    return !s->present || stop_and_start(s);
}

static bool same_counts(const capture_counts &a, const capture_counts &b)
{
    return a.frames == b.frames && a.missed == b.missed && a.stale == b.stale &&
           a.damaged == b.damaged && a.short_frames == b.short_frames && a.timeouts == b.timeouts &&
           a.restarts == b.restarts && a.reopens == b.reopens;
}

static bool random_story(uint32_t seed, bool newest)
{
    capture_wish wish = wish_of(320, 240);
    story s;
    bool good = true;

    random_state = seed;
    s.newest = newest;
    wish.newest = newest;
    wish.return_ms = 3600000;
    wish.buffers = 4;
    if (capture_open(&wish, nullptr, &s.camera) < 0 || capture_start(s.camera) < 0) {
        return false;
    }
    for (int i = 0; i < 100 && good; i++) {
        good = step(&s);
    }
    good = good && same_counts(counts_of(s.camera), s.expected);
    if (random_below(2)) {
        good = capture_stop(s.camera) == CAPTURE_OK && good;
    }
    capture_close(s.camera);
    return good && account.faults == 0 && account.requests == 0 && account.buffers == 0 &&
           account.cameras == 0 && account.managers == 0 && account.acquired == 0;
}

void test_random(uint32_t stories)
{
    uint32_t wrong = 0;

    reset();
    for (uint32_t seed = 1; seed <= stories; seed++) {
        if (!random_story(seed, seed % 2 == 0)) {
            std::printf("story %u, faults %d\n", seed, account.faults);
            wrong++;
            account = {};
        }
        fake_queue.clear();
    }
    check(wrong == 0, "%u of %u random sequences went wrong", wrong, stories);
    account = {};
}
