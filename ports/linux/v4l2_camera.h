/* Private to the V4L2 backend: an open device, its buffers, and what is known of its stream. */
#ifndef V4L2_CAMERA_H
#define V4L2_CAMERA_H

#include "backend.h"

#include <sys/time.h>

#include <linux/videodev2.h>

/* ---- A device node (capture_v4l2_device.c) ------------------------------------------------- */

typedef struct v4l2_device {
    const struct v4l2_calls *calls;
    int fd;                /* -1: not open */
    uint32_t queue;        /* V4L2_BUF_TYPE_VIDEO_CAPTURE or ..._MPLANE */
    uint64_t *interrupted; /* where to count calls that a signal ended; NULL: nowhere */
    char path[CAPTURE_PATH_BYTES];
    char card[64], driver[32], bus[64];
    char error[CAPTURE_TEXT_BYTES]; /* why v4l2_device_open failed */
} v4l2_device;

/*
 * Opens device->path, which must be a character device of V4L2 that captures and streams. `calls`
 * and `interrupted` are set by the caller. CAPTURE_ERR_NONE, _ACCESS, _BUSY, _KIND, _SYSTEM.
 */
capture_status v4l2_device_open(v4l2_device *device);
void v4l2_device_close(v4l2_device *device);

/* The ioctl, repeated as long as signals interrupt it. 0, or -1 with errno. */
int v4l2_call(v4l2_device *device, unsigned long request, void *argument);

/* The status that stands for an errno of an open device. */
capture_status v4l2_status_of(int error);

/* strerror, but safe with threads; `text` has CAPTURE_TEXT_BYTES / 4. */
enum { V4L2_REASON_BYTES = 80 };
const char *v4l2_reason(int error, char text[V4L2_REASON_BYTES]);

/* The devices there are, as capture_list. `interrupted` as above. */
int v4l2_list(const struct v4l2_calls *calls, uint64_t *interrupted, capture_device *devices,
              size_t max);

/* ---- The camera ---------------------------------------------------------------------------- */

/* One buffer of the driver in our memory. */
typedef struct v4l2_map {
    uint8_t *memory; /* NULL: none */
    size_t length;
    int queued; /* the driver has it */
    int held;   /* the caller has it */
} v4l2_map;

/* The memory of a frame that the caller still holds although its device or queue is gone. */
typedef struct v4l2_retired {
    uint8_t *memory;
    size_t length;
    unsigned slot;
} v4l2_retired;

/* Carries sequence numbers and timestamps on over wraps, restarts and reopens. */
typedef struct v4l2_track {
    int known;          /* 1: `last` and `last_us` are of this stream */
    uint32_t last;      /* sequence number of the last good buffer, as the driver said it */
    uint64_t sequence;  /* the same, carried on */
    int any;            /* 1: there has been a frame since the caller's start */
    uint32_t dropped;   /* buffers since then that were dropped here */
    uint32_t missed;    /* gaps since the last frame that was delivered */
    int64_t last_us;    /* its timestamp, as the driver said it */
    uint64_t timestamp; /* the same, carried on */
} v4l2_track;

typedef struct v4l2_camera {
    v4l2_device device;
    int named; /* the wish did not say a path: after a return the node may be another */

    /* The queue (capture_v4l2_queue.c). */
    unsigned generation; /* of the buffers; part of a frame's slot */
    int allocated;       /* the driver has buffers for us */
    unsigned count;      /* of buffers that are mapped */
    v4l2_map maps[CAPTURE_BUFFERS_MAX];
    v4l2_retired retired[CAPTURE_BUFFERS_MAX];
    unsigned held; /* frames with the caller, of `maps` and `retired` */
    size_t needed; /* fewer bytes than this are no frame */

    /* Healing (capture_v4l2_heal.c). */
    int lost;          /* the device went away, or could not be stopped and was closed */
    int stubborn;      /* it was closed because it did not let go of its buffers */
    int gone;          /* for good */
    uint64_t lost_us;  /* when */
    int restart_due;   /* the stream must be restarted before the next frame */
    unsigned failures; /* restarts in a row that failed or brought no frame */
    uint64_t retry_us; /* not before */
    unsigned quiet;    /* time-outs in a row */
    uint64_t heard_us; /* when the last buffer came, or the stream was started */
    v4l2_track track;
} v4l2_camera;

v4l2_camera *v4l2_state(const capture *camera);
uint64_t v4l2_now_us(const capture *camera);

/* Sleeps until `until_us` or a little less, at most `most_ms`. */
void v4l2_pause(capture *camera, unsigned most_ms, uint64_t until_us);

/* camera->error = "PATH: WHAT: reason of the errno `error`"; returns its status. */
capture_status v4l2_fail(capture *camera, const char *what, int error);

/* ---- Formats (capture_v4l2_format.c, capture_v4l2_modes.c) --------------------------------- */

/* What a camera could be asked for. */
typedef struct v4l2_candidate {
    uint32_t fourcc;
    unsigned width, height;
    unsigned rate_num, rate_den; /* the fastest at that size; 0/0 unknown */
} v4l2_candidate;

enum { V4L2_CANDIDATES_MAX = 64 };

/* The best first; at least one. */
unsigned v4l2_candidates(capture *camera, v4l2_candidate candidates[V4L2_CANDIDATES_MAX]);

int v4l2_modes(capture *camera, capture_mode *modes, size_t max);

/* Finds the best of the wish and sets it; fills the settings. */
capture_status v4l2_negotiate(capture *camera);

/* Makes sure that the driver's format is that of the settings, setting it again where it is not;
 * CAPTURE_ERR_FORMAT if that cannot be had. */
capture_status v4l2_confirm_format(capture *camera);

/* Sets the frame rate of the wish, if there is one, and reads it into the settings. */
void v4l2_set_rate(capture *camera);

/* ---- The queue (capture_v4l2_queue.c) ------------------------------------------------------ */

/* Buffers, maps, STREAMON; on failure all is released. */
capture_status v4l2_begin_stream(capture *camera);

/* Releases all; with keep_held the memory of frames that the caller holds becomes retired. Closes a
 * device that does not let go of its buffers (then it is lost). */
void v4l2_end_stream(capture *camera, int keep_held);

/* STREAMOFF, all buffers that are not held back into the queue, STREAMON. */
capture_status v4l2_cycle_stream(capture *camera);

/* Gives a buffer to the driver; a failure is left to the healing. */
void v4l2_queue(capture *camera, unsigned index);

typedef enum v4l2_outcome {
    V4L2_FRAME,   /* a good buffer: *buffer */
    V4L2_DROPPED, /* a damaged or short one, counted and queued again */
    V4L2_NOTHING, /* none there */
    V4L2_TROUBLE  /* healing is needed */
} v4l2_outcome;

/* What a buffer holds. */
typedef struct v4l2_filled {
    unsigned index;
    const uint8_t *bytes;
    size_t byte_count;
    uint64_t sequence;
    uint64_t timestamp_us;
} v4l2_filled;

v4l2_outcome v4l2_dequeue(capture *camera, v4l2_filled *filled);

/* Marks a buffer as the caller's and describes it. */
void v4l2_hand_out(capture *camera, const v4l2_filled *filled, capture_frame *frame);

capture_status v4l2_give_back(capture *camera, const capture_frame *frame);

/* Forgets where sequence numbers and timestamps were: a new stream follows. */
void v4l2_track_restart(v4l2_track *track);
void v4l2_track_drop(v4l2_track *track);
/* Takes in a good buffer; returns how many frames are missing before it. */
uint32_t v4l2_track_take(v4l2_track *track, uint32_t sequence, int64_t time_us);

/* ---- Healing (capture_v4l2_heal.c) --------------------------------------------------------- */

/* The device is away: lets go of it, keeping frames that are held. */
void v4l2_lose(capture *camera);

/* Notes that the stream has to be restarted. */
void v4l2_want_restart(capture *camera);

/* Handles the errno of a call that failed on the stream. */
void v4l2_trouble(capture *camera, const char *what, int error);

/* Brings the stream back to where frames can come. CAPTURE_OK; CAPTURE_TIMEOUT: not until
 * `deadline_us`; CAPTURE_ERR_GONE; CAPTURE_ERR_SYSTEM, CAPTURE_ERR_FORMAT: tried until then. */
capture_status v4l2_heal(capture *camera, uint64_t deadline_us);

/* How long to wait for a lost device; 0 = not at all. */
unsigned v4l2_return_ms(const capture *camera);

/* Opens the device again if it is there, with the same settings. */
capture_status v4l2_reopen(capture *camera);

/* ---- Controls (capture_v4l2_controls.c) ---------------------------------------------------- */

int v4l2_controls(capture *camera, capture_control *controls, size_t max);
capture_status v4l2_query(capture *camera, uint32_t id, capture_control *control);
capture_status v4l2_menu_item(capture *camera, uint32_t id, int32_t index, char text[32]);
capture_status v4l2_get(capture *camera, uint32_t id, int32_t *value);
capture_status v4l2_set(capture *camera, uint32_t id, int32_t value);
uint32_t v4l2_known(capture *camera, capture_known known);

#endif
