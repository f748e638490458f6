/* Corners to a part of a pixel: where the edges around them cross. */
#include "pel/feature.h"

#include "feature_window.h"

enum { STEPS_MAX = 10 };

/*
 * 16 numerator / determinant rounded to nearest, halves upward, which must be within 16 radius <=
 * 80. The quotient is made positive and found bit by bit: (32 numerator + determinant) / (2
 * determinant) + 80 < 2^8, and 2^8 times twice the determinant is under 2^62.
 */
static int32_t quotient_q4(int64_t numerator, int64_t determinant)
{
    int64_t rest = 32 * numerator + determinant + 160 * determinant;
    int32_t quotient = 0;

    for (int bit = 7; bit >= 0; bit--) {
        const int64_t part = determinant * ((int64_t)2 << bit);
        if (rest >= part) {
            rest -= part;
            quotient += (int32_t)1 << bit;
        }
    }
    return quotient - 80;
}

/* Where the edges cross, from the centre, in 1/16 pixel; 0 if nowhere within the radius. */
static int solve(const pel_row_pull *p, int32_t radius, int32_t *x_q4, int32_t *y_q4)
{
    const int64_t determinant = (int64_t)p->xx * p->yy - (int64_t)p->xy * p->xy;
    const int64_t x = (int64_t)p->yy * p->to_x - (int64_t)p->xy * p->to_y;
    const int64_t y = (int64_t)p->xx * p->to_y - (int64_t)p->xy * p->to_x;
    const int64_t most = determinant * radius;

    if (determinant == 0 || x > most || x < -most || y > most || y < -most) {
        return 0;
    }
    *x_q4 = quotient_q4(x, determinant);
    *y_q4 = quotient_q4(y, determinant);
    return 1;
}

/* The pixel that a place relative to another pixel lies in, -80 <= q4 <= 80. */
static int32_t whole_px(int32_t q4)
{
    return (q4 + 8 + 16 * 8) / 16 - 8;
}

static int is_within(const pel_cview *view, const pel_corner *from, int32_t radius, int32_t x,
                     int32_t y)
{
    return x >= 0 && y >= 0 && x < view->width && y < view->height && x - from->x <= radius &&
           from->x - x <= radius && y - from->y <= radius && from->y - y <= radius;
}

/* A step from the pixel at *x, *y to the one that the crossing lies in, which becomes *x, *y, and
 * the rest of the way. Returns whether there is one. */
static int step(const pel_cview *view, int32_t radius, int32_t *x, int32_t *y, int32_t *x_q4,
                int32_t *y_q4)
{
    const pel_row_pull p = pel_window_pull(view, *x, *y, radius);
    int32_t dx, dy;

    if (!solve(&p, radius, x_q4, y_q4)) {
        return 0;
    }
    dx = whole_px(*x_q4);
    dy = whole_px(*y_q4);
    *x += dx;
    *y += dy;
    *x_q4 -= 16 * dx;
    *y_q4 -= 16 * dy;
    return 1;
}

static int refine(const pel_cview *view, int32_t radius, pel_corner *corner)
{
    int32_t x = corner->x, y = corner->y, x_q4 = 0, y_q4 = 0;

    for (int i = 0, settled = 0; i < STEPS_MAX && !settled; i++) {
        const int32_t last_x = x, last_y = y;
        if (!step(view, radius, &x, &y, &x_q4, &y_q4) || !is_within(view, corner, radius, x, y)) {
            return 0;
        }
        settled = x == last_x && y == last_y;
    }
    corner->x = (uint16_t)x;
    corner->y = (uint16_t)y;
    corner->dx_q4 = (int8_t)x_q4;
    corner->dy_q4 = (int8_t)y_q4;
    return 1;
}

pel_status pel_corners_refine(const pel_cview *view, unsigned radius, pel_corner *corners,
                              uint32_t count, uint32_t *refined)
{
    const int ok =
        (corners || count == 0) && refined && radius >= 1 && radius <= PEL_WINDOW_RADIUS_MAX;
    const pel_status status = ok ? pel_cview_check(view) : PEL_ERR_ARG;

    if (status != PEL_OK) {
        return status;
    }
    if (view->format != PEL_GRAY8) {
        return PEL_ERR_FORMAT;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (corners[i].x >= view->width || corners[i].y >= view->height) {
            return PEL_ERR_RANGE;
        }
    }
    *refined = 0;
    for (uint32_t i = 0; i < count; i++) {
        *refined += refine(view, (int32_t)radius, &corners[i]) ? 1u : 0u;
    }
    return PEL_OK;
}
