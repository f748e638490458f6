/* What a classifier refuses, for callers that must know before they begin. Private to classify.c
 * and blobs_frame.c. */
#ifndef PEL_CLASSIFIER_H
#define PEL_CLASSIFIER_H

#include "pel/classify.h"

/* What pel_classify_row would answer, without doing it. */
pel_status pel_i_classify_check(const pel_classifier *classifier, const pel_crow *row,
                                uint8_t *labels);

#endif
