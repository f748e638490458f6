#include "pel/feature.h"

#include "overlap.h"
#include "row/row_feature_select.h"
#include "row/row_filter_best.h"

/* ---- Working memory ------------------------------------------------------------------------ */

/*
 * First three rows of responses: row y lies in slot y mod 3, one more on either side. Behind them
 * the gray rows: row y in slot y mod (2r + 1), r repeated pixels on either side. What is outside
 * the picture is weaker than any response.
 */
enum { FAST_RADIUS = 3 };

static const int32_t no_response = INT32_MIN;

static int32_t *response_row(const pel_corners *f, uint32_t slot)
{
    const size_t length = (size_t)f->config.width + 2u;
    return (int32_t *)f->config.work + (slot % 3u) * length + 1;
}

static uint8_t *gray_row(const pel_corners *f, uint16_t y)
{
    const size_t length = (size_t)f->config.width + 2u * f->radius;
    uint8_t *const first = (uint8_t *)f->config.work + 12u * ((size_t)f->config.width + 2u);

    return first + (y % (2u * f->radius + 1u)) * length + f->radius;
}

static void fill_responses(int32_t *row, int32_t value, uint16_t begin, uint16_t end)
{
    for (uint16_t x = begin; x < end; x++) {
        row[x] = value;
    }
}

static void put_gray(const pel_corners *f, const uint8_t *src, uint8_t *row)
{
    const int width = f->config.width;

    PEL_BEST_COPY(src, f->config.width, row);
    for (int i = 1; i <= f->radius; i++) {
        row[-i] = src[0];
        row[width - 1 + i] = src[width - 1];
    }
}

/* ---- Begin --------------------------------------------------------------------------------- */

enum { STATE_IDLE, STATE_ROWS };

uint32_t pel_corners_bytes(uint16_t width, pel_corners_method method)
{
    return PEL_CORNERS_BYTES(width, method);
}

static pel_status check_config(const pel_corners_config *c)
{
    if ((unsigned)c->method >= PEL_CORNERS_METHOD_COUNT ||
        (unsigned)c->suppress > PEL_SUPPRESS_NONE || (unsigned)c->backend >= PEL_BACKEND_COUNT ||
        c->k_q15 > 8191 || c->threshold < 0 ||
        (c->method == PEL_CORNERS_FAST9 && c->threshold > 254)) {
        return PEL_ERR_ARG;
    }
    if (!c->work || !pel_i_aligned4(c->work) || (!c->results && c->results_max > 0)) {
        return PEL_ERR_ARG;
    }
    if (c->width == 0 || c->height == 0 || c->width > PEL_SIDE_MAX || c->height > PEL_SIDE_MAX) {
        return PEL_ERR_RANGE;
    }
    return c->work_bytes < pel_corners_bytes(c->width, c->method) ? PEL_ERR_SPACE : PEL_OK;
}

static void set_defaults(pel_corners_config *c)
{
    if (c->k_q15 == 0) {
        c->k_q15 = 1311;
    }
    if (c->threshold == 0) {
        c->threshold = c->method == PEL_CORNERS_FAST9 ? 20 : 1;
    }
}

pel_status pel_corners_begin(pel_corners *f, const pel_corners_config *config)
{
    const pel_status status = f && config ? check_config(config) : PEL_ERR_ARG;

    if (status != PEL_OK) {
        return status;
    }
    f->config = *config;
    f->config.backend = pel_i_row_backend(config->backend);
    set_defaults(&f->config);
    f->found = 0;
    f->dropped = 0;
    f->kept = 0;
    f->pushed = 0;
    f->responded = 0;
    f->finished = 0;
    f->radius = (uint8_t)PEL_CORNERS_RADIUS(config->method);
    f->state = STATE_ROWS;
    for (unsigned slot = 0; slot < 3;
         slot++) { /* the sides, and slot 2 as the row above the first */
        int32_t *const row = response_row(f, slot);
        row[-1] = no_response;
        row[config->width] = no_response;
    }
    fill_responses(response_row(f, 2), no_response, 0, config->width);
    return PEL_OK;
}

/* ---- Responses ----------------------------------------------------------------------------- */

/* The rows around row y; those outside the picture are its first and its last. */
static void window_at(const pel_corners *f, uint16_t y, const uint8_t *rows[7])
{
    const int32_t last = f->config.height - 1;

    for (int32_t j = 0; j <= 2 * f->radius; j++) {
        const int32_t place = y + j - f->radius;
        rows[j] = gray_row(f, (uint16_t)(place < 0 ? 0 : place > last ? last : place));
    }
}

/* FAST has no circle at the border. */
static void respond_fast9(const pel_corners *f, uint16_t y, const uint8_t *rows[7],
                          int32_t *responses)
{
    const uint16_t width = f->config.width, height = f->config.height;

    fill_responses(responses, 0, 0, width);
    if (width > 2 * FAST_RADIUS && y >= FAST_RADIUS && y + FAST_RADIUS < height) {
        for (unsigned i = 0; i < 7; i++) {
            rows[i] += FAST_RADIUS;
        }
        pel_i_row_fast9(f->config.backend, rows, (uint16_t)(width - 2 * FAST_RADIUS),
                        (int16_t)f->config.threshold, responses + FAST_RADIUS);
    }
}

static void respond(const pel_corners *f, uint16_t y)
{
    const pel_corners_config *const c = &f->config;
    int32_t *const responses = response_row(f, y);
    const uint8_t *rows[7];

    window_at(f, y, rows);
    if (c->method == PEL_CORNERS_FAST9) {
        respond_fast9(f, y, rows, responses);
    } else if (c->method == PEL_CORNERS_SHI_TOMASI) {
        pel_i_row_shi_tomasi(c->backend, rows, c->width, responses);
    } else {
        pel_i_row_harris(c->backend, rows, c->width, c->k_q15, responses);
    }
    if (c->on_response) {
        c->on_response(c->user, y, responses);
    }
}

/* ---- The strongest ------------------------------------------------------------------------- */

/* The order of the results, read from the end: by response, then the later in raster order. */
static int is_weaker(const pel_corner *a, const pel_corner *b)
{
    if (a->response != b->response) {
        return a->response < b->response;
    }
    return a->y != b->y ? a->y > b->y : a->x > b->x;
}

static void swap(pel_corner *a, pel_corner *b)
{
    const pel_corner kept = *a;
    *a = *b;
    *b = kept;
}

/* The results are a heap, the weakest on top: a parent is weaker than its children. */
static void sift_up(pel_corner *heap, uint32_t i)
{
    while (i > 0 && is_weaker(&heap[i], &heap[(i - 1) / 2])) {
        swap(&heap[i], &heap[(i - 1) / 2]);
        i = (i - 1) / 2;
    }
}

static void sift_down(pel_corner *heap, uint32_t count)
{
    uint32_t i = 0, child;

    for (child = 1; child < count; child = 2 * i + 1) {
        if (child + 1 < count && is_weaker(&heap[child + 1], &heap[child])) {
            child++;
        }
        if (!is_weaker(&heap[child], &heap[i])) {
            return;
        }
        swap(&heap[child], &heap[i]);
        i = child;
    }
}

static void keep(pel_corners *f, const pel_corner *corner)
{
    const pel_corners_config *const c = &f->config;

    if (c->results_max == 0) {
        return;
    }
    if (f->kept < c->results_max) {
        c->results[f->kept] = *corner;
        sift_up(c->results, f->kept);
        f->kept++;
        return;
    }
    f->dropped++;
    if (is_weaker(&c->results[0], corner)) {
        c->results[0] = *corner;
        sift_down(c->results, f->kept);
    }
}

/* ---- Corners ------------------------------------------------------------------------------- */

/*
 * 16 times the vertex of the parabola through (-1, before), (0, top), (1, after), top the largest:
 * 8 (after - before) / (2 top - before - after), that is steep / bend. |after - before| is not over
 * the divisor, so the result is within -8..8. With 8 added it is found bit by bit. Values < 2^40.
 */
static int8_t vertex_q4(int32_t before, int32_t top, int32_t after)
{
    const int64_t steep = 8 * ((int64_t)after - before);
    const int64_t bend = 2 * (int64_t)top - before - after;
    const uint64_t part = 32 * (uint64_t)bend;
    uint64_t rest = (uint64_t)(2 * steep + 17 * bend);
    int quotient = 0;

    if (bend == 0) {
        return 0;
    }
    for (int i = 0; i < 5; i++) {
        quotient *= 2;
        if (rest >= part) {
            rest -= part;
            quotient++;
        }
        rest *= 2;
    }
    return (int8_t)(quotient - 8);
}

static pel_corner corner_at(const pel_corners *f, const int32_t *const rows[3], uint16_t x,
                            uint16_t y)
{
    const pel_corners_config *const c = &f->config;
    const int smooth = c->method != PEL_CORNERS_FAST9 && c->suppress != PEL_SUPPRESS_NONE;
    pel_corner corner;

    corner.response = rows[1][x];
    corner.x = x;
    corner.y = y;
    corner.dx_q4 = 0;
    corner.dy_q4 = 0;
    if (smooth && x > 0 && x + 1 < c->width) {
        corner.dx_q4 = vertex_q4(rows[1][x - 1], rows[1][x], rows[1][x + 1]);
    }
    if (smooth && y > 0 && y + 1 < c->height) {
        corner.dy_q4 = vertex_q4(rows[0][x], rows[1][x], rows[2][x]);
    }
    return corner;
}

/* Nothing more is made of a corner that nobody is told of. */
static void report(pel_corners *f, const int32_t *const rows[3], uint16_t x, uint16_t y)
{
    const pel_corners_config *const c = &f->config;

    f->found++;
    if (c->results_max > 0 || c->on_corner) {
        const pel_corner corner = corner_at(f, rows, x, y);
        keep(f, &corner);
        if (c->on_corner) {
            c->on_corner(c->user, &corner);
        }
    }
}

static void finish(pel_corners *f, uint16_t y)
{
    const pel_corners_config *const c = &f->config;
    const int32_t *rows[3];

    if (y + 1 == c->height) {
        fill_responses(response_row(f, y + 1u), no_response, 0, c->width);
    }
    for (uint32_t i = 0; i < 3; i++) {
        rows[i] = response_row(f, y + i + 2u); /* row y - 1 + i is in slot y + 2 + i, modulo 3 */
    }
    for (uint16_t x = 0; x < c->width; x++) {
        x = pel_i_row_next_top(c->backend, rows, x, c->width, c->threshold, (int)c->suppress);
        if (x < c->width) {
            report(f, rows, x, y);
        }
    }
}

/* ---- Rows ---------------------------------------------------------------------------------- */

/* Whether `ready` rows hold all that row y and `below` more need, as far as the picture goes. */
static int is_due(const pel_corners *f, uint16_t ready, uint16_t y, uint16_t below)
{
    return y < f->config.height && (ready == f->config.height || ready > y + below);
}

pel_status pel_corners_row(pel_corners *f, uint16_t y, const uint8_t *gray)
{
    if (!f || !gray) {
        return PEL_ERR_ARG;
    }
    if (f->state != STATE_ROWS || y != f->pushed || y >= f->config.height) {
        return PEL_ERR_ORDER;
    }
    put_gray(f, gray, gray_row(f, y));
    f->pushed++;
    while (is_due(f, f->pushed, f->responded, f->radius)) {
        respond(f, f->responded);
        f->responded++;
        while (is_due(f, f->responded, f->finished, 1)) {
            finish(f, f->finished);
            f->finished++;
        }
    }
    return PEL_OK;
}

pel_status pel_corners_end(pel_corners *f, uint32_t *count)
{
    if (!f || !count) {
        return PEL_ERR_ARG;
    }
    if (f->state != STATE_ROWS || f->pushed != f->config.height) {
        return PEL_ERR_ORDER;
    }
    f->state = STATE_IDLE;
    for (uint32_t left = f->kept; left > 1; left--) { /* the weakest to the end, again and again */
        swap(&f->config.results[0], &f->config.results[left - 1]);
        sift_down(f->config.results, left - 1);
    }
    *count = f->kept;
    return f->dropped > 0 ? PEL_TRUNCATED : PEL_OK;
}

pel_status pel_corners_frame(pel_corners *f, const pel_corners_config *config,
                             const pel_cview *view, uint32_t *count)
{
    pel_status status = config && count ? pel_cview_check(view) : PEL_ERR_ARG;
    pel_corners_config c;

    if (status != PEL_OK) {
        return status;
    }
    if (view->format != PEL_GRAY8) {
        return PEL_ERR_FORMAT;
    }
    c = *config;
    c.width = view->width;
    c.height = view->height;
    status = pel_corners_begin(f, &c);
    for (uint16_t y = 0; y < view->height && status == PEL_OK; y++) {
        status = pel_corners_row(f, y, view->plane[0] + (ptrdiff_t)view->stride_bytes[0] * y);
    }
    return status == PEL_OK ? pel_corners_end(f, count) : status;
}
