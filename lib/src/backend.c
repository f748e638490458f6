#include "pel/backend.h"

#include "pel/config.h"

/* Text in arrays, not pointers to text: a table of pointers would be data that needs relocation. */
static const char names[PEL_BACKEND_COUNT][8] = {"auto",   "scalar", "ssse3", "avx2",
                                                 "avx512", "neon",   "dsp",   "mve"};

const char *pel_backend_name(pel_backend backend)
{
    return (unsigned)backend < PEL_BACKEND_COUNT ? names[backend] : NULL;
}

/* ---- What the processor has ---------------------------------------------------------------- */

#if defined(__GNUC__) && defined(__x86_64__)
#include <cpuid.h>

/* Leaf 1 register ecx, leaf 7 register ebx, XCR0: bits as in the processor's manual. */
enum { OSXSAVE = 1 << 27, POPCNT = 1 << 23, BMI1 = 1 << 3, AVX2 = 1 << 5, BMI2 = 1 << 8 };
enum { YMM_STATE = 6 };

/* The register sets that the operating system saves; 0 if it does not say. */
static unsigned saved_state(unsigned leaf1_ecx)
{
    unsigned low = 0, high = 0;

    if (leaf1_ecx & OSXSAVE) {
        __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    }
    (void)high;
    return low;
}

static int has_avx2(void)
{
    const unsigned wanted = BMI1 | AVX2 | BMI2;
    unsigned a, b, c, d, leaf1_ecx;

    return __get_cpuid(1, &a, &b, &leaf1_ecx, &d) && (leaf1_ecx & POPCNT) &&
           (saved_state(leaf1_ecx) & YMM_STATE) == YMM_STATE &&
           __get_cpuid_count(7, 0, &a, &b, &c, &d) && (b & wanted) == wanted;
}
#endif

int pel_backend_available(pel_backend backend)
{
    switch (backend) {
    case PEL_BACKEND_AUTO:
    case PEL_BACKEND_SCALAR:
        return 1;
#if defined(__GNUC__) && defined(__x86_64__)
    case PEL_BACKEND_AVX2:
        return has_avx2();
#endif
    default:
        return 0;
    }
}

pel_backend pel_backend_resolve(pel_backend wish)
{
    if (wish != PEL_BACKEND_AUTO) {
        return (unsigned)wish < PEL_BACKEND_COUNT && pel_backend_available(wish)
                   ? wish
                   : PEL_BACKEND_SCALAR;
    }
    for (unsigned i = PEL_BACKEND_COUNT - 1; i > PEL_BACKEND_SCALAR; i--) {
        if (pel_backend_available((pel_backend)i)) {
            return (pel_backend)i;
        }
    }
    return PEL_BACKEND_SCALAR;
}
