/* A contact sheet: pictures made small enough to lie side by side, with text below each. */
#ifndef CONTACT_H
#define CONTACT_H

#include "source.h"

enum { CONTACT_LINES = 2, CONTACT_TEXT = 64 };

typedef struct contact_cell {
    frame picture; /* RGB888 */
    char text[CONTACT_LINES][CONTACT_TEXT];
    int marked; /* drawn with a frame around it */
} contact_cell;

/* Puts a picture of any format into the cell, reduced by a whole number so that it is at most
 * 320x240. 0, or -1 after a message that names `where`. */
int contact_shrink(const char *where, const pel_cview *view, contact_cell *cell);

/* Writes the sheet to `path` (.ppm, .pgm, .png or "-"). 0, or -1 after a message. */
int contact_write(const char *path, const contact_cell *cells, size_t count, const char *comment);

#endif
