/*
 * Filters on the pictures of two robotics lectures, whose results stand here as the lectures and
 * hand computation give them: Sobel, Laplacian, Gauss and box on 6 x 8 pixels with every border, a
 * box filter over a square with a hole, sharpening, and the integer 5x5 Gauss.
 */
#include "unity.h"

#include <pel.h>
#include <pel/filter.h>

enum { ROWS = 6, COLUMNS = 8, VALID_ROWS = 4, VALID_COLUMNS = 6, SQUARE = 10 };

static uint8_t work[PEL_FILTER_BYTES_WRAP(SQUARE, 2)];

void setUp(void)
{
}

void tearDown(void)
{
}

/* ---- The picture of the convolution example ------------------------------------------------ */

static const uint8_t slide_2[ROWS][COLUMNS] = {
    {3, 4, 20, 21, 20, 19, 0, 1}, /* row 0 */
    {3, 2, 3, 20, 20, 19, 2, 1},  /* row 1 */
    {2, 0, 3, 19, 21, 20, 5, 0},  /* row 2 */
    {2, 1, 1, 25, 24, 19, 21, 5}, /* row 3 */
    {5, 10, 19, 20, 23, 3, 2, 0}, /* row 4 */
    {1, 3, 10, 20, 19, 24, 1, 1}, /* row 5 */
};

/* The first slide differs in one pixel. */
static uint8_t slide_1[ROWS][COLUMNS];

static const uint8_t *first_slide(void)
{
    for (unsigned i = 0; i < ROWS * COLUMNS; i++) {
        slide_1[i / COLUMNS][i % COLUMNS] = slide_2[i / COLUMNS][i % COLUMNS];
    }
    slide_1[2][6] = 3;
    return &slide_1[0][0];
}

/* What it changes in a table of valid results. */
typedef struct change {
    uint8_t row, column;
    int16_t value;
} change;

typedef struct table {
    int16_t at[VALID_ROWS][VALID_COLUMNS];
} table;

static table with_changes(const table *original, const change *changes, unsigned count)
{
    table changed = *original;
    for (unsigned i = 0; i < count; i++) {
        changed.at[changes[i].row][changes[i].column] = changes[i].value;
    }
    return changed;
}

/* ---- Running a filter ---------------------------------------------------------------------- */

static pel_filter_config config_of(const pel_kernel *kernel, pel_border border)
{
    pel_filter_config config = {0};
    config.kernel = kernel;
    config.border = border;
    config.work = work;
    config.work_bytes = sizeof work;
    return config;
}

static pel_cview view_of(const uint8_t *pixels, uint16_t width, uint16_t height)
{
    pel_cview view;
    TEST_ASSERT_EQUAL_INT(
        PEL_OK, pel_cview_init(pixels, PEL_GRAY8, PEL_RANGE_FULL, width, height, 0, &view));
    return view;
}

static void filter_s16(const pel_filter_config *config, const uint8_t *pixels, uint16_t width,
                       uint16_t height, int16_t *results)
{
    const pel_cview view = view_of(pixels, width, height);
    const int32_t stride = config->border == PEL_BORDER_VALID ? width - 2 : width;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_frame_s16(config, &view, results, stride));
}

static void filter_u8(const pel_filter_config *config, const uint8_t *pixels, uint16_t width,
                      uint16_t height, uint8_t *results)
{
    const pel_cview source = view_of(pixels, width, height);
    const uint16_t lost = config->border == PEL_BORDER_VALID ? 2 : 0;
    pel_view target;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_view_init(results, PEL_GRAY8, PEL_RANGE_FULL,
                                                (uint16_t)(width - lost), (uint16_t)(height - lost),
                                                0, &target));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_frame(config, &source, &target));
}

static void expect_op_table(const table *expected, const uint8_t *picture, pel_filter_op_s16 *op,
                            const pel_kernel *kernel)
{
    pel_filter_config config = config_of(kernel, PEL_BORDER_VALID);
    table results;
    config.op_s16 = op;
    filter_s16(&config, picture, COLUMNS, ROWS, &results.at[0][0]);
    TEST_ASSERT_EQUAL_INT16_ARRAY(expected->at, results.at, VALID_ROWS * VALID_COLUMNS);
}

static void expect_table(const table *expected, const uint8_t *picture, const pel_kernel *kernel)
{
    expect_op_table(expected, picture, NULL, kernel);
}

/* A named kernel without its division: the sum alone. */
static pel_kernel sum_of(const char *name)
{
    pel_kernel kernel = *pel_kernel_named(name);
    kernel.divisor = 1;
    kernel.shift = 0;
    return kernel;
}

/* ---- Only pixels with all neighbours ------------------------------------------------------- */

static const table sobel_x = {{
    {18, 72, 52, -3, -72, -74},
    {1, 80, 76, -5, -53, -72},
    {13, 77, 68, -28, -43, -51},
    {36, 61, 40, -36, -63, -43},
}};
static const change sobel_x_slide_1[] = {{0, 4, -74}, {1, 4, -57}, {2, 4, -45}};

static const table sobel_y = {{
    {-26, -40, -20, 1, 8, 10},
    {-5, 0, 12, 13, 23, 42},
    {39, 43, 20, -12, -35, -23},
    {12, 15, -6, -10, -15, -39},
}};
static const change sobel_y_slide_1[] = {{0, 4, 6}, {0, 5, 6}, {2, 4, -33}, {2, 5, -19}};

static const table laplacian_negative = {{
    {-2, -33, 17, 0, 15, -17},
    {-8, -11, 7, 1, 16, -23},
    {-9, -44, 36, 8, 8, 53},
    {12, 35, -7, 26, -56, -17},
}};
static const change laplacian_slide_1[] = {{0, 5, -15}, {1, 4, 18}, {1, 5, -31}, {2, 5, 55}};

static const table gradient_abs = {{
    {44, 112, 72, 4, 80, 84},
    {6, 80, 88, 18, 76, 114},
    {52, 120, 88, 40, 78, 74},
    {48, 76, 46, 46, 78, 82},
}};

static const table gauss_sums = {{
    {56, 146, 270, 319, 244, 98},
    {25, 106, 262, 333, 275, 150},
    {59, 149, 294, 334, 263, 169},
    {110, 207, 308, 312, 213, 107},
}};
static const change gauss_slide_1[] = {{0, 4, 242}, {0, 5, 94},  {1, 4, 271},
                                       {1, 5, 142}, {2, 4, 261}, {2, 5, 165}};

static const table box_sums = {{
    {40, 92, 147, 179, 126, 67},
    {17, 74, 136, 187, 151, 92},
    {43, 98, 155, 174, 138, 75},
    {52, 109, 161, 177, 136, 76},
}};
static const change box_slide_1[] = {{0, 4, 124}, {0, 5, 65},  {1, 4, 149},
                                     {1, 5, 90},  {2, 4, 136}, {2, 5, 73}};

/* Rows 1..3, columns 1..3 of the picture, alone. */
static const uint8_t window[9] = {2, 3, 20, 0, 3, 19, 1, 1, 25};

static void test_the_worked_sobel_value_is_80(void)
{
    const pel_filter_config config = config_of(pel_kernel_named("sobel_x"), PEL_BORDER_VALID);
    int16_t result = 0;
    filter_s16(&config, window, 3, 3, &result);
    TEST_ASSERT_EQUAL_INT16(80, result);
}

static void test_as_true_convolution_it_is_minus_80(void)
{
    const pel_kernel flipped = pel_kernel_flipped(pel_kernel_named("sobel_x"));
    const pel_filter_config config = config_of(&flipped, PEL_BORDER_VALID);
    int16_t result = 0;
    filter_s16(&config, window, 3, 3, &result);
    TEST_ASSERT_EQUAL_INT16(-80, result);
}

static void test_sobel_x(void)
{
    const table first = with_changes(&sobel_x, sobel_x_slide_1, 3);
    expect_table(&sobel_x, &slide_2[0][0], pel_kernel_named("sobel_x"));
    expect_table(&first, first_slide(), pel_kernel_named("sobel_x"));
}

static void test_sobel_y(void)
{
    const table first = with_changes(&sobel_y, sobel_y_slide_1, 4);
    expect_table(&sobel_y, &slide_2[0][0], pel_kernel_named("sobel_y"));
    expect_table(&first, first_slide(), pel_kernel_named("sobel_y"));
}

static void test_convolution_turns_the_sign_of_sobel(void)
{
    const pel_kernel flipped_x = pel_kernel_flipped(pel_kernel_named("sobel_x"));
    const pel_kernel flipped_y = pel_kernel_flipped(pel_kernel_named("sobel_y"));
    table minus_x, minus_y;
    for (unsigned row = 0; row < VALID_ROWS; row++) {
        for (unsigned column = 0; column < VALID_COLUMNS; column++) {
            minus_x.at[row][column] = (int16_t)-sobel_x.at[row][column];
            minus_y.at[row][column] = (int16_t)-sobel_y.at[row][column];
        }
    }
    expect_table(&minus_x, &slide_2[0][0], &flipped_x);
    expect_table(&minus_y, &slide_2[0][0], &flipped_y);
}

static void test_laplacian_with_centre_plus_4(void)
{
    const table first = with_changes(&laplacian_negative, laplacian_slide_1, 4);
    expect_table(&laplacian_negative, &slide_2[0][0], pel_kernel_named("laplacian_negative"));
    expect_table(&first, first_slide(), pel_kernel_named("laplacian_negative"));
}

static void test_laplacian_is_its_negative(void)
{
    table minus;
    for (unsigned row = 0; row < VALID_ROWS; row++) {
        for (unsigned column = 0; column < VALID_COLUMNS; column++) {
            minus.at[row][column] = (int16_t)-laplacian_negative.at[row][column];
        }
    }
    expect_table(&minus, &slide_2[0][0], pel_kernel_named("laplacian"));
}

static int16_t magnitude(int16_t value)
{
    return value < 0 ? (int16_t)-value : value;
}

static void test_sum_of_the_absolute_gradients(void)
{
    const table first_x = with_changes(&sobel_x, sobel_x_slide_1, 3);
    const table first_y = with_changes(&sobel_y, sobel_y_slide_1, 4);
    table first;
    for (unsigned row = 0; row < VALID_ROWS; row++) {
        for (unsigned column = 0; column < VALID_COLUMNS; column++) {
            first.at[row][column] =
                (int16_t)(magnitude(first_x.at[row][column]) + magnitude(first_y.at[row][column]));
        }
    }
    expect_op_table(&gradient_abs, &slide_2[0][0], pel_op_gradient_abs_s16, NULL);
    expect_op_table(&first, first_slide(), pel_op_gradient_abs_s16, NULL);
}

static void test_gauss_sums(void)
{
    const pel_kernel kernel = sum_of("gauss3");
    const table first = with_changes(&gauss_sums, gauss_slide_1, 6);
    expect_table(&gauss_sums, &slide_2[0][0], &kernel);
    expect_table(&first, first_slide(), &kernel);
}

static void test_gauss_divided_by_16(void)
{
    static const uint8_t expected[VALID_ROWS][VALID_COLUMNS] = {
        {4, 9, 17, 20, 15, 6},  /* row 0 */
        {2, 7, 16, 21, 17, 9},  /* row 1 */
        {4, 9, 18, 21, 16, 11}, /* row 2 */
        {7, 13, 19, 20, 13, 7}, /* row 3 */
    };
    const pel_filter_config config = config_of(pel_kernel_named("gauss3"), PEL_BORDER_VALID);
    uint8_t results[VALID_ROWS * VALID_COLUMNS];
    filter_u8(&config, &slide_2[0][0], COLUMNS, ROWS, results);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, results, sizeof expected);
}

static void test_box_sums(void)
{
    const pel_kernel kernel = sum_of("box3");
    const table first = with_changes(&box_sums, box_slide_1, 6);
    expect_table(&box_sums, &slide_2[0][0], &kernel);
    expect_table(&first, first_slide(), &kernel);
}

static void test_box_divided_by_9_is_rounded(void)
{
    static const uint8_t expected[VALID_ROWS][VALID_COLUMNS] = {
        {4, 10, 16, 20, 14, 7}, /* row 0 */
        {2, 8, 15, 21, 17, 10}, /* row 1 */
        {5, 11, 17, 19, 15, 8}, /* row 2 */
        {6, 12, 18, 20, 15, 8}, /* row 3 */
    };
    const pel_filter_config config = config_of(pel_kernel_named("box3"), PEL_BORDER_VALID);
    uint8_t results[VALID_ROWS * VALID_COLUMNS];
    filter_u8(&config, &slide_2[0][0], COLUMNS, ROWS, results);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, results, sizeof expected);
}

/* ---- Sobel x with every border ------------------------------------------------------------- */

static void expect_full_size(const int16_t *expected, pel_border border)
{
    const pel_filter_config config = config_of(pel_kernel_named("sobel_x"), border);
    int16_t results[ROWS * COLUMNS];
    filter_s16(&config, &slide_2[0][0], COLUMNS, ROWS, results);
    TEST_ASSERT_EQUAL_INT16_ARRAY(expected, results, ROWS * COLUMNS);
}

static void test_sobel_x_with_zeros_around(void)
{
    static const int16_t expected[ROWS][COLUMNS] = {
        {10, 34, 52, 17, -5, -58, -54, -2},   /* row 0 */
        {8, 18, 72, 52, -3, -72, -74, -9},    /* row 1 */
        {3, 1, 80, 76, -5, -53, -72, -33},    /* row 2 */
        {12, 13, 77, 68, -28, -43, -51, -49}, /* row 3 */
        {24, 36, 61, 40, -36, -63, -43, -26}, /* row 4 */
        {16, 32, 44, 22, -9, -57, -49, -4},   /* row 5 */
    };
    expect_full_size(&expected[0][0], PEL_BORDER_CONSTANT);
}

static void test_sobel_x_with_repeated_edges(void)
{
    static const int16_t expected[ROWS][COLUMNS] = {
        {2, 51, 69, 17, -7, -78, -72, 2},     /* row 0 */
        {-3, 18, 72, 52, -3, -72, -74, -6},   /* row 1 */
        {-6, 1, 80, 76, -5, -53, -72, -27},   /* row 2 */
        {1, 13, 77, 68, -28, -43, -51, -39},  /* row 3 */
        {11, 36, 61, 40, -36, -63, -43, -20}, /* row 4 */
        {11, 41, 61, 31, -5, -75, -72, -2},   /* row 5 */
    };
    expect_full_size(&expected[0][0], PEL_BORDER_REPLICATE);
    expect_full_size(&expected[0][0], PEL_BORDER_SYMMETRIC);
}

static void test_sobel_x_with_the_other_side(void)
{
    static const int16_t expected[ROWS][COLUMNS] = {
        {9, 43, 69, 26, -1, -76, -77, 7},     /* row 0 */
        {5, 18, 72, 52, -3, -72, -74, 2},     /* row 1 */
        {-3, 1, 80, 76, -5, -53, -72, -24},   /* row 2 */
        {2, 13, 77, 68, -28, -43, -51, -38},  /* row 3 */
        {18, 36, 61, 40, -36, -63, -43, -13}, /* row 4 */
        {17, 49, 61, 22, -11, -77, -67, 6},   /* row 5 */
    };
    expect_full_size(&expected[0][0], PEL_BORDER_WRAP);
}

/* Mirrored about the outermost pixels, left and right neighbours of an edge pixel are equal: no
 * horizontal gradient there. The top row sees the row below twice. */
static void test_sobel_x_mirrored_about_the_edge(void)
{
    static const int16_t expected[ROWS][COLUMNS] = {
        {0, 34, 70, 34, -6, -76, -72, 0},  /* row 0: 2 (row 0) + 2 (row 1) of right - left */
        {0, 18, 72, 52, -3, -72, -74, 0},  /* row 1 */
        {0, 1, 80, 76, -5, -53, -72, 0},   /* row 2 */
        {0, 13, 77, 68, -28, -43, -51, 0}, /* row 3 */
        {0, 36, 61, 40, -36, -63, -43, 0}, /* row 4 */
        {0, 46, 54, 26, -26, -78, -52, 0}, /* row 5: 2 (row 5) + 2 (row 4) */
    };
    expect_full_size(&expected[0][0], PEL_BORDER_REFLECT101);
}

/* ---- A square with a hole and a stray pixel ------------------------------------------------ */

/* Rows 2..6, columns 3..7 are 90, but for the hole; the rest is 0, but for the stray pixel. */
static const uint8_t square[SQUARE][SQUARE] = {
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 0},      /* row 0 */
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 0},      /* row 1 */
    {0, 0, 0, 90, 90, 90, 90, 90, 0, 0}, /* row 2 */
    {0, 0, 0, 90, 90, 90, 90, 90, 0, 0}, /* row 3 */
    {0, 0, 0, 90, 90, 90, 90, 90, 0, 0}, /* row 4 */
    {0, 0, 0, 90, 0, 90, 90, 90, 0, 0},  /* row 5 */
    {0, 0, 0, 90, 90, 90, 90, 90, 0, 0}, /* row 6 */
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 0},      /* row 7 */
    {0, 0, 90, 0, 0, 0, 0, 0, 0, 0},     /* row 8 */
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 0},      /* row 9 */
};

static const uint8_t square_boxed[SQUARE][SQUARE] = {
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 0},         /* row 0 */
    {0, 0, 10, 20, 30, 30, 30, 20, 10, 0},  /* row 1 */
    {0, 0, 20, 40, 60, 60, 60, 40, 20, 0},  /* row 2 */
    {0, 0, 30, 60, 90, 90, 90, 60, 30, 0},  /* row 3 */
    {0, 0, 30, 50, 80, 80, 90, 60, 30, 0},  /* row 4 */
    {0, 0, 30, 50, 80, 80, 90, 60, 30, 0},  /* row 5 */
    {0, 0, 20, 30, 50, 50, 60, 40, 20, 0},  /* row 6 */
    {0, 10, 20, 30, 30, 30, 30, 20, 10, 0}, /* row 7 */
    {0, 10, 10, 10, 0, 0, 0, 0, 0, 0},      /* row 8 */
    {0, 10, 10, 10, 0, 0, 0, 0, 0, 0},      /* row 9 */
};

static void test_box_over_the_square_in_full_size(void)
{
    static const pel_border borders[] = {PEL_BORDER_CONSTANT, PEL_BORDER_WRAP};
    uint8_t results[SQUARE * SQUARE];
    for (unsigned i = 0; i < sizeof borders / sizeof borders[0]; i++) {
        const pel_filter_config config = config_of(pel_kernel_named("box3"), borders[i]);
        filter_u8(&config, &square[0][0], SQUARE, SQUARE, results);
        TEST_ASSERT_EQUAL_UINT8_ARRAY(square_boxed, results, sizeof results);
    }
}

static void test_box_over_the_square_as_printed(void)
{
    const pel_filter_config config = config_of(pel_kernel_named("box3"), PEL_BORDER_VALID);
    uint8_t results[8 * 8];
    filter_u8(&config, &square[0][0], SQUARE, SQUARE, results);
    for (unsigned row = 0; row < 8; row++) {
        TEST_ASSERT_EQUAL_UINT8_ARRAY(&square_boxed[row + 1][1], results + row * 8, 8);
    }
}

static void test_sharpening_the_square(void)
{
    pel_filter_config config = config_of(pel_kernel_named("sharpen"), PEL_BORDER_CONSTANT);
    uint8_t results[SQUARE * SQUARE];
    filter_u8(&config, &square[0][0], SQUARE, SQUARE, results);
    TEST_ASSERT_EQUAL_UINT8(0, results[5 * SQUARE + 4]);   /* the hole: -720/9 */
    TEST_ASSERT_EQUAL_UINT8(170, results[8 * SQUARE + 2]); /* the stray pixel: 1530/9 */
    TEST_ASSERT_EQUAL_UINT8(140, results[2 * SQUARE + 3]); /* the corners: 1260/9 */
    TEST_ASSERT_EQUAL_UINT8(140, results[2 * SQUARE + 7]);
    TEST_ASSERT_EQUAL_UINT8(150, results[6 * SQUARE + 3]); /* beside the hole: 1350/9 */
    TEST_ASSERT_EQUAL_UINT8(140, results[6 * SQUARE + 7]);
}

static void test_sharpening_before_it_is_limited(void)
{
    const pel_kernel sums = sum_of("sharpen");
    pel_filter_config config = config_of(&sums, PEL_BORDER_VALID);
    int16_t results[8 * 8];
    filter_s16(&config, &square[0][0], SQUARE, SQUARE, results);
    TEST_ASSERT_EQUAL_INT16(-720, results[4 * 8 + 3]);
    TEST_ASSERT_EQUAL_INT16(1530, results[7 * 8 + 1]);
    TEST_ASSERT_EQUAL_INT16(1260, results[1 * 8 + 2]);
    config.kernel = pel_kernel_named("sharpen");
    filter_s16(&config, &square[0][0], SQUARE, SQUARE, results);
    TEST_ASSERT_EQUAL_INT16(-80, results[4 * 8 + 3]);
}

/* ---- The integer 5x5 Gauss ----------------------------------------------------------------- */

static const uint8_t gauss5_taps[5][5] = {
    {1, 3, 6, 3, 1},    /* row 0 */
    {3, 15, 25, 15, 3}, /* row 1 */
    {6, 25, 44, 25, 6}, /* row 2 */
    {3, 15, 25, 15, 3}, /* row 3 */
    {1, 3, 6, 3, 1},    /* row 4 */
};

static void test_gauss5_sums_to_its_divisor(void)
{
    const pel_kernel *kernel = pel_kernel_named("gauss5");
    uint16_t sum = 0;
    TEST_ASSERT_EQUAL_UINT8(2, kernel->radius);
    for (unsigned i = 0; i < 25; i++) {
        TEST_ASSERT_EQUAL_INT8(gauss5_taps[i / 5][i % 5], kernel->tap[i]);
        sum = (uint16_t)(sum + gauss5_taps[i / 5][i % 5]);
    }
    TEST_ASSERT_EQUAL_UINT16(256, sum);
    TEST_ASSERT_EQUAL_UINT32(256, (uint32_t)(kernel->divisor == 0 ? 1 : kernel->divisor)
                                      << kernel->shift);
}

/* 255/256 of a tap, rounded, is the tap. */
static void test_gauss5_of_a_white_dot_is_the_kernel(void)
{
    const pel_filter_config config = config_of(pel_kernel_named("gauss5"), PEL_BORDER_CONSTANT);
    uint8_t picture[7 * 7] = {0}, results[7 * 7], expected[7 * 7] = {0};
    picture[3 * 7 + 3] = 255;
    for (unsigned row = 0; row < 5; row++) {
        for (unsigned column = 0; column < 5; column++) {
            expected[(row + 1) * 7 + column + 1] = gauss5_taps[row][column];
        }
    }
    filter_u8(&config, picture, 7, 7, results);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, results, sizeof expected);
}

/* The slides' Gauss, whose sum is 0.987, would make 252 of it. */
static void test_smoothing_keeps_flat_white(void)
{
    static const char *const names[] = {"gauss3", "gauss5", "binomial5", "box3", "sharpen"};
    uint8_t picture[6 * 6], results[6 * 6];
    for (unsigned i = 0; i < sizeof picture; i++) {
        picture[i] = 255;
    }
    for (unsigned i = 0; i < sizeof names / sizeof names[0]; i++) {
        const pel_filter_config config =
            config_of(pel_kernel_named(names[i]), PEL_BORDER_REPLICATE);
        results[0] = 0;
        filter_u8(&config, picture, 6, 6, results);
        TEST_ASSERT_EACH_EQUAL_UINT8_MESSAGE(255, results, sizeof results, names[i]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_worked_sobel_value_is_80);
    RUN_TEST(test_as_true_convolution_it_is_minus_80);
    RUN_TEST(test_sobel_x);
    RUN_TEST(test_sobel_y);
    RUN_TEST(test_convolution_turns_the_sign_of_sobel);
    RUN_TEST(test_laplacian_with_centre_plus_4);
    RUN_TEST(test_laplacian_is_its_negative);
    RUN_TEST(test_sum_of_the_absolute_gradients);
    RUN_TEST(test_gauss_sums);
    RUN_TEST(test_gauss_divided_by_16);
    RUN_TEST(test_box_sums);
    RUN_TEST(test_box_divided_by_9_is_rounded);
    RUN_TEST(test_sobel_x_with_zeros_around);
    RUN_TEST(test_sobel_x_with_repeated_edges);
    RUN_TEST(test_sobel_x_with_the_other_side);
    RUN_TEST(test_sobel_x_mirrored_about_the_edge);
    RUN_TEST(test_box_over_the_square_in_full_size);
    RUN_TEST(test_box_over_the_square_as_printed);
    RUN_TEST(test_sharpening_the_square);
    RUN_TEST(test_sharpening_before_it_is_limited);
    RUN_TEST(test_gauss5_sums_to_its_divisor);
    RUN_TEST(test_gauss5_of_a_white_dot_is_the_kernel);
    RUN_TEST(test_smoothing_keeps_flat_white);
    return UNITY_END();
}
