/* Histograms and what follows from them. */
#include "pel/point.h"

#include "frames.h"
#include "point_wide.h"
#include "row/row_point_select.h"

/* The most values a histogram may have: the bounds below count on it. */
#define VALUES_MAX ((uint32_t)PEL_SIDE_MAX * PEL_SIDE_MAX) /* 2^26 */

pel_status pel_histogram_row(const uint8_t *src, unsigned step, uint16_t count, uint32_t bins[256])
{
    if (!src || !bins || step == 0) {
        return PEL_ERR_ARG;
    }
    pel_i_row_histogram(pel_i_row_backend(PEL_BACKEND_AUTO), src, step, count, bins);
    return PEL_OK;
}

pel_status pel_histogram_frame_with(const pel_cview *src, unsigned channel, uint32_t bins[256],
                                    pel_backend backend)
{
    const pel_status status = bins ? pel_i_check_bytes(src, 0) : PEL_ERR_ARG;
    unsigned channels;

    if (status != PEL_OK) {
        return status;
    }
    channels = pel_i_channels(src->format);
    if (channel >= channels) {
        return PEL_ERR_ARG;
    }
    for (unsigned i = 0; i < 256; i++) {
        bins[i] = 0;
    }
    backend = pel_i_row_backend(backend);
    for (uint16_t y = 0; y < src->height; y++) {
        pel_i_row_histogram(backend, pel_i_row(src, y) + channel, channels, src->width, bins);
    }
    return PEL_OK;
}

pel_status pel_histogram_frame(const pel_cview *src, unsigned channel, uint32_t bins[256])
{
    return pel_histogram_frame_with(src, channel, bins, PEL_BACKEND_AUTO);
}

pel_status pel_histogram_cumulative(const uint32_t bins[256], uint32_t cumulative[256])
{
    uint32_t sum = 0;

    if (!bins || !cumulative) {
        return PEL_ERR_ARG;
    }
    for (unsigned i = 0; i < 256; i++) {
        sum += bins[i];
        cumulative[i] = sum;
    }
    return PEL_OK;
}

/* How many values there are, if there are some and not too many. */
static pel_status total_of(const uint32_t bins[256], uint32_t *total)
{
    uint32_t sum = 0;

    if (!bins) {
        return PEL_ERR_ARG;
    }
    for (unsigned i = 0; i < 256; i++) {
        if (bins[i] > VALUES_MAX - sum) {
            return PEL_ERR_RANGE;
        }
        sum += bins[i];
    }
    *total = sum;
    return sum == 0 ? PEL_ERR_ARG : PEL_OK;
}

static uint8_t smallest_value(const uint32_t bins[256])
{
    uint8_t value = 0;

    while (bins[value] == 0) {
        value++;
    }
    return value;
}

static uint8_t largest_value(const uint32_t bins[256])
{
    uint8_t value = 255;

    while (bins[value] == 0) {
        value--;
    }
    return value;
}

/* ---- Mean and variance --------------------------------------------------------------------- */

/*
 * With m the mean rounded down, the variance is S / n - (D / n)^2, where S is the sum of (value -
 * m)^2, under 2^42, and D that of value - m, under n. S = a n + b makes it a + (b n - D^2) / n^2,
 * in which nothing is larger than n^2 <= 2^52, and so not 256 times that.
 */
static uint32_t variance_q8(const uint32_t bins[256], uint32_t n, uint64_t sum)
{
    const uint32_t m = pel_i_divide(sum, n);
    const uint64_t d = sum - (uint64_t)m * n;
    const uint64_t nn = (uint64_t)n * n;
    uint64_t s = 0;
    uint32_t a;
    uint64_t rest; /* b n - D^2 + n^2, which is positive */

    for (uint32_t i = 0; i < 256; i++) {
        const uint32_t off = i < m ? m - i : i - m;
        s += (uint64_t)(off * off) * bins[i];
    }
    a = pel_i_divide(s, n);
    rest = (s - (uint64_t)a * n) * n + nn - d * d;
    return 256 * a + pel_i_divide(256 * rest + nn / 2, nn) - 256;
}

pel_status pel_histogram_measure(const uint32_t bins[256], pel_histogram_stats *stats)
{
    uint32_t n;
    const pel_status status = stats ? total_of(bins, &n) : PEL_ERR_ARG;
    uint64_t sum = 0;
    uint64_t squares = 0;

    if (status != PEL_OK) {
        return status;
    }
    for (uint32_t i = 0; i < 256; i++) {
        sum += (uint64_t)i * bins[i];
        squares += (uint64_t)(i * i) * bins[i];
    }
    stats->sum = sum;
    stats->sum_squares = squares;
    stats->count = n;
    stats->mean_q8 = pel_i_divide(256 * sum + n / 2, n);
    stats->variance_q8 = variance_q8(bins, n, sum);
    stats->min = smallest_value(bins);
    stats->max = largest_value(bins);
    return PEL_OK;
}

pel_status pel_histogram_percentile(const uint32_t bins[256], uint16_t permille, uint8_t *value)
{
    uint32_t n;
    const pel_status status = value && permille <= 1000 ? total_of(bins, &n) : PEL_ERR_ARG;
    uint32_t below;
    uint8_t v;

    if (status != PEL_OK) {
        return status;
    }
    v = smallest_value(bins);
    below = bins[v];
    while ((uint64_t)below * 1000 < (uint64_t)n * permille) {
        v++;
        below += bins[v];
    }
    *value = v;
    return PEL_OK;
}

/* ---- Otsu ---------------------------------------------------------------------------------- */

/* A split of n values into n1 low and n2 high ones. With S the sum of all and S1 that of the low
 * ones, the between-class variance is spread^2 / (n1 n2) / n^2, where spread = |n S1 - n1 S| = n1
 * n2 times the distance of the means, < 2^58. */
typedef struct split {
    uint64_t spread;
    uint64_t weight; /* n1 n2, at most 2^50 */
} split;

/* spread^2 * weight, at most 2^166: in six limbs. */
enum { OTSU_LIMBS = 6 };

static void set_product(uint32_t *wide, uint64_t spread, uint64_t weight)
{
    pel_i_wide_set(wide, OTSU_LIMBS, 1);
    pel_i_wide_multiply(wide, OTSU_LIMBS, spread);
    pel_i_wide_multiply(wide, OTSU_LIMBS, spread);
    pel_i_wide_multiply(wide, OTSU_LIMBS, weight);
}

/* Whether a's between-class variance is larger: the two fractions, crosswise. */
static int better(const split *a, const split *b)
{
    uint32_t left[OTSU_LIMBS], right[OTSU_LIMBS];

    set_product(left, a->spread, b->weight);
    set_product(right, b->spread, a->weight);
    return !pel_i_wide_not_over(left, right, OTSU_LIMBS);
}

pel_status pel_histogram_otsu(const uint32_t bins[256], uint8_t *threshold)
{
    uint32_t n;
    const pel_status status = threshold ? total_of(bins, &n) : PEL_ERR_ARG;
    split best = {0, 1};
    uint64_t sum = 0;
    uint64_t low_sum = 0;
    uint32_t low = 0;

    if (status != PEL_OK) {
        return status;
    }
    for (uint32_t i = 0; i < 256; i++) {
        sum += (uint64_t)i * bins[i];
    }
    *threshold = 0;
    for (uint32_t i = 0; i < 256; i++) {
        split here;
        low += bins[i];
        low_sum += (uint64_t)i * bins[i];
        here.spread = low * sum - n * low_sum; /* the low ones' mean is the smaller one */
        here.weight = (uint64_t)low * (n - low);
        if (bins[i] != 0 && better(&here, &best)) { /* not where a side is empty: no spread */
            best = here;
            *threshold = (uint8_t)i;
        }
    }
    return PEL_OK;
}

/* ---- Equalisation -------------------------------------------------------------------------- */

/* A rising walk, as for power curves: out + 1 is reached when 255 * sum / range >= out + 1/2. */
pel_status pel_table_equalize(const uint32_t bins[256], uint8_t table[256])
{
    uint32_t n;
    const pel_status status = table ? total_of(bins, &n) : PEL_ERR_ARG;
    uint32_t range;
    uint32_t sum = 0;
    uint32_t out = 0;
    unsigned first;

    if (status != PEL_OK) {
        return status;
    }
    first = smallest_value(bins);
    range = n - bins[first];
    if (range == 0) {
        return pel_table_brightness(0, table);
    }
    for (unsigned i = 0; i < 256; i++) {
        sum += i > first ? bins[i] : 0;
        while (out < 255 && (2 * out + 1) * (uint64_t)range <= 510 * (uint64_t)sum) {
            out++;
        }
        table[i] = (uint8_t)out;
    }
    return PEL_OK;
}
