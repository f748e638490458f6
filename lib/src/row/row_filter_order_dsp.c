/*
 * Smallest, largest and median of nine for the DSP instructions: four pixels of a row are a word,
 * which USUB8 and SEL order byte by byte. Elsewhere this file is empty; see row_filter_dsp.c.
 *
 * A step takes in the columns x + 1 .. x + 4 and yields the results x .. x + 3. Of the step before
 * it needs the upper two bytes of each word.
 */
#include "row/row_filter_dsp.h"

#if PEL_ROW_DSP

#include "row/row_dsp.h"
#include "row/row_filter.h"

/* Columns by columns; `here` are those of the results. */
typedef struct neighbours {
    uint32_t left, here, right;
} neighbours;

PEL_DSP neighbours neighbours_of(uint32_t before, uint32_t now)
{
    neighbours n;

    n.left = before >> 16 | now << 16;
    n.here = before >> 24 | now << 8;
    n.right = now;
    return n;
}

/* The columns -1 and 0 of a row where a step leaves its last two. */
static uint32_t first_two(const uint8_t *row)
{
    return (uint32_t)row[-1] << 16 | (uint32_t)row[0] << 24;
}

PEL_DSP uint32_t smallest3(uint32_t a, uint32_t b, uint32_t c)
{
    return smaller_bytes(smaller_bytes(a, b), c);
}

PEL_DSP uint32_t largest3(uint32_t a, uint32_t b, uint32_t c)
{
    return larger_bytes(larger_bytes(a, b), c);
}

PEL_DSP uint32_t middle3(uint32_t a, uint32_t b, uint32_t c)
{
    sort_bytes(&a, &b);
    return larger_bytes(a, smaller_bytes(b, c));
}

/* What is left of a row after its eights goes as eight results once more, of which some were there
 * already; a row of less than eight goes the plain way. */
#define WHOLE_ROW(name)                                                                            \
    void pel_row_##name##_dsp(const uint8_t *const rows[], uint16_t count, uint8_t *restrict out)  \
    {                                                                                              \
        if (count < 8) {                                                                           \
            pel_row_##name(rows, count, out);                                                      \
            return;                                                                                \
        }                                                                                          \
        name##_eights(rows, 0, count & ~7, out);                                                   \
        if (count & 7) {                                                                           \
            name##_eights(rows, count - 8, count, out);                                            \
        }                                                                                          \
    }

/* The results x .. end - 1, eight by eight. */
#define EXTREME(name, extreme3)                                                                    \
    static void name##_eights(const uint8_t *const rows[], int x, int end, uint8_t *restrict out)  \
    {                                                                                              \
        const uint8_t *a = rows[0] + x, *b = rows[1] + x, *c = rows[2] + x;                        \
        uint32_t before = extreme3(first_two(a), first_two(b), first_two(c));                      \
        uint8_t *to = out + x, *const to_end = out + end;                                          \
                                                                                                   \
        while (to != to_end) {                                                                     \
            const uint32_t one = extreme3(load4(a + 1), load4(b + 1), load4(c + 1));               \
            const uint32_t two = extreme3(load4(a + 5), load4(b + 5), load4(c + 5));               \
            const neighbours first = neighbours_of(before, one);                                   \
            const neighbours second = neighbours_of(one, two);                                     \
            store4(to, extreme3(first.left, first.here, first.right));                             \
            store4(to + 4, extreme3(second.left, second.here, second.right));                      \
            before = two;                                                                          \
            a = opaque(a + 8);                                                                     \
            b = opaque(b + 8);                                                                     \
            c = opaque(c + 8);                                                                     \
            to += 8;                                                                               \
        }                                                                                          \
    }

EXTREME(min3, smallest3)
EXTREME(max3, largest3)
WHOLE_ROW(min3)
WHOLE_ROW(max3)

/* Columns, the three of each in order. */
typedef struct sorted3 {
    uint32_t low, middle, high;
} sorted3;

PEL_DSP sorted3 sorted_columns(uint32_t a, uint32_t b, uint32_t c)
{
    sorted3 s;

    sort_bytes(&a, &b);
    sort_bytes(&b, &c);
    sort_bytes(&a, &b);
    s.low = a;
    s.middle = b;
    s.high = c;
    return s;
}

/* As the plain one: the middle of the largest low, the middle middle and the smallest high one. */
PEL_DSP uint32_t medians(sorted3 before, sorted3 now)
{
    neighbours n = neighbours_of(before.low, now.low);
    const uint32_t low = largest3(n.left, n.here, n.right);
    uint32_t middle;

    n = neighbours_of(before.middle, now.middle);
    middle = middle3(n.left, n.here, n.right);
    n = neighbours_of(before.high, now.high);
    return middle3(low, middle, smallest3(n.left, n.here, n.right));
}

static void median3_eights(const uint8_t *const rows[], int x, int end, uint8_t *restrict out)
{
    const uint8_t *a = rows[0] + x, *b = rows[1] + x, *c = rows[2] + x;
    sorted3 before = sorted_columns(first_two(a), first_two(b), first_two(c)), now;
    uint8_t *to = out + x, *const to_end = out + end;

    while (to != to_end) {
        now = sorted_columns(load4(a + 1), load4(b + 1), load4(c + 1));
        store4(to, medians(before, now));
        in_order();
        before = sorted_columns(load4(a + 5), load4(b + 5), load4(c + 5));
        store4(to + 4, medians(now, before));
        a = opaque(a + 8);
        b = opaque(b + 8);
        c = opaque(c + 8);
        to += 8;
    }
}

WHOLE_ROW(median3)

#endif
