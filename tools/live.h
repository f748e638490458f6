/* Results of a camera's frames as they come. */
#ifndef LIVE_H
#define LIVE_H

#include "camera.h"
#include "report.h"

/*
 * Visits the frames of a camera, in the colour range of the classes. On a terminal a table is
 * printed in place of the one before; else nothing is added to what the visitor prints. 0, or -1
 * after a message.
 */
int live_walk(const camera_options *options, report_style style, const classes *list,
              walk_visit *visit, void *user);

#endif
