/*
 * CMVision 2 tables: "TMAP\nYUV8\n16 64 64\n" and one label per cell, Y outermost, V innermost. The
 * sizes may be other powers of two up to 256. A table says nothing of the colour range: it is full.
 */
#ifndef TMFILE_H
#define TMFILE_H

#include "classfile.h"
#include "input.h"

int tmfile_matches(const uint8_t *bytes, size_t count);

/* Reads the cells into a zeroed `list`, which owns them. 0, or -1 after a message. */
int tmfile_read(input *in, classes *list);

#endif
