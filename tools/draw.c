#include "draw.h"

#include "trace.h"

static const draw_color black = {0, 0, 0};
static const draw_color white = {255, 255, 255};

void draw_pixel(const pel_view *picture, int32_t x, int32_t y, draw_color color)
{
    if (x < 0 || y < 0 || x >= picture->width || y >= picture->height) {
        return;
    }
    uint8_t *pixel = picture->plane[0] + (ptrdiff_t)y * picture->stride_bytes[0] + 3 * (ptrdiff_t)x;
    pixel[0] = color.red;
    pixel[1] = color.green;
    pixel[2] = color.blue;
}

static int32_t distance(int32_t a, int32_t b)
{
    return a < b ? b - a : a - b;
}

void draw_line(const pel_view *picture, int32_t x0, int32_t y0, int32_t x1, int32_t y1,
               draw_color color)
{
    const int32_t dx = distance(x0, x1);
    const int32_t dy = -distance(y0, y1);
    const int32_t step_x = x0 < x1 ? 1 : -1;
    const int32_t step_y = y0 < y1 ? 1 : -1;
    int32_t error = dx + dy;
    for (;;) {
        const int32_t twice = 2 * error;
        draw_pixel(picture, x0, y0, color);
        if (x0 == x1 && y0 == y1) {
            return;
        }
        if (twice >= dy) {
            error += dy;
            x0 += step_x;
        }
        if (twice <= dx) {
            error += dx;
            y0 += step_y;
        }
    }
}

static void draw_frame(const pel_view *picture, int32_t x0, int32_t y0, int32_t x1, int32_t y1,
                       draw_color color)
{
    draw_line(picture, x0, y0, x1, y0, color);
    draw_line(picture, x0, y1, x1, y1, color);
    draw_line(picture, x0, y0, x0, y1, color);
    draw_line(picture, x1, y0, x1, y1, color);
}

/* Moves a box that touches the border of the picture inside, so that its frame stays in sight. */
static int32_t into(int32_t value, int32_t size)
{
    return value < 0 ? 0 : value >= size ? size - 1 : value;
}

static void draw_box(const pel_view *picture, const pel_blob *blob, draw_color color)
{
    draw_frame(picture, into(blob->x0 - 1, picture->width), into(blob->y0 - 1, picture->height),
               into(blob->x1, picture->width), into(blob->y1, picture->height), color);
}

/* How far it is along a direction to the border of an interval, in q16 pixels. */
static int64_t reach_q16(int64_t from_q16, int64_t low, int64_t high, int64_t direction_q30)
{
    if (direction_q30 == 0) {
        return (int64_t)1 << 40;
    }
    const int64_t border_q16 = (direction_q30 > 0 ? high : low) * 65536;
    return (border_q16 - from_q16) * ((int64_t)1 << 30) / direction_q30;
}

/* From the centroid along a direction as far as the blob's pixels can be. */
static void draw_ray(const pel_view *picture, const pel_blob *blob, int64_t x_q16, int64_t y_q16,
                     int64_t cosine, int64_t sine)
{
    const int64_t across = reach_q16(x_q16, blob->x0, blob->x1 - 1, cosine);
    const int64_t down = reach_q16(y_q16, blob->y0, blob->y1 - 1, sine);
    const int64_t reach = across < down ? across : down;
    const int64_t x1_q16 = x_q16 + ((reach * (cosine >> 14)) >> 16);
    const int64_t y1_q16 = y_q16 + ((reach * (sine >> 14)) >> 16);
    draw_line(picture, (int32_t)((x_q16 + 32768) >> 16), (int32_t)((y_q16 + 32768) >> 16),
              (int32_t)((x1_q16 + 32768) >> 16), (int32_t)((y1_q16 + 32768) >> 16), white);
}

static void draw_axis(const pel_view *picture, const pel_blob *blob, int32_t x_q16, int32_t y_q16)
{
    enum { STANDS_OUT_Q15 = 32768 / 8 };
    if (pel_blob_elongation_q15(blob) < STANDS_OUT_Q15) {
        return;
    }
    const int32_t angle_mdeg = (int32_t)((int64_t)pel_blob_angle_turn16(blob) * 360000 / 65536);
    const int64_t cosine = trace_cos_q30(angle_mdeg);
    const int64_t sine = trace_sin_q30(angle_mdeg);
    draw_ray(picture, blob, x_q16, y_q16, cosine, sine);
    draw_ray(picture, blob, x_q16, y_q16, -cosine, -sine);
}

static void draw_cross(const pel_view *picture, int32_t x, int32_t y)
{
    enum { ARM = 3 };
    for (int32_t i = -ARM; i <= ARM; i++) {
        const draw_color color = i >= -1 && i <= 1 ? white : black;
        draw_pixel(picture, x + i, y, color);
        draw_pixel(picture, x, y + i, color);
    }
}

void draw_blob(const pel_view *picture, const pel_blob *blob, draw_color color)
{
    int32_t x_q16;
    int32_t y_q16;
    pel_blob_centroid_q16(blob, &x_q16, &y_q16);
    draw_box(picture, blob, color);
    draw_axis(picture, blob, x_q16, y_q16);
    draw_cross(picture, (x_q16 + 32768) >> 16, (y_q16 + 32768) >> 16);
}
