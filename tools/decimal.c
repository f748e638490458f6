#include "decimal.h"

#include <inttypes.h>

#include "say.h"

int decimal_milli(const char *command, const char *name, const char *word, int32_t min, int32_t max,
                  int32_t *milli)
{
    const char *p = *word == '-' ? word + 1 : word;
    int64_t value = 0;
    int digits = 0;
    int decimals = -1;
    for (; (*p >= '0' && *p <= '9') || (*p == '.' && decimals < 0); p++) {
        if (*p == '.') {
            decimals = 0;
        } else if (value < 1000000000 && decimals < 3) {
            value = value * 10 + (*p - '0');
            decimals += decimals >= 0;
            digits++;
        } else if (*p != '0' || decimals < 0) {
            digits = 0;
            break;
        }
    }
    for (int i = decimals < 0 ? 0 : decimals; i < 3; i++) {
        value *= 10;
    }
    value = *word == '-' ? -value : value;
    if (*p != '\0' || digits == 0 || value < min || value > max) {
        return say_error(command,
                         "%s needs a number from %" PRId32 " to %" PRId32
                         ", at most three decimals, not '%s'",
                         name, min / 1000, max / 1000, word);
    }
    *milli = (int32_t)value;
    return 0;
}
