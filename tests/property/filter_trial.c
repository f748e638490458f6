#include "filter_trial.h"

#include <stdio.h>
#include <string.h>

enum { RUBBISH = 0x9D, UNTOUCHED = 0x6E };

static const char *const border_names[] = {"replicate", "symmetric", "reflect101",
                                           "wrap",      "constant",  "valid"};

const char *filter_trial_text(const filter_trial *trial)
{
    static char text[240];
    const pel_filter_config *config = &trial->config;
    int used =
        snprintf(text, sizeof text, "%ux%u %s %s constant %u %s", trial->picture.width,
                 trial->picture.height, ref_op_name(ref_op_of(config)),
                 border_names[config->border], config->constant, pel_backend_name(config->backend));
    if (ref_op_of(config) == REF_KERNEL) {
        const pel_kernel *k = config->kernel;
        snprintf(text + used, sizeof text - (size_t)used,
                 " radius %u divisor %u shift %u absolute %u bias %d tap %d %d %d ..", k->radius,
                 k->divisor, k->shift, k->absolute, k->bias, k->tap[0], k->tap[1], k->tap[2]);
    }
    return text;
}

int is_possible(const filter_trial *trial)
{
    const unsigned least =
        trial->config.border == PEL_BORDER_VALID ? 2 * ref_radius(&trial->config) + 1 : 1;
    return trial->picture.width >= least && trial->picture.height >= least;
}

const uint8_t *expected_u8(const filter_trial *trial)
{
    static uint8_t results[REF_RESULTS_MAX];
    ref_filter_u8(&trial->config, &trial->picture, results);
    return results;
}

const int16_t *expected_s16(const filter_trial *trial)
{
    static int16_t results[REF_RESULTS_MAX];
    ref_filter_s16(&trial->config, &trial->picture, results);
    return results;
}

layout random_layout(rng *random)
{
    layout l;
    l.padding = (uint16_t)(rng_below(random, 2) ? rng_below(random, 9) : 0);
    l.bottom_up = (uint8_t)rng_below(random, 2);
    l.offset = (uint8_t)rng_below(random, 4);
    return l;
}

static size_t work_bytes_of(const filter_trial *trial)
{
    return pel_filter_bytes(trial->picture.width, ref_radius(&trial->config), trial->config.border);
}

/* ---- Row by row ---------------------------------------------------------------------------- */

static guarded work_memory, row_memory, out_memory, last_memory[2];

/* Begins with a config and last rows that are gone when it returns. */
static int stream_begin(const filter_trial *trial, pel_filter *filter)
{
    pel_filter_config config = trial->config;
    const ref_picture *picture = &trial->picture;
    const unsigned radius = ref_radius(&config);
    pel_status status;
    config.width = picture->width;
    config.height = picture->height;
    config.work_bytes = work_bytes_of(trial);
    config.work = guarded_take(&work_memory, config.work_bytes, picture->width % 4, RUBBISH);
    for (unsigned i = 0; config.border == PEL_BORDER_WRAP && i < radius; i++) {
        const int64_t y = ref_place((int64_t)i - radius, picture->height, PEL_BORDER_WRAP);
        uint8_t *row = guarded_take(&last_memory[i], picture->width, i, RUBBISH);
        memcpy(row, picture->pixels + y * picture->width, picture->width);
        config.last_rows[i] = row;
    }
    status = pel_filter_begin(filter, &config);
    for (unsigned i = 0; config.border == PEL_BORDER_WRAP && i < radius; i++) {
        memset(last_memory[i].bytes, RUBBISH, picture->width);
    }
    memset(&config, RUBBISH, sizeof config);
    return check_that(status == PEL_OK, "%s: begin gave %d", filter_trial_text(trial), (int)status);
}

/* How many rows of the result are ready after `pushed` rows of the picture. */
static unsigned rows_ready(const filter_trial *trial, unsigned pushed)
{
    const unsigned radius = ref_radius(&trial->config);
    const unsigned height = trial->picture.height;
    if (trial->config.border == PEL_BORDER_VALID) {
        return pushed < 2 * radius ? 0 : pushed - 2 * radius;
    }
    return pushed == height ? height : pushed < radius ? 0 : pushed - radius;
}

static uint8_t *stream_push(const filter_trial *trial, pel_filter *filter, unsigned y, int shared)
{
    const uint16_t width = trial->picture.width;
    uint8_t *row = guarded_take(&row_memory, width, y % 3, RUBBISH);
    pel_status status;
    memcpy(row, trial->picture.pixels + (size_t)y * width, width);
    status = pel_filter_push(filter, row);
    check_that(status == PEL_OK, "%s: push of row %u gave %d", filter_trial_text(trial), y,
               (int)status);
    check_that(memcmp(row, trial->picture.pixels + (size_t)y * width, width) == 0,
               "%s: push changed its row", filter_trial_text(trial));
    memset(row, shared ? UNTOUCHED : RUBBISH, width);
    return row;
}

static void expect_push_refused(const filter_trial *trial, pel_filter *filter)
{
    const pel_status status = pel_filter_push(filter, trial->picture.pixels);
    check_that(status == PEL_ERR_ORDER, "%s: a push out of turn gave %d", filter_trial_text(trial),
               (int)status);
}

/* Pulls a row into `out`, as 8 or as 16 bits, and compares; at a time when it is ready. */
static void expect_row(const filter_trial *trial, pel_filter *filter, const void *expected,
                       int words, void *out)
{
    const size_t width = ref_width(&trial->config, &trial->picture);
    const size_t row_bytes = words ? 2 * width : width;
    const unsigned row = filter->row;
    const pel_status status =
        words ? pel_filter_pull_s16(filter, out) : pel_filter_pull(filter, out);
    if (!check_that(status == PEL_OK && filter->row == row + 1, "%s: pull of row %u gave %d",
                    filter_trial_text(trial), row, (int)status)) {
        return;
    }
    check_that(memcmp(out, (const uint8_t *)expected + row * row_bytes, row_bytes) == 0,
               "%s: row %u differs%s", filter_trial_text(trial), row, words ? " (16 bits)" : "");
}

static void expect_no_row(const filter_trial *trial, pel_filter *filter, int words, void *out,
                          size_t bytes)
{
    int untouched = 1;
    pel_status status;
    memset(out, UNTOUCHED, bytes);
    status = words ? pel_filter_pull_s16(filter, out) : pel_filter_pull(filter, out);
    for (size_t i = 0; i < bytes; i++) {
        untouched &= ((const uint8_t *)out)[i] == UNTOUCHED;
    }
    check_that(status == PEL_ERR_ORDER && untouched,
               "%s: a pull out of turn gave %d, output %suntouched", filter_trial_text(trial),
               (int)status, untouched ? "" : "not ");
}

static void verify_stream(const filter_trial *trial, const void *expected, int words, int shared)
{
    const size_t width = ref_width(&trial->config, &trial->picture);
    const size_t row_bytes = words ? 2 * width : width;
    pel_filter filter;
    if (!stream_begin(trial, &filter)) {
        return;
    }
    for (unsigned y = 0; y < trial->picture.height; y++) {
        uint8_t *row = stream_push(trial, &filter, y, shared);
        for (unsigned ready = rows_ready(trial, y + 1); filter.row < ready;) {
            const unsigned before = filter.row;
            void *out = shared ? row : guarded_take(&out_memory, row_bytes, 2, RUBBISH);
            expect_push_refused(trial, &filter);
            expect_row(trial, &filter, expected, words, out);
            if (filter.row == before) {
                return;
            }
        }
        expect_no_row(trial, &filter, words, guarded_take(&out_memory, row_bytes, 0, RUBBISH),
                      row_bytes);
        check_that(guarded_intact(&row_memory) && guarded_intact(&out_memory) &&
                       guarded_intact(&work_memory),
                   "%s: wrote outside", filter_trial_text(trial));
    }
    expect_push_refused(trial, &filter);
}

void verify_stream_u8(const filter_trial *trial, const uint8_t *expected, int shared)
{
    verify_stream(trial, expected, 0, shared);
}

void verify_stream_s16(const filter_trial *trial, const int16_t *expected)
{
    verify_stream(trial, expected, 1, 0);
}

/* ---- Whole frames -------------------------------------------------------------------------- */

/* A plane in guarded memory: elements of 1 or 2 bytes, rubbish between the rows. */
typedef struct plane {
    uint8_t *first; /* the top row */
    int32_t stride; /* elements */
    size_t element, width, height;
} plane;

static guarded from_memory, to_memory;

static plane plane_in(guarded *memory, size_t element, uint16_t width, uint16_t height, layout l)
{
    const size_t stride = (size_t)width + l.padding;
    uint8_t *base = guarded_take(memory, (stride * (height - 1u) + width) * element,
                                 l.offset * element, UNTOUCHED);
    plane p;
    p.first = l.bottom_up ? base + stride * (height - 1u) * element : base;
    p.stride = l.bottom_up ? -(int32_t)stride : (int32_t)stride;
    p.element = element;
    p.width = width;
    p.height = height;
    return p;
}

static uint8_t *plane_row(const plane *p, size_t y)
{
    return p->first + (ptrdiff_t)p->stride * (ptrdiff_t)(y * p->element);
}

static void draw_picture(const plane *p, const ref_picture *picture)
{
    for (size_t y = 0; y < picture->height; y++) {
        memcpy(plane_row(p, y), picture->pixels + y * picture->width, picture->width);
    }
}

/* Whether the upper left part of a plane holds these rows. */
static int holds(const plane *p, const void *rows, size_t width, size_t height)
{
    int same = 1;
    for (size_t y = 0; y < height; y++) {
        same &= memcmp(plane_row(p, y), (const uint8_t *)rows + y * width * p->element,
                       width * p->element) == 0;
    }
    return same;
}

static int padding_untouched(const plane *p, layout l)
{
    int untouched = 1;
    for (size_t y = 0; y < p->height; y++) {
        const int is_last_in_memory = y == (l.bottom_up ? 0 : p->height - 1);
        const uint8_t *padding = plane_row(p, y) + p->width * p->element;
        for (size_t i = 0; !is_last_in_memory && i < l.padding * p->element; i++) {
            untouched &= padding[i] == UNTOUCHED;
        }
    }
    return untouched;
}

static pel_cview view_to_read(const plane *p)
{
    pel_cview view;
    memset(&view, 0, sizeof view);
    view.plane[0] = p->first;
    view.stride_bytes[0] = p->stride;
    view.width = (uint16_t)p->width;
    view.height = (uint16_t)p->height;
    return view;
}

static pel_view view_to_write(const plane *p)
{
    pel_view view;
    memset(&view, 0, sizeof view);
    view.plane[0] = p->first;
    view.stride_bytes[0] = p->stride;
    view.width = (uint16_t)p->width;
    view.height = (uint16_t)p->height;
    return view;
}

/* A config with memory, and with a size and rows that a frame must not look at. */
static pel_filter_config frame_config(const filter_trial *trial, size_t work_bytes)
{
    pel_filter_config config = trial->config;
    config.width = 1;
    config.height = 60000u;
    config.last_rows[0] = config.last_rows[1] = NULL;
    config.work_bytes = work_bytes;
    config.work = guarded_take(&work_memory, work_bytes, trial->picture.height % 4, RUBBISH);
    return config;
}

static void expect_frame_done(const filter_trial *trial, pel_status status, const char *what)
{
    check_that(status == PEL_OK, "%s: %s gave %d", filter_trial_text(trial), what, (int)status);
    check_that(guarded_intact(&work_memory) && guarded_intact(&from_memory) &&
                   guarded_intact(&to_memory),
               "%s: %s wrote outside", filter_trial_text(trial), what);
}

static void expect_planes(const filter_trial *trial, const plane *from, const plane *to, layout l,
                          const void *expected)
{
    check_that(holds(to, expected, to->width, to->height), "%s: frame differs",
               filter_trial_text(trial));
    check_that(padding_untouched(to, l), "%s: wrote between the rows", filter_trial_text(trial));
    check_that(holds(from, trial->picture.pixels, from->width, from->height),
               "%s: changed its source", filter_trial_text(trial));
}

void verify_frame_u8(const filter_trial *trial, const uint8_t *expected, layout from, layout to)
{
    const ref_picture *picture = &trial->picture;
    const plane a = plane_in(&from_memory, 1, picture->width, picture->height, from);
    const plane b = plane_in(&to_memory, 1, ref_width(&trial->config, picture),
                             ref_height(&trial->config, picture), to);
    const pel_filter_config config = frame_config(trial, work_bytes_of(trial));
    const pel_cview source = view_to_read(&a);
    const pel_view target = view_to_write(&b);
    draw_picture(&a, picture);
    expect_frame_done(trial, pel_filter_frame(&config, &source, &target), "frame");
    expect_planes(trial, &a, &b, to, expected);
}

void verify_frame_s16(const filter_trial *trial, const int16_t *expected, layout from, layout to)
{
    const ref_picture *picture = &trial->picture;
    const plane a = plane_in(&from_memory, 1, picture->width, picture->height, from);
    const plane b = plane_in(&to_memory, 2, ref_width(&trial->config, picture),
                             ref_height(&trial->config, picture), to);
    const pel_filter_config config = frame_config(trial, work_bytes_of(trial));
    const pel_cview source = view_to_read(&a);
    draw_picture(&a, picture);
    expect_frame_done(trial,
                      pel_filter_frame_s16(&config, &source, (int16_t *)(void *)b.first, b.stride),
                      "frame of 16 bits");
    expect_planes(trial, &a, &b, to, expected);
}

/* What lies beside a smaller result keeps the picture's pixels. */
static int rest_is_kept(const plane *p, const ref_picture *picture, size_t width, size_t height)
{
    int kept = 1;
    for (size_t y = 0; y < picture->height; y++) {
        const size_t x = y < height ? width : 0;
        kept &= memcmp(plane_row(p, y) + x, picture->pixels + y * picture->width + x,
                       picture->width - x) == 0;
    }
    return kept;
}

void verify_frame_in_place(const filter_trial *trial, const uint8_t *expected, layout both)
{
    const ref_picture *picture = &trial->picture;
    const plane a = plane_in(&from_memory, 1, picture->width, picture->height, both);
    const pel_filter_config config = frame_config(trial, work_bytes_of(trial));
    const pel_cview source = view_to_read(&a);
    pel_view target = view_to_write(&a);
    target.width = ref_width(&trial->config, picture);
    target.height = ref_height(&trial->config, picture);
    draw_picture(&a, picture);
    (void)guarded_take(&to_memory, 1, 0, UNTOUCHED);
    expect_frame_done(trial, pel_filter_frame(&config, &source, &target), "frame in place");
    check_that(holds(&a, expected, target.width, target.height), "%s: frame in place differs",
               filter_trial_text(trial));
    check_that(padding_untouched(&a, both) &&
                   rest_is_kept(&a, picture, target.width, target.height),
               "%s: in place, wrote beside the result", filter_trial_text(trial));
}

/* ---- Twice --------------------------------------------------------------------------------- */

void verify_twice(const filter_trial *trial, ref_op first, ref_op second, layout from, layout to,
                  int in_place)
{
    static uint8_t between[REF_RESULTS_MAX], expected[REF_RESULTS_MAX];
    const ref_picture *picture = &trial->picture;
    const plane a = plane_in(&from_memory, 1, picture->width, picture->height, from);
    const plane b = in_place ? a : plane_in(&to_memory, 1, picture->width, picture->height, to);
    const pel_filter_config config = frame_config(
        trial, pel_filter_bytes(picture->width, ref_radius(&trial->config), trial->config.border));
    const pel_cview source = view_to_read(&a);
    const pel_view target = view_to_write(&b);
    filter_trial step = *trial, next = *trial;
    ref_set_op(&step.config, first);
    ref_filter_u8(&step.config, picture, between);
    ref_set_op(&next.config, second);
    next.picture.pixels = between;
    ref_filter_u8(&next.config, &next.picture, expected);
    draw_picture(&a, picture);
    expect_frame_done(&step,
                      pel_filter_twice(&config, step.config.op, next.config.op, &source, &target),
                      "twice");
    check_that(holds(&b, expected, b.width, b.height), "%s, then %s: differs",
               filter_trial_text(&step), ref_op_name(second));
    check_that(padding_untouched(&b, in_place ? from : to), "%s: twice wrote between the rows",
               filter_trial_text(&step));
}

/* ---- All ----------------------------------------------------------------------------------- */

void verify_all(const filter_trial *trial, rng *random)
{
    if (ref_has_bytes(&trial->config)) {
        const uint8_t *bytes = expected_u8(trial);
        verify_stream_u8(trial, bytes, 0);
        verify_stream_u8(trial, bytes, 1);
        verify_frame_u8(trial, bytes, random_layout(random), random_layout(random));
        verify_frame_in_place(trial, bytes, random_layout(random));
    }
    if (ref_has_words(&trial->config)) {
        const int16_t *words = expected_s16(trial);
        verify_stream_s16(trial, words);
        verify_frame_s16(trial, words, random_layout(random), random_layout(random));
    }
    check_count(1, 0);
}
