/*
 * Which version of a row kernel of neighbourhoods a machine runs: the one place that says it.
 * PEL_BEST(name) is for kernels that have a version for Helium and none for DSP.
 */
#ifndef PEL_ROW_FILTER_BEST_H
#define PEL_ROW_FILTER_BEST_H

#include "row/row_filter_dsp.h"
#include "row/row_filter_mve.h"

#if PEL_ROW_MVE
#define PEL_BEST(name) pel_row_##name##_mve
#else
#define PEL_BEST(name) pel_row_##name
#endif

#if PEL_ROW_DSP && !PEL_ROW_MVE
#define PEL_BEST_COPY pel_row_copy_dsp
#define PEL_BEST_KERNEL3 pel_row_kernel3_dsp
#define PEL_BEST_GAUSS3 pel_row_gauss3_dsp
#define PEL_BEST_GRADIENT_ABS pel_row_gradient_abs_dsp
#define PEL_BEST_MEDIAN3 pel_row_median3_dsp
#define PEL_BEST_MIN3 pel_row_min3_dsp
#define PEL_BEST_MAX3 pel_row_max3_dsp
#else
#define PEL_BEST_COPY PEL_BEST(copy)
#define PEL_BEST_KERNEL3 PEL_BEST(kernel3)
#define PEL_BEST_GAUSS3 PEL_BEST(gauss3)
#define PEL_BEST_GRADIENT_ABS PEL_BEST(gradient_abs)
#define PEL_BEST_MEDIAN3 PEL_BEST(median3)
#define PEL_BEST_MIN3 PEL_BEST(min3)
#define PEL_BEST_MAX3 PEL_BEST(max3)
#endif

#endif
