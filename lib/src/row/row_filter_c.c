/* The row kernels of neighbourhoods in plain C: the truth that every faster version must equal. */
#include "pel/fixed.h"
#include "row/row_filter.h"

/* ---- Sums ---------------------------------------------------------------------------------- */

/* 3x3: -293760..291465; 5x5: -816000..809625. */
void pel_row_correlate3(const uint8_t *const rows[], const int8_t *tap, uint16_t count,
                        int32_t *sums)
{
    for (int x = 0; x < count; x++) {
        const uint8_t *const a = rows[0] + x, *const b = rows[1] + x, *const c = rows[2] + x;
        sums[x] = (int32_t)tap[0] * a[-1] + (int32_t)tap[1] * a[0] + (int32_t)tap[2] * a[1] +
                  (int32_t)tap[3] * b[-1] + (int32_t)tap[4] * b[0] + (int32_t)tap[5] * b[1] +
                  (int32_t)tap[6] * c[-1] + (int32_t)tap[7] * c[0] + (int32_t)tap[8] * c[1];
    }
}

void pel_row_correlate5(const uint8_t *const rows[], const int8_t *tap, uint16_t count,
                        int32_t *sums)
{
    for (int x = 0; x < count; x++) {
        int32_t sum = 0;
        for (unsigned r = 0; r < 5; r++) {
            const uint8_t *const p = rows[r] + x;
            const int8_t *const t = tap + 5 * r;
            sum += (int32_t)t[0] * p[-2] + (int32_t)t[1] * p[-1] + (int32_t)t[2] * p[0] +
                   (int32_t)t[3] * p[1] + (int32_t)t[4] * p[2];
        }
        sums[x] = sum;
    }
}

/* The separable ones add up each column once and keep the sums of the columns to the left. */
void pel_row_gauss3(const uint8_t *const rows[], uint16_t count, int32_t *sums)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];
    int32_t left = a[-1] + 2 * b[-1] + c[-1], middle = a[0] + 2 * b[0] + c[0];

    for (int x = 0; x < count; x++) {
        const int32_t right = a[x + 1] + 2 * b[x + 1] + c[x + 1];
        sums[x] = left + 2 * middle + right;
        left = middle;
        middle = right;
    }
}

void pel_row_box3(const uint8_t *const rows[], uint16_t count, int32_t *sums)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];
    int32_t left = a[-1] + b[-1] + c[-1], middle = a[0] + b[0] + c[0];

    for (int x = 0; x < count; x++) {
        const int32_t right = a[x + 1] + b[x + 1] + c[x + 1];
        sums[x] = left + middle + right;
        left = middle;
        middle = right;
    }
}

void pel_row_sobel_x(const uint8_t *const rows[], uint16_t count, int32_t *sums)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];
    int32_t left = a[-1] + 2 * b[-1] + c[-1], middle = a[0] + 2 * b[0] + c[0];

    for (int x = 0; x < count; x++) {
        const int32_t right = a[x + 1] + 2 * b[x + 1] + c[x + 1];
        sums[x] = right - left;
        left = middle;
        middle = right;
    }
}

void pel_row_sobel_y(const uint8_t *const rows[], uint16_t count, int32_t *sums)
{
    const uint8_t *const a = rows[0], *const c = rows[2];
    int32_t left = c[-1] - a[-1], middle = c[0] - a[0];

    for (int x = 0; x < count; x++) {
        const int32_t right = c[x + 1] - a[x + 1];
        sums[x] = left + 2 * middle + right;
        left = middle;
        middle = right;
    }
}

static int32_t binomial_column(const uint8_t *const rows[], int x)
{
    return rows[0][x] + 4 * (rows[1][x] + rows[3][x]) + 6 * rows[2][x] + rows[4][x];
}

void pel_row_binomial5(const uint8_t *const rows[], uint16_t count, int32_t *sums)
{
    int32_t c0 = binomial_column(rows, -2), c1 = binomial_column(rows, -1);
    int32_t c2 = binomial_column(rows, 0), c3 = binomial_column(rows, 1);

    for (int x = 0; x < count; x++) {
        const int32_t c4 = binomial_column(rows, x + 2);
        sums[x] = c0 + 4 * (c1 + c3) + 6 * c2 + c4;
        c0 = c1;
        c1 = c2;
        c2 = c3;
        c3 = c4;
    }
}

/* ---- Gradients ----------------------------------------------------------------------------- */

typedef struct gradient {
    int32_t x, y; /* -1020..1020 */
} gradient;

static inline gradient gradient_at(const uint8_t *const rows[], int x)
{
    const uint8_t *const a = rows[0] + x, *const b = rows[1] + x, *const c = rows[2] + x;
    gradient g;

    g.x = a[1] + 2 * b[1] + c[1] - a[-1] - 2 * b[-1] - c[-1];
    g.y = c[-1] + 2 * c[0] + c[1] - a[-1] - 2 * a[0] - a[1];
    return g;
}

static inline int32_t magnitude(int32_t value)
{
    return value < 0 ? -value : value;
}

void pel_row_gradient_abs(const uint8_t *const rows[], uint16_t count, int32_t *sums)
{
    for (int x = 0; x < count; x++) {
        const gradient g = gradient_at(rows, x);
        sums[x] = magnitude(g.x) + magnitude(g.y);
    }
}

void pel_row_gradient(const uint8_t *const rows[], uint16_t count, int32_t *sums)
{
    for (int x = 0; x < count; x++) {
        const gradient g = gradient_at(rows, x);
        sums[x] = pel_isqrt32((uint32_t)(g.x * g.x + g.y * g.y));
    }
}

/*
 * The direction changes from i to i + 1 at tan((i + 1/2) / 256 of a turn), which is irrational.
 * Each pair is a fraction y / x beside it with no possible gradient between the two (|gx|, |gy| <=
 * 1020), so that comparing with it is exact; a test visits every gradient.
 */
static const uint16_t half_steps[32][2] = {
    {13, 1059},   {53, 1439},  {65, 1058},   {129, 1498},  {115, 1037}, {237, 1745}, {200, 1243},
    {221, 1187},  {275, 1299}, {389, 1638},  {301, 1142},  {310, 1069}, {479, 1512}, {397, 1154},
    {381, 1025},  {409, 1023}, {439, 1024},  {513, 1120},  {716, 1467}, {730, 1407}, {628, 1141},
    {658, 1129},  {655, 1063}, {741, 1139},  {754, 1099},  {764, 1057}, {789, 1037}, {926, 1157},
    {1109, 1318}, {993, 1123}, {1216, 1309}, {1006, 1031},
};

/* 0..32 in the first octant, y <= x. */
static int octant_direction(int32_t x, int32_t y)
{
    int low = 0, high = 32;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (y * half_steps[middle][1] > x * half_steps[middle][0]) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

static int direction_of(gradient g)
{
    const int32_t x = magnitude(g.x), y = magnitude(g.y);
    int d = y <= x ? octant_direction(x, y) : 64 - octant_direction(y, x);
    d = g.x < 0 ? 128 - d : d;
    return g.y < 0 ? -d : d;
}

void pel_row_direction(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    for (int x = 0; x < count; x++) {
        out[x] = (uint8_t)(direction_of(gradient_at(rows, x)) & 255);
    }
}

/* ---- Results ------------------------------------------------------------------------------- */

static inline int32_t scaled(int32_t sum, const pel_row_scale *scale)
{
    const int32_t value = scale->absolute ? magnitude(sum) : sum;
    const int32_t quotient = scale->divisor == 1
                                 ? pel_round_shift(value, scale->shift)
                                 : pel_round_div(value, (int32_t)scale->divisor << scale->shift);
    return quotient + scale->bias;
}

void pel_row_scale_u8(const int32_t *sums, const pel_row_scale *scale, uint16_t count, uint8_t *out)
{
    for (uint16_t x = 0; x < count; x++) {
        out[x] = pel_saturate_u8(scaled(sums[x], scale));
    }
}

void pel_row_scale_s16(const int32_t *sums, const pel_row_scale *scale, uint16_t count,
                       int16_t *out)
{
    for (uint16_t x = 0; x < count; x++) {
        out[x] = pel_saturate_s16(scaled(sums[x], scale));
    }
}

/* ---- Order --------------------------------------------------------------------------------- */

static inline uint8_t smaller(uint8_t a, uint8_t b)
{
    return a < b ? a : b;
}

static inline uint8_t larger(uint8_t a, uint8_t b)
{
    return a > b ? a : b;
}

static inline uint8_t middle_of(uint8_t a, uint8_t b, uint8_t c)
{
    return larger(smaller(a, b), smaller(larger(a, b), c));
}

static inline uint8_t smallest(uint8_t a, uint8_t b, uint8_t c)
{
    return smaller(smaller(a, b), c);
}

static inline uint8_t largest(uint8_t a, uint8_t b, uint8_t c)
{
    return larger(larger(a, b), c);
}

/* The median of nine is the middle one of: the largest of the columns' smallest, the middle of
 * their middles, and the smallest of their largest (Smith 1996, after Paeth). */
void pel_row_median3(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    for (int x = 0; x < count; x++) {
        uint8_t low[3], mid[3], high[3];
        for (int i = 0; i < 3; i++) {
            const uint8_t a = rows[0][x + i - 1], b = rows[1][x + i - 1], c = rows[2][x + i - 1];
            low[i] = smallest(a, b, c);
            mid[i] = middle_of(a, b, c);
            high[i] = largest(a, b, c);
        }
        out[x] = middle_of(largest(low[0], low[1], low[2]), middle_of(mid[0], mid[1], mid[2]),
                           smallest(high[0], high[1], high[2]));
    }
}

void pel_row_min3(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];
    uint8_t left = smallest(a[-1], b[-1], c[-1]), middle = smallest(a[0], b[0], c[0]);

    for (int x = 0; x < count; x++) {
        const uint8_t right = smallest(a[x + 1], b[x + 1], c[x + 1]);
        out[x] = smallest(left, middle, right);
        left = middle;
        middle = right;
    }
}

void pel_row_max3(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];
    uint8_t left = largest(a[-1], b[-1], c[-1]), middle = largest(a[0], b[0], c[0]);

    for (int x = 0; x < count; x++) {
        const uint8_t right = largest(a[x + 1], b[x + 1], c[x + 1]);
        out[x] = largest(left, middle, right);
        left = middle;
        middle = right;
    }
}

/* ---- Labels -------------------------------------------------------------------------------- */

static inline void gather9(const uint8_t *const rows[], int x, uint8_t nine[9])
{
    for (int i = 0; i < 9; i++) {
        nine[i] = rows[i / 3][x + i % 3 - 1];
    }
}

static unsigned count_of(const uint8_t nine[9], uint8_t label)
{
    unsigned count = 0;

    for (unsigned i = 0; i < 9; i++) {
        count += nine[i] == label;
    }
    return count;
}

void pel_row_majority3(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    for (int x = 0; x < count; x++) {
        uint8_t nine[9], best;
        unsigned most;
        gather9(rows, x, nine);
        best = nine[4];
        most = count_of(nine, best);
        for (unsigned i = 0; i < 9 && most < 5; i++) {
            const unsigned n = count_of(nine, nine[i]);
            if (n > most || (n == most && best != nine[4] && nine[i] < best)) {
                best = nine[i];
                most = n;
            }
        }
        out[x] = best;
    }
}

void pel_row_erode_labels3(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    for (int x = 0; x < count; x++) {
        uint8_t nine[9];
        gather9(rows, x, nine);
        out[x] = count_of(nine, nine[4]) == 9 ? nine[4] : 0;
    }
}

void pel_row_dilate_labels3(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    for (int x = 0; x < count; x++) {
        uint8_t nine[9], label;
        gather9(rows, x, nine);
        label = nine[4];
        for (unsigned i = 0; i < 9 && nine[4] == 0; i++) {
            if (nine[i] != 0 && (label == 0 || nine[i] < label)) {
                label = nine[i];
            }
        }
        out[x] = label;
    }
}
