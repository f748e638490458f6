/* What the working memory of a finder holds. Private to blobs.c and blobs_frame.c. */
#ifndef PEL_BLOB_SLOTS_H
#define PEL_BLOB_SLOTS_H

#include "overlap.h"
#include "pel/blobs.h"

/* Its sums grow to the bounds that pel_blobs_begin enforces: area <= 2^22, sum_x, sum_y < 2^32. */
struct pel_blob_slot {
    uint32_t area; /* in the free and in the united list: the next slot */
    uint32_t sum_x, sum_y;
    uint16_t x0, x1, y0, y1;
    uint16_t parent; /* itself for a root */
    uint8_t label;   /* 0: the slot is free */
    uint8_t broken;  /* a run of the blob was lost */
};

struct pel_blob_moments {
    uint64_t xx12, xy, yy; /* 12 * sum of x*x: whole for every run without a division; <= 2^48 */
};

struct pel_blob_outline {
    int32_t edges; /* runs - pixel edges that they share: with the area, half the perimeter */
    int32_t euler; /* runs - touching pairs of runs = 1 - holes */
};

struct pel_blob_color {
    uint32_t y, u, v; /* sums; 255 * 2^22 < 2^30 */
};

typedef struct pel_blob_slot slot;

/* Keeps a function out of its caller, so that what it needs of the stack is not there while the
 * caller calls others. */
#if defined(__GNUC__)
#define PEL_I_APART __attribute__((noinline))
#else
#define PEL_I_APART
#endif

/* Instead of a slot, a run's blob may be NO_BLOB (joined nothing yet), or LOST + its label - 1. */
#define LOST 0xFF00u
#define NO_BLOB 0xFFFFu

/* Ends the lists of slots. */
#define END 0xFFFFu

/* What lies behind the last run of a row: every search stops here. */
enum { BEYOND = 0x7FFF };

enum { STATE_IDLE, STATE_ROWS };

/* Whether some memory overlaps what a finder writes: itself, its working memory and its results. */
static inline int pel_i_blobs_write(const pel_blobs *b, const pel_blobs_config *c,
                                    const void *memory, size_t bytes)
{
    return pel_i_overlap(b, sizeof *b, memory, bytes) ||
           pel_i_overlap(c->work, c->work_bytes, memory, bytes) ||
           pel_i_overlap(c->results, c->results_max * sizeof *c->results, memory, bytes);
}

#endif
