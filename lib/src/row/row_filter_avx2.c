/* Row kernels of neighbourhoods for x86 with AVX2: 32 pixels at a time. */
#include "row/row_filter_narrow.h"
#include "row/row_filter_x86.h"

#if defined(PEL_ROW_FILTER_X86)
#include <immintrin.h>

#define ISA __attribute__((target("avx2")))
#define INLINE __attribute__((target("avx2"), always_inline)) static inline
#define KERNEL(name) pel_row_##name##_avx2
#define V(operation) _mm256_##operation
#define BITS(operation) _mm256_##operation##_si256
#define MOVED(last, here, n)                                                                       \
    _mm256_alignr_epi8(here, _mm256_permute2x128_si256(last, here, 0x21), 16 - (n))
#define EQUAL(a, b) _mm256_cmpeq_epi8(a, b)
#define RECIPROCAL(a) _mm256_rcp_ps(a)
#define RECIPROCAL_ROOT(a) _mm256_rsqrt_ps(a)
#define PACKED(a, b) _mm256_packus_epi32(a, b)
#define XOR3(a, b, c) _mm256_xor_si256(_mm256_xor_si256(a, b), c)
#define MIN_ELSEWHERE(a, b) _mm256_min_epu8(a, b)
#define OTHER(a, b, min) _mm256_max_epu8(a, b)

enum { LANES = PEL_ROW_LANES_AVX2 };
typedef __m256i vec;
typedef __m256i_u loose_vec;

/* 16 bytes in every 16 of a vector. */
INLINE vec everywhere(__m128i bytes)
{
    return _mm256_broadcastsi128_si256(bytes);
}

/* 16 bits each, in the order that unpacking bytes gives: 0..7 and 16..23, 8..15 and 24..31. */
typedef struct words {
    vec low, high;
} words;

INLINE void store_half(int16_t *out, __m128i value)
{
    _mm_storeu_si128((__m128i_u *)(void *)out, value);
}

/* Halves one by one: they need not be brought together first. */
INLINE void store_words(int16_t *out, words results)
{
    store_half(out, _mm256_castsi256_si128(results.low));
    store_half(out + 8, _mm256_castsi256_si128(results.high));
    store_half(out + 16, _mm256_extracti128_si256(results.low, 1));
    store_half(out + 24, _mm256_extracti128_si256(results.high, 1));
}

#include "row/row_filter_template.h"
#include "row/row_filter_taps_template.h"
#include "row/row_filter_rows_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
