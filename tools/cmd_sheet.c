#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "options.h"
#include "plain.h"
#include "say.h"
#include "sink.h"
#include "usage.h"
#include "walk.h"

static const char help[] =
    "Usage: pel sheet [OPTION]... OUT IN...\n"
    "\n"
    "Joins pictures into one, row by row, in the order given; every frame of a stream is one. All\n"
    "cells have the size of the largest picture, smaller ones lie in their middle. OUT ends in "
    ".ppm,\n"
    ".pgm or .png, or is '-' for PPM on standard output.\n"
    "\n"
    "      --columns N          pictures in a row; default: as many as make the sheet square\n"
    "      --gap N              pixels between them, default 4\n"
    "\n"
    "Examples\n"
    "  pel sheet --columns 3 sheet.png before.ppm after.ppm difference.ppm\n"
    "  pel sheet --gap 1 film.png field.y4m\n";

struct job {
    unsigned long columns, gap;
    frame *cell;
    unsigned long count, room;
};

static int parse(int argc, char **argv, struct job *job)
{
    static const struct option long_options[] = {{"columns", required_argument, NULL, 'c'},
                                                 {"gap", required_argument, NULL, 'g'},
                                                 {"help", no_argument, NULL, 'h'},
                                                 {NULL, 0, NULL, 0}};
    int option;
    int failed = 0;
    opterr = 0;
    while (!failed && (option = getopt_long(argc, argv, ":h", long_options, NULL)) != -1) {
        switch (option) {
        case 'h':
            fputs(help, stdout);
            return EXIT_SUCCESS;
        case 'c':
            failed = options_number("--columns", optarg, 1, PEL_SIDE_MAX, &job->columns);
            break;
        case 'g':
            failed = options_number("--gap", optarg, 0, PEL_SIDE_MAX, &job->gap);
            break;
        default:
            return usage_bad_option("sheet", option, argv);
        }
    }
    if (failed) {
        return usage_hint("sheet");
    }
    if (argc - optind < 2) {
        return usage_error("sheet", "OUT and at least one IN wanted");
    }
    return sink_check_picture(argv[optind]) ? usage_hint("sheet") : -1;
}

static int keep(void *user, const char *path, unsigned long number, const pel_cview *view)
{
    struct job *job = user;
    if (number == job->room) {
        const unsigned long room = job->room ? 2 * job->room : 16;
        frame *larger = realloc(job->cell, room * sizeof *larger);
        if (!larger) {
            return say_error(path, "out of memory");
        }
        memset(larger + job->room, 0, (room - job->room) * sizeof *larger);
        job->cell = larger;
        job->room = room;
    }
    job->count = number + 1;
    return plain_make(path, view, PLAIN_RGB, &job->cell[number]);
}

static void paste(const pel_view *cell, const pel_view *sheet, unsigned long x, unsigned long y)
{
    for (unsigned row = 0; row < cell->height; row++) {
        memcpy(plain_row(sheet, (unsigned)y + row) + 3 * x, plain_row(cell, row),
               3 * (size_t)cell->width);
    }
}

/* As many columns as make the sheet nearest to a square from above. */
static unsigned long square(unsigned long count, unsigned long width, unsigned long height)
{
    unsigned long columns = 1;
    while (columns < count && columns * width < (count + columns - 1) / columns * height) {
        columns++;
    }
    return columns;
}

static int join(const struct job *job, const char *path)
{
    unsigned long width = 0;
    unsigned long height = 0;
    for (unsigned long i = 0; i < job->count; i++) {
        const pel_view *cell = &job->cell[i].view;
        width = cell->width > width ? cell->width : width;
        height = cell->height > height ? cell->height : height;
    }
    unsigned long columns = job->columns ? job->columns : square(job->count, width, height);
    columns = columns < job->count ? columns : job->count;
    const unsigned long rows = (job->count + columns - 1) / columns;
    const unsigned long sheet_width = columns * (width + job->gap) - job->gap;
    const unsigned long sheet_height = rows * (height + job->gap) - job->gap;
    frame sheet = {0};
    if (sheet_width > PEL_SIDE_MAX || sheet_height > PEL_SIDE_MAX) {
        return say_error(path, "would be %lux%lu, over %d a side", sheet_width, sheet_height,
                         PEL_SIDE_MAX);
    }
    if (frame_resize(&sheet, PEL_RGB888, PEL_RANGE_FULL, (unsigned)sheet_width,
                     (unsigned)sheet_height)) {
        return say_error(path, "out of memory for %lux%lu", sheet_width, sheet_height);
    }
    memset(sheet.bytes, 255, 3 * (size_t)sheet_width * sheet_height);
    for (unsigned long i = 0; i < job->count; i++) {
        const pel_view *cell = &job->cell[i].view;
        paste(cell, &sheet.view, i % columns * (width + job->gap) + (width - cell->width) / 2,
              i / columns * (height + job->gap) + (height - cell->height) / 2);
    }
    const pel_cview view = pel_view_to_read(&sheet.view);
    const int result = sink_picture(path, &view, NULL);
    frame_free(&sheet);
    return result;
}

static int run(int argc, char **argv)
{
    static struct job job;
    static const source_options describes_itself;
    job.gap = 4;
    const int status = parse(argc, argv, &job);
    if (status >= 0) {
        return status;
    }
    int failed = walk_frames(argv + optind + 1, argc - optind - 1, &describes_itself, keep, &job);
    if (!failed) {
        failed = join(&job, argv[optind]);
    }
    for (unsigned long i = 0; i < job.count; i++) {
        frame_free(&job.cell[i]);
    }
    free(job.cell);
    return failed ? EXIT_BAD_INPUT : EXIT_SUCCESS;
}

const command cmd_sheet = {"sheet", "join pictures into one", help, run};
