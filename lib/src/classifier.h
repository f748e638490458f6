/* What a classifier refuses and what it does, for callers that check once for many rows. Private to
 * classify.c and the files of blobs. */
#ifndef PEL_CLASSIFIER_H
#define PEL_CLASSIFIER_H

#include "pel/classify.h"

/* Keeps a function out of its caller, so that what it needs of the stack is not there while the
 * caller calls others. */
#if defined(__GNUC__)
#define PEL_I_APART __attribute__((noinline))
#else
#define PEL_I_APART
#endif

/* What pel_classify_row would answer, without doing it. */
pel_status pel_i_classify_check(const pel_classifier *classifier, const pel_crow *row,
                                uint8_t *labels);

/* The runs of a row that was checked and is `width` colours wide, see pel_row_classify_runs, after
 * relabel. `backend` finds runs in labels; boxes on YCbCr run as their plan says. */
uint16_t pel_i_classify_runs(const pel_classifier *classifier, const pel_crow *row, uint16_t width,
                             pel_backend backend, uint8_t *labels, uint16_t *edges);

#endif
