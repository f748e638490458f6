/* The row kernels of row.h that exist for Helium (MVE), and where these are there. */
#ifndef PEL_ROW_MVE_H
#define PEL_ROW_MVE_H

#include "row/row_thumb.h"

/* Not for programs that are to be small: the plain versions stay in for what does not fit vectors.
 */
#if defined(__ARM_FEATURE_MVE) && !defined(__OPTIMIZE_SIZE__)
#define PEL_ROW_MVE 1
#else
#define PEL_ROW_MVE 0
#endif

#if PEL_ROW_MVE && PEL_CLASS_MAX == 8
extern const uint8_t pel_row_label_of_mask[256];
void pel_row_classify_pairs_mve(const pel_row_boxes *boxes, const pel_row_pairs *src,
                                uint16_t count, uint8_t *labels);
uint16_t pel_row_find_runs_mve(const uint8_t *labels, uint16_t count, uint16_t *edges);

/* As pel_row_classify_runs: packed pixels in whole blocks, Y before the chroma or behind; any. */
enum { PEL_ROW_BLOCK_MVE = 32 };
uint16_t pel_row_runs_y_first_mve(const pel_row_packed *row, uint16_t count, uint8_t *labels,
                                  uint16_t *edges);
uint16_t pel_row_runs_y_second_mve(const pel_row_packed *row, uint16_t count, uint8_t *labels,
                                   uint16_t *edges);
uint16_t pel_row_classify_any_runs_mve(const pel_row_boxes *boxes, const pel_row_pairs *src,
                                       uint16_t count, uint8_t *labels, uint16_t *edges);

static inline uint16_t pel_row_runs_of_blocks_mve(const pel_row_boxes *boxes,
                                                  const pel_row_pairs *src, uint16_t count,
                                                  uint8_t *labels, uint16_t *edges)
{
    pel_row_packed row;

    if (pel_row_y_is_first(src)) {
        pel_row_pack(&row, src->y, boxes, src);
        return pel_row_runs_y_first_mve(&row, count, labels, edges);
    }
    pel_row_pack(&row, src->y - 1, boxes, src);
    return pel_row_runs_y_second_mve(&row, count, labels, edges);
}

static inline uint16_t pel_row_classify_runs_mve(const pel_row_boxes *boxes,
                                                 const pel_row_pairs *src, uint16_t count,
                                                 uint8_t *labels, uint16_t *edges)
{
    if (src->y_step != 2 || count % PEL_ROW_BLOCK_MVE != 0) {
        /* Copies, so that only they need to lie in memory. */
        const pel_row_boxes these_boxes = *boxes;
        const pel_row_pairs these_pairs = *src;
        return pel_row_classify_any_runs_mve(&these_boxes, &these_pairs, count, labels, edges);
    }
    return pel_row_runs_of_blocks_mve(boxes, src, count, labels, edges);
}
#define PEL_BEST_CLASSIFY_PAIRS pel_row_classify_pairs_mve
#define PEL_BEST_FIND_RUNS pel_row_find_runs_mve
#define PEL_BEST_CLASSIFY_RUNS pel_row_classify_runs_mve
#else
#define PEL_BEST_CLASSIFY_PAIRS pel_row_classify_pairs
#define PEL_BEST_FIND_RUNS pel_row_find_runs
#define PEL_BEST_CLASSIFY_RUNS PEL_ROW_RUNS_SCALAR
#endif

#endif
