/* Filters on whole frames: loops over push and pull, or what has the same results. */
#include "pel/filter.h"

#include "filter_direct.h"
#include "filter_radius.h"
#include "format.h"
#include "frames.h"

/* Begins with what the picture says. The config of the filter takes it in place: a second one would
 * weigh on the stack. */
static pel_status begin_frame(pel_filter *filter, const pel_filter_config *config,
                              pel_filter_op *op, pel_filter_op_s16 *op_s16, const pel_cview *src)
{
    pel_filter_config *const c = &filter->config;
    int r;

    *c = *config;
    c->op = op;
    c->op_s16 = op_s16;
    c->width = src->width;
    c->height = src->height;
    r = (int)pel_i_filter_radius(c);
    for (int i = 0; i < 2; i++) {
        const int32_t y = pel_border_index(i < r ? i - r : -1, src->height, PEL_BORDER_WRAP);
        c->last_rows[i] = pel_i_row(src, (uint16_t)y);
    }
    return pel_filter_begin(filter, c);
}

static int fits(const pel_filter *filter, const pel_view *dst)
{
    return dst->width == pel_filter_width(&filter->config) &&
           dst->height == pel_filter_height(&filter->config);
}

/* All rows of a filter that has begun. */
static void run(pel_filter *filter, const pel_cview *src, const pel_view *dst)
{
    const pel_filter_target target = {dst->plane[0], NULL, dst->stride_bytes[0]};

    if (src->plane[0] != dst->plane[0] && pel_i_filter_direct(filter, src, &target)) {
        return;
    }
    for (uint16_t y = 0; y < src->height; y++) {
        pel_status status = pel_filter_push(filter, pel_i_row(src, y));
        while (filter->row < dst->height && status == PEL_OK) {
            status = pel_filter_pull(filter, pel_i_row_to_write(dst, filter->row));
        }
    }
}

pel_status pel_filter_frame(const pel_filter_config *config, const pel_cview *src,
                            const pel_view *dst)
{
    pel_status status = config ? pel_i_check_gray_pair(src, dst) : PEL_ERR_ARG;
    pel_filter filter;

    if (status == PEL_OK) {
        status = begin_frame(&filter, config, config->op, config->op_s16, src);
    }
    if (status != PEL_OK) {
        return status;
    }
    if (config->op_s16 && !config->op) {
        return PEL_ERR_FORMAT;
    }
    if (!fits(&filter, dst)) {
        return PEL_ERR_SPACE;
    }
    run(&filter, src, dst);
    return PEL_OK;
}

/* Whether rows of 16-bit results fit their stride and lie apart from the picture. */
static pel_status check_words(const pel_cview *src, const int16_t *dst, int32_t stride,
                              uint16_t width, uint16_t height)
{
    const uint32_t step = stride < 0 ? 0u - (uint32_t)stride : (uint32_t)stride;
    const uint64_t reach = (uint64_t)step * 2 * (height - 1u);

    if (step < width || reach + 2u * width > INT32_MAX) {
        return PEL_ERR_RANGE;
    }
    return pel_i_view_overlaps(src, stride < 0 ? dst + (ptrdiff_t)stride * (height - 1) : dst,
                               (size_t)reach + 2u * width)
               ? PEL_ERR_ARG
               : PEL_OK;
}

static int direct_words(const pel_filter *filter, const pel_cview *src, int16_t *dst,
                        int32_t stride)
{
    const pel_filter_target target = {NULL, dst, stride};
    return pel_i_filter_direct(filter, src, &target);
}

pel_status pel_filter_frame_s16(const pel_filter_config *config, const pel_cview *src, int16_t *dst,
                                int32_t stride)
{
    pel_status status = config && dst ? pel_i_check_bytes(src, 1) : PEL_ERR_ARG;
    pel_filter filter;
    uint16_t height;

    if (status == PEL_OK) {
        status = begin_frame(&filter, config, config->op, config->op_s16, src);
    }
    if (status != PEL_OK) {
        return status;
    }
    if (config->op && !config->op_s16) {
        return PEL_ERR_FORMAT;
    }
    height = pel_filter_height(&filter.config);
    status = check_words(src, dst, stride, pel_filter_width(&filter.config), height);
    if (status == PEL_OK && direct_words(&filter, src, dst, stride)) {
        return PEL_OK;
    }
    for (uint16_t y = 0; y < src->height && status == PEL_OK; y++) {
        (void)pel_filter_push(&filter, pel_i_row(src, y));
        while (filter.row < height && status == PEL_OK) {
            status = pel_filter_pull_s16(&filter, dst + (ptrdiff_t)stride * filter.row);
        }
        status = status == PEL_ERR_ORDER ? PEL_OK : status; /* not ready: the next row first */
    }
    return status;
}

/* One of the two; without dst it is only checked. */
static pel_status one_of_two(const pel_filter_config *config, pel_filter_op *op,
                             const pel_cview *src, const pel_view *dst)
{
    pel_filter filter;
    const pel_status status = begin_frame(&filter, config, op, NULL, src);

    if (status == PEL_OK && dst) {
        run(&filter, src, dst);
    }
    return status;
}

pel_status pel_filter_twice(const pel_filter_config *config, pel_filter_op *first,
                            pel_filter_op *second, const pel_cview *src, const pel_view *dst)
{
    pel_status status = config ? pel_i_check_gray_pair(src, dst) : PEL_ERR_ARG;

    if (status == PEL_OK && config->border == PEL_BORDER_VALID) {
        status = PEL_ERR_ARG;
    }
    if (status == PEL_OK) { /* now, so that nothing is refused halfway */
        status = one_of_two(config, second, src, NULL);
    }
    if (status == PEL_OK && (dst->width != src->width || dst->height != src->height)) {
        status = PEL_ERR_SPACE;
    }
    if (status == PEL_OK) {
        status = one_of_two(config, first, src, dst);
    }
    if (status == PEL_OK) {
        const pel_cview between = pel_view_to_read(dst);
        status = one_of_two(config, second, &between, dst);
    }
    return status;
}
