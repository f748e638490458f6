#include "benchmeasure.h"

#include <stdlib.h>
#include <string.h>

#include "say.h"

enum { ROUNDS = 10, SERIES_MAX = PEL_BACKEND_COUNT + 2, REPEAT_MAX = 10000 };
static const double ENOUGH_NS = 50000;

bench_backends benchmeasure_backends(const bench_op *op, const bench_backends *all)
{
    bench_backends some = {{PEL_BACKEND_SCALAR}, 0};
    if (op->has_backend) {
        return *all;
    }
    for (unsigned i = 0; i < all->count; i++) {
        some.count |= all->of[i] == PEL_BACKEND_SCALAR;
    }
    return some;
}

/* ---- Comparing ----------------------------------------------------------------------------- */

static int compare_backend(const bench_job *scalar, pel_backend backend)
{
    static bench_job job;
    int failed = benchops_start(&job, scalar->op, scalar->picture, backend);
    if (!failed) {
        failed = benchops_result(&job);
    }
    if (!failed && (job.out_bytes != scalar->out_bytes ||
                    memcmp(job.out, scalar->out, scalar->out_bytes) != 0)) {
        failed = say_error("bench", "%s of %s: %s and scalar differ", scalar->op->name,
                           scalar->picture->name, pel_backend_name(backend));
    }
    benchops_stop(&job);
    return failed;
}

static int compare_opencv(const bench_job *scalar, benchpeer *peer, bench_compared *compared)
{
    size_t bytes = 0;
    const int got = scalar->op->fits ? benchpeer_prepare(peer, scalar->op->name, &bytes) : 0;
    if (got <= 0) {
        return got;
    }
    if (scalar->op->fits(scalar, peer->result, bytes)) {
        return -1;
    }
    compared->opencv++;
    return 0;
}

int benchmeasure_compare(const bench_op *op, const bench_picture *picture,
                         const bench_backends *backends, benchpeer *peer, bench_compared *compared)
{
    static bench_job scalar;
    int failed = benchops_start(&scalar, op, picture, PEL_BACKEND_SCALAR);
    if (!failed) {
        failed = benchops_result(&scalar);
    }
    for (unsigned i = 0; i < backends->count && !failed; i++) {
        if (backends->of[i] != PEL_BACKEND_SCALAR) {
            failed = compare_backend(&scalar, backends->of[i]);
            compared->backends += !failed;
        }
    }
    if (!failed) {
        failed = compare_opencv(&scalar, peer, compared);
    }
    benchops_stop(&scalar);
    return failed;
}

/* ---- Timing -------------------------------------------------------------------------------- */

/* Copying what the operator reads; through a volatile pointer, which no compiler leaves out. */
typedef struct copy_job {
    uint8_t *to;
    size_t bytes;
} copy_job;

static void *(*volatile copy_bytes)(void *, const void *, size_t) = memcpy;

/* One thing to time: a job, or a copy where that is NULL. */
typedef struct series {
    bench_job *job;
    const copy_job *copy;
    const bench_ring *ring;
    bench_form form; /* what is read */
    unsigned turn;   /* the frame that is next */
    unsigned repeat;
    double *ns; /* a place for each run */
} series;

static void run_once(series *of)
{
    const uint8_t *from = of->ring->frame[of->form][of->turn];
    if (of->job) {
        of->job->in.plane[0] = from;
        of->job->other.plane[0] = of->ring->frame[BENCH_TURNED][of->turn];
        of->job->op->run(of->job);
    } else {
        copy_bytes(of->copy->to, from, of->copy->bytes);
    }
    of->turn = of->turn + 1 < of->ring->count ? of->turn + 1 : 0;
}

static double time_once(series *of)
{
    const double start = benchtime_now_ns();
    for (unsigned i = 0; i < of->repeat; i++) {
        run_once(of);
    }
    return (benchtime_now_ns() - start) / of->repeat;
}

/* How often what takes so long once is to be repeated. */
static unsigned repeat_of(double once_ns)
{
    if (once_ns >= ENOUGH_NS) {
        return 1;
    }
    return once_ns * REPEAT_MAX > ENOUGH_NS ? (unsigned)(ENOUGH_NS / once_ns) + 1 : REPEAT_MAX;
}

/* Warms up, and finds out how often a run is to be repeated. */
static void calibrate(series *of)
{
    of->repeat = 1;
    time_once(of);
    of->repeat = repeat_of(time_once(of));
}

/* The same for OpenCV's job. 0, or -1 after a message. */
static int calibrate_peer(benchpeer *peer, unsigned *repeat)
{
    double once[2];
    if (benchpeer_run(peer, 1, 2, once)) {
        return -1;
    }
    *repeat = repeat_of(once[1]);
    return 0;
}

/* All that is timed together. */
typedef struct race {
    series runner[SERIES_MAX]; /* memcpy, then each backend */
    unsigned count;
    benchpeer *peer; /* NULL: no job of OpenCV's */
    unsigned peer_repeat;
    double *peer_ns;
} race;

static int run_race(race *all, unsigned runs)
{
    for (unsigned round = 0; round < ROUNDS; round++) {
        const unsigned begin = runs * round / ROUNDS;
        const unsigned end = runs * (round + 1) / ROUNDS;
        for (unsigned i = 0; i < all->count; i++) {
            for (unsigned run = begin; run < end; run++) {
                all->runner[i].ns[run] = time_once(&all->runner[i]);
            }
        }
        if (all->peer && end > begin &&
            benchpeer_run(all->peer, all->peer_repeat, end - begin, all->peer_ns + begin)) {
            return -1;
        }
    }
    return 0;
}

static void take_figures(race *all, unsigned runs, double pixels, bench_figure *figures)
{
    bench_spread opencv = {0, 0, 0};
    const bench_spread copy = benchtime_spread(all->runner[0].ns, runs, pixels);
    if (all->peer) {
        opencv = benchtime_spread(all->peer_ns, runs, pixels);
    }
    for (unsigned i = 1; i < all->count; i++) {
        bench_figure *figure = &figures[i - 1];
        figure->op = all->runner[i].job->op;
        figure->picture = all->runner[i].ring->picture;
        figure->frames = all->runner[i].ring->count;
        figure->backend = all->runner[i].job->backend;
        figure->own = benchtime_spread(all->runner[i].ns, runs, pixels);
        figure->copy = copy;
        figure->has_opencv = all->peer != NULL;
        figure->opencv = opencv;
    }
}

/* The prepared race, with `times` as room for the times of all. */
static int race_and_take(race *all, unsigned runs, double *times, double pixels,
                         bench_figure *figures)
{
    for (unsigned i = 0; i < all->count; i++) {
        all->runner[i].ns = times + (size_t)i * runs;
        calibrate(&all->runner[i]);
    }
    all->peer_ns = times + (size_t)all->count * runs;
    if (all->peer && calibrate_peer(all->peer, &all->peer_repeat)) {
        return -1;
    }
    if (run_race(all, runs)) {
        return -1;
    }
    take_figures(all, runs, pixels, figures);
    return 0;
}

int benchmeasure_time(const bench_op *op, const bench_ring *ring, const bench_backends *backends,
                      benchpeer *peer, unsigned runs, bench_figure *figures)
{
    static bench_job jobs[PEL_BACKEND_COUNT];
    const pel_cview view = benchpicture_view(ring->picture, op->form);
    copy_job copy = {NULL, pel_frame_bytes(view.format, view.width, view.height)};
    race all = {.count = 1 + backends->count};
    size_t bytes = 0;
    int failed = 0;
    double *times = malloc((all.count + 1) * (size_t)runs * sizeof *times);
    copy.to = malloc(copy.bytes);
    for (unsigned i = 0; i < all.count; i++) {
        all.runner[i].ring = ring;
        all.runner[i].form = op->form;
    }
    all.runner[0].copy = &copy;
    for (unsigned i = 0; i < backends->count; i++) {
        failed |= benchops_start(&jobs[i], op, ring->picture, backends->of[i]);
        all.runner[i + 1].job = &jobs[i];
    }
    const int got = op->fits ? benchpeer_prepare(peer, op->name, &bytes) : 0;
    all.peer = got > 0 ? peer : NULL;
    if (!times || !copy.to) {
        failed = say_error("bench", "out of memory");
    }
    failed = failed || got < 0 ||
             race_and_take(&all, runs, times, (double)view.width * view.height, figures);
    for (unsigned i = 0; i < backends->count; i++) {
        benchops_stop(&jobs[i]);
    }
    free(copy.to);
    free(times);
    return failed ? -1 : 0;
}
