/*
 * The ways in which bytes without a header can be a picture: every format, byte order and size that
 * their number allows.
 */
#ifndef READING_H
#define READING_H

#include "source.h"

/* What is known of the bytes: 0 where nothing is. */
typedef struct reading_facts {
    uint64_t bytes;         /* in all */
    unsigned width, height; /* of a frame */
    uint32_t line_bytes;    /* from one row to the next, in the first plane */
    unsigned long frames;   /* one after another */
} reading_facts;

typedef struct reading {
    pel_format format;
    int swapped; /* V before U: NV21 (with NV12) and YV12 (with I420), which pel does not read */
    unsigned width, height;
    uint32_t line_bytes;  /* padding included */
    uint32_t frame_bytes; /* likewise */
    unsigned long frames;
} reading;

enum { READINGS_MAX = 600 };

/* Lists the readings that use up all bytes; returns how many there are, at most READINGS_MAX.
 * Without a size, frames are at least 16 pixels a side, without padding, and from twice as high as
 * wide to three times as wide as high; they are one if their number is not known. */
size_t reading_list(const reading_facts *facts, reading *list);

/* The name of the format and byte order: pel's, "NV21" or "YV12". */
const char *reading_name(const reading *how);

/* Makes frame `number` a frame of pel's, without padding and with U before V; YCbCr is full range.
 * `bytes` holds all frames up to that one. 0, or -1 if memory is out. */
int reading_frame(const reading *how, const uint8_t *bytes, unsigned long number, frame *out);

/* 1 if cameras and screens have that size. */
int reading_common_size(unsigned width, unsigned height);

#endif
