#include "blob_list.h"

#include "blob_slots.h"

/* ---- Order --------------------------------------------------------------------------------- */

int pel_i_blob_before(const pel_blob *a, const pel_blob *b)
{
    if (a->area != b->area) {
        return a->area > b->area;
    }
    if (a->y0 != b->y0) {
        return a->y0 < b->y0;
    }
    if (a->x0 != b->x0) {
        return a->x0 < b->x0;
    }
    if (a->class_index != b->class_index) {
        return a->class_index < b->class_index;
    }
    return a->sum_y != b->sum_y ? a->sum_y < b->sum_y : a->sum_x < b->sum_x;
}

#if defined(__OPTIMIZE_SIZE__)
#define comes_before pel_i_blob_before
#else
/* Mostly the area decides. */
static inline int comes_before(const pel_blob *a, const pel_blob *b)
{
    return a->area != b->area ? a->area > b->area : pel_i_blob_before(a, b);
}
#endif

/* Area, y0 and x0, which nearly always decide, as one number: larger for the blob that comes before
 * another. */
static inline uint64_t key_of(const pel_blob *blob)
{
    return (uint64_t)blob->area << 32 | (UINT32_MAX - ((uint32_t)blob->y0 << 16 | blob->x0));
}

/* Of some blobs, one or more, the one that comes last. Which that is nobody can guess: where wrong
 * guesses cost much it is chosen without a jump. */
static inline pel_blob *last_of(pel_blob *blobs, const pel_blob *end)
{
    pel_blob *last = blobs;
    uint64_t last_key = key_of(last);

    for (pel_blob *blob = blobs + 1; blob < end; blob++) {
        const uint64_t key = key_of(blob);
        if (!RUNS_AHEAD || key == last_key) {
            last = comes_before(last, blob) ? blob : last;
        } else {
            last = key < last_key ? blob : last;
            last_key = key < last_key ? key : last_key;
        }
    }
    return last;
}

enum { CHILDREN = 4 };

/* Moves `blob` down from the place `hole` to where its children come before it in the order. Four
 * children each: blobs are large, and so they move half as often as with two. */
static void sift_down(pel_blob *heap, uint32_t count, uint32_t hole, const pel_blob *blob)
{
    pel_blob *place = &heap[hole], *const end = &heap[count];

    for (uint32_t left = CHILDREN * hole + 1; left < count;) {
        pel_blob *const first = &heap[left];
        pel_blob *const last = last_of(first, left + CHILDREN < count ? first + CHILDREN : end);
        if (!comes_before(blob, last)) {
            break;
        }
        *place = *last;
        place = last;
        left = CHILDREN * (left + (uint32_t)(last - first)) + 1;
    }
    *place = *blob;
}

/* Makes a heap of the blobs, then takes the first of it to the end of the list until `left` are in
 * the heap. */
static void heap_sort(pel_blob *blobs, uint32_t count, uint32_t left)
{
    uint32_t unordered = (count + CHILDREN - 2) / CHILDREN; /* those with children */

    while (unordered > 0 || count > left) {
        pel_blob blob;
        if (unordered > 0) {
            blob = blobs[--unordered];
        } else {
            blob = blobs[--count];
            blobs[count] = blobs[0];
        }
        sift_down(blobs, count, unordered, &blob);
    }
}

void pel_i_heap_make(pel_blob *heap, uint32_t count)
{
    heap_sort(heap, count, count);
}

void pel_i_heap_replace(pel_blob *heap, uint32_t count, const pel_blob *blob)
{
    sift_down(heap, count, 0, blob);
}

void pel_blobs_sort(pel_blob *blobs, uint32_t count)
{
    if (blobs) {
        heap_sort(blobs, count, 1);
    }
}

/* ---- Filter -------------------------------------------------------------------------------- */

/* Whether value lies in min..max, where a max of 0 is no bound. */
static int within(uint32_t value, uint32_t min, uint32_t max)
{
    return value >= min && (max == 0 || value <= max);
}

/* The quotient need not be exact: whole numbers compare with its floor or its ceiling as with
 * itself. */
static int aspect_passes(uint32_t width, uint32_t height, const pel_blob_filter *f)
{
    const uint32_t width_q16 = width << 16, divisor = height > 0 ? height : 1;

    return width_q16 / divisor >= f->aspect_min_q16 &&
           within(width_q16 / divisor + (width_q16 % divisor != 0), 0, f->aspect_max_q16);
}

/* As above: edges are whole numbers. */
static int roi_passes(const pel_blob *blob, const pel_blob_filter *f)
{
    const uint32_t area = blob->area > 0 ? blob->area : 1;
    const uint32_t x = blob->sum_x / area, y = blob->sum_y / area;

    return (f->roi_x0 | f->roi_x1 | f->roi_y0 | f->roi_y1) == 0 ||
           (x >= f->roi_x0 && x < f->roi_x1 && y >= f->roi_y0 && y < f->roi_y1);
}

int pel_blob_passes(const pel_blob *blob, const pel_blob_filter *f)
{
    uint32_t width, height;

    if (!blob || !f) {
        return blob != NULL;
    }
    width = (uint32_t)(blob->x1 - blob->x0);
    height = (uint32_t)(blob->y1 - blob->y0);
    return within(blob->area, f->area_min, f->area_max) &&
           within(width, f->width_min, f->width_max) &&
           within(height, f->height_min, f->height_max) &&
           (f->class_mask == 0 ||
            (blob->class_index < 32 && f->class_mask >> blob->class_index & 1)) &&
           aspect_passes(width, height, f) && roi_passes(blob, f);
}

/* ---- Merging ------------------------------------------------------------------------------- */

static uint16_t smaller(uint16_t a, uint16_t b)
{
    return a < b ? a : b;
}

static uint16_t larger(uint16_t a, uint16_t b)
{
    return a > b ? a : b;
}

/* Weighted by areas of at most 2^23 together: 255 * 2^24 < 2^32. */
static uint8_t mean_of(uint8_t a, uint32_t a_area, uint8_t b, uint32_t b_area)
{
    const uint32_t area = a_area + b_area;
    return (uint8_t)(area == 0 ? 0 : (2 * (a * a_area + b * b_area) + area) / (2 * area));
}

void pel_blob_merge(pel_blob *into, const pel_blob *from)
{
    if (!into || !from) {
        return;
    }
    into->mean_y = mean_of(into->mean_y, into->area, from->mean_y, from->area);
    into->mean_u = mean_of(into->mean_u, into->area, from->mean_u, from->area);
    into->mean_v = mean_of(into->mean_v, into->area, from->mean_v, from->area);
    into->area += from->area;
    into->sum_x += from->sum_x;
    into->sum_y += from->sum_y;
    into->sum_xx += from->sum_xx;
    into->sum_xy += from->sum_xy;
    into->sum_yy += from->sum_yy;
    into->perimeter += from->perimeter;
    into->holes += from->holes;
    into->x0 = smaller(into->x0, from->x0);
    into->x1 = larger(into->x1, from->x1);
    into->y0 = smaller(into->y0, from->y0);
    into->y1 = larger(into->y1, from->y1);
    into->edges = (uint8_t)(into->edges | from->edges);
}

/* When two blobs of a class become one. */
typedef struct merge_rule {
    int by_density;
    uint16_t density_q15;
    uint16_t margin_px;
} merge_rule;

static int dense_enough(const pel_blob *a, const pel_blob *b, uint16_t density_q15)
{
    const uint32_t width = (uint32_t)(larger(a->x1, b->x1) - smaller(a->x0, b->x0));
    const uint32_t height = (uint32_t)(larger(a->y1, b->y1) - smaller(a->y0, b->y0));
    const uint64_t area = (uint64_t)a->area + b->area;

    return area << 15 > (uint64_t)density_q15 * (width * height);
}

static int near_enough(const pel_blob *a, const pel_blob *b, uint32_t margin)
{
    return a->x0 < b->x1 + margin && b->x0 < a->x1 + margin && a->y0 < b->y1 + margin &&
           b->y0 < a->y1 + margin;
}

static int rule_applies(const merge_rule *rule, const pel_blob *a, const pel_blob *b)
{
    return a->class_index == b->class_index &&
           (rule->by_density ? dense_enough(a, b, rule->density_q15)
                             : near_enough(a, b, rule->margin_px));
}

/* Merges the first pair, in the order of the list, to which the rule applies; 1 if there
 * was one. */
static int merge_first_pair(const merge_rule *rule, pel_blob *blobs, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t j = i + 1; j < count; j++) {
            if (rule_applies(rule, &blobs[i], &blobs[j])) {
                pel_blob_merge(&blobs[i], &blobs[j]);
                blobs[j] = blobs[count - 1];
                return 1;
            }
        }
    }
    return 0;
}

static uint32_t merge_all(const merge_rule *rule, pel_blob *blobs, uint32_t count)
{
    pel_blobs_sort(blobs, count);
    while (count > 1 && merge_first_pair(rule, blobs, count)) {
        count--;
        pel_blobs_sort(blobs, count);
    }
    return count;
}

uint32_t pel_blobs_merge_density(pel_blob *blobs, uint32_t count, uint16_t density_q15)
{
    const merge_rule rule = {1, density_q15, 0};
    return blobs ? merge_all(&rule, blobs, count) : 0;
}

uint32_t pel_blobs_merge_margin(pel_blob *blobs, uint32_t count, uint16_t margin_px)
{
    const merge_rule rule = {0, 0, margin_px};
    return blobs ? merge_all(&rule, blobs, count) : 0;
}
