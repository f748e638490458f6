/* Writes a benchmark picture to standard output as raw YUYV: bench_inputs NAME WIDTHxHEIGHT */
#include "inputs.h"

#include <stdio.h>

static uint8_t frame[BENCH_FRAME_BYTES_MAX];

int main(int argc, char **argv)
{
    int width = 0;
    int height = 0;
    if (argc != 3 || sscanf(argv[2], "%dx%d", &width, &height) != 2 ||
        !((width == 640 && height == 480) || (width == 320 && height == 240))) {
        fprintf(stderr, "usage: bench_inputs synth|rand4|rand1 640x480|320x240\n");
        return 2;
    }
    if (bench_frame(argv[1], width, height, frame) != 0) {
        fprintf(stderr, "bench_inputs: %s: no such input\n", argv[1]);
        return 1;
    }
    const size_t bytes = 2u * (size_t)width * (size_t)height;
    if (fwrite(frame, 1, bytes, stdout) != bytes || fflush(stdout) != 0) {
        fprintf(stderr, "bench_inputs: cannot write\n");
        return 1;
    }
    return 0;
}
