/*
 * Streaming connected components: how a row joins the open blobs.
 *
 * The runs of the row have been found. One walk from left to right goes over them, with the runs of
 * the row above beside it:
 *   join     each run to the open blobs whose runs it touches above; blobs that turn out to be one
 *            are united (a union-find forest over the slots)
 *   add      the run to the sums of its blob; one that touches none opens a blob
 * Then a blob that has a run in the row above, but none in this one, has ended and is reported.
 * United slots are kept, as runs may still refer to them, until a run finds no free slot. Then the
 * runs of the row learn the roots of their trees, the united slots become free, and the runs
 * without get slots now, if there are any. So a blob is lost only if more blobs than slots are open
 * after the row, and as every open blob owns a run of it, there are never more of them than runs in
 * a row.
 *
 * This file is a part of blobs.c and of blobs_measure.c, which say before it what their blobs
 * measure beyond area, box and sums: clear_extras, unite_extras, touch_extras, add_extras,
 * describe_extras. So a program that measures nothing else carries no code for it.
 */

/* What a noisy picture does for many runs stays in the walk, but where size and stack count. */
#if defined(__OPTIMIZE_SIZE__)
#define APART_IF_SMALL PEL_I_APART
#else
#define APART_IF_SMALL
#endif

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

/* Opens a blob without pixels in a slot that is free; NULL if there is none. */
static inline slot *open_blob(pel_blobs *b, unsigned label)
{
    const uint16_t id = b->free_slot;
    slot *const t = &b->slots[id];

    if (id == END) {
        return NULL;
    }
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
    return t;
}

/* Two different roots become one, which is returned. The other goes to the list of united slots:
 * runs of this row and of the row above still refer to it. */
static inline slot *unite(pel_blobs *b, slot *one, slot *two)
{
    slot *const t = one < two ? one : two, *const f = one < two ? two : one;
    const uint16_t from = f->parent;

    t->area += f->area;
    t->sum_x += f->sum_x;
    t->sum_y += f->sum_y;
    t->x0 = f->x0 < t->x0 ? f->x0 : t->x0;
    t->x1 = f->x1 > t->x1 ? f->x1 : t->x1;
    t->y0 = f->y0 < t->y0 ? f->y0 : t->y0;
    t->broken = (uint8_t)(t->broken | f->broken);
    unite_extras(b, t->parent, from);
    f->parent = t->parent;
    f->area = b->united_slot;
    b->united_slot = from;
    b->open_count--;
    return t;
}

/* ---- Runs join blobs ----------------------------------------------------------------------- */

/* A run of the blob `mine`, or of none so far, touches a run of blob `above`: what it has now.
 * Apart, as most runs have one blob above and come without: the walk keeps its registers. */
PEL_I_APART static slot *join_blob(pel_blobs *b, slot *mine, unsigned above)
{
    slot *const t = &b->slots[find_root(b->slots, above)];
    return !mine || mine == t ? t : unite(b, mine, t);
}

/* Whether a run of the label that ends before `to` touches one that was lost. */
PEL_I_APART static int touches_lost(const pel_run *above, const uint16_t *id, int to,
                                    unsigned label)
{
    for (; (int)above->x0 < to; above++, id++) {
        if (*id == LOST + label - 1) {
            return 1;
        }
    }
    return 0;
}

/* A run without a blob above opens one. It is lost if it touches one that was lost, and if there is
 * no slot; but on the first walk over a row it may get one later. Without a slot it answers NULL
 * and *place is what stands for its blob. */
APART_IF_SMALL static slot *open_or_lose(pel_blobs *b, const pel_run *run, unsigned label, int lost,
                                         uint16_t *place)
{
    slot *const opened = lost ? NULL : open_blob(b, label);

    if (opened) {
        return opened;
    }
    if (!lost && !(b->losses & SECOND)) {
        b->losses = (uint8_t)(b->losses | LATE);
        *place = NO_BLOB;
        return NULL;
    }
    if (!lost) {
        b->counts.lost_opens++;
    }
    b->losses = (uint8_t)(b->losses | LOST_HERE);
    b->counts.lost_px += (uint32_t)(run->x1 - run->x0);
    *place = (uint16_t)(LOST + label - 1);
    return NULL;
}

/* ---- Blobs gather the pixels of the row ---------------------------------------------------- */

/* n * s is even: where n is odd, s is even. */
static inline void add_run(const pel_blobs *b, slot *t, pel_run run, unsigned y, uint64_t touched)
{
    const uint32_t n = (uint32_t)run.x1 - run.x0, s = (uint32_t)run.x0 + run.x1 - 1;

    t->area += n;
    t->sum_x += n * s / 2;
    t->sum_y += n * y;
    if (run.x0 < t->x0) {
        t->x0 = run.x0;
    }
    if (run.x1 > t->x1) {
        t->x1 = run.x1;
    }
    t->newest = (uint16_t)y;
    add_extras(b, t->parent, run, touched);
}

/* ---- Blobs that end ------------------------------------------------------------------------ */

PEL_I_APART static void describe(const pel_blobs *b, unsigned id, pel_blob *blob)
{
    const slot *const s = &b->slots[id];

    blob->sum_xx = 0;
    blob->sum_xy = 0;
    blob->sum_yy = 0;
    blob->perimeter = 0;
    blob->holes = 0;
    blob->mean_y = 0;
    blob->mean_u = 0;
    blob->mean_v = 0;
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

/* The filter lets most blobs of a noisy picture go by their area: those are spared the
 * description. */
static inline void close_blob(pel_blobs *b, unsigned id)
{
    const slot *const s = &b->slots[id];

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

/* Closes the blobs that have runs above and none in this row. Each is closed once: it is given a
 * run in this row. */
PEL_I_APART static void close_ended(pel_blobs *b)
{
    slot *const slots = b->slots;
    const unsigned y = b->next_row;

    for (const uint16_t *above = b->ids[b->above];; above++) {
        const unsigned id = *above;
        if (id >= LOST) {
            if (id == NO_BLOB) {
                return;
            }
        } else if (slots[id].newest != y && slots[id].parent == id) {
            slots[id].newest = (uint16_t)y;
            close_blob(b, id);
        }
    }
}

/* ---- A row --------------------------------------------------------------------------------- */

/*
 * The walk over the runs of the row from one on, with those of the row above beside it. The last
 * run of either row is behind its end and touches nothing.
 */
PEL_I_APART static void walk(pel_blobs *b, size_t first, const pel_run *above,
                             const uint8_t *labels)
{
    const pel_run *next = b->runs[1 - b->above] + first;
    uint16_t *place = b->ids[1 - b->above] + first;
    const uint16_t *id_above = b->ids[b->above];
    slot *const slots = b->slots;
    const unsigned y = b->next_row;
    const int reach = b->reach, lossy = b->losses & LOST_ABOVE;

    for (;; next++, place++) {
        const unsigned x0 = next->x0, x1 = next->x1;
        const int from = (int)x0 - reach, to = (int)x1 + reach; /* from may be -1 */
        const uint16_t *id = id_above;
        slot *mine = NULL;
        uint64_t touched = 0;
        unsigned label;
        int lost;
        if (x1 == BEYOND) {
            return;
        }
        label = labels[x0];
        for (; (int)above->x1 <= from; above++) {
            id = ++id_above;
        }
        for (const pel_run *other = above; (int)other->x0 < to; other++, id++) {
            slot *const t = &slots[*id];
            if (*id < LOST && t->label == label) {
                mine = mine || t->parent != *id ? join_blob(b, mine, *id) : t;
                touched += touch_extras(*next, *other);
            }
        }
        lost = lossy && touches_lost(above, id_above, to, label);
        if (!mine) {
            mine = open_or_lose(b, next, label, lost, place);
            if (!mine) {
                continue;
            }
        } else if (lost) {
            mine->broken = 1;
        }
        *place = mine->parent;
        add_run(b, mine, *next, y, touched);
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
    uint16_t *const ids = b->ids[1 - b->above];

    runs[count] = beyond;
    ids[count] = NO_BLOB;
    b->losses = b->losses & LOST_HERE ? LOST_ABOVE : 0;
    walk(b, 0, b->runs[b->above], labels);
    close_ended(b);
    if (b->losses & LATE) {
        settle(b, count);
        b->losses = (uint8_t)(b->losses | SECOND);
        for (size_t i = 0; i < count; i++) {
            if (ids[i] == NO_BLOB) {
                const pel_run next = runs[i + 1];
                runs[i + 1] = beyond;
                walk(b, i, &runs[i + 1], labels);
                runs[i + 1] = next;
            }
        }
    }
    if (b->open_count > b->counts.open_peak) {
        b->counts.open_peak = b->open_count;
    }
    b->above = (uint8_t)(1 - b->above);
}
