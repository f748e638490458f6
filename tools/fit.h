/*
 * How well a picture fits the format that it is read in: what a file without a header says of
 * itself.
 *
 * Neighbours in a picture are alike. So each sample is predicted by the one to its left and by the
 * one above it in the same channel, and what the prediction leaves is counted as log2(1 + 2 |rest|)
 * bits. In the right format and size this is little; where another channel's byte is taken for the
 * neighbour it is much. Red and blue are predicted from green, too, if that is cheaper, and one
 * green of a Bayer cell from the other, which tells the greens from red and blue.
 *
 * Swapping U and V does not change this. But it makes colours that no RGB has (a negative red, a
 * green over 255), and those are counted.
 */
#ifndef FIT_H
#define FIT_H

#include <pel.h>

/* Sums over one frame or more; zero it before the first. */
typedef struct fit {
    uint64_t milli_bits; /* of the prediction, over the bytes below */
    uint64_t bytes;
    uint64_t colors;         /* pairs (4:2:2) or quads (4:2:0) of pixels, but for edges */
    uint64_t impossible[2];  /* of those, not in RGB: if full range, if limited range */
    uint64_t samples;        /* of luma and chroma */
    uint64_t beyond_limited; /* of those, outside of 16..235 (chroma 16..240) */
    uint8_t luma_min, luma_max;
} fit;

/* Adds a frame to the sums; of large ones, rows spread over all of it. 0, or -1 if memory is
 * out. */
int fit_add(fit *to, const pel_cview *view);

/* Bits per byte, in thousandths. */
uint32_t fit_milli_bits(const fit *of);

#endif
