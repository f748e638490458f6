/* QEMU's RISC-V machine `virt`: a 16550 at 0x10000000. */
#include "../uart.h"

#define UART_REGISTER(offset) (*(volatile uint8_t *)(0x10000000u + (offset)))

enum { UART_TX = 0, UART_LINE_CONTROL = 3, UART_LINE_STATUS = 5 };

void uart_begin(void)
{
    UART_REGISTER(UART_LINE_CONTROL) = 3; /* 8 bits, no parity; any speed will do */
}

void uart_send(uint8_t byte)
{
    while ((UART_REGISTER(UART_LINE_STATUS) & 0x20u) == 0) {
    }
    UART_REGISTER(UART_TX) = byte;
}
