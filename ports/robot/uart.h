/* The board's serial line: 115200 baud, 8 bits, no parity. Each file of boards/ defines these two.
 * */
#ifndef UART_H
#define UART_H

#include <stdint.h>

void uart_begin(void);

/* Waits until the UART has room for the byte. */
void uart_send(uint8_t byte);

#endif
