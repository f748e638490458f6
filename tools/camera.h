/*
 * Frames of a camera for commands: their options, opening with messages that say what to do, and
 * the loop. Ctrl-C (SIGINT) and SIGTERM end the loop after a whole frame; a second one kills.
 */
#ifndef CAMERA_H
#define CAMERA_H

#include <getopt.h>
#include <stdint.h>

#include <pel.h>

#include "walk.h"

#ifdef PEL_HAS_CAMERAS

#include <capture.h>

typedef enum camera_mode { CAMERA_LEAVE, CAMERA_AUTO, CAMERA_MANUAL } camera_mode;

typedef struct camera_setting {
    camera_mode mode;
    int32_t value; /* of CAMERA_MANUAL */
} camera_setting;

/* Zero is what there is without options. */
typedef struct camera_options {
    capture_wish wish;
    unsigned given; /* how many options were */
    camera_setting exposure, white_balance, gain, power_line;
    int lock, has_settle;
    unsigned long settle;   /* frames that are skipped first */
    unsigned long count;    /* frames to deliver; 0: no end */
    unsigned long milli_s;  /* stop so long after the first; 0: no end */
    unsigned long patience; /* seconds without a frame after which to give up; 0: 10 */
    int has_range;
    pel_range range; /* YCbCr frames are converted to it, if has_range */
} camera_options;

/* For the table of getopt_long; -d is a short one, "d:". */
enum {
    CAMERA_OPTION_DEVICE = 'd',
    CAMERA_OPTION_FIRST = 1000,
    CAMERA_OPTION_BACKEND = CAMERA_OPTION_FIRST,
    CAMERA_OPTION_SIZE,
    CAMERA_OPTION_FORMAT,
    CAMERA_OPTION_RATE,
    CAMERA_OPTION_COUNT,
    CAMERA_OPTION_SECONDS,
    CAMERA_OPTION_SETTLE,
    CAMERA_OPTION_LOCK,
    CAMERA_OPTION_EXPOSURE,
    CAMERA_OPTION_WHITE_BALANCE,
    CAMERA_OPTION_GAIN,
    CAMERA_OPTION_POWER_LINE,
    CAMERA_OPTION_PATIENCE,
    CAMERA_OPTION_RECONNECT,
    CAMERA_OPTION_NEWEST
};
/* clang-format off */
#define CAMERA_OPTIONS                                                                             \
    {"device", required_argument, NULL, CAMERA_OPTION_DEVICE},                                     \
    {"camera", required_argument, NULL, CAMERA_OPTION_DEVICE},                                     \
    {"backend", required_argument, NULL, CAMERA_OPTION_BACKEND},                                   \
    {"size", required_argument, NULL, CAMERA_OPTION_SIZE},                                         \
    {"format", required_argument, NULL, CAMERA_OPTION_FORMAT},                                     \
    {"rate", required_argument, NULL, CAMERA_OPTION_RATE},                                         \
    {"count", required_argument, NULL, CAMERA_OPTION_COUNT},                                       \
    {"seconds", required_argument, NULL, CAMERA_OPTION_SECONDS},                                   \
    {"settle", required_argument, NULL, CAMERA_OPTION_SETTLE},                                     \
    {"lock", no_argument, NULL, CAMERA_OPTION_LOCK},                                               \
    {"exposure", required_argument, NULL, CAMERA_OPTION_EXPOSURE},                                 \
    {"white-balance", required_argument, NULL, CAMERA_OPTION_WHITE_BALANCE},                       \
    {"gain", required_argument, NULL, CAMERA_OPTION_GAIN},                                         \
    {"power-line", required_argument, NULL, CAMERA_OPTION_POWER_LINE},                             \
    {"patience", required_argument, NULL, CAMERA_OPTION_PATIENCE},                                 \
    {"reconnect", required_argument, NULL, CAMERA_OPTION_RECONNECT},                               \
    {"newest", no_argument, NULL, CAMERA_OPTION_NEWEST}
/* clang-format on */

typedef struct camera camera;

/* Opens and starts, sets what is asked for, skips frames, locks. NULL after a message, or after a
 * signal: then camera_was_interrupted. What the driver changed is said on standard error. */
camera *camera_open(const camera_options *options);
int camera_was_interrupted(void);

/* A frame for its reader, valid until the next call. */
typedef struct camera_frame {
    pel_cview view;
    uint64_t sequence, timestamp_us;
} camera_frame;

/* The next frame: 1, 0 at the end (count, time, signal), -1 after a message. */
int camera_next(camera *from, camera_frame *frame);

const capture_settings *camera_settings(const camera *of);

/* The camera, the format and the controls in lines of text, as they are now. Valid until close. */
const char *camera_comment(camera *of);

/* Frames that were lost on the way, of all since open; the rate is in thousandths per second. */
uint64_t camera_lost(const camera *of);
unsigned long camera_rate_milli(const camera *of);

void camera_close(camera *of);

/* A status of the port in words, with what to do about it. Returns -1. */
int camera_refuse(const capture *device, const char *name, capture_status status);

#else

/* Without cameras: -d is known, so that what it wants can be said. */
typedef struct camera_options {
    unsigned given;
} camera_options;

enum { CAMERA_OPTION_DEVICE = 'd' };
/* clang-format off */
#define CAMERA_OPTIONS                                                                             \
    {"device", required_argument, NULL, CAMERA_OPTION_DEVICE},                                     \
    {"camera", required_argument, NULL, CAMERA_OPTION_DEVICE}
/* clang-format on */

/* Says that this build has no cameras; returns the exit status. */
int camera_missing(const char *command);

#endif

/* Takes what getopt_long has just returned if it is one of CAMERA_OPTIONS: 1 taken, 0 another
 * option, -1 after a message. */
int camera_option(int option, camera_options *options);

/* Visits the frames of a camera like walk_frames those of files. */
int camera_walk(const camera_options *options, walk_visit *visit, void *user);

#endif
