/*
 * The DSP instructions of Armv7E-M and Armv8-M by what they do with pixels: lanes are the two
 * halves of a word, 16 bits each. The same in plain C where PEL_ROW_DSP_EMULATED asks for it.
 */
#ifndef PEL_ROW_DSP_H
#define PEL_ROW_DSP_H

#include <stdint.h>

#ifdef PEL_ROW_DSP_EMULATED

#define PEL_DSP static inline

PEL_DSP uint32_t pel_dsp_lane(uint32_t lanes, unsigned lane)
{
    return lanes >> 16 * lane & 0xFFFFu;
}

PEL_DSP uint32_t pel_dsp_turned(uint32_t word, unsigned turn)
{
    return word >> turn | word << (32 - turn) % 32;
}

/* In each lane a - b, but not below 0. */
PEL_DSP uint32_t subtract_to_zero(uint32_t a, uint32_t b)
{
    uint32_t lanes = 0;

    for (unsigned i = 0; i < 2; i++) {
        const uint32_t x = pel_dsp_lane(a, i), y = pel_dsp_lane(b, i);
        lanes |= (x < y ? 0 : x - y) << 16 * i;
    }
    return lanes;
}

/* Each lane, but not above 255; none is above 32767. */
PEL_DSP uint32_t limited_lanes(uint32_t lanes)
{
    const uint32_t lower = pel_dsp_lane(lanes, 0), upper = pel_dsp_lane(lanes, 1);
    return (lower > 255 ? 255 : lower) | (upper > 255 ? 255 : upper) << 16;
}

/* Byte by byte the smaller and the larger one. */
PEL_DSP uint32_t smaller_bytes(uint32_t a, uint32_t b)
{
    uint32_t bytes = 0;

    for (unsigned i = 0; i < 32; i += 8) {
        const uint32_t x = a >> i & 255, y = b >> i & 255;
        bytes |= (x < y ? x : y) << i;
    }
    return bytes;
}

PEL_DSP uint32_t larger_bytes(uint32_t a, uint32_t b)
{
    uint32_t bytes = 0;

    for (unsigned i = 0; i < 32; i += 8) {
        const uint32_t x = a >> i & 255, y = b >> i & 255;
        bytes |= (x < y ? y : x) << i;
    }
    return bytes;
}

/* Both: a the smaller, b the larger one. */
PEL_DSP void sort_bytes(uint32_t *a, uint32_t *b)
{
    const uint32_t smaller = smaller_bytes(*a, *b);

    *b = larger_bytes(*a, *b);
    *a = smaller;
}

/* Each byte twice, but not above 255. */
PEL_DSP uint32_t doubled_bytes(uint32_t word)
{
    uint32_t bytes = 0;

    for (unsigned i = 0; i < 32; i += 8) {
        const uint32_t twice = 2 * (word >> i & 255);
        bytes |= (twice > 255 ? 255 : twice) << i;
    }
    return bytes;
}

/* The lower lane of one, the upper lane of the other. */
PEL_DSP uint32_t lower_and_upper(uint32_t lower, uint32_t upper)
{
    return (lower & 0xFFFFu) | (upper & 0xFFFF0000u);
}

/* The lower lane of one, and above it that of the other. */
PEL_DSP uint32_t lower_lanes(uint32_t a, uint32_t b)
{
    return (a & 0xFFFFu) | b << 16;
}

/* The upper lane of one, and above it that of the other. */
PEL_DSP uint32_t upper_lanes(uint32_t a, uint32_t b)
{
    return a >> 16 | (b & 0xFFFF0000u);
}

/* To `sum` the product of a lane that holds a pixel and of a half that holds a factor. */
PEL_DSP int32_t pel_dsp_product(uint32_t lane, uint32_t factor, int32_t sum)
{
    return sum + (int32_t)lane * (factor > 0x7FFF ? (int32_t)factor - 0x10000 : (int32_t)factor);
}

/* To `sum` the products of both lanes, or of one lane and one half of the factors. */
PEL_DSP int32_t add_products(uint32_t lanes, uint32_t factors, int32_t sum)
{
    sum = pel_dsp_product(pel_dsp_lane(lanes, 0), pel_dsp_lane(factors, 0), sum);
    return pel_dsp_product(pel_dsp_lane(lanes, 1), pel_dsp_lane(factors, 1), sum);
}

PEL_DSP int32_t add_low_low(uint32_t lanes, uint32_t factors, int32_t sum)
{
    return pel_dsp_product(pel_dsp_lane(lanes, 0), pel_dsp_lane(factors, 0), sum);
}

PEL_DSP int32_t add_low_high(uint32_t lanes, uint32_t factors, int32_t sum)
{
    return pel_dsp_product(pel_dsp_lane(lanes, 0), pel_dsp_lane(factors, 1), sum);
}

PEL_DSP int32_t add_high_low(uint32_t lanes, uint32_t factors, int32_t sum)
{
    return pel_dsp_product(pel_dsp_lane(lanes, 1), pel_dsp_lane(factors, 0), sum);
}

PEL_DSP int32_t add_high_high(uint32_t lanes, uint32_t factors, int32_t sum)
{
    return pel_dsp_product(pel_dsp_lane(lanes, 1), pel_dsp_lane(factors, 1), sum);
}

/* value / 256, rounded down and limited to 0..255. */
PEL_DSP int32_t limited_256th(int32_t value)
{
    return value < 0 ? 0 : value >= 65536 ? 255 : value / 256;
}

/* Of a word turned to the right the bytes 0 and 2 as lanes, and added to lanes. */
#define PEL_DSP_BYTES(name, turn)                                                                  \
    PEL_DSP uint32_t bytes_##name(uint32_t word)                                                   \
    {                                                                                              \
        return pel_dsp_turned(word, turn) & UINT32_C(0x00FF00FF);                                  \
    }                                                                                              \
    PEL_DSP uint32_t add_bytes_##name(uint32_t lanes, uint32_t word)                               \
    {                                                                                              \
        return lanes + bytes_##name(word);                                                         \
    }

/* The sum of lanes and of others turned to the right. */
#define PEL_DSP_ADD(name, turn)                                                                    \
    PEL_DSP uint32_t name(uint32_t lanes, uint32_t others)                                         \
    {                                                                                              \
        return lanes + pel_dsp_turned(others, turn);                                               \
    }

PEL_DSP uint32_t load4(const uint8_t *p)
{
    return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

PEL_DSP void store4(uint8_t *p, uint32_t word)
{
    p[0] = (uint8_t)word;
    p[1] = (uint8_t)(word >> 8);
    p[2] = (uint8_t)(word >> 16);
    p[3] = (uint8_t)(word >> 24);
}

PEL_DSP uint32_t in_register(uint32_t value)
{
    return value;
}

PEL_DSP const uint8_t *opaque(const uint8_t *place)
{
    return place;
}

PEL_DSP uint8_t *opaque_to_write(uint8_t *place)
{
    return place;
}

PEL_DSP void in_order(void)
{
}

#else

#include <arm_acle.h>

/* Always: what a call carries through memory costs more than the rest. */
#define PEL_DSP static inline __attribute__((always_inline))

PEL_DSP uint32_t subtract_to_zero(uint32_t a, uint32_t b)
{
    return __uqsub16(a, b);
}

PEL_DSP uint32_t doubled_bytes(uint32_t word)
{
    return __uqadd8(word, word);
}

PEL_DSP int32_t add_products(uint32_t lanes, uint32_t factors, int32_t sum)
{
    return __smlad((int16x2_t)lanes, (int16x2_t)factors, sum);
}

PEL_DSP int32_t add_low_low(uint32_t lanes, uint32_t factors, int32_t sum)
{
    return __smlabb((int32_t)lanes, (int32_t)factors, sum);
}

PEL_DSP int32_t add_low_high(uint32_t lanes, uint32_t factors, int32_t sum)
{
    return __smlabt((int32_t)lanes, (int32_t)factors, sum);
}

PEL_DSP int32_t add_high_low(uint32_t lanes, uint32_t factors, int32_t sum)
{
    return __smlatb((int32_t)lanes, (int32_t)factors, sum);
}

PEL_DSP int32_t add_high_high(uint32_t lanes, uint32_t factors, int32_t sum)
{
    return __smlatt((int32_t)lanes, (int32_t)factors, sum);
}

PEL_DSP int32_t limited_256th(int32_t value)
{
    int32_t limited;
    __asm__("usat %0, #8, %1, asr #8" : "=r"(limited) : "r"(value));
    return limited;
}

/* For what follows there is no intrinsic, or none that compilers make one instruction of. */
#define PEL_DSP_TWO(name, instruction)                                                             \
    PEL_DSP uint32_t name(uint32_t a, uint32_t b)                                                  \
    {                                                                                              \
        uint32_t lanes;                                                                            \
        __asm__(instruction : "=r"(lanes) : "r"(a), "r"(b));                                       \
        return lanes;                                                                              \
    }
#define PEL_DSP_ONE(name, instruction)                                                             \
    PEL_DSP uint32_t name(uint32_t word)                                                           \
    {                                                                                              \
        uint32_t lanes;                                                                            \
        __asm__(instruction : "=r"(lanes) : "r"(word));                                            \
        return lanes;                                                                              \
    }

PEL_DSP_ONE(limited_lanes, "usat16 %0, #8, %1")
PEL_DSP_TWO(lower_and_upper, "pkhbt %0, %1, %2")
PEL_DSP_TWO(lower_lanes, "pkhbt %0, %1, %2, lsl #16")
PEL_DSP_TWO(upper_lanes, "pkhtb %0, %2, %1, asr #16")
/* SEL takes the first where USUB8 went without a borrow. */
PEL_DSP uint32_t smaller_bytes(uint32_t a, uint32_t b)
{
    uint32_t bytes;
    __asm__("usub8 %0, %1, %2\n\tsel %0, %2, %1" : "=&r"(bytes) : "r"(a), "r"(b));
    return bytes;
}

PEL_DSP uint32_t larger_bytes(uint32_t a, uint32_t b)
{
    uint32_t bytes;
    __asm__("usub8 %0, %1, %2\n\tsel %0, %1, %2" : "=&r"(bytes) : "r"(a), "r"(b));
    return bytes;
}

PEL_DSP void sort_bytes(uint32_t *a, uint32_t *b)
{
    uint32_t smaller;
    __asm__("usub8 %0, %1, %2\n\tsel %0, %2, %1\n\tsel %1, %1, %2"
            : "=&r"(smaller), "+r"(*a)
            : "r"(*b));
    *b = *a;
    *a = smaller;
}

#define PEL_DSP_BYTES(name, turn)                                                                  \
    PEL_DSP_ONE(bytes_##name, "uxtb16 %0, %1, ror #" #turn)                                        \
    PEL_DSP_TWO(add_bytes_##name, "uxtab16 %0, %1, %2, ror #" #turn)
#define PEL_DSP_ADD(name, turn) PEL_DSP_TWO(name, "add %0, %1, %2, ror #" #turn)

/* A constant that compilers do not know: they would take two instructions with it where one will do
 * once it is in a register. */
PEL_DSP uint32_t in_register(uint32_t value)
{
    __asm__("" : "+r"(value));
    return value;
}

/* A place that compilers do not know: else they turn several that advance alike into one offset and
 * additions to it. */
PEL_DSP const uint8_t *opaque(const uint8_t *place)
{
    __asm__("" : "+r"(place));
    return place;
}

PEL_DSP uint8_t *opaque_to_write(uint8_t *place)
{
    __asm__("" : "+r"(place));
    return place;
}

/* No load of what follows before this place: loads that come early take registers that the rest
 * needs. */
PEL_DSP void in_order(void)
{
    __asm__ volatile("" : : : "memory");
}

/* Four bytes at any address. */
typedef struct pel_dsp_word {
    uint32_t word;
} __attribute__((packed, may_alias)) pel_dsp_word;

PEL_DSP uint32_t load4(const uint8_t *p)
{
    return ((const pel_dsp_word *)(const void *)p)->word;
}

PEL_DSP void store4(uint8_t *p, uint32_t word)
{
    ((pel_dsp_word *)(void *)p)->word = word;
}

#endif

PEL_DSP_BYTES(02, 0)
PEL_DSP_BYTES(13, 8)
PEL_DSP_BYTES(20, 16)
PEL_DSP_BYTES(31, 24)

/* Lanes and others with their lanes swapped; the latter twice. */
PEL_DSP_ADD(add_swapped, 16)
PEL_DSP_ADD(add_swapped_twice, 15)

PEL_DSP uint32_t swapped(uint32_t lanes)
{
    return lanes >> 16 | lanes << 16;
}

#endif
