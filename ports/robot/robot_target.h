/*
 * What the vision tells the motors: the largest blob of the last whole frame.
 *
 * The vision writes, once per frame, into the half of a double buffer that nobody reads, and then
 * counts up; a control loop reads whenever it likes. It may be an interrupt (the vision cannot run
 * meanwhile: the first reading is good) or a task that the vision interrupts (it reads again). For
 * one core; between two cores a memory barrier belongs on each side of the counter.
 */
#ifndef ROBOT_TARGET_H
#define ROBOT_TARGET_H

#include "protocol.h"

typedef protocol_target robot_target;

/* For the vision. */
void robot_target_write(const robot_target *target);

/* For the control loop: the newest target; returns how many there have been, 0 = none yet (then
 * everything in *target is 0). A number that stays the same says that the vision stands still. */
uint32_t robot_target_read(robot_target *target);

/* The target that a blob makes, or the empty one for a blob of area 0. */
robot_target robot_target_of(uint32_t frame, const pel_blob *blob, uint16_t width, uint16_t height);

#endif
