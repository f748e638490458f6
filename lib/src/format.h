/*
 * What the library knows about pixel formats: one line of a table each, and the two ways to read a
 * row. Private to image.c, which holds the table, to image_read.c and to classify.c.
 */
#ifndef PEL_FORMAT_H
#define PEL_FORMAT_H

#include "pel/image.h"
#include "row/row.h"

/* How the bytes of a row become colours. */
enum pel_layout {
    PEL_LAYOUT_PAIRS, /* YCbCr or gray: pel_row_pairs describes it */
    PEL_LAYOUT_RGB24,
    PEL_LAYOUT_RGB565,
    PEL_LAYOUT_BAYER
};

typedef struct pel_format_info {
    unsigned layout : 2;
    unsigned pair_bytes : 3; /* bytes of two pixels in plane 0 */
    unsigned planes : 2;
    unsigned x_group : 2, y_group : 2; /* columns and rows that share something: sizes and crops
                                          keep to it */
    unsigned order : 2; /* RGB24: offset of R; RGB565: of the low byte; Bayer: place of R */
    /* Pairs: where Y, U and V start in the row, and their steps. */
    unsigned y_offset : 1, y_step : 2;
    unsigned u_plane : 2, u_offset : 2, v_plane : 2, v_offset : 2, c_step : 3;
} pel_format_info;

extern const pel_format_info pel_i_formats[PEL_FORMAT_COUNT];

/* The line of the table, NULL for a value that is no format. */
static inline const pel_format_info *pel_i_format(pel_format format)
{
    return (unsigned)format < PEL_FORMAT_COUNT ? &pel_i_formats[(unsigned)format] : NULL;
}

/* The same for a row that was checked. */
static inline const pel_format_info *pel_i_format_of(const pel_crow *row)
{
    return &pel_i_formats[(unsigned)row->format];
}

/* A row of layout PAIRS as the kernels want it. */
pel_row_pairs pel_i_pairs(const pel_format_info *info, const pel_crow *row);

/* The same, where it is known that two pixels lie in four bytes. */
static inline pel_row_pairs pel_i_packed_pairs(const pel_format_info *info, const uint8_t *bytes)
{
    const pel_row_pairs pairs = {bytes + info->y_offset, bytes + info->u_offset,
                                 bytes + info->v_offset, 2, 4};
    return pairs;
}

/* Whether the bytes of a row, or of a view and what lies between its rows, overlap some memory. */
int pel_i_crow_overlaps(const pel_crow *row, const void *memory, size_t bytes);
int pel_i_view_overlaps(const pel_cview *view, const void *memory, size_t bytes);

#endif
