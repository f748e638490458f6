/*
 * Every map of some small sizes: all masks of 4x4 and 5x4, all 3x3 maps of three classes with and
 * without background. Every field of every blob equals the reference; for the smaller families also
 * at every smaller open_max and results_max.
 */
#include "finder.h"

#include <stdio.h>
#include <string.h>

typedef struct family {
    const char *name;
    uint16_t width, height;
    uint8_t first_label; /* labels are first_label .. first_label + labels - 1 */
    uint8_t labels;
    uint8_t capacities; /* also at smaller open_max and results_max */
} family;

static const family families[] = {
    {"4x4 masks", 4, 4, 0, 2, 1},
    {"3x3 maps of background and two classes", 3, 3, 0, 3, 1},
    {"3x3 maps of three classes without background", 3, 3, 1, 3, 1},
    {"3x3 maps of background and three classes", 3, 3, 0, 4, 1},
    {"5x4 masks", 5, 4, 0, 2, 0},
    {"4x5 masks", 4, 5, 0, 2, 0},
    {"20x1 masks", 20, 1, 0, 2, 0},
    {"8x2 masks", 8, 2, 0, 2, 1},
    {"2x8 masks", 2, 8, 0, 2, 1},
};

static void number_to_labels(const family *kind, uint32_t number, uint8_t *labels)
{
    unsigned i;
    for (i = 0; i < (unsigned)kind->width * kind->height; i++) {
        labels[i] = (uint8_t)(kind->first_label + number % kind->labels);
        number /= kind->labels;
    }
}

static uint32_t family_size(const family *kind)
{
    uint32_t size = 1;
    unsigned i;
    for (i = 0; i < (unsigned)kind->width * kind->height; i++) {
        size *= kind->labels;
    }
    return size;
}

/* No finder can do with fewer than stay open after a row, and open_peak is what it says: with that
 * many nothing is lost, with one less something is. */
static void check_peak(setup *trial, const expectation *expected, uint16_t peak, uint32_t need)
{
    uint16_t open_max;
    check_that(peak >= need, "open_peak %u, but %u stay open %s", peak, (unsigned)need,
               trial_text(trial));
    for (open_max = 1; open_max < trial->map.width; open_max++) {
        pel_blobs_counts counts;
        trial->open_max = open_max;
        counts = verify(trial, expected);
        check_that((counts.lost_opens > 0) == (open_max < peak), "open_peak %u, lost_opens %u %s",
                   peak, (unsigned)counts.lost_opens, trial_text(trial));
    }
    trial->open_max = trial->map.width;
}

static void check_capacities(setup *trial, uint16_t peak)
{
    /* Reckoned first: the expectation is overwritten by the reference's next use. */
    uint32_t need = 0;
    expectation expected;
    uint16_t y;
    for (y = 0; y < trial->map.height; y++) {
        const uint32_t open = ref_open_after_row(&trial->map, trial->connectivity, y);
        need = open > need ? open : need;
    }
    expected = expect(&trial->map, trial->connectivity, trial->measure, NULL);
    check_count((uint64_t)0 - 1, (uint64_t)0 - expected.count); /* the same image again */
    check_peak(trial, &expected, peak, need);
    for (trial->results_max = 0; trial->results_max <= expected.count; trial->results_max++) {
        verify(trial, &expected);
    }
    trial->results_max = 1;
    trial->open_max = 1;
    verify(trial, &expected);
}

static void run_family(const family *kind, int connectivity, uint32_t stride)
{
    const uint32_t size = family_size(kind);
    uint8_t labels[32];
    uint32_t number;
    check_group("%s, %s%d-connected", kind->name, stride == 1 ? "all, " : "a part, ", connectivity);
    for (number = 0; number < size; number += stride) {
        ref_map map;
        setup trial;
        expectation expected;
        pel_blobs_counts counts;
        number_to_labels(kind, number, labels);
        map.width = kind->width;
        map.height = kind->height;
        map.labels = labels;
        trial = setup_safe(&map, connectivity);
        expected = expect(&map, connectivity, trial.measure, NULL);
        counts = verify(&trial, &expected);
        if (kind->capacities) {
            check_capacities(&trial, counts.open_peak);
        }
    }
}

int main(int argc, char **argv)
{
    const uint32_t scale = check_scale(argc, argv);
    unsigned i;
    for (i = 0; i < sizeof families / sizeof families[0]; i++) {
        /* An odd stride visits masks of every kind. */
        const uint32_t stride = scale == 1 ? 1 : scale | 1u;
        run_family(&families[i], 4, stride);
        run_family(&families[i], 8, stride);
    }
    return check_finish();
}
