#include "check.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(__SANITIZE_ADDRESS__)
#define HAVE_ASAN 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HAVE_ASAN 1
#endif
#endif

#ifdef HAVE_ASAN
#include <sanitizer/asan_interface.h>
#else
#define ASAN_POISON_MEMORY_REGION(address, size) ((void)(address), (void)(size))
#define ASAN_UNPOISON_MEMORY_REGION(address, size) ((void)(address), (void)(size))
#endif

enum { MESSAGES_PER_GROUP = 4, CANARY = 0xC5, CANARY_BYTES = 64 };

static struct {
    char name[160];
    int open;
    uint64_t checks, failures, images, blobs;
    uint32_t passed, failed;
} now;

static void close_group(void)
{
    int good;
    if (!now.open) {
        return;
    }
    good = now.checks > 0 && now.failures == 0;
    printf("%s  %s: %" PRIu64 " checks", good ? "ok  " : "FAIL", now.name, now.checks);
    if (now.images > 0) {
        printf(", %" PRIu64 " images, %" PRIu64 " blobs", now.images, now.blobs);
    }
    if (now.failures > 0) {
        printf(", %" PRIu64 " failed", now.failures);
    }
    printf("%s\n", now.checks == 0 ? " (nothing was checked)" : "");
    fflush(stdout);
    now.passed += good ? 1u : 0u;
    now.failed += good ? 0u : 1u;
    now.open = 0;
}

void check_group(const char *format, ...)
{
    va_list arguments;
    close_group();
    va_start(arguments, format);
    vsnprintf(now.name, sizeof now.name, format, arguments);
    va_end(arguments);
    now.open = 1;
    now.checks = 0;
    now.failures = 0;
    now.images = 0;
    now.blobs = 0;
}

int check_passed(void)
{
    now.checks++;
    return 1;
}

int check_failed(const char *format, ...)
{
    now.checks++;
    if (now.failures < MESSAGES_PER_GROUP) {
        va_list arguments;
        printf("      %s: ", now.name);
        va_start(arguments, format);
        vprintf(format, arguments);
        va_end(arguments);
        printf("\n");
    }
    now.failures++;
    return 0;
}

void check_count(uint64_t images, uint64_t blobs)
{
    now.images += images;
    now.blobs += blobs;
}

int check_finish(void)
{
    close_group();
    printf("%" PRIu32 " passed, %" PRIu32 " failed\n", now.passed, now.failed);
    return now.failed == 0 && now.passed > 0 ? 0 : 1;
}

uint32_t check_scale(int argc, char **argv)
{
    unsigned long scale = argc > 1 ? strtoul(argv[1], NULL, 10) : 1;
    return scale >= 1 && scale <= 100000 ? (uint32_t)scale : 1;
}

/* ---- Generator ----------------------------------------------------------------------------- */

rng rng_seeded(uint64_t seed)
{
    rng random;
    random.state = seed * 0x9E3779B97F4A7C15u + 0x1234567u;
    if (random.state == 0) {
        random.state = 1;
    }
    (void)rng_next(&random);
    return random;
}

uint32_t rng_next(rng *random)
{
    random->state ^= random->state >> 12;
    random->state ^= random->state << 25;
    random->state ^= random->state >> 27;
    return (uint32_t)((random->state * 0x2545F4914F6CDD1Du) >> 32);
}

uint32_t rng_below(rng *random, uint32_t limit)
{
    return (uint32_t)(((uint64_t)rng_next(random) * limit) >> 32);
}

/* ---- Guarded memory ------------------------------------------------------------------------ */

static size_t bytes_behind(const guarded *memory)
{
    return memory->room - (size_t)(memory->bytes - memory->base) - memory->size;
}

static void set_readable(const guarded *memory)
{
    ASAN_UNPOISON_MEMORY_REGION(memory->base, memory->room);
}

static void set_guarded(const guarded *memory)
{
    ASAN_POISON_MEMORY_REGION(memory->base, (size_t)(memory->bytes - memory->base));
    ASAN_POISON_MEMORY_REGION(memory->bytes + memory->size, bytes_behind(memory));
}

void *guarded_take(guarded *memory, size_t size, size_t offset, uint8_t fill)
{
    const size_t room = size + offset + 2 * (size_t)CANARY_BYTES;
    if (room > memory->room) {
        guarded_free(memory);
        memory->base = malloc(room);
        if (memory->base == NULL) {
            printf("no memory for the test\n");
            exit(1);
        }
        memory->room = room;
    }
    set_readable(memory);
    memory->bytes = memory->base + CANARY_BYTES + offset;
    memory->size = size;
    memset(memory->base, CANARY, (size_t)(memory->bytes - memory->base));
    memset(memory->bytes, fill, size);
    memset(memory->bytes + size, CANARY,
           bytes_behind(memory) < CANARY_BYTES ? bytes_behind(memory) : CANARY_BYTES);
    set_guarded(memory);
    return memory->bytes;
}

int guarded_intact(guarded *memory)
{
    const size_t front = (size_t)(memory->bytes - memory->base);
    const uint8_t *back = memory->bytes + memory->size;
    int intact = 1;
    size_t i;
    set_readable(memory);
    for (i = 0; i < front; i++) {
        intact &= memory->base[i] == CANARY;
    }
    for (i = 0; i < CANARY_BYTES && i < bytes_behind(memory); i++) {
        intact &= back[i] == CANARY;
    }
    set_guarded(memory);
    return intact;
}

void guarded_free(guarded *memory)
{
    if (memory->base != NULL) {
        set_readable(memory);
        free(memory->base);
    }
    memset(memory, 0, sizeof *memory);
}
