#include "unity.h"

#include <pel.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_every_backend_has_a_name_of_its_own(void)
{
    for (unsigned i = 0; i < PEL_BACKEND_COUNT; i++) {
        const char *const name = pel_backend_name((pel_backend)i);
        TEST_ASSERT_NOT_NULL(name);
        TEST_ASSERT_TRUE(name[0] != '\0');
        for (unsigned k = 0; k < i; k++) {
            unsigned c = 0;
            const char *const other = pel_backend_name((pel_backend)k);
            while (name[c] == other[c] && name[c] != '\0') {
                c++;
            }
            TEST_ASSERT_TRUE(name[c] != other[c]);
        }
    }
    TEST_ASSERT_NULL(pel_backend_name(PEL_BACKEND_COUNT));
}

static void test_plain_c_is_always_there(void)
{
    TEST_ASSERT_EQUAL_INT(1, pel_backend_available(PEL_BACKEND_AUTO));
    TEST_ASSERT_EQUAL_INT(1, pel_backend_available(PEL_BACKEND_SCALAR));
    TEST_ASSERT_EQUAL_INT(0, pel_backend_available(PEL_BACKEND_COUNT));
}

static void test_a_wish_becomes_something_that_runs(void)
{
    const pel_backend best = pel_backend_resolve(PEL_BACKEND_AUTO);

    TEST_ASSERT_TRUE(best != PEL_BACKEND_AUTO);
    for (unsigned i = PEL_BACKEND_SCALAR; i < PEL_BACKEND_COUNT; i++) {
        const int there = pel_backend_available((pel_backend)i);
        const pel_backend wanted = there ? (pel_backend)i : PEL_BACKEND_SCALAR;
        /* No values: what is computed here must be the same on every machine. */
        TEST_ASSERT_TRUE(pel_backend_resolve((pel_backend)i) == wanted);
        TEST_ASSERT_TRUE(!there || (unsigned)best >= i); /* in the order of what they do at once */
    }
    TEST_ASSERT_EQUAL_INT(PEL_BACKEND_SCALAR, pel_backend_resolve(PEL_BACKEND_COUNT));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_backend_has_a_name_of_its_own);
    RUN_TEST(test_plain_c_is_always_there);
    RUN_TEST(test_a_wish_becomes_something_that_runs);
    return UNITY_END();
}
