/*
 * Resizing in vectors of 16 or 32 bytes. To be included behind eight_means(). Beside the words of
 * row_point_area_template.h:
 *
 *   pair_sums(v)       the sums of each two of its bytes, as 16 bits
 *   pair_sums_u16(v)   the sums of each two of its 16 bits, which are under 2^15, as 32 bits
 */

INLINE void add_u32(uint32_t *sums, vec v)
{
    store_u32(sums, V(add_epi32)(load_u32(sums), v));
}

ISA void KERNEL(box_add2)(const uint8_t *src, uint16_t width_out, uint32_t *sums)
{
    uint16_t x = 0;

    for (; x + LANES / 2 <= width_out; x += LANES / 2) {
        const halves pairs = widened_u16(pair_sums(load(src)));
        add_u32(sums + x, pairs.low);
        add_u32(sums + x + LANES / 4, pairs.high);
        src += LANES;
    }
    pel_row_box_add(src, 2, 1, (uint16_t)(width_out - x), sums + x);
}

ISA void KERNEL(box_add4)(const uint8_t *src, uint16_t width_out, uint32_t *sums)
{
    uint16_t x = 0;

    for (; x + LANES / 4 <= width_out; x += LANES / 4) {
        add_u32(sums + x, pair_sums_u16(pair_sums(load(src))));
        src += LANES;
    }
    pel_row_box_add(src, 4, 1, (uint16_t)(width_out - x), sums + x);
}

/*
 * Single precision gives the whole part of the quotient: both sides are whole numbers under 2^24,
 * which it holds as they are, and a quotient n / area just under a whole k <= 256 is so by 1 / area
 * >= 2^-16 at least, which is no less than the distance of the numbers below k: it is not rounded
 * up to k.
 */
INLINE vec quotients(const uint32_t *sums, vec half, vec area)
{
    const vec sum = V(add_epi32)(load_u32(sums), half);
    return V(cvttps_epi32)(V(div_ps)(V(cvtepi32_ps)(sum), V(cvtepi32_ps)(area)));
}

INLINE vec box_means(const uint32_t *sums, vec half, vec area)
{
    enum { QUARTER = LANES / 4 };
    const vec first = quotients(sums, half, area);
    const vec second = quotients(sums + QUARTER, half, area);
    const vec third = quotients(sums + 2 * QUARTER, half, area);
    const vec fourth = quotients(sums + 3 * QUARTER, half, area);
    return packed_order(
        V(packus_epi16)(V(packs_epi32)(first, second), V(packs_epi32)(third, fourth)));
}

ISA void KERNEL(box_mean)(const uint32_t *sums, uint32_t area, uint16_t count, uint8_t *dst)
{
    const vec half = V(set1_epi32)((int32_t)(area / 2));
    const vec divisor = V(set1_epi32)((int32_t)area);
    const int end = count - LANES;

    for (int x = 0; x < end; x += LANES) {
        store(dst + x, box_means(sums + x, half, divisor));
    }
    store(dst + end, box_means(sums + end, half, divisor));
}

/* ---- Bilinear means ------------------------------------------------------------------------ */

/* eight_means() is that of row_point_bilinear_template.h, or a wider one. rows->last >= 15. Columns
 * that lie farther apart are for plain C. */
ISA void KERNEL(bilinear)(const pel_row_between *rows, const pel_row_place *places, uint16_t count,
                          uint8_t *dst)
{
    const pel_row_between between = *rows; /* which no result can be written over */
    const int rightmost = rows->last - 15;
    uint16_t i = 0;

    for (; i + 8 <= count; i = (uint16_t)(i + 8)) {
        const int base = places[i].x < rightmost ? places[i].x : rightmost;
        const int end = places[i + 7].x + (places[i + 7].x < between.last);
        if (end - base > 15) {
            pel_row_bilinear(rows, places + i, 1, 8, dst + i);
        } else {
            eight_means(&between, places + i, base, dst + i);
        }
    }
    pel_row_bilinear(rows, places + i, 1, (uint16_t)(count - i), dst + i);
}
