/*
 * Runs the library's filters under the sharpest conditions, guarded memory full of rubbish and rows
 * that vanish after each call, and compares every byte with the reference.
 */
#ifndef FILTER_TRIAL_H
#define FILTER_TRIAL_H

#include "check.h"
#include "filter_reference.h"

enum { REF_RESULTS_MAX = REF_WIDTH_MAX * REF_HEIGHT_MAX };

/* One picture and what to make of it: op, kernel, border and constant of the config. */
typedef struct filter_trial {
    pel_filter_config config;
    ref_picture picture;
} filter_trial;

/* How a plane lies in memory. */
typedef struct layout {
    uint16_t padding; /* elements behind each row */
    uint8_t bottom_up;
    uint8_t offset; /* bytes by which the memory is off its alignment; elements for 16 bits */
} layout;

/* The reference's results for a trial; valid until the next call for the same width of results. */
const uint8_t *expected_u8(const filter_trial *trial);
const int16_t *expected_s16(const filter_trial *trial);

/* Row by row; `shared`: each result is pulled into the memory of the row that was just pushed. */
void verify_stream_u8(const filter_trial *trial, const uint8_t *expected, int shared);
void verify_stream_s16(const filter_trial *trial, const int16_t *expected);

/* Whole frames. */
void verify_frame_u8(const filter_trial *trial, const uint8_t *expected, layout from, layout to);
void verify_frame_s16(const filter_trial *trial, const int16_t *expected, layout from, layout to);
void verify_frame_in_place(const filter_trial *trial, const uint8_t *expected, layout both);

/* pel_filter_twice, into another picture or in place. The trial's own operator is not looked at but
 * for the working memory. */
void verify_twice(const filter_trial *trial, ref_op first, ref_op second, layout from, layout to,
                  int in_place);

/* All of the above but the last, with layouts drawn from `random`. */
void verify_all(const filter_trial *trial, rng *random);

/* Whether the picture is large enough for the trial's border. */
int is_possible(const filter_trial *trial);

layout random_layout(rng *random);

/* The trial in words, in a static buffer. */
const char *filter_trial_text(const filter_trial *trial);

#endif
