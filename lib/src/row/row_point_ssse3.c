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

#include "row/row_point_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
