/* Whole frames filtered by a backend and by plain C: random sizes, borders, strides, operators. */
#include "equal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FRAMES = 1500, WIDTH_MAX = 260, HEIGHT_MAX = 40, GAP_MAX = 20, UNTOUCHED = 7 };

static pel_filter_op *const ops[] = {
    pel_op_gauss3,       pel_op_binomial5, pel_op_median, pel_op_min, pel_op_gradient,
    pel_op_erode_labels, pel_op_majority,  NULL,          pel_op_max, pel_op_gradient_abs};
static pel_filter_op_s16 *const ops_s16[] = {pel_op_sobel_x_s16, pel_op_sobel_y_s16,
                                             pel_op_gradient_s16, NULL};
static const char *const kernels[] = {"sharpen", "gauss5", "laplacian", "emboss"};

#define PICK(table, state) table[equal_random(state) % (sizeof table / sizeof table[0])]

/* A frame of pixels or of words, upright or, with a negative stride, upside down. */
typedef struct sheet {
    uint8_t *memory, *top;
    size_t bytes;
    int32_t stride; /* in pixels */
} sheet;

static sheet make(unsigned height, unsigned stride, unsigned pixel_bytes, int upside_down)
{
    sheet s;

    s.bytes = (size_t)stride * height * pixel_bytes;
    s.memory = malloc(s.bytes);
    if (!s.memory) {
        fputs("equal: out of memory\n", stderr);
        exit(1);
    }
    memset(s.memory, UNTOUCHED, s.bytes);
    s.top = s.memory + (upside_down ? (size_t)stride * (height - 1) * pixel_bytes : 0);
    s.stride = upside_down ? -(int32_t)stride : (int32_t)stride;
    return s;
}

static pel_status filter(pel_filter_config *c, pel_backend backend, const pel_cview *src,
                         const sheet *to)
{
    pel_view view;

    c->backend = backend;
    if (c->op_s16) {
        return pel_filter_frame_s16(c, src, (int16_t *)(void *)to->top, to->stride);
    }
    c->width = src->width;
    c->height = src->height;
    view.format = PEL_GRAY8;
    view.range = PEL_RANGE_FULL;
    view.width = pel_filter_width(c);
    view.height = pel_filter_height(c);
    view.plane[0] = to->top;
    view.stride_bytes[0] = to->stride;
    return pel_filter_frame(c, src, &view);
}

/* Draws what is to be computed; returns its radius. */
static unsigned draw_config(uint32_t *state, pel_filter_config *c)
{
    memset(c, 0, sizeof *c);
    if (equal_random(state) % 3 == 0) {
        c->op_s16 = PICK(ops_s16, state);
    } else {
        c->op = PICK(ops, state);
    }
    c->kernel = pel_kernel_named(PICK(kernels, state));
    c->border = (pel_border)(equal_random(state) % (PEL_BORDER_VALID + 1));
    c->constant = (uint8_t)equal_random(state);
    return c->op       ? c->op(NULL, 0, c, NULL)
           : c->op_s16 ? c->op_s16(NULL, 0, c, NULL)
                       : c->kernel->radius;
}

static int frames_equal(pel_backend backend, uint32_t *state)
{
    pel_filter_config c;
    const unsigned radius = draw_config(state, &c);
    const unsigned width = 5 + equal_random(state) % (WIDTH_MAX - 5);
    const unsigned height = 5 + equal_random(state) % (HEIGHT_MAX - 5);
    const unsigned stride = width + equal_random(state) % GAP_MAX;
    const unsigned pixel_bytes = c.op_s16 ? 2 : 1;
    const int upside_down = equal_random(state) % 2 == 0;
    const sheet in = make(height, stride, 1, equal_random(state) % 2 == 0);
    const sheet plain = make(height, stride, pixel_bytes, upside_down);
    const sheet fast = make(height, stride, pixel_bytes, upside_down);
    const unsigned odd = equal_random(state) % 2; /* the working memory begins anywhere */
    pel_cview src = {{in.top, NULL, NULL}, {in.stride, 0, 0}, (uint16_t)width,
                     (uint16_t)height,     PEL_GRAY8,         PEL_RANGE_FULL};
    uint8_t *work;
    int same;

    for (size_t i = 0; i < in.bytes; i++) {
        in.memory[i] = (uint8_t)equal_random(state);
    }
    c.work_bytes = pel_filter_bytes(src.width, radius, c.border);
    work = malloc(c.work_bytes + odd);
    c.work = work ? work + odd : NULL;
    same = filter(&c, PEL_BACKEND_SCALAR, &src, &plain) == PEL_OK &&
           filter(&c, backend, &src, &fast) == PEL_OK &&
           memcmp(plain.memory, fast.memory, plain.bytes) == 0;
    free(work);
    free(in.memory);
    free(plain.memory);
    free(fast.memory);
    return same;
}

unsigned equal_frames(pel_backend backend, uint32_t seed, unsigned *failed)
{
    for (unsigned i = 0; i < FRAMES; i++) {
        uint32_t state = seed + i;
        if (!frames_equal(backend, &state) && ++*failed <= 20) {
            printf("wrong: filtered frame, %s: seed %lu\n", pel_backend_name(backend),
                   (unsigned long)(seed + i));
        }
    }
    return FRAMES - *failed;
}
