/* Row kernels from pixels to runs for x86 with SSSE3: 32 pixels at a time. */
#include "row/row_x86.h"

#if defined(PEL_ROW_X86)
#include <immintrin.h>

#define ISA __attribute__((target("ssse3")))
#define INLINE __attribute__((target("ssse3"), always_inline)) static inline
#define APART __attribute__((target("ssse3"), noinline)) static
#define KERNEL(name) pel_row_##name##_ssse3
#define V(operation) _mm_##operation
#define BITS(operation) _mm_##operation##_si128
#define MOVED(last, here) _mm_alignr_epi8(here, last, 15)

enum { LANES = 16 };
typedef __m128i vec;
typedef __m128i_u loose_vec;

INLINE vec everywhere(__m128i bytes)
{
    return bytes;
}

INLINE vec eights(vec bytes)
{
    return bytes;
}

INLINE int are_apart(vec a, vec b)
{
    const vec both = _mm_and_si128(a, b);
    return _mm_movemask_epi8(_mm_cmpeq_epi8(both, _mm_setzero_si128())) == 0xFFFF;
}

INLINE uint64_t equal_bytes(vec a, vec b)
{
    return (uint32_t)_mm_movemask_epi8(_mm_cmpeq_epi8(a, b));
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

#include "row/row_nibbles_template.h"

#include "row/row_pairs_template.h"

INLINE uint64_t put_four_places(uint16_t *edge, uint64_t bits, size_t x);

INLINE void put_many(uint16_t *edge, uint64_t bits, size_t x)
{
    for (; bits != 0; edge += 4) {
        bits = put_four_places(edge, bits, x);
    }
}

#include "row/row_edges_template.h"
#include "row/row_classify_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
