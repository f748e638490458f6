/*
 * The operators of `pel bench`: one line each in the table of benchops.c. The line says what runs,
 * on which form of the picture, and how the result is compared with that of OpenCV's job of the
 * same name (bench_opencv.py).
 */
#ifndef BENCHOPS_H
#define BENCHOPS_H

#include "benchpicture.h"

typedef struct bench_job bench_job;

/* An operator. Its functions: start takes memory and fills configs, once; run is what is timed;
 * finish, if there is one, brings the result into `out` in the form that is compared. */
typedef struct bench_op {
    const char *name, *summary;
    bench_form form;              /* what is read */
    int has_backend;              /* 0: there is one way to run it */
    int (*start)(bench_job *job); /* 0, or -1 without memory */
    pel_status (*run)(bench_job *job);
    void (*finish)(bench_job *job);
    pel_filter_op *filter, *then; /* of filters; then: a second one */
    pel_filter_op_s16 *filter_s16;
    const char *kernel;
    int choice; /* what else tells relatives apart */
    /* How OpenCV's result is compared: 0 if it fits; NULL: no such job, or its result is another.
     */
    int (*fits)(const bench_job *job, const void *theirs, size_t bytes);
    int limit; /* how far a value may differ */
} bench_op;

/* The operators, and how many there are. */
extern const bench_op bench_ops[];
extern const unsigned bench_op_count;

/* An operator prepared for a picture and a backend. The objects refer to each other: it stays in
 * its place. */
enum { BENCH_BLOCKS = 6 };
struct bench_job {
    const bench_op *op;
    const bench_picture *picture;
    pel_backend backend;
    pel_cview in;              /* what run reads; another frame is read by another plane[0] */
    pel_cview other;           /* the second picture, where an operator has two */
    void *block[BENCH_BLOCKS]; /* memory of the job */
    unsigned blocks;
    uint8_t *out; /* the result */
    size_t out_bytes;
    pel_view out_view; /* of pictures */
    uint8_t *label_row;
    uint8_t table[256];
    uint32_t bins[256];
    uint32_t count;
    pel_classifier classifier;
    pel_classify_plan plan;
    pel_blob_filter blob_filter;
    pel_blobs_config blobs_config;
    pel_blobs blobs;
    pel_filter_config filter;
    pel_adaptive_config adaptive;
    pel_resize_config resize;
    pel_corners_config corners_config;
    pel_corners corners;
    pel_canny_config canny;
    void *stack;
};

/* Prepares; benchops_stop in any case. 0, or -1 after a message. */
int benchops_start(bench_job *job, const bench_op *op, const bench_picture *picture,
                   pel_backend backend);

/* Runs once and finishes: the result is in out. 0, or -1 after a message. */
int benchops_result(bench_job *job);

void benchops_stop(bench_job *job);

/* Memory that benchops_stop gives back, zeroed; NULL if there is none. */
void *benchops_take(bench_job *job, size_t bytes);

#endif
