/*
 * Every row kernel with every backend that this machine has, against plain C, bit for bit:
 * widths from 0 to three vectors and three, offsets 0..31, eight kinds of patterns, and random
 * long rows; with canaries on both sides of the result. Then whole frames through filters, corners
 * and edges, and all colours through the conversions. In a sanitized build the rows end where their
 * memory ends, so that a read behind them is seen, too.
 *
 *   equal [SEED]
 */
#include "equal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { OFFSETS = 32, WIDTHS = 3 * 64 + 4, CANARY = 0xA5, CANARIES = 64, LONG_ROWS = 200 };

static const equal_kernel *const tables[] = {equal_color_kernels, equal_filter_kernels,
                                             equal_point_kernels, equal_row_kernels,
                                             equal_feature_kernels};
static unsigned long passed, failed;

uint32_t equal_random(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 7;
}

/* ---- Patterns ------------------------------------------------------------------------------ */

static const char *const patterns[] = {"random",        "zeros",       "all 255",
                                       "alternating",   "rising ramp", "falling ramp",
                                       "sparse pixels", "few values"};
enum { PATTERNS = sizeof patterns / sizeof patterns[0] };

static uint8_t pattern_byte(unsigned pattern, unsigned x, uint32_t *state)
{
    const uint32_t r = equal_random(state);

    switch (pattern) {
    case 0:
        return (uint8_t)r;
    case 1:
        return 0;
    case 2:
        return 255;
    case 3:
        return x & 1 ? 255 : 0;
    case 4:
        return (uint8_t)x;
    case 5:
        return (uint8_t)(255 - 3 * x);
    case 6:
        return r % 16 == 0 ? (uint8_t)(r >> 8) : 0;
    default:
        return (uint8_t)(16 * (r % 4) + (r >> 8) % 2);
    }
}

/* ---- One comparison ------------------------------------------------------------------------ */

/* The rows lie at `offset` in pieces of the heap that end right behind them. */
static uint8_t *make_row(unsigned pattern, unsigned offset, unsigned width, uint32_t *state)
{
    const size_t bytes = offset + 2 * EQUAL_MARGIN + 4u * width;
    uint8_t *const row = malloc(bytes);

    if (!row) {
        fputs("equal: out of memory\n", stderr);
        exit(1);
    }
    for (size_t i = 0; i < bytes; i++) {
        row[i] = pattern_byte(pattern, (unsigned)i, state);
    }
    return row;
}

static int canaries_live(const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (bytes[i] != CANARY) {
            return 0;
        }
    }
    return 1;
}

static int results_equal(const equal_kernel *kernel, pel_backend backend, equal_run *run,
                         unsigned offset)
{
    static uint8_t plain[EQUAL_OUT_MAX + 2 * CANARIES], fast[EQUAL_OUT_MAX + 2 * CANARIES];
    size_t plain_bytes, fast_bytes;

    memset(plain, CANARY, sizeof plain);
    memset(fast, CANARY, sizeof fast);
    run->out = plain + CANARIES;
    plain_bytes = kernel->run(PEL_BACKEND_SCALAR, run);
    run->out = fast + CANARIES / 2 + offset;
    fast_bytes = kernel->run(backend, run);
    return plain_bytes == fast_bytes && memcmp(plain + CANARIES, run->out, plain_bytes) == 0 &&
           canaries_live(fast, CANARIES / 2 + offset) &&
           canaries_live(run->out + fast_bytes,
                         sizeof fast - (CANARIES / 2 + offset + fast_bytes)) &&
           canaries_live(plain + CANARIES + plain_bytes, sizeof plain - CANARIES - plain_bytes);
}

static void compare(const equal_kernel *kernel, pel_backend backend, unsigned pattern,
                    unsigned width, unsigned offset, uint32_t seed)
{
    uint32_t state = seed;
    uint8_t *rows[EQUAL_PLANES];
    equal_run run;

    run.width = (uint16_t)(kernel->even ? width & ~1u : width);
    run.seed = equal_random(&state);
    for (unsigned i = 0; i < EQUAL_PLANES; i++) {
        rows[i] = make_row(pattern, offset, run.width, &state);
        run.in[i] = rows[i] + offset + EQUAL_MARGIN;
    }
    if (results_equal(kernel, backend, &run, offset)) {
        passed++;
    } else if (failed++ < 20) {
        printf("wrong: %s, %s: width %u, offset %u, %s, seed %lu\n", kernel->name,
               pel_backend_name(backend), (unsigned)run.width, offset, patterns[pattern],
               (unsigned long)seed);
    }
    for (unsigned i = 0; i < EQUAL_PLANES; i++) {
        free(rows[i]);
    }
}

/* ---- All comparisons ----------------------------------------------------------------------- */

static void compare_all(const equal_kernel *kernel, pel_backend backend, uint32_t seed)
{
    for (unsigned pattern = 0; pattern < PATTERNS; pattern++) {
        for (unsigned width = 0; width < WIDTHS; width++) {
            /* A quarter of the offsets with each pattern: all of them come up over four. */
            for (unsigned offset = pattern % 4; offset < OFFSETS; offset += 4) {
                compare(kernel, backend, pattern, width, offset, ++seed);
            }
        }
    }
    for (unsigned i = 0; i < LONG_ROWS; i++) {
        const unsigned width = EQUAL_WIDTH_MAX - equal_random(&seed) % 64;
        compare(kernel, backend, i % PATTERNS, width, i % OFFSETS, ++seed);
    }
}

int main(int argc, char **argv)
{
    const uint32_t seed = argc > 1 ? (uint32_t)strtoul(argv[1], NULL, 10) : 1;
    unsigned backends = 0;

    printf("seed %lu\n", (unsigned long)seed);
    for (unsigned b = PEL_BACKEND_SCALAR + 1; b < PEL_BACKEND_COUNT; b++) {
        const unsigned long before = passed + failed;
        if (!pel_backend_available((pel_backend)b)) {
            continue;
        }
        backends++;
        for (size_t t = 0; t < sizeof tables / sizeof tables[0]; t++) {
            for (const equal_kernel *kernel = tables[t]; kernel->name; kernel++) {
                compare_all(kernel, (pel_backend)b, seed);
            }
        }
        unsigned wrong = 0;
        passed += equal_frames((pel_backend)b, seed, &wrong);
        passed += equal_colors((pel_backend)b, &wrong);
        failed += wrong;
        wrong = 0;
        passed += equal_pictures((pel_backend)b, seed, &wrong);
        failed += wrong;
        printf("%s: %lu comparisons with plain C\n", pel_backend_name((pel_backend)b),
               passed + failed - before);
    }
    if (backends == 0) {
        printf("this machine has no backend but plain C\n");
        printf("0 passed, 0 failed, 1 skipped\n");
        return 0;
    }
    *(equal_roots_hold() ? &passed : &failed) += 1;
    *(equal_long_roots_hold() ? &passed : &failed) += 1;
    printf("%lu passed, %lu failed\n", passed, failed);
    return failed != 0;
}
