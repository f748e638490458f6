/*
 * Streaming connected components: how a row joins the open blobs.
 *
 * The runs of the row have been found. One walk from left to right goes over them and over the
 * runs of the row above:
 *   join     each run to the open blobs whose runs it touches above; blobs that turn out to be one
 *            are united (a union-find forest over the slots)
 *   add      the run to the sums of its blob; one that touches none opens a blob
 *   list     a blob as closed when the walk has passed its last run above and no run of this row
 *            had joined it: each blob knows its newest run
 * After the walk the listed blobs are reported. United slots are kept, as runs may still refer to
 * them, until a run finds no free slot. Then the runs of the row learn the roots of their trees,
 * the united slots become free, and the runs without get slots now, if there are any. So a blob is
 * lost only if more blobs than slots are open after the row, and as every open blob owns a run of
 * it, there are never more of them than runs in a row.
 *
 * This file is a part of blobs.c and of blobs_measure.c, which say before it what their blobs
 * measure beyond area, box and sums: clear_extras, unite_extras, touch_extras, add_extras,
 * describe_extras. So a program that measures nothing else carries no code for it.
 */

/* ---- Slots --------------------------------------------------------------------------------- */

static inline unsigned find_root(slot *slots, unsigned id)
{
    while (slots[id].parent != id) {
        slots[id].parent = slots[slots[id].parent].parent; /* path compression by halving */
        id = slots[id].parent;
    }
    return id;
}

static void free_slot(pel_blobs *b, unsigned id)
{
    b->slots[id].area = b->free_slot;
    b->free_slot = (uint16_t)id;
}

/* Opens a blob without pixels in a slot that is free. */
static inline unsigned open_blob(pel_blobs *b, unsigned label)
{
    const uint16_t id = b->free_slot;
    slot *const t = &b->slots[id];

    b->free_slot = (uint16_t)t->area;
    t->area = 0;
    t->sum_x = 0;
    t->sum_y = 0;
    t->x0 = 0xFFFF;
    t->x1 = 0;
    t->y0 = b->next_row;
    t->parent = id;
    t->label = (uint8_t)label;
    t->broken = 0;
    clear_extras(b, id);
    b->open_count++;
    return id;
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
    t->x0 = f->x0 < t->x0 ? f->x0 : t->x0;
    t->x1 = f->x1 > t->x1 ? f->x1 : t->x1;
    t->y0 = f->y0 < t->y0 ? f->y0 : t->y0;
    t->broken = (uint8_t)(t->broken | f->broken);
    unite_extras(b, into, from);
    f->newest = t->newest; /* the walk must not take the place of a run of f for the end of f */
    f->parent = (uint16_t)into;
    f->area = b->united_slot;
    b->united_slot = (uint16_t)from;
    b->open_count--;
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

/* ---- Blobs gather the pixels of the row ---------------------------------------------------- */

/* n * s is even: where n is odd, s is even. */
static inline void add_run(pel_blobs *b, unsigned id, pel_run run, const uint16_t *place,
                           uint64_t touched)
{
    slot *const t = &b->slots[id];
    const uint32_t n = (uint32_t)run.x1 - run.x0, s = (uint32_t)run.x0 + run.x1 - 1;
    const uint32_t y = b->next_row;

    t->area += n;
    t->sum_x += n * s / 2;
    t->sum_y += n * y;
    if (run.x0 < t->x0) {
        t->x0 = run.x0;
    }
    if (run.x1 > t->x1) {
        t->x1 = run.x1;
    }
    t->newest = place_of(place);
    add_extras(b, id, run, touched);
}

/* ---- Blobs that end ------------------------------------------------------------------------ */

PEL_I_APART static void describe(const pel_blobs *b, unsigned id, pel_blob *blob)
{
    const pel_blob zero = {0};
    const slot *const s = &b->slots[id];

    *blob = zero;
    blob->area = s->area;
    blob->sum_x = s->sum_x;
    blob->sum_y = s->sum_y;
    blob->x0 = s->x0;
    blob->x1 = s->x1;
    blob->y0 = s->y0;
    blob->y1 = b->next_row;
    blob->class_index = (uint8_t)(s->label - 1);
    blob->edges = (uint8_t)((s->x0 == 0 ? PEL_EDGE_LEFT : 0) |
                            (s->x1 == b->config.width ? PEL_EDGE_RIGHT : 0) |
                            (s->y0 == 0 ? PEL_EDGE_TOP : 0) |
                            (b->next_row == b->config.height ? PEL_EDGE_BOTTOM : 0));
    describe_extras(b, id, blob);
}

/* Closes the listed blobs: their last row is the one above. The filter lets most blobs of a noisy
 * picture go by their area: those are spared the description. */
PEL_I_APART static void close_listed(pel_blobs *b)
{
    for (unsigned id = b->closed_slot, next; id != END; id = next) {
        const slot *const s = &b->slots[id];
        next = s->parent;
        if (s->broken) {
            b->counts.lost_px += s->area;
        } else if (b->config.filter && s->area < b->config.filter->area_min) {
            b->counts.filtered++;
            b->counts.filtered_px += s->area;
        } else {
            pel_blob blob;
            describe(b, id, &blob);
            pel_i_blobs_report(b, &blob);
        }
        free_slot(b, id);
        b->open_count--;
    }
}

/* ---- A row --------------------------------------------------------------------------------- */

/* A run that touches none opens a blob. On the first walk over a row it may do so later; on the
 * second it is lost if there is still no slot. */
static inline unsigned open_or_lose(pel_blobs *b, unsigned label, int second)
{
    if (b->free_slot != END) {
        return open_blob(b, label);
    }
    if (!second) {
        return NO_BLOB;
    }
    b->counts.lost_opens++;
    return LOST + label - 1;
}

/*
 * The walk over the runs of the row from one on, with those of the row above beside it; returns
 * whether a run found no free slot. The last run of a row is behind its end: it touches nothing,
 * but all of the row above is passed before it.
 */
PEL_I_APART static int walk(pel_blobs *b, size_t first, const pel_run *above, const uint8_t *labels,
                            int second)
{
    const pel_run *next = b->runs[1 - b->above] + first;
    uint16_t *place = b->ids[1 - b->above] + first;
    const uint16_t *place_above = b->ids[b->above];
    slot *const slots = b->slots;
    const int reach = b->reach;
    uint16_t *closed = &b->closed_slot;
    int late = 0;

    for (;; place++) {
        const pel_run run = *next++;
        const int from = (int)run.x0 - reach, to = (int)run.x1 + reach; /* from may be -1 */
        unsigned id = NO_BLOB, label;
        uint64_t touched = 0;
        for (; (int)above->x1 <= from; above++, place_above++) {
            const unsigned other = *place_above;
            if (other < LOST && slots[other].newest == place_of(place_above)) {
                *closed = (uint16_t)other;
                closed = &slots[other].parent;
            }
        }
        if (to >= BEYOND) {
            *closed = END;
            return late;
        }
        label = labels[run.x0];
        for (size_t k = 0; (int)above[k].x0 < to; k++) {
            const unsigned other = place_above[k];
            if (label_of_id(slots, other) == label) {
                id = id == NO_BLOB && other < LOST && slots[other].parent == other
                         ? other
                         : touch(b, id, other);
                touched += touch_extras(run, above[k]);
            }
        }
        if (id == NO_BLOB) {
            id = open_or_lose(b, label, second);
        }
        *place = (uint16_t)id;
        if (id < LOST) {
            add_run(b, id, run, place, touched);
        } else if (id == NO_BLOB) {
            late = 1;
        } else {
            b->counts.lost_px += (uint32_t)(run.x1 - run.x0);
        }
    }
}

/* Runs learn their roots; then nothing refers to united slots any more. */
PEL_I_APART static void settle(pel_blobs *b, size_t count)
{
    uint16_t *const ids = b->ids[1 - b->above];

    for (size_t i = 0; i < count; i++) {
        if (ids[i] < LOST) {
            ids[i] = (uint16_t)find_root(b->slots, ids[i]);
        }
    }
    while (b->united_slot != END) {
        const uint16_t id = b->united_slot;
        b->united_slot = (uint16_t)b->slots[id].area;
        free_slot(b, id);
    }
}

/* Joins the runs of a row, which are in their place, to the blobs. A run that found no slot in the
 * first walk has a second one of its own, which touches nothing. */
PEL_I_APART static void join_row(pel_blobs *b, size_t count, const uint8_t *labels)
{
    const pel_run beyond = {BEYOND - 1, BEYOND};
    pel_run *const runs = b->runs[1 - b->above];
    int late;

    runs[count] = beyond;
    late = walk(b, 0, b->runs[b->above], labels, 0);
    close_listed(b);
    if (late) {
        settle(b, count);
        for (size_t i = 0; i < count; i++) {
            if (b->ids[1 - b->above][i] == NO_BLOB) {
                const pel_run next = runs[i + 1];
                runs[i + 1] = beyond;
                (void)walk(b, i, &runs[i + 1], labels, 1);
                runs[i + 1] = next;
            }
        }
    }
    if (b->open_count > b->counts.open_peak) {
        b->counts.open_peak = b->open_count;
    }
    b->above = (uint8_t)(1 - b->above);
}
