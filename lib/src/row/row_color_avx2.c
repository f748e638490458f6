/* Rows of colours for x86 with AVX2: 32 pixels at a time. */
#include "row/row_color.h"

#if defined(PEL_ROW_X86)
#include <immintrin.h>

#define ISA __attribute__((target("avx2")))
#define INLINE __attribute__((target("avx2"), always_inline)) static inline
#define APART __attribute__((target("avx2"), noinline)) static
#define KERNEL(name) pel_row_##name##_avx2
#define NARROWER(name) pel_row_##name##_ssse3
#define V(operation) _mm256_##operation
#define BITS(operation) _mm256_##operation##_si256

enum { LANES = 32 };
typedef __m256i vec;
typedef __m256i_u loose_vec;

INLINE vec everywhere(__m128i bytes)
{
    return _mm256_broadcastsi128_si256(bytes);
}

INLINE vec at_steps(const uint8_t *bytes, size_t step)
{
    const __m128i_u *const low = (const __m128i_u *)(const void *)bytes;
    const __m128i_u *const high = (const __m128i_u *)(const void *)(bytes + step);
    return _mm256_inserti128_si256(_mm256_castsi128_si256(_mm_loadu_si128(low)),
                                   _mm_loadu_si128(high), 1);
}

INLINE void put_steps(uint8_t *bytes, size_t step, vec v)
{
    _mm_storeu_si128((__m128i_u *)(void *)bytes, _mm256_castsi256_si128(v));
    _mm_storeu_si128((__m128i_u *)(void *)(bytes + step), _mm256_extracti128_si256(v, 1));
}

INLINE vec eight_at(const uint8_t *bytes)
{
    const __m128i sixteen = _mm_loadu_si128((const __m128i_u *)(const void *)bytes);
    return _mm256_permute4x64_epi64(_mm256_castsi128_si256(sixteen), 0x50);
}

INLINE int is_zero(vec v)
{
    return _mm256_testz_si256(v, v);
}

INLINE vec clear_in(vec v, vec bits)
{
    return _mm256_cmpeq_epi32(_mm256_and_si256(v, bits), _mm256_setzero_si256());
}

#include "row/row_color_x86_template.h"
#include "row/row_color_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
