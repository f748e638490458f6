#include "row/row_filter_narrow.h"

#include "row/row_filter_x86.h"
#include "row/row_mve.h"
#include "row/row_neon.h"

#if defined(PEL_ROW_FILTER_X86) || defined(PEL_ROW_NEON) || PEL_ROW_MVE

/* Sums of pixels times taps: -255 * negative .. 255 * positive. */
typedef struct reach {
    uint32_t negative, positive;
    int pairs_fit;
} reach;

static uint32_t magnitude(int8_t tap)
{
    return (uint32_t)(tap < 0 ? -tap : tap);
}

static reach reach_of(const int8_t *taps, unsigned radius)
{
    const int8_t *tap = taps;
    uint32_t sizes = 0, largest_pair = 0;
    int32_t sum = 0;
    reach r;

    for (unsigned row = 0; row <= 2 * radius; row++) {
        for (unsigned i = 0; i < radius; i++) {
            const uint32_t pair = magnitude(tap[0]) + magnitude(tap[1]);
            largest_pair = pair > largest_pair ? pair : largest_pair;
            sizes += pair;
            sum += tap[0] + tap[1];
            tap += 2;
        }
        sizes += magnitude(*tap);
        sum += *tap++;
    }
    r.positive = (uint32_t)((int32_t)sizes + sum) / 2;
    r.negative = sizes - r.positive;
    r.pairs_fit = largest_pair <= 128;
    return r;
}

/*
 * n / divisor = n * factor >> (16 + shift) for all n <= top, with factor = floor(2^(16 + shift) /
 * divisor) + 1: it is too large by e / divisor, e <= divisor, so that the quotient is too large by
 * n e / (divisor 2^(16 + shift)), which must stay below 1 / divisor (Granlund and Montgomery 1994).
 */
static int set_factor(pel_row_narrow *narrow, uint32_t divisor, uint32_t top, unsigned shift)
{
    const uint32_t power = (uint32_t)1 << (16 + shift);
    const uint32_t factor = power / divisor + 1;
    const uint32_t excess = factor * divisor - power;

    narrow->factor = (uint16_t)factor;
    narrow->shift = (uint8_t)shift;
    return factor <= 65535 && (uint64_t)excess * top < power;
}

static int set_divisor(pel_row_narrow *narrow, uint32_t divisor, uint32_t top)
{
    unsigned digits = 0; /* 2^digits <= divisor */

    while (divisor >> (digits + 1) != 0) {
        digits++;
    }
    narrow->shift = 0;
    if ((divisor & (divisor - 1)) == 0) {
        narrow->factor = (uint16_t)(digits == 0 ? 0 : (uint32_t)65536 >> digits);
        return 1;
    }
    return set_factor(narrow, divisor, top, 0) || set_factor(narrow, divisor, top, digits);
}

int pel_i_row_narrow(const int8_t *taps, unsigned radius, const pel_row_scale *scale,
                     pel_row_narrow *narrow)
{
    const reach r = reach_of(taps, radius);
    const uint32_t divisor = scale->divisor != 0 ? scale->divisor : (uint32_t)1 << scale->shift;
    const uint32_t whole =
        scale->divisor != 0 ? scale->start / divisor : scale->start >> scale->shift;
    const uint32_t half = scale->start - whole * divisor;
    const int32_t bias = scale->bias + (int32_t)whole;
    const int absolute = scale->flip != 0;
    const uint32_t highest = absolute && r.negative > r.positive ? r.negative : r.positive;
    uint32_t subtract, top;

    if (!r.pairs_fit || r.negative + r.positive > 257 || divisor > 16384 || bias < -32768 ||
        bias > 32767 || (absolute && highest > 128)) {
        return 0;
    }
    subtract = absolute ? 0 : (255 * r.negative + divisor - 1) / divisor;
    top = 255 * highest + half + subtract * divisor;
    if (top > 65535 || subtract > 32768 || top / divisor - subtract > 32767) {
        return 0;
    }
    narrow->add = (uint16_t)(half + subtract * divisor);
    narrow->subtract = (uint16_t)subtract;
    narrow->bias = (int16_t)bias;
    narrow->absolute = (uint8_t)absolute;
    return set_divisor(narrow, divisor, top);
}

#else
typedef int nothing_here; /* an empty file is no C */
#endif
