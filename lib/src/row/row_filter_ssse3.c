/* Row kernels of neighbourhoods for x86 with SSSE3: 16 pixels at a time. */
#include "row/row_filter_narrow.h"
#include "row/row_filter_x86.h"

#if defined(PEL_ROW_FILTER_X86)
#include <immintrin.h>

#define ISA __attribute__((target("ssse3")))
#define INLINE __attribute__((target("ssse3"), always_inline)) static inline
#define KERNEL(name) pel_row_##name##_ssse3
#define V(operation) _mm_##operation
#define BITS(operation) _mm_##operation##_si128
#define MOVED(last, here, n) _mm_alignr_epi8(here, last, 16 - (n))
#define EQUAL(a, b) _mm_cmpeq_epi8(a, b)
#define RECIPROCAL(a) _mm_rcp_ps(a)
#define RECIPROCAL_ROOT(a) _mm_rsqrt_ps(a)
#define PACKED(a, b) packed(a, b)
#define XOR3(a, b, c) _mm_xor_si128(_mm_xor_si128(a, b), c)
#define MIN_ELSEWHERE(a, b) _mm_min_epu8(a, b)
#define OTHER(a, b, min) _mm_max_epu8(a, b)

enum { LANES = PEL_ROW_LANES_SSSE3 };
typedef __m128i vec;
typedef __m128i_u loose_vec;

INLINE vec everywhere(__m128i bytes)
{
    return bytes;
}

/* 16 bits each, in the order that unpacking bytes gives. */
typedef struct words {
    vec low, high;
} words;

INLINE void store_half(int16_t *out, __m128i value)
{
    _mm_storeu_si128((__m128i_u *)(void *)out, value);
}

INLINE void store_words(int16_t *out, words results)
{
    store_half(out, results.low);
    store_half(out + 8, results.high);
}

/* 32 bits as 16 without a sign, limited to them; a and b are not negative. */
INLINE vec packed(vec a, vec b)
{
    const vec half = _mm_set1_epi32(32768);
    const vec moved = _mm_packs_epi32(_mm_sub_epi32(a, half), _mm_sub_epi32(b, half));
    return _mm_xor_si128(moved, _mm_set1_epi16(INT16_MIN));
}

#include "row/row_filter_template.h"
#include "row/row_filter_taps_template.h"
#include "row/row_filter_rows_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
