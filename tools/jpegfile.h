/* JPEG, by libjpeg: gray and colour pictures are read and written. */
#ifndef JPEGFILE_H
#define JPEGFILE_H

#include "input.h"
#include "pngfile.h"
#include "source.h"

int jpegfile_matches(const uint8_t *bytes, size_t count);

/* Reads the picture that starts here as GRAY8 or RGB888, and not a byte more. Damage that the
 * library would only warn about is an error. 0, or -1 after a message. */
int jpegfile_read(input *in, frame *picture);

/* Writes a picture, described as for PNG, with quality 95 and a chroma sample for every pixel. 0,
 * or -1 with a message. */
int jpegfile_write(FILE *file, const pngfile_picture *picture, char message[PNGFILE_MESSAGE_BYTES]);

#endif
