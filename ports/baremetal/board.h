/*
 * What the start-up code of the boards offers to a program: its stack, looked after with guard
 * words and paint, and ends that tell what went wrong.
 */
#ifndef PEL_BOARD_H
#define PEL_BOARD_H

#include <stdint.h>

/* Exit statuses of the start-up code. Those of a program's own should be smaller. */
enum pel_board_exit {
    PEL_EXIT_FAULT = 120,    /* the core trapped: a bad address, alignment, division by zero ... */
    PEL_EXIT_GUARD = 121,    /* a guard word was written over */
    PEL_EXIT_PROTECTOR = 122 /* the compiler's guard of an array on the stack was written over */
};

/* The bytes between the stack's top and the guard words below it. */
uint32_t pel_stack_size(void);

/*
 * The most bytes of stack that were in use at any time since the start, to a word. A program that
 * leaves an array on its stack untouched makes this too small by as much.
 */
uint32_t pel_stack_high_water(void);

/*
 * Looks at the guard words above the stack, below it, below the initialised data and between these
 * and the zeroed data. Returns NULL if all are whole, else which are not. Also done after main.
 */
const char *pel_guards_broken(void);

/*
 * Ends the program: with PEL_EXIT_GUARD and a line of text if a guard word is broken, else with
 * `status`. main's return comes here by itself.
 */
#if defined(__GNUC__)
__attribute__((noreturn))
#endif
void pel_exit(int status);

#endif
