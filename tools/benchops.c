#include "benchops.h"

#include <stdlib.h>
#include <string.h>

#include "benchcompare.h"
#include "benchruns.h"
#include "say.h"

/* How the result of OpenCV's job is compared: the function and its limit. */
#define SAME benchcompare_same, 0
#define WITHIN(limit_) benchcompare_bytes, limit_
#define TURNS benchcompare_turns, 1
#define HSV benchcompare_hsv, 1
#define COLORS benchcompare_rgb, 1
#define RESPONSES benchcompare_responses, 0
#define ALONE NULL, 0 /* no job of OpenCV's, or one with another result */

#define BLOBS(name_, summary_, measure_)                                                           \
    {                                                                                              \
        name_, summary_, BENCH_YUYV, 1, benchruns_start_blobs, benchruns_blobs,                    \
            benchruns_finish_blobs, NULL, NULL, NULL, NULL, measure_, benchcompare_blobs, 0        \
    }
#define JOB(name_, summary_, form_, start_, run_, fits_)                                           \
    {                                                                                              \
        name_, summary_, BENCH_##form_, 0, benchruns_start_##start_, benchruns_##run_, NULL, NULL, \
            NULL, NULL, NULL, 0, fits_                                                             \
    }
#define POINT(name_, summary_, form_, start_, run_, fits_)                                         \
    {                                                                                              \
        name_, summary_, BENCH_##form_, 1, benchruns_start_##start_, benchruns_##run_, NULL, NULL, \
            NULL, NULL, NULL, 0, fits_                                                             \
    }
#define POINT_OF(name_, summary_, work_, choice_, fits_)                                           \
    {                                                                                              \
        name_, summary_, BENCH_GRAY, 1, benchruns_start_##work_, benchruns_##work_, NULL, NULL,    \
            NULL, NULL, NULL, choice_, fits_                                                       \
    }
#define FILTER(name_, summary_, form_, op_, fits_)                                                 \
    {                                                                                              \
        name_, summary_, BENCH_##form_, 1, benchruns_start_filter, benchruns_filter, NULL,         \
            pel_op_##op_, NULL, NULL, NULL, 0, fits_                                               \
    }
#define WIDE(name_, summary_, op_, fits_)                                                          \
    {                                                                                              \
        name_, summary_, BENCH_GRAY, 1, benchruns_start_filter_s16, benchruns_filter_s16, NULL,    \
            NULL, NULL, pel_op_##op_##_s16, NULL, 0, fits_                                         \
    }
#define TWICE(name_, summary_, op_, then_, fits_)                                                  \
    {                                                                                              \
        name_, summary_, BENCH_GRAY, 1, benchruns_start_filter, benchruns_filter_twice, NULL,      \
            pel_op_##op_, pel_op_##then_, NULL, NULL, 0, fits_                                     \
    }
#define KERNEL(name_, summary_, bits_, kernel_, fits_)                                             \
    {                                                                                              \
        name_, summary_, BENCH_GRAY, 1, benchruns_start_filter##bits_, benchruns_filter##bits_,    \
            NULL, NULL, NULL, NULL, kernel_, 0, fits_                                              \
    }

/* In the order in which they are printed. */
/* clang-format off: a line each */
const bench_op bench_ops[] = {
    BLOBS("blobs", "YUYV to blobs: area, box, centroid", 0),
    BLOBS("blobs-all", "with moments and outline", PEL_MEASURE_MOMENTS | PEL_MEASURE_OUTLINE),
    {"classify", "YUYV to labels", BENCH_YUYV, 1, benchruns_start_classify, benchruns_classify,
     NULL, NULL, NULL, NULL, NULL, 0, SAME},
    {"classify-rgb", "R G B to labels", BENCH_RGB, 1, benchruns_start_classify, benchruns_classify,
     NULL, NULL, NULL, NULL, NULL, 0, ALONE},
    JOB("runs", "labels to runs", LABELS, runs, runs, ALONE),
    JOB("planes", "YUYV to planes of Y, U and V", YUYV, three, planes, SAME),
    JOB("rgb", "YUYV to R G B", YUYV, three, rgb, COLORS),
    JOB("ycbcr", "R G B to Y U V", RGB, three, ycbcr, WITHIN(1)),
    JOB("hsv", "R G B to H S V", RGB, three, hsv, HSV),
    JOB("nrgb", "R G B to their shares of the sum", RGB, three, nrgb, ALONE),
    POINT("white-balance", "R G B times three gains", RGB, three, white_balance, ALONE),
    FILTER("gauss3", "3x3 Gaussian", GRAY, gauss3, SAME),
    FILTER("box3", "3x3 mean", GRAY, box3, SAME),
    FILTER("binomial5", "5x5 binomial", GRAY, binomial5, SAME),
    WIDE("sobel-x", "Sobel across, 16 bits", sobel_x, SAME),
    WIDE("sobel-y", "Sobel down, 16 bits", sobel_y, SAME),
    FILTER("gradient-abs", "|gx| + |gy| of Sobel", GRAY, gradient_abs, SAME),
    WIDE("gradient-abs-s16", "the same, 16 bits", gradient_abs, ALONE),
    FILTER("gradient", "sqrt(gx^2 + gy^2) of Sobel", GRAY, gradient, WITHIN(1)),
    WIDE("gradient-s16", "the same, 16 bits", gradient, ALONE),
    FILTER("direction", "atan2(gy, gx) of Sobel", GRAY, direction, TURNS),
    KERNEL("kernel3", "any 3x3 kernel: sharpen", , "sharpen", SAME),
    KERNEL("kernel3-s16", "any 3x3 kernel, 16 bits: laplacian", _s16, "laplacian", SAME),
    KERNEL("kernel5", "any 5x5 kernel: gauss5", , "gauss5", WITHIN(1)),
    FILTER("median", "3x3 median", GRAY, median, SAME),
    FILTER("min", "3x3 minimum: erosion", GRAY, min, SAME),
    FILTER("max", "3x3 maximum: dilation", GRAY, max, SAME),
    TWICE("open", "erosion, then dilation", min, max, SAME),
    TWICE("close", "dilation, then erosion", max, min, SAME),
    FILTER("majority", "most frequent label of nine", LABELS, majority, ALONE),
    FILTER("erode-labels", "the label if all nine are it", LABELS, erode_labels, ALONE),
    FILTER("dilate-labels", "labels grow into what has none", LABELS, dilate_labels, ALONE),
    POINT("threshold", "over 127 or not", GRAY, threshold, table, SAME),
    POINT("table", "256 entries: gamma", GRAY, gamma, table, SAME),
    POINT("histogram", "how often each value occurs", GRAY, histogram, histogram, SAME),
    POINT("equalize", "histogram, table, applied", GRAY, gray, equalize, WITHIN(1)),
    POINT("adaptive", "over the 15x15 mean minus 5", GRAY, adaptive, adaptive, SAME),
    POINT("integral", "sums from the top left corner", GRAY, integral, integral, SAME),
    POINT_OF("add", "two pictures: sum, at most 255", combine, PEL_COMBINE_ADD, SAME),
    POINT_OF("subtract", "difference, at least 0", combine, PEL_COMBINE_SUBTRACT, SAME),
    POINT_OF("absdiff", "size of the difference", combine, PEL_COMBINE_ABSDIFF, SAME),
    POINT_OF("smaller", "the smaller of each two", combine, PEL_COMBINE_MIN, SAME),
    POINT_OF("larger", "the larger of each two", combine, PEL_COMBINE_MAX, SAME),
    POINT_OF("and", "bits of both", combine, PEL_COMBINE_AND, SAME),
    POINT_OF("or", "bits of one or both", combine, PEL_COMBINE_OR, SAME),
    POINT_OF("xor", "bits of one of them", combine, PEL_COMBINE_XOR, SAME),
    POINT("blend", "a quarter of one, the rest of another", GRAY, gray, blend, WITHIN(1)),
    POINT_OF("resize", "bilinear, to 5/8", resize, PEL_RESIZE_BILINEAR, WITHIN(1)),
    POINT_OF("resize-box", "means of 2x2", resize, PEL_RESIZE_BOX, SAME),
    POINT_OF("resize-nearest", "one of the pixels, to 5/8", resize, PEL_RESIZE_NEAREST, SAME),
    POINT_OF("harris", "Harris responses", responses, PEL_CORNERS_HARRIS, RESPONSES),
    POINT_OF("shi-tomasi", "Shi-Tomasi responses", responses, PEL_CORNERS_SHI_TOMASI, RESPONSES),
    POINT_OF("fast", "FAST-9 responses", responses, PEL_CORNERS_FAST9, ALONE),
    POINT("canny", "edges with hysteresis", GRAY, canny, canny, SAME),
};
/* clang-format on */

const unsigned bench_op_count = sizeof bench_ops / sizeof bench_ops[0];

void *benchops_take(bench_job *job, size_t bytes)
{
    if (job->blocks == BENCH_BLOCKS) {
        return NULL;
    }
    void *block = calloc(1, bytes ? bytes : 1);
    job->block[job->blocks] = block;
    job->blocks += block != NULL;
    return block;
}

int benchops_start(bench_job *job, const bench_op *op, const bench_picture *picture,
                   pel_backend backend)
{
    memset(job, 0, sizeof *job);
    job->op = op;
    job->picture = picture;
    job->backend = backend;
    job->in = benchpicture_view(picture, op->form);
    job->other = benchpicture_view(picture, BENCH_TURNED);
    return op->start(job)
               ? say_error("bench", "%s of %s cannot be prepared", op->name, picture->name)
               : 0;
}

int benchops_result(bench_job *job)
{
    const pel_status status = job->op->run(job);
    if (status != PEL_OK) {
        return say_error("bench", "%s of %s: %s", job->op->name, job->picture->name,
                         pel_status_name(status));
    }
    if (job->op->finish) {
        job->op->finish(job);
    }
    return 0;
}

void benchops_stop(bench_job *job)
{
    while (job->blocks > 0) {
        free(job->block[--job->blocks]);
    }
}
