#include "robot_target.h"

static volatile robot_target halves[2];
static volatile uint32_t written; /* the newest is in halves[written & 1] */

void robot_target_write(const robot_target *target)
{
    const uint32_t next = written + 1;

    halves[next & 1u] = *target;
    written = next;
}

uint32_t robot_target_read(robot_target *target)
{
    uint32_t before;

    do {
        before = written;
        *target = halves[before & 1u];
    } while (written != before);
    return before;
}

/* Pixel x covers x .. x + 1 of the width, so its centre is at x + 1/2. The sum is below 2^29. */
static uint16_t part_q15(int32_t place_q16, uint16_t side)
{
    const uint32_t part = ((uint32_t)place_q16 + 32768u) / (2u * (uint32_t)side);
    return (uint16_t)(part > 32767u ? 32767u : part);
}

robot_target robot_target_of(uint32_t frame, const pel_blob *blob, uint16_t width, uint16_t height)
{
    robot_target target = {0, 0, 0, 0, 0};

    target.frame = frame;
    if (blob->area > 0) {
        int32_t x_q16, y_q16;
        pel_blob_centroid_q16(blob, &x_q16, &y_q16);
        target.area = blob->area;
        target.x_q15 = part_q15(x_q16, width);
        target.y_q15 = part_q15(y_q16, height);
        target.class_index = blob->class_index;
    }
    return target;
}
