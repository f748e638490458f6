#include "sink.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "jpegfile.h"
#include "options.h"
#include "pack.h"
#include "pngfile.h"
#include "pnm.h"
#include "raw.h"
#include "say.h"
#include "y4m.h"

static const struct {
    const char *name;
    sink_kind kind;
} endings[] = {
    {"ppm", SINK_PPM}, {"pgm", SINK_PGM}, {"png", SINK_PNG},  {"y4m", SINK_Y4M},
    {"raw", SINK_RAW}, {"yuv", SINK_RAW}, {"jpg", SINK_JPEG}, {"jpeg", SINK_JPEG},
};

int sink_kind_by_name(const char *name, sink_kind *kind)
{
    size_t i;

    for (i = 0; i < sizeof endings / sizeof endings[0]; i++) {
        if (options_same_word(name, endings[i].name)) {
            *kind = endings[i].kind;
            return 0;
        }
    }
    return -1;
}

int sink_kind_by_path(const char *path, sink_kind *kind)
{
    const char *dot = strrchr(path, '.');

    return dot ? sink_kind_by_name(dot + 1, kind) : -1;
}

FILE *sink_open_file(const char *path)
{
    FILE *file = strcmp(path, "-") == 0 ? stdout : fopen(path, "wb");

    if (!file) {
        say_error(path, "cannot create: %s", strerror(errno));
    }
    return file;
}

/* "-" is standard output here, and standard input where say_error names it. */
static const char *name_of(const char *path)
{
    return strcmp(path, "-") == 0 ? "standard output" : path;
}

int sink_close_file(FILE *file, const char *path, int status)
{
    struct stat about;
    int regular = fstat(fileno(file), &about) == 0 && S_ISREG(about.st_mode);
    int failed;

    errno = 0;
    failed = ferror(file) || fflush(file) != 0;
    if (file != stdout) {
        failed = fclose(file) != 0 || failed;
        if ((failed || status) && regular) {
            remove(path);
        }
    }
    if (failed && status == 0) {
        return say_error(name_of(path), "cannot write: %s",
                         errno ? strerror(errno) : "the device took no more");
    }
    return status;
}

void sink_attach(sink *to, FILE *file, const char *path, sink_kind kind)
{
    static const sink empty;

    *to = empty;
    to->path = path;
    to->kind = kind;
    to->file = file;
}

int sink_open(sink *to, const char *path, sink_kind kind)
{
    sink_attach(to, sink_open_file(path), path, kind);
    return to->file ? 0 : -1;
}

static int cannot_write(const sink *to)
{
    return say_error(name_of(to->path), "cannot write: %s",
                     errno ? strerror(errno) : "the device took no more");
}

static int write_pnm(sink *to, const pel_cview *view)
{
    uint8_t row[3 * PEL_SIDE_MAX];
    unsigned width = pel_color_width(view->format, view->width);
    unsigned height = pel_color_height(view->format, view->height);
    int gray = to->kind == SINK_PGM;
    size_t row_bytes = (size_t)width * (gray ? 1 : 3);
    unsigned y;

    if (pnm_write_header(to->file, gray, width, height, to->comment)) {
        return cannot_write(to);
    }
    for (y = 0; y < height; y++) {
        if (gray) {
            pack_gray_row(view, y, row);
        } else {
            pack_rgb_row(view, y, row);
        }
        if (fwrite(row, 1, row_bytes, to->file) != row_bytes) {
            return cannot_write(to);
        }
    }
    return 0;
}

static void fill_rgb(void *user, unsigned y, uint8_t *row)
{
    pack_rgb_row(user, y, row);
}

static void fill_gray(void *user, unsigned y, uint8_t *row)
{
    pack_gray_row(user, y, row);
}

/* PNG and JPEG. */
static int write_coded(sink *to, const pel_cview *view)
{
    const int is_png = to->kind == SINK_PNG;
    const char *const name = is_png ? "PNG" : "JPEG";
    pel_cview copy = *view;
    pngfile_picture picture;
    char message[PNGFILE_MESSAGE_BYTES];

    if (to->frames > 0) {
        return say_error(name_of(to->path), "a %s holds one picture; choose one with --frame N",
                         name);
    }
    picture.width = pel_color_width(view->format, view->width);
    picture.height = pel_color_height(view->format, view->height);
    picture.gray = view->format == PEL_GRAY8;
    picture.comment = to->comment;
    picture.fill_row = picture.gray ? fill_gray : fill_rgb;
    picture.user = &copy;
    if ((is_png ? pngfile_write : jpegfile_write)(to->file, &picture, message)) {
        return say_error(name_of(to->path), "%s: %s", name, message);
    }
    return 0;
}

static int write_y4m(sink *to, const pel_cview *view)
{
    const y4m_notes notes = {to->rate_num, to->rate_den, to->comment};

    if (to->frames > 0 &&
        (view->width != to->width || view->height != to->height || view->format != to->format)) {
        return say_error(name_of(to->path),
                         "frame %lu has another size or format than the first; a "
                         "video cannot hold it",
                         to->frames);
    }
    if ((to->frames == 0 && y4m_write_header(to->file, view, &notes)) ||
        y4m_write_frame(to->file, view)) {
        return cannot_write(to);
    }
    return 0;
}

static int write_raw(sink *to, const pel_cview *view)
{
    return raw_write(to->file, view) ? cannot_write(to) : 0;
}

int sink_frame(sink *to, const pel_cview *view)
{
    static int (*const writers[SINK_KIND_COUNT])(sink *, const pel_cview *) = {
        [SINK_PPM] = write_pnm,    [SINK_PGM] = write_pnm, [SINK_PNG] = write_coded,
        [SINK_JPEG] = write_coded, [SINK_Y4M] = write_y4m, [SINK_RAW] = write_raw,
    };

    errno = 0;
    if (writers[to->kind](to, view)) {
        return -1;
    }
    if (to->frames++ == 0) {
        to->width = view->width;
        to->height = view->height;
        to->format = view->format;
    }
    return 0;
}

int sink_close(sink *to, int status)
{
    FILE *file = to->file;

    to->file = NULL;
    return file ? sink_close_file(file, to->path, status) : status;
}

static int picture_kind(const char *path, sink_kind *kind)
{
    *kind = SINK_PPM;
    if (strcmp(path, "-") != 0 && (sink_kind_by_path(path, kind) || *kind > SINK_PNG)) {
        return say_error(path, "pictures are written as .ppm, .pgm or .png; name the file so");
    }
    return 0;
}

int sink_check_picture(const char *path)
{
    sink_kind kind;

    return picture_kind(path, &kind);
}

int sink_picture(const char *path, const pel_cview *view, const char *comment)
{
    sink to;
    sink_kind kind;

    if (picture_kind(path, &kind)) {
        return -1;
    }
    if (pel_cview_check(view) != PEL_OK) {
        return say_error(path, "this picture cannot be written: %s",
                         pel_status_name(pel_cview_check(view)));
    }
    if (sink_open(&to, path, kind)) {
        return -1;
    }
    to.comment = comment;
    return sink_close(&to, sink_frame(&to, view));
}
