/* Row kernels from pixels to runs for x86 with AVX-512: 64 pixels at a time. */
#include "row/row_x86.h"

#if defined(PEL_ROW_X86)
#include <immintrin.h>

#define FEATURES "avx512f,avx512bw,avx512vl,avx512vbmi,bmi,bmi2,popcnt"
#define ISA __attribute__((target(FEATURES)))
#define INLINE __attribute__((target(FEATURES), always_inline)) static inline
#define APART __attribute__((target(FEATURES), noinline)) static
#define KERNEL(name) pel_row_##name##_avx512
#define V(operation) _mm512_##operation
#define BITS(operation) _mm512_##operation##_si512
#define MOVED(last, here, n) _mm512_alignr_epi8(here, _mm512_alignr_epi64(here, last, 6), 16 - (n))

enum { LANES = 64 };
typedef __m512i vec;
typedef __m512i_u loose_vec;

INLINE vec everywhere(__m128i bytes)
{
    return _mm512_broadcast_i32x4(bytes);
}

INLINE vec in_halves(const uint8_t *low, const uint8_t *high)
{
    const __m256i first = _mm256_loadu_si256((const __m256i_u *)(const void *)low);
    const __m256i second = _mm256_loadu_si256((const __m256i_u *)(const void *)high);
    return _mm512_inserti64x4(_mm512_castsi256_si512(first), second, 1);
}

INLINE vec eights(vec bytes)
{
    return _mm512_permutexvar_epi64(_mm512_setr_epi64(0, 2, 4, 6, 1, 3, 5, 7), bytes);
}

INLINE vec fours(vec bytes)
{
    const vec places = _mm512_setr_epi32(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15);
    return _mm512_permutexvar_epi32(places, bytes);
}

INLINE vec twice(vec bytes)
{
    const vec words = _mm512_cvtepu8_epi16(_mm512_castsi512_si256(bytes));
    return _mm512_or_si512(words, _mm512_slli_epi16(words, 8));
}

INLINE vec and_halves(vec bytes)
{
    return _mm512_and_si512(bytes, _mm512_shuffle_i64x2(bytes, bytes, 0x4E));
}

INLINE int is_zero(vec bytes)
{
    return _mm512_test_epi8_mask(bytes, bytes) == 0;
}

INLINE uint64_t equal_bytes(vec a, vec b)
{
    return _mm512_cmpeq_epi8_mask(a, b);
}

INLINE unsigned lowest_place(uint64_t bits)
{
    return (unsigned)_tzcnt_u64(bits);
}

INLINE size_t bit_count(uint64_t bits)
{
    return (size_t)_mm_popcnt_u64(bits);
}

#include "row/row_nibbles_template.h"

typedef tables chroma_tables;

/* 16 bytes of U's tables in every 16 of the low half, of V's in the high half. */
INLINE vec table_of(const uint8_t *nibbles)
{
    const __m128i u = load16(nibbles + PEL_NIBBLES_CHANNEL);
    const __m128i v = load16(nibbles + 2 * PEL_NIBBLES_CHANNEL);
    return _mm512_inserti64x4(_mm512_broadcast_i32x4(u), _mm256_broadcastsi128_si256(v), 1);
}

INLINE chroma_tables chroma_tables_of(const uint8_t *nibbles)
{
    const tables t = {table_of(nibbles + PEL_NIBBLES_ABOVE), table_of(nibbles + PEL_NIBBLES_FIRST),
                      table_of(nibbles + PEL_NIBBLES_BELOW), table_of(nibbles + PEL_NIBBLES_FROM),
                      table_of(nibbles + PEL_NIBBLES_TO)};
    return t;
}

INLINE vec chroma_masks(const chroma_tables *t, vec nibble, vec values)
{
    return and_halves(masks_of(t, nibble, values));
}

#include "row/row_classify_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
