/* Arm MPS3 with a Cortex-M55: UART 0, by its secure address. */
#define UART_BASE 0x59303000u
#define UART_CLOCK_HZ 25000000u
#include "../uart_cmsdk.h"
