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
/* What the compiler's own start-up code found out, whether the operating system saves the registers
 * included. CPUID itself would take microseconds in a virtual machine, at every begin. */
static int has_avx2(void)
{
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
           __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("popcnt");
}

static int has_avx512(void)
{
    return has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512vbmi") &&
           __builtin_cpu_supports("avx512vbmi2");
}
#endif

int pel_backend_available(pel_backend backend)
{
    switch (backend) {
    case PEL_BACKEND_AUTO:
    case PEL_BACKEND_SCALAR:
        return 1;
#if defined(__GNUC__) && defined(__x86_64__)
    case PEL_BACKEND_SSSE3:
        return __builtin_cpu_supports("ssse3") != 0;
    case PEL_BACKEND_AVX2:
        return has_avx2();
    case PEL_BACKEND_AVX512:
        return has_avx512();
#endif
#if defined(__GNUC__) && defined(__aarch64__) && defined(__ARM_NEON) &&                            \
    __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    case PEL_BACKEND_NEON:
        return 1;
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
