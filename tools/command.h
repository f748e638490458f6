/*
 * The subcommands of `pel`. Each is one file cmd_NAME.c that defines one `const command cmd_NAME`;
 * pel.c lists them in its table.
 */
#ifndef COMMAND_H
#define COMMAND_H

typedef struct command {
    const char *name;
    const char *summary;               /* one line for `pel --help` */
    const char *help;                  /* the manual: what `pel NAME --help` prints */
    int (*run)(int argc, char **argv); /* argv[0] is the name; returns the exit status */
} command;

extern const command cmd_blobs, cmd_classify, cmd_runs, cmd_convert, cmd_scene, cmd_budget,
    cmd_classes, cmd_filter, cmd_point, cmd_corners, cmd_edges, cmd_histogram, cmd_line, cmd_sheet,
    cmd_listen, cmd_formatcheck, cmd_capture, cmd_cameras, cmd_bench;

#endif
