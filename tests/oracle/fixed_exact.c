/*
 * The integer arithmetic of fixed.h against its definitions in wider types, and the angle against
 * atan2l of the host's libm: everything near the places where such functions break, and millions of
 * stratified samples of the rest.
 */
#include "check.h"

#include <math.h>
#include <pel.h>

#define TWO_30 ((int32_t)1 << 30)
#define COUNT_OF(array) (sizeof(array) / sizeof((array)[0]))

static uint64_t seed = UINT64_C(0x9e3779b97f4a7c15);

/* ---- Rounding ------------------------------------------------------------------------------ */

/* floor(n / d + 1/2) = floor((2 n + d) / (2 d)), d > 0. */
static int64_t rounded(int64_t n, int64_t d)
{
    const int64_t numerator = 2 * n + d, divisor = 2 * d;
    const int64_t quotient = numerator / divisor;
    return numerator % divisor < 0 ? quotient - 1 : quotient;
}

/* A number of -limit..limit whose magnitude may be of any size. */
static int32_t random_signed(int32_t limit)
{
    const uint32_t magnitude = random_below(&seed, (uint32_t)limit + 1) >> random_below(&seed, 30);
    return random_below(&seed, 2) ? (int32_t)magnitude : -(int32_t)magnitude;
}

static void check_round_div(tally *checks)
{
    uint64_t compared = 0, wrong = 0;

    for (int32_t n = -1000; n <= 1000; n++) {
        for (int32_t d = 1; d <= 1000; d++) {
            wrong += pel_round_div(n, d) != rounded(n, d);
            compared++;
        }
    }
    for (unsigned i = 0; i < 4000000; i++) {
        const int32_t any = random_signed(TWO_30 - 1);
        const int32_t d = any < 0 ? -any : any + 1;
        const int32_t n = i % 2 ? random_signed(TWO_30) : (i % 4 ? TWO_30 : -TWO_30) / 2 + any / 2;
        wrong += pel_round_div(n, d) != rounded(n, d);
        compared++;
    }
    check(checks, "round_div", compared, wrong);
}

/* All numerators around an odd multiple of half a divisor: there the rule shows. */
static void check_round_div_at_halves(tally *checks)
{
    uint64_t compared = 0, wrong = 0;

    for (unsigned i = 0; i < 1000000; i++) {
        const int32_t any = random_signed(TWO_30 / 2 - 1);
        const int32_t half = any < 0 ? -any : any + 1; /* divisor 2 half <= 2^30 */
        const int32_t most = TWO_30 / half / 2 - 1;
        const int32_t odd = most > 0 ? 2 * (random_signed(most)) + 1 : 1;
        for (int32_t n = odd * half - 1; n <= odd * half + 1; n++) {
            wrong += pel_round_div(n, 2 * half) != rounded(n, 2 * half);
            compared++;
        }
    }
    check(checks, "round_div at halves", compared, wrong);
}

static void check_round_shift(tally *checks)
{
    uint64_t compared = 0, wrong = 0;

    for (unsigned bits = 0; bits <= 30; bits++) {
        for (int32_t value = -70000; value <= 70000; value++) {
            wrong += pel_round_shift(value, bits) != rounded(value, (int64_t)1 << bits);
            compared++;
        }
        for (unsigned i = 0; i < 100000; i++) {
            const int32_t value = random_signed(TWO_30 - 1);
            wrong += pel_round_shift(value, bits) != rounded(value, (int64_t)1 << bits);
            compared++;
        }
    }
    check(checks, "round_shift", compared, wrong);
}

static void check_saturation(tally *checks)
{
    static const int32_t far[] = {INT32_MIN, INT32_MIN + 1, -TWO_30,
                                  TWO_30,    INT32_MAX - 1, INT32_MAX};
    uint64_t compared = 0, wrong = 0;

    for (int32_t i = -100000; i <= 100000 + (int32_t)COUNT_OF(far); i++) {
        const int32_t value = i <= 100000 ? i : far[i - 100001];
        const int32_t byte = value < 0 ? 0 : value > 255 ? 255 : value;
        const int32_t word = value < -32768 ? -32768 : value > 32767 ? 32767 : value;
        wrong += pel_saturate_u8(value) != byte || pel_saturate_s16(value) != word;
        compared++;
    }
    check(checks, "saturate_u8, saturate_s16", compared, wrong);
}

/* ---- Square roots -------------------------------------------------------------------------- */

static int is_root(uint64_t root, uint64_t value)
{
    return root * root <= value && (root == UINT32_MAX || (root + 1) * (root + 1) > value);
}

static void check_isqrt32(tally *checks)
{
    uint64_t compared = 0, wrong = 0;

    for (uint32_t r = 1; r < 65536; r++) { /* where the root changes: both sides of every square */
        wrong += pel_isqrt32(r * r) != r;
        wrong += pel_isqrt32(r * r - 1) != r - 1;
        compared += 2;
    }
    for (uint32_t i = 0; i < (uint32_t)1 << 24; i++) { /* one in each stretch of 256 */
        const uint32_t value = i << 8 | random_below(&seed, 256);
        wrong += !is_root(pel_isqrt32(value), value);
        compared++;
    }
    wrong += pel_isqrt32(UINT32_MAX) != 65535;
    check(checks, "isqrt32", compared + 1, wrong);
}

static void check_isqrt64(tally *checks)
{
    uint64_t compared = 0, wrong = 0;

    for (unsigned i = 0; i < 1000000; i++) {
        /* Roots of all sizes, and the last ones before 2^32. */
        const uint32_t any = (uint32_t)(random_next(&seed) >> 32) >> i % 32;
        const uint32_t root = i < 1000 ? UINT32_MAX - i : any > 0 ? any : 1;
        const uint64_t square = (uint64_t)root * root;
        wrong += pel_isqrt64(square) != root;
        wrong += pel_isqrt64(square - 1) != root - 1;
        wrong += pel_isqrt64(square + 2 * (uint64_t)root) != root;
        compared += 3;
    }
    for (unsigned i = 0; i < 4000000; i++) {
        const uint64_t value = random_next(&seed) >> i % 64;
        wrong += !is_root(pel_isqrt64(value), value);
        compared++;
    }
    wrong += pel_isqrt64(UINT64_MAX) != UINT32_MAX || pel_isqrt64(0) != 0;
    check(checks, "isqrt64", compared + 1, wrong);
}

/* ---- Angle --------------------------------------------------------------------------------- */

typedef struct worst {
    long double error;
    int32_t y, x;
    uint64_t compared;
} worst;

/* How far an angle is from the true one, in 1/65536 of a turn, the short way round. */
static void measure_angle(worst *worst_seen, int32_t y, int32_t x)
{
    const long double units = 65536.0L / (2.0L * acosl(-1.0L));
    const long double exact = atan2l((long double)y, (long double)x) * units;
    const long double error = fabsl(remainderl(pel_atan2_turn16(y, x) - exact, 65536.0L));

    worst_seen->compared++;
    if (error > worst_seen->error) {
        worst_seen->error = error;
        worst_seen->y = y;
        worst_seen->x = x;
    }
}

static void check_angle(tally *checks, const char *name, const worst *worst_seen)
{
    printf("     %s: at worst %.4Lf units, at y %ld, x %ld\n", name, worst_seen->error,
           (long)worst_seen->y, (long)worst_seen->x);
    check(checks, name, worst_seen->compared, worst_seen->error > 1.0L);
}

static void check_atan2_of_small_vectors(tally *checks)
{
    worst seen = {0, 0, 0, 0};

    for (int32_t y = -500; y <= 500; y++) {
        for (int32_t x = -500; x <= 500; x++) {
            if (x != 0 || y != 0) {
                measure_angle(&seen, y, x);
            }
        }
    }
    check_angle(checks, "atan2 within 1 unit, all vectors up to 500", &seen);
}

static void check_atan2_of_all_sizes(tally *checks)
{
    worst seen = {0, 0, 0, 0};

    for (unsigned i = 0; i < 3000000; i++) {
        const int32_t y = random_signed(TWO_30), x = random_signed(TWO_30);
        if (x != 0 || y != 0) {
            measure_angle(&seen, y, x);
        }
    }
    check_angle(checks, "atan2 within 1 unit, vectors of all sizes", &seen);
}

/* The long sides of the square of +-2^30, its corners, and every power of two beside each axis. */
static void check_atan2_at_the_border(tally *checks)
{
    worst seen = {0, 0, 0, 0};

    for (int32_t i = -1024; i <= 1024; i++) {
        const int32_t along = i * (TWO_30 / 1024);
        measure_angle(&seen, TWO_30, along);
        measure_angle(&seen, -TWO_30, along);
        measure_angle(&seen, along, TWO_30);
        measure_angle(&seen, along, -TWO_30);
    }
    for (unsigned k = 0; k < 31 * 31; k++) {
        const int32_t a = (int32_t)1 << k / 31, b = (int32_t)1 << k % 31;
        for (int32_t d = -1; d <= 0; d++) {
            measure_angle(&seen, a + d, b);
            measure_angle(&seen, -(a + d), b);
            measure_angle(&seen, a + d, -b);
            measure_angle(&seen, -(a + d), -b);
        }
    }
    check_angle(checks, "atan2 within 1 unit, borders and powers of two", &seen);
}

/* ---- Reciprocal ---------------------------------------------------------------------------- */

static uint32_t exact_reciprocal(uint32_t divisor)
{
    const uint64_t d = divisor;
    return divisor < 2 ? UINT32_MAX : (uint32_t)((((uint64_t)1 << 33) + d) / (2 * d));
}

static void check_reciprocal(tally *checks)
{
    uint64_t compared = 0, wrong = 0;

    for (uint32_t d = 0; d < (uint32_t)1 << 20; d++) {
        wrong += pel_reciprocal_q32(d) != exact_reciprocal(d);
        wrong += pel_reciprocal_q32(UINT32_MAX - d) != exact_reciprocal(UINT32_MAX - d);
        compared += 2;
    }
    for (uint32_t i = 0; i < (uint32_t)1 << 23; i++) { /* one in each stretch of 512 */
        const uint32_t d = i << 9 | random_below(&seed, 512);
        wrong += pel_reciprocal_q32(d) != exact_reciprocal(d);
        compared++;
    }
    check(checks, "reciprocal", compared, wrong);
}

static void check_division_by_reciprocal(tally *checks)
{
    uint64_t compared = 0, wrong = 0;

    for (unsigned i = 0; i < 4000000; i++) {
        const uint32_t d = ((uint32_t)(random_next(&seed) >> 32) >> i % 31) | 2;
        const uint32_t value = i % 5 ? (uint32_t)(random_next(&seed) >> 32) : UINT32_MAX - i % 3;
        const int64_t quotient = (int64_t)(((uint64_t)value * pel_reciprocal_q32(d)) >> 32);
        const int64_t off = quotient - value / d;
        wrong += off < -1 || off > 1;
        compared++;
    }
    check(checks, "division by reciprocal within 1", compared, wrong);
}

int main(void)
{
    tally checks = {0, 0};

    check_round_div(&checks);
    check_round_div_at_halves(&checks);
    check_round_shift(&checks);
    check_saturation(&checks);
    check_isqrt32(&checks);
    check_isqrt64(&checks);
    check_atan2_of_small_vectors(&checks);
    check_atan2_of_all_sizes(&checks);
    check_atan2_at_the_border(&checks);
    check_reciprocal(&checks);
    check_division_by_reciprocal(&checks);
    return checks_end(&checks);
}
