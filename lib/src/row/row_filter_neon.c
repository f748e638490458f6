/* Row kernels of neighbourhoods for AArch64 with NEON: 16 pixels at a time. */
#include "row/row_filter_narrow.h"
#include "row/row_neon_words.h"

#if defined(PEL_ROW_NEON)
#define ISA
#define INLINE __attribute__((always_inline)) static inline
#define KERNEL(name) pel_row_##name##_neon
#define V(operation) neon_##operation
#define BITS(operation) neon_##operation
#define MOVED(last, here, n) vextq_u8(last, here, 16 - (n))
#define EQUAL(a, b) neon_cmpeq_epi8(a, b)

/* Products of bytes with a sign and bytes without one do not exist; those of 16 bits that add
 * themselves to a sum, and by one place of a vector, do. */
#define OWN_PRODUCTS

enum { LANES = PEL_ROW_LANES_NEON };

typedef struct words {
    vec low, high;
} words;

INLINE void store_words(int16_t *out, words results)
{
    vst1q_s16(out, as_s16(results.low));
    vst1q_s16(out + 8, as_s16(results.high));
}

/* n times what q is over p. */
INLINE words rises(vec p, vec q, int n)
{
    const words products = {of_u16(vsubl_u8(vget_low_u8(q), vget_low_u8(p)) * (uint16_t)n),
                            of_u16(vsubl_high_u8(q, p) * (uint16_t)n)};
    return products;
}

/* Two neighbouring columns each, weighed 1 2 1, times 16. */
INLINE vec gauss_pairs(vec a, vec b, vec c)
{
    const uint16x8_t outer = vpadalq_u8(vpaddlq_u8(a), c);
    return of_u16(vshlq_n_u16(vaddq_u16(outer, vshlq_n_u16(vpaddlq_u8(b), 1)), 4));
}

#include "row/row_filter_template.h"

/* ---- Sums of 16 bits ----------------------------------------------------------------------- */

/* Sums need not be finished early: there are registers enough. */
INLINE parities ready(parities sums)
{
    return sums;
}

/* The taps of a row, one in each place; the rest is 0. Sums may pass 16 bits on the way: without a
 * sign, C says what they are then. */
typedef struct taps3 {
    uint16x8_t tap;
} taps3;

typedef struct taps5 {
    uint16x8_t tap;
} taps5;

INLINE taps5 taps5_of(int a, int b, int c, int d, int e)
{
    const int16_t places[8] = {(int16_t)a, (int16_t)b, (int16_t)c, (int16_t)d, (int16_t)e, 0, 0, 0};
    const taps5 taps = {vreinterpretq_u16_s16(vld1q_s16(places))};
    return taps;
}

INLINE taps3 taps3_of(int a, int b, int c)
{
    const taps3 taps = {taps5_of(a, b, c, 0, 0).tap};
    return taps;
}

/* sum + v * tap number `n`, a constant. */
#define PLUS(sum, v, taps, n) vmlaq_laneq_u16(sum, as_u16(v), (taps)->tap, n)
#define TIMES(v, taps, n) vmulq_laneq_u16(as_u16(v), (taps)->tap, n)

/* Sums of three neighbours each; p is at the first place. The odd places of a vector of bytes are
 * the even ones of that which begins one further right. */
INLINE parities row_sum3(const uint8_t *p, const taps3 *taps)
{
    const parities left = parities_of(load(p - 1)), right = parities_of(load(p + 1));
    const parities sums = {
        of_u16(PLUS(PLUS(TIMES(left.even, taps, 0), left.odd, taps, 1), right.even, taps, 2)),
        of_u16(PLUS(PLUS(TIMES(left.odd, taps, 0), right.even, taps, 1), right.odd, taps, 2))};
    return sums;
}

INLINE parities row_sum5(const uint8_t *p, const taps5 *taps)
{
    const parities left = parities_of(load(p - 2)), here = parities_of(load(p));
    const parities right = parities_of(load(p + 2));
    const uint16x8_t even =
        PLUS(PLUS(TIMES(left.even, taps, 0), left.odd, taps, 1), here.even, taps, 2);
    const uint16x8_t odd =
        PLUS(PLUS(TIMES(left.odd, taps, 0), here.even, taps, 1), here.odd, taps, 2);
    const parities sums = {of_u16(PLUS(PLUS(even, here.odd, taps, 3), right.even, taps, 4)),
                           of_u16(PLUS(PLUS(odd, right.even, taps, 3), right.odd, taps, 4))};
    return sums;
}

/* By how much all places are shifted: to the left if it is positive. */
typedef int shift_count;

INLINE shift_count shift_by(int bits)
{
    return -bits;
}

INLINE vec neon_srl_epi16(vec v, shift_count count)
{
    return of_u16(vshlq_u16(as_u16(v), vdupq_n_s16((int16_t)count)));
}

INLINE vec neon_srl_epi32(vec v, shift_count count)
{
    return of_u32(vshlq_u32(as_u32(v), vdupq_n_s32(count)));
}

/* Even and odd places limited to bytes, in their order. */
INLINE vec bytes_of(parities results)
{
    const uint8x8_t even = vqmovun_s16(as_s16(results.even));
    const uint8x8_t odd = vqmovun_s16(as_s16(results.odd));
    return vcombine_u8(vzip1_u8(even, odd), vzip2_u8(even, odd));
}

/* ---- Sums of 32 bits ----------------------------------------------------------------------- */

typedef struct quads {
    vec first, second, third, fourth;
} quads;

INLINE quads wide_sums(const uint8_t *const rows[], int x, int radius, const int8_t *tap)
{
    int32x4_t first = vdupq_n_s32(0), second = first, third = first, fourth = first;

    for (int r = 0; r <= 2 * radius; r++) {
        const uint8_t *const p = rows[r] + x - radius;
        const int8_t *const t = tap + (2 * radius + 1) * r;
        for (int k = 0; k <= 2 * radius; k++) {
            const vec bytes = load(p + k);
            const int16x8_t low = vreinterpretq_s16_u16(vmovl_u8(vget_low_u8(bytes)));
            const int16x8_t high = vreinterpretq_s16_u16(vmovl_high_u8(bytes));
            first = vmlal_n_s16(first, vget_low_s16(low), t[k]);
            second = vmlal_high_n_s16(second, low, t[k]);
            third = vmlal_n_s16(third, vget_low_s16(high), t[k]);
            fourth = vmlal_high_n_s16(fourth, high, t[k]);
        }
    }
    const quads sums = {of_s32(first), of_s32(second), of_s32(third), of_s32(fourth)};
    return sums;
}

#include "row/row_filter_taps_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
