/* Arm MPS2: UART 0. */
#define UART_BASE 0x40004000u
#define UART_CLOCK_HZ 25000000u
#include "../uart_cmsdk.h"
