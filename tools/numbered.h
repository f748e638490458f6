/* File names with the place of a number in them, such as "frame-%04d.ppm". */
#ifndef NUMBERED_H
#define NUMBERED_H

/* 1 if the name has such a place. */
int numbered_is(const char *name);

/* The name for a number, to be freed; a name without a place stays. NULL if memory is out. */
char *numbered_name(const char *pattern, unsigned long number);

#endif
