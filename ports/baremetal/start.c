/* From reset to main and to the end, the same for all cores. */
#include <stddef.h>

#include "board.h"
#include "semihost.h"
#include "start.h"

enum { GUARD_WORDS = 4 };

static const uint32_t guard_pattern = 0x6a17dbe5u;
static const uint32_t paint_pattern = 0xc0a7f1e1u;

/* Of the linker script; only their addresses mean anything. */
extern uint32_t pel_data_start[], pel_data_end[], pel_bss_start[], pel_bss_end[];
extern const uint32_t pel_data_load[];
extern uint32_t pel_guard_low[], pel_guard_middle[], pel_guard_stack[], pel_guard_high[];
extern uint32_t pel_stack_bottom[], pel_paint_end[], pel_stack_top[];

struct guard {
    uint32_t *words;
    const char *place;
};

static const struct guard guards[] = {
    {pel_guard_low, "below the initialised data"},
    {pel_guard_middle, "between initialised and zeroed data"},
    {pel_guard_stack, "below the stack"},
    {pel_guard_high, "above the stack"},
};

enum { GUARDS = sizeof guards / sizeof guards[0] };

/* Through volatile pointers, so that no loop becomes a call of memcpy or memset. */
static void fill(volatile uint32_t *from, const volatile uint32_t *to, uint32_t value)
{
    while (from < to) {
        *from = value;
        from++;
    }
}

static void copy_data(void)
{
    const uint32_t *from = pel_data_load;
    for (volatile uint32_t *to = pel_data_start; to < pel_data_end; to++) {
        *to = *from;
        from++;
    }
}

uint32_t pel_stack_size(void)
{
    return (uint32_t)((uintptr_t)pel_stack_top - (uintptr_t)pel_stack_bottom);
}

uint32_t pel_stack_high_water(void)
{
    const volatile uint32_t *word = pel_stack_bottom;
    while (word < pel_stack_top && *word == paint_pattern) {
        word++;
    }
    return (uint32_t)((uintptr_t)pel_stack_top - (uintptr_t)word);
}

const char *pel_guards_broken(void)
{
    for (unsigned g = 0; g < GUARDS; g++) {
        const volatile uint32_t *words = guards[g].words;
        for (unsigned i = 0; i < GUARD_WORDS; i++) {
            if (words[i] != guard_pattern) {
                return guards[g].place;
            }
        }
    }
    return NULL;
}

void pel_exit(int status)
{
    const char *broken = pel_guards_broken();
    if (broken != NULL) {
        pel_host_text("guard words smashed ");
        pel_host_text(broken);
        pel_host_text("\n");
        pel_host_exit(PEL_EXIT_GUARD);
    }
    pel_host_exit(status);
}

/* The compiler's guard for arrays on the stack (-fstack-protector), in programs built with it. */
uintptr_t __stack_chk_guard = 0x00ad5af3u;

__attribute__((noreturn)) void __stack_chk_fail(void)
{
    pel_host_text("an array on the stack was written past its end\n");
    pel_host_exit(PEL_EXIT_PROTECTOR);
}

void pel_start(void)
{
    copy_data();
    fill(pel_bss_start, pel_bss_end, 0);
    for (unsigned g = 0; g < GUARDS; g++) {
        fill(guards[g].words, guards[g].words + GUARD_WORDS, guard_pattern);
    }
    fill(pel_stack_bottom, pel_paint_end, paint_pattern);
    pel_exit(main());
}
