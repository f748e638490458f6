/*
 * The frames of `pel bench` that take turns, as the buffers of a camera do: copies of one picture,
 * so that a run does not find in the cache what the run before it read. They are equal: branch
 * predictors do meet the same picture again, as in a scene that stands still.
 */
#ifndef BENCHRING_H
#define BENCHRING_H

#include "benchpicture.h"

enum { BENCH_FRAMES_MAX = 64, BENCH_RING_MIB = 256 };

/* A zeroed one is empty. */
typedef struct bench_ring {
    const bench_picture *picture;
    unsigned count;
    void *memory[BENCH_FRAMES_MAX]; /* of each copy: the picture in all forms */
    const uint8_t *frame[BENCH_FORMS][BENCH_FRAMES_MAX];
} bench_ring;

/* How many copies there are to be where `wanted` are asked for: fewer, but one at least, if so many
 * would take more than BENCH_RING_MIB. */
unsigned benchring_count(const bench_picture *picture, unsigned wanted);

/* Copies the picture `count` times, 1..BENCH_FRAMES_MAX; it must stay until the ring is freed. 0,
 * or -1 after a message; benchring_free in any case. */
int benchring_make(bench_ring *ring, const bench_picture *picture, unsigned count);

void benchring_free(bench_ring *ring);

#endif
