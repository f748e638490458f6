#include "machine.h"

#include <stdio.h>

void pel_machine_text(const char *text)
{
    (void)fputs(text, stdout);
    (void)fflush(stdout);
}

uint32_t pel_machine_stack_used(void)
{
    return 0;
}

uint32_t pel_machine_stack_size(void)
{
    return 0;
}
