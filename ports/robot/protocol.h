/*
 * Blobs as bytes for a serial line: the encoder of PROTOCOL.md, which says what the bytes mean.
 *
 * Plain C without heap, floats or statics; the functions only write into the record they are
 * given, so an interrupt may use them too.
 */
#ifndef PROTOCOL_H
#define PROTOCOL_H

#include <pel.h>

enum {
    PROTOCOL_START = 0xA5,
    PROTOCOL_FRAME_BEGIN = 0x01,
    PROTOCOL_FRAME_END = 0x02,
    PROTOCOL_TARGET = 0x03,
    PROTOCOL_BLOB = 0x10, /* plus the PEL_MEASURE_... bits of what it carries */

    PROTOCOL_OVERHEAD = 5, /* start, type, length, CRC */
    PROTOCOL_RECORD_MAX = PROTOCOL_OVERHEAD + 61
};

/* How a frame ended. */
enum { PROTOCOL_COMPLETE = 0, PROTOCOL_TRUNCATED = 1, PROTOCOL_BROKEN_OFF = 2 };

typedef struct protocol_begin {
    uint32_t frame;
    uint32_t time_us;
    uint16_t width, height;
    uint8_t measure;
    uint8_t classes;
} protocol_begin;

typedef struct protocol_end {
    uint32_t frame;
    uint32_t time_us;
    uint32_t missed_lines;
    uint8_t state;
} protocol_end;

/* The largest blob, for motors. */
typedef struct protocol_target {
    uint32_t frame;
    uint32_t area;         /* pixels; 0: nothing seen */
    uint16_t x_q15, y_q15; /* centroid as part of the picture's width and height, 0..32767 */
    uint8_t class_index;
} protocol_target;

/* CRC-16/CCITT: polynomial 0x1021, initial value 0xFFFF, not reflected. */
uint16_t protocol_crc16(const uint8_t *bytes, uint32_t count);

/* Each writes one record and returns how many bytes it has. */
uint32_t protocol_write_begin(const protocol_begin *begin, uint8_t record[PROTOCOL_RECORD_MAX]);
uint32_t protocol_write_blob(uint32_t frame, unsigned measure, const pel_blob *blob,
                             uint8_t record[PROTOCOL_RECORD_MAX]);
uint32_t protocol_write_target(const protocol_target *target, uint8_t record[PROTOCOL_RECORD_MAX]);
uint32_t protocol_write_end(const protocol_end *end, const pel_blobs_counts *counts,
                            uint8_t record[PROTOCOL_RECORD_MAX]);

#endif
