/* What the operators of `pel bench` do: the functions of bench_op, shared by relatives. */
#ifndef BENCHRUNS_H
#define BENCHRUNS_H

#include "benchops.h"

/* YUYV to blobs of 20 pixels and more, 4-connected, with memory with which nothing can be lost;
 * choice: PEL_MEASURE_ bits. Finished: rows of BENCH_BLOB_COLUMNS int64_t. */
enum { BENCH_BLOB_COLUMNS = 14, BENCH_BLOB_BASIC_COLUMNS = 8, BENCH_BLOB_AREA_MIN = 20 };
int benchruns_start_blobs(bench_job *job);
pel_status benchruns_blobs(bench_job *job);
void benchruns_finish_blobs(bench_job *job);

int benchruns_start_classify(bench_job *job);
pel_status benchruns_classify(bench_job *job);

/* Labels to runs: of every row their number and their ends, uint16_t. */
int benchruns_start_runs(bench_job *job);
pel_status benchruns_runs(bench_job *job);

/* YUYV to three planes, to R G B, and between colour spaces of three bytes. */
int benchruns_start_three(bench_job *job);
pel_status benchruns_planes(bench_job *job);
pel_status benchruns_rgb(bench_job *job);
pel_status benchruns_ycbcr(bench_job *job);
pel_status benchruns_hsv(bench_job *job);
pel_status benchruns_nrgb(bench_job *job);
pel_status benchruns_white_balance(bench_job *job);

/* Filters, into 8 or 16 bits. */
int benchruns_start_filter(bench_job *job);
int benchruns_start_filter_s16(bench_job *job);
pel_status benchruns_filter(bench_job *job);
pel_status benchruns_filter_s16(bench_job *job);
pel_status benchruns_filter_twice(bench_job *job);

/* Gray to gray of the same size. */
int benchruns_start_gray(bench_job *job);
int benchruns_start_threshold(bench_job *job); /* 127 */
int benchruns_start_gamma(bench_job *job);     /* brighter by 2 */
pel_status benchruns_table(bench_job *job);
pel_status benchruns_equalize(bench_job *job);
int benchruns_start_combine(bench_job *job);
pel_status benchruns_combine(bench_job *job); /* choice: pel_combine_op */
pel_status benchruns_blend(bench_job *job);   /* a quarter of it, the rest of the turned one */
int benchruns_start_adaptive(bench_job *job); /* 15x15, c 5 */
pel_status benchruns_adaptive(bench_job *job);
int benchruns_start_resize(bench_job *job); /* choice: pel_resize_method; to 5/8, box to 1/2 */
pel_status benchruns_resize(bench_job *job);

int benchruns_start_histogram(bench_job *job);
pel_status benchruns_histogram(bench_job *job);
int benchruns_start_integral(bench_job *job);
pel_status benchruns_integral(bench_job *job);

/* Responses of every pixel, int32_t; choice: pel_corners_method. */
int benchruns_start_responses(bench_job *job);
pel_status benchruns_responses(bench_job *job);

int benchruns_start_canny(bench_job *job); /* 100, 200 */
pel_status benchruns_canny(bench_job *job);

#endif
