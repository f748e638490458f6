/* Row kernels of neighbourhoods for x86 with AVX-512 VBMI: 64 pixels at a time. */
#include "row/row_filter_narrow.h"
#include "row/row_filter_x86.h"

#if defined(PEL_ROW_FILTER_X86)
#include <immintrin.h>

#define ISA __attribute__((target("avx512f,avx512bw,avx512vbmi")))
#define INLINE __attribute__((target("avx512f,avx512bw,avx512vbmi"), always_inline)) static inline
#define KERNEL(name) pel_row_##name##_avx512
#define V(operation) _mm512_##operation
#define BITS(operation) _mm512_##operation##_si512
#define MOVED(last, here, n) _mm512_alignr_epi8(here, _mm512_alignr_epi64(here, last, 6), 16 - (n))
#define EQUAL(a, b) _mm512_movm_epi8(_mm512_cmpeq_epi8_mask(a, b))
#define RECIPROCAL(a) _mm512_rcp14_ps(a)
#define RECIPROCAL_ROOT(a) _mm512_rsqrt14_ps(a)
#define PACKED(a, b) _mm512_packus_epi32(a, b)
#define UPPER_BYTES(even, odd)                                                                     \
    _mm512_mask_shuffle_epi8(odd, 0x5555555555555555, even,                                        \
                             everywhere(_mm_set_epi64x(0x0f0f0d0d0b0b0909, 0x0707050503030101)))
#define XOR3(a, b, c) _mm512_ternarylogic_epi32(a, b, c, 0x96)
#define MIN_ELSEWHERE(a, b) _mm512_mask_blend_epi8(_mm512_cmplt_epu8_mask(a, b), b, a)
#define OTHER(a, b, min) XOR3(a, b, min)

enum { LANES = PEL_ROW_LANES_AVX512 };
typedef __m512i vec;
typedef __m512i_u loose_vec;

/* 16 bytes in every 16 of a vector. */
INLINE vec everywhere(__m128i bytes)
{
    return _mm512_broadcast_i32x4(bytes);
}

/* 16 bits each, in the order that unpacking bytes gives: every other eight in each. */
typedef struct words {
    vec low, high;
} words;

INLINE void store_words(int16_t *out, words results)
{
    const vec first = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11);
    const vec second = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
    _mm512_storeu_si512(out, _mm512_permutex2var_epi64(results.low, first, results.high));
    _mm512_storeu_si512(out + 32, _mm512_permutex2var_epi64(results.low, second, results.high));
}

#include "row/row_filter_template.h"
#include "row/row_filter_taps_template.h"
#include "row/row_filter_rows_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
