/* Maps to find blobs in: shapes that are hard on connected components, and random ones. */
#ifndef MAPS_H
#define MAPS_H

#include "check.h"
#include "reference.h"

enum { SHAPE_COUNT = 26, VARIANT_COUNT = 6 };

const char *shape_name(unsigned shape);

/*
 * Draws a shape, 0 <= shape < SHAPE_COUNT. Variant 0 has one class and background, 1 to 5 turn it
 * into several classes, some without any background. `labels` has room for width * height.
 */
void draw_shape(unsigned shape, unsigned variant, uint16_t width, uint16_t height, uint8_t *labels);

/* A random map: pixel noise, blocks, smoothed noise, rectangles or strokes; labels 0..classes. */
void draw_random(rng *random, unsigned classes, uint16_t width, uint16_t height, uint8_t *labels);

#endif
