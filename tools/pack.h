/* Pictures in one pixel format become pictures in another, as a sensor would send them. */
#ifndef PACK_H
#define PACK_H

#include "source.h"

/*
 * Converts `view` to `format`; YCbCr comes out in `range`. Memory of `out` is reused.
 *
 * The size stays, but a Bayer picture has half of its mosaic's width and height in every format
 * except its own. The chroma of a pair (4:2:2) or of a quad (4:2:0) is the mean, halves upward; 5
 * and 6 bits of RGB565 are the nearest; a Bayer mosaic takes from each pixel the channel of its
 * place. YCbCr that keeps its range never goes through RGB: between the orders of 4:2:2, and
 * between the two forms of 4:2:0, nothing is lost. The same format and range copies the bytes.
 *
 * 0; -1 after a message that names `where` if the format cannot have the size.
 */
int pack_frame(const char *where, const pel_cview *view, pel_format format, pel_range range,
               frame *out);

/* Whether the bytes of a format mean Y, U, V, in one colour range only; RGB and mosaics have
 * none. */
int pack_has_range(pel_format format);

/* Row y of a picture's colours as R G B, and as full-range luma; `row` has room for 3 *
 * PEL_SIDE_MAX or PEL_SIDE_MAX bytes. The view must be one that pel_cview_check accepts. */
void pack_rgb_row(const pel_cview *view, unsigned y, uint8_t *row);
void pack_gray_row(const pel_cview *view, unsigned y, uint8_t *row);

#endif
