#include "pel/feature.h"

#include "overlap.h"
#include "row/row_feature_select.h"
#include "row/row_filter_best.h"

/* ---- Working memory ------------------------------------------------------------------------ */

/* First three rows of gradients, then three of gray; row y in slot y mod 3, one more on either
 * side. */
static uint16_t *gradient_row(const pel_canny *f, uint32_t slot)
{
    return (uint16_t *)f->config.work + (slot % 3u) * ((size_t)f->config.width + 2u) + 1;
}

static uint8_t *gray_row(const pel_canny *f, uint16_t y)
{
    const size_t length = (size_t)f->config.width + 2u;
    return (uint8_t *)f->config.work + 6u * length + (y % 3u) * length + 1;
}

/* The gradient outside the picture is 0. */
static void clear_gradients(uint16_t *row, uint16_t width)
{
    for (int x = -1; x <= width; x++) {
        row[x] = 0;
    }
}

/* ---- Rows ---------------------------------------------------------------------------------- */

enum { STATE_IDLE, STATE_ROWS };

uint32_t pel_canny_bytes(uint16_t width)
{
    return PEL_CANNY_BYTES(width);
}

static pel_status check_config(const pel_canny_config *c)
{
    if (!c->work || !pel_i_aligned2(c->work) || c->low > c->high ||
        (unsigned)c->backend >= PEL_BACKEND_COUNT) {
        return PEL_ERR_ARG;
    }
    if (c->width == 0 || c->height == 0 || c->width > PEL_SIDE_MAX || c->height > PEL_SIDE_MAX) {
        return PEL_ERR_RANGE;
    }
    return c->work_bytes < pel_canny_bytes(c->width) ? PEL_ERR_SPACE : PEL_OK;
}

pel_status pel_canny_begin(pel_canny *f, const pel_canny_config *config)
{
    const pel_status status = f && config ? check_config(config) : PEL_ERR_ARG;

    if (status != PEL_OK) {
        return status;
    }
    f->config = *config;
    f->config.backend = pel_i_row_backend(config->backend);
    f->pushed = 0;
    f->graded = 0;
    f->row = 0;
    f->state = STATE_ROWS;
    for (unsigned slot = 0; slot < 3; slot++) {
        clear_gradients(gradient_row(f, slot), config->width);
    }
    return PEL_OK;
}

static int is_ready(const pel_canny *f)
{
    return f->row < f->config.height && (f->pushed == f->config.height || f->pushed > f->row + 2);
}

pel_status pel_canny_push(pel_canny *f, const uint8_t *gray)
{
    uint8_t *row;

    if (!f || !gray) {
        return PEL_ERR_ARG;
    }
    if (f->state != STATE_ROWS || f->pushed >= f->config.height || is_ready(f)) {
        return PEL_ERR_ORDER;
    }
    row = gray_row(f, f->pushed);
    PEL_BEST_COPY(gray, f->config.width, row);
    row[-1] = row[0];
    row[f->config.width] = row[f->config.width - 1];
    f->pushed++;
    return PEL_OK;
}

static void grade(const pel_canny *f, uint16_t y)
{
    const uint8_t *rows[3];

    rows[0] = gray_row(f, (uint16_t)(y > 0 ? y - 1 : 0));
    rows[1] = gray_row(f, y);
    rows[2] = gray_row(f, (uint16_t)(y + 1 < f->config.height ? y + 1 : y));
    pel_i_row_gradient_sector(f->config.backend, rows, f->config.width, gradient_row(f, y));
}

/* Gradients are computed when a row is pulled, not when it is pushed: only then is the slot that
 * they go into free. */
pel_status pel_canny_pull(pel_canny *f, uint8_t *out)
{
    const uint16_t *rows[3];

    if (!f || !out) {
        return PEL_ERR_ARG;
    }
    if (f->state != STATE_ROWS || !is_ready(f)) {
        return PEL_ERR_ORDER;
    }
    while (f->graded <= f->row + 1 && f->graded < f->config.height) {
        grade(f, f->graded);
        f->graded++;
    }
    if (f->row + 1 == f->config.height) {
        clear_gradients(gradient_row(f, f->row + 1u), f->config.width);
    }
    for (uint32_t i = 0; i < 3; i++) {
        rows[i] = gradient_row(f, f->row + i + 2u); /* row - 1 + i, modulo 3 */
    }
    pel_i_row_thin(f->config.backend, rows, f->config.width, f->config.low, f->config.high, out);
    f->row++;
    return PEL_OK;
}

/* ---- Frames -------------------------------------------------------------------------------- */

static pel_status check_gray(const pel_cview *view)
{
    const pel_status status = pel_cview_check(view);
    return status != PEL_OK ? status : view->format == PEL_GRAY8 ? PEL_OK : PEL_ERR_FORMAT;
}

/* The first byte of a view in memory, and the one past its last. */
static void extent(const pel_cview *view, uintptr_t *begin, uintptr_t *end)
{
    const ptrdiff_t last = (ptrdiff_t)view->stride_bytes[0] * (view->height - 1);
    const uintptr_t top = (uintptr_t)view->plane[0], bottom = top + (uintptr_t)last;

    *begin = last < 0 ? bottom : top;
    *end = (last < 0 ? top : bottom) + view->width;
}

/* Writing row y when all rows to y have been read is no harm if both are the same pixels. */
static int may_write(const pel_cview *src, const pel_cview *dst)
{
    uintptr_t src_begin, src_end, dst_begin, dst_end;

    if (src->plane[0] == dst->plane[0] && src->stride_bytes[0] == dst->stride_bytes[0]) {
        return 1;
    }
    extent(src, &src_begin, &src_end);
    extent(dst, &dst_begin, &dst_end);
    return src_end <= dst_begin || dst_end <= src_begin;
}

static pel_status check_frame(const pel_cview *src, const pel_cview *map)
{
    pel_status status = check_gray(src);

    if (status == PEL_OK) {
        status = check_gray(map);
    }
    if (status != PEL_OK) {
        return status;
    }
    if (src->width != map->width || src->height != map->height) {
        return PEL_ERR_SPACE;
    }
    return may_write(src, map) ? PEL_OK : PEL_ERR_ARG;
}

static uint8_t *map_row(const pel_view *map, uint16_t y)
{
    return map->plane[0] + (ptrdiff_t)map->stride_bytes[0] * y;
}

pel_status pel_canny_frame(const pel_canny_config *config, const pel_cview *src,
                           const pel_view *map)
{
    pel_canny canny;
    pel_canny_config c;
    pel_cview out;
    pel_status status;

    if (!config || !map) {
        return PEL_ERR_ARG;
    }
    out = pel_view_to_read(map);
    status = check_frame(src, &out);
    if (status != PEL_OK) {
        return status;
    }
    c = *config;
    c.width = src->width;
    c.height = src->height;
    status = pel_canny_begin(&canny, &c);
    for (uint16_t y = 0; y < src->height && status == PEL_OK; y++) {
        status = pel_canny_push(&canny, src->plane[0] + (ptrdiff_t)src->stride_bytes[0] * y);
        while (status == PEL_OK && is_ready(&canny)) {
            status = pel_canny_pull(&canny, map_row(map, canny.row));
        }
    }
    return status;
}

/* ---- Hysteresis ---------------------------------------------------------------------------- */

/* A sweep over the map, at the place `at`. Places on the stack are strong, their neighbours not
 * yet. */
typedef struct sweep {
    const pel_view *map;
    pel_place *stack;
    uint32_t stack_max, stacked;
    pel_place at;
    int up;     /* from the last pixel to the first */
    int missed; /* a pixel became strong that the sweep has passed and the stack had no room for */
} sweep;

static int has_passed(const sweep *s, uint16_t x, uint16_t y)
{
    const int before = y != s->at.y ? y < s->at.y : x < s->at.x;
    return s->up ? !before : before;
}

/* To be looked at, now or when the sweep comes to it. */
static void promote(sweep *s, uint16_t x, uint16_t y)
{
    if (s->stacked < s->stack_max) {
        s->stack[s->stacked].x = x;
        s->stack[s->stacked].y = y;
        s->stacked++;
    } else if (has_passed(s, x, y)) {
        s->missed = 1;
    }
}

static void promote_around(sweep *s, uint16_t x, uint16_t y)
{
    const uint16_t x0 = (uint16_t)(x > 0 ? x - 1 : 0), y0 = (uint16_t)(y > 0 ? y - 1 : 0);

    for (uint16_t v = y0; v <= y + 1 && v < s->map->height; v++) {
        uint8_t *const row = map_row(s->map, v);
        for (uint16_t u = x0; u <= x + 1 && u < s->map->width; u++) {
            if (row[u] == PEL_CANNY_WEAK) {
                row[u] = PEL_CANNY_STRONG;
                promote(s, u, v);
            }
        }
    }
}

static void visit(sweep *s)
{
    promote_around(s, s->at.x, s->at.y);
    while (s->stacked > 0) {
        s->stacked--;
        promote_around(s, s->stack[s->stacked].x, s->stack[s->stacked].y);
    }
}

static void run_sweep(sweep *s)
{
    const uint16_t width = s->map->width, height = s->map->height;

    s->missed = 0;
    for (uint16_t j = 0; j < height; j++) {
        const uint16_t y = (uint16_t)(s->up ? height - 1 - j : j);
        const uint8_t *const row = map_row(s->map, y);
        s->at.y = y;
        for (uint16_t i = 0; i < width; i++) {
            const uint16_t x = (uint16_t)(s->up ? width - 1 - i : i);
            if (row[x] == PEL_CANNY_STRONG) {
                s->at.x = x;
                visit(s);
            }
        }
    }
}

static void clear_weak(const pel_view *map)
{
    for (uint16_t y = 0; y < map->height; y++) {
        uint8_t *const row = map_row(map, y);
        for (uint16_t x = 0; x < map->width; x++) {
            row[x] = row[x] == PEL_CANNY_WEAK ? PEL_CANNY_NONE : row[x];
        }
    }
}

pel_status pel_canny_hysteresis(const pel_view *map, pel_place *stack, uint32_t stack_max)
{
    pel_cview view;
    pel_status status;
    sweep s = {0};

    if (!map || (!stack && stack_max > 0)) {
        return PEL_ERR_ARG;
    }
    view = pel_view_to_read(map);
    status = check_gray(&view);
    if (status != PEL_OK) {
        return status;
    }
    s.map = map;
    s.stack = stack;
    s.stack_max = stack_max;
    do {
        run_sweep(&s);
        s.up = !s.up;
    } while (s.missed);
    clear_weak(map);
    return PEL_OK;
}

pel_status pel_canny_link_row(const uint8_t *above, const uint8_t *below, uint16_t width,
                              uint8_t *row)
{
    if (!row) {
        return PEL_ERR_ARG;
    }
    if (width == 0 || width > PEL_SIDE_MAX) {
        return PEL_ERR_RANGE;
    }
    pel_row_link(above, below, width, row);
    return PEL_OK;
}
