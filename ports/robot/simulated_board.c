/*
 * An emulated board: the camera is the file camera.yuv of the host, read by semihosting, and the
 * serial line is the board's own UART (boards/BOARD.c).
 */
#include "simulated.h"

#include "../baremetal/board.h"
#include "../baremetal/semihost.h"
#include "uart.h"

static int32_t file;

int simulated_begin(void)
{
    uart_begin();
    file = pel_host_open("camera.yuv", PEL_HOST_READ);
    if (file < 0) {
        pel_host_text("no file camera.yuv\n");
    }
    return file < 0 ? -1 : 0;
}

uint32_t simulated_read(uint8_t *bytes, uint32_t count)
{
    const int32_t got = pel_host_read(file, bytes, count);
    return got < 0 ? 0 : (uint32_t)got;
}

int simulated_write(const uint8_t *bytes, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        uart_send(bytes[i]);
    }
    return 0;
}

int simulated_end(int status)
{
    pel_host_text("stack used: ");
    pel_host_decimal(pel_stack_high_water());
    pel_host_text(" bytes\n");
    return status; /* the start-up code ends the emulator */
}
