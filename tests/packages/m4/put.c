/* Unity's characters go to the host line by line. */
#include "semihost.h"
#include "unity_config.h"

void pel_report_character(int character)
{
    static char line[128];
    static unsigned length;

    line[length++] = (char)character;
    if (character == '\n' || length + 1 == sizeof line) {
        line[length] = '\0';
        pel_host_text(line);
        length = 0;
    }
}
