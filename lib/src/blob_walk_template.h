/*
 * Streaming connected components: how a row joins the open blobs.
 *
 * The runs of the row have been found. One walk from left to right goes over them, with the runs of
 * the row above beside it:
 *   join     each run to the open blobs whose runs it touches above; blobs that turn out to be one
 *            are united (a union-find forest over the slots)
 *   add      the run to the sums of its blob; one that touches none opens a blob
 *   end      a blob where the walk passes its last run in the row above, and it has got none in
 *            this row
 * Then the blobs that have ended are reported.
 * United slots are kept, as runs may still refer to them, until a run finds no free slot. Then the
 * runs of the row learn the roots of their trees, the united slots become free, and the runs
 * without get slots now, if there are any. So a blob is lost only if more blobs than slots are open
 * after the row, and as every open blob owns a run of it, there are never more of them than runs in
 * a row.
 *
 * This file is a part of blobs.c and of blobs_measure.c, which say before it what their blobs
 * measure beyond area, box and sums: set_extras, unite_extras, touch_extras, add_extras,
 * describe_extras. So a program that measures nothing else carries no code for it.
 */

/* Not a call, whatever a compiler thinks of the size; but where size counts. */
#if defined(__GNUC__) && !defined(__OPTIMIZE_SIZE__)
#define INLINE static inline __attribute__((always_inline))
#else
#define INLINE static inline
#endif

/* ---- Slots --------------------------------------------------------------------------------- */

static inline unsigned find_root(slot *slots, unsigned id)
{
    for (unsigned up = pel_i_parent(pel_i_slot(slots, id)); up != id;
         up = pel_i_parent(pel_i_slot(slots, id))) {
        pel_i_slot(slots, id)->root = pel_i_slot(slots, up)->root; /* path compression by halving */
        id = pel_i_parent(pel_i_slot(slots, id));
    }
    return id;
}

static inline void free_slot(pel_blobs *b, unsigned id)
{
    pel_i_slot(b->slots, id)->area = b->free_slot;
    b->free_slot = (uint16_t)id;
}

/* Two different roots become one, which is returned. The other goes to the list of united slots:
 * runs of this row and of the row above still refer to it. */
static inline slot *unite(pel_blobs *b, slot *one, slot *two)
{
    slot *const t = one < two ? one : two, *const f = one < two ? two : one;
    const uint16_t from = pel_i_parent(f);

    t->area += f->area;
    t->sum_x += f->sum_x;
    t->sum_y += f->sum_y;
    t->box.x0 = f->box.x0 < t->box.x0 ? f->box.x0 : t->box.x0;
    t->box.x1 = f->box.x1 > t->box.x1 ? f->box.x1 : t->box.x1;
    t->y0 = f->y0 < t->y0 ? f->y0 : t->y0;
    t->root |= f->root & BROKEN;
    unite_extras(b, pel_i_parent(t), from);
    f->root = t->root;
    f->newest = NO_RUN;
    f->area = b->united_slot;
    b->united_slot = from;
    b->open_count--;
    return t;
}

/* ---- Runs join blobs ----------------------------------------------------------------------- */

/* What a run has found in the row above: its blob, what touch_extras says of the runs that it
 * touches, and whether it touches one that was lost. */
typedef struct found {
    slot *mine;
    uint32_t touched;
    int lost;
} found;

/* Adds the runs from `above` on to what a run has found. Apart, as most runs have one blob above
 * and come without: the walk keeps its registers. */
PEL_I_APART static void join_all(pel_blobs *b, const pel_run *run, uint32_t of_label,
                                 const pel_run *above, const uint16_t *id, found *f)
{
    const int to = (int)run->x1 + b->reach;

    for (; (int)above->x0 < to; above++, id++) {
        if (*id >= LOST) {
            f->lost |= pel_i_of_label(*id + 1 - LOST) == of_label;
        } else if (((pel_i_slot(b->slots, *id)->root ^ of_label) & pel_i_of_label(0xFF)) == 0) {
            slot *const t = pel_i_slot(b->slots, find_root(b->slots, *id));
            f->mine = !f->mine || f->mine == t ? t : unite(b, f->mine, t);
            f->touched += touch_extras(*run, *above);
        }
    }
}

/* A run that may not open a blob is lost. Without a slot it is not yet on the first walk over a
 * row, as it may get one later. *place becomes what stands for its blob. */
PEL_I_APART static void lose_run(pel_blobs *b, const pel_run *run, uint32_t of_label, int lost,
                                 uint16_t *place)
{
    if (!lost && !(b->losses & SECOND)) {
        b->losses = (uint8_t)(b->losses | LATE);
        *place = NO_BLOB;
        return;
    }
    if (!lost) {
        b->counts.lost_opens++;
        b->losses = (uint8_t)(b->losses | NO_SLOT);
    }
    b->losses = (uint8_t)(b->losses | LOST_HERE);
    b->counts.lost_px += (uint32_t)(run->x1 - run->x0);
    *place = (uint16_t)(LOST - 1 + (of_label >> 16));
}

/* ---- Blobs gather the pixels of the row ---------------------------------------------------- */

/* n * s is even: where n is odd, s is even. */
static inline uint32_t sum_of_x(uint32_t x0, uint32_t x1)
{
    return (x1 - x0) * (x0 + x1 - 1) / 2;
}

/* A run x0 .. x1 that touches none opens a blob in the first free slot; there is one. */
static inline slot *open_blob(pel_blobs *b, slot *slots, const pel_run *run, unsigned x0,
                              unsigned x1, uint32_t of_label)
{
    const uint16_t id = b->free_slot;
    slot *const t = pel_i_slot(slots, id);
    const uint32_t n = (uint32_t)x1 - x0;
    const uint16_t y = b->next_row;

    b->free_slot = (uint16_t)t->area;
    t->area = n;
    t->sum_x = sum_of_x(x0, x1);
    t->sum_y = n * y;
    t->box = *run;
    t->y0 = y;
    t->root = of_label | id;
    set_extras(b, id, (pel_run){(uint16_t)x0, (uint16_t)x1});
    b->open_count++;
    return t;
}

static inline void add_run(const pel_blobs *b, slot *t, unsigned x0, unsigned x1, uint32_t touched)
{
    const uint32_t n = (uint32_t)x1 - x0;
    const uint32_t area = t->area, sum_x = t->sum_x, sum_y = t->sum_y;

    t->area = area + n;
    t->sum_x = sum_x + sum_of_x(x0, x1);
    t->sum_y = sum_y + n * b->next_row;
    if (RUNS_AHEAD || x0 < t->box.x0) {
        t->box.x0 = (uint16_t)(x0 < t->box.x0 ? x0 : t->box.x0);
    }
    if (RUNS_AHEAD || x1 > t->box.x1) {
        t->box.x1 = (uint16_t)(x1 > t->box.x1 ? x1 : t->box.x1);
    }
    add_extras(b, pel_i_parent(t), (pel_run){(uint16_t)x0, (uint16_t)x1}, touched);
}

/* ---- Blobs that end ------------------------------------------------------------------------ */

PEL_I_APART static void describe(const pel_blobs *b, unsigned id, pel_blob *blob)
{
    const slot *const s = pel_i_slot(b->slots, id);

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
    blob->x0 = s->box.x0;
    blob->x1 = s->box.x1;
    blob->y0 = s->y0;
    blob->y1 = b->next_row;
    blob->class_index = (uint8_t)(pel_i_slot_label(s) - 1);
    blob->edges = (uint8_t)((s->box.x0 == 0 ? PEL_EDGE_LEFT : 0) |
                            (s->box.x1 == b->config.width ? PEL_EDGE_RIGHT : 0) |
                            (s->y0 == 0 ? PEL_EDGE_TOP : 0) |
                            (b->next_row == b->config.height ? PEL_EDGE_BOTTOM : 0));
    describe_extras(b, id, blob);
}

/* The walk passes a run of the row above: no run to come touches it. If it is the newest of its
 * blob, that has ended and goes to the list of those. */
static inline void pass(pel_blobs *b, slot *slots, const uint16_t *id_above, const int lossy)
{
    const uint16_t id = *id_above;
    slot *const t = pel_i_slot(slots, id);

    if ((!lossy || id < LOST) && t->newest == pel_i_run_name(id_above)) {
        t->newest = b->ended_slot;
        b->ended_slot = id;
    }
}

#if defined(__OPTIMIZE_SIZE__)
#define close_small(b) ((void)(b))
#else
/* Closes those of the blobs that have ended that the filter lets go by their area, most of a noisy
 * picture. They are spared what follows. */
PEL_I_APART static void close_small(pel_blobs *b)
{
    const uint32_t area_min = b->config.filter ? b->config.filter->area_min : 0;
    uint32_t count = 0, px = 0;
    uint16_t ended = END;

    for (unsigned id = b->ended_slot, next; id != END; id = next) {
        slot *const t = pel_i_slot(b->slots, id);
        const uint32_t area = t->area;
        next = t->newest;
        if (t->root & BROKEN || area >= area_min) {
            t->newest = ended;
            ended = (uint16_t)id;
        } else {
            count++;
            px += area;
            free_slot(b, id);
        }
    }
    b->ended_slot = ended;
    b->counts.filtered += count;
    b->counts.filtered_px += px;
    b->open_count = (uint16_t)(b->open_count - count);
}
#endif

/* Closes the blobs that have ended. */
PEL_I_APART static void close_ended(pel_blobs *b)
{
    while (b->ended_slot != END) {
        const unsigned id = b->ended_slot;
        const slot *const t = pel_i_slot(b->slots, id);
        if (t->root & BROKEN) {
            b->counts.lost_px += t->area;
        } else {
            pel_blob blob;
            describe(b, id, &blob);
            pel_i_blobs_report(b, &blob);
        }
        b->ended_slot = t->newest;
        b->open_count--;
        free_slot(b, id);
    }
}

/* ---- A row --------------------------------------------------------------------------------- */

/*
 * The walk over the runs of the row from one on, with those of the row above beside it. The last
 * run of either row is behind its end and touches nothing.
 *
 * Most runs touch none or one above, and that belongs to a root: this is all that they take here.
 * `lossy` tells whether runs above may have been lost.
 */
INLINE void walk(pel_blobs *b, size_t first, const pel_run *above, const uint8_t *labels,
                 const int lossy)
{
    const pel_run *next = b->runs[HERE] + first;
    uint16_t *place = b->ids[HERE] + first;
    const uint16_t *id_above = b->ids[ABOVE];
    slot *const slots = b->slots;
    const int reach = b->reach;

    for (;; next++, place++) {
        const unsigned x0 = next->x0, x1 = next->x1;
        const int from = (int)x0 - reach, to = (int)x1 + reach; /* from may be -1 */
        uint32_t of_label;
        slot *mine;
        found f = {NULL, 0, 0};
        int more;
        for (; (int)above->x1 <= from; above++, id_above++) {
            pass(b, slots, id_above, lossy);
        }
        if (x1 == BEYOND) {
            return;
        }
        of_label = pel_i_of_label(labels[x0]);
        more = (int)above->x0 < to;
        if (more && (!lossy || *id_above < LOST) &&
            pel_i_slot(slots, *id_above)->root == (of_label | *id_above)) {
            f.mine = pel_i_slot(slots, *id_above);
            f.touched = touch_extras(*next, *above);
            if (RUNS_AHEAD) { /* the run above is passed next time, whichever of both ends first */
                more = (int)above[1].x0 < to;
            } else {
                more = above->x1 <= x1;
            }
            if (!RUNS_AHEAD && more) {
                above++; /* what comes in this row has another label, or begins behind it */
                id_above++;
                more = (int)above->x0 < to;
            }
        }
        if (more) {
            const int seen = RUNS_AHEAD && f.mine;
            found g = f;
            join_all(b, next, of_label, above + seen, id_above + seen, &g);
            f = g;
        }
        mine = f.mine;
        if (mine) {
            if (lossy && f.lost) {
                mine->root |= BROKEN;
            }
            add_run(b, mine, x0, x1, f.touched);
        } else if ((lossy && f.lost) || b->free_slot == END) {
            lose_run(b, next, of_label, lossy && f.lost, place);
            continue;
        } else {
            mine = open_blob(b, slots, next, x0, x1, of_label);
        }
        mine->newest = pel_i_run_name(place);
        *place = pel_i_parent(mine);
    }
}

/* Any row. */
PEL_I_APART static void walk_lossy(pel_blobs *b, size_t first, const pel_run *above,
                                   const uint8_t *labels)
{
    walk(b, first, above, labels, 1);
}

#if defined(__OPTIMIZE_SIZE__)
#define walk_whole walk_lossy
#else
/* A row below one of which no run was lost. */
PEL_I_APART static void walk_whole(pel_blobs *b, size_t first, const pel_run *above,
                                   const uint8_t *labels)
{
    walk(b, first, above, labels, 0);
}
#endif

/* Runs learn their roots; then nothing refers to united slots any more. */
PEL_I_APART static void settle(pel_blobs *b, size_t count)
{
    uint16_t *const ids = b->ids[HERE];

    for (size_t i = 0; i < count; i++) {
        if (ids[i] < LOST) {
            ids[i] = (uint16_t)find_root(b->slots, ids[i]);
        }
    }
    while (b->united_slot != END) {
        const uint16_t id = b->united_slot;
        b->united_slot = (uint16_t)pel_i_slot(b->slots, id)->area;
        free_slot(b, id);
    }
}

/* Joins the runs of a row, which are in their place, to the blobs. A run that found no slot in the
 * first walk has a second one of its own, which touches nothing. */
PEL_I_APART static void join_row(pel_blobs *b, size_t count, const uint8_t *labels)
{
    const pel_run beyond = {BEYOND - 1, BEYOND};
    pel_run *const runs = b->runs[HERE];
    uint16_t *const ids = b->ids[HERE];

    runs[count] = beyond;
    ids[count] = NO_BLOB;
    b->losses = b->losses & LOST_HERE ? LOST_ABOVE : 0;
    if (b->losses != 0) {
        walk_lossy(b, 0, b->runs[ABOVE], labels);
    } else {
        walk_whole(b, 0, b->runs[ABOVE], labels);
    }
    if (b->ended_slot != END) {
        close_small(b);
        close_ended(b);
    }
    if (b->losses & LATE) {
        settle(b, count);
        b->losses = (uint8_t)(b->losses | SECOND);
        for (size_t i = 0; i < count; i++) {
            if (ids[i] == NO_BLOB) {
                const pel_run next = runs[i + 1];
                runs[i + 1] = beyond;
                walk_lossy(b, i, &runs[i + 1], labels);
                runs[i + 1] = next;
            }
        }
    }
    if (b->open_count > b->counts.open_peak) {
        b->counts.open_peak = b->open_count;
    }
    b->runs[HERE] = b->runs[ABOVE];
    b->ids[HERE] = b->ids[ABOVE];
    b->runs[ABOVE] = runs;
    b->ids[ABOVE] = ids;
}
