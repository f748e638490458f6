#include "pack.h"

#include <string.h>

#include "raw.h"
#include "say.h"

/* Two rows of colours, three bytes a pixel (Y U V or R G B as the writer wants); formats that are
 * written row by row use the upper one only. */
typedef struct band {
    uint8_t upper[3 * PEL_SIDE_MAX];
    uint8_t lower[3 * PEL_SIDE_MAX];
} band;

/* How a format is written: `put` fills the row of each plane (Bayer: of both rows of the mosaic)
 * from `rows` rows of colours. */
typedef struct packer {
    int ycbcr;     /* wants Y U V, not R G B */
    unsigned rows; /* 1, or 2 where rows share something */
    void (*put)(const struct packer *how, const band *from, unsigned width, uint8_t *const *to);
    uint8_t place[4]; /* 4:2:2: bytes of Y0 U Y1 V; RGB: of R G B, RGB565: of high low; Bayer: the
                         channels (0 R, 1 G, 2 B) of the upper left, upper right, lower left and
                         lower right */
} packer;

static uint8_t mean2(const uint8_t *pixels)
{
    return (uint8_t)((pixels[0] + pixels[3] + 1) / 2);
}

static uint8_t mean4(const uint8_t *above, const uint8_t *below)
{
    return (uint8_t)((above[0] + above[3] + below[0] + below[3] + 2) / 4);
}

static void put_gray(const packer *how, const band *from, unsigned width, uint8_t *const *to)
{
    unsigned x;

    (void)how;
    for (x = 0; x < width; x++) {
        to[0][x] = from->upper[3 * x];
    }
}

static void put_422(const packer *how, const band *from, unsigned width, uint8_t *const *to)
{
    const uint8_t *place = how->place;
    unsigned x;

    for (x = 0; x < width; x += 2) {
        const uint8_t *pair = from->upper + 3 * x;
        uint8_t *out = to[0] + 2 * x;
        out[place[0]] = pair[0];
        out[place[1]] = mean2(pair + 1);
        out[place[2]] = pair[3];
        out[place[3]] = mean2(pair + 2);
    }
}

/* to: two rows of Y, then the chroma rows: U V U V, or U and V. */
static void put_420(const packer *how, const band *from, unsigned width, uint8_t *const *to)
{
    unsigned step = how->place[0];
    unsigned x;

    for (x = 0; x < width; x++) {
        to[0][x] = from->upper[3 * x];
        to[1][x] = from->lower[3 * x];
    }
    for (x = 0; x < width; x += 2) {
        const uint8_t *above = from->upper + 3 * x, *below = from->lower + 3 * x;
        to[2][x / 2 * step] = mean4(above + 1, below + 1);
        to[3][x / 2 * step] = mean4(above + 2, below + 2);
    }
}

static void put_rgb(const packer *how, const band *from, unsigned width, uint8_t *const *to)
{
    unsigned x;

    for (x = 0; x < width; x++) {
        const uint8_t *pixel = from->upper + 3 * x;
        uint8_t *out = to[0] + 3 * x;
        out[how->place[0]] = pixel[0];
        out[how->place[1]] = pixel[1];
        out[how->place[2]] = pixel[2];
    }
}

static unsigned nearest(unsigned value, unsigned max)
{
    return (value * max + 127) / 255;
}

static void put_rgb565(const packer *how, const band *from, unsigned width, uint8_t *const *to)
{
    unsigned x;

    for (x = 0; x < width; x++) {
        const uint8_t *pixel = from->upper + 3 * x;
        unsigned bits =
            nearest(pixel[0], 31) << 11 | nearest(pixel[1], 63) << 5 | nearest(pixel[2], 31);
        to[0][2 * x + how->place[0]] = (uint8_t)(bits >> 8);
        to[0][2 * x + how->place[1]] = (uint8_t)(bits & 255);
    }
}

static void put_bayer(const packer *how, const band *from, unsigned width, uint8_t *const *to)
{
    unsigned x;

    for (x = 0; x < width; x++) {
        to[0][x] = from->upper[3 * x + how->place[x % 2]];
        to[1][x] = from->lower[3 * x + how->place[2 + x % 2]];
    }
}

static const packer packers[PEL_FORMAT_COUNT] = {
    [PEL_GRAY8] = {1, 1, put_gray, {0}},
    [PEL_YUYV] = {1, 1, put_422, {0, 1, 2, 3}},
    [PEL_UYVY] = {1, 1, put_422, {1, 0, 3, 2}},
    [PEL_YVYU] = {1, 1, put_422, {0, 3, 2, 1}},
    [PEL_VYUY] = {1, 1, put_422, {1, 2, 3, 0}},
    [PEL_NV12] = {1, 2, put_420, {2}},
    [PEL_I420] = {1, 2, put_420, {1}},
    [PEL_RGB565_LE] = {0, 1, put_rgb565, {1, 0}},
    [PEL_RGB565_BE] = {0, 1, put_rgb565, {0, 1}},
    [PEL_RGB888] = {0, 1, put_rgb, {0, 1, 2}},
    [PEL_BGR888] = {0, 1, put_rgb, {2, 1, 0}},
    [PEL_BAYER8_RGGB] = {0, 2, put_bayer, {0, 1, 1, 2}},
    [PEL_BAYER8_GRBG] = {0, 2, put_bayer, {1, 0, 2, 1}},
    [PEL_BAYER8_GBRG] = {0, 2, put_bayer, {1, 2, 0, 1}},
    [PEL_BAYER8_BGGR] = {0, 2, put_bayer, {2, 1, 1, 0}},
};

int pack_has_range(pel_format format)
{
    return packers[format].ycbcr;
}

void pack_rgb_row(const pel_cview *view, unsigned y, uint8_t *row)
{
    pel_crow from = pel_cview_row(view, (uint16_t)y);

    pel_crow_read_rgb(&from, 0, pel_color_width(view->format, view->width), row);
}

/* Row y as Y U V in `range`, three bytes a pixel. */
static void read_ycbcr(const pel_cview *view, unsigned y, pel_range range, uint8_t *row)
{
    uint16_t width = pel_color_width(view->format, view->width);
    pel_crow from = pel_cview_row(view, (uint16_t)y);
    uint8_t luma[PEL_SIDE_MAX], cb[PEL_SIDE_MAX], cr[PEL_SIDE_MAX];
    unsigned x;

    if (pack_has_range(view->format) && view->range != range) {
        pack_rgb_row(view, y, row);
        pel_rgb_to_ycbcr_row(row, row, width, range);
        return;
    }
    pel_crow_read_yuv(&from, 0, width, range, luma, cb, cr);
    for (x = 0; x < width; x++) {
        row[3 * x] = luma[x];
        row[3 * x + 1] = cb[x];
        row[3 * x + 2] = cr[x];
    }
}

void pack_gray_row(const pel_cview *view, unsigned y, uint8_t *row)
{
    uint16_t width = pel_color_width(view->format, view->width);
    uint8_t colors[3 * PEL_SIDE_MAX];
    unsigned x;

    read_ycbcr(view, y, PEL_RANGE_FULL, colors);
    for (x = 0; x < width; x++) {
        row[x] = colors[3 * x];
    }
}

/* Where row y of the output goes: the rows of its planes, as the packer's `put` wants them. */
static void find_rows(const pel_view *view, const packer *how, unsigned y, uint8_t **to)
{
    const int32_t *stride = view->stride_bytes;

    to[0] = view->plane[0] + (ptrdiff_t)y * stride[0];
    to[1] = how->rows == 2 ? to[0] + stride[0] : NULL;
    to[2] = NULL;
    to[3] = NULL;
    if (how->put == put_420) {
        to[2] = view->plane[1] + (ptrdiff_t)(y / 2) * stride[1];
        to[3] =
            view->format == PEL_I420 ? view->plane[2] + (ptrdiff_t)(y / 2) * stride[2] : to[2] + 1;
    }
}

static void read_colors(const pel_cview *view, const packer *how, unsigned y, pel_range range,
                        uint8_t *row)
{
    if (how->ycbcr) {
        read_ycbcr(view, y, range, row);
    } else {
        pack_rgb_row(view, y, row);
    }
}

static void append_row(void *user, const uint8_t *bytes, size_t count)
{
    uint8_t **end = user;

    memcpy(*end, bytes, count);
    *end += count;
}

/* The bytes as they are, without padding. */
static void copy(const pel_cview *view, frame *out)
{
    uint8_t *end = out->bytes;

    raw_each_row(view, append_row, &end);
}

static int wrong_size(const char *where, pel_format format, unsigned width, unsigned height)
{
    return say_error(where,
                     "%ux%u pixels cannot be %s: 4:2:2 needs an even width, 4:2:0 and Bayer an "
                     "even width and height; --crop X0,Y0,X1,Y1 takes a part that has one",
                     width, height, pel_format_name(format));
}

int pack_frame(const char *where, const pel_cview *view, pel_format format, pel_range range,
               frame *out)
{
    const packer *how = &packers[format];
    int same = view->format == format && (view->range == range || !how->ycbcr);
    uint16_t width = same ? view->width : pel_color_width(view->format, view->width);
    uint16_t height = same ? view->height : pel_color_height(view->format, view->height);
    uint8_t *to[4];
    unsigned y;
    band colors;

    if (pel_frame_bytes(format, width, height) == 0) {
        return wrong_size(where, format, width, height);
    }
    if (frame_resize(out, format, range, width, height)) {
        return say_error(where, "not enough memory for %ux%u pixels", width, height);
    }
    if (same) {
        copy(view, out);
        return 0;
    }
    for (y = 0; y < height; y += how->rows) {
        read_colors(view, how, y, range, colors.upper);
        if (how->rows == 2) {
            read_colors(view, how, y + 1, range, colors.lower);
        }
        find_rows(&out->view, how, y, to);
        how->put(how, &colors, width, to);
    }
    return 0;
}
