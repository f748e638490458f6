/*
 * Corners, worked out by hand on small pictures.
 *
 * A single pixel of value v on black has Sobel gradients gx = -dx (2 - |dy|) v, gy = -dy (2 - |dx|)
 * v at (dx, dy) around it: a = c = 2 (1 + 4 + 1) v^2 = 12 v^2 and b = 0 at the pixel, a = 6 v^2, c
 * = 10 v^2, b = 0 to its left and right, a = c = 5 v^2, |b| = v^2 at its diagonals.
 */
#include "unity.h"

#include <pel.h>
#include <pel/feature.h>

enum { WIDTH = 12, HEIGHT = 11, PIXELS = WIDTH * HEIGHT, FOUND_MAX = 8 };

static uint8_t picture[PIXELS];
static uint32_t work[PEL_CORNERS_WORDS(WIDTH, PEL_CORNERS_FAST9)];
static pel_corner found[FOUND_MAX];
static pel_corners corners;
static pel_corners_config config;
static uint32_t count;

void setUp(void)
{
    static const pel_corners_config zero;

    for (unsigned i = 0; i < PIXELS; i++) {
        picture[i] = 0;
    }
    config = zero;
    config.width = WIDTH;
    config.height = HEIGHT;
    config.work = work;
    config.work_bytes = sizeof work;
    config.results = found;
    config.results_max = FOUND_MAX;
    count = 99;
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

static pel_status find(void)
{
    const pel_cview view = picture_view();
    return pel_corners_frame(&corners, &config, &view, &count);
}

static void expect_corner(unsigned i, unsigned x, unsigned y, int32_t response)
{
    TEST_ASSERT_EQUAL_UINT16(x, found[i].x);
    TEST_ASSERT_EQUAL_UINT16(y, found[i].y);
    TEST_ASSERT_EQUAL_INT32(response, found[i].response);
}

/* ---- Corners: sizes and refusals ----------------------------------------------------------- */

static void test_corners_sizes(void)
{
    static const uint16_t widths[] = {1, 2, 7, 320, 641, PEL_SIDE_MAX};

    for (unsigned i = 0; i < sizeof widths / sizeof widths[0]; i++) {
        const uint16_t w = widths[i];
        TEST_ASSERT_TRUE(pel_corners_bytes(w, PEL_CORNERS_HARRIS) ==
                         PEL_CORNERS_BYTES(w, PEL_CORNERS_HARRIS));
        TEST_ASSERT_TRUE(pel_corners_bytes(w, PEL_CORNERS_SHI_TOMASI) ==
                         PEL_CORNERS_BYTES(w, PEL_CORNERS_SHI_TOMASI));
        TEST_ASSERT_TRUE(pel_corners_bytes(w, PEL_CORNERS_FAST9) ==
                         PEL_CORNERS_BYTES(w, PEL_CORNERS_FAST9));
    }
    /* 5 rows of gray with 2 + 2 more, 3 of responses with 1 + 1 more */
    TEST_ASSERT_TRUE(PEL_CORNERS_BYTES(320, PEL_CORNERS_HARRIS) == 5 * 324 + 3 * 4 * 322);
    TEST_ASSERT_TRUE(PEL_CORNERS_BYTES(320, PEL_CORNERS_FAST9) == 7 * 326 + 3 * 4 * 322);
    TEST_ASSERT_TRUE(4 * PEL_CORNERS_WORDS(7, PEL_CORNERS_FAST9) >=
                     PEL_CORNERS_BYTES(7, PEL_CORNERS_FAST9));
    TEST_ASSERT_TRUE(sizeof(pel_corners) < 150);
    TEST_ASSERT_TRUE(sizeof(pel_corner) <= 12);
}

static void expect_refused(pel_status status)
{
    corners.found = 1234;
    TEST_ASSERT_EQUAL_INT(status, pel_corners_begin(&corners, &config));
    TEST_ASSERT_EQUAL_UINT32(1234, corners.found);
    setUp();
}

/* Where nothing has to be aligned, as on AVR, no memory is misaligned. */
struct element {
    char before;
    uint32_t value;
};

static void test_corners_refuse(void)
{
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_corners_begin(NULL, &config));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_corners_begin(&corners, NULL));
    config.method = PEL_CORNERS_METHOD_COUNT;
    expect_refused(PEL_ERR_ARG);
    config.suppress = (pel_corners_suppress)3;
    expect_refused(PEL_ERR_ARG);
    config.backend = PEL_BACKEND_COUNT;
    expect_refused(PEL_ERR_ARG);
    config.k_q15 = 8192;
    expect_refused(PEL_ERR_ARG);
    config.threshold = -1;
    expect_refused(PEL_ERR_ARG);
    config.method = PEL_CORNERS_FAST9;
    config.threshold = 255;
    expect_refused(PEL_ERR_ARG);
    config.work = NULL;
    expect_refused(PEL_ERR_ARG);
    if (offsetof(struct element, value) > 1) {
        config.work = (uint8_t *)work + 1;
        expect_refused(PEL_ERR_ARG);
    }
    config.results = NULL;
    expect_refused(PEL_ERR_ARG);
    config.width = 0;
    expect_refused(PEL_ERR_RANGE);
    config.height = PEL_SIDE_MAX + 1;
    expect_refused(PEL_ERR_RANGE);
    config.work_bytes = PEL_CORNERS_BYTES(WIDTH, PEL_CORNERS_HARRIS) - 1;
    expect_refused(PEL_ERR_SPACE);
    config.width = 3853; /* 65545 bytes: 9 in 16 bits */
    expect_refused(PEL_ERR_SPACE);
}

static void test_corners_order(void)
{
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_corners_begin(&corners, &config));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ORDER, pel_corners_row(&corners, 1, picture));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_corners_row(&corners, 0, NULL));
    for (uint16_t y = 0; y < HEIGHT; y++) {
        TEST_ASSERT_EQUAL_INT(PEL_ERR_ORDER, pel_corners_end(&corners, &count));
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_corners_row(&corners, y, picture));
        TEST_ASSERT_EQUAL_INT(PEL_ERR_ORDER, pel_corners_row(&corners, y, picture));
    }
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ORDER, pel_corners_row(&corners, HEIGHT, picture));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_corners_end(&corners, NULL));
    TEST_ASSERT_EQUAL_UINT32(99, count);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_corners_end(&corners, &count));
    TEST_ASSERT_EQUAL_UINT32(0, count);
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ORDER, pel_corners_end(&corners, &count));
}

static void test_corners_frame_wants_gray(void)
{
    pel_cview view = picture_view();
    view.format = PEL_RGB888;
    view.width = WIDTH / 3;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_FORMAT, pel_corners_frame(&corners, &config, &view, &count));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_corners_frame(&corners, &config, NULL, &count));
    TEST_ASSERT_EQUAL_UINT32(99, count);
}

/* ---- Corners: values ----------------------------------------------------------------------- */

/* 16^4 = 2^16. k = 1/16: (12 12 - 24 24 / 16) 2^16 / 2^14 = 432. The k of 0: (144 2^15 - 1311 576)
 * 2^16 / 2^29 = 3963456 / 2^13 = 483.8. */
static void test_harris_of_a_pixel(void)
{
    put(6, 5, 16);
    config.k_q15 = 2048;
    TEST_ASSERT_EQUAL_INT(PEL_OK, find());
    TEST_ASSERT_EQUAL_UINT32(1, count);
    expect_corner(0, 6, 5, 432);
    TEST_ASSERT_EQUAL_INT8(0, found[0].dx_q4);
    TEST_ASSERT_EQUAL_INT8(0, found[0].dy_q4);
    config.k_q15 = 0;
    TEST_ASSERT_EQUAL_INT(PEL_OK, find());
    expect_corner(0, 6, 5, 483);
}

static void test_shi_tomasi_of_a_pixel(void)
{
    put(4, 7, 255);
    config.method = PEL_CORNERS_SHI_TOMASI;
    TEST_ASSERT_EQUAL_INT(PEL_OK, find());
    TEST_ASSERT_EQUAL_UINT32(1, count);
    expect_corner(0, 4, 7, 12 * (int32_t)65025);
}

/* All around (4, 4): a = c = 12, 6 10, 5 5 with b = 1, so the smaller eigenvalues are 12, 6, 4. */
static int32_t heard[PIXELS];

static void hear(void *user, uint16_t y, const int32_t *responses)
{
    TEST_ASSERT_EQUAL_PTR(heard, user);
    for (unsigned x = 0; x < WIDTH; x++) {
        heard[y * WIDTH + x] = responses[x];
    }
}

static void test_responses_around_a_pixel(void)
{
    static const uint8_t expected[3][3] = {{4, 6, 4}, {6, 12, 6}, {4, 6, 4}};

    put(4, 4, 1);
    config.method = PEL_CORNERS_SHI_TOMASI;
    config.on_response = hear;
    config.user = heard;
    TEST_ASSERT_EQUAL_INT(PEL_OK, find());
    for (unsigned y = 0; y < 3; y++) {
        for (unsigned x = 0; x < 3; x++) {
            TEST_ASSERT_EQUAL_INT32(expected[y][x], heard[(y + 3) * WIDTH + x + 3]);
        }
    }
    TEST_ASSERT_EQUAL_INT32(0, heard[0]);
    TEST_ASSERT_EQUAL_INT32(0, heard[PIXELS - 1]);
}

/* Columns 0 0 255 255 0: |gx| = 1020 in three columns, the largest sum there is, a = 9 1020^2. With
 * no corner in it, Harris is -8191 a^2 / 2^29, rounded down: the least. The eigenvalue is 0. */
static void test_largest_sums(void)
{
    for (unsigned y = 0; y < HEIGHT; y++) {
        put(4, y, 255);
        put(5, y, 255);
    }
    config.k_q15 = 8191;
    config.on_response = hear;
    config.user = heard;
    TEST_ASSERT_EQUAL_INT(PEL_OK, find());
    TEST_ASSERT_EQUAL_UINT32(0, count);
    TEST_ASSERT_EQUAL_INT32(-1337681614, heard[5 * WIDTH + 4]);
    config.method = PEL_CORNERS_SHI_TOMASI;
    TEST_ASSERT_EQUAL_INT(PEL_OK, find());
    TEST_ASSERT_EQUAL_INT32(0, heard[5 * WIDTH + 4]);
}

/* ---- Corners: suppression and the list ----------------------------------------------------- */

/* Two pixels side by side: a = 18, c = 38, b = 0 at both, less around. */
static void test_tie_goes_to_the_first(void)
{
    put(5, 5, 10);
    put(6, 5, 10);
    config.method = PEL_CORNERS_SHI_TOMASI;
    TEST_ASSERT_EQUAL_INT(PEL_OK, find());
    TEST_ASSERT_EQUAL_UINT32(1, count);
    expect_corner(0, 5, 5, 1800);
    TEST_ASSERT_EQUAL_INT8(8, found[0].dx_q4); /* the top lies between them */
    TEST_ASSERT_EQUAL_INT8(0, found[0].dy_q4);
    config.suppress = PEL_SUPPRESS_STRICT;
    TEST_ASSERT_EQUAL_INT(PEL_OK, find());
    TEST_ASSERT_EQUAL_UINT32(0, count);
    config.suppress = PEL_SUPPRESS_NONE;
    config.threshold = 1800;
    TEST_ASSERT_EQUAL_INT(PEL_OK, find());
    TEST_ASSERT_EQUAL_UINT32(2, count);
    expect_corner(0, 5, 5, 1800);
    expect_corner(1, 6, 5, 1800);
    TEST_ASSERT_EQUAL_INT8(0, found[0].dx_q4);
    config.threshold = 1801;
    TEST_ASSERT_EQUAL_INT(PEL_OK, find());
    TEST_ASSERT_EQUAL_UINT32(0, count);
}

static void test_strongest_are_kept(void)
{
    put(2, 2, 30);
    put(9, 2, 40);
    put(2, 8, 50);
    put(9, 8, 40);
    config.method = PEL_CORNERS_SHI_TOMASI;
    TEST_ASSERT_EQUAL_INT(PEL_OK, find());
    TEST_ASSERT_EQUAL_UINT32(4, count);
    expect_corner(0, 2, 8, 30000);
    expect_corner(1, 9, 2, 19200);
    expect_corner(2, 9, 8, 19200);
    expect_corner(3, 2, 2, 10800);
    config.results_max = 2;
    TEST_ASSERT_EQUAL_INT(PEL_TRUNCATED, find());
    TEST_ASSERT_EQUAL_UINT32(2, count);
    TEST_ASSERT_EQUAL_UINT32(4, corners.found);
    TEST_ASSERT_EQUAL_UINT32(2, corners.dropped);
    expect_corner(0, 2, 8, 30000);
    expect_corner(1, 9, 2, 19200); /* not (9, 8), which is as strong but comes later */
    config.results_max = 0;
    config.results = NULL;
    TEST_ASSERT_EQUAL_INT(PEL_OK, find());
    TEST_ASSERT_EQUAL_UINT32(0, count);
    TEST_ASSERT_EQUAL_UINT32(4, corners.found);
    TEST_ASSERT_EQUAL_UINT32(0, corners.dropped);
}

/* ---- FAST-9 -------------------------------------------------------------------------------- */

/* A circle of radius 3 around (5, 5), all `base` as is the centre, and `length` pixels of it from
 * `first` on of another value. */
static void draw_arc(unsigned first, unsigned length, uint8_t base, uint8_t value)
{
    static const int8_t circle[16][2] = {{0, -3}, {1, -3},  {2, -2},  {3, -1}, {3, 0},  {3, 1},
                                         {2, 2},  {1, 3},   {0, 3},   {-1, 3}, {-2, 2}, {-3, 1},
                                         {-3, 0}, {-3, -1}, {-2, -2}, {-1, -3}};
    for (unsigned i = 0; i < PIXELS; i++) {
        picture[i] = base;
    }
    for (unsigned i = first; i < first + length; i++) {
        put((unsigned)(5 + circle[i % 16][0]), (unsigned)(5 + circle[i % 16][1]), value);
    }
}

static int32_t fast_at_centre(int32_t threshold)
{
    config.method = PEL_CORNERS_FAST9;
    config.threshold = threshold;
    config.on_response = hear;
    config.user = heard;
    TEST_ASSERT_EQUAL_INT(PEL_OK, find());
    return heard[5 * WIDTH + 5];
}

static void test_fast_arcs(void)
{
    for (unsigned first = 0; first < 16; first++) {
        draw_arc(first, 9, 100, 150); /* all differ by 50: more than t up to 49 */
        TEST_ASSERT_EQUAL_INT32(49, fast_at_centre(20));
        TEST_ASSERT_EQUAL_INT32(49, fast_at_centre(49));
        TEST_ASSERT_EQUAL_INT32(0, fast_at_centre(50));
        draw_arc(first, 9, 100, 60);
        TEST_ASSERT_EQUAL_INT32(39, fast_at_centre(1));
        draw_arc(first, 8, 100, 200);
        TEST_ASSERT_EQUAL_INT32(0, fast_at_centre(1));
        draw_arc(first, 15, 0, 255);
        TEST_ASSERT_EQUAL_INT32(254, fast_at_centre(254));
    }
    draw_arc(3, 9, 100, 120); /* 20 brighter: not more than 20, which a threshold of 0 stands for */
    TEST_ASSERT_EQUAL_INT32(0, fast_at_centre(0));
    draw_arc(3, 9, 100, 121);
    TEST_ASSERT_EQUAL_INT32(20, fast_at_centre(0));
}

/* The weakest of the best arc counts; one side bright and the other dark is no arc. */
static void test_fast_score_is_of_the_best_arc(void)
{
    draw_arc(0, 9, 100, 150);
    put(5, 2, 130);
    TEST_ASSERT_EQUAL_INT32(29, fast_at_centre(1));
    put(4, 2, 140); /* the pixel before: another arc of nine does without the one of 150 at its
                       end */
    TEST_ASSERT_EQUAL_INT32(29, fast_at_centre(1));
    put(5, 2, 150); /* 140 150 ... 150: the arc without the 140 */
    TEST_ASSERT_EQUAL_INT32(49, fast_at_centre(1));
    put(8, 5, 50);
    TEST_ASSERT_EQUAL_INT32(0, fast_at_centre(1));
}

static void test_fast_has_no_circle_at_the_border(void)
{
    config.method = PEL_CORNERS_FAST9;
    config.threshold = 1;
    put(2, 5, 255);
    put(9, 5, 255);
    put(5, 2, 255);
    put(5, 8, 255);
    TEST_ASSERT_EQUAL_INT(PEL_OK, find());
    TEST_ASSERT_EQUAL_UINT32(0, count);
    setUp();
    config.method = PEL_CORNERS_FAST9;
    put(3, 3, 255);
    put(8, 7, 255);
    TEST_ASSERT_EQUAL_INT(PEL_OK, find());
    TEST_ASSERT_EQUAL_UINT32(2, count);
    expect_corner(0, 3, 3, 254);
    expect_corner(1, 8, 7, 254);
}

/* ---- Refinement ---------------------------------------------------------------------------- */

/* Four fields meet between columns 5 and 6 and between rows 4 and 5: at (5.5, 4.5). */
static void draw_fields(void)
{
    for (unsigned i = 0; i < PIXELS; i++) {
        picture[i] = (uint8_t)((i % WIDTH < 6) == (i / WIDTH < 5) ? 200 : 40);
    }
}

static void test_refine_finds_the_crossing(void)
{
    pel_cview view;
    uint32_t refined = 0;

    draw_fields();
    view = picture_view();
    for (unsigned radius = 2; radius <= 4; radius++) {
        for (unsigned i = 0; i < 4; i++) {
            pel_corner corner = {777, 0, 0, 3, 3};
            corner.x = (uint16_t)(5 + i % 2);
            corner.y = (uint16_t)(4 + i / 2);
            TEST_ASSERT_EQUAL_INT(PEL_OK, pel_corners_refine(&view, radius, &corner, 1, &refined));
            TEST_ASSERT_EQUAL_UINT32(1, refined);
            TEST_ASSERT_EQUAL_INT(88, 16 * corner.x + corner.dx_q4);
            TEST_ASSERT_EQUAL_INT(72, 16 * corner.y + corner.dy_q4);
            TEST_ASSERT_EQUAL_INT32(777, corner.response);
        }
    }
}

static void test_refine_leaves_what_is_no_corner(void)
{
    pel_corner corner = {7, 2, 9, 3, -3};
    pel_cview view;
    uint32_t refined = 99;

    draw_fields();
    view = picture_view();
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_corners_refine(&view, 1, &corner, 1, &refined)); /* flat */
    TEST_ASSERT_EQUAL_UINT32(0, refined);
    TEST_ASSERT_EQUAL_UINT16(2, corner.x);
    TEST_ASSERT_EQUAL_UINT16(9, corner.y);
    TEST_ASSERT_EQUAL_INT8(3, corner.dx_q4);
    TEST_ASSERT_EQUAL_INT8(-3, corner.dy_q4);
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_corners_refine(&view, 0, &corner, 1, &refined));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_corners_refine(&view, 6, &corner, 1, &refined));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_corners_refine(&view, 1, NULL, 1, &refined));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_corners_refine(NULL, 1, &corner, 1, &refined));
    corner.x = WIDTH;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, pel_corners_refine(&view, 1, &corner, 1, &refined));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_corners_sizes);
    RUN_TEST(test_corners_refuse);
    RUN_TEST(test_corners_order);
    RUN_TEST(test_corners_frame_wants_gray);
    RUN_TEST(test_harris_of_a_pixel);
    RUN_TEST(test_shi_tomasi_of_a_pixel);
    RUN_TEST(test_responses_around_a_pixel);
    RUN_TEST(test_largest_sums);
    RUN_TEST(test_tie_goes_to_the_first);
    RUN_TEST(test_strongest_are_kept);
    RUN_TEST(test_fast_arcs);
    RUN_TEST(test_fast_score_is_of_the_best_arc);
    RUN_TEST(test_fast_has_no_circle_at_the_border);
    RUN_TEST(test_refine_finds_the_crossing);
    RUN_TEST(test_refine_leaves_what_is_no_corner);
    return UNITY_END();
}
