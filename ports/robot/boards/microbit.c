/* BBC micro:bit: the UART of the nRF51 (nRF51 Series Reference Manual, chapter 29). */
#include "../uart.h"

#define UART_REGISTER(offset) (*(volatile uint32_t *)(0x40002000u + (offset)))

enum {
    UART_START_TX = 0x008,
    UART_TX_READY = 0x11C, /* event: the byte has left */
    UART_ENABLE = 0x500,
    UART_PIN_TX = 0x50C,
    UART_TX = 0x51C,
    UART_BAUD = 0x524
};

void uart_begin(void)
{
    UART_REGISTER(UART_PIN_TX) = 24;        /* to the USB chip of the board */
    UART_REGISTER(UART_BAUD) = 0x01D7E000u; /* 115200 */
    UART_REGISTER(UART_ENABLE) = 4;
    UART_REGISTER(UART_START_TX) = 1;
}

void uart_send(uint8_t byte)
{
    UART_REGISTER(UART_TX_READY) = 0;
    UART_REGISTER(UART_TX) = byte;
    while (UART_REGISTER(UART_TX_READY) == 0) {
    }
}
