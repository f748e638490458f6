/*
 * One hash of all that a suite computes. The program is linked with --wrap for Unity's checks, so
 * each comes here first: the actual value goes into the hash, and then the check runs as ever.
 *
 * The hash is FNV-1a over each value as 8 bytes, lowest first: neither the byte order nor the width
 * of int matter, and elements of arrays count one by one.
 */
#include "report.h"

#include <stddef.h>
#include <stdint.h>

#include "machine.h"

static uint64_t hash = 0xcbf29ce484222325u;
static uint32_t values;
static int left_out;

static void take(UNITY_INT value)
{
    uint64_t rest = (uint64_t)value;
    for (int i = 0; i < 8; i++) {
        hash = (hash ^ (rest & 255u)) * 0x100000001b3u;
        rest >>= 8;
    }
    values++;
}

/* Styles carry the width in bytes and whether numbers are signed. */
static void take_typed(UNITY_INT value, UNITY_DISPLAY_STYLE_T style)
{
    const unsigned width = (unsigned)style & 15u;
    if (((unsigned)style & UNITY_DISPLAY_RANGE_INT) == 0 && width < 8) {
        value = (UNITY_INT)((uint64_t)value & ((1ull << (8 * width)) - 1));
    }
    take(value);
}

static UNITY_INT element(const void *array, uint32_t index, UNITY_DISPLAY_STYLE_T style)
{
    const int is_signed = ((unsigned)style & UNITY_DISPLAY_RANGE_INT) != 0;
    switch ((unsigned)style & 15u) {
    case 1:
        return is_signed ? ((const int8_t *)array)[index] : ((const uint8_t *)array)[index];
    case 2:
        return is_signed ? ((const int16_t *)array)[index] : ((const uint16_t *)array)[index];
    case 4:
        return is_signed ? ((const int32_t *)array)[index]
                         : (UNITY_INT)((const uint32_t *)array)[index];
    default:
        return ((const UNITY_INT *)array)[index];
    }
}

static void take_array(const void *array, uint32_t count, UNITY_DISPLAY_STYLE_T style)
{
    for (uint32_t i = 0; i < count && array != NULL; i++) {
        take(element(array, i, style));
    }
}

static void take_text(const char *text)
{
    for (; text != NULL && *text != '\0'; text++) {
        take((unsigned char)*text);
    }
    take(0);
}

void pel_report_leave_out(int constant)
{
    left_out = constant;
}

int pel_report_truth(int truth)
{
    take(truth);
    return truth;
}

void __real_UnityAssertEqualNumber(UNITY_INT, UNITY_INT, const char *, UNITY_LINE_TYPE,
                                   UNITY_DISPLAY_STYLE_T);
void __wrap_UnityAssertEqualNumber(UNITY_INT expected, UNITY_INT actual, const char *message,
                                   UNITY_LINE_TYPE line, UNITY_DISPLAY_STYLE_T style);
void __real_UnityAssertGreaterOrLessOrEqualNumber(UNITY_INT, UNITY_INT, UNITY_COMPARISON_T,
                                                  const char *, UNITY_LINE_TYPE,
                                                  UNITY_DISPLAY_STYLE_T);
void __wrap_UnityAssertGreaterOrLessOrEqualNumber(UNITY_INT threshold, UNITY_INT actual,
                                                  UNITY_COMPARISON_T compare, const char *message,
                                                  UNITY_LINE_TYPE line,
                                                  UNITY_DISPLAY_STYLE_T style);
void __real_UnityAssertEqualIntArray(UNITY_INTERNAL_PTR, UNITY_INTERNAL_PTR, UNITY_UINT32,
                                     const char *, UNITY_LINE_TYPE, UNITY_DISPLAY_STYLE_T,
                                     UNITY_FLAGS_T);
void __wrap_UnityAssertEqualIntArray(UNITY_INTERNAL_PTR expected, UNITY_INTERNAL_PTR actual,
                                     UNITY_UINT32 count, const char *message, UNITY_LINE_TYPE line,
                                     UNITY_DISPLAY_STYLE_T style, UNITY_FLAGS_T flags);
void __real_UnityAssertBits(UNITY_INT, UNITY_INT, UNITY_INT, const char *, UNITY_LINE_TYPE);
void __wrap_UnityAssertBits(UNITY_INT mask, UNITY_INT expected, UNITY_INT actual,
                            const char *message, UNITY_LINE_TYPE line);
void __real_UnityAssertEqualString(const char *, const char *, const char *, UNITY_LINE_TYPE);
void __wrap_UnityAssertEqualString(const char *expected, const char *actual, const char *message,
                                   UNITY_LINE_TYPE line);
void __real_UnityAssertEqualMemory(UNITY_INTERNAL_PTR, UNITY_INTERNAL_PTR, UNITY_UINT32,
                                   UNITY_UINT32, const char *, UNITY_LINE_TYPE, UNITY_FLAGS_T);
void __wrap_UnityAssertEqualMemory(UNITY_INTERNAL_PTR expected, UNITY_INTERNAL_PTR actual,
                                   UNITY_UINT32 length, UNITY_UINT32 count, const char *message,
                                   UNITY_LINE_TYPE line, UNITY_FLAGS_T flags);
void __real_UnityAssertNumbersWithin(UNITY_UINT, UNITY_INT, UNITY_INT, const char *,
                                     UNITY_LINE_TYPE, UNITY_DISPLAY_STYLE_T);
void __wrap_UnityAssertNumbersWithin(UNITY_UINT delta, UNITY_INT expected, UNITY_INT actual,
                                     const char *message, UNITY_LINE_TYPE line,
                                     UNITY_DISPLAY_STYLE_T style);
void __real_UnityAssertNumbersArrayWithin(UNITY_UINT, UNITY_INTERNAL_PTR, UNITY_INTERNAL_PTR,
                                          UNITY_UINT32, const char *, UNITY_LINE_TYPE,
                                          UNITY_DISPLAY_STYLE_T, UNITY_FLAGS_T);
void __wrap_UnityAssertNumbersArrayWithin(UNITY_UINT delta, UNITY_INTERNAL_PTR expected,
                                          UNITY_INTERNAL_PTR actual, UNITY_UINT32 count,
                                          const char *message, UNITY_LINE_TYPE line,
                                          UNITY_DISPLAY_STYLE_T style, UNITY_FLAGS_T flags);
int __real_UnityEnd(void);
int __wrap_UnityEnd(void);

void pel_report_pointer(const void *expected, const void *actual, const char *message,
                        UNITY_LINE_TYPE line)
{
    take((UNITY_INT)((intptr_t)actual - (intptr_t)expected));
    __real_UnityAssertEqualNumber((UNITY_PTR_TO_INT)(intptr_t)expected,
                                  (UNITY_PTR_TO_INT)(intptr_t)actual, message, line,
                                  UNITY_DISPLAY_STYLE_POINTER);
}

void __wrap_UnityAssertEqualNumber(UNITY_INT expected, UNITY_INT actual, const char *message,
                                   UNITY_LINE_TYPE line, UNITY_DISPLAY_STYLE_T style)
{
    take_typed(actual, style);
    __real_UnityAssertEqualNumber(expected, actual, message, line, style);
}

void __wrap_UnityAssertGreaterOrLessOrEqualNumber(UNITY_INT threshold, UNITY_INT actual,
                                                  UNITY_COMPARISON_T compare, const char *message,
                                                  UNITY_LINE_TYPE line, UNITY_DISPLAY_STYLE_T style)
{
    if (!left_out) {
        take_typed(actual, style);
    }
    left_out = 0;
    __real_UnityAssertGreaterOrLessOrEqualNumber(threshold, actual, compare, message, line, style);
}

void __wrap_UnityAssertEqualIntArray(UNITY_INTERNAL_PTR expected, UNITY_INTERNAL_PTR actual,
                                     UNITY_UINT32 count, const char *message, UNITY_LINE_TYPE line,
                                     UNITY_DISPLAY_STYLE_T style, UNITY_FLAGS_T flags)
{
    take_array(actual, count, style);
    __real_UnityAssertEqualIntArray(expected, actual, count, message, line, style, flags);
}

void __wrap_UnityAssertBits(UNITY_INT mask, UNITY_INT expected, UNITY_INT actual,
                            const char *message, UNITY_LINE_TYPE line)
{
    take((UNITY_INT)((UNITY_UINT)mask & (UNITY_UINT)actual & 0xffffffffu));
    __real_UnityAssertBits(mask, expected, actual, message, line);
}

void __wrap_UnityAssertEqualString(const char *expected, const char *actual, const char *message,
                                   UNITY_LINE_TYPE line)
{
    take_text(actual);
    __real_UnityAssertEqualString(expected, actual, message, line);
}

/* Memory counts byte by byte: right for bytes only, and a suite that compares more is found out. */
void __wrap_UnityAssertEqualMemory(UNITY_INTERNAL_PTR expected, UNITY_INTERNAL_PTR actual,
                                   UNITY_UINT32 length, UNITY_UINT32 count, const char *message,
                                   UNITY_LINE_TYPE line, UNITY_FLAGS_T flags)
{
    take_array(actual, length * count, UNITY_DISPLAY_STYLE_UINT8);
    __real_UnityAssertEqualMemory(expected, actual, length, count, message, line, flags);
}

void __wrap_UnityAssertNumbersWithin(UNITY_UINT delta, UNITY_INT expected, UNITY_INT actual,
                                     const char *message, UNITY_LINE_TYPE line,
                                     UNITY_DISPLAY_STYLE_T style)
{
    take_typed(actual, style);
    __real_UnityAssertNumbersWithin(delta, expected, actual, message, line, style);
}

void __wrap_UnityAssertNumbersArrayWithin(UNITY_UINT delta, UNITY_INTERNAL_PTR expected,
                                          UNITY_INTERNAL_PTR actual, UNITY_UINT32 count,
                                          const char *message, UNITY_LINE_TYPE line,
                                          UNITY_DISPLAY_STYLE_T style, UNITY_FLAGS_T flags)
{
    take_array(actual, count, style);
    __real_UnityAssertNumbersArrayWithin(delta, expected, actual, count, message, line, style,
                                         flags);
}

static void print_end(UNITY_INT passed, UNITY_INT failed, UNITY_INT ignored)
{
    UnityPrint("values ");
    UnityPrintNumberUnsigned(values);
    UnityPrint(", hash ");
    UnityPrintNumberHex(hash, 16);
    UnityPrint(", stack ");
    UnityPrintNumberUnsigned(pel_machine_stack_used());
    UnityPrint(" of ");
    UnityPrintNumberUnsigned(pel_machine_stack_size());
    pel_report_character('\n');
    UnityPrintNumber(passed);
    UnityPrint(" passed, ");
    UnityPrintNumber(failed);
    UnityPrint(" failed");
    if (ignored > 0) {
        UnityPrint(", ");
        UnityPrintNumber(ignored);
        UnityPrint(" skipped");
    }
    pel_report_character('\n');
}

/* The exit status of the program; statuses from PEL_EXIT_FAULT on are the start-up code's. */
int __wrap_UnityEnd(void)
{
    const UNITY_INT failed = (UNITY_INT)Unity.TestFailures;
    const UNITY_INT ignored = (UNITY_INT)Unity.TestIgnores;
    const UNITY_INT passed = (UNITY_INT)Unity.NumberOfTests - failed - ignored;
    (void)__real_UnityEnd();
    print_end(passed, failed, ignored);
    if (passed == 0 || values == 0) {
        return 100;
    }
    return failed > 100 ? 100 : (int)failed;
}

/* A line at a time: each call of the host stops the core. */
void pel_report_character(int character)
{
    static char line[120];
    static uint32_t used;
    line[used] = (char)character;
    used++;
    if (character == '\n' || used == sizeof line - 1) {
        line[used] = '\0';
        pel_machine_text(line);
        used = 0;
    }
}
