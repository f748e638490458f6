/* Pictures of any format as bytes that every operator takes: GRAY8 or RGB888. */
#ifndef PLAIN_H
#define PLAIN_H

#include "source.h"

typedef enum plain_kind {
    PLAIN_AS_IT_IS = 0, /* GRAY8 stays, all others become RGB888 */
    PLAIN_GRAY,         /* colour becomes full-range luma */
    PLAIN_RGB           /* gray becomes three equal channels */
} plain_kind;

/* Converts a picture; Bayer pictures have half of their width and height. Memory of `out` is
 * reused. 0, or -1 after a message that names `where`. */
int plain_make(const char *where, const pel_cview *view, plain_kind kind, frame *out);

/* Row y of the first plane, to write. */
uint8_t *plain_row(const pel_view *view, unsigned y);

#endif
