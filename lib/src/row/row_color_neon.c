/* Rows of colours for AArch64 with NEON: 16 pixels at a time. */
#include "row/row_color.h"

#if defined(PEL_ROW_NEON)
#include <arm_neon.h>

#define ISA
#define INLINE __attribute__((always_inline)) static inline
#define APART __attribute__((noinline)) static
#define KERNEL(name) pel_row_##name##_neon

enum { LANES = PEL_ROW_LANES_NEON };
typedef uint8x16_t vec;

typedef struct three {
    vec a, b, c;
} three;

INLINE vec load(const uint8_t *bytes)
{
    return vld1q_u8(bytes);
}

INLINE void store(uint8_t *bytes, vec v)
{
    vst1q_u8(bytes, v);
}

INLINE three load3(const uint8_t *bytes)
{
    const uint8x16x3_t v = vld3q_u8(bytes);
    const three t = {v.val[0], v.val[1], v.val[2]};
    return t;
}

INLINE void store3(uint8_t *bytes, three t)
{
    const uint8x16x3_t v = {{t.a, t.b, t.c}};
    vst3q_u8(bytes, v);
}

/* ---- Conversions --------------------------------------------------------------------------- */

/* The upper 16 bits of products. */
INLINE int16x8_t upper_half(int16x8_t v, int16_t factor)
{
    const int32x4_t low = vmull_n_s16(vget_low_s16(v), factor);
    const int32x4_t high = vmull_high_n_s16(v, factor);
    return vuzp2q_s16(vreinterpretq_s16_s32(low), vreinterpretq_s16_s32(high));
}

/* floor(n / 125), n <= 31937. */
INLINE uint8x8_t by_125(uint16x8_t n)
{
    const uint32x4_t low = vmull_n_u16(vget_low_u16(n), PEL_ROW_BY_125);
    const uint32x4_t high = vmull_high_n_u16(n, PEL_ROW_BY_125);
    const uint16x8_t upper = vuzp2q_u16(vreinterpretq_u16_u32(low), vreinterpretq_u16_u32(high));
    return vshrn_n_u16(upper, 6);
}

typedef struct three8 {
    uint8x8_t a, b, c;
} three8;

/* Full range, of 8 pixels; see row_color.h. */
INLINE three8 ycbcr_of_8(uint8x8_t r, uint8x8_t g, uint8x8_t b)
{
    const int16x8_t middle = vdupq_n_s16(257);
    const int16x8_t d = vreinterpretq_s16_u16(vsubl_u8(g, r));
    const int16x8_t f = vreinterpretq_s16_u16(vsubl_u8(g, b));
    const int16x8_t u = vaddq_s16(vsubq_s16(middle, f), upper_half(d, PEL_ROW_BY_886));
    const int16x8_t v = vaddq_s16(vsubq_s16(middle, d), upper_half(f, PEL_ROW_BY_701));
    uint16x8_t rest = vmlal_u8(vdupq_n_u16(500), vdup_n_u8(3), r);
    uint16x8_t whole = vmull_u8(vdup_n_u8(37), r);
    three8 t;

    rest = vmlal_u8(vmlal_u8(rest, vdup_n_u8(3), g), vdup_n_u8(2), b);
    whole = vmlal_u8(vmlal_u8(whole, vdup_n_u8(73), g), vdup_n_u8(14), b);
    t.a = by_125(vsraq_n_u16(whole, rest, 3));
    t.b = vqshrun_n_s16(u, 1);
    t.c = vqshrun_n_s16(v, 1);
    return t;
}

INLINE three full_ycbcr(three rgb)
{
    const three8 low = ycbcr_of_8(vget_low_u8(rgb.a), vget_low_u8(rgb.b), vget_low_u8(rgb.c));
    const three8 high = ycbcr_of_8(vget_high_u8(rgb.a), vget_high_u8(rgb.b), vget_high_u8(rgb.c));
    const three t = {vcombine_u8(low.a, high.a), vcombine_u8(low.b, high.b),
                     vcombine_u8(low.c, high.c)};
    return t;
}

/* Three channels less 128 of 4 pixels. */
typedef struct words {
    int32x4_t a, b, c;
} words;

/* What channel j gives to form i. */
INLINE int32x4_t plus_term(int32x4_t sum, int32x4_t channel, const pel_row_form *form, unsigned i,
                           unsigned j)
{
    const int32_t factor = 256 * form->term[i][j][0] + 3 * form->term[i][j][1];
    return factor == 0 ? sum : vmlaq_n_s32(sum, channel, factor);
}

INLINE int16x4_t form_of(words w, const pel_row_form *form, unsigned i, uint32x4_t *clear)
{
    int32x4_t sum = plus_term(vdupq_n_s32(form->offset[i]), w.a, form, i, 0);
    sum = plus_term(sum, w.b, form, i, 1);
    sum = plus_term(sum, w.c, form, i, 2);
    if (!form->is_exact[i]) {
        *clear = vorrq_u32(*clear, vceqzq_s32(vandq_s32(sum, vdupq_n_s32(PEL_ROW_FORM_DOUBT))));
    }
    return vmovn_s32(vshrq_n_s32(sum, PEL_ROW_FORM_BITS));
}

/* Form i of 8 pixels. */
INLINE int8x8_t form_of_8(const words w[2], const pel_row_form *form, unsigned i, uint32x4_t *clear)
{
    const int16x4_t low = form_of(w[0], form, i, clear), high = form_of(w[1], form, i, clear);
    return vqmovn_s16(vcombine_s16(low, high));
}

INLINE three formed(three channels, const pel_row_form *form, int *doubt)
{
    const uint8x16_t half = vdupq_n_u8(128);
    const int8x16_t a = vreinterpretq_s8_u8(veorq_u8(channels.a, half));
    const int8x16_t b = vreinterpretq_s8_u8(veorq_u8(channels.b, half));
    const int8x16_t c = vreinterpretq_s8_u8(veorq_u8(channels.c, half));
    const int16x8_t a0 = vmovl_s8(vget_low_s8(a)), a1 = vmovl_high_s8(a);
    const int16x8_t b0 = vmovl_s8(vget_low_s8(b)), b1 = vmovl_high_s8(b);
    const int16x8_t c0 = vmovl_s8(vget_low_s8(c)), c1 = vmovl_high_s8(c);
    const words w[4] = {
        {vmovl_s16(vget_low_s16(a0)), vmovl_s16(vget_low_s16(b0)), vmovl_s16(vget_low_s16(c0))},
        {vmovl_high_s16(a0), vmovl_high_s16(b0), vmovl_high_s16(c0)},
        {vmovl_s16(vget_low_s16(a1)), vmovl_s16(vget_low_s16(b1)), vmovl_s16(vget_low_s16(c1))},
        {vmovl_high_s16(a1), vmovl_high_s16(b1), vmovl_high_s16(c1)}};
    uint32x4_t clear = vdupq_n_u32(0);
    vec out[3];

    for (unsigned i = 0; i < 3; i++) {
        const int8x8_t low = form_of_8(w, form, i, &clear);
        const int8x8_t high = form_of_8(w + 2, form, i, &clear);
        out[i] = veorq_u8(vreinterpretq_u8_s8(vcombine_s8(low, high)), half);
    }
    const three t = {out[0], out[1], out[2]};
    *doubt = vmaxvq_u32(clear) != 0;
    return t;
}

/* ---- Pixels of 16 bits, mosaics, pairs ----------------------------------------------------- */

INLINE three rgb565_at(const uint8_t *bytes, unsigned low)
{
    const uint8x16x2_t t = vld2q_u8(bytes);
    const vec lower = low ? t.val[1] : t.val[0], upper = low ? t.val[0] : t.val[1];
    const vec r = vandq_u8(upper, vdupq_n_u8(0xF8)), b = vshlq_n_u8(lower, 3);
    const vec g = vshlq_n_u8(vsriq_n_u8(vshlq_n_u8(upper, 3), lower, 5), 2);
    const three rgb = {vorrq_u8(r, vshrq_n_u8(r, 5)), vorrq_u8(g, vshrq_n_u8(g, 6)),
                       vorrq_u8(b, vshrq_n_u8(b, 5))};
    return rgb;
}

INLINE three bayer_at(const uint8_t *even, const uint8_t *odd, unsigned red)
{
    const uint8x16x2_t over = vld2q_u8(red & 2 ? odd : even);
    const uint8x16x2_t under = vld2q_u8(red & 2 ? even : odd);
    const three swapped = {over.val[1], vrhaddq_u8(over.val[0], under.val[1]), under.val[0]};
    const three t = {over.val[0], vrhaddq_u8(over.val[1], under.val[0]), under.val[1]};
    return red & 1 ? swapped : t;
}

/* U V U V or V U V U: each of the first and of the second kind twice. */
INLINE three with_chroma(vec y, vec u_v, int v_first)
{
    const vec first = vtrn1q_u8(u_v, u_v), second = vtrn2q_u8(u_v, u_v);
    const three t = {y, v_first ? second : first, v_first ? first : second};
    return t;
}

INLINE three pairs_at(const pel_row_pairs *src, size_t x)
{
    const int v_first = src->v < src->u;
    const uint8_t *const c = v_first ? src->v : src->u;

    if (src->y_step == 2) {
        const int y_first = src->y < c;
        const uint8x16x2_t t = vld2q_u8((y_first ? src->y : c) + 2 * x);
        return with_chroma(t.val[y_first ? 0 : 1], t.val[y_first ? 1 : 0], v_first);
    }
    if (src->c_step == 2) {
        return with_chroma(load(src->y + x), load(c + x), v_first);
    }
    if (src->c_step == 1) {
        const uint8x8_t u = vld1_u8(src->u + x / 2), v = vld1_u8(src->v + x / 2);
        const three t = {load(src->y + x), vcombine_u8(vzip1_u8(u, u), vzip2_u8(u, u)),
                         vcombine_u8(vzip1_u8(v, v), vzip2_u8(v, v))};
        return t;
    }
    const three gray = {load(src->y + x), vdupq_n_u8(*src->u), vdupq_n_u8(*src->v)};
    return gray;
}

/* ---- Classes ------------------------------------------------------------------------------- */

/* The nibble tables of a channel; see row_nibbles.h. */
typedef struct tables {
    vec above, rough, below, from, to;
} tables;

INLINE tables tables_of(const uint8_t *nibbles)
{
    const tables t = {load(nibbles + PEL_NIBBLES_ABOVE), load(nibbles + PEL_NIBBLES_ROUGH),
                      load(nibbles + PEL_NIBBLES_BELOW), load(nibbles + PEL_NIBBLES_FROM),
                      load(nibbles + PEL_NIBBLES_TO)};
    return t;
}

INLINE vec class_masks(const tables *t, vec values)
{
    const vec low = vandq_u8(values, vdupq_n_u8(15)), high = vshrq_n_u8(values, 4);
    const vec from = vandq_u8(vqtbl1q_u8(t->rough, high), vqtbl1q_u8(t->from, low));
    const vec to = vorrq_u8(vqtbl1q_u8(t->below, high), vqtbl1q_u8(t->to, low));
    return vandq_u8(vorrq_u8(vqtbl1q_u8(t->above, high), from), to);
}

INLINE vec both(vec a, vec b)
{
    return vandq_u8(a, b);
}

/* The zeros in front of the lowest bit, the byte turned round: 8 where there is none. */
INLINE vec labels_of_masks(vec masks)
{
    static const uint8_t label[16] = {1, 2, 3, 4, 5, 6, 7, 8, 0, 0, 0, 0, 0, 0, 0, 0};
    return vqtbl1q_u8(load(label), vclzq_u8(vrbitq_u8(masks)));
}

INLINE int is_zero(vec v)
{
    return vmaxvq_u32(vreinterpretq_u32_u8(v)) == 0;
}

#include "row/row_color_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
