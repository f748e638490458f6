/* Which of the readings of a file fits best, and why. */
#ifndef VERDICT_H
#define VERDICT_H

#include "fit.h"
#include "reading.h"

typedef struct candidate {
    reading how;
    fit fit;
    uint32_t milli_bits; /* per byte, of fit_milli_bits */
} candidate;

/* What made the difference. */
typedef enum verdict_reason {
    VERDICT_ONLY,       /* nothing else has that many bytes */
    VERDICT_NEIGHBOURS, /* neighbours predict each other better than in any other */
    VERDICT_COLORS,     /* the others have colours that cannot be */
    VERDICT_SIZE,       /* the others have sizes that cameras do not have */
    VERDICT_SWAPPED,    /* none: they differ by two channels that change places */
    VERDICT_FLAT,       /* none: there is too little in the picture */
    VERDICT_NOISE,      /* none: neighbours are not alike in any reading */
    VERDICT_UNCLEAR     /* none */
} verdict_reason;

typedef struct verdict {
    size_t equal; /* so many of the first candidates fit alike; 0: noise */
    verdict_reason reason;
    size_t rival; /* the best of those that were ruled out by the reason; 0 if none was */
    size_t next;  /* the best of those that fit worse; 0 if there are none */
} verdict;

/* Sorts the candidates, the best first, and decides. `count` is at least 1. */
verdict verdict_reach(candidate *list, size_t count);

/* In which range (0 full, 1 limited) the colours of `one` disprove it beside `other`, which has the
 * same ones but for the order of U and V; -1 if in none. */
int verdict_disproof(const candidate *one, const candidate *other);

/* What the bytes say of the colour range of a YCbCr reading. */
typedef enum verdict_range {
    VERDICT_FULL_BEYOND,  /* full: too many samples lie outside of the limited range */
    VERDICT_FULL_COLORS,  /* full: the limited range would make colours that cannot be */
    VERDICT_LIMITED,      /* limited: luma ends where that does, at both ends */
    VERDICT_RANGE_UNCLEAR /* all samples lie within the limited range, and so may those of full */
} verdict_range;

verdict_range verdict_judge_range(const fit *of);

#endif
