#include "maps.h"

#include <string.h>

typedef struct spot {
    unsigned x, y, width, height;
} spot;

static unsigned smaller(unsigned a, unsigned b)
{
    return a < b ? a : b;
}

static unsigned side_depth(spot p) /* from the nearest of the left and right borders */
{
    return smaller(p.x, p.width - 1 - p.x);
}

/* ---- Shapes as rules: 1 where the pixel belongs to it --------------------------------------- */

static int empty(spot p)
{
    return (int)(p.x * 0);
}
static int full(spot p)
{
    return p.x < p.width;
}
static int checkerboard_1(spot p)
{
    return (p.x + p.y) % 2 == 0;
}
static int checkerboard_2(spot p)
{
    return (p.x / 2 + p.y / 2) % 2 == 0;
}
static int checkerboard_3(spot p)
{
    return (p.x / 3 + p.y / 3) % 2 == 1;
}
static int comb_down(spot p)
{
    return p.y == 0 || p.x % 2 == 0;
}
static int comb_up(spot p)
{
    return p.y == p.height - 1 || p.x % 2 == 0;
}
static int comb_right(spot p)
{
    return p.x == 0 || p.y % 2 == 0;
}
static int comb_left(spot p)
{
    return p.x == p.width - 1 || p.y % 2 == 0;
}
static int comb_slow(spot p) /* teeth of different lengths join one after the other */
{
    return p.x % 2 == 0 ? p.y % (p.x / 2 + 1) != p.x / 2 || p.y > p.x : p.y > p.x;
}
static int rings(spot p)
{
    return smaller(side_depth(p), smaller(p.y, p.height - 1 - p.y)) % 2 == 0;
}
static int rings_inside(spot p)
{
    return !rings(p);
}
static int stairs_down(spot p)
{
    return (p.x / 2 + p.height - p.y) % 3 == 0;
}
static int stairs_up(spot p)
{
    return (p.x / 2 + p.y) % 3 == 0;
}
static int diagonals_down(spot p)
{
    return (p.x + p.height - p.y) % 4 == 0;
}
static int diagonals_up(spot p)
{
    return (p.x + p.y) % 3 == 0;
}
static int cups(spot p) /* U inside U, open at the top */
{
    return smaller(side_depth(p), p.height - 1 - p.y) % 2 == 0;
}
static int arches(spot p) /* the same, open at the bottom */
{
    return smaller(side_depth(p), p.y) % 2 == 0;
}
static int chevrons(spot p) /* V inside V */
{
    return (side_depth(p) + p.height - p.y) % 2 == 0;
}
static int columns(spot p)
{
    return p.x % 2 == 0;
}
static int beams(spot p)
{
    return p.y % 2 == 0;
}
static int dots(spot p)
{
    return p.x % 2 == 0 && p.y % 2 == 0;
}
static int gasket(spot p) /* Sierpinski's: merges of every size */
{
    return (p.x & p.y) == 0;
}
static int gasket_upward(spot p)
{
    return (p.x & (p.height - 1 - p.y)) == 0;
}
static int lattice(spot p)
{
    return p.x % 3 == 0 || p.y % 3 == 0;
}

static const struct {
    const char *name;
    int (*rule)(spot p);
} shapes[SHAPE_COUNT] = {
    {"spiral", empty}, /* the one that is walked, see draw_spiral */
    {"empty frame", empty},
    {"full frame", full},
    {"checkerboard of 1 px", checkerboard_1},
    {"checkerboard of 2 px", checkerboard_2},
    {"checkerboard of 3 px", checkerboard_3},
    {"comb, teeth down", comb_down},
    {"comb, teeth up", comb_up},
    {"comb, teeth right", comb_right},
    {"comb, teeth left", comb_left},
    {"comb, uneven teeth", comb_slow},
    {"rings", rings},
    {"rings from the second on", rings_inside},
    {"stairs down", stairs_down},
    {"stairs up", stairs_up},
    {"diagonals down", diagonals_down},
    {"diagonals up", diagonals_up},
    {"cups", cups},
    {"arches", arches},
    {"chevrons", chevrons},
    {"columns", columns},
    {"beams", beams},
    {"dots", dots},
    {"gasket", gasket},
    {"gasket upward", gasket_upward},
    {"lattice", lattice},
};

const char *shape_name(unsigned shape)
{
    return shapes[shape].name;
}

static int drawn(const uint8_t *labels, int width, int height, int x, int y)
{
    return x >= 0 && y >= 0 && x < width && y < height && labels[y * width + x] != 0;
}

/* Walks inward along the border and turns right one pixel before its own track. */
static void draw_spiral(int width, int height, uint8_t *labels)
{
    static const int step_x[4] = {1, 0, -1, 0};
    static const int step_y[4] = {0, 1, 0, -1};
    int x = 0;
    int y = 0;
    int way = 0;
    int turns = 0;
    labels[0] = 1;
    while (turns < 2) {
        const int nx = x + step_x[way];
        const int ny = y + step_y[way];
        const int blocked = nx < 0 || ny < 0 || nx >= width || ny >= height ||
                            drawn(labels, width, height, nx + step_x[way], ny + step_y[way]) ||
                            drawn(labels, width, height, nx, ny);
        if (blocked) {
            way = (way + 1) % 4;
            turns++;
        } else {
            x = nx;
            y = ny;
            labels[y * width + x] = 1;
            turns = 0;
        }
    }
}

static uint8_t recolour(int is_set, unsigned variant, unsigned x, unsigned y)
{
    switch (variant) {
    case 1:
        return is_set ? 1 : 2;
    case 2:
        return (uint8_t)(is_set ? 1 + x / 4 % 3 : 0);
    case 3:
        return (uint8_t)(is_set ? 1 + (x + y) % 2 : 3);
    case 4:
        return (uint8_t)(is_set ? 1 + (x + 2 * y) % 5 : 0);
    case 5:
        return (uint8_t)(is_set ? 255 : y / 2 % 2);
    default:
        return (uint8_t)is_set;
    }
}

void draw_shape(unsigned shape, unsigned variant, uint16_t width, uint16_t height, uint8_t *labels)
{
    spot p;
    p.width = width;
    p.height = height;
    memset(labels, 0, (size_t)width * height);
    if (shape == 0) {
        draw_spiral(width, height, labels);
    }
    for (p.y = 0; p.y < height; p.y++) {
        for (p.x = 0; p.x < width; p.x++) {
            uint8_t *label = &labels[p.y * width + p.x];
            const int is_set = shape == 0 ? *label != 0 : shapes[shape].rule(p);
            *label = recolour(is_set, variant, p.x, p.y);
        }
    }
}

/* ---- Random maps --------------------------------------------------------------------------- */

static uint8_t random_label(rng *random, unsigned classes, unsigned percent)
{
    return (uint8_t)(rng_below(random, 100) < percent ? 1 + rng_below(random, classes) : 0);
}

static void draw_blocks(rng *random, unsigned classes, uint16_t width, uint16_t height,
                        uint8_t *labels)
{
    const unsigned block_x = 1 + rng_below(random, 7);
    const unsigned block_y = 1 + rng_below(random, 7);
    const unsigned percent = 5 + rng_below(random, 96);
    unsigned x, y;
    for (y = 0; y < height; y++) {
        for (x = 0; x < width; x++) {
            const int first_x = x % block_x == 0;
            const int first_y = y % block_y == 0;
            labels[y * width + x] = !first_y   ? labels[(y - 1) * width + x]
                                    : !first_x ? labels[y * width + x - 1]
                                               : random_label(random, classes, percent);
        }
    }
}

/* Every pixel takes the label of a random neighbour, several times: ragged clusters. */
static void smooth(rng *random, unsigned rounds, uint16_t width, uint16_t height, uint8_t *labels)
{
    uint32_t left = (uint32_t)width * height * rounds;
    while (left-- > 0) {
        const uint32_t x = rng_below(random, width);
        const uint32_t y = rng_below(random, height);
        const uint32_t nx = (x + rng_below(random, 3) + width - 1u) % width;
        const uint32_t ny = (y + rng_below(random, 3) + height - 1u) % height;
        labels[y * width + x] = labels[ny * width + nx];
    }
}

static void draw_rectangles(rng *random, unsigned classes, uint16_t width, uint16_t height,
                            uint8_t *labels)
{
    unsigned count = 1 + rng_below(random, 30);
    memset(labels, 0, (size_t)width * height);
    while (count-- > 0) {
        const uint32_t x0 = rng_below(random, width);
        const uint32_t y0 = rng_below(random, height);
        const uint32_t x1 = x0 + 1 + rng_below(random, width - x0);
        const uint32_t y1 = y0 + 1 + rng_below(random, (height - y0 + 2) / 3);
        const uint8_t label = random_label(random, classes, 75);
        uint32_t y;
        for (y = y0; y < y1 && y < height; y++) {
            memset(&labels[y * width + x0], label, x1 - x0);
        }
    }
}

/* Long thin strokes that bend: deep merges. */
static void draw_strokes(rng *random, unsigned classes, uint16_t width, uint16_t height,
                         uint8_t *labels)
{
    unsigned count = 1 + rng_below(random, 12);
    memset(labels, 0, (size_t)width * height);
    while (count-- > 0) {
        uint32_t x = rng_below(random, width);
        uint32_t y = rng_below(random, height);
        unsigned steps = 5 + rng_below(random, 100);
        const uint8_t label = random_label(random, classes, 100);
        while (steps-- > 0) {
            labels[y * width + x] = label;
            x = (x + rng_below(random, 3) + width - 1u) % width;
            y = rng_below(random, 2) == 0 ? (y + 1) % height : y;
        }
    }
}

void draw_random(rng *random, unsigned classes, uint16_t width, uint16_t height, uint8_t *labels)
{
    const uint32_t kind = rng_below(random, 5);
    const unsigned percent = 5 + rng_below(random, 96);
    uint32_t i;
    if (kind == 0) {
        draw_blocks(random, classes, width, height, labels);
    } else if (kind == 1) {
        draw_rectangles(random, classes, width, height, labels);
    } else if (kind == 2) {
        draw_strokes(random, classes, width, height, labels);
    } else {
        for (i = 0; i < (uint32_t)width * height; i++) {
            labels[i] = random_label(random, classes, percent);
        }
        if (kind == 3) {
            smooth(random, 1 + rng_below(random, 4), width, height, labels);
        }
    }
}
