#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "benchplot.h"
#include "command.h"
#include "options.h"
#include "report.h"
#include "say.h"
#include "sink.h"
#include "usage.h"

/* The Python that is asked for OpenCV where nothing says which: that of the build, if one was
 * named. */
#ifndef PEL_BENCH_PYTHON
#define PEL_BENCH_PYTHON "python3"
#endif

static const char help[] =
    "Usage: pel bench [OPTION]... [FILE]...\n"
    "       pel bench --list\n"
    "\n"
    "Measures how long every operator takes on this machine: with every backend (kind of\n"
    "processor instructions) that it has, beside copying the same frame and, where Python has\n"
    "the module cv2, beside OpenCV doing the same job. All are kept on one processor core and\n"
    "take turns; a figure is the median of many runs, with the quartiles, of processor time, so\n"
    "that other programs do not count. Before anything is timed, the results of all backends\n"
    "are compared with those of plain C, byte for byte, and those with OpenCV's; where they\n"
    "differ, nothing is timed and the exit status is 1.\n"
    "\n"
    "The inputs are 'synth' (coloured shapes, 8 classes), 'rand1' and 'rand4' (noise in every\n"
    "pixel and in cells of 4 x 4), 640x480, the same bytes everywhere, and each FILE (its first\n"
    "picture, with six classes that cover most bright colours).\n"
    "\n"
    "What to measure; NAMES are separated by commas\n"
    "      --operator NAMES     these operators; --list shows all\n"
    "      --backend NAMES      these backends: scalar, avx2, ...\n"
    "      --input NAMES        these inputs, or 'none' for the FILEs alone\n"
    "      --runs N             runs of each, 1..100000, default 200; with fewer than 200 figures "
    "jump\n"
    "      --frames N           N copies of the frame in memory take turns, 1..64, default 16\n"
    "      --size WxH           only the middle of every input, both even, from 4x4 on\n"
    "      --raw FORMAT WxH     FILEs hold raw frames: YUYV 640x480, for example\n"
    "      --range RANGE        of raw YCbCr frames: full (default) or limited\n"
    "\n"
    "A robot's frames come one after the other from a ring of buffers and are read once each.\n"
    "So every run, of memcpy and OpenCV too, reads the next of N equal copies and writes to one\n"
    "place; with --frames 1 it is the same frame again, which stays in the cache. So do frames\n"
    "of which N fit there, and where N would take over 256 MiB, there are fewer.\n"
    "\n"
    "OpenCV\n"
    "      --python PYTHON      the Python that has it; default: the environment's PEL_PYTHON, or "
    "that\n"
    "                           of the build. Without this option it may be missing: its figures "
    "are\n"
    "                           then left out\n"
    "      --no-opencv          leave it out\n"
    "\n"
    "What to write\n"
    "      --csv                a line per operator, backend and input; the first line names the\n"
    "                           columns. Times are nanoseconds per pixel of the input, q1 and q3 "
    "their\n"
    "                           quartiles; `compared` says with what a result was compared,\n"
    "                           `frames` how many copies took turns\n"
    "      --plot OUT.png       also draw them\n"
    "      --list               the operators, backends and inputs that there are\n"
    "\n"
    "OpenCV runs in one thread, its functions write into memory that is there already. What its\n"
    "job is stands in tools/bench_opencv.py: for blobs a connectedComponentsWithStats per\n"
    "class, which has no moments or outline (blobs-all). It rounds otherwise in gradient,\n"
    "direction, kernel5, ycbcr, rgb, hsv, equalize, blend and resize: a value may differ by 1\n"
    "there, in Harris and Shi-Tomasi by 1/100000 of the largest response.\n"
    "\n"
    "Examples\n"
    "  pel bench\n"
    "  pel bench --operator blobs,gauss3,median --input synth\n"
    "  pel bench --csv --plot bench.png photo.jpg > bench.csv\n"
    "  pel bench --size 16x16 --no-opencv --backend scalar,avx2\n";

enum { INPUTS = 3, PICTURES_MAX = 32, RUNS = 200, FRAMES = 16 };
static const char *const inputs[INPUTS] = {"synth", "rand1", "rand4"};

struct job {
    source_options input;
    const char *operator_names, *backend_names, *input_names;
    const char *plot, *python;
    unsigned long runs, frames;
    unsigned width, height; /* 0: all */
    int csv, no_opencv;
    const bench_op *ops[128]; /* those to measure */
    unsigned op_count;
    bench_backends backends;
    bench_picture pictures[PICTURES_MAX];
    unsigned picture_count;
    bench_ring ring; /* of the picture at work */
    benchpeer peer;
    bench_compared compared;
    int core; /* on which all runs; -1: wherever the system wants */
    bench_figure *figures;
    unsigned figure_count;
    unsigned long steps, step; /* of the progress */
};

/* ---- Names --------------------------------------------------------------------------------- */

/* The length of the name at the start of a list; *next is where the list goes on, NULL at its
 * end. */
static size_t first_name(const char *list, const char **next)
{
    const size_t length = strcspn(list, ",");
    *next = list[length] == ',' ? list + length + 1 : NULL;
    return length;
}

static int is_name(const char *name, const char *word, size_t length)
{
    return strlen(name) == length && strncmp(name, word, length) == 0;
}

/* 1 if the list has the name; a NULL list has all. */
static int has_name(const char *list, const char *name)
{
    while (list) {
        const char *next;
        const size_t length = first_name(list, &next);
        if (is_name(name, list, length)) {
            return 1;
        }
        if (!next) {
            return 0;
        }
        list = next;
    }
    return 1;
}

static const char *op_name(unsigned i)
{
    return i < bench_op_count ? bench_ops[i].name : NULL;
}

static const char *input_name(unsigned i)
{
    return i < INPUTS ? inputs[i] : i == INPUTS ? "none" : NULL;
}

/* Those that this machine has. */
static const char *backend_name(unsigned i)
{
    for (unsigned b = PEL_BACKEND_SCALAR; b < PEL_BACKEND_COUNT; b++) {
        if (pel_backend_available((pel_backend)b) && i-- == 0) {
            return pel_backend_name((pel_backend)b);
        }
    }
    return NULL;
}

/* Says whether all names of a list are known. 0, or -1 after a message that lists what there is. */
static int check_names(const char *what, const char *list, const char *known(unsigned))
{
    while (list) {
        const char *next;
        const size_t length = first_name(list, &next);
        unsigned i = 0;
        while (known(i) && !is_name(known(i), list, length)) {
            i++;
        }
        if (!known(i)) {
            char all[800] = "";
            for (i = 0; known(i); i++) {
                const size_t used = strlen(all);
                snprintf(all + used, sizeof all - used, " %s", known(i));
            }
            return say_error("bench", "%s '%.*s' is none here; there are:%s", what, (int)length,
                             list, all);
        }
        list = next;
    }
    return 0;
}

static int print_list(void)
{
    puts("Operators; * = has backends (others: auto), o = OpenCV's job is compared and timed");
    for (unsigned i = 0; i < bench_op_count; i++) {
        const bench_op *op = &bench_ops[i];
        printf("  %c%c %-17s %s\n", op->has_backend ? '*' : ' ', op->fits ? 'o' : ' ', op->name,
               op->summary);
    }
    puts("Backends");
    for (unsigned i = 0; backend_name(i); i++) {
        printf("     %s\n", backend_name(i));
    }
    puts("Inputs");
    for (unsigned i = 0; i < INPUTS; i++) {
        printf("     %s\n", inputs[i]);
    }
    return EXIT_SUCCESS;
}

/* ---- The command line ---------------------------------------------------------------------- */

static const struct option long_options[] = {OPTIONS_INPUT,
                                             {"operator", required_argument, NULL, 'o'},
                                             {"backend", required_argument, NULL, 'b'},
                                             {"input", required_argument, NULL, 'i'},
                                             {"runs", required_argument, NULL, 'r'},
                                             {"frames", required_argument, NULL, 'm'},
                                             {"size", required_argument, NULL, 's'},
                                             {"python", required_argument, NULL, 'p'},
                                             {"no-opencv", no_argument, NULL, 'n'},
                                             {"csv", no_argument, NULL, 'v'},
                                             {"plot", required_argument, NULL, 'l'},
                                             {"list", no_argument, NULL, 't'},
                                             {"help", no_argument, NULL, 'h'},
                                             {NULL, 0, NULL, 0}};

static int read_size(struct job *job)
{
    if (options_size(optarg, &job->width, &job->height)) {
        return -1;
    }
    if (job->width % 2 || job->height % 2 || job->width < 4 || job->height < 4) {
        return say_error("bench", "--size wants even sides of 4 or more, not '%s'", optarg);
    }
    return 0;
}

static int read_plot(struct job *job)
{
    sink_kind kind;
    job->plot = optarg;
    if (sink_kind_by_path(optarg, &kind) || kind != SINK_PNG) {
        return say_error("bench", "--plot writes .png, not '%s'", optarg);
    }
    return 0;
}

/* Takes an option; 0, or -1 after a message. */
static int take_option(int option, int argc, char **argv, struct job *job)
{
    switch (option) {
    case 'o':
        job->operator_names = optarg;
        return check_names("operator", optarg, op_name);
    case 'b':
        job->backend_names = optarg;
        return check_names("backend", optarg, backend_name);
    case 'i':
        job->input_names = optarg;
        return check_names("input", optarg, input_name);
    case 'r':
        return options_number("--runs", optarg, 1, 100000, &job->runs);
    case 'm':
        return options_number("--frames", optarg, 1, BENCH_FRAMES_MAX, &job->frames);
    case 's':
        return read_size(job);
    case 'p':
        job->python = optarg;
        return 0;
    case 'n':
        job->no_opencv = 1;
        return 0;
    case 'v':
        job->csv = 1;
        return 0;
    case 'l':
        return read_plot(job);
    default:
        return options_input(option, argc, argv, &job->input) < 0 ? -1 : 0;
    }
}

/* Collects what was chosen: 0, or -1 if nothing is left. */
static int choose(struct job *job)
{
    for (unsigned i = 0; i < bench_op_count; i++) {
        if (has_name(job->operator_names, bench_ops[i].name)) {
            job->ops[job->op_count++] = &bench_ops[i];
        }
    }
    for (unsigned i = 0; backend_name(i); i++) {
        for (unsigned b = 0; b < PEL_BACKEND_COUNT; b++) {
            if (strcmp(backend_name(i), pel_backend_name((pel_backend)b)) == 0 &&
                has_name(job->backend_names, backend_name(i))) {
                job->backends.of[job->backends.count++] = (pel_backend)b;
            }
        }
    }
    for (unsigned i = 0; i < job->op_count; i++) {
        if (benchmeasure_backends(job->ops[i], &job->backends).count > 0) {
            return 0;
        }
    }
    return say_error("bench", "none of the operators chosen has the backend %s",
                     job->backend_names);
}

/* Reads the command line: -1 to go on, or an exit status. */
static int parse(int argc, char **argv, struct job *job)
{
    int option;
    opterr = 0;
    while ((option = getopt_long(argc, argv, ":h", long_options, NULL)) != -1) {
        switch (option) {
        case 'h':
            fputs(help, stdout);
            return EXIT_SUCCESS;
        case 't':
            return print_list();
        case '?':
        case ':':
            return usage_bad_option("bench", option, argv);
        default:
            if (take_option(option, argc, argv, job)) {
                return usage_hint("bench");
            }
        }
    }
    if (argc - optind > PICTURES_MAX - INPUTS) {
        return usage_error("bench", "at most %d FILEs", PICTURES_MAX - INPUTS);
    }
    if (argc == optind && job->input_names && !has_name(job->input_names, inputs[0]) &&
        !has_name(job->input_names, inputs[1]) && !has_name(job->input_names, inputs[2])) {
        return usage_error("bench", "--input none leaves nothing to measure without a FILE");
    }
    return choose(job) ? usage_hint("bench") : -1;
}

/* ---- Printing ------------------------------------------------------------------------------ */

/* What can only be run in one way takes the best that there is. */
static const char *name_of_backend(const bench_figure *f)
{
    return pel_backend_name(f->op->has_backend ? f->backend : PEL_BACKEND_AUTO);
}

static const char csv_header[] =
    "operator,backend,input,ns_per_px,ratio_to_memcpy,opencv_ns_per_px,speedup_over_opencv,"
    "ns_per_px_q1,ns_per_px_q3,memcpy_ns_per_px,memcpy_q1,memcpy_q3,opencv_q1,opencv_q3,runs,"
    "width,height,compared,frames\n";

static void print_csv(const struct job *job, const bench_figure *f)
{
    printf("%s,%s,", f->op->name, name_of_backend(f));
    report_csv_text(stdout, f->picture->name);
    printf(",%.4f,%.3f,", f->own.median, f->own.median / f->copy.median);
    if (f->has_opencv) {
        printf("%.4f,%.3f,", f->opencv.median, f->opencv.median / f->own.median);
    } else {
        fputs(",,", stdout);
    }
    printf("%.4f,%.4f,%.4f,%.4f,%.4f,", f->own.low, f->own.high, f->copy.median, f->copy.low,
           f->copy.high);
    if (f->has_opencv) {
        printf("%.4f,%.4f,", f->opencv.low, f->opencv.high);
    } else {
        fputs(",,", stdout);
    }
    const int is_scalar = f->backend == PEL_BACKEND_SCALAR;
    printf("%lu,%u,%u,%s%s%s,%u\n", job->runs, (unsigned)f->picture->width,
           (unsigned)f->picture->height, is_scalar ? "" : "scalar",
           !is_scalar && f->has_opencv ? "+" : "", f->has_opencv ? "opencv" : "", f->frames);
}

static void print_row(const bench_figure *f)
{
    char quartiles[40];
    snprintf(quartiles, sizeof quartiles, "%.3f-%.3f", f->own.low, f->own.high);
    printf("%-17s %-7s %8.3f %16s %9.2f", f->op->name, name_of_backend(f), f->own.median, quartiles,
           f->own.median / f->copy.median);
    if (f->has_opencv) {
        snprintf(quartiles, sizeof quartiles, "%.3f-%.3f", f->opencv.low, f->opencv.high);
        printf(" %8.3f %16s %8.2f", f->opencv.median, quartiles, f->opencv.median / f->own.median);
    }
    putchar('\n');
}

static void print_heading(const struct job *job)
{
    const bench_picture *picture = job->ring.picture;
    if (job->csv) {
        return;
    }
    printf("%s%s, %ux%u: nanoseconds per pixel, median and quartiles of %lu runs\n",
           picture == job->pictures ? "" : "\n", picture->name, (unsigned)picture->width,
           (unsigned)picture->height, job->runs);
    if (job->ring.count > 1) {
        printf("%u copies of the frame take turns.\n", job->ring.count);
    } else {
        puts("The same frame again and again: it stays in the cache.");
    }
    printf("%-17s %-7s %8s %16s %9s", "operator", "backend", "ns/px", "quartiles", "x memcpy");
    if (job->peer.process) {
        printf(" %8s %16s %8s", "OpenCV", "quartiles", "faster");
    }
    putchar('\n');
}

static void print_end(const struct job *job)
{
    if (job->csv) {
        return;
    }
    if (job->core >= 0) {
        printf("\nAll ran on processor core %d.\n", job->core);
    } else {
        puts("\nThis system does not keep a process on one core.");
    }
    printf("%lu results compared with plain C and equal; %lu compared with OpenCV%s%s%s\n",
           job->compared.backends, job->compared.opencv, job->peer.process ? " " : "",
           job->peer.process ? job->peer.version : "", job->peer.process ? ", and they fit" : "");
}

/* ---- Progress ------------------------------------------------------------------------------ */

static void show_progress(struct job *job, const char *verb, const bench_op *op,
                          const bench_picture *picture)
{
    job->step++;
    if (isatty(STDERR_FILENO)) {
        fprintf(stderr, "\r\033[K%lu of %lu: %s %s on %s", job->step, job->steps, verb, op->name,
                picture->name);
        fflush(stderr);
    }
}

static void hide_progress(void)
{
    if (isatty(STDERR_FILENO)) {
        fputs("\r\033[K", stderr);
        fflush(stderr);
    }
}

/* ---- Work ---------------------------------------------------------------------------------- */

static int load_pictures(struct job *job, int count, char **paths)
{
    for (unsigned i = 0; i < INPUTS; i++) {
        if (has_name(job->input_names, inputs[i]) &&
            benchpicture_make(inputs[i], job->width, job->height,
                              &job->pictures[job->picture_count++])) {
            return -1;
        }
    }
    for (int i = 0; i < count; i++) {
        if (benchpicture_read(paths[i], &job->input, job->width, job->height,
                              &job->pictures[job->picture_count++])) {
            return -1;
        }
    }
    return 0;
}

static int start_opencv(struct job *job)
{
    const char *python = getenv("PEL_PYTHON");
    if (job->no_opencv) {
        return 0;
    }
    python = job->python ? job->python : python ? python : PEL_BENCH_PYTHON;
    if (benchpeer_start(&job->peer, python) == 0) {
        return 0;
    }
    if (job->python) {
        return say_error("bench", "no OpenCV: %s", job->peer.missing);
    }
    say_error("bench",
              "OpenCV is left out: %s (--python names another; --no-opencv leaves it out "
              "without a word)",
              job->peer.missing);
    return 0;
}

static int compare_all(struct job *job)
{
    for (unsigned p = 0; p < job->picture_count; p++) {
        if (benchpeer_picture(&job->peer, &job->pictures[p], 1)) {
            return -1;
        }
        for (unsigned i = 0; i < job->op_count; i++) {
            const bench_backends some = benchmeasure_backends(job->ops[i], &job->backends);
            show_progress(job, "comparing", job->ops[i], &job->pictures[p]);
            if (some.count > 0 && benchmeasure_compare(job->ops[i], &job->pictures[p], &some,
                                                       &job->peer, &job->compared)) {
                return -1;
            }
        }
    }
    return 0;
}

static int time_op(struct job *job, const bench_op *op)
{
    const bench_backends some = benchmeasure_backends(op, &job->backends);
    bench_figure *figures = job->figures + job->figure_count;
    if (some.count == 0) {
        return 0;
    }
    if (benchmeasure_time(op, &job->ring, &some, &job->peer, (unsigned)job->runs, figures)) {
        return -1;
    }
    hide_progress();
    for (unsigned i = 0; i < some.count; i++) {
        if (job->csv) {
            print_csv(job, &figures[i]);
        } else {
            print_row(&figures[i]);
        }
    }
    job->figure_count += some.count;
    return report_close(stdout, "-"); /* flushed, so that a reader sees each at once */
}

/* Makes the ring of a picture here and in OpenCV's process, and times all operators on it. */
static int time_picture(struct job *job, const bench_picture *picture)
{
    const unsigned frames = benchring_count(picture, (unsigned)job->frames);
    if (frames < job->frames) {
        say_error("bench", "%s: %u frames take turns, more would take over %d MiB", picture->name,
                  frames, BENCH_RING_MIB);
    }
    if (benchring_make(&job->ring, picture, frames) ||
        benchpeer_picture(&job->peer, picture, frames)) {
        return -1;
    }
    print_heading(job);
    for (unsigned i = 0; i < job->op_count; i++) {
        show_progress(job, "timing", job->ops[i], picture);
        if (time_op(job, job->ops[i])) {
            return -1;
        }
    }
    return 0;
}

static int time_all(struct job *job)
{
    const size_t most = (size_t)job->picture_count * job->op_count * job->backends.count;
    job->figures = malloc(most * sizeof *job->figures);
    if (!job->figures) {
        return say_error("bench", "out of memory");
    }
    if (job->csv) {
        fputs(csv_header, stdout);
    }
    for (unsigned p = 0; p < job->picture_count; p++) {
        const int failed = time_picture(job, &job->pictures[p]);
        benchring_free(&job->ring);
        if (failed) {
            return -1;
        }
    }
    print_end(job);
    return 0;
}

static int draw(const struct job *job)
{
    benchplot plot = {job->figures, job->figure_count, job->backends, NULL, (unsigned)job->runs};
    if (!job->plot) {
        return 0;
    }
    plot.opencv = job->peer.process ? job->peer.version : NULL;
    return benchplot_write(job->plot, &plot);
}

static int run(int argc, char **argv)
{
    static struct job job;
    job.runs = RUNS;
    job.frames = FRAMES;
    const int status = parse(argc, argv, &job);
    if (status >= 0) {
        return status;
    }
    job.core = benchtime_pin();
    int failed = load_pictures(&job, argc - optind, argv + optind) || start_opencv(&job);
    job.steps = 2ul * job.picture_count * job.op_count;
    failed = failed || compare_all(&job) || time_all(&job) || draw(&job);
    hide_progress();
    benchpeer_stop(&job.peer);
    for (unsigned i = 0; i < job.picture_count; i++) {
        benchpicture_free(&job.pictures[i]);
    }
    free(job.figures);
    return failed ? EXIT_BAD_INPUT : EXIT_SUCCESS;
}

const command cmd_bench = {"bench", "time every operator here, beside memcpy and OpenCV", help,
                           run};
