#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>

#include "command.h"
#include "options.h"
#include "report.h"
#include "say.h"
#include "usage.h"
#include "walk.h"

static const char help[] =
    "Usage: pel runs -c CLASSES [OPTION]... INPUT...\n"
    "\n"
    "Lists the runs of every row: the longest stretches of one class, x0 <= x < x1. This is what "
    "blobs\n"
    "are made of, and what a line follower or an obstacle scanner works on.\n"
    "\n"
    "  -c, --classes CLASSES    class file, CMVision's text format, or a .tm table\n"
    "      --csv                columns frame,y,x0,x1,class,name\n"
    "      --raw FORMAT WxH     INPUT holds raw frames: YUYV 320x240, for example\n"
    "      --range RANGE        of raw YCbCr frames: full (default) or "
    "limited\n" OPTIONS_BACKEND_HELP "\n"
    "Examples\n"
    "  pel runs -c robot.classes robot.ppm\n"
    "  pel runs -c robot.classes --csv - < robot.ppm\n";

struct job {
    const char *classes_path;
    int csv;
    classes list;
    source_options input;
    pel_backend backend;
};

static int parse(int argc, char **argv, struct job *job)
{
    static const struct option long_options[] = {{"classes", required_argument, NULL, 'c'},
                                                 {"csv", no_argument, NULL, 'v'},
                                                 OPTIONS_INPUT,
                                                 OPTIONS_BACKEND,
                                                 {"help", no_argument, NULL, 'h'},
                                                 {NULL, 0, NULL, 0}};
    int option, taken;
    opterr = 0;
    while ((option = getopt_long(argc, argv, ":c:h", long_options, NULL)) != -1) {
        switch (option) {
        case 'h':
            fputs(help, stdout);
            return EXIT_SUCCESS;
        case 'c':
            job->classes_path = optarg;
            break;
        case OPTION_BACKEND:
            if (options_backend(optarg, &job->backend)) {
                return usage_hint("runs");
            }
            break;
        case 'v':
            job->csv = 1;
            break;
        default:
            taken = options_input(option, argc, argv, &job->input);
            if (taken <= 0) {
                return taken < 0 ? usage_hint("runs") : usage_bad_option("runs", option, argv);
            }
        }
    }
    if (!job->classes_path) {
        return usage_error("runs", "no classes given: say -c CLASSES");
    }
    return optind < argc ? -1 : usage_error("runs", "no input given");
}

static void print_run(const struct job *job, unsigned long number, unsigned y, pel_run run,
                      unsigned class_index)
{
    const char *name = job->list.entry[class_index].name;
    if (job->csv) {
        printf("%lu,%u,%u,%u,%u,", number, y, (unsigned)run.x0, (unsigned)run.x1, class_index);
        report_csv_text(stdout, name);
        putchar('\n');
    } else {
        printf("%5lu %5u %5u %5u  %s\n", number, y, (unsigned)run.x0, (unsigned)run.x1, name);
    }
}

static int list_runs(const struct job *job, const char *path, unsigned long number,
                     const pel_cview *view, uint8_t *labels, pel_run *runs)
{
    const uint16_t width = pel_color_width(view->format, view->width);
    const uint16_t height = pel_color_height(view->format, view->height);
    for (uint16_t y = 0; y < height; y++) {
        const pel_crow row = pel_cview_row(view, y);
        const pel_status status = pel_classify_row(&job->list.classifier, &row, labels);
        if (status != PEL_OK) {
            return say_error(path, "cannot be classified: %s", pel_status_name(status));
        }
        const uint16_t count = pel_find_runs(labels, width, runs);
        for (uint16_t i = 0; i < count; i++) {
            print_run(job, number, y, runs[i], labels[runs[i].x0] - 1u);
        }
    }
    return 0;
}

static int visit(void *user, const char *path, unsigned long number, const pel_cview *view)
{
    const struct job *job = user;
    if (walk_check_range(path, view, job->classes_path, &job->list)) {
        return -1;
    }
    uint8_t *labels = malloc(view->width);
    pel_run *runs = malloc(PEL_RUNS_MAX(view->width) * sizeof *runs);
    const int result = labels && runs ? list_runs(job, path, number, view, labels, runs)
                                      : say_error(path, "out of memory");
    free(labels);
    free(runs);
    return result || report_close(stdout, "-") ? -1 : 0;
}

static int run(int argc, char **argv)
{
    static struct job job;
    const int status = parse(argc, argv, &job);
    if (status >= 0) {
        return status;
    }
    if (classes_read(job.classes_path, &job.list)) {
        return EXIT_BAD_INPUT;
    }
    classes_choose_backend(&job.list, job.backend);
    puts(job.csv ? "frame,y,x0,x1,class,name" : "frame     y    x0    x1  class");
    const int failed = walk_frames(argv + optind, argc - optind, &job.input, visit, &job);
    classes_free(&job.list);
    return failed ? EXIT_BAD_INPUT : EXIT_SUCCESS;
}

const command cmd_runs = {"runs", "list the runs of every class, row by row", help, run};
