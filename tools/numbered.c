#include "numbered.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The place of "%d", "%4d", "%04d", ... in a name, and how long it is; NULL if there is none. */
static const char *find_number(const char *name, size_t *length)
{
    for (const char *p = strchr(name, '%'); p; p = strchr(p + 1, '%')) {
        const size_t digits = strspn(p + 1, "0123456789");
        if (digits <= 2 && p[1 + digits] == 'd') {
            *length = digits + 2;
            return p;
        }
    }
    return NULL;
}

int numbered_is(const char *name)
{
    size_t length;
    return find_number(name, &length) != NULL;
}

char *numbered_name(const char *pattern, unsigned long number)
{
    size_t length = 0;
    const char *place = find_number(pattern, &length);
    const size_t room = strlen(pattern) + 128;
    char *name = malloc(room);
    if (!name || !place) {
        return name ? strcpy(name, pattern) : NULL;
    }
    const int width = atoi(place + 1);
    const char *format = place[1] == '0' ? "%.*s%0*lu%s" : "%.*s%*lu%s";
    snprintf(name, room, format, (int)(place - pattern), pattern, width, number, place + length);
    return name;
}
