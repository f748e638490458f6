/*
 * The vision of a small robot: lines come from the camera one by one, blobs are found while the
 * frame streams by, and each is sent as soon as it is closed (PROTOCOL.md). At the end of the frame
 * the largest one is handed to the motors (robot_target.h). No frame buffer: 16 KiB of RAM are
 * plenty.
 *
 * Runs on everything that has a ports/template/port.h. The classes come from a class file:
 *     pel classes --c-array robot_classes robot.classes robot_classes.c
 */
#include "port.h"
#include "protocol.h"
#include "robot_classes.c"
#include "robot_target.h"

/* More open blobs cost 72 bytes of RAM each; what does not fit is counted in the frame's end. */
#ifndef ROBOT_OPEN_MAX
#define ROBOT_OPEN_MAX 48
#endif

/* What to measure: PEL_MEASURE_... bits. */
#ifndef ROBOT_MEASURE
#define ROBOT_MEASURE PEL_MEASURE_ALL
#endif

/* Blobs of fewer pixels are not sent. */
#ifndef ROBOT_AREA_MIN
#define ROBOT_AREA_MIN 1
#endif

/* The classes that the motors chase, a bit for each. */
#ifndef ROBOT_CHASE
#define ROBOT_CHASE 0x0Fu
#endif

static struct robot {
    pel_boxes boxes;
    pel_classifier classifier;
    pel_blob_filter filter;
    pel_blobs blobs;
    pel_blob largest;
    uint32_t frame;
    uint32_t missed_lines;
    uint32_t dropped, dropped_px; /* blobs of this frame that the output did not take */
    uint8_t in_frame;
    uint8_t labels[PORT_WIDTH];
    uint64_t work[PEL_BLOBS_WORDS(PORT_WIDTH, ROBOT_OPEN_MAX, ROBOT_MEASURE)];
} robot;

static int send(const uint8_t *record, uint32_t count)
{
    return port_write(record, count);
}

/* Called by the blob finder in the middle of a row; nothing here may take longer than the lines
 * that the camera can buffer. */
static void on_blob(void *user, const pel_blob *blob)
{
    struct robot *const r = user;
    uint8_t record[PROTOCOL_RECORD_MAX];

    if (((unsigned)ROBOT_CHASE >> blob->class_index) & 1u && blob->area > r->largest.area) {
        r->largest = *blob;
    }
    if (send(record, protocol_write_blob(r->frame, ROBOT_MEASURE, blob, record))) {
        r->dropped++;
        r->dropped_px += blob->area;
    }
}

static pel_status begin_frame(struct robot *r)
{
    static const pel_blob none;
    uint8_t record[PROTOCOL_RECORD_MAX];
    pel_blobs_config config = {0};
    protocol_begin begin = {0, 0, PORT_WIDTH, PORT_HEIGHT, ROBOT_MEASURE, robot_classes_count};

    config.width = PORT_WIDTH;
    config.height = PORT_HEIGHT;
    config.open_max = ROBOT_OPEN_MAX;
    config.measure = ROBOT_MEASURE;
    config.measurer = pel_blobs_measure;
    config.work = r->work;
    config.work_bytes = sizeof r->work;
    config.filter = &r->filter;
    config.reader = pel_crow_read_yuv;
    config.on_blob = on_blob;
    config.user = r;
    r->largest = none;
    r->dropped = 0;
    r->dropped_px = 0;
    r->in_frame = 1;
    begin.frame = r->frame;
    begin.time_us = port_time_us();
    (void)send(record, protocol_write_begin(&begin, record)); /* blobs carry the frame, too */
    return pel_blobs_begin(&r->blobs, &config);
}

static void end_frame(struct robot *r, uint8_t state)
{
    uint8_t record[PROTOCOL_RECORD_MAX];
    pel_blobs_counts counts = r->blobs.counts;
    protocol_end end;

    counts.dropped = r->dropped;
    counts.dropped_px = r->dropped_px;
    if (state != PROTOCOL_BROKEN_OFF) {
        const robot_target target = robot_target_of(r->frame, &r->largest, PORT_WIDTH, PORT_HEIGHT);
        robot_target_write(&target);
        (void)send(record, protocol_write_target(&target, record));
    }
    end.frame = r->frame;
    end.time_us = port_time_us();
    end.missed_lines = r->missed_lines;
    end.state = state == PROTOCOL_COMPLETE && r->dropped > 0 ? PROTOCOL_TRUNCATED : state;
    (void)send(record, protocol_write_end(&end, &counts, record));
    r->in_frame = 0;
    r->frame++;
}

/* Negative: this frame is spoilt. */
static pel_status add_line(struct robot *r, const port_line_info *line)
{
    return pel_blobs_pixels(&r->blobs, line->y, &r->classifier, &line->row, r->labels);
}

static void take_line(struct robot *r, const port_line_info *line)
{
    r->missed_lines += line->missed;
    if (line->y == 0) {
        if (r->in_frame) {
            end_frame(r, PROTOCOL_BROKEN_OFF);
        }
        if (begin_frame(r) != PEL_OK) {
            end_frame(r, PROTOCOL_BROKEN_OFF);
        }
    }
    if (!r->in_frame) {
        return; /* until the next frame begins */
    }
    if (add_line(r, line) < 0) {
        end_frame(r, PROTOCOL_BROKEN_OFF);
    } else if (line->y == PORT_HEIGHT - 1) {
        uint32_t kept;
        const pel_status status = pel_blobs_end(&r->blobs, &kept);
        end_frame(r, status == PEL_OK ? PROTOCOL_COMPLETE : PROTOCOL_TRUNCATED);
    }
}

static int set_up(struct robot *r)
{
    int faults = 0;

    for (unsigned i = 0; i < robot_classes_count; i++) {
        faults |= pel_boxes_set(&r->boxes, i, &robot_classes[i]) != PEL_OK;
    }
    r->classifier.boxes = &r->boxes;
    r->classifier.range = PEL_RANGE_FULL;
    r->classifier.reader = pel_crow_read_yuv;
    r->classifier.pieces = pel_classify_pieces;
    r->filter.area_min = ROBOT_AREA_MIN;
    return faults;
}

int main(void)
{
    port_line_info line;
    int got = PORT_FAILED;

    if (port_begin() != PORT_READY || set_up(&robot)) {
        return port_end(1);
    }
    while ((got = port_line(&line)) == PORT_READY) {
        take_line(&robot, &line);
    }
    if (robot.in_frame) {
        end_frame(&robot, PROTOCOL_BROKEN_OFF);
    }
    return port_end(got == PORT_END && robot.frame > 0 ? 0 : 1);
}
