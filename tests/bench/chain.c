/*
 * The chain that the benchmark measures: rows of YUYV are classified and joined to blobs, which are
 * filtered (20 pixels or more) and sorted, 4-connected, with memory with which nothing can be lost.
 *
 *   bench_chain BACKEND LEVEL INPUT  one chain to warm up, then one inside measured_chain(), where
 *                                    callgrind counts; prints what came out
 *   bench_chain --count INPUT        runs and regions of every size
 *
 * BACKEND is `scalar` or another name that backend.h knows; status 77 where there is no such one
 * here. LEVEL is `basic` (area, box, sums of x and y) or `all` (also second moments, perimeter,
 * holes).
 */
#include "benchinput.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 640, HEIGHT = 480, MIN_AREA = 20, RESULTS_MAX = 32768, NOT_HERE = 77 };

static uint8_t frame[BENCH_FRAME_BYTES_MAX];
static uint8_t labels[WIDTH];
static uint64_t work[PEL_BLOBS_WORDS(WIDTH, PEL_BLOBS_OPEN_SAFE(WIDTH), PEL_MEASURE_ALL)];
static pel_blob results[RESULTS_MAX];
static pel_run runs[PEL_RUNS_MAX(WIDTH)];

/* All that a chain needs. The pointers inside refer to this object: it stays in its place. */
typedef struct chain {
    pel_boxes boxes;
    pel_classify_plan plan;
    pel_classifier classifier;
    pel_cview view;
    pel_blob_filter filter;
    pel_blobs_config config;
    pel_blobs blobs;
    uint32_t count;
} chain;

/* With a name that the linker sees, because callgrind starts and stops counting by it. */
pel_status measured_chain(chain *c);

static void fail(const char *what)
{
    fprintf(stderr, "bench_chain: %s\n", what);
    exit(1);
}

static void chain_init(chain *c, const char *input, pel_backend backend, unsigned measure)
{
    if (bench_frame(input, WIDTH, HEIGHT, frame) != 0) {
        fail("no such input");
    }
    memset(c, 0, sizeof *c);
    bench_boxes(input, &c->boxes);
    c->classifier.boxes = &c->boxes;
    if (backend != PEL_BACKEND_SCALAR) {
        if (pel_classify_plan_make(&c->plan, &c->boxes, backend) != PEL_OK) {
            fail("the backend was refused");
        }
        c->classifier.plan = &c->plan;
    }
    c->config.backend = backend;
    c->classifier.range = PEL_RANGE_FULL;
    if (pel_cview_init(frame, PEL_YUYV, PEL_RANGE_FULL, WIDTH, HEIGHT, 0, &c->view) != PEL_OK) {
        fail("the view was refused");
    }
    c->filter.area_min = MIN_AREA;
    c->config.width = WIDTH;
    c->config.height = HEIGHT;
    c->config.open_max = PEL_BLOBS_OPEN_SAFE(WIDTH);
    c->config.connectivity = 4;
    c->config.measure = (uint8_t)measure;
    c->config.measurer = measure != 0 ? pel_blobs_measure : NULL;
    c->config.work = work;
    c->config.work_bytes = sizeof work;
    c->config.filter = &c->filter;
    c->config.results = results;
    c->config.results_max = RESULTS_MAX;
}

static pel_status run_chain(chain *c)
{
    return pel_blobs_frame(&c->blobs, &c->config, &c->classifier, &c->view, labels, &c->count);
}

__attribute__((noinline)) pel_status measured_chain(chain *c)
{
    return run_chain(c);
}

static void run_or_fail(chain *c)
{
    if (measured_chain(c) != PEL_OK) {
        fail("the chain did not end with PEL_OK");
    }
}

/* ---- What came out ------------------------------------------------------------------------- */

static int measure_of(const char *level)
{
    if (strcmp(level, "basic") == 0) {
        return 0;
    }
    return strcmp(level, "all") == 0 ? PEL_MEASURE_MOMENTS | PEL_MEASURE_OUTLINE : -1;
}

static unsigned long area_of_results(const chain *c)
{
    unsigned long area = 0;
    for (uint32_t i = 0; i < c->count; i++) {
        area += results[i].area;
    }
    return area;
}

static void print_result(chain *c)
{
    if (run_chain(c) != PEL_OK) {
        fail("the chain did not end with PEL_OK");
    }
    run_or_fail(c);
#if defined(__clang__)
    printf("compiler clang-%d.%d.%d\n", __clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
    printf("compiler gcc-%d.%d.%d\n", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
    printf("compiler unknown-0\n");
#endif
    printf("pixels %d\n", WIDTH * HEIGHT);
    printf("blobs %lu\n", (unsigned long)c->count);
    printf("area %lu\n", area_of_results(c));
    printf("found %lu\n", (unsigned long)c->blobs.counts.found);
    printf("regions4 %lu\n",
           (unsigned long)c->blobs.counts.found + (unsigned long)c->blobs.counts.filtered);
    printf("open_peak %u\n", (unsigned)c->blobs.counts.open_peak);
}

/* The runs of the whole frame, and its 8-connected regions with all classes taken as one. */
static void print_counts(chain *c)
{
    uint8_t one_class[256];
    unsigned long run_count = 0;
    for (uint16_t y = 0; y < HEIGHT; y++) {
        const pel_crow row = pel_cview_row(&c->view, y);
        if (pel_classify_row(&c->classifier, &row, labels) != PEL_OK) {
            fail("a row was refused");
        }
        run_count += pel_find_runs(labels, WIDTH, runs);
    }
    memset(one_class, 1, sizeof one_class);
    one_class[0] = 0;
    c->classifier.relabel = one_class;
    c->config.connectivity = 8;
    c->config.filter = NULL;
    run_or_fail(c);
    printf("runs %lu\n", run_count);
    printf("regions8 %lu\n", (unsigned long)c->count);
}

/* ---- Options ------------------------------------------------------------------------------- */

/* PEL_BACKEND_COUNT for a name that is none. */
static pel_backend backend_of(const char *name)
{
    unsigned backend = PEL_BACKEND_SCALAR;
    while (backend < PEL_BACKEND_COUNT &&
           strcmp(name, pel_backend_name((pel_backend)backend)) != 0) {
        backend++;
    }
    return (pel_backend)backend;
}

int main(int argc, char **argv)
{
    static chain c;
    const int is_count = argc == 3 && strcmp(argv[1], "--count") == 0;
    const pel_backend backend = argc == 4 ? backend_of(argv[1]) : PEL_BACKEND_SCALAR;
    const int measure = is_count ? 0 : argc == 4 ? measure_of(argv[2]) : -1;
    if (measure < 0 || backend == PEL_BACKEND_COUNT) {
        fprintf(stderr, "usage: bench_chain BACKEND basic|all INPUT\n"
                        "       bench_chain --count INPUT\n");
        return 2;
    }
    if (!pel_backend_available(backend)) {
        fprintf(stderr, "bench_chain: no %s here\n", argv[1]);
        return NOT_HERE;
    }
    chain_init(&c, argv[argc - 1], backend, (unsigned)measure);
    if (is_count) {
        print_counts(&c);
    } else {
        print_result(&c);
    }
    return fflush(stdout) == 0 ? 0 : 1;
}
