/* Rows with rows, integral rows, white balance. */
#include "pel/point.h"

#include "frames.h"
#include "point_wide.h"
#include "row/row_point_select.h"

/* ---- Two rows ------------------------------------------------------------------------------ */

static void combine(pel_backend backend, pel_combine_op op, const uint8_t *a, const uint8_t *b,
                    uint16_t count, uint8_t *dst)
{
    switch (op) {
    case PEL_COMBINE_ADD:
        pel_i_row_add(backend, a, b, count, dst);
        break;
    case PEL_COMBINE_SUBTRACT:
        pel_i_row_subtract(backend, a, b, count, dst);
        break;
    case PEL_COMBINE_ABSDIFF:
        pel_i_row_absdiff(backend, a, b, count, dst);
        break;
    case PEL_COMBINE_MIN:
        pel_i_row_min(backend, a, b, count, dst);
        break;
    case PEL_COMBINE_MAX:
        pel_i_row_max(backend, a, b, count, dst);
        break;
    case PEL_COMBINE_AND:
        pel_i_row_and(backend, a, b, count, dst);
        break;
    case PEL_COMBINE_OR:
        pel_i_row_or(backend, a, b, count, dst);
        break;
    case PEL_COMBINE_XOR:
        pel_i_row_xor(backend, a, b, count, dst);
        break;
    case PEL_COMBINE_OP_COUNT:
        break;
    }
}

static int is_op(pel_combine_op op)
{
    return (unsigned)op < PEL_COMBINE_OP_COUNT;
}

pel_status pel_combine_row(pel_combine_op op, const uint8_t *a, const uint8_t *b, uint16_t count,
                           uint8_t *dst)
{
    if (!is_op(op) || !a || !b || !dst) {
        return PEL_ERR_ARG;
    }
    combine(pel_i_row_backend(PEL_BACKEND_AUTO), op, a, b, count, dst);
    return PEL_OK;
}

static pel_status check_three(const pel_cview *a, const pel_cview *b, const pel_view *dst)
{
    const pel_status status = pel_i_check_pair(a, dst);
    return status != PEL_OK ? status : pel_i_check_pair(b, dst);
}

pel_status pel_combine_frame_with(pel_combine_op op, const pel_cview *a, const pel_cview *b,
                                  const pel_view *dst, pel_backend backend)
{
    const pel_status status = is_op(op) ? check_three(a, b, dst) : PEL_ERR_ARG;
    uint16_t count;

    if (status != PEL_OK) {
        return status;
    }
    backend = pel_i_row_backend(backend);
    count = (uint16_t)pel_row_bytes(dst->format, dst->width);
    for (uint16_t y = 0; y < dst->height; y++) {
        combine(backend, op, pel_i_row(a, y), pel_i_row(b, y), count, pel_i_row_to_write(dst, y));
    }
    return PEL_OK;
}

pel_status pel_combine_frame(pel_combine_op op, const pel_cview *a, const pel_cview *b,
                             const pel_view *dst)
{
    return pel_combine_frame_with(op, a, b, dst, PEL_BACKEND_AUTO);
}

pel_status pel_blend_row(uint16_t alpha_q8, const uint8_t *a, const uint8_t *b, uint16_t count,
                         uint8_t *dst)
{
    if (alpha_q8 > 256 || !a || !b || !dst) {
        return PEL_ERR_ARG;
    }
    pel_i_row_blend(pel_i_row_backend(PEL_BACKEND_AUTO), a, b, alpha_q8, count, dst);
    return PEL_OK;
}

pel_status pel_blend_frame_with(uint16_t alpha_q8, const pel_cview *a, const pel_cview *b,
                                const pel_view *dst, pel_backend backend)
{
    const pel_status status = alpha_q8 <= 256 ? check_three(a, b, dst) : PEL_ERR_ARG;
    uint16_t count;

    if (status != PEL_OK) {
        return status;
    }
    backend = pel_i_row_backend(backend);
    count = (uint16_t)pel_row_bytes(dst->format, dst->width);
    for (uint16_t y = 0; y < dst->height; y++) {
        pel_i_row_blend(backend, pel_i_row(a, y), pel_i_row(b, y), alpha_q8, count,
                        pel_i_row_to_write(dst, y));
    }
    return PEL_OK;
}

pel_status pel_blend_frame(uint16_t alpha_q8, const pel_cview *a, const pel_cview *b,
                           const pel_view *dst)
{
    return pel_blend_frame_with(alpha_q8, a, b, dst, PEL_BACKEND_AUTO);
}

/* ---- Integral rows ------------------------------------------------------------------------- */

pel_status pel_integral_row(const uint8_t *src, uint16_t width, const uint32_t *above,
                            uint32_t *sums)
{
    if (!sums || (above && !src)) {
        return PEL_ERR_ARG;
    }
    if (width == 0 || width > PEL_SIDE_MAX) {
        return PEL_ERR_RANGE;
    }
    sums[0] = 0;
    if (above) {
        pel_i_row_integral(pel_i_row_backend(PEL_BACKEND_AUTO), src, width, above + 1, sums + 1);
        return PEL_OK;
    }
    for (uint16_t x = 1; x <= width; x++) {
        sums[x] = 0;
    }
    return PEL_OK;
}

pel_status pel_integral_frame_with(const pel_cview *src, uint32_t *sums, uint32_t stride,
                                   pel_backend backend)
{
    const pel_status status = sums ? pel_i_check_bytes(src, 1) : PEL_ERR_ARG;
    const uint32_t *above = sums;

    if (status != PEL_OK) {
        return status;
    }
    if ((uint32_t)src->width * src->height > PEL_INTEGRAL_PIXELS_MAX) {
        return PEL_ERR_RANGE;
    }
    if (stride < (uint32_t)src->width + 1) {
        return PEL_ERR_SPACE;
    }
    backend = pel_i_row_backend(backend);
    (void)pel_integral_row(NULL, src->width, NULL, sums);
    for (uint16_t y = 0; y < src->height; y++) {
        sums += stride;
        sums[0] = 0;
        pel_i_row_integral(backend, pel_i_row(src, y), src->width, above + 1, sums + 1);
        above = sums;
    }
    return PEL_OK;
}

pel_status pel_integral_frame(const pel_cview *src, uint32_t *sums, uint32_t stride)
{
    return pel_integral_frame_with(src, sums, stride, PEL_BACKEND_AUTO);
}

uint32_t pel_integral_box(const uint32_t *top, const uint32_t *bottom, uint16_t x0, uint16_t x1)
{
    return bottom[x1] - bottom[x0] - top[x1] + top[x0];
}

/* ---- White balance ------------------------------------------------------------------------- */

static int is_blue_first(pel_format format)
{
    return format == PEL_BGR888;
}

pel_status pel_rgb_sums_row(const uint8_t *rgb, uint16_t width, pel_rgb_sums *sums)
{
    const uint32_t count_max = (uint32_t)PEL_SIDE_MAX * PEL_SIDE_MAX;
    uint32_t row[3] = {0, 0, 0};

    if (!rgb || !sums) {
        return PEL_ERR_ARG;
    }
    if (sums->count > count_max - width) {
        return PEL_ERR_RANGE;
    }
    pel_row_sum3(rgb, width, row);
    for (unsigned c = 0; c < 3; c++) {
        sums->sum[c] += row[c];
    }
    sums->count += width;
    return PEL_OK;
}

pel_status pel_rgb_sums_frame(const pel_cview *src, pel_rgb_sums *sums)
{
    const pel_status status = sums ? pel_i_check_bytes(src, 3) : PEL_ERR_ARG;
    const pel_rgb_sums none = {{0, 0, 0}, 0};

    if (status != PEL_OK) {
        return status;
    }
    *sums = none;
    for (uint16_t y = 0; y < src->height; y++) {
        (void)pel_rgb_sums_row(pel_i_row(src, y), src->width, sums);
    }
    if (is_blue_first(src->format)) {
        const uint64_t blue = sums->sum[0];
        sums->sum[0] = sums->sum[2];
        sums->sum[2] = blue;
    }
    return PEL_OK;
}

/* gain[c] = round(256 * target / (times * sum[c])); target <= 3 * 2^34. */
static pel_status set_gains(const pel_rgb_sums *sums, uint64_t target, unsigned times,
                            uint16_t gains_q8[3])
{
    uint16_t gains[3];

    for (unsigned c = 0; c < 3; c++) {
        const uint64_t part = times * sums->sum[c];
        const uint64_t whole = 256 * target + part / 2;
        if (part == 0 || (whole >> 16) >= part) {
            return PEL_ERR_RANGE;
        }
        gains[c] = (uint16_t)pel_i_divide(whole, part);
    }
    for (unsigned c = 0; c < 3; c++) {
        gains_q8[c] = gains[c];
    }
    return PEL_OK;
}

pel_status pel_gains_gray_patch(const pel_rgb_sums *sums, uint16_t gains_q8[3])
{
    return sums && gains_q8 ? set_gains(sums, sums->sum[1], 1, gains_q8) : PEL_ERR_ARG;
}

pel_status pel_gains_gray_world(const pel_rgb_sums *sums, uint16_t gains_q8[3])
{
    if (!sums || !gains_q8) {
        return PEL_ERR_ARG;
    }
    return set_gains(sums, sums->sum[0] + sums->sum[1] + sums->sum[2], 3, gains_q8);
}

pel_status pel_white_balance_row(const uint16_t gains_q8[3], const uint8_t *rgb, uint16_t width,
                                 uint8_t *dst)
{
    if (!gains_q8 || !rgb || !dst) {
        return PEL_ERR_ARG;
    }
    pel_i_row_gain3(pel_i_row_backend(PEL_BACKEND_AUTO), rgb, width, gains_q8, dst);
    return PEL_OK;
}

pel_status pel_white_balance_frame_with(const uint16_t gains_q8[3], const pel_cview *src,
                                        const pel_view *dst, pel_backend backend)
{
    pel_status status = gains_q8 ? pel_i_check_bytes(src, 3) : PEL_ERR_ARG;
    uint16_t in_order[3];

    if (status == PEL_OK) {
        status = pel_i_check_pair(src, dst);
    }
    if (status != PEL_OK) {
        return status;
    }
    for (unsigned c = 0; c < 3; c++) {
        in_order[c] = gains_q8[is_blue_first(src->format) ? 2 - c : c];
    }
    backend = pel_i_row_backend(backend);
    for (uint16_t y = 0; y < src->height; y++) {
        pel_i_row_gain3(backend, pel_i_row(src, y), src->width, in_order,
                        pel_i_row_to_write(dst, y));
    }
    return PEL_OK;
}

pel_status pel_white_balance_frame(const uint16_t gains_q8[3], const pel_cview *src,
                                   const pel_view *dst)
{
    return pel_white_balance_frame_with(gains_q8, src, dst, PEL_BACKEND_AUTO);
}
