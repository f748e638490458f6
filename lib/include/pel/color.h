/*
 * Colour spaces, one row at a time, exactly rounded.
 *
 * All rows are packed, three bytes a pixel: R G B, Y U V (U = Cb, V = Cr), r g b (normalised),
 * H S V. width is the number of pixels, any. Source and destination may be the same row. All return
 * PEL_OK, or PEL_ERR_ARG for a null pointer, an unknown range, or rows that overlap otherwise.
 */
#ifndef PEL_COLOR_H
#define PEL_COLOR_H

#include "pel/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * RGB to YCbCr, ITU-R BT.601 (JFIF 1.02 for the full range). With Y' = (299 R + 587 G + 114 B) /
 * 1000 unrounded:
 *
 *   full     Y = Y'                 U = 128 + (B - Y') / 1.772            V = 128 + (R-Y') / 1.402
 *   limited  Y = 16 + Y' * 219/255  U = 128 + (B - Y') / 1.772 * 224/255  V likewise
 *
 * each rounded to nearest, halves upward, limited to 0..255. Equal to exact rational arithmetic for
 * all 2^24 colours.
 */
pel_status pel_rgb_to_ycbcr_row(const uint8_t *rgb, uint8_t *ycbcr, uint16_t width,
                                pel_range range);

/*
 * YCbCr to RGB, the inverse of the formulas above, rounded to nearest, halves upward, limited to
 * 0..255. There and back an RGB colour comes out within 1 (full range, all channels) or 2 (limited
 * range); a test visits all 2^24 colours.
 */
pel_status pel_ycbcr_to_rgb_row(const uint8_t *ycbcr, uint8_t *rgb, uint16_t width,
                                pel_range range);

/*
 * RGB to normalised RGB (chromaticity): each channel * 255 / (R + G + B), rounded to nearest,
 * halves upward: independent of the brightness of the light. Where R + G + B < sum_min (0..765) the
 * colour is too dark to tell and becomes gray, 85 85 85; black always does.
 */
pel_status pel_rgb_to_nrgb_row(const uint8_t *rgb, uint8_t *nrgb, uint16_t width, uint16_t sum_min);

/*
 * RGB to HSV (Smith 1978). H in 1/256 of a turn (0 red, 85 green, 171 blue; 256 is 0 again);
 * S = 255 * (max - min) / max; V = max; each rounded to nearest, halves upward. Grays have H = 0.
 */
pel_status pel_rgb_to_hsv_row(const uint8_t *rgb, uint8_t *hsv, uint16_t width);

/* Whether hue lies on the arc that runs upward from `from` to `to`, both included, through 0 where
 * from > to: pel_hue_within(250, 240, 10) is 1. */
int pel_hue_within(uint8_t hue, uint8_t from, uint8_t to);

#ifdef __cplusplus
}
#endif

#endif
