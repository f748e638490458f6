/* What the suites share: one replayed world, one camera in it, and what must hold at the end. */
#ifndef SCENE_H
#define SCENE_H

#include "replay.h"

extern replay world;
extern capture *camera;

/* The wish for the YUYV mode of 32x24 of /dev/video0, which a test may change before scene_open. */
extern capture_wish wish;

/* For setUp and tearDown. The latter closes the camera and demands that nothing stays open, mapped,
 * queued or allocated. */
void scene_begin(void);
void scene_end(void);

/* Demands CAPTURE_OK. */
void scene_open(void);
void scene_start(void); /* opens first if need be */

/* Demands this status of capture_next. */
void scene_next(unsigned deadline_ms, capture_status expected);

/* Demands `count` good frames in a row, each checked and given back. */
void scene_frames(unsigned count);

/* Takes one good frame and keeps it. */
capture_frame scene_take(void);

/* Demands that it is still the frame that it was. */
void scene_check(const capture_frame *frame);

capture_counts scene_counts(void);
capture_settings scene_settings(void);

#endif
