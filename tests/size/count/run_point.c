/* Tables, histograms, thresholds, sums, sizes, white balance. */
#include "count.h"

static uint8_t table[256];
static int32_t choice, other;

/* Histograms lie in `work`. */
static uint32_t *bins(void)
{
    return (uint32_t *)work;
}

static void remember(const job *j)
{
    choice = j->choice;
    other = j->other;
}

/* ---- Tables --------------------------------------------------------------------------------- */

static uint32_t end_table(const job *j)
{
    switch (j->choice) {
    case 0:
        done(pel_table_linear(13, 400, 10, table));
        break;
    case 1:
        done(pel_table_contrast(13, 10, 128, table));
        break;
    default:
        done(pel_table_gamma_brighten(22, 10, table));
        break;
    }
    return 0;
}

const family table_fill = {.end = end_table};

static void begin_threshold(const job *j)
{
    (void)j;
    done(pel_table_threshold(127, table));
}

static uint32_t push_table(uint16_t y)
{
    (void)y;
    done(pel_table_row(table, row.bytes, WIDTH, output_bytes()));
    return WIDTH;
}

const family table_row = {.begin = begin_threshold, .push = push_table};

/* ---- Histograms ----------------------------------------------------------------------------- */

static void begin_histogram(const job *j)
{
    (void)j;
    for (unsigned i = 0; i < 256; i++) {
        bins()[i] = 0;
    }
}

static uint32_t push_histogram(uint16_t y)
{
    (void)y;
    done(pel_histogram_row(row.bytes, 1, WIDTH, bins()));
    return 0;
}

static uint32_t end_otsu(const job *j)
{
    (void)j;
    done(pel_histogram_otsu(bins(), output_bytes()));
    return 1;
}

static uint32_t end_equalize(const job *j)
{
    (void)j;
    done(pel_table_equalize(bins(), output_bytes()));
    return 256;
}

const family histogram_row = {.begin = begin_histogram, .push = push_histogram};
const family otsu = {.begin = begin_histogram, .push = push_histogram, .end = end_otsu};
const family equalize = {.begin = begin_histogram, .push = push_histogram, .end = end_equalize};

/* ---- Two rows, sums ------------------------------------------------------------------------- */

static uint32_t push_combine(uint16_t y)
{
    (void)y;
    done(pel_combine_row((pel_combine_op)choice, row.bytes, row.bytes + WIDTH, WIDTH,
                         output_bytes()));
    return WIDTH;
}

static uint32_t push_blend(uint16_t y)
{
    (void)y;
    done(pel_blend_row(100, row.bytes, row.bytes + WIDTH, WIDTH, output_bytes()));
    return WIDTH;
}

static uint32_t push_integral(uint16_t y)
{
    done(pel_integral_row(row.bytes, WIDTH, y == 0 ? NULL : output_row, output_row));
    return sizeof(uint32_t) * (WIDTH + 1u);
}

const family combine_row = {.begin = remember, .push = push_combine};
const family blend_row = {.push = push_blend};
const family integral_row = {.push = push_integral};

/* ---- Adaptive threshold, resizing ----------------------------------------------------------- */

static pel_adaptive adaptive;
static pel_resize resize;

static void begin_adaptive(const job *j)
{
    const pel_adaptive_config config = {.width = WIDTH,
                                        .height = HEIGHT,
                                        .radius = (uint8_t)j->choice,
                                        .c = 5,
                                        .work = work,
                                        .work_bytes = WORK_BYTES};
    done(pel_adaptive_begin(&adaptive, &config));
}

static uint32_t push_adaptive(uint16_t y)
{
    (void)y;
    done(pel_adaptive_push(&adaptive, row.bytes));
    return 0;
}

static uint32_t pull_adaptive(void)
{
    return pel_adaptive_pull(&adaptive, output_bytes()) == PEL_OK ? WIDTH : 0u;
}

static uint32_t look_at_adaptive(void)
{
    return adaptive.row;
}

const family adaptive_row = {.begin = begin_adaptive,
                             .push = push_adaptive,
                             .pull = pull_adaptive,
                             .look = look_at_adaptive};

/* choice: the method; other: the width of the result, in the shape of the picture. */
static void begin_resize(const job *j)
{
    const pel_resize_config config = {.method = (pel_resize_method)j->choice,
                                      .width_in = WIDTH,
                                      .height_in = HEIGHT,
                                      .width_out = (uint16_t)j->other,
                                      .height_out = (uint16_t)(j->other * HEIGHT / WIDTH),
                                      .work = work,
                                      .work_bytes = WORK_BYTES};
    remember(j);
    done(pel_resize_begin(&resize, &config));
}

static uint32_t push_resize(uint16_t y)
{
    (void)y;
    done(pel_resize_push(&resize, row.bytes));
    return 0;
}

static uint32_t pull_resize(void)
{
    return pel_resize_pull(&resize, output_bytes()) == PEL_OK ? (uint32_t)other : 0u;
}

static uint32_t look_at_resize(void)
{
    return resize.row;
}

const family resize_row = {
    .begin = begin_resize, .push = push_resize, .pull = pull_resize, .look = look_at_resize};

/* ---- White balance -------------------------------------------------------------------------- */

static pel_rgb_sums sums;

static void begin_sums(const job *j)
{
    (void)j;
    sums = (pel_rgb_sums){{0, 0, 0}, 0};
}

static uint32_t push_sums(uint16_t y)
{
    (void)y;
    done(pel_rgb_sums_row(row.bytes, WIDTH, &sums));
    return 0;
}

static uint32_t end_sums(const job *j)
{
    (void)j;
    done(pel_gains_gray_world(&sums, (uint16_t *)output_row));
    return 3 * sizeof(uint16_t);
}

static uint32_t push_balance(uint16_t y)
{
    static const uint16_t gains_q8[3] = {300, 256, 410};
    (void)y;
    done(pel_white_balance_row(gains_q8, row.bytes, WIDTH, output_bytes()));
    return 3 * WIDTH;
}

const family sums_row = {.begin = begin_sums, .push = push_sums, .end = end_sums};
const family balance_row = {.push = push_balance};
