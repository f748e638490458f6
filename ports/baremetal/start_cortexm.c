/* Reset and faults of every Cortex-M, from v6-M to v8.1-M. */
#include "board.h"
#include "semihost.h"
#include "start.h"

extern uint32_t pel_stack_top[], pel_stack_bottom[];

#define REGISTER(address) (*(volatile uint32_t *)(address))
#define CCR REGISTER(0xe000ed14u)
#define CFSR REGISTER(0xe000ed28u)
#define CPACR REGISTER(0xe000ed88u)

enum { CCR_UNALIGN_TRP = 1 << 3, CCR_DIV_0_TRP = 1 << 4, CPACR_CP10_CP11 = 0xf << 20 };

__attribute__((noreturn)) void pel_reset(void);
__attribute__((noreturn)) void pel_trap(void);
__attribute__((noreturn)) void pel_trap_report(const uint32_t *frame, uint32_t exception);

/* Where the word at an odd address is an error on some core, make it one on all that can. */
static void trap_early(void)
{
#if __ARM_ARCH >= 7 && defined(PEL_TRAP_UNALIGNED)
    CCR |= CCR_UNALIGN_TRP | CCR_DIV_0_TRP;
#endif
}

/* The FPU and Helium are off at reset, and the compiler may use them anywhere from main on. */
static void enable_coprocessors(void)
{
#if __ARM_ARCH >= 7
    CPACR |= CPACR_CP10_CP11;
    __asm__ volatile("dsb\n isb");
#endif
}

static void limit_stack(void)
{
#if __ARM_ARCH >= 8 && defined(__ARM_ARCH_PROFILE) && !defined(__ARM_ARCH_8M_BASE__)
    __asm__ volatile("msr msplim, %0" : : "r"(pel_stack_bottom));
#endif
}

void pel_reset(void)
{
    trap_early();
    enable_coprocessors();
    limit_stack();
    pel_start();
}

/* The stack may be what failed, so the report gets a fresh one. r0: where the core's frame is. */
__attribute__((naked, noreturn)) void pel_trap(void)
{
    __asm__ volatile("mov r0, sp\n"
                     "mrs r1, ipsr\n"
#if __ARM_ARCH >= 8 && !defined(__ARM_ARCH_8M_BASE__)
                     "movs r2, #0\n"
                     "msr msplim, r2\n"
#endif
                     "ldr r2, =pel_stack_top\n"
                     "mov sp, r2\n"
                     "ldr r3, =pel_trap_report\n"
                     "bx r3\n");
}

void pel_trap_report(const uint32_t *frame, uint32_t exception)
{
    enum { FRAME_PC = 6, FRAME_WORDS = 8 };
    pel_host_text("fault: exception ");
    pel_host_decimal(exception);
    if (frame >= pel_stack_bottom && frame + FRAME_WORDS <= pel_stack_top) {
        pel_host_text(", pc ");
        pel_host_hexadecimal(frame[FRAME_PC]);
    }
#if __ARM_ARCH >= 7
    pel_host_text(", cfsr ");
    pel_host_hexadecimal(CFSR);
#endif
    pel_host_text("\n");
    pel_host_exit(PEL_EXIT_FAULT);
}

typedef void (*handler)(void);

struct vectors {
    uint32_t *stack;
    handler handlers[15];
};

/* Reset, NMI, four faults, ... SVCall, debug, PendSV and SysTick; none but reset is expected. */
__attribute__((section(".vectors"), used)) static const struct vectors vectors = {
    pel_stack_top,
    {pel_reset, pel_trap, pel_trap, pel_trap, pel_trap, pel_trap, pel_trap, pel_trap, pel_trap,
     pel_trap, pel_trap, pel_trap, pel_trap, pel_trap, pel_trap}};
