/* Moments, outline and mean colour of blobs, and the walk over a row that measures them. */
#include "pel/blobs.h"

#include "blob_slots.h"
#include "row/row.h"

/* The sums of a slot. */
static inline uint64_t *extras_of(const pel_blobs *b, uint32_t id)
{
    return (uint64_t *)(void *)((unsigned char *)b->config.work + (uint32_t)(id * b->extra_step));
}

static inline unsigned extra_count(const pel_blobs *b)
{
    return (unsigned)((PEL_BLOBS_SLOT_BYTES(b->config.measure) - sizeof(slot)) / 8);
}

static inline void unite_extras(const pel_blobs *b, unsigned into, unsigned from)
{
    uint64_t *const sums = extras_of(b, into), *const others = extras_of(b, from);
    const unsigned count = extra_count(b);

    for (unsigned i = 0; i < count; i++) {
        sums[i] += others[i];
    }
}

/* A run touches a run above: a pair more, in the high half, and in the low half so many edges, none
 * at a corner. A row has less than 2^16 of both. */
static inline uint32_t touch_extras(pel_run run, pel_run above)
{
    const uint16_t x0 = above.x0 > run.x0 ? above.x0 : run.x0;
    const uint16_t x1 = above.x1 < run.x1 ? above.x1 : run.x1;
    return ((uint32_t)1 << 16) + x1 - x0;
}

/* The product of 16 bits and 32. Cores whose products end at 32 bits do it in two, quicker than the
 * call that is for any 64 bits. */
static inline uint64_t wide_product(uint32_t a, uint32_t b)
{
#if (defined(__ARM_ARCH_6M__) || defined(__ARM_ARCH_8M_BASE__)) && !defined(__OPTIMIZE_SIZE__)
    return ((uint64_t)(a * (b >> 16)) << 16) + a * (b & 0xFFFF);
#else
    return (uint64_t)a * b;
#endif
}

/* What a run alone has, beyond area, box and sums. With s = x0 + x1 - 1, twice the middle of a run
 * of n, its sum of x*x is n (3 s^2 + n^2 - 1) / 12; the bracket is below 2^30. */
static inline uint64_t sum_of_12xx(pel_run run)
{
    const uint32_t n = (uint32_t)run.x1 - run.x0, s = (uint32_t)run.x0 + run.x1 - 1;
    return wide_product(n, 3 * s * s + n * n - 1);
}

static inline uint64_t sum_of_xy(pel_run run, uint32_t y)
{
    const uint32_t n = (uint32_t)run.x1 - run.x0, s = (uint32_t)run.x0 + run.x1 - 1;
    return wide_product(y, n * s / 2);
}

static inline uint64_t sum_of_yy(pel_run run, uint32_t y)
{
    return wide_product((uint32_t)run.x1 - run.x0, y * y);
}

static inline void add_outline(uint64_t *sum, uint32_t touched)
{
    *sum += ((uint64_t)1 << 32) + 1 - ((uint64_t)(touched >> 16) << 32) - (touched & 0xFFFF);
}

static inline void add_moments(uint64_t sums[3], pel_run run, uint32_t y)
{
    sums[0] += sum_of_12xx(run);
    sums[1] += sum_of_xy(run, y);
    sums[2] += sum_of_yy(run, y);
}

/* The first run of a blob. */
static inline void set_extras(const pel_blobs *b, unsigned id, pel_run run)
{
    const unsigned measure = b->config.measure;
    uint64_t *extra = extras_of(b, id);

    if (measure & PEL_MEASURE_OUTLINE) {
        *extra++ = ((uint64_t)1 << 32) + 1;
    }
    if (measure & PEL_MEASURE_MOMENTS) {
        *extra++ = sum_of_12xx(run);
        *extra++ = sum_of_xy(run, b->next_row);
        *extra++ = sum_of_yy(run, b->next_row);
    }
    if (measure & PEL_MEASURE_COLOR) {
        extra[0] = 0;
        extra[1] = 0;
    }
}

static inline void add_extras(const pel_blobs *b, unsigned id, pel_run run, uint32_t touched)
{
    const unsigned measure = b->config.measure;
    uint64_t *extra = extras_of(b, id);

    if (measure & PEL_MEASURE_OUTLINE) {
        add_outline(extra++, touched);
    }
    if (measure & PEL_MEASURE_MOMENTS) {
        add_moments(extra, run, b->next_row);
    }
}

static uint8_t mean(uint32_t sum, uint32_t area)
{
    return (uint8_t)((2 * sum + area) / (2 * area));
}

static void describe_extras(const pel_blobs *b, unsigned id, pel_blob *blob)
{
    const uint64_t *sum = extras_of(b, id);

    if (b->config.measure & PEL_MEASURE_OUTLINE) {
        const uint64_t outline = *sum++ + blob->area; /* its low half is no longer negative */
        blob->perimeter = 2 * (uint32_t)outline;
        blob->holes = 1 - (uint32_t)(outline >> 32);
    }
    if (b->config.measure & PEL_MEASURE_MOMENTS) {
        /* A multiple of 12: shift by 2, then times the inverse of 3 modulo 2^64. */
        blob->sum_xx = (sum[0] >> 2) * UINT64_C(0xAAAAAAAAAAAAAAAB);
        blob->sum_xy = sum[1];
        blob->sum_yy = sum[2];
        sum += 3;
    }
    if (b->config.measure & PEL_MEASURE_COLOR) {
        blob->mean_y = mean((uint32_t)sum[0], blob->area);
        blob->mean_u = mean((uint32_t)(sum[0] >> 32), blob->area);
        blob->mean_v = mean((uint32_t)sum[1], blob->area);
    }
}

#include "blob_walk_template.h"

static void add_color(const pel_blobs *b, uint64_t *sums, pel_run run, const pel_crow *pixels)
{
    enum { CHUNK = 8 };
    uint8_t y[CHUNK], u[CHUNK], v[CHUNK];

    for (unsigned x = run.x0; x < run.x1; x += CHUNK) {
        const uint16_t n = (uint16_t)(run.x1 - x < CHUNK ? run.x1 - x : CHUNK);
        (void)b->config.reader(pixels, (uint16_t)x, n, pixels->range, y, u, v); /* checked before */
        sums[0] += pel_row_sum(y, n) | (uint64_t)pel_row_sum(u, n) << 32;
        sums[1] += pel_row_sum(v, n);
    }
}

/* The pixels of the row, when all of its runs are in blobs and it has become the one above. The
 * sums of colour are the last two. */
PEL_I_APART static void add_colors(const pel_blobs *b, size_t count, const pel_crow *pixels)
{
    const unsigned last_two = extra_count(b) - 2;

    for (size_t i = 0; i < count; i++) {
        const unsigned id = b->ids[ABOVE][i];
        if (id < LOST) {
            add_color(b, extras_of(b, find_root(b->slots, id)) + last_two, b->runs[ABOVE][i],
                      pixels);
        }
    }
}

PEL_I_APART static pel_status check_pixels(const pel_blobs *b, const pel_crow *pixels)
{
    uint8_t y, u, v;
    const pel_status status =
        pixels ? b->config.reader(pixels, 0, 0, pixels->range, &y, &u, &v) : PEL_ERR_ARG;

    if (status != PEL_OK) {
        return status;
    }
    return pel_color_width(pixels->format, pixels->width) == b->config.width ? PEL_OK
                                                                             : PEL_ERR_FORMAT;
}

pel_status pel_blobs_measure(pel_blobs *b, uint16_t count, const uint8_t *labels,
                             const pel_crow *pixels)
{
    const pel_status status =
        labels && (b->config.measure & PEL_MEASURE_COLOR) ? check_pixels(b, pixels) : PEL_OK;

    if (status == PEL_OK) {
        join_row(b, count, labels);
        if (b->config.measure & PEL_MEASURE_COLOR) {
            add_colors(b, count, pixels);
        }
    }
    return status;
}
