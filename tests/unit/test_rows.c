/*
 * Reading rows: whatever the format is, the same Y, U and V must come out. The scenes are small
 * enough to read: their bytes are written out in the order in which a sensor sends them.
 */
#include "unity.h"

#include <pel.h>

enum { CANARY = 0xa5 };

void setUp(void)
{
}

void tearDown(void)
{
}

static pel_format format_at(int index)
{
    return (pel_format)index;
}

/* ---- Small scenes -------------------------------------------------------------------------- */

/* Four pixels, Y 10 20 30 40, chroma (110, 210) left and (120, 220) right, in every format. */
static const uint8_t scene_y[4] = {10, 20, 30, 40};
static const uint8_t scene_u[4] = {110, 110, 120, 120};
static const uint8_t scene_v[4] = {210, 210, 220, 220};

static const uint8_t bytes_yuyv[8] = {10, 110, 20, 210, 30, 120, 40, 220};
static const uint8_t bytes_uyvy[8] = {110, 10, 210, 20, 120, 30, 220, 40};
static const uint8_t bytes_yvyu[8] = {10, 210, 20, 110, 30, 220, 40, 120};
static const uint8_t bytes_vyuy[8] = {210, 10, 110, 20, 220, 30, 120, 40};
static const uint8_t bytes_uv[4] = {110, 210, 120, 220};
static const uint8_t bytes_u[2] = {110, 120};
static const uint8_t bytes_v[2] = {210, 220};

static const pel_crow scenes[] = {
    {{bytes_yuyv, NULL, NULL}, 4, PEL_YUYV, PEL_RANGE_FULL},
    {{bytes_uyvy, NULL, NULL}, 4, PEL_UYVY, PEL_RANGE_FULL},
    {{bytes_yvyu, NULL, NULL}, 4, PEL_YVYU, PEL_RANGE_FULL},
    {{bytes_vyuy, NULL, NULL}, 4, PEL_VYUY, PEL_RANGE_FULL},
    {{scene_y, bytes_uv, NULL}, 4, PEL_NV12, PEL_RANGE_FULL},
    {{scene_y, bytes_u, bytes_v}, 4, PEL_I420, PEL_RANGE_FULL},
};

enum { SCENES = sizeof scenes / sizeof scenes[0] };

static void test_the_same_scene_in_every_ycbcr_format(void)
{
    for (unsigned s = 0; s < SCENES; s++) {
        uint8_t y[4], u[4], v[4];
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_crow_read_yuv(&scenes[s], 0, 4, PEL_RANGE_FULL, y, u, v));
        TEST_ASSERT_EQUAL_UINT8_ARRAY(scene_y, y, 4);
        TEST_ASSERT_EQUAL_UINT8_ARRAY(scene_u, u, 4);
        TEST_ASSERT_EQUAL_UINT8_ARRAY(scene_v, v, 4);
    }
}

static void test_ycbcr_rows_read_as_rgb_come_from_their_own_range(void)
{
    for (unsigned s = 0; s < SCENES; s++) {
        for (unsigned r = PEL_RANGE_FULL; r <= PEL_RANGE_LIMITED; r++) {
            pel_crow row = scenes[s];
            uint8_t rgb[12], expected[12];
            row.range = (pel_range)r;
            for (unsigned x = 0; x < 4; x++) {
                const uint8_t yuv[3] = {scene_y[x], scene_u[x], scene_v[x]};
                pel_ycbcr_to_rgb_row(yuv, &expected[3 * x], 1, row.range);
            }
            TEST_ASSERT_EQUAL_INT(PEL_OK, pel_crow_read_rgb(&row, 0, 4, rgb));
            TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, rgb, 12);
        }
    }
}

static void test_gray_has_no_chroma(void)
{
    static const uint8_t neutral[3] = {128, 128, 128};
    const pel_crow row = pel_crow_packed(scene_y, PEL_GRAY8, PEL_RANGE_LIMITED, 3);
    uint8_t y[3], u[3], v[3];
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_crow_read_yuv(&row, 0, 3, PEL_RANGE_LIMITED, y, u, v));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(scene_y, y, 3);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(neutral, u, 3);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(neutral, v, 3);
}

/* 10101 011011 00110 in bits: 5 and 6 bits become 8 by repeating the top ones. */
static void test_rgb565_in_both_byte_orders(void)
{
    static const uint8_t low_first[8] = {0x66, 0xab, 0x00, 0x00, 0xff, 0xff, 0xe0, 0x07};
    static const uint8_t high_first[8] = {0xab, 0x66, 0x00, 0x00, 0xff, 0xff, 0x07, 0xe0};
    static const uint8_t expected[12] = {0xad, 0x6d, 0x31, 0, 0, 0, 255, 255, 255, 0, 255, 0};
    const pel_crow little = pel_crow_packed(low_first, PEL_RGB565_LE, PEL_RANGE_FULL, 4);
    const pel_crow big = pel_crow_packed(high_first, PEL_RGB565_BE, PEL_RANGE_FULL, 4);
    uint8_t rgb[12];
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_crow_read_rgb(&little, 0, 4, rgb));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, rgb, 12);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_crow_read_rgb(&big, 0, 4, rgb));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, rgb, 12);
}

static void test_rgb_and_bgr_are_mirror_pictures(void)
{
    static const uint8_t forward[6] = {1, 2, 3, 4, 5, 6}, backward[6] = {3, 2, 1, 6, 5, 4};
    const pel_crow rgb_row = pel_crow_packed(forward, PEL_RGB888, PEL_RANGE_FULL, 2);
    const pel_crow bgr_row = pel_crow_packed(backward, PEL_BGR888, PEL_RANGE_FULL, 2);
    uint8_t rgb[6];
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_crow_read_rgb(&rgb_row, 0, 2, rgb));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(forward, rgb, 6);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_crow_read_rgb(&bgr_row, 0, 2, rgb));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(forward, rgb, 6);
}

/* A wall of one colour, R 200, B 50, its two greens 100 and 101 (mean 100.5, upward: 101), seen
 * through each of the four ways to lay the mosaic. */
static void test_a_flat_colour_is_the_same_in_every_bayer_phase(void)
{
    static const uint8_t mosaic[4][2][4] = {
        {{200, 100, 200, 100}, {101, 50, 101, 50}}, /* RGGB */
        {{100, 200, 100, 200}, {50, 101, 50, 101}}, /* GRBG */
        {{100, 50, 100, 50}, {200, 101, 200, 101}}, /* GBRG */
        {{50, 100, 50, 100}, {101, 200, 101, 200}}, /* BGGR */
    };
    static const uint8_t expected[6] = {200, 101, 50, 200, 101, 50};
    for (int phase = 0; phase < 4; phase++) {
        const pel_crow row = {{mosaic[phase][0], mosaic[phase][1], NULL},
                              4,
                              format_at(PEL_BAYER8_RGGB + phase),
                              PEL_RANGE_FULL};
        uint8_t rgb[6];
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_crow_read_rgb(&row, 0, 2, rgb));
        TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, rgb, 6);
        TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, pel_crow_read_rgb(&row, 0, 3, rgb));
    }
}

/* ---- Long rows ----------------------------------------------------------------------------- */

enum { LONG = 38 }; /* wider than any piece that a reader works in */

static uint8_t memory[256];

/* The same bytes taken as a row of each format in turn. */
static pel_crow long_row(int format)
{
    uint32_t state = 88172645u;
    pel_crow row = {{memory, memory + 76, memory + 152}, LONG, format_at(format), PEL_RANGE_FULL};
    for (unsigned i = 0; i < sizeof memory; i++) {
        state = state * 1664525u + 1013904223u;
        memory[i] = (uint8_t)(state >> 24);
    }
    return row;
}

static void test_colours_of_rgb_rows_are_converted_as_color_rows_are(void)
{
    for (int f = PEL_RGB565_LE; f < PEL_FORMAT_COUNT; f++) {
        const pel_crow row = long_row(f);
        const uint16_t width = pel_color_width(row.format, row.width);
        for (unsigned r = PEL_RANGE_FULL; r <= PEL_RANGE_LIMITED; r++) {
            uint8_t y[LONG], u[LONG], v[LONG], rgb[3 * LONG], yuv[3 * LONG];
            TEST_ASSERT_EQUAL_INT(PEL_OK, pel_crow_read_yuv(&row, 0, width, (pel_range)r, y, u, v));
            TEST_ASSERT_EQUAL_INT(PEL_OK, pel_crow_read_rgb(&row, 0, width, rgb));
            TEST_ASSERT_EQUAL_INT(PEL_OK, pel_rgb_to_ycbcr_row(rgb, yuv, width, (pel_range)r));
            for (unsigned x = 0; x < width; x++) {
                TEST_ASSERT_EQUAL_UINT8(yuv[3 * x], y[x]);
                TEST_ASSERT_EQUAL_UINT8(yuv[3 * x + 1], u[x]);
                TEST_ASSERT_EQUAL_UINT8(yuv[3 * x + 2], v[x]);
            }
        }
    }
}

typedef struct yuv_row {
    uint8_t y[LONG + 1], u[LONG + 1], v[LONG + 1]; /* one more for a canary */
} yuv_row;

/* Compares pixels x .. x+count-1 with the same pixels of the whole row, and what lies beyond. */
static void check_part(const pel_crow *row, uint16_t x, uint16_t count, const yuv_row *whole)
{
    yuv_row part;
    part.y[count] = part.u[count] = part.v[count] = CANARY;
    TEST_ASSERT_EQUAL_INT(PEL_OK,
                          pel_crow_read_yuv(row, x, count, PEL_RANGE_FULL, part.y, part.u, part.v));
    for (unsigned i = 0; i < count; i++) {
        TEST_ASSERT_EQUAL_UINT8(whole->y[x + i], part.y[i]);
        TEST_ASSERT_EQUAL_UINT8(whole->u[x + i], part.u[i]);
        TEST_ASSERT_EQUAL_UINT8(whole->v[x + i], part.v[i]);
    }
    TEST_ASSERT_EQUAL_HEX8(CANARY, part.y[count]);
    TEST_ASSERT_EQUAL_HEX8(CANARY, part.u[count]);
    TEST_ASSERT_EQUAL_HEX8(CANARY, part.v[count]);
}

static void test_rows_may_be_read_from_any_column_and_in_any_length(void)
{
    for (int f = 0; f < PEL_FORMAT_COUNT; f++) {
        const pel_crow row = long_row(f);
        const uint16_t width = pel_color_width(row.format, row.width);
        yuv_row whole;
        pel_crow_read_yuv(&row, 0, width, PEL_RANGE_FULL, whole.y, whole.u, whole.v);
        for (uint16_t x = 0; x <= width; x++) {
            for (uint16_t count = 0; count <= width - x; count++) {
                check_part(&row, x, count, &whole);
            }
        }
    }
}

/* Each reader of one layout does what the general one does, for its formats and for no other. */
static void test_readers_of_one_layout(void)
{
    static const struct {
        pel_reader *reader;
        int first, last;
    } of[] = {{pel_crow_read_ycbcr, PEL_GRAY8, PEL_I420},
              {pel_crow_read_rgb565, PEL_RGB565_LE, PEL_RGB565_BE},
              {pel_crow_read_rgb24, PEL_RGB888, PEL_BGR888},
              {pel_crow_read_bayer, PEL_BAYER8_RGGB, PEL_BAYER8_BGGR}};
    for (unsigned i = 0; i < sizeof of / sizeof of[0]; i++) {
        for (int f = 0; f < PEL_FORMAT_COUNT; f++) {
            const pel_status can = f >= of[i].first && f <= of[i].last ? PEL_OK : PEL_ERR_FORMAT;
            const pel_crow row = long_row(f);
            yuv_row part = {{CANARY}, {CANARY}, {CANARY}}, all = part;
            TEST_ASSERT_EQUAL_INT(can,
                                  of[i].reader(&row, 0, 0, PEL_RANGE_FULL, part.y, part.u, part.v));
            TEST_ASSERT_EQUAL_HEX8(CANARY, part.y[0]); /* no pixels: only the answer */
            TEST_ASSERT_EQUAL_INT(
                can, of[i].reader(&row, 1, 18, PEL_RANGE_FULL, part.y, part.u, part.v));
            if (can == PEL_OK) {
                pel_crow_read_yuv(&row, 1, 18, PEL_RANGE_FULL, all.y, all.u, all.v);
            }
            TEST_ASSERT_EQUAL_UINT8_ARRAY(all.y, part.y, 18);
            TEST_ASSERT_EQUAL_UINT8_ARRAY(all.u, part.u, 18);
            TEST_ASSERT_EQUAL_UINT8_ARRAY(all.v, part.v, 18);
            TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG,
                                  of[i].reader(&row, 0, 4, PEL_RANGE_FULL, part.y, part.u, NULL));
        }
    }
}

/* ---- Refusals ------------------------------------------------------------------------------ */

static void test_reading_beyond_the_row_is_refused(void)
{
    static const uint16_t bad[][2] = {{0, 5}, {1, 4}, {4, 1}, {5, 0}, {65535, 1}, {65535, 65535}};
    for (unsigned s = 0; s < SCENES; s++) {
        for (unsigned i = 0; i < sizeof bad / sizeof bad[0]; i++) {
            uint8_t out[16];
            TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE,
                                  pel_crow_read_yuv(&scenes[s], bad[i][0], bad[i][1],
                                                    PEL_RANGE_FULL, out, out + 5, out + 10));
            TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE,
                                  pel_crow_read_rgb(&scenes[s], bad[i][0], bad[i][1], out));
        }
    }
}

static void test_reading_in_the_wrong_range_is_refused_and_nothing_is_written(void)
{
    uint8_t y[4] = {CANARY}, u[4] = {CANARY}, v[4] = {CANARY};
    for (unsigned s = 0; s < SCENES; s++) {
        TEST_ASSERT_EQUAL_INT(PEL_ERR_FORMAT,
                              pel_crow_read_yuv(&scenes[s], 0, 4, PEL_RANGE_LIMITED, y, u, v));
    }
    TEST_ASSERT_EQUAL_HEX8(CANARY, y[0]);
    TEST_ASSERT_EQUAL_HEX8(CANARY, u[0]);
    TEST_ASSERT_EQUAL_HEX8(CANARY, v[0]);
}

static void test_reading_refuses_null_pointers_and_impossible_rows(void)
{
    const pel_crow odd = pel_crow_packed(bytes_yuyv, PEL_YUYV, PEL_RANGE_FULL, 3);
    const pel_crow *const good = &scenes[0];
    uint8_t a[4], b[4], c[12];
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_crow_read_yuv(NULL, 0, 4, PEL_RANGE_FULL, a, b, c));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_crow_read_yuv(good, 0, 4, PEL_RANGE_FULL, NULL, b, c));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_crow_read_yuv(good, 0, 4, PEL_RANGE_FULL, a, NULL, c));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_crow_read_yuv(good, 0, 4, PEL_RANGE_FULL, a, b, NULL));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_FORMAT, pel_crow_read_yuv(&odd, 0, 2, PEL_RANGE_FULL, a, b, c));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_crow_read_rgb(NULL, 0, 4, c));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_crow_read_rgb(good, 0, 4, NULL));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_FORMAT, pel_crow_read_rgb(&odd, 0, 2, c));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_same_scene_in_every_ycbcr_format);
    RUN_TEST(test_ycbcr_rows_read_as_rgb_come_from_their_own_range);
    RUN_TEST(test_gray_has_no_chroma);
    RUN_TEST(test_rgb565_in_both_byte_orders);
    RUN_TEST(test_rgb_and_bgr_are_mirror_pictures);
    RUN_TEST(test_a_flat_colour_is_the_same_in_every_bayer_phase);
    RUN_TEST(test_colours_of_rgb_rows_are_converted_as_color_rows_are);
    RUN_TEST(test_rows_may_be_read_from_any_column_and_in_any_length);
    RUN_TEST(test_readers_of_one_layout);
    RUN_TEST(test_reading_beyond_the_row_is_refused);
    RUN_TEST(test_reading_in_the_wrong_range_is_refused_and_nothing_is_written);
    RUN_TEST(test_reading_refuses_null_pointers_and_impossible_rows);
    return UNITY_END();
}
