/* The kernels from pixels to runs. */
#include "equal.h"

#include <string.h>

#include "row/row_select.h"
#include "row/row_select_runs.h"

/* The last elements of an array, so that a sanitizer sees what is written behind them. */
#define AT_END(array, count) ((array) + sizeof(array) / sizeof(array)[0] - (size_t)(count))

/* Boxes from a seed: some of any size, some empty, some that reach the ends of the scale. */
static void random_boxes(uint32_t seed, pel_boxes *boxes)
{
    memset(boxes, 0, sizeof *boxes);
    for (unsigned c = 0; c < PEL_CLASS_MAX; c++) {
        uint8_t side[6];
        for (unsigned i = 0; i < 6; i++) {
            const uint32_t r = equal_random(&seed);
            side[i] = (uint8_t)(r % 4 == 0 ? (i % 2 == 0 ? 0 : 255) : r >> 8);
        }
        const pel_color_box box = {side[0], side[1], side[2], side[3], side[4], side[5]};
        (void)pel_boxes_set(boxes, c, &box);
    }
}

/* A kernel from pixels to labels or to runs. */
typedef size_t from_pixels(pel_backend backend, const equal_run *run, const pel_row_pairs *pairs);

static size_t classify(pel_backend backend, const equal_run *run, const pel_row_pairs *pairs)
{
    pel_classify_plan plan;
    pel_boxes boxes;

    random_boxes(run->seed, &boxes);
    (void)pel_classify_plan_make(&plan, &boxes, backend);
    const pel_row_boxes tables = {boxes.y, boxes.u, boxes.v};
    pel_i_row_classify_pairs(plan.backend, plan.nibbles, &tables, pairs, run->width, run->out);
    return run->width;
}

/* The runs of a row of pixels, each with its label, in one step. */
static size_t classify_runs(pel_backend backend, const equal_run *run, const pel_row_pairs *pairs)
{
    uint8_t label_row[EQUAL_WIDTH_MAX];
    uint16_t edge_row[2 * (EQUAL_WIDTH_MAX + 1)];
    uint8_t *const labels = AT_END(label_row, run->width);
    uint16_t *const edges = AT_END(edge_row, 2 * (run->width + 1));
    pel_classify_plan plan;
    pel_boxes boxes;
    uint16_t count;

    random_boxes(run->seed, &boxes);
    (void)pel_classify_plan_make(&plan, &boxes, backend);
    const pel_row_boxes tables = {boxes.y, boxes.u, boxes.v};
    count = pel_i_row_classify_runs(plan.backend, plan.nibbles, &tables, pairs, run->width, labels,
                                    edges);
    memcpy(run->out, edges, 4u * count);
    for (unsigned i = 0; i < count; i++) {
        run->out[4u * count + i] = labels[edges[2 * i]];
    }
    return 5u * count;
}

/* The four orders of packed 4:2:2, by the seed. */
static size_t on_packed(from_pixels *kernel, pel_backend backend, const equal_run *run)
{
    const unsigned y_at = run->seed & 1, u_at = run->seed & 2;
    const uint8_t *const p = run->in[0];
    const pel_row_pairs pairs = {p + y_at, p + (1 - y_at) + u_at, p + (1 - y_at) + (2 - u_at), 2,
                                 4};
    return kernel(backend, run, &pairs);
}

/* U before V or V before U, by the seed. */
static size_t on_nv12(from_pixels *kernel, pel_backend backend, const equal_run *run)
{
    const unsigned u_at = run->seed & 1;
    const pel_row_pairs pairs = {run->in[0], run->in[1] + u_at, run->in[1] + 1 - u_at, 1, 2};
    return kernel(backend, run, &pairs);
}

static size_t on_i420(from_pixels *kernel, pel_backend backend, const equal_run *run)
{
    const pel_row_pairs pairs = {run->in[0], run->in[1], run->in[2], 1, 1};
    return kernel(backend, run, &pairs);
}

static size_t on_gray(from_pixels *kernel, pel_backend backend, const equal_run *run)
{
    static const uint8_t neutral = 128;
    const pel_row_pairs pairs = {run->in[0], &neutral, &neutral, 1, 0};
    return kernel(backend, run, &pairs);
}

#define ON(layout)                                                                                 \
    static size_t classify_##layout(pel_backend backend, const equal_run *run)                     \
    {                                                                                              \
        return on_##layout(classify, backend, run);                                                \
    }                                                                                              \
    static size_t runs_##layout(pel_backend backend, const equal_run *run)                         \
    {                                                                                              \
        return on_##layout(classify_runs, backend, run);                                           \
    }
ON(packed)
ON(nv12)
ON(i420)
ON(gray)

/* All labels that occur in the pattern, or few of them, so that runs are long and short. */
static size_t find_runs(pel_backend backend, const equal_run *run)
{
    static const uint8_t masks[] = {0xFF, 0x07, 0x01, 0x80};
    uint8_t label_row[EQUAL_WIDTH_MAX];
    uint16_t edge_row[2 * (EQUAL_WIDTH_MAX + 1)];
    uint8_t *const labels = AT_END(label_row, run->width);
    uint16_t *const edges = AT_END(edge_row, 2 * (run->width + 1));
    uint16_t count;

    for (unsigned x = 0; x < run->width; x++) {
        labels[x] = run->in[0][x] & masks[run->seed % 4];
    }
    count = pel_i_row_find_runs(backend, labels, run->width, edges);
    memcpy(run->out, edges, 4u * count);
    return 4u * count;
}

const equal_kernel equal_color_kernels[] = {{"classify packed 4:2:2", classify_packed, 1},
                                            {"classify NV12", classify_nv12, 1},
                                            {"classify I420", classify_i420, 1},
                                            {"classify gray", classify_gray, 0},
                                            {"find runs", find_runs, 0},
                                            {"runs of packed 4:2:2", runs_packed, 1},
                                            {"runs of NV12", runs_nv12, 1},
                                            {"runs of I420", runs_i420, 1},
                                            {"runs of gray", runs_gray, 0},
                                            {NULL, NULL, 0}};
