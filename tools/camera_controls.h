/* What a camera is told before its frames are used. */
#ifndef CAMERA_CONTROLS_H
#define CAMERA_CONTROLS_H

#include "camera.h"

#ifdef PEL_HAS_CAMERAS

/* Sets what the options ask for. A value that the driver does not take is reported on standard
 * error; a control that the camera has not got is an error. 0, or -1 after a message. */
int camera_controls_apply(capture *device, const char *name, const camera_options *options);

/* Switches the automatics off and holds the values that they had reached. What cannot be held is
 * reported on standard error. */
void camera_controls_lock(capture *device, const char *name);

/* Writes "exposure=157, gain=20, ..." of the known controls; "none" if there are none. */
void camera_controls_text(capture *device, char *text, size_t bytes);

#endif

#endif
