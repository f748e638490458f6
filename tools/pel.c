/* The command `pel`: finds its subcommand, runs it, and makes sure that what was printed
 * arrived. */
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <pel.h>

#include "command.h"
#include "say.h"

static const command *const commands[] = {
    &cmd_blobs,       &cmd_classify,  &cmd_runs,    &cmd_convert, &cmd_scene,
    &cmd_budget,      &cmd_classes,   &cmd_filter,  &cmd_point,   &cmd_corners,
    &cmd_edges,       &cmd_histogram, &cmd_line,    &cmd_sheet,   &cmd_listen,
    &cmd_formatcheck, &cmd_capture,   &cmd_cameras, &cmd_bench};

enum { COMMAND_COUNT = sizeof commands / sizeof commands[0] };

static void print_help(void)
{
    printf("pel %s: finds coloured things in a robot's pictures.\n\n"
           "Usage: pel COMMAND [OPTION]... FILE...\n\n",
           pel_version());
    for (size_t i = 0; i < COMMAND_COUNT; i++) {
        printf("  %-11s %s\n", commands[i]->name, commands[i]->summary);
    }
    printf("\n'pel COMMAND --help' is the manual of a command; '-' stands for standard input or\n"
           "standard output. Exit status: 0 done, 1 bad input, 2 bad usage.\n\n"
           "A first look:\n"
           "  pel scene --seed 7 -o robot.ppm --classes robot.classes\n"
           "  pel blobs -c robot.classes --min-area 20 -o found.png robot.ppm\n");
}

static const command *find(const char *name)
{
    for (size_t i = 0; i < COMMAND_COUNT; i++) {
        if (strcmp(commands[i]->name, name) == 0) {
            return commands[i];
        }
    }
    return NULL;
}

static int unknown(const char *name)
{
    say_error(NULL, "there is no command '%s'; 'pel --help' lists them", name);
    return EXIT_BAD_USAGE;
}

static int help(int argc, char **argv)
{
    if (argc < 2) {
        print_help();
        return EXIT_SUCCESS;
    }
    const command *wanted = find(argv[1]);
    if (!wanted) {
        return unknown(argv[1]);
    }
    fputs(wanted->help, stdout);
    return EXIT_SUCCESS;
}

static int run(int argc, char **argv)
{
    if (argc < 2) {
        say_error(NULL, "no command given; 'pel --help' lists them");
        return EXIT_BAD_USAGE;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) {
        print_help();
        return EXIT_SUCCESS;
    }
    if (strcmp(argv[1], "--version") == 0 || strcmp(argv[1], "-V") == 0) {
        printf("pel %s\n", pel_version());
        return EXIT_SUCCESS;
    }
    if (strcmp(argv[1], "help") == 0) {
        return help(argc - 1, argv + 1);
    }
    const command *wanted = find(argv[1]);
    return wanted ? wanted->run(argc - 1, argv + 1) : unknown(argv[1]);
}

int main(int argc, char **argv)
{
    /* A reader that goes away is an error to report, not a reason to die without a word. */
    signal(SIGPIPE, SIG_IGN);
    int status = run(argc, argv);
    errno = 0;
    if (fflush(stdout) != 0 || ferror(stdout)) {
        if (status == EXIT_SUCCESS) {
            say_error(NULL, "standard output: cannot write%s%s", errno ? ": " : "",
                      errno ? strerror(errno) : "");
            status = EXIT_BAD_INPUT;
        }
    }
    return status;
}
