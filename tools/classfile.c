#include "classfile.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "input.h"
#include "options.h"
#include "say.h"
#include "sink.h"
#include "tmfile.h"

enum { CLASS_LINE_MAX = 255 }; /* CMVision's line buffer has 256 bytes */

typedef enum section {
    SECTION_NONE, /* before the first header, or under one that is not ours: skipped */
    SECTION_COLORS,
    SECTION_THRESHOLDS
} section;

typedef struct parser {
    input *in;
    classes *list;
    section where;
    int has_range;
    int has_colors, has_thresholds;
    unsigned thresholds;
    unsigned long line;       /* the one that is being read, from 1 */
    unsigned long extra_line; /* of the first threshold that is more than PEL_CLASS_MAX allows */
    unsigned long threshold_line[PEL_CLASS_MAX];
} parser;

static int error_on_line(const parser *p, unsigned long line, const char *what)
{
    return say_error(p->in->path, "line %lu: %s", line, what);
}

/* Reads a line without its end, be it LF or CR LF. 1 a line, 0 the end, -1 after a message. */
static int read_line(parser *p, char line[CLASS_LINE_MAX + 1])
{
    size_t length = 0;
    int c;

    p->line++;
    while ((c = input_get(p->in)) != '\n' && c != EOF) {
        if (c == '\r' && (input_peek(p->in) == '\n' || input_peek(p->in) == EOF)) {
            continue;
        }
        if ((c < ' ' && c != '\t') || c == 127) {
            return error_on_line(p, p->line, "a control character; this is no text file");
        }
        if (length == CLASS_LINE_MAX) {
            return error_on_line(p, p->line, "longer than 255 characters; break it up");
        }
        line[length++] = (char)c;
    }
    line[length] = '\0';
    if (p->in->read_errno) {
        return input_error_byte(p->in, "cannot read on");
    }
    return c != EOF || length > 0;
}

static const char *skip_blanks(const char *text)
{
    while (*text == ' ' || *text == '\t') {
        text++;
    }
    return text;
}

/* Takes a number and the separator behind it; -1 if they are not there. */
static int take_int(const char **text, char separator, long *value)
{
    char *end;
    const char *start = skip_blanks(*text);

    if (strspn(start, "+-0123456789") == 0) {
        return -1;
    }
    *value = strtol(start, &end, 10);
    if (end == start || *skip_blanks(end) != separator) {
        return -1;
    }
    *text = skip_blanks(end) + 1;
    return 0;
}

static int take_merge(const char **text, double *merge)
{
    char *end;
    const char *start = skip_blanks(*text);
    size_t length = strspn(start, "0123456789.+-eE");

    if (length == 0) {
        return -1;
    }
    *merge = strtod(start, &end);
    if (end != start + length || !(*merge >= 0 && *merge <= 1e6)) {
        return -1;
    }
    *text = end;
    return 0;
}

static int take_expected(const char **text, int *expected)
{
    char *end;
    const char *start = skip_blanks(*text);
    long value;

    if (*start < '0' || *start > '9') {
        return -1;
    }
    value = strtol(start, &end, 10);
    if (value > 1000000 || (*end != ' ' && *end != '\t' && *end != '\0')) {
        return -1;
    }
    *expected = (int)value;
    *text = end;
    return 0;
}

/* The name is one word; CMVision ignores what comes after it, and so do we. */
static int take_name(const parser *p, const char *text, char name[CLASS_NAME_MAX + 1])
{
    const char *start = skip_blanks(text);
    size_t length = strcspn(start, " \t");

    if (length == 0) {
        return error_on_line(p, p->line,
                             "the colour has no name; write it behind the expected number");
    }
    if (length > CLASS_NAME_MAX) {
        return error_on_line(p, p->line, "the name is longer than 63 characters; shorten it");
    }
    memcpy(name, start, length);
    name[length] = '\0';
    return 0;
}

static int check_bytes(const parser *p, const long *values, unsigned count)
{
    unsigned i;

    for (i = 0; i < count; i++) {
        if (values[i] < 0 || values[i] > 255) {
            return say_error(p->in->path, "line %lu: %ld is out of range, write 0 to 255", p->line,
                             values[i]);
        }
    }
    return 0;
}

static int parse_color(parser *p, const char *text)
{
    class_entry *entry = &p->list->entry[p->list->count];
    long rgb[3];

    if (p->list->count == PEL_CLASS_MAX) {
        return say_error(p->in->path,
                         "line %lu: this program was built for at most %d classes; remove "
                         "some or build it with a larger PEL_CLASS_MAX",
                         p->line, PEL_CLASS_MAX);
    }
    text++;
    if (take_int(&text, ',', &rgb[0]) || take_int(&text, ',', &rgb[1]) ||
        take_int(&text, ')', &rgb[2])) {
        return error_on_line(p, p->line,
                             "a colour reads '(RED,GREEN,BLUE) MERGE EXPECTED NAME', such as "
                             "'(255,128,0) 0.5 10 orange'");
    }
    if (check_bytes(p, rgb, 3)) {
        return -1;
    }
    if (take_merge(&text, &entry->merge)) {
        return error_on_line(p, p->line,
                             "the merge density must be a number from 0 on, such as 0.5");
    }
    if (take_expected(&text, &entry->expected)) {
        return error_on_line(p, p->line, "the expected number of blobs must be 0 to 1000000");
    }
    if (take_name(p, text, entry->name)) {
        return -1;
    }
    entry->red = (uint8_t)rgb[0];
    entry->green = (uint8_t)rgb[1];
    entry->blue = (uint8_t)rgb[2];
    p->list->count++;
    return 0;
}

static int parse_threshold(parser *p, const char *text)
{
    static const char separators[] = {':', ',', ':', ',', ':', ')'};
    long v[6];
    unsigned i;

    text++;
    for (i = 0; i < 6; i++) {
        if (take_int(&text, separators[i], &v[i])) {
            return error_on_line(p, p->line,
                                 "thresholds read '(YMIN:YMAX,UMIN:UMAX,VMIN:VMAX)', such as "
                                 "'(40:200,90:120,150:200)'");
        }
    }
    if (check_bytes(p, v, 6)) {
        return -1;
    }
    if (v[0] > v[1] || v[2] > v[3] || v[4] > v[5]) {
        return error_on_line(p, p->line, "a minimum is over its maximum; no colour is within");
    }
    if (p->thresholds < PEL_CLASS_MAX) {
        const pel_color_box box = {(uint8_t)v[0], (uint8_t)v[1], (uint8_t)v[2],
                                   (uint8_t)v[3], (uint8_t)v[4], (uint8_t)v[5]};
        p->list->entry[p->thresholds].box = box;
        p->threshold_line[p->thresholds] = p->line;
    } else if (p->extra_line == 0) {
        p->extra_line = p->line;
    }
    p->thresholds++;
    return 0;
}

static int parse_header(parser *p, const char *text)
{
    char name[CLASS_LINE_MAX + 1] = "";
    int *seen;

    sscanf(text, "%255s", name);
    if (options_same_word(name, "[colors]")) {
        p->where = SECTION_COLORS;
        seen = &p->has_colors;
    } else if (options_same_word(name, "[thresholds]")) {
        p->where = SECTION_THRESHOLDS;
        seen = &p->has_thresholds;
    } else {
        p->where = SECTION_NONE;
        return 0;
    }
    if (*seen) {
        return error_on_line(p, p->line, "this section is there a second time; join the two");
    }
    *seen = 1;
    return 0;
}

static int parse_range(parser *p, const char *word)
{
    pel_range range;

    if (p->has_range) {
        return error_on_line(p, p->line, "the colour range is given a second time; keep one");
    }
    if (strcmp(word, "full") == 0) {
        range = PEL_RANGE_FULL;
    } else if (strcmp(word, "limited") == 0) {
        range = PEL_RANGE_LIMITED;
    } else {
        return say_error(p->in->path,
                         "line %lu: unknown colour range '%s'; there are: full limited", p->line,
                         word);
    }
    p->list->range = range;
    p->has_range = 1;
    return 0;
}

/* "#! range full": what CMVision does not know. */
static int parse_addition(parser *p, const char *text)
{
    char keyword[CLASS_LINE_MAX + 1] = "", word[CLASS_LINE_MAX + 1] = "";

    sscanf(text + 2, "%255s %255s", keyword, word);
    if (strcmp(keyword, "range") != 0) {
        return say_error(p->in->path,
                         "line %lu: '#!' is followed by 'range full' or 'range limited', "
                         "not '%s'; begin comments with '#' alone",
                         p->line, keyword);
    }
    return parse_range(p, word);
}

/*
 * CMVision looks for a header, then takes entries until the first line that is none; comments and
 * blank lines between entries end the section there. We read on, so every file that CMVision reads
 * whole means the same to us. What we write has comments only where CMVision looks for headers.
 */
static int parse_line(parser *p, const char *line)
{
    const char *text = skip_blanks(line);

    if (text[0] == '#') {
        return text[1] == '!' ? parse_addition(p, text) : 0;
    }
    if (text[0] == '[') {
        return parse_header(p, text);
    }
    if (text[0] == '\0' || p->where == SECTION_NONE) {
        return 0;
    }
    if (text[0] != '(') {
        return error_on_line(p, p->line,
                             "neither an entry '(...)' nor a section '[...]'; begin comments "
                             "with '#'");
    }
    return p->where == SECTION_COLORS ? parse_color(p, text) : parse_threshold(p, text);
}

static int check_whole(const parser *p)
{
    const classes *list = p->list;

    if (!p->has_colors || list->count == 0) {
        return say_error(p->in->path, p->has_colors
                                          ? "[Colors] has no entry; add one line for each class"
                                          : "there is no section [Colors]; is this a class file?");
    }
    if (!p->has_thresholds) {
        return say_error(p->in->path,
                         "there is no section [Thresholds]; add it with one line for each "
                         "of the %u colours",
                         list->count);
    }
    if (p->thresholds < list->count) {
        return say_error(p->in->path,
                         "colour '%s' has no thresholds: [Colors] has %u entries, "
                         "[Thresholds] %u",
                         list->entry[p->thresholds].name, list->count, p->thresholds);
    }
    if (p->thresholds > list->count) {
        unsigned long line =
            list->count < PEL_CLASS_MAX ? p->threshold_line[list->count] : p->extra_line;
        return error_on_line(p, line, "these thresholds have no colour; add one to [Colors]");
    }
    return 0;
}

static int read_text(input *in, classes *list)
{
    parser p = {0};
    char line[CLASS_LINE_MAX + 1];
    int status;
    unsigned i;

    p.in = in;
    p.list = list;
    while ((status = read_line(&p, line)) > 0) {
        if (parse_line(&p, line)) {
            return -1;
        }
    }
    if (status < 0 || check_whole(&p)) {
        return -1;
    }
    for (i = 0; i < list->count; i++) {
        pel_boxes_set(&list->boxes, i, &list->entry[i].box);
    }
    list->classifier.boxes = &list->boxes;
    list->classifier.reader = pel_crow_read_yuv;
    list->classifier.pieces = pel_classify_pieces;
    list->classifier.range = list->range;
    return 0;
}

void classes_choose_backend(classes *list, pel_backend backend)
{
    if (list->classifier.boxes &&
        pel_classify_plan_make(&list->plan, &list->boxes, backend) >= PEL_OK) {
        list->classifier.plan = &list->plan;
    }
}

static int read_any(input *in, classes *list)
{
    uint8_t start[4];
    size_t count = input_look(in, start, sizeof start);

    memset(list, 0, sizeof *list);
    if (count == 0) {
        return input_error_byte(in, "the file is empty");
    }
    return tmfile_matches(start, count) ? tmfile_read(in, list) : read_text(in, list);
}

int classes_read_stream(FILE *stream, const char *name, classes *list)
{
    input in;
    int status;

    input_attach(&in, stream, name);
    status = read_any(&in, list);
    input_close(&in);
    if (status) {
        classes_free(list);
    }
    return status;
}

int classes_read(const char *path, classes *list)
{
    FILE *stream = strcmp(path, "-") == 0 ? stdin : fopen(path, "rb");

    if (!stream) {
        memset(list, 0, sizeof *list);
        return say_error(path, "cannot open: %s", strerror(errno));
    }
    return classes_read_stream(stream, path, list);
}

static int check_writable(const char *path, const classes *list)
{
    unsigned i;

    if (list->cells) {
        return say_error(path,
                         "classes of a table cannot be written as thresholds; write a .tm table");
    }
    for (i = 0; i < list->count; i++) {
        const char *name = list->entry[i].name;
        if (name[0] == '\0' || name[strcspn(name, " \t\r\n")] != '\0') {
            return say_error(path, "the name '%s' cannot be written; it must be one word", name);
        }
    }
    return 0;
}

/* Four decimals as CMVision writes them, or as many as it takes to read the same number again. */
static void write_merge(FILE *file, double merge)
{
    char text[40];

    snprintf(text, sizeof text, "%6.4f", merge);
    if (strtod(text, NULL) < merge || strtod(text, NULL) > merge) {
        snprintf(text, sizeof text, "%.17g", merge);
    }
    fputs(text, file);
}

int classes_write(const char *path, const classes *list)
{
    FILE *file;
    unsigned i;

    if (check_writable(path, list) || !(file = sink_open_file(path))) {
        return -1;
    }
    fprintf(file, "#! range %s\n\n[Colors]\n", list->range == PEL_RANGE_FULL ? "full" : "limited");
    for (i = 0; i < list->count; i++) {
        const class_entry *entry = &list->entry[i];
        fprintf(file, "(%3d,%3d,%3d) ", entry->red, entry->green, entry->blue);
        write_merge(file, entry->merge);
        fprintf(file, " %d %s\n", entry->expected, entry->name);
    }
    fputs("\n[Thresholds]\n", file);
    for (i = 0; i < list->count; i++) {
        const pel_color_box *box = &list->entry[i].box;
        fprintf(file, "(%3d:%3d,%3d:%3d,%3d:%3d)\n", box->y_min, box->y_max, box->u_min, box->u_max,
                box->v_min, box->v_max);
    }
    return sink_close_file(file, path, 0);
}

void classes_free(classes *list)
{
    free(list->cells);
    memset(list, 0, sizeof *list);
}
