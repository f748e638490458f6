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

static uint8_t bytes[5][OFFSETS + 4 * WIDTH_MAX], plain[4 * WIDTH_MAX];
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

    for (unsigned row = 0; row < 5; row++) {
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

/* The four orders of packed 4:2:2, both of NV12, I420, gray, and planes that are none of these. */
enum { LAYOUTS = 9 };

static pel_row_pairs pairs_of(unsigned layout, unsigned offset)
{
    const uint8_t *const a = bytes[0] + offset, *const b = bytes[1] + offset;
    const pel_row_pairs all[LAYOUTS] = {
        {a, a + 1, a + 3, 2, 4}, {a, a + 3, a + 1, 2, 4}, {a + 1, a, a + 2, 2, 4},
        {a + 1, a + 2, a, 2, 4}, {a, b, b + 1, 1, 2},     {a, b + 1, b, 1, 2},
        {a, b, bytes[2], 1, 1},  {a, b, b, 1, 0},         {a, b + 1, bytes[2], 1, 4},
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

/* Labels of every kind of the patterns, or few of them, so that runs are long and short. */
static void compare_runs_of_labels(uint16_t width, unsigned offset)
{
    static const uint8_t masks[] = {0xFF, 0x07, 0x01, 0x80};

    for (unsigned i = 0; i < sizeof masks; i++) {
        uint8_t *const labels = guarded(offset);
        uint16_t expected, count;
        for (unsigned x = 0; x < width; x++) {
            labels[x] = bytes[0][x] & masks[i];
        }
        expected = pel_row_find_runs(labels, width, plain_edges);
        fill(fast_edges, sizeof fast_edges);
        count = PEL_BEST_FIND_RUNS(labels, width, fast_edges);
        expect_runs(width, expected, count);
    }
}

static void test_runs_of_labels(void)
{
    visit(compare_runs_of_labels);
}

/* ---- Neighbourhoods ------------------------------------------------------------------------ */

/* A column on either side of the results, two for radius 2, may be read. */
enum { MARGIN = 2 };

typedef struct window {
    const uint8_t *rows[5];
} window;

static window window_at(unsigned offset)
{
    window w;
    for (unsigned i = 0; i < 5; i++) {
        w.rows[i] = bytes[i] + offset + MARGIN;
    }
    return w;
}

#define COMPARE_BYTES(name, best)                                                                  \
    static void compare_##name(uint16_t width, unsigned offset)                                    \
    {                                                                                              \
        const window w = window_at(offset);                                                        \
        pel_row_##name(w.rows, width, plain);                                                      \
        best(w.rows, width, guarded(offset));                                                      \
        expect_guarded(plain, offset, width);                                                      \
    }                                                                                              \
    static void test_##name(void)                                                                  \
    {                                                                                              \
        visit(compare_##name);                                                                     \
    }

/* Results of 16 bits, always where their type may lie. */
#define COMPARE_WORDS(name, best)                                                                  \
    static void compare_##name(uint16_t width, unsigned offset)                                    \
    {                                                                                              \
        const window w = window_at(offset);                                                        \
        pel_row_##name(w.rows, width, plain_words);                                                \
        fill(fast_words, sizeof fast_words);                                                       \
        best(w.rows, width, fast_words);                                                           \
        expect_words(width);                                                                       \
    }                                                                                              \
    static void test_##name(void)                                                                  \
    {                                                                                              \
        visit(compare_##name);                                                                     \
    }

static int16_t plain_words[WIDTH_MAX], fast_words[WIDTH_MAX + GUARD];

static void expect_words(uint16_t width)
{
    if (width > 0) {
        TEST_ASSERT_EQUAL_INT16_ARRAY(plain_words, fast_words, width);
    }
    for (unsigned i = width; i < width + (unsigned)GUARD; i++) {
        TEST_ASSERT_EQUAL_HEX16(0xA5A5, (uint16_t)fast_words[i]);
    }
}

COMPARE_BYTES(gauss3, PEL_BEST_GAUSS3)
COMPARE_BYTES(box3, PEL_BEST(box3))
COMPARE_BYTES(binomial5, PEL_BEST(binomial5))
COMPARE_BYTES(gradient_abs, PEL_BEST_GRADIENT_ABS)
COMPARE_BYTES(median3, PEL_BEST(median3))
COMPARE_BYTES(min3, PEL_BEST(min3))
COMPARE_BYTES(max3, PEL_BEST(max3))
COMPARE_BYTES(erode_labels3, PEL_BEST(erode_labels3))
COMPARE_BYTES(dilate_labels3, PEL_BEST(dilate_labels3))
COMPARE_WORDS(sobel_x, PEL_BEST(sobel_x))
COMPARE_WORDS(sobel_y, PEL_BEST(sobel_y))
COMPARE_WORDS(gradient_abs_s16, PEL_BEST(gradient_abs_s16))

static void compare_copies(uint16_t width, unsigned offset)
{
    PEL_BEST_COPY(bytes[0] + MARGIN, width, guarded(offset));
    expect_guarded(bytes[0] + MARGIN, offset, width);
}

static void test_copies(void)
{
    visit(compare_copies);
}

/* ---- Kernels with taps --------------------------------------------------------------------- */

static int8_t tap[25];
static pel_row_scale scale;

/* Taps of a size whose sums fit 16 bits, nearly do, do not, and the extremes; scales as a filter
 * makes them of a divisor, a shift, a bias and the wish for absolute values. */
static void draw_taps(void)
{
    static const uint8_t sizes[] = {1, 5, 12, 20, 60, 127};
    const uint32_t kind = random_bits() % 8, how = random_bits() % 4;
    const uint32_t divisor = how == 0  ? 1
                             : how < 3 ? 1 + random_bits() % 300
                                       : 1 + random_bits() % 32767;
    const uint32_t shift = how == 1 ? 0 : random_bits() % (how < 3 ? 9 : 16),
                   whole = divisor << shift;
    const uint32_t more = 816000 / whole + 1;
    const int32_t bias = random_bits() % 2 == 0 ? 0 : (int32_t)(random_bits() % 65536) - 32768;

    for (unsigned i = 0; i < 25; i++) {
        const uint32_t r = random_bits();
        tap[i] = (int8_t)(kind < 6    ? (int32_t)(r % (2u * sizes[kind] + 1)) - sizes[kind]
                          : kind == 6 ? (int32_t)(r % 11)
                          : r & 1     ? -128
                                      : 127);
    }
    scale.start = more * whole + whole / 2;
    scale.flip = random_bits() % 3 == 0 ? scale.start : 0;
    scale.divisor = divisor == 1 ? 0 : whole;
    scale.shift = (uint8_t)shift;
    scale.bias = (how == 2 ? bias / 256 : bias) - (int32_t)more;
}

static void compare_kernels(uint16_t width, unsigned offset)
{
    const window w = window_at(offset);

    for (unsigned i = 0; i < 8; i++) {
        draw_taps();
        pel_row_kernel3(w.rows, tap, &scale, width, plain);
        PEL_BEST_KERNEL3(w.rows, tap, &scale, width, guarded(offset));
        expect_guarded(plain, offset, width);
        pel_row_kernel5(w.rows, tap, &scale, width, plain);
        PEL_BEST(kernel5)(w.rows, tap, &scale, width, guarded(offset));
        expect_guarded(plain, offset, width);
        fill(fast_words, sizeof fast_words);
        pel_row_kernel3_s16(w.rows, tap, &scale, width, plain_words);
        PEL_BEST(kernel3_s16)(w.rows, tap, &scale, width, fast_words);
        expect_words(width);
        fill(fast_words, sizeof fast_words);
        pel_row_kernel5_s16(w.rows, tap, &scale, width, plain_words);
        PEL_BEST(kernel5_s16)(w.rows, tap, &scale, width, fast_words);
        expect_words(width);
    }
}

static void test_kernels(void)
{
    visit(compare_kernels);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_labels);
    RUN_TEST(test_runs_of_labels);
    RUN_TEST(test_runs_of_pixels);
    RUN_TEST(test_gauss3);
    RUN_TEST(test_box3);
    RUN_TEST(test_binomial5);
    RUN_TEST(test_gradient_abs);
    RUN_TEST(test_median3);
    RUN_TEST(test_min3);
    RUN_TEST(test_max3);
    RUN_TEST(test_erode_labels3);
    RUN_TEST(test_dilate_labels3);
    RUN_TEST(test_sobel_x);
    RUN_TEST(test_sobel_y);
    RUN_TEST(test_gradient_abs_s16);
    RUN_TEST(test_copies);
    RUN_TEST(test_kernels);
    return UNITY_END();
}
