/*
 * The options that subcommands share, read the same way everywhere. In a getopt_long loop:
 *
 *     static const struct option known[] = {OPTIONS_INPUT, ...};
 *     ...
 *     default: taken = options_input(option, argc, argv, &input); ...
 *
 * All but options_input and options_same_word return 0, or -1 after a message that lists what is
 * valid; then nothing was changed.
 */
#ifndef OPTIONS_H
#define OPTIONS_H

#include <pel.h>

#include "source.h"

/* How inputs are read, for the list that getopt_long is given (<getopt.h>):
 * --raw FORMAT WIDTHxHEIGHT and --range RANGE. */
enum { OPTION_RAW = 'R', OPTION_RANGE = 'G', OPTION_BACKEND = 256 };
#define OPTIONS_INPUT                                                                              \
    {"raw", required_argument, NULL, OPTION_RAW},                                                  \
    {                                                                                              \
        "range", required_argument, NULL, OPTION_RANGE                                             \
    }

/* Takes what getopt_long has just returned if it is one of OPTIONS_INPUT; --raw has a second word
 * and moves optind past it. 1 taken, 0 another option, -1 after a message. */
int options_input(int option, int argc, char **argv, source_options *input);

/* --backend NAME, for the same list, and as a part of the manual. */
#define OPTIONS_BACKEND                                                                            \
    {                                                                                              \
        "backend", required_argument, NULL, OPTION_BACKEND                                         \
    }
#define OPTIONS_BACKEND_HELP                                                                       \
    "      --backend NAME       processor instructions: scalar, ssse3, avx2, ...; default: the "   \
    "best\n"                                                                                       \
    "                           here. Results do not depend on it\n"

/* A backend that this machine has, by its name, or "auto". */
int options_backend(const char *word, pel_backend *backend);

/* A pixel format by its name, upper or lower case: "yuyv", "RGB565_BE". */
int options_format(const char *word, pel_format *format);

/* A size such as "320x240", 1..PEL_SIDE_MAX each. */
int options_size(const char *word, unsigned *width, unsigned *height);

/* A part of a picture, x0 <= x < x1 and y0 <= y < y1. */
typedef struct options_box {
    uint16_t x0, y0, x1, y1;
} options_box;

/* "X0,Y0,X1,Y1", not empty, each at most PEL_SIDE_MAX. `name` is the option's, for the message. */
int options_take_box(const char *name, const char *word, options_box *box);

/* "full" or "limited". */
int options_range(const char *word, pel_range *range);

/* A decimal number min..max, nothing else in the word. `name` is the option's, for the message. */
int options_number(const char *name, const char *word, unsigned long min, unsigned long max,
                   unsigned long *number);

/* Says whether frames of this format can have this size; the message names the rule. */
int options_check_size(pel_format format, unsigned width, unsigned height);

/* 1 if the words are equal but for upper and lower case (ASCII), 0 if not. */
int options_same_word(const char *a, const char *b);

#endif
