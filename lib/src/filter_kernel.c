/* The named kernels. */
#include "pel/filter.h"

typedef struct named_kernel {
    char name[20];
    pel_kernel kernel;
} named_kernel;

/* name, {taps, radius, divisor, shift, absolute, bias}. No pointers in here: it stays in
 * flash. */
static const named_kernel named_kernels[] = {
    {"identity", {{0, 0, 0, 0, 1, 0, 0, 0, 0}, 1, 1, 0, 0, 0}},
    {"shift_left", {{0, 0, 0, 0, 0, 1, 0, 0, 0}, 1, 1, 0, 0, 0}},
    {"shift_right", {{0, 0, 0, 1, 0, 0, 0, 0, 0}, 1, 1, 0, 0, 0}},
    {"shift_up", {{0, 0, 0, 0, 0, 0, 0, 1, 0}, 1, 1, 0, 0, 0}},
    {"shift_down", {{0, 1, 0, 0, 0, 0, 0, 0, 0}, 1, 1, 0, 0, 0}},
    {"box3", {{1, 1, 1, 1, 1, 1, 1, 1, 1}, 1, 9, 0, 0, 0}},
    {"gauss3", {{1, 2, 1, 2, 4, 2, 1, 2, 1}, 1, 1, 4, 0, 0}},
    {"gauss5",
     {{1, 3, 6, 3, 1, 3, 15, 25, 15, 3, 6, 25, 44, 25, 6, 3, 15, 25, 15, 3, 1, 3, 6, 3, 1},
      2,
      1,
      8,
      0,
      0}},
    {"binomial5",
     {{1, 4, 6, 4, 1, 4, 16, 24, 16, 4, 6, 24, 36, 24, 6, 4, 16, 24, 16, 4, 1, 4, 6, 4, 1},
      2,
      1,
      8,
      0,
      0}},
    {"sobel_x", {{-1, 0, 1, -2, 0, 2, -1, 0, 1}, 1, 1, 0, 0, 0}},
    {"sobel_y", {{-1, -2, -1, 0, 0, 0, 1, 2, 1}, 1, 1, 0, 0, 0}},
    {"scharr_x", {{-3, 0, 3, -10, 0, 10, -3, 0, 3}, 1, 1, 0, 0, 0}},
    {"scharr_y", {{-3, -10, -3, 0, 0, 0, 3, 10, 3}, 1, 1, 0, 0, 0}},
    {"prewitt_x", {{-1, 0, 1, -1, 0, 1, -1, 0, 1}, 1, 1, 0, 0, 0}},
    {"prewitt_y", {{-1, -1, -1, 0, 0, 0, 1, 1, 1}, 1, 1, 0, 0, 0}},
    {"laplacian", {{0, 1, 0, 1, -4, 1, 0, 1, 0}, 1, 1, 0, 0, 0}},
    {"laplacian_negative", {{0, -1, 0, -1, 4, -1, 0, -1, 0}, 1, 1, 0, 0, 0}},
    {"sharpen", {{-1, -1, -1, -1, 17, -1, -1, -1, -1}, 1, 9, 0, 0, 0}},
    {"sharpen5", {{0, -1, 0, -1, 5, -1, 0, -1, 0}, 1, 1, 0, 0, 0}},
    {"emboss", {{-2, -1, 0, -1, 1, 1, 0, 1, 2}, 1, 1, 0, 0, 0}},
};

enum { NAMED_KERNELS = sizeof named_kernels / sizeof named_kernels[0] };

static int same_name(const char *a, const char *b)
{
    while (*a != '\0' && *a == *b) {
        a++;
        b++;
    }
    return *a == *b;
}

const pel_kernel *pel_kernel_named(const char *name)
{
    for (unsigned i = 0; name && i < NAMED_KERNELS; i++) {
        if (same_name(name, named_kernels[i].name)) {
            return &named_kernels[i].kernel;
        }
    }
    return NULL;
}

const char *pel_kernel_name(unsigned i)
{
    return i < NAMED_KERNELS ? named_kernels[i].name : NULL;
}

static unsigned tap_count(const pel_kernel *kernel)
{
    return kernel->radius == 1 ? 9 : 25;
}

pel_kernel pel_kernel_flipped(const pel_kernel *kernel)
{
    pel_kernel flipped = *kernel;
    const unsigned taps = tap_count(kernel);

    for (unsigned i = 0; i < taps; i++) {
        flipped.tap[i] = kernel->tap[taps - 1 - i];
    }
    return flipped;
}
