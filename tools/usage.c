#include "usage.h"

#include <getopt.h>
#include <stdarg.h>
#include <stdio.h>

#include "say.h"

int usage_hint(const char *name)
{
    fprintf(stderr, "Try 'pel %s --help'.\n", name);
    return EXIT_BAD_USAGE;
}

int usage_error(const char *name, const char *format, ...)
{
    char message[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    say_error(name, "%s", message);
    return usage_hint(name);
}

int usage_bad_option(const char *name, int code, char **argv)
{
    const char *word = argv[optind - 1];
    /* A bad letter within "-xyz" leaves optind at the word itself. */
    if (optopt > 0 && optopt < 256 && word[0] == '-' && word[1] == '-') {
        return usage_error(name, "option '%s' %s", word,
                           code == ':' ? "needs a value" : "is wrong");
    }
    if (optopt > 0 && optopt < 256) {
        return usage_error(
            name, code == ':' ? "option '-%c' needs a value" : "unknown option '-%c'", optopt);
    }
    return usage_error(name, code == ':' ? "option '%s' needs a value" : "unknown option '%s'",
                       word);
}
