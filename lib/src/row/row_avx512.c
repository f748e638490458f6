/* Row kernels from pixels to runs for x86 with AVX-512: 64 pixels at a time. */
#include "row/row_x86.h"

#if defined(PEL_ROW_X86)
#include <immintrin.h>

#define FEATURES "avx512f,avx512bw,avx512vl,avx512vbmi,bmi,bmi2,popcnt"
#define ISA __attribute__((target(FEATURES)))
#define INLINE __attribute__((target(FEATURES), always_inline)) static inline
#define KERNEL(name) pel_row_##name##_avx512
#define V(operation) _mm512_##operation
#define BITS(operation) _mm512_##operation##_si512
#define MOVED(last, here, n) _mm512_alignr_epi8(here, _mm512_alignr_epi64(here, last, 6), 16 - (n))

enum { LANES = 64, WORD = 32 };
typedef __m512i vec;
typedef __m512i_u loose_vec;

/* 16 bytes in every 16 of a vector. */
INLINE vec everywhere(__m128i bytes)
{
    return _mm512_broadcast_i32x4(bytes);
}

/* Packing a and b leaves eight bytes of a, eight of b, and so on: into the order of a b. */
INLINE vec from_packed(vec bytes)
{
    return _mm512_permutexvar_epi64(_mm512_setr_epi64(0, 2, 4, 6, 1, 3, 5, 7), bytes);
}

/* Bytes in order so that unpacking gives 0 .. 31, each twice, and 32 .. 63. */
INLINE vec to_doubled(vec bytes)
{
    return _mm512_permutexvar_epi64(_mm512_setr_epi64(0, 4, 1, 5, 2, 6, 3, 7), bytes);
}

INLINE int is_zero(vec bytes)
{
    return _mm512_test_epi8_mask(bytes, bytes) == 0;
}

INLINE int both_same(vec a, vec b, vec c, vec d)
{
    return is_zero(_mm512_or_si512(_mm512_xor_si512(a, b), _mm512_xor_si512(c, d)));
}

/* Two bits for each of 32 pixels from `from` on: there a run ends, there one begins. */
INLINE uint64_t edge_bits(vec before, vec here, int from)
{
    const __mmask64 change = _mm512_cmpneq_epi8_mask(before, here);
    const uint64_t ends = change & _mm512_test_epi8_mask(before, before);
    const uint64_t begins = change & _mm512_test_epi8_mask(here, here);

    return _pdep_u64(ends >> from, UINT64_C(0x5555555555555555)) |
           _pdep_u64(begins >> from, UINT64_C(0xAAAAAAAAAAAAAAAA));
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
