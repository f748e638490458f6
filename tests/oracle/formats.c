/*
 * One scene, every format that can carry it without loss, four ways to lie in memory: the blobs
 * must be the same, and they must be those that a flood fill finds in the scene itself.
 *
 * The planes of each frame are pieces of heap of exactly the size that is needed, so that a build
 * with AddressSanitizer also sees any byte read beyond a row.
 */
#include "check.h"

#include <pel.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH_MAX = 64, HEIGHT_MAX = 40, CLASSES = 5 };

static uint64_t seed = UINT64_C(0x853c49e6748fea9b);

static void *allocate(size_t bytes)
{
    void *memory = malloc(bytes);
    if (!memory) {
        fputs("out of memory\n", stderr);
        exit(1);
    }
    return memory;
}

/* ---- Scenes -------------------------------------------------------------------------------- */

/* Three channels per pixel: Y U V or R G B. */
typedef struct picture {
    uint16_t width, height;
    uint8_t pixel[HEIGHT_MAX][WIDTH_MAX][3];
} picture;

static const uint8_t palette[6][3] = {{60, 90, 200}, {200, 40, 150},  {70, 200, 100},
                                      {120, 80, 60}, {128, 128, 128}, {230, 128, 128}};

/* Coloured rectangles, a little noise, and the first channel trembling from pixel to pixel. */
static void paint(picture *scene, uint16_t width, uint16_t height)
{
    scene->width = width;
    scene->height = height;
    memset(scene->pixel, 0, sizeof scene->pixel);
    for (unsigned i = 0; i < 14u + width * height / 12u; i++) {
        const uint8_t *color = palette[random_below(&seed, 6)];
        const unsigned size = i < 14 ? 20 : 1;
        const unsigned x0 = random_below(&seed, width), y0 = random_below(&seed, height);
        const unsigned x1 = x0 + 1 + random_below(&seed, size);
        const unsigned y1 = y0 + 1 + random_below(&seed, size);
        for (unsigned y = y0; y < y1 && y < height; y++) {
            for (unsigned x = x0; x < x1 && x < width; x++) {
                memcpy(scene->pixel[y][x], color, 3);
                scene->pixel[y][x][0] = (uint8_t)(color[0] + random_below(&seed, 24));
            }
        }
    }
}

/* Makes channels 1 and 2 the same within groups of x_group by y_group pixels. */
static void share_chroma(picture *scene, unsigned x_group, unsigned y_group)
{
    for (unsigned y = 0; y < scene->height; y++) {
        for (unsigned x = 0; x < scene->width; x++) {
            const uint8_t *const first = scene->pixel[y / y_group * y_group][x / x_group * x_group];
            scene->pixel[y][x][1] = first[1];
            scene->pixel[y][x][2] = first[2];
        }
    }
}

static void remove_chroma(picture *scene)
{
    for (unsigned y = 0; y < scene->height; y++) {
        for (unsigned x = 0; x < scene->width; x++) {
            scene->pixel[y][x][1] = scene->pixel[y][x][2] = 128;
        }
    }
}

/* Leaves only the colours that RGB565 can show: 8 bits whose low ones repeat the high ones. */
static void reduce_to_565(picture *scene)
{
    for (unsigned y = 0; y < scene->height; y++) {
        for (unsigned x = 0; x < scene->width; x++) {
            uint8_t *const rgb = scene->pixel[y][x];
            rgb[0] = (uint8_t)((rgb[0] & 0xf8) | rgb[0] >> 5);
            rgb[1] = (uint8_t)((rgb[1] & 0xfc) | rgb[1] >> 6);
            rgb[2] = (uint8_t)((rgb[2] & 0xf8) | rgb[2] >> 5);
        }
    }
}

/* ---- Frames -------------------------------------------------------------------------------- */

typedef enum frame_layout { TIGHT, PADDED, BOTTOM_UP, CROPPED, LAYOUTS } frame_layout;

typedef struct test_frame {
    void *memory[3];
    pel_view whole; /* with the margin of CROPPED */
    pel_cview view; /* the scene */
} test_frame;

static void add_plane(test_frame *frame, unsigned p, unsigned row_bytes, unsigned rows,
                      frame_layout layout)
{
    const unsigned stride = row_bytes + (layout == PADDED ? 5 + 2 * p : 0);
    const size_t bytes = (size_t)stride * (rows - 1) + row_bytes;
    uint8_t *const memory = allocate(bytes);

    memset(memory, 0x5e, bytes);
    frame->memory[p] = memory;
    frame->whole.plane[p] = layout == BOTTOM_UP ? memory + (size_t)stride * (rows - 1) : memory;
    frame->whole.stride_bytes[p] = layout == BOTTOM_UP ? -(int32_t)stride : (int32_t)stride;
}

static void make_frame(test_frame *frame, pel_format format, pel_range range, uint16_t width,
                       uint16_t height, frame_layout layout)
{
    const unsigned margin = layout == CROPPED ? 2 : 0;
    const uint16_t w = (uint16_t)(width + 2 * margin), h = (uint16_t)(height + 2 * margin);

    memset(frame, 0, sizeof *frame);
    frame->whole.width = w;
    frame->whole.height = h;
    frame->whole.format = format;
    frame->whole.range = range;
    add_plane(frame, 0, pel_row_bytes(format, w), h, layout);
    if (format == PEL_NV12) {
        add_plane(frame, 1, w, h / 2, layout);
    } else if (format == PEL_I420) {
        add_plane(frame, 1, w / 2, h / 2, layout);
        add_plane(frame, 2, w / 2, h / 2, layout);
    }
    frame->view = pel_view_to_read(&frame->whole);
    if (layout == CROPPED && pel_cview_crop(&frame->view, 2, (uint16_t)(2 + width), 2,
                                            (uint16_t)(2 + height), &frame->view) != PEL_OK) {
        fputs("a crop was refused\n", stderr);
        exit(1);
    }
}

static void free_frame(test_frame *frame)
{
    for (unsigned p = 0; p < 3; p++) {
        free(frame->memory[p]);
    }
}

/* Where the bytes of a 4:2:2 pair lie: Y of the first pixel, U, V; the second Y is 2 further. */
static const uint8_t order_422[4][3] = {{0, 1, 3}, {1, 0, 2}, {0, 3, 1}, {1, 2, 0}};

/* Where red lies in a 2 x 2 cell, in the order of the four mosaics: column, row. */
static const uint8_t red_of_cell[4][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};

static uint8_t *at(const pel_view *view, unsigned p, unsigned y, unsigned byte)
{
    return view->plane[p] + (ptrdiff_t)view->stride_bytes[p] * (ptrdiff_t)y + byte;
}

static void put_mosaic(const pel_view *view, unsigned x, unsigned y, const uint8_t rgb[3])
{
    const uint8_t *const red = red_of_cell[view->format - PEL_BAYER8_RGGB];

    for (unsigned row = 0; row < 2; row++) {
        for (unsigned column = 0; column < 2; column++) {
            const unsigned off = (unsigned)(column != red[0]) + (unsigned)(row != red[1]);
            *at(view, 0, 2 * y + row, 2 * x + column) = rgb[off];
        }
    }
}

/* Writes pixel (x, y), channels c, in the format of the view; for mosaics a whole cell. */
static void put_pixel(const pel_view *view, unsigned x, unsigned y, const uint8_t c[3])
{
    const unsigned bits = (unsigned)(c[0] >> 3) << 11 | (unsigned)(c[1] >> 2) << 5 | c[2] >> 3;

    switch (view->format) {
    case PEL_GRAY8:
        *at(view, 0, y, x) = c[0];
        break;
    case PEL_YUYV:
    case PEL_UYVY:
    case PEL_YVYU:
    case PEL_VYUY: {
        const uint8_t *const order = order_422[view->format - PEL_YUYV];
        *at(view, 0, y, x / 2 * 4 + x % 2 * 2 + order[0]) = c[0];
        *at(view, 0, y, x / 2 * 4 + order[1]) = c[1];
        *at(view, 0, y, x / 2 * 4 + order[2]) = c[2];
        break;
    }
    case PEL_NV12:
        *at(view, 0, y, x) = c[0];
        *at(view, 1, y / 2, x / 2 * 2) = c[1];
        *at(view, 1, y / 2, x / 2 * 2 + 1) = c[2];
        break;
    case PEL_I420:
        *at(view, 0, y, x) = c[0];
        *at(view, 1, y / 2, x / 2) = c[1];
        *at(view, 2, y / 2, x / 2) = c[2];
        break;
    case PEL_RGB565_LE:
    case PEL_RGB565_BE:
        *at(view, 0, y, 2 * x + (view->format == PEL_RGB565_BE)) = (uint8_t)(bits & 255);
        *at(view, 0, y, 2 * x + (view->format == PEL_RGB565_LE)) = (uint8_t)(bits >> 8);
        break;
    case PEL_RGB888:
    case PEL_BGR888:
        for (unsigned i = 0; i < 3; i++) {
            *at(view, 0, y, 3 * x + (view->format == PEL_RGB888 ? i : 2 - i)) = c[i];
        }
        break;
    default:
        put_mosaic(view, x, y, c);
    }
}

static void encode(test_frame *frame, const picture *scene, pel_format format, pel_range range,
                   frame_layout layout)
{
    const unsigned cell = format >= PEL_BAYER8_RGGB ? 2 : 1, margin = layout == CROPPED ? 2 : 0;

    make_frame(frame, format, range, (uint16_t)(scene->width * cell),
               (uint16_t)(scene->height * cell), layout);
    for (unsigned y = 0; y < scene->height; y++) {
        for (unsigned x = 0; x < scene->width; x++) {
            put_pixel(&frame->whole, x + margin / cell, y + margin / cell, scene->pixel[y][x]);
        }
    }
}

/* ---- What must be found -------------------------------------------------------------------- */

/* Overlapping boxes; for RGB scenes they are met by other colours, which is as good. */
static const pel_color_box class_boxes[CLASSES] = {{50, 70, 60, 130, 130, 255},
                                                   {60, 215, 20, 128, 120, 255},
                                                   {60, 120, 90, 255, 80, 128},
                                                   {100, 140, 0, 130, 0, 200},
                                                   {120, 255, 100, 140, 100, 140}};

typedef struct blob_list {
    uint32_t count;
    pel_blob blob[WIDTH_MAX * HEIGHT_MAX];
} blob_list;

typedef struct label_map {
    uint16_t width, height;
    uint8_t label[HEIGHT_MAX][WIDTH_MAX];
} label_map;

static uint8_t label_of(const uint8_t yuv[3])
{
    unsigned c = 0;

    while (c < CLASSES && (yuv[0] < class_boxes[c].y_min || yuv[0] > class_boxes[c].y_max ||
                           yuv[1] < class_boxes[c].u_min || yuv[1] > class_boxes[c].u_max ||
                           yuv[2] < class_boxes[c].v_min || yuv[2] > class_boxes[c].v_max)) {
        c++;
    }
    return (uint8_t)(c < CLASSES ? c + 1 : 0);
}

/* That the conversion itself is exact for all colours is checked in color_exact.c. */
static void label_scene(const picture *scene, int rgb, pel_range range, label_map *map)
{
    map->width = scene->width;
    map->height = scene->height;
    for (unsigned y = 0; y < scene->height; y++) {
        for (unsigned x = 0; x < scene->width; x++) {
            uint8_t yuv[3];
            memcpy(yuv, scene->pixel[y][x], 3);
            if (rgb) {
                pel_rgb_to_ycbcr_row(yuv, yuv, 1, range);
            }
            map->label[y][x] = label_of(yuv);
        }
    }
}

/* Takes the region of pixel (x0, y0) out of the map and measures it. */
static pel_blob flood(label_map *map, unsigned x0, unsigned y0, int connectivity)
{
    static uint16_t todo[WIDTH_MAX * HEIGHT_MAX];
    const uint8_t label = map->label[y0][x0];
    pel_blob blob = {0};
    unsigned count = 0;

    blob.class_index = (uint8_t)(label - 1);
    blob.x0 = blob.y0 = UINT16_MAX;
    todo[count++] = (uint16_t)(y0 * WIDTH_MAX + x0);
    map->label[y0][x0] = 0;
    while (count > 0) {
        const int x = todo[--count] % WIDTH_MAX, y = todo[count] / WIDTH_MAX;
        blob.area++;
        blob.sum_x += (uint32_t)x;
        blob.sum_y += (uint32_t)y;
        blob.x0 = (uint16_t)(x < blob.x0 ? x : blob.x0);
        blob.y0 = (uint16_t)(y < blob.y0 ? y : blob.y0);
        blob.x1 = (uint16_t)(x >= blob.x1 ? x + 1 : blob.x1);
        blob.y1 = (uint16_t)(y >= blob.y1 ? y + 1 : blob.y1);
        for (int k = 0; k < 9; k++) {
            const int nx = x + k % 3 - 1, ny = y + k / 3 - 1;
            if ((connectivity == 4 && k % 2 == 0) || nx < 0 || ny < 0 || nx >= map->width ||
                ny >= map->height || map->label[ny][nx] != label) {
                continue;
            }
            map->label[ny][nx] = 0;
            todo[count++] = (uint16_t)(ny * WIDTH_MAX + nx);
        }
    }
    return blob;
}

static void find_by_flood(const label_map *map, int connectivity, blob_list *found)
{
    label_map rest = *map;

    found->count = 0;
    for (unsigned y = 0; y < rest.height; y++) {
        for (unsigned x = 0; x < rest.width; x++) {
            if (rest.label[y][x] != 0) {
                found->blob[found->count++] = flood(&rest, x, y, connectivity);
            }
        }
    }
}

/* -1, 0 or 1. */
static int compare(uint32_t a, uint32_t b)
{
    return (a > b) - (a < b);
}

/* The order that blobs.h promises: area downward; then y0, x0, class, sum_y, sum_x upward. */
static int in_order(const void *a, const void *b)
{
    const pel_blob *const p = a, *const q = b;
    int order = compare(q->area, p->area);

    order = order ? order : compare(p->y0, q->y0);
    order = order ? order : compare(p->x0, q->x0);
    order = order ? order : compare(p->class_index, q->class_index);
    order = order ? order : compare(p->sum_y, q->sum_y);
    return order ? order : compare(p->sum_x, q->sum_x);
}

/* ---- The comparison ------------------------------------------------------------------------ */

static pel_boxes boxes;

static void find_by_library(const test_frame *frame, pel_range range, int connectivity,
                            blob_list *found)
{
    static uint64_t work[PEL_BLOBS_WORDS(WIDTH_MAX, WIDTH_MAX, PEL_MEASURE_ALL)];
    const pel_classifier classifier = {&boxes,
                                       {NULL, 0, 0, 0},
                                       range,
                                       NULL,
                                       .reader = pel_crow_read_yuv,
                                       .pieces = pel_classify_pieces};
    pel_blobs_config config;
    pel_blobs blobs;
    uint8_t labels[WIDTH_MAX];

    memset(&config, 0, sizeof config);
    config.width = pel_color_width(frame->view.format, frame->view.width);
    config.height = pel_color_height(frame->view.format, frame->view.height);
    config.open_max = WIDTH_MAX;
    config.connectivity = (uint8_t)connectivity;
    config.measure = PEL_MEASURE_ALL;
    config.measurer = pel_blobs_measure;
    config.reader = pel_crow_read_yuv;
    config.work = work;
    config.work_bytes = sizeof work;
    config.results = found->blob;
    config.results_max = WIDTH_MAX * HEIGHT_MAX;
    if (pel_blobs_frame(&blobs, &config, &classifier, &frame->view, labels, &found->count) !=
        PEL_OK) {
        found->count = UINT32_MAX;
    }
}

static int same_basics(const pel_blob *a, const pel_blob *b)
{
    return in_order(a, b) == 0 && a->x1 == b->x1 && a->y1 == b->y1;
}

static int same_in_all(const pel_blob *a, const pel_blob *b)
{
    return same_basics(a, b) && a->sum_xx == b->sum_xx && a->sum_xy == b->sum_xy &&
           a->sum_yy == b->sum_yy && a->perimeter == b->perimeter && a->holes == b->holes &&
           a->edges == b->edges && a->mean_y == b->mean_y && a->mean_u == b->mean_u &&
           a->mean_v == b->mean_v;
}

typedef int (*equality)(const pel_blob *a, const pel_blob *b);

/* How many blobs differ, or are too many or too few. */
static uint64_t differences(const blob_list *a, const blob_list *b, equality same)
{
    uint64_t wrong = 0;

    if (a->count != b->count) {
        return (uint64_t)a->count + b->count;
    }
    for (uint32_t i = 0; i < a->count; i++) {
        wrong += !same(&a->blob[i], &b->blob[i]);
    }
    return wrong;
}

typedef struct comparison {
    uint64_t compared, wrong;
} comparison;

/* The scene in all the given formats and all layouts: basics equal to the flood fill, and all that
 * is measured equal to that of the first frame. */
static void compare_formats(comparison *result, const picture *scene, const pel_format *formats,
                            unsigned count, pel_range range, int connectivity)
{
    static blob_list expected, first, found;
    label_map map;

    label_scene(scene, formats[0] >= PEL_RGB565_LE, range, &map);
    find_by_flood(&map, connectivity, &expected);
    qsort(expected.blob, expected.count, sizeof expected.blob[0], in_order);
    for (unsigned i = 0; i < count * LAYOUTS; i++) {
        test_frame frame;
        encode(&frame, scene, formats[i / LAYOUTS], range, (frame_layout)(i % LAYOUTS));
        find_by_library(&frame, range, connectivity, i == 0 ? &first : &found);
        free_frame(&frame);
        result->wrong += differences(i == 0 ? &first : &found, &expected, same_basics);
        if (i > 0) {
            result->wrong += differences(&found, &first, same_in_all);
        }
        result->compared += expected.count;
    }
}

typedef struct scene_kind {
    const char *name;
    unsigned formats_count;
    pel_format formats[9];
    unsigned x_group, y_group; /* pixels that share chroma; 0: no chroma */
} scene_kind;

static const scene_kind kinds[] = {
    {"chroma shared by pairs: YUYV, UYVY, YVYU, VYUY",
     4,
     {PEL_YUYV, PEL_UYVY, PEL_YVYU, PEL_VYUY},
     2,
     1},
    {"chroma shared by 2 x 2: YUYV, NV12, I420, UYVY, YVYU, VYUY",
     6,
     {PEL_YUYV, PEL_NV12, PEL_I420, PEL_UYVY, PEL_YVYU, PEL_VYUY},
     2,
     2},
    {"no chroma: YUYV, GRAY8, NV12, I420", 4, {PEL_YUYV, PEL_GRAY8, PEL_NV12, PEL_I420}, 0, 0},
    {"colours of 16 bits: RGB888, RGB565_LE, RGB565_BE, BGR888, four mosaics",
     8,
     {PEL_RGB888, PEL_RGB565_LE, PEL_RGB565_BE, PEL_BGR888, PEL_BAYER8_RGGB, PEL_BAYER8_GRBG,
      PEL_BAYER8_GBRG, PEL_BAYER8_BGGR},
     1,
     1},
};

static void check_kind(tally *checks, const scene_kind *kind)
{
    static const uint16_t sizes[][2] = {{2, 2}, {64, 2}, {2, 40}, {34, 18}, {62, 38}, {64, 40}};
    static picture scene;
    comparison result = {0, 0};

    for (unsigned i = 0; i < 4 * sizeof sizes / sizeof sizes[0]; i++) {
        paint(&scene, sizes[i / 4][0], sizes[i / 4][1]);
        if (kind->formats[0] == PEL_RGB888) {
            reduce_to_565(&scene);
        } else if (kind->x_group == 0) {
            remove_chroma(&scene);
        } else {
            share_chroma(&scene, kind->x_group, kind->y_group);
        }
        compare_formats(&result, &scene, kind->formats, kind->formats_count,
                        i % 2 ? PEL_RANGE_FULL : PEL_RANGE_LIMITED, i % 4 < 2 ? 4 : 8);
    }
    check(checks, kind->name, result.compared, result.wrong);
}

int main(void)
{
    tally checks = {0, 0};

    for (unsigned c = 0; c < CLASSES; c++) {
        if (pel_boxes_set(&boxes, c, &class_boxes[c]) != PEL_OK) {
            return 1;
        }
    }
    for (unsigned k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
        check_kind(&checks, &kinds[k]);
    }
    return checks_end(&checks);
}
