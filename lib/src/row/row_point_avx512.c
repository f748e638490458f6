/*
 * Row kernels of point operations for x86 with AVX-512 VBMI: 64 bytes at a time. Only tables are
 * worth it: a quarter of one is a vector.
 */
#include "row/row_point_x86.h"

#if defined(PEL_ROW_POINT_X86)
#include <immintrin.h>

#define ISA __attribute__((target("avx512f,avx512bw,avx512vbmi")))
#define INLINE __attribute__((target("avx512f,avx512bw,avx512vbmi"), always_inline)) static inline

/* The upper bit of a value says in which half of the table it is. */
INLINE __m512i mapped(const uint8_t *src, const __m512i quarters[4])
{
    const __m512i v = _mm512_loadu_si512(src);
    const __m512i low = _mm512_permutex2var_epi8(quarters[0], v, quarters[1]);
    const __m512i high = _mm512_permutex2var_epi8(quarters[2], v, quarters[3]);
    return _mm512_mask_blend_epi8(_mm512_movepi8_mask(v), low, high);
}

ISA void pel_row_map_avx512(const uint8_t *src, uint16_t count, const uint8_t *table, uint8_t *dst)
{
    const __m512i quarters[4] = {_mm512_loadu_si512(table), _mm512_loadu_si512(table + 64),
                                 _mm512_loadu_si512(table + 128), _mm512_loadu_si512(table + 192)};
    const int end = count - PEL_ROW_POINT_AVX512;
    const __m512i last = mapped(src + end, quarters);

    for (int x = 0; x < end; x += PEL_ROW_POINT_AVX512) {
        _mm512_storeu_si512(dst + x, mapped(src + x, quarters));
    }
    _mm512_storeu_si512(dst + end, last);
}

#else
typedef int nothing_here; /* an empty file is no C */
#endif
