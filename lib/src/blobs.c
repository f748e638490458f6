/*
 * Streaming connected components.
 *
 * A row goes through five steps:
 *   find     the runs of the row
 *   join     each run to the open blobs whose runs it touches in the row above; blobs that turn
 *            out to be one are united (a union-find forest over the slots)
 *   close    the blobs of the row above that no run joined: their slots become free
 *   add      each run to the sums of its blob, which from now on is the root of its tree; a run
 *            that joined none opens a blob if there is a free slot
 *   free     the united slots, to which nothing refers any more; runs that found no free slot
 *            before open their blobs now
 * So a blob is lost only if more blobs than slots are open after the row, and as every open blob
 * owns a run of it, there are never more of them than runs in a row.
 */
#include "pel/blobs.h"

#include "blob_list.h"
#include "blob_slots.h"
#include "row/row.h"

/* ---- Slots --------------------------------------------------------------------------------- */

static inline unsigned find_root(slot *slots, unsigned id)
{
    while (slots[id].parent != id) {
        slots[id].parent = slots[slots[id].parent].parent; /* path compression by halving */
        id = slots[id].parent;
    }
    return id;
}

/* Its parent stays: runs of the row above may still look for their root through this slot. */
static void free_slot(pel_blobs *b, uint16_t id)
{
    b->slots[id].label = 0;
    b->slots[id].area = b->free_slot;
    b->free_slot = id;
    b->open_count--;
}

static uint16_t take_slot(pel_blobs *b, uint8_t label)
{
    const uint16_t id = b->free_slot;
    const uint16_t y = b->next_row;
    const slot empty = {0, 0, 0, 0xFFFF, 0, y, (uint16_t)(y + 1), id, label, 0};

    if (id == END) {
        return END;
    }
    b->free_slot = (uint16_t)b->slots[id].area;
    b->slots[id] = empty;
    if (b->moments) {
        const struct pel_blob_moments zero = {0, 0, 0};
        b->moments[id] = zero;
    }
    if (b->outlines) {
        const struct pel_blob_outline one_run = {1, 1};
        b->outlines[id] = one_run;
    }
    if (b->colors) {
        const struct pel_blob_color zero = {0, 0, 0};
        b->colors[id] = zero;
    }
    b->open_count++;
    return id;
}

static uint16_t smaller(uint16_t a, uint16_t b)
{
    return a < b ? a : b;
}

static uint16_t larger(uint16_t a, uint16_t b)
{
    return a > b ? a : b;
}

/* Adds what blob `from` measured beyond the basics to blob `into`. */
static void unite_measures(pel_blobs *b, unsigned into, unsigned from)
{
    if (b->moments) {
        b->moments[into].xx12 += b->moments[from].xx12;
        b->moments[into].xy += b->moments[from].xy;
        b->moments[into].yy += b->moments[from].yy;
    }
    if (b->outlines) {
        b->outlines[into].edges += b->outlines[from].edges;
        b->outlines[into].euler += b->outlines[from].euler;
    }
    if (b->colors) {
        b->colors[into].y += b->colors[from].y;
        b->colors[into].u += b->colors[from].u;
        b->colors[into].v += b->colors[from].v;
    }
}

/* Two different roots become one, which is returned. The other goes to the list of united slots:
 * runs of this row and of the row above still refer to it. */
static unsigned unite(pel_blobs *b, unsigned id1, unsigned id2)
{
    const unsigned into = id1 < id2 ? id1 : id2, from = id1 < id2 ? id2 : id1;
    slot *const t = &b->slots[into], *const f = &b->slots[from];

    t->area += f->area;
    t->sum_x += f->sum_x;
    t->sum_y += f->sum_y;
    t->x0 = smaller(t->x0, f->x0);
    t->x1 = larger(t->x1, f->x1);
    t->y0 = smaller(t->y0, f->y0);
    t->y1 = larger(t->y1, f->y1);
    t->broken = (uint8_t)(t->broken | f->broken);
    unite_measures(b, into, from);
    f->parent = (uint16_t)into;
    f->area = b->united_slot;
    b->united_slot = (uint16_t)from;
    return into;
}

/* ---- Runs join blobs ----------------------------------------------------------------------- */

static inline unsigned label_of_id(const slot *slots, unsigned id)
{
    return id < LOST ? slots[id].label : id - LOST + 1;
}

/* A run whose blob so far is `id` touches a run of blob `above`: the blob that it has now. */
static unsigned touch(pel_blobs *b, unsigned id, unsigned above)
{
    if (above >= LOST) {
        if (id < LOST) {
            b->slots[id].broken = 1;
        }
        return id < LOST ? id : above;
    }
    above = find_root(b->slots, above);
    if (id == NO_BLOB || id == above) {
        return above;
    }
    if (id >= LOST) {
        b->slots[above].broken = 1;
        return above;
    }
    return unite(b, id, above);
}

/* Joins the runs of the row to the runs of the same label that they touch. A joined blob is marked
 * by its y1, before its pixels are added. */
PEL_I_APART static void join_row(pel_blobs *b, size_t count, const uint8_t *labels)
{
    const pel_run *above = b->runs[b->above];
    const uint16_t *ids_above = b->ids[b->above];
    const pel_run *run = b->runs[1 - b->above];
    const pel_run *const runs_end = run + count;
    uint16_t *ids = b->ids[1 - b->above];
    slot *const slots = b->slots;
    struct pel_blob_outline *const outlines = b->outlines;
    const int reach = b->reach;
    const uint16_t y1 = (uint16_t)(b->next_row + 1);

    for (; run != runs_end; run++) {
        const int x0 = run->x0, x1 = run->x1;
        const unsigned label = labels[x0];
        unsigned id = NO_BLOB;
        int links = 1, shared = 1;
        while ((int)above->x1 <= x0 - reach) { /* int: x0 - reach may be -1 */
            above++;
            ids_above++;
        }
        for (size_t k = 0; (int)above[k].x0 < x1 + reach; k++) {
            const unsigned other = ids_above[k];
            if (label_of_id(slots, other) == label) {
                const int from = above[k].x0, to = above[k].x1;
                links--;
                shared -= (to < x1 ? to : x1) - (from > x0 ? from : x0); /* 0 at a corner */
                id = id == NO_BLOB && other < LOST && slots[other].parent == other
                         ? other
                         : touch(b, id, other);
            }
        }
        *ids++ = (uint16_t)id;
        if (id < LOST) {
            slots[id].y1 = y1;
            if (outlines) {
                outlines[id].edges += shared;
                outlines[id].euler += links;
            }
        }
    }
}

/* ---- Blobs gather the pixels of the row ---------------------------------------------------- */

static inline void add_basics(slot *t, pel_run run, uint32_t n, uint32_t sum_x, uint32_t y)
{
    t->area += n;
    t->sum_x += sum_x;
    t->sum_y += n * y;
    if (run.x0 < t->x0) {
        t->x0 = run.x0;
    }
    if (run.x1 > t->x1) {
        t->x1 = run.x1;
    }
}

/* With s = x0 + x1 - 1, twice the middle of a run of n, its sum of x*x is n (3 s^2 + n^2 - 1) / 12;
 * the bracket is below 2^30. */
static inline void add_moments(struct pel_blob_moments *m, uint32_t n, uint32_t s, uint32_t sum_x,
                               uint32_t y)
{
    m->xx12 += (uint64_t)n * (3 * s * s + n * n - 1);
    m->xy += (uint64_t)sum_x * y;
    m->yy += (uint64_t)n * (y * y);
}

static void add_color(const pel_blobs *b, size_t id, const pel_crow *pixels, pel_run run)
{
    enum { CHUNK = 8 };
    struct pel_blob_color *const color = &b->colors[id];
    uint8_t y[CHUNK], u[CHUNK], v[CHUNK];

    for (uint16_t x = run.x0; x < run.x1; x = (uint16_t)(x + CHUNK)) {
        const uint16_t n = smaller(CHUNK, (uint16_t)(run.x1 - x));
        (void)b->config.reader(pixels, x, n, pixels->range, y, u, v); /* checked at the door */
        color->y += pel_row_sum(y, n);
        color->u += pel_row_sum(u, n);
        color->v += pel_row_sum(v, n);
    }
}

/* slots and moments are those of b: what the caller's loop keeps in registers. */
static inline void add_run(pel_blobs *b, slot *slots, struct pel_blob_moments *moments, size_t id,
                           pel_run run, uint32_t y, const pel_crow *pixels)
{
    const uint32_t n = (uint32_t)(run.x1 - run.x0), s = (uint32_t)run.x0 + run.x1 - 1;
    const uint32_t sum_x = n * s / 2; /* n * s is even: where n is odd, s is even */

    add_basics(&slots[id], run, n, sum_x, y);
    if (moments) {
        add_moments(&moments[id], n, s, sum_x, y);
    }
    if (b->colors) {
        add_color(b, id, pixels, run);
    }
}

/* Adds the runs of the row to their blobs, and opens blobs for those that touch none while there
 * are free slots; returns for how many there was none. */
PEL_I_APART static size_t add_row(pel_blobs *b, size_t count, const uint8_t *labels,
                                  const pel_crow *pixels)
{
    const pel_run *const runs = b->runs[1 - b->above];
    uint16_t *const ids = b->ids[1 - b->above];
    slot *const slots = b->slots;
    struct pel_blob_moments *const moments = b->moments;
    const uint32_t y = b->next_row;
    size_t late = 0;

    for (size_t i = 0; i < count; i++) {
        uint16_t id = ids[i];
        if (id >= LOST) {
            if (id != NO_BLOB) {
                b->counts.lost_px += (uint32_t)(runs[i].x1 - runs[i].x0);
                continue;
            }
            id = take_slot(b, labels[runs[i].x0]);
            if (id == END) {
                late++;
                continue;
            }
            ids[i] = id;
        } else if (slots[id].parent != id) {
            id = (uint16_t)find_root(slots, id);
            ids[i] = id;
        }
        add_run(b, slots, moments, id, runs[i], y, pixels);
    }
    return late;
}

/* ---- Blobs that end ------------------------------------------------------------------------ */

static uint8_t mean(uint32_t sum, uint32_t area)
{
    return (uint8_t)((2 * sum + area) / (2 * area));
}

static void describe(const pel_blobs *b, uint16_t id, pel_blob *blob)
{
    const slot *const s = &b->slots[id];
    const pel_blob nothing = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};

    *blob = nothing;
    blob->area = s->area;
    blob->sum_x = s->sum_x;
    blob->sum_y = s->sum_y;
    blob->x0 = s->x0;
    blob->x1 = s->x1;
    blob->y0 = s->y0;
    blob->y1 = s->y1;
    blob->class_index = (uint8_t)(s->label - 1);
    blob->edges = (uint8_t)((s->x0 == 0 ? PEL_EDGE_LEFT : 0) |
                            (s->x1 == b->config.width ? PEL_EDGE_RIGHT : 0) |
                            (s->y0 == 0 ? PEL_EDGE_TOP : 0) |
                            (s->y1 == b->config.height ? PEL_EDGE_BOTTOM : 0));
    if (b->moments) {
        /* A multiple of 12: shift by 2, then times the inverse of 3 modulo 2^64. */
        blob->sum_xx = (b->moments[id].xx12 >> 2) * UINT64_C(0xAAAAAAAAAAAAAAAB);
        blob->sum_xy = b->moments[id].xy;
        blob->sum_yy = b->moments[id].yy;
    }
    if (b->outlines) {
        blob->perimeter = 2 * (s->area + (uint32_t)b->outlines[id].edges);
        blob->holes = (uint32_t)(1 - b->outlines[id].euler);
    }
    if (b->colors) {
        blob->mean_y = mean(b->colors[id].y, s->area);
        blob->mean_u = mean(b->colors[id].u, s->area);
        blob->mean_v = mean(b->colors[id].v, s->area);
    }
}

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

static void report(pel_blobs *b, uint16_t id)
{
    pel_blob blob;

    describe(b, id, &blob);
    if (!pel_blob_passes(&blob, b->config.filter) ||
        (b->config.accept && !b->config.accept(b->config.limits, &blob))) {
        b->counts.filtered++;
        b->counts.filtered_px += blob.area;
        return;
    }
    b->counts.found++;
    if (b->config.on_blob) {
        b->config.on_blob(b->config.user, &blob);
    }
    if (b->config.results_max > 0) {
        keep(b, &blob);
    }
}

static void close_blob(pel_blobs *b, uint16_t id)
{
    const slot *const s = &b->slots[id];

    if (s->broken) {
        b->counts.lost_px += s->area;
    } else if (b->config.filter && s->area < b->config.filter->area_min) {
        b->counts.filtered++; /* most blobs of a noisy picture: spare them the description */
        b->counts.filtered_px += s->area;
    } else {
        report(b, id);
    }
    free_slot(b, id);
}

/* Closes the blobs of the row above to which row y added nothing. */
static void close_ended(pel_blobs *b, uint32_t y)
{
    const uint16_t *const ids = b->ids[b->above];
    const slot *const slots = b->slots;
    const size_t count = b->above_count;
    const uint16_t y1 = (uint16_t)(y + 1);

    for (size_t k = 0; k < count; k++) {
        const unsigned id = ids[k];
        /* A slot that is no root any more was united in this row: its root goes on. */
        if (id < LOST && slots[id].y1 != y1 && slots[id].parent == id && slots[id].label != 0) {
            close_blob(b, (uint16_t)id);
        }
    }
}

/* ---- A row --------------------------------------------------------------------------------- */

static void free_united(pel_blobs *b)
{
    while (b->united_slot != END) {
        const uint16_t id = b->united_slot;
        b->united_slot = (uint16_t)b->slots[id].area;
        free_slot(b, id);
    }
}

/* Opens blobs for the last `late` runs that are still without, as far as there are slots. */
static void open_late(pel_blobs *b, size_t late, const uint8_t *labels, const pel_crow *pixels)
{
    const pel_run *run = b->runs[1 - b->above];
    uint16_t *id = b->ids[1 - b->above];

    for (; late > 0; run++, id++) {
        if (*id == NO_BLOB) {
            const uint8_t label = labels[run->x0];
            *id = take_slot(b, label);
            if (*id == END) {
                *id = (uint16_t)(LOST + label - 1);
                b->counts.lost_opens++;
                b->counts.lost_px += (uint32_t)(run->x1 - run->x0);
            } else {
                add_run(b, b->slots, b->moments, *id, *run, b->next_row, pixels);
            }
            late--;
        }
    }
}

static pel_status check_pixels(const pel_blobs *b, const pel_crow *pixels)
{
    uint8_t y, u, v;
    const pel_status status =
        pixels ? b->config.reader(pixels, 0, 0, pixels->range, &y, &u, &v) : PEL_ERR_ARG;

    if (status != PEL_OK) {
        return status;
    }
    return pel_color_width(pixels->format, pixels->width) == b->config.width ? PEL_OK
                                                                             : PEL_ERR_FORMAT;
}

pel_status pel_blobs_row(pel_blobs *b, uint16_t y, const uint8_t *labels, const pel_crow *pixels)
{
    uint32_t lost_before;
    uint16_t count;
    size_t late;

    if (!b || !labels) {
        return PEL_ERR_ARG;
    }
    if (b->state != STATE_ROWS || y != b->next_row || y >= b->config.height) {
        return PEL_ERR_ORDER;
    }
    if (pel_i_blobs_write(b, &b->config, labels, b->config.width)) {
        return PEL_ERR_ARG;
    }
    if (b->colors) {
        const pel_status status = check_pixels(b, pixels);
        if (status != PEL_OK) {
            return status;
        }
    }
    lost_before = b->counts.lost_opens;
    count = pel_row_find_runs(labels, b->config.width, &b->runs[1 - b->above]->x0);
    b->runs[1 - b->above][count].x0 = BEYOND;
    b->runs[1 - b->above][count].x1 = BEYOND;
    join_row(b, count, labels);
    close_ended(b, y);
    late = add_row(b, count, labels, pixels);
    free_united(b);
    open_late(b, late, labels, pixels);
    b->counts.open_peak = larger(b->counts.open_peak, b->open_count);
    b->above = (uint8_t)(1 - b->above);
    b->above_count = count;
    b->next_row++;
    return b->counts.lost_opens == lost_before ? PEL_OK : PEL_TRUNCATED;
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
    close_ended(b, b->next_row);
    pel_blobs_sort(b->config.results, b->results_count);
    *count = b->results_count;
    b->state = STATE_IDLE;
    return b->counts.lost_opens == 0 && b->counts.dropped == 0 ? PEL_OK : PEL_TRUNCATED;
}

uint16_t pel_find_runs(const uint8_t *labels, uint16_t width, pel_run *runs)
{
    return labels && runs ? pel_row_find_runs(labels, width, &runs->x0) : 0;
}
