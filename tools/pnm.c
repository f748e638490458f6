#include "pnm.h"

#include "say.h"

/* What the header says. */
typedef struct pnm_header {
    int plain;         /* samples are decimal numbers */
    unsigned channels; /* 1 or 3 */
    unsigned long width, height, maxval;
} pnm_header;

static int is_blank(int c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

static int is_digit(int c)
{
    return c >= '0' && c <= '9';
}

int pnm_matches(const uint8_t *bytes, size_t count)
{
    return count >= 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '7';
}

/* The next byte of the text part; a comment, which may stand anywhere in it, counts as its
 * newline. */
static int get_text(input *in)
{
    int c = input_get(in);

    if (c == '#') {
        do {
            c = input_get(in);
        } while (c != '\n' && c != EOF);
    }
    return c;
}

/* Reads a decimal number and the one byte behind it, which is a blank, a comment or the end. */
static int read_number(input *in, const char *what, unsigned long *number)
{
    unsigned long value = 0;
    int c;

    do {
        c = get_text(in);
    } while (is_blank(c));
    if (c == EOF) {
        return input_error_line(in, "the file is cut short, %s is missing", what);
    }
    if (!is_digit(c)) {
        return input_error_line(in, "%s must be a decimal number", what);
    }
    for (; is_digit(c); c = get_text(in)) {
        value = value * 10 + (unsigned long)(c - '0');
        if (value > 99999) {
            return input_error_line(in, "%s is too large", what);
        }
    }
    if (c != EOF && !is_blank(c)) {
        return input_error_line(in, "%s must be a decimal number", what);
    }
    *number = value;
    return 0;
}

static int read_magic(input *in, pnm_header *header)
{
    int kind;

    input_get(in);
    kind = input_get(in);
    switch (kind) {
    case '2':
    case '3':
    case '5':
    case '6':
        break;
    case '1':
    case '4':
        return input_error_line(in, "P%c is a bitmap (PBM); convert it to PGM, P5", kind);
    default:
        return input_error_line(in, "P7 is a PAM picture; convert it to PPM, P6, or PGM, P5");
    }
    header->plain = kind <= '3';
    header->channels = kind == '3' || kind == '6' ? 3 : 1;
    kind = input_peek(in);
    if (kind != EOF && !is_blank(kind) && kind != '#') {
        return input_error_line(in, "a blank must follow the magic number");
    }
    return 0;
}

static int read_header(input *in, pnm_header *header)
{
    if (read_magic(in, header) || read_number(in, "the width", &header->width) ||
        read_number(in, "the height", &header->height)) {
        return -1;
    }
    if (header->width < 1 || header->width > PEL_SIDE_MAX || header->height < 1 ||
        header->height > PEL_SIDE_MAX) {
        return input_error_line(in, "a picture of %lux%lu; each side must be 1 to %d",
                                header->width, header->height, PEL_SIDE_MAX);
    }
    if (read_number(in, "the maxval", &header->maxval)) {
        return -1;
    }
    if (header->maxval < 1 || header->maxval > 65535) {
        return input_error_line(in, "the maxval is %lu; it must be 1 to 65535", header->maxval);
    }
    if (!header->plain && input_at_end(in)) {
        return input_error_byte(in, "the file is cut short, it ends with the header");
    }
    return 0;
}

static uint8_t scale(unsigned long sample, unsigned long maxval)
{
    return (uint8_t)((2 * 255 * sample + maxval) / (2 * maxval));
}

static int read_plain_row(input *in, const pnm_header *header, size_t samples, uint8_t *row)
{
    size_t i;

    for (i = 0; i < samples; i++) {
        unsigned long sample;
        if (read_number(in, "a sample", &sample)) {
            return -1;
        }
        if (sample > header->maxval) {
            return input_error_line(in, "a sample is %lu, over the maxval %lu", sample,
                                    header->maxval);
        }
        row[i] = scale(sample, header->maxval);
    }
    return 0;
}

static int read_wide_row(input *in, const pnm_header *header, size_t samples, uint8_t *row)
{
    size_t i;

    for (i = 0; i < samples; i++) {
        int high = input_get(in);
        int low = input_get(in);
        unsigned long sample;
        if (low == EOF) {
            return input_error_byte(in, "the file is cut short within the pixels");
        }
        sample = (unsigned long)high * 256 + (unsigned long)low;
        if (sample > header->maxval) {
            return input_error_byte(in, "a sample is %lu, over the maxval %lu", sample,
                                    header->maxval);
        }
        row[i] = scale(sample, header->maxval);
    }
    return 0;
}

static int read_byte_row(input *in, const pnm_header *header, size_t samples, uint8_t *row)
{
    size_t i;

    if (input_read(in, row, samples) != samples) {
        return input_error_byte(in, "the file is cut short within the pixels");
    }
    if (header->maxval == 255) {
        return 0;
    }
    for (i = 0; i < samples; i++) {
        if (row[i] > header->maxval) {
            return input_error_byte(
                in, "in the %zu bytes before it a sample is %d, over the maxval %lu", samples,
                row[i], header->maxval);
        }
        row[i] = scale(row[i], header->maxval);
    }
    return 0;
}

static int read_row(input *in, const pnm_header *header, size_t samples, uint8_t *row)
{
    if (header->plain) {
        return read_plain_row(in, header, samples, row);
    }
    return header->maxval > 255 ? read_wide_row(in, header, samples, row)
                                : read_byte_row(in, header, samples, row);
}

int pnm_read(input *in, frame *picture)
{
    pnm_header header;
    size_t row_bytes, total, y;

    if (read_header(in, &header)) {
        return -1;
    }
    row_bytes = header.width * header.channels;
    total = row_bytes * header.height;
    for (y = 0; y < header.height; y++) {
        uint8_t *bytes = frame_reserve(picture, (y + 1) * row_bytes, total);
        if (!bytes) {
            return say_error(in->path, "not enough memory for %lux%lu pixels", header.width,
                             header.height);
        }
        if (read_row(in, &header, row_bytes, bytes + y * row_bytes)) {
            return -1;
        }
    }
    return frame_describe(picture, header.channels == 3 ? PEL_RGB888 : PEL_GRAY8, PEL_RANGE_FULL,
                          (unsigned)header.width, (unsigned)header.height);
}

/* One "# " in front of every line. */
static void write_comment(FILE *file, const char *comment)
{
    int at_start = 1;

    for (; *comment != '\0'; comment++) {
        if (at_start) {
            fputs("# ", file);
        }
        fputc(*comment == '\r' ? ' ' : *comment, file);
        at_start = *comment == '\n';
    }
    if (!at_start) {
        fputc('\n', file);
    }
}

int pnm_write_header(FILE *file, int gray, unsigned width, unsigned height, const char *comment)
{
    fputs(gray ? "P5\n" : "P6\n", file);
    if (comment) {
        write_comment(file, comment);
    }
    fprintf(file, "%u %u\n255\n", width, height);
    return ferror(file) ? -1 : 0;
}
