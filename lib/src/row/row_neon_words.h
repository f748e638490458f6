/*
 * The words of the row templates in NEON. The templates name an operation as x86 does, by its width
 * and its kind of number: V(add_epi16) is neon_add_epi16 here. A vector is one of bytes between
 * operations; to look at it as something else costs nothing.
 */
#ifndef PEL_ROW_NEON_WORDS_H
#define PEL_ROW_NEON_WORDS_H

#include "row/row_neon.h"

#if defined(PEL_ROW_NEON)
#include <arm_neon.h>

typedef uint8x16_t vec;
typedef uint8_t loose_vec;

/* ---- Views --------------------------------------------------------------------------------- */

static inline int16x8_t as_s16(vec v)
{
    return vreinterpretq_s16_u8(v);
}

static inline uint16x8_t as_u16(vec v)
{
    return vreinterpretq_u16_u8(v);
}

static inline uint32x4_t as_u32(vec v)
{
    return vreinterpretq_u32_u8(v);
}

static inline int32x4_t as_s32(vec v)
{
    return vreinterpretq_s32_u8(v);
}

static inline float32x4_t as_f32(vec v)
{
    return vreinterpretq_f32_u8(v);
}

static inline vec of_s16(int16x8_t v)
{
    return vreinterpretq_u8_s16(v);
}

static inline vec of_u16(uint16x8_t v)
{
    return vreinterpretq_u8_u16(v);
}

static inline vec of_u32(uint32x4_t v)
{
    return vreinterpretq_u8_u32(v);
}

static inline vec of_s32(int32x4_t v)
{
    return vreinterpretq_u8_s32(v);
}

static inline vec of_f32(float32x4_t v)
{
    return vreinterpretq_u8_f32(v);
}

/* ---- Whole vectors ------------------------------------------------------------------------- */

static inline vec neon_loadu(const loose_vec *bytes)
{
    return vld1q_u8(bytes);
}

static inline void neon_storeu(loose_vec *bytes, vec v)
{
    vst1q_u8(bytes, v);
}

static inline vec neon_setzero(void)
{
    return vdupq_n_u8(0);
}

static inline vec neon_and(vec a, vec b)
{
    return vandq_u8(a, b);
}

/* Of b what is not in a. */
static inline vec neon_andnot(vec a, vec b)
{
    return vbicq_u8(b, a);
}

static inline vec neon_or(vec a, vec b)
{
    return vorrq_u8(a, b);
}

static inline vec neon_xor(vec a, vec b)
{
    return veorq_u8(a, b);
}

/* ---- Bytes --------------------------------------------------------------------------------- */

static inline vec neon_set1_epi8(int value)
{
    return vdupq_n_u8((uint8_t)value);
}

static inline vec neon_add_epi8(vec a, vec b)
{
    return vaddq_u8(a, b);
}

static inline vec neon_sub_epi8(vec a, vec b)
{
    return vsubq_u8(a, b);
}

static inline vec neon_adds_epu8(vec a, vec b)
{
    return vqaddq_u8(a, b);
}

static inline vec neon_subs_epu8(vec a, vec b)
{
    return vqsubq_u8(a, b);
}

static inline vec neon_min_epu8(vec a, vec b)
{
    return vminq_u8(a, b);
}

static inline vec neon_max_epu8(vec a, vec b)
{
    return vmaxq_u8(a, b);
}

static inline vec neon_cmpeq_epi8(vec a, vec b)
{
    return vceqq_u8(a, b);
}

static inline vec neon_unpacklo_epi8(vec a, vec b)
{
    return vzip1q_u8(a, b);
}

static inline vec neon_unpackhi_epi8(vec a, vec b)
{
    return vzip2q_u8(a, b);
}

/* ---- 16 bits ------------------------------------------------------------------------------- */

static inline vec neon_set1_epi16(int16_t value)
{
    return of_s16(vdupq_n_s16(value));
}

static inline vec neon_add_epi16(vec a, vec b)
{
    return of_u16(vaddq_u16(as_u16(a), as_u16(b)));
}

static inline vec neon_adds_epi16(vec a, vec b)
{
    return of_s16(vqaddq_s16(as_s16(a), as_s16(b)));
}

static inline vec neon_sub_epi16(vec a, vec b)
{
    return of_u16(vsubq_u16(as_u16(a), as_u16(b)));
}

static inline vec neon_abs_epi16(vec v)
{
    return of_s16(vabsq_s16(as_s16(v)));
}

static inline vec neon_max_epi16(vec a, vec b)
{
    return of_s16(vmaxq_s16(as_s16(a), as_s16(b)));
}

static inline vec neon_mullo_epi16(vec a, vec b)
{
    return of_u16(vmulq_u16(as_u16(a), as_u16(b)));
}

/* The upper halves of the products: every other 16 bits of them. */
static inline vec neon_mulhi_epu16(vec a, vec b)
{
    const uint16x8_t p = as_u16(a), q = as_u16(b);
    const uint32x4_t low = vmull_u16(vget_low_u16(p), vget_low_u16(q));
    const uint32x4_t high = vmull_high_u16(p, q);
    return of_u16(vuzp2q_u16(vreinterpretq_u16_u32(low), vreinterpretq_u16_u32(high)));
}

/* Shifts by a constant: the operators of vectors make the instruction of them that holds it. */
static inline vec neon_slli_epi16(vec v, int bits)
{
    return of_u16(as_u16(v) << (uint16_t)bits);
}

static inline vec neon_srli_epi16(vec v, int bits)
{
    return of_u16(as_u16(v) >> (uint16_t)bits);
}

static inline vec neon_packus_epi16(vec low, vec high)
{
    return vqmovun_high_s16(vqmovun_s16(as_s16(low)), as_s16(high));
}

static inline vec neon_unpacklo_epi16(vec a, vec b)
{
    return of_u16(vzip1q_u16(as_u16(a), as_u16(b)));
}

static inline vec neon_unpackhi_epi16(vec a, vec b)
{
    return of_u16(vzip2q_u16(as_u16(a), as_u16(b)));
}

/* Products of 32 bits, sums of two neighbours. */
static inline vec neon_madd_epi16(vec a, vec b)
{
    const int16x8_t p = as_s16(a), q = as_s16(b);
    return of_s32(vpaddq_s32(vmull_s16(vget_low_s16(p), vget_low_s16(q)), vmull_high_s16(p, q)));
}

/* ---- 32 bits ------------------------------------------------------------------------------- */

static inline vec neon_set1_epi32(int32_t value)
{
    return of_s32(vdupq_n_s32(value));
}

static inline vec neon_add_epi32(vec a, vec b)
{
    return of_u32(vaddq_u32(as_u32(a), as_u32(b)));
}

static inline vec neon_abs_epi32(vec v)
{
    return of_s32(vabsq_s32(as_s32(v)));
}

static inline vec neon_packs_epi32(vec low, vec high)
{
    return of_s16(vqmovn_high_s32(vqmovn_s32(as_s32(low)), as_s32(high)));
}

/* ---- Single precision ---------------------------------------------------------------------- */

static inline vec neon_cvtepi32_ps(vec v)
{
    return of_f32(vcvtq_f32_s32(as_s32(v)));
}

static inline vec neon_cvttps_epi32(vec v)
{
    return of_s32(vcvtq_s32_f32(as_f32(v)));
}

static inline vec neon_sqrt_ps(vec v)
{
    return of_f32(vsqrtq_f32(as_f32(v)));
}

static inline vec neon_div_ps(vec a, vec b)
{
    return of_f32(vdivq_f32(as_f32(a), as_f32(b)));
}

#endif

#endif
