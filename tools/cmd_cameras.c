#include "camera.h"
#include "command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: pel cameras [OPTION]...\n"
    "\n"
    "Lists the cameras of this computer: their formats, sizes and rates, and their controls with\n"
    "ranges and values. '*' marks formats that pel reads.\n"
    "\n"
    "  -d, --device DEVICE  only this one: a path, a bus id or a part of its name\n"
    "      --camera NAME    the same\n"
    "      --backend B      v4l2 or libcamera; default: both, if this build has them\n"
    "      --csv            a line per format and size; the first line names the columns:\n"
    "                       device,card,driver,bus,format,readable,width_min,width_max,\n"
    "                       height_min,height_max,rate (frames per second, the fastest; empty if "
    "the\n"
    "                       driver does not say)\n"
    "      --controls-csv   a line per control: "
    "device,id,known,name,kind,min,max,step,initial,value,\n"
    "                       read_only,inactive\n"
    "  -h, --help           this text\n"
    "\n"
    "Exit status 1 if there is no camera.\n"
    "\n"
    "Examples\n"
    "  pel cameras\n"
    "  pel cameras -d /dev/video0 --csv\n";

#ifdef PEL_HAS_CAMERAS

#include <getopt.h>
#include <inttypes.h>

#include "report.h"
#include "say.h"
#include "usage.h"

enum { DEVICES_MAX = 64, MODES_MAX = 2000, CONTROLS_MAX = 200, MENU_MAX = 64 };

typedef enum style { FOR_PEOPLE, MODES_CSV, CONTROLS_CSV } style;

struct job {
    camera_options options;
    style style;
    int has_backend;
    capture_device devices[DEVICES_MAX];
    capture_mode modes[MODES_MAX];
    capture_control controls[CONTROLS_MAX];
};

/* ---- Modes --------------------------------------------------------------------------------- */

static void print_rate(const capture_mode *mode)
{
    if (mode->rate_num && mode->rate_den) {
        report_ratio(stdout, mode->rate_num, mode->rate_den);
    }
}

static void print_mode(const capture_mode *mode)
{
    char code[16];
    capture_fourcc_text(mode->fourcc, code);
    printf("  %c %-5s %ux%u", mode->readable ? '*' : ' ', code, mode->width_min, mode->height_min);
    if (mode->width_max != mode->width_min || mode->height_max != mode->height_min) {
        printf(" to %ux%u", mode->width_max, mode->height_max);
    }
    if (mode->rate_num && mode->rate_den) {
        fputs(", up to ", stdout);
        print_rate(mode);
        fputs(" per second", stdout);
    }
    if (mode->description[0]) {
        printf("   (%s)", mode->description);
    }
    putchar('\n');
}

static void print_mode_csv(const capture_settings *of, const capture_mode *mode)
{
    char code[16];
    const char *const texts[] = {of->path, of->card, of->driver, of->bus};
    for (int i = 0; i < 4; i++) {
        report_csv_text(stdout, texts[i]);
        putchar(',');
    }
    capture_fourcc_text(mode->fourcc, code);
    printf("%s,%d,%u,%u,%u,%u,", code, mode->readable, mode->width_min, mode->width_max,
           mode->height_min, mode->height_max);
    print_rate(mode);
    putchar('\n');
}

static void print_modes(struct job *job, capture *device, const capture_settings *of)
{
    const int count = capture_modes(device, job->modes, MODES_MAX);
    if (job->style == FOR_PEOPLE) {
        puts(count > 0 ? "  formats" : "  formats: the driver lists none");
    }
    for (int i = 0; i < count && i < MODES_MAX; i++) {
        if (job->style == FOR_PEOPLE) {
            print_mode(&job->modes[i]);
        } else {
            print_mode_csv(of, &job->modes[i]);
        }
    }
}

/* ---- Controls ------------------------------------------------------------------------------ */

static void print_menu(capture *device, const capture_control *of)
{
    char text[32];
    for (int32_t i = of->min; i <= of->max && i - of->min < MENU_MAX; i++) {
        if (capture_menu_item(device, of->id, i, text) == CAPTURE_OK) {
            printf("        %ld %s%s\n", (long)i, text, i == of->value ? " <" : "");
        }
    }
}

static void print_control(capture *device, const capture_control *of)
{
    const char *known = capture_known_name(of->known);
    printf("    %-26s %6ld", known ? known : of->name, (long)of->value);
    if (of->kind == CAPTURE_SWITCH) {
        fputs("   (0 or 1", stdout);
    } else {
        printf("   (%ld to %ld", (long)of->min, (long)of->max);
        if (of->step > 1) {
            printf(" in steps of %ld", (long)of->step);
        }
    }
    printf("; %ld at first)%s%s\n", (long)of->initial, of->read_only ? " read only" : "",
           of->inactive ? " without effect now" : "");
    if (of->kind == CAPTURE_MENU) {
        print_menu(device, of);
    }
}

static void print_control_csv(const capture_settings *of, const capture_control *control)
{
    static const char *const kinds[] = {"integer", "switch", "menu"};
    const char *known = capture_known_name(control->known);
    report_csv_text(stdout, of->path);
    printf(",%" PRIu32 ",%s,", control->id, known ? known : "");
    report_csv_text(stdout, control->name);
    printf(",%s,%ld,%ld,%ld,%ld,%ld,%d,%d\n", kinds[control->kind], (long)control->min,
           (long)control->max, (long)control->step, (long)control->initial, (long)control->value,
           control->read_only, control->inactive);
}

static void print_controls(struct job *job, capture *device, const capture_settings *of)
{
    const int count = capture_controls(device, job->controls, CONTROLS_MAX);
    if (job->style == FOR_PEOPLE) {
        puts(count > 0 ? "  controls" : "  controls: none");
    }
    for (int i = 0; i < count && i < CONTROLS_MAX; i++) {
        if (job->style == FOR_PEOPLE) {
            print_control(device, &job->controls[i]);
        } else {
            print_control_csv(of, &job->controls[i]);
        }
    }
}

/* ---- Cameras ------------------------------------------------------------------------------- */

static void print_device(struct job *job, capture *device, capture_status status)
{
    capture_settings of;
    capture_get_settings(device, &of);
    if (job->style == FOR_PEOPLE) {
        printf("%s: %s (%s, %s)%s\n", of.path, of.card, of.driver, of.bus,
               status == CAPTURE_ERR_BUSY ? ", in use by another program" : "");
    }
    if (job->style != CONTROLS_CSV) {
        print_modes(job, device, &of);
    }
    if (job->style != MODES_CSV) {
        print_controls(job, device, &of);
    }
}

/* Opens a camera and prints it: 0, or -1 after a message. */
static int show(struct job *job, capture_backend backend, const char *name)
{
    capture_wish wish = {0};
    capture *device = NULL;
    wish.backend = backend;
    wish.device = name;
    const capture_status status = capture_open(&wish, NULL, &device);
    if (!device) {
        return say_error("camera", "out of memory");
    }
    /* One that delivers nothing for pel, or is in use, has something to show all the same. */
    const int readable = status >= 0 || status == CAPTURE_ERR_BUSY || status == CAPTURE_ERR_FORMAT;
    if (readable) {
        print_device(job, device, status);
    } else {
        camera_refuse(device, name, status);
    }
    capture_close(device);
    return readable ? 0 : -1;
}

/* How many cameras of a backend were shown. */
static int show_all(struct job *job, capture_backend backend)
{
    int shown = 0;
    if (!capture_has_backend(backend)) {
        return 0;
    }
    const int count = capture_list(backend, NULL, job->devices, DEVICES_MAX);
    for (int i = 0; i < count && i < DEVICES_MAX; i++) {
        shown += show(job, backend, job->devices[i].path) == 0;
    }
    return shown;
}

static void print_header(style how)
{
    if (how == MODES_CSV) {
        puts("device,card,driver,bus,format,readable,width_min,width_max,height_min,height_max,"
             "rate");
    } else if (how == CONTROLS_CSV) {
        puts("device,id,known,name,kind,min,max,step,initial,value,read_only,inactive");
    }
}

static int list(struct job *job)
{
    const capture_backend backend = job->options.wish.backend;
    if (!capture_has_backend(backend)) {
        say_error("--backend", "this build has no libcamera: install libcamera-dev and configure "
                               "again");
        return EXIT_BAD_INPUT;
    }
    print_header(job->style);
    if (job->options.wish.device) {
        return show(job, backend, job->options.wish.device) ? EXIT_BAD_INPUT : EXIT_SUCCESS;
    }
    int shown = show_all(job, backend);
    if (!job->has_backend) {
        shown += show_all(job, CAPTURE_LIBCAMERA);
    }
    if (shown == 0) {
        say_error(NULL,
                  "no camera that can be used was found; is one plugged in? /dev/video* are "
                  "the cameras that the system knows%s",
                  capture_has_backend(CAPTURE_LIBCAMERA) ? "" : ". This build has no libcamera");
        return EXIT_BAD_INPUT;
    }
    return EXIT_SUCCESS;
}

/* ---- The command line ---------------------------------------------------------------------- */

static int take_style(struct job *job, style how)
{
    if (job->style != FOR_PEOPLE) {
        return say_error(NULL, "either --csv or --controls-csv, once");
    }
    job->style = how;
    return 0;
}

static int run(int argc, char **argv)
{
    static const struct option known[] = {
        {"device", required_argument, NULL, CAMERA_OPTION_DEVICE},
        {"camera", required_argument, NULL, CAMERA_OPTION_DEVICE},
        {"backend", required_argument, NULL, CAMERA_OPTION_BACKEND},
        {"csv", no_argument, NULL, 'v'},
        {"controls-csv", no_argument, NULL, 'k'},
        {"help", no_argument, NULL, 'h'},
        {NULL, 0, NULL, 0},
    };
    static struct job job;
    int option;
    opterr = 0;
    while ((option = getopt_long(argc, argv, ":d:h", known, NULL)) != -1) {
        int failed = 0;
        switch (option) {
        case 'h':
            fputs(help, stdout);
            return EXIT_SUCCESS;
        case '?':
        case ':':
            return usage_bad_option("cameras", option, argv);
        case 'v':
        case 'k':
            failed = take_style(&job, option == 'v' ? MODES_CSV : CONTROLS_CSV);
            break;
        default:
            job.has_backend |= option == CAMERA_OPTION_BACKEND;
            failed = camera_option(option, &job.options) < 0;
        }
        if (failed) {
            return usage_hint("cameras");
        }
    }
    return optind < argc ? usage_error("cameras", "takes no file; -d DEVICE shows one camera")
                         : list(&job);
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

const command cmd_cameras = {"cameras", "list cameras, their formats and controls", help, run};
