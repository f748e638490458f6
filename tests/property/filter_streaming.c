/*
 * Filters, row by row and on whole frames, against the reference: every operator and border, every
 * size from 1 x 1 to 9 x 9 and random ones to 67 x 35, random kernels, strides, places and
 * overlaps. The argument divides the amount of random work.
 */
#include "filter_trial.h"

#include <string.h>

enum { SMALL_MAX = 9, WIDTH_MAX = 67, HEIGHT_MAX = 35, BORDERS = PEL_BORDER_VALID + 1 };

/* Kernels of 3 x 3 and of 5 x 5, then the other operators. */
enum { KINDS = REF_OPS + 1 };

static uint8_t pixels[REF_RESULTS_MAX];
static pel_kernel kernel;

static const char *kind_name(unsigned kind)
{
    return kind == 0 ? "kernel 3x3" : kind == 1 ? "kernel 5x5" : ref_op_name((ref_op)(kind - 1));
}

/* ---- Random pictures and kernels ----------------------------------------------------------- */

/* Noise, few labels, almost one label, or black and white. */
static void draw_pixels(rng *random, size_t count)
{
    const unsigned style = rng_below(random, 4);
    for (size_t i = 0; i < count; i++) {
        const uint32_t r = rng_next(random);
        const uint8_t bytes[4] = {(uint8_t)(r >> 8), (uint8_t)((r >> 8) % 4),
                                  (uint8_t)((r >> 8) % 32 == 0 ? 7 * (r % 3) : 5),
                                  (uint8_t)((r >> 8) % 2 == 0 ? 0 : 255)};
        pixels[i] = bytes[style];
    }
}

static int8_t random_tap(rng *random, unsigned style)
{
    static const int8_t extremes[4] = {-128, 127, 0, -1};
    const uint32_t r = rng_next(random) >> 8;
    return style == 0   ? (int8_t)((int)(r % 256) - 128)
           : style == 1 ? (int8_t)((int)(r % 7) - 3)
                        : extremes[r % 4];
}

static void draw_kernel(rng *random, uint8_t radius)
{
    static const uint16_t divisors[] = {0, 1, 2, 3, 9, 25, 256, 1000, 32767};
    const unsigned style = rng_below(random, 3);
    memset(&kernel, 0, sizeof kernel);
    kernel.radius = radius;
    for (unsigned k = 0; k < 25; k++) {
        kernel.tap[k] = random_tap(random, style);
    }
    kernel.divisor = divisors[rng_below(random, 9)];
    if (rng_below(random, 4) == 0) {
        kernel.divisor = (uint16_t)rng_below(random, 32768);
    }
    kernel.shift = (uint8_t)(rng_below(random, 2) ? rng_below(random, 16) : 0);
    kernel.absolute = (uint8_t)rng_below(random, 2);
    kernel.bias = (int16_t)(rng_below(random, 2) ? (int)rng_below(random, 65536) - 32768
                                                 : (int)rng_below(random, 256) - 64);
}

static filter_trial random_trial(rng *random, unsigned kind, pel_border border, uint16_t width,
                                 uint16_t height)
{
    filter_trial trial;
    memset(&trial, 0, sizeof trial);
    draw_pixels(random, (size_t)width * height);
    draw_kernel(random, kind == 1 ? 2 : 1);
    ref_set_op(&trial.config, kind < 2 ? REF_KERNEL : (ref_op)(kind - 1));
    trial.config.kernel = kind < 2 ? &kernel : NULL;
    trial.config.border = border;
    trial.config.constant = (uint8_t)(rng_below(random, 2) ? rng_below(random, 256) : 0);
    trial.config.backend = (pel_backend)rng_below(random, PEL_BACKEND_COUNT);
    trial.picture.width = width;
    trial.picture.height = height;
    trial.picture.pixels = pixels;
    return trial;
}

/* ---- Every operator, border and size ------------------------------------------------------- */

static void small_sizes(unsigned kind)
{
    rng random = rng_seeded(100 + kind);
    check_group("%s: every border and size from 1x1 to 9x9", kind_name(kind));
    for (int border = 0; border < BORDERS; border++) {
        for (uint16_t height = 1; height <= SMALL_MAX; height++) {
            for (uint16_t width = 1; width <= SMALL_MAX; width++) {
                const filter_trial trial =
                    random_trial(&random, kind, (pel_border)border, width, height);
                if (is_possible(&trial)) {
                    verify_all(&trial, &random);
                }
            }
        }
    }
}

static void random_sizes(unsigned kind, uint32_t scale)
{
    rng random = rng_seeded(200 + kind);
    const uint32_t trials = 240 / scale + 6;
    check_group("%s: random sizes to 67x35", kind_name(kind));
    for (uint32_t i = 0; i < trials; i++) {
        const pel_border border = (pel_border)(i % BORDERS);
        const uint16_t width = (uint16_t)(5 + rng_below(&random, WIDTH_MAX - 4));
        const uint16_t height = (uint16_t)(5 + rng_below(&random, HEIGHT_MAX - 4));
        const filter_trial trial = random_trial(&random, kind, border, width, height);
        verify_all(&trial, &random);
    }
}

/* Many kernels on few pixels. */
static void random_kernels(uint32_t scale)
{
    rng random = rng_seeded(300);
    check_group("random kernels on pictures to 7x7");
    for (uint32_t i = 0; i < 20000 / scale + 12; i++) {
        const uint16_t width = (uint16_t)(1 + rng_below(&random, 7));
        const uint16_t height = (uint16_t)(1 + rng_below(&random, 7));
        const filter_trial trial =
            random_trial(&random, i % 2, (pel_border)(i / 2 % BORDERS), width, height);
        if (is_possible(&trial)) {
            verify_all(&trial, &random);
        }
    }
}

/* ---- Opening, closing and other pairs ------------------------------------------------------ */

static int has_twice(pel_border border)
{
    return border != PEL_BORDER_VALID;
}

static void twice(ref_op first, ref_op second, const char *name, uint32_t scale)
{
    rng random = rng_seeded(400 + (unsigned)first * 16 + (unsigned)second);
    check_group("twice: %s", name);
    for (int i = 0; i < BORDERS; i++) {
        const pel_border border = (pel_border)i;
        for (uint32_t k = 0; has_twice(border) && k < 81 + 60 / scale; k++) {
            const uint16_t width = (uint16_t)(k < 81 ? 1 + k % 9 : 1 + rng_below(&random, 67));
            const uint16_t height = (uint16_t)(k < 81 ? 1 + k / 9 : 1 + rng_below(&random, 35));
            const filter_trial trial = random_trial(&random, k % 2, border, width, height);
            const layout from = random_layout(&random), to = random_layout(&random);
            verify_twice(&trial, first, second, from, to, 0);
            verify_twice(&trial, first, second, from, to, 1);
            check_count(1, 0);
        }
    }
}

/* ---- Overlap ------------------------------------------------------------------------------- */

enum { ARENA = 256 };

static uint8_t arena[ARENA];

static unsigned shared_bytes(const pel_cview *a, const pel_view *b)
{
    uint8_t used[ARENA] = {0};
    unsigned shared = 0;
    for (int32_t y = 0; y < a->height; y++) {
        for (int32_t x = 0; x < a->width; x++) {
            used[a->plane[0] - arena + y * a->stride_bytes[0] + x] = 1;
        }
    }
    for (int32_t y = 0; y < b->height; y++) {
        for (int32_t x = 0; x < b->width; x++) {
            shared += used[b->plane[0] - arena + y * b->stride_bytes[0] + x];
        }
    }
    return shared;
}

/* Somewhere in the arena; rows may be mirrored, strides differ. */
static ptrdiff_t random_place(rng *random, uint16_t width, uint16_t height, int32_t *stride)
{
    const int32_t size = (int32_t)width + (int32_t)rng_below(random, 6);
    const int32_t bytes = size * (height - 1) + width;
    const int32_t start = (int32_t)rng_below(random, (uint32_t)(ARENA - bytes + 1));
    const int up = rng_below(random, 3) == 0;
    *stride = up ? -size : size;
    return up ? start + size * (height - 1) : start;
}

/* First and last byte of rows. */
static void span_of(ptrdiff_t place, int32_t stride, uint16_t width, uint16_t height,
                    ptrdiff_t *span)
{
    const ptrdiff_t far = place + (ptrdiff_t)stride * (height - 1);
    span[0] = place < far ? place : far;
    span[1] = (place < far ? far : place) + width - 1;
}

typedef struct pair {
    pel_cview source;
    pel_view target;
    int in_place; /* the same plane and stride */
    int apart;    /* one lies wholly before the other */
} pair;

static pair random_pair(rng *random, const filter_trial *trial)
{
    const uint16_t width = trial->picture.width, height = trial->picture.height;
    const uint16_t out_width = ref_width(&trial->config, &trial->picture);
    const uint16_t out_height = ref_height(&trial->config, &trial->picture);
    int32_t strides[2];
    ptrdiff_t places[2], spans[2][2];
    pair p;
    memset(&p, 0, sizeof p);
    places[0] = random_place(random, width, height, &strides[0]);
    places[1] = random_place(random, width, height, &strides[1]);
    if (rng_below(random, 8) == 0) {
        places[1] = places[0];
        strides[1] = strides[0];
    }
    span_of(places[0], strides[0], width, height, spans[0]);
    span_of(places[1], strides[1], out_width, out_height, spans[1]);
    p.source.plane[0] = arena + places[0];
    p.source.stride_bytes[0] = strides[0];
    p.source.width = width;
    p.source.height = height;
    p.target.plane[0] = arena + places[1];
    p.target.stride_bytes[0] = strides[1];
    p.target.width = out_width;
    p.target.height = out_height;
    p.in_place = places[0] == places[1] && strides[0] == strides[1];
    p.apart = spans[0][1] < spans[1][0] || spans[1][1] < spans[0][0];
    return p;
}

static void expect_pair(const filter_trial *trial, const pair *p, const uint8_t *before,
                        pel_status status)
{
    const unsigned shared = shared_bytes(&p->source, &p->target);
    if (p->in_place || p->apart) {
        check_that(status == PEL_OK, "%s: %s, but gave %d", filter_trial_text(trial),
                   p->in_place ? "in place" : "no overlap", (int)status);
    } else if (shared > 0) {
        check_that(status == PEL_ERR_ARG, "%s: %u bytes shared, but gave %d",
                   filter_trial_text(trial), shared, (int)status);
    }
    if (status < 0) {
        check_that(memcmp(before, arena, ARENA) == 0, "%s: refused, but wrote",
                   filter_trial_text(trial));
    } else {
        const uint8_t *expected = expected_u8(trial);
        for (uint16_t y = 0; y < p->target.height; y++) {
            const ptrdiff_t row = (ptrdiff_t)p->target.stride_bytes[0] * y;
            check_that(memcmp(p->target.plane[0] + row, expected + y * p->target.width,
                              p->target.width) == 0,
                       "%s: row %u differs", filter_trial_text(trial), y);
        }
    }
}

static void read_source(const pair *p)
{
    for (uint16_t y = 0; y < p->source.height; y++) {
        memcpy(pixels + y * p->source.width,
               p->source.plane[0] + (ptrdiff_t)p->source.stride_bytes[0] * y, p->source.width);
    }
}

static void overlaps(uint32_t scale)
{
    rng random = rng_seeded(500);
    uint8_t before[ARENA];
    static uint8_t work[PEL_FILTER_BYTES_WRAP(8, 2)];
    check_group("two frames anywhere in 256 bytes");
    for (uint32_t i = 0; i < 20000 / scale; i++) {
        const uint16_t width = (uint16_t)(1 + rng_below(&random, 8));
        const uint16_t height = (uint16_t)(1 + rng_below(&random, 8));
        filter_trial trial =
            random_trial(&random, i % KINDS, (pel_border)(i % BORDERS), width, height);
        pair p;
        if (!is_possible(&trial) || !ref_has_bytes(&trial.config)) {
            continue;
        }
        p = random_pair(&random, &trial);
        for (unsigned k = 0; k < ARENA; k++) {
            arena[k] = before[k] = (uint8_t)rng_below(&random, 256);
        }
        read_source(&p);
        trial.config.work = work;
        trial.config.work_bytes = sizeof work;
        expect_pair(&trial, &p, before, pel_filter_frame(&trial.config, &p.source, &p.target));
        check_count(1, 0);
    }
}

/* A source inside the memory of 16-bit results is refused, beside it not. */
static void overlaps_of_16_bits(void)
{
    static int16_t words[40];
    uint8_t *const bytes = (uint8_t *)words;
    static uint8_t work[PEL_FILTER_BYTES(4, 1)];
    filter_trial trial;
    pel_cview source;
    check_group("a source beside and inside 16-bit results");
    memset(&trial, 0, sizeof trial);
    memset(&source, 0, sizeof source);
    ref_set_op(&trial.config, REF_GRADIENT);
    trial.config.work = work;
    trial.config.work_bytes = sizeof work;
    source.width = 4;
    source.height = 3;
    source.stride_bytes[0] = 4;
    for (unsigned at = 0; at + 12 <= sizeof words; at++) {
        const int apart = at + 12 <= 2 * 10 || at >= 2 * (10 + 12); /* results: words 10 .. 21 */
        pel_status status;
        memset(words, 0, sizeof words);
        source.plane[0] = bytes + at;
        status = pel_filter_frame_s16(&trial.config, &source, words + 10, 4);
        check_that(status == (apart ? PEL_OK : PEL_ERR_ARG), "source at byte %u gave %d", at,
                   (int)status);
    }
}

int main(int argc, char **argv)
{
    const uint32_t scale = check_scale(argc, argv);
    for (unsigned kind = 0; kind < KINDS; kind++) {
        small_sizes(kind);
        random_sizes(kind, scale);
    }
    random_kernels(scale);
    twice(REF_MIN, REF_MAX, "opening", scale);
    twice(REF_MAX, REF_MIN, "closing", scale);
    twice(REF_ERODE_LABELS, REF_DILATE_LABELS, "labels opened", scale);
    twice(REF_MEDIAN, REF_GRADIENT_ABS, "gradient of the median", scale);
    twice(REF_MAJORITY, REF_MAJORITY, "majority of the majority", scale);
    twice(REF_KERNEL, REF_GAUSS3, "a kernel, then smoothed", scale);
    overlaps(scale);
    overlaps_of_16_bits();
    return check_finish();
}
