/*
 * pel_find_runs against a loop over pixels: every width up to 70, every alignment, random and edge
 * patterns, in memory where not one byte beside the row may be read or written.
 */
#include "check.h"

#include <pel.h>

#include <stdio.h>
#include <string.h>

enum { WIDTH_MAX = 70, OFFSETS = 9, PATTERNS = 12 };

static guarded labels_memory, runs_memory;

static uint16_t runs_by_loop(const uint8_t *labels, uint16_t width, pel_run *runs)
{
    uint16_t count = 0;
    uint16_t x;
    for (x = 0; x < width; x++) {
        if (labels[x] == 0) {
            continue;
        }
        if (x == 0 || labels[x - 1] != labels[x]) {
            runs[count].x0 = x;
            count++;
        }
        runs[count - 1].x1 = (uint16_t)(x + 1);
    }
    return count;
}

static uint8_t pattern_label(unsigned pattern, unsigned x, unsigned width, rng *random)
{
    switch (pattern) {
    case 0:
        return 0;
    case 1:
        return 1;
    case 2:
        return 0xC5; /* as the canaries beside the row: they must not lengthen the run */
    case 3:
        return (uint8_t)(x % 2); /* the most runs of one class */
    case 4:
        return (uint8_t)(1 + x % 2); /* the most runs at all */
    case 5:
        return (uint8_t)(x == 0 ? 7 : 0);
    case 6:
        return (uint8_t)(x + 1 == width ? 7 : 0);
    case 7:
        return (uint8_t)(x % 8 == 7 ? 128 : 127); /* changes at ends of words */
    case 8:
        return (uint8_t)(rng_below(random, 2) * 255);
    case 9:
        return (uint8_t)rng_below(random, 3);
    case 10:
        return (uint8_t)(rng_below(random, 8) != 0); /* long runs */
    default:
        return (uint8_t)rng_next(random);
    }
}

static void compare(unsigned pattern, uint16_t width, size_t offset, rng *random)
{
    pel_run expected[WIDTH_MAX + 1];
    pel_run *runs;
    uint8_t *labels;
    uint16_t expected_count, count;
    unsigned x;
    labels = guarded_take(&labels_memory, width, offset, 0);
    for (x = 0; x < width; x++) {
        labels[x] = pattern_label(pattern, x, width, random);
    }
    expected_count = runs_by_loop(labels, width, expected);
    runs = guarded_take(&runs_memory, PEL_RUNS_MAX(width) * sizeof(pel_run), 0, 0xEE);
    count = pel_find_runs(labels, width, runs);
    check_that(count == expected_count, "pattern %u width %u offset %u: %u runs, not %u", pattern,
               width, (unsigned)offset, count, expected_count);
    check_that(count == expected_count && memcmp(runs, expected, count * sizeof(pel_run)) == 0,
               "pattern %u width %u offset %u: other runs", pattern, width, (unsigned)offset);
    check_that(guarded_intact(&runs_memory) && guarded_intact(&labels_memory),
               "pattern %u width %u offset %u: wrote outside", pattern, width, (unsigned)offset);
}

static void all_widths(unsigned pattern, uint32_t scale, rng *random)
{
    const uint32_t rounds = pattern < 8 ? 1 : 1 + 60 / scale;
    uint16_t width;
    size_t offset;
    uint32_t round;
    check_group("pattern %u, widths 0 to %d, alignments 0 to %d", pattern, WIDTH_MAX, OFFSETS - 1);
    for (width = 0; width <= WIDTH_MAX; width++) {
        for (offset = 0; offset < OFFSETS; offset++) {
            for (round = 0; round < rounds; round++) {
                compare(pattern, width, offset, random);
            }
        }
    }
}

static void all_rows(void)
{
    static const uint8_t label[3] = {0, 1, 200};
    uint32_t number, size = 1;
    uint16_t width;
    check_group("all rows of up to 10 pixels, three labels");
    for (width = 1; width <= 10; width++) {
        size *= 3;
        for (number = 0; number < size; number++) {
            uint8_t labels[10];
            pel_run runs[11], expected[11];
            uint32_t rest = number;
            uint16_t x, count;
            for (x = 0; x < width; x++) {
                labels[x] = label[rest % 3];
                rest /= 3;
            }
            count = runs_by_loop(labels, width, expected);
            check_that(pel_find_runs(labels, width, runs) == count &&
                           memcmp(runs, expected, count * sizeof runs[0]) == 0,
                       "width %u number %u", width, (unsigned)number);
        }
    }
}

static void wide_rows(void)
{
    static const uint16_t widths[] = {255, 256, 257, 640, 1920, 4095, 8191, 8192};
    static uint8_t labels[PEL_SIDE_MAX];
    static pel_run runs[PEL_SIDE_MAX + 1], expected[PEL_SIDE_MAX + 1];
    unsigned pattern, i, x;
    rng random = rng_seeded(5);
    check_group("wide rows up to %d", PEL_SIDE_MAX);
    for (i = 0; i < sizeof widths / sizeof widths[0]; i++) {
        for (pattern = 0; pattern < PATTERNS; pattern++) {
            uint16_t count;
            for (x = 0; x < widths[i]; x++) {
                labels[x] = pattern_label(pattern, x, widths[i], &random);
            }
            count = runs_by_loop(labels, widths[i], expected);
            check_that(pel_find_runs(labels, widths[i], runs) == count &&
                           memcmp(runs, expected, count * sizeof runs[0]) == 0,
                       "pattern %u width %u", pattern, widths[i]);
        }
    }
}

static void nothing_given(void)
{
    uint8_t labels[4] = {1, 1, 0, 1};
    pel_run runs[5];
    check_group("null pointers and empty rows have no runs");
    check_that(pel_find_runs(NULL, 4, runs) == 0, "labels NULL");
    check_that(pel_find_runs(labels, 4, NULL) == 0, "runs NULL");
    check_that(pel_find_runs(labels, 0, runs) == 0, "width 0");
}

int main(int argc, char **argv)
{
    const uint32_t scale = check_scale(argc, argv);
    rng random = rng_seeded(20);
    unsigned pattern;
    printf("seed 20\n");
    for (pattern = 0; pattern < PATTERNS; pattern++) {
        all_widths(pattern, scale, &random);
    }
    all_rows();
    wide_rows();
    nothing_given();
    guarded_free(&labels_memory);
    guarded_free(&runs_memory);
    return check_finish();
}
