#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "options.h"
#include "say.h"
#include "sink.h"
#include "usage.h"
#include "walk.h"

static const char help[] =
    "Usage: pel classify -c CLASSES [OPTION]... INPUT OUT\n"
    "\n"
    "Writes what the classifier sees: every pixel in the display colour of its class, black where "
    "there\n"
    "is none. The quickest way to judge a class file.\n"
    "\n"
    "INPUT is a PPM, PGM, PNG, JPEG or YUV4MPEG2 file; '-' is standard input. OUT ends in .ppm or "
    ".png,\n"
    "or is '-' for PPM on standard output; every frame of a stream goes there, so more than one "
    "frame\n"
    "needs '-'.\n"
    "\n"
    "  -c, --classes CLASSES    class file, CMVision's text format, or a .tm table\n"
    "      --raw FORMAT WxH     INPUT holds raw frames: YUYV 320x240, for example\n"
    "      --range RANGE        of raw YCbCr frames: full (default) or "
    "limited\n" OPTIONS_BACKEND_HELP "\n"
    "Examples\n"
    "  pel classify -c robot.classes robot.ppm seen.png\n"
    "  pel classify -c robot.classes --raw YUYV 320x240 --range limited frame.yuv seen.png\n";

struct job {
    const char *classes_path;
    const char *output;
    classes list;
    source_options input;
    pel_backend backend;
    uint8_t *labels, *rgb;
};

static int parse(int argc, char **argv, struct job *job)
{
    static const struct option long_options[] = {{"classes", required_argument, NULL, 'c'},
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
                return usage_hint("classify");
            }
            break;
        default:
            taken = options_input(option, argc, argv, &job->input);
            if (taken <= 0) {
                return taken < 0 ? usage_hint("classify")
                                 : usage_bad_option("classify", option, argv);
            }
        }
    }
    if (!job->classes_path) {
        return usage_error("classify", "no classes given: say -c CLASSES");
    }
    if (argc - optind != 2) {
        return usage_error("classify", "INPUT and OUT wanted, %d given", argc - optind);
    }
    job->output = argv[optind + 1];
    return sink_check_picture(job->output) ? usage_hint("classify") : -1;
}

static void paint(const struct job *job, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const uint8_t label = job->labels[i];
        const class_entry *entry = label ? &job->list.entry[label - 1] : NULL;
        job->rgb[3 * i] = entry ? entry->red : 0;
        job->rgb[3 * i + 1] = entry ? entry->green : 0;
        job->rgb[3 * i + 2] = entry ? entry->blue : 0;
    }
}

static int classify(struct job *job, const char *path, const pel_cview *view, uint16_t width,
                    uint16_t height)
{
    pel_view labels;
    pel_cview colours;
    pel_status status =
        pel_view_init(job->labels, PEL_GRAY8, PEL_RANGE_FULL, width, height, 0, &labels);
    if (status == PEL_OK) {
        status = pel_classify_frame(&job->list.classifier, view, &labels);
    }
    if (status == PEL_OK) {
        paint(job, (size_t)width * height);
        status = pel_cview_init(job->rgb, PEL_RGB888, PEL_RANGE_FULL, width, height, 0, &colours);
    }
    if (status != PEL_OK) {
        return say_error(path, "cannot be classified: %s", pel_status_name(status));
    }
    return sink_picture(job->output, &colours, NULL);
}

static int visit(void *user, const char *path, unsigned long number, const pel_cview *view)
{
    struct job *job = user;
    const uint16_t width = pel_color_width(view->format, view->width);
    const uint16_t height = pel_color_height(view->format, view->height);
    const size_t count = (size_t)width * height;
    if (walk_check_range(path, view, job->classes_path, &job->list)) {
        return -1;
    }
    if (number > 0 && strcmp(job->output, "-") != 0) {
        return say_error(path,
                         "holds more than one picture; with '-' as OUT they follow each other");
    }
    job->labels = malloc(count);
    job->rgb = malloc(3 * count);
    const int result = job->labels && job->rgb
                           ? classify(job, path, view, width, height)
                           : say_error(path, "out of memory for %ux%u", width, height);
    free(job->labels);
    free(job->rgb);
    return result;
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
    const int failed = walk_frames(argv + optind, 1, &job.input, visit, &job);
    classes_free(&job.list);
    return failed ? EXIT_BAD_INPUT : EXIT_SUCCESS;
}

const command cmd_classify = {"classify", "show a picture in the colours of its classes", help,
                              run};
