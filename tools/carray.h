/* A frame as C source, so that what a camera saw in the field becomes a test on the desk. */
#ifndef CARRAY_H
#define CARRAY_H

#include <stdio.h>

#include <pel.h>

/* Whether `name` can name a variable in C and C++: not one of their keywords either. */
int carray_name_ok(const char *name);

/* Writes the frame's bytes, without padding, as `const uint8_t NAME[]` with NAME_width and
 * NAME_height. 0, or -1 if writing fails (no message). */
int carray_write(FILE *file, const pel_cview *view, const char *name);

#endif
