#include "benchcompare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "benchruns.h"
#include "say.h"

static int differs(const bench_job *job, size_t at, double own, double their)
{
    return say_error("bench",
                     "%s of %s: OpenCV's result is another: at place %lu %.10g, "
                     "here %.10g",
                     job->op->name, job->picture->name, (unsigned long)at, their, own);
}

static int sizes_differ(const bench_job *job, size_t own, size_t their)
{
    return own == their ? 0
                        : say_error("bench",
                                    "%s of %s: OpenCV's result has another size: %lu bytes, here "
                                    "%lu",
                                    job->op->name, job->picture->name, (unsigned long)their,
                                    (unsigned long)own);
}

/* turn_step: every how many bytes there is one of a circle, from the first on; 0: none is. */
static int fits(const bench_job *job, const uint8_t *their, size_t i, size_t turn_step)
{
    int difference = abs(job->out[i] - their[i]);
    if (turn_step && i % turn_step == 0 && difference > 128) {
        difference = 256 - difference;
    }
    return difference <= job->op->limit;
}

static int compare_bytes(const bench_job *job, const void *theirs, size_t bytes, size_t turn_step)
{
    const uint8_t *their = theirs;
    if (sizes_differ(job, job->out_bytes, bytes)) {
        return -1;
    }
    for (size_t i = 0; i < bytes; i++) {
        if (!fits(job, their, i, turn_step)) {
            return differs(job, i, job->out[i], their[i]);
        }
    }
    return 0;
}

int benchcompare_bytes(const bench_job *job, const void *theirs, size_t bytes)
{
    return compare_bytes(job, theirs, bytes, 0);
}

int benchcompare_turns(const bench_job *job, const void *theirs, size_t bytes)
{
    return compare_bytes(job, theirs, bytes, 1);
}

int benchcompare_hsv(const bench_job *job, const void *theirs, size_t bytes)
{
    return compare_bytes(job, theirs, bytes, 3);
}

int benchcompare_rgb(const bench_job *job, const void *theirs, size_t bytes)
{
    const uint8_t *their = theirs;
    const pel_cview gray = benchpicture_view(job->picture, BENCH_GRAY);
    if (sizes_differ(job, job->out_bytes, bytes)) {
        return -1;
    }
    for (size_t i = 0; i < bytes; i++) {
        if (gray.plane[0][i / 3] >= 16 && !fits(job, their, i, 0)) {
            return differs(job, i, job->out[i], their[i]);
        }
    }
    return 0;
}

int benchcompare_same(const bench_job *job, const void *theirs, size_t bytes)
{
    const uint8_t *their = theirs;
    size_t i = 0;
    if (sizes_differ(job, job->out_bytes, bytes)) {
        return -1;
    }
    while (i < bytes && job->out[i] == their[i]) {
        i++;
    }
    return i == bytes ? 0 : differs(job, i, job->out[i], their[i]);
}

static int32_t response_at(const bench_job *job, size_t at)
{
    int32_t own;
    memcpy(&own, job->out + at * sizeof own, sizeof own);
    return own;
}

static double largest_response(const bench_job *job)
{
    double largest = 0;
    for (size_t i = 0; i < job->out_bytes / sizeof(int32_t); i++) {
        largest = fmax(largest, fabs((double)response_at(job, i)));
    }
    return largest;
}

int benchcompare_responses(const bench_job *job, const void *theirs, size_t bytes)
{
    const float *their = theirs;
    const size_t width = job->picture->width;
    const double limit = fmax(2.0, 1e-5 * largest_response(job));
    if (sizes_differ(job, job->out_bytes, bytes)) {
        return -1;
    }
    for (size_t y = 1; y + 1 < job->picture->height; y++) {
        for (size_t x = 1; x + 1 < width; x++) {
            const size_t at = y * width + x;
            const double own = response_at(job, at);
            /* Not the other way round, so that what is no number does not fit. */
            if (!(fabs((double)their[at] - own) <= limit)) {
                return differs(job, at, own, (double)their[at]);
            }
        }
    }
    return 0;
}

int benchcompare_blobs(const bench_job *job, const void *theirs, size_t bytes)
{
    const int64_t *their = theirs;
    const size_t row = BENCH_BLOB_BASIC_COLUMNS * sizeof(int64_t);
    if (sizes_differ(job, job->count * row, bytes)) {
        return -1;
    }
    for (size_t i = 0; i < job->count * BENCH_BLOB_BASIC_COLUMNS; i++) {
        const size_t blob = i / BENCH_BLOB_BASIC_COLUMNS;
        const size_t column = i % BENCH_BLOB_BASIC_COLUMNS;
        int64_t own;
        memcpy(&own, job->out + (blob * BENCH_BLOB_COLUMNS + column) * sizeof own, sizeof own);
        if (own != their[i]) {
            return differs(job, i, (double)own, (double)their[i]);
        }
    }
    return 0;
}
