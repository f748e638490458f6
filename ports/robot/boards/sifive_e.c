/* SiFive FE310: UART 0 (FE310-G000 Manual, chapter 18), core clock 16 MHz. */
#include "../uart.h"

#define UART_REGISTER(offset) (*(volatile uint32_t *)(0x10013000u + (offset)))

enum { UART_TX = 0x00, UART_TX_CONTROL = 0x08, UART_DIVIDER = 0x18 };

void uart_begin(void)
{
    UART_REGISTER(UART_DIVIDER) = 16000000u / 115200u - 1u;
    UART_REGISTER(UART_TX_CONTROL) = 1;
}

void uart_send(uint8_t byte)
{
    while (UART_REGISTER(UART_TX) & 0x80000000u) { /* its queue is full */
    }
    UART_REGISTER(UART_TX) = byte;
}
