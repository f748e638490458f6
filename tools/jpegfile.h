/* JPEG, by libjpeg: gray and colour pictures are read. */
#ifndef JPEGFILE_H
#define JPEGFILE_H

#include "input.h"
#include "source.h"

int jpegfile_matches(const uint8_t *bytes, size_t count);

/* Reads the picture that starts here as GRAY8 or RGB888, and not a byte more. Damage that the
 * library would only warn about is an error. 0, or -1 after a message. */
int jpegfile_read(input *in, frame *picture);

#endif
