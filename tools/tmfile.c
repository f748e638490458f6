#include "tmfile.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "say.h"
#include "sink.h"

enum { HEADER_LINE_MAX = 40, WRITTEN_Y_BITS = 4, WRITTEN_UV_BITS = 6 };

int tmfile_matches(const uint8_t *bytes, size_t count)
{
    return count >= 4 && memcmp(bytes, "TMAP", 4) == 0;
}

static int read_line(input *in, char line[HEADER_LINE_MAX + 1])
{
    size_t length = 0;
    int c;

    while ((c = input_get(in)) != '\n') {
        if (c == EOF) {
            return input_error_byte(in, "the file is cut short within the header");
        }
        if (length == HEADER_LINE_MAX || c == '\0') {
            return input_error_byte(in, "the header must be three lines: 'TMAP', 'YUV8' and three "
                                        "sizes such as '16 64 64'");
        }
        line[length++] = (char)c;
    }
    line[length] = '\0';
    return 0;
}

/* The number of bits of a size that is a power of two, 1..256. */
static int take_bits(const char **text, uint8_t *bits)
{
    char *end;
    long size = strtol(*text, &end, 10);
    uint8_t n = 0;

    if (end == *text) {
        return -1;
    }
    while (n < 8 && (1L << n) < size) {
        n++;
    }
    *text = end;
    *bits = n;
    return (1L << n) == size ? 0 : -1;
}

static int read_header(input *in, pel_lut *lut)
{
    char line[HEADER_LINE_MAX + 1];
    const char *p = line;

    if (read_line(in, line)) {
        return -1;
    }
    if (strcmp(line, "TMAP") != 0) {
        return input_error_byte(in, "the first line must be 'TMAP'");
    }
    if (read_line(in, line)) {
        return -1;
    }
    if (strcmp(line, "YUV8") != 0) {
        return input_error_byte(in, "the table is of kind '%s'; only YUV8 is read", line);
    }
    if (read_line(in, line)) {
        return -1;
    }
    if (take_bits(&p, &lut->y_bits) || take_bits(&p, &lut->u_bits) || take_bits(&p, &lut->v_bits) ||
        *p != '\0') {
        return input_error_byte(in,
                                "the sizes are '%s'; they must be three powers of two, 1 to 256, "
                                "such as '16 64 64'",
                                line);
    }
    return 0;
}

/* Made-up display colours: the six saturated ones and white, then the same darker. */
static void name_class(class_entry *entry, unsigned index)
{
    static const uint8_t levels[] = {255, 176, 120, 80, 48};
    uint8_t level = levels[index / 7];
    unsigned bits = index % 7 + 1;

    snprintf(entry->name, sizeof entry->name, "class%u", index);
    entry->red = bits & 1 ? level : 0;
    entry->green = bits & 2 ? level : 0;
    entry->blue = bits & 4 ? level : 0;
}

static int check_labels(const input *in, const uint8_t *cells, size_t count, unsigned *highest)
{
    size_t i;

    *highest = 0;
    for (i = 0; i < count; i++) {
        if (cells[i] > PEL_CLASS_MAX) {
            return say_error(in->path,
                             "cell %zu has label %u, but this program was built for at most "
                             "%d classes; build it with a larger PEL_CLASS_MAX",
                             i, cells[i], PEL_CLASS_MAX);
        }
        if (cells[i] > *highest) {
            *highest = cells[i];
        }
    }
    return *highest > 0 ? 0
                        : say_error(in->path, "every label of the table is 0: there is no class");
}

static int read_cells(input *in, classes *list, const pel_lut *lut)
{
    size_t count = pel_lut_bytes(lut->y_bits, lut->u_bits, lut->v_bits);
    size_t got;

    list->cells = malloc(count);
    if (!list->cells) {
        return say_error(in->path, "not enough memory for %zu cells", count);
    }
    got = input_read(in, list->cells, count);
    if (got != count) {
        return input_error_byte(in, "the file is cut short: %zu of %zu cells", got, count);
    }
    if (!input_at_end(in)) {
        return input_error_byte(in, "there is something behind the %zu cells", count);
    }
    return check_labels(in, list->cells, count, &list->count);
}

int tmfile_read(input *in, classes *list)
{
    pel_lut lut = {0};
    unsigned i;

    if (read_header(in, &lut) || read_cells(in, list, &lut)) {
        return -1;
    }
    lut.cell = list->cells;
    list->classifier.lut = lut;
    list->classifier.reader = pel_crow_read_yuv;
    list->classifier.pieces = pel_classify_pieces;
    for (i = 0; i < list->count; i++) {
        name_class(&list->entry[i], i);
    }
    return 0;
}

/* Full-range luma, and chroma, as limited range has them; rounded, halves upward. */
static unsigned limited_luma(unsigned y)
{
    return 16 + (2 * 219 * y + 255) / 510;
}

static unsigned limited_chroma(unsigned c)
{
    /* 128 + 224 (c - 128) / 255, from 128 - 128 * 224 / 255 = 3968 / 255 on: nothing is negative */
    return (2 * (224 * c + 3968) + 255) / 510;
}

/* The label of a colour given in full range, which is the range of every table. */
static uint8_t classify_full(const classes *list, unsigned y, unsigned u, unsigned v)
{
    if (list->range == PEL_RANGE_LIMITED) {
        y = limited_luma(y);
        u = limited_chroma(u);
        v = limited_chroma(v);
    }
    return pel_classify_color(&list->classifier, (uint8_t)y, (uint8_t)u, (uint8_t)v);
}

int classes_write_tm(const char *path, const classes *list)
{
    const unsigned y_step = 256 >> WRITTEN_Y_BITS, uv_step = 256 >> WRITTEN_UV_BITS;
    FILE *file = sink_open_file(path);
    unsigned y, u, v;

    if (!file) {
        return -1;
    }
    fprintf(file, "TMAP\nYUV8\n%d %d %d\n", 1 << WRITTEN_Y_BITS, 1 << WRITTEN_UV_BITS,
            1 << WRITTEN_UV_BITS);
    for (y = y_step / 2; y < 256; y += y_step) {
        for (u = uv_step / 2; u < 256; u += uv_step) {
            for (v = uv_step / 2; v < 256; v += uv_step) {
                putc(classify_full(list, y, u, v), file);
            }
        }
    }
    return sink_close_file(file, path, 0);
}
