/* Raw frames: the bytes as the sensor sends them, one frame after another, no header. */
#ifndef RAW_H
#define RAW_H

#include "input.h"
#include "source.h"

/* Reads the next frame of the format and size in `options`; `number` is for messages. 1 a frame, 0
 * the end, -1 after a message. */
int raw_read(input *in, const source_options *options, unsigned long number, frame *picture);

/* Writes the frame without padding, plane after plane. 0, or -1 if writing fails (no message). */
int raw_write(FILE *file, const pel_cview *view);

/* Calls `take` with each row of each plane in the order of raw_write. */
typedef void raw_take_row(void *user, const uint8_t *bytes, size_t count);
void raw_each_row(const pel_cview *view, raw_take_row *take, void *user);

#endif
