/*
 * Classification: which class has a colour. The membership of a colour in a box is so simple that
 * the tests state it again in one line (inside) and compare; what can go wrong are edges, overlaps,
 * the way through each format, and the look-up table's index.
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

static pel_boxes boxes;

static void forget_boxes(void)
{
    for (unsigned i = 0; i < 256; i++) {
        boxes.y[i] = boxes.u[i] = boxes.v[i] = 0;
    }
}

static pel_classifier classifier_of_boxes(void)
{
    const pel_classifier classifier = {&boxes,
                                       {NULL, 0, 0, 0},
                                       PEL_RANGE_FULL,
                                       NULL,
                                       .reader = pel_crow_read_yuv,
                                       .pieces = pel_classify_pieces};
    return classifier;
}

/* ---- Boxes --------------------------------------------------------------------------------- */

static int inside(const pel_color_box *box, unsigned y, unsigned u, unsigned v)
{
    return box->y_min <= y && y <= box->y_max && box->u_min <= u && u <= box->u_max &&
           box->v_min <= v && v <= box->v_max;
}

static void test_both_ends_of_a_box_belong_to_it(void)
{
    static const pel_color_box box = {10, 20, 100, 110, 200, 210};
    const pel_classifier classifier = classifier_of_boxes();
    forget_boxes();
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_boxes_set(&boxes, 0, &box));
    TEST_ASSERT_EQUAL_UINT8(1, pel_classify_color(&classifier, 10, 100, 200));
    TEST_ASSERT_EQUAL_UINT8(1, pel_classify_color(&classifier, 20, 110, 210));
    TEST_ASSERT_EQUAL_UINT8(0, pel_classify_color(&classifier, 9, 100, 200));
    TEST_ASSERT_EQUAL_UINT8(0, pel_classify_color(&classifier, 21, 100, 200));
    TEST_ASSERT_EQUAL_UINT8(0, pel_classify_color(&classifier, 10, 99, 200));
    TEST_ASSERT_EQUAL_UINT8(0, pel_classify_color(&classifier, 10, 111, 200));
    TEST_ASSERT_EQUAL_UINT8(0, pel_classify_color(&classifier, 10, 100, 199));
    TEST_ASSERT_EQUAL_UINT8(0, pel_classify_color(&classifier, 10, 100, 211));
}

static void test_a_box_can_be_one_colour_or_all_of_them(void)
{
    static const pel_color_box black = {0, 0, 128, 128, 128, 128};
    static const pel_color_box anything = {0, 255, 0, 255, 0, 255};
    const pel_classifier classifier = classifier_of_boxes();
    forget_boxes();
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_boxes_set(&boxes, 0, &black));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_boxes_set(&boxes, 1, &anything));
    TEST_ASSERT_EQUAL_UINT8(1, pel_classify_color(&classifier, 0, 128, 128));
    TEST_ASSERT_EQUAL_UINT8(2, pel_classify_color(&classifier, 1, 128, 128));
    TEST_ASSERT_EQUAL_UINT8(2, pel_classify_color(&classifier, 0, 0, 0));
    TEST_ASSERT_EQUAL_UINT8(2, pel_classify_color(&classifier, 255, 255, 255));
}

static void test_a_box_with_its_ends_exchanged_is_empty(void)
{
    static const pel_color_box empty = {20, 19, 0, 255, 0, 255};
    const pel_classifier classifier = classifier_of_boxes();
    forget_boxes();
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_boxes_set(&boxes, 0, &empty));
    for (unsigned y = 0; y < 256; y++) {
        TEST_ASSERT_EQUAL_UINT8(0, pel_classify_color(&classifier, (uint8_t)y, 128, 128));
    }
}

static void test_setting_a_class_again_replaces_its_box_and_no_other(void)
{
    static const pel_color_box dark = {0, 99, 0, 255, 0, 255};
    static const pel_color_box bright = {100, 255, 0, 255, 0, 255};
    const pel_classifier classifier = classifier_of_boxes();
    forget_boxes();
    pel_boxes_set(&boxes, 0, &dark);
    pel_boxes_set(&boxes, 3, &dark);
    pel_boxes_set(&boxes, 0, &bright);
    TEST_ASSERT_EQUAL_UINT8(4, pel_classify_color(&classifier, 50, 128, 128));
    TEST_ASSERT_EQUAL_UINT8(1, pel_classify_color(&classifier, 150, 128, 128));
}

static void test_the_lowest_class_wins_where_boxes_overlap(void)
{
    const pel_classifier classifier = classifier_of_boxes();
    forget_boxes();
    for (unsigned c = 0; c < PEL_CLASS_MAX; c++) {
        /* Class c holds Y from 0 to 10 * (c + 1) - 1: the lower the class, the smaller its box. */
        const unsigned top = 10 * (c + 1) - 1 < 255 ? 10 * (c + 1) - 1 : 255;
        const pel_color_box box = {0, (uint8_t)top, 0, 255, 0, 255};
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_boxes_set(&boxes, c, &box));
    }
    for (unsigned y = 0; y < 256; y++) {
        const unsigned lowest = y / 10 < PEL_CLASS_MAX ? y / 10 + 1 : 0;
        TEST_ASSERT_EQUAL_UINT8(lowest, pel_classify_color(&classifier, (uint8_t)y, 128, 128));
    }
}

static void test_every_class_has_its_own_label(void)
{
    const pel_classifier classifier = classifier_of_boxes();
    forget_boxes();
    for (unsigned c = 0; c < PEL_CLASS_MAX; c++) {
        const uint8_t at = (uint8_t)(7 * c);
        const pel_color_box box = {at, at, 0, 255, 0, 255};
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_boxes_set(&boxes, c, &box));
    }
    for (unsigned c = 0; c < PEL_CLASS_MAX; c++) {
        TEST_ASSERT_EQUAL_UINT8(c + 1, pel_classify_color(&classifier, (uint8_t)(7 * c), 0, 255));
    }
}

static void test_classes_that_do_not_exist_are_refused(void)
{
    static const pel_color_box box = {0, 255, 0, 255, 0, 255};
    forget_boxes();
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_boxes_set(&boxes, PEL_CLASS_MAX, &box));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_boxes_set(&boxes, (unsigned)-1, &box));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_boxes_set(NULL, 0, &box));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_boxes_set(&boxes, 0, NULL));
    for (unsigned i = 0; i < 256; i++) {
        TEST_ASSERT_EQUAL_UINT32(0, (uint32_t)(boxes.y[i] | boxes.u[i] | boxes.v[i]));
    }
}

/* ---- A robot's classes --------------------------------------------------------------------- */

/* The classic five of the robot soccer field, as full-range YCbCr; what is none of them is unknown:
 * label 0. */
enum { UNKNOWN, RED, YELLOW, BLUE, GREEN, FLOOR };

static const pel_color_box field_boxes[5] = {
    [RED - 1] = {40, 140, 60, 115, 190, 255},    [YELLOW - 1] = {150, 240, 0, 80, 130, 180},
    [BLUE - 1] = {20, 120, 170, 255, 60, 125},   [GREEN - 1] = {60, 180, 30, 110, 20, 100},
    [FLOOR - 1] = {50, 200, 118, 138, 118, 138},
};

typedef struct seen {
    uint8_t rgb[3];
    uint8_t label;
} seen;

/* What a camera sees, pixel by pixel; Y U V beside it as computed by the formula of color.h. */
static const seen scene[8] = {
    {{255, 0, 0}, RED},         /*  76  85 255 */
    {{255, 220, 0}, YELLOW},    /* 205  12 163 */
    {{0, 0, 200}, BLUE},        /*  23 228 112 */
    {{0, 160, 40}, GREEN},      /*  98  95  58 */
    {{128, 128, 128}, FLOOR},   /* 128 128 128 */
    {{255, 255, 255}, UNKNOWN}, /* 255 128 128: too bright for the floor */
    {{0, 0, 0}, UNKNOWN},       /*   0 128 128 */
    {{255, 0, 255}, UNKNOWN},   /* 105 212 235: magenta is nobody's */
};

enum { SCENE = sizeof scene / sizeof scene[0] };

static void set_field_boxes(void)
{
    forget_boxes();
    for (unsigned c = 0; c < 5; c++) {
        pel_boxes_set(&boxes, c, &field_boxes[c]);
    }
}

static void test_a_robot_tells_five_colours_from_the_unknown(void)
{
    const pel_classifier classifier = classifier_of_boxes();
    uint8_t rgb[3 * SCENE], labels[SCENE];
    pel_crow row;
    set_field_boxes();
    for (unsigned x = 0; x < SCENE; x++) {
        rgb[3 * x] = scene[x].rgb[0];
        rgb[3 * x + 1] = scene[x].rgb[1];
        rgb[3 * x + 2] = scene[x].rgb[2];
    }
    row = pel_crow_packed(rgb, PEL_RGB888, PEL_RANGE_FULL, SCENE);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_classify_row(&classifier, &row, labels));
    for (unsigned x = 0; x < SCENE; x++) {
        TEST_ASSERT_EQUAL_UINT8(scene[x].label, labels[x]);
    }
}

static void test_a_colour_and_a_row_of_it_have_the_same_label(void)
{
    const pel_classifier classifier = classifier_of_boxes();
    set_field_boxes();
    for (unsigned x = 0; x < SCENE; x++) {
        uint8_t yuv[3], label;
        const pel_crow row = pel_crow_packed(scene[x].rgb, PEL_RGB888, PEL_RANGE_FULL, 1);
        pel_rgb_to_ycbcr_row(scene[x].rgb, yuv, 1, PEL_RANGE_FULL);
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_classify_row(&classifier, &row, &label));
        TEST_ASSERT_EQUAL_UINT8(label, pel_classify_color(&classifier, yuv[0], yuv[1], yuv[2]));
    }
}

static void test_a_colour_is_the_first_box_that_holds_it(void)
{
    const pel_classifier classifier = classifier_of_boxes();
    set_field_boxes();
    for (unsigned y = 0; y < 256; y += 5) {
        for (unsigned u = 0; u < 256; u += 3) {
            for (unsigned v = 0; v < 256; v += 3) {
                unsigned label = 0;
                while (label < 5 && !inside(&field_boxes[label], y, u, v)) {
                    label++;
                }
                label = label < 5 ? label + 1 : 0;
                TEST_ASSERT_EQUAL_UINT8(
                    label, pel_classify_color(&classifier, (uint8_t)y, (uint8_t)u, (uint8_t)v));
            }
        }
    }
}

/* ---- Every format -------------------------------------------------------------------------- */

enum { LONG = 70 }; /* more than two pieces of any reader */

static uint8_t memory[210];

/* The same arbitrary bytes as a row of each format in turn. */
static pel_crow long_row(int format)
{
    uint32_t state = 195948557u;
    pel_crow row = {{memory, memory + 70, memory + 140}, LONG, PEL_GRAY8, PEL_RANGE_FULL};
    row.format = (pel_format)format;
    for (unsigned i = 0; i < sizeof memory; i++) {
        state = state * 1664525u + 1013904223u;
        memory[i] = (uint8_t)(state >> 24);
    }
    return row;
}

/* Boxes that overlap and leave gaps, and are met by many of the bytes above. */
static void set_wide_boxes(void)
{
    static const pel_color_box wide[4] = {{0, 120, 0, 200, 0, 130},
                                          {100, 255, 40, 255, 60, 255},
                                          {0, 90, 0, 255, 100, 255},
                                          {0, 255, 0, 90, 0, 255}};
    forget_boxes();
    for (unsigned c = 0; c < 4; c++) {
        pel_boxes_set(&boxes, c, &wide[c]);
    }
}

static void check_row(const pel_classifier *classifier, const pel_crow *row)
{
    const uint16_t width = pel_color_width(row->format, row->width);
    uint8_t y[LONG], u[LONG], v[LONG], labels[LONG + 1];
    labels[width] = CANARY;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_crow_read_yuv(row, 0, width, PEL_RANGE_FULL, y, u, v));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_classify_row(classifier, row, labels));
    for (unsigned x = 0; x < width; x++) {
        TEST_ASSERT_EQUAL_UINT8(pel_classify_color(classifier, y[x], u[x], v[x]), labels[x]);
    }
    TEST_ASSERT_EQUAL_HEX8(CANARY, labels[width]);
}

static void test_rows_of_every_format_and_width_are_their_colours(void)
{
    const pel_classifier classifier = classifier_of_boxes();
    set_wide_boxes();
    for (int f = 0; f < PEL_FORMAT_COUNT; f++) {
        pel_crow row = long_row(f);
        unsigned checked = 0;
        for (uint16_t width = 1; width <= LONG; width++) {
            row.width = width;
            if (pel_crow_check(&row) == PEL_OK) {
                check_row(&classifier, &row);
                checked++;
            }
        }
        TEST_ASSERT_EQUAL_UINT(pel_row_bytes(row.format, 1) != 0 ? LONG : LONG / 2, checked);
    }
}

static void test_the_same_scene_has_the_same_labels_in_every_ycbcr_format(void)
{
    static const uint8_t y_plane[4] = {76, 76, 98, 205}, uv_plane[4] = {85, 255, 95, 58};
    static const uint8_t u_plane[2] = {85, 95}, v_plane[2] = {255, 58};
    static const uint8_t yuyv[8] = {76, 85, 76, 255, 98, 95, 205, 58};
    static const uint8_t uyvy[8] = {85, 76, 255, 76, 95, 98, 58, 205};
    static const uint8_t yvyu[8] = {76, 255, 76, 85, 98, 58, 205, 95};
    static const uint8_t vyuy[8] = {255, 76, 85, 76, 58, 98, 95, 205};
    static const pel_crow rows[] = {{{yuyv, NULL, NULL}, 4, PEL_YUYV, PEL_RANGE_FULL},
                                    {{uyvy, NULL, NULL}, 4, PEL_UYVY, PEL_RANGE_FULL},
                                    {{yvyu, NULL, NULL}, 4, PEL_YVYU, PEL_RANGE_FULL},
                                    {{vyuy, NULL, NULL}, 4, PEL_VYUY, PEL_RANGE_FULL},
                                    {{y_plane, uv_plane, NULL}, 4, PEL_NV12, PEL_RANGE_FULL},
                                    {{y_plane, u_plane, v_plane}, 4, PEL_I420, PEL_RANGE_FULL}};
    static const uint8_t expected[4] = {RED, RED, GREEN, UNKNOWN}; /* 205 is too bright for green */
    const pel_classifier classifier = classifier_of_boxes();
    set_field_boxes();
    for (unsigned i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        uint8_t labels[4];
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_classify_row(&classifier, &rows[i], labels));
        TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, labels, 4);
    }
}

static void test_rgb_is_converted_to_the_range_of_the_classes(void)
{
    static const uint8_t white[3] = {255, 255, 255};
    static const pel_color_box white_limited = {235, 235, 128, 128, 128, 128};
    const pel_crow row = pel_crow_packed(white, PEL_RGB888, PEL_RANGE_FULL, 1);
    pel_classifier classifier = classifier_of_boxes();
    uint8_t label;
    forget_boxes();
    pel_boxes_set(&boxes, 0, &white_limited);
    classifier.range = PEL_RANGE_LIMITED;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_classify_row(&classifier, &row, &label));
    TEST_ASSERT_EQUAL_UINT8(1, label);
    classifier.range = PEL_RANGE_FULL;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_classify_row(&classifier, &row, &label));
    TEST_ASSERT_EQUAL_UINT8(0, label);
}

/* ---- Look-up tables ------------------------------------------------------------------------ */

static uint8_t cells[1024];

static void test_the_cell_of_a_colour_is_its_top_bits(void)
{
    static const uint8_t bits[][3] = {{4, 3, 3}, {3, 4, 3}, {1, 4, 5}, {0, 5, 5}, {8, 1, 1},
                                      {1, 8, 0}, {0, 0, 8}, {0, 0, 0}, {10, 0, 0}};
    for (unsigned i = 0; bits[i][0] != 10; i++) {
        const unsigned yb = bits[i][0], ub = bits[i][1], vb = bits[i][2];
        const pel_classifier classifier = {NULL,
                                           {cells, bits[i][0], bits[i][1], bits[i][2]},
                                           PEL_RANGE_FULL,
                                           NULL,
                                           .reader = pel_crow_read_yuv,
                                           .pieces = pel_classify_pieces};
        const unsigned size = 1u << (yb + ub + vb);
        TEST_ASSERT_EQUAL_UINT(size, pel_lut_bytes(yb, ub, vb));
        TEST_ASSERT_EQUAL_UINT(size, PEL_LUT_BYTES(yb, ub, vb));
        for (unsigned n = 0; n < 997; n++) {
            const unsigned y = n * 31 % 256, u = n * 57 % 256, v = n * 101 % 256;
            const unsigned cell =
                ((y >> (8 - yb)) << (ub + vb)) | ((u >> (8 - ub)) << vb) | (v >> (8 - vb));
            cells[cell] = (uint8_t)(n % 255 + 1);
            TEST_ASSERT_EQUAL_UINT8(
                n % 255 + 1, pel_classify_color(&classifier, (uint8_t)y, (uint8_t)u, (uint8_t)v));
            cells[cell] = 0;
        }
    }
}

static void test_a_table_classifies_rows_of_every_format(void)
{
    const pel_classifier classifier = {NULL,
                                       {cells, 4, 3, 3},
                                       PEL_RANGE_FULL,
                                       NULL,
                                       .reader = pel_crow_read_yuv,
                                       .pieces = pel_classify_pieces};
    for (unsigned i = 0; i < sizeof cells; i++) {
        cells[i] = (uint8_t)(i * 37);
    }
    for (int f = 0; f < PEL_FORMAT_COUNT; f++) {
        const pel_crow row = long_row(f);
        check_row(&classifier, &row);
    }
}

static void test_boxes_come_before_a_table(void)
{
    static const pel_color_box anything = {0, 255, 0, 255, 0, 255};
    const pel_classifier classifier = {&boxes,
                                       {cells, 0, 0, 0},
                                       PEL_RANGE_FULL,
                                       NULL,
                                       .reader = pel_crow_read_yuv,
                                       .pieces = pel_classify_pieces};
    forget_boxes();
    pel_boxes_set(&boxes, 4, &anything);
    cells[0] = 99;
    TEST_ASSERT_EQUAL_UINT8(5, pel_classify_color(&classifier, 1, 2, 3));
}

/* ---- Relabel ------------------------------------------------------------------------------- */

static uint8_t map[256];

static void test_several_boxes_can_stand_for_one_colour(void)
{
    pel_classifier classifier = classifier_of_boxes();
    pel_crow row = long_row(PEL_YUYV);
    uint8_t plain[LONG], mapped[LONG];
    for (unsigned i = 0; i < 256; i++) {
        map[i] = (uint8_t)i;
    }
    map[0] = 77; /* the background too */
    map[3] = 1;
    set_wide_boxes();
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_classify_row(&classifier, &row, plain));
    classifier.relabel = map;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_classify_row(&classifier, &row, mapped));
    for (unsigned x = 0; x < LONG; x++) {
        TEST_ASSERT_EQUAL_UINT8(map[plain[x]], mapped[x]);
    }
    check_row(&classifier, &row);
}

static void test_a_table_may_use_every_label(void)
{
    const pel_classifier classifier = {NULL,
                                       {cells, 8, 0, 0},
                                       PEL_RANGE_FULL,
                                       map,
                                       .reader = pel_crow_read_yuv,
                                       .pieces = pel_classify_pieces};
    for (unsigned i = 0; i < 256; i++) {
        cells[i] = (uint8_t)(255 - i);
        map[i] = (uint8_t)(i ^ 0x55u);
    }
    for (unsigned y = 0; y < 256; y++) {
        TEST_ASSERT_EQUAL_UINT8((255 - y) ^ 0x55u,
                                pel_classify_color(&classifier, (uint8_t)y, 1, 2));
    }
}

/* ---- Frames -------------------------------------------------------------------------------- */

static void test_a_frame_is_its_rows(void)
{
    const pel_classifier classifier = classifier_of_boxes();
    pel_cview view;
    pel_view labels;
    uint8_t out[4 * 8], row_labels[6];
    set_wide_boxes();
    (void)long_row(PEL_YUYV);
    pel_cview_init(memory + 3 * 14, PEL_YUYV, PEL_RANGE_FULL, 6, 4, -14, &view);
    pel_view_init(out, PEL_GRAY8, PEL_RANGE_FULL, 6, 4, 8, &labels);
    for (unsigned i = 0; i < sizeof out; i++) {
        out[i] = CANARY;
    }
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_classify_frame(&classifier, &view, &labels));
    for (uint16_t y = 0; y < 4; y++) {
        const pel_crow row = pel_cview_row(&view, y);
        pel_classify_row(&classifier, &row, row_labels);
        TEST_ASSERT_EQUAL_UINT8_ARRAY(row_labels, out + 8 * y, 6);
        TEST_ASSERT_EQUAL_HEX8(CANARY, out[8 * y + 6]);
        TEST_ASSERT_EQUAL_HEX8(CANARY, out[8 * y + 7]);
    }
}

static void test_a_mosaic_has_half_as_many_labels_each_way(void)
{
    const pel_classifier classifier = classifier_of_boxes();
    pel_cview view;
    pel_view labels;
    uint8_t out[64];
    set_wide_boxes();
    pel_cview_init(memory, PEL_BAYER8_BGGR, PEL_RANGE_FULL, 8, 6, 0, &view);
    pel_view_init(out, PEL_GRAY8, PEL_RANGE_FULL, 4, 3, 0, &labels);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_classify_frame(&classifier, &view, &labels));
    pel_view_init(out, PEL_GRAY8, PEL_RANGE_FULL, 8, 6, 0, &labels);
    TEST_ASSERT_EQUAL_INT(PEL_ERR_SPACE, pel_classify_frame(&classifier, &view, &labels));
}

static void test_a_label_picture_of_another_size_is_refused_and_untouched(void)
{
    static const uint16_t wrong[][2] = {{5, 4}, {7, 4}, {6, 3}, {6, 5}};
    const pel_classifier classifier = classifier_of_boxes();
    pel_cview view;
    pel_view labels;
    uint8_t out[64] = {CANARY};
    set_wide_boxes();
    pel_cview_init(memory, PEL_YUYV, PEL_RANGE_FULL, 6, 4, 0, &view);
    for (unsigned i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        pel_view_init(out, PEL_GRAY8, PEL_RANGE_FULL, wrong[i][0], wrong[i][1], 0, &labels);
        TEST_ASSERT_EQUAL_INT(PEL_ERR_SPACE, pel_classify_frame(&classifier, &view, &labels));
    }
    TEST_ASSERT_EQUAL_HEX8(CANARY, out[0]);
    pel_view_init(out, PEL_GRAY8, PEL_RANGE_FULL, 6, 4, 0, &labels);
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_classify_frame(NULL, &view, &labels));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_classify_frame(&classifier, NULL, &labels));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_classify_frame(&classifier, &view, NULL));
}

/* ---- Refusals ------------------------------------------------------------------------------ */

static void test_mixing_ranges_is_refused_and_nothing_is_written(void)
{
    pel_classifier classifier = classifier_of_boxes();
    uint8_t labels[LONG] = {CANARY};
    set_wide_boxes();
    for (int f = PEL_YUYV; f <= PEL_I420; f++) {
        pel_crow row = long_row(f);
        row.range = PEL_RANGE_LIMITED;
        TEST_ASSERT_EQUAL_INT(PEL_ERR_FORMAT, pel_classify_row(&classifier, &row, labels));
        TEST_ASSERT_EQUAL_HEX8(CANARY, labels[0]);
    }
    classifier.boxes = NULL; /* a table is as strict */
    classifier.lut.cell = cells;
    for (int f = PEL_YUYV; f <= PEL_I420; f++) {
        pel_crow row = long_row(f);
        row.range = PEL_RANGE_LIMITED;
        TEST_ASSERT_EQUAL_INT(PEL_ERR_FORMAT, pel_classify_row(&classifier, &row, labels));
        TEST_ASSERT_EQUAL_HEX8(CANARY, labels[0]);
    }
}

static void test_rows_that_cannot_be_are_refused(void)
{
    const pel_classifier classifier = classifier_of_boxes();
    pel_crow row = long_row(PEL_YUYV);
    uint8_t labels[LONG];
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_classify_row(NULL, &row, labels));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_classify_row(&classifier, NULL, labels));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_classify_row(&classifier, &row, NULL));
    row.width = LONG - 1;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_FORMAT, pel_classify_row(&classifier, &row, labels));
    row.width = LONG;
    row.plane[0] = NULL;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_classify_row(&classifier, &row, labels));
}

static void test_a_classifier_without_classes_is_refused(void)
{
    static const pel_classifier nothing = {NULL,
                                           {NULL, 0, 0, 0},
                                           PEL_RANGE_FULL,
                                           NULL,
                                           .reader = pel_crow_read_yuv,
                                           .pieces = pel_classify_pieces};
    static const pel_classifier too_fine = {NULL,
                                            {cells, 9, 0, 0},
                                            PEL_RANGE_FULL,
                                            NULL,
                                            .reader = pel_crow_read_yuv,
                                            .pieces = pel_classify_pieces};
    const pel_crow row = long_row(PEL_YUYV);
    uint8_t labels[LONG];
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_classify_row(&nothing, &row, labels));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_classify_row(&too_fine, &row, labels));
    TEST_ASSERT_EQUAL_UINT8(0, pel_classify_color(&nothing, 1, 2, 3));
    TEST_ASSERT_EQUAL_UINT8(0, pel_classify_color(NULL, 1, 2, 3));
}

static void test_only_boxes_on_ycbcr_do_without_a_reader(void)
{
    pel_classifier classifier = classifier_of_boxes();
    uint8_t labels[LONG];
    set_wide_boxes();
    for (int f = 0; f < 2 * PEL_FORMAT_COUNT; f++) {
        const pel_crow row = long_row(f / 2);
        classifier.reader = f % 2 ? NULL : pel_crow_read_yuv;
        classifier.pieces = f % 2 ? pel_classify_pieces : NULL; /* one without the other */
        labels[0] = CANARY;
        TEST_ASSERT_EQUAL_INT(f / 2 <= PEL_I420 ? PEL_OK : PEL_ERR_FORMAT,
                              pel_classify_row(&classifier, &row, labels));
        TEST_ASSERT_EQUAL_INT(f / 2 <= PEL_I420, labels[0] != CANARY);
    }
    classifier.boxes = NULL;
    classifier.lut.cell = cells;
    for (int f = 0; f < PEL_FORMAT_COUNT; f++) {
        const pel_crow row = long_row(f);
        TEST_ASSERT_EQUAL_INT(PEL_ERR_FORMAT, pel_classify_row(&classifier, &row, labels));
    }
    classifier.reader = pel_crow_read_bayer; /* a reader reads what it is made for */
    for (int f = 0; f < PEL_FORMAT_COUNT; f++) {
        const pel_crow row = long_row(f);
        TEST_ASSERT_EQUAL_INT(f >= PEL_BAYER8_RGGB ? PEL_OK : PEL_ERR_FORMAT,
                              pel_classify_row(&classifier, &row, labels));
    }
}

static void test_no_box_set_means_background_everywhere(void)
{
    const pel_classifier classifier = classifier_of_boxes();
    const pel_crow row = long_row(PEL_YUYV);
    uint8_t labels[LONG];
    forget_boxes();
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_classify_row(&classifier, &row, labels));
    for (unsigned x = 0; x < LONG; x++) {
        TEST_ASSERT_EQUAL_UINT8(0, labels[x]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_both_ends_of_a_box_belong_to_it);
    RUN_TEST(test_a_box_can_be_one_colour_or_all_of_them);
    RUN_TEST(test_a_box_with_its_ends_exchanged_is_empty);
    RUN_TEST(test_setting_a_class_again_replaces_its_box_and_no_other);
    RUN_TEST(test_the_lowest_class_wins_where_boxes_overlap);
    RUN_TEST(test_every_class_has_its_own_label);
    RUN_TEST(test_classes_that_do_not_exist_are_refused);
    RUN_TEST(test_a_robot_tells_five_colours_from_the_unknown);
    RUN_TEST(test_a_colour_and_a_row_of_it_have_the_same_label);
    RUN_TEST(test_a_colour_is_the_first_box_that_holds_it);
    RUN_TEST(test_rows_of_every_format_and_width_are_their_colours);
    RUN_TEST(test_the_same_scene_has_the_same_labels_in_every_ycbcr_format);
    RUN_TEST(test_rgb_is_converted_to_the_range_of_the_classes);
    RUN_TEST(test_the_cell_of_a_colour_is_its_top_bits);
    RUN_TEST(test_a_table_classifies_rows_of_every_format);
    RUN_TEST(test_boxes_come_before_a_table);
    RUN_TEST(test_several_boxes_can_stand_for_one_colour);
    RUN_TEST(test_a_table_may_use_every_label);
    RUN_TEST(test_a_frame_is_its_rows);
    RUN_TEST(test_a_mosaic_has_half_as_many_labels_each_way);
    RUN_TEST(test_a_label_picture_of_another_size_is_refused_and_untouched);
    RUN_TEST(test_mixing_ranges_is_refused_and_nothing_is_written);
    RUN_TEST(test_rows_that_cannot_be_are_refused);
    RUN_TEST(test_a_classifier_without_classes_is_refused);
    RUN_TEST(test_only_boxes_on_ycbcr_do_without_a_reader);
    RUN_TEST(test_no_box_set_means_background_everywhere);
    return UNITY_END();
}
