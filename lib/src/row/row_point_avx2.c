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

#include "row/row_point_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
