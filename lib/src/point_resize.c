/* Resizing: rows in, rows of another size out. */
#include "pel/point.h"

#include "frames.h"
#include "overlap.h"
#include "row/row_point_select.h"

enum { IDLE, RUNNING };

/* Pixels to a mean: sums stay under 65536 * 255 + 32768 < 2^24. */
#define BOX_AREA_MAX ((uint32_t)65536)

static uint8_t channels_of(const pel_resize_config *c)
{
    return c->channels == 0 ? 1 : c->channels;
}

uint32_t pel_resize_bytes(const pel_resize_config *config)
{
    if (!config || config->channels == 2 || config->channels > 3) {
        return 0;
    }
    switch (config->method) {
    case PEL_RESIZE_NEAREST:
        return PEL_RESIZE_NEAREST_BYTES(config->width_in, channels_of(config));
    case PEL_RESIZE_BOX:
        return PEL_RESIZE_BOX_BYTES(config->width_out, channels_of(config));
    case PEL_RESIZE_BILINEAR:
        return PEL_RESIZE_BILINEAR_BYTES(config->width_in, config->width_out, channels_of(config));
    case PEL_RESIZE_METHOD_COUNT:
        break;
    }
    return 0;
}

/* ---- Where a result row or column lies ----------------------------------------------------- */

/* Numbers under 2^13 * 2^14 = 2^27, and 2^14 * 2048 = 2^25 for the weight. */
static pel_row_place place_between(uint16_t i, uint16_t size_in, uint16_t size_out)
{
    const int32_t twice_out = 2 * (int32_t)size_out;
    const int32_t centre = (2 * (int32_t)i + 1) * size_in - size_out; /* in 1 / twice_out */
    pel_row_place place = {0, 0};

    if (centre < 0) {
        return place;
    }
    place.x = (uint16_t)(centre / twice_out);
    if (place.x >= size_in - 1) {
        place.x = (uint16_t)(size_in - 1);
        return place;
    }
    place.weight = (uint16_t)((centre % twice_out * 2048 + size_out) / twice_out);
    return place;
}

/* How many rows must have been pushed before the next one can be pulled. */
static uint16_t rows_needed(const pel_resize *r)
{
    const pel_resize_config *c = &r->config;
    uint16_t first;

    if (c->method == PEL_RESIZE_BOX) {
        return (uint16_t)((r->row + 1u) * (c->height_in / c->height_out));
    }
    if (c->method == PEL_RESIZE_NEAREST) {
        return (uint16_t)((uint32_t)r->row * c->height_in / c->height_out + 1);
    }
    first = place_between(r->row, c->height_in, c->height_out).x;
    return (uint16_t)(first + 2u > c->height_in ? c->height_in : first + 2u);
}

static int is_ready(const pel_resize *r)
{
    return r->row < r->config.height_out && r->pushed >= rows_needed(r);
}

/* ---- The working memory -------------------------------------------------------------------- */

static uint32_t *sums_of(const pel_resize *r)
{
    return (uint32_t *)r->config.work;
}

static pel_row_place *places_of(const pel_resize *r)
{
    return (pel_row_place *)r->config.work;
}

/* Where row y is kept: NEAREST has one place, BILINEAR two behind the columns' places. */
static uint8_t *kept_row(const pel_resize *r, uint16_t y)
{
    const size_t bytes = (size_t)r->config.width_in * channels_of(&r->config);

    if (r->config.method == PEL_RESIZE_NEAREST) {
        return (uint8_t *)r->config.work;
    }
    return (uint8_t *)(places_of(r) + r->config.width_out) + (y % 2u) * bytes;
}

/* ---- Begin --------------------------------------------------------------------------------- */

static int is_side(uint16_t side)
{
    return side >= 1 && side <= PEL_SIDE_MAX;
}

static int is_whole_factor(const pel_resize_config *c)
{
    const uint32_t area =
        (uint32_t)(c->width_in / c->width_out) * (uint32_t)(c->height_in / c->height_out);

    return c->width_in % c->width_out == 0 && c->height_in % c->height_out == 0 &&
           area <= BOX_AREA_MAX;
}

static pel_status check_config(const pel_resize_config *c)
{
    if (!c->work || !pel_i_aligned4(c->work) || (unsigned)c->method >= PEL_RESIZE_METHOD_COUNT ||
        c->channels == 2 || c->channels > 3) {
        return PEL_ERR_ARG;
    }
    if (!is_side(c->width_in) || !is_side(c->height_in) || !is_side(c->width_out) ||
        !is_side(c->height_out) || (c->method == PEL_RESIZE_BOX && !is_whole_factor(c))) {
        return PEL_ERR_RANGE;
    }
    return c->work_bytes < pel_resize_bytes(c) ? PEL_ERR_SPACE : PEL_OK;
}

pel_status pel_resize_begin(pel_resize *resize, const pel_resize_config *config)
{
    const pel_status status = resize && config ? check_config(config) : PEL_ERR_ARG;

    if (status != PEL_OK) {
        return status;
    }
    resize->config = *config;
    resize->config.backend = pel_i_row_backend(config->backend);
    resize->pushed = 0;
    resize->row = 0;
    resize->state = RUNNING;
    if (config->method == PEL_RESIZE_BILINEAR) {
        for (uint16_t x = 0; x < config->width_out; x++) {
            places_of(resize)[x] = place_between(x, config->width_in, config->width_out);
        }
    }
    return PEL_OK;
}

/* ---- Rows ---------------------------------------------------------------------------------- */

static void keep_row(const pel_resize *r, const uint8_t *row)
{
    const uint16_t count = (uint16_t)(r->config.width_in * channels_of(&r->config));

    pel_i_row_copy(r->config.backend, row, count, kept_row(r, r->pushed));
}

static void add_row(const pel_resize *r, const uint8_t *row)
{
    const pel_resize_config *c = &r->config;
    const uint16_t count = (uint16_t)(c->width_out * channels_of(c));

    if (r->pushed % (c->height_in / c->height_out) == 0) {
        for (uint16_t i = 0; i < count; i++) {
            sums_of(r)[i] = 0;
        }
    }
    pel_i_row_box_add(c->backend, row, c->width_in / c->width_out, channels_of(c), c->width_out,
                      sums_of(r));
}

pel_status pel_resize_push(pel_resize *resize, const uint8_t *row)
{
    if (!resize || !row) {
        return PEL_ERR_ARG;
    }
    if (resize->state != RUNNING || resize->pushed == resize->config.height_in ||
        is_ready(resize)) {
        return PEL_ERR_ORDER;
    }
    if (resize->config.method == PEL_RESIZE_BOX) {
        add_row(resize, row);
    } else {
        keep_row(resize, row);
    }
    resize->pushed++;
    return PEL_OK;
}

static void pull_box(const pel_resize *r, uint8_t *out)
{
    const pel_resize_config *c = &r->config;
    const uint32_t area =
        (uint32_t)(c->width_in / c->width_out) * (uint32_t)(c->height_in / c->height_out);

    pel_i_row_box_mean(c->backend, sums_of(r), area, (uint16_t)(c->width_out * channels_of(c)),
                       out);
}

static void pull_bilinear(const pel_resize *r, uint8_t *out)
{
    const pel_resize_config *c = &r->config;
    const pel_row_place place = place_between(r->row, c->height_in, c->height_out);
    const uint16_t below = place.x + 1 < c->height_in ? (uint16_t)(place.x + 1) : place.x;
    pel_row_between rows;

    rows.upper = kept_row(r, place.x);
    rows.lower = kept_row(r, below);
    rows.last = (uint16_t)(c->width_in - 1);
    rows.weight = place.weight;
    pel_i_row_bilinear(c->backend, &rows, places_of(r), channels_of(c), c->width_out, out);
}

pel_status pel_resize_pull(pel_resize *resize, uint8_t *out)
{
    const pel_resize_config *c;

    if (!resize || !out) {
        return PEL_ERR_ARG;
    }
    if (resize->state != RUNNING || !is_ready(resize)) {
        return PEL_ERR_ORDER;
    }
    c = &resize->config;
    if (c->method == PEL_RESIZE_BOX) {
        pull_box(resize, out);
    } else if (c->method == PEL_RESIZE_BILINEAR) {
        pull_bilinear(resize, out);
    } else {
        pel_row_nearest(kept_row(resize, 0), c->width_in, channels_of(c), c->width_out, out);
    }
    resize->row++;
    return PEL_OK;
}

pel_status pel_resize_frame(const pel_resize_config *config, const pel_cview *src,
                            const pel_view *dst)
{
    pel_status status = config ? pel_i_check_apart(src, dst) : PEL_ERR_ARG;
    pel_resize resize;
    pel_resize_config c;

    if (status != PEL_OK) {
        return status;
    }
    c = *config;
    c.channels = (uint8_t)pel_i_channels(src->format);
    c.width_in = src->width;
    c.height_in = src->height;
    c.width_out = dst->width;
    c.height_out = dst->height;
    status = pel_resize_begin(&resize, &c);
    if (status != PEL_OK) {
        return status;
    }
    for (uint16_t y = 0; y < src->height; y++) {
        (void)pel_resize_push(&resize, pel_i_row(src, y));
        while (is_ready(&resize)) {
            (void)pel_resize_pull(&resize, pel_i_row_to_write(dst, resize.row));
        }
    }
    return PEL_OK;
}
