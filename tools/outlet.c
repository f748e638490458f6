#include "outlet.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

#include "pack.h"
#include "say.h"
#include "usage.h"
#include "wide.h"

static int is_stdout(const outlet *to)
{
    return strcmp(to->path, "-") == 0;
}

static int same_file(const char *a, const char *b)
{
    struct stat one;
    struct stat other;
    return strcmp(a, "-") != 0 && strcmp(b, "-") != 0 && stat(a, &one) == 0 &&
           stat(b, &other) == 0 && S_ISREG(other.st_mode) && one.st_dev == other.st_dev &&
           one.st_ino == other.st_ino;
}

int outlet_begin(outlet *to, const char *command, const char *in, const char *path, int *status)
{
    sink_kind kind;
    to->path = path;
    if (!is_stdout(to) &&
        (sink_kind_by_path(path, &kind) || kind == SINK_RAW || kind == SINK_JPEG)) {
        *status = usage_error(command, "'%s' ends in none of .ppm .pgm .png .y4m", path);
        return -1;
    }
    if (same_file(in, path)) {
        *status = EXIT_BAD_INPUT;
        return say_error(path, "IN and OUT are the same file; write to another");
    }
    return 0;
}

static int create(outlet *to, sink_kind kind)
{
    if (!to->to.file) {
        return sink_open(&to->to, to->path, kind);
    }
    if (kind == SINK_PNG) {
        return say_error(to->path, "there is more than one picture, and a PNG holds one: use .ppm, "
                                   ".pgm, .y4m or '-'");
    }
    return 0;
}

int outlet_view(outlet *to, const char *in, const pel_cview *view)
{
    sink_kind kind = view->format == PEL_GRAY8 ? SINK_PGM : SINK_PPM;
    pel_cview made = *view;
    if (!is_stdout(to) && sink_kind_by_path(to->path, &kind)) {
        return say_error(to->path, "cannot hold pictures");
    }
    if (kind == SINK_Y4M && view->format != PEL_GRAY8) {
        if (pack_frame(in, view, PEL_YUYV, PEL_RANGE_FULL, &to->packed)) {
            return -1;
        }
        made = pel_view_to_read(&to->packed.view);
    }
    if (create(to, kind)) {
        return -1;
    }
    if (is_stdout(to)) {
        to->to.kind = kind; /* each picture as it is */
    }
    return sink_frame(&to->to, &made);
}

int outlet_wide(outlet *to, const int16_t *values, unsigned width, unsigned height)
{
    sink_kind kind = SINK_PGM;
    if (!is_stdout(to) && (sink_kind_by_path(to->path, &kind) || kind != SINK_PGM)) {
        return say_error(to->path, "16 bits go into .pgm or '-' only");
    }
    if (create(to, SINK_PGM)) {
        return -1;
    }
    errno = 0;
    if (wide_write(to->to.file, values, width, height)) {
        return say_error(is_stdout(to) ? "standard output" : to->path, "cannot write: %s",
                         errno ? strerror(errno) : "the device took no more");
    }
    return 0;
}

int outlet_close(outlet *to, int status)
{
    frame_free(&to->packed);
    return sink_close(&to->to, status);
}
