#include "carray.h"

#include <inttypes.h>
#include <string.h>

#include "raw.h"

enum { NAME_MAX_BYTES = 60, BYTES_PER_LINE = 16 };

typedef struct printer {
    FILE *file;
    size_t done;
} printer;

/* The words of C and C++ and of the headers that the source needs. */
static int is_taken(const char *name)
{
    static const char taken[] =
        " alignas alignof and and_eq asm auto bitand bitor bool break case catch char char16_t "
        "char32_t char8_t class co_await co_return co_yield compl concept const const_cast "
        "consteval constexpr constinit continue decltype default delete do double dynamic_cast "
        "else enum explicit export extern false float for friend goto if inline int long mutable "
        "namespace new noexcept not not_eq nullptr operator or or_eq private protected public "
        "register reinterpret_cast requires restrict return short signed sizeof static "
        "static_assert static_cast struct switch template this thread_local throw true try "
        "typedef typeid typename typeof typeof_unqual union unsigned using virtual void volatile "
        "wchar_t while xor xor_eq _Alignas _Alignof _Atomic _Bool _Complex _Generic _Imaginary "
        "_Noreturn _Static_assert _Thread_local uint8_t pel_color_box ";
    char word[NAME_MAX_BYTES + 3];

    snprintf(word, sizeof word, " %s ", name);
    return strstr(taken, word) != NULL;
}

int carray_name_ok(const char *name)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_";
    size_t length = strlen(name);

    return length > 0 && length <= NAME_MAX_BYTES && strchr(letters, name[0]) != NULL &&
           strspn(name, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_0123456789") ==
               length &&
           !is_taken(name);
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
