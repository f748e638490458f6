#include "finder.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A blob that the callback saw, and during which call: a row, or the map's height for the end. */
typedef struct sighting {
    pel_blob blob;
    uint32_t during;
} sighting;

/* Everything that one frame produced. */
static struct {
    sighting seen[REF_PIXELS_MAX + 1];
    pel_blob found[REF_PIXELS_MAX + 1];  /* what the callback saw, sorted */
    pel_blob kept[REF_PIXELS_MAX + 1];   /* what the results hold, as they came */
    uint8_t matched[REF_PIXELS_MAX + 1]; /* per expected blob: it was found */
    uint32_t seen_count, found_count, kept_count;
    uint32_t during;
    uint32_t truncated_rows;
    pel_status status;
    pel_blobs_counts counts;
} got;

static guarded work_memory, results_memory, labels_memory, pixels_memory;

const char *trial_text(const setup *trial)
{
    static char text[512];
    const uint32_t pixels = (uint32_t)trial->map.width * trial->map.height;
    size_t length =
        (size_t)snprintf(text, sizeof text, "[%ux%u conn %u open %u results %u measure %u",
                         trial->map.width, trial->map.height, trial->connectivity, trial->open_max,
                         (unsigned)trial->results_max, trial->measure);
    uint32_t i;
    if (pixels <= 64) {
        for (i = 0; i < pixels; i++) {
            length += (size_t)snprintf(text + length, sizeof text - length, "%s%x",
                                       i % trial->map.width == 0 ? " " : "", trial->map.labels[i]);
        }
    }
    snprintf(text + length, sizeof text - length, "]");
    return text;
}

static const char *blob_text(const pel_blob *blob)
{
    static char text[320];
    snprintf(text, sizeof text,
             "class %u area %u box %u..%u x %u..%u sums %u %u second %llu %llu %llu perimeter %u "
             "holes %u edges %u mean %u %u %u",
             blob->class_index, (unsigned)blob->area, blob->x0, blob->x1, blob->y0, blob->y1,
             (unsigned)blob->sum_x, (unsigned)blob->sum_y, (unsigned long long)blob->sum_xx,
             (unsigned long long)blob->sum_xy, (unsigned long long)blob->sum_yy,
             (unsigned)blob->perimeter, (unsigned)blob->holes, blob->edges, blob->mean_y,
             blob->mean_u, blob->mean_v);
    return text;
}

/* ---- Expectation --------------------------------------------------------------------------- */

expectation expect(const ref_map *map, int connectivity, unsigned measure, const uint8_t *yuv)
{
    static pel_blob blobs[REF_PIXELS_MAX];
    expectation expected;
    uint32_t i;
    expected.count = ref_find(map, connectivity, yuv, blobs);
    expected.coloured_px = ref_coloured(map);
    expected.blobs = blobs;
    for (i = 0; i < expected.count; i++) {
        ref_forget_unmeasured(&blobs[i], measure);
    }
    qsort(blobs, expected.count, sizeof blobs[0], ref_compare_all);
    check_count(1, expected.count);
    return expected;
}

setup setup_safe(const ref_map *map, int connectivity)
{
    setup trial;
    memset(&trial, 0, sizeof trial);
    trial.map = *map;
    trial.connectivity = (uint8_t)connectivity;
    trial.measure = PEL_MEASURE_MOMENTS | PEL_MEASURE_OUTLINE;
    trial.open_max = PEL_BLOBS_OPEN_SAFE(map->width);
    trial.results_max = (uint32_t)map->width * map->height;
    return trial;
}

/* ---- Running the finder -------------------------------------------------------------------- */

static void remember(void *user, const pel_blob *blob)
{
    (void)user;
    if (got.seen_count < REF_PIXELS_MAX) {
        got.seen[got.seen_count].blob = *blob;
        got.seen[got.seen_count].during = got.during;
    }
    got.seen_count++;
}

static void configure(const setup *trial, pel_blobs_config *config)
{
    memset(config, 0, sizeof *config);
    config->width = trial->map.width;
    config->height = trial->map.height;
    config->open_max = trial->open_max;
    config->connectivity = trial->connectivity;
    config->measure = trial->measure;
    config->work_bytes = PEL_BLOBS_BYTES(trial->map.width, trial->open_max, trial->measure);
    config->work = guarded_take(&work_memory, config->work_bytes, 0, 0xA5);
    config->filter = trial->filter;
    config->accept = trial->shape != NULL ? pel_blob_shape_passes : NULL;
    config->limits = trial->shape;
    /* Area, box and sums alone: both ways to them. */
    config->measurer = trial->measure != 0 || trial->map.width % 2 == 0 ? pel_blobs_measure : NULL;
    config->reader = pel_crow_read_yuv;
    config->results = guarded_take(&results_memory, trial->results_max * sizeof(pel_blob), 0, 0x5A);
    config->results_max = trial->results_max;
    if (trial->results_max == 0) {
        config->results = NULL;
    }
    config->on_blob = trial->silent ? NULL : remember;
}

/* The row of pixels, in a buffer of its own that does not outlive the call. */
static const pel_crow *pixel_row(const picture *pixels, uint16_t y, pel_crow *row)
{
    uint8_t *copy;
    if (pixels == NULL) {
        return NULL;
    }
    copy = guarded_take(&pixels_memory, pixels->row_bytes, 0, 0);
    memcpy(copy, pixels->bytes + y * pixels->row_bytes, pixels->row_bytes);
    memset(row, 0, sizeof *row);
    row->plane[0] = copy;
    row->width = pixels->width;
    row->format = pixels->format;
    row->range = pixels->range;
    return row;
}

static void feed_row(pel_blobs *blobs, const setup *trial, uint16_t y)
{
    const size_t width = trial->map.width;
    pel_crow row;
    uint8_t *labels = guarded_take(&labels_memory, width, y % 8u, 0);
    const pel_crow *pixels = pixel_row(trial->pixels, y, &row);
    pel_status status;
    memcpy(labels, trial->map.labels + y * width, width);
    status = pel_blobs_row(blobs, y, labels, pixels);
    check_that(status == PEL_OK || status == PEL_TRUNCATED, "row %u: status %d %s", y, (int)status,
               trial_text(trial));
    check_that(memcmp(labels, trial->map.labels + y * width, width) == 0,
               "labels of row %u changed", y);
    got.truncated_rows += status == PEL_TRUNCATED;
    memset(labels, 0xFF, width);
    if (pixels != NULL) {
        memset(pixels_memory.bytes, 0xFF, pixels_memory.size);
    }
}

static void run_frame(const setup *trial)
{
    pel_blobs blobs;
    pel_blobs_config config;
    uint32_t count = 0xFFFFFFFFu;
    pel_status status;
    uint16_t y;
    got.seen_count = 0;
    got.truncated_rows = 0;
    configure(trial, &config);
    memset(&blobs, 0xEE, sizeof blobs);
    status = pel_blobs_begin(&blobs, &config);
    check_that(status == PEL_OK, "begin: status %d %s", (int)status, trial_text(trial));
    for (y = 0; y < trial->map.height; y++) {
        got.during = y;
        feed_row(&blobs, trial, y);
    }
    got.during = y;
    got.status = pel_blobs_end(&blobs, &count);
    got.counts = blobs.counts;
    check_that(count <= trial->results_max, "%u results in room for %u %s", (unsigned)count,
               (unsigned)trial->results_max, trial_text(trial));
    got.kept_count = count <= trial->results_max ? count : 0;
    if (got.kept_count > 0) {
        memcpy(got.kept, config.results, got.kept_count * sizeof(pel_blob));
    }
    check_that(guarded_intact(&work_memory), "wrote outside work %s", trial_text(trial));
    check_that(guarded_intact(&results_memory), "wrote outside results %s", trial_text(trial));
}

/* ---- Comparing ----------------------------------------------------------------------------- */

/* Every found blob is another of the expected ones, every field; returns the area found. */
static uint64_t match_found(const setup *trial, const expectation *expected)
{
    uint64_t area = 0;
    uint32_t i;
    uint32_t j = 0;
    memset(got.matched, 0, expected->count);
    for (i = 0; i < got.found_count; i++) {
        const pel_blob *blob = &got.found[i];
        while (j < expected->count && ref_compare_all(&expected->blobs[j], blob) < 0) {
            j++;
        }
        if (check_that(j < expected->count && ref_compare_all(&expected->blobs[j], blob) == 0,
                       "not a blob of the map: %s %s", blob_text(blob), trial_text(trial))) {
            got.matched[j] = 1;
            j++;
        }
        area += blob->area;
    }
    return area;
}

/* A blob is reported while the row below it is added, or by the end of the frame; never later. */
static void check_moments_of_calls(const setup *trial)
{
    uint32_t i;
    for (i = 0; i < got.seen_count; i++) {
        check_that(got.seen[i].during == got.seen[i].blob.y1, "reported during row %u: %s %s",
                   (unsigned)got.seen[i].during, blob_text(&got.seen[i].blob), trial_text(trial));
    }
}

static void gather_found(const setup *trial)
{
    uint32_t i;
    if (trial->silent) {
        got.found_count = got.kept_count;
        memcpy(got.found, got.kept, got.kept_count * sizeof got.kept[0]);
    } else {
        check_that(got.seen_count <= REF_PIXELS_MAX, "%u callbacks", (unsigned)got.seen_count);
        got.found_count = got.seen_count <= REF_PIXELS_MAX ? got.seen_count : REF_PIXELS_MAX;
        for (i = 0; i < got.found_count; i++) {
            got.found[i] = got.seen[i].blob;
        }
        check_moments_of_calls(trial);
    }
    qsort(got.found, got.found_count, sizeof got.found[0], ref_compare_all);
}

/* The results are the first of the found blobs in the documented order, in that order. */
static void check_kept(const setup *trial, uint64_t found_px)
{
    static pel_blob sorted[REF_PIXELS_MAX + 1];
    const pel_blobs_counts *counts = &got.counts;
    const uint32_t most =
        got.found_count < trial->results_max ? got.found_count : trial->results_max;
    const uint32_t missing = trial->results_max == 0 ? 0 : got.found_count - most;
    uint64_t kept_px = 0;
    uint32_t i;
    uint32_t j = 0;
    check_that(got.kept_count == most, "%u results, not %u %s", (unsigned)got.kept_count,
               (unsigned)most, trial_text(trial));
    memcpy(sorted, got.kept, got.kept_count * sizeof sorted[0]);
    qsort(sorted, got.kept_count, sizeof sorted[0], ref_compare_all);
    for (i = 0; i < got.kept_count; i++) {
        check_that(ref_compare_documented(&got.kept[i], &got.found[i]) == 0, "result %u is %s %s",
                   (unsigned)i, blob_text(&got.kept[i]), trial_text(trial));
        while (j < got.found_count && ref_compare_all(&got.found[j], &sorted[i]) < 0) {
            j++;
        }
        check_that(j < got.found_count && ref_compare_all(&got.found[j], &sorted[i]) == 0,
                   "result that was not found: %s %s", blob_text(&sorted[i]), trial_text(trial));
        j++;
        kept_px += got.kept[i].area;
    }
    check_that(counts->dropped == missing, "dropped %u, not %u %s", (unsigned)counts->dropped,
               (unsigned)missing, trial_text(trial));
    check_that(counts->dropped_px == (trial->results_max == 0 ? 0 : found_px - kept_px),
               "dropped_px %u %s", (unsigned)counts->dropped_px, trial_text(trial));
}

/* Which expected blobs are missing, and whether filter and loss account for exactly those. */
static void check_missing(const setup *trial, const expectation *expected)
{
    const pel_blobs_counts *counts = &got.counts;
    uint64_t missing_px = 0;
    uint32_t missing = 0;
    uint32_t i;
    for (i = 0; i < expected->count; i++) {
        const pel_blob *blob = &expected->blobs[i];
        int passes = ref_shape_passes(blob, trial->shape);
        if (passes < 0) {
            passes = pel_blob_shape_passes(trial->shape, blob);
        }
        passes = passes && ref_passes(blob, trial->filter);
        check_that(passes || !got.matched[i], "should not pass: %s %s", blob_text(blob),
                   trial_text(trial));
        check_that(!passes || got.matched[i] || counts->lost_opens > 0, "missing: %s %s",
                   blob_text(blob), trial_text(trial));
        if (!got.matched[i]) {
            missing++;
            missing_px += blob->area;
        }
    }
    check_that(missing_px == (uint64_t)counts->filtered_px + counts->lost_px,
               "%u px missing, %u filtered, %u lost %s", (unsigned)missing_px,
               (unsigned)counts->filtered_px, (unsigned)counts->lost_px, trial_text(trial));
    if (counts->lost_opens == 0) {
        check_that(counts->filtered == missing, "filtered %u, not %u %s",
                   (unsigned)counts->filtered, (unsigned)missing, trial_text(trial));
    }
    /* Every lost blob failed to open at least once, and every failure is one of its runs. */
    check_that(missing - (uint64_t)counts->filtered <= counts->lost_opens &&
                   counts->lost_opens <= counts->lost_px,
               "lost_opens %u for %u blobs of %u px %s", (unsigned)counts->lost_opens,
               (unsigned)(missing - counts->filtered), (unsigned)counts->lost_px,
               trial_text(trial));
}

static void check_counts(const setup *trial, const expectation *expected, uint64_t found_px)
{
    const pel_blobs_counts *counts = &got.counts;
    const int incomplete = counts->lost_opens > 0 || counts->dropped > 0;
    check_that(counts->found == got.found_count, "found %u, not %u %s", (unsigned)counts->found,
               (unsigned)got.found_count, trial_text(trial));
    check_that(found_px + counts->filtered_px + counts->lost_px == expected->coloured_px,
               "%u + %u + %u px of %u %s", (unsigned)found_px, (unsigned)counts->filtered_px,
               (unsigned)counts->lost_px, (unsigned)expected->coloured_px, trial_text(trial));
    check_that(got.status == (incomplete ? PEL_TRUNCATED : PEL_OK), "end: status %d %s",
               (int)got.status, trial_text(trial));
    check_that((counts->lost_px > 0) == (counts->lost_opens > 0) &&
                   (got.truncated_rows > 0) == (counts->lost_opens > 0),
               "lost %u px, %u opens, %u rows truncated %s", (unsigned)counts->lost_px,
               (unsigned)counts->lost_opens, (unsigned)got.truncated_rows, trial_text(trial));
    check_that(counts->open_peak <= trial->open_max &&
                   counts->open_peak <= PEL_BLOBS_OPEN_SAFE(trial->map.width) &&
                   (counts->open_peak > 0) == (expected->count > 0),
               "open_peak %u %s", counts->open_peak, trial_text(trial));
    if (trial->open_max >= PEL_BLOBS_OPEN_SAFE(trial->map.width)) {
        check_that(counts->lost_opens == 0, "lost at the never-lose size %s", trial_text(trial));
    }
}

pel_blobs_counts verify(const setup *trial, const expectation *expected)
{
    uint64_t found_px;
    run_frame(trial);
    gather_found(trial);
    found_px = match_found(trial, expected);
    check_kept(trial, found_px);
    check_missing(trial, expected);
    check_counts(trial, expected, found_px);
    return got.counts;
}

/* ---- Shape --------------------------------------------------------------------------------- */

static void verify_axes(const pel_blob *blob)
{
    const int angle = pel_blob_angle_turn16(blob);
    const int roundness = pel_blob_roundness_q15(blob);
    const long double off = fabsl((long double)roundness - ref_roundness_q15(blob));
    check_that(angle >= -16384 && angle < 16384, "angle %d: %s", angle, blob_text(blob));
    if (ref_has_axis(blob)) {
        /* An axis has no arrow: angles half a turn apart are the same. */
        const long double turned = fabsl((long double)angle - ref_angle_turn16(blob));
        check_that(fminl(turned, fabsl(turned - 32768)) <= 1.0L, "angle %d, not %.3Lf: %s", angle,
                   ref_angle_turn16(blob), blob_text(blob));
    } else {
        check_that(angle == 0 && roundness == 32767, "no axis, but angle %d roundness %d: %s",
                   angle, roundness, blob_text(blob));
    }
    check_that(roundness <= 32767 && off <= 4.0L, "roundness %d, not %.3Lf: %s", roundness,
               ref_roundness_q15(blob), blob_text(blob));
    check_that(pel_blob_elongation_q15(blob) == 32767 - roundness, "elongation %u: %s",
               pel_blob_elongation_q15(blob), blob_text(blob));
}

void verify_shape(const pel_blob *blob, unsigned measure)
{
    int32_t x_q16 = -1;
    int32_t y_q16 = -1;
    pel_blob_centroid_q16(blob, &x_q16, &y_q16);
    check_that(x_q16 == ref_centroid_q16(blob->sum_x, blob->area) &&
                   y_q16 == ref_centroid_q16(blob->sum_y, blob->area),
               "centroid %ld %ld: %s", (long)x_q16, (long)y_q16, blob_text(blob));
    check_that(pel_blob_density_q15(blob) == ref_density_q15(blob), "density %u: %s",
               pel_blob_density_q15(blob), blob_text(blob));
    if ((measure & PEL_MEASURE_MOMENTS) != 0) {
        verify_axes(blob);
    }
    if ((measure & PEL_MEASURE_OUTLINE) != 0) {
        const long double compactness = ref_compactness_q15(blob);
        check_that(fabsl((long double)pel_blob_compactness_q15(blob) - compactness) <= 1.0L,
                   "compactness %u, not %.3Lf: %s", pel_blob_compactness_q15(blob), compactness,
                   blob_text(blob));
    } else {
        check_that(pel_blob_compactness_q15(blob) == 0, "compactness without outline: %s",
                   blob_text(blob));
    }
}
