#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <pel.h>

#include "command.h"
#include "options.h"
#include "say.h"
#include "usage.h"

static const char help[] =
    "Usage: pel budget WIDTHxHEIGHT [OPTION]...\n"
    "\n"
    "Says how many bytes of RAM finding blobs takes on a microcontroller, part by part, and prints "
    "the\n"
    "C declarations to paste. The numbers come from the macros that the firmware itself uses; "
    "sizes of\n"
    "structures with pointers are those of this machine: the finder is smaller on a 32-bit "
    "controller\n"
    "(184 bytes on a 64-bit computer, 120 on Cortex-M).\n"
    "\n"
    "      --classes N        colour classes, default 8, at most 32 (8, 16 and 32 have tables of\n"
    "                         different size)\n"
    "      --open N           blobs open at the same time, default 32; fewer than the never-lose "
    "number\n"
    "                         can lose blobs in wild pictures, and counts what it loses\n"
    "      --blobs N          results to keep, default 16\n"
    "      --measure WHAT     moments,outline,color or all or none; default moments\n"
    "      --format FORMAT    of the camera, default YUYV\n"
    "      --csv              columns part,bytes\n"
    "\n"
    "Example\n"
    "  pel budget 320x240 --classes 8 --open 32 --blobs 16\n";

struct plan {
    unsigned width, height; /* of the camera */
    unsigned long classes, open, blobs;
    unsigned measure;
    pel_format format;
    int csv;
};

struct part {
    const char *name;
    size_t bytes;
};

/* ---- The command line ---------------------------------------------------------------------- */

static int read_measure(unsigned *measure)
{
    static const struct {
        const char *name;
        unsigned bits;
    } words[] = {{"none", 0},
                 {"moments", PEL_MEASURE_MOMENTS},
                 {"outline", PEL_MEASURE_OUTLINE},
                 {"color", PEL_MEASURE_COLOR},
                 {"all", PEL_MEASURE_ALL}};
    const size_t count = sizeof words / sizeof words[0];
    unsigned bits = 0;
    for (const char *p = optarg;; p++) {
        const size_t length = strcspn(p, ",");
        size_t i = 0;
        while (i < count &&
               (strlen(words[i].name) != length || strncmp(words[i].name, p, length))) {
            i++;
        }
        if (i == count) {
            return say_error(
                "budget", "--measure knows moments, outline, color, all, none, not '%s'", optarg);
        }
        bits |= words[i].bits;
        p += length;
        if (*p == '\0') {
            *measure = bits;
            return 0;
        }
    }
}

static int read_option(int option, struct plan *plan)
{
    switch (option) {
    case 'n':
        return options_number("--classes", optarg, 1, 32, &plan->classes);
    case 'p':
        return options_number("--open", optarg, 1, PEL_BLOBS_OPEN_LIMIT, &plan->open);
    case 'b':
        return options_number("--blobs", optarg, 0, 1000000, &plan->blobs);
    case 'm':
        return read_measure(&plan->measure);
    default:
        return options_format(optarg, &plan->format);
    }
}

/* Takes the size, which is checked against the format when all options are known. */
static int read_size(int argc, char **argv, struct plan *plan)
{
    if (argc - optind != 1) {
        return usage_error("budget", "one size wanted, such as 320x240, %d given", argc - optind);
    }
    if (options_size(argv[optind], &plan->width, &plan->height) ||
        options_check_size(plan->format, plan->width, plan->height)) {
        return usage_hint("budget");
    }
    return -1;
}

/* Reads the command line: -1 to go on, or an exit status. */
static int parse(int argc, char **argv, struct plan *plan)
{
    static const struct option long_options[] = {
        {"classes", required_argument, NULL, 'n'}, {"open", required_argument, NULL, 'p'},
        {"blobs", required_argument, NULL, 'b'},   {"measure", required_argument, NULL, 'm'},
        {"format", required_argument, NULL, 'f'},  {"csv", no_argument, NULL, 'v'},
        {"help", no_argument, NULL, 'h'},          {NULL, 0, NULL, 0}};
    int option;
    opterr = 0;
    while ((option = getopt_long(argc, argv, ":h", long_options, NULL)) != -1) {
        switch (option) {
        case 'h':
            fputs(help, stdout);
            return EXIT_SUCCESS;
        case 'v':
            plan->csv = 1;
            break;
        case '?':
        case ':':
            return usage_bad_option("budget", option, argv);
        default:
            if (read_option(option, plan)) {
                return usage_hint("budget");
            }
        }
    }
    return read_size(argc, argv, plan);
}

/* ---- The budget ---------------------------------------------------------------------------- */

static unsigned class_max(unsigned long classes)
{
    return classes <= 8 ? 8 : classes <= 16 ? 16 : 32;
}

/* The class tables of this build, or of one that was configured for more classes or fewer: three
 * tables of 256 masks with a bit per class. */
static size_t boxes_bytes(unsigned long classes)
{
    return class_max(classes) == PEL_CLASS_MAX ? sizeof(pel_boxes)
                                               : (size_t)3 * 256 * (class_max(classes) / 8);
}

/* What one row of colours is read from. Where rows come in pairs that is both of a mosaic, but of
 * planes one row of Y and the chroma that two share. */
static size_t line_bytes(const struct plan *plan)
{
    const uint16_t width = (uint16_t)plan->width;
    const size_t one = pel_frame_bytes(plan->format, width, 1);
    const size_t two = pel_frame_bytes(plan->format, width, 2);
    if (one > 0) {
        return one;
    }
    return pel_color_height(plan->format, 2) == 1 ? two : two - pel_row_bytes(plan->format, width);
}

static void print_parts(const struct plan *plan, const struct part *parts, size_t count)
{
    size_t sum = 0;
    if (plan->csv) {
        puts("part,bytes");
    }
    for (size_t i = 0; i < count; i++) {
        printf(plan->csv ? "%s,%zu\n" : "  %-34s %8zu\n", parts[i].name, parts[i].bytes);
        sum += parts[i].bytes;
    }
    printf(plan->csv ? "%s,%zu\n" : "  %-34s %8zu\n", "sum", sum);
    printf(plan->csv ? "%s,%zu\n" : "\n  %-34s %8zu\n", "camera line (beside it)",
           line_bytes(plan));
}

static void print_measure(unsigned measure)
{
    static const char *const names[] = {"PEL_MEASURE_MOMENTS", "PEL_MEASURE_OUTLINE",
                                        "PEL_MEASURE_COLOR"};
    const char *between = "";
    if (measure == 0 || measure == PEL_MEASURE_ALL) {
        fputs(measure ? "PEL_MEASURE_ALL" : "0", stdout);
        return;
    }
    for (unsigned i = 0; i < 3; i++) {
        if (measure & (1u << i)) {
            printf("%s%s", between, names[i]);
            between = " | ";
        }
    }
}

static void print_declarations(const struct plan *plan, unsigned width)
{
    puts("\nTo paste:\n");
    if (class_max(plan->classes) != 8) {
        printf("/* the library and this file compiled with -DPEL_CLASS_MAX=%u */\n",
               class_max(plan->classes));
    }
    puts("static pel_boxes boxes;");
    printf("static uint8_t line[%zu];\n", line_bytes(plan));
    printf("static uint8_t labels[%u];\n", width);
    printf("static uint64_t work[PEL_BLOBS_WORDS(%u, %lu, ", width, plan->open);
    print_measure(plan->measure);
    puts(")];");
    if (plan->blobs > 0) {
        printf("static pel_blob found[%lu];\n", plan->blobs);
    }
    puts("static pel_blobs blobs;");
}

static void print_remarks(const struct plan *plan, unsigned width)
{
    const unsigned long safe = PEL_BLOBS_OPEN_SAFE(width);
    printf("\nNothing can be lost with --open %lu (work: %zu bytes)", safe,
           PEL_BLOBS_WORDS(width, safe, plan->measure) * sizeof(uint64_t));
    if (plan->open >= safe) {
        puts("; this plan has that.");
    } else {
        printf(".\nWith --open %lu a picture that needs more loses blobs, and counts them.\n",
               plan->open);
    }
}

static int refuse_size(const struct plan *plan, unsigned width, unsigned height)
{
    const uint64_t longer = width > height ? width : height;
    if ((uint64_t)width * height * longer <= (uint64_t)1 << 33) {
        return 0;
    }
    return say_error("budget", "frames of %ux%u are too large for blobs: their sums could overflow",
                     plan->width, plan->height);
}

static int run(int argc, char **argv)
{
    struct plan plan = {0, 0, 8, 32, 16, PEL_MEASURE_MOMENTS, PEL_YUYV, 0};
    const int status = parse(argc, argv, &plan);
    if (status >= 0) {
        return status;
    }
    const uint16_t width = pel_color_width(plan.format, (uint16_t)plan.width);
    const uint16_t height = pel_color_height(plan.format, (uint16_t)plan.height);
    if (refuse_size(&plan, width, height)) {
        return EXIT_BAD_USAGE;
    }
    const struct part parts[] = {
        {"class tables", boxes_bytes(plan.classes)},
        {"label row", width},
        {"working memory", PEL_BLOBS_WORDS(width, plan.open, plan.measure) * sizeof(uint64_t)},
        {"results", plan.blobs * sizeof(pel_blob)},
        {"finder", sizeof(pel_blobs)},
    };
    if (!plan.csv) {
        printf("%ux%u %s, %lu classes, %lu open blobs, %lu results: bytes of RAM\n\n", plan.width,
               plan.height, pel_format_name(plan.format), plan.classes, plan.open, plan.blobs);
    }
    print_parts(&plan, parts, sizeof parts / sizeof parts[0]);
    if (!plan.csv) {
        print_remarks(&plan, width);
        print_declarations(&plan, width);
    }
    return EXIT_SUCCESS;
}

const command cmd_budget = {"budget", "say how much RAM a microcontroller needs", help, run};
