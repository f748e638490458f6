/* Row kernels of corners and edges for x86 with SSSE3: 16 bytes at a time. */
#include "row/row_feature_vectors.h"

#if defined(PEL_ROW_FEATURE_X86)
#include <immintrin.h>

#define ISA __attribute__((target("ssse3")))
#define INLINE __attribute__((target("ssse3"), always_inline)) static inline
#define KERNEL(name) pel_row_##name##_ssse3
#define V(operation) _mm_##operation
#define BITS(operation) _mm_##operation##_si128
#define EQUAL(a, b) _mm_cmpeq_epi8(a, b)
#define ABOVE(a, b) _mm_cmpgt_epi16(a, b)
#define SAME(a, b) _mm_cmpeq_epi16(a, b)
#define MOVED(last, here) _mm_alignr_epi8(here, last, 12)
#define FIRST(v) _mm_cvtepi32_pd(v)
#define SECOND(v) _mm_cvtepi32_pd(_mm_unpackhi_epi64(v, v))
#define JOINED(a, b) _mm_unpacklo_epi64(_mm_cvttpd_epi32(a), _mm_cvttpd_epi32(b))

enum { LANES = PEL_ROW_FEATURE_SSSE3 };
typedef __m128i vec;
typedef __m128i_u loose_vec;
typedef __m128d doubles;

INLINE vec lower_and_upper(vec a, vec b, vec lower)
{
    return _mm_or_si128(_mm_and_si128(a, lower), _mm_andnot_si128(lower, b));
}
#define LOWER_UPPER_16(a, b) lower_and_upper(a, b, _mm_set1_epi32(0xffff))
#define LOWER_UPPER_32(a, b) lower_and_upper(a, b, _mm_srli_epi64(_mm_set1_epi32(-1), 32))

INLINE vec wide(const uint8_t *p)
{
    return _mm_unpacklo_epi8(_mm_loadl_epi64((const __m128i_u *)(const void *)p),
                             _mm_setzero_si128());
}

INLINE vec wide_rise(const uint8_t *p, const uint8_t *q)
{
    return _mm_sub_epi16(wide(q), wide(p));
}

INLINE int any(vec bytes)
{
    return _mm_movemask_epi8(_mm_cmpeq_epi8(bytes, _mm_setzero_si128())) != 0xffff;
}

INLINE void store_part(void *out, vec value)
{
    _mm_storeu_si128((__m128i_u *)out, value);
}

INLINE void store_pairs(int32_t *out, vec a, vec b)
{
    store_part(out, _mm_unpacklo_epi32(a, b));
    store_part(out + 4, _mm_unpackhi_epi32(a, b));
}

INLINE void store_wide(int32_t *out, vec bytes)
{
    const vec zero = _mm_setzero_si128();
    const vec low = _mm_unpacklo_epi8(bytes, zero), high = _mm_unpackhi_epi8(bytes, zero);
    store_part(out, _mm_unpacklo_epi16(low, zero));
    store_part(out + 4, _mm_unpackhi_epi16(low, zero));
    store_part(out + 8, _mm_unpacklo_epi16(high, zero));
    store_part(out + 12, _mm_unpackhi_epi16(high, zero));
}

INLINE void store_edges(uint8_t *out, vec edge, vec sure)
{
    const vec weak = _mm_and_si128(_mm_packs_epi16(edge, edge), _mm_set1_epi8(-128));
    _mm_storel_epi64((__m128i_u *)(void *)out, _mm_or_si128(weak, _mm_packs_epi16(sure, sure)));
}

#include "row/row_feature_template.h"
#include "row/row_feature_tensor_template.h"

#define ABOVE_32(a, b) _mm_cmpgt_epi32(a, b)

enum { FOURS = LANES / 4 };

INLINE int first_of(vec v)
{
    const int found = _mm_movemask_ps(_mm_castsi128_ps(v));
    return found ? __builtin_ctz((unsigned)found) : FOURS;
}

#include "row/row_feature_top_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
