/*
 * Which version of a row kernel runs: the one place where backends are told apart. On x86
 * a row narrower than a vector is for the next smaller ones, in the end for plain C.
 */
#ifndef PEL_ROW_SELECT_H
#define PEL_ROW_SELECT_H

#include "pel/backend.h"
#include "row/row.h"
#include "row/row_mve.h"
#include "row/row_neon.h"
#include "row/row_nibbles.h"
#include "row/row_x86.h"

/* The backend of objects that do not choose one: what the compiler's flags promise. Where that is
 * up to the processor, plain C. */
#define PEL_ROW_BUILT_IN PEL_BACKEND_SCALAR

/* What an object keeps of the backend that it is asked for. A choice that the compiler's flags have
 * made costs no code. */
static inline pel_backend pel_i_row_backend(pel_backend wish)
{
#if defined(PEL_ROW_X86) || defined(PEL_ROW_NEON)
    return pel_backend_resolve(wish);
#else
    (void)wish;
    return PEL_ROW_BUILT_IN;
#endif
}

/* nibbles are those of the boxes; not looked at by SCALAR. */
static inline void pel_i_row_classify_pairs(pel_backend backend, const uint8_t *nibbles,
                                            const pel_row_boxes *boxes, const pel_row_pairs *src,
                                            uint16_t count, uint8_t *labels)
{
    pel_row_pairs rest = *src;
    uint16_t done = 0; /* even */

#if defined(PEL_ROW_X86)
    if (backend >= PEL_BACKEND_AVX512 && count >= PEL_ROW_VECTOR_AVX512) {
        done = pel_row_classify_nibbles_avx512(nibbles, src, count, labels);
    }
    if (backend >= PEL_BACKEND_AVX2 && count >= PEL_ROW_VECTOR_AVX2 && done == 0) {
        done = pel_row_classify_nibbles_avx2(nibbles, src, count, labels);
    }
    if (backend >= PEL_BACKEND_SSSE3 && done == 0) {
        done = pel_row_classify_nibbles_ssse3(nibbles, src, count, labels);
    }
#elif defined(PEL_ROW_NEON)
    if (backend == PEL_BACKEND_NEON) {
        done = pel_row_classify_nibbles_neon(nibbles, src, count, labels);
    }
#else
    (void)backend;
    (void)nibbles;
#endif
    if (done < count) {
        rest.y += (size_t)done * src->y_step;
        rest.u += (size_t)(done / 2) * src->c_step;
        rest.v += (size_t)(done / 2) * src->c_step;
        PEL_BEST_CLASSIFY_PAIRS(boxes, &rest, (uint16_t)(count - done), labels + done);
    }
}

#endif
