/* The adaptive threshold: a window of rows and the sums of its columns. */
#include "pel/point.h"

#include "frames.h"
#include "overlap.h"
#include "row/row_point_select.h"

enum { IDLE, RUNNING };

uint32_t pel_adaptive_bytes(uint16_t width, unsigned radius)
{
    return PEL_ADAPTIVE_BYTES(width, radius);
}

/* The working memory: a sum for each column, then 2 radius + 1 rows, row y in slot y mod (2 radius
 * + 1). */
static uint16_t *columns_of(const pel_adaptive *a)
{
    return (uint16_t *)a->config.work;
}

static uint8_t *slot_of(const pel_adaptive *a, uint16_t y)
{
    const uint16_t slots = (uint16_t)(2 * a->config.radius + 1);
    uint8_t *rows = (uint8_t *)a->config.work + 2 * (size_t)a->config.width;

    return rows + (size_t)(y % slots) * a->config.width;
}

static pel_status check_config(const pel_adaptive_config *c)
{
    if (!c->work || !pel_i_aligned2(c->work) || c->radius < 1 ||
        c->radius > PEL_ADAPTIVE_RADIUS_MAX || c->c < -255 || c->c > 255) {
        return PEL_ERR_ARG;
    }
    if (c->width == 0 || c->height == 0 || c->width > PEL_SIDE_MAX || c->height > PEL_SIDE_MAX) {
        return PEL_ERR_RANGE;
    }
    return c->work_bytes < PEL_ADAPTIVE_BYTES(c->width, c->radius) ? PEL_ERR_SPACE : PEL_OK;
}

pel_status pel_adaptive_begin(pel_adaptive *adaptive, const pel_adaptive_config *config)
{
    const pel_status status = adaptive && config ? check_config(config) : PEL_ERR_ARG;

    if (status != PEL_OK) {
        return status;
    }
    adaptive->config = *config;
    adaptive->config.backend = pel_i_row_backend(config->backend);
    adaptive->pushed = 0;
    adaptive->row = 0;
    adaptive->state = RUNNING;
    for (uint16_t x = 0; x < config->width; x++) {
        columns_of(adaptive)[x] = 0;
    }
    return PEL_OK;
}

static int is_ready(const pel_adaptive *a)
{
    const uint16_t height = a->config.height;
    const uint16_t lowest = (uint16_t)(a->row + a->config.radius);

    return a->row < height && (a->pushed == height || a->pushed > lowest);
}

/* How often row y is in the window when it enters it: the first row stands for the `radius` rows
 * above the picture, the last one for those of the first window that are below a low picture. */
static uint16_t times_entering(const pel_adaptive *a, uint16_t y)
{
    const uint16_t radius = a->config.radius;
    uint16_t times = 1;

    if (y == 0) {
        times = (uint16_t)(times + radius);
    }
    if (y == a->config.height - 1 && y < radius) {
        times = (uint16_t)(times + radius - y);
    }
    return times;
}

pel_status pel_adaptive_push(pel_adaptive *adaptive, const uint8_t *row)
{
    uint8_t *slot;
    uint16_t y;

    if (!adaptive || !row) {
        return PEL_ERR_ARG;
    }
    if (adaptive->state != RUNNING || adaptive->pushed == adaptive->config.height ||
        is_ready(adaptive)) {
        return PEL_ERR_ORDER;
    }
    y = adaptive->pushed;
    slot = slot_of(adaptive, y);
    pel_i_row_copy(adaptive->config.backend, row, adaptive->config.width, slot);
    pel_i_row_columns_add(adaptive->config.backend, slot, adaptive->config.width,
                          times_entering(adaptive, y), columns_of(adaptive));
    adaptive->pushed++;
    return PEL_OK;
}

/* Row y is done: its topmost row leaves, and below the picture the last row enters once more. */
static void move_window(const pel_adaptive *a, uint16_t y)
{
    const pel_adaptive_config *c = &a->config;
    const uint16_t last = (uint16_t)(c->height - 1);

    pel_i_row_columns_subtract(c->backend,
                               slot_of(a, y > c->radius ? (uint16_t)(y - c->radius) : 0), c->width,
                               columns_of(a));
    if ((uint32_t)y + 1 + c->radius > last) {
        pel_i_row_columns_add(c->backend, slot_of(a, last), c->width, 1, columns_of(a));
    }
}

pel_status pel_adaptive_pull(pel_adaptive *adaptive, uint8_t *out)
{
    const pel_adaptive_config *c;
    uint16_t y;

    if (!adaptive || !out) {
        return PEL_ERR_ARG;
    }
    if (adaptive->state != RUNNING || !is_ready(adaptive)) {
        return PEL_ERR_ORDER;
    }
    c = &adaptive->config;
    y = adaptive->row;
    pel_i_row_over_mean(c->backend, slot_of(adaptive, y), columns_of(adaptive), c->width, c->radius,
                        c->c, out);
    adaptive->row++;
    if (adaptive->row < c->height) {
        move_window(adaptive, y);
    }
    return PEL_OK;
}

pel_status pel_adaptive_frame(const pel_adaptive_config *config, const pel_cview *src,
                              const pel_view *dst)
{
    pel_status status = config ? pel_i_check_bytes(src, 1) : PEL_ERR_ARG;
    pel_adaptive adaptive;
    pel_adaptive_config c;

    if (status == PEL_OK) {
        status = pel_i_check_pair(src, dst);
    }
    if (status != PEL_OK) {
        return status;
    }
    c = *config;
    c.width = src->width;
    c.height = src->height;
    status = pel_adaptive_begin(&adaptive, &c);
    if (status != PEL_OK) {
        return status;
    }
    for (uint16_t y = 0; y < src->height; y++) {
        (void)pel_adaptive_push(&adaptive, pel_i_row(src, y));
        while (is_ready(&adaptive)) {
            (void)pel_adaptive_pull(&adaptive, pel_i_row_to_write(dst, adaptive.row));
        }
    }
    return PEL_OK;
}
