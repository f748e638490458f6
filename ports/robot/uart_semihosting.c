/* For boards without a file in boards/: the serial line is the file robot.uart of the host. */
#include "../baremetal/semihost.h"
#include "uart.h"

static int32_t file;

void uart_begin(void)
{
    file = pel_host_open("robot.uart", PEL_HOST_WRITE);
}

void uart_send(uint8_t byte)
{
    (void)pel_host_write(file, &byte, 1);
}
