#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "decimal.h"
#include "draw.h"
#include "live.h"
#include "numbered.h"
#include "options.h"
#include "report.h"
#include "say.h"
#include "sink.h"
#include "usage.h"
#include "walk.h"

static const char help[] =
    "Usage: pel blobs -c CLASSES [OPTION]... INPUT...\n"
    "       pel blobs -c CLASSES -d DEVICE [OPTION]...\n"
    "\n"
    "Finds the connected regions of every colour class and measures them.\n"
    "\n"
    "INPUT is a PPM, PGM, PNG, JPEG or YUV4MPEG2 file, or raw frames; '-' is standard input. "
    "Frames\n"
    "count from 0 over all inputs. Frames of a stream are processed as they arrive. Pictures over "
    "about\n"
    "4 megapixels (1920x1080 and 2048x2048 are fine, 2592x1944 is not) are refused, as their sums "
    "could\n"
    "overflow: make them smaller first (pel point resize WxH --box), or cut them (pel convert "
    "--crop).\n"
    "\n"
    "  -c, --classes CLASSES    class file, CMVision's text format, or a .tm table\n"
    "      --raw FORMAT WxH     INPUT holds raw frames: YUYV 320x240, for example\n"
    "      --range RANGE        of raw YCbCr frames: full (default) or "
    "limited\n" OPTIONS_BACKEND_HELP
    "      --connectivity 4|8   whether diagonal neighbours touch: 8 (default) they do\n"
    "\n"
    "Which blobs\n"
    "      --min-area N         at least N pixels, default 1\n"
    "      --min-density D      at least this part of the box filled, 0..1\n"
    "      --class NAME         only this class, by name or number; may be repeated\n"
    "      --roi X0,Y0,X1,Y1    only where the centroid lies in this box (x0 <= x < x1)\n"
    "      --merge-classes      then unite blobs of a class where they fill more than the class's "
    "merge\n"
    "                           density of the box around both, as CMVision does; that number of "
    "the\n"
    "                           class file (0: never) is not applied otherwise\n"
    "      --merge-density D    the same with one density for all classes, 0..1\n"
    "      --merge-margin N     then unite blobs of a class whose boxes, grown by N pixels, "
    "overlap\n"
    "      --max N              then keep the N largest of a frame, default all\n"
    "\n"
    "What to write\n"
    "      --csv                a line per blob; the first line names the columns:\n"
    "                           frame,class,name,area,x0,y0,x1,y1,sum_x,sum_y, then cx,cy "
    "(centroid),\n"
    "                           angle_deg (of the long axis, clockwise from x), elongation, "
    "roundness,\n"
    "                           density, compactness (0..1), perimeter, holes, edges (1 left, 2 "
    "right,\n"
    "                           4 top, 8 bottom: sum of the borders touched), mean_y, mean_u, "
    "mean_v\n"
    "      --json               an object per frame, on a line of its own\n"
    "                           (otherwise a table for people)\n"
    "  -o OUT                   the picture with boxes, axes and centroids drawn in: .ppm or .png. "
    "With\n"
    "                           more than one frame OUT contains %04d for the number of the frame; "
    "'-'\n"
    "                           writes PPM, one after another, in place of the list\n"
    "\n"
    "A camera\n"
    "  -d, --device DEVICE      takes its frames in place of INPUT until Ctrl-C, or as --count "
    "and\n"
    "                           --seconds say; --size, --rate, --lock and all other options of\n"
    "                           the camera are those of 'pel capture'. On a terminal the table\n"
    "                           is refreshed in place; --csv and --json write each frame at once\n"
    "\n"
    "Rows are ordered by frame, then area (largest first), then y0, then x0. Boxes are half-open:\n"
    "x0 <= x < x1. Nothing is lost: what filters and --max leave out is counted in table and "
    "JSON.\n"
    "\n"
    "Examples\n"
    "  pel blobs -c robot.classes --min-area 20 -o found.png robot.ppm\n"
    "  pel blobs -c robot.classes --csv --max 1 --class orange *.ppm > ball.csv\n"
    "  pel blobs -c robot.classes --raw YUYV 320x240 --json -   < camera.yuv\n"
    "  pel blobs -c robot.classes -d /dev/video0 --lock --json --max 3\n";

enum { NAMES_MAX = 32 };

struct job {
    const char *classes_path;
    classes list;
    source_options input;
    pel_backend backend;
    camera_options camera;
    const char *wanted[NAMES_MAX]; /* --class */
    unsigned wanted_count;
    pel_blob_filter filter;
    pel_blob_shape shape;
    uint8_t connectivity;
    uint16_t merge_density_q15;
    uint16_t merge_margin;
    int merges_classes, merges_density, merges_margin;
    unsigned long max; /* 0: all */
    report_style style;
    const char *output;
    pel_blob *blobs; /* of the frame */
    uint32_t count, room;
    int out_of_memory;
    int status; /* what the command will answer if it fails */
};

/* ---- The command line ---------------------------------------------------------------------- */

static int read_connectivity(struct job *job)
{
    unsigned long number;
    if (options_number("--connectivity", optarg, 4, 8, &number)) {
        return -1;
    }
    if (number != 4 && number != 8) {
        return say_error("blobs", "--connectivity is 4 or 8, not '%s'", optarg);
    }
    job->connectivity = (uint8_t)number;
    return 0;
}

static int read_q15(const char *name, uint16_t *value_q15)
{
    int32_t milli;
    if (decimal_milli("blobs", name, optarg, 0, 1000, &milli)) {
        return -1;
    }
    const int32_t value = (milli * 32768 + 500) / 1000;
    *value_q15 = (uint16_t)(value > 32767 ? 32767 : value);
    return 0;
}

static int read_roi(pel_blob_filter *filter)
{
    options_box box;
    if (options_take_box("--roi", optarg, &box)) {
        return -1;
    }
    filter->roi_x0 = box.x0;
    filter->roi_y0 = box.y0;
    filter->roi_x1 = box.x1;
    filter->roi_y1 = box.y1;
    return 0;
}

static int read_area(struct job *job)
{
    unsigned long number;
    if (options_number("--min-area", optarg, 0, UINT32_MAX, &number)) {
        return -1;
    }
    job->filter.area_min = (uint32_t)number;
    return 0;
}

static int read_margin(struct job *job)
{
    unsigned long number;
    if (options_number("--merge-margin", optarg, 0, PEL_SIDE_MAX, &number)) {
        return -1;
    }
    job->merge_margin = (uint16_t)number;
    job->merges_margin = 1;
    return 0;
}

static int read_wanted(struct job *job)
{
    if (job->wanted_count == NAMES_MAX) {
        return say_error("blobs", "--class is given more than %d times", (int)NAMES_MAX);
    }
    job->wanted[job->wanted_count++] = optarg;
    return 0;
}

/* Takes one of the options that are not in parse; 0, or -1 after a message. */
static int read_option(int option, int argc, char **argv, struct job *job)
{
    const int taken = options_input(option, argc, argv, &job->input);
    const int live = taken == 0 ? camera_option(option, &job->camera) : 0;
    if (taken != 0 || live != 0) {
        return taken < 0 || live < 0 ? -1 : 0;
    }
    switch (option) {
    case OPTION_BACKEND:
        return options_backend(optarg, &job->backend);
    case 'k':
        return read_connectivity(job);
    case 'a':
        return read_area(job);
    case 'e':
        return read_q15("--min-density", &job->shape.density_min_q15);
    case 'n':
        return read_wanted(job);
    case 'r':
        return read_roi(&job->filter);
    case 'K':
        job->merges_classes = 1;
        return 0;
    case 'D':
        job->merges_density = 1;
        return read_q15("--merge-density", &job->merge_density_q15);
    case 'M':
        return read_margin(job);
    default:
        return options_number("--max", optarg, 1, UINT32_MAX, &job->max);
    }
}

static int check(int argc, const struct job *job)
{
    if (!job->classes_path) {
        return usage_error("blobs", "no classes given: say -c CLASSES");
    }
    if (optind < argc && job->camera.given) {
        return usage_error("blobs", "either a camera or INPUT, not both");
    }
    if (optind >= argc && !job->camera.given) {
        return usage_error("blobs", "no input given");
    }
    if (job->output && strcmp(job->output, "-") == 0 && job->style != REPORT_TABLE) {
        return usage_error("blobs", "standard output cannot take both the list and the picture");
    }
    return job->output && sink_check_picture(job->output) ? usage_hint("blobs") : -1;
}

static const struct option long_options[] = {{"classes", required_argument, NULL, 'c'},
                                             OPTIONS_INPUT,
                                             OPTIONS_BACKEND,
                                             CAMERA_OPTIONS,
                                             {"connectivity", required_argument, NULL, 'k'},
                                             {"min-area", required_argument, NULL, 'a'},
                                             {"min-density", required_argument, NULL, 'e'},
                                             {"class", required_argument, NULL, 'n'},
                                             {"roi", required_argument, NULL, 'r'},
                                             {"merge-classes", no_argument, NULL, 'K'},
                                             {"merge-density", required_argument, NULL, 'D'},
                                             {"merge-margin", required_argument, NULL, 'M'},
                                             {"max", required_argument, NULL, 'x'},
                                             {"csv", no_argument, NULL, 'v'},
                                             {"json", no_argument, NULL, 'j'},
                                             {"help", no_argument, NULL, 'h'},
                                             {NULL, 0, NULL, 0}};

/* Reads the command line: -1 to go on, or an exit status. */
static int parse(int argc, char **argv, struct job *job)
{
    int option;
    opterr = 0;
    while ((option = getopt_long(argc, argv, ":c:d:o:h", long_options, NULL)) != -1) {
        switch (option) {
        case 'h':
            fputs(help, stdout);
            return EXIT_SUCCESS;
        case 'c':
            job->classes_path = optarg;
            break;
        case 'o':
            job->output = optarg;
            break;
        case 'v':
        case 'j':
            if (job->style != REPORT_TABLE) {
                return usage_error("blobs", "either --csv or --json, once");
            }
            job->style = option == 'v' ? REPORT_CSV : REPORT_JSON;
            break;
        case '?':
        case ':':
            return usage_bad_option("blobs", option, argv);
        default:
            if (read_option(option, argc, argv, job)) {
                return usage_hint("blobs");
            }
        }
    }
    return check(argc, job);
}

static int find_class(const classes *list, const char *name)
{
    for (unsigned i = 0; i < list->count; i++) {
        char number[12];
        snprintf(number, sizeof number, "%u", i);
        if (strcmp(list->entry[i].name, name) == 0 || strcmp(number, name) == 0) {
            return (int)i;
        }
    }
    return -1;
}

/* Turns the names of --class into the filter's mask: 0, or -1 after a message. */
static int choose_classes(struct job *job)
{
    for (unsigned i = 0; i < job->wanted_count; i++) {
        const int found = find_class(&job->list, job->wanted[i]);
        if (found < 0) {
            job->status = EXIT_BAD_USAGE;
            return say_error(job->classes_path, "has no class '%s'", job->wanted[i]);
        }
        job->filter.class_mask |= (uint32_t)1 << found;
    }
    return 0;
}

static int check_merging(struct job *job)
{
    if (job->merges_classes && job->list.cells) {
        job->status = EXIT_BAD_USAGE;
        return say_error(job->classes_path, "a table has no merge densities for --merge-classes; "
                                            "use the class file that it was made from, or "
                                            "--merge-density");
    }
    return 0;
}

/* ---- The annotated picture ----------------------------------------------------------------- */

/* Whether OUT has room for one frame only, and what to say to more. */
static int takes_one_frame(const char *output)
{
    return output && strcmp(output, "-") != 0 && !numbered_is(output);
}

static int refuse_frames(const char *output)
{
    return say_error(output, "more than one frame, but this is one picture: write %%04d where the "
                             "number of the frame shall be");
}

static int read_rgb(const pel_cview *view, const pel_view *picture)
{
    for (uint16_t y = 0; y < picture->height; y++) {
        const pel_crow row = pel_cview_row(view, y);
        uint8_t *rgb = picture->plane[0] + (ptrdiff_t)y * picture->stride_bytes[0];
        if (pel_crow_read_rgb(&row, 0, picture->width, rgb) != PEL_OK) {
            return -1;
        }
    }
    return 0;
}

static int annotate(const struct job *job, const char *path, unsigned long number,
                    const pel_cview *view)
{
    frame picture = {0};
    char *name = numbered_name(job->output, number);
    int result = -1;
    if (!name || frame_resize(&picture, PEL_RGB888, PEL_RANGE_FULL,
                              pel_color_width(view->format, view->width),
                              pel_color_height(view->format, view->height))) {
        say_error(path, "out of memory");
    } else if (read_rgb(view, &picture.view)) {
        say_error(path, "cannot be turned into a picture");
    } else {
        for (uint32_t i = 0; i < job->count; i++) {
            const class_entry *entry = &job->list.entry[job->blobs[i].class_index];
            const draw_color color = {entry->red, entry->green, entry->blue};
            draw_blob(&picture.view, &job->blobs[i], color);
        }
        const pel_cview drawn = pel_view_to_read(&picture.view);
        result = sink_picture(name, &drawn, NULL);
    }
    frame_free(&picture);
    free(name);
    return result;
}

/* ---- Finding ------------------------------------------------------------------------------- */

/* Densities over 1 are never reached, like 32767: blobs apart leave more than 1 / 32768 free. */
static uint16_t density_q15(double density)
{
    const double value = density * 32768 + 0.5;
    return (uint16_t)(value < 32767 ? value : 32767);
}

static void keep(void *user, const pel_blob *blob)
{
    struct job *job = user;
    if (job->count == job->room) {
        const uint32_t room = job->room ? 2 * job->room : 64;
        pel_blob *larger = realloc(job->blobs, room * sizeof *larger);
        if (!larger) {
            job->out_of_memory = 1;
            return;
        }
        job->blobs = larger;
        job->room = room;
    }
    job->blobs[job->count++] = *blob;
}

/* Runs the finder with so much memory that nothing can be lost. */
static int find(struct job *job, const char *path, const pel_cview *view, pel_blobs_counts *counts)
{
    const uint16_t width = pel_color_width(view->format, view->width);
    const uint16_t open_max = (uint16_t)PEL_BLOBS_OPEN_SAFE(width);
    const size_t work_bytes = pel_blobs_bytes(width, open_max, PEL_MEASURE_ALL);
    uint8_t *labels = malloc(width);
    void *work = malloc(work_bytes);
    pel_status status = PEL_ERR_SPACE;
    if (labels && work) {
        pel_blobs blobs;
        uint32_t count;
        pel_blobs_config config = {0};
        config.width = width;
        config.height = pel_color_height(view->format, view->height);
        config.open_max = open_max;
        config.connectivity = job->connectivity;
        config.measure = PEL_MEASURE_ALL;
        config.measurer = pel_blobs_measure;
        config.work = work;
        config.work_bytes = work_bytes;
        config.filter = &job->filter;
        config.accept = pel_blob_shape_passes;
        config.limits = &job->shape;
        config.reader = pel_crow_read_yuv;
        config.on_blob = keep;
        config.user = job;
        status = pel_blobs_frame(&blobs, &config, &job->list.classifier, view, labels, &count);
        *counts = blobs.counts;
    }
    free(labels);
    free(work);
    if (status == PEL_ERR_RANGE) {
        return say_error(path,
                         "a picture of %ux%u is too large: its sums could overflow; make it "
                         "smaller with pel point resize --box, or cut it with pel convert --crop",
                         (unsigned)view->width, (unsigned)view->height);
    }
    if (status == PEL_ERR_SPACE || job->out_of_memory) {
        return say_error(path, "out of memory");
    }
    return status < 0 ? say_error(path, "cannot be searched: %s", pel_status_name(status)) : 0;
}

/* Brings the blobs of a class to the front; returns how many there are. */
static uint32_t bring_to_front(pel_blob *blobs, uint32_t count, unsigned class_index)
{
    uint32_t front = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (blobs[i].class_index == class_index) {
            const pel_blob blob = blobs[i];
            blobs[i] = blobs[front];
            blobs[front++] = blob;
        }
    }
    return front;
}

/* Merges the blobs of each class with the density that the class file gives; sorted at the end. */
static void merge_classes(struct job *job)
{
    uint32_t done = 0;
    uint32_t left = job->count;
    for (unsigned i = 0; i < job->list.count; i++) {
        const double density = job->list.entry[i].merge;
        pel_blob *first = job->blobs + done;
        const uint32_t found = bring_to_front(first, left, i);
        uint32_t merged = found;
        if (density > 0) {
            pel_blobs_sort(first, found);
            merged = pel_blobs_merge_density(first, found, density_q15(density));
            memmove(first + merged, first + found, (left - found) * sizeof *first);
        }
        done += merged;
        left -= found;
    }
    job->count = done;
    pel_blobs_sort(job->blobs, job->count);
}

static void merge_and_cut(struct job *job, pel_blobs_counts *counts)
{
    pel_blobs_sort(job->blobs, job->count);
    if (job->merges_classes && job->count > 0) {
        merge_classes(job);
    }
    if (job->merges_density) {
        job->count = pel_blobs_merge_density(job->blobs, job->count, job->merge_density_q15);
    }
    if (job->merges_margin) {
        job->count = pel_blobs_merge_margin(job->blobs, job->count, job->merge_margin);
    }
    counts->found = job->count;
    while (job->max > 0 && job->count > job->max) {
        job->count--;
        counts->dropped++;
        counts->dropped_px += job->blobs[job->count].area;
    }
}

static int print_found(const struct job *job, const char *path, unsigned long number,
                       const pel_cview *view, const pel_blobs_counts *counts)
{
    report_frame found = {0};
    found.frame = number;
    found.file = path;
    found.width = pel_color_width(view->format, view->width);
    found.height = pel_color_height(view->format, view->height);
    found.list = &job->list;
    found.blobs = job->blobs;
    found.blob_count = job->count;
    found.counts = *counts;
    report_blobs(stdout, job->style, &found);
    return report_close(stdout, "-"); /* flushed, so that a reader sees each frame at once */
}

static int visit(void *user, const char *path, unsigned long number, const pel_cview *view)
{
    struct job *job = user;
    pel_blobs_counts counts = {0};
    const int to_stdout = job->output && strcmp(job->output, "-") == 0;
    if (number > 0 && takes_one_frame(job->output)) {
        return refuse_frames(job->output);
    }
    job->count = 0;
    if (walk_check_range(path, view, job->classes_path, &job->list) ||
        find(job, path, view, &counts)) {
        return -1;
    }
    merge_and_cut(job, &counts);
    if (!to_stdout && print_found(job, path, number, view, &counts)) {
        return -1;
    }
    return job->output ? annotate(job, path, number, view) : 0;
}

static int run(int argc, char **argv)
{
    static struct job job;
    const int status = parse(argc, argv, &job);
    if (status >= 0) {
        return status;
    }
    job.status = EXIT_BAD_INPUT;
    if (argc - optind > 1 && takes_one_frame(job.output)) {
        refuse_frames(job.output);
        return EXIT_BAD_INPUT;
    }
    if (classes_read(job.classes_path, &job.list)) {
        return EXIT_BAD_INPUT;
    }
    classes_choose_backend(&job.list, job.backend);
    int failed = choose_classes(&job) || check_merging(&job);
    if (!failed) {
        if (!job.output || strcmp(job.output, "-") != 0) {
            report_begin(stdout, job.style);
        }
        failed = job.camera.given
                     ? live_walk(&job.camera, job.style, &job.list, visit, &job)
                     : walk_frames(argv + optind, argc - optind, &job.input, visit, &job);
    }
    free(job.blobs);
    classes_free(&job.list);
    return failed ? job.status : EXIT_SUCCESS;
}

const command cmd_blobs = {"blobs", "find and measure the coloured regions of pictures", help, run};
