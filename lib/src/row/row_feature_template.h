/*
 * The row kernels of corners and edges in vectors, whatever their width. The file that includes
 * this one says what the words mean:
 *     vec, LANES               a vector and its bytes
 *     V(op), BITS(op)          the functions of its width, named as those of x86
 *     wide_rise(p, q)          by how much the bytes at q are over those at p, in 16 bits
 *     any(bytes)               whether one of them is not 0
 *     EQUAL(a, b)              bytes that are equal become 255, others 0
 *     ABOVE(a, b), SAME(a, b)  16 bits with a sign: all ones where a > b, a == b
 *     store_edges(out, e, s)   a step of an edge map: where there are edges, where strong ones
 *     store_wide(out, bytes)   bytes as 32 bits each
 *     ISA, INLINE, KERNEL      for what a function is compiled, what it is called
 *
 * The last step of a row ends where the row ends and so overlaps the one before it: the results
 * there are written twice. Nothing outside the neighbours of the row is read.
 */

enum { STEP = LANES / 2 /* pixels of 16 bits */ };

/* What was read before is read again, not kept all the way from there: pixels on the circle are
 * more than there are registers. */
#define READ_AGAIN __asm__ volatile("" : : : "memory")

INLINE vec load(const void *p)
{
    return BITS(loadu)((const loose_vec *)p);
}

INLINE void store(void *p, vec value)
{
    BITS(storeu)((loose_vec *)p, value);
}

/* The step behind the one at x, `count` pixels to do: the last one ends with the row, and behind it
 * there is `count`. */
INLINE int next_step(int x, int step, int count)
{
    const int next = x + step;
    return next == count ? count : next + step > count ? count - step : next;
}

/* A row in two parts, each with a beginning of its own: the steps that lie side by side, from 0 to
 * whole(count, step), and, if they do not end with the row, one that does. */
INLINE int whole(int count, int step)
{
    return count - count % step;
}

INLINE int behind(int end, int count)
{
    return end == count ? 0 : count;
}

/* ---- The structure tensor ------------------------------------------------------------------ */

/*
 * Gradients are turned by 45 degrees: u = (gx + gy) / 2 and v = (gx - gy) / 2 are whole, sums of
 * three differences each, at most 765. With uu, uv, vv the sums of their products and s = uu + vv,
 * which is at most 9 * 650250 < 2^22.5, as gx^2 + gy^2 is at most 1300500:
 *     trace = 2 s    determinant = 4 (uu vv - uv^2)
 */

/* Of three pixels above each other, in plain C. */
typedef struct column {
    int32_t uu, uv, vv;
} column;

INLINE column column_at(const uint8_t *const rows[], int x)
{
    column t = {0, 0, 0};

    for (int i = 0; i < 3; i++) {
        const uint8_t *const a = rows[i] + x, *const b = rows[i + 1] + x,
                             *const c = rows[i + 2] + x;
        const int32_t d1 = b[1] - b[-1], d2 = c[0] - a[0];
        const int32_t u = d1 + d2 + c[1] - a[-1], v = d1 - d2 + a[1] - c[-1];
        t.uu += u * u;
        t.uv += u * v;
        t.vv += v * v;
    }
    return t;
}

/* ---- FAST ---------------------------------------------------------------------------------- */

/* The circle of radius 3, clockwise from the pixels straight above, `places` further. */
INLINE vec circle_at(const uint8_t *const rows[], int x, int places)
{
    static const int8_t across[16] = {0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3, -3, -3, -2, -1};
    static const int8_t down[16] = {0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 5, 4, 3, 2, 1, 0};
    return load(rows[down[places & 15]] + x + across[places & 15]);
}

/*
 * The arc whose least pixel is the largest (inner: smaller, outer: larger), and the other way
 * round. Two arcs that begin next to each other have eight pixels in common: which of the ends is
 * better decides between them.
 */
#define PAIR_AT(i, inner) inner(circle_at(rows, x, i), circle_at(rows, x, (i) + 1))
#define ARCS(first, second, i, inner, outer)                                                       \
    inner(inner(first, second), outer(circle_at(rows, x, i), circle_at(rows, x, (i) + 9)))
#define BEST_ARC(inner, outer)                                                                     \
    const vec p1 = PAIR_AT(1, inner), p3 = PAIR_AT(3, inner), p5 = PAIR_AT(5, inner);              \
    const vec p7 = PAIR_AT(7, inner), p9 = PAIR_AT(9, inner), p11 = PAIR_AT(11, inner);            \
    const vec p13 = PAIR_AT(13, inner), p15 = PAIR_AT(15, inner);                                  \
    READ_AGAIN;                                                                                    \
    const vec q1 = inner(p1, p3), q3 = inner(p3, p5), q5 = inner(p5, p7), q7 = inner(p7, p9);      \
    const vec q9 = inner(p9, p11), q11 = inner(p11, p13), q13 = inner(p13, p15);                   \
    const vec q15 = inner(p15, p1);                                                                \
    vec best = outer(ARCS(q1, q5, 0, inner, outer), ARCS(q3, q7, 2, inner, outer));                \
    best = outer(best, ARCS(q5, q9, 4, inner, outer));                                             \
    best = outer(best, ARCS(q7, q11, 6, inner, outer));                                            \
    best = outer(best, ARCS(q9, q13, 8, inner, outer));                                            \
    best = outer(best, ARCS(q11, q15, 10, inner, outer));                                          \
    best = outer(best, ARCS(q13, q1, 12, inner, outer));                                           \
    return outer(best, ARCS(q15, q3, 14, inner, outer))

INLINE vec brightest_arc(const uint8_t *const rows[], int x)
{
    BEST_ARC(V(min_epu8), V(max_epu8));
}

INLINE vec darkest_arc(const uint8_t *const rows[], int x)
{
    BEST_ARC(V(max_epu8), V(min_epu8));
}

INLINE vec contrast_of(vec bright, vec centre, vec dark)
{
    return V(max_epu8)(V(subs_epu8)(bright, centre), V(subs_epu8)(centre, dark));
}

/* No arc has a larger contrast: it holds one at least of any two pixels that lie across. */
INLINE vec most_contrast(const uint8_t *const rows[], int x, vec centre)
{
    const vec up = circle_at(rows, x, 0), right = circle_at(rows, x, 4);
    const vec down = circle_at(rows, x, 8), left = circle_at(rows, x, 12);
    return contrast_of(V(min_epu8)(V(max_epu8)(up, down), V(max_epu8)(left, right)), centre,
                       V(max_epu8)(V(min_epu8)(up, down), V(min_epu8)(left, right)));
}

ISA void KERNEL(fast9)(const uint8_t *const rows[], uint16_t count, int16_t threshold,
                       int32_t *responses)
{
    const vec over = V(set1_epi8)((int8_t)threshold), one = V(set1_epi8)(1);
    const vec zero = BITS(setzero)();

    for (int x = 0; x < count; x = next_step(x, LANES, count)) {
        const vec centre = load(rows[3] + x);
        vec response = zero;
        if (any(V(subs_epu8)(most_contrast(rows, x, centre), over))) {
            const vec bright = brightest_arc(rows, x);
            READ_AGAIN;
            const vec contrast = contrast_of(bright, centre, darkest_arc(rows, x));
            const vec none = EQUAL(V(subs_epu8)(contrast, over), zero);
            response = BITS(andnot)(none, V(sub_epi8)(contrast, one));
        }
        store_wide(responses + x, response);
    }
}

/* ---- Canny --------------------------------------------------------------------------------- */

/*
 * gx = (d3 + d4) + 2 d1, gy = (d3 - d4) + 2 d2 with d1 = right - left, d2 = below - above, d3 =
 * lower right - upper left, d4 = upper right - lower left.
 *
 * With x and y their sizes and t = 13573 / 32768: t x is never whole but for x = 0, so that y < t x
 * is y <= floor(t x) then, and y > (2 + t) x is y - 2 x > floor(t x) for any.
 */
INLINE vec gradient_sectors(vec gx, vec gy)
{
    const vec x = V(abs_epi16)(gx), y = V(abs_epi16)(gy);
    const vec magnitude = V(add_epi16)(x, y);
    const vec flat = V(mulhi_epu16)(x, V(set1_epi16)(2 * 13573));
    const vec steep = V(sub_epi16)(V(sub_epi16)(y, x), x);
    const vec upright = ABOVE(steep, flat);
    const vec no_sides = BITS(or)(ABOVE(y, flat), SAME(magnitude, BITS(setzero)()));
    const vec diagonal = BITS(andnot)(upright, no_sides);
    const vec unlike = V(srai_epi16)(BITS(xor)(gx, gy), 15);
    const vec odd = BITS(or)(upright, BITS(and)(diagonal, unlike));
    return BITS(or)(magnitude, BITS(or)(BITS(and)(diagonal, V(set1_epi16)(0x2000)),
                                        BITS(and)(odd, V(set1_epi16)(0x1000))));
}

ISA void KERNEL(gradient_sector)(const uint8_t *const rows[], uint16_t count, uint16_t *gradients)
{
    for (int x = 0; x < count; x = next_step(x, STEP, count)) {
        const uint8_t *const a = rows[0] + x, *const b = rows[1] + x, *const c = rows[2] + x;
        const vec d1 = wide_rise(b - 1, b + 1), d2 = wide_rise(a, c);
        const vec d3 = wide_rise(a - 1, c + 1), d4 = wide_rise(c - 1, a + 1);
        const vec gx = V(add_epi16)(V(add_epi16)(d3, d4), V(add_epi16)(d1, d1));
        const vec gy = V(add_epi16)(V(sub_epi16)(d3, d4), V(add_epi16)(d2, d2));
        store(gradients + x, gradient_sectors(gx, gy));
    }
}

/* `yes` where the mask is all ones, `no` where it is all zeros. */
INLINE vec chosen(vec mask, vec yes, vec no)
{
    return BITS(or)(BITS(and)(mask, yes), BITS(andnot)(mask, no));
}

/* The magnitudes of those of four that lie across the edge; bit 12 of the sector is in `odd`, bit
 * 13 in `diagonal`. */
INLINE vec across(vec odd, vec diagonal, const uint16_t *const neighbours[4])
{
    const vec straight =
        chosen(odd, load(neighbours[PEL_SECTOR_UPRIGHT]), load(neighbours[PEL_SECTOR_SIDES]));
    const vec slanted =
        chosen(odd, load(neighbours[PEL_SECTOR_RISING]), load(neighbours[PEL_SECTOR_FALLING]));
    return BITS(and)(chosen(diagonal, slanted, straight), V(set1_epi16)(0x0fff));
}

/* Magnitudes have 12 bits. The second of two neighbours may be as large unless both lie diagonally,
 * so there one is taken from what it is compared with. */
ISA void KERNEL(thin)(const uint16_t *const rows[], uint16_t count, uint16_t low, uint16_t high,
                      uint8_t *out)
{
    const vec weak = V(set1_epi16)((int16_t)(low < 0x0fff ? low : 0x0fff));
    const vec strong = V(set1_epi16)((int16_t)(high < 0x0fff ? high : 0x0fff));

    for (int x = 0; x < count; x = next_step(x, STEP, count)) {
        const uint16_t *const a = rows[0] + x, *const b = rows[1] + x, *const c = rows[2] + x;
        const uint16_t *const before[4] = {b - 1, a, a - 1, a + 1};
        const uint16_t *const after[4] = {b + 1, c, c + 1, c - 1};
        const vec own = load(b), m = BITS(and)(own, V(set1_epi16)(0x0fff));
        const vec odd = V(srai_epi16)(V(slli_epi16)(own, 15 - PEL_SECTOR_SHIFT), 15);
        const vec diagonal = V(srai_epi16)(V(slli_epi16)(own, 14 - PEL_SECTOR_SHIFT), 15);
        const vec second = V(sub_epi16)(across(odd, diagonal, after), V(set1_epi16)(1));
        const vec last = V(sub_epi16)(second, diagonal);
        const vec most = V(max_epi16)(across(odd, diagonal, before), last);
        const vec edge = ABOVE(m, V(max_epi16)(most, weak));
        const vec sure = BITS(and)(edge, ABOVE(m, strong));
        store_edges(out + x, edge, sure);
    }
}
