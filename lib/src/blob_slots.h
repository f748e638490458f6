/* What the working memory of a finder holds. Private to the files of blobs. */
#ifndef PEL_BLOB_SLOTS_H
#define PEL_BLOB_SLOTS_H

#include "classifier.h"
#include "overlap.h"
#include "pel/blobs.h"

/*
 * Its sums grow to the bounds that pel_blobs_begin enforces: area <= 2^22, sum_x, sum_y < 2^32.
 * No two of them lie side by side: compilers would add to both at once, which takes them longer.
 *
 * One comparison of `root` tells whether a run of a label may be added to the slot that a run above
 * names: see pel_i_of_label.
 */
struct pel_blob_slot {
    uint32_t root; /* the parent, itself for a root; label << 16; BROKEN if a run was lost */
    uint32_t sum_x;
    pel_run box;     /* x0 and x1 of the box */
    uint32_t area;   /* in the free and in the united list: the next slot */
    uint16_t y0;     /* of the box */
    uint16_t newest; /* its newest run, see pel_i_run_name; in the list of ended blobs: the next */
    uint32_t sum_y;
};

#define BROKEN ((uint32_t)1 << 24)

/*
 * What is measured beside that takes 64-bit sums, in this order:
 *   outline  1: low half: runs - pixel edges that they share, with the area half the perimeter;
 *               high half: runs - touching pairs of runs, 1 - holes. One 64-bit sum, both signed
 *   moments  3: 12 * sum of x*x (whole for every run without a division), x*y, y*y; each <= 2^48
 *   colour   2: y in the low and u in the high half, each 255 * 2^22 < 2^30; v
 */

typedef struct pel_blob_slot slot;

/* Whether the processor runs so far ahead that a jump which it guesses wrong costs it more than a
 * few instructions. */
#if (defined(__x86_64__) || defined(__aarch64__)) && !defined(__OPTIMIZE_SIZE__)
enum { RUNS_AHEAD = 1 };
#else
enum { RUNS_AHEAD = 0 };
#endif

/* Instead of a slot, a run's blob may be NO_BLOB (none yet; also behind the last run of a row), or
 * LOST + its label - 1. */
#define LOST 0xFF00u
#define NO_BLOB 0xFFFFu

/* Ends the lists of slots. Thumb-2 compares with it at once. */
#define END 0xFF00u

/* Bits of pel_blobs.losses: a run of this row found no slot so far; runs of this row were lost; of
 * the row above; this is the second walk over the row; for want of a slot a run was lost. */
enum { LATE = 1, LOST_HERE = 2, LOST_ABOVE = 4, SECOND = 8, NO_SLOT = 16 };

/* The run behind the last of a row, BEYOND - 1 .. BEYOND: every search stops there. One more still
 * fits an int of 16 bits, and Thumb-2 compares with it at once. */
enum { BEYOND = 0x7F00 };

enum { STATE_IDLE, STATE_ROWS };

/* Which of pel_blobs.runs and ids are of the row above, and of this row. */
enum { ABOVE, HERE };

/*
 * Slots are named by where they lie, in steps of 8 bytes: from a name an address is one scaled
 * addition. So there are at most OPEN_USED of them. More are of no use: a row has not so many runs.
 */
enum { SLOT_STEPS = sizeof(struct pel_blob_slot) / 8, OPEN_USED = 0xFF00 / SLOT_STEPS };

/* SLOT_STEPS times this is 1 modulo 2^32: multiplied with it, a name is the number of its slot. */
#define SLOT_STEPS_INVERSE ((uint32_t)0xAAAAAAAB)
typedef char pel_i_inverse_holds[(uint32_t)(SLOT_STEPS * SLOT_STEPS_INVERSE) == 1 ? 1 : -1];

static inline slot *pel_i_slot(slot *slots, size_t id)
{
    return (slot *)(void *)((unsigned char *)slots + 8 * id);
}

/* A slot's `root` is this and its own number, and that is all, if it is a root, has the label, and
 * lost no run. */
static inline uint32_t pel_i_of_label(unsigned label)
{
    return (uint32_t)label << 16;
}

static inline uint16_t pel_i_parent(const slot *s)
{
    return (uint16_t)s->root;
}

static inline unsigned pel_i_slot_label(const slot *s)
{
    return s->root >> 16 & 0xFF;
}

/* Names a run of this row or of the row above by where its blob is noted, `place`: even, and as
 * two rows are less than 64 KiB, different for different runs. */
static inline uint16_t pel_i_run_name(const uint16_t *place)
{
    return (uint16_t)(uintptr_t)place;
}

/* The name of none. */
enum { NO_RUN = 1 };

/* Takes a closed blob: counts it, asks filter and accept, calls on_blob, keeps it. */
void pel_i_blobs_report(pel_blobs *b, const pel_blob *blob);

/* Where the runs of the next row go. */
static inline uint16_t *pel_i_blobs_edges(const pel_blobs *b)
{
    return &b->runs[HERE]->x0;
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
