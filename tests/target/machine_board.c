#include "machine.h"

#include "board.h"
#include "semihost.h"

void pel_machine_text(const char *text)
{
    pel_host_text(text);
}

uint32_t pel_machine_stack_used(void)
{
    return pel_stack_high_water();
}

uint32_t pel_machine_stack_size(void)
{
    return pel_stack_size();
}
