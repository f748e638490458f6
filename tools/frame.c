/* Frames: memory that grows and a view of it. */
#include <stdlib.h>

#include "source.h"

enum { FIRST_BYTES = 65536 };

uint8_t *frame_reserve(frame *picture, size_t bytes, size_t total)
{
    size_t capacity;
    uint8_t *larger;

    if (bytes <= picture->capacity) {
        return picture->bytes;
    }
    capacity = picture->capacity ? picture->capacity : FIRST_BYTES;
    while (capacity < bytes) {
        capacity *= 2;
    }
    if (capacity > total && total >= bytes) {
        capacity = total;
    }
    larger = realloc(picture->bytes, capacity);
    if (!larger) {
        return NULL;
    }
    picture->bytes = larger;
    picture->capacity = capacity;
    return larger;
}

int frame_describe(frame *picture, pel_format format, pel_range range, unsigned width,
                   unsigned height)
{
    size_t bytes;

    if (width > PEL_SIDE_MAX || height > PEL_SIDE_MAX) {
        return -1;
    }
    bytes = pel_frame_bytes(format, (uint16_t)width, (uint16_t)height);
    if (bytes == 0 || bytes > picture->capacity) {
        return -1;
    }
    return pel_view_init(picture->bytes, format, range, (uint16_t)width, (uint16_t)height, 0,
                         &picture->view) == PEL_OK
               ? 0
               : -1;
}

int frame_resize(frame *picture, pel_format format, pel_range range, unsigned width,
                 unsigned height)
{
    size_t bytes;

    if (width > PEL_SIDE_MAX || height > PEL_SIDE_MAX) {
        return -1;
    }
    bytes = pel_frame_bytes(format, (uint16_t)width, (uint16_t)height);
    if (bytes == 0 || !frame_reserve(picture, bytes, bytes)) {
        return -1;
    }
    return frame_describe(picture, format, range, width, height);
}

void frame_free(frame *picture)
{
    static const frame empty;

    free(picture->bytes);
    *picture = empty;
}
