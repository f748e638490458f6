/*
 * The largest frames that pel_blobs_begin accepts, where sums come nearest to their bounds: figures
 * that are one blob, streamed row by row, against closed forms and sums over pixels in 64 bits; and
 * the shape functions on large rectangles.
 */
#include "finder.h"

#include <stdio.h>
#include <string.h>

enum { OPEN_MAX = 4096, FIGURES = 10 };

typedef struct size {
    uint16_t width, height;
} size;

static const size sizes[] = {{2048, 2048}, {1920, 1080}, {8192, 128}, {128, 8192}, {4096, 512},
                             {8192, 1},    {1, 8192},    {8192, 2},   {2, 8192},   {640, 480}};

/* ---- Figures: one blob each, 8-connected ---------------------------------------------------- */

static const char *const figure_names[FIGURES] = {
    "full",           "border", "last column",  "last row", "diagonal",
    "other diagonal", "L",      "checkerboard", "triangle", "comb"};

static int figure(unsigned kind, size frame, int x, int y)
{
    const int w = frame.width;
    const int h = frame.height;
    if (x < 0 || y < 0 || x >= w || y >= h) {
        return 0;
    }
    switch (kind) {
    case 0:
        return 1;
    case 1:
        return x == 0 || y == 0 || x == w - 1 || y == h - 1;
    case 2:
        return x == w - 1;
    case 3:
        return y == h - 1;
    case 4:
        return x == y;
    case 5:
        return w - 1 - x == h - 1 - y;
    case 6:
        return x == 0 || y == h - 1;
    case 7:
        return (x + y) % 2 == 0;
    case 8:
        return x * (h > 1 ? h - 1 : 1) <= y * (w > 1 ? w - 1 : 1) || y == h - 1;
    default:
        return y == h - 1 || x % 2 == 0;
    }
}

/* The dots of a checkerboard hang together by their corners, which takes two rows and columns. */
static int is_one_blob(unsigned kind, size frame)
{
    return kind != 7 || (frame.width > 1 && frame.height > 1);
}

static uint32_t holes_of(unsigned kind, size frame)
{
    const uint32_t w = frame.width;
    const uint32_t h = frame.height;
    uint32_t x, y;
    uint32_t holes = 0;
    if (w < 3 || h < 3) {
        return 0;
    }
    if (kind == 7) { /* every pixel that is not set and not on the border is a hole */
        for (y = 1; y < h - 1; y++) {
            for (x = 1; x < w - 1; x++) {
                holes += (x + y) % 2;
            }
        }
        return holes;
    }
    return kind == 1;
}

static pel_blob sum_over_pixels(unsigned kind, size frame)
{
    pel_blob blob;
    uint64_t sum_x = 0;
    uint64_t sum_y = 0;
    int x, y;
    memset(&blob, 0, sizeof blob);
    blob.x0 = 65535;
    blob.y0 = 65535;
    for (y = 0; y < frame.height; y++) {
        for (x = 0; x < frame.width; x++) {
            if (!figure(kind, frame, x, y)) {
                continue;
            }
            blob.area++;
            sum_x += (uint64_t)x;
            sum_y += (uint64_t)y;
            blob.sum_xx += (uint64_t)x * (uint64_t)x;
            blob.sum_xy += (uint64_t)x * (uint64_t)y;
            blob.sum_yy += (uint64_t)y * (uint64_t)y;
            blob.perimeter +=
                (uint32_t)(4 - figure(kind, frame, x - 1, y) - figure(kind, frame, x + 1, y) -
                           figure(kind, frame, x, y - 1) - figure(kind, frame, x, y + 1));
            blob.x0 = (uint16_t)(x < blob.x0 ? x : blob.x0);
            blob.y0 = (uint16_t)(y < blob.y0 ? y : blob.y0);
            blob.x1 = (uint16_t)(x >= blob.x1 ? x + 1 : blob.x1);
            blob.y1 = (uint16_t)(y >= blob.y1 ? y + 1 : blob.y1);
        }
    }
    check_that(sum_x <= 0xFFFFFFFFu && sum_y <= 0xFFFFFFFFu, "a sum over 32 bits was accepted");
    blob.sum_x = (uint32_t)sum_x;
    blob.sum_y = (uint32_t)sum_y;
    blob.edges = (uint8_t)((blob.x0 == 0 ? PEL_EDGE_LEFT : 0) |
                           (blob.x1 == frame.width ? PEL_EDGE_RIGHT : 0) |
                           (blob.y0 == 0 ? PEL_EDGE_TOP : 0) |
                           (blob.y1 == frame.height ? PEL_EDGE_BOTTOM : 0));
    blob.holes = holes_of(kind, frame);
    blob.mean_y = 255;
    blob.mean_u = 128;
    blob.mean_v = 128;
    return blob;
}

/* ---- Streaming them -------------------------------------------------------------------------- */

static pel_status stream(unsigned kind, size frame, pel_blob *found, pel_blobs_counts *counts)
{
    static uint64_t work[PEL_BLOBS_WORDS(PEL_SIDE_MAX, OPEN_MAX, PEL_MEASURE_ALL)];
    static uint8_t labels[PEL_SIDE_MAX], gray[PEL_SIDE_MAX];
    pel_blobs blobs;
    pel_blobs_config config = {0};
    const pel_crow row = pel_crow_packed(gray, PEL_GRAY8, PEL_RANGE_FULL, frame.width);
    uint32_t count = 0;
    pel_status status;
    uint16_t x, y;
    memset(gray, 255, sizeof gray);
    config.width = frame.width;
    config.height = frame.height;
    config.open_max = PEL_BLOBS_OPEN_SAFE_ONE_CLASS(PEL_SIDE_MAX);
    config.measure = PEL_MEASURE_ALL;
    config.measurer = pel_blobs_measure;
    config.reader = pel_crow_read_yuv;
    config.work = work;
    config.work_bytes = sizeof work;
    config.results = found;
    config.results_max = 1;
    status = pel_blobs_begin(&blobs, &config);
    for (y = 0; y < frame.height && status == PEL_OK; y++) {
        for (x = 0; x < frame.width; x++) {
            labels[x] = (uint8_t)figure(kind, frame, x, y);
        }
        status = pel_blobs_row(&blobs, y, labels, &row);
    }
    if (status == PEL_OK) {
        status = pel_blobs_end(&blobs, &count);
    }
    *counts = blobs.counts;
    return status;
}

static void figures(uint32_t scale)
{
    unsigned kind, i;
    for (kind = 0; kind < FIGURES; kind++) {
        check_group("%s, at the largest sizes", figure_names[kind]);
        for (i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
            pel_blob expected, found;
            pel_blobs_counts counts;
            pel_status status;
            if ((scale > 1 && (i + kind) % 3 != 0) || !is_one_blob(kind, sizes[i])) {
                continue;
            }
            expected = sum_over_pixels(kind, sizes[i]);
            status = stream(kind, sizes[i], &found, &counts);
            check_that(status == PEL_OK && counts.found == 1 && counts.lost_opens == 0,
                       "%u x %u: status %d, found %u", sizes[i].width, sizes[i].height, (int)status,
                       (unsigned)counts.found);
            check_that(ref_compare_all(&found, &expected) == 0,
                       "%u x %u: area %u sums %u %u, perimeter %u, holes %u, mean %u",
                       sizes[i].width, sizes[i].height, (unsigned)found.area, (unsigned)found.sum_x,
                       (unsigned)found.sum_y, (unsigned)found.perimeter, (unsigned)found.holes,
                       found.mean_y);
            verify_shape(&found, PEL_MEASURE_ALL);
            check_count(1, 1);
        }
    }
}

/* The sums of a full frame as everybody learnt them: n(n-1)/2 and (n-1)n(2n-1)/6. */
static void full_frame_closed_form(void)
{
    unsigned i;
    check_group("full frames against closed forms");
    for (i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        const uint64_t w = sizes[i].width;
        const uint64_t h = sizes[i].height;
        pel_blob found;
        pel_blobs_counts counts;
        memset(&found, 0, sizeof found);
        check_that(stream(0, sizes[i], &found, &counts) == PEL_OK, "status");
        check_that(found.area == w * h, "area");
        check_that(found.sum_x == h * (w * (w - 1) / 2), "sum_x");
        check_that(found.sum_y == w * (h * (h - 1) / 2), "sum_y");
        check_that(found.sum_xx == h * ((w - 1) * w * (2 * w - 1) / 6), "sum_xx");
        check_that(found.sum_yy == w * ((h - 1) * h * (2 * h - 1) / 6), "sum_yy");
        check_that(found.sum_xy == (w * (w - 1) / 2) * (h * (h - 1) / 2), "sum_xy");
        check_that(found.perimeter == 2 * (w + h) && found.holes == 0 && found.edges == 15,
                   "outline");
        check_count(1, 1);
    }
}

/* ---- Shape functions on large blobs --------------------------------------------------------- */

static uint64_t squares_below(uint64_t n) /* 0 + 1 + 4 + ... + (n-1)^2 */
{
    return n == 0 ? 0 : (n - 1) * n * (2 * n - 1) / 6;
}

static uint64_t numbers_below(uint64_t n)
{
    return n == 0 ? 0 : n * (n - 1) / 2;
}

/* A rectangle x0..x1 x y0..y1 as a blob; its outline is that of the rectangle alone. */
static pel_blob rectangle(uint32_t x0, uint32_t x1, uint32_t y0, uint32_t y1)
{
    const uint64_t w = x1 - x0;
    const uint64_t h = y1 - y0;
    const uint64_t sum_x = numbers_below(x1) - numbers_below(x0);
    const uint64_t sum_y = numbers_below(y1) - numbers_below(y0);
    pel_blob blob;
    memset(&blob, 0, sizeof blob);
    blob.area = (uint32_t)(w * h);
    blob.sum_x = (uint32_t)(sum_x * h);
    blob.sum_y = (uint32_t)(sum_y * w);
    blob.sum_xx = (squares_below(x1) - squares_below(x0)) * h;
    blob.sum_yy = (squares_below(y1) - squares_below(y0)) * w;
    blob.sum_xy = sum_x * sum_y;
    blob.perimeter = (uint32_t)(2 * (w + h));
    blob.x0 = (uint16_t)x0;
    blob.x1 = (uint16_t)x1;
    blob.y0 = (uint16_t)y0;
    blob.y1 = (uint16_t)y1;
    return blob;
}

static pel_blob random_rectangle(rng *random, size frame, uint32_t thinness)
{
    const uint32_t most_w = frame.width / (1 + rng_below(random, thinness));
    const uint32_t most_h = frame.height / (1 + rng_below(random, thinness));
    const uint32_t w = 1 + rng_below(random, most_w > 0 ? most_w : 1);
    const uint32_t h = 1 + rng_below(random, most_h > 0 ? most_h : 1);
    const uint32_t x0 = rng_below(random, frame.width - w + 1);
    const uint32_t y0 = rng_below(random, frame.height - h + 1);
    return rectangle(x0, x0 + w, y0, y0 + h);
}

/* One rectangle, or two that lie apart in y and so share no pixel: tilted axes of every ratio. */
static void shapes_of_rectangles(uint32_t scale)
{
    const uint32_t trials = 300000 / scale;
    rng random = rng_seeded(7);
    uint32_t i;
    check_group("shape functions on %u large blobs (seed 7)", (unsigned)trials);
    for (i = 0; i < trials; i++) {
        const size frame = sizes[i % (sizeof sizes / sizeof sizes[0])];
        pel_blob blob = random_rectangle(&random, frame, 1u << rng_below(&random, 11));
        if (i % 3 != 0) {
            const pel_blob other = random_rectangle(&random, frame, 1u << rng_below(&random, 11));
            if (other.y0 >= blob.y1 || other.y1 <= blob.y0) {
                pel_blob_merge(&blob, &other);
            }
        }
        verify_shape(&blob, PEL_MEASURE_ALL);
    }
    check_count(0, trials);
}

int main(int argc, char **argv)
{
    const uint32_t scale = check_scale(argc, argv);
    figures(scale);
    full_frame_closed_form();
    shapes_of_rectangles(scale);
    return check_finish();
}
