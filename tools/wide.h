/* 16-bit results as pictures: PGM with a maxval of 65535. */
#ifndef WIDE_H
#define WIDE_H

#include <stdint.h>
#include <stdio.h>

/* The value that stands for 0 in the file; a comment in it says so. */
enum { WIDE_OFFSET = 32768 };

/* Writes width * height signed values, row by row. 0, or -1 if writing fails (no message). */
int wide_write(FILE *file, const int16_t *values, unsigned width, unsigned height);

#endif
