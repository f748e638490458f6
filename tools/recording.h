/* Frames of a camera into files, one after another or each into one of its own. */
#ifndef RECORDING_H
#define RECORDING_H

#include "camera.h"

#ifdef PEL_HAS_CAMERAS

#include "sink.h"

/* Zero it and set the first three. */
typedef struct recording {
    const char *path; /* may have the place of a number; "-" is YUV4MPEG2 on standard output */
    int force;        /* existing files are overwritten */
    sink_kind kind;
    sink to;            /* of all frames, unless each has a file */
    int spare;          /* the same file once more, to cut off what is half written; -1: none */
    int64_t good_bytes; /* up to the end of the last whole frame */
    unsigned long frames;
    frame packed;
} recording;

/* Decides what OUT is, and says early whether it can be written: 0, or -1 after a message. */
int recording_check(recording *to);

/* Writes a frame; files are created with the first one. 0, or -1 after a message; then what came
 * before it is kept. */
int recording_frame(recording *to, camera *from, const camera_frame *got);

/* Closes. With a `status` of -1 writing has failed and a message was printed; else 0, or -1 after a
 * message. */
int recording_close(recording *to, int status);

#endif

#endif
