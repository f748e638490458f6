/*
 * Integer arithmetic shared by all modules: one rounding rule, one saturation rule, and the few
 * functions that other libraries take from libm, each with a stated bound that a test measures.
 *
 * None of these functions can fail; arguments outside the stated range saturate or are named.
 */
#ifndef PEL_FIXED_H
#define PEL_FIXED_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* value / 2^bits, halves rounded upward. value: any with |value| < 2^30; bits: 0..30. */
int32_t pel_round_shift(int32_t value, unsigned bits);

/* numerator / divisor rounded to nearest, halves upward: floor(n/d + 1/2), exact.
 * numerator: -2^30..2^30, divisor: 1..2^30. */
int32_t pel_round_div(int32_t numerator, int32_t divisor);

/* value limited to 0..255. */
uint8_t pel_saturate_u8(int32_t value);

/* value limited to -32768..32767. */
int16_t pel_saturate_s16(int32_t value);

/* The integer square root: the largest r with r*r <= value. Exact for every argument. */
uint16_t pel_isqrt32(uint32_t value);
uint32_t pel_isqrt64(uint64_t value);

/*
 * The angle of the vector (x, y) in 1/65536 of a turn: 0 along +x, 16384 (a quarter) along +y,
 * that is, clockwise in a picture whose y points down. -32768..32767; (0, 0) gives 0.
 * Within 1 unit (0.0055 degrees) of the true angle. |x|, |y| <= 2^30.
 * Method: CORDIC in vectoring mode, Volder 1959.
 */
int16_t pel_atan2_turn16(int32_t y, int32_t x);

/*
 * 2^32 / divisor, rounded to nearest, halves upward; divisor 2..2^32-1. For divisor 0 and 1 the
 * result saturates to 2^32-1. Exact. With it a division by the same number becomes a
 * multiplication: (value * reciprocal) >> 32 is floor(value / divisor) or one off for any 32-bit
 * value.
 */
uint32_t pel_reciprocal_q32(uint32_t divisor);

#ifdef __cplusplus
}
#endif

#endif
