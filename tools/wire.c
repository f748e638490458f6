#include "wire.h"

#include <string.h>

enum { START = 0xA5, OVERHEAD = 5 };

/* Fields one after another, least significant byte first. */
typedef struct fields {
    const uint8_t *at;
} fields;

static uint64_t take(fields *from, unsigned bytes)
{
    uint64_t value = 0;
    for (unsigned i = 0; i < bytes; i++) {
        value |= (uint64_t)from->at[i] << (8 * i);
    }
    from->at += bytes;
    return value;
}

static uint8_t take8(fields *from)
{
    return (uint8_t)take(from, 1);
}

static uint16_t take16(fields *from)
{
    return (uint16_t)take(from, 2);
}

static uint32_t take32(fields *from)
{
    return (uint32_t)take(from, 4);
}

/* ---- Types
 * ---------------------------------------------------------------------------------
 */

/* The length of a type's payload; -1 for a type of another time. */
static int length_of(uint8_t type)
{
    switch (type) {
    case WIRE_FRAME_BEGIN:
        return 14;
    case WIRE_FRAME_END:
        return 43;
    case WIRE_TARGET:
        return 13;
    default:
        if (type < WIRE_BLOB || type > WIRE_BLOB + PEL_MEASURE_ALL) {
            return -1;
        }
        return 26 + (type & PEL_MEASURE_MOMENTS ? 24 : 0) + (type & PEL_MEASURE_OUTLINE ? 8 : 0) +
               (type & PEL_MEASURE_COLOR ? 3 : 0);
    }
}

static void read_begin(fields *from, wire_record *record)
{
    record->time_us = take32(from);
    record->width = take16(from);
    record->height = take16(from);
    record->measure = take8(from);
    record->class_count = take8(from);
}

static void read_end(fields *from, wire_record *record)
{
    pel_blobs_counts *const counts = &record->counts;
    record->time_us = take32(from);
    counts->found = take32(from);
    counts->dropped = take32(from);
    counts->dropped_px = take32(from);
    counts->filtered = take32(from);
    counts->filtered_px = take32(from);
    counts->lost_px = take32(from);
    counts->lost_opens = take32(from);
    counts->open_peak = take16(from);
    record->missed_lines = take32(from);
    record->state = take8(from);
}

static void read_target(fields *from, wire_record *record)
{
    record->area = take32(from);
    record->x_q15 = take16(from);
    record->y_q15 = take16(from);
    record->blob.class_index = take8(from);
}

static void read_blob(fields *from, wire_record *record)
{
    pel_blob *const blob = &record->blob;
    blob->class_index = take8(from);
    blob->edges = take8(from);
    blob->x0 = take16(from);
    blob->x1 = take16(from);
    blob->y0 = take16(from);
    blob->y1 = take16(from);
    blob->area = take32(from);
    blob->sum_x = take32(from);
    blob->sum_y = take32(from);
    if (record->measure & PEL_MEASURE_MOMENTS) {
        blob->sum_xx = take(from, 8);
        blob->sum_xy = take(from, 8);
        blob->sum_yy = take(from, 8);
    }
    if (record->measure & PEL_MEASURE_OUTLINE) {
        blob->perimeter = take32(from);
        blob->holes = take32(from);
    }
    if (record->measure & PEL_MEASURE_COLOR) {
        blob->mean_y = take8(from);
        blob->mean_u = take8(from);
        blob->mean_v = take8(from);
    }
}

static void read_fields(uint8_t type, const uint8_t *payload, wire_record *record)
{
    static const wire_record empty;
    fields from = {payload};
    *record = empty;
    record->kind = type >= WIRE_BLOB ? WIRE_BLOB : (wire_kind)type;
    record->frame = take32(&from);
    switch (record->kind) {
    case WIRE_FRAME_BEGIN:
        read_begin(&from, record);
        break;
    case WIRE_FRAME_END:
        read_end(&from, record);
        break;
    case WIRE_TARGET:
        read_target(&from, record);
        break;
    default:
        record->measure = type & PEL_MEASURE_ALL;
        read_blob(&from, record);
    }
}

/* ---- What can be true
 * ---------------------------------------------------------------------- */

/* Whether a sum over `area` pixels of values low..high - 1 can be this. */
static int sum_fits(uint64_t sum, uint64_t area, uint64_t low, uint64_t high)
{
    return sum >= area * low && sum <= area * (high - 1);
}

static uint64_t product(uint16_t a, uint16_t b)
{
    return (uint64_t)a * b;
}

static int moments_fit(const pel_blob *b)
{
    const uint64_t x = b->x1 - 1u, y = b->y1 - 1u;
    return sum_fits(b->sum_xx, b->area, product(b->x0, b->x0), x * x + 1) &&
           sum_fits(b->sum_xy, b->area, product(b->x0, b->y0), x * y + 1) &&
           sum_fits(b->sum_yy, b->area, product(b->y0, b->y0), y * y + 1);
}

static int blob_fits(const wire_record *record)
{
    const pel_blob *const b = &record->blob;
    if (b->x0 >= b->x1 || b->y0 >= b->y1 || b->x1 > PEL_SIDE_MAX || b->y1 > PEL_SIDE_MAX ||
        b->area == 0 || b->area > product(b->x1 - b->x0, b->y1 - b->y0) || b->edges > 15 ||
        b->class_index >= PEL_CLASS_MAX) {
        return 0;
    }
    return sum_fits(b->sum_x, b->area, b->x0, b->x1) && sum_fits(b->sum_y, b->area, b->y0, b->y1) &&
           (!(record->measure & PEL_MEASURE_MOMENTS) || moments_fit(b));
}

static int makes_sense(const wire_record *record)
{
    switch (record->kind) {
    case WIRE_FRAME_BEGIN:
        return record->width > 0 && record->width <= PEL_SIDE_MAX && record->height > 0 &&
               record->height <= PEL_SIDE_MAX && record->measure <= PEL_MEASURE_ALL;
    case WIRE_FRAME_END:
        return record->state <= WIRE_BROKEN_OFF && record->counts.dropped <= record->counts.found;
    case WIRE_TARGET:
        return record->x_q15 <= 32767 && record->y_q15 <= 32767 &&
               record->blob.class_index < PEL_CLASS_MAX;
    default:
        return blob_fits(record);
    }
}

/* ---- The stream
 * ----------------------------------------------------------------------------
 */

static uint16_t crc16(const uint8_t *bytes, size_t count)
{
    unsigned crc = 0xFFFF;
    for (size_t i = 0; i < count; i++) {
        crc ^= (unsigned)bytes[i] << 8;
        for (int bit = 0; bit < 8; bit++) {
            crc = (crc & 0x8000u ? (crc << 1) ^ 0x1021u : crc << 1) & 0xFFFFu;
        }
    }
    return (uint16_t)crc;
}

/* Makes sure that `count` bytes are held; 0 if the stream ends before. */
static int hold(wire *from, size_t count)
{
    while (from->held_count < count) {
        const int c = input_get(from->in);
        if (c == EOF) {
            return 0;
        }
        from->held[from->held_count++] = (uint8_t)c;
    }
    return 1;
}

static void let_go(wire *from, size_t count)
{
    from->held_count -= count;
    memmove(from->held, from->held + count, from->held_count);
}

/* Looks at the bytes held, of which the first is a start byte: 1 a record, 0 none starts here. */
static int take_record(wire *from, wire_record *record)
{
    if (!hold(from, 3)) {
        from->counts.cut_short++;
        return 0;
    }
    const int known = length_of(from->held[1]);
    const size_t length = from->held[2];
    if (known < 0 ? length > WIRE_PAYLOAD_MAX : length != (size_t)known) {
        return 0;
    }
    if (!hold(from, length + OVERHEAD)) {
        from->counts.cut_short++;
        return 0;
    }
    const uint8_t *const crc = from->held + 3 + length;
    if (crc16(from->held + 1, length + 2) != (crc[0] | crc[1] << 8)) {
        from->counts.bad_checksums += known >= 0;
        return 0;
    }
    if (known < 0) {
        from->counts.unknown++;
    } else {
        read_fields(from->held[1], from->held + 3, record);
        if (!makes_sense(record)) {
            from->counts.bad_values++;
            return 0;
        }
        from->counts.records++;
    }
    let_go(from, length + OVERHEAD);
    return known >= 0;
}

int wire_next(wire *from, wire_record *record)
{
    while (hold(from, 1)) {
        const uint64_t unknown = from->counts.unknown;
        if (from->held[0] == START && take_record(from, record)) {
            return 1;
        }
        if (from->counts.unknown == unknown) {
            from->counts.skipped_bytes++;
            let_go(from, 1);
        }
    }
    return 0;
}
