/* Row kernels of corners and edges for x86 with AVX2: 32 bytes at a time. */
#include "row/row_feature_vectors.h"

#if defined(PEL_ROW_FEATURE_X86)
#include <immintrin.h>

#define ISA __attribute__((target("avx2")))
#define INLINE __attribute__((target("avx2"), always_inline)) static inline
#define KERNEL(name) pel_row_##name##_avx2
#define V(operation) _mm256_##operation
#define BITS(operation) _mm256_##operation##_si256
#define EQUAL(a, b) _mm256_cmpeq_epi8(a, b)
#define ABOVE(a, b) _mm256_cmpgt_epi16(a, b)
#define SAME(a, b) _mm256_cmpeq_epi16(a, b)
#define MOVED(last, here)                                                                          \
    _mm256_permutevar8x32_epi32(_mm256_blend_epi32(here, last, 0x80),                              \
                                _mm256_setr_epi32(7, 0, 1, 2, 3, 4, 5, 6))
#define LOWER_UPPER_16(a, b) _mm256_blend_epi16(a, b, 0xaa)
#define LOWER_UPPER_32(a, b) _mm256_blend_epi32(a, b, 0xaa)
#define FIRST(v) _mm256_cvtepi32_pd(_mm256_castsi256_si128(v))
#define SECOND(v) _mm256_cvtepi32_pd(_mm256_extracti128_si256(v, 1))
#define JOINED(a, b)                                                                               \
    _mm256_inserti128_si256(_mm256_castsi128_si256(_mm256_cvttpd_epi32(a)),                        \
                            _mm256_cvttpd_epi32(b), 1)

enum { LANES = PEL_ROW_FEATURE_AVX2 };
typedef __m256i vec;
typedef __m256i_u loose_vec;
typedef __m256d doubles;

INLINE vec wide(const uint8_t *p)
{
    return _mm256_cvtepu8_epi16(_mm_loadu_si128((const __m128i_u *)(const void *)p));
}

INLINE vec wide_rise(const uint8_t *p, const uint8_t *q)
{
    return _mm256_sub_epi16(wide(q), wide(p));
}

INLINE int any(vec bytes)
{
    return !_mm256_testz_si256(bytes, bytes);
}

INLINE void store_part(void *out, vec value)
{
    _mm256_storeu_si256((__m256i_u *)out, value);
}

INLINE void store_pairs(int32_t *out, vec a, vec b)
{
    const vec low = _mm256_unpacklo_epi32(a, b), high = _mm256_unpackhi_epi32(a, b);
    store_part(out, _mm256_permute2x128_si256(low, high, 0x20));
    store_part(out + 8, _mm256_permute2x128_si256(low, high, 0x31));
}

INLINE void store_wide(int32_t *out, vec bytes)
{
    const __m128i low = _mm256_castsi256_si128(bytes), high = _mm256_extracti128_si256(bytes, 1);
    store_part(out, _mm256_cvtepu8_epi32(low));
    store_part(out + 8, _mm256_cvtepu8_epi32(_mm_srli_si128(low, 8)));
    store_part(out + 16, _mm256_cvtepu8_epi32(high));
    store_part(out + 24, _mm256_cvtepu8_epi32(_mm_srli_si128(high, 8)));
}

INLINE void store_edges(uint8_t *out, vec edge, vec sure)
{
    const vec both = _mm256_permute4x64_epi64(_mm256_packs_epi16(edge, sure), 0xd8);
    const __m128i weak = _mm_and_si128(_mm256_castsi256_si128(both), _mm_set1_epi8(-128));
    _mm_storeu_si128((__m128i_u *)(void *)out,
                     _mm_or_si128(weak, _mm256_extracti128_si256(both, 1)));
}

#include "row/row_feature_template.h"
#include "row/row_feature_tensor_template.h"

#define ABOVE_32(a, b) _mm256_cmpgt_epi32(a, b)

enum { FOURS = LANES / 4 };

INLINE int first_of(vec v)
{
    const int found = _mm256_movemask_ps(_mm256_castsi256_ps(v));
    return found ? __builtin_ctz((unsigned)found) : FOURS;
}

#include "row/row_feature_top_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
