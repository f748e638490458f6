/*
 * The places of bits as edges of runs, for processors that cannot store what a mask selects. The
 * file that includes this one says what lowest_place and bit_count of 64 bits are, the place of
 * none may be any; and put_many, which writes the places of one bit or more where there are likely
 * to be several.
 */

INLINE uint64_t put_place(uint16_t *edge, uint64_t bits, size_t x)
{
    *edge = (uint16_t)(x + lowest_place(bits));
    return bits & (bits - 1);
}

/* Four at once, whatever there are, so that few jumps depend on the picture. */
INLINE uint64_t put_four_places(uint16_t *edge, uint64_t bits, size_t x)
{
    bits = put_place(edge, bits, x);
    bits = put_place(edge + 1, bits, x);
    bits = put_place(edge + 2, bits, x);
    return put_place(edge + 3, bits, x);
}

/* A place for every bit; there is one. Places that are none are scratch, for which there is room:
 * the pixels before x have 2 x - 1 edges at most, so that there are 2 n + 3 places for what begins
 * or ends at the n pixels from x to the end of the row. Two are written at one pixel or more, nine
 * at three or more. */
INLINE uint16_t *put_places(uint16_t *edge, uint64_t bits, size_t x)
{
    uint16_t *const end = edge + bit_count(bits);
    const uint64_t others = put_place(edge + 1, put_place(edge, bits, x), x);

    if (others != 0) {
        put_many(edge + 2, others, x);
    }
    return end;
}

/* The same where at some places, `both`, a run ends and the next one begins. */
INLINE uint16_t *put_some_twice(uint16_t *edge, uint64_t bits, uint64_t both, size_t x)
{
    do {
        const unsigned place = lowest_place(bits);
        edge[0] = (uint16_t)(x + place);
        edge[1] = (uint16_t)(x + place);
        edge += 1 + (both >> place & 1);
        bits &= bits - 1;
    } while (bits != 0);
    return edge;
}

/* Writes what is at the places x, x + 1, ... : `changes` of the label, of which there is one, to
 * labels that are `nonzero` or not; `inside` is 1 if the label before them is not 0. */
INLINE uint16_t *put_edges(uint16_t *edge, uint64_t changes, uint64_t nonzero, uint64_t inside,
                           size_t x)
{
    const uint64_t both = changes & nonzero & (nonzero << 1 | inside);

    return both == 0 ? put_places(edge, changes, x) : put_some_twice(edge, changes, both, x);
}
