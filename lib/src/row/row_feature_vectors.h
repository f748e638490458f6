/*
 * The row kernels of corners and edges that exist in vectors: those of row_feature.h, bit for bit,
 * one name for each instruction set. count is at least the pixels of a step; what does not fill the
 * last step is done twice.
 */
#ifndef PEL_ROW_FEATURE_VECTORS_H
#define PEL_ROW_FEATURE_VECTORS_H

#include "row/row_feature.h"
#include "row/row_neon.h"

#define PEL_ROW_NEXT_TOP(isa)                                                                      \
    uint16_t pel_row_next_top_##isa(const int32_t *const rows[], uint16_t begin, uint16_t end,     \
                                    int32_t threshold, int kind)

#define PEL_ROW_FEATURES(isa)                                                                      \
    void pel_row_harris_##isa(const uint8_t *const rows[], uint16_t count, uint16_t k_q15,         \
                              int32_t *responses);                                                 \
    void pel_row_shi_tomasi_##isa(const uint8_t *const rows[], uint16_t count,                     \
                                  int32_t *responses);                                             \
    void pel_row_fast9_##isa(const uint8_t *const rows[], uint16_t count, int16_t threshold,       \
                             int32_t *responses);                                                  \
    void pel_row_gradient_sector_##isa(const uint8_t *const rows[], uint16_t count,                \
                                       uint16_t *gradients);                                       \
    void pel_row_thin_##isa(const uint16_t *const rows[], uint16_t count, uint16_t low,            \
                            uint16_t high, uint8_t *out)

/* On x86 a step of harris, shi_tomasi, gradient_sector and thin is half a vector of bytes, one of
 * fast9 a whole one. Elsewhere none takes rows shorter than a vector of bytes. */
#if defined(__GNUC__) && defined(__x86_64__)
#define PEL_ROW_FEATURE_X86 1

enum { PEL_ROW_FEATURE_SSSE3 = 16, PEL_ROW_FEATURE_AVX2 = 32, PEL_ROW_FEATURE_AVX512 = 64 };

PEL_ROW_FEATURES(ssse3);
PEL_ROW_FEATURES(avx2);
PEL_ROW_FEATURES(avx512);
PEL_ROW_NEXT_TOP(ssse3);
PEL_ROW_NEXT_TOP(avx2);
#elif defined(PEL_ROW_NEON)
PEL_ROW_FEATURES(neon);
PEL_ROW_NEXT_TOP(neon);
#endif

#endif
