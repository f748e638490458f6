#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "carray.h"
#include "classfile.h"
#include "command.h"
#include "options.h"
#include "report.h"
#include "say.h"
#include "sink.h"
#include "usage.h"

static const char help[] =
    "Usage: pel classes [--c-array NAME] IN [OUT]\n"
    "\n"
    "Shows what a class file says, or writes it in another form. IN is a class file in CMVision's "
    "text\n"
    "format or a .tm table; \"-\" is standard input. Without OUT the classes are listed.\n"
    "\n"
    "  OUT.tm               a CMVision 2 table of 16 x 64 x 64 labels, each cell classified at "
    "its\n"
    "                       middle. A table has full colour range: for classes of limited range "
    "the\n"
    "                       middles are converted first. It has no names and no merge densities\n"
    "  OUT.c                C source for the flash of a robot: the boxes, or the cells of a table\n"
    "  any other OUT        the text format (a table of labels has no boxes to write there)\n"
    "      --c-array NAME   the name in the C source; default: classes\n"
    "\n"
    "Examples\n"
    "  pel classes robot.classes\n"
    "  pel classes robot.classes robot.tm\n"
    "  pel classes --c-array robot_classes robot.classes robot_classes.c\n";

struct job {
    const char *array_name;
    classes list;
};

static int parse(int argc, char **argv, struct job *job)
{
    static const struct option long_options[] = {{"c-array", required_argument, NULL, 'a'},
                                                 {"help", no_argument, NULL, 'h'},
                                                 {NULL, 0, NULL, 0}};
    int option;

    opterr = 0;
    while ((option = getopt_long(argc, argv, ":h", long_options, NULL)) != -1) {
        switch (option) {
        case 'h':
            fputs(help, stdout);
            return EXIT_SUCCESS;
        case 'a':
            if (!carray_name_ok(optarg)) {
                return usage_error("classes", "'%s' is not a C name, or a keyword of C or C++",
                                   optarg);
            }
            job->array_name = optarg;
            break;
        default:
            return usage_bad_option("classes", option, argv);
        }
    }
    if (optind >= argc) {
        return usage_error("classes", "no class file given");
    }
    return argc - optind > 2 ? usage_error("classes", "too many files: '%s'", argv[optind + 2])
                             : -1;
}

static void print_box(FILE *file, const char *format, const pel_color_box *box)
{
    fprintf(file, format, (unsigned)box->y_min, (unsigned)box->y_max, (unsigned)box->u_min,
            (unsigned)box->u_max, (unsigned)box->v_min, (unsigned)box->v_max);
}

static int print_list(const classes *list)
{
    printf("class  name                  Y          U          V        colour\n");
    for (unsigned i = 0; i < list->count; i++) {
        const class_entry *const entry = &list->entry[i];
        printf("%5u  %-16s", i, entry->name);
        if (list->cells) {
            printf("   %-33s", "by table");
        } else {
            print_box(stdout, "  %3u..%-3u   %3u..%-3u   %3u..%-3u  ", &entry->box);
        }
        printf(" %u,%u,%u\n", (unsigned)entry->red, (unsigned)entry->green, (unsigned)entry->blue);
    }
    printf("colour range: %s\n", list->range == PEL_RANGE_LIMITED ? "limited" : "full");
    return report_close(stdout, "-");
}

static void write_boxes(FILE *file, const char *name, const classes *list)
{
    fprintf(file,
            "/* %u classes, colour range %s. Once, at the start:\n"
            " *     for (unsigned i = 0; i < %s_count; i++) pel_boxes_set(&boxes, i, &%s[i]); */\n"
            "#include <pel.h>\n\nenum { %s_count = %u };\n\nconst pel_color_box %s[] = {\n",
            list->count, list->range == PEL_RANGE_LIMITED ? "limited" : "full", name, name, name,
            list->count, name);
    for (unsigned i = 0; i < list->count; i++) {
        print_box(file, "    {%u, %u, %u, %u, %u, %u},", &list->entry[i].box);
        fprintf(file, " /* %u: %s */\n", i, list->entry[i].name);
    }
    fputs("};\n", file);
}

static void write_cells(FILE *file, const char *name, const classes *list)
{
    const pel_lut *const lut = &list->classifier.lut;
    const size_t count = pel_lut_bytes(lut->y_bits, lut->u_bits, lut->v_bits);

    fprintf(file,
            "/* A table of labels, colour range %s. To classify with it:\n"
            " *     pel_classifier classifier = {.lut = {%s, %u, %u, %u},\n"
            " *                                  .reader = pel_crow_read_yuv,\n"
            " *                                  .pieces = pel_classify_pieces}; */\n"
            "#include <stdint.h>\n\nconst uint8_t %s[%zu] = {",
            list->range == PEL_RANGE_LIMITED ? "limited" : "full", name, (unsigned)lut->y_bits,
            (unsigned)lut->u_bits, (unsigned)lut->v_bits, name, count);
    for (size_t i = 0; i < count; i++) {
        fprintf(file, "%s%u,", i % 32 == 0 ? "\n    " : "", (unsigned)lut->cell[i]);
    }
    fputs("\n};\n", file);
}

static int write_source(const char *path, const char *name, const classes *list)
{
    FILE *file = sink_open_file(path);

    if (!file) {
        return -1;
    }
    if (list->cells) {
        write_cells(file, name, list);
    } else {
        write_boxes(file, name, list);
    }
    return sink_close_file(file, path, 0);
}

static int has_ending(const char *path, const char *ending)
{
    const size_t length = strlen(path), tail = strlen(ending);
    return length > tail && options_same_word(path + length - tail, ending);
}

static int write_list(const char *path, const struct job *job)
{
    if (has_ending(path, ".tm")) {
        return classes_write_tm(path, &job->list);
    }
    if (has_ending(path, ".c")) {
        return write_source(path, job->array_name, &job->list);
    }
    if (job->list.cells) {
        return say_error(path, "a table has no boxes for the text format: write .tm or .c");
    }
    return classes_write(path, &job->list);
}

static int run(int argc, char **argv)
{
    static struct job job = {.array_name = "classes"};
    const int status = parse(argc, argv, &job);

    if (status >= 0) {
        return status;
    }
    if (classes_read(argv[optind], &job.list)) {
        return EXIT_BAD_INPUT;
    }
    const int failed =
        argc - optind == 2 ? write_list(argv[optind + 1], &job) : print_list(&job.list);
    classes_free(&job.list);
    return failed ? EXIT_BAD_INPUT : EXIT_SUCCESS;
}

const command cmd_classes = {"classes", "show a class file, or write it as .tm, C or text", help,
                             run};
