/* A Unity suite on an AVR: its characters go to UART 0, and at its end the chip sleeps for good. */
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>

#include "unity_config.h"

int pel_suite_main(void);

void pel_report_character(int character)
{
    while ((UCSR0A & _BV(UDRE0)) == 0) {
    }
    UDR0 = (unsigned char)character;
}

int main(void)
{
    UBRR0 = 0;
    UCSR0A = _BV(U2X0);
    UCSR0B = _BV(TXEN0);
    (void)pel_suite_main();
    cli();
    sleep_enable();
    for (;;) {
        sleep_cpu();
    }
}
