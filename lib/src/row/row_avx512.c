/* Row kernels from pixels to runs for x86 with AVX-512 VBMI2: 64 pixels at a time. */
#include "row/row_x86.h"

#if defined(PEL_ROW_X86)
#include <immintrin.h>

#define FEATURES "avx512f,avx512bw,avx512vl,avx512vbmi,avx512vbmi2,bmi,bmi2,popcnt"
#define ISA __attribute__((target(FEATURES)))
/* Some of what the templates hold is not of use here. */
#define INLINE __attribute__((target(FEATURES), always_inline, unused)) static inline
#define APART __attribute__((target(FEATURES), noinline)) static
#define KERNEL(name) pel_row_##name##_avx512
#define V(operation) _mm512_##operation
#define BITS(operation) _mm512_##operation##_si512

enum { LANES = 64, BLOCK = 64 };
typedef __m512i vec;
typedef __m512i_u loose_vec;

INLINE vec everywhere(__m128i bytes)
{
    return _mm512_broadcast_i32x4(bytes);
}

#include "row/row_nibbles_template.h"

/* ---- Blocks of labels ---------------------------------------------------------------------- */

typedef vec block;

INLINE block load_block(const uint8_t *labels)
{
    return load(labels);
}

/* Turned by one, so that its last label comes first. */
INLINE vec last_of(block b)
{
    const vec places = _mm512_setr_epi64(0x060504030201003F, 0x0E0D0C0B0A090807, 0x161514131211100F,
                                         0x1E1D1C1B1A191817, 0x262524232221201F, 0x2E2D2C2B2A292827,
                                         0x363534333231302F, 0x3E3D3C3B3A393837);
    return _mm512_permutexvar_epi8(places, b);
}

INLINE uint64_t equal_before(vec last, block b)
{
    return _mm512_cmpeq_epi8_mask(_mm512_mask_mov_epi8(last_of(b), 1, last), b);
}

INLINE uint64_t zeros_of(block b)
{
    return _mm512_testn_epi8_mask(b, b);
}

/* Places of lowest bits, as labels and where there is none. */
INLINE void store_places(uint8_t *labels, block places, vec none)
{
    store(labels, _mm512_sub_epi8(places, none));
}

INLINE block no_places(vec none)
{
    return none;
}

INLINE uint64_t nowhere_of(block places)
{
    return _mm512_movepi8_mask(places);
}

/* ---- Pixels -------------------------------------------------------------------------------- */

/* The nibble tables of a channel; see row_nibbles.h. */
typedef struct tables {
    vec rough, above, below, from, to;
} tables;

/* A row and its classes. Packed 4:2:2 begins at `bytes`. The tables of chroma are those of U in the
 * low half and of V in the high half, and so is chroma itself. The orders say where things lie in
 * two vectors of packed bytes, and the chroma masks of every pixel in one of them. */
typedef struct row {
    const uint8_t *constants;
    const pel_row_pairs *src;
    const uint8_t *bytes;
    vec nibble, luma_order, chroma_order, twice;
    tables luma, chroma;
} row;

INLINE vec chroma_table(const uint8_t *nibbles, unsigned which)
{
    const __m128i of_v = load16(nibbles + 2 * PEL_NIBBLES_CHANNEL + which);
    return _mm512_mask_broadcast_i32x4(table_of(nibbles + PEL_NIBBLES_CHANNEL, which), 0xFF00,
                                       of_v);
}

/* 0, 1, 2, ... */
INLINE vec counted(void)
{
    return _mm512_setr_epi64(0x0706050403020100, 0x0F0E0D0C0B0A0908, 0x1716151413121110,
                             0x1F1E1D1C1B1A1918, 0x2726252423222120, 0x2F2E2D2C2B2A2928,
                             0x3736353433323130, 0x3F3E3D3C3B3A3938);
}

/* One byte in the low half, another in the high half. */
INLINE vec in_halves(size_t low, size_t high)
{
    return _mm512_inserti64x4(_mm512_set1_epi8((char)low), _mm256_set1_epi8((char)high), 1);
}

INLINE row row_of(const uint8_t *nibbles, const pel_row_pairs *src)
{
    const uint8_t *const c = src->u < src->v ? src->u : src->v;
    const uint8_t *const bytes = src->y_step == 2 && src->y < c ? src->y : c;
    const uint8_t *const constant = constants();
    const vec doubled = _mm512_add_epi8(counted(), counted());
    const vec steps = src->c_step == 4 ? _mm512_add_epi8(doubled, doubled) : doubled;
    const row r = {
        constant,
        src,
        bytes,
        everywhere(load16(constant + OF_NIBBLE)),
        _mm512_add_epi8(doubled, _mm512_set1_epi8(bytes < src->y)),
        _mm512_add_epi8(steps, in_halves((size_t)(src->u - bytes), (size_t)(src->v - bytes))),
        _mm512_and_si512(_mm512_srli_epi16(counted(), 1), _mm512_set1_epi8(31)),
        {rough_table(nibbles), table_of(nibbles, PEL_NIBBLES_ABOVE),
         table_of(nibbles, PEL_NIBBLES_BELOW), table_of(nibbles, PEL_NIBBLES_FROM),
         table_of(nibbles, PEL_NIBBLES_TO)},
        {chroma_table(nibbles, PEL_NIBBLES_ROUGH), chroma_table(nibbles, PEL_NIBBLES_ABOVE),
         chroma_table(nibbles, PEL_NIBBLES_BELOW), chroma_table(nibbles, PEL_NIBBLES_FROM),
         chroma_table(nibbles, PEL_NIBBLES_TO)}};
    return r;
}

INLINE row packed_row_of(const uint8_t *nibbles, const pel_row_pairs *src)
{
    return row_of(nibbles, src);
}

/* U in the low half, V in the high half. */
INLINE vec chroma_at(const row *r, int is_packed, size_t x)
{
    const pel_row_pairs *const src = r->src;

    if (is_packed) {
        return _mm512_permutex2var_epi8(load(r->bytes + 2 * x), r->chroma_order,
                                        load(r->bytes + 2 * x + LANES));
    }
    if (src->c_step == 1) {
        const __m256i u = _mm256_loadu_si256((const __m256i_u *)(const void *)(src->u + x / 2));
        const __m256i v = _mm256_loadu_si256((const __m256i_u *)(const void *)(src->v + x / 2));
        return _mm512_inserti64x4(_mm512_castsi256_si512(u), v, 1);
    }
    if (src->c_step == 2) {
        return _mm512_permutexvar_epi8(r->chroma_order, load(r->bytes + x));
    }
    return in_halves(*src->u, *src->v); /* gray */
}

INLINE vec luma_at(const row *r, int is_packed, size_t x)
{
    return is_packed ? _mm512_permutex2var_epi8(load(r->bytes + 2 * x), r->luma_order,
                                                load(r->bytes + 2 * x + LANES))
                     : load(r->src->y + x);
}

/* The class masks of values, see row_nibbles_template.h. */
INLINE vec masks_by(const tables *t, vec nibble, vec values)
{
    enum { OR_AND = 0xA8 }; /* (a | b) & c */
    const vec high = high_nibbles(nibble, values), low = _mm512_and_si512(values, nibble);
    const vec from = _mm512_ternarylogic_epi64(_mm512_shuffle_epi8(t->above, high),
                                               _mm512_shuffle_epi8(t->from, low),
                                               _mm512_shuffle_epi8(t->rough, high), OR_AND);
    return _mm512_ternarylogic_epi64(_mm512_shuffle_epi8(t->below, high),
                                     _mm512_shuffle_epi8(t->to, low), from, OR_AND);
}

/* See row_pairs_template.h. */
INLINE int places_at(const row *r, int is_packed, size_t x, block *places)
{
    vec masks = masks_by(&r->chroma, r->nibble, chroma_at(r, is_packed, x));

    masks = _mm512_and_si512(masks, _mm512_shuffle_i64x2(masks, masks, 0x4E));
    if (_mm512_test_epi8_mask(masks, masks) == 0) {
        return 0;
    }
    masks = _mm512_and_si512(masks_by(&r->luma, r->nibble, luma_at(r, is_packed, x)),
                             _mm512_permutexvar_epi8(r->twice, masks));
    *places = places_of_lowest(r->constants, r->nibble, masks);
    return 1;
}

/* ---- Edges --------------------------------------------------------------------------------- */

/* The places of the set bits, in order. */
INLINE vec places_of(uint64_t bits)
{
    return _mm512_maskz_compress_epi8(bits, counted());
}

/* A place for every bit, 32 at a time: nothing depends on how many there are, which no processor
 * can foretell. */
INLINE uint16_t *put_places(uint16_t *edge, uint64_t bits, size_t x)
{
    const vec base = _mm512_set1_epi16((int16_t)x), all = places_of(bits);
    const unsigned count = (unsigned)_mm_popcnt_u64(bits);
    const vec low = _mm512_cvtepu8_epi16(_mm512_castsi512_si256(all));

    _mm512_mask_storeu_epi16(edge, _bzhi_u32(0xFFFFFFFF, count), _mm512_add_epi16(low, base));
    if (count > 32) {
        const vec high = _mm512_cvtepu8_epi16(_mm512_extracti64x4_epi64(all, 1));
        _mm512_mask_storeu_epi16(edge + 32, _bzhi_u32(0xFFFFFFFF, count - 32),
                                 _mm512_add_epi16(high, base));
    }
    return edge + count;
}

/* The same where at some places a run ends and the next one begins. Ends and begins of runs take
 * turns: the first ones of either kind are written side by side, then the second ones, and so on,
 * 16 pairs at a time. */
INLINE uint16_t *put_some_twice(uint16_t *edge, uint64_t ends, uint64_t begins, uint64_t inside,
                                size_t x)
{
    const unsigned count = (unsigned)(_mm_popcnt_u64(ends) + _mm_popcnt_u64(begins));
    vec first = places_of(inside != 0 ? ends : begins);
    vec second = places_of(inside != 0 ? begins : ends);

    for (unsigned done = 0; done < count; done += 32) {
        const vec low = _mm512_cvtepu8_epi32(_mm512_castsi512_si128(first));
        const vec high = _mm512_cvtepu8_epi32(_mm512_castsi512_si128(second));
        const vec places = _mm512_add_epi16(_mm512_or_si512(low, _mm512_slli_epi32(high, 16)),
                                            _mm512_set1_epi16((int16_t)x));
        _mm512_mask_storeu_epi16(edge + done, _bzhi_u32(0xFFFFFFFF, count - done), places);
        first = _mm512_alignr_epi64(first, first, 2);
        second = _mm512_alignr_epi64(second, second, 2);
    }
    return edge + count;
}

/* As in row_edges_template.h. */
INLINE uint16_t *put_edges(uint16_t *edge, uint64_t changes, uint64_t nonzero, uint64_t inside,
                           size_t x)
{
    const uint64_t ends = changes & (nonzero << 1 | inside), begins = changes & nonzero;

    return (ends & begins) == 0 ? put_places(edge, changes, x)
                                : put_some_twice(edge, ends, begins, inside, x);
}

#include "row/row_classify_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
