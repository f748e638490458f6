#include "border.h"

#include <string.h>

#include "options.h"
#include "say.h"

static const struct {
    const char *name;
    pel_border border;
} borders[] = {
    {"replicate", PEL_BORDER_REPLICATE},   {"symmetric", PEL_BORDER_SYMMETRIC},
    {"reflect101", PEL_BORDER_REFLECT101}, {"wrap", PEL_BORDER_WRAP},
    {"zero", PEL_BORDER_CONSTANT},         {"valid", PEL_BORDER_VALID},
};

int border_read(const char *command, const char *word, pel_border *border, uint8_t *constant)
{
    static const char assignment[] = "constant=";
    if (strncmp(word, assignment, sizeof assignment - 1) == 0) {
        unsigned long value;
        if (options_number("--border constant", word + sizeof assignment - 1, 0, 255, &value)) {
            return -1;
        }
        *border = PEL_BORDER_CONSTANT;
        *constant = (uint8_t)value;
        return 0;
    }
    for (size_t i = 0; i < sizeof borders / sizeof borders[0]; i++) {
        if (options_same_word(word, borders[i].name)) {
            *border = borders[i].border;
            *constant = 0;
            return 0;
        }
    }
    return say_error(command,
                     "unknown border '%s'; there are: replicate symmetric reflect101 wrap zero "
                     "constant=V valid",
                     word);
}
