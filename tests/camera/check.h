/* What the checks with virtual cameras share: how they report, and how they open a camera. */
#ifndef CAMERA_CHECK_H
#define CAMERA_CHECK_H

#include <stddef.h>
#include <stdint.h>

#include "capture.h"

/* One line 'ok NAME' or 'FAIL NAME: remark'; the remark is made as by printf. Returns `good`. */
int check(int good, const char *name, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same of a name that is put together: `group` and `what` with a blank between them. */
int check_in(int good, const char *group, const char *what, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* The text of a status and what the camera says of it, for remarks; overwritten by the next call.
 */
const char *told(capture_status status, const capture *camera);

/* What is wanted of most cameras here: this device, YUYV, 320x180, as fast as can be. */
capture_wish small_wish(const char *device);

/* Opens and starts; says so as a failed check of that name, closes and returns NULL if it fails. */
capture *opened(const capture_wish *wish, const char *name);

/*
 * What came of a number of frames. A frame is out of order if its sequence number is not that of
 * the one before, plus one, plus what it says was missed, or if its time is before that one's.
 */
typedef struct series {
    unsigned frames;
    unsigned out_of_order;
    uint64_t missed; /* as the frames themselves say */
    uint64_t first_sequence, last_sequence, first_us, last_us;
    capture_status status; /* of the last capture_next */
} series;

/* Takes `count` frames, or as many as come, each within `deadline_ms`, and gives them back. */
series take(capture *camera, unsigned count, unsigned deadline_ms);

/* Milliseconds of a clock that nobody sets. */
uint64_t now_ms(void);
void pause_ms(unsigned ms);

/* The groups of checks: what main takes as its first argument; `arguments` are the others. */
typedef void check_group(int count, char **arguments);

check_group group_list, group_kinds, group_access, group_busy;
check_group group_pictures, group_ranges, group_sizes, group_changed;
check_group group_controls;
check_group group_setup_errors, group_stream_errors, group_dropped, group_wrap, group_clock;
check_group group_stale, group_signals;
check_group group_unplugged, group_removed;
check_group group_feed, group_fed, group_stalled;

#endif
