/*
 * Put before every suite by the build (-include). The linker catches most of Unity's checks on
 * their way (report.c); two never reach a function that could be caught, or reach it with numbers
 * that differ from machine to machine, and are turned aside here.
 */
#ifndef PEL_REPORT_H
#define PEL_REPORT_H

#include "unity.h"

/* Where things lie is the linker's choice: what counts is how far off a pointer is, 0 if right. */
void pel_report_pointer(const void *expected, const void *actual, const char *message,
                        UNITY_LINE_TYPE line);

/* Takes a truth value into the hash and returns it. */
int pel_report_truth(int truth);

/*
 * Bounds are also set to sizes of structs, which differ with the width of pointers: a constant
 * expression is no result. Of the two kinds of a conditional with a null pointer constant, C knows
 * which it is: (void *)(0) makes it int *, any other pointer void *, whose size is 1 here.
 */
#define PEL_IS_CONSTANT(value)                                                                     \
    (sizeof(*(8 ? (void *)((intptr_t)(value)*0) : (int *)8)) == sizeof(int))

/* Before a check: whether its value is left out of the hash. */
void pel_report_leave_out(int constant);

#define UnityAssertGreaterOrLessOrEqualNumber(threshold, actual, compare, message, line, style)    \
    (pel_report_leave_out(PEL_IS_CONSTANT(actual)),                                                \
     (UnityAssertGreaterOrLessOrEqualNumber)((threshold), (actual), (compare), (message), (line),  \
                                             (style)))

#undef UNITY_TEST_ASSERT_EQUAL_PTR
#define UNITY_TEST_ASSERT_EQUAL_PTR(expected, actual, line, message)                               \
    pel_report_pointer((expected), (actual), (message), (UNITY_LINE_TYPE)(line))

#undef UNITY_TEST_ASSERT
#define UNITY_TEST_ASSERT(condition, line, message)                                                \
    do {                                                                                           \
        if (!pel_report_truth((condition) ? 1 : 0)) {                                              \
            UnityFail((message), (UNITY_LINE_TYPE)(line));                                         \
        }                                                                                          \
    } while (0)

#endif
