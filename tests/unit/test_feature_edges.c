/* Canny's edges and hysteresis, worked out by hand on small pictures. */
#include "unity.h"

#include <pel.h>
#include <pel/feature.h>

enum { WIDTH = 12, HEIGHT = 11, PIXELS = WIDTH * HEIGHT };

static uint8_t picture[PIXELS], map[PIXELS];

void setUp(void)
{
    for (unsigned i = 0; i < PIXELS; i++) {
        picture[i] = 0;
        map[i] = 0;
    }
}

void tearDown(void)
{
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

/* ---- Edges --------------------------------------------------------------------------------- */

static uint16_t canny_work[PEL_CANNY_WORDS(WIDTH)];

static pel_canny_config canny_config(uint16_t low, uint16_t high)
{
    pel_canny_config c = {0};
    c.width = WIDTH;
    c.height = HEIGHT;
    c.low = low;
    c.high = high;
    c.work = canny_work;
    c.work_bytes = sizeof canny_work;
    return c;
}

static void find_edges(uint16_t low, uint16_t high)
{
    const pel_canny_config c = canny_config(low, high);
    const pel_cview src = picture_view();
    const pel_view dst = view_of(map);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_canny_frame(&c, &src, &dst));
}

static void test_canny_sizes(void)
{
    static const uint16_t widths[] = {1, 2, 7, 320, 641, PEL_SIDE_MAX};

    for (unsigned i = 0; i < sizeof widths / sizeof widths[0]; i++) {
        TEST_ASSERT_TRUE(pel_canny_bytes(widths[i]) == PEL_CANNY_BYTES(widths[i]));
    }
    TEST_ASSERT_TRUE(PEL_CANNY_BYTES(320) == 3 * 322 + 3 * 2 * 322); /* gray, gradients */
    TEST_ASSERT_TRUE(2 * PEL_CANNY_WORDS(7) >= PEL_CANNY_BYTES(7));
    TEST_ASSERT_TRUE(sizeof(pel_canny) < 60);
}

/* A step of 200 has gx = 800 on both sides of it; of two equal ones the left or upper is the
 * edge. */
static void test_canny_of_a_step(void)
{
    for (unsigned i = 0; i < PIXELS; i++) {
        picture[i] = i % WIDTH < 4 ? 10 : 210;
    }
    find_edges(100, 799);
    for (unsigned i = 0; i < PIXELS; i++) {
        TEST_ASSERT_EQUAL_UINT8(i % WIDTH == 3 ? PEL_CANNY_STRONG : PEL_CANNY_NONE, map[i]);
    }
    find_edges(799, 800);
    TEST_ASSERT_EQUAL_UINT8(PEL_CANNY_WEAK, map[5 * WIDTH + 3]);
    find_edges(800, 800);
    TEST_ASSERT_EQUAL_UINT8(PEL_CANNY_NONE, map[5 * WIDTH + 3]);
    for (unsigned i = 0; i < PIXELS; i++) {
        picture[i] = i / WIDTH < 6 ? 210 : 10;
    }
    find_edges(0, 100);
    for (unsigned i = 0; i < PIXELS; i++) {
        TEST_ASSERT_EQUAL_UINT8(i / WIDTH == 5 ? PEL_CANNY_STRONG : PEL_CANNY_NONE, map[i]);
    }
}

/* Black above the falling diagonal, white from it on. On it and just above it |gx| = |gy| = 3 v,
 * one pixel further away v: both lie on the diagonal of their neighbours, neither is stronger than
 * the other there. */
static void test_canny_of_a_diagonal(void)
{
    for (unsigned i = 0; i < PIXELS; i++) {
        picture[i] = i / WIDTH >= i % WIDTH ? 100 : 0;
    }
    find_edges(400, 500);
    for (unsigned i = 3; i < 8; i++) {
        TEST_ASSERT_EQUAL_UINT8(PEL_CANNY_STRONG, map[i * WIDTH + i]);
        TEST_ASSERT_EQUAL_UINT8(PEL_CANNY_STRONG, map[i * WIDTH + i + 1]);
        TEST_ASSERT_EQUAL_UINT8(PEL_CANNY_NONE, map[i * WIDTH + i + 2]);
        TEST_ASSERT_EQUAL_UINT8(PEL_CANNY_NONE, map[i * WIDTH + i - 1]);
    }
}

/* At (6, 5) gx = 816 and gy = 338: 32768 gy is just over 13573 gx, so the lower right neighbour
 * counts. It is as strong, 1154, and the pixel is no maximum. With gy = 336 left and right count:
 * it is one. */
static void test_canny_sectors_meet_at_13573(void)
{
    static const uint8_t around[4][3] = {{0, 0, 51}, {0, 255, 255}, {0, 67, 255}, {0, 255, 0}};

    for (unsigned i = 0; i < 12; i++) {
        picture[(4 + i / 3) * WIDTH + 5 + i % 3] = around[i / 3][i % 3];
    }
    find_edges(100, 200);
    TEST_ASSERT_EQUAL_UINT8(PEL_CANNY_NONE, map[5 * WIDTH + 6]);
    picture[6 * WIDTH + 6] = 66;
    find_edges(100, 200);
    TEST_ASSERT_EQUAL_UINT8(PEL_CANNY_STRONG, map[5 * WIDTH + 6]);
}

/* Where nothing has to be aligned, as on AVR, no memory is misaligned. */
struct element {
    char before;
    uint16_t value;
};

static void test_canny_refuses(void)
{
    pel_canny canny;
    pel_canny_config c = canny_config(5, 4);
    uint8_t row[WIDTH];

    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_canny_begin(&canny, &c));
    c = canny_config(100, 200);
    c.backend = PEL_BACKEND_COUNT;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_canny_begin(&canny, &c));
    c = canny_config(1, 2);
    if (offsetof(struct element, value) > 1) {
        c.work = (uint8_t *)canny_work + 1;
        TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_canny_begin(&canny, &c));
    }
    c = canny_config(1, 2);
    c.work_bytes = PEL_CANNY_BYTES(WIDTH) - 1;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_SPACE, pel_canny_begin(&canny, &c));
    c = canny_config(1, 2);
    c.width = 7280; /* 65538 bytes: 2 in 16 bits */
    TEST_ASSERT_EQUAL_INT(PEL_ERR_SPACE, pel_canny_begin(&canny, &c));
    c = canny_config(1, 2);
    c.height = 0;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, pel_canny_begin(&canny, &c));
    c.height = 3;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_canny_begin(&canny, &c));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ORDER, pel_canny_pull(&canny, row));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_canny_push(&canny, picture));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_canny_push(&canny, picture));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ORDER, pel_canny_pull(&canny, row));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_canny_push(&canny, picture));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ORDER, pel_canny_push(&canny, picture));
    for (unsigned y = 0; y < 3; y++) {
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_canny_pull(&canny, row));
    }
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ORDER, pel_canny_pull(&canny, row));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ORDER, pel_canny_push(&canny, picture));
}

static void test_canny_frame_refuses_overlap(void)
{
    const pel_canny_config c = canny_config(1, 2);
    const pel_view whole = view_of(picture), other = view_of(map);
    pel_view upper, lower;
    pel_cview src;

    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_view_crop(&whole, 0, WIDTH, 0, 8, &upper));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_view_crop(&whole, 0, WIDTH, 1, 9, &lower));
    src = pel_view_to_read(&upper);
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_canny_frame(&c, &src, &lower));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_SPACE, pel_canny_frame(&c, &src, &other));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_canny_frame(&c, &src, &upper));
}

/* ---- Hysteresis ---------------------------------------------------------------------------- */

/* s strong, w weak, x another value; what should stay is upper case. */
static const char chains[HEIGHT][WIDTH + 1] = {
    "WWW.........", /* the strong one at the far end of a chain that goes back up */
    "...W..w.w...", "....W..w.w..", "...W......w.", "..W...WWW...", ".W...W...W..",
    "W....W...S..", ".W....W.....", "..WWWW......", "w........x..", "ww........ww",
};

static void put_chains(void)
{
    for (unsigned i = 0; i < PIXELS; i++) {
        const char c = chains[i / WIDTH][i % WIDTH];
        map[i] = (uint8_t)(c == '.'   ? PEL_CANNY_NONE
                           : c == 'x' ? 7
                           : c == 'S' ? PEL_CANNY_STRONG
                                      : PEL_CANNY_WEAK);
    }
}

static void expect_chains(void)
{
    for (unsigned i = 0; i < PIXELS; i++) {
        const char c = chains[i / WIDTH][i % WIDTH];
        TEST_ASSERT_EQUAL_UINT8(c == 'x'               ? 7
                                : c == 'S' || c == 'W' ? PEL_CANNY_STRONG
                                                       : PEL_CANNY_NONE,
                                map[i]);
    }
}

static void test_hysteresis_follows_chains(void)
{
    static pel_place stack[30];
    const pel_view view = view_of(map);

    for (uint32_t places = 0; places <= 30; places += 1 + places) {
        put_chains();
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_canny_hysteresis(&view, stack, places));
        expect_chains();
    }
    put_chains();
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_canny_hysteresis(&view, NULL, 0));
    expect_chains();
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_canny_hysteresis(&view, NULL, 1));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_canny_hysteresis(NULL, stack, 1));
}

static void link(const char *above, const char *row, const char *below, const char *expected)
{
    uint8_t rows[3][8];
    const char *const text[3] = {above, row, below};

    for (unsigned i = 0; i < 24; i++) {
        const char c = text[i / 8] ? text[i / 8][i % 8] : '.';
        rows[i / 8][i % 8] = c == 'S' ? PEL_CANNY_STRONG : c == 'w' ? PEL_CANNY_WEAK : 0;
    }
    TEST_ASSERT_EQUAL_INT(
        PEL_OK, pel_canny_link_row(above ? rows[0] : NULL, below ? rows[2] : NULL, 8, rows[1]));
    for (unsigned x = 0; x < 8; x++) {
        TEST_ASSERT_EQUAL_UINT8(expected[x] == 'S' ? PEL_CANNY_STRONG : 0, rows[1][x]);
    }
}

static void test_link_row(void)
{
    uint8_t row[1] = {PEL_CANNY_WEAK};

    link(NULL, "ww.wSw.w", NULL, "...SSS..");
    link("S.......", ".ww..ww.", "......wS", ".SS..SS.");
    link("..S.....", "ww..ww.w", "........", "SS......");
    link("...w....", "wwwwwwww", "....w...", "........"); /* weak ones below are not known to
                                                             stay */
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_canny_link_row(NULL, NULL, 8, NULL));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, pel_canny_link_row(NULL, NULL, 0, row));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_canny_link_row(NULL, NULL, 1, row));
    TEST_ASSERT_EQUAL_UINT8(0, row[0]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_canny_sizes);
    RUN_TEST(test_canny_of_a_step);
    RUN_TEST(test_canny_of_a_diagonal);
    RUN_TEST(test_canny_sectors_meet_at_13573);
    RUN_TEST(test_canny_refuses);
    RUN_TEST(test_canny_frame_refuses_overlap);
    RUN_TEST(test_hysteresis_follows_chains);
    RUN_TEST(test_link_row);
    return UNITY_END();
}
