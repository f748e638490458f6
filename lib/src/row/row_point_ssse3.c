/* Row kernels of point operations for x86 with SSSE3: 16 bytes at a time. */
#include "row/row_point_x86.h"

#if defined(PEL_ROW_POINT_X86)
#include <immintrin.h>

#define ISA __attribute__((target("ssse3")))
#define INLINE __attribute__((target("ssse3"), always_inline)) static inline
#define KERNEL(name) pel_row_##name##_ssse3
#define V(operation) _mm_##operation
#define BITS(operation) _mm_##operation##_si128

enum { LANES = PEL_ROW_POINT_SSSE3 };
typedef __m128i vec;
typedef __m128i_u loose_vec;

/* ---- What the templates leave to the width of a vector -------------------------------------- */

/* Unpacking and packing keep the order. */
INLINE vec ordered(vec v)
{
    return v;
}

INLINE vec packed_order(vec v)
{
    return v;
}

INLINE vec running(vec v)
{
    const vec two = _mm_add_epi32(v, _mm_slli_si128(v, 4));
    return _mm_add_epi32(two, _mm_slli_si128(two, 8));
}

INLINE vec running_u16(vec v)
{
    const vec two = _mm_add_epi16(v, _mm_slli_si128(v, 2));
    const vec four = _mm_add_epi16(two, _mm_slli_si128(two, 4));
    return _mm_add_epi16(four, _mm_slli_si128(four, 8));
}

INLINE vec last_of(vec v)
{
    return _mm_shuffle_epi32(v, 0xFF);
}

INLINE vec last_of_u16(vec v)
{
    return _mm_srli_epi32(_mm_shuffle_epi32(v, 0xFF), 16);
}

INLINE uint32_t first_of(vec v)
{
    return (uint32_t)_mm_cvtsi128_si32(v);
}

INLINE vec pair_sums(vec v)
{
    return _mm_maddubs_epi16(v, _mm_set1_epi8(1));
}

INLINE vec pair_sums_u16(vec v)
{
    return _mm_madd_epi16(v, _mm_set1_epi16(1));
}

INLINE vec shuffled(vec v, vec places)
{
    return _mm_shuffle_epi8(v, places);
}

INLINE void store_half(uint8_t *bytes, vec v)
{
    _mm_storel_epi64((loose_vec *)(void *)bytes, v);
}

INLINE int is_zero(vec v)
{
    return _mm_movemask_epi8(_mm_cmpeq_epi8(v, _mm_setzero_si128())) == 0xFFFF;
}

#include "row/row_point_template.h"
#include "row/row_point_map_template.h"
#include "row/row_point_area_template.h"
#include "row/row_point_bilinear_template.h"
#include "row/row_point_resize_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
