#include "format.h"
#include "overlap.h"

/*
 * The formats, in the order of the enum. No pointers in here: the table stays in flash.
 *    layout, bytes of a pair, planes, groups, order,
 *    Y offset and step, U and V plane and offset, their step
 */
const pel_format_info pel_i_formats[PEL_FORMAT_COUNT] = {
    {PEL_LAYOUT_PAIRS, 2, 1, 1, 1, 0, 0, 1, 0, 0, 0, 0, 0},  /* GRAY8 */
    {PEL_LAYOUT_PAIRS, 4, 1, 2, 1, 0, 0, 2, 0, 1, 0, 3, 4},  /* YUYV */
    {PEL_LAYOUT_PAIRS, 4, 1, 2, 1, 0, 1, 2, 0, 0, 0, 2, 4},  /* UYVY */
    {PEL_LAYOUT_PAIRS, 4, 1, 2, 1, 0, 0, 2, 0, 3, 0, 1, 4},  /* YVYU */
    {PEL_LAYOUT_PAIRS, 4, 1, 2, 1, 0, 1, 2, 0, 2, 0, 0, 4},  /* VYUY */
    {PEL_LAYOUT_PAIRS, 2, 2, 2, 2, 0, 0, 1, 1, 0, 1, 1, 2},  /* NV12 */
    {PEL_LAYOUT_PAIRS, 2, 3, 2, 2, 0, 0, 1, 1, 0, 2, 0, 1},  /* I420 */
    {PEL_LAYOUT_RGB565, 4, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0}, /* RGB565_LE */
    {PEL_LAYOUT_RGB565, 4, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0}, /* RGB565_BE */
    {PEL_LAYOUT_RGB24, 6, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0},  /* RGB888 */
    {PEL_LAYOUT_RGB24, 6, 1, 1, 1, 2, 0, 0, 0, 0, 0, 0, 0},  /* BGR888 */
    {PEL_LAYOUT_BAYER, 2, 1, 2, 2, 0, 0, 0, 0, 0, 0, 0, 0},  /* BAYER8_RGGB */
    {PEL_LAYOUT_BAYER, 2, 1, 2, 2, 1, 0, 0, 0, 0, 0, 0, 0},  /* BAYER8_GRBG */
    {PEL_LAYOUT_BAYER, 2, 1, 2, 2, 2, 0, 0, 0, 0, 0, 0, 0},  /* BAYER8_GBRG */
    {PEL_LAYOUT_BAYER, 2, 1, 2, 2, 3, 0, 0, 0, 0, 0, 0, 0},  /* BAYER8_BGGR */
};

/* Apart from the rest, so that only programs that print names carry them. */
static const char names[PEL_FORMAT_COUNT][12] = {
    "GRAY8",  "YUYV",        "UYVY",        "YVYU",        "VYUY",
    "NV12",   "I420",        "RGB565_LE",   "RGB565_BE",   "RGB888",
    "BGR888", "BAYER8_RGGB", "BAYER8_GRBG", "BAYER8_GBRG", "BAYER8_BGGR"};

/* Gray has this U and V everywhere. */
static const uint8_t neutral_chroma = 128;

const char *pel_format_name(pel_format format)
{
    return (unsigned)format < PEL_FORMAT_COUNT ? names[(unsigned)format] : NULL;
}

/* ---- Sizes --------------------------------------------------------------------------------- */

/* Groups are of 1 or 2. */
static int side_fits(uint16_t side, unsigned group)
{
    return (side & (group - 1)) == 0;
}

static uint32_t row_bytes(const pel_format_info *info, uint16_t width)
{
    return (uint32_t)width * info->pair_bytes / 2;
}

uint32_t pel_row_bytes(pel_format format, uint16_t width)
{
    const pel_format_info *info = pel_i_format(format);
    return info && width <= PEL_SIDE_MAX && side_fits(width, info->x_group) ? row_bytes(info, width)
                                                                            : 0;
}

uint32_t pel_frame_bytes(pel_format format, uint16_t width, uint16_t height)
{
    const pel_format_info *info = pel_i_format(format);
    uint32_t luma;

    if (!info || pel_row_bytes(format, width) == 0 || height > PEL_SIDE_MAX ||
        !side_fits(height, info->y_group)) {
        return 0;
    }
    luma = row_bytes(info, width) * height;
    return info->planes > 1 ? luma + luma / 2 : luma;
}

uint16_t pel_color_width(pel_format format, uint16_t width)
{
    const pel_format_info *info = pel_i_format(format);
    return info && info->layout == PEL_LAYOUT_BAYER ? (uint16_t)(width / 2) : width;
}

uint16_t pel_color_height(pel_format format, uint16_t height)
{
    return pel_color_width(format, height); /* a Bayer cell is as high as it is wide */
}

static pel_status check_size(const pel_format_info *info, uint16_t width, uint16_t height)
{
    if (width == 0 || height == 0 || width > PEL_SIDE_MAX || height > PEL_SIDE_MAX) {
        return PEL_ERR_RANGE;
    }
    return side_fits(width, info->x_group) && side_fits(height, info->y_group) ? PEL_OK
                                                                               : PEL_ERR_FORMAT;
}

/* ---- Views --------------------------------------------------------------------------------- */

/* Bytes of a row in chroma plane p: a whole row of U V pairs, or half a row of one of them. */
static uint32_t plane_row_bytes(const pel_format_info *info, unsigned plane, uint16_t width)
{
    return plane > 0 && info->planes == 3 ? (uint32_t)width / 2 : row_bytes(info, width);
}

/* Whether rows of `bytes` fit the stride, and whether the distance from the first row to behind the
 * last fits 32 bits. */
static int stride_fits(int32_t stride_bytes, uint32_t bytes, uint16_t rows)
{
    const uint32_t reach = stride_bytes < 0 ? 0u - (uint32_t)stride_bytes : (uint32_t)stride_bytes;
    return reach >= bytes && (uint64_t)reach * rows <= INT32_MAX;
}

static pel_status check_stride(const pel_format_info *info, int32_t stride_bytes, uint16_t width,
                               uint16_t height)
{
    const int upside_down = stride_bytes < 0;
    return stride_fits(stride_bytes, row_bytes(info, width), height) &&
                   !(upside_down && info->planes > 1)
               ? PEL_OK
               : PEL_ERR_RANGE;
}

pel_status pel_cview_init(const uint8_t *pixels, pel_format format, pel_range range, uint16_t width,
                          uint16_t height, int32_t stride_bytes, pel_cview *view)
{
    const pel_format_info *info = pel_i_format(format);
    const pel_cview described = {{pixels, NULL, NULL}, {0, 0, 0}, width, height, format, range};
    pel_status status;

    if (!pixels || !view || !info || (unsigned)range > PEL_RANGE_LIMITED) {
        return PEL_ERR_ARG;
    }
    status = check_size(info, width, height);
    if (status == PEL_OK && stride_bytes == 0) {
        stride_bytes = (int32_t)row_bytes(info, width);
    }
    if (status == PEL_OK) {
        status = check_stride(info, stride_bytes, width, height);
    }
    if (status != PEL_OK) {
        return status;
    }
    *view = described;
    view->stride_bytes[0] = stride_bytes;
    for (unsigned p = 1; p < info->planes; p++) {
        const ptrdiff_t rows_above = p == 1 ? height : height / 2;
        view->plane[p] = view->plane[p - 1] + rows_above * view->stride_bytes[p - 1];
        view->stride_bytes[p] = info->planes == 3 ? stride_bytes / 2 : stride_bytes;
    }
    return PEL_OK;
}

pel_status pel_view_init(uint8_t *pixels, pel_format format, pel_range range, uint16_t width,
                         uint16_t height, int32_t stride_bytes, pel_view *view)
{
    pel_cview described;
    const pel_status status =
        view ? pel_cview_init(pixels, format, range, width, height, stride_bytes, &described)
             : PEL_ERR_ARG;

    if (status != PEL_OK) {
        return status;
    }
    for (unsigned p = 0; p < 3; p++) {
        view->plane[p] = described.plane[p] ? pixels + (described.plane[p] - pixels) : NULL;
        view->stride_bytes[p] = described.stride_bytes[p];
    }
    view->width = width;
    view->height = height;
    view->format = format;
    view->range = range;
    return PEL_OK;
}

pel_cview pel_view_to_read(const pel_view *view)
{
    pel_cview out = {{NULL, NULL, NULL}, {0, 0, 0}, 0, 0, PEL_GRAY8, PEL_RANGE_FULL};

    if (!view) {
        return out;
    }
    for (unsigned p = 0; p < 3; p++) {
        out.plane[p] = view->plane[p];
        out.stride_bytes[p] = view->stride_bytes[p];
    }
    out.width = view->width;
    out.height = view->height;
    out.format = view->format;
    out.range = view->range;
    return out;
}

pel_status pel_cview_check(const pel_cview *view)
{
    const pel_format_info *info = view ? pel_i_format(view->format) : NULL;
    pel_status status;

    if (!info || (unsigned)view->range > PEL_RANGE_LIMITED) {
        return PEL_ERR_ARG;
    }
    status = check_size(info, view->width, view->height);
    for (unsigned p = 0; p < info->planes && status == PEL_OK; p++) {
        if (!view->plane[p]) {
            status = PEL_ERR_ARG;
        } else if (!stride_fits(view->stride_bytes[p], plane_row_bytes(info, p, view->width),
                                p == 0 ? view->height : view->height / 2)) {
            status = PEL_ERR_RANGE;
        }
    }
    return status;
}

static pel_status check_crop(const pel_cview *view, uint16_t x0, uint16_t x1, uint16_t y0,
                             uint16_t y1)
{
    const pel_format_info *info;
    const pel_status status = pel_cview_check(view);

    if (status != PEL_OK) {
        return status;
    }
    if (x0 >= x1 || y0 >= y1 || x1 > view->width || y1 > view->height) {
        return PEL_ERR_RANGE;
    }
    info = pel_i_format(view->format);
    return side_fits(x0, info->x_group) && side_fits(x1, info->x_group) &&
                   side_fits(y0, info->y_group) && side_fits(y1, info->y_group)
               ? PEL_OK
               : PEL_ERR_FORMAT;
}

pel_status pel_cview_crop(const pel_cview *view, uint16_t x0, uint16_t x1, uint16_t y0, uint16_t y1,
                          pel_cview *part)
{
    const pel_status status = part ? check_crop(view, x0, x1, y0, y1) : PEL_ERR_ARG;
    const pel_format_info *info;

    if (status != PEL_OK) {
        return status;
    }
    *part = *view;
    info = pel_i_format(part->format);
    for (unsigned p = 0; p < info->planes; p++) {
        const ptrdiff_t rows = p == 0 ? y0 : y0 / 2;
        part->plane[p] += rows * part->stride_bytes[p];
        part->plane[p] += plane_row_bytes(info, p, x0);
    }
    part->width = (uint16_t)(x1 - x0);
    part->height = (uint16_t)(y1 - y0);
    return PEL_OK;
}

pel_status pel_view_crop(const pel_view *view, uint16_t x0, uint16_t x1, uint16_t y0, uint16_t y1,
                         pel_view *part)
{
    pel_cview whole, cut;
    pel_status status = PEL_ERR_ARG;

    if (view && part) {
        whole = pel_view_to_read(view);
        status = pel_cview_crop(&whole, x0, x1, y0, y1, &cut);
    }
    if (status != PEL_OK) {
        return status;
    }
    *part = *view;
    for (unsigned p = 0; p < pel_i_format(view->format)->planes; p++) {
        part->plane[p] += cut.plane[p] - whole.plane[p];
    }
    part->width = cut.width;
    part->height = cut.height;
    return PEL_OK;
}

/* ---- Rows ---------------------------------------------------------------------------------- */

pel_crow pel_cview_row(const pel_cview *view, uint16_t y)
{
    const pel_format_info *info = pel_i_format(view->format);
    pel_crow row = {{NULL, NULL, NULL}, view->width, view->format, view->range};

    if (info->layout == PEL_LAYOUT_BAYER) {
        row.plane[0] = view->plane[0] + (ptrdiff_t)view->stride_bytes[0] * 2 * y;
        row.plane[1] = row.plane[0] + view->stride_bytes[0];
        return row;
    }
    row.plane[0] = view->plane[0] + (ptrdiff_t)view->stride_bytes[0] * y;
    for (unsigned p = 1; p < info->planes; p++) {
        row.plane[p] = view->plane[p] + (ptrdiff_t)view->stride_bytes[p] * (y / 2);
    }
    return row;
}

pel_crow pel_crow_packed(const uint8_t *pixels, pel_format format, pel_range range, uint16_t width)
{
    const pel_crow row = {{pixels, NULL, NULL}, width, format, range};
    return row;
}

/* How many pointers a row of the format has: a Bayer row is a pair of rows of the mosaic. */
static unsigned row_planes(const pel_format_info *info)
{
    return info->layout == PEL_LAYOUT_BAYER ? 2 : info->planes;
}

pel_status pel_crow_check(const pel_crow *row)
{
    const pel_format_info *info = row ? pel_i_format(row->format) : NULL;

    if (!info || (unsigned)row->range > PEL_RANGE_LIMITED) {
        return PEL_ERR_ARG;
    }
    for (unsigned p = 0; p < row_planes(info); p++) {
        if (!row->plane[p]) {
            return PEL_ERR_ARG;
        }
    }
    return check_size(info, row->width, info->y_group);
}

pel_row_pairs pel_i_pairs(const pel_format_info *info, const pel_crow *row)
{
    pel_row_pairs pairs;

    pairs.y = row->plane[0] + info->y_offset;
    pairs.y_step = info->y_step;
    pairs.c_step = info->c_step;
    if (pairs.c_step == 0) {
        pairs.u = &neutral_chroma;
        pairs.v = &neutral_chroma;
    } else {
        pairs.u = row->plane[info->u_plane] + info->u_offset;
        pairs.v = row->plane[info->v_plane] + info->v_offset;
    }
    return pairs;
}

int pel_i_crow_overlaps(const pel_crow *row, const void *memory, size_t bytes)
{
    const pel_format_info *info = pel_i_format(row->format);
    const unsigned planes = row_planes(info);
    int found = 0;

    for (unsigned p = 0; p < planes; p++) {
        const unsigned like = info->planes == 1 ? 0 : p; /* both rows of a Bayer pair are alike */
        found |=
            pel_i_overlap(row->plane[p], plane_row_bytes(info, like, row->width), memory, bytes);
    }
    return found;
}

int pel_i_view_overlaps(const pel_cview *view, const void *memory, size_t bytes)
{
    const pel_format_info *info = pel_i_format(view->format);
    int found = 0;

    for (unsigned p = 0; p < info->planes; p++) {
        const ptrdiff_t rows = p == 0 ? view->height : view->height / 2;
        const ptrdiff_t reach = (rows - 1) * view->stride_bytes[p];
        const uint8_t *const lowest = view->plane[p] + (reach < 0 ? reach : 0);
        const size_t size =
            (size_t)(reach < 0 ? -reach : reach) + plane_row_bytes(info, p, view->width);
        found |= pel_i_overlap(lowest, size, memory, bytes);
    }
    return found;
}
