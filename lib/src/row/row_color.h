/*
 * Rows of colours in vectors: what the plain kernels of row.h do one after the other (read pixels,
 * convert them, classify them) in one pass, bit for bit the same. Kernels take any count. What
 * cannot be told exactly in the vectors' arithmetic is left to plain C, a vector of pixels at a
 * time.
 */
#ifndef PEL_ROW_COLOR_H
#define PEL_ROW_COLOR_H

#include "row/row.h"
#include "row/row_neon.h"
#include "row/row_x86.h"

#if defined(PEL_ROW_X86) || defined(PEL_ROW_NEON)
#define PEL_ROW_COLOR 1

typedef enum pel_row_color_kind {
    PEL_ROW_RGB24 = 0, /* pel_row_read_rgb24 reads them, order is `first` */
    PEL_ROW_RGB565,    /* pel_row_read_rgb565, `low` */
    PEL_ROW_BAYER      /* pel_row_read_bayer, `red` */
} pel_row_color_kind;

/* A row of pixels that are not YCbCr. */
typedef struct pel_row_colors {
    const uint8_t *bytes, *odd; /* odd: the second row of a mosaic */
    pel_row_color_kind kind;
    unsigned order;
} pel_row_colors;

/* Where three channels go. step 1: to planes that overlap nothing; 3: the second and the third
 * right behind the first, which may be the source if that is RGB24. */
typedef struct pel_row_places {
    uint8_t *a, *b, *c;
    unsigned step;
} pel_row_places;

/*
 * Linear forms of three channels with 22 bits behind the point: channel i of the result is the sum
 * over j of 256 * high + 3 * low of term[i][j] times (channel j - 128), plus offset[i], cut off,
 * plus 128, limited to 0..255. These coefficients are those of color.h rounded to 2^-22, which
 * makes their sums wrong by less than 128 units: 128 * (|error 0| + |error 1| + |error 2|) + 1/2.
 * An offset holds 1/2 for rounding and 128 units more: where the 14 upper bits of a fraction are
 * all 0, the exact sum may lie on either side of the whole number, and plain C must say. The exact
 * R and B of full range are multiples of 1/500 and 1/250: no doubt there.
 *
 * Largest: 4883779 * 128 + 8460885 * 128 + 12209575 < 2^31.
 */
enum {
    PEL_ROW_FORM_BITS = 22,
    PEL_ROW_FORM_DOUBT = 0x3FFF00 /* a fraction with none of these bits */
};

typedef struct pel_row_form {
    int16_t term[3][3][2]; /* high, low */
    int32_t offset[3];
    uint8_t is_exact[3]; /* no sum comes so near to a whole number that it may be on either side */
} pel_row_form;

#define PEL_ROW_FORM_YCBCR                                                                         \
    {                                                                                              \
        {{{4206, 104}, {8259, 56}, {1603, 93}},                                                    \
         {{-2429, 44}, {-4768, 32}, {7197, -76}},                                                  \
         {{7197, -76}, {-6025, -72}, {-1169, -108}}},                                              \
            {-6587397, 2097280, 2097280},                                                          \
        {                                                                                          \
            0, 0, 0                                                                                \
        }                                                                                          \
    }
#define PEL_ROW_FORM_RGB_FULL                                                                      \
    {                                                                                              \
        {{{16384, 0}, {0, 0}, {22971, -54}},                                                       \
         {{16384, 0}, {-5638, -28}, {-11700, -35}},                                                \
         {{16384, 0}, {29033, -47}, {0, 0}}},                                                      \
            {2097280, 2097280, 2097280},                                                           \
        {                                                                                          \
            1, 0, 1                                                                                \
        }                                                                                          \
    }
#define PEL_ROW_FORM_RGB_LIMITED                                                                   \
    {                                                                                              \
        {{{19078, -63}, {0, 0}, {26149, 26}},                                                      \
         {{19078, -63}, {-6418, -54}, {-13320, 29}},                                               \
         {{19078, -63}, {32766, 24263}, {0, 0}}},                                                  \
            {12209575, 12209575, 12209575},                                                        \
        {                                                                                          \
            0, 0, 0                                                                                \
        }                                                                                          \
    }

/*
 * RGB to full-range YCbCr takes 16 bits. With D = G - R and F = G - B:
 *     U = (257 - F + floor(299 D / 886)) >> 1
 *     V = (257 - D + floor(114 F / 701)) >> 1
 *     Y = floor(floor((299 R + 587 G + 114 B + 500) / 8) / 125),
 * 299 = 8 * 37 + 3, 587 = 8 * 73 + 3, 114 = 8 * 14 + 2; the floors of quotients are the upper 16
 * bits of products, exact for all |D|, |F| <= 255 and all sums up to 31937.
 */
enum {
    PEL_ROW_BY_886 = 22117, /* floor(299 D / 886) = D * this >> 16 */
    PEL_ROW_BY_701 = 10658, /* floor(114 F / 701) = F * this >> 16 */
    PEL_ROW_BY_125 = 33555  /* floor(n / 125) = n * this >> 22 */
};

#define PEL_ROW_COLORS(isa)                                                                        \
    void pel_row_colors_to_ycbcr_##isa(const pel_row_colors *src, uint16_t count, int limited,     \
                                       const pel_row_places *dst);                                 \
    void pel_row_colors_to_rgb_##isa(const pel_row_colors *src, uint16_t count, uint8_t *rgb);     \
    void pel_row_pairs_to_planes_##isa(const pel_row_pairs *src, uint16_t count,                   \
                                       const pel_row_places *dst);                                 \
    void pel_row_pairs_to_rgb_##isa(const pel_row_pairs *src, uint16_t count, int limited,         \
                                    uint8_t *rgb);                                                 \
    void pel_row_ycbcr_to_rgb_##isa(const uint8_t *ycbcr, uint16_t count, int limited,             \
                                    uint8_t *rgb);                                                 \
    /* Says how many labels it did, the first ones. labels may be y. */                            \
    uint16_t pel_row_classify_planes_##isa(const uint8_t *nibbles, const uint8_t *y,               \
                                           const uint8_t *u, const uint8_t *v, uint16_t count,     \
                                           uint8_t *labels)

#if defined(PEL_ROW_X86)
PEL_ROW_COLORS(ssse3);
PEL_ROW_COLORS(avx2);

/* A table of four cells or more. Says how many labels it did; labels may be y. */
uint16_t pel_row_classify_lut_avx2(const pel_row_lut *lut, const uint8_t *y, const uint8_t *u,
                                   const uint8_t *v, uint16_t count, uint8_t *labels);
#else
PEL_ROW_COLORS(neon);
#endif

#endif

#endif
