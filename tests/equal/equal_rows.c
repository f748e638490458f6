/* The kernels of colours: conversions, readers, classes of separate Y, U and V. */
#include "equal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "row/row_color_select.h"

/* ---- Conversions --------------------------------------------------------------------------- */

/* Into another row or in place, by the seed, in either range. Sources end where their memory ends:
 * in front of the margin behind the 4 bytes a pixel. */
static const uint8_t *source_of(const equal_run *run)
{
    const uint8_t *const src = run->in[0] + EQUAL_MARGIN + run->width;

    if (run->seed & 2) {
        memcpy(run->out, src, 3u * run->width);
        return run->out;
    }
    return src;
}

static size_t rgb_to_ycbcr(pel_backend backend, const equal_run *run)
{
    pel_i_row_rgb_to_ycbcr(backend, source_of(run), run->width, run->seed & 1, run->out);
    return 3u * run->width;
}

static size_t ycbcr_to_rgb(pel_backend backend, const equal_run *run)
{
    pel_i_row_ycbcr_to_rgb(backend, source_of(run), run->width, run->seed & 1, run->out);
    return 3u * run->width;
}

/* ---- Pixels that are not YCbCr ------------------------------------------------------------- */

enum { RGB24, RGB565, BAYER };

/* How a backend reads what plain C reads with these arguments. 1: it did. */
static int at_once(pel_backend backend, const equal_run *run, unsigned kind, const uint8_t *bytes,
                   const uint8_t *odd, unsigned order, int to_planes)
{
#if defined(PEL_ROW_COLOR)
    const pel_row_colors src = {bytes, odd, (pel_row_color_kind)kind, order};
    const pel_row_places dst = {run->out, run->out + run->width, run->out + 2 * run->width, 1};

    return to_planes ? pel_i_row_colors_to_ycbcr(backend, &src, run->width, run->seed & 1, &dst)
                     : pel_i_row_colors_to_rgb(backend, &src, run->width, run->out);
#else
    (void)backend, (void)run, (void)kind, (void)bytes, (void)odd, (void)order, (void)to_planes;
    return 0;
#endif
}

static size_t read_colors(pel_backend backend, const equal_run *run, unsigned kind, int to_planes)
{
    const unsigned bytes = kind == RGB24 ? 3 : 2;
    const uint8_t *const first = run->in[0] + EQUAL_MARGIN + (4 - bytes) * run->width;
    const uint8_t *const odd = run->in[1] + EQUAL_MARGIN + (4 - bytes) * run->width;
    const unsigned choice = run->seed / 4 % 4;
    const unsigned order = kind == RGB24 ? choice & 2 : kind == RGB565 ? choice & 1 : choice;
    uint8_t rgb[3 * EQUAL_WIDTH_MAX], *const out = run->out;

    if (at_once(backend, run, kind, first, odd, order, to_planes)) {
        return 3u * run->width;
    }
    if (kind == RGB24) {
        pel_row_read_rgb24(first, run->width, order, rgb);
    } else if (kind == RGB565) {
        pel_row_read_rgb565(first, run->width, order, rgb);
    } else {
        pel_row_read_bayer(first, odd, run->width, order, rgb);
    }
    if (to_planes) {
        pel_row_rgb_to_ycbcr(rgb, run->width, run->seed & 1, out, out + run->width,
                             out + 2 * run->width, 1);
    } else {
        memcpy(out, rgb, 3u * run->width);
    }
    return 3u * run->width;
}

#define COLORS(name, kind)                                                                         \
    static size_t name##_to_ycbcr(pel_backend backend, const equal_run *run)                       \
    {                                                                                              \
        return read_colors(backend, run, kind, 1);                                                 \
    }                                                                                              \
    static size_t name##_to_rgb(pel_backend backend, const equal_run *run)                         \
    {                                                                                              \
        return read_colors(backend, run, kind, 0);                                                 \
    }
COLORS(rgb24, RGB24)
COLORS(rgb565, RGB565)
COLORS(bayer, BAYER)

/* ---- Pairs --------------------------------------------------------------------------------- */

static int pairs_at_once(pel_backend backend, const equal_run *run, const pel_row_pairs *pairs,
                         int to_planes)
{
#if defined(PEL_ROW_COLOR)
    const pel_row_places dst = {run->out, run->out + run->width, run->out + 2 * run->width, 1};

    return to_planes ? pel_i_row_pairs_to_planes(backend, pairs, run->width, &dst)
                     : pel_i_row_pairs_to_rgb(backend, pairs, run->width, run->seed & 1, run->out);
#else
    (void)backend, (void)run, (void)pairs, (void)to_planes;
    return 0;
#endif
}

static size_t read_pairs(pel_backend backend, const equal_run *run, const pel_row_pairs *pairs,
                         int to_planes)
{
    uint8_t ycbcr[3][EQUAL_WIDTH_MAX];

    if (pairs_at_once(backend, run, pairs, to_planes)) {
        return 3u * run->width;
    }
    pel_row_read_pairs(pairs, 0, run->width, ycbcr[0], ycbcr[1], ycbcr[2]);
    if (to_planes) {
        for (unsigned i = 0; i < 3; i++) {
            memcpy(run->out + i * run->width, ycbcr[i], run->width);
        }
    } else {
        pel_row_ycbcr_to_rgb(ycbcr[0], ycbcr[1], ycbcr[2], 1, run->width, run->seed & 1, run->out);
    }
    return 3u * run->width;
}

/* The last `bytes` of an input row. */
static const uint8_t *row_end(const equal_run *run, unsigned plane, unsigned bytes)
{
    return run->in[plane] + EQUAL_MARGIN + 4u * run->width - bytes;
}

/* The four orders of packed 4:2:2, by the seed; the two of NV12; I420; gray of any U and V. */
static pel_row_pairs packed_pairs(const equal_run *run)
{
    const unsigned y_at = run->seed / 2 & 1, u_at = run->seed / 2 & 2;
    const uint8_t *const p = row_end(run, 0, 2u * run->width);
    const pel_row_pairs pairs = {p + y_at, p + (1 - y_at) + u_at, p + (1 - y_at) + (2 - u_at), 2,
                                 4};
    return pairs;
}

static pel_row_pairs nv12_pairs(const equal_run *run)
{
    const unsigned u_at = run->seed / 2 & 1;
    const uint8_t *const c = row_end(run, 1, run->width);
    const pel_row_pairs pairs = {row_end(run, 0, run->width), c + u_at, c + 1 - u_at, 1, 2};
    return pairs;
}

static pel_row_pairs i420_pairs(const equal_run *run)
{
    const pel_row_pairs pairs = {row_end(run, 0, run->width), row_end(run, 1, run->width / 2u),
                                 row_end(run, 2, run->width / 2u), 1, 1};
    return pairs;
}

static pel_row_pairs gray_pairs(const equal_run *run)
{
    const pel_row_pairs pairs = {row_end(run, 0, run->width), run->in[1], run->in[2], 1, 0};
    return pairs;
}

#define PAIRS(layout)                                                                              \
    static size_t layout##_to_planes(pel_backend backend, const equal_run *run)                    \
    {                                                                                              \
        const pel_row_pairs pairs = layout##_pairs(run);                                           \
        return read_pairs(backend, run, &pairs, 1);                                                \
    }                                                                                              \
    static size_t layout##_to_rgb(pel_backend backend, const equal_run *run)                       \
    {                                                                                              \
        const pel_row_pairs pairs = layout##_pairs(run);                                           \
        return read_pairs(backend, run, &pairs, 0);                                                \
    }
PAIRS(packed)
PAIRS(nv12)
PAIRS(i420)
PAIRS(gray)

/* ---- Classes ------------------------------------------------------------------------------- */

/* Boxes that may be empty or reach the ends of the scale; labels in Y's place, by the seed. */
static size_t classify_planes(pel_backend backend, const equal_run *run)
{
    const uint8_t *yuv[3];
    uint32_t state = run->seed;
    pel_boxes boxes;
    pel_classify_plan plan;

    memset(&boxes, 0, sizeof boxes);
    for (unsigned c = 0; c < PEL_CLASS_MAX; c++) {
        uint8_t side[6];
        for (unsigned i = 0; i < 6; i++) {
            const uint32_t r = equal_random(&state);
            side[i] = (uint8_t)(r % 4 == 0 ? (i % 2 == 0 ? 0 : 255) : r >> 8);
        }
        const pel_color_box box = {side[0], side[1], side[2], side[3], side[4], side[5]};
        (void)pel_boxes_set(&boxes, c, &box);
    }
    (void)pel_classify_plan_make(&plan, &boxes, backend);
    for (unsigned i = 0; i < 3; i++) {
        yuv[i] = row_end(run, i, run->width);
    }
    if (run->seed & 1) {
        memcpy(run->out, yuv[0], run->width);
        yuv[0] = run->out;
    }
    const pel_row_boxes tables = {boxes.y, boxes.u, boxes.v};
    pel_i_row_classify(plan.backend, plan.nibbles, &tables, yuv, run->width, run->out);
    return run->width;
}

/* Tables of 1 to 4096 cells that end where their memory ends; labels in Y's place, by the seed. */
static size_t classify_lut(pel_backend backend, const equal_run *run)
{
    const uint8_t *yuv[3];
    uint32_t state = run->seed;
    const unsigned y_bits = equal_random(&state) % 5, u_bits = equal_random(&state) % 5;
    const unsigned v_bits = equal_random(&state) % 5, bits = y_bits + u_bits + v_bits;
    uint8_t *const cells = malloc((size_t)1 << bits);

    if (!cells) {
        exit(1);
    }
    for (size_t i = 0; i < (size_t)1 << bits; i++) {
        cells[i] = (uint8_t)equal_random(&state);
    }
    for (unsigned i = 0; i < 3; i++) {
        yuv[i] = row_end(run, i, run->width);
    }
    if (run->seed & 1) {
        memcpy(run->out, yuv[0], run->width);
        yuv[0] = run->out;
    }
    const pel_row_lut lut = {cells,
                             (uint8_t)(8 - y_bits),
                             (uint8_t)(8 - u_bits),
                             (uint8_t)(8 - v_bits),
                             (uint8_t)(u_bits + v_bits),
                             (uint8_t)v_bits};
    pel_i_row_classify_lut(backend, &lut, yuv, run->width, run->out);
    free(cells);
    return run->width;
}

const equal_kernel equal_row_kernels[] = {{"RGB to YCbCr", rgb_to_ycbcr, 0},
                                          {"YCbCr to RGB", ycbcr_to_rgb, 0},
                                          {"RGB24 to planes", rgb24_to_ycbcr, 0},
                                          {"RGB24 to RGB", rgb24_to_rgb, 0},
                                          {"RGB565 to planes", rgb565_to_ycbcr, 0},
                                          {"RGB565 to RGB", rgb565_to_rgb, 0},
                                          {"Bayer to planes", bayer_to_ycbcr, 0},
                                          {"Bayer to RGB", bayer_to_rgb, 0},
                                          {"packed 4:2:2 to planes", packed_to_planes, 1},
                                          {"packed 4:2:2 to RGB", packed_to_rgb, 1},
                                          {"NV12 to planes", nv12_to_planes, 1},
                                          {"NV12 to RGB", nv12_to_rgb, 1},
                                          {"I420 to planes", i420_to_planes, 1},
                                          {"I420 to RGB", i420_to_rgb, 1},
                                          {"gray to planes", gray_to_planes, 0},
                                          {"gray to RGB", gray_to_rgb, 0},
                                          {"classify planes", classify_planes, 0},
                                          {"classify by table", classify_lut, 0},
                                          {NULL, NULL, 0}};

/* ---- All colours --------------------------------------------------------------------------- */

enum { ROW = 4096, ROWS = 4096 };

/* Whether a backend does to a row of all first and second channels what plain C does. */
static int row_holds(pel_backend backend, const uint8_t *in, int limited)
{
    static uint8_t plain[3 * ROW], fast[3 * ROW];
    int holds;

    pel_i_row_rgb_to_ycbcr(PEL_BACKEND_SCALAR, in, ROW, limited, plain);
    pel_i_row_rgb_to_ycbcr(backend, in, ROW, limited, fast);
    holds = memcmp(plain, fast, sizeof plain) == 0;
    pel_i_row_ycbcr_to_rgb(PEL_BACKEND_SCALAR, in, ROW, limited, plain);
    pel_i_row_ycbcr_to_rgb(backend, in, ROW, limited, fast);
    return holds && memcmp(plain, fast, sizeof plain) == 0;
}

unsigned equal_colors(pel_backend backend, unsigned *failed)
{
    static uint8_t in[3 * ROW];
    unsigned passed = 0;

    for (unsigned limited = 0; limited < 2; limited++) {
        unsigned equal = 0;
        for (uint32_t row = 0; row < ROWS; row++) {
            for (uint32_t i = 0; i < ROW; i++) {
                const uint32_t color = row * ROW + i;
                in[3 * i] = (uint8_t)color;
                in[3 * i + 1] = (uint8_t)(color >> 8);
                in[3 * i + 2] = (uint8_t)(color >> 16);
            }
            equal += (unsigned)row_holds(backend, in, (int)limited);
        }
        *(equal == ROWS ? &passed : failed) += 1;
        if (equal != ROWS) {
            printf("wrong: %s range, %u of %u rows of all colours\n", limited ? "limited" : "full",
                   ROWS - equal, (unsigned)ROWS);
        }
    }
    return passed;
}
