#include "verdict.h"

#include <stdlib.h>

#include "pack.h"

/* Costs this near to each other are alike: half a percent, or 0.01 bits per byte. */
enum { NEAR_PER_MILLE = 5, NEAR_MILLI = 10 };

/* Below this many thousandths of a bit per byte there is nothing to predict. */
enum { FLAT_MILLI = 20 };

/* Random bytes leave 7 bits of 8, real pictures 1 to 4. */
enum { NOISE_MILLI = 6000 };

/* Impossible colours prove something from this many on, and if there are so many times fewer in the
 * other reading: noise and sharpening make some, too. */
enum { PROOF_MIN = 8, PROOF_TIMES = 4 };

static int by_cost(const void *a, const void *b)
{
    const candidate *one = a;
    const candidate *other = b;
    const uint64_t wrong = one->fit.impossible[0];
    const uint64_t other_wrong = other->fit.impossible[0];
    if (one->milli_bits != other->milli_bits) {
        return one->milli_bits < other->milli_bits ? -1 : 1;
    }
    if (wrong != other_wrong) {
        return wrong < other_wrong ? -1 : 1;
    }
    if (one->how.swapped != other->how.swapped) {
        return one->how.swapped - other->how.swapped;
    }
    if (one->how.format != other->how.format) {
        return one->how.format < other->how.format ? -1 : 1;
    }
    return one->how.width < other->how.width ? -1 : one->how.width > other->how.width;
}

static int is_common(const candidate *of)
{
    return reading_common_size(of->how.width, of->how.height);
}

int verdict_disproof(const candidate *one, const candidate *other)
{
    if (other->fit.colors != one->fit.colors || other->milli_bits != one->milli_bits) {
        return -1;
    }
    for (int range = 0; range < 2; range++) {
        if (one->fit.impossible[range] >= PROOF_MIN + PROOF_TIMES * other->fit.impossible[range]) {
            return range;
        }
    }
    return -1;
}

static int is_disproved(const candidate *one, const candidate *than)
{
    return verdict_disproof(one, than) >= 0;
}

/* Moves candidate `from` to place `to`; those between move down. */
static void move_up(candidate *list, size_t from, size_t to)
{
    const candidate moved = list[from];
    for (size_t i = from; i > to; i--) {
        list[i] = list[i - 1];
    }
    list[to] = moved;
}

typedef int is_worse(const candidate *one, const candidate *than);

static int has_odd_size(const candidate *one, const candidate *than)
{
    return !is_common(one) && is_common(than);
}

/* Of the first `count`, brings those to the front that are worse than none; returns how many. */
static size_t keep_best(candidate *list, size_t count, is_worse *worse)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        int good = 1;
        for (size_t k = 0; k < count && good; k++) {
            good = k == i || !worse(&list[i], &list[k]);
        }
        if (good) {
            move_up(list, i, kept++);
        }
    }
    return kept;
}

static int same_but_swapped(const candidate *list, size_t count)
{
    for (size_t i = 1; i < count; i++) {
        if (list[i].milli_bits != list[0].milli_bits || list[i].how.width != list[0].how.width) {
            return 0;
        }
    }
    return count == 2;
}

verdict verdict_reach(candidate *list, size_t count)
{
    verdict reached = {1, VERDICT_ONLY, 0, 0};
    qsort(list, count, sizeof *list, by_cost);
    const uint32_t least = list[0].milli_bits;
    if (least > NOISE_MILLI) {
        reached.equal = 0;
        reached.reason = VERDICT_NOISE;
    }
    if (count == 1 || least > NOISE_MILLI) {
        return reached;
    }
    const uint32_t near = least + least * NEAR_PER_MILLE / 1000 + NEAR_MILLI;
    size_t equal = 1;
    while (equal < count && list[equal].milli_bits <= near) {
        equal++;
    }
    reached.reason = VERDICT_NEIGHBOURS;
    reached.next = equal < count ? equal : 0;
    reached.rival = reached.next;
    if (least < FLAT_MILLI && equal > 1) {
        reached.equal = equal;
        reached.reason = VERDICT_FLAT;
        return reached;
    }
    const size_t possible = keep_best(list, equal, is_disproved);
    if (possible > 0 && possible < equal) {
        reached.reason = VERDICT_COLORS;
        reached.rival = possible;
        equal = possible;
    }
    const size_t sized = keep_best(list, equal, has_odd_size);
    if (sized < equal) {
        reached.reason = VERDICT_SIZE;
        reached.rival = sized;
        equal = sized;
    }
    reached.equal = equal;
    if (equal > 1) {
        reached.reason = same_but_swapped(list, equal) ? VERDICT_SWAPPED : VERDICT_UNCLEAR;
    }
    return reached;
}

verdict_range verdict_judge_range(const fit *of)
{
    enum { BEYOND_PER_MILLE = 1, COLORS_PER_MILLE = 5, SLACK = 1 };
    if (of->beyond_limited * 1000 > of->samples * BEYOND_PER_MILLE) {
        return VERDICT_FULL_BEYOND;
    }
    if (of->impossible[1] >= PROOF_MIN + PROOF_TIMES * of->impossible[0] &&
        of->impossible[1] * 1000 > of->colors * COLORS_PER_MILLE) {
        return VERDICT_FULL_COLORS;
    }
    if (abs(of->luma_min - 16) <= SLACK && abs(of->luma_max - 235) <= SLACK) {
        return VERDICT_LIMITED;
    }
    return VERDICT_RANGE_UNCLEAR;
}
