/*
 * Private to ports/linux: what a backend implements and what it finds in a camera. The front
 * (capture.c) has checked every argument before it calls.
 */
#ifndef BACKEND_H
#define BACKEND_H

#include "capture.h"
#include "v4l2_calls.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CAPTURE_TEXT_BYTES = 320, CAPTURE_KEPT_MAX = 64 };

struct capture_ops {
    /*
     * Opens what camera->wish says and fills camera->settings. On failure camera->error says why;
     * the front calls close in every case, once, also after a failed open.
     */
    capture_status (*open)(capture *camera);
    void (*close)(capture *camera);

    /* Only called while stopped, and only while started (camera->started). */
    capture_status (*start)(capture *camera);
    capture_status (*stop)(capture *camera);

    /* Only called while started; *frame is all zero. A frame gets a slot that is not 0. */
    capture_status (*next)(capture *camera, unsigned deadline_ms, capture_frame *frame);
    /* Called with frame->slot not 0, started or not. */
    capture_status (*give_back)(capture *camera, const capture_frame *frame);

    /* Like the functions of capture.h with these names. The front sets camera->error aside. */
    int (*controls)(capture *camera, capture_control *controls, size_t max);
    capture_status (*menu_item)(capture *camera, uint32_t id, int32_t index, char text[32]);
    /* One control, its value included; CAPTURE_ERR_NONE if the camera has not got it. */
    capture_status (*query)(capture *camera, uint32_t id, capture_control *control);
    capture_status (*get)(capture *camera, uint32_t id, int32_t *value);
    /* Without reading back: the front does. */
    capture_status (*set)(capture *camera, uint32_t id, int32_t value);
    uint32_t (*known)(capture *camera, capture_known known);

    int (*modes)(capture *camera, capture_mode *modes, size_t max);
    int (*list)(const struct v4l2_calls *calls, capture_device *devices, size_t max);
};

/* A control that the caller has set: set again after a reopen. */
typedef struct capture_kept {
    uint32_t id;
    int32_t value;
} capture_kept;

struct capture {
    const struct capture_ops *ops;
    void *state; /* the backend's own */
    const struct v4l2_calls *calls;
    capture_wish wish;               /* with the defaults of buffers and restart_after filled in */
    char device[CAPTURE_PATH_BYTES]; /* what wish.device points to, if it does */
    capture_settings settings;
    capture_counts counts;
    capture_kept kept[CAPTURE_KEPT_MAX];
    unsigned kept_count;
    int opened;  /* open succeeded */
    int looking; /* set by the backend if open answers CAPTURE_ERR_BUSY, but modes and controls can
                  * be read all the same */
    int started; /* kept by the front */
    char changes[CAPTURE_TEXT_BYTES];
    char error[CAPTURE_TEXT_BYTES];
};

/* Sets camera->error and returns `status`. */
#ifdef __GNUC__
__attribute__((format(printf, 3, 4)))
#endif
capture_status
capture_fail(capture *camera, capture_status status, const char *format, ...);

/* Adds to camera->changes, after "; " if there is something already. */
#ifdef __GNUC__
__attribute__((format(printf, 2, 3)))
#endif
void capture_note_change(capture *camera, const char *format, ...);

/* Copies a text that may be unterminated, cutting it where it does not fit; unprintable bytes
 * become '?'. */
void capture_copy_text(char *to, size_t to_bytes, const char *from, size_t from_bytes);

/* How many of the formats that pel reads come before this one; -1 if pel does not read it. */
int capture_format_rank(uint32_t fourcc);

/* The format of a rank; 0 if there are not so many. */
uint32_t capture_format_at(int rank);

/* 1 for formats of Y, U and V, whose range plays a part. */
int capture_format_has_range(uint32_t fourcc);

/* 1 if this build decodes JPEG. */
int capture_can_decode(void);

const struct capture_ops *capture_v4l2_ops(void);
const struct capture_ops *capture_libcamera_ops(void); /* if CAPTURE_HAVE_LIBCAMERA is defined */

#ifdef __cplusplus
}
#endif

#endif
