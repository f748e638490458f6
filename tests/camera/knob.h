/* The other hand on a virtual camera: turns what the driver offers, not through the port. */
#ifndef CAMERA_KNOB_H
#define CAMERA_KNOB_H

#include <linux/videodev2.h>

/* Each opens the device, does its work and closes it; 0, or -1 with a message. Controls go by the
 * driver's name for them; a button is pressed with any value. */
int knob_set(const char *device, const char *name, int value);
int knob_get(const char *device, const char *name, int *value);

/* Sets a menu to the item of that text. */
int knob_choose(const char *device, const char *name, const char *item);

/* The television standard, a V4L2_STD_... */
int knob_standard(const char *device, v4l2_std_id standard);

/* What the driver is set to. */
int knob_format(const char *device, struct v4l2_pix_format *format);
int knob_interval(const char *device, struct v4l2_fract *seconds_per_frame);

#endif
