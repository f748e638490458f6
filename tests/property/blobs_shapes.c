/*
 * Shapes that are hard on connected components, of every width from 1 to 40 and larger, in one
 * class and in several: at the never-lose size, at every smaller one, and with few results.
 */
#include "finder.h"
#include "maps.h"

#include <stdio.h>
#include <string.h>

static uint8_t labels[REF_PIXELS_MAX];

static void sweep_capacities(setup *trial, const expectation *expected, uint16_t step)
{
    const uint32_t all = trial->results_max;
    const uint16_t peak = verify(trial, expected).open_peak;
    uint32_t open_max, results_max;
    for (open_max = 1; open_max < trial->map.width; open_max += step) {
        pel_blobs_counts counts;
        trial->open_max = (uint16_t)open_max;
        counts = verify(trial, expected);
        check_that((counts.lost_opens > 0) == (open_max < peak), "open_peak %u, lost_opens %u %s",
                   peak, (unsigned)counts.lost_opens, trial_text(trial));
        trial->results_max = open_max % 4;
        verify(trial, expected);
        trial->results_max = all;
    }
    trial->open_max = trial->map.width;
    for (results_max = 0; results_max <= 5; results_max++) {
        trial->results_max = results_max;
        verify(trial, expected);
    }
}

static void run_shape(unsigned shape, unsigned variant, uint16_t width, uint16_t height,
                      uint16_t step)
{
    int connectivity;
    draw_shape(shape, variant, width, height, labels);
    for (connectivity = 4; connectivity <= 8; connectivity += 4) {
        ref_map map;
        setup trial;
        expectation expected;
        uint32_t i;
        map.width = width;
        map.height = height;
        map.labels = labels;
        trial = setup_safe(&map, connectivity);
        expected = expect(&map, connectivity, trial.measure, NULL);
        for (i = 0; i < expected.count; i++) {
            verify_shape(&expected.blobs[i], trial.measure);
        }
        sweep_capacities(&trial, &expected, step);
    }
}

static void all_sizes(unsigned shape, uint32_t scale)
{
    static const uint16_t heights[] = {1, 2, 3, 8, 17, 40};
    const uint16_t width_step = scale > 1 ? 9 : 1;
    const uint16_t step = scale > 1 ? 5 : 1;
    unsigned variant, i;
    uint16_t width;
    check_group("%s, widths 1 to 40 and larger", shape_name(shape));
    for (variant = 0; variant < VARIANT_COUNT; variant++) {
        for (width = 1; width <= 40; width = (uint16_t)(width + width_step)) {
            for (i = 0; i < sizeof heights / sizeof heights[0]; i++) {
                run_shape(shape, variant, width, heights[i], step);
            }
        }
        run_shape(shape, variant, 64, 48, step);
        run_shape(shape, variant, 127, 20, (uint16_t)(4 * step));
        run_shape(shape, variant, 20, 127, step);
    }
}

/* ---- What is kept when open blobs are short, reckoned by hand -------------------------------- */

static pel_blobs_counts counts_of(unsigned shape, uint16_t width, uint16_t height,
                                  uint8_t connectivity, uint16_t open_max)
{
    ref_map map;
    setup trial;
    expectation expected;
    draw_shape(shape, 0, width, height, labels);
    map.width = width;
    map.height = height;
    map.labels = labels;
    trial = setup_safe(&map, connectivity);
    trial.open_max = open_max;
    expected = expect(&map, connectivity, trial.measure, NULL);
    return verify(&trial, &expected);
}

static unsigned shape_number(const char *name)
{
    unsigned shape = 0;
    while (shape < SHAPE_COUNT - 1u && strcmp(shape_name(shape), name) != 0) {
        shape++;
    }
    check_that(strcmp(shape_name(shape), name) == 0, "no shape named %s", name);
    return shape;
}

/* Dots on every second row: of each row's dots the finder keeps as many as it has room for. */
static void dots_keep_what_fits(void)
{
    const unsigned dots = shape_number("dots");
    uint16_t open_max;
    check_group("dots: every row keeps as many as fit");
    for (open_max = 1; open_max <= 12; open_max++) {
        const pel_blobs_counts counts = counts_of(dots, 20, 9, 8, open_max);
        const uint32_t kept = 5u * (open_max < 10 ? open_max : 10u);
        check_that(counts.found == kept && counts.lost_px == 50 - kept &&
                       counts.lost_opens == 50 - kept,
                   "open_max %u: found %u of 50", open_max, (unsigned)counts.found);
    }
}

/* Single pixels of a 4-connected checkerboard: ten a row, and no row inherits a blob. */
static void checkerboard_keeps_what_fits(void)
{
    const unsigned board = shape_number("checkerboard of 1 px");
    uint16_t open_max;
    check_group("checkerboard: every row keeps as many as fit");
    for (open_max = 1; open_max <= 12; open_max++) {
        const pel_blobs_counts counts = counts_of(board, 20, 9, 4, open_max);
        const uint32_t kept = 9u * (open_max < 10 ? open_max : 10u);
        check_that(counts.found == kept && counts.lost_px == 90 - kept,
                   "open_max %u: found %u of 90", open_max, (unsigned)counts.found);
    }
}

/* A comb hanging from its back is one blob from the first row on; standing on it, one per tooth. */
static void combs_need_what_they_need(void)
{
    const unsigned hanging = shape_number("comb, teeth down");
    const unsigned standing = shape_number("comb, teeth up");
    pel_blobs_counts counts;
    check_group("combs: one open blob hanging, one per tooth standing");
    counts = counts_of(hanging, 19, 8, 4, 1);
    check_that(counts.found == 1 && counts.lost_px == 0 && counts.open_peak == 1, "hanging");
    counts = counts_of(standing, 19, 8, 4, 10);
    check_that(counts.found == 1 && counts.lost_px == 0 && counts.open_peak == 10, "standing, 10");
    counts = counts_of(standing, 19, 8, 4, 9);
    check_that(counts.found == 0 && counts.lost_px == 10 * 7 + 19 && counts.lost_opens == 1,
               "standing, 9: found %u, lost %u px in %u opens", (unsigned)counts.found,
               (unsigned)counts.lost_px, (unsigned)counts.lost_opens);
}

int main(int argc, char **argv)
{
    const uint32_t scale = check_scale(argc, argv);
    unsigned shape;
    for (shape = 0; shape < SHAPE_COUNT; shape++) {
        all_sizes(shape, scale);
    }
    dots_keep_what_fits();
    checkerboard_keeps_what_fits();
    combs_need_what_they_need();
    return check_finish();
}
