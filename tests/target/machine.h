/* What the report needs of the machine it runs on. */
#ifndef PEL_MACHINE_H
#define PEL_MACHINE_H

#include <stdint.h>

void pel_machine_text(const char *text);

/* In bytes; both 0 where nobody watches the stack. */
uint32_t pel_machine_stack_used(void);
uint32_t pel_machine_stack_size(void);

#endif
