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

#if PEL_ROW_THUMB ||                                                                               \
    (defined(__ARM_FEATURE_MVE) && !defined(__OPTIMIZE_SIZE__) && PEL_CLASS_MAX == 8)
/* Packed pixels and the masks of their bytes. */
typedef struct pel_row_packed {
    const uint8_t *pixels;                    /* the byte that comes first, Y or not */
    const pel_class_mask *y, *first, *second; /* of Y, of both chroma bytes in their order */
} pel_row_packed;

static inline int pel_row_y_is_first(const pel_row_pairs *src)
{
    return src->y < src->u && src->y < src->v;
}

static inline void pel_row_pack(pel_row_packed *row, const uint8_t *pixels,
                                const pel_row_boxes *boxes, const pel_row_pairs *src)
{
    const int u_first = src->u < src->v;

    row->pixels = pixels;
    row->y = boxes->y;
    row->first = u_first ? boxes->u : boxes->v;
    row->second = u_first ? boxes->v : boxes->u;
}
#endif

#if PEL_ROW_THUMB
/* As pel_row_classify_runs, for an even number of packed pixels, Y before the chroma or behind. */
uint16_t pel_row_runs_y_first_thumb(const pel_row_packed *row, uint16_t count, uint8_t *labels,
                                    uint16_t *edges);
uint16_t pel_row_runs_y_second_thumb(const pel_row_packed *row, uint16_t count, uint8_t *labels,
                                     uint16_t *edges);

static inline uint16_t pel_row_classify_runs_thumb(const pel_row_boxes *boxes,
                                                   const pel_row_pairs *src, uint16_t count,
                                                   uint8_t *labels, uint16_t *edges)
{
    pel_row_packed row;

    if (src->y_step != 2 || count % 2 != 0) {
        return pel_row_classify_runs(boxes, src, count, labels, edges);
    }
    if (pel_row_y_is_first(src)) {
        pel_row_pack(&row, src->y, boxes, src);
        return pel_row_runs_y_first_thumb(&row, count, labels, edges);
    }
    pel_row_pack(&row, src->y - 1, boxes, src);
    return pel_row_runs_y_second_thumb(&row, count, labels, edges);
}
#define PEL_ROW_RUNS_SCALAR pel_row_classify_runs_thumb
#else
#define PEL_ROW_RUNS_SCALAR pel_row_classify_runs
#endif

#endif
