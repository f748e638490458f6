/* Pixel formats become one another: bytes by hand, and what must not change at all. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "carray.h"
#include "harness.h"
#include "pack.h"

/*
 * In full range:
 *
 *     red    blue      Y  76.2  29.1    U 85.0 255.5    V 255.5 107.3
 *     green  white       149.7 255        43.5 128         21.2 128
 *
 * rounded and limited: Y 76 29 150 255, U 85 255 44 128, V 255 107 21 128. Mean chroma of the upper
 * pair: U 170, V 181; of the lower: U 86, V 74.5 -> 75; of all four: U 128, V 127.75 -> 128.
 */
static const uint8_t four[] = {255, 0, 0, 0, 0, 255, 0, 255, 0, 255, 255, 255};

static const struct {
    pel_format format;
    uint8_t bytes[12];
} packed[] = {
    {PEL_GRAY8, {76, 29, 150, 255}},
    {PEL_YUYV, {76, 170, 29, 181, 150, 86, 255, 75}},
    {PEL_UYVY, {170, 76, 181, 29, 86, 150, 75, 255}},
    {PEL_YVYU, {76, 181, 29, 170, 150, 75, 255, 86}},
    {PEL_VYUY, {181, 76, 170, 29, 75, 150, 86, 255}},
    {PEL_NV12, {76, 29, 150, 255, 128, 128}},
    {PEL_I420, {76, 29, 150, 255, 128, 128}},
    {PEL_RGB565_LE, {0x00, 0xf8, 0x1f, 0x00, 0xe0, 0x07, 0xff, 0xff}},
    {PEL_RGB565_BE, {0xf8, 0x00, 0x00, 0x1f, 0x07, 0xe0, 0xff, 0xff}},
    {PEL_RGB888, {255, 0, 0, 0, 0, 255, 0, 255, 0, 255, 255, 255}},
    {PEL_BGR888, {0, 0, 255, 255, 0, 0, 0, 255, 0, 255, 255, 255}},
    {PEL_BAYER8_RGGB, {255, 0, 255, 255}},
    {PEL_BAYER8_GRBG, {0, 0, 0, 255}},
    {PEL_BAYER8_GBRG, {0, 255, 0, 255}},
    {PEL_BAYER8_BGGR, {0, 0, 255, 255}},
};

static pel_cview view_of(const uint8_t *bytes, pel_format format, pel_range range, unsigned width,
                         unsigned height)
{
    pel_cview view;

    if (pel_cview_init(bytes, format, range, (uint16_t)width, (uint16_t)height, 0, &view) !=
        PEL_OK) {
        abort();
    }
    return view;
}

static void check_packed(const pel_cview *view, pel_format format, pel_range range,
                         const uint8_t *want)
{
    frame out = {0};
    size_t bytes;

    if (check(pack_frame("four", view, format, range, &out) == 0, "%s: %s", pel_format_name(format),
              last_message)) {
        bytes = pel_frame_bytes(format, out.view.width, out.view.height);
        check(bytes > 0 && memcmp(out.bytes, want, bytes) == 0, "%s from %s: wrong bytes",
              pel_format_name(format), pel_format_name(view->format));
        check(out.view.format == format && out.view.range == range, "%s: wrong view",
              pel_format_name(format));
    }
    frame_free(&out);
}

static void test_hand_made(void)
{
    const pel_cview view = view_of(four, PEL_RGB888, PEL_RANGE_FULL, 2, 2);
    size_t i;

    for (i = 0; i < sizeof packed / sizeof packed[0]; i++) {
        check_packed(&view, packed[i].format, PEL_RANGE_FULL, packed[i].bytes);
    }
    check(i == PEL_FORMAT_COUNT, "only %zu formats", i);
}

/* 100 * 31 / 255 = 12.2, 100 * 63 / 255 = 24.7: 01100 011001 01100. */
static void test_nearest_565(void)
{
    static const uint8_t gray[] = {100, 100, 100}, want[] = {0x63, 0x2c};
    const pel_cview view = view_of(gray, PEL_RGB888, PEL_RANGE_FULL, 1, 1);

    check_packed(&view, PEL_RGB565_BE, PEL_RANGE_FULL, want);
}

static void fill(uint8_t *bytes, size_t count)
{
    uint32_t state = 12345;
    size_t i;

    for (i = 0; i < count; i++) {
        state = state * 1664525u + 1013904223u;
        bytes[i] = (uint8_t)(state >> 24);
    }
}

/* There and back through another format of the same kind. */
static void check_lossless(pel_format format, pel_format through, pel_range range)
{
    uint8_t bytes[2 * 24 * 10];
    frame middle = {0};
    pel_cview view;

    fill(bytes, sizeof bytes);
    view = view_of(bytes, format, range, 24, 10);
    if (check(pack_frame("it", &view, through, range, &middle) == 0, "%s", last_message)) {
        pel_cview back = pel_view_to_read(&middle.view);
        check_packed(&back, format, range, bytes);
    }
    frame_free(&middle);
}

static void test_lossless(void)
{
    static const pel_format pairs[] = {PEL_YUYV, PEL_UYVY, PEL_YVYU, PEL_VYUY};
    unsigned range, i, k;

    for (range = PEL_RANGE_FULL; range <= PEL_RANGE_LIMITED; range++) {
        for (i = 0; i < 4; i++) {
            for (k = 0; k < 4; k++) {
                check_lossless(pairs[i], pairs[k], (pel_range)range);
            }
        }
        check_lossless(PEL_NV12, PEL_I420, (pel_range)range);
        check_lossless(PEL_I420, PEL_NV12, (pel_range)range);
    }
    check_lossless(PEL_RGB565_LE, PEL_RGB565_BE, PEL_RANGE_FULL);
    check_lossless(PEL_RGB565_LE, PEL_RGB888, PEL_RANGE_FULL);
}

/* Padded and bottom-up pictures are packed as what they show. */
static void test_strides(void)
{
    uint8_t rows[2][20];
    pel_cview view;

    memcpy(rows[0], four, 6);
    memcpy(rows[1], four + 6, 6);
    check(pel_cview_init(rows[0], PEL_RGB888, PEL_RANGE_FULL, 2, 2, sizeof rows[0], &view) ==
              PEL_OK,
          "padded");
    check_packed(&view, PEL_RGB888, PEL_RANGE_FULL, four);
    check_packed(&view, packed[1].format, PEL_RANGE_FULL, packed[1].bytes);
    memcpy(rows[1], four, 6);
    memcpy(rows[0], four + 6, 6);
    check(pel_cview_init(rows[1], PEL_RGB888, PEL_RANGE_FULL, 2, 2, -(int32_t)sizeof rows[0],
                         &view) == PEL_OK,
          "bottom-up");
    check_packed(&view, PEL_RGB888, PEL_RANGE_FULL, four);
    check_packed(&view, packed[1].format, PEL_RANGE_FULL, packed[1].bytes);
}

/* Black and white: limited Y 16 and 235 are full Y 0 and 255; chroma stays in the middle. */
static void test_ranges(void)
{
    static const uint8_t limited[] = {16, 128, 235, 128}, full[] = {0, 128, 255, 128};
    const pel_cview a = view_of(limited, PEL_YUYV, PEL_RANGE_LIMITED, 2, 1);
    const pel_cview b = view_of(full, PEL_YUYV, PEL_RANGE_FULL, 2, 1);

    check_packed(&a, PEL_YUYV, PEL_RANGE_FULL, full);
    check_packed(&b, PEL_YUYV, PEL_RANGE_LIMITED, limited);
    check_packed(&a, PEL_YUYV, PEL_RANGE_LIMITED, limited);
}

/* A mosaic becomes half its size, each cell one colour (R, mean G, B); the same mosaic is
 * copied. */
static void test_bayer(void)
{
    static const uint8_t mosaic[] = {200, 100, 10, 20, 103, 50, 31, 40},
                         cells[] = {200, 102, 50, 10, 26, 40};
    const pel_cview view = view_of(mosaic, PEL_BAYER8_RGGB, PEL_RANGE_FULL, 4, 2);

    check_packed(&view, PEL_RGB888, PEL_RANGE_FULL, cells);
    check_packed(&view, PEL_BAYER8_RGGB, PEL_RANGE_FULL, mosaic);
}

static void check_refused(pel_format format, unsigned width, unsigned height)
{
    static const uint8_t bytes[100];
    const pel_cview view = view_of(bytes, PEL_RGB888, PEL_RANGE_FULL, width, height);
    frame out = {0};

    message_count = 0;
    check(pack_frame("odd.ppm", &view, format, PEL_RANGE_FULL, &out) == -1 && message_count == 1 &&
              strstr(last_message, "odd.ppm") && strstr(last_message, pel_format_name(format)),
          "%s of %ux%u: '%s'", pel_format_name(format), width, height, last_message);
    frame_free(&out);
}

static void test_sizes(void)
{
    check_refused(PEL_YUYV, 3, 2);
    check_refused(PEL_VYUY, 1, 1);
    check_refused(PEL_NV12, 2, 3);
    check_refused(PEL_I420, 3, 2);
    check_refused(PEL_BAYER8_GBRG, 2, 1);
}

static void test_c_array(void)
{
    static const char want[] =
        "#include <stdint.h>\n\nenum { shot_width = 2, shot_height = 2 };\n\n"
        "const uint8_t shot[8] = {\n"
        "    0x4c, 0xaa, 0x1d, 0xb5, 0x96, 0x56, 0xff, 0x4b,\n};\n";
    const pel_cview view = view_of(packed[1].bytes, PEL_YUYV, PEL_RANGE_LIMITED, 2, 2);
    char text[2000];
    FILE *file = tmpfile();
    size_t count;

    if (!file) {
        abort();
    }
    check(carray_write(file, &view, "shot") == 0, "C array");
    rewind(file);
    count = fread(text, 1, sizeof text - 1, file);
    text[count] = '\0';
    fclose(file);
    check(strstr(text, want) != NULL, "C array: %s", text);
    check(strstr(text, "pel_cview_init(shot, PEL_YUYV, PEL_RANGE_LIMITED,") != NULL, "C array: %s",
          text);
    check(carray_name_ok("a") && carray_name_ok("_x9") && !carray_name_ok("") &&
              !carray_name_ok("9x") && !carray_name_ok("a-b") && !carray_name_ok("a b"),
          "names of arrays");
}

int main(void)
{
    test_hand_made();
    test_nearest_565();
    test_lossless();
    test_strides();
    test_ranges();
    test_bayer();
    test_sizes();
    test_c_array();
    return finish();
}
