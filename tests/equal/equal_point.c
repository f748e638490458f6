/* The kernels of point operations. */
#include "equal.h"

#include <string.h>

#include "row/row_point_select.h"

/* Into a third row, into the first, or into the second, by the seed. Sources end where their memory
 * ends. */
typedef struct rows {
    const uint8_t *a, *b;
} rows;

static rows rows_of(const equal_run *run)
{
    const size_t last = EQUAL_MARGIN + 3u * run->width;
    rows r = {run->in[0] + last, run->in[1] + last};

    if (run->seed % 3 == 0) {
        memcpy(run->out, r.a, run->width);
        r.a = run->out;
    } else if (run->seed % 3 == 1) {
        memcpy(run->out, r.b, run->width);
        r.b = run->out;
    }
    return r;
}

#define PAIR(name)                                                                                 \
    static size_t name##_rows(pel_backend backend, const equal_run *run)                           \
    {                                                                                              \
        const rows r = rows_of(run);                                                               \
        pel_i_row_##name(backend, r.a, r.b, run->width, run->out);                                 \
        return run->width;                                                                         \
    }

PAIR(add)
PAIR(subtract)
PAIR(absdiff)
PAIR(min)
PAIR(max)
PAIR(and)
PAIR(or)
PAIR(xor)

static size_t blend_rows(pel_backend backend, const equal_run *run)
{
    const rows r = rows_of(run);
    pel_i_row_blend(backend, r.a, r.b, (uint16_t)(run->seed / 3 % 257), run->width, run->out);
    return run->width;
}

/* ---- Results of 16 and 32 bits --------------------------------------------------------------- */

/* Kernels may count on the alignment of their type: such results are made here, with canaries of
 * their own, and then copied. */
enum { GUARDS = 16 };
static union {
    uint32_t u32[EQUAL_WIDTH_MAX + 2 * GUARDS];
    uint16_t u16[EQUAL_WIDTH_MAX + 2 * GUARDS];
} made;

/* The last `bytes` of a row: they end where its memory ends. */
static const uint8_t *end_of(const equal_run *run, unsigned plane, size_t bytes)
{
    return run->in[plane] + EQUAL_MARGIN + 4u * run->width - bytes;
}

static void fill_u16(uint32_t seed, uint16_t limit)
{
    for (unsigned i = 0; i < EQUAL_WIDTH_MAX + 2 * GUARDS; i++) {
        made.u16[i] = (uint16_t)(equal_random(&seed) % (limit + 1u));
    }
}

static void fill_u32(uint32_t seed)
{
    for (unsigned i = 0; i < EQUAL_WIDTH_MAX + 2 * GUARDS; i++) {
        made.u32[i] = equal_random(&seed) << 9 ^ equal_random(&seed);
    }
}

static size_t give(const equal_run *run, size_t bytes)
{
    memcpy(run->out, &made, bytes);
    return bytes;
}

static size_t give_u16(const equal_run *run)
{
    return give(run, (run->width + 2u * GUARDS) * sizeof(uint16_t));
}

static size_t give_u32(const equal_run *run)
{
    return give(run, (run->width + 2u * GUARDS) * sizeof(uint32_t));
}

/* ---- Tables, values -------------------------------------------------------------------------- */

/* Any table; a step; one with an entry that is none; one value only. */
static void fill_table(uint32_t seed, uint8_t table[256])
{
    const unsigned kind = seed % 4, last = equal_random(&seed) % 256;
    const uint8_t low = (uint8_t)equal_random(&seed);
    const uint8_t high = kind == 3 ? low : (uint8_t)equal_random(&seed);

    for (unsigned i = 0; i < 256; i++) {
        table[i] = kind == 0 ? (uint8_t)equal_random(&seed) : i > last ? high : low;
    }
    table[equal_random(&seed) % 256] ^= kind == 2;
}

static size_t map_row(pel_backend backend, const equal_run *run)
{
    uint8_t table[256];
    const uint8_t *src = end_of(run, 0, run->width);
    pel_row_curve curve;

    fill_table(run->seed, table);
    curve = pel_i_row_curve(backend, table, PEL_ROW_POINT_STEP);
    if (run->seed / 4 % 2) {
        memcpy(run->out, src, run->width);
        src = run->out;
    }
    pel_i_row_map(backend, &curve, src, run->width, run->out);
    return run->width;
}

static size_t copy_row(pel_backend backend, const equal_run *run)
{
    pel_i_row_copy(backend, end_of(run, 0, run->width), run->width, run->out);
    return run->width;
}

static size_t histogram_row(pel_backend backend, const equal_run *run)
{
    const unsigned step = run->seed % 3 + 1;
    fill_u32(run->seed);
    pel_i_row_histogram(backend, end_of(run, 0, step * run->width), step, run->width, made.u32);
    return give(run, 256 * sizeof made.u32[0]);
}

static size_t gain3_row(pel_backend backend, const equal_run *run)
{
    static const uint16_t special[] = {0, 1, 255, 256, 257, 32768, 65535, 384};
    const uint8_t *src = end_of(run, 0, 3u * run->width);
    uint32_t state = run->seed;
    uint16_t gains[3];

    for (unsigned c = 0; c < 3; c++) {
        gains[c] = (uint16_t)equal_random(&state);
        gains[c] = gains[c] % 2 ? special[gains[c] / 2 % 8] : gains[c];
    }
    if (run->seed % 2) {
        memcpy(run->out, src, 3u * run->width);
        src = run->out;
    }
    pel_i_row_gain3(backend, src, run->width, gains, run->out);
    return 3u * run->width;
}

/* ---- Sums over areas ------------------------------------------------------------------------- */

static size_t integral_row(pel_backend backend, const equal_run *run)
{
    uint32_t above[EQUAL_WIDTH_MAX];
    const uint32_t *const sums = made.u32 + GUARDS;

    fill_u32(run->seed);
    memcpy(above, sums, sizeof above);
    pel_i_row_integral(backend, end_of(run, 0, run->width), run->width,
                       run->seed % 2 ? above : sums, made.u32 + GUARDS);
    return give_u32(run);
}

static size_t columns_add_row(pel_backend backend, const equal_run *run)
{
    const uint16_t times = (uint16_t)(run->seed % 128 + 1);
    fill_u16(run->seed, (uint16_t)(65535 - 255 * times));
    pel_i_row_columns_add(backend, end_of(run, 0, run->width), run->width, times,
                          made.u16 + GUARDS);
    return give_u16(run);
}

static size_t columns_subtract_row(pel_backend backend, const equal_run *run)
{
    fill_u16(run->seed, 65535 - 255);
    for (unsigned i = 0; i < EQUAL_WIDTH_MAX + 2 * GUARDS; i++) {
        made.u16[i] = (uint16_t)(made.u16[i] + 255);
    }
    pel_i_row_columns_subtract(backend, end_of(run, 0, run->width), run->width, made.u16 + GUARDS);
    return give_u16(run);
}

/* Columns of any pixels, or of those that are looked at, by the seed. */
static size_t over_mean_row(pel_backend backend, const equal_run *run)
{
    uint32_t state = run->seed;
    const uint16_t radius = (uint16_t)(equal_random(&state) % (run->seed % 2 ? 127 : 9) + 1);
    const uint16_t side = (uint16_t)(2 * radius + 1);
    const int16_t c = (int16_t)(run->seed % 3 ? (int)(equal_random(&state) % 511) - 255 : 0);
    const uint8_t *src = end_of(run, 0, run->width);

    if (run->width == 0) {
        return 0;
    }
    fill_u16(state, (uint16_t)(255 * side));
    for (unsigned x = 0; run->seed % 5 > 1 && x < run->width; x++) {
        made.u16[x] = (uint16_t)(side * src[x]);
    }
    if (run->seed / 2 % 2) {
        memcpy(run->out, src, run->width);
        src = run->out;
    }
    pel_i_row_over_mean(backend, src, made.u16, run->width, radius, c, run->out);
    return run->width;
}

/* ---- Resizing -------------------------------------------------------------------------------- */

static size_t box_add_row(pel_backend backend, const equal_run *run)
{
    const uint16_t factor = (uint16_t)(run->seed % 4 + 1);
    const uint8_t channels = run->seed / 4 % 4 == 0 ? 3 : 1;
    const size_t bytes = (size_t)factor * channels;
    const uint16_t width = run->width / channels;

    fill_u32(run->seed);
    pel_i_row_box_add(backend, end_of(run, 0, bytes * width), factor, channels, width,
                      made.u32 + GUARDS);
    return give_u32(run);
}

/* Sums of which half are at the limit between two results. */
static size_t box_mean_row(pel_backend backend, const equal_run *run)
{
    uint32_t state = run->seed;
    const uint32_t area = run->seed % 4 == 0   ? 65536 - equal_random(&state) % 4
                          : run->seed % 4 == 1 ? equal_random(&state) % 65536 + 1
                                               : (uint32_t)1 << equal_random(&state) % 17;

    for (unsigned x = 0; x < run->width; x++) {
        const uint32_t limit = (equal_random(&state) % 255 + 1) * area - area / 2;
        const uint32_t kind = equal_random(&state) % 4;
        made.u32[x] = kind == 0   ? limit - 1
                      : kind == 1 ? limit
                      : kind == 2 ? 255 * area
                                  : equal_random(&state) % (255 * area + 1);
    }
    pel_i_row_box_mean(backend, made.u32, area, run->width, run->out);
    return run->width;
}

/* Columns some way apart: up to three pixels, or none. */
static size_t bilinear_row(pel_backend backend, const equal_run *run)
{
    static pel_row_place places[EQUAL_WIDTH_MAX];
    const uint8_t channels = run->seed % 5 == 0 ? 3 : 1;
    const uint16_t width_in = (uint16_t)((4u * run->width) / channels);
    uint32_t state = run->seed;
    const uint32_t pace = equal_random(&state) % (run->seed % 3 ? 2u << 8 : 4u << 8);
    pel_row_between between = {end_of(run, 0, 4u * run->width), end_of(run, 1, 4u * run->width), 0,
                               0};

    if (run->width == 0) {
        return 0;
    }
    between.last = (uint16_t)(run->seed % 7 ? width_in - 1 : 0);
    between.weight = (uint16_t)(equal_random(&state) % 2049);
    for (unsigned x = 0; x < run->width; x++) {
        const uint32_t at = x * pace >> 8;
        places[x].x = (uint16_t)(at < between.last ? at : between.last);
        places[x].weight = (uint16_t)(equal_random(&state) % 2049);
    }
    pel_i_row_bilinear(backend, &between, places, channels, run->width, run->out);
    return (size_t)channels * run->width;
}

const equal_kernel equal_point_kernels[] = {{"add", add_rows, 0},
                                            {"subtract", subtract_rows, 0},
                                            {"absdiff", absdiff_rows, 0},
                                            {"min", min_rows, 0},
                                            {"max", max_rows, 0},
                                            {"and", and_rows, 0},
                                            {"or", or_rows, 0},
                                            {"xor", xor_rows, 0},
                                            {"blend", blend_rows, 0},
                                            {"copy", copy_row, 0},
                                            {"map", map_row, 0},
                                            {"histogram", histogram_row, 0},
                                            {"gain3", gain3_row, 0},
                                            {"integral", integral_row, 0},
                                            {"columns_add", columns_add_row, 0},
                                            {"columns_subtract", columns_subtract_row, 0},
                                            {"over_mean", over_mean_row, 0},
                                            {"box_add", box_add_row, 0},
                                            {"box_mean", box_mean_row, 0},
                                            {"bilinear", bilinear_row, 0},
                                            {NULL, NULL, 0}};
