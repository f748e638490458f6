/*
 * Reads bytes in memory as the command would read them from a file, and keeps what it says. The
 * program is linked with the readers of tools/, but not with say.c: messages come here.
 */
#ifndef HARNESS_H
#define HARNESS_H

#include <stddef.h>
#include <stdint.h>

#include "classfile.h"
#include "source.h"

/* Counts a check; prints what failed. Returns `holds`. */
int check(int holds, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Prints the closing line; returns the exit status. A leak is a failure, where leaks can be
 * seen. */
int finish(void);

/* What the readers said last, "FILE: message", and how many messages there were. */
extern char last_message[1024];
extern unsigned message_count;

/* How to read: pictures and videos (options.raw too), or class files and tables. */
typedef struct reading {
    int is_classes;
    source_options options;
} reading;

/* Reads everything from the bytes. -1 refused, otherwise how many frames (1 for classes). Checks
 * that exactly the refused ones have exactly one message, that it begins with `name`, and that
 * every view is one that the library accepts. */
int read_bytes(const char *name, const uint8_t *bytes, size_t count, const reading *how);

/* A whole file; NULL if it cannot be read. The caller frees it. */
uint8_t *load(const char *path, size_t *count);

#endif
