/* Rows of colours for x86 with AVX2: 32 pixels at a time. */
#include "row/row_color.h"

#if defined(PEL_ROW_X86)
#include <immintrin.h>

#define ISA __attribute__((target("avx2")))
#define INLINE __attribute__((target("avx2"), always_inline)) static inline
#define APART __attribute__((target("avx2"), noinline)) static
#define KERNEL(name) pel_row_##name##_avx2
#define NARROWER(name) pel_row_##name##_ssse3
#define V(operation) _mm256_##operation
#define BITS(operation) _mm256_##operation##_si256

enum { LANES = 32 };
typedef __m256i vec;
typedef __m256i_u loose_vec;

INLINE vec everywhere(__m128i bytes)
{
    return _mm256_broadcastsi128_si256(bytes);
}

INLINE vec at_steps(const uint8_t *bytes, size_t step)
{
    const __m128i_u *const low = (const __m128i_u *)(const void *)bytes;
    const __m128i_u *const high = (const __m128i_u *)(const void *)(bytes + step);
    return _mm256_inserti128_si256(_mm256_castsi128_si256(_mm_loadu_si128(low)),
                                   _mm_loadu_si128(high), 1);
}

INLINE void put_steps(uint8_t *bytes, size_t step, vec v)
{
    _mm_storeu_si128((__m128i_u *)(void *)bytes, _mm256_castsi256_si128(v));
    _mm_storeu_si128((__m128i_u *)(void *)(bytes + step), _mm256_extracti128_si256(v, 1));
}

INLINE vec eight_at(const uint8_t *bytes)
{
    const __m128i sixteen = _mm_loadu_si128((const __m128i_u *)(const void *)bytes);
    return _mm256_permute4x64_epi64(_mm256_castsi128_si256(sixteen), 0x50);
}

INLINE int is_zero(vec v)
{
    return _mm256_testz_si256(v, v);
}

INLINE vec clear_in(vec v, vec bits)
{
    return _mm256_cmpeq_epi32(_mm256_and_si256(v, bits), _mm256_setzero_si256());
}

#include "row/row_color_x86_template.h"
#include "row/row_color_template.h"

/* ---- Look-up tables ------------------------------------------------------------------------ */

/* Eight values without their lowest bits, moved up. */
INLINE vec moved_up(const uint8_t *bytes, unsigned drop, unsigned shift)
{
    const vec v = _mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i_u *)(const void *)bytes));
    return _mm256_sll_epi32(_mm256_srl_epi32(v, _mm_cvtsi32_si128((int)drop)),
                            _mm_cvtsi32_si128((int)shift));
}

/* Eight labels of 32 bits. The processor gathers four cells for each: the four to which the cell
 * belongs, so that nothing beyond the table is read. */
INLINE vec eight_labels(const pel_row_lut *lut, const uint8_t *y, const uint8_t *u,
                        const uint8_t *v)
{
    const vec low2 = _mm256_set1_epi32(3);
    const vec u_v =
        _mm256_or_si256(moved_up(u, lut->u_drop, lut->u_shift), moved_up(v, lut->v_drop, 0));
    const vec place = _mm256_or_si256(moved_up(y, lut->y_drop, lut->y_shift), u_v);
    const vec cells = _mm256_i32gather_epi32((const int *)(const void *)lut->cell,
                                             _mm256_andnot_si256(low2, place), 1);
    const vec bits = _mm256_slli_epi32(_mm256_and_si256(place, low2), 3);
    return _mm256_and_si256(_mm256_srlv_epi32(cells, bits), _mm256_set1_epi32(255));
}

ISA uint16_t pel_row_classify_lut_avx2(const pel_row_lut *lut, const uint8_t *y, const uint8_t *u,
                                       const uint8_t *v, uint16_t count, uint8_t *labels)
{
    const vec order = _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7);
    size_t x = 0;

    for (; x + LANES <= count; x += LANES) {
        const vec a = eight_labels(lut, y + x, u + x, v + x);
        const vec b = eight_labels(lut, y + x + 8, u + x + 8, v + x + 8);
        const vec c = eight_labels(lut, y + x + 16, u + x + 16, v + x + 16);
        const vec d = eight_labels(lut, y + x + 24, u + x + 24, v + x + 24);
        const vec bytes = _mm256_packus_epi16(_mm256_packus_epi32(a, b), _mm256_packus_epi32(c, d));
        store(labels + x, _mm256_permutevar8x32_epi32(bytes, order));
    }
    return (uint16_t)x;
}

#else
typedef int nothing_here; /* an empty file is no C */
#endif
