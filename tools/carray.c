#include "carray.h"

#include <inttypes.h>
#include <string.h>

#include "raw.h"

enum { NAME_MAX_BYTES = 60, BYTES_PER_LINE = 16 };

typedef struct printer {
    FILE *file;
    size_t done;
} printer;

int carray_name_ok(const char *name)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_";
    size_t length = strlen(name);

    return length > 0 && length <= NAME_MAX_BYTES && strchr(letters, name[0]) != NULL &&
           strspn(name, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_0123456789") ==
               length;
}

static void print_bytes(void *user, const uint8_t *bytes, size_t count)
{
    printer *to = user;
    size_t i;

    for (i = 0; i < count; i++) {
        fputs(to->done % BYTES_PER_LINE == 0 ? "\n    " : " ", to->file);
        fprintf(to->file, "0x%02x,", bytes[i]);
        to->done++;
    }
}

int carray_write(FILE *file, const pel_cview *view, const char *name)
{
    printer to = {file, 0};
    const char *range = view->range == PEL_RANGE_FULL ? "FULL" : "LIMITED";
    const char *format = pel_format_name(view->format);

    fprintf(file,
            "/*\n"
            " * %s: a frame of %ux%u pixels, %s, colour range %s, no padding. Use it so:\n"
            " *\n"
            " *     pel_cview view;\n"
            " *     pel_cview_init(%s, PEL_%s, PEL_RANGE_%s, %s_width, %s_height, 0, &view);\n"
            " */\n"
            "#include <stdint.h>\n"
            "\n"
            "enum { %s_width = %u, %s_height = %u };\n"
            "\n"
            "const uint8_t %s[%" PRIu32 "] = {",
            name, view->width, view->height, format,
            view->range == PEL_RANGE_FULL ? "full" : "limited", name, format, range, name, name,
            name, view->width, name, view->height, name,
            pel_frame_bytes(view->format, view->width, view->height));
    raw_each_row(view, print_bytes, &to);
    fputs("\n};\n", file);
    return ferror(file) ? -1 : 0;
}
