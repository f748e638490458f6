/*
 * Cameras that exist only in a table of system calls: they do what a test tells them, well or not,
 * on a clock of their own, and keep account of everything that is open, mapped or queued.
 *
 * The pixels of a frame are a function of its number (its id, over all streams), so that a frame
 * that lies in the wrong place, was overwritten or is not the one it claims to be is noticed.
 */
#ifndef REPLAY_H
#define REPLAY_H

#include <stddef.h>
#include <stdint.h>
#include <sys/time.h>

#include <linux/videodev2.h>

#include "capture.h"
#include "v4l2_calls.h"

enum {
    REPLAY_NODES = 6,
    REPLAY_MODES = 12,
    REPLAY_BUFFERS = 64,
    REPLAY_CONTROLS = 12,
    REPLAY_HANDLES = 16,
    REPLAY_MEMORIES = 512,
    REPLAY_FAULTS = 16,
    REPLAY_PLAN = 32,
    REPLAY_LOG = 1024
};

/* Calls that are no ioctl, for replay_fail; ioctls are meant by their request. */
enum { REPLAY_OPEN = 1, REPLAY_STAT, REPLAY_FSTAT, REPLAY_MMAP, REPLAY_POLL };

typedef enum replay_kind {
    REPLAY_GOOD = 0,
    REPLAY_DAMAGED,  /* error flag */
    REPLAY_SHORT,    /* too few bytes */
    REPLAY_OVERLONG, /* more bytes than the buffer has: nonsense */
    REPLAY_LOST,     /* no buffer, but the sequence number is used up */
    REPLAY_NO_MARK   /* compressed frames: does not begin like a JPEG */
} replay_kind;

enum { REPLAY_NO_SUCH = 1, REPLAY_NOT_QUEUED };

typedef struct replay_mode {
    uint32_t fourcc;
    unsigned width, height;
    unsigned rate; /* frames per second, the fastest */
} replay_mode;

typedef struct replay_control {
    uint32_t id, type, flags;
    char name[32];
    int32_t min, max, step, initial, value;
    int ignored;         /* the driver says yes and does nothing */
    int error;           /* setting fails with this errno */
    const char *menu[4]; /* NULL: no such item */
} replay_control;

/* Memory of a buffer: lives as long as the driver or a map has it. */
typedef struct replay_memory {
    uint8_t *bytes;
    size_t length;
    int owned, mapped;
} replay_memory;

typedef struct replay_buffer {
    int memory; /* index of a replay_memory */
    int queued; /* 1 waiting to be filled, 2 filled */
    uint32_t id;
    replay_kind kind;
    uint32_t sequence;
    int64_t time_us;
    unsigned lost_before;
} replay_buffer;

typedef struct replay_node {
    /* What it is. */
    int present;
    unsigned number; /* /dev/videoNUMBER */
    unsigned device_major;
    int not_a_device; /* a regular file */
    int open_error;
    uint32_t caps;
    const char *driver, *card, *bus;
    replay_mode modes[REPLAY_MODES];
    unsigned mode_count;
    replay_control controls[REPLAY_CONTROLS];
    unsigned control_count;

    /* How it behaves; zero is well. */
    int no_formats, no_sizes, no_rates, endless; /* enumeration */
    int stepwise;                                /* sizes in steps, from the first mode up */
    int no_get_format, no_parm, rate_ignored, no_next_control;
    uint32_t force_fourcc; /* S_FMT takes this instead */
    unsigned force_width, force_height;
    int format_lies; /* S_FMT answers as asked all the same; G_FMT tells the truth */
    unsigned stride_extra, size_extra;
    int no_tail;   /* the padding of the last row is not delivered */
    int no_stride; /* bytesperline 0 */
    uint32_t field, colorspace, quantization;
    unsigned buffers_min, buffers_max; /* 0: 2 and 32 */
    unsigned buffer_cut;               /* buffers are so much shorter than a frame */
    unsigned data_offset;              /* multi-planar only */
    int keeps_mapped;                  /* an old kernel: REQBUFS fails while something is mapped */
    uint32_t first_sequence;
    int no_sequence, no_time;
    int64_t first_time_us, time_low_us, time_period_us; /* period 0: the clock never wraps */
    const uint8_t *jpeg; /* what compressed frames hold; NULL: a mark and the pattern */
    size_t jpeg_bytes;

    /* What happens. */
    replay_kind plan[REPLAY_PLAN]; /* of the frames from stream to stream; then all are good */
    unsigned plan_count, plan_at;
    int stalled;                    /* no frames until the next STREAMON */
    int broken;                     /* EIO until STREAMOFF */
    int spurious;                   /* poll says ready although nothing is */
    int bad_index;                  /* the next DQBUF gives a buffer that it did not have */
    unsigned unplug_after;          /* frames taken until it is gone; 0 never */
    uint64_t back_after_us;         /* and how long; 0 for ever */
    unsigned back_number;           /* as which node */
    const char *back_card;          /* NULL: the same */
    unsigned back_force_width;      /* then it only has this width */
    unsigned damage, shorten, lose; /* per mille of frames at random */

    /* State. */
    uint32_t instance;
    uint64_t back_us;
    uint32_t fourcc;
    unsigned width, height, rate;
    int format_set;
    int owner; /* handle that has the queue, -1 none */
    int streaming;
    replay_buffer buffers[REPLAY_BUFFERS];
    unsigned buffer_count;
    unsigned waiting[REPLAY_BUFFERS], waiting_count; /* to be filled */
    unsigned filled[REPLAY_BUFFERS], filled_count;
    uint64_t next_us, stream_us;
    uint32_t sequence;
    unsigned lost_now;     /* since the last buffer that was filled */
    unsigned lost_pending; /* since the last good one that was taken */
    int good_taken;        /* in this stream */
    unsigned taken;        /* frames, since it was plugged in */
} replay_node;

typedef struct replay_handle {
    int used;
    int node;
    uint32_t instance;
    int streamed; /* STREAMON was called on it with success */
} replay_handle;

typedef struct replay_fault {
    unsigned long call;
    unsigned skip, times;
    int error;
} replay_fault;

typedef struct replay_entry {
    uint32_t id;
    replay_kind kind;
    uint64_t made_us;
    int taken;
} replay_entry;

/* What was injected or done, to be compared with what the camera counted. */
typedef struct replay_counts {
    uint64_t interrupted, good, damaged, short_frames, missed;
    uint64_t stream_ons, first_stream_ons;
} replay_counts;

typedef struct replay {
    struct v4l2_calls calls;
    uint64_t now_us;
    unsigned cost_us; /* of each call */
    replay_node nodes[REPLAY_NODES];
    replay_handle handles[REPLAY_HANDLES];
    replay_memory memories[REPLAY_MEMORIES];
    replay_fault faults[REPLAY_FAULTS];
    unsigned fault_count;
    unsigned interrupt; /* per mille of calls that a signal ends */
    unsigned fail;      /* per mille of calls that fail, see replay_random_error */
    uint64_t random;
    uint32_t next_id;
    replay_entry log[REPLAY_LOG];
    replay_counts counts;
    unsigned long last_call; /* for messages */
    int last_open_flags;
    int misuse; /* calls that no correct program makes; each prints a line */
} replay;

/* One node, /dev/video0: YUYV 32x24 at 30, also 16x8; MJPEG 64x48 at 60; three controls. */
void replay_init(replay *world);
void replay_free(replay *world);

/* A camera such as nodes[0], at this node and number. */
replay_node *replay_add_camera(replay *world, unsigned node, unsigned number, const char *card,
                               const char *bus);

/* After `skip` of these calls the next `times` fail. */
void replay_fail(replay *world, unsigned long call, unsigned skip, unsigned times, int error);

void replay_unplug(replay *world, replay_node *node);

unsigned replay_open_count(const replay *world);
unsigned replay_map_count(const replay *world);
unsigned replay_queued_count(const replay *world);
unsigned replay_buffer_count(const replay *world);

/* NULL if the frame is one that was made, is good, was taken out of the driver and holds exactly
 * the pixels it should; else what is wrong. *id is its number. */
const char *replay_check_frame(const replay *world, const capture_settings *settings,
                               const capture_frame *frame, uint32_t *id);
const replay_entry *replay_find(const replay *world, uint32_t id);

/* The byte of a frame at a place: column in bytes. */
uint8_t replay_byte(uint32_t id, unsigned plane, unsigned row, unsigned column);

/* ---- Between the files of the replay --------------------------------------------------------- */

uint32_t replay_random(replay *world);
int replay_chance(replay *world, unsigned per_mille);
int replay_errno(int error); /* sets errno; returns -1 */
int replay_ioctl_format(replay *world, replay_node *node, unsigned long request, void *argument);
int replay_ioctl_queue(replay *world, int handle, unsigned long request, void *argument);
int replay_ioctl_control(replay_node *node, unsigned long request, void *argument);
void replay_advance(replay *world, replay_node *node);
void replay_drop_buffers(replay *world, replay_node *node);
void replay_release(replay *world, int memory);
uint32_t replay_queue_type(const replay_node *node);
unsigned replay_stride(const replay_node *node);
uint32_t replay_frame_bytes(const replay_node *node);

#endif
