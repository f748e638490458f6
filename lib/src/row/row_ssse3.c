/* Row kernels from pixels to runs for x86 with SSSE3: 16 pixels at a time. */
#include "row/row_x86.h"

#if defined(PEL_ROW_X86)
#include <immintrin.h>

#define ISA __attribute__((target("ssse3")))
#define INLINE __attribute__((target("ssse3"), always_inline)) static inline
#define KERNEL(name) pel_row_##name##_ssse3
#define V(operation) _mm_##operation
#define BITS(operation) _mm_##operation##_si128
#define MOVED(last, here, n) _mm_alignr_epi8(here, last, 16 - (n))

enum { LANES = 16, WORD = 16 };
typedef __m128i vec;
typedef __m128i_u loose_vec;

INLINE vec everywhere(__m128i bytes)
{
    return bytes;
}

/* Packing and unpacking keep the order. */
INLINE vec from_packed(vec bytes)
{
    return bytes;
}

INLINE vec to_doubled(vec bytes)
{
    return bytes;
}

INLINE int is_zero(vec bytes)
{
    return _mm_movemask_epi8(_mm_cmpeq_epi8(bytes, _mm_setzero_si128())) == 0xFFFF;
}

INLINE int both_same(vec a, vec b, vec c, vec d)
{
    return _mm_movemask_epi8(_mm_and_si128(_mm_cmpeq_epi8(a, b), _mm_cmpeq_epi8(c, d))) == 0xFFFF;
}

/* Two bits for each of the pixels: there a run ends, there one begins. */
INLINE uint64_t edge_bits(vec before, vec here, int from)
{
    const vec zero = _mm_setzero_si128(), same = _mm_cmpeq_epi8(before, here);
    const vec no_end = _mm_or_si128(same, _mm_cmpeq_epi8(before, zero));
    const vec no_begin = _mm_or_si128(same, _mm_cmpeq_epi8(here, zero));
    const uint32_t low = (uint32_t)_mm_movemask_epi8(_mm_unpacklo_epi8(no_end, no_begin));
    const uint32_t high = (uint32_t)_mm_movemask_epi8(_mm_unpackhi_epi8(no_end, no_begin));

    (void)from;
    return (uint32_t) ~(low | high << 16);
}

/* The processor counts trailing zeros, but not those of 0, nor has it a count of bits. */
INLINE unsigned lowest_place(uint64_t bits)
{
    return (unsigned)__builtin_ctzll(bits | UINT64_C(1) << 63);
}

/* In pairs, fours and eights of bits; then all the sums meet in the top byte. */
INLINE size_t bit_count(uint64_t bits)
{
    const uint64_t ones = ~UINT64_C(0);

    bits -= bits >> 1 & ones / 3;
    bits = (bits & ones / 5) + (bits >> 2 & ones / 5);
    return (size_t)(((bits + (bits >> 4)) & ones / 17) * (ones / 255) >> 56);
}

#include "row/row_classify_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
