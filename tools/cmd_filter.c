#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "border.h"
#include "command.h"
#include "options.h"
#include "planes.h"
#include "say.h"
#include "turn.h"
#include "usage.h"
#include "whole.h"

static const char help[] =
    "Usage: pel filter NAME [OPTION]... IN OUT\n"
    "       pel filter --kernel \"NUMBERS\" [OPTION]... IN OUT\n"
    "       pel filter --list\n"
    "\n"
    "Computes every pixel from its neighbours: smoothing, sharpening, gradients, median, erosion "
    "and\n"
    "dilation. The channels of a colour picture are filtered one by one.\n"
    "\n"
    "Which filter\n"
    "      NAME                 a named kernel or operator; --list shows all, '_' is as good as "
    "'-'\n"
    "      --kernel \"NUMBERS\"   9 numbers (3x3) or 25 (5x5), -128..127, row by row: the result "
    "is\n"
    "                           the sum of number times pixel. Commas and '/' may stand between "
    "them\n"
    "      --convolve           turn the kernel by half a turn first: the convolution of the\n"
    "                           textbooks, where everybody else computes the correlation\n"
    "\n"
    "What becomes of the sum of a kernel; named ones have their own divisor\n"
    "      --shift N            divide by 2^N, N up to 15; rounded to nearest, halves upward\n"
    "      --divide N           divide by N, 1..32767, rounded likewise\n"
    "      --absolute           without its sign\n"
    "      --bias N             then add N: --bias 128 shows both signs around middle gray\n"
    "      --wide               write 16 bits with their sign, plus 32768, as PGM of maxval "
    "65535,\n"
    "                           in place of 8 bits cut off at 0 and 255. Gray pictures, or --gray\n"
    "\n"
    "      --border MODE        what lies outside of the picture; for a row a b c d it is\n"
    "                             replicate    a a | a b c d | d d   (default)\n"
    "                             symmetric    b a | a b c d | d c\n"
    "                             reflect101   c b | a b c d | c b\n"
    "                             wrap         c d | a b c d | a b\n"
    "                             zero         0 0 | a b c d | 0 0\n"
    "                             constant=V   V V | a b c d | V V   V = 0..255\n"
    "                             valid        nothing: the result is smaller\n"
    "      --repeat N           filter N times, 1..100; open and close do both of their steps N "
    "times,\n"
    "                           one after the other\n" OPTIONS_BACKEND_HELP TURN_HELP "\n"
    "Examples\n"
    "  pel filter gauss3 robot.ppm smooth.ppm\n"
    "  pel filter gradient --gray robot.ppm edges.png\n"
    "  pel filter --kernel \"0 -1 0  -1 5 -1  0 -1 0\" robot.ppm sharp.ppm\n"
    "  pel filter sobel-x --gray --shift 2 --bias 128 --border reflect101 robot.ppm gx.pgm\n"
    "  pel filter laplacian --gray --wide robot.ppm laplacian.pgm\n"
    "  pel filter median --repeat 3 noisy.png clean.png\n";

enum { STEPS_MAX = 2 };

/* The operators that are not kernels: one step, or two for opening and closing. */
typedef struct named_operator {
    const char *name, *summary;
    pel_filter_op *step[STEPS_MAX];
    unsigned steps;
    pel_filter_op_s16 *wide; /* NULL if it has no 16-bit results */
} named_operator;

static const named_operator operators[] = {
    {"gradient-abs", "|gx| + |gy| of Sobel", {pel_op_gradient_abs}, 1, pel_op_gradient_abs_s16},
    {"gradient",
     "sqrt(gx^2 + gy^2) of Sobel, rounded down",
     {pel_op_gradient},
     1,
     pel_op_gradient_s16},
    {"direction",
     "atan2(gy, gx) in 1/256 of a turn: 0 brighter to the right, 64 below",
     {pel_op_direction},
     1,
     NULL},
    {"median", "the fifth of the nine: takes out single pixels", {pel_op_median}, 1, NULL},
    {"erode", "the smallest of the nine; also called min", {pel_op_min}, 1, NULL},
    {"dilate", "the largest of the nine; also called max", {pel_op_max}, 1, NULL},
    {"min", NULL, {pel_op_min}, 1, NULL},
    {"max", NULL, {pel_op_max}, 1, NULL},
    {"open", "erode, then dilate: small bright things go", {pel_op_min, pel_op_max}, 2, NULL},
    {"close", "dilate, then erode: small dark things go", {pel_op_max, pel_op_min}, 2, NULL},
    {"majority", "of labels: the most frequent of the nine", {pel_op_majority}, 1, NULL},
    {"erode-labels", "the label if all nine are it, else 0", {pel_op_erode_labels}, 1, NULL},
    {"dilate-labels",
     "its own label; where that is 0, the smallest one around",
     {pel_op_dilate_labels},
     1,
     NULL},
};

enum { OPERATORS = sizeof operators / sizeof operators[0] };

struct job {
    turn turn;
    const char *numbers; /* of --kernel */
    pel_kernel kernel;
    pel_filter_op *step[STEPS_MAX]; /* NULL is the kernel */
    unsigned steps;
    pel_filter_op_s16 *wide_op;
    pel_filter_config config;
    long shift, divide; /* -1 and 0: as the kernel has it */
    int32_t bias;       /* NO_BIAS likewise */
    int absolute, convolve, wide;
    unsigned long repeat;
    planes split, made[2];
    frame joined;
};

enum { NO_BIAS = 100000 };

/* ---- The list ------------------------------------------------------------------------------ */

static void print_name(const char *name)
{
    char dashed[32];
    snprintf(dashed, sizeof dashed, "%s", name);
    for (char *p = dashed; *p != '\0'; p++) {
        *p = *p == '_' ? '-' : *p;
    }
    printf("%-19s", dashed);
}

static void print_kernel(const pel_kernel *kernel)
{
    const int side = 2 * kernel->radius + 1;
    const unsigned long divisor = (unsigned long)(kernel->divisor ? kernel->divisor : 1)
                                  << kernel->shift;
    for (int i = 0; i < side * side; i++) {
        printf("%s%d", i == 0 ? "" : i % side == 0 ? " / " : " ", kernel->tap[i]);
    }
    if (divisor > 1) {
        printf(", divided by %lu", divisor);
    }
    if (kernel->bias) {
        printf(", plus %d", kernel->bias);
    }
    putchar('\n');
}

static int print_list(void)
{
    for (unsigned i = 0; pel_kernel_name(i); i++) {
        print_name(pel_kernel_name(i));
        print_kernel(pel_kernel_named(pel_kernel_name(i)));
    }
    for (unsigned i = 0; i < OPERATORS; i++) {
        if (operators[i].summary) {
            print_name(operators[i].name);
            puts(operators[i].summary);
        }
    }
    return EXIT_SUCCESS;
}

/* ---- The command line ---------------------------------------------------------------------- */

/* "sobel-x" becomes "sobel_x", or the other way round. */
static void respell(const char *word, char from, char to, char spelt[32])
{
    size_t i = 0;
    for (; i < 31 && word[i] != '\0'; i++) {
        spelt[i] = word[i] == from ? to : word[i];
    }
    spelt[i] = '\0';
}

static int find_name(const char *word, struct job *job)
{
    char spelt[32];
    respell(word, '-', '_', spelt);
    const pel_kernel *named = pel_kernel_named(spelt);
    if (named) {
        job->kernel = *named;
        job->step[0] = NULL;
        job->steps = 1;
        return 0;
    }
    respell(word, '_', '-', spelt);
    for (unsigned i = 0; i < OPERATORS; i++) {
        if (strcmp(spelt, operators[i].name) == 0) {
            memcpy(job->step, operators[i].step, sizeof job->step);
            job->steps = operators[i].steps;
            job->wide_op = operators[i].wide;
            return 0;
        }
    }
    return say_error("filter", "there is no filter '%s'; 'pel filter --list' shows them", word);
}

static int is_separator(char c)
{
    return c != '\0' && strchr(" \t\n,;/", c) != NULL;
}

static int read_kernel(const char *numbers, pel_kernel *kernel)
{
    unsigned count = 0;
    const char *p = numbers;
    for (;;) {
        while (is_separator(*p)) {
            p++;
        }
        if (*p == '\0') {
            break;
        }
        char *end;
        const long tap = strtol(p, &end, 10);
        if (end == p || (*end != '\0' && !is_separator(*end)) || tap < -128 || tap > 127) {
            return say_error("filter", "--kernel takes whole numbers -128..127, not '%.20s'", p);
        }
        if (count < 25) {
            kernel->tap[count] = (int8_t)tap;
        }
        count++;
        p = end;
    }
    if (count != 9 && count != 25) {
        return say_error("filter", "--kernel takes 9 numbers (3x3) or 25 (5x5), not %u", count);
    }
    kernel->radius = count == 9 ? 1 : 2;
    return 0;
}

static int read_number(const char *name, unsigned long min, unsigned long max, long *number)
{
    unsigned long value;
    if (options_number(name, optarg, min, max, &value)) {
        return -1;
    }
    *number = (long)value;
    return 0;
}

static const struct option long_options[] = {{"kernel", required_argument, NULL, 'k'},
                                             {"list", no_argument, NULL, 'l'},
                                             {"border", required_argument, NULL, 'b'},
                                             {"shift", required_argument, NULL, 's'},
                                             {"divide", required_argument, NULL, 'd'},
                                             {"bias", required_argument, NULL, 'i'},
                                             {"absolute", no_argument, NULL, 'a'},
                                             {"convolve", no_argument, NULL, 'c'},
                                             {"repeat", required_argument, NULL, 'n'},
                                             {"wide", no_argument, NULL, 'w'},
                                             OPTIONS_BACKEND,
                                             TURN_OPTIONS};

/* Takes an option of its own: 0, -1 after a message, or 1 if it is none. */
static int take_option(int option, struct job *job)
{
    switch (option) {
    case 'k':
        job->numbers = optarg;
        return 0;
    case 'b':
        return border_read("filter", optarg, &job->config.border, &job->config.constant);
    case 's':
        return read_number("--shift", 0, 15, &job->shift);
    case 'd':
        return read_number("--divide", 1, 32767, &job->divide);
    case 'i':
        return whole_number("filter", "--bias", optarg, -32768, 32767, &job->bias);
    case 'n':
        return options_number("--repeat", optarg, 1, 100, &job->repeat);
    case OPTION_BACKEND:
        return options_backend(optarg, &job->config.backend);
    case 'a':
        job->absolute = 1;
        return 0;
    case 'c':
        job->convolve = 1;
        return 0;
    case 'w':
        job->wide = 1;
        return 0;
    default:
        return 1;
    }
}

/* What is said beside the kernel. */
static int finish_kernel(struct job *job)
{
    pel_kernel *const kernel = &job->kernel;
    if (job->step[0]) {
        if (job->shift >= 0 || job->divide > 0 || job->bias != NO_BIAS || job->absolute ||
            job->convolve) {
            return usage_error("filter", "--shift, --divide, --bias, --absolute and --convolve are "
                                         "for kernels");
        }
        return -1;
    }
    if (job->convolve) {
        *kernel = pel_kernel_flipped(kernel);
    }
    if (job->shift >= 0 || job->divide > 0) {
        kernel->shift = (uint8_t)(job->shift > 0 ? job->shift : 0);
        kernel->divisor = (uint16_t)(job->divide > 0 ? job->divide : 1);
    }
    if (job->bias != NO_BIAS) {
        kernel->bias = (int16_t)job->bias;
    }
    if (job->absolute) {
        kernel->absolute = 1;
    }
    return -1;
}

static int check_wide(const struct job *job)
{
    if (!job->wide) {
        return -1;
    }
    if (job->repeat > 1) {
        return usage_error("filter", "--wide results cannot be filtered again: no --repeat");
    }
    if (job->step[0] && !job->wide_op) {
        return usage_error("filter", "--wide is for kernels, gradient and gradient-abs");
    }
    return -1;
}

/* The filter, by its name or its numbers: -1 to go on, or an exit status. */
static int choose_filter(int argc, char **argv, struct job *job)
{
    if (job->shift >= 0 && job->divide > 0) {
        return usage_error("filter", "either --shift or --divide");
    }
    if (job->numbers) {
        job->step[0] = NULL;
        job->steps = 1;
        if (read_kernel(job->numbers, &job->kernel)) {
            return usage_hint("filter");
        }
    } else if (optind >= argc) {
        return usage_error("filter", "no filter given: say its NAME or --kernel");
    } else if (find_name(argv[optind++], job)) {
        return usage_hint("filter");
    }
    const int status = finish_kernel(job);
    return status >= 0 ? status : check_wide(job);
}

static int parse(int argc, char **argv, struct job *job)
{
    int option;
    opterr = 0;
    while ((option = getopt_long(argc, argv, ":h", long_options, NULL)) != -1) {
        if (option == 'h') {
            fputs(help, stdout);
            return EXIT_SUCCESS;
        }
        if (option == 'l') {
            return print_list();
        }
        const int taken = take_option(option, job);
        const int status = taken > 0   ? turn_option(&job->turn, option, argc, argv)
                           : taken < 0 ? usage_hint("filter")
                                       : -1;
        if (status >= 0) {
            return status;
        }
    }
    const int status = choose_filter(argc, argv, job);
    return status >= 0 ? status : turn_files(&job->turn, argc, argv);
}

/* ---- The work ------------------------------------------------------------------------------ */

static int explain(const char *path, const pel_cview *view, pel_status status)
{
    if (status == PEL_ERR_RANGE) {
        return say_error(path, "a picture of %ux%u is too small for --border valid", view->width,
                         view->height);
    }
    return say_error(path, "cannot be filtered: %s", pel_status_name(status));
}

/* The config for a picture, with working memory that the caller frees. */
static int prepare(const struct job *job, const char *path, const pel_cview *view,
                   pel_filter_config *config)
{
    *config = job->config;
    config->kernel = &job->kernel;
    config->work_bytes = PEL_FILTER_BYTES_WRAP(view->width, 2);
    config->work = malloc(config->work_bytes);
    return config->work ? 0 : say_error(path, "out of memory");
}

/* One step on every channel, 8 bits. */
static int filter_channels(const struct job *job, const char *path, pel_filter_op *op,
                           const planes *from, planes *to)
{
    const pel_cview first = planes_view(from, 0);
    pel_filter_config config;
    if (prepare(job, path, &first, &config)) {
        return -1;
    }
    config.op = op;
    config.width = first.width;
    config.height = first.height;
    const int less = config.border != PEL_BORDER_VALID ? 0 : !op && job->kernel.radius == 2 ? 4 : 2;
    pel_status status = PEL_ERR_RANGE;
    int failed = 0;
    if (first.width > less && first.height > less) {
        failed = planes_resize(path, to, from->count, pel_filter_width(&config),
                               pel_filter_height(&config));
        status = PEL_OK;
    }
    for (unsigned i = 0; !failed && status == PEL_OK && i < from->count; i++) {
        const pel_cview channel = planes_view(from, i);
        status = pel_filter_frame(&config, &channel, &to->channel[i].view);
    }
    free(config.work);
    return failed ? -1 : status == PEL_OK ? 0 : explain(path, &first, status);
}

static int make_wide(struct job *job, const char *path, const pel_cview *view)
{
    pel_filter_config config;
    if (view->format != PEL_GRAY8) {
        return say_error(path, "is a colour picture, and --wide writes gray ones: add --gray");
    }
    if (prepare(job, path, view, &config)) {
        return -1;
    }
    config.op_s16 = job->wide_op;
    config.width = view->width;
    config.height = view->height;
    const uint16_t width = pel_filter_width(&config);
    int16_t *values = malloc(sizeof *values * view->width * view->height);
    pel_status status = PEL_ERR_SPACE;
    if (values) {
        status = pel_filter_frame_s16(&config, view, values, width);
    }
    int result = -1;
    if (!values) {
        say_error(path, "out of memory");
    } else if (status != PEL_OK) {
        explain(path, view, status);
    } else {
        result = outlet_wide(&job->turn.to, values, width, pel_filter_height(&config));
    }
    free(values);
    free(config.work);
    return result;
}

static int make(void *user, const char *path, const pel_cview *picture)
{
    struct job *job = user;
    const planes *from = &job->split;
    unsigned next = 0;
    if (job->wide) {
        return make_wide(job, path, picture);
    }
    if (planes_split(path, picture, &job->split)) {
        return -1;
    }
    for (unsigned i = 0; i < job->steps; i++) {
        for (unsigned long round = 0; round < job->repeat; round++) {
            planes *const to = &job->made[next];
            if (filter_channels(job, path, job->step[i], from, to)) {
                return -1;
            }
            from = to;
            next = 1 - next;
        }
    }
    if (planes_join(path, from, &job->joined)) {
        return -1;
    }
    const pel_cview joined = pel_view_to_read(&job->joined.view);
    return outlet_view(&job->turn.to, path, &joined);
}

static int run(int argc, char **argv)
{
    static struct job job;
    job.turn.command = "filter";
    job.turn.make = make;
    job.turn.user = &job;
    job.shift = -1;
    job.bias = NO_BIAS;
    job.repeat = 1;
    int status = parse(argc, argv, &job);
    if (status < 0) {
        status = turn_run(&job.turn);
        planes_free(&job.split);
        planes_free(&job.made[0]);
        planes_free(&job.made[1]);
        frame_free(&job.joined);
    }
    return status;
}

const command cmd_filter = {"filter", "smooth, sharpen, find gradients, erode and dilate", help,
                            run};
