/* Messages of the command: errors go to standard error as "pel: FILE: what is wrong". */
#ifndef SAY_H
#define SAY_H

/* Exit statuses of the command. */
enum { EXIT_BAD_INPUT = 1, EXIT_BAD_USAGE = 2 };

/* Prints "pel: <where>: <message>" and a newline on standard error; returns -1, so that a reader
 * can `return say_error(path, "...")`. `where` is a file name ("-" prints as "standard input") or
 * NULL. */
int say_error(const char *where, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
