/* The row kernels of neighbourhoods in plain C: the truth that every faster version must equal. */
#include "row/row_filter.h"

/* pel_saturate_u8 and _s16 where the compiler can see them. */
static inline uint8_t limited_u8(int32_t value)
{
    return (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : value);
}

static inline int16_t limited_s16(int32_t value)
{
    return (int16_t)(value < -32768 ? -32768 : value > 32767 ? 32767 : value);
}

void pel_row_copy(const uint8_t *restrict src, uint16_t count, uint8_t *restrict dst)
{
    for (int x = 0; x < count; x++) {
        dst[x] = src[x];
    }
}

/* ---- Kernels ------------------------------------------------------------------------------- */

static inline int32_t scaled(uint32_t value, const pel_row_scale *scale)
{
    const uint32_t v = value < scale->flip ? 2 * scale->flip - value : value;
    return (int32_t)(scale->divisor == 0 ? v >> scale->shift : v / scale->divisor) + scale->bias;
}

/* What the columns seen so far add to the next result and to the one after it. 3x3: the sums are
 * -293760..291465; the start of the scale is in them. */
typedef struct ahead3 {
    int32_t next, after;
} ahead3;

/* Takes in the column at x and returns the sum that it completes. */
static inline int32_t take_column3(ahead3 *ahead, const uint8_t *const rows[], int x,
                                   const int8_t *tap, int32_t start)
{
    const int32_t a = rows[0][x], b = rows[1][x], c = rows[2][x];
    const int32_t sum = ahead->next + tap[2] * a + tap[5] * b + tap[8] * c;

    ahead->next = ahead->after + tap[1] * a + tap[4] * b + tap[7] * c;
    ahead->after = start + tap[0] * a + tap[3] * b + tap[6] * c;
    return sum;
}

static ahead3 first_columns3(const uint8_t *const rows[], const int8_t *tap, int32_t start)
{
    ahead3 ahead = {0, 0};

    (void)take_column3(&ahead, rows, -1, tap, start);
    (void)take_column3(&ahead, rows, 0, tap, start);
    return ahead;
}

void pel_row_kernel3(const uint8_t *const rows[], const int8_t *tap, const pel_row_scale *scale,
                     uint16_t count, uint8_t *restrict out)
{
    const int32_t start = (int32_t)scale->start;
    ahead3 ahead = first_columns3(rows, tap, start);

    for (int x = 0; x < count; x++) {
        const int32_t sum = take_column3(&ahead, rows, x + 1, tap, start);
        out[x] = limited_u8(scaled((uint32_t)sum, scale));
    }
}

void pel_row_kernel3_s16(const uint8_t *const rows[], const int8_t *tap, const pel_row_scale *scale,
                         uint16_t count, int16_t *restrict out)
{
    const int32_t start = (int32_t)scale->start;
    ahead3 ahead = first_columns3(rows, tap, start);

    for (int x = 0; x < count; x++) {
        const int32_t sum = take_column3(&ahead, rows, x + 1, tap, start);
        out[x] = limited_s16(scaled((uint32_t)sum, scale));
    }
}

/* 5x5: -816000..809625. In a loop: written out, 25 taps would fill the stack. */
static inline int32_t sum5(const uint8_t *const rows[], int x, const int8_t *tap)
{
    int32_t sum = 0;

    for (unsigned r = 0; r < 5; r++) {
        const uint8_t *const p = rows[r] + x;
        sum += tap[0] * (int32_t)p[-2] + tap[1] * (int32_t)p[-1] + tap[2] * (int32_t)p[0] +
               tap[3] * (int32_t)p[1] + tap[4] * (int32_t)p[2];
        tap += 5;
    }
    return sum;
}

void pel_row_kernel5(const uint8_t *const rows[], const int8_t *tap, const pel_row_scale *scale,
                     uint16_t count, uint8_t *restrict out)
{
    const pel_row_scale s = *scale;

    for (int x = 0; x < count; x++) {
        out[x] = limited_u8(scaled(s.start + (uint32_t)sum5(rows, x, tap), &s));
    }
}

void pel_row_kernel5_s16(const uint8_t *const rows[], const int8_t *tap, const pel_row_scale *scale,
                         uint16_t count, int16_t *restrict out)
{
    const pel_row_scale s = *scale;

    for (int x = 0; x < count; x++) {
        out[x] = limited_s16(scaled(s.start + (uint32_t)sum5(rows, x, tap), &s));
    }
}

/* The separable ones add up each column once and keep the sums of the columns to the left. */
void pel_row_gauss3(const uint8_t *const rows[], uint16_t count, uint8_t *restrict out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];
    unsigned left = a[-1] + 2u * b[-1] + c[-1], middle = a[0] + 2u * b[0] + c[0];

    for (int x = 0; x < count; x++) {
        const unsigned right = a[x + 1] + 2u * b[x + 1] + c[x + 1];
        out[x] = (uint8_t)((left + 2 * middle + right + 8) >> 4);
        left = middle;
        middle = right;
    }
}

/* n / 9 is n * 7282 >> 16 for all n up to 2299. */
void pel_row_box3(const uint8_t *const rows[], uint16_t count, uint8_t *restrict out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];
    unsigned left = 0u + a[-1] + b[-1] + c[-1], middle = 0u + a[0] + b[0] + c[0];

    for (int x = 0; x < count; x++) {
        const unsigned right = 0u + a[x + 1] + b[x + 1] + c[x + 1];
        out[x] = (uint8_t)(((uint32_t)(left + middle + right + 4) * 7282) >> 16);
        left = middle;
        middle = right;
    }
}

/* At most 4080. */
static inline uint32_t binomial_column(const uint8_t *const rows[], int x)
{
    return rows[0][x] + 4u * (rows[1][x] + rows[3][x]) + 6u * rows[2][x] + rows[4][x];
}

void pel_row_binomial5(const uint8_t *const rows[], uint16_t count, uint8_t *restrict out)
{
    uint32_t c0 = binomial_column(rows, -2), c1 = binomial_column(rows, -1);
    uint32_t c2 = binomial_column(rows, 0), c3 = binomial_column(rows, 1);

    for (int x = 0; x < count; x++) {
        const uint32_t c4 = binomial_column(rows, x + 2);
        out[x] = (uint8_t)((c0 + 4 * (c1 + c3) + 6 * c2 + c4 + 128) >> 8);
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

/* Of a column: the sum 1 2 1 and the difference, lower less upper. */
typedef struct sobel_column {
    int32_t sum, difference;
} sobel_column;

static inline sobel_column sobel_at(const uint8_t *const rows[], int x)
{
    const int32_t a = rows[0][x], b = rows[1][x], c = rows[2][x];
    sobel_column column;

    column.sum = a + 2 * b + c;
    column.difference = c - a;
    return column;
}

static inline gradient gradient_of(sobel_column left, sobel_column here, sobel_column right)
{
    gradient g;

    g.x = right.sum - left.sum;
    g.y = left.difference + 2 * here.difference + right.difference;
    return g;
}

static inline int32_t magnitude(int32_t value)
{
    return value < 0 ? -value : value;
}

/* floor(sqrt(gx^2 + gy^2)): the square is at most 2080800 < 2^21, its root has 11 digits. */
static inline int32_t length_of(gradient g)
{
    uint32_t value = (uint32_t)(g.x * g.x + g.y * g.y), root = 0;

    for (uint32_t digit = (uint32_t)1 << 20; digit != 0; digit >>= 2) {
        const uint32_t trial = root + digit;
        root >>= 1;
        if (value >= trial) {
            value -= trial;
            root += digit;
        }
    }
    return (int32_t)root;
}

void pel_row_sobel_x(const uint8_t *const rows[], uint16_t count, int16_t *restrict out)
{
    sobel_column left = sobel_at(rows, -1), here = sobel_at(rows, 0);

    for (int x = 0; x < count; x++) {
        const sobel_column right = sobel_at(rows, x + 1);
        out[x] = (int16_t)gradient_of(left, here, right).x;
        left = here;
        here = right;
    }
}

void pel_row_sobel_y(const uint8_t *const rows[], uint16_t count, int16_t *restrict out)
{
    sobel_column left = sobel_at(rows, -1), here = sobel_at(rows, 0);

    for (int x = 0; x < count; x++) {
        const sobel_column right = sobel_at(rows, x + 1);
        out[x] = (int16_t)gradient_of(left, here, right).y;
        left = here;
        here = right;
    }
}

void pel_row_gradient_abs(const uint8_t *const rows[], uint16_t count, uint8_t *restrict out)
{
    sobel_column left = sobel_at(rows, -1), here = sobel_at(rows, 0);

    for (int x = 0; x < count; x++) {
        const sobel_column right = sobel_at(rows, x + 1);
        const gradient g = gradient_of(left, here, right);
        out[x] = limited_u8(magnitude(g.x) + magnitude(g.y));
        left = here;
        here = right;
    }
}

void pel_row_gradient_abs_s16(const uint8_t *const rows[], uint16_t count, int16_t *restrict out)
{
    sobel_column left = sobel_at(rows, -1), here = sobel_at(rows, 0);

    for (int x = 0; x < count; x++) {
        const sobel_column right = sobel_at(rows, x + 1);
        const gradient g = gradient_of(left, here, right);
        out[x] = (int16_t)(magnitude(g.x) + magnitude(g.y));
        left = here;
        here = right;
    }
}

void pel_row_gradient(const uint8_t *const rows[], uint16_t count, uint8_t *restrict out)
{
    sobel_column left = sobel_at(rows, -1), here = sobel_at(rows, 0);

    for (int x = 0; x < count; x++) {
        const sobel_column right = sobel_at(rows, x + 1);
        const gradient g = gradient_of(left, here, right);
        out[x] = limited_u8(length_of(g));
        left = here;
        here = right;
    }
}

void pel_row_gradient_s16(const uint8_t *const rows[], uint16_t count, int16_t *restrict out)
{
    sobel_column left = sobel_at(rows, -1), here = sobel_at(rows, 0);

    for (int x = 0; x < count; x++) {
        const sobel_column right = sobel_at(rows, x + 1);
        const gradient g = gradient_of(left, here, right);
        out[x] = (int16_t)length_of(g);
        left = here;
        here = right;
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

void pel_row_direction(const uint8_t *const rows[], uint16_t count, uint8_t *restrict out)
{
    sobel_column left = sobel_at(rows, -1), here = sobel_at(rows, 0);

    for (int x = 0; x < count; x++) {
        const sobel_column right = sobel_at(rows, x + 1);
        out[x] = (uint8_t)(direction_of(gradient_of(left, here, right)) & 255);
        left = here;
        here = right;
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

/* The three of a column in order. */
typedef struct column3 {
    uint8_t low, middle, high;
} column3;

static inline column3 sorted_column(const uint8_t *const rows[], int x)
{
    const uint8_t a = rows[0][x], b = rows[1][x], c = rows[2][x];
    const uint8_t low = smaller(a, b), high = larger(a, b);
    column3 sorted;

    sorted.low = smaller(low, c);
    sorted.middle = larger(low, smaller(high, c));
    sorted.high = larger(high, c);
    return sorted;
}

/* The median of nine is the middle one of: the largest of the columns' smallest, the middle of
 * their middles, and the smallest of their largest (Smith 1996, after Paeth). */
void pel_row_median3(const uint8_t *const rows[], uint16_t count, uint8_t *restrict out)
{
    column3 left = sorted_column(rows, -1), here = sorted_column(rows, 0);

    for (int x = 0; x < count; x++) {
        const column3 right = sorted_column(rows, x + 1);
        out[x] = middle_of(largest(left.low, here.low, right.low),
                           middle_of(left.middle, here.middle, right.middle),
                           smallest(left.high, here.high, right.high));
        left = here;
        here = right;
    }
}

void pel_row_min3(const uint8_t *const rows[], uint16_t count, uint8_t *restrict out)
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

void pel_row_max3(const uint8_t *const rows[], uint16_t count, uint8_t *restrict out)
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

void pel_row_majority3(const uint8_t *const rows[], uint16_t count, uint8_t *restrict out)
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

void pel_row_erode_labels3(const uint8_t *const rows[], uint16_t count, uint8_t *restrict out)
{
    for (int x = 0; x < count; x++) {
        uint8_t nine[9];
        gather9(rows, x, nine);
        out[x] = count_of(nine, nine[4]) == 9 ? nine[4] : 0;
    }
}

void pel_row_dilate_labels3(const uint8_t *const rows[], uint16_t count, uint8_t *restrict out)
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
