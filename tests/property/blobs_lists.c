/*
 * Lists of blobs: sorting, merging two blobs, density merge and margin merge, against references
 * that try every pair again after every merge.
 */
#include "finder.h"
#include "maps.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LIST_MAX = 400, GUARD = 2 };

static pel_blob original[LIST_MAX], expected[LIST_MAX], got[LIST_MAX + GUARD];

/* ---- Lists to work on ------------------------------------------------------------------------ */

/* Blobs in random boxes, with no thought of whether such pixels could exist side by side. */
static uint32_t synthetic_list(rng *random, uint32_t most, uint32_t side, pel_blob *list)
{
    const uint32_t count = rng_below(random, most + 1);
    const uint32_t classes = 1 + rng_below(random, 3);
    uint32_t i;
    for (i = 0; i < count; i++) {
        pel_blob *blob = &list[i];
        uint32_t width, height;
        memset(blob, 0, sizeof *blob);
        width = 1 + rng_below(random, side);
        height = 1 + rng_below(random, side);
        blob->x0 = (uint16_t)rng_below(random, 4 * side);
        blob->y0 = (uint16_t)rng_below(random, 4 * side);
        blob->x1 = (uint16_t)(blob->x0 + width);
        blob->y1 = (uint16_t)(blob->y0 + height);
        blob->area = 1 + rng_below(random, width * height);
        blob->class_index = (uint8_t)rng_below(random, classes);
        blob->sum_x = blob->x0 * blob->area + rng_below(random, 9);
        blob->sum_y = blob->y0 * blob->area + rng_below(random, 9);
        blob->sum_xx = (uint64_t)rng_next(random) << 8;
        blob->sum_xy = (uint64_t)rng_next(random) << 8;
        blob->sum_yy = (uint64_t)rng_next(random) << 8;
        blob->perimeter = rng_below(random, 1000);
        blob->holes = rng_below(random, 10);
        blob->edges = (uint8_t)rng_below(random, 16);
        blob->mean_y = (uint8_t)rng_next(random);
        blob->mean_u = (uint8_t)rng_next(random);
        blob->mean_v = (uint8_t)rng_next(random);
    }
    return count;
}

static void copy_out(const pel_blob *list, uint32_t count)
{
    memcpy(original, list, count * sizeof list[0]);
    memcpy(expected, list, count * sizeof list[0]);
    memset(got, 0x99, sizeof got);
    memcpy(got, list, count * sizeof list[0]);
}

static int guard_intact(uint32_t count)
{
    const uint8_t *bytes = (const uint8_t *)&got[count];
    size_t i;
    int intact = 1;
    for (i = 0; i < GUARD * sizeof got[0]; i++) {
        intact &= bytes[i] == 0x99;
    }
    return intact;
}

/* ---- Sort ------------------------------------------------------------------------------------ */

static void sorting(uint32_t scale)
{
    const uint32_t lists = 4000 / scale;
    rng random = rng_seeded(1);
    uint32_t i, j;
    check_group("pel_blobs_sort against qsort, %u lists (seed 1)", (unsigned)lists);
    for (i = 0; i < lists; i++) {
        static pel_blob list[LIST_MAX];
        /* Small sides make ties down to the last key likely. */
        const uint32_t count = synthetic_list(&random, i % LIST_MAX, 1 + i % 3, list);
        copy_out(list, count);
        qsort(expected, count, sizeof expected[0], ref_compare_all);
        pel_blobs_sort(got, count);
        for (j = 0; j < count; j++) {
            check_that(ref_compare_documented(&got[j], &expected[j]) == 0, "list %u place %u",
                       (unsigned)i, (unsigned)j);
        }
        check_that(guard_intact(count), "wrote behind the list");
        qsort(got, count, sizeof got[0], ref_compare_all);
        for (j = 0; j < count; j++) {
            check_that(ref_compare_all(&got[j], &expected[j]) == 0, "list %u lost a blob",
                       (unsigned)i);
        }
        check_count(1, count);
    }
    pel_blobs_sort(NULL, 0);
    pel_blobs_sort(NULL, 5);
}

/* Each key decides where all keys before it tie. */
static void sorting_by_each_key(void)
{
    unsigned key;
    check_group("pel_blobs_sort: each key in its turn");
    for (key = 0; key < 6; key++) {
        pel_blob list[2];
        memset(list, 0, sizeof list);
        list[0].area = 50;
        list[1].area = 50;
        /* Keys after the one that decides say the opposite. */
        list[0].area += key == 0 ? 0 : 1;
        list[1].area += key == 0 ? 1 : 1;
        list[key < 1 ? 1 : 0].y0 = (uint16_t)(key <= 1 ? 2 : 0);
        list[key < 2 ? 1 : 0].x0 = (uint16_t)(key <= 2 ? 2 : 0);
        list[key < 3 ? 1 : 0].class_index = (uint8_t)(key <= 3 ? 2 : 0);
        list[key < 4 ? 1 : 0].sum_y = key <= 4 ? 2 : 0;
        list[key < 5 ? 1 : 0].sum_x = key <= 5 ? 2 : 0;
        list[1].holes = 77; /* the one that must come first */
        pel_blobs_sort(list, 2);
        check_that(list[0].holes == 77 && list[1].holes == 0, "key %u", key);
    }
}

/* ---- Merging two ----------------------------------------------------------------------------- */

static uint8_t weighted(uint8_t a, uint32_t area_a, uint8_t b, uint32_t area_b)
{
    const uint64_t area = (uint64_t)area_a + area_b;
    return (uint8_t)((2 * ((uint64_t)a * area_a + (uint64_t)b * area_b) + area) / (2 * area));
}

static void ref_merge(pel_blob *into, const pel_blob *from)
{
    into->mean_y = weighted(into->mean_y, into->area, from->mean_y, from->area);
    into->mean_u = weighted(into->mean_u, into->area, from->mean_u, from->area);
    into->mean_v = weighted(into->mean_v, into->area, from->mean_v, from->area);
    into->area += from->area;
    into->sum_x += from->sum_x;
    into->sum_y += from->sum_y;
    into->sum_xx += from->sum_xx;
    into->sum_xy += from->sum_xy;
    into->sum_yy += from->sum_yy;
    into->perimeter += from->perimeter;
    into->holes += from->holes;
    into->edges = (uint8_t)(into->edges | from->edges);
    into->x0 = into->x0 < from->x0 ? into->x0 : from->x0;
    into->y0 = into->y0 < from->y0 ? into->y0 : from->y0;
    into->x1 = into->x1 > from->x1 ? into->x1 : from->x1;
    into->y1 = into->y1 > from->y1 ? into->y1 : from->y1;
}

static void merging_two(uint32_t scale)
{
    const uint32_t pairs = 20000 / scale;
    rng random = rng_seeded(2);
    uint32_t i;
    check_group("pel_blob_merge, %u pairs (seed 2)", (unsigned)pairs);
    for (i = 0; i < pairs; i++) {
        pel_blob list[2], united, before;
        while (synthetic_list(&random, 2, 60, list) < 2) {
        }
        united = list[0];
        before = list[1];
        ref_merge(&united, &list[1]);
        pel_blob_merge(&list[0], &list[1]);
        check_that(ref_compare_all(&united, &list[0]) == 0, "pair %u", (unsigned)i);
        check_that(ref_compare_all(&before, &list[1]) == 0, "pair %u: `from` changed", (unsigned)i);
        check_count(0, 2);
    }
}

/* The largest areas that a frame can have: the weighted mean needs more than 32 bits. */
static void merging_large(void)
{
    pel_blob a, b;
    check_group("pel_blob_merge: two halves of 2048 x 2048");
    memset(&a, 0, sizeof a);
    memset(&b, 0, sizeof b);
    a.area = 1u << 21;
    b.area = 1u << 21;
    a.mean_y = 255;
    b.mean_y = 254;
    a.mean_u = 255;
    b.mean_u = 255;
    pel_blob_merge(&a, &b);
    check_that(a.area == 1u << 22 && a.mean_y == 255 && a.mean_u == 255 && a.mean_v == 0,
               "area %u mean %u %u", (unsigned)a.area, a.mean_y, a.mean_u);
}

/* ---- Merging lists --------------------------------------------------------------------------- */

typedef int (*merge_rule)(const pel_blob *a, const pel_blob *b, uint16_t bound);

static int dense_together(const pel_blob *a, const pel_blob *b, uint16_t density_q15)
{
    pel_blob both = *a;
    uint64_t box;
    ref_merge(&both, b);
    box = (uint64_t)(both.x1 - both.x0) * (uint64_t)(both.y1 - both.y0);
    return a->class_index == b->class_index && (uint64_t)both.area * 32768 > density_q15 * box;
}

static int near_together(const pel_blob *a, const pel_blob *b, uint16_t margin_px)
{
    const int32_t margin = margin_px;
    return a->class_index == b->class_index && a->x0 - margin < b->x1 && b->x0 < a->x1 + margin &&
           a->y0 - margin < b->y1 && b->y0 < a->y1 + margin;
}

/* The largest blob that can swallow another swallows the largest that it can; again, until none. */
static uint32_t merge_by_rule(merge_rule rule, uint16_t bound, pel_blob *list, uint32_t count)
{
    uint32_t i, j;
    qsort(list, count, sizeof list[0], ref_compare_all);
    for (i = 0; i < count; i++) {
        for (j = i + 1; j < count; j++) {
            if (rule(&list[i], &list[j], bound)) {
                ref_merge(&list[i], &list[j]);
                count--;
                memmove(&list[j], &list[j + 1], (count - j) * sizeof list[0]);
                qsort(list, count, sizeof list[0], ref_compare_all);
                i = 0;
                j = 0;
            }
        }
    }
    return count;
}

static void forget_means(pel_blob *list, uint32_t count)
{
    uint32_t i;
    for (i = 0; i < count; i++) {
        ref_forget_unmeasured(&list[i], PEL_MEASURE_MOMENTS | PEL_MEASURE_OUTLINE);
    }
}

static void check_same_lists(uint32_t got_count, uint32_t expected_count, uint16_t bound,
                             uint32_t number)
{
    uint32_t i;
    check_that(got_count == expected_count, "list %u, bound %u: %u blobs, not %u", (unsigned)number,
               bound, (unsigned)got_count, (unsigned)expected_count);
    for (i = 0; i < got_count && i < expected_count; i++) {
        check_that(ref_compare_documented(&got[i], &expected[i]) == 0,
                   "list %u, bound %u: order, place %u", (unsigned)number, bound, (unsigned)i);
    }
    /* Means are rounded at every merge, so they depend on its order; sums do not. */
    forget_means(got, got_count);
    forget_means(expected, expected_count);
    qsort(got, got_count, sizeof got[0], ref_compare_all);
    qsort(expected, expected_count, sizeof expected[0], ref_compare_all);
    for (i = 0; i < got_count && i < expected_count; i++) {
        check_that(ref_compare_all(&got[i], &expected[i]) == 0, "list %u, bound %u: blob %u",
                   (unsigned)number, bound, (unsigned)i);
    }
}

/* Whatever was merged, pixels and sums of every class are still there, and nothing more can be. */
static void check_conserved(merge_rule rule, uint16_t bound, uint32_t count, uint32_t got_count)
{
    int64_t area[3] = {0, 0, 0};
    int64_t sum[3] = {0, 0, 0};
    uint32_t i, j;
    for (i = 0; i < count; i++) {
        area[original[i].class_index] += original[i].area;
        sum[original[i].class_index] += (int64_t)(original[i].sum_xy >> 8);
    }
    for (i = 0; i < got_count; i++) {
        area[got[i].class_index] -= got[i].area;
        sum[got[i].class_index] -= (int64_t)(got[i].sum_xy >> 8);
        for (j = i + 1; j < got_count; j++) {
            check_that(!rule(&got[i], &got[j], bound), "bound %u: blobs %u and %u still merge",
                       bound, (unsigned)i, (unsigned)j);
        }
    }
    check_that(area[0] == 0 && area[1] == 0 && area[2] == 0 && sum[0] == 0 && sum[1] == 0 &&
                   sum[2] == 0,
               "pixels of a class got lost");
}

typedef uint32_t (*list_merge)(pel_blob *blobs, uint32_t count, uint16_t bound);

static void compare_merges(const char *name, list_merge merge, merge_rule rule,
                           uint16_t bound_limit, uint32_t scale)
{
    const uint32_t lists = 3000 / scale;
    rng random = rng_seeded(bound_limit);
    uint32_t merges = 0;
    uint32_t i;
    check_group("%s, %u lists (seed %u)", name, (unsigned)lists, bound_limit);
    for (i = 0; i < lists; i++) {
        static pel_blob list[LIST_MAX];
        const uint16_t bound = (uint16_t)rng_below(&random, bound_limit);
        const uint32_t count = synthetic_list(&random, 1 + i % 40, 3 + i % 20, list);
        uint32_t expected_count, got_count;
        copy_out(list, count);
        expected_count = merge_by_rule(rule, bound, expected, count);
        got_count = merge(got, count, bound);
        check_that(guard_intact(count), "wrote behind the list");
        check_that(got_count <= count, "more blobs than before");
        check_conserved(rule, bound, count, got_count);
        check_same_lists(got_count, expected_count, bound, i);
        merges += count - got_count;
        check_count(1, count);
    }
    check_that(merges > lists, "only %u merges", (unsigned)merges);
}

static pel_blob bar(uint16_t x0, uint16_t x1, uint16_t y0, uint16_t y1, uint8_t class_index)
{
    pel_blob blob;
    memset(&blob, 0, sizeof blob);
    blob.x0 = x0;
    blob.x1 = x1;
    blob.y0 = y0;
    blob.y1 = y1;
    blob.area = (uint32_t)(x1 - x0) * (uint32_t)(y1 - y0);
    blob.class_index = class_index;
    return blob;
}

/* A box of one row has the height 1, not 0: what is far apart on it stays apart. */
static void density_on_one_row(void)
{
    pel_blob list[2];
    check_group("density merge on a single row");
    list[0] = bar(10, 30, 7, 8, 0);
    list[1] = bar(210, 230, 7, 8, 0);
    check_that(pel_blobs_merge_density(list, 2, 31130) == 2, "180 px apart at .95");
    list[0] = bar(10, 30, 7, 8, 0);
    list[1] = bar(31, 51, 7, 8, 0);
    check_that(pel_blobs_merge_density(list, 2, 31130) == 1, "1 px apart: 40 of 41");
    list[0] = bar(10, 30, 7, 8, 0);
    list[1] = bar(31, 51, 7, 8, 1);
    check_that(pel_blobs_merge_density(list, 2, 31130) == 2, "two classes");
    /* 40 of 80 pixels is a half, and a half is not more than a half. */
    list[0] = bar(10, 30, 7, 8, 0);
    list[1] = bar(70, 90, 7, 8, 0);
    check_that(pel_blobs_merge_density(list, 2, 16384) == 2, "exactly the bound");
    check_that(pel_blobs_merge_density(list, 2, 16383) == 1, "just over the bound");
    check_that(list[0].area == 40 && list[0].x0 == 10 && list[0].x1 == 90, "the union");
    check_that(pel_blobs_merge_density(list, 0, 16383) == 0, "an empty list");
}

static void margin_at_its_edge(void)
{
    pel_blob list[3];
    check_group("margin merge at its edge, and in a chain");
    list[0] = bar(0, 10, 0, 10, 0);
    list[1] = bar(13, 20, 0, 10, 0); /* three columns between them */
    check_that(pel_blobs_merge_margin(list, 2, 3) == 2, "grown by 3 the boxes only meet");
    check_that(pel_blobs_merge_margin(list, 2, 4) == 1, "grown by 4 they overlap");
    list[0] = bar(0, 10, 0, 10, 0);
    list[1] = bar(5, 15, 5, 15, 0);
    check_that(pel_blobs_merge_margin(list, 2, 0) == 1, "boxes overlap without a margin");
    list[0] = bar(0, 10, 0, 10, 0);
    list[1] = bar(5, 15, 5, 15, 1);
    check_that(pel_blobs_merge_margin(list, 2, 65535) == 2, "two classes");
    list[0] = bar(0, 10, 0, 10, 0);
    list[1] = bar(30, 36, 0, 6, 0);
    list[2] = bar(15, 25, 0, 1, 0); /* the bridge, smallest of all */
    check_that(pel_blobs_merge_margin(list, 3, 6) == 1 && list[0].x0 == 0 && list[0].x1 == 36,
               "a chain over a bridge");
    list[0] = bar(0, 1, 0, 1, 0);
    list[1] = bar(8191, 8192, 8191, 8192, 0);
    check_that(pel_blobs_merge_margin(list, 2, 65535) == 1, "the largest margin");
    check_that(pel_blobs_merge_margin(list, 0, 1) == 0, "an empty list");
}

static void null_lists(void)
{
    check_group("no list, no blobs");
    check_that(pel_blobs_merge_density(NULL, 0, 1) == 0, "density");
    check_that(pel_blobs_merge_margin(NULL, 0, 1) == 0, "margin");
}

int main(int argc, char **argv)
{
    const uint32_t scale = check_scale(argc, argv);
    sorting(scale);
    sorting_by_each_key();
    merging_two(scale);
    merging_large();
    compare_merges("density merge", pel_blobs_merge_density, dense_together, 32768, scale);
    compare_merges("margin merge", pel_blobs_merge_margin, near_together, 12, scale);
    density_on_one_row();
    margin_at_its_edge();
    null_lists();
    return check_finish();
}
