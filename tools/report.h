/* How results are printed: a table for people, CSV and JSON for programs; and numbers as decimals,
 * computed from integers so that they have the same digits everywhere. */
#ifndef REPORT_H
#define REPORT_H

#include <stdint.h>
#include <stdio.h>

#include "classfile.h"

/* Opens a file to write text into; "-" is standard output. NULL after a message. */
FILE *report_open(const char *path);

/* Closes it (standard output: flushes it). 0, or -1 after a message where not all could be
 * written. */
int report_close(FILE *file, const char *path);

/* sum / count with three decimals, halves upward; 0 for a count of 0. */
void report_ratio(FILE *file, uint64_t sum, uint64_t count);

/* Text as a CSV field (RFC 4180: quoted only where it must be) or as a JSON string. */
void report_csv_text(FILE *file, const char *text);
void report_json_text(FILE *file, const char *text);

typedef enum report_style { REPORT_TABLE, REPORT_CSV, REPORT_JSON } report_style;

/* What was found in a frame. `counts` follows pel_blobs_counts: dropped = cut off by --max. */
typedef struct report_frame {
    unsigned long frame;
    const char *file;
    unsigned width, height; /* in which the blobs count */
    const classes *list;
    const pel_blob *blobs;
    uint32_t blob_count;
    pel_blobs_counts counts;
} report_frame;

/* What comes before the first frame. */
void report_begin(FILE *file, report_style style);

/* A frame and its blobs in the order given. */
void report_blobs(FILE *file, report_style style, const report_frame *frame);

#endif
