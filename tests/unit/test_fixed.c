/*
 * Integer arithmetic: the one rounding rule (halves upward), the one saturation rule, and the
 * functions that elsewhere come from libm. The exhaustive checks are in tests/oracle; here stand
 * the values that show what each function means, and the borders where such functions break.
 */
#include "unity.h"

#include <pel.h>

#define TWO_30 1073741824

void setUp(void)
{
}

void tearDown(void)
{
}

/* ---- Rounding ------------------------------------------------------------------------------ */

static void test_round_shift_rounds_halves_upward(void)
{
    TEST_ASSERT_EQUAL_INT32(0, pel_round_shift(1, 2));  /*  0.25 */
    TEST_ASSERT_EQUAL_INT32(1, pel_round_shift(2, 2));  /*  0.5  */
    TEST_ASSERT_EQUAL_INT32(1, pel_round_shift(3, 2));  /*  0.75 */
    TEST_ASSERT_EQUAL_INT32(1, pel_round_shift(5, 2));  /*  1.25 */
    TEST_ASSERT_EQUAL_INT32(2, pel_round_shift(6, 2));  /*  1.5  */
    TEST_ASSERT_EQUAL_INT32(3, pel_round_shift(10, 2)); /*  2.5: not to even */
}

static void test_round_shift_of_negatives_also_rounds_halves_upward(void)
{
    TEST_ASSERT_EQUAL_INT32(0, pel_round_shift(-1, 2));   /* -0.25 */
    TEST_ASSERT_EQUAL_INT32(0, pel_round_shift(-2, 2));   /* -0.5: towards plus infinity */
    TEST_ASSERT_EQUAL_INT32(-1, pel_round_shift(-3, 2));  /* -0.75 */
    TEST_ASSERT_EQUAL_INT32(-1, pel_round_shift(-6, 2));  /* -1.5  */
    TEST_ASSERT_EQUAL_INT32(-2, pel_round_shift(-7, 2));  /* -1.75 */
    TEST_ASSERT_EQUAL_INT32(-2, pel_round_shift(-10, 2)); /* -2.5  */
}

static void test_round_shift_by_nothing_changes_nothing(void)
{
    TEST_ASSERT_EQUAL_INT32(0, pel_round_shift(0, 0));
    TEST_ASSERT_EQUAL_INT32(-7, pel_round_shift(-7, 0));
    TEST_ASSERT_EQUAL_INT32(TWO_30 - 1, pel_round_shift(TWO_30 - 1, 0));
    TEST_ASSERT_EQUAL_INT32(-(TWO_30 - 1), pel_round_shift(-(TWO_30 - 1), 0));
}

static void test_round_shift_at_the_ends_of_its_range(void)
{
    TEST_ASSERT_EQUAL_INT32(1, pel_round_shift(TWO_30 - 1, 30));
    TEST_ASSERT_EQUAL_INT32(-1, pel_round_shift(-(TWO_30 - 1), 30));
    TEST_ASSERT_EQUAL_INT32(1, pel_round_shift(TWO_30 / 2, 30));       /*  0.5 */
    TEST_ASSERT_EQUAL_INT32(0, pel_round_shift(TWO_30 / 2 - 1, 30));   /* just less */
    TEST_ASSERT_EQUAL_INT32(0, pel_round_shift(-TWO_30 / 2, 30));      /* -0.5 */
    TEST_ASSERT_EQUAL_INT32(-1, pel_round_shift(-TWO_30 / 2 - 1, 30)); /* just beyond */
    TEST_ASSERT_EQUAL_INT32(TWO_30 / 2, pel_round_shift(TWO_30 - 1, 1));
}

static void test_round_div_rounds_halves_upward(void)
{
    TEST_ASSERT_EQUAL_INT32(2, pel_round_div(7, 3));   /*  2.33 */
    TEST_ASSERT_EQUAL_INT32(3, pel_round_div(8, 3));   /*  2.67 */
    TEST_ASSERT_EQUAL_INT32(4, pel_round_div(7, 2));   /*  3.5  */
    TEST_ASSERT_EQUAL_INT32(3, pel_round_div(5, 2));   /*  2.5  */
    TEST_ASSERT_EQUAL_INT32(-2, pel_round_div(-7, 3)); /* -2.33 */
    TEST_ASSERT_EQUAL_INT32(-3, pel_round_div(-8, 3)); /* -2.67 */
    TEST_ASSERT_EQUAL_INT32(-3, pel_round_div(-7, 2)); /* -3.5  */
    TEST_ASSERT_EQUAL_INT32(-2, pel_round_div(-5, 2)); /* -2.5  */
    TEST_ASSERT_EQUAL_INT32(0, pel_round_div(-1, 2));  /* -0.5  */
    TEST_ASSERT_EQUAL_INT32(1, pel_round_div(1, 2));   /*  0.5  */
    TEST_ASSERT_EQUAL_INT32(0, pel_round_div(0, 9));
}

static void test_round_div_at_the_ends_of_its_range(void)
{
    TEST_ASSERT_EQUAL_INT32(TWO_30, pel_round_div(TWO_30, 1));
    TEST_ASSERT_EQUAL_INT32(-TWO_30, pel_round_div(-TWO_30, 1));
    TEST_ASSERT_EQUAL_INT32(1, pel_round_div(TWO_30, TWO_30));
    TEST_ASSERT_EQUAL_INT32(-1, pel_round_div(-TWO_30, TWO_30));
    TEST_ASSERT_EQUAL_INT32(1, pel_round_div(TWO_30 / 2, TWO_30));       /*  0.5 */
    TEST_ASSERT_EQUAL_INT32(0, pel_round_div(TWO_30 / 2 - 1, TWO_30));   /* just less */
    TEST_ASSERT_EQUAL_INT32(0, pel_round_div(-TWO_30 / 2, TWO_30));      /* -0.5 */
    TEST_ASSERT_EQUAL_INT32(-1, pel_round_div(-TWO_30 / 2 - 1, TWO_30)); /* just beyond */
    TEST_ASSERT_EQUAL_INT32(0, pel_round_div(1, TWO_30));
    TEST_ASSERT_EQUAL_INT32(0, pel_round_div(-1, TWO_30));
}

static void test_shift_and_division_by_the_same_power_agree(void)
{
    for (int32_t value = -70; value <= 70; value++) {
        for (unsigned bits = 0; bits <= 6; bits++) {
            TEST_ASSERT_EQUAL_INT32(pel_round_div(value, (int32_t)1 << bits),
                                    pel_round_shift(value, bits));
        }
    }
}

/* ---- Saturation ---------------------------------------------------------------------------- */

static void test_saturate_u8_at_its_borders(void)
{
    TEST_ASSERT_EQUAL_UINT8(0, pel_saturate_u8(INT32_MIN));
    TEST_ASSERT_EQUAL_UINT8(0, pel_saturate_u8(-1));
    TEST_ASSERT_EQUAL_UINT8(0, pel_saturate_u8(0));
    TEST_ASSERT_EQUAL_UINT8(1, pel_saturate_u8(1));
    TEST_ASSERT_EQUAL_UINT8(254, pel_saturate_u8(254));
    TEST_ASSERT_EQUAL_UINT8(255, pel_saturate_u8(255));
    TEST_ASSERT_EQUAL_UINT8(255, pel_saturate_u8(256));
    TEST_ASSERT_EQUAL_UINT8(255, pel_saturate_u8(INT32_MAX));
}

static void test_saturate_s16_at_its_borders(void)
{
    TEST_ASSERT_EQUAL_INT16(-32768, pel_saturate_s16(INT32_MIN));
    TEST_ASSERT_EQUAL_INT16(-32768, pel_saturate_s16(-32769));
    TEST_ASSERT_EQUAL_INT16(-32768, pel_saturate_s16(-32768));
    TEST_ASSERT_EQUAL_INT16(-32767, pel_saturate_s16(-32767));
    TEST_ASSERT_EQUAL_INT16(0, pel_saturate_s16(0));
    TEST_ASSERT_EQUAL_INT16(32767, pel_saturate_s16(32767));
    TEST_ASSERT_EQUAL_INT16(32767, pel_saturate_s16(32768));
    TEST_ASSERT_EQUAL_INT16(32767, pel_saturate_s16(INT32_MAX));
}

/* ---- Square root --------------------------------------------------------------------------- */

/* By definition: r*r <= value < (r+1)*(r+1), in twice the width so that nothing wraps. */
static int is_root_of_32(uint32_t root, uint32_t value)
{
    const uint64_t r = root;
    return r * r <= value && (r + 1) * (r + 1) > value;
}

/* The same for 64 bits; the square of 2^32 does not fit and is more than any value. */
static int is_root_of_64(uint32_t root, uint64_t value)
{
    const uint64_t r = root;
    return r * r <= value && (root == UINT32_MAX || (r + 1) * (r + 1) > value);
}

static void test_isqrt32_of_small_numbers(void)
{
    static const uint8_t root[18] = {0, 1, 1, 1, 2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 3, 4, 4};
    for (uint32_t value = 0; value < 18; value++) {
        TEST_ASSERT_EQUAL_UINT16(root[value], pel_isqrt32(value));
    }
}

static void test_isqrt32_around_squares(void)
{
    for (uint32_t r = 1; r < 65536; r += 97) {
        TEST_ASSERT_EQUAL_UINT16(r - 1, pel_isqrt32(r * r - 1));
        TEST_ASSERT_EQUAL_UINT16(r, pel_isqrt32(r * r));
        TEST_ASSERT_EQUAL_UINT16(r, pel_isqrt32(r * r + 1));
        TEST_ASSERT_TRUE(is_root_of_32(pel_isqrt32(r * r + r), r * r + r));
    }
}

static void test_isqrt32_at_its_end(void)
{
    TEST_ASSERT_EQUAL_UINT16(65535, pel_isqrt32(UINT32_MAX));
    TEST_ASSERT_EQUAL_UINT16(65535, pel_isqrt32(65535u * UINT32_C(65535)));
    TEST_ASSERT_EQUAL_UINT16(65534, pel_isqrt32(65535u * UINT32_C(65535) - 1u));
    TEST_ASSERT_EQUAL_UINT16(32768, pel_isqrt32(0x40000000u));
    TEST_ASSERT_EQUAL_UINT16(46340, pel_isqrt32(0x7fffffffu));
}

static void test_isqrt64_equals_isqrt32_where_both_apply(void)
{
    for (uint32_t value = 0; value < 300; value++) {
        TEST_ASSERT_EQUAL_UINT32(pel_isqrt32(value), pel_isqrt64(value));
    }
    TEST_ASSERT_EQUAL_UINT32(65535, pel_isqrt64(UINT32_MAX));
    TEST_ASSERT_EQUAL_UINT32(65536, pel_isqrt64((uint64_t)UINT32_MAX + 1));
}

static void test_isqrt64_around_squares(void)
{
    static const uint32_t roots[] = {1,          2,          65535,      65536,
                                     65537,      1000000,    2147483647, 2147483648,
                                     3037000499, 3037000500, 4294967294, 4294967295};
    for (unsigned i = 0; i < sizeof roots / sizeof roots[0]; i++) {
        const uint64_t square = (uint64_t)roots[i] * roots[i];
        TEST_ASSERT_EQUAL_UINT32(roots[i] - 1, pel_isqrt64(square - 1));
        TEST_ASSERT_EQUAL_UINT32(roots[i], pel_isqrt64(square));
        TEST_ASSERT_EQUAL_UINT32(roots[i], pel_isqrt64(square + 1));
        TEST_ASSERT_TRUE(is_root_of_64(pel_isqrt64(square + roots[i]), square + roots[i]));
    }
}

static void test_isqrt64_at_its_end(void)
{
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, pel_isqrt64(UINT64_MAX));
    for (unsigned bit = 0; bit < 64; bit++) {
        const uint64_t value = (uint64_t)1 << bit;
        TEST_ASSERT_TRUE(is_root_of_64(pel_isqrt64(value), value));
        TEST_ASSERT_TRUE(is_root_of_64(pel_isqrt64(value - 1), value - 1));
    }
}

/* ---- Angle --------------------------------------------------------------------------------- */

/* The difference of two angles the short way round: -32768 and 32767 are neighbours. */
static int32_t turn_between(int32_t from, int32_t to)
{
    const uint32_t around = (uint32_t)(to - from) & 0xffffu;
    return around < 32768u ? (int32_t)around : (int32_t)around - 65536;
}

/* Whether an angle lies within 1 unit of the true one, which is between `below` and `below` + 1. */
static int angle_is_near(int16_t angle, int32_t below)
{
    const int32_t off = turn_between(below, angle);
    return off == 0 || off == 1;
}

static void test_atan2_along_the_axes(void)
{
    TEST_ASSERT_EQUAL_INT16(0, pel_atan2_turn16(0, 1));
    TEST_ASSERT_EQUAL_INT16(16384, pel_atan2_turn16(1, 0));
    TEST_ASSERT_EQUAL_INT16(-16384, pel_atan2_turn16(-1, 0));
    TEST_ASSERT_EQUAL_INT16(-32768, pel_atan2_turn16(0, -1));
    TEST_ASSERT_EQUAL_INT16(0, pel_atan2_turn16(0, TWO_30));
    TEST_ASSERT_EQUAL_INT16(16384, pel_atan2_turn16(TWO_30, 0));
    TEST_ASSERT_EQUAL_INT16(-16384, pel_atan2_turn16(-TWO_30, 0));
    TEST_ASSERT_EQUAL_INT16(-32768, pel_atan2_turn16(0, -TWO_30));
}

static void test_atan2_of_no_direction_is_zero(void)
{
    TEST_ASSERT_EQUAL_INT16(0, pel_atan2_turn16(0, 0));
}

static void test_atan2_along_the_diagonals(void)
{
    static const int32_t lengths[] = {1, 2, 3, 1000, 65536, TWO_30};
    for (unsigned i = 0; i < sizeof lengths / sizeof lengths[0]; i++) {
        const int32_t n = lengths[i];
        TEST_ASSERT_INT16_WITHIN(1, 8192, pel_atan2_turn16(n, n));
        TEST_ASSERT_INT16_WITHIN(1, 24576, pel_atan2_turn16(n, -n));
        TEST_ASSERT_INT16_WITHIN(1, -24576, pel_atan2_turn16(-n, -n));
        TEST_ASSERT_INT16_WITHIN(1, -8192, pel_atan2_turn16(-n, n));
    }
}

/* True angles by calculator: atan(y / x) * 65536 / 360 degrees. */
static void test_atan2_of_known_triangles(void)
{
    TEST_ASSERT_TRUE(angle_is_near(pel_atan2_turn16(3, 4), 6711));  /* 36.8699 degrees: 6711.96 */
    TEST_ASSERT_TRUE(angle_is_near(pel_atan2_turn16(1, 2), 4836));  /* 26.5651 degrees: 4836.02 */
    TEST_ASSERT_TRUE(angle_is_near(pel_atan2_turn16(5, 12), 4117)); /* 22.6199 degrees: 4117.82 */
    TEST_ASSERT_TRUE(angle_is_near(pel_atan2_turn16(1, 1000), 10)); /*  0.0573 degrees:   10.43 */
    TEST_ASSERT_TRUE(
        angle_is_near(pel_atan2_turn16(1, -2), 27931)); /* 32768 - 4836.02 = 27931.98 */
    TEST_ASSERT_TRUE(angle_is_near(pel_atan2_turn16(-1, -2), -27932));
}

static void test_atan2_does_not_depend_on_the_length(void)
{
    for (unsigned bits = 0; bits <= 28; bits++) {
        const int32_t scale = (int32_t)1 << bits;
        TEST_ASSERT_TRUE(angle_is_near(pel_atan2_turn16(3 * scale, 4 * scale), 6711));
    }
}

/* Two results within 1 unit each are within 2 of being mirror pictures of each other. */
static void test_atan2_is_symmetric(void)
{
    for (int32_t y = 1; y <= 20; y++) {
        for (int32_t x = 1; x <= 20; x++) {
            const int32_t a = pel_atan2_turn16(y, x);
            const int32_t mirrored_y = turn_between(-a, pel_atan2_turn16(-y, x));
            const int32_t mirrored_x = turn_between(32768 - a, pel_atan2_turn16(y, -x));
            const int32_t swapped = turn_between(16384 - a, pel_atan2_turn16(x, y));
            TEST_ASSERT_INT32_WITHIN(2, 0, mirrored_y);
            TEST_ASSERT_INT32_WITHIN(2, 0, mirrored_x);
            TEST_ASSERT_INT32_WITHIN(2, 0, swapped);
        }
    }
}

/* ---- Reciprocal ---------------------------------------------------------------------------- */

static void test_reciprocal_of_known_divisors(void)
{
    TEST_ASSERT_EQUAL_HEX32(0x80000000u, pel_reciprocal_q32(2));
    TEST_ASSERT_EQUAL_UINT32(1431655765u, pel_reciprocal_q32(3)); /* ...765.33 */
    TEST_ASSERT_EQUAL_UINT32(613566757u, pel_reciprocal_q32(7));  /* ...756.57 */
    TEST_ASSERT_EQUAL_UINT32(4294967u, pel_reciprocal_q32(1000)); /* ...967.296 */
    TEST_ASSERT_EQUAL_HEX32(0x00010000u, pel_reciprocal_q32(65536));
}

static void test_reciprocal_saturates_where_it_does_not_fit(void)
{
    TEST_ASSERT_EQUAL_HEX32(UINT32_MAX, pel_reciprocal_q32(0));
    TEST_ASSERT_EQUAL_HEX32(UINT32_MAX, pel_reciprocal_q32(1));
}

static void test_reciprocal_of_large_divisors(void)
{
    TEST_ASSERT_EQUAL_UINT32(2, pel_reciprocal_q32(0x80000000u));
    TEST_ASSERT_EQUAL_UINT32(2, pel_reciprocal_q32(0x80000001u)); /* 1.9999 */
    TEST_ASSERT_EQUAL_UINT32(2, pel_reciprocal_q32(0xaaaaaaaau)); /* just over 1.5 */
    TEST_ASSERT_EQUAL_UINT32(1, pel_reciprocal_q32(0xaaaaaaabu)); /* just under 1.5 */
    TEST_ASSERT_EQUAL_UINT32(1, pel_reciprocal_q32(UINT32_MAX));
}

/* What the function is for: a multiplication in place of a division, never more than one off. */
static void test_reciprocal_divides_within_one(void)
{
    static const uint32_t divisors[] = {2,     3,       7,           255,       1000,
                                        65537, 1000003, 0x7fffffffu, UINT32_MAX};
    static const uint32_t values[] = {0, 1, 254, 255, 65536, 999999, 0x80000000u, UINT32_MAX};
    for (unsigned d = 0; d < sizeof divisors / sizeof divisors[0]; d++) {
        const uint64_t reciprocal = pel_reciprocal_q32(divisors[d]);
        for (unsigned v = 0; v < sizeof values / sizeof values[0]; v++) {
            const uint32_t quotient = (uint32_t)((values[v] * reciprocal) >> 32);
            TEST_ASSERT_UINT32_WITHIN(1, values[v] / divisors[d], quotient);
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_round_shift_rounds_halves_upward);
    RUN_TEST(test_round_shift_of_negatives_also_rounds_halves_upward);
    RUN_TEST(test_round_shift_by_nothing_changes_nothing);
    RUN_TEST(test_round_shift_at_the_ends_of_its_range);
    RUN_TEST(test_round_div_rounds_halves_upward);
    RUN_TEST(test_round_div_at_the_ends_of_its_range);
    RUN_TEST(test_shift_and_division_by_the_same_power_agree);
    RUN_TEST(test_saturate_u8_at_its_borders);
    RUN_TEST(test_saturate_s16_at_its_borders);
    RUN_TEST(test_isqrt32_of_small_numbers);
    RUN_TEST(test_isqrt32_around_squares);
    RUN_TEST(test_isqrt32_at_its_end);
    RUN_TEST(test_isqrt64_equals_isqrt32_where_both_apply);
    RUN_TEST(test_isqrt64_around_squares);
    RUN_TEST(test_isqrt64_at_its_end);
    RUN_TEST(test_atan2_along_the_axes);
    RUN_TEST(test_atan2_of_no_direction_is_zero);
    RUN_TEST(test_atan2_along_the_diagonals);
    RUN_TEST(test_atan2_of_known_triangles);
    RUN_TEST(test_atan2_does_not_depend_on_the_length);
    RUN_TEST(test_atan2_is_symmetric);
    RUN_TEST(test_reciprocal_of_known_divisors);
    RUN_TEST(test_reciprocal_saturates_where_it_does_not_fit);
    RUN_TEST(test_reciprocal_of_large_divisors);
    RUN_TEST(test_reciprocal_divides_within_one);
    return UNITY_END();
}
