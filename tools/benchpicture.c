#include "benchpicture.h"

#include <stdio.h>
#include <string.h>

#include "pack.h"
#include "plain.h"
#include "say.h"

pel_cview benchpicture_view(const bench_picture *picture, bench_form form)
{
    return pel_view_to_read(&picture->form[form].view);
}

static int room(bench_picture *picture, frame *out, pel_format format)
{
    if (frame_resize(out, format, PEL_RANGE_FULL, picture->width, picture->height)) {
        return say_error(picture->name, "out of memory for %ux%u", picture->width, picture->height);
    }
    return 0;
}

static void fill_gray(bench_picture *picture)
{
    for (unsigned y = 0; y < picture->height; y++) {
        const uint8_t *from = plain_row(&picture->form[BENCH_YUYV].view, y);
        uint8_t *gray = plain_row(&picture->form[BENCH_GRAY].view, y);
        uint8_t *turned = plain_row(&picture->form[BENCH_TURNED].view, picture->height - 1u - y);
        for (unsigned x = 0; x < picture->width; x++) {
            gray[x] = from[2 * x];
            turned[picture->width - 1u - x] = from[2 * x];
        }
    }
}

static int fill_rgb(bench_picture *picture, const pel_cview *yuyv)
{
    pel_status status = PEL_OK;
    for (uint16_t y = 0; y < picture->height && status == PEL_OK; y++) {
        const pel_crow row = pel_cview_row(yuyv, y);
        status = pel_crow_read_rgb(&row, 0, picture->width,
                                   plain_row(&picture->form[BENCH_RGB].view, y));
    }
    return status == PEL_OK ? 0 : say_error(picture->name, "has no colours");
}

static int fill_labels(bench_picture *picture, const pel_cview *yuyv)
{
    pel_classifier classifier = {0};
    classifier.boxes = &picture->boxes;
    classifier.range = PEL_RANGE_FULL;
    const pel_status status =
        pel_classify_frame(&classifier, yuyv, &picture->form[BENCH_LABELS].view);
    return status == PEL_OK ? 0 : say_error(picture->name, "cannot be classified");
}

/* Makes all the other forms from the YUYV one. */
static int complete(bench_picture *picture)
{
    picture->width = picture->form[BENCH_YUYV].view.width;
    picture->height = picture->form[BENCH_YUYV].view.height;
    if (room(picture, &picture->form[BENCH_GRAY], PEL_GRAY8) ||
        room(picture, &picture->form[BENCH_RGB], PEL_RGB888) ||
        room(picture, &picture->form[BENCH_LABELS], PEL_GRAY8) ||
        room(picture, &picture->form[BENCH_TURNED], PEL_GRAY8)) {
        return -1;
    }
    const pel_cview yuyv = benchpicture_view(picture, BENCH_YUYV);
    fill_gray(picture);
    return fill_rgb(picture, &yuyv) || fill_labels(picture, &yuyv) ? -1 : 0;
}

/* Takes the middle of a YUYV view. */
static int take_middle(const char *where, const pel_cview *view, unsigned width, unsigned height,
                       bench_picture *picture)
{
    pel_cview part;
    width = width ? width : view->width;
    height = height ? height : view->height & ~1u;
    const unsigned x0 = view->width < width ? 0 : (view->width - width) / 2 & ~1u;
    const unsigned y0 = view->height < height ? 0 : (view->height - height) / 2 & ~1u;
    if (pel_cview_crop(view, (uint16_t)x0, (uint16_t)(x0 + width), (uint16_t)y0,
                       (uint16_t)(y0 + height), &part) != PEL_OK) {
        return say_error(where, "has only %ux%u pixels", view->width, view->height);
    }
    return pack_frame(where, &part, PEL_YUYV, PEL_RANGE_FULL, &picture->form[BENCH_YUYV]) ||
                   complete(picture)
               ? -1
               : 0;
}

int benchpicture_make(const char *name, unsigned width, unsigned height, bench_picture *picture)
{
    static uint8_t bytes[BENCH_FRAME_BYTES_MAX];
    pel_cview whole;
    snprintf(picture->name, sizeof picture->name, "%s", name);
    picture->box_count = bench_box_list(name, picture->box);
    bench_boxes(name, &picture->boxes);
    if (bench_frame(name, BENCH_WIDTH_MAX, BENCH_HEIGHT_MAX, bytes) ||
        pel_cview_init(bytes, PEL_YUYV, PEL_RANGE_FULL, BENCH_WIDTH_MAX, BENCH_HEIGHT_MAX, 0,
                       &whole) != PEL_OK) {
        return say_error(name, "cannot be made");
    }
    return take_middle(name, &whole, width, height, picture);
}

/* "folder/ball.png" becomes "ball". */
static void take_name(const char *path, bench_picture *picture)
{
    const char *slash = strrchr(path, '/');
    snprintf(picture->name, sizeof picture->name, "%s", slash ? slash + 1 : path);
    char *dot = strrchr(picture->name, '.');
    if (dot && dot != picture->name) {
        *dot = '\0';
    }
}

/* The first frame of a source, but an odd last column (4:2:2 wants an even width). */
static int read_yuyv(source *from, const char *path, frame *yuyv)
{
    frame first = {0};
    pel_cview even;
    int failed = -1;
    const int got = source_next(from, &first);
    if (got == 0) {
        say_error(path, "holds no picture");
    } else if (got > 0) {
        const pel_cview view = pel_view_to_read(&first.view);
        /* A mosaic has two columns to a colour. */
        const unsigned unit = 2u * view.width / pel_color_width(view.format, view.width);
        const uint16_t width = (uint16_t)(view.width - view.width % unit);
        failed = pel_cview_crop(&view, 0, width, 0, view.height, &even) != PEL_OK
                     ? say_error(path, "is too narrow")
                     : pack_frame(path, &even, PEL_YUYV, PEL_RANGE_FULL, yuyv);
    }
    frame_free(&first);
    return failed;
}

int benchpicture_read(const char *path, const source_options *options, unsigned width,
                      unsigned height, bench_picture *picture)
{
    frame yuyv = {0};
    source *from = source_open(path, options);
    if (!from) {
        return -1;
    }
    take_name(path, picture);
    picture->box_count = bench_box_list(path, picture->box);
    bench_boxes(path, &picture->boxes);
    int failed = read_yuyv(from, path, &yuyv);
    if (!failed) {
        const pel_cview whole = pel_view_to_read(&yuyv.view);
        failed = take_middle(path, &whole, width, height, picture);
    }
    source_close(from);
    frame_free(&yuyv);
    return failed;
}

void benchpicture_free(bench_picture *picture)
{
    for (int i = 0; i < BENCH_FORMS; i++) {
        frame_free(&picture->form[i]);
    }
}
