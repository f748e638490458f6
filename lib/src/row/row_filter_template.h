/*
 * The row kernels of neighbourhoods in the vectors of x86, whatever their width. The file that
 * includes this one says what the words mean: vec is a vector and LANES its bytes, V(op) and
 * BITS(op) are the intrinsic functions of its width, `everywhere` repeats 16 bytes, store_words
 * writes what unpacking bytes left behind, and ISA, INLINE and KERNEL say for what a function is
 * compiled and what it is called.
 *
 * The last vector of a row ends where the row ends and so overlaps the one before it: the results
 * there are written twice. Nothing outside the neighbours of the row is read.
 */

typedef struct words {
    vec low, high; /* 16 bits each, in the order that unpacking bytes gives */
} words;

INLINE vec load(const uint8_t *bytes)
{
    return BITS(loadu)((const loose_vec *)(const void *)bytes);
}

INLINE void store(uint8_t *bytes, vec value)
{
    BITS(storeu)((loose_vec *)(void *)bytes, value);
}

/* Where the vector behind the one at x begins; count if there is none. */
INLINE int behind(int x, int count)
{
    x += LANES;
    return x >= count || x + LANES <= count ? x : count - LANES;
}

/* Taps for two neighbouring bytes. */
INLINE vec taps_of(int first, int second)
{
    return V(set1_epi16)((int16_t)((first & 255) | (second & 255) * 256));
}

/* p times the first tap plus q times the second. */
INLINE words weighted(vec p, vec q, vec taps)
{
    const words sums = {V(maddubs_epi16)(V(unpacklo_epi8)(p, q), taps),
                        V(maddubs_epi16)(V(unpackhi_epi8)(p, q), taps)};
    return sums;
}

INLINE words sum_of(words a, words b)
{
    const words sums = {V(add_epi16)(a.low, b.low), V(add_epi16)(a.high, b.high)};
    return sums;
}

/* Results of the even places, 0..255 in 16 bits, and of the odd ones between them. */
INLINE vec interleaved(vec even, vec odd)
{
    return BITS(or)(even, V(slli_epi16)(odd, 8));
}

/* ---- Kernels of fixed taps ----------------------------------------------------------------- */

/*
 * Even places 2i and odd places 2i + 1 apart: a vector of bytes is one of pairs, which
 * _mm_maddubs_epi16 multiplies by two taps and adds up. For an even place the pair that begins at
 * its left neighbour and one of the pair that begins at its right one; for an odd place the pair
 * that begins at its left neighbour is the pair at the even place, and so on.
 */
typedef struct parities {
    vec even, odd;
} parities;

INLINE parities sum_of_parities(parities a, parities b)
{
    const parities sums = {V(add_epi16)(a.even, b.even), V(add_epi16)(a.odd, b.odd)};
    return sums;
}

/* Two taps for the first two of three neighbours, and the third, as first and as second of a
 * pair. */
typedef struct taps3 {
    vec first, third_left, third_right;
} taps3;

INLINE taps3 taps3_of(int a, int b, int c)
{
    const taps3 taps = {taps_of(a, b), taps_of(c, 0), taps_of(0, c)};
    return taps;
}

/* Sums of three neighbours each; p is at the first place. */
INLINE parities row_sum3(const uint8_t *p, const taps3 *taps)
{
    const vec left = load(p - 1), here = load(p), right = load(p + 1);
    const parities sums = {V(add_epi16)(V(maddubs_epi16)(left, taps->first),
                                        V(maddubs_epi16)(right, taps->third_left)),
                           V(add_epi16)(V(maddubs_epi16)(here, taps->first),
                                        V(maddubs_epi16)(right, taps->third_right))};
    return sums;
}

typedef struct taps5 {
    vec first, third, fifth_left, fifth_right;
} taps5;

INLINE taps5 taps5_of(int a, int b, int c, int d, int e)
{
    const taps5 taps = {taps_of(a, b), taps_of(c, d), taps_of(e, 0), taps_of(0, e)};
    return taps;
}

INLINE parities row_sum5(const uint8_t *p, const taps5 *taps)
{
    const vec fifth = load(p + 2);
    const vec even = V(add_epi16)(V(maddubs_epi16)(load(p - 2), taps->first),
                                  V(maddubs_epi16)(load(p), taps->third));
    const vec odd = V(add_epi16)(V(maddubs_epi16)(load(p - 1), taps->first),
                                 V(maddubs_epi16)(load(p + 1), taps->third));
    const parities sums = {V(add_epi16)(even, V(maddubs_epi16)(fifth, taps->fifth_left)),
                           V(add_epi16)(odd, V(maddubs_epi16)(fifth, taps->fifth_right))};
    return sums;
}

ISA void KERNEL(gauss3)(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];
    const taps3 outer = taps3_of(1, 2, 1), inner = taps3_of(2, 4, 2);
    const vec half = V(set1_epi16)(8);

    for (int x = 0; x < count; x = behind(x, count)) {
        const parities sums =
            sum_of_parities(sum_of_parities(row_sum3(a + x, &outer), row_sum3(b + x, &inner)),
                            row_sum3(c + x, &outer));
        store(out + x, interleaved(V(srli_epi16)(V(add_epi16)(sums.even, half), 4),
                                   V(srli_epi16)(V(add_epi16)(sums.odd, half), 4)));
    }
}

ISA void KERNEL(box3)(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];
    const taps3 ones = taps3_of(1, 1, 1);
    const vec half = V(set1_epi16)(4), ninth = V(set1_epi16)(7282);

    for (int x = 0; x < count; x = behind(x, count)) {
        const parities sums =
            sum_of_parities(sum_of_parities(row_sum3(a + x, &ones), row_sum3(b + x, &ones)),
                            row_sum3(c + x, &ones));
        store(out + x, interleaved(V(mulhi_epu16)(V(add_epi16)(sums.even, half), ninth),
                                   V(mulhi_epu16)(V(add_epi16)(sums.odd, half), ninth)));
    }
}

/* At most 65280 + 128: 16 bits without a sign. */
ISA void KERNEL(binomial5)(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2], *const d = rows[3],
                         *const e = rows[4];
    const taps5 outer = taps5_of(1, 4, 6, 4, 1), next = taps5_of(4, 16, 24, 16, 4);
    const taps5 inner = taps5_of(6, 24, 36, 24, 6);
    const vec half = V(set1_epi16)(128);

    for (int x = 0; x < count; x = behind(x, count)) {
        const parities upper = sum_of_parities(row_sum5(a + x, &outer), row_sum5(b + x, &next));
        const parities lower = sum_of_parities(row_sum5(d + x, &next), row_sum5(e + x, &outer));
        const parities sums =
            sum_of_parities(sum_of_parities(upper, lower), row_sum5(c + x, &inner));
        store(out + x, interleaved(V(srli_epi16)(V(add_epi16)(sums.even, half), 8),
                                   V(srli_epi16)(V(add_epi16)(sums.odd, half), 8)));
    }
}

/* ---- Gradients ----------------------------------------------------------------------------- */

INLINE words sobel_x_at(const uint8_t *a, const uint8_t *b, const uint8_t *c)
{
    const vec outer = taps_of(-1, 1), inner = taps_of(-2, 2);
    return sum_of(sum_of(weighted(load(a - 1), load(a + 1), outer),
                         weighted(load(b - 1), load(b + 1), inner)),
                  weighted(load(c - 1), load(c + 1), outer));
}

INLINE words sobel_y_at(const uint8_t *a, const uint8_t *c)
{
    const vec outer = taps_of(-1, 1), inner = taps_of(-2, 2);
    return sum_of(
        sum_of(weighted(load(a - 1), load(c - 1), outer), weighted(load(a), load(c), inner)),
        weighted(load(a + 1), load(c + 1), outer));
}

/* |gx| + |gy| */
INLINE words absolute_sum(words gx, words gy)
{
    const words sums = {V(add_epi16)(V(abs_epi16)(gx.low), V(abs_epi16)(gy.low)),
                        V(add_epi16)(V(abs_epi16)(gx.high), V(abs_epi16)(gy.high))};
    return sums;
}

/* floor(sqrt(value)), value < 2^21: single precision holds it exactly, and its root is never
 * rounded up to a whole number, as that is at least 2^-12 away and the last digit 2^-13. */
INLINE vec root_of(vec value)
{
    return V(cvttps_epi32)(V(sqrt_ps)(V(cvtepi32_ps)(value)));
}

INLINE vec length_of_8(vec gx, vec gy)
{
    const vec first = V(unpacklo_epi16)(gx, gy), second = V(unpackhi_epi16)(gx, gy);
    return V(packs_epi32)(root_of(V(madd_epi16)(first, first)),
                          root_of(V(madd_epi16)(second, second)));
}

INLINE words length_of(words gx, words gy)
{
    const words lengths = {length_of_8(gx.low, gy.low), length_of_8(gx.high, gy.high)};
    return lengths;
}

ISA void KERNEL(sobel_x)(const uint8_t *const rows[], uint16_t count, int16_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0; x < count; x = behind(x, count)) {
        const words gx = sobel_x_at(a + x, b + x, c + x);
        store_words(out + x, gx.low, gx.high);
    }
}

ISA void KERNEL(sobel_y)(const uint8_t *const rows[], uint16_t count, int16_t *out)
{
    const uint8_t *const a = rows[0], *const c = rows[2];

    for (int x = 0; x < count; x = behind(x, count)) {
        const words gy = sobel_y_at(a + x, c + x);
        store_words(out + x, gy.low, gy.high);
    }
}

ISA void KERNEL(gradient_abs)(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0; x < count; x = behind(x, count)) {
        const words sums = absolute_sum(sobel_x_at(a + x, b + x, c + x), sobel_y_at(a + x, c + x));
        store(out + x, V(packus_epi16)(sums.low, sums.high));
    }
}

ISA void KERNEL(gradient_abs_s16)(const uint8_t *const rows[], uint16_t count, int16_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0; x < count; x = behind(x, count)) {
        const words sums = absolute_sum(sobel_x_at(a + x, b + x, c + x), sobel_y_at(a + x, c + x));
        store_words(out + x, sums.low, sums.high);
    }
}

ISA void KERNEL(gradient)(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0; x < count; x = behind(x, count)) {
        const words lengths = length_of(sobel_x_at(a + x, b + x, c + x), sobel_y_at(a + x, c + x));
        store(out + x, V(packus_epi16)(lengths.low, lengths.high));
    }
}

ISA void KERNEL(gradient_s16)(const uint8_t *const rows[], uint16_t count, int16_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0; x < count; x = behind(x, count)) {
        const words lengths = length_of(sobel_x_at(a + x, b + x, c + x), sobel_y_at(a + x, c + x));
        store_words(out + x, lengths.low, lengths.high);
    }
}

/* ---- Order --------------------------------------------------------------------------------- */

INLINE vec smaller(vec a, vec b)
{
    return V(min_epu8)(a, b);
}

INLINE vec larger(vec a, vec b)
{
    return V(max_epu8)(a, b);
}

INLINE vec smallest(vec a, vec b, vec c)
{
    return smaller(smaller(a, b), c);
}

INLINE vec largest(vec a, vec b, vec c)
{
    return larger(larger(a, b), c);
}

INLINE vec middle_of(vec a, vec b, vec c)
{
    return larger(smaller(a, b), smaller(larger(a, b), c));
}

typedef struct columns {
    vec low, middle, high; /* the three of each column in order */
} columns;

INLINE columns sorted_columns(vec a, vec b, vec c)
{
    const vec low = smaller(a, b), high = larger(a, b);
    const columns sorted = {smaller(low, c), larger(low, smaller(high, c)), larger(high, c)};
    return sorted;
}

/* As in plain C. */
ISA void KERNEL(median3)(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0; x < count; x = behind(x, count)) {
        const columns left = sorted_columns(load(a + x - 1), load(b + x - 1), load(c + x - 1));
        const columns here = sorted_columns(load(a + x), load(b + x), load(c + x));
        const columns right = sorted_columns(load(a + x + 1), load(b + x + 1), load(c + x + 1));
        store(out + x, middle_of(largest(left.low, here.low, right.low),
                                 middle_of(left.middle, here.middle, right.middle),
                                 smallest(left.high, here.high, right.high)));
    }
}

INLINE vec smallest_of_row(const uint8_t *p)
{
    return smallest(load(p - 1), load(p), load(p + 1));
}

INLINE vec largest_of_row(const uint8_t *p)
{
    return largest(load(p - 1), load(p), load(p + 1));
}

ISA void KERNEL(min3)(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0; x < count; x = behind(x, count)) {
        store(out + x,
              smallest(smallest_of_row(a + x), smallest_of_row(b + x), smallest_of_row(c + x)));
    }
}

ISA void KERNEL(max3)(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0; x < count; x = behind(x, count)) {
        store(out + x,
              largest(largest_of_row(a + x), largest_of_row(b + x), largest_of_row(c + x)));
    }
}

/* ---- Labels -------------------------------------------------------------------------------- */

/* All nine are equal where the smallest is the largest. */
ISA void KERNEL(erode_labels3)(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0; x < count; x = behind(x, count)) {
        const vec low =
            smallest(smallest_of_row(a + x), smallest_of_row(b + x), smallest_of_row(c + x));
        const vec high =
            largest(largest_of_row(a + x), largest_of_row(b + x), largest_of_row(c + x));
        store(out + x, BITS(and)(low, V(cmpeq_epi8)(low, high)));
    }
}

/* Labels less one, so that 0 is the largest of all. */
INLINE vec smallest_label_of_row(const uint8_t *p)
{
    const vec one = V(set1_epi8)(1);
    return smallest(V(sub_epi8)(load(p - 1), one), V(sub_epi8)(load(p), one),
                    V(sub_epi8)(load(p + 1), one));
}

ISA void KERNEL(dilate_labels3)(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0; x < count; x = behind(x, count)) {
        const vec own = load(b + x);
        const vec found = smallest(smallest_label_of_row(a + x), smallest_label_of_row(b + x),
                                   smallest_label_of_row(c + x));
        const vec label = V(add_epi8)(found, V(set1_epi8)(1));
        const vec none = V(cmpeq_epi8)(own, BITS(setzero)());
        store(out + x, BITS(or)(own, BITS(and)(label, none)));
    }
}
