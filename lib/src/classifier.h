/* What a classifier refuses and what it does, for callers that check once for many rows. Private to
 * classify.c and the files of blobs. */
#ifndef PEL_CLASSIFIER_H
#define PEL_CLASSIFIER_H

#include "pel/classify.h"
#include "row/row_select_runs.h"

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

static inline pel_row_boxes pel_i_row_boxes(const pel_classifier *classifier)
{
    const pel_row_boxes boxes = {classifier->boxes->y, classifier->boxes->u, classifier->boxes->v};
    return boxes;
}

/* The runs of a row of YCbCr under boxes, see pel_row_classify_runs. */
static inline uint16_t pel_i_box_runs(const pel_classifier *classifier, const pel_row_pairs *pairs,
                                      uint16_t width, uint8_t *labels, uint16_t *edges)
{
    const pel_classify_plan *const plan = classifier->plan;
    const pel_row_boxes boxes = pel_i_row_boxes(classifier);

    return pel_i_row_classify_runs(plan ? plan->backend : PEL_ROW_BUILT_IN,
                                   plan ? plan->nibbles : NULL, &boxes, pairs, width, labels,
                                   edges);
}

/* The runs of a row that was checked and is `width` colours wide, see pel_row_classify_runs, after
 * relabel. `backend` finds runs in labels; boxes on YCbCr run as their plan says. */
uint16_t pel_i_classify_runs(const pel_classifier *classifier, const pel_crow *row, uint16_t width,
                             pel_backend backend, uint8_t *labels, uint16_t *edges);

#endif
