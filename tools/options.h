/*
 * The options that subcommands share, read the same way everywhere. In a getopt_long loop:
 *
 *     {"raw", required_argument, NULL, 'R'}, {"range", required_argument, NULL, 'G'},
 *     ...
 *     case 'R': if (options_raw(argc, argv, &input)) { return EXIT_BAD_USAGE; } break;
 *     case 'G': if (options_range(optarg, &input.range)) { return EXIT_BAD_USAGE; } break;
 *
 * All return 0, or -1 after a message that lists what is valid; then nothing was changed.
 */
#ifndef OPTIONS_H
#define OPTIONS_H

#include "source.h"

/* "--raw FORMAT WIDTHxHEIGHT", two words: called when getopt_long has just returned the option,
 * whose argument is FORMAT. Takes argv[optind] as the size and moves optind past it. */
int options_raw(int argc, char **argv, source_options *options);

/* A pixel format by its name, upper or lower case: "yuyv", "RGB565_BE". */
int options_format(const char *word, pel_format *format);

/* A size such as "320x240", 1..PEL_SIDE_MAX each. */
int options_size(const char *word, unsigned *width, unsigned *height);

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
