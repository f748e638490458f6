/* What can go wrong on a board, one case for each program: -DWRONG_CASE=WRONG_... */
#include <stddef.h>
#include <stdint.h>

#include "board.h"
#include "semihost.h"

enum wrong {
    WRONG_NOTHING,
    WRONG_STATUS,
    WRONG_INSTRUCTION,
    WRONG_ARRAY,
    WRONG_ABOVE_STACK,
    WRONG_BELOW_STACK,
    WRONG_BELOW_DATA,
    WRONG_BEHIND_DATA,
    WRONG_HIGH_WATER,
    WRONG_RECURSION,
    WRONG_UNALIGNED,
    WRONG_DIVISION,
    WRONG_HANG
};

/* Of the linker script. */
extern uint32_t pel_stack_top[], pel_guard_stack[], pel_data_start[], pel_data_end[];

/* The compiler must not see that what follows is wrong, or it may do as it likes. */
static volatile int one = 1;
static volatile uint32_t sink;
static uint32_t words[4];
/* Lies below the stack's guard and may be written over. */
static volatile uint8_t ballast[512];

/* The word `index` words from an address of the linker's. */
static volatile uint32_t *word_at(uint32_t *base, int index)
{
    return (volatile uint32_t *)((uintptr_t)base + (uintptr_t)((intptr_t)index * 4));
}

static void break_array(void)
{
    char text[8] = "1234567";
    char *volatile end = text + 8 * one;
    for (int i = 0; i < 8; i++) {
        end[i] = 'x';
    }
    sink = (uint32_t)text[one];
}

/* Uses some more than 64 bytes for each level. */
__attribute__((noinline)) static uint32_t deep(uint32_t levels)
{
    volatile uint32_t frame[16];
    for (int i = 0; i < 16; i++) {
        frame[i] = levels;
    }
    const uint32_t below = levels == 0 ? 0 : deep(levels - (uint32_t)one);
    return below + frame[levels & 15u];
}

/* A thousand bytes more than before, give or take the rest of a call, and never less. */
static int high_water(void)
{
    const uint32_t before = pel_stack_high_water();
    sink = deep(15);
    const uint32_t grown = pel_stack_high_water() - before;
    const int right =
        grown >= 15u * 64u && grown <= 16u * 160u && pel_stack_high_water() <= pel_stack_size();
    pel_host_text(right ? "high water is right\n" : "high water is wrong\n");
    return right ? 0 : 1;
}

/* One level more than there is stack for: over the guard words, but not out of small memories. */
static void overflow(void)
{
    const uint32_t before = pel_stack_high_water();
    sink = deep(15);
    const uint32_t level = (pel_stack_high_water() - before) / 15u;
    sink = ballast[one];
    sink = deep(pel_stack_size() / level + 1u);
}

static int go_wrong(enum wrong wrong)
{
    switch (wrong) {
    case WRONG_NOTHING:
        pel_host_text("nothing is wrong\n");
        return 0;
    case WRONG_STATUS:
        pel_host_text("status 7\n");
        return 7;
    case WRONG_INSTRUCTION:
#if defined(__riscv)
        __asm__ volatile(".half 0");
#else
        __asm__ volatile("udf #0");
#endif
        return 0;
    case WRONG_ARRAY:
        break_array();
        return 0;
    case WRONG_ABOVE_STACK:
        *word_at(pel_stack_top, 0) = 0;
        return 0;
    case WRONG_BELOW_STACK:
        *word_at(pel_guard_stack, 3) = 0;
        return 0;
    case WRONG_BELOW_DATA:
        *word_at(pel_data_start, -1) = 0;
        return 0;
    case WRONG_BEHIND_DATA:
        *word_at(pel_data_end, 0) = 0;
        return 0;
    case WRONG_HIGH_WATER:
        return high_water();
    case WRONG_RECURSION:
        overflow();
        return 0;
    case WRONG_UNALIGNED:
        sink = *(volatile uint32_t *)((uintptr_t)words + (uintptr_t)one);
        return 0;
    case WRONG_DIVISION:
        sink = (uint32_t)(7 / (one - 1));
        return 0;
    case WRONG_HANG:
        pel_host_text("for ever\n");
        while (one) {
        }
        return 0;
    }
    return 1;
}

int main(void)
{
    return go_wrong(WRONG_CASE);
}
