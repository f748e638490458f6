#include "pel/fixed.h"

/* Shifts that round towards minus infinity also where >> of a negative value does
 * something else. */
static int32_t floor_shift(int32_t value, unsigned bits)
{
    return value >= 0 ? value >> bits : ~(~value >> bits);
}

int32_t pel_round_shift(int32_t value, unsigned bits)
{
    return bits == 0 ? value : floor_shift(value + ((int32_t)1 << (bits - 1)), bits);
}

int32_t pel_round_div(int32_t numerator, int32_t divisor)
{
    int32_t quotient = numerator / divisor;
    int32_t remainder = numerator % divisor;

    if (remainder < 0) {
        remainder += divisor;
        quotient--;
    }
    return remainder >= divisor - remainder ? quotient + 1 : quotient;
}

uint8_t pel_saturate_u8(int32_t value)
{
    return (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : value);
}

int16_t pel_saturate_s16(int32_t value)
{
    return (int16_t)(value < -32768 ? -32768 : value > 32767 ? 32767 : value);
}

/* Digit by digit in base 2: `root` holds the digits found so far, shifted to their place. */
uint16_t pel_isqrt32(uint32_t value)
{
    uint32_t root = 0;

    for (uint32_t digit = (uint32_t)1 << 30; digit != 0; digit >>= 2) {
        if (value >= root + digit) {
            value -= root + digit;
            root = (root >> 1) + digit;
        } else {
            root >>= 1;
        }
    }
    return (uint16_t)root;
}

uint32_t pel_isqrt64(uint64_t value)
{
    uint64_t root = 0;

    for (uint64_t digit = (uint64_t)1 << 62; digit != 0; digit >>= 2) {
        if (value >= root + digit) {
            value -= root + digit;
            root = (root >> 1) + digit;
        } else {
            root >>= 1;
        }
    }
    return (uint32_t)root;
}

/* atan(2^-i) in 1/2^32 of a turn, rounded. The last one, 0.08 of a result unit, is what the method
 * leaves undetermined; with the final rounding the error stays under 1 unit. */
static const uint32_t cordic_turn32[] = {
    536870912, 316933406, 167458907, 85004756, 42667331, 21354465, 10679838, 5340245, 2670163,
    1335087,   667544,    333772,    166886,   83443,    41722,    20861,    10430,   5215};

enum { CORDIC_STEPS = sizeof cordic_turn32 / sizeof cordic_turn32[0] };

static uint32_t magnitude(int32_t value)
{
    return value < 0 ? 0u - (uint32_t)value : (uint32_t)value;
}

int16_t pel_atan2_turn16(int32_t y, int32_t x)
{
    const uint32_t size = magnitude(x) | magnitude(y);
    uint32_t turn32 = 0;

    if (size == 0) {
        return 0;
    }
    /* The steps lengthen the vector by 1.65: |x|, |y| < 2^29 keeps it under 2^31. Small vectors are
     * stretched so that the shifts below do not lose their digits. */
    if (size >= (uint32_t)1 << 29) {
        x = floor_shift(x, 2);
        y = floor_shift(y, 2);
    } else {
        for (uint32_t s = size; s < (uint32_t)1 << 28; s <<= 1) {
            x *= 2;
            y *= 2;
        }
    }
    if (x < 0) {
        turn32 = (uint32_t)1 << 31;
        x = -x;
        y = -y;
    }
    for (unsigned i = 0; i < CORDIC_STEPS; i++) {
        const int32_t dx = floor_shift(y, i);
        const int32_t dy = floor_shift(x, i);
        if (y > 0) {
            x += dx;
            y -= dy;
            turn32 += cordic_turn32[i];
        } else {
            x -= dx;
            y += dy;
            turn32 -= cordic_turn32[i];
        }
    }
    turn32 = (turn32 + 0x8000u) >> 16;
    return (int16_t)(turn32 < 0x8000u ? (int32_t)turn32 : (int32_t)turn32 - 0x10000);
}

uint32_t pel_reciprocal_q32(uint32_t divisor)
{
    uint32_t quotient, remainder;

    if (divisor < 2) {
        return UINT32_MAX;
    }
    quotient = UINT32_MAX / divisor;
    remainder = UINT32_MAX % divisor + 1; /* of 2^32, not yet reduced */
    if (remainder == divisor) {
        quotient++;
        remainder = 0;
    }
    return remainder >= divisor - remainder ? quotient + 1 : quotient;
}
