/* Row kernels for x86 with AVX2: 32 pixels at a time. */
#include "row/row_x86.h"

#if defined(PEL_ROW_X86)
#include <immintrin.h>

#define AVX2 __attribute__((target("avx2,bmi,bmi2,popcnt")))
#define AVX2_INLINE __attribute__((target("avx2,bmi,bmi2,popcnt"), always_inline)) static inline

AVX2_INLINE __m256i load(const void *bytes)
{
    return _mm256_loadu_si256((const __m256i_u *)bytes);
}

AVX2_INLINE void store(void *bytes, __m256i value)
{
    _mm256_storeu_si256((__m256i_u *)bytes, value);
}

AVX2_INLINE __m256i pair_of(const uint8_t *low, const uint8_t *high)
{
    return _mm256_inserti128_si256(_mm256_castsi128_si256(_mm_loadu_si128((const __m128i_u *)low)),
                                   _mm_loadu_si128((const __m128i_u *)high), 1);
}

/* ---- Box classes --------------------------------------------------------------------------- */

/* The nibble tables of a channel in both halves of a register, or of U in the low and V in the
 * high half. */
typedef struct tables {
    __m256i above, first, below, from, to;
} tables;

AVX2_INLINE tables tables_of(const uint8_t *low, const uint8_t *high)
{
    const tables t = {pair_of(low + PEL_NIBBLES_ABOVE, high + PEL_NIBBLES_ABOVE),
                      pair_of(low + PEL_NIBBLES_FIRST, high + PEL_NIBBLES_FIRST),
                      pair_of(low + PEL_NIBBLES_BELOW, high + PEL_NIBBLES_BELOW),
                      pair_of(low + PEL_NIBBLES_FROM, high + PEL_NIBBLES_FROM),
                      pair_of(low + PEL_NIBBLES_TO, high + PEL_NIBBLES_TO)};
    return t;
}

/* The class masks of 32 values; see row_nibbles.h. */
AVX2_INLINE __m256i masks_of(const tables *t, __m256i values)
{
    const __m256i nibble = _mm256_set1_epi8(15);
    const __m256i low = _mm256_and_si256(values, nibble);
    const __m256i high = _mm256_and_si256(_mm256_srli_epi16(values, 4), nibble);
    const __m256i from =
        _mm256_and_si256(_mm256_shuffle_epi8(t->first, high), _mm256_shuffle_epi8(t->from, low));
    const __m256i to =
        _mm256_or_si256(_mm256_shuffle_epi8(t->below, high), _mm256_shuffle_epi8(t->to, low));
    return _mm256_and_si256(_mm256_or_si256(_mm256_shuffle_epi8(t->above, high), from), to);
}

/* 1 + the place of the lowest bit, 0 for none: of either nibble one less (255 for none), the
 * smaller of both, plus one. */
AVX2_INLINE __m256i labels_of(__m256i masks)
{
    const __m256i nibble = _mm256_set1_epi8(15);
    const __m256i of_low =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(-1, 0, 1, 0, 2, 0, 1, 0, 3, 0, 1, 0, 2, 0, 1, 0));
    const __m256i of_high =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(-1, 4, 5, 4, 6, 4, 5, 4, 7, 4, 5, 4, 6, 4, 5, 4));
    const __m256i low = _mm256_shuffle_epi8(of_low, _mm256_and_si256(masks, nibble));
    const __m256i high =
        _mm256_shuffle_epi8(of_high, _mm256_and_si256(_mm256_srli_epi16(masks, 4), nibble));
    return _mm256_sub_epi8(_mm256_min_epu8(low, high), _mm256_set1_epi8(-1));
}

/* 32 bytes a b a b ... of each half of the register become 16 a in the low, 16 b in the high half,
 * those of the low half first. */
AVX2_INLINE __m256i split(__m256i pairs)
{
    const __m256i even = _mm256_and_si256(pairs, _mm256_set1_epi16(255));
    const __m256i odd = _mm256_srli_epi16(pairs, 8);
    return _mm256_permute4x64_epi64(_mm256_packus_epi16(even, odd), 0xD8);
}

/* 16 U masks in the low, 16 V masks in the high half: their conjunction in both. */
AVX2_INLINE __m256i both(__m256i masks)
{
    return _mm256_and_si256(masks, _mm256_permute4x64_epi64(masks, 0x4E));
}

/* Of 16 masks in both halves: each twice, 8 of them in either half. */
AVX2_INLINE __m256i twice(__m256i masks)
{
    const __m256i places = _mm256_setr_epi8(0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 8, 8, 9,
                                            9, 10, 10, 11, 11, 12, 12, 13, 13, 14, 14, 15, 15);
    return _mm256_shuffle_epi8(masks, places);
}

/* Packed 4:2:2 from its lowest byte on. y_at: where the first Y is, 0 or 1. */
AVX2 static void classify_packed(const tables *y, const tables *uv, const uint8_t *src,
                                 unsigned y_at, size_t count, uint8_t *labels)
{
    const __m128i to_y = _mm_cvtsi32_si128(y_at != 0 ? 8 : 0);
    const __m128i to_c = _mm_cvtsi32_si128(y_at != 0 ? 0 : 8);
    const __m256i byte = _mm256_set1_epi16(255);

    for (size_t x = 0; x < count; x += 32) {
        const __m256i a = load(src + 2 * x), b = load(src + 2 * x + 32);
        const __m256i c = _mm256_packus_epi16(_mm256_and_si256(_mm256_srl_epi16(a, to_c), byte),
                                              _mm256_and_si256(_mm256_srl_epi16(b, to_c), byte));
        const __m256i chroma = both(masks_of(uv, split(c)));
        __m256i found = _mm256_setzero_si256();
        if (!_mm256_testz_si256(chroma, chroma)) {
            const __m256i luma =
                _mm256_packus_epi16(_mm256_and_si256(_mm256_srl_epi16(a, to_y), byte),
                                    _mm256_and_si256(_mm256_srl_epi16(b, to_y), byte));
            const __m256i masks = _mm256_and_si256(masks_of(y, luma), twice(chroma));
            found = _mm256_permute4x64_epi64(labels_of(masks), 0xD8);
        }
        store(labels + x, found);
    }
}

/* 16 U in the low and 16 V in the high half, from separate or interleaved planes. */
AVX2_INLINE __m256i chroma_at(const pel_row_pairs *src, size_t pair)
{
    if (src->c_step == 1) {
        return pair_of(src->u + pair, src->v + pair);
    }
    if (src->c_step == 2) {
        return split(load((src->u < src->v ? src->u : src->v) + 2 * pair));
    }
    return _mm256_inserti128_si256(_mm256_set1_epi8((char)*src->u), _mm_set1_epi8((char)*src->v),
                                   1);
}

AVX2 static void classify_planar(const tables *y, const tables *uv, const pel_row_pairs *src,
                                 size_t count, uint8_t *labels)
{
    for (size_t x = 0; x < count; x += 32) {
        const __m256i chroma = both(masks_of(uv, chroma_at(src, x / 2)));
        __m256i found = _mm256_setzero_si256();
        if (!_mm256_testz_si256(chroma, chroma)) {
            found = labels_of(_mm256_and_si256(masks_of(y, load(src->y + x)), twice(chroma)));
        }
        store(labels + x, found);
    }
}

AVX2 uint16_t pel_row_classify_nibbles_avx2(const uint8_t *nibbles, const pel_row_pairs *src,
                                            uint16_t count, uint8_t *labels)
{
    const uint16_t whole = (uint16_t)(count & ~31u);
    const uint8_t *const of_u = nibbles + PEL_NIBBLES_CHANNEL;
    const uint8_t *const of_v = of_u + PEL_NIBBLES_CHANNEL;
    const tables y = tables_of(nibbles, nibbles);
    const int v_first = src->v < src->u && src->c_step > 1;
    const tables uv = v_first ? tables_of(of_v, of_u) : tables_of(of_u, of_v);

    if (src->y_step == 2) {
        const uint8_t *const c = v_first ? src->v : src->u;
        classify_packed(&y, &uv, c < src->y ? c : src->y, c < src->y, whole, labels);
    } else {
        classify_planar(&y, &uv, src, whole, labels);
    }
    return whole;
}

/* ---- Runs ---------------------------------------------------------------------------------- */

/* Writes the places of the set bits, `from` higher, into every second element; `bits` is not 0. */
AVX2_INLINE uint16_t *put_places(uint32_t bits, unsigned from, uint16_t *out)
{
    do {
        *out = (uint16_t)(from + _tzcnt_u32(bits));
        out += 2;
        bits = _blsr_u32(bits);
    } while (bits != 0);
    return out;
}

/* Begins and ends alternate, so they can be written each for itself: begins to edges[0], [2], ...,
 * ends to edges[1], [3], ... */
AVX2 uint16_t pel_row_find_runs_avx2(const uint8_t *labels, uint16_t count, uint16_t *edges)
{
    const __m256i zero = _mm256_setzero_si256();
    uint16_t *begin = edges, *end = edges + 1;
    __m256i last = zero;
    unsigned x = 0;
    uint8_t label;

    for (; x + 32 <= count; x += 32) {
        const __m256i here = load(labels + x);
        const __m256i before =
            _mm256_alignr_epi8(here, _mm256_permute2x128_si256(last, here, 0x21), 15);
        const uint32_t same = (uint32_t)_mm256_movemask_epi8(_mm256_cmpeq_epi8(here, before));
        last = here;
        if (same != 0xFFFFFFFFu) {
            const uint32_t begins =
                ~(same | (uint32_t)_mm256_movemask_epi8(_mm256_cmpeq_epi8(here, zero)));
            const uint32_t ends =
                ~(same | (uint32_t)_mm256_movemask_epi8(_mm256_cmpeq_epi8(before, zero)));
            if (begins != 0) {
                begin = put_places(begins, x, begin);
            }
            if (ends != 0) {
                end = put_places(ends, x, end);
            }
        }
    }
    label = x > 0 ? labels[x - 1] : 0;
    for (; x <= count; x++) {
        const uint8_t next = x < count ? labels[x] : 0;
        if (next != label) {
            *begin = (uint16_t)x;
            begin += next != 0 ? 2 : 0;
            *end = (uint16_t)x;
            end += label != 0 ? 2 : 0;
            label = next;
        }
    }
    return (uint16_t)((size_t)(begin - edges) / 2);
}

#else
typedef int nothing_here; /* an empty file is no C */
#endif
