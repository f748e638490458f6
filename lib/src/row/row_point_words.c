/*
 * Row kernels that no vector does well, in words of eight pixels: for processors of 64 bits that
 * load words from any address.
 */
#include "row/row_point_words.h"

#if defined(PEL_ROW_POINT_WORDS)

static uint64_t load_word(const uint8_t *bytes)
{
    uint64_t word;
    __builtin_memcpy(&word, bytes, sizeof word);
    return word;
}

/*
 * Shuffles of 16 or 32 bytes would do: 16 of them for 256 entries, with what chooses between them.
 * With AVX2 that took as long as this does, with SSSE3 half as long again.
 */
void pel_row_map_words(const uint8_t *src, uint16_t count, const uint8_t *table, uint8_t *dst)
{
    uint16_t x = 0;

    for (; x + 8 <= count; x = (uint16_t)(x + 8)) {
        dst[x] = table[src[x]];
        dst[x + 1] = table[src[x + 1]];
        dst[x + 2] = table[src[x + 2]];
        dst[x + 3] = table[src[x + 3]];
        dst[x + 4] = table[src[x + 4]];
        dst[x + 5] = table[src[x + 5]];
        dst[x + 6] = table[src[x + 6]];
        dst[x + 7] = table[src[x + 7]];
    }
    pel_row_map(src + x, (uint16_t)(count - x), table, dst + x);
}

/*
 * One bin counted up again and again waits for its own last store each time. Where that is worst,
 * in areas of one value, eight are one. For the rest there would have to be several arrays of bins,
 * for which there is no memory.
 */
void pel_row_histogram_words(const uint8_t *src, uint16_t count, uint32_t *bins)
{
    uint16_t x = 0;

    for (; x + 8 <= count; x = (uint16_t)(x + 8)) {
        const uint64_t word = load_word(src + x);
        if (word == (word << 8 | word >> 56)) {
            bins[word & 255] += 8;
        } else {
            bins[word & 255]++;
            bins[word >> 8 & 255]++;
            bins[word >> 16 & 255]++;
            bins[word >> 24 & 255]++;
            bins[word >> 32 & 255]++;
            bins[word >> 40 & 255]++;
            bins[word >> 48 & 255]++;
            bins[word >> 56]++;
        }
    }
    pel_row_histogram(src + x, 1, (uint16_t)(count - x), bins);
}

#else
typedef int nothing_here; /* an empty file is no C */
#endif
