#include "row/row_point.h"

void pel_row_histogram(const uint8_t *src, unsigned step, uint16_t count, uint32_t *bins)
{
    for (uint16_t i = 0; i < count; i++) {
        bins[*src]++;
        src += step;
    }
}

/* ---- Two rows ------------------------------------------------------------------------------ */

void pel_row_add(const uint8_t *a, const uint8_t *b, uint16_t count, uint8_t *dst)
{
    for (uint16_t i = 0; i < count; i++) {
        const uint16_t sum = (uint16_t)(a[i] + b[i]);
        dst[i] = (uint8_t)(sum > 255 ? 255 : sum);
    }
}

void pel_row_subtract(const uint8_t *a, const uint8_t *b, uint16_t count, uint8_t *dst)
{
    for (uint16_t i = 0; i < count; i++) {
        dst[i] = (uint8_t)(a[i] > b[i] ? a[i] - b[i] : 0);
    }
}

void pel_row_absdiff(const uint8_t *a, const uint8_t *b, uint16_t count, uint8_t *dst)
{
    for (uint16_t i = 0; i < count; i++) {
        dst[i] = (uint8_t)(a[i] > b[i] ? a[i] - b[i] : b[i] - a[i]);
    }
}

void pel_row_min(const uint8_t *a, const uint8_t *b, uint16_t count, uint8_t *dst)
{
    for (uint16_t i = 0; i < count; i++) {
        dst[i] = a[i] < b[i] ? a[i] : b[i];
    }
}

void pel_row_max(const uint8_t *a, const uint8_t *b, uint16_t count, uint8_t *dst)
{
    for (uint16_t i = 0; i < count; i++) {
        dst[i] = a[i] > b[i] ? a[i] : b[i];
    }
}

void pel_row_and(const uint8_t *a, const uint8_t *b, uint16_t count, uint8_t *dst)
{
    for (uint16_t i = 0; i < count; i++) {
        dst[i] = (uint8_t)(a[i] & b[i]);
    }
}

void pel_row_or(const uint8_t *a, const uint8_t *b, uint16_t count, uint8_t *dst)
{
    for (uint16_t i = 0; i < count; i++) {
        dst[i] = (uint8_t)(a[i] | b[i]);
    }
}

void pel_row_xor(const uint8_t *a, const uint8_t *b, uint16_t count, uint8_t *dst)
{
    for (uint16_t i = 0; i < count; i++) {
        dst[i] = (uint8_t)(a[i] ^ b[i]);
    }
}

void pel_row_blend(const uint8_t *a, const uint8_t *b, uint16_t alpha_q8, uint16_t count,
                   uint8_t *dst)
{
    const uint32_t alpha = alpha_q8;
    const uint32_t rest = 256 - alpha;

    for (uint16_t i = 0; i < count; i++) {
        dst[i] = (uint8_t)((a[i] * alpha + b[i] * rest + 128) >> 8);
    }
}

/* ---- Sums over areas ----------------------------------------------------------------------- */

void pel_row_integral(const uint8_t *src, uint16_t count, const uint32_t *above, uint32_t *sums)
{
    uint32_t row = 0;

    for (uint16_t i = 0; i < count; i++) {
        row += src[i];
        sums[i] = above[i] + row;
    }
}

void pel_row_columns_add(const uint8_t *src, uint16_t count, uint16_t times, uint16_t *sums)
{
    for (uint16_t i = 0; i < count; i++) {
        sums[i] = (uint16_t)(sums[i] + (uint32_t)src[i] * times);
    }
}

void pel_row_columns_subtract(const uint8_t *src, uint16_t count, uint16_t *sums)
{
    for (uint16_t i = 0; i < count; i++) {
        sums[i] = (uint16_t)(sums[i] - src[i]);
    }
}

/* The sum of the columns -radius .. radius. */
static uint32_t first_box(const uint16_t *columns, uint16_t last, uint16_t radius)
{
    uint32_t sum = columns[0] * ((uint32_t)radius + 1);

    for (uint16_t i = 1; i <= radius; i++) {
        sum += columns[i < last ? i : last];
    }
    return sum;
}

/*
 * Without a division: round(sum / area) < v is 2 sum < area (2 v - 1), as area is odd and so no
 * mean a half. Sums: at most 255^3 < 2^24; the right side lies within 65025 * (2 * 510 - 1) < 2^27.
 */
void pel_row_over_mean(const uint8_t *src, const uint16_t *columns, uint16_t count, uint16_t radius,
                       int16_t c, uint8_t *dst)
{
    const uint16_t last = (uint16_t)(count - 1);
    const int32_t side = 2 * (int32_t)radius + 1;
    const int32_t area = side * side;
    uint32_t sum = first_box(columns, last, radius);

    for (uint16_t i = 0; i < count; i++) {
        const int32_t value = (int32_t)src[i] + c;
        const uint32_t enters = (uint32_t)i + radius + 1;
        dst[i] = 2 * (int32_t)sum < area * (2 * value - 1) ? 255 : 0;
        sum += columns[enters < last ? enters : last];
        sum -= columns[i > radius ? i - radius : 0];
    }
}

/* ---- Resizing ------------------------------------------------------------------------------ */

/* x = floor(X * width_in / width_out) without a division per pixel: each step adds the whole part
 * of width_in / width_out, and one more when the rests have added up to one. */
void pel_row_nearest(const uint8_t *src, uint16_t width_in, uint8_t channels, uint16_t width_out,
                     uint8_t *dst)
{
    const uint32_t whole = (uint32_t)(width_in / width_out) * channels;
    const uint16_t rest = width_in % width_out;
    uint32_t sum = 0;

    for (uint16_t i = 0; i < width_out; i++) {
        for (uint8_t c = 0; c < channels; c++) {
            *dst++ = src[c];
        }
        src += whole;
        sum += rest;
        if (sum >= width_out) {
            sum -= width_out;
            src += channels;
        }
    }
}

void pel_row_box_add(const uint8_t *src, uint16_t factor, uint8_t channels, uint16_t width_out,
                     uint32_t *sums)
{
    for (uint16_t i = 0; i < width_out; i++) {
        for (uint16_t k = 0; k < factor; k++) {
            for (uint8_t c = 0; c < channels; c++) {
                sums[c] += *src++;
            }
        }
        sums += channels;
    }
}

void pel_row_box_mean(const uint32_t *sums, uint32_t area, uint16_t count, uint8_t *dst)
{
    for (uint16_t i = 0; i < count; i++) {
        dst[i] = (uint8_t)((sums[i] + area / 2) / area);
    }
}

/* 2048 times the point between two pixels. */
static uint32_t between(uint8_t left, uint8_t right, uint16_t weight)
{
    return left * (uint32_t)(2048u - weight) + right * (uint32_t)weight;
}

void pel_row_bilinear(const pel_row_between *rows, const pel_row_place *places, uint8_t channels,
                      uint16_t count, uint8_t *dst)
{
    const uint32_t below = rows->weight;
    const uint32_t above = 2048 - below;

    for (uint16_t i = 0; i < count; i++) {
        const uint16_t x = places[i].x;
        const uint16_t weight = places[i].weight;
        const uint32_t left = (uint32_t)x * channels;
        const uint32_t right = x < rows->last ? left + channels : left;
        for (uint8_t c = 0; c < channels; c++) {
            const uint32_t upper = between(rows->upper[left + c], rows->upper[right + c], weight);
            const uint32_t lower = between(rows->lower[left + c], rows->lower[right + c], weight);
            *dst++ = (uint8_t)((upper * above + lower * below + ((uint32_t)1 << 21)) >> 22);
        }
    }
}

/* ---- White balance ------------------------------------------------------------------------- */

void pel_row_sum3(const uint8_t *src, uint16_t count, uint32_t sums[3])
{
    for (uint16_t i = 0; i < count; i++) {
        sums[0] += src[0];
        sums[1] += src[1];
        sums[2] += src[2];
        src += 3;
    }
}

void pel_row_gain3(const uint8_t *src, uint16_t count, const uint16_t gains_q8[3], uint8_t *dst)
{
    for (uint16_t i = 0; i < count; i++) {
        for (unsigned c = 0; c < 3; c++) {
            const uint32_t value = (*src++ * (uint32_t)gains_q8[c] + 128) >> 8;
            *dst++ = (uint8_t)(value > 255 ? 255 : value);
        }
    }
}
