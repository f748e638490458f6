#include "filter_direct.h"

#if defined(PEL_ROW_FILTER_X86)
#include "filter_compute.h"

#define APART __attribute__((noinline)) /* so that a frame of the stack is no sum of all */

/*
 * The results whose neighbours all lie inside are computed row by row from the rows of the picture.
 * The r on either side need pixels that lie nowhere: for these each row has a record of 6r bytes,
 *
 *     r outside, the first 2r, the last 2r, r outside
 *
 * in which the first and the last r results have all their neighbours. Records of rows that follow
 * each other lie side by side, so that one long row of a few dozen records is filtered at once, the
 * rows above and below it being the same memory, records earlier and later.
 */
enum {
    WIDTH_MIN = 96, /* less is not worth it, and leaves too little room for records */
    ROWS_MAX = 16   /* so that the sides of rows are still in the cache when their turn comes */
};

/* The working memory: a row of constants, if the border wants it, then records and results. */
typedef struct direct {
    const pel_filter *filter;
    const pel_cview *src;
    pel_filter_target dst;
    uint8_t *records;
    unsigned rows_max; /* whose records and results fit */
} direct;

/* Row y of the picture, or what stands for it outside. */
static const uint8_t *row_at(const direct *d, int32_t y)
{
    const pel_filter_config *const c = &d->filter->config;
    const int is_inside = (uint32_t)y < c->height;
    const int32_t found = is_inside ? y : pel_border_index(y, c->height, c->border);

    return found < 0 ? c->work : d->src->plane[0] + (ptrdiff_t)found * d->src->stride_bytes[0];
}

static void compute(const direct *d, const uint8_t *const rows[], uint16_t count,
                    const pel_filter_target *to)
{
    const pel_filter *const f = d->filter;

    if (to->bytes) {
        pel_i_filter_compute(&f->config, f->radius, rows, count, to->bytes);
    } else {
        pel_i_filter_compute_s16(&f->config, f->radius, rows, count, to->words);
    }
}

/* ---- Middles ------------------------------------------------------------------------------- */

/* Several rows at once, where there is a kernel for them. */
#define AT_ONCE(op_, kernel)                                                                       \
    if (c->op == (op_)) {                                                                          \
        pel_i_row_##kernel##_rows(c->backend, rows, width, count, to->bytes, to->stride);          \
        return 1;                                                                                  \
    }

APART static void kernel_at_once(const pel_filter_config *c, const uint8_t *const rows[],
                                 uint16_t width, uint16_t count, const pel_filter_target *to)
{
    const pel_row_taps taps = {c->kernel->tap, pel_i_filter_scale(c->kernel)};
    pel_i_row_kernel3_rows(c->backend, rows, &taps, width, count, to->bytes, to->stride);
}

APART static int bytes_at_once(const pel_filter_config *c, const uint8_t *const rows[],
                               uint16_t width, uint16_t count, const pel_filter_target *to)
{
    AT_ONCE(pel_op_gauss3, gauss3)
    AT_ONCE(pel_op_gradient_abs, gradient_abs)
    AT_ONCE(pel_op_gradient, gradient)
    AT_ONCE(pel_op_median, median3)
    AT_ONCE(pel_op_min, min3)
    AT_ONCE(pel_op_max, max3)
    if (!c->op && c->kernel->radius == 1) {
        kernel_at_once(c, rows, width, count, to);
        return 1;
    }
    return 0;
}

APART static int words_at_once(const pel_filter_config *c, const uint8_t *const rows[],
                               uint16_t width, uint16_t count, const pel_filter_target *to)
{
    if (c->op_s16 == pel_op_sobel_x_s16) {
        pel_i_row_sobel_x_rows(c->backend, rows, width, count, to->words, to->stride);
        return 1;
    }
    if (c->op_s16 == pel_op_sobel_y_s16) {
        pel_i_row_sobel_y_rows(c->backend, rows, width, count, to->words, to->stride);
        return 1;
    }
    return 0;
}

/* `count` rows from y on, without their sides; rows: those around them, without the same. */
APART static void filter_middles(const direct *d, const uint8_t *const rows[], uint16_t y,
                                 uint16_t count)
{
    const pel_filter *const f = d->filter;
    const int32_t r = f->radius, above = f->config.border == PEL_BORDER_VALID ? 0 : r;
    const uint16_t width = (uint16_t)(f->config.width - 2 * r);
    const ptrdiff_t place = y * d->dst.stride + above;
    pel_filter_target to = {d->dst.bytes ? d->dst.bytes + place : NULL,
                            d->dst.words ? d->dst.words + place : NULL, d->dst.stride};

    if (to.bytes ? bytes_at_once(&f->config, rows, width, count, &to)
                 : words_at_once(&f->config, rows, width, count, &to)) {
        return;
    }
    for (unsigned i = 0; i < count; i++) {
        compute(d, rows + i, width, &to);
        to.bytes = to.bytes ? to.bytes + to.stride : NULL;
        to.words = to.words ? to.words + to.stride : NULL;
    }
}

/* ---- Sides --------------------------------------------------------------------------------- */

/* Which pixels of a row, or which constant, stand outside. A copy of what the filter knows, as it
 * cannot be what is written to. */
typedef struct sides {
    int32_t left[2], right[2];
    uint32_t width;
    uint8_t constant;
} sides;

static inline uint8_t outside(const sides *s, const uint8_t *row, int32_t x)
{
    return x < 0 ? s->constant : row[x];
}

/* For r = 1: put together in a register, as stores of single bytes would be what takes longest. */
static inline void put_record3(const sides *s, const uint8_t *row, uint8_t *record)
{
    const uint8_t *const last = row + s->width - 2;
    const uint32_t front = (uint32_t)outside(s, row, s->left[0]) | (uint32_t)row[0] << 8 |
                           (uint32_t)row[1] << 16 | (uint32_t)last[0] << 24;
    const uint32_t back = (uint32_t)last[1] | (uint32_t)outside(s, row, s->right[0]) << 8;

    for (unsigned i = 0; i < 4; i++) {
        record[i] = (uint8_t)(front >> 8 * i);
    }
    record[4] = (uint8_t)back;
    record[5] = (uint8_t)(back >> 8);
}

static inline void put_record5(const sides *s, const uint8_t *row, uint8_t *record)
{
    const uint8_t *const last = row + s->width - 4;

    for (unsigned i = 0; i < 2; i++) {
        record[1 - i] = outside(s, row, s->left[i]);
        record[10 + i] = outside(s, row, s->right[i]);
    }
    for (unsigned i = 0; i < 4; i++) {
        record[2 + i] = row[i];
        record[6 + i] = last[i];
    }
}

APART static void put_records(const direct *d, const uint8_t *const rows[], unsigned count)
{
    const pel_filter *const f = d->filter;
    const sides s = {
        {f->left[0], f->left[1]}, {f->right[0], f->right[1]}, f->config.width, f->config.constant};
    uint8_t *record = d->records;

    if (f->radius == 1) {
        for (unsigned i = 0; i < count; i++, record += 6) {
            put_record3(&s, rows[i] - 1, record);
        }
    } else {
        for (unsigned i = 0; i < count; i++, record += 12) {
            put_record5(&s, rows[i] - 2, record);
        }
    }
}

/* The first and the last r results of `count` records to where they belong. */
#define TAKE(name, pixel)                                                                          \
    static inline void name(const pixel *from, unsigned r, unsigned count, uint32_t width,         \
                            ptrdiff_t stride, pixel *to)                                           \
    {                                                                                              \
        for (unsigned i = 0; i < count; i++, from += 6 * r, to += stride) {                        \
            for (unsigned k = 0; k < r; k++) {                                                     \
                to[k] = from[k];                                                                   \
                to[width - r + k] = from[3 * r + k];                                               \
            }                                                                                      \
        }                                                                                          \
    }

TAKE(take_bytes, uint8_t)
TAKE(take_words, int16_t)

static void take_results(const direct *d, uint16_t y, unsigned count, const pel_filter_target *from)
{
    const unsigned r = d->filter->radius;
    const uint32_t width = d->filter->config.width;
    const ptrdiff_t stride = d->dst.stride;

    if (from->words) {
        take_words(from->words, r, count, width, stride, d->dst.words + y * stride);
    } else if (r == 1) {
        take_bytes(from->bytes, 1, count, width, stride, d->dst.bytes + y * stride);
    } else {
        take_bytes(from->bytes, 2, count, width, stride, d->dst.bytes + y * stride);
    }
}

/* Both sides of `count` rows from y on. */
APART static void filter_sides(const direct *d, const uint8_t *const rows[], uint16_t y,
                               unsigned count)
{
    const unsigned r = d->filter->radius, record = 6 * r;
    uint8_t *const results = d->records + (d->rows_max + 2 * r) * record;
    const pel_filter_target to = {d->dst.bytes ? results : NULL,
                                  d->dst.words ? (int16_t *)(void *)results : NULL, 0};
    const uint8_t *long_rows[5];

    for (unsigned k = 0; k <= 2 * r; k++) {
        long_rows[k] = d->records + k * record + r;
    }
    put_records(d, rows, count + 2 * r);
    compute(d, long_rows, (uint16_t)(count * record - 2 * r), &to);
    take_results(d, y, count, &to);
}

/* ---- The frame ----------------------------------------------------------------------------- */

/* Lays out the working memory; the records begin where results of 16 bits may lie, and are even in
 * number of bytes. */
static void lay_out(direct *d)
{
    const pel_filter *const f = d->filter;
    const unsigned r = f->radius, width = f->config.width;
    const unsigned kept = f->config.border == PEL_BORDER_CONSTANT ? width : 0;
    uint8_t *const work = f->config.work;
    const unsigned room = (2 * r + 1) * (width + 2 * r) - kept - 1 - 12 * r * r;

    for (unsigned i = 0; i < kept; i++) {
        work[i] = f->config.constant;
    }
    d->records = work + kept + ((uintptr_t)(work + kept) & 1);
    d->rows_max = room / (18 * r) < ROWS_MAX ? room / (18 * r) : ROWS_MAX;
}

/* The rows around `count` results from y on, without their sides. */
APART static void find_rows(const direct *d, int32_t y, int32_t count, const uint8_t *rows[])
{
    const int32_t r = d->filter->radius;
    const int32_t top = d->filter->config.border == PEL_BORDER_VALID ? y : y - r;

    for (int32_t k = 0; k < count + 2 * r; k++) {
        rows[k] = row_at(d, top + k) + r;
    }
}

/* `count` rows from y on. */
APART static void filter_rows(const direct *d, unsigned y, unsigned count)
{
    const uint8_t *rows[ROWS_MAX + 4];

    find_rows(d, (int32_t)y, (int32_t)count, rows);
    filter_middles(d, rows, (uint16_t)y, (uint16_t)count);
    if (d->filter->config.border != PEL_BORDER_VALID) {
        filter_sides(d, rows, (uint16_t)y, count);
    }
}

int pel_i_filter_direct(const pel_filter *f, const pel_cview *src, const pel_filter_target *dst)
{
    direct d = {f, src, *dst, NULL, 0};
    const unsigned rows =
        f->config.border == PEL_BORDER_VALID ? f->config.height - 2u * f->radius : f->config.height;
    unsigned count;

    if (f->config.backend == PEL_BACKEND_SCALAR || f->config.width < WIDTH_MIN) {
        return 0;
    }
    lay_out(&d);
    for (unsigned y = 0; y < rows; y += count) {
        count = rows - y < d.rows_max ? rows - y : d.rows_max;
        filter_rows(&d, y, count);
    }
    return 1;
}

#else
typedef int nothing_here; /* an empty file is no C */
#endif
