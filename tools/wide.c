#include "wide.h"

int wide_write(FILE *file, const int16_t *values, unsigned width, unsigned height)
{
    const size_t count = (size_t)width * height;
    fprintf(file, "P5\n# signed values plus %d: this sample stands for 0\n%u %u\n65535\n",
            (int)WIDE_OFFSET, width, height);
    for (size_t i = 0; i < count; i++) {
        const unsigned sample = (unsigned)((int32_t)values[i] + WIDE_OFFSET);
        putc((int)(sample >> 8), file);
        putc((int)(sample & 255), file);
    }
    return ferror(file) ? -1 : 0;
}
