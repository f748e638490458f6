/* Between the start-up files; programs need board.h only. */
#ifndef PEL_START_H
#define PEL_START_H

#include <stdint.h>

int main(void);

/* Called on a fresh stack with nothing initialised: goes to main and ends the program. */
__attribute__((noreturn)) void pel_start(void);

#endif
