/*
 * Where frames come from: one picture or a stream of them, in any format that pel reads.
 *
 * PPM/PGM (P2 P3 P5 P6; several pictures in a row make a stream), PNG, JPEG, YUV4MPEG2, or raw
 * frames. The content decides, not the file name; "-" is standard input. Readers accept only whole
 * frames: anything cut short or malformed is an error that names the file and the place.
 */
#ifndef SOURCE_H
#define SOURCE_H

#include <stdio.h>

#include <pel.h>

/* A frame and the memory it owns. A zeroed frame is empty. The view's planes point into `bytes`. */
typedef struct frame {
    pel_view view;
    uint8_t *bytes;
    size_t capacity;
} frame;

/* Makes room for a tightly packed frame and describes it; keeps the memory where it is enough.
 * 0, or -1 if the size is impossible or memory is out. */
int frame_resize(frame *picture, pel_format format, pel_range range, unsigned width,
                 unsigned height);
void frame_free(frame *picture);

/*
 * The same in two steps, for readers: memory grows with the bytes that really arrive, so that a
 * header alone, however large the picture that it promises, costs nothing.
 *
 * frame_reserve: room for `bytes` of the `total` that the frame will have; returns the start, or
 * NULL if memory is out. What was written before stays. frame_describe: the view, once all is
 * there; 0, or -1 if the size is impossible or was not reserved.
 */
uint8_t *frame_reserve(frame *picture, size_t bytes, size_t total);
int frame_describe(frame *picture, pel_format format, pel_range range, unsigned width,
                   unsigned height);

/* How to read: zero for everything that describes itself. */
typedef struct source_options {
    int raw; /* 1: raw frames of the format and size below, one after another */
    pel_format format;
    pel_range range; /* of raw YCbCr frames */
    unsigned width, height;
} source_options;

typedef struct source source;

/* Opens a file; NULL after an error message. */
source *source_open(const char *path, const source_options *options);

/* The same for a stream that is open already; source_close closes it. `name` is for messages and
 * must outlive the source. On an error the stream is closed, too. */
source *source_open_stream(FILE *stream, const char *name, const source_options *options);

/* Reads the next frame into `picture` (reusing its memory): 1 a frame, 0 the end, -1 after an error
 * message. PPM, PNG and JPEG give RGB888, PGM and gray ones GRAY8, Y4M I420 or YUYV or GRAY8. */
int source_next(source *from, frame *picture);

void source_close(source *from);

#endif
