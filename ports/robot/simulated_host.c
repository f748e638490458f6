/* The machine on the desk: the camera is standard input, the serial line standard output. */
#include "simulated.h"

#include <stdio.h>

int simulated_begin(void)
{
    return 0;
}

uint32_t simulated_read(uint8_t *bytes, uint32_t count)
{
    return (uint32_t)fread(bytes, 1, count, stdin);
}

int simulated_write(const uint8_t *bytes, uint32_t count)
{
    return fwrite(bytes, 1, count, stdout) == count ? 0 : -1;
}

int simulated_end(int status)
{
    return fflush(stdout) ? 1 : status;
}
