/*
 * The row kernels of neighbourhoods in the vectors of x86, whatever their width. The file that
 * includes this one says what the words mean:
 *     vec, LANES               a vector and its bytes
 *     V(op), BITS(op)          the intrinsic functions of its width
 *     everywhere(bytes)        16 bytes in every 16 of a vector
 *     MOVED(last, here, n)     what lies n bytes before `here` if `last` lies before it
 *     EQUAL(a, b)              bytes that are equal become 255, others 0
 *     RECIPROCAL(a), RECIPROCAL_ROOT(a)    in single precision, nearly
 *     PACKED(a, b)             32 bits limited to 16 without a sign
 *     UPPER_BYTES(even, odd)   of 16 bits each, those of even between those of odd
 *     XOR3(a, b, c)            bits that one of them has, or all three
 *     MIN_ELSEWHERE(a, b)      the smaller bytes, by other units than smaller() if there are any
 *     OTHER(a, b, min)         the larger ones, where those are known
 *     words, store_words       results of 16 bits, as unpacking bytes leaves them
 *     ISA, INLINE, KERNEL      for what a function is compiled, what it is called
 *     OWN_PRODUCTS             defined: the file brings what is made of products, because its
 *                              instructions have others
 *
 * The last vector of a row ends where the row ends and so overlaps the one before it: the results
 * there are written twice. Nothing outside the neighbours of the row is read.
 */

INLINE vec load(const uint8_t *bytes)
{
    return BITS(loadu)((const loose_vec *)(const void *)bytes);
}

/* The same for what is used more than once: in a register, not read again for every use. */
INLINE vec load_once(const uint8_t *bytes)
{
    vec value = load(bytes);
#if defined(__x86_64__) /* where an operation can have an operand in memory */
    __asm__("" : "+v"(value));
#endif
    return value;
}

INLINE void store(uint8_t *bytes, vec value)
{
    BITS(storeu)((loose_vec *)(void *)bytes, value);
}

/*
 * A row is done in two parts, each with a beginning of its own: the vectors that lie side by side,
 * from 0 to whole(count), and, if they do not end with the row, one that does:
 *
 *     for (int x = 0, end = whole(count); end != 0; x = count - LANES, end = behind(end, count))
 *         for (; x < end; x += LANES)
 */
INLINE int whole(int count)
{
    return count - count % LANES;
}

INLINE int behind(int end, int count)
{
    return end == count ? 0 : count;
}

/* Taps for two neighbouring bytes. */
INLINE vec taps_of(int first, int second)
{
    return V(set1_epi16)((int16_t)((first & 255) | (second & 255) * 256));
}

#if !defined(OWN_PRODUCTS)
/* n times what q is over p. */
INLINE words rises(vec p, vec q, int n)
{
    const vec taps = taps_of(-n, n);
    const words products = {V(maddubs_epi16)(V(unpacklo_epi8)(p, q), taps),
                            V(maddubs_epi16)(V(unpackhi_epi8)(p, q), taps)};
    return products;
}
#endif

INLINE words sum_of(words a, words b)
{
    const words sums = {V(add_epi16)(a.low, b.low), V(add_epi16)(a.high, b.high)};
    return sums;
}

INLINE words difference_of(words a, words b)
{
    const words differences = {V(sub_epi16)(a.low, b.low), V(sub_epi16)(a.high, b.high)};
    return differences;
}

/* ---- Columns in 16 bits -------------------------------------------------------------------- */

/*
 * Sums of columns, those of every other place apart. A vector of columns ends one place right of
 * the results that it completes; what they need of the columns to the left comes from the vector
 * before. The first one of a row and the one that overlaps have none before them: there the few
 * columns that count are repeated all over a vector.
 */
typedef struct parities {
    vec even, odd;
} parities;

INLINE parities parities_of(vec bytes)
{
    const parities both = {BITS(and)(bytes, V(set1_epi16)(255)), V(srli_epi16)(bytes, 8)};
    return both;
}

INLINE parities sum_of_parities(parities a, parities b)
{
    const parities sums = {V(add_epi16)(a.even, b.even), V(add_epi16)(a.odd, b.odd)};
    return sums;
}

/* Results of the even places, 0..255 in 16 bits, and of the odd ones between them. */
INLINE vec interleaved(vec even, vec odd)
{
    return BITS(or)(even, V(slli_epi16)(odd, 8));
}

#if !defined(UPPER_BYTES)
#define UPPER_BYTES(even, odd)                                                                     \
    BITS(or)(V(srli_epi16)(even, 8), BITS(and)(odd, V(set1_epi16)((int16_t)0xff00)))
#endif

/* The two columns at p all over. */
INLINE vec two_at(const uint8_t *p)
{
    return taps_of(p[0], p[1]);
}

/* The odd ones and both together, which is what the next vector needs. */
typedef struct columns3 {
    vec odd, both, even;
} columns3;

INLINE columns3 columns3_of(parities sums)
{
    const columns3 columns = {sums.odd, V(add_epi16)(sums.even, sums.odd), sums.even};
    return columns;
}

/*
 * Gauss: two neighbouring columns each, times 16. For an even place the pairs that begin at its
 * left neighbour and at itself make 1 2 1, for the odd one behind it the latter and the one that
 * begins at its right neighbour, which is the left one of the next even place. The largest is
 * 65280: 16 bits without a sign, the result in the upper 8.
 */
#if !defined(OWN_PRODUCTS)
INLINE vec gauss_pairs(vec a, vec b, vec c)
{
    const vec outer = V(set1_epi8)(16), inner = V(set1_epi8)(32);
    return V(add_epi16)(V(add_epi16)(V(maddubs_epi16)(a, outer), V(maddubs_epi16)(b, inner)),
                        V(maddubs_epi16)(c, outer));
}
#endif

ISA void KERNEL(gauss3)(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];
    const vec half = V(set1_epi16)(128);

    for (int x = 0, end = whole(count); end != 0; x = count - LANES, end = behind(end, count)) {
        vec last = gauss_pairs(two_at(a + x - 1), two_at(b + x - 1), two_at(c + x - 1));
        for (; x < end; x += LANES) {
            const vec here = gauss_pairs(load(a + x + 1), load(b + x + 1), load(c + x + 1));
            const vec middle =
                V(add_epi16)(gauss_pairs(load(a + x), load(b + x), load(c + x)), half);
            const vec even = V(add_epi16)(MOVED(last, here, 2), middle);
            const vec odd = V(add_epi16)(middle, here);
            store(out + x, UPPER_BYTES(even, odd));
            last = here;
        }
    }
}

INLINE columns3 box_columns(vec a, vec b, vec c)
{
    return columns3_of(
        sum_of_parities(sum_of_parities(parities_of(a), parities_of(b)), parities_of(c)));
}

INLINE vec box_of(columns3 last, columns3 here)
{
    const vec half = V(set1_epi16)(4), ninth = V(set1_epi16)(7282); /* see plain C */
    const vec even = V(add_epi16)(MOVED(last.both, here.both, 2), here.even);
    const vec odd = V(add_epi16)(MOVED(last.odd, here.odd, 2), here.both);
    return interleaved(V(mulhi_epu16)(V(add_epi16)(even, half), ninth),
                       V(mulhi_epu16)(V(add_epi16)(odd, half), ninth));
}

ISA void KERNEL(box3)(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0, end = whole(count); end != 0; x = count - LANES, end = behind(end, count)) {
        columns3 last = box_columns(two_at(a + x - 1), two_at(b + x - 1), two_at(c + x - 1));
        for (; x < end; x += LANES) {
            const columns3 here = box_columns(load(a + x + 1), load(b + x + 1), load(c + x + 1));
            store(out + x, box_of(last, here));
            last = here;
        }
    }
}

/* Outer two, next two and middle one: outer + 4 next + 6 middle. Rows: at most 4080, columns of
 * them 65280: 16 bits without a sign. */
INLINE vec binomial_of(vec outer, vec next, vec middle)
{
    return V(add_epi16)(V(add_epi16)(outer, V(slli_epi16)(next, 2)),
                        V(mullo_epi16)(middle, V(set1_epi16)(6)));
}

INLINE parities binomial_columns(vec a, vec b, vec c, vec d, vec e)
{
    const parities outer = sum_of_parities(parities_of(a), parities_of(e));
    const parities next = sum_of_parities(parities_of(b), parities_of(d));
    const parities middle = parities_of(c);
    const parities sums = {binomial_of(outer.even, next.even, middle.even),
                           binomial_of(outer.odd, next.odd, middle.odd)};
    return sums;
}

/* With columns e0 o0 e1 o1 e2 o2: of the first five, and of the last. */
INLINE vec binomials_of(parities last, parities here)
{
    const vec e1 = MOVED(last.even, here.even, 2), o1 = MOVED(last.odd, here.odd, 2);
    const vec e0 = MOVED(last.even, here.even, 4), o0 = MOVED(last.odd, here.odd, 4);
    const vec half = V(set1_epi16)(128);
    const vec even =
        binomial_of(V(add_epi16)(V(add_epi16)(e0, half), here.even), V(add_epi16)(o0, o1), e1);
    const vec odd = binomial_of(V(add_epi16)(V(add_epi16)(o0, half), here.odd),
                                V(add_epi16)(e1, here.even), o1);
    return interleaved(V(srli_epi16)(even, 8), V(srli_epi16)(odd, 8));
}

/* The four columns at p all over. */
INLINE vec four_at(const uint8_t *p)
{
    return V(set1_epi32)(
        (int32_t)(p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24));
}

ISA void KERNEL(binomial5)(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2], *const d = rows[3],
                         *const e = rows[4];

    for (int x = 0, end = whole(count); end != 0; x = count - LANES, end = behind(end, count)) {
        const int left = x - 2;
        parities last = binomial_columns(four_at(a + left), four_at(b + left), four_at(c + left),
                                         four_at(d + left), four_at(e + left));
        for (; x < end; x += LANES) {
            const int right = x + 2;
            const parities here =
                binomial_columns(load(a + right), load(b + right), load(c + right), load(d + right),
                                 load(e + right));
            store(out + x, binomials_of(last, here));
            last = here;
        }
    }
}

/* ---- Gradients ----------------------------------------------------------------------------- */

/*
 * Sobel's gradients by four differences: d1 = right - left, d2 = below - above, d3 = lower right -
 * upper left, d4 = upper right - lower left. gx + gy = 2 (d1 + d2 + d3), gx - gy = 2 (d1 - d2 +
 * d4). And |gx| + |gy| is the larger one of |gx + gy| and |gx - gy|, gx^2 + gy^2 half the sum of
 * their squares.
 */
typedef struct diagonals {
    words sum, difference; /* of gx and gy: half of them if `one` is 1, all if it is 2 */
} diagonals;

INLINE diagonals diagonals_at(const uint8_t *a, const uint8_t *b, const uint8_t *c, int one)
{
    const words d1 = rises(load_once(b - 1), load_once(b + 1), one);
    const words d2 = rises(load_once(a), load_once(c), one);
    const words d3 = rises(load_once(a - 1), load_once(c + 1), one);
    const words d4 = rises(load_once(c - 1), load_once(a + 1), one);
    const diagonals d = {sum_of(sum_of(d1, d2), d3), sum_of(difference_of(d1, d2), d4)};
    return d;
}

INLINE vec larger_magnitude(vec a, vec b)
{
    return V(max_epi16)(V(abs_epi16)(a), V(abs_epi16)(b));
}

INLINE words absolute_sum_at(const uint8_t *a, const uint8_t *b, const uint8_t *c)
{
    const diagonals d = diagonals_at(a, b, c, 2);
    const words sums = {larger_magnitude(d.sum.low, d.difference.low),
                        larger_magnitude(d.sum.high, d.difference.high)};
    return sums;
}

/* floor(sqrt(2 value)), value < 2^20: single precision holds it exactly, and its root is never
 * rounded up to a whole number, as that is at least 2^-12 away and the last digit 2^-13. */
INLINE vec root_of_twice(vec value)
{
    return V(cvttps_epi32)(V(sqrt_ps)(V(cvtepi32_ps)(V(add_epi32)(value, value))));
}

/* Of halves: gx^2 + gy^2 = 2 (sum^2 + difference^2). */
INLINE vec length_of(vec sum, vec difference)
{
    const vec first = V(unpacklo_epi16)(sum, difference);
    const vec second = V(unpackhi_epi16)(sum, difference);
    return V(packs_epi32)(root_of_twice(V(madd_epi16)(first, first)),
                          root_of_twice(V(madd_epi16)(second, second)));
}

INLINE words length_at(const uint8_t *a, const uint8_t *b, const uint8_t *c)
{
    const diagonals d = diagonals_at(a, b, c, 1);
    const words lengths = {length_of(d.sum.low, d.difference.low),
                           length_of(d.sum.high, d.difference.high)};
    return lengths;
}

ISA void KERNEL(sobel_x)(const uint8_t *const rows[], uint16_t count, int16_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0, end = whole(count); end != 0; x = count - LANES, end = behind(end, count)) {
        for (; x < end; x += LANES) {
            const words upper = rises(load_once(a + x - 1), load_once(a + x + 1), 1);
            const words middle = rises(load_once(b + x - 1), load_once(b + x + 1), 2);
            const words lower = rises(load_once(c + x - 1), load_once(c + x + 1), 1);
            store_words(out + x, sum_of(sum_of(upper, middle), lower));
        }
    }
}

ISA void KERNEL(sobel_y)(const uint8_t *const rows[], uint16_t count, int16_t *out)
{
    const uint8_t *const a = rows[0], *const c = rows[2];

    for (int x = 0, end = whole(count); end != 0; x = count - LANES, end = behind(end, count)) {
        for (; x < end; x += LANES) {
            const words left = rises(load_once(a + x - 1), load_once(c + x - 1), 1);
            const words middle = rises(load_once(a + x), load_once(c + x), 2);
            const words right = rises(load_once(a + x + 1), load_once(c + x + 1), 1);
            store_words(out + x, sum_of(sum_of(left, middle), right));
        }
    }
}

ISA void KERNEL(gradient_abs)(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0, end = whole(count); end != 0; x = count - LANES, end = behind(end, count)) {
        for (; x < end; x += LANES) {
            const words sums = absolute_sum_at(a + x, b + x, c + x);
            store(out + x, V(packus_epi16)(sums.low, sums.high));
        }
    }
}

ISA void KERNEL(gradient_abs_s16)(const uint8_t *const rows[], uint16_t count, int16_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0, end = whole(count); end != 0; x = count - LANES, end = behind(end, count)) {
        for (; x < end; x += LANES) {
            store_words(out + x, absolute_sum_at(a + x, b + x, c + x));
        }
    }
}

ISA void KERNEL(gradient)(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0, end = whole(count); end != 0; x = count - LANES, end = behind(end, count)) {
        for (; x < end; x += LANES) {
            const words lengths = length_at(a + x, b + x, c + x);
            store(out + x, V(packus_epi16)(lengths.low, lengths.high));
        }
    }
}

ISA void KERNEL(gradient_s16)(const uint8_t *const rows[], uint16_t count, int16_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0, end = whole(count); end != 0; x = count - LANES, end = behind(end, count)) {
        for (; x < end; x += LANES) {
            store_words(out + x, length_at(a + x, b + x, c + x));
        }
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

/* Three in order. */
typedef struct ranks {
    vec low, middle, high;
} ranks;

INLINE ranks sorted(vec a, vec b, vec c)
{
    const vec low = smaller(a, b), high = larger(a, b);
    const ranks order = {smaller(low, c), larger(low, smaller(high, c)), larger(high, c)};
    return order;
}

/* Of columns in order, as in plain C. */
INLINE vec median_of(ranks last, ranks here)
{
    const vec low = largest(MOVED(last.low, here.low, 2), MOVED(last.low, here.low, 1), here.low);
    const vec middle = middle_of(MOVED(last.middle, here.middle, 2),
                                 MOVED(last.middle, here.middle, 1), here.middle);
    const vec high =
        smallest(MOVED(last.high, here.high, 2), MOVED(last.high, here.high, 1), here.high);
    return middle_of(low, middle, high);
}

ISA void KERNEL(median3)(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0, end = whole(count); end != 0; x = count - LANES, end = behind(end, count)) {
        ranks last = sorted(two_at(a + x - 1), two_at(b + x - 1), two_at(c + x - 1));
        for (; x < end; x += LANES) {
            const ranks here = sorted(load(a + x + 1), load(b + x + 1), load(c + x + 1));
            store(out + x, median_of(last, here));
            last = here;
        }
    }
}

/* Of columns: the smallest, and the largest, of three neighbours. */
INLINE vec smallest_of(vec last, vec here)
{
    return smallest(MOVED(last, here, 2), MOVED(last, here, 1), here);
}

INLINE vec largest_of(vec last, vec here)
{
    return largest(MOVED(last, here, 2), MOVED(last, here, 1), here);
}

ISA void KERNEL(min3)(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0, end = whole(count); end != 0; x = count - LANES, end = behind(end, count)) {
        vec last = smallest(two_at(a + x - 1), two_at(b + x - 1), two_at(c + x - 1));
        for (; x < end; x += LANES) {
            const vec here = smallest(load(a + x + 1), load(b + x + 1), load(c + x + 1));
            store(out + x, smallest_of(last, here));
            last = here;
        }
    }
}

ISA void KERNEL(max3)(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0, end = whole(count); end != 0; x = count - LANES, end = behind(end, count)) {
        vec last = largest(two_at(a + x - 1), two_at(b + x - 1), two_at(c + x - 1));
        for (; x < end; x += LANES) {
            const vec here = largest(load(a + x + 1), load(b + x + 1), load(c + x + 1));
            store(out + x, largest_of(last, here));
            last = here;
        }
    }
}

/* ---- Labels -------------------------------------------------------------------------------- */

/* All nine are equal where the smallest is the largest. */
typedef struct extremes {
    vec low, high;
} extremes;

INLINE extremes extremes_of(vec a, vec b, vec c)
{
    const extremes e = {smallest(a, b, c), largest(a, b, c)};
    return e;
}

ISA void KERNEL(erode_labels3)(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0, end = whole(count); end != 0; x = count - LANES, end = behind(end, count)) {
        extremes last = extremes_of(two_at(a + x - 1), two_at(b + x - 1), two_at(c + x - 1));
        for (; x < end; x += LANES) {
            const extremes here = extremes_of(load(a + x + 1), load(b + x + 1), load(c + x + 1));
            const vec low = smallest_of(last.low, here.low);
            const vec high = largest_of(last.high, here.high);
            store(out + x, BITS(and)(low, EQUAL(low, high)));
            last = here;
        }
    }
}

/* The smallest label, less one, so that none is the largest of all. */
INLINE vec label_columns(vec a, vec b, vec c)
{
    const vec one = V(set1_epi8)(1);
    return smallest(V(sub_epi8)(a, one), V(sub_epi8)(b, one), V(sub_epi8)(c, one));
}

INLINE vec dilated(vec own, vec found)
{
    const vec label = V(add_epi8)(found, V(set1_epi8)(1));
    const vec none = EQUAL(own, BITS(setzero)());
    return BITS(or)(own, BITS(and)(label, none));
}

ISA void KERNEL(dilate_labels3)(const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];

    for (int x = 0, end = whole(count); end != 0; x = count - LANES, end = behind(end, count)) {
        vec last = label_columns(two_at(a + x - 1), two_at(b + x - 1), two_at(c + x - 1));
        for (; x < end; x += LANES) {
            const vec here = label_columns(load(a + x + 1), load(b + x + 1), load(c + x + 1));
            store(out + x, dilated(load(b + x), smallest_of(last, here)));
            last = here;
        }
    }
}
