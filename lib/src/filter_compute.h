/* A row of results from the rows around it. Private to filter.c and filter_direct.c. */
#ifndef PEL_FILTER_COMPUTE_H
#define PEL_FILTER_COMPUTE_H

#include "pel/filter.h"
#include "row/row_filter_select.h"

/*
 * How the sum of a kernel becomes a result: `start` makes it positive, 816000 being the largest,
 * and holds the half to be rounded; what it adds to the quotient is taken away again with the bias.
 * start <= 816000 + 3/2 * 32767 * 2^15 < 2^31.
 */
static pel_row_scale pel_i_filter_scale(const pel_kernel *k)
{
    const uint32_t divisor = (uint32_t)(k->divisor == 0 ? 1 : k->divisor) << k->shift;
    const uint32_t more = 816000 / divisor + 1;
    pel_row_scale scale;

    scale.start = more * divisor + divisor / 2;
    scale.flip = k->absolute ? scale.start : 0;
    scale.divisor = k->divisor <= 1 ? 0 : divisor;
    scale.shift = k->shift;
    scale.bias = k->bias - (int32_t)more;
    return scale;
}

static inline void pel_i_filter_compute(const pel_filter_config *c, unsigned radius,
                                        const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    pel_row_scale scale;

    if (c->op) {
        (void)c->op(rows, count, c, out);
        return;
    }
    scale = pel_i_filter_scale(c->kernel);
    if (radius == 1) {
        pel_i_row_kernel3(c->backend, rows, c->kernel->tap, &scale, count, out);
    } else {
        pel_i_row_kernel5(c->backend, rows, c->kernel->tap, &scale, count, out);
    }
}

static inline void pel_i_filter_compute_s16(const pel_filter_config *c, unsigned radius,
                                            const uint8_t *const rows[], uint16_t count,
                                            int16_t *out)
{
    pel_row_scale scale;

    if (c->op_s16) {
        (void)c->op_s16(rows, count, c, out);
        return;
    }
    scale = pel_i_filter_scale(c->kernel);
    if (radius == 1) {
        pel_i_row_kernel3_s16(c->backend, rows, c->kernel->tap, &scale, count, out);
    } else {
        pel_i_row_kernel5_s16(c->backend, rows, c->kernel->tap, &scale, count, out);
    }
}

#endif
