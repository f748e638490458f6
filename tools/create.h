/* New files of programs that run unattended: no existing file is touched unless that was said, and
 * a name never leads anywhere else. */
#ifndef CREATE_H
#define CREATE_H

#include <stdio.h>

/*
 * Creates a file to write, with mode 0644 less the umask. An existing one is refused, or with
 * `force` emptied if it is a regular file with that one name. Symbolic links are not followed.
 * NULL after a message.
 */
FILE *create_file(const char *path, int force);

/* Says early whether create_file would refuse a name that exists: 0, or -1 after a message. */
int create_check(const char *path, int force);

#endif
