/*
 * Where the pictures go that a command makes from pictures: .ppm, .pgm, .png, .y4m, or "-" for PPM
 * or PGM on standard output. The file is created when the first picture is there, so that bad input
 * leaves none behind; more than one picture needs a file that can hold them.
 */
#ifndef OUTLET_H
#define OUTLET_H

#include "sink.h"
#include "source.h"

/* Zero it, then outlet_begin. */
typedef struct outlet {
    const char *path;
    sink to;
    frame packed;
} outlet;

/* Says whether OUT can be written: the ending of its name is known, and it is not the file that is
 * read. 0, or -1 after a message; then *status is the exit status. */
int outlet_begin(outlet *to, const char *command, const char *in, const char *path, int *status);

/* Writes the next picture; `in` is for messages. 0, or -1 after a message. */
int outlet_view(outlet *to, const char *in, const pel_cview *view);

/* The same for signed 16-bit values (see wide.h), into .pgm and "-" only. */
int outlet_wide(outlet *to, const int16_t *values, unsigned width, unsigned height);

/* Closes the file: with a `status` of -1 it is dropped, with 0 it says whether all is written. */
int outlet_close(outlet *to, int status);

#endif
