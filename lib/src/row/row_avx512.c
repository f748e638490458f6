/* Row kernels from pixels to runs for x86 with AVX-512 VBMI2: 64 pixels at a time. */
#include "row/row_x86.h"

#if defined(PEL_ROW_X86)
#include <immintrin.h>

#define FEATURES "avx512f,avx512bw,avx512vl,avx512vbmi,avx512vbmi2,bmi,bmi2,popcnt"
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

INLINE int are_apart(vec a, vec b)
{
    return _mm512_test_epi8_mask(a, b) == 0;
}

INLINE uint64_t equal_bytes(vec a, vec b)
{
    return _mm512_cmpeq_epi8_mask(a, b);
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

INLINE chroma chroma_masks(const chroma_tables *t, vec nibble, vec values)
{
    const vec masks = masks_of(t, nibble, values);
    const chroma c = {masks, _mm512_shuffle_i64x2(masks, masks, 0x4E)};
    return c;
}

/* The places of the set bits, in order. */
INLINE vec places_of(uint64_t bits)
{
    const vec all = _mm512_setr_epi64(0x0706050403020100, 0x0F0E0D0C0B0A0908, 0x1716151413121110,
                                      0x1F1E1D1C1B1A1918, 0x2726252423222120, 0x2F2E2D2C2B2A2928,
                                      0x3736353433323130, 0x3F3E3D3C3B3A3938);
    return _mm512_maskz_compress_epi8(bits, all);
}

/* As in row_edges_template.h. Ends and begins of runs take turns: the first ones of either kind are
 * written side by side, then the second ones, and so on, 16 pairs at a time. */
INLINE uint16_t *put_edges(uint16_t *edge, uint64_t changes, uint64_t nonzero, uint64_t inside,
                           size_t x)
{
    const uint64_t ends = changes & (nonzero << 1 | inside), begins = changes & nonzero;
    const unsigned count = (unsigned)(_mm_popcnt_u64(ends) + _mm_popcnt_u64(begins));
    vec first = places_of(inside != 0 ? ends : begins);
    vec second = places_of(inside != 0 ? begins : ends);

    for (unsigned done = 0; done < count; done += 32) {
        const vec low = _mm512_cvtepu8_epi32(_mm512_castsi512_si128(first));
        const vec high = _mm512_cvtepu8_epi32(_mm512_castsi512_si128(second));
        const vec places = _mm512_add_epi16(_mm512_or_si512(low, _mm512_slli_epi32(high, 16)),
                                            _mm512_set1_epi16((int16_t)x));
        _mm512_mask_storeu_epi16(edge + done, _bzhi_u32(0xFFFFFFFF, count - done), places);
        first = _mm512_alignr_epi64(first, first, 2);
        second = _mm512_alignr_epi64(second, second, 2);
    }
    return edge + count;
}

#include "row/row_classify_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
