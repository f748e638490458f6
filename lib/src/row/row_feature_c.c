/* The row kernels of corners and edges in plain C: the truth that every faster version must
 * equal. */
#include "row/row_feature.h"
#include "pel/fixed.h"

/* ---- The structure tensor ------------------------------------------------------------------ */

/* Sums of gx^2, gx gy and gy^2. Per pixel at most 1040400, 585225 (|gx| + |gy| <= 1530) and
 * 1040400; of a column three times, of a window nine times that: 9363600 < 2^24. */
typedef struct tensor {
    int32_t xx, xy, yy;
} tensor;

/* Of the three pixels (x, -1), (x, 0), (x, 1): Sobel as differences and sums along five rows, then
 * across them. */
static inline tensor tensor_column(const uint8_t *const rows[], int x)
{
    int16_t difference[5], sum[5];
    tensor t = {0, 0, 0};

    for (int i = 0; i < 5; i++) {
        const uint8_t *const p = rows[i] + x;
        difference[i] = (int16_t)(p[1] - p[-1]);
        sum[i] = (int16_t)(p[-1] + 2 * p[0] + p[1]);
    }
    for (int i = 1; i < 4; i++) {
        const int32_t gx = difference[i - 1] + 2 * difference[i] + difference[i + 1];
        const int32_t gy = sum[i + 1] - sum[i - 1];
        t.xx += gx * gx;
        t.xy += gx * gy;
        t.yy += gy * gy;
    }
    return t;
}

static inline tensor tensor_sum(const tensor *left, const tensor *middle, const tensor *right)
{
    tensor t;

    t.xx = left->xx + middle->xx + right->xx;
    t.xy = left->xy + middle->xy + right->xy;
    t.yy = left->yy + middle->yy + right->yy;
    return t;
}

/* trace <= 11704500, its square < 2^47, times k < 2^60; determinant < 2^45, times 2^15 < 2^60. */
static int32_t harris_of(const tensor *t, uint16_t k_q15)
{
    const int64_t trace = t->xx + t->yy;
    const int64_t determinant = (int64_t)t->xx * t->yy - (int64_t)t->xy * t->xy;
    const int64_t r = determinant * 32768 - trace * trace * k_q15;

    return (int32_t)(r >= 0 ? r >> 29 : ~(~r >> 29));
}

/* (a - c)^2 + 4 b^2 <= (a + c)^2 < 2^47. Its root is rounded up, so that half of what is left of
 * the trace is rounded down. */
static int32_t smaller_eigenvalue(const tensor *t)
{
    const int64_t apart = t->xx - t->yy;
    const uint64_t square = (uint64_t)(apart * apart) + 4 * (uint64_t)((int64_t)t->xy * t->xy);
    const uint32_t root = pel_isqrt64(square);
    const uint32_t up = root + ((uint64_t)root * root < square ? 1u : 0u);

    return (int32_t)(((uint32_t)(t->xx + t->yy) - up) >> 1);
}

/* With no_weight: the smaller eigenvalue, not Harris's measure. */
static const uint16_t no_weight = 0xffff;

static void respond(const uint8_t *const rows[], uint16_t count, uint16_t k_q15, int32_t *responses)
{
    tensor left = tensor_column(rows, -1), middle = tensor_column(rows, 0);

    for (int x = 0; x < count; x++) {
        const tensor right = tensor_column(rows, x + 1);
        const tensor sum = tensor_sum(&left, &middle, &right);
        responses[x] = k_q15 == no_weight ? smaller_eigenvalue(&sum) : harris_of(&sum, k_q15);
        left = middle;
        middle = right;
    }
}

void pel_row_harris(const uint8_t *const rows[], uint16_t count, uint16_t k_q15, int32_t *responses)
{
    respond(rows, count, k_q15, responses);
}

void pel_row_shi_tomasi(const uint8_t *const rows[], uint16_t count, int32_t *responses)
{
    respond(rows, count, no_weight, responses);
}

/* ---- Refinement ---------------------------------------------------------------------------- */

void pel_row_pull_around(const uint8_t *const rows[], int16_t radius, int16_t py,
                         pel_row_pull *sums)
{
    for (int px = -radius; px <= radius; px++) {
        const uint8_t *const a = rows[0] + px, *const b = rows[1] + px, *const c = rows[2] + px;
        const int32_t gx = a[1] + 2 * b[1] + c[1] - a[-1] - 2 * b[-1] - c[-1];
        const int32_t gy = c[-1] + 2 * c[0] + c[1] - a[-1] - 2 * a[0] - a[1];
        const int32_t along = gx * px + gy * py;
        sums->xx += gx * gx;
        sums->xy += gx * gy;
        sums->yy += gy * gy;
        sums->to_x += gx * along;
        sums->to_y += gy * along;
    }
}

/* ---- FAST ---------------------------------------------------------------------------------- */

enum { CIRCLE = 16, ARC = 9 };

/* The circle of radius 3, clockwise from the pixel straight above: x, and y + 3 as the place in
 * rows. */
static const int8_t circle_x[CIRCLE] = {0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3, -3, -3, -2, -1};
static const int8_t circle_row[CIRCLE] = {0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 5, 4, 3, 2, 1, 0};

/* Nine in a row hold one at least of any two that lie across: a look at four pixels rules out
 * most. */
static inline int may_be_corner(const uint8_t *const rows[], int x, int16_t threshold)
{
    const int16_t centre = rows[3][x];
    const int16_t over = (int16_t)(centre + threshold), under = (int16_t)(centre - threshold);
    const uint8_t up = rows[0][x], down = rows[6][x], left = rows[3][x - 3], right = rows[3][x + 3];

    return ((up > over || down > over) && (left > over || right > over)) ||
           ((up < under || down < under) && (left < under || right < under));
}

/* By how much at least one arc differs from the centre, all to one side; under 1: none does. */
static int16_t arc_contrast(const uint8_t *const rows[], int x)
{
    const int16_t centre = rows[3][x];
    int16_t difference[CIRCLE];
    int16_t best = 0;

    for (int i = 0; i < CIRCLE; i++) {
        difference[i] = (int16_t)(rows[circle_row[i]][x + circle_x[i]] - centre);
    }
    for (int i = 0; i < CIRCLE; i++) {
        int16_t least = 255, most = -255;
        for (int j = i; j < i + ARC; j++) {
            const int16_t d = difference[j % CIRCLE];
            least = d < least ? d : least;
            most = d > most ? d : most;
        }
        best = least > best ? least : best;
        best = -most > best ? (int16_t)-most : best;
    }
    return best;
}

void pel_row_fast9(const uint8_t *const rows[], uint16_t count, int16_t threshold,
                   int32_t *responses)
{
    for (int x = 0; x < count; x++) {
        int16_t contrast = 0;
        if (may_be_corner(rows, x, threshold)) {
            contrast = arc_contrast(rows, x);
        }
        responses[x] = contrast > threshold ? contrast - 1 : 0;
    }
}

/* ---- Tops ---------------------------------------------------------------------------------- */

/* Over those before it, in raster order, and over or at least at those behind it. */
static int is_top(const int32_t *const rows[], int x, int kind)
{
    const int32_t *const row = rows[1] + x;
    const int32_t r = row[0];
    const int32_t most = r - kind; /* cannot wrap, as the threshold is at least 1 */

    if (kind == PEL_ROW_TOP_ANY) {
        return 1;
    }
    if (row[-1] >= r || row[1] > most) {
        return 0;
    }
    for (int i = x - 1; i <= x + 1; i++) {
        if (rows[0][i] >= r || rows[2][i] > most) {
            return 0;
        }
    }
    return 1;
}

uint16_t pel_row_next_top(const int32_t *const rows[], uint16_t begin, uint16_t end,
                          int32_t threshold, int kind)
{
    const int32_t *const row = rows[1];

    for (uint16_t x = begin; x < end; x++) {
        if (row[x] >= threshold && is_top(rows, x, kind)) {
            return x;
        }
    }
    return end;
}

/* ---- Canny --------------------------------------------------------------------------------- */

/* Angles by products: 32768 * 1020 < 2^25, (65536 + 13573) * 1020 < 2^27. */
static inline uint16_t sector_of(int32_t gx, int32_t gy)
{
    const int32_t x = gx < 0 ? -gx : gx, y = (gy < 0 ? -gy : gy) * 32768;
    const int32_t flat = x * 13573;

    if (y < flat) {
        return PEL_SECTOR_SIDES;
    }
    if (y > flat + x * 65536) {
        return PEL_SECTOR_UPRIGHT;
    }
    return (gx < 0) == (gy < 0) ? PEL_SECTOR_FALLING : PEL_SECTOR_RISING;
}

void pel_row_gradient_sector(const uint8_t *const rows[], uint16_t count, uint16_t *gradients)
{
    for (int x = 0; x < count; x++) {
        const uint8_t *const a = rows[0] + x, *const b = rows[1] + x, *const c = rows[2] + x;
        const int32_t gx = a[1] + 2 * b[1] + c[1] - a[-1] - 2 * b[-1] - c[-1];
        const int32_t gy = c[-1] + 2 * c[0] + c[1] - a[-1] - 2 * a[0] - a[1];
        const int32_t magnitude = (gx < 0 ? -gx : gx) + (gy < 0 ? -gy : gy);
        gradients[x] =
            (uint16_t)((uint16_t)magnitude | (uint16_t)(sector_of(gx, gy) << PEL_SECTOR_SHIFT));
    }
}

static inline uint16_t magnitude_at(const uint16_t *gradients, int x)
{
    return gradients[x] & 0xfffu;
}

static int is_maximum(const uint16_t *const rows[], int x)
{
    const uint16_t m = magnitude_at(rows[1], x);

    switch (rows[1][x] >> PEL_SECTOR_SHIFT) {
    case PEL_SECTOR_SIDES:
        return m > magnitude_at(rows[1], x - 1) && m >= magnitude_at(rows[1], x + 1);
    case PEL_SECTOR_UPRIGHT:
        return m > magnitude_at(rows[0], x) && m >= magnitude_at(rows[2], x);
    case PEL_SECTOR_FALLING:
        return m > magnitude_at(rows[0], x - 1) && m > magnitude_at(rows[2], x + 1);
    default:
        return m > magnitude_at(rows[0], x + 1) && m > magnitude_at(rows[2], x - 1);
    }
}

void pel_row_thin(const uint16_t *const rows[], uint16_t count, uint16_t low, uint16_t high,
                  uint8_t *out)
{
    for (int x = 0; x < count; x++) {
        const uint16_t m = magnitude_at(rows[1], x);
        uint8_t edge = PEL_ROW_EDGE_NONE;
        if (m > low && is_maximum(rows, x)) {
            edge = m > high ? PEL_ROW_EDGE_STRONG : PEL_ROW_EDGE_WEAK;
        }
        out[x] = edge;
    }
}

static inline int is_edge(uint8_t value)
{
    return value == PEL_ROW_EDGE_WEAK || value == PEL_ROW_EDGE_STRONG;
}

/* Whether a part of a row holds a strong pixel; none does if there is no row. */
static int has_strong(const uint8_t *row, uint16_t begin, uint16_t end)
{
    for (uint16_t x = begin; row && x < end; x++) {
        if (row[x] == PEL_ROW_EDGE_STRONG) {
            return 1;
        }
    }
    return 0;
}

void pel_row_link(const uint8_t *above, const uint8_t *below, uint16_t count, uint8_t *row)
{
    uint16_t end = 0;

    for (uint16_t begin = 0; begin < count; begin = (uint16_t)(end + 1)) {
        uint16_t left, right;
        uint8_t linked;
        for (end = begin; end < count && is_edge(row[end]); end++) {
        }
        left = (uint16_t)(begin > 0 ? begin - 1 : 0);
        right = (uint16_t)(end < count ? end + 1 : end);
        linked = begin < end && (has_strong(row, begin, end) || has_strong(above, left, right) ||
                                 has_strong(below, left, right))
                     ? PEL_ROW_EDGE_STRONG
                     : PEL_ROW_EDGE_NONE;
        for (uint16_t x = begin; x < end; x++) {
            row[x] = linked;
        }
    }
}
