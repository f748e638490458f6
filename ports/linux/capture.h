/*
 * Frames from the cameras of a Linux computer: V4L2 and libcamera behind one door.
 *
 *     capture_wish wish = {0};              everything zero: the first camera, its best format
 *     capture *camera;
 *     capture_frame frame;
 *
 *     wish.width = 640;
 *     wish.height = 480;
 *     if (capture_open(&wish, NULL, &camera) < 0)       says why in capture_error(camera)
 *         ...
 *     capture_start(camera);
 *     while (capture_next(camera, 1000, &frame) == CAPTURE_OK) {
 *         use(&frame.view);                 the driver's memory: no copy was made
 *         capture_give_back(camera, &frame);
 *     }
 *     capture_close(camera);
 *
 * What a camera does wrong is either healed and counted (a lost frame, a damaged one, a device that
 * was unplugged and comes back) or said by a status; nothing is believed that was not read back.
 * One thread per camera. Memory comes from the heap at open and goes at close.
 */
#ifndef CAPTURE_H
#define CAPTURE_H

#include <stddef.h>
#include <stdint.h>

#include <pel.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Statuses ------------------------------------------------------------------------------ */

/* Negative: failed. 0: done. Positive: done, but not as wished. */
typedef enum capture_status {
    CAPTURE_OK = 0,
    CAPTURE_CHANGED = 1,     /* the driver took something else than it was asked for */
    CAPTURE_TIMEOUT = 2,     /* no frame within the deadline; the stream goes on */
    CAPTURE_ERR_ARG = -1,    /* null pointer, or a wish that no camera can have */
    CAPTURE_ERR_NONE = -2,   /* there is no such camera */
    CAPTURE_ERR_ACCESS = -3, /* it may not be opened by this user */
    CAPTURE_ERR_BUSY = -4,   /* another program holds it */
    CAPTURE_ERR_KIND = -5,   /* the device is no camera that streams */
    CAPTURE_ERR_FORMAT = -6, /* it delivers nothing that can be read here, or a damaged JPEG */
    CAPTURE_ERR_GONE = -7,   /* unplugged while in use */
    CAPTURE_ERR_ORDER = -8,  /* not started, frames not given back, ... */
    CAPTURE_ERR_SYSTEM = -9  /* the system or the driver failed otherwise; see capture_error */
} capture_status;

/* "timeout", "busy", ...; "unknown" for a value that is none. Static text. */
const char *capture_status_name(capture_status status);

/* ---- What to open -------------------------------------------------------------------------- */

enum { CAPTURE_PATH_BYTES = 256, CAPTURE_BUFFERS_MIN = 2, CAPTURE_BUFFERS_MAX = 32 };

typedef enum capture_backend { CAPTURE_V4L2 = 0, CAPTURE_LIBCAMERA } capture_backend;

/* 1 if this build holds the backend. */
int capture_has_backend(capture_backend backend);

/*
 * What is wanted. Zero or NULL is "whatever serves best". Strings are copied.
 *
 * The camera is the one of `device`: a path ("/dev/video2"), a bus id as capture_list gives it
 * ("usb-0000:00:14.0-1"), or, for either backend, a camera's name or a part of it that no other
 * camera has. NULL: the first camera that streams.
 */
typedef struct capture_wish {
    capture_backend backend;
    const char *device;
    uint32_t fourcc;             /* V4L2's code, 0 = any format that pel reads, best first */
    unsigned width, height;      /* pixels; one of them 0: any; both: the nearest to 640x480 */
    unsigned rate_num, rate_den; /* frames per second = num / den; 0: what the camera gives */
    unsigned buffers;            /* in the driver's queue, 2..32; 0 = 4 */
    int newest;                  /* 1: capture_next skips to the newest frame (counted as stale) */
    unsigned restart_after;      /* time-outs in a row before the stream restarts; 0 = 3. Never
                                  * before a second, or four frames, of silence */
    unsigned return_ms;          /* how long to wait for an unplugged camera; 0 = do not */
} capture_wish;

/* What the driver really set: read it before the first frame (after capture_start, for buffers). A
 * reopened camera may have another path, stride and number of buffers; format and size stay. */
typedef struct capture_settings {
    char path[CAPTURE_PATH_BYTES]; /* "/dev/video0"; libcamera: the camera's id */
    char card[64], driver[32], bus[64];
    uint32_t fourcc;
    pel_format format; /* of the views; for compressed frames RGB888 once decoded */
    int compressed;    /* 1: MJPEG: frames have no view but `bytes`, see capture_decode */
    pel_range range;
    unsigned width, height;
    uint32_t bytes_per_line;     /* of plane 0, padding included */
    uint32_t frame_bytes;        /* the most bytes that a frame has */
    unsigned rate_num, rate_den; /* frames per second; 0/0 where the driver does not say */
    unsigned buffers;
} capture_settings;

/* ---- Frames -------------------------------------------------------------------------------- */

/* A frame in the driver's memory, valid until it is given back or the camera is stopped, even if
 * the stream is restarted or the camera unplugged meanwhile. */
typedef struct capture_frame {
    pel_cview view;       /* plane[0] = NULL for compressed frames */
    const uint8_t *bytes; /* all that arrived */
    size_t byte_count;
    uint64_t sequence; /* as the driver counts, carried on past 2^32 and restarts: it only grows */
    uint64_t timestamp_us; /* of the driver's clock; never goes back from start to stop */
    uint32_t missed;       /* gaps in the driver's numbers since the frame delivered before */
    unsigned slot;         /* private */
} capture_frame;

/* All since open. */
typedef struct capture_counts {
    uint64_t frames;       /* delivered to the caller */
    uint64_t missed;       /* gaps in the sequence numbers */
    uint64_t stale;        /* skipped because a newer one was there */
    uint64_t damaged;      /* error flag set, or filled in a way that cannot be: dropped */
    uint64_t short_frames; /* too few bytes: dropped */
    uint64_t timeouts;     /* waits in vain; a deadline of 0 is no wait */
    uint64_t restarts;     /* of the stream, after time-outs, EIO and the like */
    uint64_t reopens; /* of the device, after it was unplugged or did not let itself be restarted */
    uint64_t interrupted; /* system calls that a signal ended early: repeated */
} capture_counts;

/* ---- The life of a camera ------------------------------------------------------------------ */

typedef struct capture capture;

/* The system calls of the V4L2 backend; NULL stands for the system's own. See v4l2_calls.h. */
struct v4l2_calls;

/*
 * Opens and negotiates. Always sets *camera unless memory is out, so that capture_error can be
 * read; capture_close it also after a failure. CAPTURE_CHANGED: open, but format, size or rate are
 * not as wished (see capture_get_settings; `capture_changes` says it in words).
 * After CAPTURE_ERR_BUSY of a V4L2 camera its modes and controls can still be read.
 */
capture_status capture_open(const capture_wish *wish, const struct v4l2_calls *calls,
                            capture **camera);
void capture_close(capture *camera); /* NULL is left alone; frames need not be given back */

void capture_get_settings(const capture *camera, capture_settings *settings);

/* "size 640x480 became 636x480; rate 60 became 30", "" if all is as wished. Valid until close. */
const char *capture_changes(const capture *camera);

/* What went wrong last, for people: "/dev/video0: VIDIOC_STREAMON: No space left on device (...)".
 * "" if nothing did. Valid until the next call. */
const char *capture_error(const capture *camera);

/* CAPTURE_ERR_BUSY, CAPTURE_ERR_GONE, CAPTURE_ERR_FORMAT (another program has changed the format
 * meanwhile, and it cannot be set back), CAPTURE_ERR_SYSTEM: nothing is held, start may be tried
 * again. CAPTURE_ERR_ORDER: started already, or not open. */
capture_status capture_start(capture *camera);

/* Takes all frames back and lets go of the driver's memory; start may follow. */
capture_status capture_stop(capture *camera);

/*
 * The next frame, within `deadline_ms` (0: only what is there). Heals on the way, inside the
 * deadline: interrupted calls are repeated; damaged and short frames dropped and counted; after
 * `restart_after` time-outs in a row and after EIO the stream restarts; after ENODEV the device is
 * closed and, if the wish has return_ms, waited for and opened again with the same settings.
 * CAPTURE_TIMEOUT, CAPTURE_ERR_GONE (for good: only close is left), CAPTURE_ERR_ORDER (not started,
 * or the caller holds as many frames as there are buffers), CAPTURE_ERR_SYSTEM, CAPTURE_ERR_BUSY
 * and CAPTURE_ERR_FORMAT (restarting failed until the deadline; the next call tries again).
 */
capture_status capture_next(capture *camera, unsigned deadline_ms, capture_frame *frame);

/* Gives the driver its memory back and empties *frame. CAPTURE_ERR_ARG: not a frame that is out. A
 * frame from before a restart, a reopen or a stop is taken without complaint. */
capture_status capture_give_back(capture *camera, capture_frame *frame);

void capture_get_counts(const capture *camera, capture_counts *counts);

/*
 * Decodes a compressed frame into the caller's RGB888 view of the camera's size (stride as the
 * caller likes). CAPTURE_ERR_FORMAT: damaged (message in capture_error). Uncompressed frames are
 * refused (CAPTURE_ERR_ARG): read them through `view`.
 */
capture_status capture_decode(capture *camera, const capture_frame *frame, const pel_view *rgb);

/* ---- Controls ------------------------------------------------------------------------------ */

typedef enum capture_control_kind {
    CAPTURE_INTEGER,
    CAPTURE_SWITCH, /* 0 or 1 */
    CAPTURE_MENU    /* value = index of the item; see capture_menu_item */
} capture_control_kind;

/* The controls that every camera names alike; others have their driver's id only. */
typedef enum capture_known {
    CAPTURE_EXPOSURE = 1,  /* units of 100 us */
    CAPTURE_AUTO_EXPOSURE, /* V4L2's menu: 0 auto, 1 manual, 2 shutter, 3 aperture priority */
    CAPTURE_GAIN,
    CAPTURE_AUTO_GAIN,
    CAPTURE_WHITE_BALANCE, /* kelvin */
    CAPTURE_AUTO_WHITE_BALANCE,
    CAPTURE_POWER_LINE, /* menu: 0 off, 1 50 Hz, 2 60 Hz, 3 auto */
    CAPTURE_KNOWN_COUNT
} capture_known;

typedef struct capture_control {
    uint32_t id;         /* the driver's */
    capture_known known; /* 0: none of those above */
    char name[32];
    capture_control_kind kind;
    int32_t min, max, step, initial, value;
    int read_only;
    int inactive; /* without effect now, for instance exposure while auto exposure is on */
} capture_control;

/* "exposure", "auto_exposure", ...; NULL for a value that is none. Static text. */
const char *capture_known_name(capture_known known);

/* Fills up to `max` controls and returns how many the camera has; negative is a status. */
int capture_controls(capture *camera, capture_control *controls, size_t max);

/* The text of a menu's item; CAPTURE_ERR_ARG where the menu has none of that index. */
capture_status capture_menu_item(capture *camera, uint32_t id, int32_t index, char text[32]);

/*
 * Sets, then reads back into *actual (may be NULL). CAPTURE_CHANGED: the driver took another value
 * or ignored it. CAPTURE_ERR_NONE: the camera has no such control. CAPTURE_ERR_ARG: outside
 * min..max, or read-only. What was set is set again after a reopen.
 */
capture_status capture_set(capture *camera, uint32_t id, int32_t value, int32_t *actual);
capture_status capture_get(capture *camera, uint32_t id, int32_t *value);

/* The id under which this camera has a known control; 0 if it has not. */
uint32_t capture_control_id(capture *camera, capture_known known);

/* ---- What there is ------------------------------------------------------------------------- */

typedef struct capture_device {
    char path[CAPTURE_PATH_BYTES]; /* what capture_wish.device takes; libcamera: the id */
    char card[64], driver[32], bus[64];
    capture_status status; /* CAPTURE_OK; or why it could not be looked at: ACCESS, BUSY */
} capture_device;

/* Fills up to `max` cameras (of V4L2: only nodes that capture and stream, and those that could not
 * be opened) in the order of their numbers; returns how many there are; negative is a status. */
int capture_list(capture_backend backend, const struct v4l2_calls *calls, capture_device *devices,
                 size_t max);

/* One format, size and rate that a camera offers. Where a driver gives a range instead of a list,
 * min and max differ; a rate of 0/0 is not said. */
typedef struct capture_mode {
    uint32_t fourcc;
    char description[32];
    int readable; /* pel reads it (compressed: after capture_decode) */
    unsigned width_min, width_max, height_min, height_max;
    unsigned rate_num, rate_den; /* the fastest */
} capture_mode;

/* Fills up to `max` modes of an open camera that is not streaming; returns how many there are;
 * negative is a status. */
int capture_modes(capture *camera, capture_mode *modes, size_t max);

/* The format of a V4L2 code: 1 and *format, 2 for MJPEG/JPEG (*format = RGB888), 0 for one that
 * pel does not read. */
int capture_format_of(uint32_t fourcc, pel_format *format);

/* V4L2's code as text, "YUYV" or "0x..." for unprintable ones; and back (4 letters; 0 if not). */
void capture_fourcc_text(uint32_t fourcc, char text[16]);
uint32_t capture_fourcc(const char *text);

#ifdef __cplusplus
}
#endif

#endif
