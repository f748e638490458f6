/* A frame: its start, its rows straight from pixels, and the loop over them. */
#include "blob_slots.h"
#include "classifier.h"
#include "format.h"
#include "overlap.h"
#include "pel/blobs.h"

uint32_t pel_blobs_bytes(uint16_t width, uint16_t open_max, unsigned measure)
{
    return PEL_BLOBS_BYTES(width, open_max, measure);
}

/* PEL_BLOBS_BYTES, also where size_t has 16 bits and the macro would wrap. */
static uint32_t bytes_needed(const pel_blobs_config *c)
{
    return c->open_max * (uint32_t)PEL_BLOBS_SLOT_BYTES(c->measure) + 12 * ((uint32_t)c->width + 1);
}

/* The finder, the working memory and the results are three different places. */
static int places_fit(const pel_blobs *b, const pel_blobs_config *c)
{
    const size_t results_bytes = c->results_max * sizeof *c->results;

    return !pel_i_overlap(c->work, c->work_bytes, c->results, results_bytes) &&
           !pel_i_overlap(b, sizeof *b, c->work, c->work_bytes) &&
           !pel_i_overlap(b, sizeof *b, c->results, results_bytes);
}

static pel_status check_config(const pel_blobs *b, const pel_blobs_config *c)
{
    const uint64_t sum_limit = (uint64_t)1 << 33; /* 2 * sum_x < width * width * height */
    const uint32_t pixels = (uint32_t)c->width * c->height;
    const uint32_t side = c->width > c->height ? c->width : c->height;

    if (!c->work || !pel_i_aligned8(c->work) || (!c->results && c->results_max > 0) ||
        (c->connectivity != 0 && c->connectivity != 4 && c->connectivity != 8) ||
        c->measure > PEL_MEASURE_ALL || (unsigned)c->backend >= PEL_BACKEND_COUNT ||
        c->open_max == 0 || c->open_max > PEL_BLOBS_OPEN_LIMIT ||
        (c->measure != 0 && !c->measurer) ||
        ((c->measure & PEL_MEASURE_COLOR) != 0 && !c->reader)) {
        return PEL_ERR_ARG;
    }
    if (pixels == 0 || side > PEL_SIDE_MAX || (uint64_t)pixels * side > sum_limit) {
        return PEL_ERR_RANGE;
    }
    if (!places_fit(b, c)) {
        return PEL_ERR_ARG;
    }
    return c->work_bytes < bytes_needed(c) ? PEL_ERR_SPACE : PEL_OK;
}

/* The elements with the strictest alignment lie first, so that all are aligned. */
static void lay_out(pel_blobs *b)
{
    const pel_blobs_config *const c = &b->config;
    const size_t open = c->open_max, width = (size_t)c->width + 1;
    const uint32_t extra_bytes = PEL_BLOBS_SLOT_BYTES(c->measure) - (uint32_t)sizeof(slot);

    b->extra_step = extra_bytes * SLOT_STEPS_INVERSE;
    b->slots = (slot *)(void *)((unsigned char *)c->work + open * extra_bytes);
    b->runs[ABOVE] = (pel_run *)(void *)(b->slots + open);
    b->runs[HERE] = b->runs[ABOVE] + width;
    b->ids[ABOVE] = (uint16_t *)(void *)(b->runs[HERE] + width);
    b->ids[HERE] = b->ids[ABOVE] + width;
}

static void free_all_slots(pel_blobs *b)
{
    const uint16_t used = b->config.open_max < OPEN_USED ? b->config.open_max : (uint16_t)OPEN_USED;
    uint32_t next = END;

    for (uint32_t i = used; i-- > 0; next = i * SLOT_STEPS) {
        b->slots[i].area = next;
    }
    b->free_slot = 0;
    b->united_slot = END;
}

pel_status pel_blobs_begin(pel_blobs *b, const pel_blobs_config *config)
{
    const pel_blobs_counts nothing = {0};
    const pel_run beyond = {BEYOND - 1, BEYOND};
    const pel_status status = b && config ? check_config(b, config) : PEL_ERR_ARG;

    if (status != PEL_OK) {
        return status;
    }
    b->config = *config;
    b->counts = nothing;
    b->config.backend = pel_i_row_backend(config->backend);
    b->reach = config->connectivity == 4 ? 0 : 1;
    lay_out(b);
    free_all_slots(b);
    b->runs[ABOVE][0] = beyond;
    b->ids[ABOVE][0] = NO_BLOB;
    b->labels = NULL;
    b->results_count = 0;
    b->next_row = 0;
    b->open_count = 0;
    b->losses = 0;
    b->ended_slot = END;
    b->state = STATE_ROWS;
    return PEL_OK;
}

/* The runs of the next row, which was checked. RGB is read in the range of the classes, also
 * later. */
static uint16_t find_runs(const pel_blobs *b, const pel_classifier *classifier, pel_crow *row,
                          uint8_t *labels)
{
    row->range = classifier->range;
    return pel_i_classify_runs(classifier, row, b->config.width, b->config.backend, labels,
                               pel_i_blobs_edges(b));
}

/* Packed YCbCr for boxes, row after row with the same labels: what most cameras send is accepted by
 * a few comparisons where the checks of all kinds of rows take hundreds of instructions. They judge
 * what is not accepted here, and everything where code is to be small. */
static inline int is_usual(const pel_blobs *b, uint16_t y, const pel_classifier *classifier,
                           const pel_crow *pixels, const uint8_t *labels)
{
#if defined(__OPTIMIZE_SIZE__)
    (void)b;
    (void)y;
    (void)classifier;
    (void)pixels;
    (void)labels;
    return 0;
#else
    const pel_format_info *const info = pixels ? pel_i_format(pixels->format) : NULL;
    uint16_t width;

    if (!b || !classifier || !info || !labels || labels != b->labels || b->state != STATE_ROWS ||
        y != b->next_row || y >= b->config.height) {
        return 0;
    }
    width = b->config.width;
    return classifier->boxes && !classifier->relabel && pixels->plane[0] &&
           info->layout == PEL_LAYOUT_PAIRS && info->pair_bytes == 4 && pixels->width == width &&
           width % 2 == 0 && pixels->range == classifier->range &&
           (unsigned)pixels->range <= PEL_RANGE_LIMITED &&
           (uintptr_t)labels - (uintptr_t)pixels->plane[0] >= 2 * (size_t)width &&
           (uintptr_t)pixels->plane[0] - (uintptr_t)labels >= width;
#endif
}

/* What is wrong with a row of any kind. */
static pel_status check_pixels(const pel_blobs *b, uint16_t y, const pel_classifier *classifier,
                               const pel_crow *pixels, uint8_t *labels)
{
    pel_status status = b ? pel_i_classify_check(classifier, pixels, labels) : PEL_ERR_ARG;

    if (status == PEL_OK) {
        status = pel_i_blobs_check_row(b, y, labels);
    }
    if (status == PEL_OK && pel_color_width(pixels->format, pixels->width) != b->config.width) {
        status = PEL_ERR_FORMAT;
    }
    return status;
}

/* A row of any kind. */
PEL_I_APART static pel_status add_pixels(pel_blobs *b, uint16_t y, const pel_classifier *classifier,
                                         const pel_crow *pixels, uint8_t *labels)
{
    const pel_status status = check_pixels(b, y, classifier, pixels, labels);
    pel_crow row;

    if (status != PEL_OK) {
        return status;
    }
    b->labels = labels;
    row = *pixels;
    return pel_i_blobs_join(b, find_runs(b, classifier, &row, labels), labels, &row);
}

pel_status pel_blobs_pixels(pel_blobs *b, uint16_t y, const pel_classifier *classifier,
                            const pel_crow *pixels, uint8_t *labels)
{
    if (is_usual(b, y, classifier, pixels, labels)) {
        const pel_row_pairs pairs = pel_i_packed_pairs(pel_i_format_of(pixels), pixels->plane[0]);
        const uint16_t count =
            pel_i_box_runs(classifier, &pairs, b->config.width, labels, pel_i_blobs_edges(b));
        return pel_i_blobs_join(b, count, labels, pixels);
    }
    return add_pixels(b, y, classifier, pixels, labels);
}

/* What pel_blobs_frame refuses beyond what begin does. Apart, so that its stack is not there while
 * the rows are added. */
PEL_I_APART static pel_status check_frame(const pel_blobs *b, const pel_blobs_config *config,
                                          const pel_classifier *classifier, const pel_cview *view,
                                          uint8_t *labels)
{
    pel_status status = b && config && labels ? pel_cview_check(view) : PEL_ERR_ARG;
    pel_crow row;

    if (status != PEL_OK) {
        return status;
    }
    if (config->width != pel_color_width(view->format, view->width) ||
        config->height != pel_color_height(view->format, view->height)) {
        return PEL_ERR_RANGE;
    }
    row = pel_cview_row(view, 0); /* what this row is refused for, all are */
    status = pel_i_classify_check(classifier, &row, labels);
    if (status == PEL_OK && (config->measure & PEL_MEASURE_COLOR) != 0 && config->reader) {
        status = config->reader(&row, 0, 0, classifier->range, labels, labels, labels);
    }
    if (status != PEL_OK) {
        return status;
    }
    return pel_i_view_overlaps(view, labels, config->width) ||
                   pel_i_blobs_write(b, config, labels, config->width)
               ? PEL_ERR_ARG
               : PEL_OK;
}

/* The rows of a frame of any kind. */
static inline pel_status add_rows(pel_blobs *b, const pel_classifier *classifier,
                                  const pel_cview *view, uint8_t *labels)
{
    pel_status status = PEL_OK;

    for (uint16_t y = 0; status >= 0 && y < b->config.height; y++) {
        pel_crow row = pel_cview_row(view, y);
        status = pel_i_blobs_join(b, find_runs(b, classifier, &row, labels), labels, &row);
    }
    return status;
}

#if !defined(__OPTIMIZE_SIZE__)
/* Packed YCbCr for boxes, what most cameras send: all that its rows have in common is found out
 * once. */
static int is_packed(const pel_classifier *classifier, const pel_cview *view)
{
    const pel_format_info *const info = pel_i_format(view->format);

    return classifier->boxes && !classifier->relabel && info->layout == PEL_LAYOUT_PAIRS &&
           info->pair_bytes == 4;
}

PEL_I_APART static pel_status add_packed_rows(pel_blobs *b, const pel_classifier *classifier,
                                              const pel_cview *view, uint8_t *labels)
{
    const pel_classify_plan *const plan = classifier->plan;
    const pel_backend backend = plan ? plan->backend : PEL_ROW_BUILT_IN;
    const uint8_t *const nibbles = plan ? plan->nibbles : NULL;
    const pel_row_boxes boxes = pel_i_row_boxes(classifier);
    const uint16_t width = b->config.width, height = b->config.height;
    pel_crow row = pel_cview_row(view, 0);
    pel_row_pairs pairs = pel_i_packed_pairs(pel_i_format_of(&row), row.plane[0]);
    pel_status status = PEL_OK;

    for (uint16_t y = 0; status >= 0 && y < height; y++) {
        const ptrdiff_t step = y > 0 ? view->stride_bytes[0] : 0;
        uint16_t count;
        row.plane[0] += step;
        pairs.y += step;
        pairs.u += step;
        pairs.v += step;
        count = pel_i_row_classify_runs(backend, nibbles, &boxes, &pairs, width, labels,
                                        pel_i_blobs_edges(b));
        status = pel_i_blobs_join(b, count, labels, &row);
    }
    return status;
}
#endif

pel_status pel_blobs_frame(pel_blobs *b, const pel_blobs_config *config,
                           const pel_classifier *classifier, const pel_cview *view, uint8_t *labels,
                           uint32_t *count)
{
    pel_status status = count ? check_frame(b, config, classifier, view, labels) : PEL_ERR_ARG;

    if (status == PEL_OK) {
        status = pel_blobs_begin(b, config);
    }
    if (status != PEL_OK) {
        return status;
    }
#if defined(__OPTIMIZE_SIZE__)
    status = add_rows(b, classifier, view, labels);
#else
    status = is_packed(classifier, view) ? add_packed_rows(b, classifier, view, labels)
                                         : add_rows(b, classifier, view, labels);
#endif
    return status < 0 ? status : pel_blobs_end(b, count);
}
