/* Row kernels of point operations for AArch64 with NEON: 16 bytes at a time. */
#include "row/row_neon_words.h"

#if defined(PEL_ROW_NEON)
#define ISA
#define INLINE __attribute__((always_inline)) static inline
#define KERNEL(name) pel_row_##name##_neon
#define V(operation) neon_##operation
#define BITS(operation) neon_##operation

enum { LANES = PEL_ROW_LANES_NEON };

/* ---- More words of x86 --------------------------------------------------------------------- */

INLINE vec neon_subs_epu16(vec a, vec b)
{
    return of_u16(vqsubq_u16(as_u16(a), as_u16(b)));
}

INLINE vec neon_sub_epi32(vec a, vec b)
{
    return of_u32(vsubq_u32(as_u32(a), as_u32(b)));
}

INLINE vec neon_cmpgt_epi32(vec a, vec b)
{
    return of_u32(vcgtq_s32(as_s32(a), as_s32(b)));
}

INLINE vec neon_slli_epi32(vec v, int bits)
{
    return of_u32(as_u32(v) << (uint32_t)bits);
}

INLINE vec neon_srli_epi32(vec v, int bits)
{
    return of_u32(as_u32(v) >> (uint32_t)bits);
}

INLINE vec neon_packs_epi16(vec low, vec high)
{
    return vreinterpretq_u8_s8(vqmovn_high_s16(vqmovn_s16(as_s16(low)), as_s16(high)));
}

/* ---- What the templates leave to the instruction set ---------------------------------------- */

/* Unpacking and packing keep the order. */
INLINE vec ordered(vec v)
{
    return v;
}

INLINE vec packed_order(vec v)
{
    return v;
}

INLINE vec running(vec v)
{
    const vec zero = neon_setzero();
    const vec two = neon_add_epi32(v, vextq_u8(zero, v, 12));
    return neon_add_epi32(two, vextq_u8(zero, two, 8));
}

INLINE vec running_u16(vec v)
{
    const vec zero = neon_setzero();
    const vec two = neon_add_epi16(v, vextq_u8(zero, v, 14));
    const vec four = neon_add_epi16(two, vextq_u8(zero, two, 12));
    return neon_add_epi16(four, vextq_u8(zero, four, 8));
}

INLINE vec last_of(vec v)
{
    return of_u32(vdupq_laneq_u32(as_u32(v), 3));
}

INLINE vec last_of_u16(vec v)
{
    return of_u32(vdupq_n_u32(vgetq_lane_u16(as_u16(v), 7)));
}

INLINE uint32_t first_of(vec v)
{
    return vgetq_lane_u32(as_u32(v), 0);
}

INLINE vec pair_sums(vec v)
{
    return of_u16(vpaddlq_u8(v));
}

INLINE vec pair_sums_u16(vec v)
{
    return of_u32(vpaddlq_u16(as_u16(v)));
}

INLINE vec shuffled(vec v, vec places)
{
    return vqtbl1q_u8(v, places);
}

INLINE void store_half(uint8_t *bytes, vec v)
{
    vst1_u8(bytes, vget_low_u8(v));
}

INLINE int is_zero(vec v)
{
    return vmaxvq_u8(v) == 0;
}

#include "row/row_point_template.h"
#include "row/row_point_map_template.h"
#include "row/row_point_area_template.h"
#include "row/row_point_bilinear_template.h"
#include "row/row_point_resize_template.h"

/* ---- Tables -------------------------------------------------------------------------------- */

/* Four quarters of the table; where a value is of none of those looked at, it stays as it was. */
#define MAPPED(v)                                                                                  \
    vqtbx4q_u8(vqtbx4q_u8(vqtbx4q_u8(vqtbl4q_u8(first, v), second, vsubq_u8(v, quarter)), third,   \
                          vsubq_u8(v, half)),                                                      \
               fourth, vsubq_u8(v, vaddq_u8(quarter, half)))

void pel_row_map_neon(const uint8_t *src, uint16_t count, const uint8_t *table, uint8_t *dst)
{
    const uint8x16x4_t first = vld1q_u8_x4(table), second = vld1q_u8_x4(table + 64);
    const uint8x16x4_t third = vld1q_u8_x4(table + 128), fourth = vld1q_u8_x4(table + 192);
    const vec quarter = vdupq_n_u8(64), half = vdupq_n_u8(128);
    const int end = count - LANES;
    const vec last_in = load(src + end), last = MAPPED(last_in);

    for (int x = 0; x < end; x += LANES) {
        const vec v = load(src + x);
        store(dst + x, MAPPED(v));
    }
    store(dst + end, last);
}

#else
typedef int nothing_here; /* an empty file is no C */
#endif
