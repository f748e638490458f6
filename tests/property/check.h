/*
 * What every property program shares: groups of checks, a seeded generator, guarded memory.
 *
 * A group passes if it checked something and every check held. The first few failures of a group
 * are printed. check_finish prints the closing line and gives the exit status.
 */
#ifndef CHECK_H
#define CHECK_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define CHECK_FORMAT(text, first) __attribute__((format(printf, text, first)))
#else
#define CHECK_FORMAT(text, first)
#endif

/* Starts a group and closes the one before. */
void check_group(const char *format, ...) CHECK_FORMAT(1, 2);

/*
 * check_that(condition, format, ...) counts one check and prints the message if it does not hold;
 * its value is the condition. The message's arguments are evaluated only then.
 */
#define check_that(condition, ...) ((condition) ? check_passed() : check_failed(__VA_ARGS__))
int check_passed(void);                                       /* 1 */
int check_failed(const char *format, ...) CHECK_FORMAT(1, 2); /* 0 */

/* Adds to the images and blobs that the group's line reports. */
void check_count(uint64_t images, uint64_t blobs);

/* Closes the last group, prints the closing line; the program's exit status. */
int check_finish(void);

/* The scale given on the command line: do 1/scale of the work. 1 without one. */
uint32_t check_scale(int argc, char **argv);

/* A small generator (xorshift64*), the same on every machine. */
typedef struct rng {
    uint64_t state;
} rng;

rng rng_seeded(uint64_t seed);
uint32_t rng_next(rng *random);
uint32_t rng_below(rng *random, uint32_t limit); /* 0 .. limit-1; limit >= 1 */

/*
 * Memory with a canary on both sides; under AddressSanitizer the canaries may not even be read.
 * Aligned to 16 bytes plus `offset`. The canaries are laid out again by every guarded_take.
 */
typedef struct guarded {
    uint8_t *base;  /* allocated */
    uint8_t *bytes; /* handed out */
    size_t size, room;
} guarded;

void *guarded_take(guarded *memory, size_t size, size_t offset, uint8_t fill);
int guarded_intact(guarded *memory);
void guarded_free(guarded *memory);

#endif
