/*
 * Readers: rows of any format as separate Y, U and V, or as R G B. One function for each layout and
 * one for all of them, so that a program links only what it names.
 */
#include "format.h"
#include "overlap.h"
#include "row/row_color_select.h"

/* What all readers refuse. */
static pel_status check_part(const pel_crow *row, uint16_t x, uint16_t count)
{
    const pel_status status = pel_crow_check(row);

    if (status != PEL_OK) {
        return status;
    }
    return (uint32_t)x + count <= pel_color_width(row->format, row->width) ? PEL_OK : PEL_ERR_RANGE;
}

/* ---- To Y, U and V ------------------------------------------------------------------------- */

/* Where the parts of a colour go. */
typedef struct planes {
    uint8_t *y, *u, *v;
} planes;

static pel_status check_yuv(const pel_crow *row, uint16_t x, uint16_t count, pel_range range,
                            planes to)
{
    const pel_status status = to.y && to.u && to.v && (unsigned)range <= PEL_RANGE_LIMITED
                                  ? check_part(row, x, count)
                                  : PEL_ERR_ARG;
    if (status != PEL_OK) {
        return status;
    }
    return pel_i_crow_overlaps(row, to.y, count) || pel_i_crow_overlaps(row, to.u, count) ||
                   pel_i_crow_overlaps(row, to.v, count) ||
                   pel_i_overlap(to.y, count, to.u, count) ||
                   pel_i_overlap(to.y, count, to.v, count) ||
                   pel_i_overlap(to.u, count, to.v, count)
               ? PEL_ERR_ARG
               : PEL_OK;
}

/* Pixels x .. x+count-1 of a row that is not YCbCr as R G B. */
typedef void rgb_reader(const pel_crow *row, uint16_t x, uint16_t count, uint8_t *rgb);

static void rgb_of_rgb24(const pel_crow *row, uint16_t x, uint16_t count, uint8_t *rgb)
{
    pel_row_read_rgb24(row->plane[0] + 3 * (size_t)x, count, pel_i_format_of(row)->order, rgb);
}

static void rgb_of_rgb565(const pel_crow *row, uint16_t x, uint16_t count, uint8_t *rgb)
{
    pel_row_read_rgb565(row->plane[0] + 2 * (size_t)x, count, pel_i_format_of(row)->order, rgb);
}

static void rgb_of_bayer(const pel_crow *row, uint16_t x, uint16_t count, uint8_t *rgb)
{
    pel_row_read_bayer(row->plane[0] + 2 * (size_t)x, row->plane[1] + 2 * (size_t)x, count,
                       pel_i_format_of(row)->order, rgb);
}

static rgb_reader *rgb_reader_of(unsigned layout)
{
    return layout == PEL_LAYOUT_RGB24    ? rgb_of_rgb24
           : layout == PEL_LAYOUT_RGB565 ? rgb_of_rgb565
                                         : rgb_of_bayer;
}

/* ---- In vectors ---------------------------------------------------------------------------- */

/* Whole parts of rows where a backend has a version for them; else 0, and nothing is done. */
#if defined(PEL_ROW_COLOR)
static pel_row_colors colors_of(const pel_crow *row, uint16_t x)
{
    const pel_format_info *const info = pel_i_format(row->format);
    const size_t skip = (size_t)x * (info->layout == PEL_LAYOUT_RGB24 ? 3 : 2);
    const pel_row_colors colors = {row->plane[0] + skip,
                                   info->layout == PEL_LAYOUT_BAYER ? row->plane[1] + skip : NULL,
                                   info->layout == PEL_LAYOUT_RGB24    ? PEL_ROW_RGB24
                                   : info->layout == PEL_LAYOUT_RGB565 ? PEL_ROW_RGB565
                                                                       : PEL_ROW_BAYER,
                                   info->order};
    return colors;
}

static int convert_at_once(const pel_crow *row, uint16_t x, uint16_t count, int limited, planes to)
{
    const pel_row_colors src = colors_of(row, x);
    const pel_row_places dst = {to.y, to.u, to.v, 1};
    return pel_i_row_colors_to_ycbcr(pel_i_row_backend(PEL_BACKEND_AUTO), &src, count, limited,
                                     &dst);
}

static int copy_at_once(const pel_crow *row, uint16_t x, uint16_t count, uint8_t *rgb)
{
    const pel_row_colors src = colors_of(row, x);
    return pel_i_row_colors_to_rgb(pel_i_row_backend(PEL_BACKEND_AUTO), &src, count, rgb);
}

/* A pair that begins with its second pixel is for plain C. */
static pel_row_pairs pairs_from(const pel_row_pairs *pairs, uint16_t x)
{
    const size_t chroma = (size_t)(x / 2) * pairs->c_step;
    const pel_row_pairs part = {pairs->y + (size_t)x * pairs->y_step, pairs->u + chroma,
                                pairs->v + chroma, pairs->y_step, pairs->c_step};
    return part;
}

static int copy_pairs_at_once(const pel_row_pairs *pairs, uint16_t x, uint16_t count, planes to)
{
    const pel_row_pairs src = pairs_from(pairs, x);
    const pel_row_places dst = {to.y, to.u, to.v, 1};
    return x % 2 == 0 &&
           pel_i_row_pairs_to_planes(pel_i_row_backend(PEL_BACKEND_AUTO), &src, count, &dst);
}

static int convert_pairs_at_once(const pel_row_pairs *pairs, uint16_t x, uint16_t count,
                                 int limited, uint8_t *rgb)
{
    const pel_row_pairs src = pairs_from(pairs, x);
    return x % 2 == 0 &&
           pel_i_row_pairs_to_rgb(pel_i_row_backend(PEL_BACKEND_AUTO), &src, count, limited, rgb);
}
#else
#define convert_at_once(row, x, count, limited, to) 0
#define copy_at_once(row, x, count, rgb) 0
#define copy_pairs_at_once(pairs, x, count, to) 0
#define convert_pairs_at_once(pairs, x, count, limited, rgb) 0
#endif

enum { CHUNK = 8 }; /* pixels converted at a time: 24 bytes of stack */

static void convert(const pel_crow *row, uint16_t x, uint16_t count, rgb_reader *read, int limited,
                    planes to)
{
    uint8_t rgb[3 * CHUNK];

    if (convert_at_once(row, x, count, limited, to)) {
        return;
    }
    for (uint16_t done = 0; done < count; done = (uint16_t)(done + CHUNK)) {
        const uint16_t n = (uint16_t)(count - done < CHUNK ? count - done : CHUNK);
        read(row, (uint16_t)(x + done), n, rgb);
        pel_row_rgb_to_ycbcr(rgb, n, limited, to.y + done, to.u + done, to.v + done, 1);
    }
}

/* Of a row that is YCbCr, which must have the range. */
static pel_status copy_pairs(const pel_crow *row, uint16_t x, uint16_t count, pel_range range,
                             planes to)
{
    const pel_row_pairs pairs = pel_i_pairs(pel_i_format_of(row), row);

    if (row->range != range) {
        return PEL_ERR_FORMAT;
    }
    if (!copy_pairs_at_once(&pairs, x, count, to)) {
        pel_row_read_pairs(&pairs, x, count, to.y, to.u, to.v);
    }
    return PEL_OK;
}

/* Those of check_yuv, and that the row has the layout. Apart from the conversion, so that their
 * stacks do not add up. */
static pel_status check_layout(const pel_crow *row, uint16_t x, uint16_t count, pel_range range,
                               enum pel_layout layout, planes to)
{
    const pel_status status = check_yuv(row, x, count, range, to);

    return status == PEL_OK && pel_i_format_of(row)->layout != layout ? PEL_ERR_FORMAT : status;
}

pel_status pel_crow_read_rgb24(const pel_crow *row, uint16_t x, uint16_t count, pel_range range,
                               uint8_t *y, uint8_t *u, uint8_t *v)
{
    const planes to = {y, u, v};
    const pel_status status = check_layout(row, x, count, range, PEL_LAYOUT_RGB24, to);

    if (status == PEL_OK) {
        convert(row, x, count, rgb_of_rgb24, range == PEL_RANGE_LIMITED, to);
    }
    return status;
}

pel_status pel_crow_read_rgb565(const pel_crow *row, uint16_t x, uint16_t count, pel_range range,
                                uint8_t *y, uint8_t *u, uint8_t *v)
{
    const planes to = {y, u, v};
    const pel_status status = check_layout(row, x, count, range, PEL_LAYOUT_RGB565, to);

    if (status == PEL_OK) {
        convert(row, x, count, rgb_of_rgb565, range == PEL_RANGE_LIMITED, to);
    }
    return status;
}

pel_status pel_crow_read_bayer(const pel_crow *row, uint16_t x, uint16_t count, pel_range range,
                               uint8_t *y, uint8_t *u, uint8_t *v)
{
    const planes to = {y, u, v};
    const pel_status status = check_layout(row, x, count, range, PEL_LAYOUT_BAYER, to);

    if (status == PEL_OK) {
        convert(row, x, count, rgb_of_bayer, range == PEL_RANGE_LIMITED, to);
    }
    return status;
}

pel_status pel_crow_read_ycbcr(const pel_crow *row, uint16_t x, uint16_t count, pel_range range,
                               uint8_t *y, uint8_t *u, uint8_t *v)
{
    const planes to = {y, u, v};
    const pel_status status = check_layout(row, x, count, range, PEL_LAYOUT_PAIRS, to);

    return status == PEL_OK ? copy_pairs(row, x, count, range, to) : status;
}

pel_status pel_crow_read_yuv(const pel_crow *row, uint16_t x, uint16_t count, pel_range range,
                             uint8_t *y, uint8_t *u, uint8_t *v)
{
    const planes to = {y, u, v};
    const pel_status status = check_yuv(row, x, count, range, to);
    unsigned layout;

    if (status != PEL_OK) {
        return status;
    }
    layout = pel_i_format_of(row)->layout;
    if (layout == PEL_LAYOUT_PAIRS) {
        return copy_pairs(row, x, count, range, to);
    }
    convert(row, x, count, rgb_reader_of(layout), range == PEL_RANGE_LIMITED, to);
    return PEL_OK;
}

/* ---- To R G B ------------------------------------------------------------------------------ */

/* Pairs to R G B in pieces. */
static void convert_pairs(const pel_row_pairs *pairs, uint16_t x, uint16_t count, int limited,
                          uint8_t *rgb)
{
    uint8_t yuv[3 * CHUNK];

    if (convert_pairs_at_once(pairs, x, count, limited, rgb)) {
        return;
    }
    for (uint16_t done = 0; done < count; done = (uint16_t)(done + CHUNK)) {
        const uint16_t n = (uint16_t)(count - done < CHUNK ? count - done : CHUNK);
        pel_row_read_pairs(pairs, (uint16_t)(x + done), n, yuv, yuv + CHUNK, yuv + 2 * CHUNK);
        pel_row_ycbcr_to_rgb(yuv, yuv + CHUNK, yuv + 2 * CHUNK, 1, n, limited,
                             rgb + 3 * (size_t)done);
    }
}

pel_status pel_crow_read_rgb(const pel_crow *row, uint16_t x, uint16_t count, uint8_t *rgb)
{
    const pel_format_info *info;
    const pel_status status = rgb ? check_part(row, x, count) : PEL_ERR_ARG;

    if (status != PEL_OK) {
        return status;
    }
    if (pel_i_crow_overlaps(row, rgb, 3 * (size_t)count)) {
        return PEL_ERR_ARG;
    }
    info = pel_i_format_of(row);
    if (info->layout == PEL_LAYOUT_PAIRS) {
        const pel_row_pairs pairs = pel_i_pairs(info, row);
        convert_pairs(&pairs, x, count, row->range == PEL_RANGE_LIMITED, rgb);
    } else if (!copy_at_once(row, x, count, rgb)) {
        rgb_reader *const read = rgb_reader_of(info->layout);
        read(row, x, count, rgb);
    }
    return PEL_OK;
}
