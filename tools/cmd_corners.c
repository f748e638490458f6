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

static const char help[] =
    "Usage: pel corners [OPTION]... IN\n"
    "\n"
    "Finds the corners of a picture, strongest first. Works on the luma of a colour picture.\n"
    "\n"
    "IN is a PPM, PGM, PNG, JPEG or YUV4MPEG2 file, or raw frames; '-' is standard input. Frames "
    "of a\n"
    "stream are searched as they arrive.\n"
    "\n"
    "      --method METHOD      harris (default), shi-tomasi, or fast (FAST-9); each has responses "
    "on\n"
    "                           a scale of its own\n"
    "      --max N              the N strongest of a frame, default 100\n"
    "      --threshold T        the least response, 1 or more; default 1, for fast 20 (at most "
    "254)\n"
    "      --k K                harris: det - K trace^2, 0..0.249, default 0.04\n"
    "      --suppress HOW       among neighbours: first (default: of equals the first counts), "
    "strict\n"
    "                           (equals put each other out) or none (all over the threshold)\n"
    "      --raw FORMAT WxH     IN holds raw frames: YUYV 320x240, for example\n"
    "      --range RANGE        of raw YCbCr frames: full (default) or "
    "limited\n" OPTIONS_BACKEND_HELP "\n"
    "What to write\n"
    "      --csv                a line per corner; the first line names the columns: "
    "x,y,response.\n"
    "                           An empty line stands between two frames\n"
    "      --subpixel           x and y with four decimals, in steps of 1/16 (not for fast)\n"
    "  -o OUT                   the picture with crosses on the corners: .ppm, .png, .y4m, or '-' "
    "for\n"
    "                           PPM in place of the list\n"
    "\n"
    "Examples\n"
    "  pel corners robot.ppm\n"
    "  pel corners --method fast --threshold 40 --csv robot.ppm > corners.csv\n"
    "  pel corners --max 54 --subpixel -o marked.png chessboard.jpg\n";

struct job {
    source_options input;
    const char *output;
    pel_corners_config config;
    unsigned long max;
    int csv, subpixel;
    outlet to;
    frame gray, drawn;
    int status; /* what the command will answer if it fails */
};

/* ---- The command line ---------------------------------------------------------------------- */

static int read_method(pel_corners_method *method)
{
    static const char *const names[] = {"harris", "shi-tomasi", "fast"};
    for (int i = 0; i < 3; i++) {
        if (options_same_word(optarg, names[i])) {
            *method = (pel_corners_method)i;
            return 0;
        }
    }
    return say_error("corners", "--method is harris, shi-tomasi or fast, not '%s'", optarg);
}

static int read_suppress(pel_corners_suppress *suppress)
{
    static const char *const names[] = {"first", "strict", "none"};
    for (int i = 0; i < 3; i++) {
        if (options_same_word(optarg, names[i])) {
            *suppress = (pel_corners_suppress)i;
            return 0;
        }
    }
    return say_error("corners", "--suppress is first, strict or none, not '%s'", optarg);
}

static int read_k(uint16_t *k_q15)
{
    int32_t milli;
    if (decimal_milli("corners", "--k", optarg, 1, 249, &milli)) {
        return -1;
    }
    *k_q15 = (uint16_t)((milli * 32768 + 500) / 1000);
    return 0;
}

static int read_threshold(int32_t *threshold)
{
    unsigned long number;
    if (options_number("--threshold", optarg, 1, INT32_MAX, &number)) {
        return -1;
    }
    *threshold = (int32_t)number;
    return 0;
}

/* Takes an option with a value; 0, or -1 after a message. */
static int read_option(int option, int argc, char **argv, struct job *job)
{
    switch (option) {
    case OPTION_RAW:
    case OPTION_RANGE:
        return options_input(option, argc, argv, &job->input) < 0 ? -1 : 0;
    case 'm':
        return read_method(&job->config.method);
    case 's':
        return read_suppress(&job->config.suppress);
    case 'k':
        return read_k(&job->config.k_q15);
    case OPTION_BACKEND:
        return options_backend(optarg, &job->config.backend);
    case 't':
        return read_threshold(&job->config.threshold);
    default:
        return options_number("--max", optarg, 1, 1000000, &job->max);
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
        return usage_error("corners", "one IN wanted, %d given", argc - optind);
    }
    if (job->config.method == PEL_CORNERS_FAST9 && (job->config.threshold > 254 || job->subpixel)) {
        return usage_error("corners", job->subpixel ? "fast has no --subpixel"
                                                    : "fast takes a --threshold of at most 254");
    }
    if (is_stdout(job->output) && job->csv) {
        return usage_error("corners", "standard output cannot take both the list and the picture");
    }
    if (job->output && outlet_begin(&job->to, "corners", argv[optind], job->output, &status)) {
        return status;
    }
    return -1;
}

static const struct option long_options[] = {OPTIONS_INPUT,
                                             OPTIONS_BACKEND,
                                             {"method", required_argument, NULL, 'm'},
                                             {"max", required_argument, NULL, 'x'},
                                             {"threshold", required_argument, NULL, 't'},
                                             {"k", required_argument, NULL, 'k'},
                                             {"suppress", required_argument, NULL, 's'},
                                             {"csv", no_argument, NULL, 'v'},
                                             {"subpixel", no_argument, NULL, 'p'},
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
        case 'p':
            job->subpixel = 1;
            break;
        case '?':
        case ':':
            return usage_bad_option("corners", option, argv);
        default:
            if (read_option(option, argc, argv, job)) {
                return usage_hint("corners");
            }
        }
    }
    return check(argc, argv, job);
}

/* ---- Printing ------------------------------------------------------------------------------ */

static void print_place(int32_t whole, int32_t sixteenths, int decimals, int width)
{
    if (!decimals) {
        printf("%*" PRId32, width, whole);
        return;
    }
    /* Beside the first pixel it may be just under 0. */
    const int32_t q4 = 16 * whole + sixteenths;
    const int32_t size = q4 < 0 ? -q4 : q4;
    char text[24];
    snprintf(text, sizeof text, "%s%" PRId32 ".%04" PRId32, q4 < 0 ? "-" : "", size / 16,
             size % 16 * 625);
    printf("%*s", width, text);
}

static int print_corners(const struct job *job, unsigned long number, const pel_corners *corners,
                         uint32_t count)
{
    const int width = job->csv ? 0 : job->subpixel ? 10 : 5;
    if (job->csv) {
        fputs(number == 0 ? "x,y,response\n" : "\n", stdout);
    } else {
        printf("frame %lu: %" PRIu32 " corners%s%" PRIu32 "%s\n%*s %*s %10s\n", number,
               corners->found, corners->dropped ? ", the strongest " : ", all ", count,
               count ? ":" : "", width, "x", width, "y", "response");
    }
    for (uint32_t i = 0; i < count; i++) {
        const pel_corner *corner = &corners->config.results[i];
        print_place(corner->x, corner->dx_q4, job->subpixel, width);
        putchar(job->csv ? ',' : ' ');
        print_place(corner->y, corner->dy_q4, job->subpixel, width);
        printf(job->csv ? ",%" PRId32 "\n" : " %10" PRId32 "\n", corner->response);
    }
    return report_close(stdout, "-"); /* flushed, so that a reader sees each frame at once */
}

/* ---- Drawing ------------------------------------------------------------------------------- */

static void draw_corner(const pel_view *picture, const pel_corner *corner)
{
    static const draw_color outer = {0, 0, 0};
    static const draw_color inner = {255, 40, 40};
    for (int i = -4; i <= 4; i++) {
        const draw_color color = i < -3 || i > 3 ? outer : inner;
        if (i != 0) {
            draw_pixel(picture, corner->x + i, corner->y, color);
            draw_pixel(picture, corner->x, corner->y + i, color);
        }
    }
}

static int draw_corners(struct job *job, const char *path, const pel_cview *view,
                        const pel_corner *corners, uint32_t count)
{
    if (plain_make(path, view, PLAIN_RGB, &job->drawn)) {
        return -1;
    }
    for (uint32_t i = count; i > 0; i--) { /* the strongest on top */
        draw_corner(&job->drawn.view, &corners[i - 1]);
    }
    const pel_cview drawn = pel_view_to_read(&job->drawn.view);
    return outlet_view(&job->to, path, &drawn);
}

/* ---- Finding ------------------------------------------------------------------------------- */

static int visit(void *user, const char *path, unsigned long number, const pel_cview *view)
{
    struct job *job = user;
    pel_corners corners;
    pel_corners_config config = job->config;
    uint32_t count = 0;
    int failed;
    if (plain_make(path, view, PLAIN_GRAY, &job->gray)) {
        return -1;
    }
    const pel_cview gray = pel_view_to_read(&job->gray.view);
    config.work_bytes = PEL_CORNERS_BYTES(gray.width, config.method);
    config.work = malloc(config.work_bytes);
    config.results_max = (uint32_t)job->max;
    config.results = malloc(job->max * sizeof *config.results);
    if (!config.work || !config.results) {
        failed = say_error(path, "out of memory");
    } else {
        const pel_status status = pel_corners_frame(&corners, &config, &gray, &count);
        failed = status < 0
                     ? say_error(path, "its corners cannot be found: %s", pel_status_name(status))
                     : 0;
    }
    if (!failed && !is_stdout(job->output)) {
        failed = print_corners(job, number, &corners, count);
    }
    if (!failed && job->output) {
        failed = draw_corners(job, path, view, config.results, count);
    }
    free(config.results);
    free(config.work);
    return failed;
}

static int run(int argc, char **argv)
{
    static struct job job;
    job.max = 100;
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

const command cmd_corners = {"corners", "find corners (Harris, Shi-Tomasi, FAST)", help, run};
