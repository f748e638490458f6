#include "fit.h"

#include <stdlib.h>

#include "pack.h"

/* Rows are looked at in bands that hold two rows of 4:2:0 chroma and two of Bayer cells. */
enum { BAND_ROWS = 4, BANDS_MAX = 80, REST_MAX = 511 };

/* What predictions leave of a channel: to the left [0], above [1]. */
typedef struct channel {
    uint64_t sum[2], count[2];
} channel;

/* Ways to predict a channel of RGB: by itself, by the green of the same pixel, and by how green
 * changes. */
enum { BY_ITSELF, BY_GREEN, BY_CHANGE_OF_GREEN, WAYS };

typedef struct work {
    uint32_t cost[REST_MAX + 1];
    const pel_cview *view;
    unsigned half_bytes; /* twice the bytes of a pixel */
    unsigned rows;       /* in the band */
    channel luma, chroma[2];
    channel green, other[2][WAYS];              /* of red, of blue */
    channel lattice[4];                         /* of a Bayer mosaic */
    uint8_t sample[4][BAND_ROWS][PEL_SIDE_MAX]; /* 3: green in the steps of red and blue */
    uint8_t rgb[3 * PEL_SIDE_MAX];
} work;

/* log2(1 + 2 rest) in thousandths, straight between powers of two. */
static uint32_t milli_log(unsigned rest)
{
    const unsigned value = 1 + 2 * rest;
    unsigned power = 1;
    uint32_t bits = 0;
    for (; 2 * power <= value; power *= 2) {
        bits++;
    }
    return 1000 * bits + 1000 * (value - power) / power;
}

static void count_rest(const work *job, channel *of, int direction, int rest)
{
    const unsigned size = (unsigned)(rest < 0 ? -rest : rest);
    of->sum[direction] += job->cost[size < REST_MAX ? size : REST_MAX];
    of->count[direction]++;
}

/* The mean over both directions in thousandths of a bit. */
static uint64_t mean_cost(const channel *of)
{
    uint64_t sum = 0;
    uint64_t directions = 0;
    for (int i = 0; i < 2; i++) {
        if (of->count[i] > 0) {
            sum += of->sum[i] / of->count[i];
            directions++;
        }
    }
    return directions ? sum / directions : 0;
}

/* ---- YCbCr and gray ------------------------------------------------------------------------ */

/* A channel of the band that has a sample for every `step`th column and `down`th row. */
static void predict(const work *job, unsigned plane, unsigned step, unsigned down, channel *of)
{
    for (unsigned y = 0; y < job->rows; y += down) {
        const uint8_t *row = job->sample[plane][y];
        for (unsigned x = step; x < job->view->width; x += step) {
            count_rest(job, of, 0, row[x] - row[x - step]);
        }
        for (unsigned x = 0; y >= down && x < job->view->width; x += step) {
            count_rest(job, of, 1, row[x] - job->sample[plane][y - down][x]);
        }
    }
}

/* Whether a colour lies outside of RGB by more than rounding; luma counts from its black. */
static int is_impossible(int luma, int u, int v, pel_range range)
{
    enum { ROUNDING = 3000 }; /* thousandths */
    const int is_limited = range == PEL_RANGE_LIMITED;
    const int gray = (luma - (is_limited ? 16 : 0)) * 255000 / (is_limited ? 219 : 255);
    const int blue_side = (u - 128) * 255000 / (is_limited ? 224 : 255);
    const int red_side = (v - 128) * 255000 / (is_limited ? 224 : 255);
    const int channels[3] = {gray + red_side * 7 / 5, gray - (blue_side * 34 + red_side * 71) / 100,
                             gray + blue_side * 177 / 100};
    for (int i = 0; i < 3; i++) {
        if (channels[i] < -ROUNDING || channels[i] > 255000 + ROUNDING) {
            return 1;
        }
    }
    return 0;
}

/* Where luma changes, chroma may belong to one side of the edge, and then they do not match. */
static int is_edge(const uint8_t *above, const uint8_t *below)
{
    enum { STEP = 12 };
    return abs(above[0] - above[1]) > STEP || abs(below[0] - below[1]) > STEP ||
           abs(above[0] - below[1]) > STEP || abs(above[1] - below[0]) > STEP;
}

static void judge_colors(const work *job, unsigned down, fit *to)
{
    for (unsigned y = 0; y + down <= job->rows; y += down) {
        for (unsigned x = 0; x + 1 < job->view->width; x += 2) {
            const uint8_t *above = &job->sample[0][y][x];
            const uint8_t *below = &job->sample[0][y + down - 1][x];
            const int luma = (above[0] + above[1] + below[0] + below[1] + 2) / 4;
            const int u = job->sample[1][y][x];
            const int v = job->sample[2][y][x];
            to->samples += 2;
            to->beyond_limited += (u < 16 || u > 240) + (unsigned)(v < 16 || v > 240);
            if (is_edge(above, below)) {
                continue;
            }
            to->colors++;
            to->impossible[0] += (unsigned)is_impossible(luma, u, v, PEL_RANGE_FULL);
            to->impossible[1] += (unsigned)is_impossible(luma, u, v, PEL_RANGE_LIMITED);
        }
    }
}

static void judge_luma(const work *job, fit *to)
{
    for (unsigned y = 0; y < job->rows; y++) {
        for (unsigned x = 0; x < job->view->width; x++) {
            const uint8_t luma = job->sample[0][y][x];
            to->luma_min = luma < to->luma_min ? luma : to->luma_min;
            to->luma_max = luma > to->luma_max ? luma : to->luma_max;
            to->beyond_limited += luma < 16 || luma > 235;
        }
        to->samples += job->view->width;
    }
}

static void take_ycbcr(work *job, unsigned y0, fit *to)
{
    const unsigned down = job->half_bytes == 3 ? 2 : 1;
    for (unsigned y = 0; y < job->rows; y++) {
        const pel_crow row = pel_cview_row(job->view, (uint16_t)(y0 + y));
        pel_crow_read_yuv(&row, 0, job->view->width, job->view->range, job->sample[0][y],
                          job->sample[1][y], job->sample[2][y]);
    }
    predict(job, 0, 1, 1, &job->luma);
    judge_luma(job, to);
    if (job->half_bytes > 2) {
        predict(job, 1, 2, down, &job->chroma[0]);
        predict(job, 2, 2, down, &job->chroma[1]);
        judge_colors(job, down, to);
    }
}

/* ---- RGB ----------------------------------------------------------------------------------- */

/* The rest of red or blue, predicted from a neighbour that is `from` columns or rows back. */
static void predict_other(const work *job, channel *ways, const uint8_t *of, const uint8_t *green,
                          const uint8_t *of_back, const uint8_t *green_back, int direction)
{
    const int change = *of - *of_back;
    count_rest(job, &ways[BY_ITSELF], direction, change);
    count_rest(job, &ways[BY_GREEN], direction, *of - *green);
    count_rest(job, &ways[BY_CHANGE_OF_GREEN], direction, change - (*green - *green_back));
}

static void take_rgb(work *job, unsigned y0)
{
    static const uint8_t bits_of_888[4] = {8, 8, 8, 8};
    static const uint8_t bits_of_565[4] = {5, 6, 5, 5};
    const uint8_t *bits = job->half_bytes == 4 ? bits_of_565 : bits_of_888;
    const unsigned width = job->view->width;
    for (unsigned y = 0; y < job->rows; y++) {
        pack_rgb_row(job->view, y0 + y, job->rgb);
        for (unsigned x = 0; x < width; x++) {
            for (unsigned i = 0; i < 4; i++) {
                const uint8_t sample = job->rgb[3 * x + (i < 3 ? i : 1)];
                job->sample[i][y][x] = (uint8_t)(sample >> (8 - bits[i]));
            }
        }
    }
    predict(job, 1, 1, 1, &job->green);
    for (unsigned which = 0; which < 2; which++) {
        for (unsigned y = 0; y < job->rows; y++) {
            const uint8_t *of = job->sample[2 * which][y];
            const uint8_t *green = job->sample[3][y];
            for (unsigned x = 1; x < width; x++) {
                predict_other(job, job->other[which], of + x, green + x, of + x - 1, green + x - 1,
                              0);
            }
            for (unsigned x = 0; y > 0 && x < width; x++) {
                predict_other(job, job->other[which], of + x, green + x,
                              &job->sample[2 * which][y - 1][x], &job->sample[3][y - 1][x], 1);
            }
        }
    }
}

/* ---- Bayer --------------------------------------------------------------------------------- */

static void predict_lattice(const work *job, unsigned x0, unsigned y0, channel *of)
{
    for (unsigned y = y0; y < job->rows; y += 2) {
        const uint8_t *row = job->sample[0][y];
        for (unsigned x = x0 + 2; x < job->view->width; x += 2) {
            count_rest(job, of, 0, row[x] - row[x - 2]);
        }
        for (unsigned x = x0; y >= 2 && x < job->view->width; x += 2) {
            count_rest(job, of, 1, row[x] - job->sample[0][y - 2][x]);
        }
    }
}

/* The lower green of each cell from the upper green to both sides of it. */
static void predict_green(const work *job, unsigned x0, channel *of)
{
    for (unsigned y = 1; y < job->rows; y += 2) {
        for (unsigned x = x0 + 2; x + 1 < job->view->width; x += 2) {
            count_rest(job, of, 0, job->sample[0][y][x] - job->sample[0][y - 1][x - 1]);
            count_rest(job, of, 1, job->sample[0][y][x] - job->sample[0][y - 1][x + 1]);
        }
    }
}

static void take_mosaic(work *job, unsigned y0)
{
    /* "BAYER8_GRBG": the greens lie in the columns that the name says. */
    const char *cell = pel_format_name(job->view->format) + sizeof "BAYER8_" - 1;
    const unsigned lower_green = cell[2] == 'G' ? 2 : 3;
    for (unsigned y = 0; y < job->rows; y++) {
        const uint8_t *row = job->view->plane[0] + (ptrdiff_t)(y0 + y) * job->view->stride_bytes[0];
        for (unsigned x = 0; x < job->view->width; x++) {
            job->sample[0][y][x] = row[x];
        }
    }
    for (unsigned i = 0; i < 4; i++) {
        if (i == lower_green) {
            predict_green(job, i % 2, &job->lattice[i]);
        } else {
            predict_lattice(job, i % 2, i / 2, &job->lattice[i]);
        }
    }
}

/* ---- The sum ------------------------------------------------------------------------------- */

static uint64_t cheapest(const channel *ways)
{
    uint64_t least = mean_cost(&ways[0]);
    for (int i = 1; i < WAYS; i++) {
        const uint64_t cost = mean_cost(&ways[i]);
        least = cost < least ? cost : least;
    }
    return least;
}

/* Thousandths of a bit per byte of the frame. */
static uint64_t cost_per_byte(const work *job, int is_ycbcr)
{
    if (!is_ycbcr && job->half_bytes == 2) {
        uint64_t sum = 0;
        for (int i = 0; i < 4; i++) {
            sum += mean_cost(&job->lattice[i]);
        }
        return sum / 4;
    }
    if (!is_ycbcr) {
        const uint64_t pixel =
            mean_cost(&job->green) + cheapest(job->other[0]) + cheapest(job->other[1]);
        return 2 * pixel / job->half_bytes;
    }
    /* Twice the samples of U that a pixel has: 1 in 4:2:2, 1/2 in 4:2:0, none in gray. */
    const uint64_t chroma = mean_cost(&job->chroma[0]) + mean_cost(&job->chroma[1]);
    return (2 * mean_cost(&job->luma) + (job->half_bytes - 2) * chroma / 2) / job->half_bytes;
}

int fit_add(fit *to, const pel_cview *view)
{
    const unsigned width = view->width, height = view->height;
    const uint32_t bytes = pel_frame_bytes(view->format, view->width, view->height);
    const int is_ycbcr = pack_has_range(view->format);
    const unsigned bands = (height + BAND_ROWS - 1) / BAND_ROWS;
    const unsigned step = (bands + BANDS_MAX - 1) / BANDS_MAX;
    work *job = calloc(1, sizeof *job);
    if (!job) {
        return -1;
    }
    for (unsigned rest = 0; rest <= REST_MAX; rest++) {
        job->cost[rest] = milli_log(rest);
    }
    if (to->bytes == 0) {
        to->luma_min = UINT8_MAX;
    }
    job->view = view;
    job->half_bytes = (unsigned)(2 * (uint64_t)bytes / (width * height));
    for (unsigned band = 0; band < bands; band += step) {
        const unsigned y0 = band * BAND_ROWS;
        job->rows = height - y0 < BAND_ROWS ? height - y0 : BAND_ROWS;
        if (is_ycbcr) {
            take_ycbcr(job, y0, to);
        } else if (job->half_bytes == 2) {
            take_mosaic(job, y0);
        } else {
            take_rgb(job, y0);
        }
    }
    to->milli_bits += cost_per_byte(job, is_ycbcr) * bytes;
    to->bytes += bytes;
    free(job);
    return 0;
}

uint32_t fit_milli_bits(const fit *of)
{
    return of->bytes ? (uint32_t)(of->milli_bits / of->bytes) : 0;
}
