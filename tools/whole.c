#include "whole.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include <pel.h>

#include "say.h"

int whole_number(const char *command, const char *name, const char *word, int32_t min, int32_t max,
                 int32_t *number)
{
    const char *p = *word == '-' || *word == '+' ? word + 1 : word;
    int64_t value = 0;
    int digits = 0;
    for (; *p >= '0' && *p <= '9' && value <= INT32_MAX; p++, digits++) {
        value = 10 * value + (*p - '0');
    }
    value = *word == '-' ? -value : value;
    if (*p != '\0' || digits == 0 || value < min || value > max) {
        return say_error(command,
                         "%s needs a whole number from %" PRId32 " to %" PRId32 ", not '%s'", name,
                         min, max, word);
    }
    *number = (int32_t)value;
    return 0;
}

int whole_box(const char *command, const char *name, const char *word, uint16_t box[4])
{
    unsigned n[4];
    char end;
    if (strlen(word) > 19 || word[strspn(word, "0123456789,")] != '\0' ||
        sscanf(word, "%u,%u,%u,%u%c", &n[0], &n[1], &n[2], &n[3], &end) != 4 || n[0] >= n[2] ||
        n[1] >= n[3] || n[2] > PEL_SIDE_MAX || n[3] > PEL_SIDE_MAX) {
        return say_error(command, "%s needs X0,Y0,X1,Y1 with X0 < X1 and Y0 < Y1, not '%s'", name,
                         word);
    }
    for (int i = 0; i < 4; i++) {
        box[i] = (uint16_t)n[i];
    }
    return 0;
}
