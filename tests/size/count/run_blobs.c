/* Classification, runs, blobs, and the rows of pixels that they read. */
#include "count.h"

static pel_classifier classifier;
static pel_blobs blobs;
static pel_blobs_config config;
static pel_blob_filter at_least_20_px;
static uint32_t kept;

/* ---- Classification ------------------------------------------------------------------------- */

static void begin_boxes(const job *j)
{
    (void)j;
    classifier.boxes = &picture_classes;
    classifier.reader = pel_crow_read_yuv;
    classifier.pieces = pel_classify_pieces;
}

/* 2 + 4 + 4 bits in 1 KiB of `work`; the cells' values do not change how many instructions it
 * takes, but give the checksum something to see. */
static void prepare_table(const job *j)
{
    uint8_t *const cells = (uint8_t *)work;
    (void)j;
    for (unsigned i = 0; i < PEL_LUT_BYTES(2, 4, 4); i++) {
        cells[i] = (uint8_t)(i * 7u % 9u);
    }
    classifier.boxes = NULL;
    classifier.lut.cell = cells;
    classifier.lut.y_bits = 2;
    classifier.lut.u_bits = 4;
    classifier.lut.v_bits = 4;
}

static uint32_t push_classify(uint16_t y)
{
    (void)y;
    done(pel_classify_row(&classifier, &row.crow, output_bytes()));
    return pel_color_width(row.crow.format, WIDTH);
}

const family classify_boxes = {.begin = begin_boxes, .push = push_classify};
const family classify_table = {.ready = prepare_table, .push = push_classify};

/* ---- Runs ----------------------------------------------------------------------------------- */

static uint32_t push_runs_of(const uint8_t *some_labels)
{
    const uint32_t count = pel_find_runs(some_labels, WIDTH, (pel_run *)work);
    output_row[0] = count;
    return sizeof output_row[0];
}

static uint32_t push_runs(uint16_t y)
{
    (void)y;
    return push_runs_of(row.bytes);
}

static uint32_t push_classify_and_runs(uint16_t y)
{
    (void)y;
    done(pel_classify_row(&classifier, &row.crow, labels));
    return push_runs_of(labels);
}

const family runs_of_labels = {.push = push_runs};
const family classify_runs = {.begin = begin_boxes, .push = push_classify_and_runs};

/* ---- From the camera's rows to blobs, as tests/bench/chain.c -------------------------------- */

static void begin_chain(const job *j)
{
    classifier.boxes = &picture_classes;
    at_least_20_px.area_min = 20;
    config.width = WIDTH;
    config.height = HEIGHT;
    config.open_max = OPEN_MAX;
    config.connectivity = 4;
    config.measure = (uint8_t)j->other;
    config.measurer = config.measure != 0 ? pel_blobs_measure : NULL;
    config.reader = pel_crow_read_yuv;
    config.work = work;
    config.work_bytes = WORK_BYTES;
    config.filter = &at_least_20_px;
    config.results = (pel_blob *)results;
    config.results_max = RESULTS_MAX;
    done(pel_blobs_begin(&blobs, &config));
}

static uint32_t push_chain(uint16_t y)
{
    done(pel_blobs_pixels(&blobs, y, &classifier, &row.crow, labels));
    return 0;
}

static uint32_t end_chain(const job *j)
{
    (void)j;
    done(pel_blobs_end(&blobs, &kept));
    return 0;
}

/* A lost blob would make the figure that of another piece of work. */
static uint32_t look_at_blobs(void)
{
    return blobs.counts.lost_opens == 0 ? blobs.counts.found : 0;
}

const family chain = {
    .begin = begin_chain, .push = push_chain, .end = end_chain, .look = look_at_blobs};

/* ---- Reading rows, colours ------------------------------------------------------------------ */

static uint32_t push_read_yuv(uint16_t y)
{
    uint8_t *const out = output_bytes();
    const uint16_t count = pel_color_width(row.crow.format, WIDTH);
    (void)y;
    done(pel_crow_read_yuv(&row.crow, 0, count, PEL_RANGE_FULL, out, out + WIDTH, out + 2 * WIDTH));
    return count;
}

static uint32_t push_read_rgb(uint16_t y)
{
    const uint16_t count = pel_color_width(row.crow.format, WIDTH);
    (void)y;
    done(pel_crow_read_rgb(&row.crow, 0, count, output_bytes()));
    return 3u * count;
}

const family read_yuv = {.push = push_read_yuv};
const family read_rgb = {.push = push_read_rgb};

static int32_t conversion;

static void begin_color(const job *j)
{
    conversion = j->choice;
}

static uint32_t push_color(uint16_t y)
{
    uint8_t *const out = output_bytes();
    (void)y;
    switch (conversion) {
    case 0:
        done(pel_rgb_to_ycbcr_row(row.bytes, out, WIDTH, PEL_RANGE_FULL));
        break;
    case 1:
        done(pel_ycbcr_to_rgb_row(row.bytes, out, WIDTH, PEL_RANGE_FULL));
        break;
    case 2:
        done(pel_rgb_to_nrgb_row(row.bytes, out, WIDTH, 30));
        break;
    default:
        done(pel_rgb_to_hsv_row(row.bytes, out, WIDTH));
        break;
    }
    return 3 * WIDTH;
}

const family color_row = {.begin = begin_color, .push = push_color};
