/*
 * RAM that a program pays for each part of the library at 320 pixels a row: its object, its working
 * memory and the results. Each array below has the size of one sum and the name under which
 * budgets.py lists it, with blanks for the underscores. Compiled, never run.
 */
#include <pel.h>

enum { W = 320, OPEN = 32, RESULTS = 16, CORNERS = 64 };

#define RAM(name, bytes) char ram_##name[bytes]

RAM(boxes_of_8_classes, sizeof(pel_boxes));
RAM(label_row, W);
RAM(blobs_basic, sizeof(pel_blobs) + PEL_BLOBS_BYTES(W, OPEN, 0) + RESULTS * sizeof(pel_blob));
RAM(blobs_all,
    sizeof(pel_blobs) + PEL_BLOBS_BYTES(W, OPEN, PEL_MEASURE_ALL) + RESULTS * sizeof(pel_blob));
RAM(blobs_with_nothing_ever_lost,
    sizeof(pel_blobs) + PEL_BLOBS_BYTES(W, PEL_BLOBS_OPEN_SAFE(W), 0) + RESULTS * sizeof(pel_blob));
RAM(filter_3x3, sizeof(pel_filter) + PEL_FILTER_BYTES(W, 1));
RAM(filter_5x5, sizeof(pel_filter) + PEL_FILTER_BYTES(W, 2));
RAM(adaptive_threshold_15x15, sizeof(pel_adaptive) + PEL_ADAPTIVE_BYTES(W, 7));
RAM(resize_box_to_160, sizeof(pel_resize) + PEL_RESIZE_BOX_BYTES(160, 1));
RAM(resize_bilinear_to_160, sizeof(pel_resize) + PEL_RESIZE_BILINEAR_BYTES(W, 160, 1));
RAM(corners_harris,
    sizeof(pel_corners) + PEL_CORNERS_BYTES(W, PEL_CORNERS_HARRIS) + CORNERS * sizeof(pel_corner));
RAM(corners_fast9,
    sizeof(pel_corners) + PEL_CORNERS_BYTES(W, PEL_CORNERS_FAST9) + CORNERS * sizeof(pel_corner));
RAM(edges, sizeof(pel_canny) + PEL_CANNY_BYTES(W));
