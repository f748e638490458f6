/* How `pel bench` compares and times an operator on a picture with each backend. */
#ifndef BENCHMEASURE_H
#define BENCHMEASURE_H

#include "benchops.h"
#include "benchpeer.h"
#include "benchring.h"
#include "benchtime.h"

/* Which backends, in the order of the enum. */
typedef struct bench_backends {
    pel_backend of[PEL_BACKEND_COUNT];
    unsigned count;
} bench_backends;

/* The backends that change something for an operator: `all`, or where there is one way only,
 * SCALAR alone (none if that was not asked for). */
bench_backends benchmeasure_backends(const bench_op *op, const bench_backends *all);

/* How many results were compared. */
typedef struct bench_compared {
    unsigned long backends, opencv;
} bench_compared;

/* Compares the results of all backends with that of SCALAR, and that with OpenCV's, whose process
 * has the picture. 0, or -1 after a message: also where they differ. */
int benchmeasure_compare(const bench_op *op, const bench_picture *picture,
                         const bench_backends *backends, benchpeer *peer, bench_compared *compared);

/* What was measured. Times are in nanoseconds per pixel of the picture. */
typedef struct bench_figure {
    const bench_op *op;
    const bench_picture *picture;
    unsigned frames; /* how many copies of it took turns */
    pel_backend backend;
    bench_spread own;
    bench_spread copy; /* of memcpy of what the operator reads */
    int has_opencv;
    bench_spread opencv;
} bench_figure;

/*
 * Times the operator with each backend, into figures[0 .. backends->count - 1]. All take turns in
 * ten rounds, so that what happens to the machine meanwhile happens to all of them: memcpy, each
 * backend, OpenCV, whose process has the picture as often as the ring. What is over in less than 50
 * microseconds is repeated so often that it takes that long. Every run and repetition reads the
 * ring's next frame, all write into one place. 0, or -1 after a message.
 */
int benchmeasure_time(const bench_op *op, const bench_ring *ring, const bench_backends *backends,
                      benchpeer *peer, unsigned runs, bench_figure *figures);

#endif
