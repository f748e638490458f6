#include <getopt.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "options.h"
#include "plain.h"
#include "report.h"
#include "say.h"
#include "sink.h"
#include "usage.h"
#include "walk.h"

static const char help[] =
    "Usage: pel histogram [OPTION]... IN\n"
    "\n"
    "Counts how often each value occurs: of a gray picture, or of the red, green and blue of one. "
    "The\n"
    "frames of a stream are counted together.\n"
    "\n"
    "IN is a PPM, PGM, PNG, JPEG or YUV4MPEG2 file, or raw frames; '-' is standard input.\n"
    "\n"
    "      --gray               count the luma of a colour picture\n"
    "      --cumulative         count the values up to each, instead of each\n"
    "      --raw FORMAT WxH     IN holds raw frames: YUYV 320x240, for example\n"
    "      --range RANGE        of raw YCbCr frames: full (default) or limited\n"
    "\n"
    "What to write\n"
    "      --csv                256 lines; the first line names the columns: value,count or\n"
    "                           value,red,green,blue. Otherwise a table for people: smallest and\n"
    "                           largest value, mean, variance, percentiles, and Otsu's threshold\n"
    "  -o OUT                   a picture of 512x256 pixels: two columns for each value from 0 on, "
    "as\n"
    "                           high as it is frequent, the most frequent one 256. Colours are\n"
    "                           drawn over each other as light. .ppm, .pgm, .png, or '-' for PPM "
    "in\n"
    "                           place of the numbers\n"
    "\n"
    "Examples\n"
    "  pel histogram robot.ppm\n"
    "  pel histogram --gray --csv robot.ppm > gray.csv\n"
    "  pel histogram -o histogram.png robot.ppm\n";

enum { COLUMN_PX = 2, HEIGHT_PX = 256 };

struct job {
    source_options input;
    const char *output;
    plain_kind kind;
    int csv, cumulative;
    unsigned channels; /* 0 before the first frame */
    uint64_t pixels;
    uint32_t bins[3][256];
    frame plain;
};

/* ---- The command line ---------------------------------------------------------------------- */

/* Takes an option; -1 to go on, or an exit status. */
static int take_option(int option, int argc, char **argv, struct job *job)
{
    int failed = 0;
    switch (option) {
    case OPTION_RAW:
    case OPTION_RANGE:
        failed = options_input(option, argc, argv, &job->input) < 0;
        break;
    case 'Y':
        job->kind = PLAIN_GRAY;
        break;
    case 'c':
        job->cumulative = 1;
        break;
    case 'v':
        job->csv = 1;
        break;
    case 'o':
        job->output = optarg;
        break;
    default:
        return usage_bad_option("histogram", option, argv);
    }
    return failed ? usage_hint("histogram") : -1;
}

static int parse(int argc, char **argv, struct job *job)
{
    static const struct option long_options[] = {OPTIONS_INPUT,
                                                 {"gray", no_argument, NULL, 'Y'},
                                                 {"cumulative", no_argument, NULL, 'c'},
                                                 {"csv", no_argument, NULL, 'v'},
                                                 {"help", no_argument, NULL, 'h'},
                                                 {NULL, 0, NULL, 0}};
    int option;
    opterr = 0;
    while ((option = getopt_long(argc, argv, ":o:h", long_options, NULL)) != -1) {
        if (option == 'h') {
            fputs(help, stdout);
            return EXIT_SUCCESS;
        }
        const int status = take_option(option, argc, argv, job);
        if (status >= 0) {
            return status;
        }
    }
    if (argc - optind != 1) {
        return usage_error("histogram", "one IN wanted, %d given", argc - optind);
    }
    if (job->csv && job->output && strcmp(job->output, "-") == 0) {
        return usage_error("histogram",
                           "standard output cannot take both the numbers and the picture");
    }
    return job->output && sink_check_picture(job->output) ? usage_hint("histogram") : -1;
}

/* ---- Counting ------------------------------------------------------------------------------ */

static int count_plain(struct job *job, const pel_cview *view)
{
    const unsigned channels = view->format == PEL_GRAY8 ? 1 : 3;
    pel_status status = PEL_OK;
    for (unsigned y = 0; y < view->height; y++) {
        const uint8_t *row = plain_row(&job->plain.view, y);
        for (unsigned i = 0; i < channels && status == PEL_OK; i++) {
            status = pel_histogram_row(row + i, channels, view->width, job->bins[i]);
        }
    }
    return status == PEL_OK ? 0 : -1;
}

static int visit(void *user, const char *path, unsigned long number, const pel_cview *view)
{
    struct job *job = user;
    (void)number;
    if (plain_make(path, view, job->kind, &job->plain)) {
        return -1;
    }
    const pel_cview plain = pel_view_to_read(&job->plain.view);
    const unsigned channels = plain.format == PEL_GRAY8 ? 1 : 3;
    if (job->channels != 0 && job->channels != channels) {
        return say_error(path, "has both gray and colour pictures; count them with --gray");
    }
    job->channels = channels;
    job->pixels += (uint64_t)plain.width * plain.height;
    if (job->pixels > (uint64_t)PEL_SIDE_MAX * PEL_SIDE_MAX) {
        return say_error(path, "has more than 2^26 pixels in all; choose frames with 'pel convert "
                               "--frame N'");
    }
    return count_plain(job, &plain) ? say_error(path, "cannot be counted") : 0;
}

/* ---- The numbers --------------------------------------------------------------------------- */

static const char *channel_name(const struct job *job, unsigned i)
{
    static const char *const names[] = {"red", "green", "blue"};
    return job->channels == 1 ? "count" : names[i];
}

static void print_csv(const struct job *job)
{
    fputs("value", stdout);
    for (unsigned i = 0; i < job->channels; i++) {
        printf(",%s", channel_name(job, i));
    }
    for (unsigned value = 0; value < 256; value++) {
        printf("\n%u", value);
        for (unsigned i = 0; i < job->channels; i++) {
            printf(",%" PRIu32, job->bins[i][value]);
        }
    }
    putchar('\n');
}

static const uint16_t permilles[] = {10, 50, 250, 500, 750, 950, 990};

enum { PERMILLES = sizeof permilles / sizeof permilles[0] };

static int print_measures(const uint32_t bins[256], const char *name)
{
    pel_histogram_stats stats;
    uint8_t value;
    if (pel_histogram_measure(bins, &stats) != PEL_OK) {
        return -1;
    }
    printf("%-6s %9" PRIu32 " %4u %4u %7.2f %9.2f  ", name, stats.count, stats.min, stats.max,
           stats.mean_q8 / 256.0, stats.variance_q8 / 256.0);
    for (unsigned i = 0; i < PERMILLES; i++) {
        if (pel_histogram_percentile(bins, permilles[i], &value) != PEL_OK) {
            return -1;
        }
        printf(" %3u", value);
    }
    if (pel_histogram_otsu(bins, &value) != PEL_OK) {
        return -1;
    }
    printf("  %4u\n", value);
    return 0;
}

static int print_table(const struct job *job)
{
    fputs("           count  min  max    mean  variance  ", stdout);
    for (unsigned i = 0; i < PERMILLES; i++) {
        printf(" %2u%%", permilles[i] / 10u);
    }
    fputs("  otsu\n", stdout);
    for (unsigned i = 0; i < job->channels; i++) {
        if (print_measures(job->bins[i], job->channels == 1 ? "gray" : channel_name(job, i))) {
            return -1;
        }
    }
    return 0;
}

/* ---- The picture --------------------------------------------------------------------------- */

static uint32_t most_frequent(const struct job *job)
{
    uint32_t most = 0;
    for (unsigned i = 0; i < job->channels; i++) {
        for (unsigned value = 0; value < 256; value++) {
            most = job->bins[i][value] > most ? job->bins[i][value] : most;
        }
    }
    return most;
}

/* The height of a bar, rounded up so that what occurs is seen. */
static unsigned bar_px(uint32_t count, uint32_t most)
{
    return (unsigned)(((uint64_t)count * HEIGHT_PX + most - 1) / most);
}

static int draw(const struct job *job)
{
    frame picture = {0};
    const pel_format format = job->channels == 1 ? PEL_GRAY8 : PEL_RGB888;
    const uint32_t most = most_frequent(job);
    if (frame_resize(&picture, format, PEL_RANGE_FULL, 256 * COLUMN_PX, HEIGHT_PX)) {
        return say_error(job->output, "out of memory");
    }
    for (unsigned y = 0; y < HEIGHT_PX; y++) {
        uint8_t *row = plain_row(&picture.view, y);
        for (unsigned x = 0; x < 256 * COLUMN_PX; x++) {
            for (unsigned i = 0; i < job->channels; i++) {
                const unsigned bar = bar_px(job->bins[i][x / COLUMN_PX], most);
                *row++ = HEIGHT_PX - y <= bar ? 255 : 0;
            }
        }
    }
    const pel_cview view = pel_view_to_read(&picture.view);
    const int failed = sink_picture(job->output, &view, NULL);
    frame_free(&picture);
    return failed;
}

static int write_all(struct job *job)
{
    const int picture_only = job->output && strcmp(job->output, "-") == 0;
    if (!job->csv && !picture_only && print_table(job)) {
        return say_error("histogram", "its numbers cannot be measured");
    }
    for (unsigned i = 0; job->cumulative && i < job->channels; i++) {
        pel_histogram_cumulative(job->bins[i], job->bins[i]);
    }
    if (job->csv) {
        print_csv(job);
    }
    if (!picture_only && report_close(stdout, "-")) {
        return -1;
    }
    return job->output ? draw(job) : 0;
}

static int run(int argc, char **argv)
{
    static struct job job;
    const int status = parse(argc, argv, &job);
    if (status >= 0) {
        return status;
    }
    int failed = walk_frames(argv + optind, 1, &job.input, visit, &job);
    frame_free(&job.plain);
    if (!failed) {
        failed = write_all(&job);
    }
    return failed ? EXIT_BAD_INPUT : EXIT_SUCCESS;
}

const command cmd_histogram = {"histogram", "count the values of a picture, draw their histogram",
                               help, run};
