/* Sums over a window of a picture, for refinement: a file of its own, so that its rows do not lie
 * on the stack together with all the rest. */
#ifndef PEL_FEATURE_WINDOW_H
#define PEL_FEATURE_WINDOW_H

#include "pel/image.h"

#include "row/row_feature.h"

enum { PEL_WINDOW_RADIUS_MAX = 5 };

/* The sums over the (2 radius + 1)^2 pixels around (x, y), which is inside; edge pixels repeat. */
pel_row_pull pel_window_pull(const pel_cview *view, int32_t x, int32_t y, int32_t radius);

#endif
