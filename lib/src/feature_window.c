#include "feature_window.h"

static int32_t clamp(int32_t i, int32_t length)
{
    return i < 0 ? 0 : i >= length ? length - 1 : i;
}

/* The pixels of row y from column x on; edge pixels repeat. */
static void gather(const pel_cview *view, int32_t x, int32_t y, int32_t count, uint8_t *pixels)
{
    const uint8_t *const row =
        view->plane[0] + (ptrdiff_t)view->stride_bytes[0] * clamp(y, view->height);

    for (int32_t i = 0; i < count; i++) {
        pixels[i] = row[clamp(x + i, view->width)];
    }
}

/* Row by row into three rows of their own, the oldest overwritten. */
pel_row_pull pel_window_pull(const pel_cview *view, int32_t x, int32_t y, int32_t radius)
{
    pel_row_pull p = {0, 0, 0, 0, 0};
    uint8_t pixels[3][2 * PEL_WINDOW_RADIUS_MAX + 3];
    const uint8_t *rows[3] = {pixels[0], pixels[1], pixels[2]};

    for (int32_t i = -radius - 1; i <= radius + 1; i++) {
        uint8_t *const newest = pixels[(i + 3 * radius) % 3];
        gather(view, x - radius - 1, y + i, 2 * radius + 3, newest);
        rows[0] = rows[1];
        rows[1] = rows[2];
        rows[2] = newest + radius + 1;
        if (i > -radius) {
            pel_row_pull_around(rows, (int16_t)radius, (int16_t)(i - 1), &p);
        }
    }
    return p;
}
