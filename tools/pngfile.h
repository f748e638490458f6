/* PNG, by libpng: every colour type and depth is read, 8-bit gray and RGB written. */
#ifndef PNGFILE_H
#define PNGFILE_H

#include "input.h"
#include "source.h"

int pngfile_matches(const uint8_t *bytes, size_t count);

/* Reads the picture that starts here as GRAY8 or RGB888. 16 bits become 8, exactly rounded; alpha
 * is dropped. 0, or -1 after a message. */
int pngfile_read(input *in, frame *picture);

/* Makes row y: width bytes of gray or 3 * width of RGB. */
typedef void pngfile_fill_row(void *user, unsigned y, uint8_t *row);

typedef struct pngfile_picture {
    unsigned width, height;
    int gray;
    const char *comment; /* becomes a text chunk; may be NULL */
    pngfile_fill_row *fill_row;
    void *user;
} pngfile_picture;

enum { PNGFILE_MESSAGE_BYTES = 200 };

/* Writes a picture. 0, or -1 with the library's words for it in `message`. */
int pngfile_write(FILE *file, const pngfile_picture *picture, char message[PNGFILE_MESSAGE_BYTES]);

#endif
