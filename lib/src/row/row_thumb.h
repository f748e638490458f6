/* The row kernels of row.h that exist for Cortex-M in Thumb code, and where these are there. */
#ifndef PEL_ROW_THUMB_H
#define PEL_ROW_THUMB_H

#include "row/row.h"

/* Not where there is Helium, nor for programs that are to be small or whose every branch lands on a
 * mark. PEL_ROW_THUMB_V6 asks for what Armv6-M runs on the others too, for tests. */
#if defined(__GNUC__) && defined(__thumb__) && defined(__ARM_ARCH_PROFILE) &&                      \
    !defined(__OPTIMIZE_SIZE__) && !defined(__ARM_FEATURE_BTI_DEFAULT) &&                          \
    !defined(__ARM_BIG_ENDIAN) && !defined(__ARM_FEATURE_MVE) && PEL_CLASS_MAX == 8
#if __ARM_ARCH_PROFILE == 'M'
#define PEL_ROW_THUMB 1
#endif
#endif
#ifndef PEL_ROW_THUMB
#define PEL_ROW_THUMB 0
#endif

#if PEL_ROW_THUMB
/* As pel_row_classify_runs, for an even number of packed pixels, Y before the chroma or behind. */
uint16_t pel_row_runs_y_first_thumb(const pel_row_boxes *boxes, const pel_row_pairs *src,
                                    uint16_t count, uint8_t *labels, uint16_t *edges);
uint16_t pel_row_runs_y_second_thumb(const pel_row_boxes *boxes, const pel_row_pairs *src,
                                     uint16_t count, uint8_t *labels, uint16_t *edges);

static inline uint16_t pel_row_classify_runs_thumb(const pel_row_boxes *boxes,
                                                   const pel_row_pairs *src, uint16_t count,
                                                   uint8_t *labels, uint16_t *edges)
{
    if (src->y_step != 2 || count % 2 != 0) {
        return pel_row_classify_runs(boxes, src, count, labels, edges);
    }
    return src->y < src->u && src->y < src->v
               ? pel_row_runs_y_first_thumb(boxes, src, count, labels, edges)
               : pel_row_runs_y_second_thumb(boxes, src, count, labels, edges);
}
#define PEL_ROW_RUNS_SCALAR pel_row_classify_runs_thumb
#else
#define PEL_ROW_RUNS_SCALAR pel_row_classify_runs
#endif

#endif
