/* Spans and lines, worked out by hand. */
#include "unity.h"

#include <pel.h>
#include <pel/feature.h>

enum { WIDTH = 12, HEIGHT = 11, PIXELS = WIDTH * HEIGHT };

static uint8_t picture[PIXELS];
static uint32_t count;

void setUp(void)
{
    for (unsigned i = 0; i < PIXELS; i++) {
        picture[i] = 0;
    }
}

void tearDown(void)
{
}

static void put(unsigned x, unsigned y, uint8_t value)
{
    picture[y * WIDTH + x] = value;
}

static pel_view view_of(uint8_t *pixels)
{
    pel_view view;
    TEST_ASSERT_EQUAL_INT(
        PEL_OK, pel_view_init(pixels, PEL_GRAY8, PEL_RANGE_FULL, WIDTH, HEIGHT, 0, &view));
    return view;
}

static pel_cview picture_view(void)
{
    const pel_view view = view_of(picture);
    return pel_view_to_read(&view);
}

/* ---- Spans and lines ----------------------------------------------------------------------- */

static void test_scan_row(void)
{
    static const uint8_t labels[12] = {3, 3, 0, 3, 1, 3, 3, 3, 3, 0, 3, 3};
    pel_scan scan = {0};
    pel_span spans[4];

    scan.label = 3;
    TEST_ASSERT_EQUAL_UINT16(4, pel_scan_row(&scan, labels, 12, spans, 4));
    TEST_ASSERT_EQUAL_UINT16(0, spans[0].begin);
    TEST_ASSERT_EQUAL_UINT16(2, spans[0].end);
    TEST_ASSERT_EQUAL_UINT16(5, spans[2].begin);
    TEST_ASSERT_EQUAL_UINT16(9, spans[2].end);
    TEST_ASSERT_EQUAL_UINT16(12, spans[3].end);
    scan.length_min = 2;
    scan.length_max = 3;
    TEST_ASSERT_EQUAL_UINT16(2, pel_scan_row(&scan, labels, 12, spans, 1)); /* more than fit */
    TEST_ASSERT_EQUAL_UINT16(0, spans[0].begin);
    scan.x0 = 1; /* cuts the first to one pixel, the long one to three */
    scan.x1 = 8;
    TEST_ASSERT_EQUAL_UINT16(1, pel_scan_row(&scan, labels, 12, spans, 4));
    TEST_ASSERT_EQUAL_UINT16(5, spans[0].begin);
    TEST_ASSERT_EQUAL_UINT16(8, spans[0].end);
    scan.x1 = 13;
    TEST_ASSERT_EQUAL_UINT16(0, pel_scan_row(&scan, labels, 12, spans, 4));
    TEST_ASSERT_EQUAL_UINT16(0, pel_scan_row(NULL, labels, 12, spans, 4));
    TEST_ASSERT_EQUAL_UINT16(0, pel_scan_row(&scan, NULL, 12, spans, 4));
}

/* A bar from (4, 2) to (5, 8), two pixels wide, seven high. */
static void test_scan_view(void)
{
    const pel_cview view = picture_view();
    pel_point_q4 points[8];
    pel_scan scan = {0};

    for (unsigned y = 2; y < 9; y++) {
        put(4, y, 9);
        put(5, y, 9);
    }
    scan.label = 9;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_scan_view(&scan, &view, points, 8, &count));
    TEST_ASSERT_EQUAL_UINT32(7, count);
    TEST_ASSERT_EQUAL_INT32(72, points[6].x_q4); /* 4.5 */
    TEST_ASSERT_EQUAL_INT32(128, points[6].y_q4);
    TEST_ASSERT_EQUAL_INT(PEL_TRUNCATED, pel_scan_view(&scan, &view, points, 3, &count));
    TEST_ASSERT_EQUAL_UINT32(3, count);
    scan.columns = 1;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_scan_view(&scan, &view, points, 8, &count));
    TEST_ASSERT_EQUAL_UINT32(2, count);
    TEST_ASSERT_EQUAL_INT32(80, points[1].x_q4);
    TEST_ASSERT_EQUAL_INT32(80, points[1].y_q4);
    scan.x0 = 5;
    scan.x1 = 6;
    scan.y0 = 4;
    scan.y1 = HEIGHT + 1;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, pel_scan_view(&scan, &view, points, 8, &count));
    scan.y1 = HEIGHT;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_scan_view(&scan, &view, points, 8, &count));
    TEST_ASSERT_EQUAL_UINT32(1, count);
    TEST_ASSERT_EQUAL_INT32(96, points[0].y_q4); /* rows 4 to 8 */
}

static void expect_line(const pel_line *line, int32_t dx_q16, int32_t dy_q16, int32_t offset_q4)
{
    TEST_ASSERT_INT32_WITHIN(1, dx_q16, line->dx_q16);
    TEST_ASSERT_INT32_WITHIN(1, dy_q16, line->dy_q16);
    TEST_ASSERT_INT32_WITHIN(1, offset_q4, line->offset_q4);
}

static void test_line_directions(void)
{
    static const pel_point_q4 level[] = {{0, 80}, {160, 80}, {80, 80}};
    static const pel_point_q4 upright[] = {{48, 10}, {48, -70}, {48, 900}};
    static const pel_point_q4 falling[] = {{0, 0}, {1600, 1600}};
    static const pel_point_q4 rising[] = {{0, 400}, {400, 0}, {100, 300}, {300, 100}};
    static const pel_point_q4 square[] = {{0, 0}, {0, 20}, {20, 0}, {20, 20}};
    pel_line line;

    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_line_fit(level, 3, 0, 0, &line));
    expect_line(&line, 65536, 0, 80);
    TEST_ASSERT_EQUAL_INT16(0, line.angle_turn16);
    TEST_ASSERT_EQUAL_UINT16(3, line.inliers);
    TEST_ASSERT_EQUAL_INT32(0, line.x0_q4);
    TEST_ASSERT_EQUAL_INT32(160, line.x1_q4);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_line_fit(upright, 3, 0, 0, &line));
    expect_line(&line, 0, -65536, 48);
    TEST_ASSERT_EQUAL_INT16(-16384, line.angle_turn16);
    TEST_ASSERT_EQUAL_INT32(900, line.y0_q4);
    TEST_ASSERT_EQUAL_INT32(-70, line.y1_q4);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_line_fit(falling, 2, 1, 0, &line));
    expect_line(&line, 46341, 46341, 0); /* 65536 / sqrt 2 */
    TEST_ASSERT_INT16_WITHIN(2, 8192, line.angle_turn16);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_line_fit(rising, 4, 1, 2, &line));
    expect_line(&line, 46341, -46341, 283); /* 400 / sqrt 2 = 282.8 */
    TEST_ASSERT_INT16_WITHIN(2, -8192, line.angle_turn16);
    TEST_ASSERT_EQUAL_UINT16(4, line.inliers);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_line_fit(square, 4, 10, 0, &line));
    TEST_ASSERT_EQUAL_INT16(0, line.angle_turn16);
}

static void test_line_distance(void)
{
    static const pel_point_q4 level[] = {{0, 80}, {160, 80}};
    static const pel_point_q4 upright[] = {{48, 0}, {48, 100}};
    pel_line line;

    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_line_fit(level, 2, 0, 0, &line));
    TEST_ASSERT_EQUAL_INT32(20, pel_line_distance_q4(&line, 1000, 100));
    TEST_ASSERT_EQUAL_INT32(-30, pel_line_distance_q4(&line, -1000, 50));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_line_fit(upright, 2, 0, 0, &line));
    TEST_ASSERT_EQUAL_INT32(2, pel_line_distance_q4(&line, 50, 7777));
}

/* Ten points of a level line and two far from it. All together tilt; the last rounds do without the
 * two. */
static void test_line_rejects_outliers(void)
{
    pel_point_q4 points[12];
    pel_line line;

    for (int i = 0; i < 12; i++) {
        points[i].x_q4 = 16 * i;
        points[i].y_q4 = i < 10 ? 100 : 150;
    }
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_line_fit(points, 12, 4, 0, &line));
    TEST_ASSERT_TRUE(line.angle_turn16 > 1000);
    TEST_ASSERT_TRUE(line.inliers < 10);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_line_fit(points, 12, 4, 4, &line));
    TEST_ASSERT_EQUAL_INT16(0, line.angle_turn16);
    TEST_ASSERT_EQUAL_UINT16(10, line.inliers);
    TEST_ASSERT_EQUAL_INT32(100, line.offset_q4);
    TEST_ASSERT_EQUAL_INT32(144, line.x1_q4); /* the last good one */
}

static void test_line_refuses(void)
{
    static const pel_point_q4 same[] = {{5, 5}, {5, 5}, {5, 5}};
    static const pel_point_q4 ends[] = {{-131072, -131072}, {131071, 131071}};
    static const pel_point_q4 far_out[] = {{0, 0}, {131072, 0}};
    pel_line line = {0};

    line.inliers = 77;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, pel_line_fit(same, 3, 5, 1, &line));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, pel_line_fit(same, 0, 5, 1, &line));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, pel_line_fit(far_out, 2, 5, 1, &line));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, pel_line_fit(same, PEL_LINE_POINTS_MAX + 1, 5, 1, &line));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_line_fit(NULL, 2, 5, 1, &line));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_line_fit(ends, 2, 5, 1, NULL));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_line_fit(ends, 2, 5, 9, &line));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_line_fit(ends, 2, 131072, 1, &line));
    TEST_ASSERT_EQUAL_UINT16(77, line.inliers);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_line_fit(ends, 2, 5, 8, &line));
    TEST_ASSERT_EQUAL_UINT16(2, line.inliers);
    TEST_ASSERT_INT16_WITHIN(2, 8192, line.angle_turn16);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_scan_row);
    RUN_TEST(test_scan_view);
    RUN_TEST(test_line_directions);
    RUN_TEST(test_line_distance);
    RUN_TEST(test_line_rejects_outliers);
    RUN_TEST(test_line_refuses);
    return UNITY_END();
}
