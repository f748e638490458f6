#include "benchruns.h"

#include <string.h>

#include "plain.h"

/* Room for a result, and its bytes. */
static int take_out(bench_job *job, size_t bytes)
{
    job->out = benchops_take(job, bytes);
    job->out_bytes = bytes;
    return job->out ? 0 : -1;
}

static int take_picture(bench_job *job, pel_format format, unsigned width, unsigned height)
{
    const uint32_t bytes = pel_frame_bytes(format, (uint16_t)width, (uint16_t)height);
    return take_out(job, bytes) || pel_view_init(job->out, format, PEL_RANGE_FULL, (uint16_t)width,
                                                 (uint16_t)height, 0, &job->out_view) != PEL_OK
               ? -1
               : 0;
}

static size_t pixels_of(const bench_job *job)
{
    return (size_t)job->in.width * job->in.height;
}

int benchruns_start_gray(bench_job *job)
{
    return take_picture(job, PEL_GRAY8, job->in.width, job->in.height);
}

/* ---- Classes, runs, blobs ------------------------------------------------------------------ */

static int start_classifier(bench_job *job)
{
    job->classifier.boxes = &job->picture->boxes;
    job->classifier.range = PEL_RANGE_FULL;
    job->classifier.plan = &job->plan;
    job->classifier.reader = pel_crow_read_yuv; /* of what is not YCbCr */
    job->classifier.pieces = pel_classify_pieces;
    return pel_classify_plan_make(&job->plan, &job->picture->boxes, job->backend) < 0 ? -1 : 0;
}

int benchruns_start_classify(bench_job *job)
{
    return start_classifier(job) ? -1 : benchruns_start_gray(job);
}

pel_status benchruns_classify(bench_job *job)
{
    return pel_classify_frame(&job->classifier, &job->in, &job->out_view);
}

int benchruns_start_runs(bench_job *job)
{
    return take_out(job, job->in.height * (PEL_RUNS_MAX(job->in.width) + 1u) * sizeof(pel_run));
}

pel_status benchruns_runs(bench_job *job)
{
    pel_run *runs = (pel_run *)(void *)job->out;
    for (uint16_t y = 0; y < job->in.height; y++) {
        const uint8_t *labels = job->in.plane[0] + (ptrdiff_t)y * job->in.stride_bytes[0];
        const uint16_t count = pel_find_runs(labels, job->in.width, runs + 1);
        runs[0].x0 = count;
        runs += count + 1;
    }
    return PEL_OK;
}

int benchruns_start_blobs(bench_job *job)
{
    pel_blobs_config *config = &job->blobs_config;
    const uint16_t width = job->in.width;
    const uint16_t open_max = (uint16_t)PEL_BLOBS_OPEN_SAFE(width);
    job->blob_filter.area_min = BENCH_BLOB_AREA_MIN;
    config->width = width;
    config->height = job->in.height;
    config->open_max = open_max;
    config->connectivity = 4;
    config->measure = (uint8_t)job->op->choice;
    config->measurer = config->measure != 0 ? pel_blobs_measure : NULL;
    config->work_bytes = pel_blobs_bytes(width, open_max, config->measure);
    config->work = benchops_take(job, config->work_bytes);
    config->filter = &job->blob_filter;
    config->results_max = (uint32_t)(pixels_of(job) / BENCH_BLOB_AREA_MIN) + 1;
    config->results = benchops_take(job, config->results_max * sizeof *config->results);
    job->label_row = benchops_take(job, width);
    return !config->work || !config->results || !job->label_row || start_classifier(job) ||
                   take_out(job, config->results_max * BENCH_BLOB_COLUMNS * sizeof(int64_t))
               ? -1
               : 0;
}

pel_status benchruns_blobs(bench_job *job)
{
    return pel_blobs_frame(&job->blobs, &job->blobs_config, &job->classifier, &job->in,
                           job->label_row, &job->count);
}

void benchruns_finish_blobs(bench_job *job)
{
    const pel_blob *blob = job->blobs_config.results;
    for (uint32_t i = 0; i < job->count; i++, blob++) {
        const int64_t row[BENCH_BLOB_COLUMNS] = {
            blob->class_index,
            blob->area,
            blob->x0,
            blob->y0,
            blob->x1,
            blob->y1,
            blob->sum_x,
            blob->sum_y,
            (int64_t)blob->sum_xx,
            (int64_t)blob->sum_xy,
            (int64_t)blob->sum_yy,
            blob->perimeter,
            blob->holes,
            blob->edges,
        };
        memcpy(job->out + i * sizeof row, row, sizeof row);
    }
    job->out_bytes = job->count * BENCH_BLOB_COLUMNS * sizeof(int64_t);
}

/* ---- Colours ------------------------------------------------------------------------------- */

int benchruns_start_three(bench_job *job)
{
    return take_picture(job, PEL_RGB888, job->in.width, job->in.height);
}

pel_status benchruns_planes(bench_job *job)
{
    const size_t pixels = pixels_of(job);
    pel_status status = PEL_OK;
    for (uint16_t y = 0; y < job->in.height && status == PEL_OK; y++) {
        const pel_crow row = pel_cview_row(&job->in, y);
        uint8_t *to = job->out + (size_t)y * job->in.width;
        status = pel_crow_read_yuv(&row, 0, job->in.width, PEL_RANGE_FULL, to, to + pixels,
                                   to + 2 * pixels);
    }
    return status;
}

/* OpenCV's YUYV has limited range. */
pel_status benchruns_rgb(bench_job *job)
{
    pel_status status = PEL_OK;
    for (uint16_t y = 0; y < job->in.height && status == PEL_OK; y++) {
        pel_crow row = pel_cview_row(&job->in, y);
        row.range = PEL_RANGE_LIMITED;
        status = pel_crow_read_rgb(&row, 0, job->in.width, plain_row(&job->out_view, y));
    }
    return status;
}

static const uint8_t *in_row(const bench_job *job, unsigned y)
{
    return job->in.plane[0] + (ptrdiff_t)y * job->in.stride_bytes[0];
}

pel_status benchruns_ycbcr(bench_job *job)
{
    pel_status status = PEL_OK;
    for (unsigned y = 0; y < job->in.height && status == PEL_OK; y++) {
        status = pel_rgb_to_ycbcr_row(in_row(job, y), plain_row(&job->out_view, y), job->in.width,
                                      PEL_RANGE_FULL);
    }
    return status;
}

pel_status benchruns_hsv(bench_job *job)
{
    pel_status status = PEL_OK;
    for (unsigned y = 0; y < job->in.height && status == PEL_OK; y++) {
        status = pel_rgb_to_hsv_row(in_row(job, y), plain_row(&job->out_view, y), job->in.width);
    }
    return status;
}

pel_status benchruns_nrgb(bench_job *job)
{
    pel_status status = PEL_OK;
    for (unsigned y = 0; y < job->in.height && status == PEL_OK; y++) {
        status =
            pel_rgb_to_nrgb_row(in_row(job, y), plain_row(&job->out_view, y), job->in.width, 0);
    }
    return status;
}

pel_status benchruns_white_balance(bench_job *job)
{
    static const uint16_t gains_q8[3] = {300, 256, 200};
    return pel_white_balance_frame_with(gains_q8, &job->in, &job->out_view, job->backend);
}

/* ---- Filters ------------------------------------------------------------------------------- */

static int start_filter(bench_job *job)
{
    pel_filter_config *config = &job->filter;
    config->op = job->op->filter;
    config->op_s16 = job->op->filter_s16;
    config->kernel = job->op->kernel ? pel_kernel_named(job->op->kernel) : NULL;
    config->backend = job->backend;
    config->work_bytes = PEL_FILTER_BYTES(job->in.width, 2);
    config->work = benchops_take(job, config->work_bytes);
    return config->work ? 0 : -1;
}

int benchruns_start_filter(bench_job *job)
{
    return start_filter(job) ? -1 : benchruns_start_gray(job);
}

int benchruns_start_filter_s16(bench_job *job)
{
    return start_filter(job) ? -1 : take_out(job, pixels_of(job) * sizeof(int16_t));
}

pel_status benchruns_filter(bench_job *job)
{
    return pel_filter_frame(&job->filter, &job->in, &job->out_view);
}

pel_status benchruns_filter_s16(bench_job *job)
{
    return pel_filter_frame_s16(&job->filter, &job->in, (int16_t *)(void *)job->out, job->in.width);
}

pel_status benchruns_filter_twice(bench_job *job)
{
    return pel_filter_twice(&job->filter, job->op->filter, job->op->then, &job->in, &job->out_view);
}

/* ---- Points -------------------------------------------------------------------------------- */

int benchruns_start_threshold(bench_job *job)
{
    return pel_table_threshold(127, job->table) != PEL_OK ? -1 : benchruns_start_gray(job);
}

int benchruns_start_gamma(bench_job *job)
{
    return pel_table_gamma_brighten(2, 1, job->table) != PEL_OK ? -1 : benchruns_start_gray(job);
}

pel_status benchruns_table(bench_job *job)
{
    return pel_table_frame_with(job->table, &job->in, &job->out_view, job->backend);
}

pel_status benchruns_equalize(bench_job *job)
{
    pel_status status = pel_histogram_frame_with(&job->in, 0, job->bins, job->backend);
    if (status == PEL_OK) {
        status = pel_table_equalize(job->bins, job->table);
    }
    return status == PEL_OK ? benchruns_table(job) : status;
}

/* "combine" as the others are named; nothing but room is taken. */
int benchruns_start_combine(bench_job *job)
{
    return benchruns_start_gray(job);
}

pel_status benchruns_combine(bench_job *job)
{
    return pel_combine_frame_with((pel_combine_op)job->op->choice, &job->in, &job->other,
                                  &job->out_view, job->backend);
}

pel_status benchruns_blend(bench_job *job)
{
    return pel_blend_frame_with(64, &job->in, &job->other, &job->out_view, job->backend);
}

int benchruns_start_adaptive(bench_job *job)
{
    enum { RADIUS = 7, C = 5 };
    job->adaptive.radius = RADIUS;
    job->adaptive.c = C;
    job->adaptive.backend = job->backend;
    job->adaptive.work_bytes = PEL_ADAPTIVE_BYTES(job->in.width, RADIUS);
    job->adaptive.work = benchops_take(job, job->adaptive.work_bytes);
    return job->adaptive.work ? benchruns_start_gray(job) : -1;
}

pel_status benchruns_adaptive(bench_job *job)
{
    return pel_adaptive_frame(&job->adaptive, &job->in, &job->out_view);
}

int benchruns_start_resize(bench_job *job)
{
    pel_resize_config *config = &job->resize;
    const int is_box = job->op->choice == PEL_RESIZE_BOX;
    const unsigned width = is_box ? job->in.width / 2u : job->in.width * 5u / 8u;
    const unsigned height = is_box ? job->in.height / 2u : job->in.height * 5u / 8u;
    config->method = (pel_resize_method)job->op->choice;
    config->channels = 1;
    config->backend = job->backend;
    config->width_in = job->in.width;
    config->height_in = job->in.height;
    config->width_out = (uint16_t)width;
    config->height_out = (uint16_t)height;
    config->work_bytes = pel_resize_bytes(config);
    config->work = benchops_take(job, config->work_bytes);
    return config->work ? take_picture(job, PEL_GRAY8, width, height) : -1;
}

pel_status benchruns_resize(bench_job *job)
{
    return pel_resize_frame(&job->resize, &job->in, &job->out_view);
}

int benchruns_start_histogram(bench_job *job)
{
    return take_out(job, 256 * sizeof(uint32_t));
}

pel_status benchruns_histogram(bench_job *job)
{
    return pel_histogram_frame_with(&job->in, 0, (uint32_t *)(void *)job->out, job->backend);
}

int benchruns_start_integral(bench_job *job)
{
    return take_out(job,
                    (job->in.width + (size_t)1) * (job->in.height + (size_t)1) * sizeof(uint32_t));
}

pel_status benchruns_integral(bench_job *job)
{
    return pel_integral_frame_with(&job->in, (uint32_t *)(void *)job->out, job->in.width + 1u,
                                   job->backend);
}

/* ---- Features ------------------------------------------------------------------------------ */

static void keep_responses(void *user, uint16_t y, const int32_t *responses)
{
    bench_job *job = user;
    const size_t bytes = job->in.width * sizeof *responses;
    memcpy(job->out + y * bytes, responses, bytes);
}

int benchruns_start_responses(bench_job *job)
{
    pel_corners_config *config = &job->corners_config;
    config->method = (pel_corners_method)job->op->choice;
    config->backend = job->backend;
    config->work_bytes = pel_corners_bytes(job->in.width, config->method);
    config->work = benchops_take(job, config->work_bytes);
    config->on_response = keep_responses;
    config->user = job;
    return config->work ? take_out(job, pixels_of(job) * sizeof(int32_t)) : -1;
}

pel_status benchruns_responses(bench_job *job)
{
    return pel_corners_frame(&job->corners, &job->corners_config, &job->in, &job->count);
}

int benchruns_start_canny(bench_job *job)
{
    job->canny.backend = job->backend;
    job->canny.low = 100;
    job->canny.high = 200;
    job->canny.work_bytes = PEL_CANNY_BYTES(job->in.width);
    job->canny.work = benchops_take(job, job->canny.work_bytes);
    job->count = (uint32_t)pixels_of(job);
    job->stack = benchops_take(job, job->count * sizeof(pel_place));
    return job->canny.work && job->stack ? benchruns_start_gray(job) : -1;
}

pel_status benchruns_canny(bench_job *job)
{
    const pel_status status = pel_canny_frame(&job->canny, &job->in, &job->out_view);
    return status == PEL_OK ? pel_canny_hysteresis(&job->out_view, job->stack, job->count) : status;
}
