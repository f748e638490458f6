/* Letters on an RGB888 picture, 5 pixels wide and 7 high; two more below the line. */
#ifndef TEXT_H
#define TEXT_H

#include "draw.h"

enum { TEXT_STEP = 6 }; /* from one letter to the next */

/* Draws small letters (large ones become small), digits and . , : - + / ( ) % _ with (x, y) as the
 * top left corner; a box stands for what there is no letter for. */
void text_draw(const pel_view *picture, int32_t x, int32_t y, const char *text, draw_color color);

/* How many pixels wide it becomes. */
int32_t text_width(const char *text);

#endif
