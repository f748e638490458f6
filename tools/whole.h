/* Whole numbers of the command line that may be negative. */
#ifndef WHOLE_H
#define WHOLE_H

#include <stdint.h>

/* Reads a whole number min..max, nothing else in the word. 0, or -1 after a message that names the
 * command and what the number is. */
int whole_number(const char *command, const char *name, const char *word, int32_t min, int32_t max,
                 int32_t *number);

/* Reads a box "X0,Y0,X1,Y1", half-open. 0, or -1 after a message. */
int whole_box(const char *command, const char *name, const char *word, uint16_t box[4]);

#endif
