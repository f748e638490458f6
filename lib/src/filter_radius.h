/* Private to filter.c and filter_frame.c. */
#ifndef PEL_FILTER_RADIUS_H
#define PEL_FILTER_RADIUS_H

#include "pel/filter.h"

/* The radius of what a config computes, 1 or 2; 0 if it computes nothing or has two radii. */
unsigned pel_i_filter_radius(const pel_filter_config *config);

/* A part of filter.c; not in line, as few rows need it: see there. */
void pel_i_filter_rows_outside(const pel_filter *f, unsigned y, unsigned below,
                               const uint8_t *rows[5]);

#endif
