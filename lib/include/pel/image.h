/*
 * Views of pictures, the pixel formats that cameras deliver, and how their rows are read.
 *
 * A view says where pixels lie and what they are; it owns nothing and copies nothing. A crop is
 * another view. A row (pel_crow) is the part of a view that one row operator needs; a camera that
 * delivers lines fills it directly, with no view and no frame buffer at all.
 *
 * Readers turn any row into separate Y, U and V bytes; everything above this module works on those
 * and never asks for the format again.
 */
#ifndef PEL_IMAGE_H
#define PEL_IMAGE_H

#include "pel/config.h"
#include "pel/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Pixel formats. The name gives the order of bytes in memory, first byte first, on every machine.
 * 4:2:2, 4:2:0 and Bayer need an even width; 4:2:0 and Bayer also an even height.
 */
typedef enum pel_format {
    PEL_GRAY8 = 0,   /* Y */
    PEL_YUYV,        /* Y0 U Y1 V: 4:2:2, two pixels in four bytes (V4L2 YUYV, also named YUY2) */
    PEL_UYVY,        /* U Y0 V Y1 */
    PEL_YVYU,        /* Y0 V Y1 U */
    PEL_VYUY,        /* V Y0 U Y1 */
    PEL_NV12,        /* plane 0: Y; plane 1: U V U V, half width and half height (4:2:0) */
    PEL_I420,        /* plane 0: Y; planes 1 and 2: U and V, half width and half height (4:2:0) */
    PEL_RGB565_LE,   /* 16 bits rrrrrggggggbbbbb, low byte first */
    PEL_RGB565_BE,   /* the same 16 bits, high byte first (what most small cameras send) */
    PEL_RGB888,      /* R G B */
    PEL_BGR888,      /* B G R */
    PEL_BAYER8_RGGB, /* colour filter mosaic; the name gives the first two bytes of rows 0 and 1 */
    PEL_BAYER8_GRBG,
    PEL_BAYER8_GBRG,
    PEL_BAYER8_BGGR,
    PEL_FORMAT_COUNT
} pel_format;

/*
 * What the bytes of a YCbCr picture mean. Full: Y, U, V in 0..255 (JPEG/JFIF, most MJPEG cameras).
 * Limited: Y in 16..235, U and V in 16..240 (ITU-R BT.601 as most YUYV webcams deliver it).
 * RGB and Bayer pictures have no range of their own: they are converted to the one that is asked.
 */
typedef enum pel_range { PEL_RANGE_FULL = 0, PEL_RANGE_LIMITED = 1 } pel_range;

/*
 * A picture to read. Plane p starts at plane[p] (its top row) and goes stride_bytes[p] from one row
 * to the next, which may be more than the row's bytes (padding) or negative (a bottom-up picture).
 * Planes that the format does not have are ignored.
 */
typedef struct pel_cview {
    const uint8_t *plane[3];
    int32_t stride_bytes[3];
    uint16_t width;  /* pixels, 1..PEL_SIDE_MAX */
    uint16_t height; /* rows, 1..PEL_SIDE_MAX */
    pel_format format;
    pel_range range;
} pel_cview;

/* A picture to write: the same, with writable planes. */
typedef struct pel_view {
    uint8_t *plane[3];
    int32_t stride_bytes[3];
    uint16_t width;
    uint16_t height;
    pel_format format;
    pel_range range;
} pel_view;

/*
 * One row to read. Packed formats use plane[0]. NV12: plane[0] = the Y row, plane[1] = its U V row.
 * I420: plane[0..2] = the Y, U and V rows. Bayer: plane[0] and plane[1] = the even and the odd row
 * of the pair that together give one row of colours of half the width.
 */
typedef struct pel_crow {
    const uint8_t *plane[3];
    uint16_t width; /* pixels (Bayer: of the mosaic) */
    pel_format format;
    pel_range range;
} pel_crow;

/* The name of a format as in the enum without its prefix, such as "RGB565_LE"; NULL for a value
 * that is none. Static text. */
const char *pel_format_name(pel_format format);

/* How many bytes a row of `width` pixels takes in plane 0 without padding; 0 if the format cannot
 * have that width. */
uint32_t pel_row_bytes(pel_format format, uint16_t width);

/* How many bytes a whole frame takes without padding, chroma planes behind the Y plane; 0 if the
 * format cannot have that size. At most 3 * PEL_SIDE_MAX^2 < 2^28. */
uint32_t pel_frame_bytes(pel_format format, uint16_t width, uint16_t height);

/*
 * Describes a frame in one piece of memory: plane 0 at `pixels`, and for NV12 and I420 the chroma
 * planes right behind it, each with the stride of plane 0 (NV12) or half of it (I420), as V4L2
 * lays them out. stride_bytes 0 means no padding. For a bottom-up picture `pixels` is the top
 * row (the last in memory) and the stride negative; NV12 and I420 cannot be described that way
 * (fill the struct by hand).
 *
 * PEL_ERR_ARG: null pointer, unknown format or range. PEL_ERR_FORMAT: the format cannot have this
 * size. PEL_ERR_RANGE: a side is 0 or over PEL_SIDE_MAX, or the stride is shorter than a row.
 */
pel_status pel_view_init(uint8_t *pixels, pel_format format, pel_range range, uint16_t width,
                         uint16_t height, int32_t stride_bytes, pel_view *view);
pel_status pel_cview_init(const uint8_t *pixels, pel_format format, pel_range range, uint16_t width,
                          uint16_t height, int32_t stride_bytes, pel_cview *view);

/* The same picture, to read only. */
pel_cview pel_view_to_read(const pel_view *view);

/* Says whether a view is one that the library accepts; statuses as of pel_view_init. */
pel_status pel_cview_check(const pel_cview *view);

/*
 * The part x0 <= x < x1, y0 <= y < y1 of a view as another view of the same pixels. `part` may be
 * `view`. PEL_ERR_RANGE: empty or not inside. PEL_ERR_FORMAT: an edge that cuts through a group of
 * pixels with shared chroma (odd x in 4:2:2; odd x or y in 4:2:0 and Bayer).
 */
pel_status pel_cview_crop(const pel_cview *view, uint16_t x0, uint16_t x1, uint16_t y0, uint16_t y1,
                          pel_cview *part);
pel_status pel_view_crop(const pel_view *view, uint16_t x0, uint16_t x1, uint16_t y0, uint16_t y1,
                         pel_view *part);

/* Columns and rows of colours: the size of the view, or half of it for Bayer. Label rows and blobs
 * count in these. */
uint16_t pel_color_width(pel_format format, uint16_t width);
uint16_t pel_color_height(pel_format format, uint16_t height);

/* Row y of the colours of a view, 0 <= y < pel_color_height. Not checked: for use in loops. */
pel_crow pel_cview_row(const pel_cview *view, uint16_t y);

/* A row of a packed format (all but NV12, I420 and Bayer) as a camera's line buffer holds it. */
pel_crow pel_crow_packed(const uint8_t *pixels, pel_format format, pel_range range, uint16_t width);

/* Says whether a row is one that the library accepts; statuses as of pel_view_init. */
pel_status pel_crow_check(const pel_crow *row);

/*
 * Reads `count` pixels of a row from column x on as Y, U and V in the given range, each into its
 * own array of `count` bytes. GRAY8 has U = V = 128. RGB is converted as pel_rgb_to_ycbcr_row
 * does. 5 and 6 bits of RGB565 become 8 by repeating the top bits. A Bayer cell gives one colour:
 * its R, its B and the mean of its two G, halves upward.
 *
 * PEL_ERR_ARG: null pointer, unknown format or range, outputs that overlap the row or each other.
 * PEL_ERR_RANGE: x + count is over pel_color_width. PEL_ERR_FORMAT: impossible width, or a YCbCr
 * row whose range is not the one asked.
 */
pel_status pel_crow_read_yuv(const pel_crow *row, uint16_t x, uint16_t count, pel_range range,
                             uint8_t *y, uint8_t *u, uint8_t *v);

/*
 * A function like pel_crow_read_yuv. What needs more of a format than its YCbCr bytes in place is
 * told which function reads it (pel_classifier, pel_blobs_config), so that a program links only the
 * readers that it names: pel_crow_read_yuv for all formats, or one of those below, which do the
 * same for their formats and answer PEL_ERR_FORMAT to others. With a count of 0 a reader only says
 * whether it can read the row.
 */
typedef pel_status pel_reader(const pel_crow *row, uint16_t x, uint16_t count, pel_range range,
                              uint8_t *y, uint8_t *u, uint8_t *v);

pel_reader pel_crow_read_ycbcr;  /* GRAY8, YUYV and its kin, NV12, I420 */
pel_reader pel_crow_read_rgb24;  /* RGB888, BGR888 */
pel_reader pel_crow_read_rgb565; /* RGB565_LE, RGB565_BE */
pel_reader pel_crow_read_bayer;  /* BAYER8_... */

/*
 * Reads `count` pixels of a row from column x on as R G B, 3 * count bytes. YCbCr is converted as
 * pel_ycbcr_to_rgb_row does, from the row's own range. Statuses as of pel_crow_read_yuv.
 */
pel_status pel_crow_read_rgb(const pel_crow *row, uint16_t x, uint16_t count, uint8_t *rgb);

#ifdef __cplusplus
}
#endif

#endif
