/*
 * Semihosting: the board asks its debugger, here QEMU, for text output, files of the host and an
 * end with an exit status. No C library. The same calls on Cortex-M and RISC-V.
 *
 * Each call stops the core while the host works: nothing for a control loop, everything for tests.
 */
#ifndef PEL_SEMIHOST_H
#define PEL_SEMIHOST_H

#include <stdint.h>

enum pel_host_mode {
    PEL_HOST_READ = 1,  /* an existing file, from its start */
    PEL_HOST_WRITE = 5, /* a new file, or an existing one emptied */
    PEL_HOST_APPEND = 9 /* behind what is there */
};

/* Writes zero-terminated text to the debugger's console (QEMU: standard error). */
void pel_host_text(const char *text);

/* As pel_host_text, for one character. */
void pel_host_character(char character);

/* Decimal and hexadecimal numbers as text; hexadecimal with 8 digits, without a prefix. */
void pel_host_decimal(uint32_t value);
void pel_host_hexadecimal(uint32_t value);

/*
 * Opens the host's file of that name, relative to the folder in which QEMU was started. The name
 * ":tt" is the console: PEL_HOST_READ is standard input, PEL_HOST_WRITE standard output.
 * Returns a handle for the calls below, or -1.
 */
int32_t pel_host_open(const char *name, enum pel_host_mode mode);

/*
 * Reads up to `size` bytes. Returns how many were read, 0 at the end of the file, -1 for an error.
 * Fewer than `size` does not mean that the end is reached when the file is a pipe or a console.
 */
int32_t pel_host_read(int32_t handle, void *bytes, uint32_t size);

/* Writes `size` bytes. Returns how many were written (fewer when the disk is full), or -1. */
int32_t pel_host_write(int32_t handle, const void *bytes, uint32_t size);

/* Goes to a place in the file, in bytes from its start. Returns 0 or -1. */
int32_t pel_host_seek(int32_t handle, uint32_t position);

/* The file's length in bytes, or -1. */
int32_t pel_host_length(int32_t handle);

/* Returns 0 or -1. */
int32_t pel_host_close(int32_t handle);

/*
 * Puts the words of QEMU's option `-semihosting-config ...,arg=a,arg=b` into `line`, with a blank
 * between them and a zero at the end. The first word is a name of the program (arg=a stands for it
 * as argv[0] does). Returns the length, or -1 when it does not fit or there is none.
 */
int32_t pel_host_arguments(char *line, uint32_t size);

/* Ends the emulator; its exit status is `status`, held to 0..255. */
#if defined(__GNUC__)
__attribute__((noreturn))
#endif
void pel_host_exit(int status);

#endif
