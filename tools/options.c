#include "options.h"

#include <getopt.h>
#include <stdio.h>
#include <string.h>

#include "say.h"

/* No <ctype.h>: what is a letter must not depend on the user's locale. */
static int lower(int c)
{
    return (c >= 'A' && c <= 'Z') ? c - 'A' + 'a' : c;
}

int options_same_word(const char *a, const char *b)
{
    while (*a != '\0' && lower(*a) == lower(*b)) {
        a++;
        b++;
    }
    return *a == *b;
}

/* Reads decimal digits at *text and moves it past them; -1 if there are none or the number is over
 * max. */
static int take_number(const char **text, unsigned long max, unsigned long *number)
{
    unsigned long value = 0;
    const char *p = *text;

    if (*p < '0' || *p > '9') {
        return -1;
    }
    for (; *p >= '0' && *p <= '9'; p++) {
        unsigned long digit = (unsigned long)(*p - '0');
        if (digit > max || value > (max - digit) / 10) {
            return -1;
        }
        value = value * 10 + digit;
    }
    *text = p;
    *number = value;
    return 0;
}

int options_number(const char *name, const char *word, unsigned long min, unsigned long max,
                   unsigned long *number)
{
    unsigned long value;
    const char *end = word;

    if (take_number(&end, max, &value) || *end != '\0' || value < min) {
        return say_error(NULL, "%s needs a number from %lu to %lu, not '%s'", name, min, max, word);
    }
    *number = value;
    return 0;
}

int options_backend(const char *word, pel_backend *backend)
{
    char list[128] = "";
    for (unsigned b = PEL_BACKEND_AUTO; b < PEL_BACKEND_COUNT; b++) {
        const char *const name = pel_backend_name((pel_backend)b);
        if (!pel_backend_available((pel_backend)b)) {
            continue;
        }
        if (strcmp(word, name) == 0) {
            *backend = (pel_backend)b;
            return 0;
        }
        const size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, " %s", name);
    }
    return say_error(NULL, "no backend '%s' here; there are:%s", word, list);
}

static int unknown_format(const char *word)
{
    char list[512];
    size_t used = 0;
    int format;

    list[0] = '\0';
    for (format = 0; format < PEL_FORMAT_COUNT; format++) {
        int added =
            snprintf(list + used, sizeof list - used, " %s", pel_format_name((pel_format)format));
        if (added < 0 || (size_t)added >= sizeof list - used) {
            break;
        }
        used += (size_t)added;
    }
    return say_error(NULL, "unknown pixel format '%s'; there are:%s", word, list);
}

int options_format(const char *word, pel_format *format)
{
    int i;

    for (i = 0; i < PEL_FORMAT_COUNT; i++) {
        if (options_same_word(word, pel_format_name((pel_format)i))) {
            *format = (pel_format)i;
            return 0;
        }
    }
    return unknown_format(word);
}

int options_size(const char *word, unsigned *width, unsigned *height)
{
    const char *p = word;
    unsigned long w, h;

    if (take_number(&p, PEL_SIDE_MAX, &w) || (*p != 'x' && *p != 'X')) {
        w = 0;
    } else {
        p++;
        if (take_number(&p, PEL_SIDE_MAX, &h) || *p != '\0') {
            h = 0;
        }
    }
    if (w == 0 || h == 0) {
        return say_error(NULL,
                         "'%s' is not a size; write WIDTHxHEIGHT, such as 320x240, "
                         "each side 1 to %d",
                         word, PEL_SIDE_MAX);
    }
    *width = (unsigned)w;
    *height = (unsigned)h;
    return 0;
}

int options_take_box(const char *name, const char *word, options_box *box)
{
    const char *p = word;
    unsigned long edge[4];
    int i, good = 1;

    for (i = 0; i < 4 && good; i++) {
        good = take_number(&p, PEL_SIDE_MAX, &edge[i]) == 0 && *p++ == (i < 3 ? ',' : '\0');
    }
    if (!good || edge[0] >= edge[2] || edge[1] >= edge[3]) {
        return say_error(NULL,
                         "%s needs X0,Y0,X1,Y1 with X0 < X1 and Y0 < Y1, at most %d each, "
                         "not '%s'",
                         name, PEL_SIDE_MAX, word);
    }
    box->x0 = (uint16_t)edge[0];
    box->y0 = (uint16_t)edge[1];
    box->x1 = (uint16_t)edge[2];
    box->y1 = (uint16_t)edge[3];
    return 0;
}

int options_range(const char *word, pel_range *range)
{
    if (options_same_word(word, "full")) {
        *range = PEL_RANGE_FULL;
    } else if (options_same_word(word, "limited")) {
        *range = PEL_RANGE_LIMITED;
    } else {
        return say_error(NULL, "unknown colour range '%s'; there are: full limited", word);
    }
    return 0;
}

int options_check_size(pel_format format, unsigned width, unsigned height)
{
    if (width > PEL_SIDE_MAX || height > PEL_SIDE_MAX ||
        pel_frame_bytes(format, (uint16_t)width, (uint16_t)height) == 0) {
        return say_error(NULL,
                         "%s frames cannot be %ux%u: 4:2:2 needs an even width, 4:2:0 and Bayer "
                         "an even width and height",
                         pel_format_name(format), width, height);
    }
    return 0;
}

/* --raw FORMAT WIDTHxHEIGHT: getopt_long has taken FORMAT only. */
static int take_raw(int argc, char **argv, source_options *options)
{
    pel_format format = PEL_GRAY8;
    unsigned width, height;

    if (options_format(optarg, &format)) {
        return -1;
    }
    if (optind >= argc) {
        return say_error(NULL, "--raw needs two words, FORMAT and WIDTHxHEIGHT, such as "
                               "--raw YUYV 320x240");
    }
    if (options_size(argv[optind], &width, &height) || options_check_size(format, width, height)) {
        return -1;
    }
    optind++;
    options->raw = 1;
    options->format = format;
    options->width = width;
    options->height = height;
    return 0;
}

int options_input(int option, int argc, char **argv, source_options *input)
{
    int status;

    if (option != OPTION_RAW && option != OPTION_RANGE) {
        return 0;
    }
    status =
        option == OPTION_RAW ? take_raw(argc, argv, input) : options_range(optarg, &input->range);
    return status ? -1 : 1;
}
