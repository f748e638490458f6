/* What the commands have in common that turn pictures into pictures: IN, OUT, how to read, and the
 * frames between. */
#ifndef TURN_H
#define TURN_H

#include <getopt.h>

#include "options.h"
#include "outlet.h"
#include "plain.h"

/* Turns a GRAY8 or RGB888 picture into another and writes it with outlet_view(&turn.to, path, ...)
 * or a relative of that. 0, or -1 after a message. */
typedef int turn_make(void *user, const char *path, const pel_cview *picture);

/* Zero it and set the first three. */
typedef struct turn {
    const char *command;
    turn_make *make;
    void *user;
    plain_kind kind;
    source_options input;
    char *in;
    outlet to;
    frame picture;
} turn;

/* The options that they share: --raw, --range, --gray, --help, for a getopt_long table, and as a
 * part of the manual. */
/* clang-format off */
#define TURN_OPTIONS                                                                               \
    OPTIONS_INPUT, \
    {"gray", no_argument, NULL, 'Y'}, {"help", no_argument, NULL, 'h'}, {NULL, 0, NULL, 0}
/* clang-format on */
#define TURN_HELP                                                                                  \
    "      --gray               work on the luma of a colour picture\n"                            \
    "      --raw FORMAT WxH     IN holds raw frames: YUYV 320x240, for example\n"                  \
    "      --range RANGE        of raw YCbCr frames: full (default) or limited\n"                  \
    "\n"                                                                                           \
    "IN is a PPM, PGM, PNG, JPEG or YUV4MPEG2 file; '-' is standard input. OUT ends in .ppm, "     \
    ".pgm, "                                                                                       \
    ".png\n"                                                                                       \
    "or .y4m; '-' is standard output, PPM or PGM. Every frame of a stream is turned, in order, "   \
    "as "                                                                                          \
    "it\n"                                                                                         \
    "arrives.\n"

/* Takes one of the options above, as getopt_long returned it: -1 to go on, or an exit status. */
int turn_option(turn *job, int option, int argc, char **argv);

/* Takes IN and OUT, the words from argv[optind] on: -1 to go on, or an exit status. */
int turn_files(turn *job, int argc, char **argv);

/* Turns all frames; returns the exit status. */
int turn_run(turn *job);

#endif
