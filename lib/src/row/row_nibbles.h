/*
 * Box classes for processors that look up 16 bytes at once.
 *
 * A table of 256 masks is too large for a byte shuffle, but the masks of boxes are intervals, and
 * an interval falls into two tests on the nibbles of a value, v = 16 h + l, for all 8 classes at
 * once (bit c of every byte below belongs to class c with the interval min..max):
 *
 *     v >= min, and h <= max / 16:    above[h] | (rough[h] & from[l])
 *     v <= max, or h < max / 16:      below[h] | to[l]
 *
 * with above: min / 16 < h <= max / 16; rough: min / 16 <= h <= max / 16; from: l >= min % 16;
 * below: h != max / 16; to: l <= max % 16. Both together are v in min..max, exactly. What rough
 * does not have is not in it, whatever l is; what above and below have is in it.
 */
#ifndef PEL_ROW_NIBBLES_H
#define PEL_ROW_NIBBLES_H

#include "pel/config.h"

enum {
    PEL_NIBBLES_ABOVE = 0, /* by the high nibble, like the next two */
    PEL_NIBBLES_ROUGH = 16,
    PEL_NIBBLES_BELOW = 32,
    PEL_NIBBLES_FROM = 48, /* by the low nibble, like the next */
    PEL_NIBBLES_TO = 64,
    PEL_NIBBLES_CHANNEL = 80, /* from Y's tables to U's, and from U's to V's */
    PEL_NIBBLES_BYTES = 240
};

#endif
