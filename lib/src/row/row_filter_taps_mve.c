/*
 * Row kernels with taps for Helium (MVE): 16 results at a time, in sums of 16 bits. The sums are
 * made in assembly, for compilers keep nine taps in memory. Elsewhere this file is empty.
 */
#include "row/row_filter_mve.h"

#include "row/row_filter_mve_lanes.h"

#if PEL_ROW_MVE
#include "row/row_filter_dsp.h"
#include "row/row_filter_narrow.h"

#define INLINE __attribute__((always_inline)) static inline

/* The outer two taps of a row in one register, and the middle one. */
typedef struct taps3 {
    uint32_t outer;
    int32_t middle;
} taps3;

static taps3 taps_of_row(const int8_t *tap)
{
    taps3 taps;

    taps.outer = (uint32_t)(tap[0] & 0xFFFF) | (uint32_t)tap[2] << 16;
    taps.middle = tap[1];
    return taps;
}

typedef struct sums16 {
    uint16x8_t near, far;
} sums16;

/* To 16 sums modulo 2^16 the taps of a row, which moves on. These loads want a low register. */
INLINE sums16 add_three(sums16 sums, const uint8_t **row, taps3 taps)
{
    uint16x8_t pixels, others;
    uint32_t right;

    __asm__("vldrb.u16 %q[pixels], [%[row], #-1]\n\t"
            "vldrb.u16 %q[others], [%[row], #7]\n\t"
            "vmla.u16 %q[near], %q[pixels], %[left]\n\t"
            "lsr %[right], %[left], #16\n\t"
            "vmla.u16 %q[far], %q[others], %[left]\n\t"
            "vldrb.u16 %q[pixels], [%[row], #1]\n\t"
            "vldrb.u16 %q[others], [%[row], #9]\n\t"
            "vmla.u16 %q[near], %q[pixels], %[right]\n\t"
            "vmla.u16 %q[far], %q[others], %[right]\n\t"
            "vldrb.u16 %q[others], [%[row], #8]\n\t"
            "vldrb.u16 %q[pixels], [%[row]], #16\n\t"
            "vmla.u16 %q[far], %q[others], %[middle]\n\t"
            "vmla.u16 %q[near], %q[pixels], %[middle]"
            : [near] "+t"(sums.near), [far] "+t"(sums.far), [row] "+l"(*row),
              [pixels] "=&t"(pixels), [others] "=&t"(others), [right] "=&r"(right)
            : [left] "r"(taps.outer), [middle] "r"(taps.middle)
            : "memory");
    return sums;
}

/* Taps of a row of five: two in one register, and two, and the middle one. */
typedef struct taps5 {
    uint32_t outer, inner;
    int32_t middle;
} taps5;

static taps5 taps_of_row5(const int8_t *tap)
{
    const taps3 three = taps_of_row(tap + 1);
    taps5 taps;

    taps.outer = (uint32_t)(tap[0] & 0xFFFF) | (uint32_t)tap[4] << 16;
    taps.inner = three.outer;
    taps.middle = three.middle;
    return taps;
}

INLINE sums16 add_five(sums16 sums, const uint8_t *row, taps5 taps)
{
    const taps3 three = {taps.inner, taps.middle};
    uint16x8_t pixels, others;
    uint32_t right;

    __asm__("vldrb.u16 %q[pixels], [%[row], #-2]\n\t"
            "vldrb.u16 %q[others], [%[row], #6]\n\t"
            "vmla.u16 %q[near], %q[pixels], %[left]\n\t"
            "lsr %[right], %[left], #16\n\t"
            "vmla.u16 %q[far], %q[others], %[left]\n\t"
            "vldrb.u16 %q[pixels], [%[row], #2]\n\t"
            "vldrb.u16 %q[others], [%[row], #10]\n\t"
            "vmla.u16 %q[near], %q[pixels], %[right]\n\t"
            "vmla.u16 %q[far], %q[others], %[right]"
            : [near] "+t"(sums.near), [far] "+t"(sums.far), [pixels] "=&t"(pixels),
              [others] "=&t"(others), [right] "=&r"(right)
            : [row] "l"(row), [left] "r"(taps.outer)
            : "memory");
    return add_three(sums, &row, three);
}

/*
 * How sums become results: what row_filter_narrow.h says in fewer steps. Sums begin at `first`;
 * absolute ones begin at 0 and take `add` afterwards. A factor of a power of two is a shift alone,
 * and what is subtracted goes together with the bias or, where nothing is divided, with `add`.
 */
typedef struct finish {
    uint16_t first, add, factor;
    int16_t more;
    int8_t left; /* the shift, negative for one to the right */
    uint8_t absolute;
} finish;

static int finish_of(const int8_t *tap, unsigned radius, const pel_row_scale *scale, finish *f)
{
    pel_row_narrow narrow;
    uint16_t factor;
    int32_t more;

    if (!pel_i_row_narrow(tap, radius, scale, &narrow)) {
        return 0;
    }
    factor = narrow.factor;
    more = factor == 0 ? narrow.bias : (int32_t)narrow.bias - narrow.subtract;
    f->add = factor == 0 ? (uint16_t)(narrow.add - narrow.subtract) : narrow.add;
    f->first = narrow.absolute ? 0 : f->add;
    f->absolute = narrow.absolute;
    f->more = (int16_t)more;
    if ((factor & (factor - 1u)) == 0) {
        f->factor = 0;
        f->left = factor == 0 ? 0 : (int8_t)(__builtin_ctz(factor) - 16);
    } else {
        f->factor = factor;
        f->left = (int8_t)-narrow.shift;
    }
    return more >= -32768;
}

INLINE sums16 results_of(sums16 sums, const finish *f)
{
    if (f->absolute) {
        sums.near = vaddq_n_u16(without_sign(vabsq_s16(with_sign(sums.near))), f->add);
        sums.far = vaddq_n_u16(without_sign(vabsq_s16(with_sign(sums.far))), f->add);
    }
    if (f->factor != 0) {
        sums.near = vmulhq_u16(sums.near, vdupq_n_u16(f->factor));
        sums.far = vmulhq_u16(sums.far, vdupq_n_u16(f->factor));
    }
    sums.near = without_sign(vqaddq_n_s16(with_sign(vshlq_r_u16(sums.near, f->left)), f->more));
    sums.far = without_sign(vqaddq_n_s16(with_sign(vshlq_r_u16(sums.far, f->left)), f->more));
    return sums;
}

/* Results as bytes, limited, or as words; where the next ones go. The second ones first: so
 * compilers move the place along with the other store. */
INLINE void *put_results(void *out, sums16 results, int as_bytes)
{
    if (as_bytes) {
        /* In place, which saves a copy. */
        __asm__("vqmovunb.s16 %q0, %q0" : "+t"(results.near));
        __asm__("vqmovunb.s16 %q0, %q0" : "+t"(results.far));
        vstrbq_u16((uint8_t *)out + WORDS, results.far);
        vstrbq_u16(out, results.near);
        return (uint8_t *)out + BYTES;
    }
    vst1q_s16((int16_t *)out + WORDS, with_sign(results.far));
    vst1q_s16(out, with_sign(results.near));
    return (int16_t *)out + BYTES;
}

INLINE void sum_kernel3(const uint8_t *const rows[], const int8_t *tap, const finish *f,
                        unsigned count, void *out, int as_bytes)
{
    const taps3 upper = taps_of_row(tap), own = taps_of_row(tap + 3), lower = taps_of_row(tap + 6);
    const uint8_t *a = rows[0], *b = rows[1], *c = rows[2];
    const finish copy = *f; /* that out cannot alias */

    for (const uint8_t *const end = a + count; a != end;) {
        sums16 sums = {vdupq_n_u16(copy.first), vdupq_n_u16(copy.first)};
        sums = add_three(sums, &a, upper);
        sums = add_three(sums, &b, own);
        sums = add_three(sums, &c, lower);
        out = put_results(out, results_of(sums, &copy), as_bytes);
    }
}

INLINE void sum_kernel5(const uint8_t *const rows[], const int8_t *tap, const finish *f,
                        unsigned count, void *out, int as_bytes)
{
    const finish copy = *f;
    taps5 taps[5];

    for (unsigned i = 0; i < 5; i++) {
        taps[i] = taps_of_row5(tap + 5 * i);
    }
    for (unsigned x = 0; x < count; x += BYTES) {
        sums16 sums = {vdupq_n_u16(copy.first), vdupq_n_u16(copy.first)};
        for (unsigned i = 0; i < 5; i++) {
            sums = add_five(sums, rows[i] + x, taps[i]);
        }
        out = put_results(out, results_of(sums, &copy), as_bytes);
    }
}

/* Sums that 16 bits do not hold are for `wide`. */
#define KERNEL_WITH_TAPS(name, radius, pixel, wide)                                                \
    static void name(const uint8_t *const rows[], const int8_t *tap, const finish *f,              \
                     unsigned count, pixel *out)                                                   \
    {                                                                                              \
        if ((radius) == 1) {                                                                       \
            sum_kernel3(rows, tap, f, count, out, sizeof(pixel) == 1);                             \
        } else {                                                                                   \
            sum_kernel5(rows, tap, f, count, out, sizeof(pixel) == 1);                             \
        }                                                                                          \
    }                                                                                              \
    void pel_row_##name##_mve(const uint8_t *const rows[], const int8_t *tap,                      \
                              const pel_row_scale *scale, uint16_t count, pixel *out)              \
    {                                                                                              \
        const unsigned rest = count % BYTES, last = count - (unsigned)BYTES;                       \
        finish f;                                                                                  \
        if (count < BYTES || !finish_of(tap, radius, scale, &f)) {                                 \
            wide(rows, tap, scale, count, out);                                                    \
            return;                                                                                \
        }                                                                                          \
        name(rows, tap, &f, count - rest, out);                                                    \
        if (rest != 0) {                                                                           \
            const window at_last = window_at(rows, radius, last);                                  \
            name(at_last.rows, tap, &f, BYTES, out + last);                                        \
        }                                                                                          \
    }

#if PEL_ROW_DSP
#define WIDE_KERNEL3 pel_row_kernel3_dsp
#else
#define WIDE_KERNEL3 pel_row_kernel3
#endif

KERNEL_WITH_TAPS(kernel3, 1, uint8_t, WIDE_KERNEL3)
KERNEL_WITH_TAPS(kernel3_s16, 1, int16_t, pel_row_kernel3_s16)
KERNEL_WITH_TAPS(kernel5, 2, uint8_t, pel_row_kernel5)
KERNEL_WITH_TAPS(kernel5_s16, 2, int16_t, pel_row_kernel5_s16)

#else
typedef int nothing_here; /* an empty file is no C */
#endif
