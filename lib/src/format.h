/*
 * What the library knows about pixel formats: one line of a table each, and the two ways to read a
 * row. Private to image.c, which holds the table, and to classify.c, which reads rows.
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
    char name[12];
    uint8_t layout;
    uint8_t pair_bytes; /* bytes of two pixels in plane 0 */
    uint8_t planes;
    uint8_t x_group,
        y_group;   /* columns and rows that share something: sizes and crops keep to it */
    uint8_t order; /* RGB24: offset of R; RGB565: offset of the low byte; Bayer: place of R */
    struct {       /* pairs: where Y, U and V start in the row, and their steps */
        uint8_t y_offset, y_step;
        uint8_t u_plane, u_offset, v_plane, v_offset, c_step;
    } pairs;
} pel_format_info;

/* The line of the table, NULL for a value that is no format. */
const pel_format_info *pel_i_format(pel_format format);

/* A row of layout PAIRS as the kernels want it. */
pel_row_pairs pel_i_pairs(const pel_format_info *info, const pel_crow *row);

/* Pixels x .. x+count-1 of a row of any other layout as R G B. */
void pel_i_read_rgb(const pel_format_info *info, const pel_crow *row, uint16_t x, uint16_t count,
                    uint8_t *rgb);

/* Whether the bytes of a row, or of a view and what lies between its rows, overlap some memory. */
int pel_i_crow_overlaps(const pel_crow *row, const void *memory, size_t bytes);
int pel_i_view_overlaps(const pel_cview *view, const void *memory, size_t bytes);

#endif
