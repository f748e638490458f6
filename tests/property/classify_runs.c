/*
 * pel_row_classify_runs against a loop over pixels that asks each box whether it holds the colour:
 * every width up to 70, every layout, boxes that overlap, touch and repeat, rows from noise to one
 * colour. The pixels, the labels and the edges lie in memory where not one byte beside them may be
 * read or written.
 */
#include "check.h"

#include "pel/classify.h"
#include "row/row.h"

#include <stdio.h>
#include <string.h>

enum { WIDTH_MAX = 70, ROWS = 24, COLORS = 6 };

typedef struct color {
    uint8_t y, u, v;
} color;

static guarded pixel_memory, u_memory, v_memory, labels_memory, edges_memory;

/* ---- Layouts ------------------------------------------------------------------------------- */

/* Bytes of Y and of chroma from one to the next, where the first of each lies; chroma in the bytes
 * of Y, in a plane of U and V, or in two. */
typedef struct layout {
    const char *name;
    uint8_t y_step, c_step, y_at, u_at, v_at;
} layout;

static const layout layouts[] = {
    {"YUYV", 2, 4, 0, 1, 3}, {"YVYU", 2, 4, 0, 3, 1}, {"UYVY", 2, 4, 1, 0, 2},
    {"VYUY", 2, 4, 1, 2, 0}, {"NV12", 1, 2, 0, 0, 1}, {"NV21", 1, 2, 0, 1, 0},
    {"I420", 1, 1, 0, 0, 0}, {"gray", 1, 0, 0, 0, 0},
};
enum { LAYOUTS = sizeof layouts / sizeof layouts[0] };

/* Places of `count` bytes, each `step` behind the one before, and not a byte more. */
static size_t bytes_to_last(size_t count, size_t step, size_t first)
{
    return count == 0 ? 0 : (count - 1) * step + first + 1;
}

static size_t larger(size_t a, size_t b)
{
    return a > b ? a : b;
}

static void take_packed(const layout *l, uint16_t width, size_t offset, uint8_t **y, uint8_t **u,
                        uint8_t **v)
{
    const size_t pairs = (width + 1u) / 2;
    const size_t luma = bytes_to_last(width, l->y_step, l->y_at);
    const size_t chroma = bytes_to_last(pairs, l->c_step, larger(l->u_at, l->v_at));
    uint8_t *const row = guarded_take(&pixel_memory, larger(luma, chroma), offset, 0);
    *y = row + l->y_at;
    *u = row + l->u_at;
    *v = row + l->v_at;
}

static void take_planes(const layout *l, uint16_t width, size_t offset, uint8_t **y, uint8_t **u,
                        uint8_t **v)
{
    const size_t pairs = l->c_step == 0 ? 1 : (width + 1u) / 2;
    *y = guarded_take(&pixel_memory, width, offset, 0);
    if (l->c_step == 2) {
        uint8_t *const both = guarded_take(&u_memory, 2 * pairs, offset, 0);
        *u = both + l->u_at;
        *v = both + l->v_at;
    } else {
        *u = guarded_take(&u_memory, pairs, offset, 0);
        *v = guarded_take(&v_memory, pairs, offset, 0);
    }
}

/* Writes the row into its layout; reads back from it what colours the pixels then have, as two of
 * them share a U and a V. */
static pel_row_pairs lay_out(const layout *l, color *row, uint16_t width, size_t offset)
{
    uint8_t *y, *u, *v;
    unsigned x;
    if (l->y_step == 2) {
        take_packed(l, width, offset, &y, &u, &v);
    } else {
        take_planes(l, width, offset, &y, &u, &v);
    }
    for (x = 0; x < width; x++) {
        y[x * l->y_step] = row[x].y;
        u[x / 2 * l->c_step] = row[x].u;
        v[x / 2 * l->c_step] = row[x].v;
    }
    for (x = 0; x < width; x++) {
        row[x].u = u[x / 2 * l->c_step];
        row[x].v = v[x / 2 * l->c_step];
    }
    {
        const pel_row_pairs pairs = {y, u, v, l->y_step, l->c_step};
        return pairs;
    }
}

/* ---- What is expected ---------------------------------------------------------------------- */

typedef struct box_list {
    pel_color_box box[PEL_CLASS_MAX];
    pel_boxes tables;
} box_list;

static uint8_t label_by_boxes(const box_list *list, color c)
{
    unsigned i;
    for (i = 0; i < PEL_CLASS_MAX; i++) {
        const pel_color_box *const b = &list->box[i];
        if (b->y_min <= c.y && c.y <= b->y_max && b->u_min <= c.u && c.u <= b->u_max &&
            b->v_min <= c.v && c.v <= b->v_max) {
            return (uint8_t)(i + 1);
        }
    }
    return 0;
}

typedef struct labelled_run {
    uint16_t x0, x1;
    uint8_t label;
} labelled_run;

static uint16_t runs_by_loop(const box_list *list, const color *row, uint16_t width,
                             labelled_run *runs)
{
    uint16_t count = 0, x;
    uint8_t before = 0;
    for (x = 0; x < width; x++) {
        const uint8_t label = label_by_boxes(list, row[x]);
        if (label != 0 && label != before) {
            runs[count].x0 = x;
            runs[count].label = label;
            count++;
        }
        if (label != 0) {
            runs[count - 1].x1 = (uint16_t)(x + 1);
        }
        before = label;
    }
    return count;
}

/* ---- Boxes and rows ------------------------------------------------------------------------ */

static uint8_t random_byte(rng *random)
{
    return (uint8_t)rng_next(random);
}

/* Both ends at random, sometimes at the end of the scale; one in eight boxes comes out empty. */
static void random_range(rng *random, uint8_t *min, uint8_t *max)
{
    const uint8_t a = random_byte(random), b = random_byte(random);
    const int swap = (a > b) != (rng_below(random, 24) == 0);
    *min = rng_below(random, 4) == 0 ? 0 : swap ? b : a;
    *max = rng_below(random, 4) == 0 ? 255 : swap ? a : b;
}

/* Of kind 0 any boxes; 1: all share their chroma and split Y, as white, gray and black do; 2: all
 * are the same, so that every mask has many bits; 3: one class. */
static void make_boxes(unsigned kind, rng *random, box_list *list)
{
    const unsigned band = 256 / PEL_CLASS_MAX;
    unsigned i;
    memset(&list->tables, 0, sizeof list->tables);
    for (i = 0; i < PEL_CLASS_MAX; i++) {
        pel_color_box *const b = &list->box[i];
        random_range(random, &b->y_min, &b->y_max);
        random_range(random, &b->u_min, &b->u_max);
        random_range(random, &b->v_min, &b->v_max);
        if (i > 0 && (kind == 1 || kind == 2)) {
            *b = list->box[0];
        }
        if (kind == 1) {
            b->y_min = (uint8_t)(i * band);
            b->y_max = (uint8_t)(i * band + band - 1);
        }
        if (kind == 3 && i > 0) {
            b->y_min = 1;
            b->y_max = 0;
        }
        check_that(pel_boxes_set(&list->tables, i, b) == PEL_OK, "box %u", i);
    }
}

/* A colour in the middle of a box, or any colour. */
static color random_color(const box_list *list, rng *random)
{
    const pel_color_box *const b = &list->box[rng_below(random, PEL_CLASS_MAX)];
    color c = {random_byte(random), random_byte(random), random_byte(random)};
    if (rng_below(random, 3) != 0) {
        c.y = (uint8_t)((b->y_min + b->y_max) / 2);
        c.u = (uint8_t)((b->u_min + b->u_max) / 2);
        c.v = (uint8_t)((b->v_min + b->v_max) / 2);
    }
    return c;
}

/* Stretches of one colour from a few, `length` pixels long on average. */
static void make_row(const box_list *list, unsigned length, rng *random, color *row)
{
    color palette[COLORS], now;
    unsigned x;
    for (x = 0; x < COLORS; x++) {
        palette[x] = random_color(list, random);
    }
    now = palette[0];
    for (x = 0; x < WIDTH_MAX; x++) {
        if (rng_below(random, length) == 0) {
            now = palette[rng_below(random, COLORS)];
        }
        row[x] = now;
        if (rng_below(random, 8) == 0) {
            row[x].y = random_byte(random);
        }
    }
}

/* ---- Comparisons --------------------------------------------------------------------------- */

static int all_intact(void)
{
    return guarded_intact(&pixel_memory) && guarded_intact(&labels_memory) &&
           guarded_intact(&edges_memory);
}

static void compare(const layout *l, const box_list *list, const color *colors, uint16_t width,
                    size_t offset)
{
    const pel_row_boxes tables = {list->tables.y, list->tables.u, list->tables.v};
    color row[WIDTH_MAX];
    labelled_run expected[WIDTH_MAX + 1];
    uint8_t *labels;
    uint16_t *edges;
    uint16_t expected_count, count, i;
    memcpy(row, colors, sizeof row);
    {
        const pel_row_pairs pairs = lay_out(l, row, width, offset);
        expected_count = runs_by_loop(list, row, width, expected);
        labels = guarded_take(&labels_memory, width, offset, 0xEE);
        edges = guarded_take(&edges_memory, 2 * (width + 1u) * sizeof *edges, 0, 0xEE);
        count = pel_row_classify_runs(&tables, &pairs, width, labels, edges);
    }
    check_that(count == expected_count, "width %u offset %u: %u runs, not %u", width,
               (unsigned)offset, count, expected_count);
    for (i = 0; i < count && i < expected_count; i++) {
        const labelled_run *const r = &expected[i];
        check_that(edges[2 * i] == r->x0 && edges[2 * i + 1] == r->x1 && labels[r->x0] == r->label,
                   "width %u offset %u: run %u is %u..%u, not %u..%u, label %u", width,
                   (unsigned)offset, i, edges[2 * i], edges[2 * i + 1], r->x0, r->x1, r->label);
    }
    check_that(all_intact(), "width %u offset %u: wrote outside", width, (unsigned)offset);
}

static void random_rows(const layout *l, uint32_t scale, rng *random)
{
    static const unsigned lengths[] = {1, 2, 3, 8, 30, 1000};
    const unsigned rows = ROWS / scale + 1;
    box_list list;
    color row[WIDTH_MAX];
    unsigned kind, i, length;
    uint16_t width;
    check_group("%s, widths 0 to %d", l->name, WIDTH_MAX);
    for (kind = 0; kind < 4; kind++) {
        for (i = 0; i < rows; i++) {
            make_boxes(kind, random, &list);
            for (length = 0; length < sizeof lengths / sizeof lengths[0]; length++) {
                make_row(&list, lengths[length], random, row);
                for (width = 0; width <= WIDTH_MAX; width++) {
                    compare(l, &list, row, width, rng_below(random, 4));
                }
            }
        }
    }
}

/* Every row of up to seven pixels whose Y tells them apart, three classes and background: all ways
 * in which runs begin, end and meet, at both places of a pair. */
static void all_rows(const layout *l)
{
    static const uint8_t luma[4] = {0, 50, 100, 150};
    box_list list;
    color row[WIDTH_MAX] = {{0, 0, 0}};
    uint32_t number, size = 1;
    unsigned i;
    uint16_t width, x;
    check_group("%s, all rows of up to 7 pixels, three classes", l->name);
    memset(&list, 0, sizeof list);
    for (i = 0; i < PEL_CLASS_MAX; i++) {
        const pel_color_box box = {(uint8_t)(50 * i + 40), (uint8_t)(50 * i + 60), 0, 255, 0, 255};
        const pel_color_box none = {1, 0, 1, 0, 1, 0};
        list.box[i] = i < 3 ? box : none;
        check_that(pel_boxes_set(&list.tables, i, &list.box[i]) == PEL_OK, "box %u", i);
    }
    for (width = 1; width <= 7; width++) {
        size *= 4;
        for (number = 0; number < size; number++) {
            uint32_t rest = number;
            for (x = 0; x < width; x++) {
                row[x].y = luma[rest % 4];
                rest /= 4;
            }
            compare(l, &list, row, width, number % 4);
        }
    }
}

int main(int argc, char **argv)
{
    const uint32_t scale = check_scale(argc, argv);
    rng random = rng_seeded(21);
    unsigned i;
    printf("seed 21\n");
    for (i = 0; i < LAYOUTS; i++) {
        random_rows(&layouts[i], scale, &random);
        all_rows(&layouts[i]);
    }
    guarded_free(&pixel_memory);
    guarded_free(&u_memory);
    guarded_free(&v_memory);
    guarded_free(&labels_memory);
    guarded_free(&edges_memory);
    return check_finish();
}
