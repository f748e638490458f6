/*
 * OpenCV, asked through a Python process that has its module cv2: it gets the same pictures, gives
 * its results for comparison, and times itself on the same processor core (bench_opencv.py, which
 * is compiled in, says what is asked and answered). While it works, this process waits.
 */
#ifndef BENCHPEER_H
#define BENCHPEER_H

#include <stdio.h>
#include <sys/types.h>

#include "benchpicture.h"

/* Zero it first. Without a process everything below says that there is no such job. */
typedef struct benchpeer {
    pid_t process;
    FILE *to, *from;
    char version[32];
    char missing[200]; /* why there is none */
    uint8_t *result;
    size_t capacity;
} benchpeer;

/* Starts the process. 0; -1: there is none, and `missing` says why. */
int benchpeer_start(benchpeer *peer, const char *python);

/* All: -1 after a message if the process does not answer as it should. */

/* Hands over the picture that the jobs work on; `frames` copies of it take turns there. */
int benchpeer_picture(benchpeer *peer, const bench_picture *picture, unsigned frames);

/* Prepares a job, runs it and fetches its result into `result`: 1 done, 0 there is no such job. */
int benchpeer_prepare(benchpeer *peer, const char *job, size_t *bytes);

/* The times of `count` times `repeat` runs of the prepared job. */
int benchpeer_run(benchpeer *peer, unsigned repeat, unsigned count, double *ns);

void benchpeer_stop(benchpeer *peer);

#endif
