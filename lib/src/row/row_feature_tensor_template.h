/*
 * The row kernels of the structure tensor in the vectors of x86, whatever their width; the words of
 * row_feature_template.h and
 *     MOVED(last, here)        what lies 32 bits before `here` if `last` lies before it
 *     LOWER_UPPER_16(a, b)     of every 32 bits the lower 16 of a and the upper 16 of b
 *     LOWER_UPPER_32(a, b)     of every 64 bits the lower 32 of a and the upper 32 of b
 *     FIRST(v), SECOND(v)      32 bits each of the first, the second half of a vector as doubles
 *     JOINED(a, b)             two such halves cut off to 32 bits
 *     store_pairs(out, a, b)   a0 b0 a1 b1 ... of 32 bits
 */

/* Sums of 32 bits of the even and of the odd places. */
typedef struct places {
    vec even, odd;
} places;

typedef struct tensors {
    places uu, uv, vv;
} tensors;

/* Rotated gradients of two rows, every 32 bits those of one column, and of a third one. */
typedef struct threesome {
    vec even, odd; /* the first row in the lower, the second in the upper 16 bits */
    vec third, third_even, third_odd; /* the places that are not of the name are 0 */
} threesome;

typedef struct rotated {
    vec u, v;
} rotated;

INLINE rotated rotated_at(const uint8_t *a, const uint8_t *b, const uint8_t *c)
{
    const vec d1 = wide_rise(b - 1, b + 1), d2 = wide_rise(a, c);
    const vec d3 = wide_rise(a - 1, c + 1), d4 = wide_rise(c - 1, a + 1);
    const rotated r = {V(add_epi16)(V(add_epi16)(d1, d2), d3),
                       V(add_epi16)(V(sub_epi16)(d1, d2), d4)};
    return r;
}

INLINE threesome threesome_of(vec first, vec second, vec third)
{
    const vec zero = BITS(setzero)();
    const threesome t = {LOWER_UPPER_16(first, V(slli_epi32)(second, 16)),
                         LOWER_UPPER_16(V(srli_epi32)(first, 16), second), third,
                         LOWER_UPPER_16(third, zero), LOWER_UPPER_16(zero, third)};
    return t;
}

INLINE places products_of(threesome a, threesome b)
{
    const places p = {
        V(add_epi32)(V(madd_epi16)(a.even, b.even), V(madd_epi16)(a.third, b.third_even)),
        V(add_epi32)(V(madd_epi16)(a.odd, b.odd), V(madd_epi16)(a.third, b.third_odd))};
    return p;
}

/* Of the columns from x on. */
INLINE tensors columns_at(const uint8_t *const rows[], int x)
{
    const uint8_t *const a = rows[0] + x, *const b = rows[1] + x, *const c = rows[2] + x,
                         *const d = rows[3] + x, *const e = rows[4] + x;
    const rotated upper = rotated_at(a, b, c), middle = rotated_at(b, c, d);
    const rotated lower = rotated_at(c, d, e);
    const threesome u = threesome_of(upper.u, middle.u, lower.u);
    const threesome v = threesome_of(upper.v, middle.v, lower.v);
    const tensors t = {products_of(u, u), products_of(u, v), products_of(v, v)};
    return t;
}

/* ---- Windows ------------------------------------------------------------------------------- */

/* What the next step needs of the columns of this one: the odd ones, and those with the even ones
 * to their left. */
typedef struct carried {
    vec both, odd;
} carried;

/* A vector of columns begins one place right of the results: with columns e0 o0 e1 o1 the even one
 * at e0 + o0 + e1, the odd one at o0 + e1 + o1. */
INLINE places windows_of(carried *last, places here)
{
    const vec both = V(add_epi32)(here.even, here.odd);
    const places w = {V(add_epi32)(MOVED(last->both, both), here.even),
                      V(add_epi32)(MOVED(last->odd, here.odd), both)};
    last->both = both;
    last->odd = here.odd;
    return w;
}

typedef struct window {
    carried uu, uv, vv;
} window;

INLINE tensors next_windows(const uint8_t *const rows[], int x, window *last)
{
    const tensors here = columns_at(rows, x + 1);
    const tensors t = {windows_of(&last->uu, here.uu), windows_of(&last->uv, here.uv),
                       windows_of(&last->vv, here.vv)};
    return t;
}

INLINE carried carried_of(int32_t even, int32_t odd)
{
    const carried c = {V(set1_epi32)(even + odd), V(set1_epi32)(odd)};
    return c;
}

/* The two columns before x + 1. */
INLINE window window_before(const uint8_t *const rows[], int x)
{
    const column even = column_at(rows, x - 1), odd = column_at(rows, x);
    const window w = {carried_of(even.uu, odd.uu), carried_of(even.uv, odd.uv),
                      carried_of(even.vv, odd.vv)};
    return w;
}

/* ---- Responses ----------------------------------------------------------------------------- */

/*
 * Of the lower 32 of every 64 bits: 2^15 (uu vv - uv^2) - k s^2, a quarter of 2^15 determinant - k
 * trace^2. k is in every 32 bits. s^2 < 2^45 is multiplied in two parts, the lower 32 bits of it
 * and the upper 13; as a 16-bit number among zeros their product is already where it belongs.
 */
INLINE vec harris_lower(vec uu, vec uv, vec vv, vec s, vec k)
{
    const vec square = V(mul_epu32)(s, s);
    const vec determinant = V(sub_epi64)(V(mul_epu32)(uu, vv), V(mul_epu32)(uv, uv));
    const vec rest = V(sub_epi64)(V(slli_epi64)(determinant, 15), V(mul_epu32)(square, k));
    return V(sub_epi64)(rest, V(madd_epi16)(LOWER_UPPER_32(BITS(setzero)(), square), k));
}

/* Bits 27..58 of the results, which have 59 bits with their sign. */
INLINE vec harris_of(vec uu, vec uv, vec vv, vec k)
{
    const vec size = V(abs_epi32)(uv), s = V(add_epi32)(uu, vv);
    const vec lower = harris_lower(uu, size, vv, s, k);
    const vec upper = harris_lower(V(srli_epi64)(uu, 32), V(srli_epi64)(size, 32),
                                   V(srli_epi64)(vv, 32), V(srli_epi64)(s, 32), k);
    return LOWER_UPPER_32(V(srli_epi64)(lower, 27), V(slli_epi64)(upper, 5));
}

ISA void KERNEL(harris)(const uint8_t *const rows[], uint16_t count, uint16_t k_q15,
                        int32_t *responses)
{
    const vec k = V(set1_epi32)(k_q15);

    for (int x = 0, end = whole(count, STEP); end != 0;
         x = count - STEP, end = behind(end, count)) {
        window last = window_before(rows, x);
        for (; x < end; x += STEP) {
            const tensors t = next_windows(rows, x, &last);
            store_pairs(responses + x, harris_of(t.uu.even, t.uv.even, t.vv.even, k),
                        harris_of(t.uu.odd, t.uv.odd, t.vv.odd, k));
        }
    }
}

/*
 * s - sqrt((uu - vv)^2 + 4 uv^2), half the trace less half the root, cut off. Under the root there
 * is a whole number < 2^45, so that double precision has it exactly and its root to 2^-30, while a
 * root that is not whole is 2^-24 away from whole numbers.
 */
INLINE doubles smaller_eigenvalue(doubles s, doubles apart, doubles across)
{
    const doubles square = V(add_pd)(V(mul_pd)(apart, apart), V(mul_pd)(across, across));
    return V(sub_pd)(s, V(sqrt_pd)(square));
}

INLINE vec shi_tomasi_of(vec uu, vec uv, vec vv)
{
    const vec s = V(add_epi32)(uu, vv), apart = V(sub_epi32)(uu, vv);
    const vec across = V(add_epi32)(uv, uv);
    return JOINED(smaller_eigenvalue(FIRST(s), FIRST(apart), FIRST(across)),
                  smaller_eigenvalue(SECOND(s), SECOND(apart), SECOND(across)));
}

ISA void KERNEL(shi_tomasi)(const uint8_t *const rows[], uint16_t count, int32_t *responses)
{
    for (int x = 0, end = whole(count, STEP); end != 0;
         x = count - STEP, end = behind(end, count)) {
        window last = window_before(rows, x);
        for (; x < end; x += STEP) {
            const tensors t = next_windows(rows, x, &last);
            store_pairs(responses + x, shi_tomasi_of(t.uu.even, t.uv.even, t.vv.even),
                        shi_tomasi_of(t.uu.odd, t.uv.odd, t.vv.odd));
        }
    }
}
