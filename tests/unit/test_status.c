/*
 * Statuses, compile-time choices, version: the small print that every other module relies on.
 *
 * The sign of a status tells the story, so its numbers are part of the contract: callers may write
 * `status < 0` for "refused" and `status > 0` for "done, but something was counted".
 */
#include "unity.h"

#include <pel.h>

/* From numbers to text at compile time: "0.1.0" out of 0, 1 and 0. */
#define TEXT_OF(number) TEXT(number)
#define TEXT(token) #token

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_done_is_zero_and_incomplete_is_positive(void)
{
    TEST_ASSERT_EQUAL_INT(0, PEL_OK);
    TEST_ASSERT_EQUAL_INT(1, PEL_TRUNCATED);
}

static void test_refusals_are_negative_and_keep_their_numbers(void)
{
    TEST_ASSERT_EQUAL_INT(-1, PEL_ERR_ARG);
    TEST_ASSERT_EQUAL_INT(-2, PEL_ERR_FORMAT);
    TEST_ASSERT_EQUAL_INT(-3, PEL_ERR_SPACE);
    TEST_ASSERT_EQUAL_INT(-4, PEL_ERR_RANGE);
    TEST_ASSERT_EQUAL_INT(-5, PEL_ERR_ORDER);
}

static void test_every_status_has_the_name_of_its_constant(void)
{
    TEST_ASSERT_EQUAL_STRING("PEL_OK", pel_status_name(PEL_OK));
    TEST_ASSERT_EQUAL_STRING("PEL_TRUNCATED", pel_status_name(PEL_TRUNCATED));
    TEST_ASSERT_EQUAL_STRING("PEL_ERR_ARG", pel_status_name(PEL_ERR_ARG));
    TEST_ASSERT_EQUAL_STRING("PEL_ERR_FORMAT", pel_status_name(PEL_ERR_FORMAT));
    TEST_ASSERT_EQUAL_STRING("PEL_ERR_SPACE", pel_status_name(PEL_ERR_SPACE));
    TEST_ASSERT_EQUAL_STRING("PEL_ERR_RANGE", pel_status_name(PEL_ERR_RANGE));
    TEST_ASSERT_EQUAL_STRING("PEL_ERR_ORDER", pel_status_name(PEL_ERR_ORDER));
}

static void test_a_value_that_is_no_status_is_a_question_mark(void)
{
    TEST_ASSERT_EQUAL_STRING("?", pel_status_name((pel_status)2));
    TEST_ASSERT_EQUAL_STRING("?", pel_status_name((pel_status)-6));
}

static void test_the_version_text_is_made_of_the_version_numbers(void)
{
    TEST_ASSERT_EQUAL_STRING(
        TEXT_OF(PEL_VERSION_MAJOR) "." TEXT_OF(PEL_VERSION_MINOR) "." TEXT_OF(PEL_VERSION_PATCH),
        PEL_VERSION);
}

static void test_the_library_is_the_one_of_the_headers(void)
{
    TEST_ASSERT_EQUAL_STRING(PEL_VERSION, pel_version());
}

static void test_a_class_mask_has_one_bit_per_class(void)
{
    TEST_ASSERT_EQUAL_UINT(PEL_CLASS_MAX, 8u * sizeof(pel_class_mask));
}

static void test_the_side_limit_is_the_one_that_the_bounds_assume(void)
{
    TEST_ASSERT_EQUAL_UINT(8192, PEL_SIDE_MAX);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_done_is_zero_and_incomplete_is_positive);
    RUN_TEST(test_refusals_are_negative_and_keep_their_numbers);
    RUN_TEST(test_every_status_has_the_name_of_its_constant);
    RUN_TEST(test_a_value_that_is_no_status_is_a_question_mark);
    RUN_TEST(test_the_version_text_is_made_of_the_version_numbers);
    RUN_TEST(test_the_library_is_the_one_of_the_headers);
    RUN_TEST(test_a_class_mask_has_one_bit_per_class);
    RUN_TEST(test_the_side_limit_is_the_one_that_the_bounds_assume);
    return UNITY_END();
}
