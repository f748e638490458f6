/*
 * A port without hardware: a line camera that reads its pixels from a file of raw YUYV frames,
 * full range, and fills two line buffers in turn as a DMA controller would. Its clock is the
 * camera's: each line takes 130 us, 240 lines and the pause behind them 1/30 s, so that every run
 * gives the same bytes on every machine.
 */
#include "port.h"
#include "simulated.h"

enum { LINE_BYTES = 2 * PORT_WIDTH, LINE_US = 130, FRAME_US = 33333 };

/* For tests: line PORT_MISS_LINE of frame PORT_MISS_FRAME comes too early for the program. */
#ifndef PORT_MISS_FRAME
#define PORT_MISS_FRAME -1
#define PORT_MISS_LINE 0
#endif

static struct camera {
    uint32_t frame;
    uint16_t y; /* of the line to come */
    uint8_t half;
    uint8_t lines[2][LINE_BYTES];
} camera;

int port_begin(void)
{
    return simulated_begin() ? PORT_FAILED : PORT_READY;
}

/* Lets the camera fill the next buffer; 0 at the end of the file. */
static int next_line(void)
{
    camera.half = (uint8_t)(1 - camera.half);
    return simulated_read(camera.lines[camera.half], LINE_BYTES) == LINE_BYTES;
}

static void count_line(void)
{
    camera.y++;
    if (camera.y == PORT_HEIGHT) {
        camera.y = 0;
        camera.frame++;
    }
}

int port_line(port_line_info *line)
{
    line->missed = 0;
    if ((int32_t)camera.frame == PORT_MISS_FRAME && camera.y == PORT_MISS_LINE) {
        if (!next_line()) {
            return PORT_END;
        }
        count_line();
        line->missed = 1;
    }
    if (!next_line()) {
        return PORT_END;
    }
    line->row = pel_crow_packed(camera.lines[camera.half], PEL_YUYV, PEL_RANGE_FULL, PORT_WIDTH);
    line->y = camera.y;
    count_line();
    return PORT_READY;
}

int port_frame(pel_cview *view)
{
    (void)view;
    return PORT_FAILED; /* 150 KiB: there is no room */
}

uint32_t port_time_us(void)
{
    return camera.frame * FRAME_US + (uint32_t)camera.y * LINE_US;
}

int port_write(const uint8_t *bytes, uint32_t count)
{
    return simulated_write(bytes, count) ? PORT_FAILED : 0;
}

int port_end(int status)
{
    return simulated_end(status);
}
