#include <getopt.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "report.h"
#include "say.h"
#include "usage.h"
#include "wire.h"

static const char help[] =
    "Usage: pel listen [-c CLASSES] [OPTION]... [INPUT]\n"
    "\n"
    "Reads what a robot says on its serial line (ports/robot/PROTOCOL.md) and "
    "prints the blobs as\n"
    "'pel blobs' does, frame by frame as they come, largest first.\n"
    "\n"
    "INPUT is a file, a pipe or the device of a serial line that has been set "
    "up (stty); without "
    "it, or\n"
    "with '-', standard input. Listening may start anywhere: damaged records "
    "are skipped and "
    "counted on\n"
    "standard error.\n"
    "\n"
    "  -c, --classes CLASSES    the robot's class file, for the names; "
    "otherwise class0, class1, "
    "...\n"
    "      --csv                the columns of 'pel blobs --csv'; what the "
    "robot did not measure "
    "is\n"
    "                           computed from zeros\n"
    "      --json               the objects of 'pel blobs --json'\n"
    "      --targets            instead of the blobs what the robot told its "
    "motors, as CSV:\n"
    "                           frame,class,name,area,x_q15,y_q15; area 0 "
    "where it saw nothing\n"
    "\n"
    "Exit status 1 if there was no valid record at all.\n"
    "\n"
    "Examples\n"
    "  stty -F /dev/ttyACM0 115200 raw && pel listen -c robot.classes "
    "/dev/ttyACM0\n"
    "  pel listen -c robot.classes --csv log.uart > log.csv\n";

struct job {
    const char *classes_path, *input;
    classes list;
    report_style style;
    int styles; /* how many were asked for */
    int targets;
    wire line;
    wire_record begin; /* of the frame that is being heard, as far as it is known */
    int in_frame;
    pel_blob *blobs;
    uint32_t count, room;
    uint64_t missing_blobs, missing_ends, broken_off;
    uint32_t missed_lines;
};

/* ---- The command line
 * ---------------------------------------------------------------------- */

/* Reads the command line: -1 to go on, or an exit status. */
static int parse(int argc, char **argv, struct job *job)
{
    static const struct option long_options[] = {
        {"classes", required_argument, NULL, 'c'}, {"csv", no_argument, NULL, 'v'},
        {"json", no_argument, NULL, 'j'},          {"targets", no_argument, NULL, 't'},
        {"help", no_argument, NULL, 'h'},          {NULL, 0, NULL, 0}};
    int option;
    opterr = 0;
    while ((option = getopt_long(argc, argv, ":c:h", long_options, NULL)) != -1) {
        switch (option) {
        case 'h':
            fputs(help, stdout);
            return EXIT_SUCCESS;
        case 'c':
            job->classes_path = optarg;
            break;
        case 'v':
        case 'j':
            job->styles++;
            job->style = option == 'v' ? REPORT_CSV : REPORT_JSON;
            break;
        case 't':
            job->styles++;
            job->targets = 1;
            break;
        default:
            return usage_bad_option("listen", option, argv);
        }
    }
    if (job->styles > 1) {
        return usage_error("listen", "one of --csv, --json and --targets, once");
    }
    if (argc - optind > 1) {
        return usage_error("listen", "one input wanted, %d given", argc - optind);
    }
    job->input = optind < argc ? argv[optind] : "-";
    return -1;
}

/* Names for the classes that the class file, if there is one, does not name. */
static int name_classes(struct job *job)
{
    if (job->classes_path && classes_read(job->classes_path, &job->list)) {
        return -1;
    }
    for (unsigned i = job->list.count; i < PEL_CLASS_MAX; i++) {
        snprintf(job->list.entry[i].name, sizeof job->list.entry[i].name, "class%u", i);
    }
    return 0;
}

/* ---- Frames
 * --------------------------------------------------------------------------------
 */

static int keep(struct job *job, const pel_blob *blob)
{
    if (job->count == job->room) {
        const uint32_t room = job->room ? 2 * job->room : 64;
        pel_blob *larger = room > job->room ? realloc(job->blobs, room * sizeof *larger) : NULL;
        if (!larger) {
            return say_error(job->input, "out of memory");
        }
        job->blobs = larger;
        job->room = room;
    }
    job->blobs[job->count++] = *blob;
    return 0;
}

static void open_frame(struct job *job, const wire_record *record)
{
    job->begin = *record;
    job->in_frame = 1;
    job->count = 0;
}

/* Prints what was heard of a frame; `counts` are those of its end or made up from what there is.
 * */
static int print_frame(struct job *job, const pel_blobs_counts *counts)
{
    report_frame found = {0};
    job->in_frame = 0;
    if (job->targets) {
        return 0;
    }
    pel_blobs_sort(job->blobs, job->count);
    found.frame = job->begin.frame;
    found.file = job->input;
    found.width = job->begin.width;
    found.height = job->begin.height;
    found.list = &job->list;
    found.blobs = job->blobs;
    found.blob_count = job->count;
    found.counts = *counts;
    report_blobs(stdout, job->style, &found);
    return report_close(stdout, "-");
}

/* The end of the frame was not heard: prints what came before. */
static int print_rest(struct job *job)
{
    pel_blobs_counts counts = {0};
    if (!job->in_frame) {
        return 0;
    }
    job->missing_ends++;
    counts.found = job->count;
    return print_frame(job, &counts);
}

static int hear_end(struct job *job, const wire_record *record)
{
    const uint32_t sent = record->counts.found - record->counts.dropped;
    if (job->count < sent) {
        job->missing_blobs += sent - job->count;
    }
    job->broken_off += record->state == WIRE_BROKEN_OFF;
    job->missed_lines = record->missed_lines;
    return print_frame(job, &record->counts);
}

static int print_target(const struct job *job, const wire_record *record)
{
    const uint8_t class_index = record->blob.class_index;
    if (!job->targets) {
        return 0;
    }
    printf("%" PRIu32 ",%u,", record->frame, (unsigned)class_index);
    report_csv_text(stdout, job->list.entry[class_index].name);
    printf(",%" PRIu32 ",%u,%u\n", record->area, (unsigned)record->x_q15, (unsigned)record->y_q15);
    return report_close(stdout, "-");
}

/* 0, or -1 after a message. */
static int hear(struct job *job, const wire_record *record)
{
    const int goes_on =
        job->in_frame && record->kind != WIRE_FRAME_BEGIN && record->frame == job->begin.frame;
    if (!goes_on) {
        const wire_record unknown = {.frame = record->frame};
        if (print_rest(job)) {
            return -1;
        }
        open_frame(job, record->kind == WIRE_FRAME_BEGIN ? record : &unknown);
    }
    switch (record->kind) {
    case WIRE_BLOB:
        return keep(job, &record->blob);
    case WIRE_TARGET:
        return print_target(job, record);
    case WIRE_FRAME_END:
        return hear_end(job, record);
    default:
        return 0;
    }
}

/* ---- What went wrong
 * ----------------------------------------------------------------------- */

static void tell(const struct job *job, uint64_t count, const char *what)
{
    if (count > 0) {
        say_error(job->input, "%" PRIu64 " %s", count, what);
    }
}

static void tell_all(const struct job *job)
{
    const wire_counts *const counts = &job->line.counts;
    tell(job, counts->bad_checksums, "records with a wrong checksum");
    tell(job, counts->bad_values, "records with impossible values");
    tell(job, counts->cut_short, "records cut short by the end");
    tell(job, counts->unknown, "records of unknown types");
    tell(job, counts->skipped_bytes, "bytes skipped");
    tell(job, job->missing_blobs, "blobs missing");
    tell(job, job->missing_ends, "frames whose end is missing");
    tell(job, job->broken_off, "frames broken off by the robot");
    tell(job, job->missed_lines, "lines missed by the robot");
}

static int listen(struct job *job)
{
    static input in;
    wire_record record;
    int failed = 0;
    if (input_open(&in, job->input)) {
        return -1;
    }
    job->line.in = &in;
    while (!failed && wire_next(&job->line, &record)) {
        failed = hear(job, &record);
    }
    failed = failed || print_rest(job);
    if (!failed && in.read_errno) {
        failed = say_error(job->input, "cannot read on: %s", strerror(in.read_errno)) != 0;
    }
    tell_all(job);
    input_close(&in);
    if (!failed && job->line.counts.records == 0) {
        return say_error(job->input, "holds no valid record");
    }
    return failed ? -1 : 0;
}

static int run(int argc, char **argv)
{
    static struct job job;
    const int status = parse(argc, argv, &job);
    if (status >= 0) {
        return status;
    }
    if (name_classes(&job)) {
        return EXIT_BAD_INPUT;
    }
    if (job.targets) {
        puts("frame,class,name,area,x_q15,y_q15");
    } else {
        report_begin(stdout, job.style);
    }
    const int failed = listen(&job);
    free(job.blobs);
    classes_free(&job.list);
    return failed ? EXIT_BAD_INPUT : EXIT_SUCCESS;
}

const command cmd_listen = {"listen", "print the blobs that a robot sends on a serial line", help,
                            run};
