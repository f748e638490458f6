/* Private to filter.c and filter_frame.c. */
#ifndef PEL_FILTER_RADIUS_H
#define PEL_FILTER_RADIUS_H

#include "pel/filter.h"

/* The radius of what a config computes, 1 or 2; 0 if it computes nothing or has two radii. */
unsigned pel_i_filter_radius(const pel_filter_config *config);

#endif
