/*
 * The row kernels that the compiler's flags choose, DSP or Helium, against plain C, bit for bit:
 * every width up to more than two vectors and a few long ones, every alignment, patterns of several
 * kinds, and guards around the results. A suite like those of tests/unit, so that it runs on
 * emulated boards, and its hash is the same on all. Where there is plain C alone both sides are the
 * same, and it says nothing else.
 */
#include "unity.h"

#include <pel.h>

#include "row/row_filter_best.h"
#include "row/row_select.h"
#include "row/row_select_runs.h"

enum { WIDTH_MAX = 328, SHORT_MAX = 72, OFFSETS = 4, STYLES = 6, GUARD = 16, CANARY = 0xA5 };

static uint8_t bytes[3][OFFSETS + 4 * WIDTH_MAX], plain[4 * WIDTH_MAX];
static uint8_t room[GUARD + OFFSETS + 4 * WIDTH_MAX + GUARD];
static uint16_t plain_edges[2 * (WIDTH_MAX + 1)], fast_edges[2 * (WIDTH_MAX + 1) + GUARD];
static pel_boxes classes;
static uint32_t state;

void setUp(void)
{
    state = 2718;
}

void tearDown(void)
{
}

static uint32_t random_bits(void)
{
    state = state * UINT32_C(1664525) + UINT32_C(1013904223);
    return state >> 8;
}

static void fill(void *memory, size_t count)
{
    uint8_t *const at = memory;
    for (size_t i = 0; i < count; i++) {
        at[i] = CANARY;
    }
}

/* Noise, black and white, a ramp, one value, sparse pixels, stretches of 1 to 64 bytes. */
static void draw(unsigned style)
{
    uint8_t value = 0;
    unsigned left = 0;

    for (unsigned row = 0; row < 3; row++) {
        for (unsigned x = 0; x < sizeof bytes[0]; x++) {
            const uint32_t r = random_bits();
            if (left == 0) {
                left = 1 + r % 64;
                value = (uint8_t)(r >> 6);
            }
            left--;
            bytes[row][x] = (uint8_t)(style == 0   ? r
                                      : style == 1 ? (r & 1 ? 255 : 0)
                                      : style == 2 ? 3 * x
                                      : style == 3 ? 255
                                      : style == 4 ? (r % 16 == 0 ? r >> 8 : 0)
                                                   : value);
        }
    }
}

/* Eight boxes, some of which reach the ends of the scale. */
static void draw_classes(void)
{
    static const pel_boxes none;
    classes = none;
    for (unsigned c = 0; c < 8; c++) {
        uint8_t side[6];
        pel_color_box box;
        for (unsigned i = 0; i < 6; i++) {
            const uint32_t r = random_bits();
            side[i] = (uint8_t)(r % 4 == 0 ? (i % 2 == 0 ? 0 : 255) : r >> 8);
        }
        box.y_min = side[0];
        box.y_max = side[1];
        box.u_min = side[2];
        box.u_max = side[3];
        box.v_min = side[4];
        box.v_max = side[5];
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_boxes_set(&classes, c, &box));
    }
}

/* The place of a result, with guards on both sides. */
static uint8_t *guarded(unsigned offset)
{
    fill(room, sizeof room);
    return room + GUARD + offset;
}

static void expect_guarded(const uint8_t *expected, unsigned offset, size_t count)
{
    TEST_ASSERT_EACH_EQUAL_UINT8(CANARY, room, GUARD + offset);
    if (count > 0) {
        TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, room + GUARD + offset, (uint16_t)count);
    }
    TEST_ASSERT_EACH_EQUAL_UINT8(CANARY, room + GUARD + offset + count, GUARD);
}

/* Calls with every width, offset and style. */
static void visit(void (*compare)(uint16_t width, unsigned offset))
{
    for (unsigned style = 0; style < STYLES; style++) {
        for (uint16_t width = 0; width <= SHORT_MAX; width++) {
            draw(style);
            compare(width, width % OFFSETS);
            compare(width, random_bits() % OFFSETS);
        }
        for (uint16_t width = WIDTH_MAX - 16; width <= WIDTH_MAX - 4; width++) {
            draw(style);
            compare(width, width % OFFSETS);
        }
    }
}

/* ---- From pixels to runs ------------------------------------------------------------------- */

/* The four orders of packed 4:2:2, both of NV12, I420 and gray, and pairs that are none of these. */
enum { LAYOUTS = 9 };

static pel_row_pairs pairs_of(unsigned layout, unsigned offset)
{
    const uint8_t *const a = bytes[0] + offset, *const b = bytes[1] + offset;
    const pel_row_pairs all[LAYOUTS] = {
        {a, a + 1, a + 3, 2, 4}, {a, a + 3, a + 1, 2, 4}, {a + 1, a, a + 2, 2, 4},
        {a + 1, a + 2, a, 2, 4}, {a, b, b + 1, 1, 2},     {a, b + 1, b, 1, 2},
        {a, b, bytes[2], 1, 1},  {a, b, b, 1, 0},         {a, b + 1, bytes[2], 2, 4},
    };
    return all[layout];
}

static void compare_labels(uint16_t width, unsigned offset)
{
    const pel_row_boxes boxes = {classes.y, classes.u, classes.v};

    for (unsigned layout = 0; layout < LAYOUTS; layout++) {
        const pel_row_pairs pairs = pairs_of(layout, offset);
        draw_classes();
        pel_row_classify_pairs(&boxes, &pairs, width, plain);
        PEL_BEST_CLASSIFY_PAIRS(&boxes, &pairs, width, guarded(offset));
        expect_guarded(plain, offset, width);
    }
}

static void test_labels(void)
{
    visit(compare_labels);
}

static void expect_runs(uint16_t width, uint16_t expected, uint16_t count)
{
    TEST_ASSERT_EQUAL_UINT(expected, count);
    if (count > 0) {
        TEST_ASSERT_EQUAL_UINT16_ARRAY(plain_edges, fast_edges, 2 * count);
    }
    for (unsigned i = 2u * (width + 1u); i < 2u * (width + 1u) + GUARD; i++) {
        TEST_ASSERT_EQUAL_HEX16(0xA5A5, fast_edges[i]);
    }
}

static void compare_runs(uint16_t width, unsigned offset)
{
    const pel_row_boxes boxes = {classes.y, classes.u, classes.v};

    for (unsigned layout = 0; layout < LAYOUTS; layout++) {
        const pel_row_pairs pairs = pairs_of(layout, offset);
        uint8_t *const labels = guarded(offset);
        uint16_t expected, count;
        draw_classes();
        expected = pel_row_classify_runs(&boxes, &pairs, width, plain, plain_edges);
        fill(fast_edges, sizeof fast_edges);
        count = PEL_BEST_CLASSIFY_RUNS(&boxes, &pairs, width, labels, fast_edges);
        expect_runs(width, expected, count);
        for (unsigned i = 0; i < count; i++) {
            TEST_ASSERT_EQUAL_UINT8(plain[fast_edges[2 * i]], labels[fast_edges[2 * i]]);
        }
        TEST_ASSERT_EACH_EQUAL_UINT8(CANARY, room, GUARD + offset);
        TEST_ASSERT_EACH_EQUAL_UINT8(CANARY, labels + width, GUARD);
    }
}

static void test_runs_of_pixels(void)
{
    visit(compare_runs);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_labels);
    RUN_TEST(test_runs_of_pixels);
    return UNITY_END();
}
