#include <errno.h>
#include <getopt.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "carray.h"
#include "command.h"
#include "options.h"
#include "pack.h"
#include "say.h"
#include "sink.h"
#include "source.h"
#include "usage.h"

static const char help[] =
    "Usage: pel convert [OPTION]... IN OUT\n"
    "\n"
    "Converts pictures and video between all formats that pel reads and writes, and into C\n"
    "source. '-' is standard input or standard output.\n"
    "\n"
    "IN is told by its content, not by its name:\n"
    "  PPM, PGM     P2 P3 P5 P6, any maxval; several pictures in one file are several frames\n"
    "  PNG, JPEG    16 bits become 8, alpha is dropped\n"
    "  YUV4MPEG2    8-bit 4:2:0, 4:2:2 and mono; limited range unless the header says\n"
    "               XCOLORRANGE=FULL\n"
    "  raw frames   need --raw\n"
    "\n"
    "OUT is told by the ending of its name:\n"
    "  .ppm .pgm    one picture after another; the default of '-' is PPM\n"
    "  .png         one picture; gray if the frame is gray\n"
    "  .jpg .jpeg   likewise, but lossy: quality 95, chroma of every pixel\n"
    "  .y4m         video: 4:2:2 without loss from YUYV and its relatives, 4:2:0 from NV12 and\n"
    "               I420, mono from gray\n"
    "  .raw .yuv    the bytes of the pixel format that --to names, frame after frame\n"
    "  any name     with --c-array, C source; with --to, what that names\n"
    "\n"
    "Options\n"
    "      --raw FORMAT WIDTHxHEIGHT\n"
    "                       IN holds raw frames; two words, such as --raw YUYV 320x240\n"
    "      --to FORMAT      pixel format of OUT, needed for .raw, .yuv and --c-array unless IN\n"
    "                       is raw: then it stays. Or ppm, pgm, png, jpg, y4m, for '-'\n"
    "      --range RANGE    full or limited: what YCbCr bytes mean that do not say so\n"
    "                       themselves, of raw IN and of OUT. Without it raw IN is full, and OUT\n"
    "                       has the range of IN; RGB becomes full\n"
    "      --c-array NAME   writes the frame as C source: const uint8_t NAME[], in the bytes of\n"
    "                       the sensor, with NAME_width and NAME_height\n"
    "      --frame N        only frame N, from 0; may be given several times\n"
    "      --crop X0,Y0,X1,Y1\n"
    "                       only this part of each frame, x0 <= x < x1, in pixels of IN (Bayer:\n"
    "                       of the mosaic). Pixels that share colours stay together: x even in\n"
    "                       4:2:2, x and y even in 4:2:0 and Bayer\n"
    "  -h, --help           this text\n"
    "\n"
    "Pixel formats: GRAY8 YUYV UYVY YVYU VYUY NV12 I420 RGB565_LE RGB565_BE RGB888 BGR888\n"
    "BAYER8_RGGB BAYER8_GRBG BAYER8_GBRG BAYER8_BGGR, in upper or lower case. 4:2:2 needs an\n"
    "even width, 4:2:0 and Bayer an even width and height. A Bayer mosaic becomes a picture of\n"
    "half its width and height.\n"
    "\n"
    "Examples\n"
    "  pel convert photo.jpg photo.ppm\n"
    "  pel convert --to YUYV robot.ppm robot.yuv\n"
    "  pel convert --raw YUYV 320x240 --range limited camera.yuv camera.y4m\n"
    "  pel convert --raw UYVY 160x120 --frame 17 field.yuv failure.png\n"
    "  pel convert --raw RGB565_BE 160x120 --frame 17 --c-array failure field.raw failure.c\n"
    "  pel convert --to RGB565_BE photo.png - | wc -c\n"
    "  pel convert --crop 0,0,2048,1536 large.jpg part.png\n";

enum { FRAMES_MAX = 100 };

/* What was asked for. */
typedef struct request {
    source_options input;
    const char *in, *out, *array;
    int has_format, has_kind, has_range, has_crop;
    pel_format format; /* of OUT, if has_format */
    sink_kind kind;    /* of OUT, always known in the end unless `array` */
    options_box crop;
    unsigned long frames[FRAMES_MAX]; /* wanted; none: all */
    unsigned frame_count;
} request;

/* Where the frames go: a picture file, a video, or one C array. */
typedef struct output {
    sink to;
    FILE *array;
    frame packed;
    unsigned long written;
} output;

/* ---- The command line ---------------------------------------------------------------------- */

static int take_frame(request *wanted)
{
    if (wanted->frame_count == FRAMES_MAX) {
        return say_error("convert", "at most %d frames can be chosen with --frame", FRAMES_MAX);
    }
    return options_number("--frame", optarg, 0, ULONG_MAX / 2,
                          &wanted->frames[wanted->frame_count++]);
}

/* --to names a file format or a pixel format. */
static int take_target(request *wanted)
{
    if (!options_same_word(optarg, "raw") && !options_same_word(optarg, "yuv") &&
        sink_kind_by_name(optarg, &wanted->kind) == 0) {
        wanted->has_kind = 1;
        return 0;
    }
    wanted->has_format = 1;
    return options_format(optarg, &wanted->format);
}

static int take_crop(request *wanted)
{
    wanted->has_crop = 1;
    return options_take_box("--crop", optarg, &wanted->crop);
}

static int take_array(request *wanted)
{
    wanted->array = optarg;
    return carray_name_ok(optarg)
               ? 0
               : say_error("convert",
                           "'%s' cannot name an array in C: letters, digits and '_', at most "
                           "60, no digit first, no keyword of C or C++",
                           optarg);
}

/* Takes one of the options that inputs have everywhere. --range is OUT's, too. */
static int take_input(int option, int argc, char **argv, request *wanted)
{
    const int taken = options_input(option, argc, argv, &wanted->input);

    wanted->has_range |= option == OPTION_RANGE;
    if (taken == 0) {
        usage_bad_option("convert", option, argv);
    } else if (taken < 0) {
        usage_hint("convert");
    }
    return taken > 0 ? 0 : -1;
}

/* Takes one of convert's own: 0, or -1 after a message. */
static int take_option(int option, request *wanted)
{
    int status;

    switch (option) {
    case 'T':
        status = take_target(wanted);
        break;
    case 'F':
        status = take_frame(wanted);
        break;
    case 'P':
        status = take_crop(wanted);
        break;
    default:
        status = take_array(wanted);
    }
    if (status) {
        usage_hint("convert");
    }
    return status;
}

/* 0 to go on, 1 after --help, -1 after a message. */
static int parse_options(int argc, char **argv, request *wanted)
{
    static const struct option known[] = {
        OPTIONS_INPUT,
        {"to", required_argument, NULL, 'T'},
        {"crop", required_argument, NULL, 'P'},
        {"frame", required_argument, NULL, 'F'},
        {"c-array", required_argument, NULL, 'C'},
        {"help", no_argument, NULL, 'h'},
        {NULL, 0, NULL, 0},
    };
    int option, status = 0;

    opterr = 0;
    while (status == 0 && (option = getopt_long(argc, argv, ":h", known, NULL)) != -1) {
        switch (option) {
        case 'h':
            return 1;
        case 'T':
        case 'F':
        case 'P':
        case 'C':
            status = take_option(option, wanted);
            break;
        default:
            status = take_input(option, argc, argv, wanted);
        }
    }
    return status;
}

/* Decides what kind of file OUT is, from its name and --to. */
static int choose_kind(request *wanted)
{
    sink_kind by_name;
    int named = sink_kind_by_path(wanted->out, &by_name) == 0;

    if (!wanted->has_kind) {
        if (named) {
            wanted->kind = by_name;
        } else if (wanted->has_format) {
            wanted->kind = SINK_RAW;
        } else if (strcmp(wanted->out, "-") == 0) {
            wanted->kind = SINK_PPM;
        } else {
            return usage_error("convert",
                               "what shall '%s' be? It ends in none of " SINK_ENDINGS
                               ", and there is no --to",
                               wanted->out);
        }
    } else if (named && by_name != wanted->kind) {
        return usage_error("convert", "--to says another format than the ending of '%s'",
                           wanted->out);
    }
    if (wanted->kind < SINK_Y4M && wanted->has_format) {
        return usage_error("convert",
                           "pictures have no pixel format to choose; leave out --to, or end "
                           "'%s' in .raw or .y4m",
                           wanted->out);
    }
    return 0;
}

static int check_request(request *wanted)
{
    if (!wanted->array && choose_kind(wanted)) {
        return EXIT_BAD_USAGE;
    }
    if (wanted->array && wanted->has_kind) {
        return usage_error("convert", "--c-array needs a pixel format in --to, such as --to YUYV");
    }
    if (!wanted->has_format && (wanted->array || wanted->kind == SINK_RAW)) {
        if (!wanted->input.raw) {
            return usage_error("convert", "'%s' needs a pixel format, such as --to YUYV",
                               wanted->out);
        }
        wanted->has_format = 1;
        wanted->format = wanted->input.format;
    }
    return 0;
}

/* ---- The work ------------------------------------------------------------------------------ */

/* Reading from the file that is written would destroy it. */
static int check_not_same(const request *wanted)
{
    struct stat in, out;

    if (strcmp(wanted->in, "-") == 0 || strcmp(wanted->out, "-") == 0 ||
        stat(wanted->in, &in) != 0 || stat(wanted->out, &out) != 0 || !S_ISREG(out.st_mode)) {
        return 0;
    }
    return in.st_dev == out.st_dev && in.st_ino == out.st_ino
               ? say_error(wanted->out, "IN and OUT are the same file; write to another")
               : 0;
}

static int is_wanted(const request *wanted, unsigned long number)
{
    unsigned i;

    for (i = 0; i < wanted->frame_count; i++) {
        if (wanted->frames[i] == number) {
            return 1;
        }
    }
    return wanted->frame_count == 0;
}

/* The highest frame that is wanted: reading stops behind it. */
static unsigned long last_wanted(const request *wanted)
{
    unsigned long last = wanted->frame_count ? 0 : ULONG_MAX;
    unsigned i;

    for (i = 0; i < wanted->frame_count; i++) {
        last = wanted->frames[i] > last ? wanted->frames[i] : last;
    }
    return last;
}

/* The three layouts that a video file has; the nearest to the frame's if --to does not say. */
static pel_format video_format(const request *wanted, pel_format format)
{
    if (wanted->has_format) {
        format = wanted->format;
    }
    if (format == PEL_NV12) {
        return PEL_I420;
    }
    return format == PEL_I420 || format == PEL_GRAY8 ? format : PEL_YUYV;
}

/* Pictures are converted while they are written, the others before. */
static int make_view(const request *wanted, const pel_cview *view, frame *packed, pel_cview *made)
{
    pel_range range = wanted->has_range ? wanted->input.range : view->range;
    pel_format format = wanted->format;

    if (!wanted->array && wanted->kind < SINK_Y4M) {
        *made = *view;
        return 0;
    }
    if (!wanted->array && wanted->kind == SINK_Y4M) {
        format = video_format(wanted, view->format);
    }
    if (pack_frame(wanted->in, view, format, range, packed)) {
        return -1;
    }
    *made = pel_view_to_read(&packed->view);
    return 0;
}

static int write_array(const request *wanted, output *out, const pel_cview *view)
{
    if (out->written > 0) {
        return say_error(wanted->in,
                         "there are several frames, but a C array holds one; choose it with "
                         "--frame N");
    }
    out->array = sink_open_file(wanted->out);
    if (!out->array) {
        return -1;
    }
    errno = 0;
    return carray_write(out->array, view, wanted->array)
               ? say_error(wanted->out, "cannot write: %s", strerror(errno))
               : 0;
}

/* OUT is created when the first frame is there: bad input leaves no file behind. */
static int write_frame(const request *wanted, output *out, const pel_cview *view)
{
    pel_cview made;

    if (make_view(wanted, view, &out->packed, &made)) {
        return -1;
    }
    if (wanted->array) {
        if (write_array(wanted, out, &made)) {
            return -1;
        }
    } else if ((!out->to.file && sink_open(&out->to, wanted->out, wanted->kind)) ||
               sink_frame(&out->to, &made)) {
        return -1;
    }
    out->written++;
    return 0;
}

/* The part that --crop asks for: 0, or -1 after a message. */
static int crop_frame(const request *wanted, pel_cview *view)
{
    const options_box *box = &wanted->crop;
    const unsigned width = view->width, height = view->height;

    if (!wanted->has_crop) {
        return 0;
    }
    switch (pel_cview_crop(view, box->x0, box->x1, box->y0, box->y1, view)) {
    case PEL_OK:
        return 0;
    case PEL_ERR_RANGE:
        return say_error(wanted->in, "--crop %u,%u,%u,%u is not inside the picture of %ux%u",
                         box->x0, box->y0, box->x1, box->y1, width, height);
    default:
        return say_error(wanted->in,
                         "--crop %u,%u,%u,%u cuts through pixels of %s that share colours: "
                         "4:2:2 needs even x, 4:2:0 and Bayer even x and y",
                         box->x0, box->y0, box->x1, box->y1, pel_format_name(view->format));
    }
}

static int copy_frames(const request *wanted, source *from, output *out)
{
    unsigned long number = 0, last = last_wanted(wanted);
    frame picture = {0};
    int status = 1;

    for (; status > 0 && number <= last; number++) {
        status = source_next(from, &picture);
        if (status > 0 && is_wanted(wanted, number)) {
            pel_cview view = pel_view_to_read(&picture.view);
            status = crop_frame(wanted, &view) || write_frame(wanted, out, &view) ? -1 : 1;
        }
    }
    frame_free(&picture);
    if (status == 0 && wanted->frame_count) {
        return say_error(wanted->in, "there is no frame %lu; the last one is %lu", last,
                         number - 2);
    }
    return status < 0 ? -1 : 0;
}

static int convert(const request *wanted)
{
    output out = {0};
    source *from;
    int status;

    if (check_not_same(wanted)) {
        return -1;
    }
    from = source_open(wanted->in, &wanted->input);
    if (!from) {
        return -1;
    }
    status = copy_frames(wanted, from, &out);
    source_close(from);
    if (out.array) {
        status = sink_close_file(out.array, wanted->out, status);
    }
    status = sink_close(&out.to, status);
    frame_free(&out.packed);
    return status;
}

static int run(int argc, char **argv)
{
    request wanted = {0};
    int status = parse_options(argc, argv, &wanted);

    if (status > 0) {
        fputs(help, stdout);
        return EXIT_SUCCESS;
    }
    if (status < 0) {
        return EXIT_BAD_USAGE;
    }
    if (argc - optind != 2) {
        return usage_error("convert", "needs two files, IN and OUT");
    }
    wanted.in = argv[optind];
    wanted.out = argv[optind + 1];
    if (check_request(&wanted)) {
        return EXIT_BAD_USAGE;
    }
    return convert(&wanted) ? EXIT_BAD_INPUT : EXIT_SUCCESS;
}

const command cmd_convert = {
    "convert",
    "converts pictures, video and raw frames, also into C source",
    help,
    run,
};
