/* Rows straight from pixels: pel_blobs_pixels and pel_blobs_frame say what pel_classify_row and
 * pel_blobs_row say one after the other, for every format and every kind of classifier. */
#include "check.h"
#include "reference.h"

#include <string.h>

enum {
    SIDE_MAX = 40,
    LUT_BITS = 2,
    CELLS = 1 << (3 * LUT_BITS),
    RESULTS = SIDE_MAX * SIDE_MAX,
    ROOM = PEL_BLOBS_WORDS(SIDE_MAX, SIDE_MAX, PEL_MEASURE_ALL)
};

/* A picture, what classifies it, and what is asked of the finder. */
typedef struct scene {
    uint8_t bytes[3 * SIDE_MAX * SIDE_MAX];
    pel_cview view;
    pel_boxes boxes;
    uint8_t cells[CELLS];
    uint8_t relabel[256];
    pel_classify_plan plan;
    pel_classifier classifier;
    pel_blob_filter filter;
    pel_blobs_config config;
} scene;

/* What came out. */
typedef struct outcome {
    pel_status worst;
    uint32_t count;
    pel_blobs_counts counts;
    pel_blob blobs[RESULTS];
} outcome;

static uint64_t work[ROOM];
static uint8_t labels[SIDE_MAX];

/* ---- Scenes ---------------------------------------------------------------------------------- */

/* Few values, often repeated, so that there are runs to find. */
static void fill(rng *random, uint8_t *bytes, size_t count)
{
    const uint32_t values = 1 + rng_below(random, 6), stay = rng_below(random, 8);
    size_t i;
    for (i = 0; i < count; i++) {
        const int again = i >= 6 && rng_below(random, 8) < stay;
        bytes[i] = again ? bytes[i - 6 + i % 2 * 2] : (uint8_t)(rng_below(random, values) * 50);
    }
}

static void random_classifier(rng *random, scene *s)
{
    unsigned c, i;
    memset(&s->boxes, 0, sizeof s->boxes);
    for (c = 0; c < 8; c++) {
        pel_color_box box = {0, 255, 0, 255, 0, 255};
        box.y_min = (uint8_t)rng_below(random, 200);
        box.y_max = (uint8_t)(box.y_min + rng_below(random, 56));
        box.u_min = (uint8_t)rng_below(random, 150);
        box.v_max = (uint8_t)(100 + rng_below(random, 156));
        check_that(pel_boxes_set(&s->boxes, c, &box) == PEL_OK, "pel_boxes_set");
    }
    for (i = 0; i < CELLS; i++) {
        s->cells[i] = (uint8_t)(rng_below(random, 3) * rng_below(random, 128));
    }
    for (i = 0; i < 256; i++) {
        s->relabel[i] = (uint8_t)rng_below(random, 4);
    }
    memset(&s->classifier, 0, sizeof s->classifier);
    s->classifier.boxes = rng_below(random, 3) > 0 ? &s->boxes : NULL;
    s->classifier.lut.cell = s->cells;
    s->classifier.lut.y_bits = LUT_BITS;
    s->classifier.lut.u_bits = LUT_BITS;
    s->classifier.lut.v_bits = LUT_BITS;
    s->classifier.range = s->view.range;
    s->classifier.relabel = rng_below(random, 3) == 0 ? s->relabel : NULL;
    s->classifier.reader = pel_crow_read_yuv;
    s->classifier.pieces = pel_classify_pieces;
    if (rng_below(random, 2) == 0) {
        const pel_backend wish = (pel_backend)rng_below(random, PEL_BACKEND_COUNT);
        check_that(pel_classify_plan_make(&s->plan, &s->boxes, wish) >= PEL_OK, "plan");
        s->classifier.plan = &s->plan;
    }
}

static void random_scene(rng *random, pel_format format, scene *s)
{
    const uint16_t width = (uint16_t)(2 * (1 + rng_below(random, SIDE_MAX / 2)));
    const uint16_t height = (uint16_t)(2 * (1 + rng_below(random, SIDE_MAX / 2)));
    const pel_range range = (pel_range)rng_below(random, 2);
    fill(random, s->bytes, sizeof s->bytes);
    check_that(pel_cview_init(s->bytes, format, range, width, height, 0, &s->view) == PEL_OK,
               "view");
    random_classifier(random, s);
    memset(&s->filter, 0, sizeof s->filter);
    s->filter.area_min = rng_below(random, 3);
    memset(&s->config, 0, sizeof s->config);
    s->config.width = pel_color_width(format, width);
    s->config.height = pel_color_height(format, height);
    s->config.open_max = (uint16_t)(1 + rng_below(random, SIDE_MAX));
    s->config.connectivity = rng_below(random, 2) ? 4 : 8;
    s->config.measure = (uint8_t)rng_below(random, 8);
    s->config.measurer = s->config.measure != 0 ? pel_blobs_measure : NULL;
    s->config.backend = (pel_backend)rng_below(random, PEL_BACKEND_COUNT);
    s->config.work = work;
    s->config.work_bytes = sizeof work;
    s->config.filter = &s->filter;
    s->config.reader = pel_crow_read_yuv;
    s->config.results_max = rng_below(random, 2) ? RESULTS : 3;
}

/* ---- Three ways ------------------------------------------------------------------------------ */

static pel_status two_calls(const scene *s, pel_blobs *finder, uint16_t y)
{
    pel_crow row = pel_cview_row(&s->view, y);
    const pel_status status = pel_classify_row(&s->classifier, &row, labels);
    row.range = s->classifier.range; /* RGB is read in the range of the classes */
    return status < 0 ? status : pel_blobs_row(finder, y, labels, &row);
}

static pel_status one_call(const scene *s, pel_blobs *finder, uint16_t y)
{
    const pel_crow row = pel_cview_row(&s->view, y);
    return pel_blobs_pixels(finder, y, &s->classifier, &row, labels);
}

static void by_rows(const scene *s, pel_status add(const scene *, pel_blobs *, uint16_t),
                    outcome *out)
{
    pel_blobs finder;
    pel_blobs_config config = s->config;
    pel_status status;
    uint16_t y;
    config.results = out->blobs;
    memset(work, 0x5C, sizeof work);
    out->worst = pel_blobs_begin(&finder, &config);
    for (y = 0; y < config.height; y++) {
        status = add(s, &finder, y);
        out->worst = status > out->worst || status < 0 ? status : out->worst;
    }
    status = pel_blobs_end(&finder, &out->count);
    out->worst = status > out->worst || status < 0 ? status : out->worst;
    out->counts = finder.counts;
}

static void by_frame(const scene *s, outcome *out)
{
    pel_blobs finder;
    pel_blobs_config config = s->config;
    config.results = out->blobs;
    out->worst = pel_blobs_frame(&finder, &config, &s->classifier, &s->view, labels, &out->count);
    out->counts = finder.counts;
}

static void compare(const outcome *expected, const outcome *found, const char *way)
{
    uint32_t i;
    check_that(found->worst == expected->worst, "%s: status %d, not %d", way, (int)found->worst,
               (int)expected->worst);
    check_that(found->count == expected->count, "%s: %u blobs, not %u", way, (unsigned)found->count,
               (unsigned)expected->count);
    check_that(memcmp(&found->counts.found, &expected->counts.found, 7 * sizeof(uint32_t)) == 0 &&
                   found->counts.open_peak == expected->counts.open_peak,
               "%s: counts", way);
    for (i = 0; i < expected->count && i < found->count; i++) {
        check_that(ref_compare_all(&found->blobs[i], &expected->blobs[i]) == 0, "%s: blob %u", way,
                   (unsigned)i);
    }
}

static void format_in_three_ways(pel_format format, uint32_t scale)
{
    static scene s;
    static outcome expected, found;
    const uint32_t images = 400 / scale + 1;
    rng random = rng_seeded(500 + (uint64_t)format);
    uint64_t blobs = 0;
    uint32_t i;
    check_group("%u random %s frames in three ways (seed %u)", (unsigned)images,
                pel_format_name(format), 500 + (unsigned)format);
    for (i = 0; i < images; i++) {
        random_scene(&random, format, &s);
        by_rows(&s, two_calls, &expected);
        check_that(expected.worst >= 0, "status %d", (int)expected.worst);
        by_rows(&s, one_call, &found);
        compare(&expected, &found, "pel_blobs_pixels");
        by_frame(&s, &found);
        compare(&expected, &found, "pel_blobs_frame");
        blobs += expected.count;
    }
    check_that(blobs > images, "only %u blobs", (unsigned)blobs);
    check_count(images, blobs);
}

/* ---- What is refused ------------------------------------------------------------------------- */

/* Row 0 of a scene with a finder that has begun: a call that must be refused, then one that must
 * not, so nothing was harmed. */
static void expect_refused(const scene *s, const pel_classifier *classifier, const pel_crow *row,
                           uint16_t y, uint8_t *row_labels, pel_status expected, const char *what)
{
    static pel_blob blobs[RESULTS];
    pel_blobs finder;
    pel_blobs_config config = s->config;
    pel_status status;
    config.results = blobs;
    check_that(pel_blobs_begin(&finder, &config) == PEL_OK, "begin");
    status = pel_blobs_pixels(&finder, y, classifier, row, row_labels);
    check_that(status == expected, "%s: status %d, not %d", what, (int)status, (int)expected);
    check_that(one_call(s, &finder, 0) >= PEL_OK, "%s: the row that is due", what);
}

static void refused(void)
{
    static scene s;
    rng random = rng_seeded(77);
    pel_classifier bad;
    pel_crow row, other;
    pel_blobs idle;
    memset(&idle, 0, sizeof idle);
    check_group("rows that do not fit are refused");
    random_scene(&random, PEL_YUYV, &s);
    s.classifier.boxes = &s.boxes;
    s.config.measure = PEL_MEASURE_COLOR;
    s.config.measurer = pel_blobs_measure;
    row = pel_cview_row(&s.view, 0);
    check_that(pel_blobs_pixels(NULL, 0, &s.classifier, &row, labels) == PEL_ERR_ARG, "finder");
    check_that(pel_blobs_pixels(&idle, 0, &s.classifier, &row, labels) == PEL_ERR_ORDER,
               "never begun");
    expect_refused(&s, NULL, &row, 0, labels, PEL_ERR_ARG, "classifier NULL");
    expect_refused(&s, &s.classifier, NULL, 0, labels, PEL_ERR_ARG, "pixels NULL");
    expect_refused(&s, &s.classifier, &row, 0, NULL, PEL_ERR_ARG, "labels NULL");
    expect_refused(&s, &s.classifier, &row, 1, labels, PEL_ERR_ORDER, "the row after");
    expect_refused(&s, &s.classifier, &row, 0, s.bytes + 1, PEL_ERR_ARG, "labels in the row");
    expect_refused(&s, &s.classifier, &row, 0, (uint8_t *)work, PEL_ERR_ARG, "labels in work");
    bad = s.classifier;
    bad.boxes = NULL;
    bad.lut.cell = NULL;
    expect_refused(&s, &bad, &row, 0, labels, PEL_ERR_ARG, "no classes");
    bad = s.classifier;
    bad.range = s.view.range == PEL_RANGE_FULL ? PEL_RANGE_LIMITED : PEL_RANGE_FULL;
    expect_refused(&s, &bad, &row, 0, labels, PEL_ERR_FORMAT, "range");
    bad = s.classifier;
    bad.boxes = NULL;
    bad.reader = pel_crow_read_bayer;
    expect_refused(&s, &bad, &row, 0, labels, PEL_ERR_FORMAT, "reader of another format");
    other = row;
    other.width = (uint16_t)(row.width - 2);
    expect_refused(&s, &s.classifier, &other, 0, labels,
                   other.width == 0 ? PEL_ERR_RANGE : PEL_ERR_FORMAT, "narrower");
    other.width = (uint16_t)(row.width + 2);
    expect_refused(&s, &s.classifier, &other, 0, labels, PEL_ERR_FORMAT, "wider");
    other = row;
    other.plane[0] = NULL;
    expect_refused(&s, &s.classifier, &other, 0, labels, PEL_ERR_ARG, "plane NULL");
    other = row;
    other.format = PEL_FORMAT_COUNT;
    expect_refused(&s, &s.classifier, &other, 0, labels, PEL_ERR_ARG, "no format");
    s.config.reader = pel_crow_read_ycbcr;
    other = pel_crow_packed(s.bytes, PEL_RGB888, s.view.range, row.width);
    expect_refused(&s, &s.classifier, &other, 0, labels, PEL_ERR_FORMAT, "the reader of colour");
}

int main(int argc, char **argv)
{
    const uint32_t scale = check_scale(argc, argv);
    int format;
    for (format = 0; format < PEL_FORMAT_COUNT; format++) {
        format_in_three_ways((pel_format)format, scale);
    }
    refused();
    return check_finish();
}
