/*
 * Point operations and their relatives on 8-bit rows: tables of 256 entries, histograms and what
 * follows from them, rows combined with rows, integral rows, resizing, white balance.
 *
 * Rows are bytes. What works on each byte alone takes a count of bytes, so that it serves gray rows
 * (width) and packed R G B rows (3 * width) alike. The frame forms are nothing but loops over the
 * rows; they take GRAY8 and, where it says so, RGB888 and BGR888 ("byte formats"), and answer
 * PEL_ERR_FORMAT for the rest.
 *
 * Where it says "in place", source and destination may be the same bytes (same pointer, and in
 * frames the same stride). In frames any other overlap is refused with PEL_ERR_ARG.
 *
 * Statuses that all functions share: PEL_ERR_ARG for a null pointer or a value outside its stated
 * range; the frame forms also those of pel_cview_check, and PEL_ERR_SPACE for a destination of
 * another size or PEL_ERR_FORMAT for one of another format than the source.
 *
 * Everything runs on the best backend that there is (pel/backend.h). Objects have a field in their
 * config to choose another one; pel_..._frame_with is pel_..._frame on a backend of choice.
 */
#ifndef PEL_POINT_H
#define PEL_POINT_H

#include "pel/backend.h"
#include "pel/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Tables -------------------------------------------------------------------------------- */

/*
 * A table is an array of 256 bytes: out = table[in]. All of these write it whole, from exact
 * integer arithmetic: round is to nearest, halves upward, and results are limited to 0..255.
 */

/* out = 255 - in */
pel_status pel_table_invert(uint8_t table[256]);

/* out = in > threshold ? 255 : 0, as OpenCV's THRESH_BINARY. */
pel_status pel_table_threshold(uint8_t threshold, uint8_t table[256]);

/* out = in + offset. offset: any. (A brightness of 0.15 of full scale is +38.) */
pel_status pel_table_brightness(int16_t offset, uint8_t table[256]);

/* out = pivot + round((in - pivot) * alpha / divisor): contrast alpha / divisor around a gray that
 * stays as it is. |alpha| <= 2^21, divisor: 1..2^21. */
pel_status pel_table_contrast(int32_t alpha, int32_t divisor, uint8_t pivot, uint8_t table[256]);

/*
 * out = round((in * alpha + beta) / divisor): contrast and brightness in one. A contrast of 1.3 and
 * a brightness of 40 is (13, 400, 10); q8 numbers have the divisor 256; stretching low..high to
 * 0..255 is (255, -255 * low, high - low). |alpha| <= 2^21, |beta| <= 2^29, divisor: 1..2^30.
 */
pel_status pel_table_linear(int32_t alpha, int32_t beta, int32_t divisor, uint8_t table[256]);

/*
 * Power curves: out = round(255 * (in / 255)^exponent), exact, with a rational exponent, so that
 * nobody has to guess whether "gamma" means the exponent or one over it:
 *
 *   pel_table_gamma_exponent   exponent = numerator / denominator, as it stands
 *   pel_table_gamma_brighten   exponent = denominator / numerator: a gamma of 5/2 has the exponent
 *                              0.4 and makes dark grays brighter (16 -> 84)
 *   pel_table_gamma_darken     exponent = numerator / denominator: a gamma of 5/2 makes them darker
 *                              (16 -> 0, 128 -> 46)
 *
 * Both numbers: 1..PEL_GAMMA_TERM_MAX, so all exponents of one decimal up to 3.2. brighten and
 * darken refuse a gamma under 1 (numerator < denominator), which would do the opposite of their
 * name, with PEL_ERR_RANGE. Time: 511 comparisons of integers of up to 288 bits; the larger the two
 * numbers, the longer. Compute it once, or keep it in flash.
 */
#define PEL_GAMMA_TERM_MAX 32
pel_status pel_table_gamma_exponent(unsigned numerator, unsigned denominator, uint8_t table[256]);
pel_status pel_table_gamma_brighten(unsigned numerator, unsigned denominator, uint8_t table[256]);
pel_status pel_table_gamma_darken(unsigned numerator, unsigned denominator, uint8_t table[256]);

/* dst[i] = table[src[i]] for `count` bytes. In place. */
pel_status pel_table_row(const uint8_t table[256], const uint8_t *src, uint16_t count,
                         uint8_t *dst);

/* The same for a frame of a byte format, on every channel. In place. */
pel_status pel_table_frame(const uint8_t table[256], const pel_cview *src, const pel_view *dst);
pel_status pel_table_frame_with(const uint8_t table[256], const pel_cview *src, const pel_view *dst,
                                pel_backend backend);

/* ---- Histograms ---------------------------------------------------------------------------- */

/*
 * A histogram is an array of 256 counts. Set it to 0, add rows, read it. The functions that read
 * one take up to PEL_SIDE_MAX^2 = 2^26 values in total and answer PEL_ERR_RANGE for more,
 * PEL_ERR_ARG for none.
 */

/* Adds the bytes src[0], src[step], src[2 * step], ... `count` of them. step: 1 for gray, 3 for one
 * channel of R G B. */
pel_status pel_histogram_row(const uint8_t *src, unsigned step, uint16_t count, uint32_t bins[256]);

/* The histogram of one channel of a frame of a byte format (a clean one: `bins` is set to 0 first).
 * channel: 0 for GRAY8; 0..2 in the order of the bytes for RGB888 and BGR888. */
pel_status pel_histogram_frame(const pel_cview *src, unsigned channel, uint32_t bins[256]);
pel_status pel_histogram_frame_with(const pel_cview *src, unsigned channel, uint32_t bins[256],
                                    pel_backend backend);

/* cumulative[i] = bins[0] + ... + bins[i]. May be the same array. */
pel_status pel_histogram_cumulative(const uint32_t bins[256], uint32_t cumulative[256]);

/* What a histogram says of its values. */
typedef struct pel_histogram_stats {
    uint64_t sum;         /* of the values, under 2^34 */
    uint64_t sum_squares; /* of their squares, under 2^42 */
    uint32_t count;
    uint32_t mean_q8;     /* sum / count, rounded */
    uint32_t variance_q8; /* sum_squares / count - (sum / count)^2, exact until it is rounded */
    uint8_t min, max;
} pel_histogram_stats;

pel_status pel_histogram_measure(const uint32_t bins[256], pel_histogram_stats *stats);

/* The smallest value that occurs and that at least permille / 1000 of all values do not exceed
 * (nearest rank): 0 gives the minimum, 500 the lower median, 1000 the maximum. permille: 0..1000 */
pel_status pel_histogram_percentile(const uint32_t bins[256], uint16_t permille, uint8_t *value);

/*
 * Otsu's threshold (Otsu 1979), for pel_table_threshold: the t that splits the values into 0..t and
 * t+1..255 with the largest between-class variance, compared exactly; of several the smallest. 0 if
 * all values are equal. OpenCV computes the same in double precision; where two t are equally good
 * it may take another one.
 */
pel_status pel_histogram_otsu(const uint32_t bins[256], uint8_t *threshold);

/*
 * The table that equalises a histogram: with m the smallest value that occurs and C the cumulative
 * histogram, out = round(255 * (C(in) - C(m)) / (count - C(m))), and 0 below m. If all values are
 * equal, the table changes nothing. OpenCV's equalizeHist is the same formula in single precision.
 */
pel_status pel_table_equalize(const uint32_t bins[256], uint8_t table[256]);

/* ---- Two rows ------------------------------------------------------------------------------ */

typedef enum pel_combine_op {
    PEL_COMBINE_ADD = 0,  /* a + b, at most 255 */
    PEL_COMBINE_SUBTRACT, /* a - b, at least 0 */
    PEL_COMBINE_ABSDIFF,  /* |a - b| */
    PEL_COMBINE_MIN,
    PEL_COMBINE_MAX,
    PEL_COMBINE_AND, /* bit by bit */
    PEL_COMBINE_OR,
    PEL_COMBINE_XOR,
    PEL_COMBINE_OP_COUNT
} pel_combine_op;

/* dst[i] = a[i] op b[i] for `count` bytes. dst may be a or b (in place). */
pel_status pel_combine_row(pel_combine_op op, const uint8_t *a, const uint8_t *b, uint16_t count,
                           uint8_t *dst);
pel_status pel_combine_frame(pel_combine_op op, const pel_cview *a, const pel_cview *b,
                             const pel_view *dst);
pel_status pel_combine_frame_with(pel_combine_op op, const pel_cview *a, const pel_cview *b,
                                  const pel_view *dst, pel_backend backend);

/* dst[i] = round((a[i] * alpha + b[i] * (256 - alpha)) / 256); alpha_q8: 0..256. In place too. */
pel_status pel_blend_row(uint16_t alpha_q8, const uint8_t *a, const uint8_t *b, uint16_t count,
                         uint8_t *dst);
pel_status pel_blend_frame(uint16_t alpha_q8, const pel_cview *a, const pel_cview *b,
                           const pel_view *dst);
pel_status pel_blend_frame_with(uint16_t alpha_q8, const pel_cview *a, const pel_cview *b,
                                const pel_view *dst, pel_backend backend);

/* ---- Integral rows ------------------------------------------------------------------------- */

/*
 * Integral rows (Crow 1984), as OpenCV's integral: a picture of W x H has H + 1 rows of W + 1 sums,
 * and sums[y][x] is the sum of all pixels left of x and above y. The first row and the first column
 * are 0.
 *
 * `width` pixels and the sums of the row above give the next row of sums; above = NULL stands for
 * the first row, of zeros. `sums` may be `above`: then one row of memory is all there is. 1 <=
 * width <= PEL_SIDE_MAX, otherwise PEL_ERR_RANGE.
 *
 * A white picture of more than PEL_INTEGRAL_PIXELS_MAX pixels goes over 2^32 and wraps. Sums of
 * boxes are differences and come out right all the same if the box has no more pixels than that.
 */
#define PEL_INTEGRAL_PIXELS_MAX 16843009u /* floor((2^32 - 1) / 255) */
pel_status pel_integral_row(const uint8_t *src, uint16_t width, const uint32_t *above,
                            uint32_t *sums);

/* All H + 1 rows of a GRAY8 frame; row y begins at sums + y * stride (in elements, at least W + 1,
 * otherwise PEL_ERR_SPACE). PEL_ERR_RANGE: more than PEL_INTEGRAL_PIXELS_MAX pixels. */
pel_status pel_integral_frame(const pel_cview *src, uint32_t *sums, uint32_t stride);
pel_status pel_integral_frame_with(const pel_cview *src, uint32_t *sums, uint32_t stride,
                                   pel_backend backend);

/* The sum of the pixels x0 <= x < x1, y0 <= y < y1, from the rows y0 (top) and y1 (bottom) of sums.
 * Not checked. */
uint32_t pel_integral_box(const uint32_t *top, const uint32_t *bottom, uint16_t x0, uint16_t x1);

/* ---- Adaptive threshold -------------------------------------------------------------------- */

/*
 * A pixel becomes 255 where it is larger than the mean of the (2 radius + 1)^2 pixels around it
 * minus c, and 0 elsewhere: OpenCV's ADAPTIVE_THRESH_MEAN_C with THRESH_BINARY, byte for byte. The
 * mean is rounded to nearest (of an odd number of pixels it is never a half); outside the picture
 * its edge repeats. Ink on paper: a positive c, and pel_table_invert on the result if the ink is to
 * be white.
 *
 * Streaming as in pel/filter.h: push a row, pull what is ready; the first `radius` pushes give
 * nothing, the last gives radius + 1 rows.
 *
 * Memory: the 2 radius + 1 rows of the window and a 16-bit sum for each column.
 */
#define PEL_ADAPTIVE_RADIUS_MAX 127 /* column sums of up to 255 * 255 = 65025 */
#define PEL_ADAPTIVE_BYTES(width, radius) ((uint32_t)(width) * (2u * (uint32_t)(radius) + 3u))
uint32_t pel_adaptive_bytes(uint16_t width, unsigned radius);

typedef struct pel_adaptive_config {
    uint16_t width, height; /* 1..PEL_SIDE_MAX */
    uint8_t radius;         /* 1..PEL_ADAPTIVE_RADIUS_MAX */
    int16_t c;              /* -255..255 */
    void *work;             /* aligned for uint16_t; in use until the last row is pulled */
    size_t work_bytes;      /* at least PEL_ADAPTIVE_BYTES(width, radius) */
    pel_backend backend;    /* 0 = the best that there is; results are the same */
} pel_adaptive_config;

/* An adaptive threshold at work. The caller places it (under 64 bytes); private but for `row`. */
typedef struct pel_adaptive {
    pel_adaptive_config config;
    uint16_t pushed;
    uint16_t row; /* how many rows have been pulled */
    uint8_t state;
} pel_adaptive;

/* Starts a picture. PEL_ERR_ARG: also misaligned work. PEL_ERR_RANGE: a side is 0 or over
 * PEL_SIDE_MAX. PEL_ERR_SPACE: work_bytes too small. */
pel_status pel_adaptive_begin(pel_adaptive *adaptive, const pel_adaptive_config *config);

/* Adds the next row, which may be overwritten at once. PEL_ERR_ORDER: no row is due, or a row that
 * is ready has not been pulled. */
pel_status pel_adaptive_push(pel_adaptive *adaptive, const uint8_t *row);

/* Gives the next row of the result, `width` bytes, any place but in `work`. PEL_ERR_ORDER: not
 * ready yet, or all done; nothing is written. */
pel_status pel_adaptive_pull(pel_adaptive *adaptive, uint8_t *out);

/* A whole GRAY8 frame; width and height of the config are filled in. In place. */
pel_status pel_adaptive_frame(const pel_adaptive_config *config, const pel_cview *src,
                              const pel_view *dst);

/* ---- Resizing ------------------------------------------------------------------------------ */

/* Sizes: w -> W columns and likewise h -> H rows. Columns are named x in the source, X in the
 * result. */
typedef enum pel_resize_method {
    /* x = floor(X * w / W): OpenCV's INTER_NEAREST. Any sizes. The sample is the top left one of
     * those that a result pixel covers, not the middle one. */
    PEL_RESIZE_NEAREST = 0,

    /* The mean of w / W times h / H pixels, rounded: OpenCV's INTER_AREA. w and h must be multiples
     * of W and H, with at most 65536 pixels to the mean, otherwise PEL_ERR_RANGE. */
    PEL_RESIZE_BOX,

    /*
     * Between the four neighbours of the point x = (X + 1/2) * w / W - 1/2, the centre of the pixel
     * (OpenCV's INTER_LINEAR, within 1). With i = floor(x) and f = round(2048 * (x - i)), and i =
     * 0, f = 0 left of the first centre and i = w - 1, f = 0 right of the last; the same in y with
     * j, g:
     *   out = round(((2048-g) * ((2048-f) * p[j][i] + f * p[j][i+1])
     *                   + g   * ((2048-f) * p[j+1][i] + f * p[j+1][i+1])) / 2^22)
     * The sum is at most 255 * 2^22 < 2^30; there is no rounding on the way. Shrinking to less than
     * half leaves pixels out; use BOX first.
     */
    PEL_RESIZE_BILINEAR,
    PEL_RESIZE_METHOD_COUNT
} pel_resize_method;

/*
 * Bytes of working memory: a source row; a 32-bit sum for each result column and channel; or two
 * source rows and 4 bytes for each result column. As an array of uint32_t: PEL_RESIZE_WORDS(bytes).
 * pel_resize_bytes reads method, widths and channels of the config; 0 if they are unknown.
 */
#define PEL_RESIZE_NEAREST_BYTES(width_in, channels) ((uint32_t)(width_in) * (channels))
#define PEL_RESIZE_BOX_BYTES(width_out, channels) (4u * (uint32_t)(width_out) * (channels))
#define PEL_RESIZE_BILINEAR_BYTES(width_in, width_out, channels)                                   \
    (2u * (uint32_t)(width_in) * (channels) + 4u * (uint32_t)(width_out))
#define PEL_RESIZE_WORDS(bytes) (((bytes) + 3u) / 4u)

typedef struct pel_resize_config {
    pel_resize_method method;
    uint8_t channels;               /* 1 (or 0) for gray, 3 for R G B */
    uint16_t width_in, height_in;   /* 1..PEL_SIDE_MAX */
    uint16_t width_out, height_out; /* 1..PEL_SIDE_MAX */
    void *work;                     /* aligned for uint32_t; in use until the last row is pulled */
    size_t work_bytes;
    pel_backend backend; /* 0 = the best that there is; results are the same */
} pel_resize_config;

uint32_t pel_resize_bytes(const pel_resize_config *config);

/* A resize at work. The caller places it (under 80 bytes); private but for `row`. */
typedef struct pel_resize {
    pel_resize_config config;
    uint16_t pushed;
    uint16_t row; /* how many rows have been pulled */
    uint8_t state;
} pel_resize;

/* Starts a picture. PEL_ERR_ARG: also misaligned work, unknown method, channels not 0, 1, 3.
 * PEL_ERR_RANGE: a side is 0 or over PEL_SIDE_MAX, or BOX and not a whole factor. PEL_ERR_SPACE:
 * work_bytes too small. */
pel_status pel_resize_begin(pel_resize *resize, const pel_resize_config *config);

/*
 * Adds the next row, width_in * channels bytes, which may be overwritten at once. Every row is
 * pushed, also one that the result leaves out. PEL_ERR_ORDER: no row is due, or a row that is ready
 * has not been pulled.
 */
pel_status pel_resize_push(pel_resize *resize, const uint8_t *row);

/* Gives the next row of the result, width_out * channels bytes, any place but in `work`.
 * PEL_ERR_ORDER: not ready yet, or all done; nothing is written. */
pel_status pel_resize_pull(pel_resize *resize, uint8_t *out);

/* A whole frame of a byte format to the size of `dst`; sizes and channels of the config are filled
 * in. Never in place. */
pel_status pel_resize_frame(const pel_resize_config *config, const pel_cview *src,
                            const pel_view *dst);

/* ---- White balance ------------------------------------------------------------------------- */

/* Sums over pixels, by channel: R, G, B. Set to 0, add rows (of a gray patch, or all of them). */
typedef struct pel_rgb_sums {
    uint64_t sum[3]; /* at most 2^26 pixels * 255 < 2^34 */
    uint32_t count;  /* pixels */
} pel_rgb_sums;

/* Adds `width` pixels R G B. PEL_ERR_RANGE: more than PEL_SIDE_MAX^2 pixels in total. */
pel_status pel_rgb_sums_row(const uint8_t *rgb, uint16_t width, pel_rgb_sums *sums);

/* The sums of an RGB888 or BGR888 view (clean ones); a patch is a crop. Always in the order R, G,
 * B. */
pel_status pel_rgb_sums_frame(const pel_cview *src, pel_rgb_sums *sums);

/*
 * Gains for R, G, B. gray_patch: from pixels that are gray or white in truth: each channel gets the
 * mean of green, gain = G / channel (that of green is 1). gray_world: from a whole picture,
 * supposing that it is gray on average (Buchsbaum 1980): gain = (R + G + B) / (3 * channel).
 * Rounded to 1/256, halves upward. PEL_ERR_RANGE: a channel's sum is 0 or a gain goes over 65535 /
 * 256.
 */
pel_status pel_gains_gray_patch(const pel_rgb_sums *sums, uint16_t gains_q8[3]);
pel_status pel_gains_gray_world(const pel_rgb_sums *sums, uint16_t gains_q8[3]);

/* out = round(channel * gain / 256), at most 255, for `width` pixels R G B. In place. */
pel_status pel_white_balance_row(const uint16_t gains_q8[3], const uint8_t *rgb, uint16_t width,
                                 uint8_t *dst);

/* The same for an RGB888 or BGR888 frame (the gains are R, G, B for both). In place. */
pel_status pel_white_balance_frame(const uint16_t gains_q8[3], const pel_cview *src,
                                   const pel_view *dst);
pel_status pel_white_balance_frame_with(const uint16_t gains_q8[3], const pel_cview *src,
                                        const pel_view *dst, pel_backend backend);

#ifdef __cplusplus
}
#endif

#endif
