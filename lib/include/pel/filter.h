/*
 * Neighbourhood filters on 8-bit rows: 3x3 and 5x5 integer kernels, gradients, median, minimum and
 * maximum, majority; every one with six ways to treat the border, streaming or on a whole frame.
 *
 * Streaming: begin, push a row, pull what is ready, push the next. A filter of radius r (1 for 3x3,
 * 2 for 5x5) needs r rows below the one it computes, so the first r pushes give nothing and the
 * last one gives r + 1 rows:
 *
 *     static uint8_t work[PEL_FILTER_BYTES(320, 1)];
 *     pel_filter filter;
 *     pel_filter_config config = {0};
 *     config.op = pel_op_gauss3;
 *     config.width = 320;
 *     config.height = 240;
 *     config.work = work;
 *     config.work_bytes = sizeof work;
 *
 *     pel_filter_begin(&filter, &config);
 *     for (y = 0; y < 240; y++) {
 *         pel_filter_push(&filter, camera_row(y));
 *         while (pel_filter_pull(&filter, out) == PEL_OK)
 *             use(filter.row - 1, out);           rows 0, 1, 2, ... in order
 *     }
 *
 * A pushed row may be overwritten at once; `out` may be the row that was just pushed.
 */
#ifndef PEL_FILTER_H
#define PEL_FILTER_H

#include "pel/backend.h"
#include "pel/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Borders ------------------------------------------------------------------------------- */

/* What lies outside the picture, shown for a row a b c d. For a 3x3 filter replicate and symmetric
 * are the same. */
typedef enum pel_border {
    PEL_BORDER_REPLICATE = 0, /* a a | a b c d | d d   the edge repeats (SciPy: nearest) */
    PEL_BORDER_SYMMETRIC,     /* b a | a b c d | d c   mirrored, edge twice (SciPy: reflect) */
    PEL_BORDER_REFLECT101,    /* c b | a b c d | c b   mirrored, edge once (SciPy: mirror) */
    PEL_BORDER_WRAP,     /* c d | a b c d | a b   the other side; needs `last_rows` to stream */
    PEL_BORDER_CONSTANT, /* k k | a b c d | k k   the value `constant` */
    PEL_BORDER_VALID     /* nothing: only pixels with all neighbours, 2r fewer each way */
} pel_border;

/* The place inside 0..length-1 that stands for place i outside it; -1 for CONSTANT and VALID. Works
 * for any distance and any length of at least 1; an inside i is itself. */
int32_t pel_border_index(int32_t i, int32_t length, pel_border border);

/* ---- Kernels ------------------------------------------------------------------------------- */

/*
 * A kernel of (2 radius + 1)^2 taps, row by row, the top left one first. With sum = the sum of
 * tap times pixel, a result is
 *
 *     round(sum / (divisor << shift)) + bias      halves upward; a divisor of 0 stands for 1
 *
 * limited to 0..255 or, in the _s16 forms, to -32768..32767. With `absolute` it is |sum| that is
 * divided. Sums: 3x3 -293760..291465, 5x5 -816000..809625.
 */
typedef struct pel_kernel {
    int8_t tap[25];
    uint8_t radius;   /* 1 or 2 */
    uint16_t divisor; /* 0..32767 */
    uint8_t shift;    /* 0..15 */
    uint8_t absolute; /* 0 or 1 */
    int16_t bias;
} pel_kernel;

/*
 * The named kernels; NULL for a name that is none. A program that calls this holds the whole table,
 * 1 KiB. All as correlations (tap k meets pixel k):
 *   identity                            box3      all 1 / 9
 *   shift_left shift_right shift_up shift_down    the picture moves by one pixel
 *   gauss3      1 2 1 / 2 4 2 / 1 2 1, / 16       binomial5  1 4 6 4 1 squared, / 256
 *   gauss5      sigma 1, rounded, sum 256: 1 3 6 3 1 / 3 15 25 15 3 / 6 25 44 25 6 / ...
 *   sobel_x     -1 0 1 / -2 0 2 / -1 0 1          sobel_y    its transpose: grows downward
 *   scharr_x    -3 0 3 / -10 0 10 / -3 0 3        scharr_y
 *   prewitt_x   -1 0 1, three times               prewitt_y
 *   laplacian   0 1 0 / 1 -4 1 / 0 1 0            laplacian_negative  the same with a centre of +4
 *   sharpen     2 identity - box: -1, centre 17, / 9      sharpen5   centre 5, its 4 neighbours -1
 *   emboss      -2 -1 0 / -1 1 1 / 0 1 2
 */
const pel_kernel *pel_kernel_named(const char *name);

/* The name of the i-th named kernel, NULL behind the last. */
const char *pel_kernel_name(unsigned i);

/* The kernel turned by half a turn. Filtering computes correlations, as everybody does; filtering
 * with the flipped kernel is the convolution of the textbooks. */
pel_kernel pel_kernel_flipped(const pel_kernel *kernel);

/* ---- Operators ----------------------------------------------------------------------------- */

struct pel_filter_config;

/*
 * An operator computes a row of the result: `count` pixels into `out`. rows[0 .. 2r] are the rows
 * from r above to r below; each points at the pixel above, at or below the first result, and r
 * pixels on either side of the `count` ones may be read. `config` is that of the filter, with the
 * backend that it chose. `out` is none of the rows. It returns its radius r, 1 or 2; to learn it,
 * it is also called with a count of 0, and then rows and out are NULL.
 *
 * An operator is asked for by its function, so that a program holds those that it names and no
 * others (on x86 pel_filter_frame holds seven itself). One of your own is as good as these:
 *
 *     static unsigned brighter_above(const uint8_t *const rows[], uint16_t count,
 *                                    const pel_filter_config *config, uint8_t *out)
 *     {
 *         (void)config;
 *         for (uint16_t x = 0; x < count; x++)
 *             out[x] = rows[0][x] > rows[1][x] ? 255 : 0;
 *         return 1;
 *     }
 */
typedef unsigned pel_filter_op(const uint8_t *const rows[], uint16_t count,
                               const struct pel_filter_config *config, uint8_t *out);

/* The same with signed 16-bit results. */
typedef unsigned pel_filter_op_s16(const uint8_t *const rows[], uint16_t count,
                                   const struct pel_filter_config *config, int16_t *out);

/* The named kernels of these names, byte for byte, but several times as fast as by their taps. */
pel_filter_op pel_op_gauss3, pel_op_box3, pel_op_binomial5;
pel_filter_op_s16 pel_op_sobel_x_s16, pel_op_sobel_y_s16;

/* |gx| + |gy| of Sobel, 0..1530, in 8 bits limited to 255. */
pel_filter_op pel_op_gradient_abs;
pel_filter_op_s16 pel_op_gradient_abs_s16;

/* sqrt(gx^2 + gy^2) of Sobel, rounded down, 0..1140, in 8 bits limited to 255. */
pel_filter_op pel_op_gradient;
pel_filter_op_s16 pel_op_gradient_s16;

/* atan2(gy, gx) of Sobel in 1/256 of a turn, nearest, 0..255: 0 = brighter to the right, 64 =
 * brighter below; 0 where there is no gradient. */
pel_filter_op pel_op_direction;

/* The fifth of the nine; the smallest: erosion of bright areas; the largest: dilation. */
pel_filter_op pel_op_median, pel_op_min, pel_op_max;

/* Of labels: the most frequent of the nine; of several, the pixel's own if it is one of them, else
 * the smallest. */
pel_filter_op pel_op_majority;

/* The label if all nine are it, else 0. */
pel_filter_op pel_op_erode_labels;

/* The pixel's own label; where that is 0, the smallest one around. */
pel_filter_op pel_op_dilate_labels;

/* ---- Streaming ----------------------------------------------------------------------------- */

/*
 * Bytes of working memory for a filter of radius r: 2r + 1 rows with r pixels on either side. WRAP
 * needs r rows more. The macros are constant expressions; the function takes the border.
 */
#define PEL_FILTER_BYTES(width, radius)                                                            \
    ((uint32_t)(2 * (radius) + 1) * ((uint32_t)(width) + 2 * (radius)))
#define PEL_FILTER_BYTES_WRAP(width, radius)                                                       \
    ((uint32_t)(3 * (radius) + 1) * ((uint32_t)(width) + 2 * (radius)))
uint32_t pel_filter_bytes(uint16_t width, unsigned radius, pel_border border);

/* What to compute: `op` in 8 bits, `op_s16` in 16 bits, or both if their radius is the same; where
 * both are NULL, the sums of `kernel`, in either. Width, height and work must be set; zero is a
 * sane value for the rest. */
typedef struct pel_filter_config {
    pel_filter_op *op;
    pel_filter_op_s16 *op_s16;
    const pel_kernel *kernel; /* not copied */
    uint16_t width, height;   /* 1..PEL_SIDE_MAX; for VALID at least 2r + 1 */
    pel_border border;
    pel_backend backend;         /* resolved by begin */
    uint8_t constant;            /* the value outside for PEL_BORDER_CONSTANT */
    const uint8_t *last_rows[2]; /* for PEL_BORDER_WRAP: the last r rows of the picture, upper one
                                    first (of a picture with fewer rows: rows -r.. of it, wrapped);
                                    read by begin only */
    void *work;                  /* any alignment; in use until the last row is pulled */
    size_t work_bytes;
} pel_filter_config;

/* A filter at work. The caller places it (under 100 bytes); private but for `row`. */
typedef struct pel_filter {
    pel_filter_config config;
    uint16_t pushed;
    uint16_t row; /* how many rows have been pulled */
    uint8_t radius;
    uint8_t slot;
    int16_t left[2], right[2];
} pel_filter;

/* The size of the result: that of the picture, or 2r less each way for VALID. */
uint16_t pel_filter_width(const pel_filter_config *config);
uint16_t pel_filter_height(const pel_filter_config *config);

/*
 * Starts a picture. PEL_ERR_ARG: null pointer, unknown border or backend, a radius, divisor or
 * shift out of range, two radii, WRAP without last_rows. PEL_ERR_RANGE: a side is 0, over
 * PEL_SIDE_MAX, or too small for VALID. PEL_ERR_SPACE: work_bytes too small.
 */
pel_status pel_filter_begin(pel_filter *filter, const pel_filter_config *config);

/* Adds the next row. PEL_ERR_ARG: null pointer. PEL_ERR_ORDER: no row is due, or a row that is
 * ready has not been pulled. */
pel_status pel_filter_push(pel_filter *filter, const uint8_t *row);

/* Computes the next row of the result, if the rows that it needs are there: PEL_OK. PEL_ERR_ORDER:
 * not yet, or all done; nothing is written. PEL_ERR_ARG: null pointer. PEL_ERR_FORMAT: only op_s16
 * is set. */
pel_status pel_filter_pull(pel_filter *filter, uint8_t *out);

/* The same with signed 16-bit results; PEL_ERR_FORMAT: only op is set. */
pel_status pel_filter_pull_s16(pel_filter *filter, int16_t *out);

/* ---- Whole frames -------------------------------------------------------------------------- */

/*
 * Filters a GRAY8 view: the results are those of push and pull. (With the vector instructions of
 * x86 rows are read where they lie; an operator is then called for parts of rows, and for several
 * rows at once.) config.width, height and last_rows are filled in. `dst` has the size of the
 * result. It may be the same pixels as `src` (same plane and stride); otherwise they must not
 * overlap. PEL_ERR_FORMAT: not GRAY8. PEL_ERR_SPACE: dst has another size. PEL_ERR_ARG: overlap,
 * null pointer. Others as of begin and pull.
 */
pel_status pel_filter_frame(const pel_filter_config *config, const pel_cview *src,
                            const pel_view *dst);

/* The same into 16-bit results: row y begins at dst + y * stride, stride in elements. Never in
 * place. PEL_ERR_RANGE: the stride is shorter than a row or reaches over 2^31 bytes. */
pel_status pel_filter_frame_s16(const pel_filter_config *config, const pel_cview *src, int16_t *dst,
                                int32_t stride);

/*
 * Opening and closing: a filter and, on its result, another, both with the border, kernel and
 * working memory of config; for opening pel_op_min then pel_op_max, for closing the other way
 * round; NULL is the kernel. dst has the size of src, and holds the first result in between. VALID
 * is refused (PEL_ERR_ARG). In place and all else as above.
 */
pel_status pel_filter_twice(const pel_filter_config *config, pel_filter_op *first,
                            pel_filter_op *second, const pel_cview *src, const pel_view *dst);

#ifdef __cplusplus
}
#endif

#endif
