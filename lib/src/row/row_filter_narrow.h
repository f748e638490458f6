/* How 16 bits do for the sums of a kernel: for versions that do several at once. */
#ifndef PEL_ROW_FILTER_NARROW_H
#define PEL_ROW_FILTER_NARROW_H

#include "row/row_filter.h"

/*
 * A result is, modulo 2^16,
 *
 *     n = (absolute ? |sum| : sum) + add;  q = factor == 0 ? n : n * factor >> (16 + shift);
 *     q - subtract + bias, limited to 16 bits with a sign
 *
 * with 0 <= n < 2^16 and a product of 32 bits.
 */
typedef struct pel_row_narrow {
    uint16_t add, factor, subtract;
    int16_t bias;
    uint8_t shift;
    uint8_t absolute;
} pel_row_narrow;

/*
 * 1 if `taps` can be summed up so and give what `scale` says for all pixels, and no neighbours' sum
 * (of the first and second tap in a row, of the third and fourth) leaves -32768..32767. radius 1 or
 * 2.
 */
int pel_i_row_narrow(const int8_t *taps, unsigned radius, const pel_row_scale *scale,
                     pel_row_narrow *narrow);

#endif
