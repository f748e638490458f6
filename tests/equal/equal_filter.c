/* The kernels of neighbourhoods. */
#include "equal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "row/row_filter_select.h"

/* ---- Rows that end where their neighbours end ---------------------------------------------- */

typedef struct window {
    uint8_t *memory[5];
    const uint8_t *rows[5];
} window;

/* Copies rows with `radius` bytes on either side, so that a sanitizer sees one that is read beyond
 * them. */
static window window_of(const equal_run *run, unsigned radius)
{
    window w;

    for (unsigned i = 0; i < 5; i++) {
        const size_t bytes = run->width + 2u * radius;
        w.memory[i] = malloc(bytes);
        if (!w.memory[i]) {
            fputs("equal: out of memory\n", stderr);
            exit(1);
        }
        memcpy(w.memory[i], run->in[i] - radius, bytes);
        w.rows[i] = w.memory[i] + radius;
    }
    return w;
}

static void drop(window *w)
{
    for (unsigned i = 0; i < 5; i++) {
        free(w->memory[i]);
    }
}

/* ---- Kernels without parameters ------------------------------------------------------------ */

#define BYTES(name, radius)                                                                        \
    static size_t name(pel_backend backend, const equal_run *run)                                  \
    {                                                                                              \
        window w = window_of(run, radius);                                                         \
        pel_i_row_##name(backend, w.rows, run->width, run->out);                                   \
        drop(&w);                                                                                  \
        return run->width;                                                                         \
    }

/* Results of 16 bits lie where their type may, then where the bytes of the comparison are. */
#define WORDS(name)                                                                                \
    static size_t name(pel_backend backend, const equal_run *run)                                  \
    {                                                                                              \
        int16_t *const words = words_for(run);                                                     \
        window w = window_of(run, 1);                                                              \
        pel_i_row_##name(backend, w.rows, run->width, words);                                      \
        drop(&w);                                                                                  \
        return take_words(run, words);                                                             \
    }

static int16_t *words_for(const equal_run *run)
{
    int16_t *const words = malloc(2u * run->width + 1u);
    if (!words) {
        fputs("equal: out of memory\n", stderr);
        exit(1);
    }
    return words;
}

static size_t take_words(const equal_run *run, int16_t *words)
{
    memcpy(run->out, words, 2u * run->width);
    free(words);
    return 2u * run->width;
}

BYTES(gauss3, 1)
BYTES(box3, 1)
BYTES(binomial5, 2)
BYTES(gradient_abs, 1)
BYTES(gradient, 1)
BYTES(median3, 1)
BYTES(min3, 1)
BYTES(max3, 1)
BYTES(erode_labels3, 1)
BYTES(dilate_labels3, 1)
WORDS(sobel_x)
WORDS(sobel_y)
WORDS(gradient_abs_s16)
WORDS(gradient_s16)

/* ---- Rows at once -------------------------------------------------------------------------- */

#if defined(PEL_ROW_FILTER_X86)
/* Bytes: one row of results and up to as many as there is room for, side by side or, turned, from
 * below to above with a gap; what they are made of are the rows of a run, again and again. Others:
 * as many as the rows of a run give. */
enum { AT_ONCE_MAX = 6, AT_ONCE = EQUAL_PLANES - 2, GAP = 3 };

static unsigned height_of(const equal_run *run)
{
    return 1 + run->seed / 2 % AT_ONCE_MAX;
}

static size_t results_at_once(const equal_run *run, unsigned height)
{
    return (size_t)height * (run->width + (size_t)GAP);
}

#define AT_ONCE_BYTES(name)                                                                        \
    static size_t name##_rows(pel_backend backend, const equal_run *run)                           \
    {                                                                                              \
        const ptrdiff_t stride = run->seed % 2 == 0 ? run->width : -(ptrdiff_t)run->width - GAP;   \
        const unsigned height = height_of(run);                                                    \
        const uint8_t *rows[AT_ONCE_MAX + 2];                                                      \
        window w = window_of(run, 1);                                                              \
        for (unsigned i = 0; i < height + 2; i++) {                                                \
            rows[i] = w.rows[i % EQUAL_PLANES];                                                    \
        }                                                                                          \
        memset(run->out, 1, results_at_once(run, height));                                         \
        pel_i_row_##name##_rows(backend, rows, run->width, (uint16_t)height,                       \
                                run->out + (stride < 0 ? (1 - (ptrdiff_t)height) * stride : 0),    \
                                stride);                                                           \
        drop(&w);                                                                                  \
        return results_at_once(run, height);                                                       \
    }
#define AT_ONCE_WORDS(name)                                                                        \
    static size_t name##_rows(pel_backend backend, const equal_run *run)                           \
    {                                                                                              \
        const size_t bytes = 2 * results_at_once(run, AT_ONCE);                                    \
        int16_t *const words = malloc(bytes);                                                      \
        window w = window_of(run, 1);                                                              \
        if (!words) {                                                                              \
            fputs("equal: out of memory\n", stderr);                                               \
            exit(1);                                                                               \
        }                                                                                          \
        memset(words, 1, bytes);                                                                   \
        pel_i_row_##name##_rows(backend, w.rows, run->width, AT_ONCE, words, run->width + GAP);    \
        memcpy(run->out, words, bytes);                                                            \
        free(words);                                                                               \
        drop(&w);                                                                                  \
        return bytes;                                                                              \
    }

AT_ONCE_BYTES(gauss3)
AT_ONCE_BYTES(gradient_abs)
AT_ONCE_BYTES(gradient)
AT_ONCE_BYTES(median3)
AT_ONCE_BYTES(min3)
AT_ONCE_BYTES(max3)
AT_ONCE_WORDS(sobel_x)
AT_ONCE_WORDS(sobel_y)
#endif

/* ---- Kernels with taps --------------------------------------------------------------------- */

typedef struct taps {
    int8_t tap[25];
    pel_row_scale scale;
} taps;

/* As a filter makes it of a divisor, a shift and a bias, see filter.h. */
static pel_row_scale scale_of(uint32_t divisor, unsigned shift, int absolute, int32_t bias)
{
    const uint32_t whole = divisor << shift, more = 816000 / whole + 1;
    pel_row_scale scale;

    scale.start = more * whole + whole / 2;
    scale.flip = absolute ? scale.start : 0;
    scale.divisor = divisor == 1 ? 0 : whole;
    scale.shift = (uint8_t)shift;
    scale.bias = bias - (int32_t)more;
    return scale;
}

/* Taps of a size that fits 16-bit sums, that nearly does, that does not, and the extremes. */
static void draw_taps(uint32_t *state, int8_t *tap)
{
    static const uint8_t sizes[] = {1, 5, 12, 20, 60, 127};
    const unsigned kind = equal_random(state) % 8;

    for (unsigned i = 0; i < 25; i++) {
        const uint32_t r = equal_random(state);
        if (kind < sizeof sizes) {
            tap[i] = (int8_t)((int32_t)(r % (2u * sizes[kind] + 1)) - sizes[kind]);
        } else if (kind == 6) {
            tap[i] = (int8_t)(r % 11);
        } else {
            tap[i] = r % 2 == 0 ? -128 : 127;
        }
    }
}

static taps draw(uint32_t seed)
{
    uint32_t state = seed;
    taps t;
    draw_taps(&state, t.tap);
    const uint32_t r = equal_random(&state), kind = equal_random(&state) % 4;
    const unsigned shift = equal_random(&state) % (kind < 3 ? 9 : 16);
    const uint32_t divisor = kind == 0 ? 1 : kind < 3 ? 1 + r % 300 : 1 + r % 32767;
    const int32_t bias =
        equal_random(&state) % 2 == 0 ? 0 : (int32_t)(equal_random(&state) % 65536) - 32768;
    const int absolute = equal_random(&state) % 3 == 0;
    t.scale = scale_of(divisor, kind == 1 ? 0 : shift, absolute, kind == 2 ? bias / 256 : bias);
    return t;
}

#define TAPS_BYTES(name, radius)                                                                   \
    static size_t name(pel_backend backend, const equal_run *run)                                  \
    {                                                                                              \
        const taps t = draw(run->seed);                                                            \
        window w = window_of(run, radius);                                                         \
        pel_i_row_##name(backend, w.rows, t.tap, &t.scale, run->width, run->out);                  \
        drop(&w);                                                                                  \
        return run->width;                                                                         \
    }

#define TAPS_WORDS(name, radius)                                                                   \
    static size_t name(pel_backend backend, const equal_run *run)                                  \
    {                                                                                              \
        const taps t = draw(run->seed);                                                            \
        int16_t *const words = words_for(run);                                                     \
        window w = window_of(run, radius);                                                         \
        pel_i_row_##name(backend, w.rows, t.tap, &t.scale, run->width, words);                     \
        drop(&w);                                                                                  \
        return take_words(run, words);                                                             \
    }

#if defined(PEL_ROW_FILTER_X86)
static size_t kernel3_rows(pel_backend backend, const equal_run *run)
{
    const taps t = draw(run->seed);
    const pel_row_taps all = {t.tap, t.scale};
    window w = window_of(run, 1);
    pel_i_row_kernel3_rows(backend, w.rows, &all, run->width, AT_ONCE, run->out, run->width);
    drop(&w);
    return (size_t)AT_ONCE * run->width;
}
#endif

TAPS_BYTES(kernel3, 1)
TAPS_WORDS(kernel3_s16, 1)
TAPS_BYTES(kernel5, 2)
TAPS_WORDS(kernel5_s16, 2)

/* ---- Roots --------------------------------------------------------------------------------- */

#if defined(PEL_ROW_FILTER_X86)
#include <emmintrin.h>

/* The root of n that is guessed, or that of a guess that is wrong by as much as processors may. */
static int32_t guessed(int32_t n, float wrong)
{
    const __m128 near = _mm_rcp_ps(_mm_rsqrt_ps(_mm_cvtepi32_ps(_mm_set1_epi32(n))));
    const __m128 exact = _mm_sqrt_ps(_mm_cvtepi32_ps(_mm_set1_epi32(n)));
    const __m128 guess = wrong == 0 ? near : _mm_mul_ps(exact, _mm_set1_ps(1 + wrong));
    const int32_t root = _mm_cvtsi128_si32(_mm_cvttps_epi32(_mm_add_ps(guess, _mm_set1_ps(0.5F))));
    return root - (root * root > n);
}

/* Both reciprocals: 3 / 8192 each. */
static int guess_holds(int32_t n, int32_t root)
{
    const float wrong = 2 * 3.01F / 8192;
    return guessed(n, 0) == root && guessed(n, wrong) == root && guessed(n, -wrong) == root;
}

int equal_roots_hold(void)
{
    const int32_t most = 2 * 1020 * 1020; /* more than is reached */
    int32_t root = 0;                     /* root^2 <= n < (root + 1)^2 */

    for (int32_t n = 0; n <= most; n++) {
        const __m128 found = _mm_sqrt_ps(_mm_cvtepi32_ps(_mm_set1_epi32(n)));
        root += (root + 1) * (root + 1) == n;
        if (_mm_cvtsi128_si32(_mm_cvttps_epi32(found)) != root ||
            (n < 65536 && !guess_holds(n, root))) {
            printf("wrong: the root of %ld\n", (long)n);
            return 0;
        }
    }
    return 1;
}
#else
int equal_roots_hold(void)
{
    return 1;
}
#endif

const equal_kernel equal_filter_kernels[] = {{"gauss3", gauss3, 0},
                                             {"box3", box3, 0},
                                             {"binomial5", binomial5, 0},
                                             {"sobel x", sobel_x, 0},
                                             {"sobel y", sobel_y, 0},
                                             {"gradient abs", gradient_abs, 0},
                                             {"gradient abs, 16 bits", gradient_abs_s16, 0},
                                             {"gradient", gradient, 0},
                                             {"gradient, 16 bits", gradient_s16, 0},
                                             {"median3", median3, 0},
                                             {"min3", min3, 0},
                                             {"max3", max3, 0},
                                             {"erode labels", erode_labels3, 0},
                                             {"dilate labels", dilate_labels3, 0},
                                             {"kernel3", kernel3, 0},
                                             {"kernel3, 16 bits", kernel3_s16, 0},
                                             {"kernel5", kernel5, 0},
                                             {"kernel5, 16 bits", kernel5_s16, 0},
#if defined(PEL_ROW_FILTER_X86)
                                             {"gauss3, rows", gauss3_rows, 0},
                                             {"sobel x, rows", sobel_x_rows, 0},
                                             {"sobel y, rows", sobel_y_rows, 0},
                                             {"gradient abs, rows", gradient_abs_rows, 0},
                                             {"gradient, rows", gradient_rows, 0},
                                             {"median3, rows", median3_rows, 0},
                                             {"min3, rows", min3_rows, 0},
                                             {"max3, rows", max3_rows, 0},
                                             {"kernel3, rows", kernel3_rows, 0},
#endif
                                             {NULL, NULL, 0}};
