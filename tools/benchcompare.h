/*
 * Whether OpenCV's result of a job is ours. Each: 0 if it fits, or -1 after a message that says
 * where it does not.
 */
#ifndef BENCHCOMPARE_H
#define BENCHCOMPARE_H

#include "benchops.h"

/* Bytes, each within the operator's limit. */
int benchcompare_bytes(const bench_job *job, const void *theirs, size_t bytes);

/* The same where 255 and 0 are neighbours. */
int benchcompare_turns(const bench_job *job, const void *theirs, size_t bytes);

/* H, S, V: H as turns, S and V as bytes. */
int benchcompare_hsv(const bench_job *job, const void *theirs, size_t bytes);

/* R, G, B from YUYV of limited range. OpenCV takes Y below 16 for 16; such pixels are left out. */
int benchcompare_rgb(const bench_job *job, const void *theirs, size_t bytes);

/* Equal, whatever they are. */
int benchcompare_same(const bench_job *job, const void *theirs, size_t bytes);

/* int32_t against float, inside of a border of one pixel (outside of the picture it is the picture
 * that goes on here, and its gradients there): within 2, or a hundred-thousandth of the largest. */
int benchcompare_responses(const bench_job *job, const void *theirs, size_t bytes);

/* The first BENCH_BLOB_BASIC_COLUMNS of every blob. */
int benchcompare_blobs(const bench_job *job, const void *theirs, size_t bytes);

#endif
