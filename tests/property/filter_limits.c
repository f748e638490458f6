/*
 * Filters where they are most likely to break: named kernels, the largest and
 * smallest sums, every pair of gradients that eight neighbours can have, places far outside rows.
 * The argument divides the amount of work.
 */
#include "filter_trial.h"

#include <stdio.h>
#include <string.h>

enum { BORDERS = PEL_BORDER_VALID + 1 };

static uint8_t pixels[REF_RESULTS_MAX];

static filter_trial trial_of(const pel_kernel *kernel, pel_border border, uint16_t width,
                             uint16_t height)
{
    filter_trial trial;
    memset(&trial, 0, sizeof trial);
    trial.config.kernel = kernel;
    trial.config.border = border;
    trial.config.constant = 255;
    trial.config.backend = (pel_backend)((width + height) % PEL_BACKEND_COUNT);
    trial.picture.width = width;
    trial.picture.height = height;
    trial.picture.pixels = pixels;
    return trial;
}

static void draw_noise(rng *random, size_t count)
{
    const int black_and_white = rng_below(random, 2) == 0;
    for (size_t i = 0; i < count; i++) {
        const uint8_t value = (uint8_t)(rng_next(random) >> 9);
        pixels[i] = black_and_white ? (value < 128 ? 0 : 255) : value;
    }
}

/* ---- Named kernels ------------------------------------------------------------------------- */

/* One kernel on random pictures: sizes from 1 x 1 on, each border in turn. */
static void verify_kernel(const pel_kernel *kernel, rng *random, uint32_t trials)
{
    for (uint32_t i = 0; i < trials; i++) {
        const uint16_t width = (uint16_t)(1 + rng_below(random, i % 3 == 0 ? 67 : 9));
        const uint16_t height = (uint16_t)(1 + rng_below(random, i % 3 == 0 ? 35 : 9));
        const filter_trial trial = trial_of(kernel, (pel_border)(i % BORDERS), width, height);
        draw_noise(random, (size_t)width * height);
        if (is_possible(&trial)) {
            verify_all(&trial, random);
        }
    }
}

static void named_kernels(uint32_t scale)
{
    const char *name;
    for (unsigned i = 0; (name = pel_kernel_name(i)) != NULL; i++) {
        rng random = rng_seeded(600 + i);
        const pel_kernel *named = pel_kernel_named(name);
        check_group("%s", name);
        if (check_that(named != NULL, "the name is listed, but not found")) {
            verify_kernel(named, &random, 180 / scale + 12);
        }
    }
}

/* Copies of named kernels whose division, bias or direction is another: their taps still count. */
static void changed_kernels(uint32_t scale)
{
    const char *name;
    rng random = rng_seeded(700);
    check_group("copies of named kernels, flipped, divided or biased in another way");
    for (unsigned i = 0; (name = pel_kernel_name(i)) != NULL; i++) {
        for (unsigned k = 0; k < 6; k++) {
            pel_kernel copy = *pel_kernel_named(name);
            copy.divisor = (uint16_t)(k == 1 ? 7 : copy.divisor);
            copy.shift = (uint8_t)(k == 2 ? 3 : copy.shift);
            copy.absolute = (uint8_t)(k == 3);
            copy.bias = (int16_t)(k == 4 ? -300 : k == 3 ? 20 : 0);
            if (k == 5) {
                copy = pel_kernel_flipped(&copy);
            }
            verify_kernel(&copy, &random, 24 / scale + 6);
        }
    }
}

/* ---- The largest sums ---------------------------------------------------------------------- */

/* White where the neighbourhood of the picture's centre has taps of one sign, black elsewhere. */
static void draw_worst(const pel_kernel *kernel, int positive, uint16_t side)
{
    const int radius = kernel->radius, width = 2 * radius + 1, centre = side / 2;
    memset(pixels, 0, (size_t)side * side);
    for (int k = 0; k < width * width; k++) {
        const int x = centre + k % width - radius, y = centre + k / width - radius;
        pixels[y * side + x] = (kernel->tap[k] > 0) == positive ? 255 : 0;
    }
}

static void draw_pattern(unsigned pattern, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        pixels[i] = pattern == 0 ? 255 : pattern == 1 ? (i % 2 ? 255 : 0) : (i % 3 ? 0 : 255);
    }
}

static void draw_extreme_taps(pel_kernel *kernel, unsigned style, rng *random)
{
    for (unsigned k = 0; k < 25; k++) {
        const int8_t choice[5] = {-128, 127, (int8_t)(k % 2 ? 127 : -128),
                                  (int8_t)(k % 2 ? -128 : 127),
                                  (int8_t)(rng_below(random, 2) ? 127 : -128)};
        kernel->tap[k] = choice[style];
    }
}

static void verify_extreme(const pel_kernel *kernel, rng *random)
{
    const uint16_t side = 7;
    for (int border = 0; border < BORDERS; border++) {
        const filter_trial trial = trial_of(kernel, (pel_border)border, side, side);
        for (unsigned pattern = 0; pattern < 5; pattern++) {
            if (pattern < 3) {
                draw_pattern(pattern, (size_t)side * side);
            } else {
                draw_worst(kernel, pattern == 3, side);
            }
            verify_all(&trial, random);
        }
    }
}

static void extremes(uint32_t scale)
{
    static const uint16_t divisors[] = {0, 1, 2, 9, 25, 128, 32767};
    static const uint8_t shifts[] = {0, 1, 5, 15};
    static const int16_t biases[] = {0, -32768, 32767, -129, 383};
    rng random = rng_seeded(800);
    unsigned count = 0;
    check_group("taps of -128 and 127 on black and white");
    for (unsigned i = 0; i < 2 * 5 * 7 * 4 * 5 * 2; i++) {
        pel_kernel kernel;
        if (i % scale != 0) {
            continue;
        }
        memset(&kernel, 0, sizeof kernel);
        kernel.radius = (uint8_t)(1 + i % 2);
        draw_extreme_taps(&kernel, i / 2 % 5, &random);
        kernel.absolute = (uint8_t)(i / 10 % 2);
        kernel.divisor = divisors[i / 20 % 7];
        kernel.shift = shifts[i / 140 % 4];
        kernel.bias = biases[i / 560 % 5];
        verify_extreme(&kernel, &random);
        count++;
    }
    printf("      %u kernels\n", count);
}

/* The bounds in the header are reached, and by the stated kernels. */
static void stated_bounds(void)
{
    static const int64_t bounds[2][2] = {{-293760, 291465}, {-816000, 809625}};
    check_group("the stated bounds of sums are reached");
    for (unsigned radius = 1; radius <= 2; radius++) {
        for (unsigned i = 0; i < 2; i++) {
            const uint16_t side = (uint16_t)(2 * radius + 1);
            pel_kernel kernel;
            filter_trial trial;
            int16_t exact;
            memset(&kernel, 0, sizeof kernel);
            memset(kernel.tap, i == 0 ? -128 : 127, sizeof kernel.tap);
            memset(pixels, 255, sizeof pixels);
            kernel.radius = (uint8_t)radius;
            trial = trial_of(&kernel, PEL_BORDER_VALID, side, side);
            check_that(ref_result(&trial.config, &trial.picture, 0, 0) == bounds[radius - 1][i],
                       "radius %u: another bound", radius);
            kernel.divisor = (uint16_t)(side * side);
            exact = (int16_t)(bounds[radius - 1][i] / kernel.divisor);
            verify_stream_s16(&trial, &exact);
        }
    }
}

/* ---- Every gradient ------------------------------------------------------------------------ */

enum { TRIPLES = 2730, GRADIENT_WIDTH = 3 * TRIPLES };

static uint8_t strip[3][GRADIENT_WIDTH];
static int16_t wanted[TRIPLES][2];
static unsigned triples;
static int largest_sum, largest_length;
static unsigned long compared, wrong;

/* The whole numbers nearest to 0 that leave a rest of at most 510 and an even one. */
static int left_over(int gradient)
{
    const int size = gradient < 0 ? -gradient : gradient;
    int rest = size > 510 ? size - 510 : 0;
    rest += (size - rest) % 2;
    return gradient < 0 ? -rest : rest;
}

/*
 * Eight neighbours with gradients gx and gy; 0 if there are none. Diagonals (corner minus opposite
 * corner) p and q add p + q to gx and p - q to gy; the sides add twice their differences.
 */
static int draw_neighbours(int gx, int gy, uint8_t (*rows)[GRADIENT_WIDTH], unsigned x)
{
    const int s = left_over(gx), t = left_over(gy);
    const int parts[4][3] = {/* difference, and the two places of it in the 3 x 3 */
                             {(s + t) / 2, 8, 0},
                             {(s - t) / 2, 2, 6},
                             {(gx - s) / 2, 5, 3},
                             {(gy - t) / 2, 7, 1}};
    if ((s + t) % 2 != 0 || (s < 0 ? -s : s) + (t < 0 ? -t : t) > 510) {
        return 0;
    }
    rows[1][x + 1] = (uint8_t)(gx & 255); /* the centre must not matter */
    for (unsigned i = 0; i < 4; i++) {
        const int d = parts[i][0], up = parts[i][1], down = parts[i][2];
        rows[up / 3][x + (unsigned)up % 3] = (uint8_t)(d > 0 ? d : 0);
        rows[down / 3][x + (unsigned)down % 3] = (uint8_t)(d < 0 ? -d : 0);
    }
    return 1;
}

/* The reference's results are those of a picture of one neighbourhood. */
static int64_t neighbours_result(ref_op op, unsigned x)
{
    uint8_t around[9];
    filter_trial trial = trial_of(NULL, PEL_BORDER_VALID, 3, 3);
    for (unsigned k = 0; k < 9; k++) {
        around[k] = strip[k / 3][x + k % 3];
    }
    ref_set_op(&trial.config, op);
    trial.picture.pixels = around;
    return ref_result(&trial.config, &trial.picture, 0, 0);
}

static void compare_triples(ref_op op, const uint8_t *bytes, const int16_t *words)
{
    for (unsigned i = 0; i < triples; i++) {
        const int64_t expected = neighbours_result(op, 3 * i);
        const int64_t result = words != NULL ? words[3 * i] : bytes[3 * i];
        compared++;
        if (result == expected) {
            continue;
        }
        wrong++;
        check_that(0, "op %d, gx %d, gy %d: %ld, not %ld", (int)op, wanted[i][0], wanted[i][1],
                   (long)result, (long)expected);
    }
    check_that(triples > 0, "no neighbours");
}

static void run_triples(ref_op op)
{
    static uint8_t work[PEL_FILTER_BYTES(GRADIENT_WIDTH, 1)], bytes[GRADIENT_WIDTH];
    static int16_t words[GRADIENT_WIDTH];
    pel_filter_config config;
    pel_filter filter;
    pel_status status;
    memset(&config, 0, sizeof config);
    ref_set_op(&config, op);
    config.border = PEL_BORDER_VALID;
    config.width = (uint16_t)(3 * triples);
    config.height = 3;
    config.work = work;
    config.work_bytes = sizeof work;
    status = pel_filter_begin(&filter, &config);
    for (unsigned y = 0; y < 3 && status == PEL_OK; y++) {
        status = pel_filter_push(&filter, strip[y]);
    }
    if (status == PEL_OK) {
        status = op == REF_DIRECTION ? pel_filter_pull(&filter, bytes)
                                     : pel_filter_pull_s16(&filter, words);
    }
    if (check_that(status == PEL_OK, "a strip of neighbourhoods gave %d", (int)status)) {
        compare_triples(op, bytes, op == REF_DIRECTION ? NULL : words);
    }
}

static void finish_triples(void)
{
    if (triples > 0) {
        run_triples(REF_DIRECTION);
        run_triples(REF_GRADIENT);
        run_triples(REF_GRADIENT_ABS);
    }
    triples = 0;
}

static void add_triple(int gx, int gy)
{
    const unsigned x = 3 * triples;
    if (!draw_neighbours(gx, gy, strip, x)) {
        return;
    }
    wanted[triples][0] = (int16_t)gx;
    wanted[triples][1] = (int16_t)gy;
    if (neighbours_result(REF_GRADIENT_ABS, x) > largest_sum) {
        largest_sum = (int)neighbours_result(REF_GRADIENT_ABS, x);
    }
    if (neighbours_result(REF_GRADIENT, x) > largest_length) {
        largest_length = (int)neighbours_result(REF_GRADIENT, x);
    }
    if (++triples == TRIPLES) {
        finish_triples();
    }
}

static void every_gradient(uint32_t scale)
{
    const int step = scale == 1 ? 1 : (int)scale * 2 + 1; /* odd: all residues come */
    check_group("every pair of gradients: length, sum and direction");
    for (int gy = -1020; gy <= 1020; gy++) {
        for (int gx = -1020 + (step == 1 ? 0 : (gy + 1020) * 7 % step); gx <= 1020; gx += step) {
            add_triple(gx, gy);
        }
    }
    add_triple(1020, 510);
    finish_triples();
    check_that(largest_sum == 1530, "the largest sum is %d", largest_sum);
    check_that(largest_length == 1140, "the largest length is %d", largest_length);
    printf("      %lu results compared, %lu differ\n", compared, wrong);
}

/* ---- Places -------------------------------------------------------------------------------- */

static void places(void)
{
    check_group("places of -100 .. 200 in rows of 1 .. 70");
    for (int32_t length = 1; length <= 70; length++) {
        for (int32_t i = -100; i <= 200; i++) {
            for (int border = 0; border < BORDERS; border++) {
                const int32_t place = pel_border_index(i, length, (pel_border)border);
                check_that(place == ref_place(i, length, (pel_border)border),
                           "place %ld of %ld, border %d: %ld", (long)i, (long)length, border,
                           (long)place);
            }
        }
    }
}

/* Rows so long that the walk outside takes a few steps only. */
static void far_places(void)
{
    static const int32_t lengths[] = {0x10000000, 0x3FFFFFFF, 0x40000000, 0x40000001, INT32_MAX};
    check_group("places in rows of up to 2^31 - 1");
    for (unsigned k = 0; k < sizeof lengths / sizeof lengths[0]; k++) {
        for (int64_t i = INT32_MIN; i <= INT32_MAX; i += 0x2FFFFFF) {
            for (int border = 0; border < BORDERS; border++) {
                const int32_t place = pel_border_index((int32_t)i, lengths[k], (pel_border)border);
                check_that(place == ref_place(i, lengths[k], (pel_border)border),
                           "place %ld of %ld, border %d: %ld", (long)i, (long)lengths[k], border,
                           (long)place);
            }
        }
    }
}

int main(int argc, char **argv)
{
    const uint32_t scale = check_scale(argc, argv);
    named_kernels(scale);
    changed_kernels(scale);
    extremes(scale);
    stated_bounds();
    every_gradient(scale);
    places();
    far_places();
    return check_finish();
}
