/*
 * Seeded random maps: every field of every blob, shape functions, loss, filters, mean colours, and
 * whole frames, against the reference.
 */
#include "finder.h"
#include "maps.h"

#include <stdlib.h>
#include <string.h>

enum { WIDTH_MAX = 64, HEIGHT_MAX = 48, PIXELS_MAX = WIDTH_MAX * HEIGHT_MAX };

static uint8_t labels[PIXELS_MAX];
static uint8_t bytes[PIXELS_MAX * 3]; /* of a picture, packed */
static uint8_t yuv[PIXELS_MAX * 3];   /* the same as Y U V per pixel */

static void random_map(rng *random, unsigned classes, ref_map *map)
{
    map->width = (uint16_t)(1 + rng_below(random, WIDTH_MAX));
    map->height = (uint16_t)(1 + rng_below(random, HEIGHT_MAX));
    map->labels = labels;
    draw_random(random, classes, map->width, map->height, labels);
}

static int random_connectivity(rng *random)
{
    return rng_below(random, 2) == 0 ? 4 : 8;
}

/* ---- Everything, at the never-lose size ------------------------------------------------------ */

static void all_fields(uint32_t scale)
{
    const uint32_t images = 20000 / scale;
    rng random = rng_seeded(1);
    uint32_t i, j;
    int connectivity;
    check_group("%u random maps, 8 classes, 4- and 8-connected (seed 1)", (unsigned)images);
    for (i = 0; i < images; i++) {
        ref_map map;
        random_map(&random, 8, &map);
        for (connectivity = 4; connectivity <= 8; connectivity += 4) {
            setup trial = setup_safe(&map, connectivity);
            const expectation expected = expect(&map, connectivity, trial.measure, NULL);
            verify(&trial, &expected);
            for (j = 0; j < expected.count; j++) {
                verify_shape(&expected.blobs[j], trial.measure);
            }
        }
    }
}

/* ---- Too little room ------------------------------------------------------------------------- */

static void too_little_room(uint32_t scale)
{
    const uint32_t images = 4000 / scale;
    rng random = rng_seeded(2);
    uint32_t i, k;
    check_group("%u random maps with few open blobs and results (seed 2)", (unsigned)images);
    for (i = 0; i < images; i++) {
        ref_map map;
        setup trial;
        expectation expected;
        random_map(&random, 1 + rng_below(&random, 8), &map);
        trial = setup_safe(&map, random_connectivity(&random));
        expected = expect(&map, trial.connectivity, trial.measure, NULL);
        for (k = 0; k < 6; k++) {
            trial.open_max = (uint16_t)(1 + rng_below(&random, map.width + 2u));
            trial.results_max = rng_below(&random, expected.count + 3);
            verify(&trial, &expected);
        }
    }
}

static void any_label(uint32_t scale)
{
    const uint32_t images = 1000 / scale;
    rng random = rng_seeded(3);
    uint32_t i;
    check_group("%u random maps with labels up to 255, no callback (seed 3)", (unsigned)images);
    for (i = 0; i < images; i++) {
        ref_map map;
        setup trial;
        expectation expected;
        random_map(&random, 255, &map);
        trial = setup_safe(&map, random_connectivity(&random));
        trial.silent = 1;
        expected = expect(&map, trial.connectivity, trial.measure, NULL);
        verify(&trial, &expected);
    }
}

/* ---- Filters --------------------------------------------------------------------------------- */

enum { FILTER_KINDS = 15 };

static uint16_t half_the_time(rng *random, uint32_t value)
{
    return (uint16_t)(rng_below(random, 2) == 0 ? 0 : value);
}

static void set_region(rng *random, const ref_map *map, pel_blob_filter *filter)
{
    filter->roi_x0 = (uint16_t)rng_below(random, map->width);
    filter->roi_x1 = (uint16_t)(filter->roi_x0 + rng_below(random, map->width));
    filter->roi_y0 = (uint16_t)rng_below(random, map->height);
    filter->roi_y1 = (uint16_t)(filter->roi_y0 + rng_below(random, map->height));
}

/* Sets one kind of bound; `like` is a blob of the map, so that bounds are met exactly, too. */
static void set_bound(unsigned kind, rng *random, const ref_map *map, const pel_blob *like,
                      pel_blob_filter *filter, pel_blob_shape *shape)
{
    const uint32_t width = (uint32_t)(like->x1 - like->x0);
    const uint32_t height = (uint32_t)(like->y1 - like->y0);
    const uint32_t near = rng_below(random, 3); /* 0, 1, 2: below, at, above */
    switch (kind) {
    case 0:
        filter->area_min = like->area + near - 1;
        break;
    case 1:
        filter->area_max = like->area + near - 1;
        break;
    case 2:
        filter->width_min = (uint16_t)(width + near - 1);
        break;
    case 3:
        filter->width_max = (uint16_t)(width + near - 1);
        break;
    case 4:
        filter->height_min = (uint16_t)(height + near - 1);
        break;
    case 5:
        filter->height_max = (uint16_t)(height + near - 1);
        break;
    case 6:
        filter->aspect_min_q16 = width * 65536 / height + near - 1;
        break;
    case 7:
        filter->aspect_max_q16 = width * 65536 / height + near - 1;
        break;
    case 8:
        shape->density_min_q15 = (uint16_t)(ref_density_q15(like) + near - 1);
        break;
    case 9:
        shape->density_max_q15 = (uint16_t)(ref_density_q15(like) + near - 1);
        break;
    case 10:
        shape->elongation_min_q15 = (uint16_t)rng_below(random, 32768);
        break;
    case 11:
        shape->elongation_max_q15 = (uint16_t)rng_below(random, 32768);
        break;
    case 12:
        filter->class_mask = 1u + rng_below(random, 255);
        break;
    case 13:
        set_region(random, map, filter);
        break;
    default: /* a region with an edge right at a centroid */
        filter->roi_x0 = half_the_time(random, like->sum_x / like->area);
        filter->roi_x1 = (uint16_t)(like->sum_x / like->area + near);
        filter->roi_y1 = (uint16_t)(map->height - half_the_time(random, map->height / 2u));
        break;
    }
}

static void filter_trial(unsigned kind, unsigned more, rng *random)
{
    ref_map map;
    setup trial;
    expectation expected;
    pel_blob_filter filter;
    pel_blob_shape shape;
    uint32_t i;
    random_map(random, 1 + rng_below(random, 8), &map);
    trial = setup_safe(&map, random_connectivity(random));
    expected = expect(&map, trial.connectivity, trial.measure, NULL);
    if (expected.count == 0) {
        return;
    }
    memset(&filter, 0, sizeof filter);
    memset(&shape, 0, sizeof shape);
    set_bound(kind, random, &map, &expected.blobs[rng_below(random, expected.count)], &filter,
              &shape);
    while (more-- > 0) {
        set_bound(rng_below(random, FILTER_KINDS), random, &map,
                  &expected.blobs[rng_below(random, expected.count)], &filter, &shape);
    }
    trial.filter = &filter;
    trial.shape = &shape;
    verify(&trial, &expected);
    for (i = 0; i < expected.count; i++) {
        const pel_blob *blob = &expected.blobs[i];
        const int passes = ref_passes(blob, &filter);
        const int fits = ref_shape_passes(blob, &shape);
        check_that(pel_blob_passes(blob, &filter) == passes,
                   "pel_blob_passes, filter kind %u: not %d %s", kind, passes, trial_text(&trial));
        check_that(fits < 0 || pel_blob_shape_passes(&shape, blob) == fits,
                   "pel_blob_shape_passes, filter kind %u: not %d %s", kind, fits,
                   trial_text(&trial));
    }
    trial.open_max = (uint16_t)(1 + rng_below(random, map.width));
    trial.results_max = rng_below(random, 4);
    verify(&trial, &expected);
}

static void filters(uint32_t scale)
{
    static const char *const names[FILTER_KINDS] = {
        "area_min",       "area_max",       "width_min",  "width_max",   "height_min",
        "height_max",     "aspect_min",     "aspect_max", "density_min", "density_max",
        "elongation_min", "elongation_max", "class_mask", "region",      "region at a centroid"};
    const uint32_t images = 500 / scale;
    unsigned kind;
    uint32_t i;
    for (kind = 0; kind < FILTER_KINDS; kind++) {
        rng random = rng_seeded(100 + kind);
        check_group("filter %s alone and at small capacity (seed %u)", names[kind], 100 + kind);
        for (i = 0; i < images; i++) {
            filter_trial(kind, 0, &random);
        }
    }
    {
        rng random = rng_seeded(99);
        check_group("filters combined (seed 99)");
        for (i = 0; i < 4 * images; i++) {
            filter_trial(rng_below(&random, FILTER_KINDS), 1 + rng_below(&random, 3), &random);
        }
    }
}

/* Classes beyond the 32 bits of class_mask pass only where no mask is set. */
static void classes_beyond_the_mask(void)
{
    unsigned class_index;
    check_group("class_mask and all 255 classes");
    for (class_index = 0; class_index < 255; class_index++) {
        pel_blob blob;
        pel_blob_filter filter;
        memset(&blob, 0, sizeof blob);
        memset(&filter, 0, sizeof filter);
        blob.area = 1;
        blob.x1 = 1;
        blob.y1 = 1;
        blob.class_index = (uint8_t)class_index;
        check_that(pel_blob_passes(&blob, &filter) == 1, "class %u, no mask", class_index);
        check_that(pel_blob_passes(&blob, NULL) == 1, "class %u, no filter", class_index);
        filter.class_mask = 0xFFFFFFFFu;
        check_that(pel_blob_passes(&blob, &filter) == (class_index < 32), "class %u, all 32",
                   class_index);
        filter.class_mask = 0x80000001u;
        check_that(pel_blob_passes(&blob, &filter) == (class_index == 0 || class_index == 31),
                   "class %u, first and last", class_index);
    }
}

/* ---- Mean colour and what is measured -------------------------------------------------------- */

/* A picture of noise around a few levels, so that means are not all the same. */
static void random_picture(rng *random, const ref_map *map, pel_format format, picture *pixels)
{
    const uint32_t count = (uint32_t)map->width * map->height;
    const uint32_t level = rng_below(random, 256);
    const uint32_t spread = 1 + rng_below(random, 256);
    const uint32_t bytes_per_pixel = format == PEL_YUYV ? 2 : 3;
    uint32_t i;
    for (i = 0; i < count * bytes_per_pixel; i++) {
        bytes[i] = (uint8_t)(level + rng_below(random, spread));
    }
    pixels->bytes = bytes;
    pixels->row_bytes = (size_t)map->width * bytes_per_pixel;
    pixels->width = map->width;
    pixels->format = format;
    pixels->range = rng_below(random, 2) == 0 ? PEL_RANGE_FULL : PEL_RANGE_LIMITED;
    for (i = 0; i < count; i++) {
        if (format == PEL_YUYV) { /* Y0 U Y1 V; rows have an even width, so pairs never straddle */
            yuv[3 * i] = bytes[2 * i];
            yuv[3 * i + 1] = bytes[i / 2 * 4 + 1];
            yuv[3 * i + 2] = bytes[i / 2 * 4 + 3];
        } else {
            ref_rgb_to_yuv(&bytes[3 * i], pixels->range, &yuv[3 * i]);
        }
    }
}

static void colours(pel_format format, uint32_t scale)
{
    const uint32_t images = 3000 / scale;
    rng random = rng_seeded(200 + (uint64_t)format);
    uint32_t i;
    check_group("%u random maps over %s pictures, all measure bits (seed %u)", (unsigned)images,
                pel_format_name(format), 200 + (unsigned)format);
    for (i = 0; i < images; i++) {
        ref_map map;
        picture pixels;
        setup trial;
        expectation expected;
        random_map(&random, 3, &map);
        if (format == PEL_YUYV) {
            map.width = (uint16_t)(map.width + map.width % 2);
            draw_random(&random, 3, map.width, map.height, labels);
        }
        random_picture(&random, &map, format, &pixels);
        trial = setup_safe(&map, random_connectivity(&random));
        trial.measure = (uint8_t)(i % 8);
        trial.pixels = i % 16 < 8 || (i % 8 & PEL_MEASURE_COLOR) != 0 ? &pixels : NULL;
        expected = expect(&map, trial.connectivity, trial.measure, yuv);
        verify(&trial, &expected);
        trial.open_max = (uint16_t)(1 + rng_below(&random, map.width));
        verify(&trial, &expected);
    }
}

/* ---- Whole frames ---------------------------------------------------------------------------- */

static int in_box(const pel_color_box *box, const uint8_t *color)
{
    return color[0] >= box->y_min && color[0] <= box->y_max && color[1] >= box->u_min &&
           color[1] <= box->u_max && color[2] >= box->v_min && color[2] <= box->v_max;
}

static void random_box(rng *random, pel_color_box *box)
{
    uint8_t edge[6];
    int i;
    for (i = 0; i < 6; i++) {
        edge[i] = (uint8_t)rng_next(random);
    }
    box->y_min = edge[0] < edge[1] ? edge[0] : edge[1];
    box->y_max = edge[0] < edge[1] ? edge[1] : edge[0];
    box->u_min = edge[2] < edge[3] ? edge[2] : edge[3];
    box->u_max = edge[2] < edge[3] ? edge[3] : edge[2];
    box->v_min = edge[4] < edge[5] ? edge[4] : edge[5];
    box->v_max = edge[4] < edge[5] ? edge[5] : edge[4];
}

static uint8_t label_by_boxes(const pel_color_box *box, const uint8_t *color)
{
    uint8_t c;
    for (c = 0; c < 8; c++) {
        if (in_box(&box[c], color)) {
            return (uint8_t)(c + 1);
        }
    }
    return 0;
}

static void compare_frame(const ref_map *map, const picture *pixels, const pel_boxes *boxes,
                          int connectivity)
{
    static uint64_t work[PEL_BLOBS_WORDS(WIDTH_MAX, WIDTH_MAX, PEL_MEASURE_ALL)];
    static pel_blob found[PIXELS_MAX];
    static uint8_t row_of_labels[WIDTH_MAX];
    const expectation expected = expect(map, connectivity, PEL_MEASURE_ALL, yuv);
    pel_blobs finder;
    pel_blobs_config config = {0};
    pel_classifier classifier = {0};
    pel_cview view;
    uint32_t count = 12345;
    uint32_t i;
    pel_status status;
    config.width = map->width;
    config.height = map->height;
    config.open_max = map->width;
    config.connectivity = (uint8_t)connectivity;
    config.measure = PEL_MEASURE_ALL;
    config.measurer = pel_blobs_measure;
    config.reader = pel_crow_read_yuv;
    config.work = work;
    config.work_bytes = sizeof work;
    config.results = found;
    config.results_max = PIXELS_MAX;
    classifier.boxes = boxes;
    classifier.reader = pel_crow_read_yuv;
    classifier.pieces = pel_classify_pieces;
    classifier.range = pixels->range;
    status = pel_cview_init(pixels->bytes, pixels->format, pixels->range, map->width, map->height,
                            0, &view);
    check_that(status == PEL_OK, "view: status %d", (int)status);
    status = pel_blobs_frame(&finder, &config, &classifier, &view, row_of_labels, &count);
    check_that(status == PEL_OK && count == expected.count, "%ux%u: status %d, %u blobs, not %u",
               map->width, map->height, (int)status, (unsigned)count, (unsigned)expected.count);
    count = count < expected.count ? count : expected.count;
    for (i = 0; i < count; i++) {
        check_that(ref_compare_documented(&found[i], &expected.blobs[i]) == 0, "order of blob %u",
                   (unsigned)i);
    }
    qsort(found, count, sizeof found[0], ref_compare_all); /* blobs that tie may change places */
    for (i = 0; i < count; i++) {
        check_that(ref_compare_all(&found[i], &expected.blobs[i]) == 0, "a field of blob %u",
                   (unsigned)i);
    }
}

static void frames(pel_format format, uint32_t scale)
{
    const uint32_t images = 500 / scale;
    rng random = rng_seeded(300 + (uint64_t)format);
    uint32_t i, pixel;
    check_group("%u random %s frames through classifier and finder (seed %u)", (unsigned)images,
                pel_format_name(format), 300 + (unsigned)format);
    for (i = 0; i < images; i++) {
        ref_map map;
        picture pixels;
        pel_boxes boxes = {{0}, {0}, {0}};
        pel_color_box box[8];
        unsigned c;
        random_map(&random, 1, &map);
        map.width = (uint16_t)(map.width + map.width % 2);
        random_picture(&random, &map, format, &pixels);
        for (c = 0; c < 8; c++) {
            random_box(&random, &box[c]);
            check_that(pel_boxes_set(&boxes, c, &box[c]) == PEL_OK, "pel_boxes_set");
        }
        for (pixel = 0; pixel < (uint32_t)map.width * map.height; pixel++) {
            labels[pixel] = label_by_boxes(box, &yuv[3 * pixel]);
        }
        compare_frame(&map, &pixels, &boxes, random_connectivity(&random));
    }
}

int main(int argc, char **argv)
{
    const uint32_t scale = check_scale(argc, argv);
    all_fields(scale);
    too_little_room(scale);
    any_label(scale);
    filters(scale);
    classes_beyond_the_mask();
    colours(PEL_YUYV, scale);
    colours(PEL_RGB888, scale);
    frames(PEL_YUYV, scale);
    frames(PEL_RGB888, scale);
    return check_finish();
}
