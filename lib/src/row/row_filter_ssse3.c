/* Row kernels of neighbourhoods for x86 with SSSE3: 16 pixels at a time. */
#include "row/row_filter_narrow.h"
#include "row/row_filter_x86.h"

#if defined(PEL_ROW_FILTER_X86)
#include <immintrin.h>

#define ISA __attribute__((target("ssse3")))
#define INLINE __attribute__((target("ssse3"), always_inline)) static inline
#define KERNEL(name) pel_row_##name##_ssse3
#define V(operation) _mm_##operation
#define BITS(operation) _mm_##operation##_si128

enum { LANES = PEL_ROW_LANES_SSSE3 };
typedef __m128i vec;
typedef __m128i_u loose_vec;

INLINE vec everywhere(__m128i bytes)
{
    return bytes;
}

INLINE void store_words(int16_t *out, vec low, vec high)
{
    _mm_storeu_si128((void *)out, low);
    _mm_storeu_si128((void *)(out + 8), high);
}

#include "row/row_filter_template.h"
#include "row/row_filter_taps_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
