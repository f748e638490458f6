#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_that_passes(void)
{
    TEST_ASSERT_EQUAL_INT(4, 2 + 2);
}

static void test_that_fails(void)
{
    TEST_ASSERT_EQUAL_INT(5, 2 + 2);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_passes);
    RUN_TEST(test_that_fails);
    return UNITY_END();
}
