/*
 * What blobs are, written down a second time: straight from the definitions in pel/blobs.h, with
 * flood fill, one pixel at a time, slowly. Shares no idea with the library: no runs, no union-find,
 * no streaming, no fixed point.
 */
#ifndef REFERENCE_H
#define REFERENCE_H

#include <pel.h>

enum { REF_SIDE_MAX = 128, REF_PIXELS_MAX = 128 * 128 };

/* A map of labels, row after row without padding. */
typedef struct ref_map {
    uint16_t width, height; /* 1..REF_SIDE_MAX */
    const uint8_t *labels;
} ref_map;

/*
 * All blobs of a map, everything measured, in raster order of their first pixels. `yuv`: three
 * bytes per pixel for the mean colour; may be NULL. `blobs` has room for width * height. Returns
 * how many.
 */
uint32_t ref_find(const ref_map *map, int connectivity, const uint8_t *yuv, pel_blob *blobs);

/* Sets what was not measured to 0. */
void ref_forget_unmeasured(pel_blob *blob, unsigned measure);

/* Pixels that have a class. */
uint32_t ref_coloured(const ref_map *map);

/* The blobs of rows 0..y that reach row y: no finder can keep fewer of them open after that row. */
uint32_t ref_open_after_row(const ref_map *map, int connectivity, uint16_t y);

/* Negative, 0, positive by the order that pel_blobs_sort documents. */
int ref_compare_documented(const void *a, const void *b);

/* The same, then by every other field: 0 only for equal blobs. */
int ref_compare_all(const void *a, const void *b);

/* 1 passes, 0 does not; a NULL filter passes all. */
int ref_passes(const pel_blob *blob, const pel_blob_filter *filter);

/* The same for bounds of the shape; -1: too near to an elongation bound for the stated error of
 * elongation. */
int ref_shape_passes(const pel_blob *blob, const pel_blob_shape *shape);

/* The shape functions from their definitions; the real ones unrounded. */
int32_t ref_centroid_q16(uint32_t sum, uint32_t area);
uint16_t ref_density_q15(const pel_blob *blob);
int ref_has_axis(const pel_blob *blob);
long double ref_angle_turn16(const pel_blob *blob);
long double ref_roundness_q15(const pel_blob *blob);
long double ref_compactness_q15(const pel_blob *blob);

/* One RGB colour as Y, U, V by the formulas in pel/color.h, in rational arithmetic. */
void ref_rgb_to_yuv(const uint8_t *rgb, pel_range range, uint8_t *yuv);

#endif
