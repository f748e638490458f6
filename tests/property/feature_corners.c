/*
 * Corners against their definitions, computed pixel by pixel in 64 bits: every response, every
 * corner and the list of the strongest, on random pictures of every size from 1x1 to 40x30; row by
 * row with guarded memory and rows that are destroyed after use, and as a frame with a stride,
 * upside down or not.
 */
#include "feature_picture.h"

static guarded work, line_buffer, result_buffer;

/* ---- Responses ----------------------------------------------------------------------------- */

static void tensor(int x, int y, int64_t *a, int64_t *b, int64_t *c)
{
    *a = *b = *c = 0;
    for (int v = y - 1; v <= y + 1; v++) {
        for (int u = x - 1; u <= x + 1; u++) {
            const int64_t gx = sobel(u, v, 0), gy = sobel(u, v, 1);
            *a += gx * gx;
            *b += gx * gy;
            *c += gy * gy;
        }
    }
}

/* r is the floor of exact / 2^29 if r 2^29 <= exact < (r + 1) 2^29. */
static int is_harris(int x, int y, int64_t k_q15, int64_t r)
{
    const int64_t unit = (int64_t)1 << 29;
    int64_t a, b, c, exact;
    tensor(x, y, &a, &b, &c);
    exact = 32768 * (a * c - b * b) - k_q15 * (a + c) * (a + c);
    return r * unit <= exact && exact < (r + 1) * unit;
}

/* v is not over both eigenvalues if it is not over their mean and (a - v)(c - v) - b^2 is not
 * negative. */
static int is_at_most_eigenvalue(int64_t a, int64_t b, int64_t c, int64_t v)
{
    return 2 * v <= a + c && (a - v) * (c - v) - b * b >= 0;
}

static int is_shi_tomasi(int x, int y, int64_t r)
{
    int64_t a, b, c;
    tensor(x, y, &a, &b, &c);
    return is_at_most_eigenvalue(a, b, c, r) && !is_at_most_eigenvalue(a, b, c, r + 1);
}

static int is_fast_corner(int x, int y, int t)
{
    static const int circle[16][2] = {{0, 3},  {1, 3},  {2, 2},  {3, 1},   {3, 0},   {3, -1},
                                      {2, -2}, {1, -3}, {0, -3}, {-1, -3}, {-2, -2}, {-3, -1},
                                      {-3, 0}, {-3, 1}, {-2, 2}, {-1, 3}};
    if (x < 3 || y < 3 || x >= width - 3 || y >= height - 3) {
        return 0;
    }
    for (int sign = -1; sign <= 1; sign += 2) {
        int in_a_row = 0;
        for (int i = 0; i < 16 + 8; i++) {
            const int there = at(x + circle[i % 16][0], y + circle[i % 16][1]);
            in_a_row = sign * (there - at(x, y)) > t ? in_a_row + 1 : 0;
            if (in_a_row == 9) {
                return 1;
            }
        }
    }
    return 0;
}

static int is_fast(int x, int y, int threshold, int r)
{
    return r == 0 ? !is_fast_corner(x, y, threshold)
                  : r >= threshold && is_fast_corner(x, y, r) && !is_fast_corner(x, y, r + 1);
}

static int is_response(const pel_corners_config *c, int x, int y, int32_t r)
{
    return c->method == PEL_CORNERS_HARRIS ? is_harris(x, y, c->k_q15 ? c->k_q15 : 1311, r)
           : c->method == PEL_CORNERS_SHI_TOMASI
               ? is_shi_tomasi(x, y, r)
               : is_fast(x, y, c->threshold ? c->threshold : 20, r);
}

/* ---- The list ------------------------------------------------------------------------------ */

static int32_t responses[PIXELS_MAX];
static int response_rows;

static pel_corner wanted[PIXELS_MAX];
static uint32_t wanted_count;

static int is_stronger(int x, int y, int u, int v, int strict)
{
    if (u < 0 || v < 0 || u >= width || v >= height) {
        return 1;
    }
    return responses[y * width + x] >= responses[v * width + u] + (strict ? 1 : 0);
}

static int is_wanted(const pel_corners_config *c, int x, int y)
{
    const int32_t least = c->threshold ? c->threshold : c->method == PEL_CORNERS_FAST9 ? 20 : 1;
    if (responses[y * width + x] < least) {
        return 0;
    }
    for (int v = y - 1; c->suppress != PEL_SUPPRESS_NONE && v <= y + 1; v++) {
        for (int u = x - 1; u <= x + 1; u++) {
            const int before = v < y || (v == y && u < x);
            const int strict = before || c->suppress == PEL_SUPPRESS_STRICT;
            if ((u != x || v != y) && !is_stronger(x, y, u, v, strict)) {
                return 0;
            }
        }
    }
    return 1;
}

/* floor(8 (after - before) / (2 top - before - after) + 1/2) */
static int8_t vertex(int64_t before, int64_t top, int64_t after)
{
    const int64_t up = 16 * (after - before) + (2 * top - before - after);
    const int64_t down = 2 * (2 * top - before - after);
    return (int8_t)(down == 0 ? 0 : up >= 0 ? up / down : -((-up + down - 1) / down));
}

static pel_corner corner_of(const pel_corners_config *c, int x, int y)
{
    const int smooth = c->method != PEL_CORNERS_FAST9 && c->suppress != PEL_SUPPRESS_NONE;
    const int32_t *const r = responses + y * width + x;
    pel_corner corner;
    corner.response = *r;
    corner.x = (uint16_t)x;
    corner.y = (uint16_t)y;
    corner.dx_q4 = (int8_t)(smooth && x > 0 && x < width - 1 ? vertex(r[-1], r[0], r[1]) : 0);
    corner.dy_q4 =
        (int8_t)(smooth && y > 0 && y < height - 1 ? vertex(r[-width], r[0], r[width]) : 0);
    return corner;
}

static int compare(const void *left, const void *right)
{
    const pel_corner *const a = left, *const b = right;
    return a->response != b->response ? (a->response < b->response ? 1 : -1)
           : a->y != b->y             ? (a->y > b->y ? 1 : -1)
                                      : (a->x > b->x) - (a->x < b->x);
}

static int same_corner(const pel_corner *a, const pel_corner *b)
{
    return a->response == b->response && a->x == b->x && a->y == b->y && a->dx_q4 == b->dx_q4 &&
           a->dy_q4 == b->dy_q4;
}

static uint32_t told_count;
static int told_right;

static void hear_corner(void *user, const pel_corner *corner)
{
    (void)user; /* in raster order, as `wanted` is before it is sorted */
    if (told_count == 0) {
        memset(wanted, 0, sizeof wanted);
    }
    wanted[told_count < PIXELS_MAX ? told_count : 0] = *corner;
    told_count++;
}

static void hear_response(void *user, uint16_t y, const int32_t *row)
{
    (void)user;
    told_right = told_right && y == response_rows;
    memcpy(responses + y * width, row, (size_t)width * sizeof *row);
    response_rows++;
}

static void check_responses(const pel_corners_config *c)
{
    check_that(told_right && response_rows == height, "%dx%d: rows of responses", width, height);
    for (int i = 0; i < width * height; i++) {
        check_that(is_response(c, i % width, i / width, responses[i]),
                   "%dx%d, method %d: (%d, %d) has %ld", width, height, (int)c->method, i % width,
                   i / width, (long)responses[i]);
    }
}

/* `wanted` holds what was told; it is checked, then replaced by the sorted list. */
static void check_told(const pel_corners_config *c)
{
    uint32_t n = 0;
    int same = 1;
    for (int i = 0; i < width * height; i++) {
        if (is_wanted(c, i % width, i / width)) {
            const pel_corner corner = corner_of(c, i % width, i / width);
            same = same && n < told_count && same_corner(&corner, &wanted[n]);
            wanted[n++] = corner;
        }
    }
    check_that(same && n == told_count, "%dx%d, method %d: told %u corners, not %u", width, height,
               (int)c->method, (unsigned)told_count, (unsigned)n);
    wanted_count = n;
    qsort(wanted, n, sizeof *wanted, compare);
}

static void check_list(const pel_corners *f, pel_status status, const pel_corner *found,
                       uint32_t count)
{
    const uint32_t room = f->config.results_max;
    const uint32_t kept = wanted_count < room ? wanted_count : room;
    int same = count == kept;
    for (uint32_t i = 0; same && i < count; i++) {
        same = same_corner(&found[i], &wanted[i]);
    }
    check_that(same, "%dx%d, method %d: the strongest %u", width, height, (int)f->config.method,
               (unsigned)room);
    check_that(f->found == wanted_count && f->dropped == (room ? wanted_count - kept : 0) &&
                   status == (f->dropped ? PEL_TRUNCATED : PEL_OK),
               "%dx%d, method %d: counted %u, dropped %u", width, height, (int)f->config.method,
               (unsigned)f->found, (unsigned)f->dropped);
}

/* ---- Corners ------------------------------------------------------------------------------- */

static void stream_corners(pel_corners_config c)
{
    pel_corners f;
    uint32_t count = 12345;
    pel_status status;

    c.width = (uint16_t)width;
    c.height = (uint16_t)height;
    c.work_bytes = PEL_CORNERS_BYTES(width, c.method);
    c.work = guarded_take(&work, c.work_bytes, 4, 0xAA);
    c.results = guarded_take(&result_buffer, c.results_max * sizeof(pel_corner), 0, 0xAA);
    c.on_corner = hear_corner;
    c.on_response = hear_response;
    told_count = 0;
    response_rows = 0;
    told_right = 1;
    check_that(pel_corners_begin(&f, &c) == PEL_OK, "begin");
    for (int y = 0; y < height; y++) {
        uint8_t *const row = guarded_take(&line_buffer, (size_t)width, (size_t)(y % 3), 0);
        memcpy(row, picture + y * width, (size_t)width);
        check_that(pel_corners_row(&f, (uint16_t)y, row) == PEL_OK, "row %d", y);
        memset(row, 0x5A, (size_t)width);
    }
    status = pel_corners_end(&f, &count);
    check_responses(&c);
    check_told(&c);
    check_list(&f, status, c.results, count);
    check_that(guarded_intact(&work) && guarded_intact(&line_buffer) &&
                   guarded_intact(&result_buffer),
               "%dx%d: wrote beside its memory", width, height);
}

/* After stream_corners of the same config: `wanted` is what the frame must give. */
static void frame_corners(pel_corners_config c, int upside_down)
{
    const pel_cview view = spread_picture(upside_down);
    pel_corners f;
    uint32_t count = 0;
    pel_status status;

    c.work_bytes = PEL_CORNERS_BYTES(width, c.method);
    c.work = guarded_take(&work, c.work_bytes, 0, 0x55);
    c.results = guarded_take(&result_buffer, c.results_max * sizeof(pel_corner), 0, 0xAA);
    status = pel_corners_frame(&f, &c, &view, &count);
    check_list(&f, status, c.results, count);
    check_that(guarded_intact(&work), "%dx%d: frame wrote beside its memory", width, height);
}

static void every_size_of_corners(rng *random, uint32_t scale, int rounds)
{
    static const char *const names[] = {"Harris", "Shi-Tomasi", "FAST-9"};
    static const uint32_t rooms[] = {0, 1, 5, 17, PIXELS_MAX};
    for (int method = 0; method < PEL_CORNERS_METHOD_COUNT; method++) {
        uint32_t turn = 0;
        check_group("%s, every size to %dx%d", names[method], WIDTH_MAX, HEIGHT_MAX);
        for (int i = 0; i < PIXELS_MAX * rounds; i += (int)(1 + rng_below(random, 2 * scale - 1))) {
            pel_corners_config c;
            memset(&c, 0, sizeof c);
            c.method = (pel_corners_method)method;
            c.suppress = (pel_corners_suppress)(turn % 3);
            c.k_q15 = (uint16_t)(turn % 4 == 0 ? 0 : 1 + rng_below(random, 8191));
            c.threshold = (int32_t)(turn % 5 == 0 ? 0 : 1 + rng_below(random, 254));
            c.results_max = rooms[turn % 5];
            draw(random, 1 + i % WIDTH_MAX, 1 + i / WIDTH_MAX % HEIGHT_MAX, turn / 3 % 4);
            stream_corners(c);
            frame_corners(c, (int)(turn & 1));
            turn++;
        }
    }
}

/* ---- Refinement ---------------------------------------------------------------------------- */

static int64_t floor_div(int64_t n, int64_t d)
{
    return n >= 0 ? n / d : -((-n + d - 1) / d);
}

/* Where the edges around (x, y) cross, from there, in 1/16 pixel; 0 if nowhere within the
 * radius. */
static int crossing(int x, int y, int radius, int *x_q4, int *y_q4)
{
    int64_t a = 0, b = 0, c = 0, p = 0, q = 0, det, over_x, over_y;
    for (int dy = -radius; dy <= radius; dy++) {
        for (int dx = -radius; dx <= radius; dx++) {
            const int64_t gx = sobel(x + dx, y + dy, 0), gy = sobel(x + dx, y + dy, 1);
            a += gx * gx;
            b += gx * gy;
            c += gy * gy;
            p += gx * (gx * dx + gy * dy);
            q += gy * (gx * dx + gy * dy);
        }
    }
    det = a * c - b * b;
    over_x = c * p - b * q;
    over_y = a * q - b * p;
    if (det == 0 || llabs(over_x) > radius * det || llabs(over_y) > radius * det) {
        return 0;
    }
    *x_q4 = (int)floor_div(32 * over_x + det, 2 * det);
    *y_q4 = (int)floor_div(32 * over_y + det, 2 * det);
    return 1;
}

/* 0, and the corner as it was, if it has nowhere to go. */
static int refine_exactly(pel_corner *corner, int radius)
{
    int x = corner->x, y = corner->y, x_q4 = 0, y_q4 = 0;
    for (int step = 0, moved = 1; moved && step < 10; step++) {
        int u, v;
        if (!crossing(x, y, radius, &x_q4, &y_q4)) {
            return 0;
        }
        u = x + (int)floor_div(x_q4 + 8, 16);
        v = y + (int)floor_div(y_q4 + 8, 16);
        x_q4 += 16 * (x - u);
        y_q4 += 16 * (y - v);
        if (u < 0 || v < 0 || u >= width || v >= height || abs(u - corner->x) > radius ||
            abs(v - corner->y) > radius) {
            return 0;
        }
        moved = u != x || v != y;
        x = u;
        y = v;
    }
    corner->x = (uint16_t)x;
    corner->y = (uint16_t)y;
    corner->dx_q4 = (int8_t)x_q4;
    corner->dy_q4 = (int8_t)y_q4;
    return 1;
}

static void refinement(rng *random, uint32_t scale)
{
    check_group("refinement");
    for (uint32_t n = 0; n < 600 / scale + 5; n++) {
        const int radius = 1 + (int)(n % 5);
        pel_corner before[8], after[8];
        uint32_t refined = 0, moved = 0;
        pel_cview view;
        draw(random, 1 + (int)rng_below(random, WIDTH_MAX), 1 + (int)rng_below(random, HEIGHT_MAX),
             n % 4);
        view = spread_picture((int)(n & 1));
        for (int i = 0; i < 8; i++) {
            before[i].response = (int32_t)rng_next(random);
            before[i].x = (uint16_t)rng_below(random, (uint32_t)width);
            before[i].y = (uint16_t)rng_below(random, (uint32_t)height);
            before[i].dx_q4 = 99; /* no result has this: it shows what stayed as it was */
            before[i].dy_q4 = 99;
            after[i] = before[i];
        }
        check_that(pel_corners_refine(&view, (unsigned)radius, after, 8, &refined) == PEL_OK,
                   "refine");
        for (int i = 0; i < 8; i++) {
            moved += refine_exactly(&before[i], radius) ? 1u : 0u;
            check_that(same_corner(&before[i], &after[i]),
                       "%dx%d, radius %d: (%d + %d/16, %d + %d/16), not (%d + %d/16, %d + %d/16)",
                       width, height, radius, after[i].x, after[i].dx_q4, after[i].y,
                       after[i].dy_q4, before[i].x, before[i].dx_q4, before[i].y, before[i].dy_q4);
        }
        check_that(moved == refined, "%u refined, told %u", (unsigned)moved, (unsigned)refined);
    }
}

int main(int argc, char **argv)
{
    const uint32_t scale = check_scale(argc, argv);
    rng random = rng_seeded(11);
    every_size_of_corners(&random, scale, scale == 1 ? 4 : 1);
    refinement(&random, scale);
    guarded_free(&work);
    guarded_free(&line_buffer);
    guarded_free(&result_buffer);
    guarded_free(&frame_buffer);
    return check_finish();
}
