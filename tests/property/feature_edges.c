/*
 * Canny's edges against their definition, computed pixel by pixel, and hysteresis against chains
 * that grow until nothing changes; random pictures of every size from 1x1 to 40x30, row by row into
 * the row that was just pushed, and as a frame in place and not.
 */
#include "feature_picture.h"

static guarded work, line_buffer, map_buffer, stack_buffer;

/* ---- Edges --------------------------------------------------------------------------------- */

static uint8_t classes[PIXELS_MAX], kept[PIXELS_MAX];

static int64_t magnitude(int x, int y)
{
    if (x < 0 || y < 0 || x >= width || y >= height) {
        return 0;
    }
    return llabs(sobel(x, y, 0)) + llabs(sobel(x, y, 1));
}

static uint8_t class_of(int x, int y, int low, int high)
{
    const int64_t gx = sobel(x, y, 0), gy = sobel(x, y, 1), m = magnitude(x, y);
    const int64_t flat = 13573 * llabs(gx), steep = flat + 65536 * llabs(gx);
    const int64_t up = 32768 * llabs(gy);
    int top;

    if (up < flat) {
        top = m > magnitude(x - 1, y) && m >= magnitude(x + 1, y);
    } else if (up > steep) {
        top = m > magnitude(x, y - 1) && m >= magnitude(x, y + 1);
    } else if (gx * gy > 0) {
        top = m > magnitude(x - 1, y - 1) && m > magnitude(x + 1, y + 1);
    } else {
        top = m > magnitude(x + 1, y - 1) && m > magnitude(x - 1, y + 1);
    }
    return m <= low || !top ? PEL_CANNY_NONE : m > high ? PEL_CANNY_STRONG : PEL_CANNY_WEAK;
}

/* Chains of neighbours: spread from pixel to pixel until nothing changes. */
static void link_all(void)
{
    int changed = 1;
    memcpy(kept, classes, sizeof kept);
    while (changed) {
        changed = 0;
        for (int i = 0; i < width * height; i++) {
            const int x = i % width, y = i / width;
            for (int v = y - 1; kept[i] == PEL_CANNY_WEAK && v <= y + 1; v++) {
                for (int u = x - 1; u <= x + 1; u++) {
                    if (u >= 0 && v >= 0 && u < width && v < height &&
                        kept[v * width + u] == PEL_CANNY_STRONG) {
                        kept[i] = PEL_CANNY_STRONG;
                        changed = 1;
                    }
                }
            }
        }
    }
    for (int i = 0; i < width * height; i++) {
        kept[i] = kept[i] == PEL_CANNY_STRONG ? PEL_CANNY_STRONG : PEL_CANNY_NONE;
    }
}

static void stream_edges(pel_canny_config c)
{
    pel_canny f;
    int y = 0;

    c.width = (uint16_t)width;
    c.height = (uint16_t)height;
    c.work_bytes = PEL_CANNY_BYTES(width);
    c.work = guarded_take(&work, c.work_bytes, 2, 0xAA);
    check_that(pel_canny_begin(&f, &c) == PEL_OK, "begin");
    for (int pushed = 0; pushed < height; pushed++) {
        uint8_t *const row = guarded_take(&line_buffer, (size_t)width, (size_t)(pushed % 3), 0);
        memcpy(row, picture + pushed * width, (size_t)width);
        check_that(pel_canny_push(&f, row) == PEL_OK, "push");
        while (pel_canny_pull(&f, row) == PEL_OK) { /* into the row that was pushed */
            check_that(memcmp(row, classes + y * width, (size_t)width) == 0,
                       "%dx%d, %d..%d: edges of row %d", width, height, c.low, c.high, y);
            y++;
        }
        check_that(y == (pushed == height - 1 ? height
                         : pushed < 2         ? 0
                                              : pushed - 1),
                   "%dx%d: %d rows of edges after %d", width, height, y, pushed + 1);
    }
    check_that(guarded_intact(&work) && guarded_intact(&line_buffer),
               "%dx%d: wrote beside its memory", width, height);
}

/* A map, with padding, and what is on it. */
static pel_view spread_map(const uint8_t *pixels)
{
    pel_view view;
    memset(&view, 0, sizeof view);
    view.stride_bytes[0] = width + 2;
    view.plane[0] = guarded_take(&map_buffer, (size_t)((width + 2) * height), 0, 0x33);
    view.width = (uint16_t)width;
    view.height = (uint16_t)height;
    for (int y = 0; y < height; y++) {
        memcpy(view.plane[0] + (width + 2) * y, pixels + y * width, (size_t)width);
    }
    return view;
}

static int map_is(const pel_view *map, const uint8_t *pixels)
{
    for (int y = 0; y < height; y++) {
        const uint8_t *const row = map->plane[0] + map->stride_bytes[0] * y;
        if (memcmp(row, pixels + y * width, (size_t)width) != 0 || row[width] != 0x33 ||
            row[width + 1] != 0x33) {
            return 0;
        }
    }
    return 1;
}

static void frame_edges(pel_canny_config c, int in_place)
{
    const pel_cview src = spread_picture(!in_place);
    pel_view map = spread_map(picture);
    const pel_cview same = pel_view_to_read(&map);

    c.work_bytes = PEL_CANNY_BYTES(width);
    c.work = guarded_take(&work, c.work_bytes, 0, 0x55);
    check_that(pel_canny_frame(&c, in_place ? &same : &src, &map) == PEL_OK &&
                   map_is(&map, classes),
               "%dx%d: edges of a frame, in place %d", width, height, in_place);
}

static void hysteresis(uint32_t stack_max)
{
    const size_t bytes = stack_max * sizeof(pel_place);
    const pel_view map = spread_map(classes);
    pel_place *const stack = guarded_take(&stack_buffer, bytes, 0, 0xAA);

    check_that(pel_canny_hysteresis(&map, stack, stack_max) == PEL_OK && map_is(&map, kept),
               "%dx%d: hysteresis with %u places", width, height, (unsigned)stack_max);
    check_that(guarded_intact(&stack_buffer) && guarded_intact(&map_buffer),
               "%dx%d: hysteresis wrote beside its memory", width, height);
}

/* By its words: pixel x of a row stays if its stretch holds or touches a strong one. */
static int is_linked(const uint8_t *above, const uint8_t *row, const uint8_t *below, int x)
{
    int begin = x, end = x;
    if (row[x] == PEL_CANNY_NONE) {
        return 0;
    }
    while (begin > 0 && row[begin - 1] != PEL_CANNY_NONE) {
        begin--;
    }
    while (end < width && row[end] != PEL_CANNY_NONE) {
        end++;
    }
    for (int i = begin; i < end; i++) {
        if (row[i] == PEL_CANNY_STRONG) {
            return 1;
        }
    }
    for (int i = begin > 0 ? begin - 1 : 0; i < end + 1 && i < width; i++) {
        if ((above && above[i] == PEL_CANNY_STRONG) || (below && below[i] == PEL_CANNY_STRONG)) {
            return 1;
        }
    }
    return 0;
}

static void link_rows(void)
{
    static uint8_t linked[PIXELS_MAX], expected[WIDTH_MAX];
    memcpy(linked, classes, sizeof linked);
    for (int y = 0; y < height; y++) {
        uint8_t *const row = linked + y * width;
        const uint8_t *const above = y > 0 ? row - width : NULL;
        const uint8_t *const below = y < height - 1 ? row + width : NULL;
        int nested = 1;
        for (int x = 0; x < width; x++) {
            expected[x] = is_linked(above, row, below, x) ? PEL_CANNY_STRONG : PEL_CANNY_NONE;
        }
        check_that(pel_canny_link_row(above, below, (uint16_t)width, row) == PEL_OK &&
                       memcmp(row, expected, (size_t)width) == 0,
                   "%dx%d: linked row %d", width, height, y);
        for (int x = 0; x < width; x++) {
            nested = nested && (row[x] == 0 || kept[y * width + x] == PEL_CANNY_STRONG) &&
                     (row[x] || classes[y * width + x] != PEL_CANNY_STRONG);
        }
        check_that(nested, "%dx%d: row %d is not between strong and exact", width, height, y);
    }
}

static void every_size_of_edges(rng *random, uint32_t scale, int rounds)
{
    uint32_t turn = 0;
    check_group("Canny, every size to %dx%d", WIDTH_MAX, HEIGHT_MAX);
    for (int i = 0; i < PIXELS_MAX * rounds; i += (int)(1 + rng_below(random, 2 * scale - 1))) {
        pel_canny_config c;
        memset(&c, 0, sizeof c);
        c.low = (uint16_t)rng_below(random, turn % 2 ? 300 : 1000);
        c.high = (uint16_t)(c.low + rng_below(random, turn % 2 ? 500 : 1200));
        draw(random, 1 + i % WIDTH_MAX, 1 + i / WIDTH_MAX % HEIGHT_MAX, turn % 4);
        for (int p = 0; p < width * height; p++) {
            classes[p] = class_of(p % width, p / width, c.low, c.high);
        }
        link_all();
        stream_edges(c);
        frame_edges(c, (int)(turn & 1));
        hysteresis(0);
        hysteresis(1 + turn % 9);
        hysteresis(PIXELS_MAX);
        link_rows();
        turn++;
    }
}

/* Random maps are denser than those of pictures; a spiral is the longest chain there is. */
static void hysteresis_maps(rng *random, uint32_t scale)
{
    check_group("hysteresis on random maps and a spiral");
    for (uint32_t n = 0; n < 2000 / scale + 10; n++) {
        const uint32_t full = 1 + rng_below(random, 8), rare = 2 + rng_below(random, 60);
        width = 1 + (int)rng_below(random, WIDTH_MAX);
        height = 1 + (int)rng_below(random, HEIGHT_MAX);
        for (int i = 0; i < width * height; i++) {
            classes[i] = rng_below(random, 8) >= full   ? PEL_CANNY_NONE
                         : rng_below(random, rare) == 0 ? PEL_CANNY_STRONG
                                                        : PEL_CANNY_WEAK;
        }
        link_all();
        hysteresis(0);
        hysteresis(n % 5);
        link_rows();
    }
    width = 40;
    height = 30;
    memset(classes, 0, sizeof classes);
    for (int x0 = 0, y0 = 0, x1 = 39, y1 = 29; x1 - x0 > 2 && y1 - y0 > 2;) {
        for (int x = x0; x <= x1; x++) { /* right, down, left, and up to the next turn */
            classes[y0 * width + x] = classes[y1 * width + x] = PEL_CANNY_WEAK;
        }
        for (int y = y0; y <= y1; y++) {
            classes[y * width + x1] = PEL_CANNY_WEAK;
            if (y >= y0 + 2) {
                classes[y * width + x0] = PEL_CANNY_WEAK;
            }
        }
        classes[(y0 + 2) * width + x0 + 1] = PEL_CANNY_WEAK;
        x0 += 2;
        y0 += 2;
        x1 -= 2;
        y1 -= 2;
    }
    classes[0] = PEL_CANNY_STRONG;
    link_all();
    check_that(memchr(classes, PEL_CANNY_WEAK, sizeof classes) && kept[14 * 40 + 20] == 0 &&
                   kept[12 * 40 + 20] == PEL_CANNY_STRONG,
               "the spiral is not one chain to its middle");
    hysteresis(0);
    hysteresis(1);
    hysteresis(PIXELS_MAX);
}

int main(int argc, char **argv)
{
    const uint32_t scale = check_scale(argc, argv);
    rng random = rng_seeded(11);
    every_size_of_edges(&random, scale, scale == 1 ? 4 : 1);
    hysteresis_maps(&random, scale);
    guarded_free(&work);
    guarded_free(&line_buffer);
    guarded_free(&map_buffer);
    guarded_free(&stack_buffer);
    guarded_free(&frame_buffer);
    return check_finish();
}
