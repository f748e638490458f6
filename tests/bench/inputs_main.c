/*
 * Writes a benchmark picture to standard output as raw YUYV, or the classes that go with it as the
 * bytes of pel_boxes:
 *     bench_inputs NAME WIDTHxHEIGHT
 *     bench_inputs NAME boxes
 */
#include "benchinput.h"

#include <stdio.h>
#include <string.h>

static uint8_t frame[BENCH_FRAME_BYTES_MAX];

static int write_out(const void *bytes, size_t count)
{
    if (fwrite(bytes, 1, count, stdout) != count || fflush(stdout) != 0) {
        fprintf(stderr, "bench_inputs: cannot write\n");
        return 1;
    }
    return 0;
}

static int write_boxes(const char *name)
{
    static pel_boxes boxes;
    bench_boxes(name, &boxes);
    return write_out(&boxes, sizeof boxes);
}

int main(int argc, char **argv)
{
    int width = 0;
    int height = 0;
    if (argc == 3 && strcmp(argv[2], "boxes") == 0) {
        return write_boxes(argv[1]);
    }
    if (argc != 3 || sscanf(argv[2], "%dx%d", &width, &height) != 2 ||
        !((width == 640 && height == 480) || (width == 320 && height == 240))) {
        fprintf(stderr, "usage: bench_inputs synth|rand4|rand1 640x480|320x240|boxes\n");
        return 2;
    }
    if (bench_frame(argv[1], width, height, frame) != 0) {
        fprintf(stderr, "bench_inputs: %s: no such input\n", argv[1]);
        return 1;
    }
    return write_out(frame, 2u * (size_t)width * (size_t)height);
}
