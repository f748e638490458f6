/*
 * What filters compute, written down a second time: straight from the definitions in pel/filter.h,
 * one pixel at a time, with 64-bit sums, exact fractions and mirrors walked step by step. Shares no
 * idea with the library: no rows, no slots, no streaming.
 */
#ifndef FILTER_REFERENCE_H
#define FILTER_REFERENCE_H

#include <pel.h>
#include <pel/filter.h>

enum { REF_WIDTH_MAX = 128, REF_HEIGHT_MAX = 64 };

/* A gray picture, row after row without padding. */
typedef struct ref_picture {
    uint16_t width, height;
    const uint8_t *pixels;
} ref_picture;

/* The place that stands for place i; -1 for none. */
int64_t ref_place(int64_t i, int64_t length, pel_border border);

/* Radius of what a config computes, and the size of its result for a picture. */
unsigned ref_radius(const pel_filter_config *config);
uint16_t ref_width(const pel_filter_config *config, const ref_picture *picture);
uint16_t ref_height(const pel_filter_config *config, const ref_picture *picture);

/* Whether an operator has 16-bit results. */
int ref_is_signed(pel_filter_op op);

/*
 * The result at (x, y) of the result picture, not yet limited to 8 or 16 bits. Of a config only op,
 * kernel, border and constant are looked at.
 */
int64_t ref_result(const pel_filter_config *config, const ref_picture *picture, uint16_t x,
                   uint16_t y);

/* All results, limited; row after row without padding. */
void ref_filter_u8(const pel_filter_config *config, const ref_picture *picture, uint8_t *results);
void ref_filter_s16(const pel_filter_config *config, const ref_picture *picture, int16_t *results);

#endif
