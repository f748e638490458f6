/*
 * Every one of the 2^24 colours (Y, U, V) classified, by boxes and by look-up tables, against the
 * definition: a colour has the first class whose box holds it, and a table's index is the formula
 * of classify.h. Built for 8, 16 and 32 classes: as each build equals the same definition for the
 * same eight boxes, they equal each other.
 */
#include "check.h"

#include <pel.h>
#include <string.h>

enum { EIGHT = 8, LEVELS = 256 };

static uint64_t seed = UINT64_C(0x2545f4914f6cdd1d);

static pel_boxes tables;
static uint8_t cells[1 << 24];

/* ---- Sets of boxes ------------------------------------------------------------------------- */

static void random_interval(uint8_t *min, uint8_t *max, uint32_t widest)
{
    const uint32_t width = random_below(&seed, widest);
    const uint32_t from = random_below(&seed, LEVELS - width);

    *min = (uint8_t)from;
    *max = (uint8_t)(from + width);
}

static pel_color_box random_box(uint32_t widest)
{
    pel_color_box box;

    random_interval(&box.y_min, &box.y_max, widest);
    random_interval(&box.u_min, &box.u_max, widest);
    random_interval(&box.v_min, &box.v_max, widest);
    return box;
}

/* Wide boxes that overlap each other many times over. */
static void overlapping_boxes(pel_color_box *boxes, unsigned count)
{
    for (unsigned c = 0; c < count; c++) {
        boxes[c] = random_box(LEVELS);
    }
}

/* Slices of Y: no two boxes share a colour. */
static void disjoint_boxes(pel_color_box *boxes, unsigned count)
{
    for (unsigned c = 0; c < count; c++) {
        boxes[c] = random_box(LEVELS);
        boxes[c].y_min = (uint8_t)(c * LEVELS / count);
        boxes[c].y_max = (uint8_t)((c + 1) * LEVELS / count - 1 - random_below(&seed, 3));
    }
}

/* The boxes where mistakes hide: empty, one colour, the ends of each axis, everything. */
static void extreme_boxes(pel_color_box *boxes, unsigned count)
{
    static const pel_color_box extremes[EIGHT] = {
        {1, 0, 0, 255, 0, 255},     {0, 0, 0, 0, 0, 0},         {255, 255, 255, 255, 255, 255},
        {0, 255, 0, 0, 0, 255},     {0, 255, 0, 255, 255, 255}, {128, 128, 0, 255, 0, 255},
        {0, 255, 127, 128, 0, 127}, {0, 255, 0, 255, 0, 255}};

    for (unsigned c = 0; c < count; c++) {
        boxes[c] = c < EIGHT ? extremes[c] : random_box(20);
    }
}

/* ---- The definition ------------------------------------------------------------------------ */

static int holds(const pel_color_box *box, unsigned y, unsigned u, unsigned v)
{
    return y >= box->y_min && y <= box->y_max && u >= box->u_min && u <= box->u_max &&
           v >= box->v_min && v <= box->v_max;
}

/* The labels of the 256 colours of one U and V. */
static void define_labels(const pel_color_box *boxes, unsigned count, unsigned u, unsigned v,
                          uint8_t labels[LEVELS])
{
    for (unsigned y = 0; y < LEVELS; y++) {
        unsigned c = 0;
        while (c < count && !holds(&boxes[c], y, u, v)) {
            c++;
        }
        labels[y] = (uint8_t)(c < count ? c + 1 : 0);
    }
}

/* ---- The comparison ------------------------------------------------------------------------ */

/* The 256 colours of one U and V as a row of YUYV. */
static void fill_row(uint8_t *row, unsigned u, unsigned v)
{
    for (unsigned x = 0; x < LEVELS; x += 2) {
        row[2 * x] = (uint8_t)x;
        row[2 * x + 1] = (uint8_t)u;
        row[2 * x + 2] = (uint8_t)(x + 1);
        row[2 * x + 3] = (uint8_t)v;
    }
}

/* How many of the 256 colours of one U and V get another label than the expected one, as a row and
 * one by one. */
static uint64_t count_wrong(const pel_classifier *classifier, unsigned u, unsigned v,
                            const uint8_t expected[LEVELS])
{
    uint8_t pixels[2 * LEVELS], labels[LEVELS];
    uint64_t wrong = 0;
    pel_crow row;

    fill_row(pixels, u, v);
    row = pel_crow_packed(pixels, PEL_YUYV, PEL_RANGE_FULL, LEVELS);
    memset(labels, 255, sizeof labels);
    wrong += pel_classify_row(classifier, &row, labels) != PEL_OK;
    for (unsigned y = 0; y < LEVELS; y++) {
        wrong += labels[y] != expected[y];
        wrong += pel_classify_color(classifier, (uint8_t)y, (uint8_t)u, (uint8_t)v) != expected[y];
    }
    return wrong;
}

static void check_boxes(tally *checks, const char *name,
                        void (*make)(pel_color_box *boxes, unsigned count), unsigned count)
{
    const pel_classifier classifier = {&tables,
                                       {NULL, 0, 0, 0},
                                       PEL_RANGE_FULL,
                                       NULL,
                                       .reader = pel_crow_read_yuv,
                                       .pieces = pel_classify_pieces};
    pel_color_box boxes[PEL_CLASS_MAX];
    uint64_t wrong = 0, hits[PEL_CLASS_MAX + 1] = {0};

    make(boxes, count);
    memset(&tables, 0, sizeof tables);
    for (unsigned c = 0; c < count; c++) {
        wrong += pel_boxes_set(&tables, c, &boxes[c]) != PEL_OK;
    }
    for (unsigned u = 0; u < LEVELS; u++) {
        for (unsigned v = 0; v < LEVELS; v++) {
            uint8_t expected[LEVELS];
            define_labels(boxes, count, u, v, expected);
            wrong += count_wrong(&classifier, u, v, expected);
            for (unsigned y = 0; y < LEVELS; y++) {
                hits[expected[y]]++;
            }
        }
    }
    printf("     %u %s, colours of each class:", count, name);
    for (unsigned c = 1; c <= count; c++) {
        printf(" %llu", (unsigned long long)hits[c]);
    }
    printf("\n");
    check(checks, name, UINT64_C(2) << 24, wrong);
}

static void check_table(tally *checks, unsigned y_bits, unsigned u_bits, unsigned v_bits)
{
    const pel_classifier classifier = {NULL,
                                       {cells, (uint8_t)y_bits, (uint8_t)u_bits, (uint8_t)v_bits},
                                       PEL_RANGE_FULL,
                                       NULL,
                                       .reader = pel_crow_read_yuv,
                                       .pieces = pel_classify_pieces};
    const size_t size = pel_lut_bytes(y_bits, u_bits, v_bits);
    uint64_t wrong = size != (size_t)1 << (y_bits + u_bits + v_bits);
    char name[32];

    for (size_t i = 0; i < size; i++) {
        cells[i] = (uint8_t)(random_next(&seed) >> 56);
    }
    for (unsigned u = 0; u < LEVELS; u++) {
        for (unsigned v = 0; v < LEVELS; v++) {
            uint8_t expected[LEVELS];
            for (unsigned y = 0; y < LEVELS; y++) {
                expected[y] = cells[((y >> (8 - y_bits)) << (u_bits + v_bits)) |
                                    ((u >> (8 - u_bits)) << v_bits) | (v >> (8 - v_bits))];
            }
            wrong += count_wrong(&classifier, u, v, expected);
        }
    }
    snprintf(name, sizeof name, "table of %u, %u, %u bits", y_bits, u_bits, v_bits);
    check(checks, name, UINT64_C(2) << 24, wrong);
}

int main(void)
{
    tally checks = {0, 0};

    printf("built for %d classes\n", PEL_CLASS_MAX);
    check_boxes(&checks, "overlapping boxes", overlapping_boxes, EIGHT);
    check_boxes(&checks, "disjoint boxes", disjoint_boxes, EIGHT);
    check_boxes(&checks, "extreme boxes", extreme_boxes, EIGHT);
#if PEL_CLASS_MAX > 8
    check_boxes(&checks, "overlapping boxes of all classes", overlapping_boxes, PEL_CLASS_MAX);
    check_boxes(&checks, "disjoint boxes of all classes", disjoint_boxes, PEL_CLASS_MAX);
#endif
    check_table(&checks, 3, 5, 5);
    check_table(&checks, 4, 6, 6);
    check_table(&checks, 0, 6, 6);
    check_table(&checks, 8, 1, 0);
    check_table(&checks, 0, 0, 0);
    check_table(&checks, 8, 8, 8);
    return checks_end(&checks);
}
