/* Sequence numbers and timestamps that never go back, whatever the driver's do. */
#include "v4l2_camera.h"

void v4l2_track_restart(v4l2_track *track)
{
    track->known = 0;
    track->dropped = 0;
}

void v4l2_track_drop(v4l2_track *track)
{
    track->dropped++;
}

/* How far a clock went from `last` to `now`, both in microseconds. Where it went back, it may have
 * wrapped: after 2^31 or 2^32 seconds, or 2^64 nanoseconds; if it did not, time stands still. */
static uint64_t time_passed(int64_t last, int64_t now)
{
    static const uint64_t wraps_us[] = {
        (UINT64_C(1) << 31) * 1000000u,
        (UINT64_C(1) << 32) * 1000000u,
        UINT64_C(18446744073709552),
    };
    const uint64_t longest_us = 60000000;

    if (now >= last) {
        return (uint64_t)now - (uint64_t)last;
    }
    for (unsigned i = 0; i < sizeof wraps_us / sizeof wraps_us[0]; i++) {
        const uint64_t passed = (uint64_t)now + wraps_us[i] - (uint64_t)last;

        if (passed <= longest_us) {
            return passed;
        }
    }
    return 0;
}

static void take_time(v4l2_track *track, int64_t time_us)
{
    const uint64_t said = time_us > 0 ? (uint64_t)time_us : 0;

    if (track->known) {
        track->timestamp += time_passed(track->last_us, time_us);
    } else if (!track->any || said > track->timestamp) {
        track->timestamp = said;
    }
    track->last_us = time_us;
}

/*
 * How many frames are missing is told by the numbers of good buffers and by how many damaged ones
 * came between them; the numbers of damaged ones are not trusted. A number that repeats or goes
 * back (a driver that does not count, or started again) tells nothing.
 */
uint32_t v4l2_track_take(v4l2_track *track, uint32_t sequence, int64_t time_us)
{
    const uint32_t step = sequence - track->last;
    uint32_t missing = 0;

    if (!track->known) {
        track->sequence = track->any ? track->sequence + 1 : sequence;
    } else if (step == 0 || step > UINT32_MAX / 2) {
        track->sequence += 1 + (uint64_t)track->dropped;
    } else {
        track->sequence += step;
        missing = step - 1 > track->dropped ? step - 1 - track->dropped : 0;
    }
    take_time(track, time_us);
    track->last = sequence;
    track->known = 1;
    track->any = 1;
    track->dropped = 0;
    track->missed = missing < UINT32_MAX - track->missed ? track->missed + missing : UINT32_MAX;
    return missing;
}
