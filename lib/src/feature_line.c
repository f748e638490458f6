#include "pel/feature.h"

#include "pel/fixed.h"

/* ---- Spans --------------------------------------------------------------------------------- */

/* The first span at or after `begin`; labels lie `step` bytes apart. 0 if there is none. */
static int next_span(const uint8_t *labels, ptrdiff_t step, uint8_t label, pel_span within,
                     pel_span *span)
{
    uint16_t i = within.begin;

    while (i < within.end && labels[step * i] != label) {
        i++;
    }
    span->begin = i;
    while (i < within.end && labels[step * i] == label) {
        i++;
    }
    span->end = i;
    return span->begin < span->end;
}

static int has_length(const pel_scan *scan, pel_span span)
{
    const uint16_t length = (uint16_t)(span.end - span.begin);
    return length >= scan->length_min && (scan->length_max == 0 || length <= scan->length_max);
}

static int is_everywhere(const pel_scan *scan)
{
    return scan->x0 == 0 && scan->x1 == 0 && scan->y0 == 0 && scan->y1 == 0;
}

/* The part of a row, or with `columns` of a column, to be looked at; empty if it is not inside. */
static pel_span part_to_scan(const pel_scan *scan, int columns, uint16_t length)
{
    pel_span part = {0, 0};

    if (is_everywhere(scan)) {
        part.end = length;
    } else {
        part.begin = columns ? scan->y0 : scan->x0;
        part.end = columns ? scan->y1 : scan->x1;
    }
    if (part.begin >= part.end || part.end > length) {
        part.end = part.begin;
    }
    return part;
}

uint16_t pel_scan_row(const pel_scan *scan, const uint8_t *labels, uint16_t width, pel_span *spans,
                      uint16_t spans_max)
{
    uint16_t count = 0;
    pel_span part, span;

    if (!scan || !labels || (!spans && spans_max > 0)) {
        return 0;
    }
    part = part_to_scan(scan, 0, width);
    for (; next_span(labels, 1, scan->label, part, &span); part.begin = span.end) {
        if (has_length(scan, span)) {
            if (count < spans_max) {
                spans[count] = span;
            }
            count++;
        }
    }
    return count;
}

/* A list of points with an end, and how many there would be without. */
typedef struct point_list {
    pel_point_q4 *points;
    uint32_t max, found;
} point_list;

static void add_centres(const pel_scan *scan, const pel_cview *view, uint16_t line, pel_span part,
                        point_list *list)
{
    const ptrdiff_t stride = view->stride_bytes[0];
    const uint8_t *const labels = view->plane[0] + (scan->columns ? line : stride * line);
    const ptrdiff_t step = scan->columns ? stride : 1;
    pel_span span;

    for (; next_span(labels, step, scan->label, part, &span); part.begin = span.end) {
        const int32_t centre_q4 = 8 * ((int32_t)span.begin + span.end - 1);
        const int32_t line_q4 = 16 * (int32_t)line;
        if (!has_length(scan, span)) {
            continue;
        }
        if (list->found < list->max) {
            list->points[list->found].x_q4 = scan->columns ? line_q4 : centre_q4;
            list->points[list->found].y_q4 = scan->columns ? centre_q4 : line_q4;
        }
        list->found++;
    }
}

pel_status pel_scan_view(const pel_scan *scan, const pel_cview *view, pel_point_q4 *points,
                         uint32_t points_max, uint32_t *count)
{
    const int ok = scan && count && (points || points_max == 0);
    const pel_status status = ok ? pel_cview_check(view) : PEL_ERR_ARG;
    pel_span lines, part;
    point_list list = {0};

    if (status != PEL_OK) {
        return status;
    }
    if (view->format != PEL_GRAY8) {
        return PEL_ERR_FORMAT;
    }
    part = part_to_scan(scan, scan->columns, scan->columns ? view->height : view->width);
    lines = part_to_scan(scan, !scan->columns, scan->columns ? view->width : view->height);
    if (part.begin == part.end || lines.begin == lines.end) {
        return PEL_ERR_RANGE;
    }
    list.points = points;
    list.max = points_max;
    for (uint16_t i = lines.begin; i < lines.end; i++) {
        add_centres(scan, view, i, part, &list);
    }
    *count = list.found < points_max ? list.found : points_max;
    return list.found > points_max ? PEL_TRUNCATED : PEL_OK;
}

/* ---- Lines --------------------------------------------------------------------------------- */

/* value / 2^16, halves upward. */
static int32_t round_q16(int64_t value)
{
    const int64_t v = value + 0x8000;
    return (int32_t)(v >= 0 ? v >> 16 : ~(~v >> 16));
}

/* 2^16 part / whole, rounded to nearest, digit by digit; part <= whole < 2^31. */
static int32_t ratio_q16(uint32_t part, uint32_t whole)
{
    uint32_t quotient = 0;

    for (unsigned i = 0; i <= 16; i++) {
        quotient <<= 1;
        if (part >= whole) {
            part -= whole;
            quotient |= 1u;
        }
        part <<= 1;
    }
    return (int32_t)(part >= whole ? quotient + 1 : quotient);
}

static uint32_t size_of(int32_t value)
{
    return (uint32_t)(value < 0 ? -value : value);
}

int32_t pel_line_distance_q4(const pel_line *line, int32_t x_q4, int32_t y_q4)
{
    const int32_t x = x_q4 - line->x_q4, y = y_q4 - line->y_q4;
    return round_q16((int64_t)y * line->dx_q16 - (int64_t)x * line->dy_q16);
}

static int is_near(const pel_line *line, const pel_point_q4 *p, uint32_t distance_q4)
{
    return size_of(pel_line_distance_q4(line, p->x_q4, p->y_q4)) <= distance_q4;
}

/* The points that count, and what is summed up over them. */
typedef struct selection {
    const pel_point_q4 *points;
    uint32_t count;
    const pel_line *near; /* only points near this line; NULL: all */
    uint32_t distance_q4;
} selection;

static int is_selected(const selection *s, uint32_t i)
{
    return !s->near || is_near(s->near, &s->points[i], s->distance_q4);
}

/* The rounded mean. Differences from the first point are under 2^18, of 4096 points their sum is
 * under 2^30. Returns how many points there are. */
static int32_t find_mean(const selection *s, pel_point_q4 *mean)
{
    int32_t n = 0, sum_x = 0, sum_y = 0;

    for (uint32_t i = 0; i < s->count; i++) {
        if (is_selected(s, i)) {
            sum_x += s->points[i].x_q4 - s->points[0].x_q4;
            sum_y += s->points[i].y_q4 - s->points[0].y_q4;
            n++;
        }
    }
    if (n > 0) {
        mean->x_q4 = s->points[0].x_q4 + pel_round_div(sum_x, n);
        mean->y_q4 = s->points[0].y_q4 + pel_round_div(sum_y, n);
    }
    return n;
}

/* n times the second central moments, exact: 2^12 * 2^48. */
typedef struct moments {
    int64_t xx, xy, yy;
} moments;

/* Around the rounded mean, so the sums of x and y are at most n / 2 and those of squares under
 * 2^48. */
static moments find_moments(const selection *s, const pel_point_q4 *mean, int32_t n)
{
    moments m = {0, 0, 0};
    int32_t sum_x = 0, sum_y = 0;

    for (uint32_t i = 0; i < s->count; i++) {
        if (is_selected(s, i)) {
            const int32_t x = s->points[i].x_q4 - mean->x_q4, y = s->points[i].y_q4 - mean->y_q4;
            sum_x += x;
            sum_y += y;
            m.xx += (int64_t)x * x;
            m.xy += (int64_t)x * y;
            m.yy += (int64_t)y * y;
        }
    }
    m.xx = m.xx * n - (int64_t)sum_x * sum_x;
    m.xy = m.xy * n - (int64_t)sum_x * sum_y;
    m.yy = m.yy * n - (int64_t)sum_y * sum_y;
    return m;
}

/* Both stretched or shrunk by the same power of two until the larger one is in 2^29 .. 2^30 - 1;
 * not both are 0. */
static void normalise(int64_t a, int64_t b, int32_t *small_a, int32_t *small_b)
{
    uint64_t p = (uint64_t)(a < 0 ? -a : a), q = (uint64_t)(b < 0 ? -b : b);

    while ((p | q) >> 30) {
        p >>= 1;
        q >>= 1;
    }
    while (!((p | q) >> 29)) {
        p <<= 1;
        q <<= 1;
    }
    *small_a = a < 0 ? -(int32_t)p : (int32_t)p;
    *small_b = b < 0 ? -(int32_t)q : (int32_t)q;
}

/*
 * The long axis: the eigenvector of the larger eigenvalue. With a = xx - yy, b = 2 xy and l =
 * sqrt(a^2 + b^2) it is (l + a, b) and as well (|b|, (l - a) sign b); the one is used that adds,
 * not subtracts.
 */
static void set_direction(const moments *m, pel_line *line)
{
    int32_t a, b, angle;
    uint32_t l, across, along, length;
    int down;

    line->dx_q16 = 65536;
    line->dy_q16 = 0;
    line->angle_turn16 = 0;
    if (m->xx == m->yy && m->xy == 0) {
        return;
    }
    normalise(m->xx - m->yy, 2 * m->xy, &a, &b);
    l = pel_isqrt64((uint64_t)((int64_t)a * a) + (uint64_t)((int64_t)b * b));
    across = (a >= 0 ? l + (uint32_t)a : size_of(b)) >> 2; /* l + |a| < 2^32; now under 2^30 */
    along = (a >= 0 ? size_of(b) : l + size_of(a)) >> 2;
    down = b > 0;
    length = pel_isqrt64((uint64_t)across * across + (uint64_t)along * along);
    line->dx_q16 = ratio_q16(across, length);
    line->dy_q16 = ratio_q16(along, length);
    if (!down || line->dx_q16 == 0) {
        line->dy_q16 = -line->dy_q16;
    }
    angle = pel_atan2_turn16(down ? (int32_t)along : -(int32_t)along, (int32_t)across);
    angle = angle > 16383 ? 16383 : angle;
    line->angle_turn16 = (int16_t)(line->dx_q16 == 0 ? -16384 : angle);
}

/* 0 if there are not two different points. */
static int fit(const selection *s, pel_line *line)
{
    pel_point_q4 mean = {0, 0};
    const int32_t n = find_mean(s, &mean);
    moments m;

    if (n < 2) {
        return 0;
    }
    m = find_moments(s, &mean, n);
    if (m.xx + m.yy == 0) {
        return 0;
    }
    line->x_q4 = mean.x_q4;
    line->y_q4 = mean.y_q4;
    set_direction(&m, line);
    return 1;
}

/* Inliers, ends and offset of a line that has a place and a direction. Coordinates < 2^18 and
 * directions <= 2^16 make products < 2^35. */
static void complete(const pel_point_q4 *points, uint32_t count, uint32_t distance_q4,
                     pel_line *line)
{
    const int64_t dx = line->dx_q16, dy = line->dy_q16;
    int32_t first = 0, last = 0;

    line->inliers = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (is_near(line, &points[i], distance_q4)) {
            const int32_t x = points[i].x_q4 - line->x_q4, y = points[i].y_q4 - line->y_q4;
            const int32_t t = round_q16(dx * x + dy * y);
            first = line->inliers == 0 || t < first ? t : first;
            last = line->inliers == 0 || t > last ? t : last;
            line->inliers++;
        }
    }
    line->x0_q4 = line->x_q4 + round_q16(dx * first);
    line->y0_q4 = line->y_q4 + round_q16(dy * first);
    line->x1_q4 = line->x_q4 + round_q16(dx * last);
    line->y1_q4 = line->y_q4 + round_q16(dy * last);
    line->offset_q4 = round_q16(dx * line->y_q4 - dy * line->x_q4);
}

static int in_range(int32_t coordinate)
{
    return coordinate >= -PEL_LINE_COORDINATE_MAX_Q4 - 1 &&
           coordinate <= PEL_LINE_COORDINATE_MAX_Q4;
}

static pel_status check_points(const pel_point_q4 *points, uint32_t count)
{
    if (count > PEL_LINE_POINTS_MAX) {
        return PEL_ERR_RANGE;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (!in_range(points[i].x_q4) || !in_range(points[i].y_q4)) {
            return PEL_ERR_RANGE;
        }
    }
    return PEL_OK;
}

enum { ROUNDS_MAX = 8 };

/* No enum: an int has 16 bits on some machines. */
static const uint32_t distance_max_q4 = 131071;

pel_status pel_line_fit(const pel_point_q4 *points, uint32_t count, uint32_t distance_q4,
                        unsigned rounds, pel_line *line)
{
    const int ok = points && line && rounds <= ROUNDS_MAX && distance_q4 <= distance_max_q4;
    const pel_status status = ok ? check_points(points, count) : PEL_ERR_ARG;
    selection s = {0};
    pel_line best = {0};

    if (status != PEL_OK) {
        return status;
    }
    s.points = points;
    s.count = count;
    if (!fit(&s, &best)) {
        return PEL_ERR_RANGE;
    }
    for (unsigned left = rounds; left > 0; left--) {
        const pel_line wide = best;
        s.near = &wide;
        s.distance_q4 = distance_q4 << (left - 1);
        (void)fit(&s, &best);
    }
    complete(points, count, distance_q4, &best);
    *line = best;
    return PEL_OK;
}
