/* The UART of Arm's MPS boards (CMSDK APB UART). A board file defines UART_BASE and UART_CLOCK_HZ.
 * */
#include "uart.h"

#define UART_REGISTER(offset) (*(volatile uint32_t *)(UART_BASE + (offset)))

enum { UART_DATA = 0x00, UART_STATE = 0x04, UART_CONTROL = 0x08, UART_DIVIDER = 0x10 };

void uart_begin(void)
{
    UART_REGISTER(UART_DIVIDER) = UART_CLOCK_HZ / 115200u;
    UART_REGISTER(UART_CONTROL) = 1; /* transmitter on */
}

void uart_send(uint8_t byte)
{
    while (UART_REGISTER(UART_STATE) & 1u) { /* its buffer, of one byte, is full */
    }
    UART_REGISTER(UART_DATA) = byte;
}
