/* Colour bars as they are defined, and what a driver's bytes should be where they show. */
#ifndef CAMERA_BARS_H
#define CAMERA_BARS_H

#include <linux/videodev2.h>

#include "capture.h"

#define BARS 8

/* Components of a colour as numbers from 0 to 255; of YCbCr the middle of Cb and Cr is 128. */
typedef struct components {
    double value[3];
} components;

/* R, G, B of bar 0..7: white, yellow, cyan, green, magenta, red, blue, black (falling luminance),
 * each 0 or `percent` of 255. */
components bar_rgb(unsigned bar, unsigned percent);

/* Y, Cb, Cr of a colour in the encoding and range that the driver reports, its defaults resolved as
 * V4L2 defines them. */
components coded(components rgb, const struct v4l2_pix_format *format);

/* Luminance as ITU-R BT.709 weighs it, 0..255. */
double luminance(components rgb);

/* Whether the driver reports that Y reaches from 0 to 255. */
int full_range(const struct v4l2_pix_format *format);

/*
 * Compares what a frame shows inside the bars (away from their edges) with `percent` bars. The
 * tolerance is 2 of 255 in each component of YCbCr, grey and 8-bit RGB (rounding, in the driver's
 * tables and of 75 % of 255), and one step of the format more for RGB565. Returns how many bytes or
 * components were compared; *wrong is how many are off, and the first of them is described.
 */
typedef struct comparison {
    unsigned long compared, wrong;
    char first[120];
} comparison;

/* The bytes as V4L2 defines their order, read here and not by the library. */
comparison compare_bytes(const capture_frame *frame, const struct v4l2_pix_format *format,
                         unsigned percent);

/* R, G, B as the library reads them from the frame's view. Its colours are BT.601. The tolerance
 * is 6: what 2 in Y and 2 in Cr or Cb may amount to; and 10 for RGB565. */
comparison compare_colors(const capture_frame *frame, unsigned percent);

#endif
