/* Short texts on an RGB888 picture: capital letters, digits and a few signs in cells of 6x8 pixels;
 * small letters are drawn as capitals, what is not known as a gap. */
#ifndef LABEL_H
#define LABEL_H

#include "draw.h"

enum { LABEL_WIDTH = 6, LABEL_HEIGHT = 8 };

/* Writes with the upper left corner of the first cell at x, y. */
void label_draw(const pel_view *picture, int32_t x, int32_t y, const char *text, draw_color color);

#endif
