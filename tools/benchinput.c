#include "benchinput.h"

#include <stdio.h>
#include <string.h>

enum { BLOBS = 40, BLOBS_ACROSS = 8, BLOBS_DOWN = 5, SEED = 1000 };

/* Three planes at full resolution; the chroma is halved when the frame is packed. */
typedef struct planes {
    int width, height;
    uint8_t y[BENCH_WIDTH_MAX * BENCH_HEIGHT_MAX];
    uint8_t u[BENCH_WIDTH_MAX * BENCH_HEIGHT_MAX];
    uint8_t v[BENCH_WIDTH_MAX * BENCH_HEIGHT_MAX];
} planes;

static const uint8_t synth_centre[8][3] = {
    {90, 100, 200}, {140, 70, 180}, {190, 40, 150}, {110, 80, 70},
    {150, 150, 60}, {70, 200, 110}, {90, 180, 150}, {170, 140, 175},
};

static const pel_color_box rand_box = {128, 255, 0, 255, 0, 255};

static const pel_color_box photo_box[6] = {
    {30, 255, 0, 127, 150, 255}, {30, 255, 128, 255, 150, 255}, {30, 255, 140, 255, 0, 149},
    {30, 255, 0, 119, 0, 119},   {30, 255, 0, 104, 120, 149},   {30, 255, 120, 139, 0, 119},
};

/* ---- Random numbers and noise -------------------------------------------------------------- */

/* The finalizer of MurmurHash3: the hash of a counter is a random number, without any state. */
static uint32_t mix(uint32_t h)
{
    h ^= h >> 16;
    h *= 0x85ebca6bu;
    h ^= h >> 13;
    h *= 0xc2b2ae35u;
    return h ^ (h >> 16);
}

static uint32_t random_at(uint32_t seed, uint32_t index)
{
    return mix(seed + 0x9e3779b9u * (index + 1u));
}

static uint32_t byte_sum(uint32_t word)
{
    return (word & 255u) + (word >> 8 & 255u) + (word >> 16 & 255u) + (word >> 24);
}

/* Nearly Gaussian, sigma 4: the sum of 12 bytes has mean 1530 and sigma 256. */
static int noise_at(uint32_t seed, uint32_t index)
{
    uint32_t sum = 0;
    for (uint32_t k = 0; k < 3; k++) {
        sum += byte_sum(random_at(seed, 3u * index + k));
    }
    /* 65536 makes the dividend positive, so that the division rounds down. */
    return (((int)sum - 1530) * 4 + 128 + 65536) / 256 - 256;
}

static uint8_t clip(int value)
{
    return (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : value);
}

static int lattice_node(uint32_t seed, int index, int amplitude)
{
    return (int)(random_at(seed, (uint32_t)index) % (uint32_t)(amplitude + 1));
}

/* Value noise: random values on a grid of cells, bilinear in between. */
static int lattice_at(uint32_t seed, int width, int x, int y, int cell, int amplitude)
{
    const int across = width / cell + 2;
    const int node = y / cell * across + x / cell;
    const int fx = x % cell;
    const int fy = y % cell;
    const int top = lattice_node(seed, node, amplitude) * (cell - fx) +
                    lattice_node(seed, node + 1, amplitude) * fx;
    const int bottom = lattice_node(seed, node + across, amplitude) * (cell - fx) +
                       lattice_node(seed, node + across + 1, amplitude) * fx;
    return (top * (cell - fy) + bottom * fy) / (cell * cell);
}

/* ---- synth --------------------------------------------------------------------------------- */

static void paint_background(planes *picture)
{
    const int scale = BENCH_WIDTH_MAX / picture->width;
    const int w = picture->width;
    for (int y = 0; y < picture->height; y++) {
        for (int x = 0; x < w; x++) {
            const int i = y * w + x;
            picture->y[i] = (uint8_t)(60 + lattice_at(SEED + 1, w, x, y, 16 / scale, 120));
            picture->u[i] = (uint8_t)(118 + lattice_at(SEED + 2, w, x, y, 32 / scale, 20));
            picture->v[i] = (uint8_t)(118 + lattice_at(SEED + 3, w, x, y, 32 / scale, 20));
        }
    }
}

/* A disc of that radius where half_height is 0, else a rectangle. */
typedef struct shape {
    int cx, cy, radius, half_height;
    const uint8_t *color;
} shape;

static int larger(int a, int b)
{
    return a > b ? a : b;
}

static shape shape_of(int index, int width, int height)
{
    const uint32_t seed = (uint32_t)(SEED + 100 + index);
    const int cell_w = width / BLOBS_ACROSS;
    const int cell_h = height / BLOBS_DOWN;
    shape s;
    s.radius = (8 + (int)(random_at(seed, 0) % 29u)) / (BENCH_WIDTH_MAX / width);
    const int free_x = larger(1, cell_w / 2 - s.radius - 1);
    const int free_y = larger(1, cell_h / 2 - s.radius - 1);
    s.cx = index % BLOBS_ACROSS * cell_w + cell_w / 2 +
           (int)(random_at(seed, 1) % (uint32_t)(2 * free_x + 1)) - free_x;
    s.cy = index / BLOBS_ACROSS * cell_h + cell_h / 2 +
           (int)(random_at(seed, 2) % (uint32_t)(2 * free_y + 1)) - free_y;
    s.half_height = 0;
    if (index % 2 != 0) {
        s.half_height = larger(1, s.radius * (40 + (int)(random_at(seed, 3) % 60u)) / 100);
    }
    s.color = synth_centre[(3 * index + index / BLOBS_ACROSS) % 8];
    return s;
}

static int is_inside(const shape *s, int x, int y)
{
    const int dx = x - s->cx;
    const int dy = y - s->cy;
    if (s->half_height == 0) {
        return dx * dx + dy * dy <= s->radius * s->radius;
    }
    return dx >= -s->radius && dx <= s->radius && dy >= -s->half_height && dy <= s->half_height;
}

static void paint_shape(planes *picture, const shape *s)
{
    for (int y = 0; y < picture->height; y++) {
        for (int x = 0; x < picture->width; x++) {
            if (is_inside(s, x, y)) {
                const int i = y * picture->width + x;
                /* A quarter of the contrast stays; 400 makes the division round down. */
                picture->y[i] = clip(s->color[0] + (picture->y[i] - 120 + 400) / 4 - 100);
                picture->u[i] = s->color[1];
                picture->v[i] = s->color[2];
            }
        }
    }
}

static void pack_with_noise(const planes *picture, uint8_t *frame)
{
    const uint32_t pairs = (uint32_t)(picture->width * picture->height) / 2u;
    for (uint32_t k = 0; k < pairs; k++) {
        const int u = (picture->u[2u * k] + picture->u[2u * k + 1u] + 1) / 2;
        const int v = (picture->v[2u * k] + picture->v[2u * k + 1u] + 1) / 2;
        frame[4u * k] = clip(picture->y[2u * k] + noise_at(SEED + 10, 2u * k));
        frame[4u * k + 1u] = clip(u + noise_at(SEED + 11, k));
        frame[4u * k + 2u] = clip(picture->y[2u * k + 1u] + noise_at(SEED + 10, 2u * k + 1u));
        frame[4u * k + 3u] = clip(v + noise_at(SEED + 12, k));
    }
}

static void make_synth(int width, int height, uint8_t *frame)
{
    static planes picture;
    picture.width = width;
    picture.height = height;
    paint_background(&picture);
    for (int i = 0; i < BLOBS; i++) {
        const shape s = shape_of(i, width, height);
        paint_shape(&picture, &s);
    }
    pack_with_noise(&picture, frame);
}

/* ---- rand and photographs ------------------------------------------------------------------ */

static void make_rand(int cell, int width, int height, uint8_t *frame)
{
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            const uint32_t node = (uint32_t)(y / cell * (width / cell) + x / cell);
            const uint32_t is_white = random_at((uint32_t)(7000 + cell), node) >> 31;
            uint8_t *const pixel = frame + 2 * (y * width + x);
            pixel[0] = is_white != 0 ? 235 : 16;
            pixel[1] = 128;
        }
    }
}

static int read_photo(const char *name, size_t bytes, uint8_t *frame)
{
    FILE *const file = fopen(name, "rb");
    if (file == NULL) {
        return -1;
    }
    const int is_whole = fread(frame, 1, bytes, file) == bytes && fgetc(file) == EOF;
    fclose(file);
    return is_whole ? 0 : -1;
}

int bench_is_made(const char *name)
{
    return strcmp(name, "synth") == 0 || strcmp(name, "rand4") == 0 || strcmp(name, "rand1") == 0;
}

int bench_frame(const char *name, int width, int height, uint8_t *frame)
{
    if (strcmp(name, "synth") == 0) {
        make_synth(width, height, frame);
    } else if (strcmp(name, "rand4") == 0) {
        make_rand(4, width, height, frame);
    } else if (strcmp(name, "rand1") == 0) {
        make_rand(1, width, height, frame);
    } else {
        return read_photo(name, 2u * (size_t)width * (size_t)height, frame);
    }
    return 0;
}

static pel_color_box synth_box(const uint8_t centre[3])
{
    const pel_color_box box = {
        clip(centre[0] - 50), clip(centre[0] + 50), clip(centre[1] - 12),
        clip(centre[1] + 12), clip(centre[2] - 12), clip(centre[2] + 12),
    };
    return box;
}

unsigned bench_box_list(const char *name, pel_color_box box[BENCH_BOXES_MAX])
{
    enum { PHOTO_BOXES = sizeof photo_box / sizeof photo_box[0] };
    if (strcmp(name, "synth") == 0) {
        for (unsigned c = 0; c < BENCH_BOXES_MAX; c++) {
            box[c] = synth_box(synth_centre[c]);
        }
        return BENCH_BOXES_MAX;
    }
    if (bench_is_made(name)) {
        box[0] = rand_box;
        return 1;
    }
    memcpy(box, photo_box, sizeof photo_box);
    return PHOTO_BOXES;
}

void bench_boxes(const char *name, pel_boxes *boxes)
{
    pel_color_box box[BENCH_BOXES_MAX];
    const unsigned count = bench_box_list(name, box);
    memset(boxes, 0, sizeof *boxes);
    for (unsigned c = 0; c < count; c++) {
        pel_boxes_set(boxes, c, &box[c]);
    }
}
