/*
 * What tests/equal compares: a row kernel run by a backend must give the bytes that plain C gives.
 * A kernel is one line of a table; everything else (widths, offsets, patterns, canaries) is common.
 */
#ifndef EQUAL_H
#define EQUAL_H

#include <pel.h>

enum {
    EQUAL_PLANES = 5,      /* input rows at most */
    EQUAL_MARGIN = 8,      /* bytes that a kernel may read beside a row, as its neighbours */
    EQUAL_WIDTH_MAX = 640, /* pixels */
    EQUAL_OUT_MAX = 6 * EQUAL_WIDTH_MAX + 64 /* bytes of result */
};

/* One run: rows of 4 bytes per pixel at most, all filled with the same kind of pattern. */
typedef struct equal_run {
    const uint8_t *in[EQUAL_PLANES];
    uint8_t *out;
    uint16_t width;
    uint32_t seed; /* for what else the kernel needs: taps, boxes, a variant */
} equal_run;

typedef struct equal_kernel {
    const char *name;
    /* Runs the kernel into run->out and returns how many bytes of it are its result. */
    size_t (*run)(pel_backend backend, const equal_run *run);
    int even; /* 1: only even widths */
} equal_kernel;

/* The tables of the modules, ended by a kernel without name. */
extern const equal_kernel equal_color_kernels[], equal_filter_kernels[], equal_point_kernels[],
    equal_row_kernels[], equal_feature_kernels[];

/* A random number; the state moves on. */
uint32_t equal_random(uint32_t *state);

/* Filters random frames; returns how many are equal. */
unsigned equal_frames(pel_backend backend, uint32_t seed, unsigned *failed);

/* Converts all 2^24 colours, there and back, in either range; returns in how many ranges all are
 * equal. */
unsigned equal_colors(pel_backend backend, unsigned *failed);

/* Finds corners and edges in random pictures; returns how many are equal. */
unsigned equal_pictures(pel_backend backend, uint32_t seed, unsigned *failed);

/* Whether the root that the kernels of x86 take in single precision, cut off, is the whole root of
 * every number that gx^2 + gy^2 can be, and the guessed one that of those of 16 bits. Elsewhere
 * there is nothing to try. */
int equal_roots_hold(void);

/* Whether a number < 2^23 less the root of one < 2^45 in double precision, cut off, is what it
 * exactly is, at all squares and beside them, where it comes closest to the next whole number. */
int equal_long_roots_hold(void);

#endif
