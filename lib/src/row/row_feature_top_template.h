/*
 * The row kernel that finds the tops among responses, in vectors; the words of
 * row_feature_template.h and
 *     FOURS                      how many responses a vector holds
 *     ABOVE_32(a, b)             32 bits with a sign: all ones where a > b
 *     first_of(v)                the first place that is all ones, FOURS if all are zeros
 */

/* Those over all neighbours before them, in raster order, and with `more` added over those behind:
 * 1 lets these be as large. */
INLINE vec tops_at(const int32_t *const rows[], int x, vec more)
{
    const int32_t *const above = rows[0] + x, *const row = rows[1] + x, *const below = rows[2] + x;
    const vec r = load(row), least = V(add_epi32)(r, more);
    const vec before =
        BITS(and)(BITS(and)(ABOVE_32(r, load(above - 1)), ABOVE_32(r, load(above))),
                  BITS(and)(ABOVE_32(r, load(above + 1)), ABOVE_32(r, load(row - 1))));
    const vec behind_it =
        BITS(and)(BITS(and)(ABOVE_32(least, load(row + 1)), ABOVE_32(least, load(below - 1))),
                  BITS(and)(ABOVE_32(least, load(below)), ABOVE_32(least, load(below + 1))));
    return BITS(and)(before, behind_it);
}

ISA uint16_t KERNEL(next_top)(const int32_t *const rows[], uint16_t begin, uint16_t end,
                              int32_t threshold, int kind)
{
    const vec under = V(set1_epi32)(threshold - 1);
    const vec more = V(set1_epi32)(kind == PEL_ROW_TOP_FIRST);
    int x = begin;

    for (; x + FOURS <= end; x += FOURS) {
        vec tops = ABOVE_32(load(rows[1] + x), under);
        int first = first_of(tops);
        if (first < FOURS && kind != PEL_ROW_TOP_ANY) {
            tops = BITS(and)(tops, tops_at(rows, x, more));
            first = first_of(tops);
        }
        if (first < FOURS) {
            return (uint16_t)(x + first);
        }
    }
    return pel_row_next_top(rows, (uint16_t)x, end, threshold, kind);
}
