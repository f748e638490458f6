#include "say.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

int say_error(const char *where, const char *format, ...)
{
    va_list arguments;

    fputs("pel: ", stderr);
    if (where) {
        fprintf(stderr, "%s: ", strcmp(where, "-") == 0 ? "standard input" : where);
    }
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
    return -1;
}
