/*
 * pel: colour vision for robots that see with a microcontroller.
 *
 * This file includes the whole library. Its headers are the manual; read them in this order:
 *
 *   pel/status.h     what a call answers: done, done in part, or refused
 *   pel/config.h     the compile-time choices: how many classes, how large a picture
 *   pel/version.h    the version, as numbers and as text
 *   pel/fixed.h      integer arithmetic: rounding, saturation, square root, atan2, reciprocal
 *   pel/backend.h    which instructions the inner loops are made of: plain C, AVX2, NEON, ...
 *   pel/image.h      views of pictures in every camera format, and how their rows are read
 *   pel/color.h      RGB, YCbCr, normalised RGB and HSV, row by row
 *   pel/classify.h   a row of pixels becomes a row of class labels
 *   pel/blobs.h      rows of labels become blobs: area, box, centroid, axes, holes
 *   pel/filter.h     3x3 and 5x5 kernels, gradients, median, morphology, with every border
 *   pel/point.h      tables, histograms, thresholds, resizing, white balance
 *   pel/feature.h    corners, edges, lines
 *
 * From a camera to blobs in four steps:
 *
 *   1. describe the colours       pel_boxes_set()        once
 *   2. start a frame              pel_blobs_begin()      per frame
 *   3. for every row:
 *        classify it              pel_classify_row()
 *        join it to the blobs     pel_blobs_row()
 *   4. finish the frame           pel_blobs_end()        the results, largest first
 *
 * or pel_blobs_frame() for steps 2 to 4 when the whole frame is in memory.
 *
 * What holds everywhere:
 *
 *   Memory       The caller owns all of it. pel never allocates, never keeps a pointer past the
 *                object that was given it, and has no static data. Sizes are macros for arrays and
 *                functions of the same name in lower case for run-time use.
 *   Rows         Every operator works row by row; what works on a frame is a loop over rows.
 *                A row that was passed in may be overwritten as soon as the call returns.
 *   Numbers      Integers only. Names tell the fixed-point format: _q4 has 4 fraction bits,
 *                _q15 has 15, _q16 has 16. Halves round upward (towards plus infinity).
 *   Coordinates  x grows to the right, y downward, both from 0. The centre of a pixel lies on its
 *                integer coordinates. Boxes are half-open: x0 <= x < x1, y0 <= y < y1.
 *   Threads      No call touches anything but its arguments: two threads may work at the same time
 *                on different objects.
 *   Overlap      Source and destination must not overlap unless the declaration allows it.
 */
#ifndef PEL_H
#define PEL_H

#include "pel/status.h"
#include "pel/config.h"
#include "pel/version.h"
#include "pel/fixed.h"
#include "pel/backend.h"
#include "pel/image.h"
#include "pel/color.h"
#include "pel/classify.h"
#include "pel/blobs.h"
#include "pel/filter.h"
#include "pel/point.h"
#include "pel/feature.h"

#endif
