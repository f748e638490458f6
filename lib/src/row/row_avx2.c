/* Row kernels from pixels to runs for x86 with AVX2: 32 pixels at a time. */
#include "row/row_x86.h"

#if defined(PEL_ROW_X86)
#include <immintrin.h>

#define ISA __attribute__((target("avx2,bmi,bmi2,popcnt")))
#define INLINE __attribute__((target("avx2,bmi,bmi2,popcnt"), always_inline)) static inline
#define APART __attribute__((target("avx2,bmi,bmi2,popcnt"), noinline)) static
#define KERNEL(name) pel_row_##name##_avx2
#define V(operation) _mm256_##operation
#define BITS(operation) _mm256_##operation##_si256
#define MOVED(last, here, n)                                                                       \
    _mm256_alignr_epi8(here, _mm256_permute2x128_si256(last, here, 0x21), 16 - (n))

enum { LANES = 32 };
typedef __m256i vec;
typedef __m256i_u loose_vec;

INLINE vec everywhere(__m128i bytes)
{
    return _mm256_broadcastsi128_si256(bytes);
}

INLINE vec in_halves(const uint8_t *low, const uint8_t *high)
{
    const __m128i first = _mm_loadu_si128((const __m128i_u *)(const void *)low);
    const __m128i second = _mm_loadu_si128((const __m128i_u *)(const void *)high);
    return _mm256_inserti128_si256(_mm256_castsi128_si256(first), second, 1);
}

INLINE vec eights(vec bytes)
{
    return _mm256_permute4x64_epi64(bytes, 0xD8);
}

INLINE vec fours(vec bytes)
{
    return _mm256_permutevar8x32_epi32(bytes, _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7));
}

INLINE vec twice(vec bytes)
{
    const __m128i places = _mm_setr_epi8(0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7);
    const __m128i others = _mm_add_epi8(places, _mm_set1_epi8(8));
    return _mm256_shuffle_epi8(bytes,
                               _mm256_inserti128_si256(_mm256_castsi128_si256(places), others, 1));
}

INLINE int are_apart(vec a, vec b)
{
    return _mm256_testz_si256(a, b);
}

INLINE uint64_t equal_bytes(vec a, vec b)
{
    return (uint32_t)_mm256_movemask_epi8(_mm256_cmpeq_epi8(a, b));
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
    return _mm256_inserti128_si256(_mm256_castsi128_si256(u), v, 1);
}

INLINE chroma_tables chroma_tables_of(const uint8_t *nibbles)
{
    const tables t = {table_of(nibbles + PEL_NIBBLES_ABOVE), table_of(nibbles + PEL_NIBBLES_FIRST),
                      table_of(nibbles + PEL_NIBBLES_BELOW), table_of(nibbles + PEL_NIBBLES_FROM),
                      table_of(nibbles + PEL_NIBBLES_TO)};
    return t;
}

INLINE chroma chroma_masks(const chroma_tables *t, vec nibble, vec values)
{
    const vec masks = masks_of(t, nibble, values);
    const chroma c = {masks, _mm256_permute4x64_epi64(masks, 0x4E)};
    return c;
}

#include "row/row_edges_template.h"
#include "row/row_classify_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
