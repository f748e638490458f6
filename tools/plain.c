#include "plain.h"

#include "pack.h"
#include "say.h"

uint8_t *plain_row(const pel_view *view, unsigned y)
{
    return view->plane[0] + (ptrdiff_t)y * view->stride_bytes[0];
}

int plain_make(const char *where, const pel_cview *view, plain_kind kind, frame *out)
{
    const unsigned width = pel_color_width(view->format, view->width);
    const unsigned height = pel_color_height(view->format, view->height);
    const int gray = kind == PLAIN_GRAY || (kind == PLAIN_AS_IT_IS && view->format == PEL_GRAY8);
    if (frame_resize(out, gray ? PEL_GRAY8 : PEL_RGB888, PEL_RANGE_FULL, width, height)) {
        return say_error(where, "out of memory for %ux%u", width, height);
    }
    for (unsigned y = 0; y < height; y++) {
        if (gray) {
            pack_gray_row(view, y, plain_row(&out->view, y));
        } else {
            pack_rgb_row(view, y, plain_row(&out->view, y));
        }
    }
    return 0;
}
