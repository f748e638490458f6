/* Row kernels of corners and edges for AArch64 with NEON: 16 bytes at a time. */
#include "row/row_feature_vectors.h"
#include "row/row_neon_words.h"

#if defined(PEL_ROW_NEON)
#define ISA
#define INLINE __attribute__((always_inline)) static inline
#define KERNEL(name) pel_row_##name##_neon
#define V(operation) neon_##operation
#define BITS(operation) neon_##operation
#define EQUAL(a, b) neon_cmpeq_epi8(a, b)
#define ABOVE(a, b) of_u16(vcgtq_s16(as_s16(a), as_s16(b)))
#define SAME(a, b) of_u16(vceqq_s16(as_s16(a), as_s16(b)))

enum { LANES = PEL_ROW_LANES_NEON };

INLINE vec neon_srai_epi16(vec v, int bits)
{
    return of_s16(as_s16(v) >> (int16_t)bits);
}

INLINE vec wide_rise(const uint8_t *p, const uint8_t *q)
{
    return of_u16(vsubl_u8(vld1_u8(q), vld1_u8(p)));
}

INLINE int any(vec bytes)
{
    return vmaxvq_u8(bytes) != 0;
}

INLINE void store_wide(int32_t *out, vec bytes)
{
    const uint16x8_t low = vmovl_u8(vget_low_u8(bytes)), high = vmovl_high_u8(bytes);
    vst1q_s32(out, vreinterpretq_s32_u32(vmovl_u16(vget_low_u16(low))));
    vst1q_s32(out + 4, vreinterpretq_s32_u32(vmovl_high_u16(low)));
    vst1q_s32(out + 8, vreinterpretq_s32_u32(vmovl_u16(vget_low_u16(high))));
    vst1q_s32(out + 12, vreinterpretq_s32_u32(vmovl_high_u16(high)));
}

INLINE void store_edges(uint8_t *out, vec edge, vec sure)
{
    const uint8x8_t weak = vand_u8(vmovn_u16(as_u16(edge)), vdup_n_u8(PEL_ROW_EDGE_WEAK));
    vst1_u8(out, vorr_u8(weak, vmovn_u16(as_u16(sure))));
}

#include "row/row_feature_template.h"

/* ---- Tops ---------------------------------------------------------------------------------- */

#define ABOVE_32(a, b) of_u32(vcgtq_s32(as_s32(a), as_s32(b)))

enum { FOURS = LANES / 4 };

INLINE int first_of(vec v)
{
    const uint64_t found = vget_lane_u64(vreinterpret_u64_u16(vmovn_u32(as_u32(v))), 0);
    return found ? __builtin_ctzll(found) / 16 : FOURS;
}

#include "row/row_feature_top_template.h"

/* ---- Columns ------------------------------------------------------------------------------- */

/* The even and the odd ones of 16 columns, and what lies to their left and right. */
typedef struct sides {
    uint8x8_t left, own, right;
} sides;

typedef struct line {
    sides even, odd;
} line;

INLINE line line_at(const uint8_t *p)
{
    const uint8x8x2_t before = vld2_u8(p - 1), behind_it = vld2_u8(p + 1);
    const line l = {{before.val[0], before.val[1], behind_it.val[0]},
                    {before.val[1], behind_it.val[0], behind_it.val[1]}};
    return l;
}

/* Sums of eight columns, every other one. */
typedef struct eight {
    int32x4_t low, high;
} eight;

typedef struct eights {
    eight uu, uv, vv;
} eights;

INLINE void add_products(eight *sum, int16x8_t a, int16x8_t b)
{
    sum->low = vmlal_s16(sum->low, vget_low_s16(a), vget_low_s16(b));
    sum->high = vmlal_high_s16(sum->high, a, b);
}

INLINE int16x8_t rise(uint8x8_t p, uint8x8_t q)
{
    return vreinterpretq_s16_u16(vsubl_u8(q, p));
}

INLINE void add_gradients(eights *sums, const sides *a, const sides *b, const sides *c)
{
    const int16x8_t d1 = rise(b->left, b->right), d2 = rise(a->own, c->own);
    const int16x8_t u = vaddq_s16(vaddq_s16(d1, d2), rise(a->left, c->right));
    const int16x8_t v = vaddq_s16(vsubq_s16(d1, d2), rise(c->left, a->right));
    add_products(&sums->uu, u, u);
    add_products(&sums->uv, u, v);
    add_products(&sums->vv, v, v);
}

typedef struct tensors {
    eights even, odd;
} tensors;

INLINE tensors columns_at(const uint8_t *const rows[], int x)
{
    const int32x4_t zero = vdupq_n_s32(0);
    const eights none = {{zero, zero}, {zero, zero}, {zero, zero}};
    tensors t = {none, none};
    line a = line_at(rows[0] + x), b = line_at(rows[1] + x);

    for (int i = 2; i < 5; i++) {
        const line c = line_at(rows[i] + x);
        add_gradients(&t.even, &a.even, &b.even, &c.even);
        add_gradients(&t.odd, &a.odd, &b.odd, &c.odd);
        a = b;
        b = c;
    }
    return t;
}

/* ---- Windows ------------------------------------------------------------------------------- */

/* What the next step needs of the columns of this one: the odd ones, and those with the even ones
 * to their left. */
typedef struct carried {
    int32x4_t both, odd;
} carried;

INLINE eight moved(int32x4_t last, eight here)
{
    const eight m = {vextq_s32(last, here.low, 3), vextq_s32(here.low, here.high, 3)};
    return m;
}

INLINE eight sum_of(eight a, eight b)
{
    const eight s = {vaddq_s32(a.low, b.low), vaddq_s32(a.high, b.high)};
    return s;
}

/* A vector of columns begins one place right of the results: with columns e0 o0 e1 o1 the even one
 * at e0 + o0 + e1, the odd one at o0 + e1 + o1. */
INLINE void make_windows(carried *last, eight *even, eight *odd)
{
    const eight both = sum_of(*even, *odd);
    const carried next = {both.high, odd->high};
    *even = sum_of(moved(last->both, both), *even);
    *odd = sum_of(moved(last->odd, *odd), both);
    *last = next;
}

typedef struct window {
    carried uu, uv, vv;
} window;

INLINE tensors next_windows(const uint8_t *const rows[], int x, window *last)
{
    tensors t = columns_at(rows, x + 1);
    make_windows(&last->uu, &t.even.uu, &t.odd.uu);
    make_windows(&last->uv, &t.even.uv, &t.odd.uv);
    make_windows(&last->vv, &t.even.vv, &t.odd.vv);
    return t;
}

INLINE carried carried_of(int32_t even, int32_t odd)
{
    const carried c = {vdupq_n_s32(even + odd), vdupq_n_s32(odd)};
    return c;
}

/* The two columns before x + 1. */
INLINE window window_before(const uint8_t *const rows[], int x)
{
    const column even = column_at(rows, x - 1), odd = column_at(rows, x);
    const window w = {carried_of(even.uu, odd.uu), carried_of(even.uv, odd.uv),
                      carried_of(even.vv, odd.vv)};
    return w;
}

/* ---- Responses ----------------------------------------------------------------------------- */

/*
 * 2^15 (uu vv - uv^2) - k s^2, a quarter of 2^15 determinant - k trace^2, cut off to bits 27..58,
 * the highest. The powers of two go to the factors: uu 2^8 and vv 2^7 < 2^31. k s < 2^36 would be
 * too much, so s comes in two parts, 2^8 s1 + s0: k s1 < 2^28 and 2^8 s < 2^31.
 */
INLINE int32x2_t harris_half(int32x2_t uu, int32x2_t uv, int32x2_t vv, int32_t k)
{
    const int32x2_t s = vadd_s32(uu, vv);
    const int32x2_t upper = vmul_n_s32(vshr_n_s32(s, 8), k);
    const int32x2_t lower = vmul_n_s32(vand_s32(s, vdup_n_s32(255)), k);
    int64x2_t r = vmull_s32(vshl_n_s32(uu, 8), vshl_n_s32(vv, 7));

    r = vmlsl_s32(r, vshl_n_s32(uv, 8), vshl_n_s32(uv, 7));
    r = vmlsl_s32(r, upper, vshl_n_s32(s, 8));
    return vshrn_n_s64(vmlsl_s32(r, lower, s), 27);
}

INLINE int32x4_t harris_of(int32x4_t uu, int32x4_t uv, int32x4_t vv, int32_t k)
{
    return vcombine_s32(harris_half(vget_low_s32(uu), vget_low_s32(uv), vget_low_s32(vv), k),
                        harris_half(vget_high_s32(uu), vget_high_s32(uv), vget_high_s32(vv), k));
}

INLINE void store_pairs(int32_t *out, int32x4_t even, int32x4_t odd)
{
    vst1q_s32(out, vzip1q_s32(even, odd));
    vst1q_s32(out + 4, vzip2q_s32(even, odd));
}

void pel_row_harris_neon(const uint8_t *const rows[], uint16_t count, uint16_t k_q15,
                         int32_t *responses)
{
    for (int x = 0, end = whole(count, LANES); end != 0;
         x = count - LANES, end = behind(end, count)) {
        window last = window_before(rows, x);
        for (; x < end; x += LANES) {
            const tensors t = next_windows(rows, x, &last);
            const eights *const e = &t.even, *const o = &t.odd;
            store_pairs(responses + x, harris_of(e->uu.low, e->uv.low, e->vv.low, k_q15),
                        harris_of(o->uu.low, o->uv.low, o->vv.low, k_q15));
            store_pairs(responses + x + 8, harris_of(e->uu.high, e->uv.high, e->vv.high, k_q15),
                        harris_of(o->uu.high, o->uv.high, o->vv.high, k_q15));
        }
    }
}

/*
 * s - sqrt((uu - vv)^2 + 4 uv^2), half the trace less half the root, cut off. Under the root there
 * is a whole number < 2^45, so that double precision has it exactly and its root to 2^-30, while a
 * root that is not whole is 2^-24 away from whole numbers.
 */
INLINE int32x2_t smaller_half(int32x2_t s, int32x2_t apart, int32x2_t twice)
{
    const int64x2_t square = vmlal_s32(vmull_s32(apart, apart), twice, twice);
    const float64x2_t root = vsqrtq_f64(vcvtq_f64_s64(square));
    return vmovn_s64(vcvtq_s64_f64(vsubq_f64(vcvtq_f64_s64(vmovl_s32(s)), root)));
}

INLINE int32x4_t shi_tomasi_of(int32x4_t uu, int32x4_t uv, int32x4_t vv)
{
    const int32x4_t s = vaddq_s32(uu, vv), apart = vsubq_s32(uu, vv), twice = vaddq_s32(uv, uv);
    return vcombine_s32(smaller_half(vget_low_s32(s), vget_low_s32(apart), vget_low_s32(twice)),
                        smaller_half(vget_high_s32(s), vget_high_s32(apart), vget_high_s32(twice)));
}

void pel_row_shi_tomasi_neon(const uint8_t *const rows[], uint16_t count, int32_t *responses)
{
    for (int x = 0, end = whole(count, LANES); end != 0;
         x = count - LANES, end = behind(end, count)) {
        window last = window_before(rows, x);
        for (; x < end; x += LANES) {
            const tensors t = next_windows(rows, x, &last);
            const eights *const e = &t.even, *const o = &t.odd;
            store_pairs(responses + x, shi_tomasi_of(e->uu.low, e->uv.low, e->vv.low),
                        shi_tomasi_of(o->uu.low, o->uv.low, o->vv.low));
            store_pairs(responses + x + 8, shi_tomasi_of(e->uu.high, e->uv.high, e->vv.high),
                        shi_tomasi_of(o->uu.high, o->uv.high, o->vv.high));
        }
    }
}

#else
typedef int nothing_here; /* an empty file is no C */
#endif
