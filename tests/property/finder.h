/*
 * Runs the library's finder over a map under the sharpest conditions, guarded memory full of
 * rubbish and rows that vanish after each call, and compares all that it says with the reference.
 */
#ifndef FINDER_H
#define FINDER_H

#include "check.h"
#include "reference.h"

/* Pixels under a map, for the mean colour: a packed format. */
typedef struct picture {
    const uint8_t *bytes;
    size_t row_bytes;
    uint16_t width; /* pixels */
    pel_format format;
    pel_range range;
} picture;

typedef struct setup {
    ref_map map;
    uint8_t connectivity;
    uint8_t measure;
    uint8_t silent; /* no callback; results_max must then be large enough for all blobs */
    uint16_t open_max;
    uint32_t results_max;
    const pel_blob_filter *filter; /* may be NULL */
    const pel_blob_shape *shape;   /* may be NULL: no accept */
    const picture *pixels;         /* NULL without PEL_MEASURE_COLOR */
} setup;

/* What the reference finds in a map, sorted by ref_compare_all, unmeasured fields 0. */
typedef struct expectation {
    const pel_blob *blobs;
    uint32_t count;
    uint32_t coloured_px;
} expectation;

/* The expectation of a map; `yuv` as of ref_find. Valid until the next call. */
expectation expect(const ref_map *map, int connectivity, unsigned measure, const uint8_t *yuv);

/* Runs the finder and checks all of its answers; returns its counters. */
pel_blobs_counts verify(const setup *trial, const expectation *expected);

/* The usual setup: never-lose size, room for every blob, everything but colour. */
setup setup_safe(const ref_map *map, int connectivity);

/* Checks the five shape functions of a blob against their definitions. */
void verify_shape(const pel_blob *blob, unsigned measure);

/* A trial in words, in a static buffer: size, settings, and small maps in full. */
const char *trial_text(const setup *trial);

#endif
