#include "pel/color.h"

#include "overlap.h"
#include "row/row_color_select.h"

/* Rows of three bytes a pixel: the same one, or two that do not overlap. */
static int places_ok(const uint8_t *src, const uint8_t *dst, uint16_t width)
{
    const size_t bytes = 3 * (size_t)width;
    return src && dst && (src == dst || !pel_i_overlap(src, bytes, dst, bytes));
}

pel_status pel_rgb_to_ycbcr_row(const uint8_t *rgb, uint8_t *ycbcr, uint16_t width, pel_range range)
{
    if (!places_ok(rgb, ycbcr, width) || (unsigned)range > PEL_RANGE_LIMITED) {
        return PEL_ERR_ARG;
    }
    pel_i_row_rgb_to_ycbcr(pel_i_row_backend(PEL_BACKEND_AUTO), rgb, width,
                           range == PEL_RANGE_LIMITED, ycbcr);
    return PEL_OK;
}

pel_status pel_ycbcr_to_rgb_row(const uint8_t *ycbcr, uint8_t *rgb, uint16_t width, pel_range range)
{
    if (!places_ok(ycbcr, rgb, width) || (unsigned)range > PEL_RANGE_LIMITED) {
        return PEL_ERR_ARG;
    }
    pel_i_row_ycbcr_to_rgb(pel_i_row_backend(PEL_BACKEND_AUTO), ycbcr, width,
                           range == PEL_RANGE_LIMITED, rgb);
    return PEL_OK;
}

pel_status pel_rgb_to_nrgb_row(const uint8_t *rgb, uint8_t *nrgb, uint16_t width, uint16_t sum_min)
{
    if (!places_ok(rgb, nrgb, width)) {
        return PEL_ERR_ARG;
    }
    pel_row_rgb_to_nrgb(rgb, width, sum_min, nrgb);
    return PEL_OK;
}

pel_status pel_rgb_to_hsv_row(const uint8_t *rgb, uint8_t *hsv, uint16_t width)
{
    if (!places_ok(rgb, hsv, width)) {
        return PEL_ERR_ARG;
    }
    pel_row_rgb_to_hsv(rgb, width, hsv);
    return PEL_OK;
}

int pel_hue_within(uint8_t hue, uint8_t from, uint8_t to)
{
    return (uint8_t)(hue - from) <= (uint8_t)(to - from);
}
