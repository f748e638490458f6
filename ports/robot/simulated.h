/*
 * What port_simulated.c needs to play a camera: a file of raw YUYV frames and a serial line. One
 * file for each kind of machine: simulated_host.c, simulated_board.c.
 */
#ifndef SIMULATED_H
#define SIMULATED_H

#include <stdint.h>

/* Opens file and line; 0, or -1. */
int simulated_begin(void);

/* Reads up to `count` bytes; fewer only at the end of the file. */
uint32_t simulated_read(uint8_t *bytes, uint32_t count);

/* Sends all bytes; 0, or -1. */
int simulated_write(const uint8_t *bytes, uint32_t count);

/* Ends the program; on the host it returns what main shall return. */
int simulated_end(int status);

#endif
