/* Pictures taken apart into channels, for the operators that work on gray ones only. */
#ifndef PLANES_H
#define PLANES_H

#include "source.h"

/* A gray picture (count 1), or the red, green and blue of one (count 3): GRAY8 frames of one size.
 * A zeroed one is empty. */
typedef struct planes {
    unsigned count;
    frame channel[3];
} planes;

/* Takes a GRAY8 or RGB888 picture apart. 0, or -1 after a message that names `where`. */
int planes_split(const char *where, const pel_cview *view, planes *out);

/* Makes room for channels of a size; what was in them is lost. 0, or -1 after a message. */
int planes_resize(const char *where, planes *to, unsigned count, unsigned width, unsigned height);

/* The picture as one frame, GRAY8 or RGB888. 0, or -1 after a message. */
int planes_join(const char *where, const planes *from, frame *out);

/* Channel i to read. */
pel_cview planes_view(const planes *from, unsigned i);

void planes_free(planes *of);

#endif
