/* Row kernels of corners and edges for x86 with AVX-512: 64 bytes at a time. */
#include "row/row_feature_vectors.h"

#if defined(PEL_ROW_FEATURE_X86)
#include <immintrin.h>

#define ISA __attribute__((target("avx512f,avx512bw")))
#define INLINE __attribute__((target("avx512f,avx512bw"), always_inline)) static inline
#define KERNEL(name) pel_row_##name##_avx512
#define V(operation) _mm512_##operation
#define BITS(operation) _mm512_##operation##_si512
#define EQUAL(a, b) _mm512_movm_epi8(_mm512_cmpeq_epi8_mask(a, b))
#define ABOVE(a, b) _mm512_movm_epi16(_mm512_cmpgt_epi16_mask(a, b))
#define SAME(a, b) _mm512_movm_epi16(_mm512_cmpeq_epi16_mask(a, b))
#define MOVED(last, here) _mm512_alignr_epi32(here, last, 15)
#define LOWER_UPPER_16(a, b) _mm512_mask_blend_epi16(0xaaaaaaaa, a, b)
#define LOWER_UPPER_32(a, b) _mm512_mask_blend_epi32(0xaaaa, a, b)
#define FIRST(v) _mm512_cvtepi32_pd(_mm512_castsi512_si256(v))
#define SECOND(v) _mm512_cvtepi32_pd(_mm512_extracti64x4_epi64(v, 1))
#define JOINED(a, b)                                                                               \
    _mm512_inserti64x4(_mm512_castsi256_si512(_mm512_cvttpd_epi32(a)), _mm512_cvttpd_epi32(b), 1)

enum { LANES = PEL_ROW_FEATURE_AVX512 };
typedef __m512i vec;
typedef __m512i_u loose_vec;
typedef __m512d doubles;

INLINE vec wide(const uint8_t *p)
{
    return _mm512_cvtepu8_epi16(_mm256_loadu_si256((const __m256i_u *)(const void *)p));
}

INLINE vec wide_rise(const uint8_t *p, const uint8_t *q)
{
    return _mm512_sub_epi16(wide(q), wide(p));
}

INLINE int any(vec bytes)
{
    return _mm512_test_epi8_mask(bytes, bytes) != 0;
}

INLINE void store_pairs(int32_t *out, vec a, vec b)
{
    const vec first = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
    const vec second =
        _mm512_setr_epi32(8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
    _mm512_storeu_si512(out, _mm512_permutex2var_epi32(a, first, b));
    _mm512_storeu_si512(out + 16, _mm512_permutex2var_epi32(a, second, b));
}

INLINE void store_wide(int32_t *out, vec bytes)
{
    _mm512_storeu_si512(out, _mm512_cvtepu8_epi32(_mm512_castsi512_si128(bytes)));
    _mm512_storeu_si512(out + 16, _mm512_cvtepu8_epi32(_mm512_extracti32x4_epi32(bytes, 1)));
    _mm512_storeu_si512(out + 32, _mm512_cvtepu8_epi32(_mm512_extracti32x4_epi32(bytes, 2)));
    _mm512_storeu_si512(out + 48, _mm512_cvtepu8_epi32(_mm512_extracti32x4_epi32(bytes, 3)));
}

INLINE void store_edges(uint8_t *out, vec edge, vec sure)
{
    const vec weak = _mm512_and_si512(edge, _mm512_set1_epi16(128));
    _mm256_storeu_si256((__m256i_u *)(void *)out,
                        _mm512_cvtepi16_epi8(_mm512_or_si512(weak, sure)));
}

#include "row/row_feature_template.h"
#include "row/row_feature_tensor_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
