#include "bars.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define EDGE 4 /* columns on both sides of a bar's edge where chroma may be mixed */

components bar_rgb(unsigned bar, unsigned percent)
{
    const double level = 255.0 * percent / 100.0;
    const components rgb = {{bar & 2u ? 0 : level, bar & 4u ? 0 : level, bar & 1u ? 0 : level}};
    return rgb;
}

double luminance(components rgb)
{
    return 0.2126 * rgb.value[0] + 0.7152 * rgb.value[1] + 0.0722 * rgb.value[2];
}

static unsigned encoding(const struct v4l2_pix_format *format)
{
    return format->ycbcr_enc != V4L2_YCBCR_ENC_DEFAULT
               ? format->ycbcr_enc
               : (unsigned)V4L2_MAP_YCBCR_ENC_DEFAULT(format->colorspace);
}

int full_range(const struct v4l2_pix_format *format)
{
    const unsigned range =
        format->quantization != V4L2_QUANTIZATION_DEFAULT
            ? format->quantization
            : (unsigned)V4L2_MAP_QUANTIZATION_DEFAULT(0, format->colorspace, encoding(format));
    return range == V4L2_QUANTIZATION_FULL_RANGE;
}

components coded(components rgb, const struct v4l2_pix_format *format)
{
    double kr = 0.299, kb = 0.114; /* ITU-R BT.601 */
    if (encoding(format) == V4L2_YCBCR_ENC_709) {
        kr = 0.2126;
        kb = 0.0722;
    } else if (encoding(format) == V4L2_YCBCR_ENC_BT2020) {
        kr = 0.2627;
        kb = 0.0593;
    }
    const double r = rgb.value[0] / 255, g = rgb.value[1] / 255, b = rgb.value[2] / 255;
    const double y = kr * r + (1 - kr - kb) * g + kb * b;
    const double cb = (b - y) / (2 * (1 - kb)), cr = (r - y) / (2 * (1 - kr));
    if (full_range(format)) {
        const components full = {{255 * y, 128 + 255 * cb, 128 + 255 * cr}};
        return full;
    }
    const components limited = {{16 + 219 * y, 128 + 224 * cb, 128 + 224 * cr}};
    return limited;
}

/* The bar in column x, or -1 near an edge. */
static int bar_at(unsigned x, unsigned width)
{
    const unsigned left = (x >= EDGE ? x - EDGE : 0) * BARS / width;
    const unsigned right = (x + EDGE < width ? x + EDGE : width - 1) * BARS / width;
    return left == right ? (int)left : -1;
}

static void compare(comparison *all, const char *what, unsigned x, unsigned y, int is,
                    double should, double tolerance)
{
    all->compared++;
    if (fabs(is - should) > tolerance) {
        if (all->wrong++ == 0) {
            snprintf(all->first, sizeof all->first, "%s at %u,%u is %d, should be %.1f +- %.0f",
                     what, x, y, is, should, tolerance);
        }
    }
}

/* ---- Bytes --------------------------------------------------------------------------------- */

/* Where the components of pixel 0 of a pair lie in a packed group of four bytes: Y, Cb, Cr. */
struct packed {
    uint32_t fourcc;
    unsigned y, cb, cr;
};

static const struct packed packed_formats[] = {
    {V4L2_PIX_FMT_YUYV, 0, 1, 3},
    {V4L2_PIX_FMT_UYVY, 1, 0, 2},
    {V4L2_PIX_FMT_YVYU, 0, 3, 1},
    {V4L2_PIX_FMT_VYUY, 1, 2, 0},
};

/* The colours, R 0, G 1, B 2, of the sites of a mosaic: row 0 then row 1. */
struct mosaic {
    uint32_t fourcc;
    unsigned site[4];
};

static const struct mosaic mosaics[] = {
    {V4L2_PIX_FMT_SRGGB8, {0, 1, 1, 2}},
    {V4L2_PIX_FMT_SGRBG8, {1, 0, 2, 1}},
    {V4L2_PIX_FMT_SGBRG8, {1, 2, 0, 1}},
    {V4L2_PIX_FMT_SBGGR8, {2, 1, 1, 0}},
};

static const uint8_t *row(const capture_frame *frame, unsigned plane, unsigned y)
{
    return frame->view.plane[plane] + (ptrdiff_t)frame->view.stride_bytes[plane] * (ptrdiff_t)y;
}

/* Y, Cb and Cr of a pixel; 0 if the format is none of these. */
static int ycbcr_at(const capture_frame *frame, uint32_t fourcc, unsigned x, unsigned y, int is[3])
{
    const unsigned pair = x / 2;
    for (size_t i = 0; i < sizeof packed_formats / sizeof packed_formats[0]; i++) {
        const struct packed *order = &packed_formats[i];
        if (order->fourcc == fourcc) {
            const uint8_t *group = row(frame, 0, y) + 4 * (size_t)pair;
            is[0] = group[order->y + 2 * (x & 1u)];
            is[1] = group[order->cb];
            is[2] = group[order->cr];
            return 1;
        }
    }
    if (fourcc == V4L2_PIX_FMT_NV12) {
        is[0] = row(frame, 0, y)[x];
        is[1] = row(frame, 1, y / 2)[2 * pair];
        is[2] = row(frame, 1, y / 2)[2 * pair + 1];
        return 1;
    }
    if (fourcc == V4L2_PIX_FMT_YUV420) {
        is[0] = row(frame, 0, y)[x];
        is[1] = row(frame, 1, y / 2)[pair];
        is[2] = row(frame, 2, y / 2)[pair];
        return 1;
    }
    return 0;
}

/* R, G and B of a pixel, the bits of RGB565 scaled to 0..255; 0 if the format is none of these. */
static int rgb_at(const capture_frame *frame, uint32_t fourcc, unsigned x, unsigned y, int is[3])
{
    if (fourcc == V4L2_PIX_FMT_RGB565 || fourcc == V4L2_PIX_FMT_RGB565X) {
        const uint8_t *pixel = row(frame, 0, y) + 2 * (size_t)x;
        const unsigned low = fourcc == V4L2_PIX_FMT_RGB565 ? 0 : 1;
        const unsigned bits = pixel[low] | (unsigned)pixel[1 - low] << 8;
        is[0] = (int)((bits >> 11) * 255 / 31);
        is[1] = (int)((bits >> 5 & 63u) * 255 / 63);
        is[2] = (int)((bits & 31u) * 255 / 31);
        return 1;
    }
    if (fourcc == V4L2_PIX_FMT_RGB24 || fourcc == V4L2_PIX_FMT_BGR24) {
        const uint8_t *pixel = row(frame, 0, y) + 3 * (size_t)x;
        const unsigned red = fourcc == V4L2_PIX_FMT_RGB24 ? 0 : 2;
        is[0] = pixel[red];
        is[1] = pixel[1];
        is[2] = pixel[2 - red];
        return 1;
    }
    return 0;
}

/* The one byte of a mosaic or of grey, and which colour it shows (3: luminance). */
static int single_at(const capture_frame *frame, uint32_t fourcc, unsigned x, unsigned y,
                     unsigned *colour)
{
    *colour = 3;
    for (size_t i = 0; i < sizeof mosaics / sizeof mosaics[0]; i++) {
        if (mosaics[i].fourcc == fourcc) {
            *colour = mosaics[i].site[2 * (y & 1u) + (x & 1u)];
        }
    }
    return row(frame, 0, y)[x];
}

static void compare_pixel(comparison *all, const capture_frame *frame,
                          const struct v4l2_pix_format *format, unsigned x, unsigned y,
                          components rgb)
{
    static const char *const ycbcr_names[3] = {"Y", "Cb", "Cr"};
    static const char *const rgb_names[4] = {"R", "G", "B", "grey"};
    const uint32_t fourcc = format->pixelformat;
    const int coarse = fourcc == V4L2_PIX_FMT_RGB565 || fourcc == V4L2_PIX_FMT_RGB565X;
    int is[3];
    if (ycbcr_at(frame, fourcc, x, y, is)) {
        const components should = coded(rgb, format);
        for (unsigned i = 0; i < 3; i++) {
            compare(all, ycbcr_names[i], x, y, is[i], should.value[i], 2);
        }
    } else if (rgb_at(frame, fourcc, x, y, is)) {
        for (unsigned i = 0; i < 3; i++) {
            const double step = !coarse ? 0 : i == 1 ? 4 : 8;
            compare(all, rgb_names[i], x, y, is[i], rgb.value[i], 2 + step);
        }
    } else {
        unsigned colour;
        is[0] = single_at(frame, fourcc, x, y, &colour);
        compare(all, rgb_names[colour], x, y, is[0],
                colour < 3 ? rgb.value[colour] : luminance(rgb), 2);
    }
}

/* Every fifth row, so even ones and odd ones, and the last. */
static unsigned next_row(unsigned y, unsigned height)
{
    return y + 5 < height || y + 1 == height ? y + 5 : height - 1;
}

comparison compare_bytes(const capture_frame *frame, const struct v4l2_pix_format *format,
                         unsigned percent)
{
    comparison all;
    memset(&all, 0, sizeof all);
    for (unsigned y = 0; y < format->height; y = next_row(y, format->height)) {
        for (unsigned x = 0; x < format->width; x++) {
            const int bar = bar_at(x, format->width);
            if (bar >= 0) {
                compare_pixel(&all, frame, format, x, y, bar_rgb((unsigned)bar, percent));
            }
        }
    }
    return all;
}

/* ---- Colours ------------------------------------------------------------------------------- */

comparison compare_colors(const capture_frame *frame, unsigned percent)
{
    static uint8_t colors[3 * PEL_SIDE_MAX];
    const pel_cview *view = &frame->view;
    const uint16_t width = pel_color_width(view->format, view->width);
    const uint16_t height = pel_color_height(view->format, view->height);
    const int coarse = view->format == PEL_RGB565_LE || view->format == PEL_RGB565_BE;
    comparison all;
    memset(&all, 0, sizeof all);
    for (unsigned y = 0; y < height; y = next_row(y, height)) {
        const pel_crow one = pel_cview_row(view, (uint16_t)y);
        const pel_status status = pel_crow_read_rgb(&one, 0, width, colors);
        compare(&all, "status of the row", 0, y, status, PEL_OK, 0);
        for (unsigned x = 0; x < width && status == PEL_OK; x++) {
            const int bar = bar_at(x, width);
            for (unsigned i = 0; bar >= 0 && i < 3; i++) {
                const components rgb = bar_rgb((unsigned)bar, percent);
                compare(&all, "a colour", x, y, colors[3 * x + i], rgb.value[i], coarse ? 10 : 6);
            }
        }
    }
    return all;
}
