#include "planes.h"

#include "plain.h"
#include "say.h"

pel_cview planes_view(const planes *from, unsigned i)
{
    return pel_view_to_read(&from->channel[i].view);
}

int planes_resize(const char *where, planes *to, unsigned count, unsigned width, unsigned height)
{
    for (unsigned i = 0; i < count; i++) {
        if (frame_resize(&to->channel[i], PEL_GRAY8, PEL_RANGE_FULL, width, height)) {
            return say_error(where, "out of memory for %ux%u", width, height);
        }
    }
    to->count = count;
    return 0;
}

int planes_split(const char *where, const pel_cview *view, planes *out)
{
    const unsigned count = view->format == PEL_GRAY8 ? 1 : 3;
    if (planes_resize(where, out, count, view->width, view->height)) {
        return -1;
    }
    for (unsigned y = 0; y < view->height; y++) {
        const uint8_t *from = view->plane[0] + (ptrdiff_t)y * view->stride_bytes[0];
        for (unsigned i = 0; i < count; i++) {
            uint8_t *const to = plain_row(&out->channel[i].view, y);
            for (size_t x = 0; x < view->width; x++) {
                to[x] = from[count * x + i];
            }
        }
    }
    return 0;
}

int planes_join(const char *where, const planes *from, frame *out)
{
    const pel_view *first = &from->channel[0].view;
    const pel_format format = from->count == 1 ? PEL_GRAY8 : PEL_RGB888;
    if (frame_resize(out, format, PEL_RANGE_FULL, first->width, first->height)) {
        return say_error(where, "out of memory for %ux%u", first->width, first->height);
    }
    for (unsigned y = 0; y < first->height; y++) {
        uint8_t *const to = plain_row(&out->view, y);
        for (unsigned i = 0; i < from->count; i++) {
            const uint8_t *channel = plain_row(&from->channel[i].view, y);
            for (size_t x = 0; x < first->width; x++) {
                to[from->count * x + i] = channel[x];
            }
        }
    }
    return 0;
}

void planes_free(planes *of)
{
    for (unsigned i = 0; i < 3; i++) {
        frame_free(&of->channel[i]);
    }
    of->count = 0;
}
