#include "contact.h"

#include <string.h>

#include "label.h"
#include "plain.h"
#include "say.h"
#include "sink.h"

enum { PICTURE_WIDTH = 320, PICTURE_HEIGHT = 240, GAP = 6, PAPER = 32 };

enum {
    LINE_HEIGHT = LABEL_HEIGHT + 2,
    CELL_WIDTH = PICTURE_WIDTH + 2 * GAP,
    CELL_HEIGHT = PICTURE_HEIGHT + 2 * GAP + CONTACT_LINES * LINE_HEIGHT
};

/* The mean of `step` x `step` pixels around each that stays. */
static void reduce(const pel_view *from, unsigned step, const pel_view *to)
{
    for (unsigned y = 0; y < to->height; y++) {
        uint8_t *row = plain_row(to, y);
        for (unsigned i = 0; i < 3U * to->width; i++) {
            uint32_t sum = 0;
            for (unsigned k = 0; k < step * step; k++) {
                const uint8_t *pixels = plain_row(from, y * step + k / step);
                sum += pixels[3 * (i / 3 * step + k % step) + i % 3];
            }
            row[i] = (uint8_t)((2 * sum + step * step) / (2 * step * step));
        }
    }
}

int contact_shrink(const char *where, const pel_cview *view, contact_cell *cell)
{
    frame whole = {0};
    if (plain_make(where, view, PLAIN_RGB, &whole)) {
        return -1;
    }
    const unsigned width = whole.view.width, height = whole.view.height;
    unsigned step = 1;
    while (width / step > PICTURE_WIDTH || height / step > PICTURE_HEIGHT) {
        step++;
    }
    const unsigned less_width = width / step > 0 ? width / step : 1;
    const unsigned less_height = height / step > 0 ? height / step : 1;
    int status = 0;
    if (width < step || height < step) {
        status = say_error(where, "%ux%u cannot be made small enough for a sheet", width, height);
    } else if (frame_resize(&cell->picture, PEL_RGB888, PEL_RANGE_FULL, less_width, less_height)) {
        status = say_error(where, "out of memory");
    } else {
        reduce(&whole.view, step, &cell->picture.view);
    }
    frame_free(&whole);
    return status;
}

static void draw_border(const pel_view *sheet, int32_t x0, int32_t y0, int32_t x1, int32_t y1)
{
    const draw_color green = {64, 255, 64};
    for (int32_t i = 0; i < 2; i++) {
        draw_line(sheet, x0 + i, y0 + i, x1 - i, y0 + i, green);
        draw_line(sheet, x0 + i, y1 - i, x1 - i, y1 - i, green);
        draw_line(sheet, x0 + i, y0 + i, x0 + i, y1 - i, green);
        draw_line(sheet, x1 - i, y0 + i, x1 - i, y1 - i, green);
    }
}

static void draw_cell(const pel_view *sheet, int32_t x0, int32_t y0, const contact_cell *cell)
{
    const draw_color white = {255, 255, 255};
    const pel_view *picture = &cell->picture.view;
    const unsigned left = (unsigned)x0 + GAP + (PICTURE_WIDTH - picture->width) / 2U;
    const unsigned top = (unsigned)y0 + GAP + (PICTURE_HEIGHT - picture->height) / 2U;
    for (unsigned y = 0; y < picture->height; y++) {
        memcpy(plain_row(sheet, top + y) + 3 * (size_t)left, plain_row(picture, y),
               3 * (size_t)picture->width);
    }
    for (int32_t i = 0; i < CONTACT_LINES; i++) {
        label_draw(sheet, x0 + GAP, y0 + PICTURE_HEIGHT + 2 * GAP + i * LINE_HEIGHT, cell->text[i],
                   white);
    }
    if (cell->marked) {
        draw_border(sheet, x0, y0, x0 + CELL_WIDTH - 1, y0 + CELL_HEIGHT - 1);
    }
}

int contact_write(const char *path, const contact_cell *cells, size_t count, const char *comment)
{
    unsigned columns = 1;
    while (columns * columns < count) {
        columns++;
    }
    const unsigned rows = ((unsigned)count + columns - 1) / columns;
    frame sheet = {0};
    if (frame_resize(&sheet, PEL_RGB888, PEL_RANGE_FULL, columns * CELL_WIDTH,
                     rows * CELL_HEIGHT)) {
        return say_error(path, "the sheet of %zu pictures is too large", count);
    }
    memset(sheet.bytes, PAPER, 3 * (size_t)sheet.view.width * sheet.view.height);
    for (unsigned i = 0; i < count; i++) {
        draw_cell(&sheet.view, (int32_t)(i % columns * CELL_WIDTH),
                  (int32_t)(i / columns * CELL_HEIGHT), &cells[i]);
    }
    const pel_cview view = pel_view_to_read(&sheet.view);
    const int status = sink_picture(path, &view, comment);
    frame_free(&sheet);
    return status;
}
