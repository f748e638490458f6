/*
 * Sums over areas in vectors of 16 or 32 bytes. Beside the words of row_point_map_template.h:
 *
 *   running(v)       the sums of its 32 bits from the first one on
 *   running_u16(v)   likewise of its 16 bits
 *   last_of(v)       its last 32 bits everywhere
 *   last_of_u16(v)   its last 16 bits everywhere, as 32 bits
 *   packed_order(v)  what four vectors of 32 bits became by being packed twice, as one after the
 *                    other
 */

/* The halves of bytes as 16 bits, and of 16 bits as 32, in order. */
typedef struct halves {
    vec low, high;
} halves;

INLINE halves widened(vec bytes)
{
    const vec v = ordered(bytes), zero = BITS(setzero)();
    const halves h = {V(unpacklo_epi8)(v, zero), V(unpackhi_epi8)(v, zero)};
    return h;
}

INLINE halves widened_u16(vec words)
{
    const vec v = ordered(words), zero = BITS(setzero)();
    const halves h = {V(unpacklo_epi16)(v, zero), V(unpackhi_epi16)(v, zero)};
    return h;
}

INLINE vec load_u16(const uint16_t *words)
{
    return load((const uint8_t *)words);
}

INLINE void store_u16(uint16_t *words, vec v)
{
    store((uint8_t *)words, v);
}

INLINE vec load_u32(const uint32_t *words)
{
    return load((const uint8_t *)words);
}

INLINE void store_u32(uint32_t *words, vec v)
{
    store((uint8_t *)words, v);
}

/* ---- Sums of columns ----------------------------------------------------------------------- */

ISA void KERNEL(columns_add)(const uint8_t *src, uint16_t count, uint16_t times, uint16_t *sums)
{
    const vec factor = V(set1_epi16)((int16_t)times);
    uint16_t x = 0;

    for (; x + LANES <= count; x += LANES) {
        const halves v = widened(load(src + x));
        store_u16(sums + x, V(add_epi16)(load_u16(sums + x), V(mullo_epi16)(v.low, factor)));
        store_u16(sums + x + LANES / 2,
                  V(add_epi16)(load_u16(sums + x + LANES / 2), V(mullo_epi16)(v.high, factor)));
    }
    pel_row_columns_add(src + x, (uint16_t)(count - x), times, sums + x);
}

ISA void KERNEL(columns_subtract)(const uint8_t *src, uint16_t count, uint16_t *sums)
{
    uint16_t x = 0;

    for (; x + LANES <= count; x += LANES) {
        const halves v = widened(load(src + x));
        store_u16(sums + x, V(sub_epi16)(load_u16(sums + x), v.low));
        store_u16(sums + x + LANES / 2, V(sub_epi16)(load_u16(sums + x + LANES / 2), v.high));
    }
    pel_row_columns_subtract(src + x, (uint16_t)(count - x), sums + x);
}

/* ---- Integral rows ------------------------------------------------------------------------- */

/* The sums of half a vector of pixels; at most 16 * 255. */
INLINE vec integrate(vec words, vec before, const uint32_t *above, uint32_t *sums)
{
    const vec row = running_u16(words);
    const halves h = widened_u16(row);

    const vec low = V(add_epi32)(load_u32(above), V(add_epi32)(h.low, before));
    const vec high = V(add_epi32)(load_u32(above + LANES / 4), V(add_epi32)(h.high, before));
    store_u32(sums, low);
    store_u32(sums + LANES / 4, high);
    return V(add_epi32)(before, last_of_u16(row));
}

ISA void KERNEL(integral)(const uint8_t *src, uint16_t count, const uint32_t *above, uint32_t *sums)
{
    vec before = BITS(setzero)();
    uint32_t row;
    uint16_t x = 0;

    for (; x + LANES <= count; x += LANES) {
        const halves v = widened(load(src + x));
        before = integrate(v.low, before, above + x, sums + x);
        before = integrate(v.high, before, above + x + LANES / 2, sums + x + LANES / 2);
    }
    row = first_of(before);
    for (; x < count; x++) {
        row += src[x];
        sums[x] = above[x] + row;
    }
}

/* ---- Adaptive threshold -------------------------------------------------------------------- */

typedef struct mean_row {
    const uint8_t *src;
    const uint16_t *columns;
    int count, radius;
    int32_t c, area;
} mean_row;

/* What the kernel in plain C compares with: 2 sum < area (2 v - 1) is sum < area v - (area - 1) / 2
 * as area is odd. */
typedef struct mean_test {
    vec area, base; /* base: area * c - (area - 1) / 2 */
    vec sum;        /* of the pixels around the next one */
} mean_test;

/* A quarter of a vector: `product` is area * src. All ones where it is over the mean. */
INLINE vec quarter_over(mean_test *test, vec enters, vec leaves, vec product)
{
    const vec change = V(sub_epi32)(enters, leaves);
    const vec after = running(change);
    const vec sum = V(add_epi32)(test->sum, V(sub_epi32)(after, change));

    test->sum = V(add_epi32)(test->sum, last_of(after));
    return V(cmpgt_epi32)(V(add_epi32)(product, test->base), sum);
}

/* Half a vector, in 16 bits. */
INLINE vec half_over(mean_test *test, const uint16_t *entering, const uint16_t *leaving, vec words)
{
    const halves enters = widened_u16(load_u16(entering));
    const halves leaves = widened_u16(load_u16(leaving));
    const vec v = ordered(words);
    const vec low = V(mullo_epi16)(v, test->area), high = V(mulhi_epu16)(v, test->area);
    const vec first = quarter_over(test, enters.low, leaves.low, V(unpacklo_epi16)(low, high));
    const vec second = quarter_over(test, enters.high, leaves.high, V(unpackhi_epi16)(low, high));

    return V(packs_epi32)(first, second);
}

/* The pixels first .. end-1 of a row, one by one: those whose columns repeat beyond an end. */
INLINE uint32_t over_mean_edge(const mean_row *row, uint32_t sum, int first, int end, uint8_t *dst)
{
    const int last = row->count - 1, radius = row->radius;

    for (int x = first; x < end; x++) {
        const int enters = x + radius + 1 < last ? x + radius + 1 : last;
        const int leaves = x > radius ? x - radius : 0;
        const int32_t value = row->src[x] + row->c;
        dst[x] = 2 * (int32_t)sum < row->area * (2 * value - 1) ? 255 : 0;
        sum += row->columns[enters];
        sum -= row->columns[leaves];
    }
    return sum;
}

/* The pixels first .. end-1, whole vectors, with columns on both sides. */
INLINE uint32_t over_mean_inside(const mean_row *row, uint32_t sum, int first, int end,
                                 uint8_t *dst)
{
    mean_test test = {V(set1_epi16)((int16_t)row->area),
                      V(set1_epi32)(row->area * row->c - (row->area - 1) / 2),
                      V(set1_epi32)((int32_t)sum)};

    for (int x = first; x < end; x += LANES) {
        const uint16_t *const entering = row->columns + x + row->radius + 1;
        const uint16_t *const leaving = row->columns + x - row->radius;
        const halves v = widened(load(row->src + x));
        const vec low = half_over(&test, entering, leaving, v.low);
        const vec high = half_over(&test, entering + LANES / 2, leaving + LANES / 2, v.high);
        store(dst + x, packed_order(V(packs_epi16)(low, high)));
    }
    return first_of(test.sum);
}

ISA void KERNEL(over_mean)(const uint8_t *src, const uint16_t *columns, uint16_t count,
                           uint16_t radius, int16_t c, uint8_t *dst)
{
    const int side = 2 * radius + 1;
    const mean_row row = {src, columns, count, radius, c, (int32_t)side * side};
    const int inside = count - side; /* from radius on; 0 or less: none */
    const int left = inside >= LANES ? radius : 0;
    const int right = left + (inside >= LANES ? inside / LANES * LANES : 0);
    uint32_t sum = columns[0] * ((uint32_t)radius + 1);

    for (int x = 1; x <= radius; x++) {
        sum += columns[x < count - 1 ? x : count - 1];
    }
    sum = over_mean_edge(&row, sum, 0, left, dst);
    sum = over_mean_inside(&row, sum, left, right, dst);
    (void)over_mean_edge(&row, sum, right, count, dst);
}
