/*
 * Blobs: connected regions of one class, found while the rows stream by.
 *
 * A row of labels becomes runs (maximal stretches of one label), each run joins the blobs of the
 * runs it touches in the row above (union-find with path compression), and a blob that the newest
 * row did not touch is closed: its numbers are final and it is reported at once, before the frame
 * has ended. Two rows of runs and the open blobs are all the memory there is: it grows with the
 * width, never with the height.
 *
 *     static uint64_t work[PEL_BLOBS_WORDS(320, 32, PEL_MEASURE_MOMENTS)];
 *     static pel_blob found[16];
 *     pel_blobs blobs;
 *     pel_blobs_config config = {0};
 *     config.width = 320;
 *     config.height = 240;
 *     config.open_max = 32;
 *     config.measure = PEL_MEASURE_MOMENTS;
 *     config.measurer = pel_blobs_measure;
 *     config.work = work;
 *     config.work_bytes = sizeof work;
 *     config.results = found;
 *     config.results_max = 16;
 *
 *     pel_blobs_begin(&blobs, &config);
 *     for (y = 0; y < 240; y++)
 *         pel_blobs_row(&blobs, y, labels_of_row(y), NULL);
 *     pel_blobs_end(&blobs, &count);          found[0..count-1], largest first
 *
 * What does not fit is counted, and what is kept is exact:
 *   - Runs always fit.
 *   - If open_max is smaller than PEL_BLOBS_OPEN_SAFE(width), a row may need more open blobs than
 *     there are. A blob that lost a run that way is not reported at all, rather than wrongly; its
 *     pixels are added to lost_px. It never turns into two blobs, and no other blob changes.
 *   - If more blobs pass the filter than results_max, the largest are kept and the rest counted.
 * In both cases pel_blobs_end answers PEL_TRUNCATED.
 */
#ifndef PEL_BLOBS_H
#define PEL_BLOBS_H

#include "pel/classify.h"
#include "pel/image.h"

#ifdef __cplusplus
extern "C" {
#endif

struct pel_blobs;

/* ---- A blob -------------------------------------------------------------------------------- */

/*
 * A closed blob. Its sums are exact integers, so blobs can be added and compared; what people want
 * to read (centroid, angle, ...) is computed from them by the functions below. Fields that were not
 * measured are 0.
 */
typedef struct pel_blob {
    uint64_t sum_xx, sum_xy,
        sum_yy;            /* sums of x*x, x*y, y*y over its pixels; PEL_MEASURE_MOMENTS */
    uint32_t area;         /* pixels */
    uint32_t sum_x, sum_y; /* sums of x and of y over its pixels */
    uint32_t perimeter; /* pixel edges between the blob and what is not the blob, the frame's border
                             and its holes included; PEL_MEASURE_OUTLINE */
    uint32_t holes; /* regions that it encloses: not of the blob and, connected by the other rule
                             (4 for 8, 8 for 4), cut off from the outside; PEL_MEASURE_OUTLINE */
    uint16_t x0, x1, y0, y1;        /* the smallest box that holds it, half-open */
    uint8_t class_index;            /* label - 1 */
    uint8_t edges;                  /* PEL_EDGE_...: which borders of the frame it touches */
    uint8_t mean_y, mean_u, mean_v; /* mean colour, halves upward; PEL_MEASURE_COLOR */
} pel_blob;

enum { PEL_EDGE_LEFT = 1, PEL_EDGE_RIGHT = 2, PEL_EDGE_TOP = 4, PEL_EDGE_BOTTOM = 8 };

/* What to measure beside area, box, sum_x and sum_y, which are always there, and which
 * pel_blobs_measure measures. Costs per open blob, and time per run (per pixel of the class for
 * colour). */
enum {
    PEL_MEASURE_MOMENTS = 1, /* 24 bytes: sum_xx, sum_xy, sum_yy, for angle and roundness */
    PEL_MEASURE_OUTLINE = 2, /* 8 bytes: perimeter, holes */
    PEL_MEASURE_COLOR = 4,   /* 16 bytes: mean_y, mean_u, mean_v; needs the pixels of each row */
    PEL_MEASURE_ALL = 7
};

/* The centroid (sum_x / area, sum_y / area) in 1/65536 pixel, rounded to nearest, halves upward.
 * (0, 0) is the centre of the first pixel. No area gives 0; a NULL output is left out. Here and
 * below a NULL blob is one of which nothing is known. */
void pel_blob_centroid_q16(const pel_blob *blob, int32_t *x_q16, int32_t *y_q16);

/*
 * The direction of the long axis in 1/65536 of a turn, -16384 <= angle < 16384: 0 along x, 8192 =
 * 45 degrees down to the right (y points down). Half the atan2 of the second central moments,
 * 0.5 * atan2(2 c11, c20 - c02) (Horn, Robot Vision, 1986); within 1 unit of it. 0 if no axis
 * stands out (discs, squares). Needs PEL_MEASURE_MOMENTS.
 */
int16_t pel_blob_angle_turn16(const pel_blob *blob);

/*
 * Short axis / long axis of the ellipse with the same second moments, in q15: 32767 for a disc, a
 * square or a single pixel, 0 for a straight line one pixel thin; square root of the ratio of the
 * eigenvalues of the covariance. Within 4 / 32768. Needs PEL_MEASURE_MOMENTS; 32767
 * without.
 */
uint16_t pel_blob_roundness_q15(const pel_blob *blob);

/* 32767 - roundness: 0 for a disc, 32767 for a line. */
uint16_t pel_blob_elongation_q15(const pel_blob *blob);

/* area / (box width * box height) in q15, rounded to nearest, halves upward, at most 32767. */
uint16_t pel_blob_density_q15(const pel_blob *blob);

/* 4 pi area / perimeter^2 in q15: 25736 for a square (pi / 4, the most there is, as the perimeter
 * counts pixel edges), less for ragged or hollow shapes. Within 1. Needs PEL_MEASURE_OUTLINE;
 * 0 without. */
uint16_t pel_blob_compactness_q15(const pel_blob *blob);

/* ---- Filter -------------------------------------------------------------------------------- */

/*
 * Which blobs count. Every bound belongs to the allowed interval; 0 in a `max` means no bound, so a
 * zeroed filter lets everything pass. Aspect is box width / box height, compared exactly.
 */
typedef struct pel_blob_filter {
    uint32_t area_min, area_max;             /* pixels */
    uint16_t width_min, width_max;           /* of the box, pixels */
    uint16_t height_min, height_max;         /* of the box, pixels */
    uint32_t aspect_min_q16, aspect_max_q16; /* 65536 = as wide as high */
    uint32_t class_mask;                     /* bit c: class c < 32 may pass; 0 = all */
    uint16_t roi_x0, roi_x1, roi_y0, roi_y1; /* the centroid must lie inside, half-open; all 0 =
                                                      no region of interest */
} pel_blob_filter;

/* 1 if the blob passes the filter, 0 if not; a NULL filter passes all. */
int pel_blob_passes(const pel_blob *blob, const pel_blob_filter *filter);

/*
 * Bounds of what takes more code to compute, by the same rules and as the functions above give it.
 * Elongation needs PEL_MEASURE_MOMENTS (without, it is 0) and costs two square roots per blob.
 */
typedef struct pel_blob_shape {
    uint16_t density_min_q15, density_max_q15;
    uint16_t elongation_min_q15, elongation_max_q15;
} pel_blob_shape;

/* A further decision about a blob: 1 passes, 0 does not. pel_blobs_config names the function, so
 * that a program links only what it asks for. */
typedef int pel_blob_accept(const void *limits, const pel_blob *blob);

/* 1 if the blob lies within a pel_blob_shape, 0 if not or for a NULL blob; NULL limits pass all
 * others. */
pel_blob_accept pel_blob_shape_passes;

/* ---- Finding blobs ------------------------------------------------------------------------- */

#define pel_blobs_pixels PEL_FOR_CLASSES(pel_blobs_pixels)
#define pel_blobs_frame PEL_FOR_CLASSES(pel_blobs_frame)

/* A run: the stretch x0 <= x < x1 of one row that has one label. */
typedef struct pel_run {
    uint16_t x0, x1;
} pel_run;

/* How many runs a row can have, plus the one that finding them needs as room to work. */
#define PEL_RUNS_MAX(width) ((uint32_t)(width) + 1u)

/*
 * The runs of a row of labels, from left to right; the class of a run is labels[run.x0] - 1. `runs`
 * has room for PEL_RUNS_MAX(width). Returns how many there are; 0 for a null pointer.
 */
uint16_t pel_find_runs(const uint8_t *labels, uint16_t width, pel_run *runs);

/*
 * How many open blobs a row of this width can need: with at least this many nothing is ever lost.
 * After a row every open blob owns at least one run of that row, and a row has at most `width` runs
 * (of a single class, or of classes that never touch each other: half of that, rounded up).
 */
#define PEL_BLOBS_OPEN_SAFE(width) (width)
#define PEL_BLOBS_OPEN_SAFE_ONE_CLASS(width) (((width) + 1) / 2)

/* The largest open_max. */
#define PEL_BLOBS_OPEN_LIMIT 65000u

/*
 * Bytes of working memory: two rows of runs with their blobs, 12 (width + 1), and 24 bytes per open
 * blob plus what is measured. The macro is a constant expression, for arrays; PEL_BLOBS_WORDS is
 * the same in elements of uint64_t, which have the alignment that is needed.
 */
#define PEL_BLOBS_SLOT_BYTES(measure)                                                              \
    (24u + (((measure)&1u) ? 24u : 0u) + (((measure)&2u) ? 8u : 0u) + (((measure)&4u) ? 16u : 0u))
#define PEL_BLOBS_BYTES(width, open_max, measure)                                                  \
    ((uint32_t)(open_max)*PEL_BLOBS_SLOT_BYTES(measure) + 12u * ((uint32_t)(width) + 1u))
#define PEL_BLOBS_WORDS(width, open_max, measure)                                                  \
    ((PEL_BLOBS_BYTES(width, open_max, measure) + 7u) / 8u)
uint32_t pel_blobs_bytes(uint16_t width, uint16_t open_max, unsigned measure);

/* A row joins the blobs, and more is measured than without; not to be called by programs. */
typedef pel_status pel_blobs_measurer(struct pel_blobs *blobs, uint16_t count,
                                      const uint8_t *labels, const pel_crow *pixels);
pel_blobs_measurer pel_blobs_measure;

/*
 * What to find, and with which memory. Only width, height, work, work_bytes and open_max must be
 * set; zero is a sane value for everything else.
 */
typedef struct pel_blobs_config {
    uint16_t width;    /* labels in a row, 1..PEL_SIDE_MAX */
    uint16_t height;   /* rows in a frame, 1..PEL_SIDE_MAX; see PEL_ERR_RANGE below */
    uint16_t open_max; /* blobs open at the same time, 1..PEL_BLOBS_OPEN_LIMIT: memory against loss;
                             32 serves most robots */
    uint8_t connectivity; /* 8 (or 0): diagonal neighbours touch; 4: they do not */
    uint8_t measure;      /* PEL_MEASURE_... bits; they need `measurer` */
    pel_backend backend;  /* what finds runs in labels; resolved by begin */
    void *work;           /* PEL_BLOBS_BYTES(width, open_max, measure), aligned to 8 bytes; in use
                             from begin to end, may be shared between frames and finders */
    size_t work_bytes;
    const pel_blob_filter *filter; /* what counts as a blob; NULL: everything. Not copied:
                                      it stays as it is until the end */

    /* Asked about every blob that passes the filter: what it answers 0 to is counted as filtered.
     * pel_blob_shape_passes, or one of your own; NULL: nobody is asked. */
    pel_blob_accept *accept;
    const void *limits; /* handed to accept; not copied */

    /* The code behind the bits of `measure`: pel_blobs_measure. NULL: area, box, sum_x and sum_y
     * only, and a program that never names it does without that code. */
    pel_blobs_measurer *measurer;

    /* Reads the pixels for PEL_MEASURE_COLOR, which needs it: pel_crow_read_yuv for any format, or
     * one that links less (see pel_reader). */
    pel_reader *reader;

    pel_blob *results; /* the largest blobs, for pel_blobs_end; may be NULL if results_max is 0.
                          64 bytes each */
    uint32_t results_max;

    /* Called for every blob that passes, as soon as it is closed, from within pel_blobs_row or
     * pel_blobs_end; the blob is valid during the call. NULL: nobody is called. */
    void (*on_blob)(void *user, const pel_blob *blob);
    void *user; /* handed to on_blob */
} pel_blobs_config;

/* Counters of a frame, final after pel_blobs_end. Every coloured pixel of the frame is in exactly
 * one of: the blobs kept (with results_max 0: the blobs found), filtered_px, dropped_px, lost_px.
 */
typedef struct pel_blobs_counts {
    uint32_t found;       /* blobs that passed filter and accept */
    uint32_t dropped;     /* of those, not in `results` because it was full of larger ones */
    uint32_t dropped_px;  /* their pixels. With results_max 0 nothing counts as dropped */
    uint32_t filtered;    /* blobs that filter or accept stopped */
    uint32_t filtered_px; /* their pixels */
    uint32_t lost_px;    /* pixels of blobs that were not measured because open_max was too small */
    uint32_t lost_opens; /* how often a blob could not be opened; 0 means nothing was lost */
    uint16_t open_peak;  /* the most blobs that were open at once: what open_max needs to be */
} pel_blobs_counts;

/* The finder. The caller places it (136 bytes on 32-bit machines), zeroes it unless pel_blobs_begin
 * is the first to see it, and reads `counts`; the rest is private. */
typedef struct pel_blobs {
    pel_blobs_config config;
    pel_blobs_counts counts;
    struct pel_blob_slot *slots;
    uint32_t extra_step;   /* the name of a slot times this: where in work its other sums lie */
    pel_run *runs[2];      /* of the row above and of this row, which change places */
    uint16_t *ids[2];      /* the blob of each run */
    const uint8_t *labels; /* of the row before: they lie where the finder does not write */
    uint32_t results_count;
    uint16_t next_row;
    uint16_t free_slot;
    uint16_t united_slot;
    uint16_t open_count;
    uint8_t reach;
    uint8_t state;
    uint8_t losses;
    uint16_t ended_slot;
} pel_blobs;

/*
 * Starts a frame; any frame in progress is forgotten. The config is copied.
 *
 * PEL_ERR_ARG: null pointer, misaligned work, finder, work and results that overlap, connectivity
 * not 0, 4, 8, unknown measure bits or backend, a measure without measurer, colour without a
 * reader, open_max out of range.
 * PEL_ERR_RANGE: a side is 0 or over PEL_SIDE_MAX, or so large that a 32-bit sum could overflow
 * (width * width * height or width * height * height over 2^33: 1920 x 1080 and 2048 x 2048 are
 * allowed, 2592 x 1944 is not). PEL_ERR_SPACE: work_bytes too small.
 */
pel_status pel_blobs_begin(pel_blobs *blobs, const pel_blobs_config *config);

/*
 * Adds row y: `width` labels, and for PEL_MEASURE_COLOR the row of pixels that they were made from
 * (of the same colour width; RGB is read in the row's range; without colour ignored, may be NULL).
 * Both may be overwritten afterwards.
 *
 * PEL_TRUNCATED: done, but a blob of this row was lost for want of open blobs. PEL_ERR_ORDER: not
 * the row that is due; the frame goes on unharmed. PEL_ERR_ARG: null pointer, or labels in memory
 * that the finder writes. PEL_ERR_FORMAT: the pixels have another width; others as of
 * the reader.
 */
pel_status pel_blobs_row(pel_blobs *blobs, uint16_t y, const uint8_t *labels,
                         const pel_crow *pixels);

/*
 * Adds row y straight from its pixels: does what pel_classify_row and pel_blobs_row do, in fewer
 * steps. `labels` is scratch, colour width bytes: what it holds afterwards is of no use. For
 * PEL_MEASURE_COLOR, RGB is read in the range of the classifier.
 *
 * Statuses of these two; PEL_ERR_FORMAT also where the colour width is not that of the frame.
 */
pel_status pel_blobs_pixels(pel_blobs *blobs, uint16_t y, const pel_classifier *classifier,
                            const pel_crow *pixels, uint8_t *labels);

/*
 * Ends the frame: closes what is open and sorts the results, largest first (see pel_blobs_sort).
 * *count = how many results there are. PEL_TRUNCATED: blobs were lost or dropped, see `counts`.
 * PEL_ERR_ORDER: rows are missing; the frame goes on. PEL_ERR_ARG: null pointer.
 */
pel_status pel_blobs_end(pel_blobs *blobs, uint32_t *count);

/*
 * A whole frame: begin, classify and add every row, end. `labels` is scratch for one row, colour
 * width bytes; the size in `config` must be the colour size of the view. Statuses of the three
 * calls; also PEL_ERR_FORMAT where the view and the classifier do not fit, PEL_ERR_RANGE where
 * sizes differ.
 */
pel_status pel_blobs_frame(pel_blobs *blobs, const pel_blobs_config *config,
                           const pel_classifier *classifier, const pel_cview *view, uint8_t *labels,
                           uint32_t *count);

/* ---- Lists of blobs ------------------------------------------------------------------------ */

/* Sorts by area, largest first; then by y0, x0, class_index, sum_y, sum_x, smallest first. Heap
 * sort: n log n at worst, no memory. A NULL list is left alone. */
void pel_blobs_sort(pel_blob *blobs, uint32_t count);

/* `into` becomes the union of two blobs of disjoint pixels: sums, perimeter and holes add up, the
 * box grows, the mean colour is weighted by area, the class stays that of `into`. */
void pel_blob_merge(pel_blob *into, const pel_blob *from);

/*
 * CMVision's density merge: two blobs of a class become one where their common area is more than
 * density_q15 / 32768 of the box around both. The first such pair in the order of pel_blobs_sort is
 * merged, the list is sorted again, and so on until there is none. Returns the new count. Up to
 * count^3 comparisons of boxes: meant for tens of blobs.
 */
uint32_t pel_blobs_merge_density(pel_blob *blobs, uint32_t count, uint16_t density_q15);

/*
 * Margin merge: two blobs of a class become one where their boxes overlap after one of them has
 * grown by margin_px on every side; in the same order, and as often, as above. Returns the new
 * count.
 */
uint32_t pel_blobs_merge_margin(pel_blob *blobs, uint32_t count, uint16_t margin_px);

#ifdef __cplusplus
}
#endif

#endif
