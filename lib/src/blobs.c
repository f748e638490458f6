/* The rows of a frame and its end; how rows join blobs is in blob_walk_template.h. */
#include "pel/blobs.h"

#include "blob_list.h"
#include "blob_slots.h"
#include "row/row_select_runs.h"

/* Nothing is measured beyond area, box and sums. */

static inline void set_extras(const pel_blobs *b, unsigned id, pel_run run)
{
    (void)b;
    (void)id;
    (void)run;
}

static inline void unite_extras(const pel_blobs *b, unsigned into, unsigned from)
{
    (void)b;
    (void)into;
    (void)from;
}

static inline uint32_t touch_extras(pel_run run, pel_run above)
{
    (void)run;
    (void)above;
    return 0;
}

static inline void add_extras(const pel_blobs *b, unsigned id, pel_run run, uint32_t touched)
{
    (void)b;
    (void)id;
    (void)run;
    (void)touched;
}

static inline void describe_extras(const pel_blobs *b, unsigned id, pel_blob *blob)
{
    (void)b;
    (void)id;
    (void)blob;
}

#include "blob_walk_template.h"

/* ---- What is found ------------------------------------------------------------------------- */

/* Puts a blob among the results; when they are full it takes the place of the smallest, if that is
 * smaller. From the first time on the results are a heap with the smallest on top. */
static void keep(pel_blobs *b, const pel_blob *blob)
{
    pel_blob *const results = b->config.results;
    const uint32_t max = b->config.results_max;

    if (b->results_count < max) {
        results[b->results_count++] = *blob;
        return;
    }
    if (b->counts.dropped == 0) {
        pel_i_heap_make(results, max);
    }
    b->counts.dropped++;
    if (pel_i_blob_before(blob, &results[0])) {
        b->counts.dropped_px += results[0].area;
        pel_i_heap_replace(results, max, blob);
    } else {
        b->counts.dropped_px += blob->area;
    }
}

void pel_i_blobs_report(pel_blobs *b, const pel_blob *blob)
{
    const pel_blobs_config *const c = &b->config;

    if (!pel_blob_passes(blob, c->filter) || (c->accept && !c->accept(c->limits, blob))) {
        b->counts.filtered++;
        b->counts.filtered_px += blob->area;
        return;
    }
    b->counts.found++;
    if (c->on_blob) {
        c->on_blob(c->user, blob);
    }
    if (c->results_max > 0) {
        keep(b, blob);
    }
}

/* ---- A row --------------------------------------------------------------------------------- */

pel_status pel_i_blobs_join(pel_blobs *b, uint16_t count, const uint8_t *labels,
                            const pel_crow *pixels)
{
    if (b->config.measurer) {
        const pel_status status = b->config.measurer(b, count, labels, pixels);
        if (status != PEL_OK) {
            return status;
        }
    } else {
        join_row(b, count, labels);
    }
    b->next_row++;
    return b->losses & NO_SLOT ? PEL_TRUNCATED : PEL_OK;
}

pel_status pel_blobs_row(pel_blobs *b, uint16_t y, const uint8_t *labels, const pel_crow *pixels)
{
    pel_status status = b && labels ? pel_i_blobs_check_row(b, y, labels) : PEL_ERR_ARG;
    uint16_t count;

    if (status != PEL_OK) {
        return status;
    }
    count = pel_i_row_find_runs(b->config.backend, labels, b->config.width, pel_i_blobs_edges(b));
    return pel_i_blobs_join(b, count, labels, pixels);
}

/* ---- The end ------------------------------------------------------------------------------- */

pel_status pel_blobs_end(pel_blobs *b, uint32_t *count)
{
    if (!b || !count) {
        return PEL_ERR_ARG;
    }
    if (b->state != STATE_ROWS || b->next_row != b->config.height) {
        return PEL_ERR_ORDER;
    }
    (void)pel_i_blobs_join(b, 0, NULL, NULL); /* there is no row below the last */
    pel_blobs_sort(b->config.results, b->results_count);
    *count = b->results_count;
    b->state = STATE_IDLE;
    return b->counts.lost_opens == 0 && b->counts.dropped == 0 ? PEL_OK : PEL_TRUNCATED;
}

uint16_t pel_find_runs(const uint8_t *labels, uint16_t width, pel_run *runs)
{
    return labels && runs ? pel_i_row_find_runs(PEL_ROW_BUILT_IN, labels, width, &runs->x0) : 0;
}
