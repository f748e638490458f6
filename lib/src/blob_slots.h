/* What the working memory of a finder holds. Private to the files of blobs. */
#ifndef PEL_BLOB_SLOTS_H
#define PEL_BLOB_SLOTS_H

#include "classifier.h"
#include "overlap.h"
#include "pel/blobs.h"

/* Its sums grow to the bounds that pel_blobs_begin enforces: area <= 2^22, sum_x, sum_y < 2^32. */
struct pel_blob_slot {
    uint32_t area; /* in the free and in the united list: the next slot */
    uint32_t sum_x, sum_y;
    uint16_t x0, x1, y0;
    uint16_t newest; /* the row of its newest run */
    uint16_t parent; /* itself for a root */
    uint8_t label;
    uint8_t broken; /* a run of the blob was lost */
};

/*
 * What is measured beside that takes 64-bit sums, in this order:
 *   outline  1: low half: runs - pixel edges that they share, with the area half the perimeter;
 *               high half: runs - touching pairs of runs, 1 - holes. One 64-bit sum, both signed
 *   moments  3: 12 * sum of x*x (whole for every run without a division), x*y, y*y; each <= 2^48
 *   colour   2: y in the low and u in the high half, each 255 * 2^22 < 2^30; v
 */

typedef struct pel_blob_slot slot;

/* Instead of a slot, a run's blob may be NO_BLOB (none yet; also behind the last run of a row), or
 * LOST + its label - 1. */
#define LOST 0xFF00u
#define NO_BLOB 0xFFFFu

/* Ends the lists of slots. */
#define END 0xFFFFu

/* Bits of pel_blobs.losses: a run of this row found no slot so far; runs of this row were lost; of
 * the row above; this is the second walk over the row. */
enum { LATE = 1, LOST_HERE = 2, LOST_ABOVE = 4, SECOND = 8 };

/* The run behind the last of a row, BEYOND - 1 .. BEYOND: every search stops there. One more still
 * fits an int of 16 bits, and Thumb-2 compares with it at once. */
enum { BEYOND = 0x7F00 };

enum { STATE_IDLE, STATE_ROWS };

/* Takes a closed blob: counts it, asks filter and accept, calls on_blob, keeps it. */
void pel_i_blobs_report(pel_blobs *b, const pel_blob *blob);

/* Where the runs of the next row go. */
static inline uint16_t *pel_i_blobs_edges(const pel_blobs *b)
{
    return &b->runs[1 - b->above]->x0;
}

/* Adds the row whose runs lie there; of `labels` only the first of each run is read. */
pel_status pel_i_blobs_join(pel_blobs *b, uint16_t count, const uint8_t *labels,
                            const pel_crow *pixels);

/* Whether some memory overlaps what a finder writes: itself, its working memory and its results. */
static inline int pel_i_blobs_write(const pel_blobs *b, const pel_blobs_config *c,
                                    const void *memory, size_t bytes)
{
    return pel_i_overlap_now(b, sizeof *b, memory, bytes) ||
           pel_i_overlap_now(c->work, c->work_bytes, memory, bytes) ||
           pel_i_overlap_now(c->results, c->results_max * sizeof *c->results, memory, bytes);
}

/* What is wrong with the number of a row, or with where its labels lie. */
static inline pel_status pel_i_blobs_check_row(const pel_blobs *b, uint16_t y,
                                               const uint8_t *labels)
{
    if (b->state != STATE_ROWS || y != b->next_row || y >= b->config.height) {
        return PEL_ERR_ORDER;
    }
    return pel_i_blobs_write(b, &b->config, labels, b->config.width) ? PEL_ERR_ARG : PEL_OK;
}

#endif
