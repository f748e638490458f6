/*
 * Reset and traps of a 32-bit RISC-V core in machine mode. The instructions for control registers
 * are allowed here only: with them in -march, gcc 12 does not find its own 32-bit libgcc.
 */
#include "board.h"
#include "semihost.h"
#include "start.h"

__attribute__((noreturn)) void pel_reset(void);
__attribute__((noreturn)) void pel_trap(void);
__attribute__((noreturn)) void pel_trap_report(uint32_t cause, uint32_t pc, uint32_t value);

__attribute__((naked, noreturn, section(".reset"))) void pel_reset(void)
{
    __asm__ volatile(".option push\n .option norelax\n .option arch, +zicsr\n"
                     "la gp, __global_pointer$\n"
                     "la t0, pel_trap\n"
                     "csrw mtvec, t0\n"
                     ".option pop\n"
                     "la sp, pel_stack_top\n"
                     "j pel_start\n");
}

/* The stack may be what failed, so the report gets a fresh one. */
__attribute__((naked, noreturn, aligned(4))) void pel_trap(void)
{
    __asm__ volatile(".option push\n .option arch, +zicsr\n"
                     "csrr a0, mcause\n"
                     "csrr a1, mepc\n"
                     "csrr a2, mtval\n"
                     ".option pop\n"
                     "la sp, pel_stack_top\n"
                     "j pel_trap_report\n");
}

void pel_trap_report(uint32_t cause, uint32_t pc, uint32_t value)
{
    pel_host_text("fault: mcause ");
    pel_host_hexadecimal(cause);
    pel_host_text(", pc ");
    pel_host_hexadecimal(pc);
    pel_host_text(", mtval ");
    pel_host_hexadecimal(value);
    pel_host_text("\n");
    pel_host_exit(PEL_EXIT_FAULT);
}
