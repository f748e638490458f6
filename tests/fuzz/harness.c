#include "harness.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "say.h"

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SEES_LEAKS 1
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define SEES_LEAKS 1
#endif
#ifdef SEES_LEAKS
int __lsan_do_recoverable_leak_check(void); /* <sanitizer/lsan_interface.h>, not always installed */
#endif

char last_message[1024];
unsigned message_count;

static unsigned long passed, failed;

int say_error(const char *where, const char *format, ...)
{
    va_list arguments;
    int length = snprintf(last_message, sizeof last_message, "%s: ", where ? where : "");

    message_count++;
    if (length < 0 || (size_t)length >= sizeof last_message) {
        abort();
    }
    va_start(arguments, format);
    vsnprintf(last_message + length, sizeof last_message - (size_t)length, format, arguments);
    va_end(arguments);
    return -1;
}

int check(int holds, const char *format, ...)
{
    va_list arguments;

    if (holds) {
        passed++;
        return holds;
    }
    failed++;
    printf("FAILED: ");
    va_start(arguments, format);
    vprintf(format, arguments);
    va_end(arguments);
    printf("\n");
    return holds;
}

int finish(void)
{
#ifdef SEES_LEAKS
    check(__lsan_do_recoverable_leak_check() == 0, "memory was leaked");
#endif
    check(passed > 0, "nothing was checked");
#ifdef SEES_LEAKS
    printf("%lu passed, %lu failed\n", passed, failed);
#else
    printf("skipped: the sanitizers, which this compiler does not have\n");
    printf("%lu passed, %lu failed, 1 skipped\n", passed, failed);
#endif
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}

static int read_frames(FILE *stream, const char *name, const source_options *options)
{
    source *from = source_open_stream(stream, name, options);
    frame picture = {0};
    int frames = 0, status;

    if (!from) {
        return -1;
    }
    while ((status = source_next(from, &picture)) > 0) {
        pel_cview view = pel_view_to_read(&picture.view);
        check(pel_cview_check(&view) == PEL_OK, "%s: a frame that the library refuses", name);
        frames++;
    }
    source_close(from);
    frame_free(&picture);
    return status < 0 ? -1 : frames;
}

static int read_classes(FILE *stream, const char *name)
{
    static classes list;
    int status = classes_read_stream(stream, name, &list);

    if (status == 0) {
        check(list.count >= 1 && list.count <= PEL_CLASS_MAX, "%s: %u classes", name, list.count);
        status = 1;
    }
    classes_free(&list);
    return status;
}

int read_bytes(const char *name, const uint8_t *bytes, size_t count, const reading *how)
{
    /* A copy of exactly this size, so that the sanitizer sees every byte too far. */
    uint8_t *copy = malloc(count ? count : 1);
    FILE *stream;
    int result;

    if (!copy) {
        abort();
    }
    memcpy(copy, bytes, count);
    stream = fmemopen(copy, count ? count : 1, "rb");
    if (!stream) {
        abort();
    }
    if (count == 0) {
        fgetc(stream); /* fmemopen has no empty streams */
    }
    message_count = 0;
    last_message[0] = '\0';
    result =
        how->is_classes ? read_classes(stream, name) : read_frames(stream, name, &how->options);
    free(copy);
    check(message_count == (result < 0 ? 1u : 0u), "%s: result %d with %u messages: %s", name,
          result, message_count, last_message);
    if (result < 0) {
        check(strncmp(last_message, name, strlen(name)) == 0, "%s: not named in '%s'", name,
              last_message);
    }
    return result;
}

uint8_t *load(const char *path, size_t *count)
{
    FILE *file = fopen(path, "rb");
    uint8_t *bytes = malloc(1 << 20);

    if (!file || !bytes) {
        check(0, "cannot read %s", path);
        free(bytes);
        if (file) {
            fclose(file);
        }
        return NULL;
    }
    *count = fread(bytes, 1, 1 << 20, file);
    fclose(file);
    return bytes;
}
