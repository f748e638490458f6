/*
 * Which instructions the inner loops are made of.
 *
 * Every row kernel exists in plain C; some exist again for instruction sets that work on many
 * pixels at once. Results do not depend on the choice, bit for bit; time does. An object chooses
 * once, when it begins, from what its config says (0 = the best that the processor has), and keeps
 * the choice: nothing global.
 *
 * On x86 the choice is made at run time; NEON is part of every AArch64. On Cortex-M there is
 * nothing to choose: what the compiler's flags promise (DSP on Armv7E-M, Helium on cores such as
 * the Cortex-M55) is compiled in place of the plain loops unless it optimises for size, and the
 * object says SCALAR, whose results it gives.
 */
#ifndef PEL_BACKEND_H
#define PEL_BACKEND_H

#ifdef __cplusplus
extern "C" {
#endif

typedef enum pel_backend {
    PEL_BACKEND_AUTO = 0, /* the best that there is */
    PEL_BACKEND_SCALAR,   /* plain C */
    PEL_BACKEND_SSSE3,    /* x86, 16 bytes at a time */
    PEL_BACKEND_AVX2,     /* x86, 32 bytes */
    PEL_BACKEND_AVX512,   /* x86 with AVX-512 VBMI2, 64 bytes */
    PEL_BACKEND_NEON,     /* AArch64, 16 bytes */
    PEL_BACKEND_DSP,      /* Armv7E-M (Cortex-M4, M7, M33), 4 bytes; compiled in, see above */
    PEL_BACKEND_MVE,      /* Armv8.1-M with Helium (Cortex-M55), 16 bytes; likewise */
    PEL_BACKEND_COUNT
} pel_backend;

/* "auto", "scalar", "ssse3", "avx2", "avx512", "neon", "dsp", "mve"; NULL for a value that is none.
 * Static text. */
const char *pel_backend_name(pel_backend backend);

/* 1 if an object can choose the backend: this build holds it and this processor can run it. AUTO
 * and SCALAR: always 1; DSP and MVE: never. */
int pel_backend_available(pel_backend backend);

/* What a wish becomes: AUTO the best available, one that is not available SCALAR, others
 * themselves. */
pel_backend pel_backend_resolve(pel_backend wish);

#ifdef __cplusplus
}
#endif

#endif
