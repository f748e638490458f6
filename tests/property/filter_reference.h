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

/* What the library has under pel_op_...; some in 8 bits, some in 16, some in both. */
typedef enum ref_op {
    REF_KERNEL,
    REF_GRADIENT_ABS,
    REF_GRADIENT,
    REF_DIRECTION,
    REF_MEDIAN,
    REF_MIN,
    REF_MAX,
    REF_MAJORITY,
    REF_ERODE_LABELS,
    REF_DILATE_LABELS,
    REF_GAUSS3,
    REF_BOX3,
    REF_BINOMIAL5,
    REF_SOBEL_X,
    REF_SOBEL_Y,
    REF_OPS
} ref_op;

/* Puts the functions of an operator into a config, and says which one is in there. */
void ref_set_op(pel_filter_config *config, ref_op op);
ref_op ref_op_of(const pel_filter_config *config);
const char *ref_op_name(ref_op op);

/* Which results a config has. */
int ref_has_bytes(const pel_filter_config *config);
int ref_has_words(const pel_filter_config *config);

/*
 * The result at (x, y) of the result picture, not yet limited to 8 or 16 bits. Of a config only the
 * operator, kernel, border and constant are looked at.
 */
int64_t ref_result(const pel_filter_config *config, const ref_picture *picture, uint16_t x,
                   uint16_t y);

/* All results, limited; row after row without padding. */
void ref_filter_u8(const pel_filter_config *config, const ref_picture *picture, uint8_t *results);
void ref_filter_s16(const pel_filter_config *config, const ref_picture *picture, int16_t *results);

#endif
