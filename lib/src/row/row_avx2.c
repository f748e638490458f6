/* Row kernels from pixels to runs for x86 with AVX2: 32 pixels at a time. */
#include "row/row_x86.h"

#if defined(PEL_ROW_X86)
#include <immintrin.h>

#define ISA __attribute__((target("avx2,bmi,bmi2,popcnt")))
#define INLINE __attribute__((target("avx2,bmi,bmi2,popcnt"), always_inline)) static inline
#define KERNEL(name) pel_row_##name##_avx2
#define V(operation) _mm256_##operation
#define BITS(operation) _mm256_##operation##_si256
#define MOVED(last, here, n)                                                                       \
    _mm256_alignr_epi8(here, _mm256_permute2x128_si256(last, here, 0x21), 16 - (n))

enum { LANES = 32, WORD = 32 };
typedef __m256i vec;
typedef __m256i_u loose_vec;

/* 16 bytes in every 16 of a vector. */
INLINE vec everywhere(__m128i bytes)
{
    return _mm256_broadcastsi128_si256(bytes);
}

/* Packing a and b leaves the halves of both, then their other halves: into the order of a b. */
INLINE vec from_packed(vec bytes)
{
    return _mm256_permute4x64_epi64(bytes, 0xD8);
}

/* Bytes in order so that unpacking gives 0 .. 15, each twice, and 16 .. 31. */
INLINE vec to_doubled(vec bytes)
{
    return _mm256_permute4x64_epi64(bytes, 0xD8);
}

INLINE int is_zero(vec bytes)
{
    return _mm256_testz_si256(bytes, bytes);
}

INLINE int both_same(vec a, vec b, vec c, vec d)
{
    return is_zero(_mm256_or_si256(_mm256_xor_si256(a, b), _mm256_xor_si256(c, d)));
}

/* Two bits for each of the pixels: there a run ends, there one begins. */
INLINE uint64_t edge_bits(vec before, vec here, int from)
{
    const vec zero = _mm256_setzero_si256(), same = _mm256_cmpeq_epi8(before, here);
    const vec no_end = from_packed(_mm256_or_si256(same, _mm256_cmpeq_epi8(before, zero)));
    const vec no_begin = from_packed(_mm256_or_si256(same, _mm256_cmpeq_epi8(here, zero)));
    const uint32_t low = (uint32_t)_mm256_movemask_epi8(_mm256_unpacklo_epi8(no_end, no_begin));
    const uint32_t high = (uint32_t)_mm256_movemask_epi8(_mm256_unpackhi_epi8(no_end, no_begin));

    (void)from;
    return ~(low | (uint64_t)high << 32);
}

INLINE unsigned lowest_place(uint64_t bits)
{
    return (unsigned)_tzcnt_u64(bits);
}

INLINE size_t bit_count(uint64_t bits)
{
    return (size_t)_mm_popcnt_u64(bits);
}

#include "row/row_classify_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
