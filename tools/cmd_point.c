#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "decimal.h"
#include "options.h"
#include "pointops.h"
#include "say.h"
#include "usage.h"
#include "whole.h"

static const char help[] =
    "Usage: pel point OP [WORD]... [OPTION]... IN OUT\n"
    "       pel point --list\n"
    "\n"
    "Changes every pixel by itself (brightness, contrast, gamma, threshold), joins two pictures,\n"
    "resizes, balances colours. OP and its words come first; --list shows them all.\n"
    "\n"
    "Curves work on the red, green and blue of a colour picture alike. What looks at the picture "
    "to\n"
    "find its curve (stretch, equalize) looks at the luma; masks (threshold, otsu, adaptive) and\n"
    "integral are made of the luma, and are gray.\n"
    "\n"
    "Options of one OP\n"
    "      --pivot N|mean       contrast: the gray that stays as it is, default 128\n"
    "      --bilinear           resize: between the four neighbours (default)\n"
    "      --box                resize: the mean of what a pixel covers, by whole factors only\n"
    "      --nearest            resize: one of the pixels, none mixed\n"
    "      --gray-world         white-balance: supposing that the picture is gray on average\n"
    "      --patch X0,Y0,X1,Y1  white-balance: from this box (x0 <= x < x1), gray in truth\n"
    "\n"
    "SECOND is another picture of the same size, or one for each frame of IN; if only one of the "
    "two\n"
    "has colours, the other is made of three equal channels. --raw says what both are.\n"
    "\n"
    "Options\n" OPTIONS_BACKEND_HELP TURN_HELP "\n"
    "Examples\n"
    "  pel point brightness 38 robot.ppm brighter.ppm\n"
    "  pel point brightness -38 robot.ppm darker.ppm\n"
    "  pel point contrast 1.3 --pivot mean robot.ppm stronger.ppm\n"
    "  pel point gamma-brighten 2.2 dark.png visible.png\n"
    "  pel point otsu robot.ppm mask.pgm\n"
    "  pel point adaptive 7 5 page.jpg ink.png\n"
    "  pel point resize 160x120 --box robot.ppm small.ppm\n"
    "  pel point white-balance --patch 20,30,40,50 robot.ppm balanced.ppm\n"
    "  pel point absdiff background.ppm camera.ppm moved.ppm\n"
    "  pel point blend 0.25 second.ppm robot.ppm mixed.ppm\n";

typedef struct operation {
    const char *name, *words, *summary;
    int word_count;
    int (*read)(pointops_job *job, char **words); /* 0, or -1 after a message; may be NULL */
    pointops_step *look, *make;
    plain_kind kind;
    const char *options; /* letters of the options that are its own */
} operation;

/* ---- The words of the operations ----------------------------------------------------------- */

/* A library that refuses what its words say would be a fault of the limits here. */
static int accepted(pel_status status)
{
    return status == PEL_OK ? 0 : say_error("point", "%s", pel_status_name(status));
}

static int read_brightness(pointops_job *job, char **words)
{
    int32_t offset;
    return whole_number("point", "brightness", words[0], -255, 255, &offset)
               ? -1
               : accepted(pel_table_brightness((int16_t)offset, job->table));
}

static int read_contrast(pointops_job *job, char **words)
{
    job->pivot = 128;
    return decimal_milli("point", "contrast", words[0], -100000, 100000, &job->contrast_milli);
}

static int read_linear(pointops_job *job, char **words)
{
    int32_t alpha;
    int32_t beta;
    if (decimal_milli("point", "linear", words[0], -100000, 100000, &alpha) ||
        decimal_milli("point", "linear", words[1], -25500000, 25500000, &beta)) {
        return -1;
    }
    return accepted(pel_table_linear(alpha, beta, 1000, job->table));
}

/* Percent with one decimal. */
static int read_permille(const char *word, uint16_t *permille)
{
    int32_t milli;
    if (decimal_milli("point", "stretch", word, 0, 100000, &milli)) {
        return -1;
    }
    *permille = (uint16_t)((milli + 50) / 100);
    return 0;
}

static int read_stretch(pointops_job *job, char **words)
{
    if (read_permille(words[0], &job->low_permille) ||
        read_permille(words[1], &job->high_permille)) {
        return -1;
    }
    return job->low_permille < job->high_permille
               ? 0
               : say_error("point", "stretch needs LOW under HIGH, not '%s' and '%s'", words[0],
                           words[1]);
}

static int32_t divisor_of(int32_t a, int32_t b)
{
    while (b != 0) {
        const int32_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* "11/5" or "2.2", as a fraction of small numbers. */
static int read_fraction(const char *word, unsigned *numerator, unsigned *denominator)
{
    int32_t n;
    int32_t d = 1000;
    unsigned upper;
    unsigned lower;
    char end;
    if (strlen(word) <= 5 && word[strspn(word, "0123456789/")] == '\0' &&
        sscanf(word, "%u/%u%c", &upper, &lower, &end) == 2) {
        n = (int32_t)upper;
        d = (int32_t)lower;
    } else if (decimal_milli("point", "a gamma", word, 0, 32000, &n)) {
        return -1;
    }
    const int32_t common = n > 0 && d > 0 ? divisor_of(n, d) : 1;
    if (n < 1 || d < 1 || n / common > PEL_GAMMA_TERM_MAX || d / common > PEL_GAMMA_TERM_MAX) {
        return say_error("point",
                         "a gamma is a fraction N/D with numbers from 1 to %d, or a decimal number "
                         "that is one, such as 2.2; not '%s'",
                         PEL_GAMMA_TERM_MAX, word);
    }
    *numerator = (unsigned)(n / common);
    *denominator = (unsigned)(d / common);
    return 0;
}

typedef pel_status gamma_table(unsigned numerator, unsigned denominator, uint8_t table[256]);

static int read_gamma(pointops_job *job, const char *word, gamma_table *make, const char *other)
{
    unsigned numerator = 1;
    unsigned denominator = 1;
    if (read_fraction(word, &numerator, &denominator)) {
        return -1;
    }
    const pel_status status = make(numerator, denominator, job->table);
    if (status == PEL_ERR_RANGE) {
        return say_error("point", "a gamma of %s, under 1, would do the opposite; that is %s", word,
                         other);
    }
    return accepted(status);
}

static int read_brighten(pointops_job *job, char **words)
{
    return read_gamma(job, words[0], pel_table_gamma_brighten, "gamma-darken");
}

static int read_darken(pointops_job *job, char **words)
{
    return read_gamma(job, words[0], pel_table_gamma_darken, "gamma-brighten");
}

static int read_exponent(pointops_job *job, char **words)
{
    return read_gamma(job, words[0], pel_table_gamma_exponent, "");
}

static int read_invert(pointops_job *job, char **words)
{
    (void)words;
    return accepted(pel_table_invert(job->table));
}

static int read_threshold(pointops_job *job, char **words)
{
    int32_t threshold;
    return whole_number("point", "threshold", words[0], 0, 255, &threshold)
               ? -1
               : accepted(pel_table_threshold((uint8_t)threshold, job->table));
}

static int read_adaptive(pointops_job *job, char **words)
{
    int32_t radius;
    int32_t c;
    if (whole_number("point", "adaptive: R", words[0], 1, PEL_ADAPTIVE_RADIUS_MAX, &radius) ||
        whole_number("point", "adaptive: C", words[1], -255, 255, &c)) {
        return -1;
    }
    job->radius = (uint8_t)radius;
    job->c = (int16_t)c;
    return 0;
}

static int read_size(pointops_job *job, char **words)
{
    job->method = PEL_RESIZE_BILINEAR;
    return options_size(words[0], &job->width, &job->height);
}

static int read_second(pointops_job *job, char **words)
{
    job->second = words[0];
    return 0;
}

static int read_blend(pointops_job *job, char **words)
{
    int32_t milli;
    if (decimal_milli("point", "blend: A", words[0], 0, 1000, &milli)) {
        return -1;
    }
    job->alpha_q8 = (uint16_t)((milli * 256 + 500) / 1000);
    job->second = words[1];
    return 0;
}

/* ---- The table ----------------------------------------------------------------------------- */

#define CURVE(name, words, count, read, look, options, summary)                                    \
    {                                                                                              \
        name, words, summary, count, read, look, pointops_table, PLAIN_AS_IT_IS, options           \
    }
#define MASK(name, words, count, read, look, summary)                                              \
    {                                                                                              \
        name, words, summary, count, read, look, pointops_table, PLAIN_GRAY, ""                    \
    }
#define PAIR(name, summary)                                                                        \
    {                                                                                              \
        name, "SECOND", summary, 1, read_second, NULL, pointops_combine, PLAIN_AS_IT_IS, ""        \
    }

static const operation operations[] = {
    CURVE("brightness", "N", 1, read_brightness, NULL, "", "plus N, -255..255"),
    CURVE("contrast", "A", 1, read_contrast, pointops_look_contrast, "p",
          "times A around the gray of --pivot"),
    CURVE("linear", "A B", 2, read_linear, NULL, "", "times A, plus B"),
    CURVE("stretch", "LOW HIGH", 2, read_stretch, pointops_look_stretch, "",
          "contrast such that LOW percent become black, all over HIGH percent white"),
    CURVE("equalize", "", 0, NULL, pointops_look_equalize, "",
          "a curve after which all grays are about as frequent"),
    CURVE("gamma-brighten", "G", 1, read_brighten, NULL, "",
          "exponent 1/G, G = N/D or decimal, at least 1: dark grays become brighter"),
    CURVE("gamma-darken", "G", 1, read_darken, NULL, "",
          "exponent G, at least 1: dark grays become darker"),
    CURVE("gamma-exponent", "E", 1, read_exponent, NULL, "", "exponent E as it stands"),
    CURVE("invert", "", 0, read_invert, NULL, "", "255 minus each"),
    MASK("threshold", "N", 1, read_threshold, NULL, "white where the gray is over N, else black"),
    MASK("otsu", "", 0, NULL, pointops_look_otsu,
         "threshold at the gray that separates dark and bright best"),
    {"adaptive", "R C", "white where the gray is over the mean of the (2R+1)^2 around minus C", 2,
     read_adaptive, NULL, pointops_adaptive, PLAIN_GRAY, ""},
    {"integral", "", "sums from the top left corner on, scaled so that the last is white", 0, NULL,
     NULL, pointops_integral, PLAIN_GRAY, ""},
    {"resize", "WxH", "to a size: --bilinear, --box or --nearest", 1, read_size, NULL,
     pointops_resize, PLAIN_AS_IT_IS, "nxb"},
    {"white-balance", "", "without the tint of the light: --gray-world or --patch", 0, NULL, NULL,
     pointops_balance, PLAIN_RGB, "PW"},
    PAIR("add", "IN + SECOND, at most 255"),
    PAIR("subtract", "IN - SECOND, at least 0"),
    PAIR("absdiff", "|IN - SECOND|"),
    PAIR("min", "the smaller one"),
    PAIR("max", "the larger one"),
    PAIR("and", "bit by bit, as of masks"),
    PAIR("or", "likewise"),
    PAIR("xor", "likewise"),
    {"blend", "A SECOND", "A times IN, 1 - A times SECOND; A = 0..1, in steps of 1/256", 2,
     read_blend, NULL, pointops_blend, PLAIN_AS_IT_IS, ""},
};

enum { OPERATIONS = sizeof operations / sizeof operations[0] };

/* What the pairs do, by name. */
static const struct {
    const char *name;
    pel_combine_op op;
} pairs[] = {
    {"add", PEL_COMBINE_ADD}, {"subtract", PEL_COMBINE_SUBTRACT}, {"absdiff", PEL_COMBINE_ABSDIFF},
    {"min", PEL_COMBINE_MIN}, {"max", PEL_COMBINE_MAX},           {"and", PEL_COMBINE_AND},
    {"or", PEL_COMBINE_OR},   {"xor", PEL_COMBINE_XOR},
};

static int print_list(void)
{
    for (unsigned i = 0; i < OPERATIONS; i++) {
        char usage[40];
        snprintf(usage, sizeof usage, "%s %s", operations[i].name, operations[i].words);
        printf("%-18s %s\n", usage, operations[i].summary);
    }
    return EXIT_SUCCESS;
}

/* ---- The command line ---------------------------------------------------------------------- */

static const operation *find(const char *name)
{
    for (unsigned i = 0; i < OPERATIONS; i++) {
        if (strcmp(operations[i].name, name) == 0) {
            return &operations[i];
        }
    }
    return NULL;
}

static int read_pivot(pointops_job *job)
{
    if (options_same_word(optarg, "mean")) {
        job->pivot = PIVOT_MEAN;
        return 0;
    }
    return whole_number("point", "--pivot", optarg, 0, 255, &job->pivot);
}

/* Takes an option of an operation. */
static int take_own(int option, pointops_job *job)
{
    switch (option) {
    case 'p':
        return read_pivot(job);
    case 'n':
        job->method = PEL_RESIZE_NEAREST;
        return 0;
    case 'x':
        job->method = PEL_RESIZE_BOX;
        return 0;
    case 'b':
        job->method = PEL_RESIZE_BILINEAR;
        return 0;
    case 'P':
        job->has_patch = 1;
        return whole_box("point", "--patch", optarg, job->patch);
    default:
        job->gray_world = 1;
        return 0;
    }
}

static const struct option long_options[] = {{"list", no_argument, NULL, 'l'},
                                             {"pivot", required_argument, NULL, 'p'},
                                             {"nearest", no_argument, NULL, 'n'},
                                             {"box", no_argument, NULL, 'x'},
                                             {"bilinear", no_argument, NULL, 'b'},
                                             {"patch", required_argument, NULL, 'P'},
                                             {"gray-world", no_argument, NULL, 'W'},
                                             OPTIONS_BACKEND,
                                             TURN_OPTIONS};

static int check(const operation *chosen, const pointops_job *job)
{
    if (chosen->make == pointops_balance && job->has_patch == job->gray_world) {
        return usage_error("point", "white-balance needs --gray-world or --patch, one of them");
    }
    if (chosen->make == pointops_balance && job->turn.kind == PLAIN_GRAY) {
        return usage_error("point", "white-balance is of colours: no --gray");
    }
    if (job->second && strcmp(job->second, "-") == 0 && strcmp(job->turn.in, "-") == 0) {
        return usage_error("point", "IN and SECOND cannot both be standard input");
    }
    return -1;
}

/* The options, and IN and OUT, behind the words of the operation. */
static int parse_rest(int argc, char **argv, const operation *chosen, pointops_job *job)
{
    int option;
    int place = 0;
    while ((option = getopt_long(argc, argv, ":h", long_options, &place)) != -1) {
        int status = -1;
        if (option == 'h') {
            fputs(help, stdout);
            return EXIT_SUCCESS;
        }
        if (option == 'l') {
            return print_list();
        }
        if (option == OPTION_BACKEND) {
            status = options_backend(optarg, &job->backend) ? usage_hint("point") : -1;
        } else if (strchr("pnxbPW", option)) {
            if (!chosen || !strchr(chosen->options, option)) {
                return usage_error("point", "'--%s' is no option of %s", long_options[place].name,
                                   chosen ? chosen->name : "its own: the operation comes first");
            }
            status = take_own(option, job) ? usage_hint("point") : -1;
        } else {
            status = turn_option(&job->turn, option, argc, argv);
        }
        if (status >= 0) {
            return status;
        }
    }
    if (!chosen) {
        return usage_error("point", "no operation given, or not as the first word; 'pel point "
                                    "--list' shows them");
    }
    const int status = turn_files(&job->turn, argc, argv);
    return status >= 0 ? status : check(chosen, job);
}

static int parse(int argc, char **argv, pointops_job *job)
{
    const operation *chosen = NULL;
    opterr = 0;
    if (argc < 2 || argv[1][0] == '-') {
        return parse_rest(argc, argv, NULL, job);
    }
    chosen = find(argv[1]);
    if (!chosen) {
        return usage_error("point", "there is no operation '%s'; 'pel point --list' shows them",
                           argv[1]);
    }
    if (argc - 2 > 0 && (strcmp(argv[2], "--help") == 0 || strcmp(argv[2], "-h") == 0)) {
        fputs(help, stdout);
        return EXIT_SUCCESS;
    }
    if (argc - 2 < chosen->word_count) {
        return usage_error("point", "it is: pel point %s %s IN OUT", chosen->name, chosen->words);
    }
    job->turn.kind = chosen->kind;
    job->look = chosen->look;
    job->make = chosen->make;
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        job->combine = strcmp(pairs[i].name, chosen->name) == 0 ? pairs[i].op : job->combine;
    }
    if (chosen->read && chosen->read(job, argv + 2)) {
        return usage_hint("point");
    }
    return parse_rest(argc - 1 - chosen->word_count, argv + 1 + chosen->word_count, chosen, job);
}

static int make(void *user, const char *path, const pel_cview *picture)
{
    pointops_job *job = user;
    return job->make(job, path, picture);
}

static int run(int argc, char **argv)
{
    static pointops_job job;
    job.turn.command = "point";
    job.turn.make = make;
    job.turn.user = &job;
    int status = parse(argc, argv, &job);
    if (status < 0) {
        status = turn_run(&job.turn);
        pointops_free(&job);
    }
    return status;
}

const command cmd_point = {"point", "brightness, contrast, thresholds, resizing, two pictures",
                           help, run};
