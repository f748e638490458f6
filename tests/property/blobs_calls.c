/*
 * The contract of the calls: what is refused and by which name, that a refusal touches nothing and
 * harms no frame, when callbacks come, and how much memory is needed.
 */
#include "finder.h"

#include <stdio.h>
#include <string.h>

enum { WIDTH = 6, HEIGHT = 4, OPEN_MAX = 3, RESULTS = 5 };

static guarded work_memory;
static pel_blob results[RESULTS];

/* A small frame of two blobs: an L of class 0 and a bar of class 1. */
static const uint8_t frame[HEIGHT][WIDTH] = {
    {1, 0, 0, 0, 0, 0},
    {1, 0, 0, 2, 2, 2},
    {1, 1, 0, 0, 0, 0},
    {0, 0, 0, 0, 0, 0},
};

static pel_blobs_config good_config(unsigned measure)
{
    pel_blobs_config config;
    memset(&config, 0, sizeof config);
    config.width = WIDTH;
    config.height = HEIGHT;
    config.open_max = OPEN_MAX;
    config.measure = (uint8_t)measure;
    config.work_bytes = PEL_BLOBS_BYTES(WIDTH, OPEN_MAX, measure);
    config.work = guarded_take(&work_memory, config.work_bytes, 0, 0x33);
    config.results = results;
    config.results_max = RESULTS;
    config.measurer = pel_blobs_measure;
    config.reader = pel_crow_read_ycbcr;
    return config;
}

/* ---- begin ----------------------------------------------------------------------------------- */

static void expect_begin(pel_blobs_config config, pel_status expected, const char *what)
{
    pel_blobs blobs, before;
    pel_status status;
    size_t i;
    int work_untouched = 1;
    memset(&blobs, 0x77, sizeof blobs);
    memcpy(&before, &blobs, sizeof blobs);
    status = pel_blobs_begin(&blobs, &config);
    check_that(status == expected, "%s: status %d, not %d", what, (int)status, (int)expected);
    if (status < 0) {
        check_that(memcmp(&blobs, &before, sizeof blobs) == 0, "%s: refused, but wrote *blobs",
                   what);
        for (i = 0; i < work_memory.size; i++) {
            work_untouched &= work_memory.bytes[i] == 0x33;
        }
        check_that(work_untouched, "%s: refused, but wrote work", what);
    }
    check_that(guarded_intact(&work_memory), "%s: wrote outside work", what);
}

static void begin_null_pointers(void)
{
    pel_blobs blobs;
    pel_blobs_config config;
    check_group("begin: null pointers");
    config = good_config(0);
    expect_begin(config, PEL_OK, "the good config");
    check_that(pel_blobs_begin(NULL, &config) == PEL_ERR_ARG, "blobs NULL");
    check_that(pel_blobs_begin(&blobs, NULL) == PEL_ERR_ARG, "config NULL");
    config = good_config(0);
    config.work = NULL;
    expect_begin(config, PEL_ERR_ARG, "work NULL");
    config = good_config(0);
    config.results = NULL;
    expect_begin(config, PEL_ERR_ARG, "results NULL, results_max 5");
    config.results_max = 0;
    expect_begin(config, PEL_OK, "results NULL, results_max 0");
}

static void begin_choices(void)
{
    pel_blobs_config config;
    unsigned value;
    check_group("begin: every connectivity, measure byte and backend");
    for (value = 0; value < 256; value++) {
        config = good_config(PEL_MEASURE_ALL);
        config.measure = 0;
        config.connectivity = (uint8_t)value;
        expect_begin(config, value == 0 || value == 4 || value == 8 ? PEL_OK : PEL_ERR_ARG,
                     "connectivity");
        config = good_config(PEL_MEASURE_ALL);
        config.measure = (uint8_t)value;
        expect_begin(config, value <= PEL_MEASURE_ALL ? PEL_OK : PEL_ERR_ARG, "measure");
        config = good_config(PEL_MEASURE_ALL);
        config.measure = (uint8_t)value;
        config.reader = NULL;
        expect_begin(config, value < PEL_MEASURE_COLOR ? PEL_OK : PEL_ERR_ARG, "no reader");
        config = good_config(PEL_MEASURE_ALL);
        config.measure = (uint8_t)value;
        config.measurer = NULL;
        expect_begin(config, value == 0 ? PEL_OK : PEL_ERR_ARG, "no measurer");
        config = good_config(0);
        config.backend = (pel_backend)value;
        expect_begin(config, value < PEL_BACKEND_COUNT ? PEL_OK : PEL_ERR_ARG, "backend");
    }
}

static void begin_open_max(void)
{
    const uint16_t most = (uint16_t)PEL_BLOBS_OPEN_LIMIT;
    const size_t room = PEL_BLOBS_BYTES(WIDTH, 65535u, PEL_MEASURE_ALL);
    pel_blobs_config config;
    check_group("begin: open_max from 1 to its limit");
    config = good_config(PEL_MEASURE_ALL);
    config.work_bytes = room;
    config.work = guarded_take(&work_memory, room, 0, 0x33);
    config.open_max = 0;
    expect_begin(config, PEL_ERR_ARG, "open_max 0");
    config.open_max = (uint16_t)(most + 1u);
    expect_begin(config, PEL_ERR_ARG, "open_max over the limit");
    config.open_max = 65535;
    expect_begin(config, PEL_ERR_ARG, "open_max 65535");
    config.open_max = most;
    expect_begin(config, PEL_OK, "open_max at the limit");
}

static void begin_memory(void)
{
    static const uint16_t widths[] = {1, 2, 3, 7, 8, 64, 320, 8192};
    static const uint16_t opens[] = {1, 2, 3, 5, 32, 321};
    unsigned w, o, measure, offset;
    check_group("begin: work one byte too small, and misaligned");
    for (w = 0; w < sizeof widths / sizeof widths[0]; w++) {
        for (o = 0; o < sizeof opens / sizeof opens[0]; o++) {
            for (measure = 0; measure <= PEL_MEASURE_ALL; measure++) {
                const size_t need = PEL_BLOBS_BYTES(widths[w], opens[o], measure);
                pel_blobs_config config = good_config(0);
                config.width = widths[w];
                config.open_max = opens[o];
                config.measure = (uint8_t)measure;
                check_that(pel_blobs_bytes(widths[w], opens[o], measure) == need,
                           "pel_blobs_bytes(%u, %u, %u)", widths[w], opens[o], measure);
                config.work = guarded_take(&work_memory, need, 0, 0x33);
                config.work_bytes = need;
                expect_begin(config, PEL_OK, "as many bytes as needed");
                config.work = guarded_take(&work_memory, need - 1, 0, 0x33);
                config.work_bytes = need - 1;
                expect_begin(config, PEL_ERR_SPACE, "one byte less");
                config.work_bytes = 0;
                expect_begin(config, PEL_ERR_SPACE, "no byte");
            }
        }
    }
    for (offset = 1; offset < 8; offset++) {
        pel_blobs_config config = good_config(0);
        config.work = guarded_take(&work_memory, config.work_bytes, offset, 0x33);
        expect_begin(config, PEL_ERR_ARG, "misaligned work");
    }
}

static void sized(uint16_t width, uint16_t height, pel_status expected)
{
    pel_blobs_config config = good_config(0);
    char what[48];
    config.width = width;
    config.height = height;
    config.work_bytes = PEL_BLOBS_BYTES(width, OPEN_MAX, 0);
    config.work = guarded_take(&work_memory, config.work_bytes, 0, 0x33);
    snprintf(what, sizeof what, "%u x %u", width, height);
    expect_begin(config, expected, what);
}

/* The bound: width * width * height and width * height * height at most 2^33. */
static void begin_sizes(void)
{
    uint32_t width, height;
    uint32_t refused = 0;
    check_group("begin: sizes up to the last whose sums fit 32 bits");
    sized(0, 1, PEL_ERR_RANGE);
    sized(1, 0, PEL_ERR_RANGE);
    sized(0, 0, PEL_ERR_RANGE);
    sized(8193, 1, PEL_ERR_RANGE);
    sized(1, 8193, PEL_ERR_RANGE);
    sized(65535, 1, PEL_ERR_RANGE);
    sized(1, 65535, PEL_ERR_RANGE);
    sized(65535, 65535, PEL_ERR_RANGE);
    sized(1, 1, PEL_OK);
    sized(8192, 1, PEL_OK);
    sized(1, 8192, PEL_OK);
    sized(1920, 1080, PEL_OK);
    sized(2048, 2048, PEL_OK);
    sized(2048, 2049, PEL_ERR_RANGE);
    sized(2049, 2048, PEL_ERR_RANGE);
    sized(2592, 1944, PEL_ERR_RANGE);
    sized(8192, 128, PEL_OK);
    sized(8192, 129, PEL_ERR_RANGE);
    sized(128, 8192, PEL_OK);
    sized(129, 8192, PEL_ERR_RANGE);
    for (width = 1; width <= 8192; width += width < 8 ? 1 : width / 7) {
        for (height = 1; height <= 8192; height += height < 8 ? 1 : height / 7) {
            const uint64_t larger = width > height ? width : height;
            const int fits = larger * width * height <= (uint64_t)1 << 33;
            sized((uint16_t)width, (uint16_t)height, fits ? PEL_OK : PEL_ERR_RANGE);
            refused += !fits;
        }
    }
    check_that(refused > 10, "no size was over the bound");
}

/* ---- rows in order --------------------------------------------------------------------------- */

static pel_status add(pel_blobs *blobs, uint16_t y)
{
    return pel_blobs_row(blobs, y, frame[y % HEIGHT], NULL);
}

/* Finishes the frame from row y on: whatever was refused before, both blobs come out whole. */
static void finish_unharmed(pel_blobs *blobs, uint16_t y)
{
    uint32_t count = 99;
    for (; y < HEIGHT; y++) {
        check_that(add(blobs, y) == PEL_OK, "row %u", y);
    }
    check_that(pel_blobs_end(blobs, &count) == PEL_OK && count == 2, "end: %u blobs",
               (unsigned)count);
    check_that(results[0].area == 4 && results[0].class_index == 0 && results[1].area == 3 &&
                   results[1].class_index == 1,
               "areas %u %u", (unsigned)results[0].area, (unsigned)results[1].area);
    check_that(blobs->counts.found == 2 && blobs->counts.lost_px == 0, "counts");
}

static void refuse_row(pel_blobs *blobs, uint16_t y, const uint8_t *labels, pel_status expected,
                       const char *what)
{
    pel_blobs before;
    uint8_t work[512];
    pel_status status;
    memcpy(&before, blobs, sizeof before);
    memcpy(work, work_memory.bytes, work_memory.size);
    status = pel_blobs_row(blobs, y, labels, NULL);
    check_that(status == expected, "%s: status %d, not %d", what, (int)status, (int)expected);
    check_that(memcmp(blobs, &before, sizeof before) == 0, "%s: changed *blobs", what);
    check_that(memcmp(work, work_memory.bytes, work_memory.size) == 0, "%s: changed work", what);
}

static void refuse_end(pel_blobs *blobs, uint32_t *count, pel_status expected, const char *what)
{
    const uint32_t count_before = count != NULL ? *count : 0;
    pel_blobs before;
    pel_status status;
    memcpy(&before, blobs, sizeof before);
    status = pel_blobs_end(blobs, count);
    check_that(status == expected, "%s: status %d, not %d", what, (int)status, (int)expected);
    check_that(memcmp(blobs, &before, sizeof before) == 0, "%s: changed *blobs", what);
    check_that(count == NULL || *count == count_before, "%s: changed *count", what);
}

static void rows_out_of_order(void)
{
    pel_blobs blobs;
    pel_blobs_config config = good_config(PEL_MEASURE_MOMENTS | PEL_MEASURE_OUTLINE);
    uint32_t count = 4711;
    uint16_t y;
    check_group("rows out of order are refused and the frame goes on");
    check_that(pel_blobs_begin(&blobs, &config) == PEL_OK, "begin");
    refuse_row(&blobs, 1, frame[1], PEL_ERR_ORDER, "first row skipped");
    refuse_end(&blobs, &count, PEL_ERR_ORDER, "end before any row");
    for (y = 0; y < HEIGHT; y++) {
        check_that(add(&blobs, y) == PEL_OK, "row %u", y);
        refuse_row(&blobs, y, frame[y], PEL_ERR_ORDER, "row repeated");
        refuse_row(&blobs, (uint16_t)(y + 2), frame[0], PEL_ERR_ORDER, "row skipped");
        refuse_row(&blobs, 65535, frame[0], PEL_ERR_ORDER, "row 65535");
        if (y + 1 < HEIGHT) {
            refuse_row(&blobs, (uint16_t)(y + 1), NULL, PEL_ERR_ARG, "labels NULL");
            refuse_end(&blobs, &count, PEL_ERR_ORDER, "end too early");
        }
    }
    refuse_row(&blobs, HEIGHT, frame[0], PEL_ERR_ORDER, "row below the frame");
    refuse_end(&blobs, NULL, PEL_ERR_ARG, "count NULL");
    finish_unharmed(&blobs, HEIGHT);
    refuse_row(&blobs, 0, frame[0], PEL_ERR_ORDER, "row 0 after the end");
    refuse_row(&blobs, HEIGHT, frame[0], PEL_ERR_ORDER, "next row after the end");
    refuse_end(&blobs, &count, PEL_ERR_ORDER, "end twice");
    check_that(guarded_intact(&work_memory), "wrote outside work");
}

static void finder_never_begun(void)
{
    pel_blobs blobs;
    uint32_t count = 4711;
    check_group("a finder that was never begun refuses rows and end");
    memset(&blobs, 0, sizeof blobs);
    check_that(pel_blobs_row(&blobs, 0, frame[0], NULL) == PEL_ERR_ORDER, "row");
    check_that(pel_blobs_end(&blobs, &count) == PEL_ERR_ORDER && count == 4711, "end");
    check_that(pel_blobs_row(NULL, 0, frame[0], NULL) == PEL_ERR_ARG, "row of NULL");
    check_that(pel_blobs_end(NULL, &count) == PEL_ERR_ARG && count == 4711, "end of NULL");
}

static void begin_again(void)
{
    pel_blobs blobs;
    pel_blobs_config config = good_config(0);
    uint16_t rows;
    check_group("begin in the middle of a frame forgets it");
    for (rows = 0; rows <= HEIGHT; rows++) {
        uint16_t y;
        check_that(pel_blobs_begin(&blobs, &config) == PEL_OK, "begin");
        for (y = 0; y < rows; y++) {
            check_that(add(&blobs, y) == PEL_OK, "row %u", y);
        }
        check_that(pel_blobs_begin(&blobs, &config) == PEL_OK, "begin again");
        finish_unharmed(&blobs, 0);
    }
    /* The config was copied: what happens to the caller's is of no account. */
    check_that(pel_blobs_begin(&blobs, &config) == PEL_OK, "begin");
    memset(&config, 0, sizeof config);
    finish_unharmed(&blobs, 0);
}

/* ---- pixels for the mean colour -------------------------------------------------------------- */

static void pixels_for_colour(void)
{
    static const uint8_t gray[2 * WIDTH] = {10, 20, 30, 40, 50, 60, 70, 80, 90, 100, 110, 120};
    pel_blobs blobs;
    pel_blobs_config config = good_config(PEL_MEASURE_COLOR);
    pel_crow row = pel_crow_packed(gray, PEL_GRAY8, PEL_RANGE_FULL, WIDTH);
    pel_crow bad;
    uint32_t count = 0;
    uint16_t y;
    check_group("colour: rows of pixels that do not fit are refused");
    check_that(pel_blobs_begin(&blobs, &config) == PEL_OK, "begin");
    check_that(pel_blobs_row(&blobs, 0, frame[0], NULL) == PEL_ERR_ARG, "pixels NULL");
    bad = row;
    bad.width = WIDTH - 1;
    check_that(pel_blobs_row(&blobs, 0, frame[0], &bad) == PEL_ERR_FORMAT, "narrower");
    bad.width = 2 * WIDTH;
    check_that(pel_blobs_row(&blobs, 0, frame[0], &bad) == PEL_ERR_FORMAT, "wider");
    bad.width = WIDTH; /* a Bayer row of this width has half as many colours */
    bad.plane[1] = gray;
    bad.format = PEL_BAYER8_RGGB;
    check_that(pel_blobs_row(&blobs, 0, frame[0], &bad) == PEL_ERR_FORMAT, "Bayer");
    bad.format = PEL_BGR888; /* not for this reader */
    check_that(pel_blobs_row(&blobs, 0, frame[0], &bad) == PEL_ERR_FORMAT, "BGR888");
    bad = row;
    bad.plane[0] = NULL;
    check_that(pel_blobs_row(&blobs, 0, frame[0], &bad) == PEL_ERR_ARG, "plane NULL");
    for (y = 0; y < HEIGHT; y++) {
        check_that(pel_blobs_row(&blobs, y, frame[y], &row) == PEL_OK, "row %u", y);
    }
    check_that(pel_blobs_end(&blobs, &count) == PEL_OK && count == 2, "end");
    /* (10 + 10 + 10 + 20) / 4 = 12.5 rounds to 13; (40 + 50 + 60) / 3 = 50 */
    check_that(results[0].mean_y == 13 && results[0].mean_u == 128 && results[0].mean_v == 128,
               "the L: %u %u %u", results[0].mean_y, results[0].mean_u, results[0].mean_v);
    check_that(results[1].mean_y == 50, "the bar: %u", results[1].mean_y);
    check_that(guarded_intact(&work_memory), "wrote outside work");
}

/* ---- callbacks ------------------------------------------------------------------------------- */

typedef struct witness {
    int order[8];
    int calls;
    int during; /* the row that is being added, or HEIGHT */
} witness;

static void see(void *user, const pel_blob *blob)
{
    witness *me = user;
    if (me->calls < 4) {
        me->order[2 * me->calls] = me->during;
        me->order[2 * me->calls + 1] = blob->class_index;
    }
    me->calls++;
}

static void callbacks_come_early(void)
{
    pel_blobs blobs;
    pel_blobs_config config = good_config(0);
    witness me;
    uint32_t count = 99;
    memset(&me, 0, sizeof me);
    check_group("callbacks come with the row below the blob");
    config.on_blob = see;
    config.user = &me;
    config.results = NULL;
    config.results_max = 0;
    check_that(pel_blobs_begin(&blobs, &config) == PEL_OK, "begin");
    for (me.during = 0; me.during < HEIGHT; me.during++) {
        check_that(add(&blobs, (uint16_t)me.during) == PEL_OK, "row");
    }
    check_that(me.calls == 2, "%d calls before the end", me.calls);
    check_that(me.order[0] == 2 && me.order[1] == 1, "the bar, during row %d", me.order[0]);
    check_that(me.order[2] == 3 && me.order[3] == 0, "the L, during row %d", me.order[2]);
    check_that(pel_blobs_end(&blobs, &count) == PEL_OK && count == 0, "end: %u results",
               (unsigned)count);
    check_that(me.calls == 2 && blobs.counts.found == 2 && blobs.counts.dropped == 0 &&
                   blobs.counts.dropped_px == 0,
               "no results asked: nothing dropped");
}

/* ---- the frame form -------------------------------------------------------------------------- */

typedef struct frame_call {
    pel_blobs_config config;
    pel_classifier classifier;
    pel_boxes boxes;
    pel_cview view;
    uint8_t pixels[WIDTH * HEIGHT];
    uint8_t labels[WIDTH];
} frame_call;

static void good_frame_call(frame_call *call)
{
    const pel_color_box box = {100, 255, 0, 255, 0, 255};
    memset(call, 0, sizeof *call);
    call->config = good_config(0);
    check_that(pel_boxes_set(&call->boxes, 0, &box) == PEL_OK, "box");
    call->classifier.boxes = &call->boxes;
    memset(call->pixels, 120, sizeof call->pixels);
    check_that(pel_cview_init(call->pixels, PEL_GRAY8, PEL_RANGE_FULL, WIDTH, HEIGHT, 0,
                              &call->view) == PEL_OK,
               "view");
}

static void expect_frame(frame_call *call, pel_status expected, const char *what)
{
    pel_blobs blobs, before;
    uint32_t count = 4711;
    pel_status status;
    memset(&blobs, 0x77, sizeof blobs);
    memcpy(&before, &blobs, sizeof blobs);
    status = pel_blobs_frame(&blobs, &call->config, &call->classifier, &call->view, call->labels,
                             &count);
    check_that(status == expected, "%s: status %d, not %d", what, (int)status, (int)expected);
    if (expected < 0) {
        check_that(count == 4711, "%s: refused, but wrote *count", what);
        check_that(memcmp(&blobs, &before, sizeof blobs) == 0, "%s: refused, but wrote *blobs",
                   what);
        check_that(work_memory.bytes[0] == 0x33, "%s: refused, but wrote work", what);
    } else {
        check_that(count == 1 && results[0].area == WIDTH * HEIGHT, "%s: %u blobs", what,
                   (unsigned)count);
    }
    check_that(guarded_intact(&work_memory), "%s: wrote outside work", what);
}

static void frame_sizes_and_formats(void)
{
    frame_call call;
    check_group("frame: what does not fit is refused");
    good_frame_call(&call);
    expect_frame(&call, PEL_OK, "the good call");
    good_frame_call(&call);
    call.config.width = WIDTH - 1;
    expect_frame(&call, PEL_ERR_RANGE, "narrower config");
    good_frame_call(&call);
    call.config.height = HEIGHT + 1;
    expect_frame(&call, PEL_ERR_RANGE, "higher config");
    good_frame_call(&call);
    call.view.range = PEL_RANGE_LIMITED;
    expect_frame(&call, PEL_ERR_FORMAT, "range of the view");
    good_frame_call(&call);
    call.classifier.boxes = NULL;
    expect_frame(&call, PEL_ERR_ARG, "no classes");
    good_frame_call(&call);
    call.config.work_bytes--;
    expect_frame(&call, PEL_ERR_SPACE, "work too small");
    good_frame_call(&call);
    call.config.measure = PEL_MEASURE_COLOR;
    call.config.reader = pel_crow_read_bayer;
    expect_frame(&call, PEL_ERR_FORMAT, "the colour reader of another format");
    good_frame_call(&call);
    call.view.plane[0] = NULL;
    expect_frame(&call, PEL_ERR_ARG, "plane NULL");
}

static void frame_null_pointers(void)
{
    frame_call call;
    pel_blobs blobs;
    uint32_t count;
    check_group("frame: null pointers");
    good_frame_call(&call);
    check_that(pel_blobs_frame(NULL, &call.config, &call.classifier, &call.view, call.labels,
                               &count) == PEL_ERR_ARG,
               "blobs");
    check_that(pel_blobs_frame(&blobs, NULL, &call.classifier, &call.view, call.labels, &count) ==
                   PEL_ERR_ARG,
               "config");
    check_that(pel_blobs_frame(&blobs, &call.config, NULL, &call.view, call.labels, &count) ==
                   PEL_ERR_ARG,
               "classifier");
    check_that(pel_blobs_frame(&blobs, &call.config, &call.classifier, NULL, call.labels, &count) ==
                   PEL_ERR_ARG,
               "view");
    check_that(pel_blobs_frame(&blobs, &call.config, &call.classifier, &call.view, NULL, &count) ==
                   PEL_ERR_ARG,
               "labels");
    check_that(pel_blobs_frame(&blobs, &call.config, &call.classifier, &call.view, call.labels,
                               NULL) == PEL_ERR_ARG,
               "count");
}

int main(void)
{
    begin_null_pointers();
    begin_choices();
    begin_open_max();
    begin_memory();
    begin_sizes();
    rows_out_of_order();
    finder_never_begun();
    begin_again();
    pixels_for_colour();
    callbacks_come_early();
    frame_sizes_and_formats();
    frame_null_pointers();
    guarded_free(&work_memory);
    return check_finish();
}
