/* What subcommands say to a wrong command line, the same way everywhere. */
#ifndef USAGE_H
#define USAGE_H

/* Prints "pel: <name>: <message>" and where to read on; returns EXIT_BAD_USAGE. */
int usage_error(const char *name, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The same for a command line whose fault has been printed already. */
int usage_hint(const char *name);

/* The same for what getopt_long, started with ":" and opterr 0, has just refused: `code` is what it
 * returned, '?' or ':'. */
int usage_bad_option(const char *name, int code, char **argv);

#endif
