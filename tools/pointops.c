#include "pointops.h"

#include <stdlib.h>
#include <string.h>

#include "say.h"

static int failed(const char *path, pel_status status)
{
    return say_error(path, "cannot be turned: %s", pel_status_name(status));
}

/* Room for a result of a size. */
static int room(pointops_job *job, const char *path, pel_format format, unsigned width,
                unsigned height)
{
    return frame_resize(&job->made, format, PEL_RANGE_FULL, width, height)
               ? say_error(path, "out of memory for %ux%u", width, height)
               : 0;
}

/* Writes what was made, if it was. */
static int put(pointops_job *job, const char *path, pel_status status)
{
    if (status != PEL_OK) {
        return failed(path, status);
    }
    const pel_cview made = pel_view_to_read(&job->made.view);
    return outlet_view(&job->turn.to, path, &made);
}

static unsigned channels_of(const pel_cview *picture)
{
    return picture->format == PEL_GRAY8 ? 1 : 3;
}

/* ---- Tables -------------------------------------------------------------------------------- */

static int count_luma(pointops_job *job, const char *path, const pel_cview *picture,
                      uint32_t bins[256])
{
    if (plain_make(path, picture, PLAIN_GRAY, &job->gray)) {
        return -1;
    }
    const pel_cview gray = pel_view_to_read(&job->gray.view);
    const pel_status status = pel_histogram_frame_with(&gray, 0, bins, job->backend);
    return status == PEL_OK ? 0 : failed(path, status);
}

int pointops_look_contrast(pointops_job *job, const char *path, const pel_cview *picture)
{
    uint32_t bins[256];
    int32_t pivot = job->pivot;
    if (pivot == PIVOT_MEAN) {
        pel_histogram_stats stats;
        if (count_luma(job, path, picture, bins)) {
            return -1;
        }
        const pel_status status = pel_histogram_measure(bins, &stats);
        if (status != PEL_OK) {
            return failed(path, status);
        }
        pivot = (int32_t)((stats.mean_q8 + 128) >> 8);
    }
    const pel_status status =
        pel_table_contrast(job->contrast_milli, 1000, (uint8_t)pivot, job->table);
    return status == PEL_OK ? 0 : failed(path, status);
}

int pointops_look_stretch(pointops_job *job, const char *path, const pel_cview *picture)
{
    uint32_t bins[256];
    uint8_t low;
    uint8_t high;
    if (count_luma(job, path, picture, bins)) {
        return -1;
    }
    pel_status status = pel_histogram_percentile(bins, job->low_permille, &low);
    if (status == PEL_OK) {
        status = pel_histogram_percentile(bins, job->high_permille, &high);
    }
    if (status == PEL_OK) {
        /* One gray only has nothing to stretch. */
        status = low < high ? pel_table_linear(255, -255 * low, high - low, job->table)
                            : pel_table_brightness(0, job->table);
    }
    return status == PEL_OK ? 0 : failed(path, status);
}

int pointops_look_otsu(pointops_job *job, const char *path, const pel_cview *picture)
{
    uint32_t bins[256];
    uint8_t threshold;
    if (count_luma(job, path, picture, bins)) {
        return -1;
    }
    pel_status status = pel_histogram_otsu(bins, &threshold);
    if (status == PEL_OK) {
        status = pel_table_threshold(threshold, job->table);
    }
    return status == PEL_OK ? 0 : failed(path, status);
}

int pointops_look_equalize(pointops_job *job, const char *path, const pel_cview *picture)
{
    uint32_t bins[256];
    if (count_luma(job, path, picture, bins)) {
        return -1;
    }
    const pel_status status = pel_table_equalize(bins, job->table);
    return status == PEL_OK ? 0 : failed(path, status);
}

int pointops_table(pointops_job *job, const char *path, const pel_cview *picture)
{
    if (job->look && job->look(job, path, picture)) {
        return -1;
    }
    if (room(job, path, picture->format, picture->width, picture->height)) {
        return -1;
    }
    return put(job, path, pel_table_frame_with(job->table, picture, &job->made.view, job->backend));
}

/* ---- Neighbours and sizes ------------------------------------------------------------------ */

int pointops_adaptive(pointops_job *job, const char *path, const pel_cview *picture)
{
    pel_adaptive_config config = {0};
    config.radius = job->radius;
    config.c = job->c;
    config.backend = job->backend;
    config.work_bytes = PEL_ADAPTIVE_BYTES(picture->width, job->radius);
    if (room(job, path, PEL_GRAY8, picture->width, picture->height)) {
        return -1;
    }
    config.work = malloc(config.work_bytes);
    if (!config.work) {
        return say_error(path, "out of memory");
    }
    const pel_status status = pel_adaptive_frame(&config, picture, &job->made.view);
    free(config.work);
    return put(job, path, status);
}

int pointops_resize(pointops_job *job, const char *path, const pel_cview *picture)
{
    pel_resize_config config = {0};
    config.method = job->method;
    config.backend = job->backend;
    config.channels = (uint8_t)channels_of(picture);
    config.width_in = picture->width;
    config.height_in = picture->height;
    config.width_out = (uint16_t)job->width;
    config.height_out = (uint16_t)job->height;
    config.work_bytes = pel_resize_bytes(&config);
    if (room(job, path, picture->format, job->width, job->height)) {
        return -1;
    }
    config.work = malloc(config.work_bytes);
    if (!config.work) {
        return say_error(path, "out of memory");
    }
    const pel_status status = pel_resize_frame(&config, picture, &job->made.view);
    free(config.work);
    if (status == PEL_ERR_RANGE) {
        return say_error(path,
                         "%ux%u does not divide into %ux%u by whole factors, as --box wants; use "
                         "--bilinear or --nearest",
                         picture->width, picture->height, job->width, job->height);
    }
    return put(job, path, status);
}

/* Sums from the top left corner grow to the last one, which becomes white. */
static void scale_sums(const uint32_t *sums, size_t stride, const pel_view *made)
{
    const uint32_t total = sums[(size_t)made->height * stride + made->width];
    for (unsigned y = 0; y < made->height; y++) {
        uint8_t *row = plain_row(made, y);
        for (unsigned x = 0; x < made->width; x++) {
            const uint64_t sum = sums[(y + 1) * stride + x + 1];
            row[x] = (uint8_t)(total ? (2 * 255 * sum + total) / (2 * (uint64_t)total) : 0);
        }
    }
}

int pointops_integral(pointops_job *job, const char *path, const pel_cview *picture)
{
    const uint32_t stride = (uint32_t)picture->width + 1;
    if (room(job, path, PEL_GRAY8, picture->width, picture->height)) {
        return -1;
    }
    uint32_t *sums = malloc(sizeof *sums * stride * ((size_t)picture->height + 1));
    if (!sums) {
        return say_error(path, "out of memory");
    }
    const pel_status status = pel_integral_frame_with(picture, sums, stride, job->backend);
    if (status == PEL_OK) {
        scale_sums(sums, stride, &job->made.view);
    }
    free(sums);
    if (status == PEL_ERR_RANGE) {
        return say_error(path, "a picture of %ux%u is too large: its sums go over 32 bits",
                         picture->width, picture->height);
    }
    return put(job, path, status);
}

/* ---- White balance ------------------------------------------------------------------------- */

static int find_gains(const pointops_job *job, const char *path, const pel_cview *picture,
                      uint16_t gains_q8[3])
{
    pel_rgb_sums sums;
    pel_cview part = *picture;
    const uint16_t *box = job->patch;
    if (job->has_patch &&
        pel_cview_crop(picture, box[0], box[2], box[1], box[3], &part) != PEL_OK) {
        return say_error(path, "the patch %u,%u,%u,%u is not inside of its %ux%u pixels", box[0],
                         box[1], box[2], box[3], picture->width, picture->height);
    }
    pel_status status = pel_rgb_sums_frame(&part, &sums);
    if (status == PEL_OK) {
        status = job->has_patch ? pel_gains_gray_patch(&sums, gains_q8)
                                : pel_gains_gray_world(&sums, gains_q8);
    }
    if (status == PEL_ERR_RANGE) {
        return say_error(path, "one of its channels is (nearly) black; that cannot be balanced");
    }
    return status == PEL_OK ? 0 : failed(path, status);
}

int pointops_balance(pointops_job *job, const char *path, const pel_cview *picture)
{
    uint16_t gains_q8[3];
    if (find_gains(job, path, picture, gains_q8) ||
        room(job, path, PEL_RGB888, picture->width, picture->height)) {
        return -1;
    }
    return put(job, path,
               pel_white_balance_frame_with(gains_q8, picture, &job->made.view, job->backend));
}

/* ---- Two pictures -------------------------------------------------------------------------- */

/* The picture of SECOND that belongs to the next frame of IN: the next one, or the only one. */
static int next_second(pointops_job *job)
{
    if (!job->other && !(job->other = source_open(job->second, &job->turn.input))) {
        return -1;
    }
    const int got = job->other_ended ? 0 : source_next(job->other, &job->second_raw);
    if (got < 0) {
        return -1;
    }
    job->others += got > 0;
    job->other_ended = got == 0;
    if (job->others == 0) {
        return say_error(job->second, "holds no picture");
    }
    if (job->other_ended && job->others > 1) {
        return say_error(job->second, "has %lu pictures, fewer than %s", job->others, job->turn.in);
    }
    return 0;
}

/* Both pictures in one format: colour if one of them has it. */
static int pair(pointops_job *job, const char *path, const pel_cview *picture, pel_cview *a,
                pel_cview *b)
{
    if (next_second(job)) {
        return -1;
    }
    const pel_cview second = pel_view_to_read(&job->second_raw.view);
    const int gray = job->turn.kind == PLAIN_GRAY ||
                     (picture->format == PEL_GRAY8 && second.format == PEL_GRAY8);
    const plain_kind kind = gray ? PLAIN_GRAY : PLAIN_RGB;
    if (plain_make(path, picture, kind, &job->first_plain) ||
        plain_make(job->second, &second, kind, &job->second_plain)) {
        return -1;
    }
    *a = pel_view_to_read(&job->first_plain.view);
    *b = pel_view_to_read(&job->second_plain.view);
    if (a->width != b->width || a->height != b->height) {
        return say_error(job->second, "has %ux%u pixels, but %s has %ux%u", b->width, b->height,
                         path, a->width, a->height);
    }
    return room(job, path, a->format, a->width, a->height);
}

int pointops_combine(pointops_job *job, const char *path, const pel_cview *picture)
{
    pel_cview a;
    pel_cview b;
    if (pair(job, path, picture, &a, &b)) {
        return -1;
    }
    return put(job, path,
               pel_combine_frame_with(job->combine, &a, &b, &job->made.view, job->backend));
}

int pointops_blend(pointops_job *job, const char *path, const pel_cview *picture)
{
    pel_cview a;
    pel_cview b;
    if (pair(job, path, picture, &a, &b)) {
        return -1;
    }
    return put(job, path,
               pel_blend_frame_with(job->alpha_q8, &a, &b, &job->made.view, job->backend));
}

void pointops_free(pointops_job *job)
{
    frame_free(&job->gray);
    frame_free(&job->second_raw);
    frame_free(&job->second_plain);
    frame_free(&job->first_plain);
    frame_free(&job->made);
    if (job->other) {
        source_close(job->other);
    }
}
