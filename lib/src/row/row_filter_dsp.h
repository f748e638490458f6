/* Which kernels of row_filter.h have a version for DSP instructions, and where these are there. */
#ifndef PEL_ROW_FILTER_DSP_H
#define PEL_ROW_FILTER_DSP_H

#include "row/row_filter.h"

/* Not for programs that are to be small: the plain versions stay in for what does not fit lanes.
 * Words are read as they lie in memory, lowest byte first. */
#if (defined(__ARM_FEATURE_SIMD32) && !defined(__ARM_BIG_ENDIAN) &&                                \
     !defined(__OPTIMIZE_SIZE__)) ||                                                               \
    defined(PEL_ROW_DSP_EMULATED)
#define PEL_ROW_DSP 1
#else
#define PEL_ROW_DSP 0
#endif

#if PEL_ROW_DSP
void pel_row_copy_dsp(const uint8_t *src, uint16_t count, uint8_t *dst);
void pel_row_kernel3_dsp(const uint8_t *const rows[], const int8_t *tap, const pel_row_scale *scale,
                         uint16_t count, uint8_t *out);
void pel_row_gauss3_dsp(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_gradient_abs_dsp(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_median3_dsp(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_min3_dsp(const uint8_t *const rows[], uint16_t count, uint8_t *out);
void pel_row_max3_dsp(const uint8_t *const rows[], uint16_t count, uint8_t *out);
#endif

#endif
