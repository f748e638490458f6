/*
 * What a robot has to give to pel: lines or frames of a camera, a clock, and somewhere to put the
 * results. A program that uses only this header and <pel.h> runs on every board that has a port;
 * README.md shows the way from the empty functions of port.c to the first blob.
 *
 * Every function is called from the main program, never from an interrupt. None allocates.
 */
#ifndef PORT_H
#define PORT_H

#include <pel.h>

/* What a call answers, by the habit of pel_status: negative = did not work, zero = nothing more to
 * come, positive = here it is. */
enum { PORT_FAILED = -1, PORT_END = 0, PORT_READY = 1 };

/* The size of the camera, which programs need at compile time for their arrays. Give both with -D,
 * or change them here. */
#ifndef PORT_WIDTH
#define PORT_WIDTH 320
#endif
#ifndef PORT_HEIGHT
#define PORT_HEIGHT 240
#endif

/*
 * Switches on clocks, camera and output. Once, first thing in main. PORT_READY, or PORT_FAILED if
 * something does not answer.
 */
int port_begin(void);

/*
 * A line of the camera. `row` points into the buffer that the camera has just left; it stays as it
 * is until the next call of port_line, while the next line arrives in the other buffer.
 */
typedef struct port_line_info {
    pel_crow row;    /* PORT_WIDTH pixels, in the format and range of the camera */
    uint16_t y;      /* 0 begins a frame */
    uint16_t missed; /* lines lost since the last call, because the program was
                      not back in time */
} port_line_info;

/*
 * Line source, for cameras whose frame does not fit into RAM: waits for the next line. PORT_READY;
 * PORT_END if there will be none any more (a file that is played back; a camera never ends);
 * PORT_FAILED if the camera has stopped.
 */
int port_line(port_line_info *line);

/*
 * Frame source, for boards that hold a frame: waits for the next one. The view's pixels stay as
 * they are until the next call. A port has one source or both; the one that it lacks answers
 * PORT_FAILED.
 */
int port_frame(pel_cview *view);

/* Microseconds since some moment; wraps after 71 minutes. A port without a clock answers 0. */
uint32_t port_time_us(void);

/*
 * Output, usually a UART: all bytes or none. May wait for the line to take them, but no longer
 * than the robot can wait for its vision. 0 = taken, PORT_FAILED = not (the queue is full, nobody
 * there).
 */
int port_write(const uint8_t *bytes, uint32_t count);

/*
 * The program is over; `status` 0 = all went well. An emulator ends here, a robot stops its
 * motors. What it returns becomes the value of main.
 */
int port_end(int status);

#endif
