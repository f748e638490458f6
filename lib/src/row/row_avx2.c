/* Row kernels from pixels to runs for x86 with AVX2: 64 pixels at a time. */
#include "row/row_x86.h"

#if defined(PEL_ROW_X86)
#include "row/row_places.h"

#include <immintrin.h>

#define ISA __attribute__((target("avx2,bmi,bmi2,popcnt")))
#define INLINE __attribute__((target("avx2,bmi,bmi2,popcnt"), always_inline)) static inline
#define APART __attribute__((target("avx2,bmi,bmi2,popcnt"), noinline)) static
#define KERNEL(name) pel_row_##name##_avx2
#define V(operation) _mm256_##operation
#define BITS(operation) _mm256_##operation##_si256
#define MOVED(last, here) _mm256_alignr_epi8(here, _mm256_permute2x128_si256(last, here, 0x21), 15)

enum { LANES = 32 };
typedef __m256i vec;
typedef __m256i_u loose_vec;

INLINE vec everywhere(__m128i bytes)
{
    return _mm256_broadcastsi128_si256(bytes);
}

INLINE vec eights(vec bytes)
{
    return _mm256_permute4x64_epi64(bytes, 0xD8);
}

INLINE int are_apart(vec a, vec b)
{
    return _mm256_testz_si256(a, b);
}

INLINE uint64_t equal_bytes(vec a, vec b)
{
    return (uint32_t)_mm256_movemask_epi8(_mm256_cmpeq_epi8(a, b));
}

INLINE unsigned lowest_place(uint64_t bits)
{
    return (unsigned)_tzcnt_u64(bits);
}

INLINE size_t bit_count(uint64_t bits)
{
    return (size_t)_mm_popcnt_u64(bits);
}

#include "row/row_nibbles_template.h"

#include "row/row_pairs_template.h"

INLINE uint64_t put_place(uint16_t *edge, uint64_t bits, size_t x);
INLINE uint64_t put_four_places(uint16_t *edge, uint64_t bits, size_t x);

/* Where there are more than a few, those of a byte of bits at once. */
INLINE void put_many(uint16_t *edge, uint64_t bits, size_t x)
{
    const uint64_t *const table = pel_i_places();
    __m128i before = _mm_set1_epi16((int16_t)x);

    if (bit_count(bits) <= 7) {
        bits = put_four_places(edge, bits, x);
        bits = put_place(edge + 4, bits, x);
        bits = put_place(edge + 5, bits, x);
        (void)put_place(edge + 6, bits, x);
        return;
    }
    for (unsigned i = 0; i < 8; i++, bits >>= 8) {
        const uint64_t *const places = table + (bits & 0xFF);
        const __m128i words =
            _mm_cvtepu8_epi16(_mm_loadl_epi64((const __m128i_u *)(const void *)places));
        _mm_storeu_si128((__m128i_u *)(void *)edge, _mm_add_epi16(words, before));
        edge += bit_count(bits & 0xFF);
        before = _mm_add_epi16(before, _mm_set1_epi16(8));
    }
}

#include "row/row_edges_template.h"
#include "row/row_classify_template.h"

#else
typedef int nothing_here; /* an empty file is no C */
#endif
