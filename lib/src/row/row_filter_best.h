/*
 * Which version of a row kernel of neighbourhoods a machine runs: the one place that says it. A
 * kernel without a line here is that of row_filter_c.c everywhere.
 */
#ifndef PEL_ROW_FILTER_BEST_H
#define PEL_ROW_FILTER_BEST_H

#include "row/row_filter_dsp.h"

#if PEL_ROW_DSP
#define PEL_BEST_COPY pel_row_copy_dsp
#define PEL_BEST_KERNEL3 pel_row_kernel3_dsp
#define PEL_BEST_GAUSS3 pel_row_gauss3_dsp
#define PEL_BEST_GRADIENT_ABS pel_row_gradient_abs_dsp
#else
#define PEL_BEST_COPY pel_row_copy
#define PEL_BEST_KERNEL3 pel_row_kernel3
#define PEL_BEST_GAUSS3 pel_row_gauss3
#define PEL_BEST_GRADIENT_ABS pel_row_gradient_abs
#endif

#endif
