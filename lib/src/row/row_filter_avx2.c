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

enum { LANES = PEL_ROW_LANES_AVX2 };
typedef __m256i vec;
typedef __m256i_u loose_vec;

/* 16 bytes in every 16 of a vector. */
INLINE vec everywhere(__m128i bytes)
{
    return _mm256_broadcastsi128_si256(bytes);
}

/* Words 0..7 and 16..23 in `low`, 8..15 and 24..31 in `high`, as unpacking leaves them. */
INLINE void store_words(int16_t *out, vec low, vec high)
{
    _mm256_storeu_si256((void *)out, _mm256_permute2x128_si256(low, high, 0x20));
    _mm256_storeu_si256((void *)(out + 16), _mm256_permute2x128_si256(low, high, 0x31));
}

#include "row/row_filter_template.h"
#include "row/row_filter_taps_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
