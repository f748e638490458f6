#include "camera.h"
#include "command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: pel capture [OPTION]... OUT\n"
    "\n"
    "Records frames of a camera. OUT is told by the ending of its name:\n"
    "\n"
    "  .ppm .png            pictures: %04d in the name is the number of the frame, from 0; "
    "without\n"
    "                       it, one picture\n"
    "  .y4m                 video (YUV4MPEG2): 4:2:2 without loss from YUYV and its relatives,\n"
    "                       4:2:0 from NV12 and I420, mono from gray; others become 4:2:2\n"
    "  .raw .yuv            the bytes of the frames without padding, one after another; of MJPEG\n"
    "                       cameras decoded, as RGB888\n"
    "  -                    YUV4MPEG2 on standard output, each frame at once\n"
    "\n"
    "Without --count or --seconds it goes on until Ctrl-C, which ends the file after a whole\n"
    "frame; one picture is one frame. A camera that fails leaves what came before, too.\n"
    "\n"
    "The camera\n"
    "  -d, --device DEVICE  a path (/dev/video2), a bus id, or a part of a name that no other\n"
    "                       camera has; 'pel cameras' lists them. Default: the first\n"
    "      --camera NAME    the same\n"
    "      --backend B      v4l2 (default) or libcamera, if this build has it\n"
    "      --size WxH       default: what the camera does nearest to 640x480\n"
    "      --format F       V4L2's code (YUYV, MJPG, GREY ...) or pel's name; default: the best\n"
    "      --rate N         frames per second, such as 30 or 7.5\n"
    "      --count N        stop after N frames\n"
    "      --seconds S      stop S seconds after the first frame\n"
    "      --newest         if frames wait, take the newest and drop the others\n"
    "      --patience S     give up after S seconds without a frame, default 10\n"
    "      --reconnect S    if the camera is unplugged, wait S seconds for its return\n"
    "\n"
    "Light\n"
    "      --exposure N     in units of 100 us, or 'auto'. A number switches the automatics off\n"
    "      --gain N         in the camera's units, or 'auto'\n"
    "      --white-balance N\n"
    "                       in kelvin, or 'auto'\n"
    "      --power-line F   off, 50, 60 (Hz) or auto, against flicker\n"
    "      --settle N       skip the first N frames, in which the automatics still move\n"
    "      --lock           then switch auto exposure, gain and white balance off and hold what\n"
    "                       they reached: colours stay the same from then on; skips 30 frames\n"
    "                       if --settle does not say\n"
    "\n"
    "The files\n"
    "      --force          overwrite files that exist; they are refused otherwise. Symbolic "
    "links\n"
    "                       are never followed\n"
    "      --range RANGE    full or limited: convert YCbCr frames to it; default: as they come\n"
    "\n"
    "On a terminal, a line shows frames, rate and losses; otherwise only problems are printed.\n"
    "What the driver changes or ignores is reported. The camera, its format and its controls are\n"
    "written into the comment of PPM and PNG and into the header of YUV4MPEG2.\n"
    "\n"
    "Examples\n"
    "  pel capture frame.png\n"
    "  pel capture --lock --count 20 still-%04d.ppm\n"
    "  pel capture -d /dev/video2 --size 640x480 --format YUYV --seconds 10 field.y4m\n"
    "  pel capture --range full - | pel blobs -c robot.classes --csv -\n";

#ifdef PEL_HAS_CAMERAS

#include <getopt.h>
#include <time.h>
#include <unistd.h>

#include "numbered.h"
#include "options.h"
#include "recording.h"
#include "say.h"
#include "usage.h"

enum { OPTION_FORCE = 'F' };

struct job {
    camera_options options;
    recording out;
    uint64_t shown_ms; /* when the line on the terminal was drawn last */
};

/* ---- The command line ---------------------------------------------------------------------- */

static int take_option(int option, struct job *job)
{
    const int taken = camera_option(option, &job->options);
    if (taken != 0) {
        return taken > 0 ? 0 : -1;
    }
    if (option == OPTION_FORCE) {
        job->out.force = 1;
        return 0;
    }
    job->options.has_range = 1;
    return options_range(optarg, &job->options.range);
}

static int check(int argc, char **argv, struct job *job)
{
    if (argc - optind != 1) {
        return usage_error("capture", "one OUT wanted: a .ppm, .png, .y4m or .raw file, or '-'");
    }
    job->out.path = argv[optind];
    sink_kind kind;
    if (strcmp(job->out.path, "-") != 0 &&
        (sink_kind_by_path(job->out.path, &kind) || kind == SINK_JPEG || kind == SINK_PGM)) {
        return usage_error("capture", "'%s' ends in none of .ppm .png .y4m .raw .yuv",
                           job->out.path);
    }
    if (recording_check(&job->out)) {
        return EXIT_BAD_INPUT;
    }
    const int pictures = job->out.kind == SINK_PPM || job->out.kind == SINK_PNG;
    const int numbered = numbered_is(job->out.path);
    if (!pictures && numbered) {
        return usage_error("capture", "'%s': only pictures are numbered", job->out.path);
    }
    if (pictures && !numbered) {
        if (job->options.count > 1 || job->options.milli_s > 0) {
            return usage_error("capture",
                               "'%s' is one picture: write %%04d where the number of "
                               "the frame shall be",
                               job->out.path);
        }
        job->options.count = 1;
    }
    return -1;
}

/* Reads the command line: -1 to go on, or an exit status. */
static int parse(int argc, char **argv, struct job *job)
{
    static const struct option known[] = {
        CAMERA_OPTIONS,
        {"force", no_argument, NULL, OPTION_FORCE},
        {"range", required_argument, NULL, OPTION_RANGE},
        {"help", no_argument, NULL, 'h'},
        {NULL, 0, NULL, 0},
    };
    int option;
    opterr = 0;
    while ((option = getopt_long(argc, argv, ":d:h", known, NULL)) != -1) {
        switch (option) {
        case 'h':
            fputs(help, stdout);
            return EXIT_SUCCESS;
        case '?':
        case ':':
            return usage_bad_option("capture", option, argv);
        default:
            if (take_option(option, job)) {
                return usage_hint("capture");
            }
        }
    }
    return check(argc, argv, job);
}

/* ---- The work ------------------------------------------------------------------------------ */

static uint64_t now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000 + (uint64_t)now.tv_nsec / 1000000;
}

/* The line on a terminal: at most four times a second, and once at the end. */
static void show_progress(struct job *job, const camera *from, int last)
{
    const uint64_t now = now_ms();
    if (!isatty(STDERR_FILENO) || (!last && now - job->shown_ms < 250)) {
        return;
    }
    job->shown_ms = now;
    const unsigned long rate = camera_rate_milli(from);
    fprintf(stderr, "\r%lu frames, %lu.%02lu per second, %lu lost%s", job->out.frames, rate / 1000,
            rate % 1000 / 10, (unsigned long)camera_lost(from), last ? "\n" : "  ");
    fflush(stderr);
}

static int record(struct job *job)
{
    camera_frame got;
    int status = 0;
    int written = 0;
    camera *from = camera_open(&job->options);
    if (!from) {
        return camera_was_interrupted() ? 0 : -1;
    }
    while (written == 0 && (status = camera_next(from, &got)) > 0) {
        written = recording_frame(&job->out, from, &got);
        show_progress(job, from, 0);
    }
    show_progress(job, from, 1);
    camera_close(from);
    return recording_close(&job->out, written) || status < 0 ? -1 : 0;
}

static int run(int argc, char **argv)
{
    static struct job job;
    const int status = parse(argc, argv, &job);
    if (status >= 0) {
        return status;
    }
    return record(&job) ? EXIT_BAD_INPUT : EXIT_SUCCESS;
}

#else

static int run(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "--help") == 0) {
        fputs(help, stdout);
        return EXIT_SUCCESS;
    }
    return camera_missing(argv[0]);
}

#endif

const command cmd_capture = {"capture", "record frames of a camera", help, run};
