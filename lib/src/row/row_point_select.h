/* Which version of a row kernel of point operations runs: a part of row_select.h, see there. */
#ifndef PEL_ROW_POINT_SELECT_H
#define PEL_ROW_POINT_SELECT_H

#include "row/row_neon.h"
#include "row/row_point_words.h"
#include "row/row_point_x86.h"
#include "row/row_select.h"

/* So many values are worth a look at whether their table is a step. */
enum { PEL_ROW_POINT_STEP = 64 };

/* The versions of a kernel in vectors; rows narrower than one are for the next smaller one. */
#if defined(PEL_ROW_POINT_X86)
#define PEL_ROW_TRY_POINT(name, arguments)                                                         \
    if (backend >= PEL_BACKEND_AVX2 && count >= PEL_ROW_POINT_AVX2) {                              \
        pel_row_##name##_avx2 arguments;                                                           \
        return;                                                                                    \
    }                                                                                              \
    if (backend >= PEL_BACKEND_SSSE3 && count >= PEL_ROW_POINT_SSSE3) {                            \
        pel_row_##name##_ssse3 arguments;                                                          \
        return;                                                                                    \
    }
#elif defined(PEL_ROW_NEON)
#define PEL_ROW_TRY_POINT(name, arguments)                                                         \
    if (backend == PEL_BACKEND_NEON && count >= PEL_ROW_LANES_NEON) {                              \
        pel_row_##name##_neon arguments;                                                           \
        return;                                                                                    \
    }
#else
#define PEL_ROW_TRY_POINT(name, arguments) (void)backend;
#endif

/* pel_i_row_NAME(backend, a, b, count, dst) */
#define PEL_ROW_SELECT_PAIR(name)                                                                  \
    static inline void pel_i_row_##name(pel_backend backend, const uint8_t *a, const uint8_t *b,   \
                                        uint16_t count, uint8_t *dst)                              \
    {                                                                                              \
        PEL_ROW_TRY_POINT(name, (a, b, count, dst))                                                \
        pel_row_##name(a, b, count, dst);                                                          \
    }

PEL_ROW_SELECT_PAIR(add)
PEL_ROW_SELECT_PAIR(subtract)
PEL_ROW_SELECT_PAIR(absdiff)
PEL_ROW_SELECT_PAIR(min)
PEL_ROW_SELECT_PAIR(max)
PEL_ROW_SELECT_PAIR(and)
PEL_ROW_SELECT_PAIR(or)
PEL_ROW_SELECT_PAIR(xor)

static inline void pel_i_row_blend(pel_backend backend, const uint8_t *a, const uint8_t *b,
                                   uint16_t alpha_q8, uint16_t count, uint8_t *dst)
{
    PEL_ROW_TRY_POINT(blend, (a, b, alpha_q8, count, dst))
    pel_row_blend(a, b, alpha_q8, count, dst);
}

/* dst[i] = src[i], of rows that do not overlap. */
static inline void pel_i_row_copy(pel_backend backend, const uint8_t *src, uint16_t count,
                                  uint8_t *dst)
{
    PEL_ROW_TRY_POINT(copy, (src, count, dst))
    for (uint16_t i = 0; i < count; i++) {
        dst[i] = src[i];
    }
}

/* ---- Tables, values ------------------------------------------------------------------------ */

/* Whether a backend has more than plain C: looked at where there is something to prepare. */
static inline int pel_i_row_is_plain(pel_backend backend)
{
#if defined(PEL_ROW_POINT_WORDS)
    return backend <= PEL_BACKEND_SCALAR;
#else
    (void)backend;
    return 1;
#endif
}

/* What there is to know of a table before `count` values are looked up in it. */
static inline pel_row_curve pel_i_row_curve(pel_backend backend, const uint8_t *table,
                                            uint32_t count)
{
    pel_row_curve curve = {table, 0, 0};

#if defined(PEL_ROW_POINT_X86)
    if (backend >= PEL_BACKEND_SSSE3 && count >= PEL_ROW_POINT_STEP) {
        curve.is_step = (uint8_t)pel_row_find_step_ssse3(table, &curve.last_low);
    }
#elif defined(PEL_ROW_NEON)
    if (backend == PEL_BACKEND_NEON && count >= PEL_ROW_POINT_STEP) {
        curve.is_step = (uint8_t)pel_row_find_step_neon(table, &curve.last_low);
    }
#else
    (void)backend;
    (void)count;
#endif
    return curve;
}

static inline void pel_i_row_step(pel_backend backend, const pel_row_curve *curve,
                                  const uint8_t *src, uint16_t count, uint8_t *dst)
{
    PEL_ROW_TRY_POINT(step, (curve, src, count, dst))
    pel_row_map(src, count, curve->table, dst);
}

static inline void pel_i_row_map(pel_backend backend, const pel_row_curve *curve,
                                 const uint8_t *src, uint16_t count, uint8_t *dst)
{
    if (curve->is_step) {
        pel_i_row_step(backend, curve, src, count, dst);
        return;
    }
#if defined(PEL_ROW_POINT_X86)
    if (backend >= PEL_BACKEND_AVX512 && count >= PEL_ROW_POINT_AVX512) {
        pel_row_map_avx512(src, count, curve->table, dst);
        return;
    }
    if (backend >= PEL_BACKEND_SSSE3) {
        pel_row_map_words(src, count, curve->table, dst);
        return;
    }
#elif defined(PEL_ROW_NEON)
    if (backend == PEL_BACKEND_NEON && count >= PEL_ROW_LANES_NEON) {
        pel_row_map_neon(src, count, curve->table, dst);
        return;
    }
#endif
    pel_row_map(src, count, curve->table, dst);
}

static inline void pel_i_row_histogram(pel_backend backend, const uint8_t *src, unsigned step,
                                       uint16_t count, uint32_t *bins)
{
#if defined(PEL_ROW_POINT_WORDS)
    if (!pel_i_row_is_plain(backend) && step == 1) {
        pel_row_histogram_words(src, count, bins);
        return;
    }
#else
    (void)backend;
#endif
    pel_row_histogram(src, step, count, bins);
}

static inline void pel_i_row_gain3(pel_backend backend, const uint8_t *src, uint16_t count,
                                   const uint16_t gains_q8[3], uint8_t *dst)
{
    PEL_ROW_TRY_POINT(gain3, (src, count, gains_q8, dst))
    pel_row_gain3(src, count, gains_q8, dst);
}

/* ---- Sums over areas ----------------------------------------------------------------------- */

static inline void pel_i_row_integral(pel_backend backend, const uint8_t *src, uint16_t count,
                                      const uint32_t *above, uint32_t *sums)
{
    PEL_ROW_TRY_POINT(integral, (src, count, above, sums))
    pel_row_integral(src, count, above, sums);
}

static inline void pel_i_row_columns_add(pel_backend backend, const uint8_t *src, uint16_t count,
                                         uint16_t times, uint16_t *sums)
{
    PEL_ROW_TRY_POINT(columns_add, (src, count, times, sums))
    pel_row_columns_add(src, count, times, sums);
}

static inline void pel_i_row_columns_subtract(pel_backend backend, const uint8_t *src,
                                              uint16_t count, uint16_t *sums)
{
    PEL_ROW_TRY_POINT(columns_subtract, (src, count, sums))
    pel_row_columns_subtract(src, count, sums);
}

static inline void pel_i_row_over_mean(pel_backend backend, const uint8_t *src,
                                       const uint16_t *columns, uint16_t count, uint16_t radius,
                                       int16_t c, uint8_t *dst)
{
#if defined(PEL_ROW_POINT_X86)
    /* Wide vectors leave more to be done one by one between the ends. */
    if (backend > PEL_BACKEND_SSSE3 && count < 4 * PEL_ROW_POINT_AVX2) {
        backend = PEL_BACKEND_SSSE3;
    }
#endif
    PEL_ROW_TRY_POINT(over_mean, (src, columns, count, radius, c, dst))
    pel_row_over_mean(src, columns, count, radius, c, dst);
}

/* ---- Resizing ------------------------------------------------------------------------------ */

static inline void pel_i_row_box_add2(pel_backend backend, const uint8_t *src, uint16_t count,
                                      uint32_t *sums)
{
    PEL_ROW_TRY_POINT(box_add2, (src, count, sums))
    pel_row_box_add(src, 2, 1, count, sums);
}

static inline void pel_i_row_box_add4(pel_backend backend, const uint8_t *src, uint16_t count,
                                      uint32_t *sums)
{
    PEL_ROW_TRY_POINT(box_add4, (src, count, sums))
    pel_row_box_add(src, 4, 1, count, sums);
}

static inline void pel_i_row_box_add(pel_backend backend, const uint8_t *src, uint16_t factor,
                                     uint8_t channels, uint16_t width_out, uint32_t *sums)
{
    if (!pel_i_row_is_plain(backend) && channels == 1 && factor == 2) {
        pel_i_row_box_add2(backend, src, width_out, sums);
    } else if (!pel_i_row_is_plain(backend) && channels == 1 && factor == 4) {
        pel_i_row_box_add4(backend, src, width_out, sums);
    } else {
        pel_row_box_add(src, factor, channels, width_out, sums);
    }
}

static inline void pel_i_row_box_mean(pel_backend backend, const uint32_t *sums, uint32_t area,
                                      uint16_t count, uint8_t *dst)
{
    PEL_ROW_TRY_POINT(box_mean, (sums, area, count, dst))
    pel_row_box_mean(sums, area, count, dst);
}

static inline void pel_i_row_bilinear1(pel_backend backend, const pel_row_between *rows,
                                       const pel_row_place *places, uint16_t count, uint8_t *dst)
{
    PEL_ROW_TRY_POINT(bilinear, (rows, places, count, dst))
    pel_row_bilinear(rows, places, 1, count, dst);
}

static inline void pel_i_row_bilinear(pel_backend backend, const pel_row_between *rows,
                                      const pel_row_place *places, uint8_t channels, uint16_t count,
                                      uint8_t *dst)
{
    if (!pel_i_row_is_plain(backend) && channels == 1 && rows->last >= 15) {
        pel_i_row_bilinear1(backend, rows, places, count, dst);
    } else {
        pel_row_bilinear(rows, places, channels, count, dst);
    }
}

#endif
