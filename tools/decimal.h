/* Decimal numbers of the command line, as integers. */
#ifndef DECIMAL_H
#define DECIMAL_H

#include <stdint.h>

/* Reads a decimal number such as "12.5" or "-3" in thousandths, min..max (of those). 0, or -1
 * after a message that names the command and the option. */
int decimal_milli(const char *command, const char *name, const char *word, int32_t min, int32_t max,
                  int32_t *milli);

#endif
