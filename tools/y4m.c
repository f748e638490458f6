#include "y4m.h"

#include <stdlib.h>
#include <string.h>

#include "say.h"

enum { LINE_MAX_BYTES = 1024 };

static const char magic[] = "YUV4MPEG2";

/* The first name of a format is the one that is written. */
static const struct {
    const char *name;
    pel_format format;
} chromas[] = {
    {"C420jpeg", PEL_I420},  {"C420", PEL_I420}, {"C420paldv", PEL_I420},
    {"C420mpeg2", PEL_I420}, {"C422", PEL_YUYV}, {"Cmono", PEL_GRAY8},
};

int y4m_matches(const uint8_t *bytes, size_t count)
{
    return count >= sizeof magic - 1 && memcmp(bytes, magic, sizeof magic - 1) == 0;
}

/* Reads up to the newline, which is not stored. */
static int read_line(input *in, const char *what, char *line)
{
    size_t length = 0;
    int c;

    while ((c = input_get(in)) != '\n') {
        if (c == EOF) {
            return input_error_byte(in, "the file is cut short within %s", what);
        }
        if (c == '\0' || length == LINE_MAX_BYTES) {
            return input_error_byte(in, "%s is not a line of text of at most %d bytes", what,
                                    LINE_MAX_BYTES);
        }
        line[length++] = (char)c;
    }
    line[length] = '\0';
    return 0;
}

static int parse_side(input *in, const char *word, unsigned *side)
{
    unsigned value = 0;
    const char *p = word + 1;

    for (; *p >= '0' && *p <= '9' && value <= PEL_SIDE_MAX; p++) {
        value = value * 10 + (unsigned)(*p - '0');
    }
    if (*p != '\0' || value < 1 || value > PEL_SIDE_MAX) {
        return input_error_byte(in, "%s in the stream header; each side must be 1 to %d", word,
                                PEL_SIDE_MAX);
    }
    *side = value;
    return 0;
}

static int parse_chroma(input *in, const char *word, pel_format *format)
{
    size_t i;

    for (i = 0; i < sizeof chromas / sizeof chromas[0]; i++) {
        if (strcmp(word, chromas[i].name) == 0) {
            *format = chromas[i].format;
            return 0;
        }
    }
    return input_error_byte(in,
                            "chroma '%s' is not read; there are: C420 C420jpeg C420paldv "
                            "C420mpeg2 C422 Cmono, all of 8 bits",
                            word);
}

static int parse_extension(input *in, const char *word, pel_range *range)
{
    static const char name[] = "XCOLORRANGE=";

    if (strncmp(word, name, sizeof name - 1) != 0) {
        return 0; /* somebody else's extension */
    }
    if (strcmp(word + sizeof name - 1, "FULL") == 0) {
        *range = PEL_RANGE_FULL;
    } else if (strcmp(word + sizeof name - 1, "LIMITED") == 0) {
        *range = PEL_RANGE_LIMITED;
    } else {
        return input_error_byte(in, "unknown colour range '%s'; there are: FULL LIMITED", word);
    }
    return 0;
}

static int parse_word(input *in, const char *word, y4m_stream *stream)
{
    switch (word[0]) {
    case 'W':
        return parse_side(in, word, &stream->width);
    case 'H':
        return parse_side(in, word, &stream->height);
    case 'C':
        return parse_chroma(in, word, &stream->format);
    case 'X':
        return parse_extension(in, word, &stream->range);
    default:
        return 0; /* frame rate, interlacing, pixel aspect: the bytes are the same */
    }
}

static int check_size(input *in, const y4m_stream *stream)
{
    if (stream->width == 0 || stream->height == 0) {
        return input_error_byte(in, "the stream header has no %s",
                                stream->width ? "H (height)" : "W (width)");
    }
    if (pel_frame_bytes(stream->format, (uint16_t)stream->width, (uint16_t)stream->height) == 0) {
        return input_error_byte(in,
                                "%ux%u frames: 4:2:2 needs an even width, 4:2:0 an even width and "
                                "height; crop the video",
                                stream->width, stream->height);
    }
    return 0;
}

int y4m_begin(input *in, y4m_stream *stream)
{
    char line[LINE_MAX_BYTES + 1];
    char *word, *rest = NULL;

    stream->format = PEL_I420;
    stream->range = PEL_RANGE_LIMITED;
    stream->width = 0;
    stream->height = 0;
    stream->frames = 0;
    if (read_line(in, "the stream header", line)) {
        return -1;
    }
    word = strtok_r(line, " \r", &rest);
    if (!word || strcmp(word, magic) != 0) {
        return input_error_byte(in, "the stream header must begin with '%s '", magic);
    }
    while ((word = strtok_r(NULL, " \r", &rest)) != NULL) {
        if (parse_word(in, word, stream)) {
            return -1;
        }
    }
    return check_size(in, stream);
}

static int cut_short(input *in, const y4m_stream *stream)
{
    return input_error_byte(in, "frame %lu is cut short", stream->frames);
}

static int out_of_memory(input *in, const y4m_stream *stream)
{
    return say_error(in->path, "not enough memory for %ux%u pixels", stream->width, stream->height);
}

/* I420 and GRAY8: the file's bytes are the frame's. */
static int read_planar(input *in, const y4m_stream *stream, frame *picture)
{
    size_t total =
        pel_frame_bytes(stream->format, (uint16_t)stream->width, (uint16_t)stream->height);
    size_t done = 0;

    while (done < total) {
        size_t piece = total - done < INPUT_BUFFER_BYTES ? total - done : INPUT_BUFFER_BYTES;
        uint8_t *bytes = frame_reserve(picture, done + piece, total);
        if (!bytes) {
            return out_of_memory(in, stream);
        }
        if (input_read(in, bytes + done, piece) != piece) {
            return cut_short(in, stream);
        }
        done += piece;
    }
    return 0;
}

/* One plane of 4:2:2 into its places in YUYV: the first at `first`, then every `step` bytes. */
static int read_woven(input *in, const y4m_stream *stream, frame *picture, size_t first,
                      size_t step)
{
    size_t row_bytes = 2 * (size_t)stream->width;
    size_t total = row_bytes * stream->height;
    uint8_t samples[PEL_SIDE_MAX];
    size_t y, i;

    for (y = 0; y < stream->height; y++) {
        uint8_t *bytes = frame_reserve(picture, (y + 1) * row_bytes, total);
        uint8_t *row;
        if (!bytes) {
            return out_of_memory(in, stream);
        }
        row = bytes + y * row_bytes;
        if (input_read(in, samples, row_bytes / step) != row_bytes / step) {
            return cut_short(in, stream);
        }
        for (i = 0; i < row_bytes / step; i++) {
            row[first + i * step] = samples[i];
        }
    }
    return 0;
}

static int read_pixels(input *in, const y4m_stream *stream, frame *picture)
{
    if (stream->format != PEL_YUYV) {
        return read_planar(in, stream, picture);
    }
    if (read_woven(in, stream, picture, 0, 2) || read_woven(in, stream, picture, 1, 4)) {
        return -1;
    }
    return read_woven(in, stream, picture, 3, 4);
}

int y4m_read(input *in, y4m_stream *stream, frame *picture)
{
    char line[LINE_MAX_BYTES + 1];

    if (input_at_end(in)) {
        if (in->read_errno || stream->frames == 0) {
            return input_error_byte(in, "the file is cut short, it has no frame");
        }
        return 0;
    }
    if (read_line(in, "a frame header", line)) {
        return -1;
    }
    if (strncmp(line, "FRAME", 5) != 0 || (line[5] != '\0' && line[5] != ' ' && line[5] != '\r')) {
        return input_error_byte(in, "frame %lu must begin with a line 'FRAME'", stream->frames);
    }
    if (read_pixels(in, stream, picture) ||
        frame_describe(picture, stream->format, stream->range, stream->width, stream->height)) {
        return -1;
    }
    stream->frames++;
    return 1;
}

static const char *chroma_name(pel_format format)
{
    size_t i = 0;

    while (chromas[i].format != format) {
        i++;
    }
    return chromas[i].name;
}

/* A word of the header cannot hold blanks, and readers need not take long lines. */
static void write_comment(FILE *file, const char *comment)
{
    enum { COMMENT_MAX = 800 };
    size_t i;

    fputs(" XPEL=", file);
    for (i = 0; comment[i] != '\0' && i < COMMENT_MAX; i++) {
        const int c = (unsigned char)comment[i];
        fputc(c == '\n' ? ';' : c <= ' ' || c >= 0x7f ? '_' : c, file);
    }
}

int y4m_write_header(FILE *file, const pel_cview *view, const y4m_notes *notes)
{
    const int has_rate = notes && notes->rate_num > 0 && notes->rate_den > 0;

    fprintf(file, "%s W%u H%u F%u:%u Ip A1:1 %s XCOLORRANGE=%s", magic, view->width, view->height,
            has_rate ? notes->rate_num : 30, has_rate ? notes->rate_den : 1,
            chroma_name(view->format), view->range == PEL_RANGE_FULL ? "FULL" : "LIMITED");
    if (notes && notes->comment) {
        write_comment(file, notes->comment);
    }
    fputc('\n', file);
    return ferror(file) ? -1 : 0;
}

/* Every `step`-th byte of every row from the `first` on. */
static void write_plane(FILE *file, const uint8_t *plane, int32_t stride_bytes, size_t first,
                        size_t step, size_t count, size_t rows)
{
    uint8_t samples[PEL_SIDE_MAX];
    size_t y, i;

    for (y = 0; y < rows; y++) {
        const uint8_t *row = plane + (ptrdiff_t)y * stride_bytes + first;
        for (i = 0; i < count; i++) {
            samples[i] = row[i * step];
        }
        fwrite(samples, 1, count, file);
    }
}

int y4m_write_frame(FILE *file, const pel_cview *view)
{
    size_t width = view->width, height = view->height;
    const int32_t *stride = view->stride_bytes;

    fputs("FRAME\n", file);
    if (view->format == PEL_YUYV) {
        write_plane(file, view->plane[0], stride[0], 0, 2, width, height);
        write_plane(file, view->plane[0], stride[0], 1, 4, width / 2, height);
        write_plane(file, view->plane[0], stride[0], 3, 4, width / 2, height);
        return ferror(file) ? -1 : 0;
    }
    write_plane(file, view->plane[0], stride[0], 0, 1, width, height);
    if (view->format == PEL_I420) {
        write_plane(file, view->plane[1], stride[1], 0, 1, width / 2, height / 2);
        write_plane(file, view->plane[2], stride[2], 0, 1, width / 2, height / 2);
    }
    return ferror(file) ? -1 : 0;
}
