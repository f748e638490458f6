/*
 * What the readers and writers of pictures and video must give, by hand and by definition.
 * Argument: the folder corpus/.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness.h"
#include "sink.h"

enum { PATH_BYTES = 512 };

static const char *corpus;

/* ---- Reading ------------------------------------------------------------------------------- */

typedef struct known_picture {
    const char *name;
    pel_format format;
    pel_range range;
    unsigned width, height;
    const char *bytes; /* hexadecimal, blanks anywhere; NULL: only the size is known */
} known_picture;

/* v * 255 / maxval, halves upward: 33 of 100 is 84.15, 50 of 100 is 127.5, 512 of 1023 is 127.6,
 * 32768 of 65535 is 127.502, 32767 of 65535 is 127.498. */
static const known_picture known[] = {
    {"plain.pgm", PEL_GRAY8, PEL_RANGE_FULL, 3, 2, "00 80 ff 54 a8 fc"},
    {"plain.ppm", PEL_RGB888, PEL_RANGE_FULL, 2, 2, "0080ff 000000 010101 ffffff"},
    {"binary.pgm", PEL_GRAY8, PEL_RANGE_FULL, 4, 3, "00010203 04050607 08090a0b"},
    {"wide.pgm", PEL_GRAY8, PEL_RANGE_FULL, 2, 2, "00 00 80 ff"},
    {"binary.ppm", PEL_RGB888, PEL_RANGE_FULL, 3, 2, "64656667 68696a6b 6c6d6e6f 70717273 7475"},
    {"video420.y4m", PEL_I420, PEL_RANGE_FULL, 4, 2, "00010203 04050607 0809 0a0b"},
    {"video422.y4m", PEL_YUYV, PEL_RANGE_LIMITED, 4, 2, "0008010c 0209030d 040a050e 060b070f"},
    {"videomono.y4m", PEL_GRAY8, PEL_RANGE_LIMITED, 3, 2, "000102 030405"},
    {"rgb.png", PEL_RGB888, PEL_RANGE_FULL, 3, 2, "000102 030405 060708 0a0b0c 0d0e0f 101112"},
    {"gray.png", PEL_GRAY8, PEL_RANGE_FULL, 3, 2, "007fff 010203"},
    {"gray16.png", PEL_GRAY8, PEL_RANGE_FULL, 2, 1, "7f ff"},
    {"gray1.png", PEL_GRAY8, PEL_RANGE_FULL, 8, 1, "ff00ff00 00ff00ff"},
    {"grayalpha.png", PEL_GRAY8, PEL_RANGE_FULL, 2, 1, "10 20"},
    {"rgba.png", PEL_RGB888, PEL_RANGE_FULL, 1, 1, "010203"},
    {"palette.png", PEL_RGB888, PEL_RANGE_FULL, 2, 1, "141516 0a0b0c"},
    {"interlaced.png", PEL_GRAY8, PEL_RANGE_FULL, 2, 2, "0102 0304"},
    {"gray.jpg", PEL_GRAY8, PEL_RANGE_FULL, 16, 16, NULL},
    {"color.jpg", PEL_RGB888, PEL_RANGE_FULL, 16, 16, NULL},
};

static size_t from_hex(const char *text, uint8_t *bytes)
{
    size_t count = 0;
    unsigned value;

    for (; *text != '\0'; text++) {
        if (*text != ' ' && sscanf(text, "%2x", &value) == 1) {
            bytes[count++] = (uint8_t)value;
            text++;
        }
    }
    return count;
}

/* Opens a stream over bytes and reads its first frame. */
static int read_first(const char *name, const void *bytes, size_t count, frame *picture)
{
    FILE *stream = tmpfile();
    source *from;
    int status;

    if (!stream || fwrite(bytes, 1, count, stream) != count) {
        abort();
    }
    rewind(stream);
    from = source_open_stream(stream, name, NULL);
    status = from ? source_next(from, picture) : -1;
    source_close(from);
    return status;
}

static int read_good(const char *name, frame *picture)
{
    char path[PATH_BYTES];
    source *from;
    int status;

    snprintf(path, sizeof path, "%s/good/%s", corpus, name);
    from = source_open(path, NULL);
    status = from ? source_next(from, picture) : -1;
    source_close(from);
    return status;
}

static void test_known_pictures(void)
{
    size_t i;

    for (i = 0; i < sizeof known / sizeof known[0]; i++) {
        const known_picture *want = &known[i];
        frame picture = {0};
        uint8_t bytes[64];
        if (check(read_good(want->name, &picture) == 1, "%s: %s", want->name, last_message)) {
            const pel_view *view = &picture.view;
            check(view->format == want->format && view->range == want->range &&
                      view->width == want->width && view->height == want->height,
                  "%s: format %d, range %d, %ux%u", want->name, view->format, view->range,
                  view->width, view->height);
            check(!want->bytes || memcmp(picture.bytes, bytes, from_hex(want->bytes, bytes)) == 0,
                  "%s: wrong pixels", want->name);
        }
        frame_free(&picture);
    }
}

/* The pixel r of sample v is the one with r - 1/2 <= 255 v / maxval < r + 1/2. */
static void test_every_sample(unsigned long maxval)
{
    unsigned long width = maxval < 256 ? maxval + 1 : 256, height = (maxval + 1) / width, v;
    uint8_t *file = malloc(200000);
    frame picture = {0};
    size_t count;

    if (!file) {
        abort();
    }
    count = (size_t)sprintf((char *)file, "P5 %lu %lu %lu\n", width, height, maxval);
    for (v = 0; v < width * height; v++) {
        if (maxval > 255) {
            file[count++] = (uint8_t)(v >> 8);
        }
        file[count++] = (uint8_t)v;
    }
    check(read_first("samples", file, count, &picture) == 1, "maxval %lu: %s", maxval,
          last_message);
    for (v = 0; picture.bytes && v < width * height; v++) {
        long twice = 2 * 255 * (long)v, max = (long)maxval, pixel = picture.bytes[v];
        if ((2 * pixel - 1) * max > twice || twice >= (2 * pixel + 1) * max) {
            check(0, "maxval %lu: sample %lu became %ld", maxval, v, pixel);
        }
    }
    check(v > maxval / 2, "maxval %lu: only %lu samples", maxval, v);
    frame_free(&picture);
    free(file);
}

static void test_progressive_is_the_same_picture(void)
{
    frame a = {0}, b = {0}, c = {0};

    if (check(read_good("color.jpg", &a) == 1 && read_good("progressive.jpg", &b) == 1 &&
                  read_good("motion.jpg", &c) == 1,
              "JPEG: %s", last_message)) {
        check(memcmp(a.bytes, b.bytes, 768) == 0, "the progressive picture differs");
        check(memcmp(a.bytes, c.bytes, 768) == 0, "the one without Huffman tables differs");
        check(a.bytes[0] < 40 && a.bytes[3 * 15] > 200 && a.bytes[3 * 240 + 1] > 200,
              "red grows to the right, green downward: %u %u %u", a.bytes[0], a.bytes[3 * 15],
              a.bytes[3 * 240 + 1]);
    }
    frame_free(&a);
    frame_free(&b);
    frame_free(&c);
}

/* Pictures behind each other are frames; what cameras put behind a JPEG is nothing. */
static void test_streams(void)
{
    static const char *const parts[] = {"rgb.png", "plain.pgm", "binary.ppm", "gray.png",
                                        "color.jpg"};
    static const reading as_source;
    uint8_t *whole = malloc(1 << 20);
    size_t used = 0, i;

    if (!whole) {
        abort();
    }
    for (i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        char path[PATH_BYTES];
        size_t count = 0;
        uint8_t *bytes;
        snprintf(path, sizeof path, "%s/good/%s", corpus, parts[i]);
        bytes = load(path, &count);
        if (bytes) {
            memcpy(whole + used, bytes, count);
            used += count;
        }
        free(bytes);
    }
    check(read_bytes("five", whole, used, &as_source) == 5, "five pictures: %s", last_message);
    memcpy(whole + used, "camera", 6);
    check(read_bytes("five", whole, used + 6, &as_source) == 5, "with a trailer: %s", last_message);
    free(whole);
}

/* ---- Writing ------------------------------------------------------------------------------- */

static void make_picture(frame *picture, pel_format format, unsigned width, unsigned height)
{
    size_t i, count;

    if (frame_resize(picture, format, PEL_RANGE_FULL, width, height)) {
        abort();
    }
    count = pel_frame_bytes(format, (uint16_t)width, (uint16_t)height);
    for (i = 0; i < count; i++) {
        picture->bytes[i] = (uint8_t)(i * 37 + i / 256);
    }
}

static void test_written_is_read(const char *path, pel_format format, const char *says)
{
    frame made = {0}, got = {0};
    size_t bytes = pel_frame_bytes(format, 61, 7), count = 0;
    pel_cview view;
    uint8_t *file;
    source *from;

    make_picture(&made, format, 61, 7);
    view = pel_view_to_read(&made.view);
    check(sink_picture(path, &view, "first\nsecond") == 0, "%s: %s", path, last_message);
    from = source_open(path, NULL);
    check(from && source_next(from, &got) == 1, "%s: %s", path, last_message);
    check(got.bytes && got.view.format == format && memcmp(made.bytes, got.bytes, bytes) == 0,
          "%s: not what was written", path);
    check(from && source_next(from, &got) == 0, "%s: more than was written", path);
    source_close(from);
    file = load(path, &count);
    if (file) {
        file[count < (1 << 20) ? count : (1 << 20) - 1] = '\0';
        size_t i = 0, length = strlen(says);
        while (i + length <= count && memcmp(file + i, says, length) != 0) {
            i++;
        }
        check(i + length <= count, "%s: the comment is missing", path);
    }
    free(file);
    frame_free(&made);
    frame_free(&got);
    remove(path);
}

static void test_video_is_read(pel_format format)
{
    frame made = {0}, got = {0};
    pel_cview view;
    sink to;
    source *from;
    int i;

    make_picture(&made, format, 10, 6);
    view = pel_view_to_read(&made.view);
    check(sink_open(&to, "written.y4m", SINK_Y4M) == 0, "y4m: %s", last_message);
    check(sink_frame(&to, &view) == 0 && sink_frame(&to, &view) == 0, "y4m: %s", last_message);
    check(sink_close(&to, 0) == 0, "y4m: %s", last_message);
    from = source_open("written.y4m", NULL);
    for (i = 0; i < 2; i++) {
        check(from && source_next(from, &got) == 1, "y4m frame %d: %s", i, last_message);
        check(got.bytes && got.view.format == format && got.view.range == PEL_RANGE_FULL &&
                  memcmp(made.bytes, got.bytes, pel_frame_bytes(format, 10, 6)) == 0,
              "y4m frame %d: not what was written", i);
    }
    check(from && source_next(from, &got) == 0, "y4m: more than was written");
    source_close(from);
    frame_free(&made);
    frame_free(&got);
    remove("written.y4m");
}

static void expect_refused(int status, const char *name, const char *fragment)
{
    check(status == -1 && strstr(last_message, name) && strstr(last_message, fragment),
          "%s: %d, '%s' does not say '%s'", name, status, last_message, fragment);
}

static void test_refused_writing(void)
{
    frame made = {0}, other = {0};
    pel_cview view, second;
    sink to;

    make_picture(&made, PEL_RGB888, 20, 20);
    make_picture(&other, PEL_GRAY8, 20, 20);
    view = pel_view_to_read(&made.view);
    second = pel_view_to_read(&other.view);
    expect_refused(sink_picture("picture.gif", &view, NULL), "picture.gif", ".ppm, .pgm or .png");
    expect_refused(sink_picture("no/such/folder.ppm", &view, NULL), "no/such/folder.ppm",
                   "cannot create");
    if (access("/dev/full", W_OK) == 0) {
        expect_refused(
            sink_open(&to, "/dev/full", SINK_PPM) || sink_close(&to, sink_frame(&to, &view)) ? -1
                                                                                             : 0,
            "/dev/full", "cannot write");
        expect_refused(
            sink_open(&to, "/dev/full", SINK_PNG) || sink_close(&to, sink_frame(&to, &view)) ? -1
                                                                                             : 0,
            "/dev/full", "cannot write");
    }
    sink_open(&to, "two.png", SINK_PNG);
    check(sink_frame(&to, &view) == 0, "%s", last_message);
    expect_refused(sink_close(&to, sink_frame(&to, &view)), "two.png", "one picture");
    check(access("two.png", F_OK) != 0, "two.png was left behind");
    sink_open(&to, "two.y4m", SINK_Y4M);
    check(sink_frame(&to, &second) == 0, "%s", last_message);
    make_picture(&other, PEL_GRAY8, 20, 10);
    second = pel_view_to_read(&other.view);
    expect_refused(sink_close(&to, sink_frame(&to, &second)), "two.y4m", "another size");
    check(access("two.y4m", F_OK) != 0, "two.y4m was left behind");
    frame_free(&made);
    frame_free(&other);
}

int main(int argc, char **argv)
{
    static const unsigned long maxvals[] = {1, 2, 3, 5, 100, 127, 254, 255, 511, 1023, 4095, 65535};
    size_t i;

    if (argc != 2) {
        fprintf(stderr, "usage: %s CORPUS\n", argv[0]);
        return 2;
    }
    corpus = argv[1];
    test_known_pictures();
    for (i = 0; i < sizeof maxvals / sizeof maxvals[0]; i++) {
        test_every_sample(maxvals[i]);
    }
    test_progressive_is_the_same_picture();
    test_streams();
    test_written_is_read("written.ppm", PEL_RGB888, "P6\n# first\n# second\n61 7\n255\n");
    test_written_is_read("written.pgm", PEL_GRAY8, "P5\n# first\n# second\n61 7\n255\n");
    test_written_is_read("color.png", PEL_RGB888, "Comment");
    test_written_is_read("gray.png", PEL_GRAY8, "first\nsecond");
    test_video_is_read(PEL_I420);
    test_video_is_read(PEL_YUYV);
    test_video_is_read(PEL_GRAY8);
    test_refused_writing();
    return finish();
}
