/*
 * Records of the serial line (ports/robot/PROTOCOL.md), found in a stream of bytes that may begin
 * anywhere and be damaged. Written from that page, apart from the encoder, so that each checks the
 * other.
 */
#ifndef WIRE_H
#define WIRE_H

#include <pel.h>

#include "input.h"

typedef enum wire_kind {
    WIRE_FRAME_BEGIN = 0x01,
    WIRE_FRAME_END = 0x02,
    WIRE_TARGET = 0x03,
    WIRE_BLOB = 0x10 /* and up to WIRE_BLOB + PEL_MEASURE_ALL; all of them become
                      this kind */
} wire_kind;

enum { WIRE_COMPLETE = 0, WIRE_TRUNCATED = 1, WIRE_BROKEN_OFF = 2 };

/* A record; what does not belong to its kind is 0. */
typedef struct wire_record {
    wire_kind kind;
    uint32_t frame;
    uint32_t time_us;       /* begin, end */
    uint16_t width, height; /* begin */
    uint8_t measure;        /* begin, blob */
    uint8_t class_count;    /* begin */
    pel_blob blob;          /* blob */
    pel_blobs_counts counts;
    uint32_t missed_lines;
    uint8_t state;         /* WIRE_COMPLETE ...; these three of the end */
    uint32_t area;         /* target, and the next two, too */
    uint16_t x_q15, y_q15; /* its class is blob.class_index */
} wire_record;

typedef struct wire_counts {
    uint64_t records;       /* good ones, of known types */
    uint64_t unknown;       /* good ones of other types, skipped */
    uint64_t bad_checksums; /* a start byte, a known type and its length, but the
                             wrong CRC */
    uint64_t bad_values;    /* the right CRC, but no robot can mean that */
    uint64_t cut_short;     /* the same start, but the stream ended before the record */
    uint64_t skipped_bytes; /* that belong to no good record */
} wire_counts;

enum { WIRE_PAYLOAD_MAX = 96, WIRE_RECORD_MAX = WIRE_PAYLOAD_MAX + 5 };

/* Reads from `in`; zero it but for that. */
typedef struct wire {
    input *in;
    wire_counts counts;
    size_t held_count;
    uint8_t held[WIRE_RECORD_MAX]; /* bytes that may be the start of a record */
} wire;

/* The next good record: 1, or 0 at the end of the stream. */
int wire_next(wire *from, wire_record *record);

#endif
