/*
 * Colour classification: a row of pixels becomes a row of class labels.
 *
 * A label is one byte: 0 = no class (background), c + 1 = class c. Two kinds of classifier give it:
 *
 *   Boxes   A class is a box in YCbCr. Three tables of 256 masks, one for each of Y, U and V,
 *           hold a bit per class; the AND of three look-ups has the bit of every class whose box
 *           holds the colour, whatever the number of classes. Where boxes overlap the lowest class
 *           wins. (Bruce, Balch, Veloso: Fast and inexpensive color image segmentation for
 *           interactive robots, IROS 2000.) 768 bytes for 8 classes.
 *   Table   A 3-D look-up table with a label per cell takes any decision: nearest neighbour,
 *           Gaussian, tree. 3+5+5 bits = 8 KiB, 4+6+6 = 64 KiB.
 */
#ifndef PEL_CLASSIFY_H
#define PEL_CLASSIFY_H

#include "pel/backend.h"
#include "pel/image.h"

#ifdef __cplusplus
extern "C" {
#endif

#define pel_boxes_set PEL_FOR_CLASSES(pel_boxes_set)
#define pel_classify_row PEL_FOR_CLASSES(pel_classify_row)
#define pel_classify_pieces PEL_FOR_CLASSES(pel_classify_pieces)
#define pel_classify_color PEL_FOR_CLASSES(pel_classify_color)
#define pel_classify_frame PEL_FOR_CLASSES(pel_classify_frame)

struct pel_classifier;

/* The box of one class in YCbCr; both ends belong to it. A box with a min over its max is empty. */
typedef struct pel_color_box {
    uint8_t y_min, y_max;
    uint8_t u_min, u_max;
    uint8_t v_min, v_max;
} pel_color_box;

/* The mask tables of up to PEL_CLASS_MAX boxes. May be const, in flash. All zero: no class. */
typedef struct pel_boxes {
    pel_class_mask y[256];
    pel_class_mask u[256];
    pel_class_mask v[256];
} pel_boxes;

/* Sets the box of a class, 0 <= class_index < PEL_CLASS_MAX, in place of the one it had. Start from
 * a zeroed pel_boxes. PEL_ERR_ARG: null pointer or no such class. */
pel_status pel_boxes_set(pel_boxes *boxes, unsigned class_index, const pel_color_box *box);

/* A 3-D look-up table: the label of (y, u, v) is
 * cell[((y >> (8-y_bits)) << (u_bits+v_bits)) | ((u >> (8-u_bits)) << v_bits) | (v >> (8-v_bits))].
 * Bits: 0..8 each. Labels 0..255. The caller owns the cells. CMVision's .tm files are 4, 6, 6. */
typedef struct pel_lut {
    const uint8_t *cell;
    uint8_t y_bits, u_bits, v_bits;
} pel_lut;

/* How many bytes the cells of a table take. */
#define PEL_LUT_BYTES(y_bits, u_bits, v_bits) ((uint32_t)1 << ((y_bits) + (u_bits) + (v_bits)))
uint32_t pel_lut_bytes(unsigned y_bits, unsigned u_bits, unsigned v_bits);

/*
 * A plan: boxes prepared for a backend that looks up many pixels at once; 244 bytes for less
 * time. Optional: without one, classification runs in plain C (on Cortex-M with what the compiler
 * was told the core has). Make it again when the boxes change.
 */
#define pel_classify_plan_make PEL_FOR_CLASSES(pel_classify_plan_make)
typedef struct pel_classify_plan {
    pel_backend backend;  /* what will run; read only */
    uint8_t nibbles[240]; /* private */
} pel_classify_plan;

/*
 * Makes a plan for boxes (PEL_BACKEND_AUTO: the best there is). PEL_TRUNCATED: the backend that was
 * asked for is not there or cannot do these tables (PEL_CLASS_MAX is not 8, or somebody wrote a
 * table that is no box): the plan is plain C, with the same results. PEL_ERR_ARG: null pointer,
 * unknown backend.
 */
pel_status pel_classify_plan_make(pel_classify_plan *plan, const pel_boxes *boxes,
                                  pel_backend backend);

/* Classifies what a reader reads, see below; not to be called by programs. */
typedef void pel_piecewise(const struct pel_classifier *classifier, const pel_crow *row,
                           uint16_t width, uint8_t *labels);
pel_piecewise pel_classify_pieces;

/*
 * What classifies: boxes, or, where boxes is NULL, a look-up table. `range` is the colour range
 * that the classes were made for; a YCbCr row of the other range is refused, RGB rows are converted
 * to it. `relabel`, if not NULL, is a table of 256 bytes applied to every label after that, so that
 * several boxes or cells can stand for one colour. Zero value: refused (no classes).
 *
 * Boxes work on YCbCr and gray rows as they are. A look-up table, and boxes on RGB and Bayer rows,
 * need a `reader`: pel_crow_read_yuv for any format, or one that links less (see pel_reader), and
 * as `pieces` the function that classifies what it reads: pel_classify_pieces. A program that names
 * neither carries no code for them.
 */
typedef struct pel_classifier {
    const pel_boxes *boxes;
    pel_lut lut;
    pel_range range;
    const uint8_t *relabel;
    pel_reader *reader;
    const pel_classify_plan *plan; /* of these boxes; NULL: plain C */
    pel_piecewise *pieces;
} pel_classifier;

/*
 * Classifies a row: labels[x] for 0 <= x < pel_color_width(row).
 * Cost per pixel: boxes on YCbCr, three look-ups at most; what goes through the reader is read in
 * pieces first, of 8 pixels, or of 64 where a processor converts many at once.
 *
 * PEL_ERR_ARG: null pointer, unknown format or range, no classes, table bits over 8, labels that
 * overlap the row. PEL_ERR_FORMAT: impossible width, a colour range that is not the classifier's,
 * or no reader and pieces for this format.
 */
pel_status pel_classify_row(const pel_classifier *classifier, const pel_crow *row, uint8_t *labels);

/* Classifies one colour given as Y, U, V in the classifier's range; 0 where nothing matches or the
 * classifier is NULL or empty. */
uint8_t pel_classify_color(const pel_classifier *classifier, uint8_t y, uint8_t u, uint8_t v);

/*
 * Classifies a whole view into a picture of labels, GRAY8 of pel_color_width x pel_color_height;
 * a loop over pel_classify_row. Statuses as above; PEL_ERR_SPACE: `labels` has another size.
 */
pel_status pel_classify_frame(const pel_classifier *classifier, const pel_cview *view,
                              const pel_view *labels);

#ifdef __cplusplus
}
#endif

#endif
