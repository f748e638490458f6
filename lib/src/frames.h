/* What the frame forms of filter, point and feature have in common: checks at the door and the way
 * to a row. Private to lib/. */
#ifndef PEL_FRAMES_H
#define PEL_FRAMES_H

#include "pel/image.h"

/* The channels of a format whose pixels are bytes of one kind each: 1 for GRAY8, 3 for RGB888 and
 * BGR888, 0 for all others. */
unsigned pel_i_channels(pel_format format);

/* PEL_OK for a good view of `channels` channels, or of 1 or 3 where channels is 0. */
pel_status pel_i_check_bytes(const pel_cview *view, unsigned channels);

/* PEL_OK if the two views share no pixel, or are the same pixels; PEL_ERR_ARG if not. Both are
 * good. */
pel_status pel_i_check_places(const pel_cview *src, const pel_cview *dst);

/* PEL_OK if both are good GRAY8 views, of any two sizes, and the same pixels or apart. */
pel_status pel_i_check_gray_pair(const pel_cview *src, const pel_view *dst);

/* PEL_OK if both are good, of the same format, and do not overlap. */
pel_status pel_i_check_apart(const pel_cview *src, const pel_view *dst);

/* PEL_OK if both are good, of the same format and size, and either the same pixels or apart. */
pel_status pel_i_check_pair(const pel_cview *src, const pel_view *dst);

/* Row y of a view. */
const uint8_t *pel_i_row(const pel_cview *view, uint16_t y);
uint8_t *pel_i_row_to_write(const pel_view *view, uint16_t y);

#endif
