/* Filters on whole frames: loops over push and pull. */
#include "pel/filter.h"

#include "format.h"
#include "frames.h"

/* The filter takes what the picture says into its config, in place: a second config would weigh on
 * the stack. */
static void set_picture(pel_filter *filter, const pel_filter_config *config, const pel_cview *src)
{
    pel_filter_config *const c = &filter->config;

    *c = *config;
    c->width = src->width;
    c->height = src->height;
    for (int i = 0; i < 2; i++) {
        const int r = c->op == PEL_FILTER_KERNEL && c->kernel && c->kernel->radius == 2 ? 2 : 1;
        const int32_t y = pel_border_index(i < r ? i - r : -1, src->height, PEL_BORDER_WRAP);
        c->last_rows[i] = pel_i_row(src, (uint16_t)y);
    }
}

/* Pulls all rows that are ready into their places. */
static void pull_into(pel_filter *filter, const pel_view *dst)
{
    pel_status status = PEL_OK;

    while (filter->row < dst->height && status == PEL_OK) {
        status = pel_filter_pull(filter, pel_i_row_to_write(dst, filter->row));
    }
}

pel_status pel_filter_frame(const pel_filter_config *config, const pel_cview *src,
                            const pel_view *dst)
{
    pel_status status = config ? pel_i_check_gray_pair(src, dst) : PEL_ERR_ARG;
    pel_filter filter;

    if (status != PEL_OK) {
        return status;
    }
    set_picture(&filter, config, src);
    status = pel_filter_begin(&filter, &filter.config);
    if (status != PEL_OK) {
        return status;
    }
    if (dst->width != pel_filter_width(&filter.config) ||
        dst->height != pel_filter_height(&filter.config)) {
        return PEL_ERR_SPACE;
    }
    for (uint16_t y = 0; y < src->height; y++) {
        (void)pel_filter_push(&filter, pel_i_row(src, y));
        pull_into(&filter, dst);
    }
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

pel_status pel_filter_frame_s16(const pel_filter_config *config, const pel_cview *src, int16_t *dst,
                                int32_t stride)
{
    pel_status status = config && dst ? pel_i_check_bytes(src, 1) : PEL_ERR_ARG;
    pel_filter filter;
    uint16_t height;

    if (status != PEL_OK) {
        return status;
    }
    set_picture(&filter, config, src);
    status = pel_filter_begin(&filter, &filter.config);
    if (status != PEL_OK) {
        return status;
    }
    height = pel_filter_height(&filter.config);
    status = check_words(src, dst, stride, pel_filter_width(&filter.config), height);
    for (uint16_t y = 0; y < src->height && status == PEL_OK; y++) {
        (void)pel_filter_push(&filter, pel_i_row(src, y));
        while (filter.row < height && status == PEL_OK) {
            status = pel_filter_pull_s16(&filter, dst + (ptrdiff_t)stride * filter.row);
        }
        status = status == PEL_ERR_ORDER ? PEL_OK : status; /* not ready: the next row first */
    }
    return status;
}

static pel_status check_twice(const pel_filter_config *config, pel_filter_op first,
                              pel_filter_op second, const pel_cview *src, const pel_view *dst)
{
    if (first == PEL_FILTER_KERNEL || second == PEL_FILTER_KERNEL ||
        config->border == PEL_BORDER_VALID || config->border == PEL_BORDER_WRAP || !config->work) {
        return PEL_ERR_ARG;
    }
    return dst->width != src->width || dst->height != src->height ||
                   config->work_bytes < PEL_FILTER_TWICE_BYTES(src->width)
               ? PEL_ERR_SPACE
               : PEL_OK;
}

/* Begins a filter of the pair in its share of the working memory, `place` bytes from the start. */
static pel_status begin_one(pel_filter *filter, const pel_filter_config *config, pel_filter_op op,
                            const pel_cview *src, size_t place)
{
    set_picture(filter, config, src);
    filter->config.op = op;
    filter->config.work = (uint8_t *)config->work + place;
    filter->config.work_bytes = PEL_FILTER_BYTES(src->width, 1);
    return pel_filter_begin(filter, &filter->config);
}

pel_status pel_filter_twice(const pel_filter_config *config, pel_filter_op first,
                            pel_filter_op second, const pel_cview *src, const pel_view *dst)
{
    pel_status status = config ? pel_i_check_gray_pair(src, dst) : PEL_ERR_ARG;
    pel_filter filters[2];
    uint8_t *between;

    if (status == PEL_OK) {
        status = check_twice(config, first, second, src, dst);
    }
    if (status != PEL_OK) {
        return status;
    }
    between = (uint8_t *)config->work + 2 * PEL_FILTER_BYTES(src->width, 1);
    status = begin_one(&filters[0], config, first, src, 0);
    if (status == PEL_OK) {
        status = begin_one(&filters[1], config, second, src, PEL_FILTER_BYTES(src->width, 1));
    }
    for (uint16_t y = 0; y < src->height && status == PEL_OK; y++) {
        (void)pel_filter_push(&filters[0], pel_i_row(src, y));
        while (pel_filter_pull(&filters[0], between) == PEL_OK) {
            (void)pel_filter_push(&filters[1], between);
            pull_into(&filters[1], dst);
        }
    }
    return status;
}
