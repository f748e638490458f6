/* Spans against a search pixel by pixel; lines against their neighbours: none may fit better. */
#include "feature_picture.h"

/* ---- Spans and lines ----------------------------------------------------------------------- */

static void check_scan(const pel_scan *scan, const pel_cview *view, uint32_t room)
{
    static pel_point_q4 points[PIXELS_MAX], expected[PIXELS_MAX];
    const int everywhere = scan->x1 == 0;
    const int lines = scan->columns ? width : height, length = scan->columns ? height : width;
    const int l0 = everywhere ? 0 : scan->columns ? scan->x0 : scan->y0;
    const int l1 = everywhere ? lines : scan->columns ? scan->x1 : scan->y1;
    const int i0 = everywhere ? 0 : scan->columns ? scan->y0 : scan->x0;
    const int i1 = everywhere ? length : scan->columns ? scan->y1 : scan->x1;
    uint32_t n = 0, count = 0;

    for (int l = l0; l < l1; l++) {
        int begin = -1;
        for (int i = i0; i <= i1; i++) {
            const int is =
                i < i1 && picture[scan->columns ? i * width + l : l * width + i] == scan->label;
            if (is && begin < 0) {
                begin = i;
            } else if (!is && begin >= 0) {
                const int size = i - begin, centre_q4 = 16 * begin + 8 * (size - 1);
                if (size >= scan->length_min && (!scan->length_max || size <= scan->length_max)) {
                    expected[n].x_q4 = scan->columns ? 16 * l : centre_q4;
                    expected[n++].y_q4 = scan->columns ? centre_q4 : 16 * l;
                }
                begin = -1;
            }
        }
    }
    check_that(
        pel_scan_view(scan, view, points, room, &count) == (n > room ? PEL_TRUNCATED : PEL_OK) &&
            count == (n < room ? n : room) && memcmp(points, expected, count * sizeof *points) == 0,
        "%dx%d: %u spans, not %u", width, height, (unsigned)count, (unsigned)n);
}

static void scans(rng *random, uint32_t scale)
{
    check_group("spans of rows and columns");
    for (uint32_t n = 0; n < 4000 / scale + 10; n++) {
        pel_scan scan;
        pel_cview view;
        memset(&scan, 0, sizeof scan);
        draw(random, 1 + (int)rng_below(random, WIDTH_MAX), 1 + (int)rng_below(random, HEIGHT_MAX),
             n % 3 + 1);
        view = spread_picture((int)(n & 1));
        scan.label = picture[rng_below(random, (uint32_t)(width * height))];
        scan.columns = (uint8_t)(n / 2 % 2);
        scan.length_min = (uint16_t)rng_below(random, 4);
        scan.length_max = (uint16_t)rng_below(random, 9);
        if (n % 3) {
            scan.x0 = (uint16_t)rng_below(random, (uint32_t)width);
            scan.x1 = (uint16_t)(scan.x0 + 1 + rng_below(random, (uint32_t)(width - scan.x0)));
            scan.y0 = (uint16_t)rng_below(random, (uint32_t)height);
            scan.y1 = (uint16_t)(scan.y0 + 1 + rng_below(random, (uint32_t)(height - scan.y0)));
        }
        check_scan(&scan, &view, n % 7 == 0 ? 3 : PIXELS_MAX);
    }
}

/* The sum of squared distances from the line through the mean in a direction. */
static double misfit(const pel_point_q4 *points, uint32_t count, double dx, double dy)
{
    double mean_x = 0, mean_y = 0, sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        mean_x += points[i].x_q4 / (double)count;
        mean_y += points[i].y_q4 / (double)count;
    }
    for (uint32_t i = 0; i < count; i++) {
        const double d = (points[i].y_q4 - mean_y) * dx - (points[i].x_q4 - mean_x) * dy;
        sum += d * d;
    }
    return sum;
}

/* No direction a little to either side fits better, nor does the one across. */
static void check_line(const pel_point_q4 *points, uint32_t count)
{
    const double step = 1.0 / 16384;
    pel_line line;
    double dx, dy, best;

    if (pel_line_fit(points, count, 131071, 0, &line) != PEL_OK) {
        check_that(0, "%u points: no line", (unsigned)count);
        return;
    }
    dx = line.dx_q16 / 65536.0;
    dy = line.dy_q16 / 65536.0;
    best = misfit(points, count, dx, dy) * (1 - 1e-9);
    check_that(best <= misfit(points, count, dx - step * dy, dy + step * dx) &&
                   best <= misfit(points, count, dx + step * dy, dy - step * dx) &&
                   best <= misfit(points, count, dy, -dx),
               "%u points: (%f, %f) is not best", (unsigned)count, dx, dy);
    check_that(line.inliers <= count && line.x0_q4 <= line.x1_q4, "%u points: ends",
               (unsigned)count);
}

static void lines(rng *random, uint32_t scale)
{
    static pel_point_q4 points[PEL_LINE_POINTS_MAX];
    check_group("lines: no direction fits better");
    for (uint32_t n = 0; n < 2000 / scale + 10; n++) {
        const uint32_t count = n % 50 ? 2 + rng_below(random, 40) : PEL_LINE_POINTS_MAX;
        const uint32_t wide = 1 + rng_below(random, n % 3 ? 262144 : 40);
        const uint32_t high = 1 + rng_below(random, n % 5 ? 262144 : 3);
        for (uint32_t i = 0; i < count; i++) {
            points[i].x_q4 = (int32_t)rng_below(random, wide) - 131072;
            points[i].y_q4 = (int32_t)rng_below(random, high) - 131072;
        }
        points[1].x_q4 = points[0].x_q4 + 1; /* two different ones at least */
        check_line(points, count);
    }
    check_group("lines: the largest sums");
    for (int shape = 0; shape < 6; shape++) {
        for (int i = 0; i < PEL_LINE_POINTS_MAX; i++) { /* both ends of a diagonal, of a side */
            const int32_t one = i % 2 ? 131071 : -131072;
            const int32_t rare = i == 0 ? 131071 : -131072;
            points[i].x_q4 = shape == 2 ? -131072 : shape < 4 ? one : rare;
            points[i].y_q4 = shape == 1 ? 131071 : shape == 3 ? -1 - one : shape < 4 ? one : rare;
        }
        check_line(points, PEL_LINE_POINTS_MAX);
    }
}

int main(int argc, char **argv)
{
    const uint32_t scale = check_scale(argc, argv);
    rng random = rng_seeded(11);
    scans(&random, scale);
    lines(&random, scale);
    guarded_free(&frame_buffer);
    return check_finish();
}
