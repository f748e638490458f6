/* --border: what lies outside of a picture. */
#ifndef BORDER_H
#define BORDER_H

#include <pel.h>

/* Reads "replicate", "symmetric", "reflect101", "wrap", "zero", "constant=V" or "valid". 0, or -1
 * after a message that names the command and lists them; then nothing was changed. */
int border_read(const char *command, const char *word, pel_border *border, uint8_t *constant);

#endif
