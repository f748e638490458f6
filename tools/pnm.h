/* PPM and PGM (Netpbm): P2 P3 P5 P6 are read, P5 and P6 written. */
#ifndef PNM_H
#define PNM_H

#include <stdio.h>

#include "input.h"
#include "source.h"

/* Whether a picture that starts with these bytes is ours to read (or to refuse by name: P1 P4
 * P7). */
int pnm_matches(const uint8_t *bytes, size_t count);

/* Reads the picture that starts here; samples of any maxval become 0..255, exactly rounded. P3 and
 * P6 give RGB888, P2 and P5 GRAY8. 0, or -1 after a message. */
int pnm_read(input *in, frame *picture);

/* Writes rows as P6 (gray = 0) or P5 (gray = 1): pnm_write_header once, then the rows with fwrite.
 * `comment` may be NULL or hold several lines. 0, or -1 if the disk is full (no message). */
int pnm_write_header(FILE *file, int gray, unsigned width, unsigned height, const char *comment);

#endif
