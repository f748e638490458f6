#include "input.h"

#include <errno.h>
#include <inttypes.h>
#include <stdarg.h>
#include <string.h>
#include <unistd.h>

#include "say.h"

void input_attach(input *in, FILE *file, const char *path)
{
    in->path = path;
    in->file = file;
    in->offset = 0;
    in->line = 1;
    in->at = 0;
    in->end = 0;
    in->read_errno = 0;
}

int input_open(input *in, const char *path)
{
    FILE *file = strcmp(path, "-") == 0 ? stdin : fopen(path, "rb");

    if (!file) {
        return say_error(path, "cannot open: %s", strerror(errno));
    }
    input_attach(in, file, path);
    return 0;
}

void input_close(input *in)
{
    if (in->file && in->file != stdin) {
        fclose(in->file);
    }
    in->file = NULL;
}

/* What there is, as soon as there is something: fread would wait for a full buffer while a camera's
 * frame has long arrived. Streams in memory have no descriptor and never make anybody wait. */
static size_t read_some(input *in, uint8_t *bytes, size_t room)
{
    const int descriptor = fileno(in->file);
    ssize_t got;

    errno = 0;
    if (descriptor < 0) {
        errno = 0;
        got = (ssize_t)fread(bytes, 1, room, in->file);
        in->read_errno = got == 0 && ferror(in->file) ? (errno ? errno : EIO) : 0;
        return (size_t)got;
    }
    do {
        got = read(descriptor, bytes, room);
    } while (got < 0 && errno == EINTR);
    in->read_errno = got < 0 ? errno : 0;
    return got < 0 ? 0 : (size_t)got;
}

/* Makes at least `count` bytes available, count <= INPUT_LOOK_MAX, or all that there are. */
static size_t fill(input *in, size_t count)
{
    size_t have = in->end - in->at;

    if (have >= count) {
        return have;
    }
    memmove(in->buffer, in->buffer + in->at, have);
    in->at = 0;
    in->end = have;
    while (in->end < count) {
        const size_t got = read_some(in, in->buffer + in->end, sizeof in->buffer - in->end);
        if (got == 0) {
            break;
        }
        in->end += got;
    }
    return in->end - in->at;
}

int input_peek(input *in)
{
    return fill(in, 1) ? in->buffer[in->at] : EOF;
}

int input_get(input *in)
{
    int c = input_peek(in);

    if (c != EOF) {
        in->at++;
        in->offset++;
        in->line += c == '\n';
    }
    return c;
}

size_t input_look(input *in, uint8_t *bytes, size_t count)
{
    size_t have = fill(in, count);

    if (have > count) {
        have = count;
    }
    memcpy(bytes, in->buffer + in->at, have);
    return have;
}

const uint8_t *input_window(input *in, size_t *count)
{
    *count = fill(in, 1);
    return in->buffer + in->at;
}

void input_skip(input *in, size_t count)
{
    in->at += count;
    in->offset += count;
}

size_t input_read(input *in, uint8_t *bytes, size_t count)
{
    size_t done = 0;

    while (done < count) {
        size_t piece;
        const uint8_t *window = input_window(in, &piece);
        if (piece == 0) {
            break;
        }
        if (piece > count - done) {
            piece = count - done;
        }
        memcpy(bytes + done, window, piece);
        input_skip(in, piece);
        done += piece;
    }
    return done;
}

int input_at_end(input *in)
{
    return fill(in, 1) == 0;
}

static int error_at(const input *in, const char *unit, uint64_t number, const char *format,
                    va_list arguments) __attribute__((format(printf, 4, 0)));

static int error_at(const input *in, const char *unit, uint64_t number, const char *format,
                    va_list arguments)
{
    char message[512];

    if (in->read_errno) {
        return say_error(in->path, "cannot read on at byte %" PRIu64 ": %s", in->offset,
                         strerror(in->read_errno));
    }
    vsnprintf(message, sizeof message, format, arguments);
    return say_error(in->path, "%s %" PRIu64 ": %s", unit, number, message);
}

int input_error_byte(const input *in, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    error_at(in, "byte", in->offset, format, arguments);
    va_end(arguments);
    return -1;
}

int input_error_line(const input *in, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    error_at(in, "line", in->line, format, arguments);
    va_end(arguments);
    return -1;
}
