/* Drawing on an RGB888 picture. What lies outside is not drawn. */
#ifndef DRAW_H
#define DRAW_H

#include "classfile.h"

typedef struct draw_color {
    uint8_t red, green, blue;
} draw_color;

void draw_pixel(const pel_view *picture, int32_t x, int32_t y, draw_color color);

/* A line of one pixel, both ends included (Bresenham 1965). */
void draw_line(const pel_view *picture, int32_t x0, int32_t y0, int32_t x1, int32_t y1,
               draw_color color);

/*
 * A blob: a frame around its box, in the colour of its class, one pixel outside so that it hides
 * nothing of the blob; its long axis as far as the box goes, where one stands out; and a cross of
 * black and white on its centroid.
 */
void draw_blob(const pel_view *picture, const pel_blob *blob, draw_color color);

#endif
