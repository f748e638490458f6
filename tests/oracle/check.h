/* Counting checks: a program says what it compared, and its last line how much held. */
#ifndef CHECK_H
#define CHECK_H

#include <stdint.h>
#include <stdio.h>

typedef struct tally {
    unsigned passed, failed;
} tally;

/* One named check over `compared` single comparisons, `wrong` of which did not hold. */
static inline void check(tally *checks, const char *name, uint64_t compared, uint64_t wrong)
{
    const int good = compared > 0 && wrong == 0;
    checks->passed += good ? 1u : 0u;
    checks->failed += good ? 0u : 1u;
    printf("%s %s: %llu compared, %llu wrong\n", good ? "ok  " : "FAIL", name,
           (unsigned long long)compared, (unsigned long long)wrong);
}

/* The closing line; the result is the exit status of the program. */
static inline int checks_end(const tally *checks)
{
    printf("%u passed, %u failed\n", checks->passed, checks->failed);
    return checks->failed > 0 || checks->passed == 0 ? 1 : 0;
}

/* Repeatable random numbers: xorshift64* (Vigna 2016). */
static inline uint64_t random_next(uint64_t *state)
{
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return *state * UINT64_C(2685821657736338717);
}

/* 0 <= result < limit. */
static inline uint32_t random_below(uint64_t *state, uint32_t limit)
{
    return (uint32_t)((random_next(state) >> 32) * limit >> 32);
}

#endif
