/* The kernels with taps of one's own: a part of row_filter_template.h, see there. */

/*
 * Sums for even places 2i and odd places 2i + 1 apart: a vector of bytes is one of pairs, which
 * _mm_maddubs_epi16 multiplies by two taps and adds up. For an even place the pair that begins at
 * its left neighbour, and the first one of the pair that begins at its right one; for the odd place
 * behind it the pair that begins at the even place, and the second one of that other pair.
 */

/* ---- Sums of 16 bits ----------------------------------------------------------------------- */

#if !defined(OWN_PRODUCTS)
/* A sum that is ready here: if the compiler put all sums off to the end, they would not fit into
 * the registers. */
INLINE parities ready(parities sums)
{
    __asm__("" : "+v"(sums.even), "+v"(sums.odd));
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

/* By how much all places are shifted. */
typedef __m128i shift_count;

INLINE shift_count shift_by(int bits)
{
    return _mm_cvtsi32_si128(bits);
}

/* Even and odd places limited to bytes, in their order. */
INLINE vec bytes_of(parities results)
{
    const vec places =
        everywhere(_mm_setr_epi8(0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15));
    return V(shuffle_epi8)(V(packus_epi16)(results.even, results.odd), places);
}
#endif

typedef struct narrow_scale {
    vec add, factor, subtract, bias;
    shift_count shift;
} narrow_scale;

INLINE narrow_scale narrow_scale_of(const pel_row_narrow *narrow)
{
    const narrow_scale scale = {V(set1_epi16)((int16_t)narrow->add),
                                V(set1_epi16)((int16_t)narrow->factor),
                                V(set1_epi16)((int16_t)narrow->subtract),
                                V(set1_epi16)(narrow->bias), shift_by(narrow->shift)};
    return scale;
}

INLINE vec narrow_result(vec sums, const pel_row_narrow *narrow, const narrow_scale *scale)
{
    vec n = V(add_epi16)(narrow->absolute ? V(abs_epi16)(sums) : sums, scale->add);
    if (narrow->factor != 0) {
        n = V(mulhi_epu16)(n, scale->factor);
        n = narrow->shift != 0 ? V(srl_epi16)(n, scale->shift) : n;
    }
    return V(adds_epi16)(V(sub_epi16)(n, scale->subtract), scale->bias);
}

/* Even and odd places as words in their order, or limited to bytes. */
INLINE void store_parities(void *out, int x, int bytes, parities results)
{
    if (bytes) {
        store((uint8_t *)out + x, bytes_of(results));
    } else {
        const words ordered = {V(unpacklo_epi16)(results.even, results.odd),
                               V(unpackhi_epi16)(results.even, results.odd)};
        store_words((int16_t *)out + x, ordered);
    }
}

INLINE parities narrow_results(parities sums, const pel_row_narrow *narrow,
                               const narrow_scale *scale)
{
    const parities results = {narrow_result(sums.even, narrow, scale),
                              narrow_result(sums.odd, narrow, scale)};
    return results;
}

/* All that the sums of 3x3 need. */
typedef struct narrow3 {
    taps3 upper, middle, lower;
    narrow_scale scale;
    pel_row_narrow narrow; /* a copy that results cannot alias */
} narrow3;

INLINE narrow3 narrow3_of(const int8_t *t, const pel_row_narrow *narrow)
{
    const narrow3 all = {taps3_of(t[0], t[1], t[2]), taps3_of(t[3], t[4], t[5]),
                         taps3_of(t[6], t[7], t[8]), narrow_scale_of(narrow), *narrow};
    return all;
}

INLINE parities narrow3_at(const narrow3 *all, const uint8_t *a, const uint8_t *b, const uint8_t *c)
{
    const parities sums =
        sum_of_parities(ready(sum_of_parities(row_sum3(a, &all->upper), row_sum3(b, &all->middle))),
                        row_sum3(c, &all->lower));
    return narrow_results(sums, &all->narrow, &all->scale);
}

INLINE void narrow_kernel3(const uint8_t *const rows[], const int8_t *t,
                           const pel_row_narrow *narrow, int count, void *out, int bytes)
{
    const uint8_t *const a = rows[0], *const b = rows[1], *const c = rows[2];
    const narrow3 all = narrow3_of(t, narrow);

    for (int x = 0, end = whole(count); end != 0; x = count - LANES, end = behind(end, count)) {
        for (; x < end; x += LANES) {
            store_parities(out, x, bytes, narrow3_at(&all, a + x, b + x, c + x));
        }
    }
}

INLINE void narrow_kernel5(const uint8_t *const rows[], const int8_t *t,
                           const pel_row_narrow *narrow, int count, void *out, int bytes)
{
    const uint8_t *const row[5] = {rows[0], rows[1], rows[2], rows[3], rows[4]};
    const pel_row_narrow copy = *narrow;
    const narrow_scale scale = narrow_scale_of(narrow);
    taps5 taps[5];

    for (int r = 0; r < 5; r++, t += 5) {
        taps[r] = taps5_of(t[0], t[1], t[2], t[3], t[4]);
    }
    for (int x = 0, end = whole(count); end != 0; x = count - LANES, end = behind(end, count)) {
        for (; x < end; x += LANES) {
            parities sums = row_sum5(row[0] + x, &taps[0]);
            for (int r = 1; r < 5; r++) {
                sums = ready(sum_of_parities(sums, row_sum5(row[r] + x, &taps[r])));
            }
            store_parities(out, x, bytes, narrow_results(sums, &copy, &scale));
        }
    }
}

/* ---- Sums of 32 bits ----------------------------------------------------------------------- */

#if !defined(OWN_PRODUCTS)
/* In the order that unpacking bytes twice gives. */
typedef struct quads {
    vec first, second, third, fourth;
} quads;

/* Adds p times the first and q times the second of two taps of 16 bits. */
INLINE void add_weighted(quads *sums, vec p, vec q, vec taps)
{
    const vec zero = BITS(setzero)();
    const vec low = V(unpacklo_epi8)(p, q), high = V(unpackhi_epi8)(p, q);
    sums->first = V(add_epi32)(sums->first, V(madd_epi16)(V(unpacklo_epi8)(low, zero), taps));
    sums->second = V(add_epi32)(sums->second, V(madd_epi16)(V(unpackhi_epi8)(low, zero), taps));
    sums->third = V(add_epi32)(sums->third, V(madd_epi16)(V(unpacklo_epi8)(high, zero), taps));
    sums->fourth = V(add_epi32)(sums->fourth, V(madd_epi16)(V(unpackhi_epi8)(high, zero), taps));
}

INLINE quads wide_sums(const uint8_t *const rows[], int x, int radius, const int8_t *tap)
{
    const vec zero = BITS(setzero)();
    quads sums = {zero, zero, zero, zero};

    for (int r = 0; r <= 2 * radius; r++) {
        const uint8_t *const p = rows[r] + x - radius;
        const int8_t *const t = tap + (2 * radius + 1) * r;
        for (int k = 0; k < 2 * radius; k += 2) {
            add_weighted(&sums, load(p + k), load(p + k + 1),
                         V(set1_epi32)((t[k] & 65535) | t[k + 1] * 65536));
        }
        add_weighted(&sums, load(p + 2 * radius), zero, V(set1_epi32)(t[2 * radius] & 65535));
    }
    return sums;
}
#endif

/* v / divisor in single precision, which holds v < 2^22 and the divisor exactly; the quotient is at
 * least 1 / v of itself away from the next whole number, and its error 2^-23 of itself. */
INLINE vec wide_result(vec sums, const pel_row_scale *scale)
{
    const vec start = V(set1_epi32)((int32_t)scale->start);
    vec v = V(add_epi32)(scale->flip != 0 ? V(abs_epi32)(sums) : sums, start);
    if (scale->divisor == 0) {
        v = V(srl_epi32)(v, shift_by(scale->shift));
    } else {
        const vec divisor = V(set1_epi32)((int32_t)scale->divisor);
        v = V(cvttps_epi32)(V(div_ps)(V(cvtepi32_ps)(v), V(cvtepi32_ps)(divisor)));
    }
    return V(add_epi32)(v, V(set1_epi32)(scale->bias));
}

INLINE void wide_kernel(const uint8_t *const rows[], int radius, const int8_t *tap,
                        const pel_row_scale *scale, int count, void *out, int bytes)
{
    const pel_row_scale copy = *scale;
    const uint8_t *row[5];

    for (int r = 0; r <= 2 * radius; r++) {
        row[r] = rows[r];
    }
    for (int x = 0, end = whole(count); end != 0; x = count - LANES, end = behind(end, count)) {
        for (; x < end; x += LANES) {
            const quads sums = wide_sums(row, x, radius, tap);
            const words results = {
                V(packs_epi32)(wide_result(sums.first, &copy), wide_result(sums.second, &copy)),
                V(packs_epi32)(wide_result(sums.third, &copy), wide_result(sums.fourth, &copy))};
            if (bytes) {
                store((uint8_t *)out + x, V(packus_epi16)(results.low, results.high));
            } else {
                store_words((int16_t *)out + x, results);
            }
        }
    }
}

/* Whether wide_kernel can do it: not for divisors beyond all sums, which nobody uses. */
INLINE int is_wide(const pel_row_scale *scale)
{
    return scale->divisor == 0 || scale->start < ((uint32_t)1 << 22) - 816000;
}

ISA void KERNEL(kernel3)(const uint8_t *const rows[], const int8_t *tap, const pel_row_scale *scale,
                         uint16_t count, uint8_t *out)
{
    pel_row_narrow narrow;

    if (pel_i_row_narrow(tap, 1, scale, &narrow)) {
        narrow_kernel3(rows, tap, &narrow, count, out, 1);
    } else if (is_wide(scale)) {
        wide_kernel(rows, 1, tap, scale, count, out, 1);
    } else {
        pel_row_kernel3(rows, tap, scale, count, out);
    }
}

ISA void KERNEL(kernel3_s16)(const uint8_t *const rows[], const int8_t *tap,
                             const pel_row_scale *scale, uint16_t count, int16_t *out)
{
    pel_row_narrow narrow;

    if (pel_i_row_narrow(tap, 1, scale, &narrow)) {
        narrow_kernel3(rows, tap, &narrow, count, out, 0);
    } else if (is_wide(scale)) {
        wide_kernel(rows, 1, tap, scale, count, out, 0);
    } else {
        pel_row_kernel3_s16(rows, tap, scale, count, out);
    }
}

ISA void KERNEL(kernel5)(const uint8_t *const rows[], const int8_t *tap, const pel_row_scale *scale,
                         uint16_t count, uint8_t *out)
{
    pel_row_narrow narrow;

    if (pel_i_row_narrow(tap, 2, scale, &narrow)) {
        narrow_kernel5(rows, tap, &narrow, count, out, 1);
    } else if (is_wide(scale)) {
        wide_kernel(rows, 2, tap, scale, count, out, 1);
    } else {
        pel_row_kernel5(rows, tap, scale, count, out);
    }
}

ISA void KERNEL(kernel5_s16)(const uint8_t *const rows[], const int8_t *tap,
                             const pel_row_scale *scale, uint16_t count, int16_t *out)
{
    pel_row_narrow narrow;

    if (pel_i_row_narrow(tap, 2, scale, &narrow)) {
        narrow_kernel5(rows, tap, &narrow, count, out, 0);
    } else if (is_wide(scale)) {
        wide_kernel(rows, 2, tap, scale, count, out, 0);
    } else {
        pel_row_kernel5_s16(rows, tap, scale, count, out);
    }
}
