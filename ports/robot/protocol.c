#include "protocol.h"

/* Byte by byte, so that the order in memory is nobody's concern. */
static uint8_t *put16(uint8_t *to, uint16_t value)
{
    to[0] = (uint8_t)(value & 0xFFu);
    to[1] = (uint8_t)(value >> 8);
    return to + 2;
}

static uint8_t *put32(uint8_t *to, uint32_t value)
{
    return put16(put16(to, (uint16_t)(value & 0xFFFFu)), (uint16_t)(value >> 16));
}

static uint8_t *put64(uint8_t *to, uint64_t value)
{
    return put32(put32(to, (uint32_t)(value & 0xFFFFFFFFu)), (uint32_t)(value >> 32));
}

/* Bit by bit: 600 steps for the longest record, where a table would take 512 bytes of flash. */
uint16_t protocol_crc16(const uint8_t *bytes, uint32_t count)
{
    uint16_t crc = 0xFFFF;

    for (uint32_t i = 0; i < count; i++) {
        crc = (uint16_t)(crc ^ ((unsigned)bytes[i] << 8));
        for (int bit = 0; bit < 8; bit++) {
            crc = (uint16_t)(crc & 0x8000u ? ((uint32_t)crc << 1) ^ 0x1021u : (uint32_t)crc << 1);
        }
    }
    return crc;
}

/* Puts what surrounds the payload, which ends at `end` and began at record + 3. */
static uint32_t finish(uint8_t *record, unsigned type, uint8_t *end)
{
    const uint32_t length = (uint32_t)(end - record) - 3;

    record[0] = PROTOCOL_START;
    record[1] = (uint8_t)type;
    record[2] = (uint8_t)length;
    put16(end, protocol_crc16(record + 1, length + 2));
    return length + PROTOCOL_OVERHEAD;
}

uint32_t protocol_write_begin(const protocol_begin *begin, uint8_t record[PROTOCOL_RECORD_MAX])
{
    uint8_t *to = record + 3;

    to = put32(to, begin->frame);
    to = put32(to, begin->time_us);
    to = put16(to, begin->width);
    to = put16(to, begin->height);
    *to++ = begin->measure;
    *to++ = begin->classes;
    return finish(record, PROTOCOL_FRAME_BEGIN, to);
}

uint32_t protocol_write_blob(uint32_t frame, unsigned measure, const pel_blob *blob,
                             uint8_t record[PROTOCOL_RECORD_MAX])
{
    const unsigned groups = measure & PEL_MEASURE_ALL;
    uint8_t *to = record + 3;

    to = put32(to, frame);
    *to++ = blob->class_index;
    *to++ = blob->edges;
    to = put16(to, blob->x0);
    to = put16(to, blob->x1);
    to = put16(to, blob->y0);
    to = put16(to, blob->y1);
    to = put32(to, blob->area);
    to = put32(to, blob->sum_x);
    to = put32(to, blob->sum_y);
    if (groups & PEL_MEASURE_MOMENTS) {
        to = put64(to, blob->sum_xx);
        to = put64(to, blob->sum_xy);
        to = put64(to, blob->sum_yy);
    }
    if (groups & PEL_MEASURE_OUTLINE) {
        to = put32(to, blob->perimeter);
        to = put32(to, blob->holes);
    }
    if (groups & PEL_MEASURE_COLOR) {
        *to++ = blob->mean_y;
        *to++ = blob->mean_u;
        *to++ = blob->mean_v;
    }
    return finish(record, PROTOCOL_BLOB | groups, to);
}

uint32_t protocol_write_target(const protocol_target *target, uint8_t record[PROTOCOL_RECORD_MAX])
{
    uint8_t *to = record + 3;

    to = put32(to, target->frame);
    to = put32(to, target->area);
    to = put16(to, target->x_q15);
    to = put16(to, target->y_q15);
    *to++ = target->class_index;
    return finish(record, PROTOCOL_TARGET, to);
}

uint32_t protocol_write_end(const protocol_end *end, const pel_blobs_counts *counts,
                            uint8_t record[PROTOCOL_RECORD_MAX])
{
    uint8_t *to = record + 3;

    to = put32(to, end->frame);
    to = put32(to, end->time_us);
    to = put32(to, counts->found);
    to = put32(to, counts->dropped);
    to = put32(to, counts->dropped_px);
    to = put32(to, counts->filtered);
    to = put32(to, counts->filtered_px);
    to = put32(to, counts->lost_px);
    to = put32(to, counts->lost_opens);
    to = put16(to, counts->open_peak);
    to = put32(to, end->missed_lines);
    *to++ = end->state;
    return finish(record, PROTOCOL_FRAME_END, to);
}
