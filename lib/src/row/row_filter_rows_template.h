/*
 * Several rows of results at once: a part of row_filter_template.h, see there. A strip as wide as a
 * vector is done from top to bottom, so that what a row gives to the results above it, in it and
 * below it is made of its pixels only once.
 *
 * Strips begin where those of the first row fill cache lines, or parts of them: stores that pass
 * the end of a line take several times as long. The first strip and the last one overlap others.
 */

/* Asks for what lies below a strip, so that it is in the cache when the rows there get their turn:
 * processors foretell what is read along a row, but not down a strip. Once for each 64 bytes, a
 * line of the cache; rows that do not exist do no harm. */
INLINE void fetch_below(const uint8_t *const rows[], int x, int height)
{
    const uintptr_t last = (uintptr_t)rows[height + 1], stride = last - (uintptr_t)rows[height];
    uintptr_t place = last + (uintptr_t)x;

    if (place % 64 < LANES) {
        for (int y = 0; y < height; y++) {
            place += stride;
            _mm_prefetch((const char *)place, _MM_HINT_T0);
        }
    }
}

#define ROWS(name, strip, pixel)                                                                   \
    ISA void KERNEL(name##_rows)(const uint8_t *const rows[], uint16_t count, uint16_t height,     \
                                 pixel *out, ptrdiff_t stride)                                     \
    {                                                                                              \
        const int last = count - LANES;                                                            \
        const int skew = (int)((uintptr_t)out / sizeof(pixel) % LANES);                            \
                                                                                                   \
        strip(rows, 0, height, out, stride);                                                       \
        for (int x = LANES - skew; x < last; x += LANES) {                                         \
            fetch_below(rows, x, height);                                                          \
            strip(rows, x, height, out + x, stride);                                               \
        }                                                                                          \
        if (last > 0) {                                                                            \
            strip(rows, last, height, out + last, stride);                                         \
        }                                                                                          \
    }

/* Sums of two neighbours each, times n: those that begin left of the places of a vector, at them
 * and right of them. */
typedef struct neighbours {
    vec left, here, right;
} neighbours;

INLINE neighbours neighbours_at(const uint8_t *p, int n)
{
    const vec taps = taps_of(n, n);
    const neighbours sums = {V(maddubs_epi16)(load(p - 1), taps), V(maddubs_epi16)(load(p), taps),
                             V(maddubs_epi16)(load(p + 1), taps)};
    return sums;
}

INLINE parities difference_of_parities(parities a, parities b)
{
    const parities differences = {V(sub_epi16)(a.even, b.even), V(sub_epi16)(a.odd, b.odd)};
    return differences;
}

/* ---- Gauss --------------------------------------------------------------------------------- */

/* 1 2 1, times 16, and a quarter of the half by which results are rounded. */
INLINE parities gauss_row(const uint8_t *p)
{
    const neighbours n = neighbours_at(p, 16);
    const vec here = V(add_epi16)(n.here, V(set1_epi16)(32));
    const parities sums = {V(add_epi16)(n.left, here), V(add_epi16)(here, n.right)};
    return sums;
}

/* Of two rows and of the two below them; sums are 65408 at most: 16 bits without a sign, the result
 * in the upper 8. */
INLINE vec gauss_of(parities above, parities below)
{
    const parities sums = sum_of_parities(above, below);
    return UPPER_BYTES(sums.even, sums.odd);
}

/* By twos: what the next rows need is then where it was. */
INLINE void gauss3_strip(const uint8_t *const rows[], int x, int height, uint8_t *out,
                         ptrdiff_t stride)
{
    parities here = gauss_row(rows[1] + x);
    parities above = sum_of_parities(gauss_row(rows[0] + x), here);
    int y = 0;

    for (; y < height - 1; y += 2, out += 2 * stride) {
        const parities next = gauss_row(rows[y + 2] + x), below = sum_of_parities(here, next);
        store(out, gauss_of(above, below));
        here = gauss_row(rows[y + 3] + x);
        above = sum_of_parities(next, here);
        store(out + stride, gauss_of(below, above));
    }
    if (y < height) {
        store(out, gauss_of(above, sum_of_parities(here, gauss_row(rows[y + 2] + x))));
    }
}

ROWS(gauss3, gauss3_strip, uint8_t)

/* ---- Gradients ----------------------------------------------------------------------------- */

INLINE words step_row(const uint8_t *p)
{
    return rises(load_once(p - 1), load_once(p + 1), 1);
}

INLINE void sobel_x_strip(const uint8_t *const rows[], int x, int height, int16_t *out,
                          ptrdiff_t stride)
{
    words here = step_row(rows[1] + x), above = sum_of(step_row(rows[0] + x), here);

    for (int y = 0; y < height; y++, out += stride) {
        const words next = step_row(rows[y + 2] + x), below = sum_of(here, next);
        store_words(out, sum_of(above, below));
        here = next;
        above = below;
    }
}

ROWS(sobel_x, sobel_x_strip, int16_t)

/* Of three neighbours: 1 2 1, and the right one less the left one. */
typedef struct sobel_row {
    parities smooth, step;
} sobel_row;

INLINE sobel_row sobel_row_at(const uint8_t *p)
{
    const neighbours n = neighbours_at(p, 1);
    const sobel_row row = {{V(add_epi16)(n.left, n.here), V(add_epi16)(n.here, n.right)},
                           {V(sub_epi16)(n.here, n.left), V(sub_epi16)(n.right, n.here)}};
    return row;
}

INLINE void sobel_y_strip(const uint8_t *const rows[], int x, int height, int16_t *out,
                          ptrdiff_t stride)
{
    parities above = sobel_row_at(rows[0] + x).smooth, here = sobel_row_at(rows[1] + x).smooth;

    for (int y = 0; y < height; y++, out += stride) {
        const parities next = sobel_row_at(rows[y + 2] + x).smooth;
        store_parities(out, 0, 0, difference_of_parities(next, above));
        above = here;
        here = next;
    }
}

ROWS(sobel_y, sobel_y_strip, int16_t)

typedef struct gradients {
    parities x, y;
} gradients;

/* What the rows so far give to the next gradients: the 1 2 1 of the upper row, the differences of
 * the upper two, and the middle row. */
typedef struct sobel_window {
    parities smooth, steps;
    sobel_row here;
} sobel_window;

INLINE sobel_window sobel_window_at(const uint8_t *upper, const uint8_t *middle)
{
    const sobel_row above = sobel_row_at(upper), here = sobel_row_at(middle);
    const sobel_window window = {above.smooth, sum_of_parities(above.step, here.step), here};
    return window;
}

/* Takes in the row below, and moves on. */
INLINE gradients next_gradients(sobel_window *window, const uint8_t *lower)
{
    const sobel_row next = sobel_row_at(lower);
    const parities steps = sum_of_parities(window->here.step, next.step);
    const gradients g = {sum_of_parities(window->steps, steps),
                         difference_of_parities(next.smooth, window->smooth)};
    const sobel_window moved = {window->here.smooth, steps, next};
    *window = moved;
    return g;
}

INLINE vec sum_of_magnitudes(vec gx, vec gy)
{
    return V(add_epi16)(V(abs_epi16)(gx), V(abs_epi16)(gy));
}

INLINE void gradient_abs_strip(const uint8_t *const rows[], int x, int height, uint8_t *out,
                               ptrdiff_t stride)
{
    sobel_window window = sobel_window_at(rows[0] + x, rows[1] + x);

    for (int y = 0; y < height; y++, out += stride) {
        const gradients g = next_gradients(&window, rows[y + 2] + x);
        const parities sums = {sum_of_magnitudes(g.x.even, g.y.even),
                               sum_of_magnitudes(g.x.odd, g.y.odd)};
        store(out, bytes_of(sums));
    }
}

ROWS(gradient_abs, gradient_abs_strip, uint8_t)

/*
 * floor(sqrt(gx^2 + gy^2)), up to 255, in two ways: the unit that takes roots is as long about them
 * as the others about all the rest. Half of them are taken as in root_of_twice. The other half are
 * guessed as the reciprocal of the reciprocal root, both of which are at most 3 / 8192 of
 * themselves off: less than a half below 256. Rounded, this is the whole root or one more, and
 * then its square is too large. A sum of squares beyond 16 bits counts as 65535, which no square
 * passes in 16 bits, and limits to 255 what is left. No rounding depends on the mode that is set.
 */
INLINE vec squares_of(vec gx_gy)
{
    return V(madd_epi16)(gx_gy, gx_gy);
}

INLINE vec root_of(vec value)
{
    return V(cvttps_epi32)(V(sqrt_ps)(V(cvtepi32_ps)(value)));
}

INLINE vec root_nearly(vec value)
{
    return V(cvttps_epi32)(
        V(add_ps)(RECIPROCAL(RECIPROCAL_ROOT(V(cvtepi32_ps)(value))), V(set1_ps)(0.5F)));
}

INLINE vec roots_of(vec gx, vec gy)
{
    return V(packs_epi32)(root_of(squares_of(V(unpacklo_epi16)(gx, gy))),
                          root_of(squares_of(V(unpackhi_epi16)(gx, gy))));
}

INLINE vec roots_from_near(vec gx, vec gy)
{
    const vec low = squares_of(V(unpacklo_epi16)(gx, gy));
    const vec high = squares_of(V(unpackhi_epi16)(gx, gy));
    const vec near = V(packs_epi32)(root_nearly(low), root_nearly(high));
    const vec over = V(subs_epu16)(V(mullo_epi16)(near, near), PACKED(low, high));
    return V(sub_epi16)(near, V(min_epi16)(over, V(set1_epi16)(1)));
}

INLINE vec lengths_of(gradients g)
{
    const parities lengths = {roots_of(g.x.even, g.y.even), roots_from_near(g.x.odd, g.y.odd)};
    return bytes_of(lengths);
}

/* The roots of a row are taken after the gradients of the next one: they take so long that
 * otherwise the processor runs out of instructions that need not wait. */
INLINE void gradient_strip(const uint8_t *const rows[], int x, int height, uint8_t *out,
                           ptrdiff_t stride)
{
    sobel_window window = sobel_window_at(rows[0] + x, rows[1] + x);
    gradients last = next_gradients(&window, rows[2] + x);

    for (int y = 1; y < height; y++, out += stride) {
        const gradients next = next_gradients(&window, rows[y + 2] + x);
        store(out, lengths_of(last));
        last = next;
    }
    store(out, lengths_of(last));
}

ROWS(gradient, gradient_strip, uint8_t)

/* ---- Order --------------------------------------------------------------------------------- */

INLINE vec smallest_of_row(const uint8_t *p)
{
    return smallest(load(p - 1), load(p + 1), load(p));
}

INLINE void min3_strip(const uint8_t *const rows[], int x, int height, uint8_t *out,
                       ptrdiff_t stride)
{
    vec here = smallest_of_row(rows[1] + x), above = smaller(smallest_of_row(rows[0] + x), here);

    for (int y = 0; y < height; y++, out += stride) {
        const vec next = smallest_of_row(rows[y + 2] + x);
        store(out, smaller(above, next));
        above = smaller(here, next);
        here = next;
    }
}

ROWS(min3, min3_strip, uint8_t)

INLINE vec largest_of_row(const uint8_t *p)
{
    return largest(load(p - 1), load(p + 1), load(p));
}

INLINE void max3_strip(const uint8_t *const rows[], int x, int height, uint8_t *out,
                       ptrdiff_t stride)
{
    vec here = largest_of_row(rows[1] + x), above = larger(largest_of_row(rows[0] + x), here);

    for (int y = 0; y < height; y++, out += stride) {
        const vec next = largest_of_row(rows[y + 2] + x);
        store(out, larger(above, next));
        above = larger(here, next);
        here = next;
    }
}

ROWS(max3, max3_strip, uint8_t)

/*
 * Median: as in plain C, of rows in order instead of columns, the middle of the largest low one,
 * the middle of the middle ones and the smallest high one. What two rows give to the result above
 * and to the one below is the same.
 *
 * Few units compare, and they are what takes longest. The last one of two or three when the others
 * are known is what these leave of all, which is logic: for units that are idle otherwise.
 */
typedef struct shared_ranks {
    vec low, high;    /* the larger low one of two rows, the smaller high one */
    vec lower, upper; /* the middle ones */
} shared_ranks;

INLINE ranks ranks_of_row(const uint8_t *p)
{
    const vec left = load_once(p - 1), here = load_once(p), right = load_once(p + 1);
    const vec lower = MIN_ELSEWHERE(left, right), upper = XOR3(left, right, lower);
    const vec low = smaller(lower, here), high = larger(upper, here);
    const ranks order = {low, XOR3(XOR3(left, right, here), low, high), high};
    return order;
}

INLINE shared_ranks shared_ranks_of(ranks a, ranks b)
{
    const vec lower = smaller(a.middle, b.middle);
    const shared_ranks both = {larger(a.low, b.low), smaller(a.high, b.high), lower,
                               OTHER(a.middle, b.middle, lower)};
    return both;
}

INLINE vec median_with(shared_ranks both, ranks third)
{
    const vec low = larger(both.low, third.low), high = smaller(both.high, third.high);
    const vec middle = larger(both.lower, smaller(both.upper, third.middle));
    const vec lower = MIN_ELSEWHERE(low, high), upper = OTHER(low, high, lower);
    return larger(lower, smaller(upper, middle));
}

/* The upper result is stored before the fourth row is read: registers are few. */
INLINE void median3_strip(const uint8_t *const rows[], int x, int height, uint8_t *out,
                          ptrdiff_t stride)
{
    ranks above = ranks_of_row(rows[0] + x), here = ranks_of_row(rows[1] + x);
    int y = 0;

    for (; y < height - 1; y += 2, out += 2 * stride) {
        const ranks next = ranks_of_row(rows[y + 2] + x);
        const shared_ranks both = shared_ranks_of(here, next);
        store(out, median_with(both, above));
        above = next;
        here = ranks_of_row(rows[y + 3] + x);
        store(out + stride, median_with(both, here));
    }
    if (y < height) {
        const ranks next = ranks_of_row(rows[y + 2] + x);
        store(out, median_with(shared_ranks_of(here, next), above));
    }
}

ROWS(median3, median3_strip, uint8_t)

/* ---- Taps of one's own --------------------------------------------------------------------- */

INLINE void kernel3_strip(const uint8_t *const rows[], int height, const narrow3 *all, int x,
                          uint8_t *out, ptrdiff_t stride)
{
    for (int y = 0; y < height; y++, out += stride) {
        const parities sums = narrow3_at(all, rows[y] + x, rows[y + 1] + x, rows[y + 2] + x);
        store(out + x, bytes_of(sums));
    }
}

/* As ROWS has it, with taps. */
INLINE void narrow_rows3(const uint8_t *const rows[], int count, int height, const narrow3 *all,
                         uint8_t *out, ptrdiff_t stride)
{
    const int skew = (int)((uintptr_t)out % LANES), last = count - LANES;

    kernel3_strip(rows, height, all, 0, out, stride);
    for (int x = LANES - skew; x < last; x += LANES) {
        fetch_below(rows, x, height);
        kernel3_strip(rows, height, all, x, out, stride);
    }
    kernel3_strip(rows, height, all, last, out, stride);
}

ISA void KERNEL(kernel3_rows)(const uint8_t *const rows[], const pel_row_taps *taps, uint16_t count,
                              uint16_t height, uint8_t *out, ptrdiff_t stride)
{
    pel_row_narrow narrow;

    if (pel_i_row_narrow(taps->tap, 1, &taps->scale, &narrow)) {
        const narrow3 all = narrow3_of(taps->tap, &narrow);
        narrow_rows3(rows, count, height, &all, out, stride);
    } else {
        for (unsigned y = 0; y < height; y++) {
            KERNEL(kernel3)(rows + y, taps->tap, &taps->scale, count, out + (ptrdiff_t)y * stride);
        }
    }
}
