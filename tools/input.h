/*
 * A file or pipe that is read once from front to back, with a look ahead to tell formats apart.
 * Every reader of a file format reads through it, so that messages can say where the fault is.
 */
#ifndef INPUT_H
#define INPUT_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum { INPUT_LOOK_MAX = 16, INPUT_BUFFER_BYTES = 16384 };

typedef struct input {
    const char *path; /* for messages; must outlive the input */
    FILE *file;
    uint64_t offset; /* bytes taken so far */
    uint64_t line;   /* of the next byte, counted from 1 */
    size_t at, end;  /* what of the buffer is not taken yet */
    int read_errno;  /* why reading stopped; 0 = at the end of the file or not stopped */
    uint8_t buffer[INPUT_BUFFER_BYTES];
} input;

/* Opens a file, "-" for standard input. 0, or -1 after a message. */
int input_open(input *in, const char *path);

/* Reads from an open stream, which input_close will close. */
void input_attach(input *in, FILE *file, const char *path);

void input_close(input *in);

/* The next byte, or EOF; peek leaves it there. */
int input_get(input *in);
int input_peek(input *in);

/* The next bytes without taking them, at most INPUT_LOOK_MAX; returns how many there are. */
size_t input_look(input *in, uint8_t *bytes, size_t count);

/* Takes up to `count` bytes; fewer only at the end of the file. Does not count lines. */
size_t input_read(input *in, uint8_t *bytes, size_t count);

/* The bytes that are in the buffer now, after filling it if it was empty; *count is 0 at the end.
 * input_skip takes some of them. For libraries that read from memory in pieces. */
const uint8_t *input_window(input *in, size_t *count);
void input_skip(input *in, size_t count);

/* 1 if there is nothing left. */
int input_at_end(input *in);

/* "pel: FILE: byte N: message" and "pel: FILE: line N: message" for the next byte; both return -1.
 * If reading stopped because of the disk or the pipe they say that instead. */
int input_error_byte(const input *in, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
int input_error_line(const input *in, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
