/* The kernels of corners and edges, and whole pictures through the objects that run them. */
#include "equal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "row/row_feature_select.h"

static void *memory(size_t bytes)
{
    void *const block = malloc(bytes ? bytes : 1);
    if (!block) {
        fputs("equal: out of memory\n", stderr);
        exit(1);
    }
    return block;
}

/* ---- Rows that end where their neighbours end ---------------------------------------------- */

enum { ROWS = 7 };

typedef struct window {
    uint8_t *memory[ROWS];
    const uint8_t *rows[ROWS];
} window;

/* Copies rows with `radius` bytes on either side, so that a sanitizer sees one that is read beyond
 * them. A run has five: the others are from further behind in the first. */
static window window_of(const equal_run *run, unsigned radius)
{
    window w;

    for (unsigned i = 0; i < ROWS; i++) {
        const size_t bytes = run->width + 2u * radius;
        const size_t from = (size_t)run->width * (i / EQUAL_PLANES);
        w.memory[i] = memory(bytes);
        memcpy(w.memory[i], run->in[i % EQUAL_PLANES] + from - radius, bytes);
        w.rows[i] = w.memory[i] + radius;
    }
    return w;
}

static void drop(window *w)
{
    for (unsigned i = 0; i < ROWS; i++) {
        free(w->memory[i]);
    }
}

/* Results lie where their type may, then where the bytes of the comparison are. */
static size_t take(const equal_run *run, void *results, size_t bytes)
{
    memcpy(run->out, results, bytes);
    free(results);
    return bytes;
}

/* ---- Kernels ------------------------------------------------------------------------------- */

static size_t harris(pel_backend backend, const equal_run *run)
{
    static const uint16_t weights[] = {0, 1, 1311, 8191};
    int32_t *const responses = memory(4u * run->width);
    window w = window_of(run, 2);
    pel_i_row_harris(backend, w.rows, run->width, weights[run->seed % 4], responses);
    drop(&w);
    return take(run, responses, 4u * run->width);
}

static size_t shi_tomasi(pel_backend backend, const equal_run *run)
{
    int32_t *const responses = memory(4u * run->width);
    window w = window_of(run, 2);
    pel_i_row_shi_tomasi(backend, w.rows, run->width, responses);
    drop(&w);
    return take(run, responses, 4u * run->width);
}

static size_t fast9(pel_backend backend, const equal_run *run)
{
    static const int16_t thresholds[] = {1, 20, 100, 127, 128, 253, 254};
    int32_t *const responses = memory(4u * run->width);
    window w = window_of(run, 3);
    pel_i_row_fast9(backend, w.rows, run->width, thresholds[run->seed % 7], responses);
    drop(&w);
    return take(run, responses, 4u * run->width);
}

/* Responses that are often equal, sometimes far apart. */
static int32_t response_from(const uint8_t *bytes)
{
    return bytes[0] & 0x80u ? (int32_t)(bytes[1] & 3u) : (bytes[0] - 64) * 20000000 + bytes[1];
}

/* The places of all tops: a search begins behind the last one. */
static size_t next_top(pel_backend backend, const equal_run *run)
{
    const uint16_t width = run->width;
    const int32_t threshold = run->seed % 2 ? 1 : 1 + (int32_t)(run->seed % 1000000);
    uint16_t *const places = memory(2u * width);
    int32_t *responses[3];
    const int32_t *rows[3];
    size_t count = 0;

    for (unsigned i = 0; i < 3; i++) {
        responses[i] = memory(4u * (width + 2u));
        for (unsigned x = 0; x < width + 2u; x++) {
            responses[i][x] = response_from(run->in[i] + 2 * x);
        }
        rows[i] = responses[i] + 1;
    }
    for (uint16_t x = 0; x < width; x++) {
        x = pel_i_row_next_top(backend, rows, x, width, threshold, (int)(run->seed / 2 % 3));
        if (x < width) {
            places[count++] = x;
        }
    }
    for (unsigned i = 0; i < 3; i++) {
        free(responses[i]);
    }
    return take(run, places, 2u * count);
}

static size_t gradient_sector(pel_backend backend, const equal_run *run)
{
    uint16_t *const gradients = memory(2u * run->width);
    window w = window_of(run, 1);
    pel_i_row_gradient_sector(backend, w.rows, run->width, gradients);
    drop(&w);
    return take(run, gradients, 2u * run->width);
}

/* Magnitudes that differ a little or not at all, of any sector. */
static uint16_t gradient_from(const uint8_t *bytes)
{
    const unsigned magnitude = bytes[0] & 0x80u ? bytes[1] * 8u : bytes[1] & 3u;
    return (uint16_t)(magnitude | (bytes[0] & 3u) << PEL_SECTOR_SHIFT);
}

static size_t thin(pel_backend backend, const equal_run *run)
{
    static const uint16_t lows[] = {0, 1, 100, 2040, 4095, 65535};
    const uint16_t low = lows[run->seed % 6], high = (uint16_t)(low < 65000 ? low + 300 : low);
    uint16_t *gradients[3];
    const uint16_t *rows[3];

    for (unsigned i = 0; i < 3; i++) {
        gradients[i] = memory(2u * (run->width + 2u));
        for (unsigned x = 0; x < run->width + 2u; x++) {
            gradients[i][x] = gradient_from(run->in[i] + 2 * x);
        }
        rows[i] = gradients[i] + 1;
    }
    pel_i_row_thin(backend, rows, run->width, low, high, run->out);
    for (unsigned i = 0; i < 3; i++) {
        free(gradients[i]);
    }
    return run->width;
}

const equal_kernel equal_feature_kernels[] = {{"harris", harris, 0},
                                              {"shi-tomasi", shi_tomasi, 0},
                                              {"fast9", fast9, 0},
                                              {"next top", next_top, 0},
                                              {"gradient and sector", gradient_sector, 0},
                                              {"thin", thin, 0},
                                              {NULL, NULL, 0}};

/* ---- Pictures ------------------------------------------------------------------------------ */

enum { PICTURES = 400, SIDE_MAX = 150, CORNERS = 50 };

/* Noise, few values or black and white: the largest gradients there are. */
static void draw(uint32_t *state, uint8_t *pixels, size_t count)
{
    const unsigned kind = equal_random(state) % 3;

    for (size_t i = 0; i < count; i++) {
        const uint32_t r = equal_random(state);
        pixels[i] = (uint8_t)(kind == 0 ? r : kind == 1 ? 16 * (r % 4) : r % 2 * 255);
    }
}

static void keep_responses(void *user, uint16_t y, const int32_t *responses)
{
    int32_t(*const kept)[SIDE_MAX] = user;
    memcpy(kept[y], responses, sizeof kept[0]);
}

typedef struct found {
    int32_t responses[SIDE_MAX][SIDE_MAX];
    pel_corner corners[CORNERS];
    uint32_t count;
} found;

/* The responses of a row are followed by other memory of the finder, so that those of a picture
 * that is narrower than the widest can be taken with it. */
static int find_corners(pel_corners_config c, pel_backend backend, const pel_cview *view, found *f)
{
    pel_corners corners;
    pel_status status;

    memset(f, 0, sizeof *f);
    c.backend = backend;
    c.results = f->corners;
    c.results_max = CORNERS;
    c.on_response = keep_responses;
    c.user = f->responses;
    c.work_bytes = pel_corners_bytes(view->width, c.method);
    c.work = memory(c.work_bytes + sizeof f->responses[0]);
    memset(c.work, 0, c.work_bytes + sizeof f->responses[0]);
    status = pel_corners_frame(&corners, &c, view, &f->count);
    free(c.work);
    return status >= 0;
}

static int corners_equal(pel_backend backend, uint32_t *state, const pel_cview *view)
{
    static found plain, fast;
    pel_corners_config c = {0};

    c.method = (pel_corners_method)(equal_random(state) % PEL_CORNERS_METHOD_COUNT);
    c.suppress = (pel_corners_suppress)(equal_random(state) % 3);
    c.k_q15 = (uint16_t)(equal_random(state) % 8192);
    return find_corners(c, PEL_BACKEND_SCALAR, view, &plain) &&
           find_corners(c, backend, view, &fast) && memcmp(&plain, &fast, sizeof plain) == 0;
}

static int map_edges(pel_canny_config c, pel_backend backend, const pel_cview *view,
                     uint8_t map[SIDE_MAX * SIDE_MAX])
{
    const pel_view out = {{map, NULL, NULL}, {SIDE_MAX, 0, 0}, view->width,
                          view->height,      PEL_GRAY8,        PEL_RANGE_FULL};
    pel_status status;

    memset(map, 7, SIDE_MAX * SIDE_MAX);
    c.backend = backend;
    c.work_bytes = pel_canny_bytes(view->width);
    c.work = memory(c.work_bytes);
    status = pel_canny_frame(&c, view, &out);
    free(c.work);
    return status == PEL_OK;
}

static int edges_equal(pel_backend backend, uint32_t *state, const pel_cview *view)
{
    static uint8_t plain[SIDE_MAX * SIDE_MAX], fast[SIDE_MAX * SIDE_MAX];
    pel_canny_config c = {0};

    c.low = (uint16_t)(equal_random(state) % 1000);
    c.high = (uint16_t)(c.low + equal_random(state) % 1000);
    return map_edges(c, PEL_BACKEND_SCALAR, view, plain) && map_edges(c, backend, view, fast) &&
           memcmp(plain, fast, sizeof plain) == 0;
}

unsigned equal_pictures(pel_backend backend, uint32_t seed, unsigned *failed)
{
    static uint8_t pixels[SIDE_MAX * SIDE_MAX];

    for (unsigned i = 0; i < PICTURES; i++) {
        uint32_t state = seed + i;
        const unsigned width = 1 + equal_random(&state) % SIDE_MAX;
        const unsigned height = 1 + equal_random(&state) % SIDE_MAX;
        const pel_cview view = {{pixels, NULL, NULL},
                                {(int32_t)width, 0, 0},
                                (uint16_t)width,
                                (uint16_t)height,
                                PEL_GRAY8,
                                PEL_RANGE_FULL};
        draw(&state, pixels, (size_t)width * height);
        if ((!corners_equal(backend, &state, &view) || !edges_equal(backend, &state, &view)) &&
            ++*failed <= 20) {
            printf("wrong: corners or edges of a picture, %s: seed %lu\n",
                   pel_backend_name(backend), (unsigned long)(seed + i));
        }
    }
    return PICTURES - *failed;
}

/* ---- Roots --------------------------------------------------------------------------------- */

#if defined(PEL_ROW_FEATURE_X86)
#include <emmintrin.h>

/* What the kernels make of s and of what is under the root. */
static int32_t less_root(int32_t s, int64_t square)
{
    const __m128d root = _mm_sqrt_pd(_mm_set1_pd((double)square));
    return _mm_cvtsi128_si32(
        _mm_cvttpd_epi32(_mm_sub_pd(_mm_cvtepi32_pd(_mm_set1_epi32(s)), root)));
}
#elif defined(PEL_ROW_NEON)
#include <arm_neon.h>

static int32_t less_root(int32_t s, int64_t square)
{
    const float64x2_t root = vsqrtq_f64(vcvtq_f64_s64(vdupq_n_s64(square)));
    return (int32_t)vgetq_lane_s64(vcvtq_s64_f64(vsubq_f64(vcvtq_f64_s64(vdupq_n_s64(s)), root)),
                                   0);
}
#endif

#if defined(PEL_ROW_FEATURE_X86) || defined(PEL_ROW_NEON)
int equal_long_roots_hold(void)
{
    const int32_t most = 9 * 650250;

    for (int32_t n = 2; n < most; n++) {
        const int64_t square = (int64_t)n * n;
        if (less_root(n, square - 1) != 0 || less_root(n, square) != 0 ||
            less_root(most, square) != most - n || less_root(most, square + 1) != most - n - 1) {
            printf("wrong: the root around %ld squared\n", (long)n);
            return 0;
        }
    }
    return 1;
}
#else
int equal_long_roots_hold(void)
{
    return 1;
}
#endif
