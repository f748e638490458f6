#include "frames.h"

unsigned pel_i_channels(pel_format format)
{
    return format == PEL_GRAY8 ? 1 : format == PEL_RGB888 || format == PEL_BGR888 ? 3 : 0;
}

pel_status pel_i_check_bytes(const pel_cview *view, unsigned channels)
{
    const pel_status status = pel_cview_check(view);
    unsigned found;

    if (status != PEL_OK) {
        return status;
    }
    found = pel_i_channels(view->format);
    return found != 0 && (channels == 0 || channels == found) ? PEL_OK : PEL_ERR_FORMAT;
}

/* Bytes from one row to the next, whichever way. */
static uintptr_t row_distance(const pel_cview *view)
{
    const uint32_t stride = (uint32_t)view->stride_bytes[0];
    return view->stride_bytes[0] < 0 ? 0u - stride : stride;
}

/* The lowest address of a view and the number of bytes to its highest one. */
static uintptr_t lowest(const pel_cview *view, uintptr_t *bytes)
{
    const uintptr_t reach = row_distance(view) * (view->height - 1u);

    *bytes = reach + pel_row_bytes(view->format, view->width);
    return (uintptr_t)view->plane[0] - (view->stride_bytes[0] < 0 ? reach : 0);
}

/* With rows equally far apart, two parts of one picture may lie side by side: their rows come in
 * turns. */
static int in_turns(const pel_cview *a, const pel_cview *b, uintptr_t distance)
{
    const uintptr_t gap = distance % row_distance(a);

    return row_distance(a) == row_distance(b) && gap >= pel_row_bytes(a->format, a->width) &&
           row_distance(a) - gap >= pel_row_bytes(b->format, b->width);
}

static int overlap(const pel_cview *a, const pel_cview *b)
{
    uintptr_t a_bytes, b_bytes;
    const uintptr_t a_begin = lowest(a, &a_bytes);
    const uintptr_t b_begin = lowest(b, &b_bytes);

    if (a_begin <= b_begin) {
        return b_begin - a_begin < a_bytes && !in_turns(a, b, b_begin - a_begin);
    }
    return a_begin - b_begin < b_bytes && !in_turns(b, a, a_begin - b_begin);
}

static pel_status check_formats(const pel_cview *src, const pel_view *dst, pel_cview *written)
{
    pel_status status = dst ? pel_i_check_bytes(src, 0) : PEL_ERR_ARG;

    if (status == PEL_OK) {
        *written = pel_view_to_read(dst);
        status = pel_i_check_bytes(written, 0);
    }
    return status != PEL_OK ? status : src->format == dst->format ? PEL_OK : PEL_ERR_FORMAT;
}

pel_status pel_i_check_places(const pel_cview *src, const pel_cview *dst)
{
    const int same = src->plane[0] == dst->plane[0] && src->stride_bytes[0] == dst->stride_bytes[0];
    return same || !overlap(src, dst) ? PEL_OK : PEL_ERR_ARG;
}

pel_status pel_i_check_apart(const pel_cview *src, const pel_view *dst)
{
    pel_cview written;
    const pel_status status = check_formats(src, dst, &written);

    return status != PEL_OK ? status : overlap(src, &written) ? PEL_ERR_ARG : PEL_OK;
}

pel_status pel_i_check_pair(const pel_cview *src, const pel_view *dst)
{
    pel_cview written;
    const pel_status status = check_formats(src, dst, &written);

    if (status != PEL_OK) {
        return status;
    }
    if (src->width != dst->width || src->height != dst->height) {
        return PEL_ERR_SPACE;
    }
    return pel_i_check_places(src, &written);
}

pel_status pel_i_check_gray_pair(const pel_cview *src, const pel_view *dst)
{
    pel_cview written;
    const pel_status status = check_formats(src, dst, &written);

    if (status != PEL_OK) {
        return status;
    }
    return src->format == PEL_GRAY8 ? pel_i_check_places(src, &written) : PEL_ERR_FORMAT;
}

const uint8_t *pel_i_row(const pel_cview *view, uint16_t y)
{
    return view->plane[0] + (ptrdiff_t)view->stride_bytes[0] * y;
}

uint8_t *pel_i_row_to_write(const pel_view *view, uint16_t y)
{
    return view->plane[0] + (ptrdiff_t)view->stride_bytes[0] * y;
}
