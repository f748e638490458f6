#include <getopt.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "decimal.h"
#include "draw.h"
#include "options.h"
#include "outlet.h"
#include "plain.h"
#include "report.h"
#include "say.h"
#include "usage.h"
#include "walk.h"
#include "whole.h"

static const char help[] =
    "Usage: pel line [OPTION]... IN\n"
    "\n"
    "Fits a straight line to the white of a mask or of an edge map, such as a lane or the border "
    "of a\n"
    "field: every row gives the centres of its white spans, and the line is the one with the least "
    "sum\n"
    "of squared distances from them, found anew after leaving out those that are too far away.\n"
    "\n"
    "IN is a PPM, PGM, PNG, JPEG or YUV4MPEG2 file, or raw frames; '-' is standard input. A "
    "colour\n"
    "picture counts by its luma.\n"
    "\n"
    "Which points\n"
    "      --label N            the value to look for, 0..255, default 255\n"
    "      --columns            look along columns: for lines that run across\n"
    "      --length MIN-MAX     only spans of so many pixels\n"
    "      --roi X0,Y0,X1,Y1    only in this box (x0 <= x < x1)\n"
    "Which line\n"
    "      --distance D         how far a point may be from the line, in pixels, default 2\n"
    "      --rounds N           how often far points are left out, 0..8, default 4; the first "
    "rounds\n"
    "                           are more generous\n"
    "      --raw FORMAT WxH     IN holds raw frames: GRAY8 320x240, for example\n"
    "      --range RANGE        of raw YCbCr frames: full (default) or limited\n"
    "\n"
    "What to write\n"
    "      --csv                a line per frame; the first line names the columns:\n"
    "                           frame,points,inliers,x0,y0,x1,y1,angle_deg (clockwise from x, -90 "
    "to\n"
    "                           90), the last five empty where there is no line\n"
    "  -o OUT                   the picture with the line drawn in: .ppm, .png, .y4m, or '-' for "
    "PPM\n"
    "                           in place of the numbers\n"
    "\n"
    "Examples\n"
    "  pel point threshold 180 field.ppm - | pel line --length 2-30 -\n"
    "  pel edges field.ppm - | pel line --columns --roi 0,40,320,80 -o border.png -\n";

struct job {
    source_options input;
    const char *output;
    pel_scan scan;
    int32_t distance_milli;
    unsigned long rounds;
    int csv;
    outlet to;
    frame gray, drawn;
    pel_point_q4 *points;
};

/* ---- The command line ---------------------------------------------------------------------- */

static int read_label(pel_scan *scan)
{
    unsigned long number;
    if (options_number("--label", optarg, 0, 255, &number)) {
        return -1;
    }
    scan->label = (uint8_t)number;
    return 0;
}

static int read_length(pel_scan *scan)
{
    unsigned min;
    unsigned max;
    char end;
    if (strlen(optarg) > 9 || optarg[strspn(optarg, "0123456789-")] != '\0' ||
        sscanf(optarg, "%u-%u%c", &min, &max, &end) != 2 || min < 1 || min > max ||
        max > PEL_SIDE_MAX) {
        return say_error("line", "--length needs MIN-MAX, such as 2-30, not '%s'", optarg);
    }
    scan->length_min = (uint16_t)min;
    scan->length_max = (uint16_t)max;
    return 0;
}

static int read_roi(pel_scan *scan)
{
    uint16_t box[4];
    if (whole_box("line", "--roi", optarg, box)) {
        return -1;
    }
    scan->x0 = box[0];
    scan->y0 = box[1];
    scan->x1 = box[2];
    scan->y1 = box[3];
    return 0;
}

/* Takes an option with a value; 0, or -1 after a message. */
static int read_option(int option, int argc, char **argv, struct job *job)
{
    switch (option) {
    case OPTION_RAW:
    case OPTION_RANGE:
        return options_input(option, argc, argv, &job->input) < 0 ? -1 : 0;
    case 'b':
        return read_label(&job->scan);
    case 'l':
        return read_length(&job->scan);
    case 'r':
        return read_roi(&job->scan);
    case 'd':
        return decimal_milli("line", "--distance", optarg, 0, 8000000, &job->distance_milli);
    default:
        return options_number("--rounds", optarg, 0, 8, &job->rounds);
    }
}

static int is_stdout(const char *path)
{
    return path && strcmp(path, "-") == 0;
}

static int check(int argc, char **argv, struct job *job)
{
    int status = EXIT_SUCCESS;
    if (argc - optind != 1) {
        return usage_error("line", "one IN wanted, %d given", argc - optind);
    }
    if (is_stdout(job->output) && job->csv) {
        return usage_error("line", "standard output cannot take both the numbers and the picture");
    }
    if (job->output && outlet_begin(&job->to, "line", argv[optind], job->output, &status)) {
        return status;
    }
    return -1;
}

static const struct option long_options[] = {OPTIONS_INPUT,
                                             {"label", required_argument, NULL, 'b'},
                                             {"columns", no_argument, NULL, 'c'},
                                             {"length", required_argument, NULL, 'l'},
                                             {"roi", required_argument, NULL, 'r'},
                                             {"distance", required_argument, NULL, 'd'},
                                             {"rounds", required_argument, NULL, 'n'},
                                             {"csv", no_argument, NULL, 'v'},
                                             {"help", no_argument, NULL, 'h'},
                                             {NULL, 0, NULL, 0}};

/* Reads the command line: -1 to go on, or an exit status. */
static int parse(int argc, char **argv, struct job *job)
{
    int option;
    opterr = 0;
    while ((option = getopt_long(argc, argv, ":o:h", long_options, NULL)) != -1) {
        switch (option) {
        case 'h':
            fputs(help, stdout);
            return EXIT_SUCCESS;
        case 'o':
            job->output = optarg;
            break;
        case 'v':
            job->csv = 1;
            break;
        case 'c':
            job->scan.columns = 1;
            break;
        case '?':
        case ':':
            return usage_bad_option("line", option, argv);
        default:
            if (read_option(option, argc, argv, job)) {
                return usage_hint("line");
            }
        }
    }
    return check(argc, argv, job);
}

/* ---- Results ------------------------------------------------------------------------------- */

static void print_csv(unsigned long number, uint32_t points, const pel_line *line)
{
    if (number == 0) {
        puts("frame,points,inliers,x0,y0,x1,y1,angle_deg");
    }
    if (!line) {
        printf("%lu,%" PRIu32 ",0,,,,,\n", number, points);
        return;
    }
    printf("%lu,%" PRIu32 ",%u,%.4f,%.4f,%.4f,%.4f,%.3f\n", number, points, line->inliers,
           line->x0_q4 / 16.0, line->y0_q4 / 16.0, line->x1_q4 / 16.0, line->y1_q4 / 16.0,
           line->angle_turn16 * 360.0 / 65536.0);
}

static int print_line(const struct job *job, unsigned long number, uint32_t points,
                      const pel_line *line)
{
    if (job->csv) {
        print_csv(number, points, line);
    } else if (!line) {
        printf("frame %lu: no line, %" PRIu32 " points\n", number, points);
    } else {
        printf("frame %lu: from (%.2f, %.2f) to (%.2f, %.2f), %.2f degrees, %u of %" PRIu32
               " points\n",
               number, line->x0_q4 / 16.0, line->y0_q4 / 16.0, line->x1_q4 / 16.0,
               line->y1_q4 / 16.0, line->angle_turn16 * 360.0 / 65536.0, line->inliers, points);
    }
    return report_close(stdout, "-"); /* flushed, so that a reader sees each frame at once */
}

static int draw(struct job *job, const char *path, const pel_cview *view, const pel_line *line)
{
    static const draw_color red = {255, 40, 40};
    if (plain_make(path, view, PLAIN_RGB, &job->drawn)) {
        return -1;
    }
    if (line) {
        draw_line(&job->drawn.view, (line->x0_q4 + 8) >> 4, (line->y0_q4 + 8) >> 4,
                  (line->x1_q4 + 8) >> 4, (line->y1_q4 + 8) >> 4, red);
    }
    const pel_cview drawn = pel_view_to_read(&job->drawn.view);
    return outlet_view(&job->to, path, &drawn);
}

/* ---- Fitting ------------------------------------------------------------------------------- */

static int scan(const struct job *job, const char *path, const pel_cview *gray, uint32_t *count)
{
    const pel_status status =
        pel_scan_view(&job->scan, gray, job->points, PEL_LINE_POINTS_MAX, count);
    if (status == PEL_TRUNCATED) {
        return say_error(path, "has more than %d spans; choose with --roi or --length",
                         PEL_LINE_POINTS_MAX);
    }
    if (status == PEL_ERR_RANGE) {
        return say_error(path, "the box %u,%u,%u,%u is not inside of its %ux%u pixels",
                         job->scan.x0, job->scan.y0, job->scan.x1, job->scan.y1, gray->width,
                         gray->height);
    }
    return status == PEL_OK ? 0 : say_error(path, "cannot be scanned: %s", pel_status_name(status));
}

static int visit(void *user, const char *path, unsigned long number, const pel_cview *view)
{
    struct job *job = user;
    pel_line line;
    uint32_t count = 0;
    if (plain_make(path, view, PLAIN_GRAY, &job->gray)) {
        return -1;
    }
    const pel_cview gray = pel_view_to_read(&job->gray.view);
    if (scan(job, path, &gray, &count)) {
        return -1;
    }
    const uint32_t distance_q4 = (uint32_t)((job->distance_milli * (int64_t)16 + 500) / 1000);
    const pel_status status =
        pel_line_fit(job->points, count, distance_q4, (unsigned)job->rounds, &line);
    if (status != PEL_OK && status != PEL_ERR_RANGE) {
        return say_error(path, "its line cannot be found: %s", pel_status_name(status));
    }
    /* Out of range: fewer than two points that differ. */
    const pel_line *found = status == PEL_OK && line.inliers > 0 ? &line : NULL;
    if (!is_stdout(job->output) && print_line(job, number, count, found)) {
        return -1;
    }
    return job->output ? draw(job, path, view, found) : 0;
}

static int run(int argc, char **argv)
{
    static struct job job;
    static pel_point_q4 points[PEL_LINE_POINTS_MAX];
    job.points = points;
    job.scan.label = 255;
    job.distance_milli = 2000;
    job.rounds = 4;
    const int status = parse(argc, argv, &job);
    if (status >= 0) {
        return status;
    }
    int failed = walk_frames(argv + optind, 1, &job.input, visit, &job);
    if (job.output) {
        failed = outlet_close(&job.to, failed);
    }
    frame_free(&job.gray);
    frame_free(&job.drawn);
    return failed ? EXIT_BAD_INPUT : EXIT_SUCCESS;
}

const command cmd_line = {"line", "fit a straight line to a mask or an edge map", help, run};
