/*
 * Where pictures go. The ending of the name decides the format: .ppm .pgm .png .jpg .y4m
 * .yuv/.raw; "-" is standard output (then `kind` decides).
 *
 * A file is complete or it is not there: everything that is written is checked, and after an error
 * the file is removed if it is a regular one.
 */
#ifndef SINK_H
#define SINK_H

#include <stdio.h>

#include <pel.h>

/* Writes one picture (any pixel format, converted to RGB or gray as the file needs) to `path`,
 * which ends in .ppm, .pgm or .png, or is "-" for a PPM on standard output. `comment` goes into the
 * file, one line per line; may be NULL. 0, or -1 after an error message. */
int sink_picture(const char *path, const pel_cview *view, const char *comment);

/* Says whether sink_picture takes a path of that name, before anything is read: 0, or -1 after a
 * message. */
int sink_check_picture(const char *path);

typedef enum sink_kind {
    SINK_PPM, /* one picture after another */
    SINK_PGM,
    SINK_PNG,  /* one picture only; gray if the first is GRAY8 */
    SINK_JPEG, /* likewise */
    SINK_Y4M,  /* I420, YUYV and GRAY8 frames of one size */
    SINK_RAW,  /* the bytes of any format */
    SINK_KIND_COUNT
} sink_kind;

/* The kind by its name ("ppm", ...) or by the ending of a path. 0, or -1 if there is none (no
 * message). sink_endings is the list for messages. */
int sink_kind_by_name(const char *name, sink_kind *kind);
int sink_kind_by_path(const char *path, sink_kind *kind);
#define SINK_ENDINGS ".ppm .pgm .png .jpg .jpeg .y4m .yuv .raw"

/* A file that is being written; zero it, or let sink_open do so. */
typedef struct sink {
    const char *path;
    const char *comment;         /* for all but SINK_RAW; NULL for none */
    unsigned rate_num, rate_den; /* frames per second, for Y4M; 0: not known */
    sink_kind kind;
    FILE *file;
    unsigned long frames;
    uint16_t width, height; /* of the first frame */
    pel_format format;
} sink;

/* Creates the file. Then sink_frame for each frame, and sink_close in any case: with a `status` of
 * -1 it drops the file, with 0 it says whether all is written. All: 0, or -1 after a message. */
int sink_open(sink *to, const char *path, sink_kind kind);
void sink_attach(sink *to, FILE *file, const char *path, sink_kind kind); /* open already */
int sink_frame(sink *to, const pel_cview *view);
int sink_close(sink *to, int status);

/* The same for text and other bytes: opens `path` ("-": standard output) and closes it, checked. */
FILE *sink_open_file(const char *path);
int sink_close_file(FILE *file, const char *path, int status);

#endif
