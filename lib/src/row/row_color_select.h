/* Which version of a row kernel of colours runs: a part of row_select.h, see there. */
#ifndef PEL_ROW_COLOR_SELECT_H
#define PEL_ROW_COLOR_SELECT_H

#include "row/row_color.h"
#include "row/row_select.h"

/* Tries the versions of a kernel in vectors: ends the function that says so where one does it. In
 * shorter rows plain C is through before the constants of a version are set up. */
#if defined(PEL_ROW_X86)
enum { PEL_ROW_COLOR_SSSE3 = 16, PEL_ROW_COLOR_AVX2 = 32 };

#define PEL_ROW_TRY_COLOR(name, arguments)                                                         \
    if (backend >= PEL_BACKEND_AVX2 && count >= PEL_ROW_COLOR_AVX2) {                              \
        pel_row_##name##_avx2 arguments;                                                           \
        return 1;                                                                                  \
    }                                                                                              \
    if (backend >= PEL_BACKEND_SSSE3 && count >= PEL_ROW_COLOR_SSSE3) {                            \
        pel_row_##name##_ssse3 arguments;                                                          \
        return 1;                                                                                  \
    }                                                                                              \
    return 0;
#elif defined(PEL_ROW_NEON)
enum { PEL_ROW_COLOR_NEON = 16 };

#define PEL_ROW_TRY_COLOR(name, arguments)                                                         \
    if (backend == PEL_BACKEND_NEON && count >= PEL_ROW_COLOR_NEON) {                              \
        pel_row_##name##_neon arguments;                                                           \
        return 1;                                                                                  \
    }                                                                                              \
    return 0;
#endif

/* Functions that do a whole row, or nothing: 0 where plain C must. */
#if defined(PEL_ROW_COLOR)
static inline int pel_i_row_colors_to_ycbcr(pel_backend backend, const pel_row_colors *src,
                                            uint16_t count, int limited, const pel_row_places *dst)
{
    PEL_ROW_TRY_COLOR(colors_to_ycbcr, (src, count, limited, dst))
}

static inline int pel_i_row_colors_to_rgb(pel_backend backend, const pel_row_colors *src,
                                          uint16_t count, uint8_t *rgb)
{
    PEL_ROW_TRY_COLOR(colors_to_rgb, (src, count, rgb))
}

/* The first of the pixels has an even place. */
static inline int pel_i_row_pairs_to_planes(pel_backend backend, const pel_row_pairs *src,
                                            uint16_t count, const pel_row_places *dst)
{
    PEL_ROW_TRY_COLOR(pairs_to_planes, (src, count, dst))
}

static inline int pel_i_row_pairs_to_rgb(pel_backend backend, const pel_row_pairs *src,
                                         uint16_t count, int limited, uint8_t *rgb)
{
    PEL_ROW_TRY_COLOR(pairs_to_rgb, (src, count, limited, rgb))
}

static inline int pel_i_row_packed_to_rgb(pel_backend backend, const uint8_t *ycbcr, uint16_t count,
                                          int limited, uint8_t *rgb)
{
    PEL_ROW_TRY_COLOR(ycbcr_to_rgb, (ycbcr, count, limited, rgb))
}
#endif

/* Packed pixels of three bytes to packed pixels, which may be the same. */
static inline void pel_i_row_rgb_to_ycbcr(pel_backend backend, const uint8_t *rgb, uint16_t count,
                                          int limited, uint8_t *ycbcr)
{
#if defined(PEL_ROW_COLOR)
    const pel_row_colors src = {rgb, rgb, PEL_ROW_RGB24, 0};
    const pel_row_places dst = {ycbcr, ycbcr + 1, ycbcr + 2, 3};
    if (pel_i_row_colors_to_ycbcr(backend, &src, count, limited, &dst)) {
        return;
    }
#else
    (void)backend;
#endif
    pel_row_rgb_to_ycbcr(rgb, count, limited, ycbcr, ycbcr + 1, ycbcr + 2, 3);
}

static inline void pel_i_row_ycbcr_to_rgb(pel_backend backend, const uint8_t *ycbcr, uint16_t count,
                                          int limited, uint8_t *rgb)
{
#if defined(PEL_ROW_COLOR)
    if (pel_i_row_packed_to_rgb(backend, ycbcr, count, limited, rgb)) {
        return;
    }
#else
    (void)backend;
#endif
    pel_row_ycbcr_to_rgb(ycbcr, ycbcr + 1, ycbcr + 2, 3, count, limited, rgb);
}

/* nibbles are those of the boxes; not looked at by SCALAR. labels may be y. */
static inline void pel_i_row_classify(pel_backend backend, const uint8_t *nibbles,
                                      const pel_row_boxes *boxes, const uint8_t *const yuv[3],
                                      uint16_t count, uint8_t *labels)
{
    const uint8_t *const y = yuv[0], *const u = yuv[1], *const v = yuv[2];
    uint16_t done = 0;

#if defined(PEL_ROW_X86)
    if (backend >= PEL_BACKEND_AVX2 && count >= PEL_ROW_VECTOR_AVX2) {
        done = pel_row_classify_planes_avx2(nibbles, y, u, v, count, labels);
    } else if (backend >= PEL_BACKEND_SSSE3) {
        done = pel_row_classify_planes_ssse3(nibbles, y, u, v, count, labels);
    }
#elif defined(PEL_ROW_NEON)
    if (backend == PEL_BACKEND_NEON) {
        done = pel_row_classify_planes_neon(nibbles, y, u, v, count, labels);
    }
#else
    (void)backend;
    (void)nibbles;
#endif
    pel_row_classify(boxes, y + done, u + done, v + done, (uint16_t)(count - done), labels + done);
}

/* labels may be y. Tables of fewer than four cells are for plain C, as are those of processors that
 * do not gather. */
static inline void pel_i_row_classify_lut(pel_backend backend, const pel_row_lut *lut,
                                          const uint8_t *const yuv[3], uint16_t count,
                                          uint8_t *labels)
{
    const uint8_t *const y = yuv[0], *const u = yuv[1], *const v = yuv[2];
    uint16_t done = 0;

#if defined(PEL_ROW_X86)
    if (backend >= PEL_BACKEND_AVX2 && lut->y_shift + 8 - lut->y_drop >= 2) {
        done = pel_row_classify_lut_avx2(lut, y, u, v, count, labels);
    }
#else
    (void)backend;
#endif
    pel_row_classify_lut(lut, y + done, u + done, v + done, (uint16_t)(count - done),
                         labels + done);
}

#endif
