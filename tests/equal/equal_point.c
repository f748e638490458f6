/* The kernels of two rows. */
#include "equal.h"

#include <string.h>

#include "row/row_point_select.h"

/* Into a third row, into the first, or into the second, by the seed. Sources end where their memory
 * ends. */
typedef struct rows {
    const uint8_t *a, *b;
} rows;

static rows rows_of(const equal_run *run)
{
    const size_t last = EQUAL_MARGIN + 3u * run->width;
    rows r = {run->in[0] + last, run->in[1] + last};

    if (run->seed % 3 == 0) {
        memcpy(run->out, r.a, run->width);
        r.a = run->out;
    } else if (run->seed % 3 == 1) {
        memcpy(run->out, r.b, run->width);
        r.b = run->out;
    }
    return r;
}

#define PAIR(name)                                                                                 \
    static size_t name##_rows(pel_backend backend, const equal_run *run)                           \
    {                                                                                              \
        const rows r = rows_of(run);                                                               \
        pel_i_row_##name(backend, r.a, r.b, run->width, run->out);                                 \
        return run->width;                                                                         \
    }

PAIR(add)
PAIR(subtract)
PAIR(absdiff)
PAIR(min)
PAIR(max)
PAIR(and)
PAIR(or)
PAIR(xor)

static size_t blend_rows(pel_backend backend, const equal_run *run)
{
    const rows r = rows_of(run);
    pel_i_row_blend(backend, r.a, r.b, (uint16_t)(run->seed / 3 % 257), run->width, run->out);
    return run->width;
}

const equal_kernel equal_point_kernels[] = {
    {"add", add_rows, 0}, {"subtract", subtract_rows, 0}, {"absdiff", absdiff_rows, 0},
    {"min", min_rows, 0}, {"max", max_rows, 0},           {"and", and_rows, 0},
    {"or", or_rows, 0},   {"xor", xor_rows, 0},           {"blend", blend_rows, 0},
    {NULL, NULL, 0}};
