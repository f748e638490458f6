#include "source.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "input.h"
#include "jpegfile.h"
#include "pngfile.h"
#include "pnm.h"
#include "raw.h"
#include "say.h"
#include "y4m.h"

/* The pictures that describe themselves, told apart by their first bytes. */
typedef struct picture_kind {
    int (*matches)(const uint8_t *bytes, size_t count);
    int (*read)(input *in, frame *picture);
    int may_trail; /* cameras and phones put data of their own behind a JPEG; it is ignored */
} picture_kind;

static const picture_kind kinds[] = {
    {pnm_matches, pnm_read, 0},
    {pngfile_matches, pngfile_read, 0},
    {jpegfile_matches, jpegfile_read, 1},
};

struct source {
    input in;
    source_options options;
    unsigned long frames;     /* read so far */
    const picture_kind *last; /* of the picture before; NULL at first */
    int is_video;
    y4m_stream video;
};

static const picture_kind *find_kind(input *in)
{
    uint8_t start[INPUT_LOOK_MAX];
    size_t count = input_look(in, start, sizeof start);
    size_t i;

    for (i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        if (kinds[i].matches(start, count)) {
            return &kinds[i];
        }
    }
    return NULL;
}

/* Looks at the first bytes. */
static int begin(source *from)
{
    input *in = &from->in;
    uint8_t start[INPUT_LOOK_MAX];
    size_t count = input_look(in, start, sizeof start);

    if (count == 0) {
        return input_error_byte(in, "the file is empty");
    }
    if (from->options.raw) {
        return 0;
    }
    if (y4m_matches(start, count)) {
        from->is_video = 1;
        return y4m_begin(in, &from->video);
    }
    if (!find_kind(in)) {
        return input_error_byte(in, "neither PPM, PGM, PNG, JPEG nor YUV4MPEG2; raw frames need "
                                    "--raw FORMAT WIDTHxHEIGHT");
    }
    return 0;
}

static int check_raw(const char *name, const source_options *options)
{
    if (options->width <= PEL_SIDE_MAX && options->height <= PEL_SIDE_MAX &&
        pel_frame_bytes(options->format, (uint16_t)options->width, (uint16_t)options->height) > 0) {
        return 0;
    }
    return say_error(name, "raw frames of this format cannot be %ux%u", options->width,
                     options->height);
}

source *source_open_stream(FILE *stream, const char *name, const source_options *options)
{
    source *from = calloc(1, sizeof *from);

    if (!from) {
        say_error(name, "not enough memory");
        if (stream != stdin) {
            fclose(stream);
        }
        return NULL;
    }
    input_attach(&from->in, stream, name);
    if (options) {
        from->options = *options;
    }
    if ((from->options.raw && check_raw(name, options)) || begin(from)) {
        source_close(from);
        return NULL;
    }
    return from;
}

source *source_open(const char *path, const source_options *options)
{
    FILE *stream = strcmp(path, "-") == 0 ? stdin : fopen(path, "rb");

    if (!stream) {
        say_error(path, "cannot open: %s", strerror(errno));
        return NULL;
    }
    return source_open_stream(stream, path, options);
}

/* Blanks and newlines between pictures are harmless; some editors add one at the end. */
static void skip_blanks(input *in)
{
    int c;

    while ((c = input_peek(in)) == ' ' || c == '\t' || c == '\n' || c == '\r') {
        input_get(in);
    }
}

static int next_picture(source *from, frame *picture)
{
    input *in = &from->in;
    const picture_kind *kind;

    if (from->frames > 0) {
        skip_blanks(in);
    }
    if (input_at_end(in)) {
        return in->read_errno ? input_error_byte(in, "cannot read on") : 0;
    }
    kind = find_kind(in);
    if (!kind) {
        return from->last && from->last->may_trail
                   ? 0
                   : input_error_byte(in, "picture %lu ends here, but what follows is no picture",
                                      from->frames - 1);
    }
    from->last = kind;
    return kind->read(in, picture) ? -1 : 1;
}

int source_next(source *from, frame *picture)
{
    int status;

    if (from->options.raw) {
        status = raw_read(&from->in, &from->options, from->frames, picture);
    } else if (from->is_video) {
        status = y4m_read(&from->in, &from->video, picture);
    } else {
        status = next_picture(from, picture);
    }
    from->frames += status > 0;
    return status;
}

void source_close(source *from)
{
    if (from) {
        input_close(&from->in);
        free(from);
    }
}
