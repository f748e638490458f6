/* Rows of colours for x86 with SSSE3: 16 pixels at a time. */
#include "row/row_color.h"

#if defined(PEL_ROW_X86)
#include <immintrin.h>

#define ISA __attribute__((target("ssse3")))
#define INLINE __attribute__((target("ssse3"), always_inline)) static inline
#define APART __attribute__((target("ssse3"), noinline)) static
#define KERNEL(name) pel_row_##name##_ssse3
#define V(operation) _mm_##operation
#define BITS(operation) _mm_##operation##_si128

enum { LANES = 16 };
typedef __m128i vec;
typedef __m128i_u loose_vec;

INLINE vec everywhere(__m128i bytes)
{
    return bytes;
}

/* One place is all there is. */
INLINE vec at_steps(const uint8_t *bytes, size_t step)
{
    (void)step;
    return _mm_loadu_si128((const __m128i_u *)(const void *)bytes);
}

INLINE void put_steps(uint8_t *bytes, size_t step, vec v)
{
    (void)step;
    _mm_storeu_si128((__m128i_u *)(void *)bytes, v);
}

INLINE vec eight_at(const uint8_t *bytes)
{
    return _mm_loadl_epi64((const __m128i_u *)(const void *)bytes);
}

INLINE int is_zero(vec v)
{
    return _mm_movemask_epi8(_mm_cmpeq_epi8(v, _mm_setzero_si128())) == 0xFFFF;
}

INLINE vec clear_in(vec v, vec bits)
{
    return _mm_cmpeq_epi32(_mm_and_si128(v, bits), _mm_setzero_si128());
}

#include "row/row_color_x86_template.h"
#include "row/row_color_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
