/* Row kernels of point operations for x86 with AVX2: 32 bytes at a time. */
#include "row/row_point_x86.h"

#if defined(PEL_ROW_POINT_X86)
#include <immintrin.h>

#define ISA __attribute__((target("avx2")))
#define INLINE __attribute__((target("avx2"), always_inline)) static inline
#define KERNEL(name) pel_row_##name##_avx2
#define V(operation) _mm256_##operation
#define BITS(operation) _mm256_##operation##_si256

enum { LANES = PEL_ROW_POINT_AVX2 };
typedef __m256i vec;
typedef __m256i_u loose_vec;

/* ---- What the templates leave to the width of a vector -------------------------------------- */

/* Unpacking and packing work within each half of a vector. */
INLINE vec ordered(vec v)
{
    return _mm256_permute4x64_epi64(v, 0xD8);
}

INLINE vec packed_order(vec v)
{
    return _mm256_permutevar8x32_epi32(v, _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7));
}

/* The last 32 bits of the lower half in all of the upper one, 0 in the lower one. */
INLINE vec carried(vec v)
{
    const vec last = _mm256_shuffle_epi32(v, 0xFF);
    return _mm256_permute2x128_si256(last, last, 0x08);
}

INLINE vec running(vec v)
{
    const vec two = _mm256_add_epi32(v, _mm256_slli_si256(v, 4));
    const vec four = _mm256_add_epi32(two, _mm256_slli_si256(two, 8));
    return _mm256_add_epi32(four, carried(four));
}

INLINE vec running_u16(vec v)
{
    const vec two = _mm256_add_epi16(v, _mm256_slli_si256(v, 2));
    const vec four = _mm256_add_epi16(two, _mm256_slli_si256(two, 4));
    const vec eight = _mm256_add_epi16(four, _mm256_slli_si256(four, 8));
    const vec last = _mm256_shufflehi_epi16(eight, 0xFF);
    return _mm256_add_epi16(eight, carried(last));
}

INLINE vec last_of(vec v)
{
    return _mm256_permutevar8x32_epi32(v, _mm256_set1_epi32(7));
}

INLINE vec last_of_u16(vec v)
{
    return _mm256_srli_epi32(last_of(v), 16);
}

INLINE uint32_t first_of(vec v)
{
    return (uint32_t)_mm_cvtsi128_si32(_mm256_castsi256_si128(v));
}

INLINE vec pair_sums(vec v)
{
    return _mm256_maddubs_epi16(v, _mm256_set1_epi8(1));
}

INLINE vec pair_sums_u16(vec v)
{
    return _mm256_madd_epi16(v, _mm256_set1_epi16(1));
}

INLINE int is_zero(vec v)
{
    return _mm256_testz_si256(v, v);
}

#include "row/row_point_template.h"
#include "row/row_point_map_template.h"
#include "row/row_point_area_template.h"

/* ---- Bilinear means ------------------------------------------------------------------------ */

/*
 * As in row_point_bilinear_template.h, with the eight results in one vector of 32 bits each.
 */
INLINE vec products(__m128i pixels, __m128i pairs, vec weights, vec factor)
{
    const vec words = _mm256_cvtepu8_epi16(_mm_shuffle_epi8(pixels, pairs));
    return _mm256_mullo_epi32(_mm256_madd_epi16(words, weights), factor);
}

INLINE __m128i neighbours_of(vec places, int base)
{
    const vec x = _mm256_and_si256(places, _mm256_set1_epi32(0xFFFF));
    const vec left = _mm256_sub_epi32(x, _mm256_set1_epi32(base));
    const vec both = _mm256_or_si256(left, _mm256_slli_epi32(left, 8));
    const __m128i pairs =
        _mm_packs_epi32(_mm256_castsi256_si128(both), _mm256_extracti128_si256(both, 1));
    return _mm_min_epu8(_mm_add_epi16(pairs, _mm_set1_epi16(0x100)), _mm_set1_epi8(15));
}

INLINE void eight_means(const pel_row_between *rows, const pel_row_place *places, int base,
                        uint8_t *dst)
{
    const vec at = load((const uint8_t *)places);
    const vec left = _mm256_sub_epi32(_mm256_set1_epi32(2048), _mm256_srli_epi32(at, 16));
    const vec weights = _mm256_blend_epi16(left, at, 0xAA);
    const __m128i pairs = neighbours_of(at, base);
    const __m128i upper = _mm_loadu_si128((const __m128i_u *)(const void *)(rows->upper + base));
    const __m128i lower = _mm_loadu_si128((const __m128i_u *)(const void *)(rows->lower + base));
    const vec above = products(upper, pairs, weights, _mm256_set1_epi32(2048 - rows->weight));
    const vec below = products(lower, pairs, weights, _mm256_set1_epi32(rows->weight));
    const vec sum = _mm256_add_epi32(_mm256_add_epi32(above, below), _mm256_set1_epi32(1 << 21));
    const vec means = _mm256_srli_epi32(sum, 22);
    const __m128i words =
        _mm_packs_epi32(_mm256_castsi256_si128(means), _mm256_extracti128_si256(means, 1));
    _mm_storel_epi64((__m128i_u *)(void *)dst, _mm_packus_epi16(words, words));
}

#include "row/row_point_resize_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
