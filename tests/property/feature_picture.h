/* What the tests of corners, edges and lines share: a small picture, drawn at random, and how it is
 * read by the definitions: pixel by pixel, edge pixels repeated outside. */
#ifndef FEATURE_PICTURE_H
#define FEATURE_PICTURE_H

#include "check.h"

#include <pel.h>
#include <pel/feature.h>

#include <stdlib.h>
#include <string.h>

enum { WIDTH_MAX = 40, HEIGHT_MAX = 30, PIXELS_MAX = WIDTH_MAX * HEIGHT_MAX };

static uint8_t picture[PIXELS_MAX];
static int width, height;
static guarded frame_buffer;

/* Noise; black and white; few levels; rectangles on a slope. */
static inline void draw(rng *random, int w, int h, unsigned kind)
{
    width = w;
    height = h;
    for (int i = 0; i < w * h; i++) {
        const uint32_t value = rng_below(random, 256);
        picture[i] = (uint8_t)(kind == 0 ? value : kind == 1 ? (value & 1) * 255 : value / 64 * 85);
    }
    for (int n = 0; kind == 3 && n < 6; n++) {
        const int x0 = (int)rng_below(random, (uint32_t)w),
                  y0 = (int)rng_below(random, (uint32_t)h);
        const uint8_t value = (uint8_t)rng_below(random, 256);
        for (int y = n == 0 ? 0 : y0; y < h && (n == 0 || y < y0 + 9); y++) {
            for (int x = n == 0 ? 0 : x0; x < w && (n == 0 || x < x0 + 9); x++) {
                picture[y * w + x] = (uint8_t)(n == 0 ? 3 * x + 2 * y : value);
            }
        }
    }
}

static inline int at(int x, int y)
{
    x = x < 0 ? 0 : x >= width ? width - 1 : x;
    y = y < 0 ? 0 : y >= height ? height - 1 : y;
    return picture[y * width + x];
}

static inline int64_t sobel(int x, int y, int upright)
{
    static const int taps[3][3] = {{-1, 0, 1}, {-2, 0, 2}, {-1, 0, 1}};
    int64_t sum = 0;
    for (int j = 0; j < 3; j++) {
        for (int i = 0; i < 3; i++) {
            sum += (int64_t)(upright ? taps[i][j] : taps[j][i]) * at(x + i - 1, y + j - 1);
        }
    }
    return sum;
}

/* The picture with padding between rows, every second time from the last row to the first. */
static inline pel_cview spread_picture(int upside_down)
{
    const int stride = width + 3;
    uint8_t *const base = guarded_take(&frame_buffer, (size_t)(stride * height), 1, 0x77);
    pel_cview view;

    memset(&view, 0, sizeof view);
    view.plane[0] = base + (upside_down ? stride * (height - 1) : 0);
    view.stride_bytes[0] = upside_down ? -stride : stride;
    view.width = (uint16_t)width;
    view.height = (uint16_t)height;
    for (int y = 0; y < height; y++) {
        memcpy(base + stride * (upside_down ? height - 1 - y : y), picture + y * width,
               (size_t)width);
    }
    return view;
}

#endif
