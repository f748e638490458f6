#include "reference.h"

#include <math.h>
#include <string.h>

/* The moments of the largest frames, multiplied by an area, need more than 64 bits. */
__extension__ typedef __int128 wide;

static const int step_x[8] = {1, -1, 0, 0, 1, 1, -1, -1}; /* the first four share an edge */
static const int step_y[8] = {0, 0, 1, -1, 1, -1, 1, -1};

static uint32_t owner[REF_PIXELS_MAX]; /* number of the pixel's blob, from 1; 0 = none yet */
static uint32_t stack[REF_PIXELS_MAX]; /* each pixel is pushed once at most */

/* ---- Which pixels belong together ---------------------------------------------------------- */

static int inside(const ref_map *map, int x, int y)
{
    return x >= 0 && y >= 0 && x < map->width && y < map->height;
}

static uint32_t at(const ref_map *map, int x, int y)
{
    return (uint32_t)y * map->width + (uint32_t)x;
}

static void fill_blob(const ref_map *map, int connectivity, uint32_t start, uint32_t number)
{
    uint32_t depth = 0;
    owner[start] = number;
    stack[depth++] = start;
    while (depth > 0) {
        const uint32_t pixel = stack[--depth];
        const int x = (int)(pixel % map->width);
        const int y = (int)(pixel / map->width);
        int i;
        for (i = 0; i < connectivity; i++) {
            const int nx = x + step_x[i];
            const int ny = y + step_y[i];
            if (inside(map, nx, ny) && owner[at(map, nx, ny)] == 0 &&
                map->labels[at(map, nx, ny)] == map->labels[pixel]) {
                owner[at(map, nx, ny)] = number;
                stack[depth++] = at(map, nx, ny);
            }
        }
    }
}

/* ---- What a blob measures ------------------------------------------------------------------ */

static uint32_t open_sides(const ref_map *map, int x, int y)
{
    uint32_t sides = 0;
    int i;
    for (i = 0; i < 4; i++) {
        const int nx = x + step_x[i];
        const int ny = y + step_y[i];
        if (!inside(map, nx, ny) || owner[at(map, nx, ny)] != owner[at(map, x, y)]) {
            sides++;
        }
    }
    return sides;
}

static void grow_box(pel_blob *blob, uint16_t x, uint16_t y)
{
    if (blob->area == 0 || x < blob->x0) {
        blob->x0 = x;
    }
    if (blob->area == 0 || y < blob->y0) {
        blob->y0 = y;
    }
    if (x + 1u > blob->x1) {
        blob->x1 = (uint16_t)(x + 1u);
    }
    if (y + 1u > blob->y1) {
        blob->y1 = (uint16_t)(y + 1u);
    }
}

static uint8_t touched_edges(const ref_map *map, int x, int y)
{
    int edges = 0;
    edges |= x == 0 ? PEL_EDGE_LEFT : 0;
    edges |= x == map->width - 1 ? PEL_EDGE_RIGHT : 0;
    edges |= y == 0 ? PEL_EDGE_TOP : 0;
    edges |= y == map->height - 1 ? PEL_EDGE_BOTTOM : 0;
    return (uint8_t)edges;
}

static void add_pixel(const ref_map *map, uint16_t x, uint16_t y, pel_blob *blob)
{
    grow_box(blob, x, y);
    blob->area++;
    blob->sum_x += x;
    blob->sum_y += y;
    blob->sum_xx += (uint64_t)x * x;
    blob->sum_xy += (uint64_t)x * y;
    blob->sum_yy += (uint64_t)y * y;
    blob->perimeter += open_sides(map, x, y);
    blob->edges = (uint8_t)(blob->edges | touched_edges(map, x, y));
    blob->class_index = (uint8_t)(map->labels[at(map, x, y)] - 1);
}

static void set_mean_color(const ref_map *map, uint32_t number, const uint8_t *yuv, pel_blob *blob)
{
    uint64_t sum[3] = {0, 0, 0};
    uint16_t x, y;
    for (y = blob->y0; y < blob->y1; y++) {
        for (x = blob->x0; x < blob->x1; x++) {
            if (owner[at(map, x, y)] == number) {
                sum[0] += yuv[3 * at(map, x, y)];
                sum[1] += yuv[3 * at(map, x, y) + 1];
                sum[2] += yuv[3 * at(map, x, y) + 2];
            }
        }
    }
    blob->mean_y = (uint8_t)((2 * sum[0] + blob->area) / (2 * (uint64_t)blob->area));
    blob->mean_u = (uint8_t)((2 * sum[1] + blob->area) / (2 * (uint64_t)blob->area));
    blob->mean_v = (uint8_t)((2 * sum[2] + blob->area) / (2 * (uint64_t)blob->area));
}

/* ---- Holes --------------------------------------------------------------------------------- */

enum { FRAME_SIDE = REF_SIDE_MAX + 2 };

static uint8_t taken[FRAME_SIDE * FRAME_SIDE]; /* 1: of the blob, or visited */
static uint32_t taken_stack[FRAME_SIDE * FRAME_SIDE];

static void fill_complement(int width, int height, int connectivity, int start)
{
    uint32_t depth = 0;
    taken[start] = 1;
    taken_stack[depth++] = (uint32_t)start;
    while (depth > 0) {
        const int cell = (int)taken_stack[--depth];
        int i;
        for (i = 0; i < connectivity; i++) {
            const int x = cell % width + step_x[i];
            const int y = cell / width + step_y[i];
            if (x >= 0 && y >= 0 && x < width && y < height && !taken[y * width + x]) {
                taken[y * width + x] = 1;
                taken_stack[depth++] = (uint32_t)(y * width + x);
            }
        }
    }
}

/*
 * The complement of the blob in its box with one more cell on every side: everything beyond the box
 * hangs together with that border, which is the outside; every other region is a hole.
 */
static uint32_t count_holes(const ref_map *map, int connectivity, uint32_t number,
                            const pel_blob *blob)
{
    const int width = blob->x1 - blob->x0 + 2;
    const int height = blob->y1 - blob->y0 + 2;
    uint32_t regions = 0;
    int x, y, i;
    memset(taken, 0, (size_t)width * (size_t)height);
    for (y = blob->y0; y < blob->y1; y++) {
        for (x = blob->x0; x < blob->x1; x++) {
            taken[(y - blob->y0 + 1) * width + (x - blob->x0 + 1)] = owner[at(map, x, y)] == number;
        }
    }
    for (i = 0; i < width * height; i++) {
        if (!taken[i]) {
            fill_complement(width, height, connectivity == 8 ? 4 : 8, i);
            regions++;
        }
    }
    return regions - 1;
}

/* ---- The blobs of a map -------------------------------------------------------------------- */

uint32_t ref_find(const ref_map *map, int connectivity, const uint8_t *yuv, pel_blob *blobs)
{
    const uint32_t pixels = (uint32_t)map->width * map->height;
    uint32_t count = 0;
    uint32_t i;
    memset(owner, 0, pixels * sizeof owner[0]);
    for (i = 0; i < pixels; i++) {
        if (map->labels[i] != 0 && owner[i] == 0) {
            memset(&blobs[count], 0, sizeof blobs[count]);
            count++;
            fill_blob(map, connectivity, i, count);
        }
    }
    for (i = 0; i < pixels; i++) {
        if (owner[i] != 0) {
            add_pixel(map, (uint16_t)(i % map->width), (uint16_t)(i / map->width),
                      &blobs[owner[i] - 1]);
        }
    }
    for (i = 0; i < count; i++) {
        blobs[i].holes = count_holes(map, connectivity, i + 1, &blobs[i]);
        if (yuv != NULL) {
            set_mean_color(map, i + 1, yuv, &blobs[i]);
        }
    }
    return count;
}

void ref_forget_unmeasured(pel_blob *blob, unsigned measure)
{
    if ((measure & PEL_MEASURE_MOMENTS) == 0) {
        blob->sum_xx = 0;
        blob->sum_xy = 0;
        blob->sum_yy = 0;
    }
    if ((measure & PEL_MEASURE_OUTLINE) == 0) {
        blob->perimeter = 0;
        blob->holes = 0;
    }
    if ((measure & PEL_MEASURE_COLOR) == 0) {
        blob->mean_y = 0;
        blob->mean_u = 0;
        blob->mean_v = 0;
    }
}

uint32_t ref_coloured(const ref_map *map)
{
    const uint32_t pixels = (uint32_t)map->width * map->height;
    uint32_t coloured = 0;
    uint32_t i;
    for (i = 0; i < pixels; i++) {
        coloured += map->labels[i] != 0;
    }
    return coloured;
}

uint32_t ref_open_after_row(const ref_map *map, int connectivity, uint16_t y)
{
    static pel_blob blobs[REF_PIXELS_MAX];
    ref_map upper = *map;
    uint32_t open = 0;
    uint32_t count, i;
    upper.height = (uint16_t)(y + 1u);
    count = ref_find(&upper, connectivity, NULL, blobs);
    for (i = 0; i < count; i++) {
        open += blobs[i].y1 == upper.height;
    }
    return open;
}

/* ---- Order --------------------------------------------------------------------------------- */

static int compare(uint64_t a, uint64_t b)
{
    return a < b ? -1 : a > b;
}

int ref_compare_documented(const void *first, const void *second)
{
    const pel_blob *a = first;
    const pel_blob *b = second;
    int order = compare(b->area, a->area);
    order = order != 0 ? order : compare(a->y0, b->y0);
    order = order != 0 ? order : compare(a->x0, b->x0);
    order = order != 0 ? order : compare(a->class_index, b->class_index);
    order = order != 0 ? order : compare(a->sum_y, b->sum_y);
    return order != 0 ? order : compare(a->sum_x, b->sum_x);
}

int ref_compare_all(const void *first, const void *second)
{
    const pel_blob *a = first;
    const pel_blob *b = second;
    int order = ref_compare_documented(a, b);
    order = order != 0 ? order : compare(a->sum_xx, b->sum_xx);
    order = order != 0 ? order : compare(a->sum_xy, b->sum_xy);
    order = order != 0 ? order : compare(a->sum_yy, b->sum_yy);
    order = order != 0 ? order : compare(a->x1, b->x1);
    order = order != 0 ? order : compare(a->y1, b->y1);
    order = order != 0 ? order : compare(a->perimeter, b->perimeter);
    order = order != 0 ? order : compare(a->holes, b->holes);
    order = order != 0 ? order : compare(a->edges, b->edges);
    order = order != 0 ? order : compare(a->mean_y, b->mean_y);
    order = order != 0 ? order : compare(a->mean_u, b->mean_u);
    return order != 0 ? order : compare(a->mean_v, b->mean_v);
}

/* ---- Shape --------------------------------------------------------------------------------- */

int32_t ref_centroid_q16(uint32_t sum, uint32_t area)
{
    if (area == 0) {
        return 0;
    }
    return (int32_t)((((wide)sum << 17) + area) / (2 * (wide)area));
}

uint16_t ref_density_q15(const pel_blob *blob)
{
    const uint64_t box = (uint64_t)(blob->x1 - blob->x0) * (uint64_t)(blob->y1 - blob->y0);
    const uint64_t density = ((uint64_t)blob->area * 65536 + box) / (2 * box);
    return (uint16_t)(density > 32767 ? 32767 : density);
}

/* Second central moments times area: exact integers. */
static void central_moments(const pel_blob *blob, wide *c20, wide *c11, wide *c02)
{
    *c20 = (wide)blob->area * (wide)blob->sum_xx - (wide)blob->sum_x * blob->sum_x;
    *c11 = (wide)blob->area * (wide)blob->sum_xy - (wide)blob->sum_x * blob->sum_y;
    *c02 = (wide)blob->area * (wide)blob->sum_yy - (wide)blob->sum_y * blob->sum_y;
}

int ref_has_axis(const pel_blob *blob)
{
    wide c20, c11, c02;
    central_moments(blob, &c20, &c11, &c02);
    return c11 != 0 || c20 != c02;
}

long double ref_angle_turn16(const pel_blob *blob)
{
    const long double turn = 2 * acosl(-1.0L);
    wide c20, c11, c02;
    central_moments(blob, &c20, &c11, &c02);
    return atan2l(2 * (long double)c11, (long double)(c20 - c02)) / 2 / turn * 65536;
}

/* sqrt(l2 / l1) = sqrt(l1 l2) / l1, and l1 l2 is the determinant: nothing cancels in l1. */
long double ref_roundness_q15(const pel_blob *blob)
{
    long double a, b, c, large, determinant;
    wide c20, c11, c02;
    central_moments(blob, &c20, &c11, &c02);
    if (!ref_has_axis(blob)) {
        return 32767;
    }
    a = (long double)c20;
    b = (long double)c11;
    c = (long double)c02;
    large = (a + c + sqrtl((a - c) * (a - c) + 4 * b * b)) / 2;
    determinant = a * c - b * b;
    if (determinant <= 0) {
        return 0;
    }
    return fminl(32767, sqrtl(determinant) / large * 32768);
}

long double ref_compactness_q15(const pel_blob *blob)
{
    const long double perimeter = (long double)blob->perimeter;
    if (blob->perimeter == 0) {
        return 0;
    }
    return 4 * acosl(-1.0L) * (long double)blob->area / (perimeter * perimeter) * 32768;
}

/* ---- Filter -------------------------------------------------------------------------------- */

/* value / unit within min / scale .. max / scale, max 0 = no bound; all in integers. */
static int within(uint64_t value, uint64_t unit, uint64_t scale, uint64_t min, uint64_t max)
{
    return value * scale >= min * unit && (max == 0 || value * scale <= max * unit);
}

static int in_region(const pel_blob *blob, const pel_blob_filter *filter)
{
    const uint64_t area = blob->area;
    if (filter->roi_x0 == 0 && filter->roi_x1 == 0 && filter->roi_y0 == 0 && filter->roi_y1 == 0) {
        return 1;
    }
    return blob->sum_x >= filter->roi_x0 * area && blob->sum_x < filter->roi_x1 * area &&
           blob->sum_y >= filter->roi_y0 * area && blob->sum_y < filter->roi_y1 * area;
}

static int class_passes(const pel_blob *blob, uint32_t class_mask)
{
    if (class_mask == 0) {
        return 1;
    }
    return blob->class_index < 32 && ((uint64_t)class_mask >> blob->class_index) % 2 == 1;
}

/* Elongation is allowed to be off by 4; nearer than that to a bound both answers are right. */
static int elongation_passes(const pel_blob *blob, const pel_blob_shape *shape)
{
    const long double low = shape->elongation_min_q15;
    const long double high = shape->elongation_max_q15;
    long double elongation;
    if (low == 0 && high == 0) {
        return 1;
    }
    elongation = 32767 - ref_roundness_q15(blob);
    if ((low > 0 && fabsl(elongation - low) <= 5) || (high > 0 && fabsl(elongation - high) <= 5)) {
        return -1;
    }
    return elongation >= low && (high == 0 || elongation <= high);
}

int ref_passes(const pel_blob *blob, const pel_blob_filter *filter)
{
    const uint64_t width = (uint64_t)(blob->x1 - blob->x0);
    const uint64_t height = (uint64_t)(blob->y1 - blob->y0);
    if (filter == NULL) {
        return 1;
    }
    return within(blob->area, 1, 1, filter->area_min, filter->area_max) &&
           within(width, 1, 1, filter->width_min, filter->width_max) &&
           within(height, 1, 1, filter->height_min, filter->height_max) &&
           within(width, height, 65536, filter->aspect_min_q16, filter->aspect_max_q16) &&
           class_passes(blob, filter->class_mask) && in_region(blob, filter);
}

int ref_shape_passes(const pel_blob *blob, const pel_blob_shape *shape)
{
    if (shape == NULL) {
        return 1;
    }
    if (!within(ref_density_q15(blob), 1, 1, shape->density_min_q15, shape->density_max_q15)) {
        return 0;
    }
    return elongation_passes(blob, shape);
}

/* ---- Colour -------------------------------------------------------------------------------- */

/* base + numerator / divisor, halves upward, limited to 0..255 */
static uint8_t rounded(int64_t base, int64_t numerator, int64_t divisor)
{
    const int64_t shifted = 2 * (base * divisor + numerator) + divisor;
    const int64_t value = shifted < 0 ? 0 : shifted / (2 * divisor);
    return (uint8_t)(value > 255 ? 255 : value);
}

void ref_rgb_to_yuv(const uint8_t *rgb, pel_range range, uint8_t *yuv)
{
    const int64_t r = rgb[0];
    const int64_t g = rgb[1];
    const int64_t b = rgb[2];
    const int64_t luma = 299 * r + 587 * g + 114 * b; /* 1000 Y' */
    if (range == PEL_RANGE_FULL) {
        yuv[0] = rounded(0, luma, 1000);
        yuv[1] = rounded(128, 1000 * b - luma, 1772);
        yuv[2] = rounded(128, 1000 * r - luma, 1402);
    } else {
        yuv[0] = rounded(16, luma * 219, 255000);
        yuv[1] = rounded(128, (1000 * b - luma) * 224, 1772 * 255);
        yuv[2] = rounded(128, (1000 * r - luma) * 224, 1402 * 255);
    }
}
