/* What the commands that look at pictures have in common: they visit the frames of their inputs. */
#ifndef WALK_H
#define WALK_H

#include "classfile.h"
#include "source.h"

/* Visits a frame; frames count from 0 over all inputs. 0 to go on, or -1 after a message. */
typedef int walk_visit(void *user, const char *path, unsigned long number, const pel_cview *view);

/* Visits every frame of every input as it arrives. An input without a frame is an error, and so is
 * being given the same standard input twice. 0, or -1 after a message. */
int walk_frames(char *const *paths, int count, const source_options *options, walk_visit *visit,
                void *user);

/* Says whether the classes fit the colour range of a frame; the message says what to do. 0 or
 * -1. */
int walk_check_range(const char *path, const pel_cview *view, const char *classes_path,
                     const classes *list);

#endif
