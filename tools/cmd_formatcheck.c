#include <getopt.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "contact.h"
#include "input.h"
#include "jpegfile.h"
#include "options.h"
#include "pack.h"
#include "pnm.h"
#include "report.h"
#include "say.h"
#include "sink.h"
#include "usage.h"
#include "verdict.h"
#include "y4m.h"

static const char help[] =
    "Usage: pel formatcheck [OPTION]... FILE\n"
    "\n"
    "Says what a raw frame is: its pixel format, the order of its bytes and its size. The\n"
    "bytes of FILE ('-': standard input) are read in every way that their number allows, and\n"
    "the way is chosen in which neighbours are most alike.\n"
    "\n"
    "      --size WxH       the size of a frame; without it, sizes are guessed from the number\n"
    "                       of bytes\n"
    "      --stride BYTES   from one row to the next, if rows are padded (needs --size; without\n"
    "                       it, a padding that fits the number of bytes is found)\n"
    "      --frames N       how many frames the file holds; default: as many as fit --size, or\n"
    "                       one\n"
    "      --best N         show the N best only, default 12\n"
    "      --csv            a line per way, the best first; the first line names the columns:\n"
    "                       rank,format,width,height,bytes_per_line,frames,bits_per_byte,\n"
    "                       impossible_percent (empty without U and V),fits (1 or 0)\n"
    "  -o SHEET             all of them as one picture with labels, .ppm, .pgm or .png ('-':\n"
    "                       PPM on standard output in place of the list); those that fit have\n"
    "                       a green frame\n"
    "\n"
    "How it decides: bits_per_byte is what remains of a byte after it was predicted by the\n"
    "sample to its left and the one above, in the same channel: log2(1 + 2 |rest|). The right\n"
    "way has the least; taking U for Y, or the end of a row for the next row, costs bits. Ways\n"
    "within half a percent of the least are told apart by colours that cannot be: U and V in the\n"
    "wrong order make a red or a green below 0 or over 255. Then common sizes go before odd\n"
    "ones.\n"
    "\n"
    "It says so if it cannot tell. RGB888 and BGR888, and a Bayer mosaic that begins with red\n"
    "or with blue, differ by red and blue changing places, and so do YUYV and YVYU in a picture\n"
    "with little colour: look at the sheet. NV21 and YV12 are NV12 and I420 with V before U;\n"
    "pel does not read them.\n"
    "\n"
    "Examples\n"
    "  pel formatcheck --size 640x480 -o sheet.png frame.raw\n"
    "  pel formatcheck frame.raw\n"
    "  pel formatcheck --csv --best 1 - < frame.raw\n";

/* Of long recordings the beginning is enough. */
enum { FRAMES_JUDGED = 3 };
static const size_t bytes_max = (size_t)256 << 20;

struct job {
    reading_facts facts;
    unsigned long best;
    int csv;
    const char *path, *sheet;
    uint8_t *bytes;
    size_t count; /* of those kept; facts.bytes are all */
    candidate *list;
    size_t candidates;
    verdict answer;
};

/* ---- The command line ---------------------------------------------------------------------- */

static int take_number(const char *name, unsigned long max, unsigned long *number)
{
    return options_number(name, optarg, 1, max, number);
}

static int take_option(int option, struct job *job)
{
    unsigned long number = 0;
    int status = 0;
    switch (option) {
    case 's':
        return options_size(optarg, &job->facts.width, &job->facts.height);
    case 't':
        status = take_number("--stride", 4 * (unsigned long)PEL_SIDE_MAX, &number);
        job->facts.line_bytes = (uint32_t)number;
        return status;
    case 'f':
        return take_number("--frames", 1000000, &job->facts.frames);
    default:
        return take_number("--best", READINGS_MAX, &job->best);
    }
}

/* Reads the command line: -1 to go on, or an exit status. */
static int parse(int argc, char **argv, struct job *job)
{
    static const struct option known[] = {
        {"size", required_argument, NULL, 's'},
        {"stride", required_argument, NULL, 't'},
        {"frames", required_argument, NULL, 'f'},
        {"best", required_argument, NULL, 'b'},
        {"csv", no_argument, NULL, 'v'},
        {"help", no_argument, NULL, 'h'},
        {NULL, 0, NULL, 0},
    };
    int option;
    opterr = 0;
    while ((option = getopt_long(argc, argv, ":o:h", known, NULL)) != -1) {
        switch (option) {
        case 'h':
            fputs(help, stdout);
            return EXIT_SUCCESS;
        case 'o':
            job->sheet = optarg;
            break;
        case 'v':
            job->csv = 1;
            break;
        case '?':
        case ':':
            return usage_bad_option("formatcheck", option, argv);
        default:
            if (take_option(option, job)) {
                return usage_hint("formatcheck");
            }
        }
    }
    return -1;
}

static int check(int argc, char **argv, struct job *job)
{
    if (argc - optind != 1) {
        return usage_error("formatcheck", "one FILE wanted");
    }
    job->path = argv[optind];
    if (job->facts.line_bytes && !job->facts.width) {
        return usage_error("formatcheck", "--stride needs --size, too");
    }
    if (job->sheet && strcmp(job->sheet, "-") == 0 && job->csv) {
        return usage_error("formatcheck",
                           "standard output cannot take both the list and the sheet");
    }
    return job->sheet && sink_check_picture(job->sheet) ? usage_hint("formatcheck") : -1;
}

/* ---- Reading ------------------------------------------------------------------------------- */

/* A file with a header says what it is: 0, or -1 after a message. */
static int check_raw(input *in)
{
    uint8_t start[INPUT_LOOK_MAX];
    const size_t count = input_look(in, start, sizeof start);
    const char *name = NULL;
    if (jpegfile_matches(start, count)) {
        name = "a JPEG (so are the frames of an MJPEG camera)";
    } else if (pngfile_matches(start, count)) {
        name = "a PNG";
    } else if (y4m_matches(start, count)) {
        name = "a YUV4MPEG2 video";
    } else if (count >= 3 && pnm_matches(start, count) && start[2] <= ' ') {
        name = "a PPM or PGM";
    }
    return name ? say_error(in->path, "is no raw frame, it is %s: pel convert reads it", name) : 0;
}

static int read_all(input *in, struct job *job)
{
    size_t room = 0;
    for (;;) {
        size_t count;
        const uint8_t *window = input_window(in, &count);
        if (count == 0) {
            break;
        }
        job->facts.bytes += count;
        if (job->count + count > room && room < bytes_max) {
            room = room ? 2 * room : 1 << 20;
            uint8_t *larger = realloc(job->bytes, room);
            if (!larger) {
                return say_error(in->path, "out of memory");
            }
            job->bytes = larger;
        }
        const size_t keep = count < room - job->count ? count : room - job->count;
        memcpy(job->bytes + job->count, window, keep);
        job->count += keep;
        input_skip(in, count);
    }
    if (in->read_errno || job->facts.bytes == 0) {
        return input_error_byte(in, "the file is empty");
    }
    return 0;
}

static int read_file(struct job *job)
{
    static input in;
    if (input_open(&in, job->path)) {
        return -1;
    }
    const int status = check_raw(&in) || read_all(&in, job) ? -1 : 0;
    input_close(&in);
    return status;
}

/* ---- Judging ------------------------------------------------------------------------------- */

static int judge(const struct job *job, candidate *one, frame *scratch)
{
    for (unsigned long i = 0; i < one->how.frames && i < FRAMES_JUDGED; i++) {
        if ((size_t)(i + 1) * one->how.frame_bytes > job->count) {
            break;
        }
        if (reading_frame(&one->how, job->bytes, i, scratch)) {
            return say_error(job->path, "out of memory");
        }
        const pel_cview view = pel_view_to_read(&scratch->view);
        if (fit_add(&one->fit, &view)) {
            return say_error(job->path, "out of memory");
        }
    }
    one->milli_bits = fit_milli_bits(&one->fit);
    return 0;
}

static int nothing_fits(const struct job *job)
{
    const reading_facts *facts = &job->facts;
    if (facts->width) {
        const uint64_t centi = facts->bytes * 100 / ((uint64_t)facts->width * facts->height);
        return say_error(job->path,
                         "%" PRIu64 " bytes are %" PRIu64 ".%02" PRIu64 " per pixel of %ux%u: no "
                         "format of pel has that; is the file cut short, or the size another?",
                         facts->bytes, centi / 100, centi % 100, facts->width, facts->height);
    }
    return say_error(job->path,
                     "%" PRIu64 " bytes make no frame of any size and format; is the file cut "
                     "short? --size WxH allows for padded rows, too",
                     facts->bytes);
}

static int judge_all(struct job *job)
{
    reading *ways = malloc(READINGS_MAX * sizeof *ways);
    frame scratch = {0};
    int status = 0;
    job->list = calloc(READINGS_MAX, sizeof *job->list);
    if (!ways || !job->list) {
        free(ways);
        return say_error(job->path, "out of memory");
    }
    job->candidates = reading_list(&job->facts, ways);
    for (size_t i = 0; i < job->candidates && status == 0; i++) {
        job->list[i].how = ways[i];
        status = judge(job, &job->list[i], &scratch);
    }
    frame_free(&scratch);
    free(ways);
    if (status == 0 && job->candidates == 0) {
        return nothing_fits(job);
    }
    if (status == 0) {
        job->answer = verdict_reach(job->list, job->candidates);
    }
    return status;
}

/* ---- The list ------------------------------------------------------------------------------ */

static uint64_t impossible_permille(const candidate *one)
{
    return one->fit.colors ? one->fit.impossible[0] * 1000 / one->fit.colors : 0;
}

static void print_csv(const struct job *job)
{
    puts("rank,format,width,height,bytes_per_line,frames,bits_per_byte,impossible_percent,fits");
    for (size_t i = 0; i < job->candidates && i < job->best; i++) {
        const candidate *one = &job->list[i];
        printf("%zu,%s,%u,%u,%" PRIu32 ",%lu,", i + 1, reading_name(&one->how), one->how.width,
               one->how.height, one->how.line_bytes, one->how.frames);
        report_ratio(stdout, one->milli_bits, 1000);
        fputc(',', stdout);
        if (one->fit.colors) {
            report_ratio(stdout, 100 * one->fit.impossible[0], one->fit.colors);
        }
        printf(",%d\n", i < job->answer.equal);
    }
}

static void print_table(const struct job *job)
{
    printf("%s: %" PRIu64 " bytes, %zu way%s to read them\n"
           "     format         size     line  frames  bits/byte  impossible colours\n",
           strcmp(job->path, "-") == 0 ? "standard input" : job->path, job->facts.bytes,
           job->candidates, job->candidates == 1 ? "" : "s");
    for (size_t i = 0; i < job->candidates && i < job->best; i++) {
        const candidate *one = &job->list[i];
        char size[24];
        snprintf(size, sizeof size, "%ux%u", one->how.width, one->how.height);
        printf("  %c  %-12s %-9s %5" PRIu32 " %7lu %6" PRIu32 ".%03" PRIu32,
               i < job->answer.equal ? '*' : ' ', reading_name(&one->how), size,
               one->how.line_bytes, one->how.frames, one->milli_bits / 1000,
               one->milli_bits % 1000);
        if (one->fit.colors) {
            printf("  %7" PRIu64 ".%" PRIu64 " %%", impossible_permille(one) / 10,
                   impossible_permille(one) % 10);
        }
        putchar('\n');
    }
}

static const char *percent(const candidate *one, int range)
{
    static char text[24];
    const uint64_t hundredths =
        one->fit.colors ? one->fit.impossible[range] * 10000 / one->fit.colors : 0;
    snprintf(text, sizeof text, "%" PRIu64 ".%02" PRIu64 " %%", hundredths / 100, hundredths % 100);
    return text;
}

static void print_names(const struct job *job, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const reading *how = &job->list[i].how;
        printf("%s%s %ux%u",
               i == 0          ? ""
               : i + 1 < count ? ", "
                               : " or ",
               reading_name(how), how->width, how->height);
    }
    if (count < job->answer.equal) {
        printf(" and %zu more", job->answer.equal - count);
    }
}

static void print_next(const candidate *best, const candidate *next)
{
    printf("  neighbours are most alike: %" PRIu32 ".%03" PRIu32 " bits per byte; ",
           best->milli_bits / 1000, best->milli_bits % 1000);
    printf("%s %ux%u, the next, leaves %" PRIu32 ".%03" PRIu32 "\n", reading_name(&next->how),
           next->how.width, next->how.height, next->milli_bits / 1000, next->milli_bits % 1000);
}

static void print_colors(const candidate *best, const candidate *rival)
{
    const int range = verdict_disproof(rival, best) == 1;
    printf("  as %s, %s of the colours would lie outside of RGB", reading_name(&rival->how),
           percent(rival, range));
    printf("; as %s %s do%s\n", reading_name(&best->how), percent(best, range),
           range ? " (if of limited range)" : "");
}

static void print_why(const struct job *job)
{
    const candidate *best = &job->list[0];
    const candidate *rival = &job->list[job->answer.rival];
    if (job->answer.next > 0 && job->answer.reason != VERDICT_FLAT) {
        print_next(best, &job->list[job->answer.next]);
    }
    switch (job->answer.reason) {
    case VERDICT_ONLY:
        printf("  nothing else has that many bytes\n");
        break;
    case VERDICT_NEIGHBOURS:
        break;
    case VERDICT_COLORS:
        print_colors(best, rival);
        break;
    case VERDICT_SIZE:
        printf("  %s %ux%u fits alike, but no camera has that size\n", reading_name(&rival->how),
               rival->how.width, rival->how.height);
        break;
    case VERDICT_SWAPPED:
        printf("  they differ by red and blue (or U and V) changing places, and no colour in it "
               "proves which\n  is right: look at both (-o SHEET)\n");
        break;
    case VERDICT_FLAT:
        printf("  there is too little in the picture: point the camera at something with edges and "
               "colours\n");
        break;
    case VERDICT_NOISE:
        printf(
            "  neighbours are not alike in any reading: noise, compressed data, or a size that was "
            "not tried\n");
        break;
    case VERDICT_UNCLEAR:
        printf("  they fit alike: look at them (-o SHEET)%s\n",
               job->facts.width ? "" : ", or say --size WxH");
        break;
    }
}

static const char *print_range(const candidate *best)
{
    switch (verdict_judge_range(&best->fit)) {
    case VERDICT_FULL_BEYOND:
        printf("  full range: luma %u to %u, limited range ends at 16 and 235\n",
               (unsigned)best->fit.luma_min, (unsigned)best->fit.luma_max);
        return "full";
    case VERDICT_FULL_COLORS:
        puts("  full range: the limited range would make colours outside of RGB");
        return "full";
    case VERDICT_LIMITED:
        puts("  limited range: luma ends at 16 and 235");
        return "limited";
    default:
        printf("  range: cannot tell, luma goes from %u to %u only; most YUYV cameras send limited "
               "range\n",
               (unsigned)best->fit.luma_min, (unsigned)best->fit.luma_max);
        return NULL;
    }
}

static void print_notes(const struct job *job)
{
    const candidate *best = &job->list[0];
    const reading *how = &best->how;
    const uint32_t row_bytes = pel_row_bytes(how->format, (uint16_t)how->width);
    const char *range = pack_has_range(how->format) ? print_range(best) : NULL;
    if (job->answer.equal > 1) {
        return;
    }
    if (how->format == PEL_GRAY8) {
        puts("  a Bayer mosaic of things without colour looks the same");
    }
    if (how->line_bytes > row_bytes) {
        printf("  each row has %" PRIu32 " bytes of pixels and %" PRIu32 " of padding\n", row_bytes,
               how->line_bytes - row_bytes);
    } else if (how->swapped) {
        printf("  pel does not read it: swap its U and V, then it is %s\n",
               pel_format_name(how->format));
    } else {
        printf("  pel convert --raw %s %ux%u%s%s IN OUT.png\n", pel_format_name(how->format),
               how->width, how->height, range ? " --range " : "", range ? range : "");
    }
}

static void print_verdict(const struct job *job)
{
    enum { NAMES_MAX = 4 };
    const size_t equal = job->answer.equal;
    fputs(equal == 1 ? "best: " : equal > 1 ? "cannot tell: " : "nothing fits", stdout);
    print_names(job, equal < NAMES_MAX ? equal : NAMES_MAX);
    putchar('\n');
    print_why(job);
    if (equal == 1 || job->answer.reason == VERDICT_SWAPPED) {
        print_notes(job);
    }
}

/* ---- The sheet ----------------------------------------------------------------------------- */

static int fill_cell(const struct job *job, size_t i, frame *scratch, contact_cell *cell)
{
    const candidate *one = &job->list[i];
    if (reading_frame(&one->how, job->bytes, 0, scratch)) {
        return say_error(job->path, "out of memory");
    }
    pel_cview view = pel_view_to_read(&scratch->view);
    if (pack_has_range(view.format) && verdict_judge_range(&one->fit) == VERDICT_LIMITED) {
        view.range = PEL_RANGE_LIMITED;
    }
    cell->marked = i < job->answer.equal;
    snprintf(cell->text[0], CONTACT_TEXT, "%zu %s %ux%u", i + 1, reading_name(&one->how),
             one->how.width, one->how.height);
    snprintf(cell->text[1], CONTACT_TEXT, "%" PRIu32 ".%03" PRIu32 " bits/byte%s%s",
             one->milli_bits / 1000, one->milli_bits % 1000, one->fit.colors ? "  wrong " : "",
             one->fit.colors ? percent(one, 0) : "");
    return contact_shrink(job->path, &view, cell);
}

static int write_sheet(const struct job *job)
{
    const size_t count = job->candidates < job->best ? job->candidates : job->best;
    contact_cell *cells = calloc(count, sizeof *cells);
    frame scratch = {0};
    int status = cells ? 0 : say_error(job->path, "out of memory");
    for (size_t i = 0; i < count && status == 0; i++) {
        status = fill_cell(job, i, &scratch, &cells[i]);
    }
    if (status == 0) {
        status = contact_write(job->sheet, cells, count, NULL);
    }
    for (size_t i = 0; cells && i < count; i++) {
        frame_free(&cells[i].picture);
    }
    free(cells);
    frame_free(&scratch);
    return status;
}

static int check_formats(struct job *job)
{
    if (read_file(job) || judge_all(job)) {
        return -1;
    }
    if (job->csv) {
        print_csv(job);
    } else if (!job->sheet || strcmp(job->sheet, "-") != 0) {
        print_table(job);
        print_verdict(job);
    }
    return job->sheet ? write_sheet(job) : 0;
}

static int run(int argc, char **argv)
{
    struct job job = {0};
    job.best = 12;
    int status = parse(argc, argv, &job);
    if (status < 0) {
        status = check(argc, argv, &job);
    }
    if (status >= 0) {
        return status;
    }
    const int failed = check_formats(&job);
    free(job.bytes);
    free(job.list);
    return failed ? EXIT_BAD_INPUT : EXIT_SUCCESS;
}

const command cmd_formatcheck = {"formatcheck", "say what format and size a raw frame has", help,
                                 run};
