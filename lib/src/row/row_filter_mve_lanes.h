/* What the files of row kernels of neighbourhoods for Helium (MVE) have in common. */
#ifndef PEL_ROW_FILTER_MVE_LANES_H
#define PEL_ROW_FILTER_MVE_LANES_H

#include "row/row_filter_mve.h"

#if PEL_ROW_MVE
#include <arm_mve.h>

enum { WORDS = 8, BYTES = 16 };

static inline int16x8_t with_sign(uint16x8_t lanes)
{
    return vreinterpretq_s16_u16(lanes);
}

static inline uint16x8_t without_sign(int16x8_t lanes)
{
    return vreinterpretq_u16_s16(lanes);
}

/* Rows further to the right. */
typedef struct window {
    const uint8_t *rows[5];
} window;

static inline window window_at(const uint8_t *const rows[], unsigned radius, unsigned x)
{
    window w;

    for (unsigned i = 0; i <= 2 * radius; i++) {
        w.rows[i] = rows[i] + x;
    }
    return w;
}

#endif

#endif
