/* Arm MPS2 with a Cortex-M33: UART 0, by its secure address. */
#define UART_BASE 0x50200000u
#define UART_CLOCK_HZ 20000000u
#include "../uart_cmsdk.h"
