/* Row kernels of point operations for AArch64 with NEON: 16 bytes at a time. */
#include "row/row_neon_words.h"

#if defined(PEL_ROW_NEON)
#define ISA
#define INLINE __attribute__((always_inline)) static inline
#define KERNEL(name) pel_row_##name##_neon
#define V(operation) neon_##operation
#define BITS(operation) neon_##operation

enum { LANES = PEL_ROW_LANES_NEON };

#include "row/row_point_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
