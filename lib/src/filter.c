#include "pel/filter.h"

#include "row/row_filter.h"

/* ---- Borders ------------------------------------------------------------------------------- */

static int32_t modulo(int32_t i, int32_t length)
{
    const int32_t rest = i % length;
    return rest < 0 ? rest + length : rest;
}

/* Whether i lies in an odd one of the stretches of `length` places to either side of 0. */
static int is_odd_stretch(int32_t i, int32_t length)
{
    return (i / length - (i % length < 0 ? 1 : 0)) % 2 != 0;
}

int32_t pel_border_index(int32_t i, int32_t length, pel_border border)
{
    if (i >= 0 && i < length) {
        return i;
    }
    switch (border) {
    case PEL_BORDER_REPLICATE:
        return i < 0 ? 0 : length - 1;
    case PEL_BORDER_SYMMETRIC: /* there and back again: a b c d d c b a, then anew */
        return is_odd_stretch(i, length) ? length - 1 - modulo(i, length) : modulo(i, length);
    case PEL_BORDER_REFLECT101: /* a b c d c b, then anew */
        if (length == 1) {
            return 0;
        }
        return is_odd_stretch(i, length - 1) ? length - 1 - modulo(i, length - 1)
                                             : modulo(i, length - 1);
    case PEL_BORDER_WRAP:
        return modulo(i, length);
    case PEL_BORDER_CONSTANT:
    case PEL_BORDER_VALID:
        break;
    }
    return -1;
}

/* ---- Kernels ------------------------------------------------------------------------------- */

/* Kernels with a way of their own, by the value of `fast`. */
enum { FAST_NONE, FAST_GAUSS3, FAST_BOX3, FAST_SOBEL_X, FAST_SOBEL_Y, FAST_BINOMIAL5 };

typedef struct named_kernel {
    char name[20];
    pel_kernel kernel;
} named_kernel;

/* name, {taps, radius, divisor, shift, absolute, bias, fast}. No pointers in here: it stays in
 * flash. */
static const named_kernel named_kernels[] = {
    {"identity", {{0, 0, 0, 0, 1, 0, 0, 0, 0}, 1, 1, 0, 0, 0, FAST_NONE}},
    {"shift_left", {{0, 0, 0, 0, 0, 1, 0, 0, 0}, 1, 1, 0, 0, 0, FAST_NONE}},
    {"shift_right", {{0, 0, 0, 1, 0, 0, 0, 0, 0}, 1, 1, 0, 0, 0, FAST_NONE}},
    {"shift_up", {{0, 0, 0, 0, 0, 0, 0, 1, 0}, 1, 1, 0, 0, 0, FAST_NONE}},
    {"shift_down", {{0, 1, 0, 0, 0, 0, 0, 0, 0}, 1, 1, 0, 0, 0, FAST_NONE}},
    {"box3", {{1, 1, 1, 1, 1, 1, 1, 1, 1}, 1, 9, 0, 0, 0, FAST_BOX3}},
    {"gauss3", {{1, 2, 1, 2, 4, 2, 1, 2, 1}, 1, 1, 4, 0, 0, FAST_GAUSS3}},
    {"gauss5",
     {{1, 3, 6, 3, 1, 3, 15, 25, 15, 3, 6, 25, 44, 25, 6, 3, 15, 25, 15, 3, 1, 3, 6, 3, 1},
      2,
      1,
      8,
      0,
      0,
      FAST_NONE}},
    {"binomial5",
     {{1, 4, 6, 4, 1, 4, 16, 24, 16, 4, 6, 24, 36, 24, 6, 4, 16, 24, 16, 4, 1, 4, 6, 4, 1},
      2,
      1,
      8,
      0,
      0,
      FAST_BINOMIAL5}},
    {"sobel_x", {{-1, 0, 1, -2, 0, 2, -1, 0, 1}, 1, 1, 0, 0, 0, FAST_SOBEL_X}},
    {"sobel_y", {{-1, -2, -1, 0, 0, 0, 1, 2, 1}, 1, 1, 0, 0, 0, FAST_SOBEL_Y}},
    {"scharr_x", {{-3, 0, 3, -10, 0, 10, -3, 0, 3}, 1, 1, 0, 0, 0, FAST_NONE}},
    {"scharr_y", {{-3, -10, -3, 0, 0, 0, 3, 10, 3}, 1, 1, 0, 0, 0, FAST_NONE}},
    {"prewitt_x", {{-1, 0, 1, -1, 0, 1, -1, 0, 1}, 1, 1, 0, 0, 0, FAST_NONE}},
    {"prewitt_y", {{-1, -1, -1, 0, 0, 0, 1, 1, 1}, 1, 1, 0, 0, 0, FAST_NONE}},
    {"laplacian", {{0, 1, 0, 1, -4, 1, 0, 1, 0}, 1, 1, 0, 0, 0, FAST_NONE}},
    {"laplacian_negative", {{0, -1, 0, -1, 4, -1, 0, -1, 0}, 1, 1, 0, 0, 0, FAST_NONE}},
    {"sharpen", {{-1, -1, -1, -1, 17, -1, -1, -1, -1}, 1, 9, 0, 0, 0, FAST_NONE}},
    {"sharpen5", {{0, -1, 0, -1, 5, -1, 0, -1, 0}, 1, 1, 0, 0, 0, FAST_NONE}},
    {"emboss", {{-2, -1, 0, -1, 1, 1, 0, 1, 2}, 1, 1, 0, 0, 0, FAST_NONE}},
};

enum { NAMED_KERNELS = sizeof named_kernels / sizeof named_kernels[0] };

static int same_name(const char *a, const char *b)
{
    while (*a != '\0' && *a == *b) {
        a++;
        b++;
    }
    return *a == *b;
}

const pel_kernel *pel_kernel_named(const char *name)
{
    for (unsigned i = 0; name && i < NAMED_KERNELS; i++) {
        if (same_name(name, named_kernels[i].name)) {
            return &named_kernels[i].kernel;
        }
    }
    return NULL;
}

const char *pel_kernel_name(unsigned i)
{
    return i < NAMED_KERNELS ? named_kernels[i].name : NULL;
}

static unsigned tap_count(const pel_kernel *kernel)
{
    return kernel->radius == 1 ? 9 : 25;
}

pel_kernel pel_kernel_flipped(const pel_kernel *kernel)
{
    pel_kernel flipped = *kernel;
    const unsigned taps = tap_count(kernel);

    for (unsigned i = 0; i < taps; i++) {
        flipped.tap[i] = kernel->tap[taps - 1 - i];
    }
    flipped.fast = FAST_NONE;
    return flipped;
}

/* ---- The window of rows -------------------------------------------------------------------- */

/*
 * Row y of the picture lies in slot y mod (2r + 1) of the working memory, with r pixels on either
 * side that hold the border. So do the rows outside that are not a copy of a row inside: for
 * CONSTANT and WRAP they are put into their slots as if they had been pushed. WRAP keeps the first
 * r rows of the picture, which come again below the last, in r slots of their own.
 */
static size_t slot_bytes(const pel_filter *f)
{
    return (size_t)f->config.width + 2u * f->radius;
}

static uint8_t *slot_at(const pel_filter *f, size_t slot)
{
    return (uint8_t *)f->config.work + slot * slot_bytes(f) + f->radius;
}

/* y from -r to height + r - 1. */
static uint8_t *row_slot(const pel_filter *f, int32_t y)
{
    return slot_at(f, (size_t)modulo(y, 2 * f->radius + 1));
}

static void fill(uint8_t *row, uint8_t value, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        row[i] = value;
    }
}

static void put_sides(const pel_filter *f, uint8_t *row)
{
    const int32_t width = f->config.width;

    for (int32_t i = 1; i <= f->radius; i++) {
        const int32_t left = pel_border_index(-i, width, f->config.border);
        const int32_t right = pel_border_index(width - 1 + i, width, f->config.border);
        row[-i] = left < 0 ? f->config.constant : row[left];
        row[width - 1 + i] = right < 0 ? f->config.constant : row[right];
    }
}

static void put_row(const pel_filter *f, const uint8_t *src, uint8_t *row)
{
    for (uint16_t x = 0; x < f->config.width; x++) {
        row[x] = src[x];
    }
    put_sides(f, row);
}

/* The rows above the picture: those that are copies need nothing, the others go into
 * their slots. */
static void put_rows_above(const pel_filter *f)
{
    const int32_t r = f->radius;

    for (int32_t i = 0; i < r; i++) {
        if (f->config.border == PEL_BORDER_WRAP) {
            put_row(f, f->config.last_rows[i], row_slot(f, i - r));
        } else {
            fill(row_slot(f, i - r) - r, f->config.constant, slot_bytes(f));
        }
    }
}

/* The row `below` rows under the last one, likewise. */
static void put_row_below(const pel_filter *f, int32_t below)
{
    uint8_t *const row = row_slot(f, f->config.height - 1 + below);

    if (f->config.border == PEL_BORDER_WRAP) {
        const size_t kept = 2u * f->radius + 1u + (size_t)((below - 1) % f->config.height);
        put_row(f, slot_at(f, kept), row);
    } else if (f->config.border == PEL_BORDER_CONSTANT) {
        fill(row - f->radius, f->config.constant, slot_bytes(f));
    }
}

/* The rows around row y of the picture. */
static void window_at(const pel_filter *f, int32_t y, const uint8_t *rows[5])
{
    const int32_t r = f->radius;

    for (int32_t j = -r; j <= r; j++) {
        const int32_t copy = f->config.border == PEL_BORDER_WRAP
                                 ? -1
                                 : pel_border_index(y + j, f->config.height, f->config.border);
        rows[j + r] = row_slot(f, copy < 0 ? y + j : copy);
    }
}

/* ---- Begin --------------------------------------------------------------------------------- */

static unsigned radius_of(const pel_filter_config *c)
{
    return c->op == PEL_FILTER_KERNEL && c->kernel ? c->kernel->radius : 1;
}

uint32_t pel_filter_bytes(uint16_t width, unsigned radius, pel_border border)
{
    return border == PEL_BORDER_WRAP ? PEL_FILTER_BYTES_WRAP(width, radius)
                                     : PEL_FILTER_BYTES(width, radius);
}

static uint16_t less_border(uint16_t side, const pel_filter_config *c)
{
    return (uint16_t)(c->border == PEL_BORDER_VALID ? side - 2 * radius_of(c) : side);
}

uint16_t pel_filter_width(const pel_filter_config *config)
{
    return less_border(config->width, config);
}

uint16_t pel_filter_height(const pel_filter_config *config)
{
    return less_border(config->height, config);
}

static pel_status check_operator(const pel_filter_config *c)
{
    const pel_kernel *const k = c->kernel;

    if ((unsigned)c->op >= PEL_FILTER_OP_COUNT || (unsigned)c->border > PEL_BORDER_VALID) {
        return PEL_ERR_ARG;
    }
    if (c->op == PEL_FILTER_KERNEL &&
        (!k || k->radius < 1 || k->radius > 2 || k->divisor > 32767 || k->shift > 15)) {
        return PEL_ERR_ARG;
    }
    if (c->border == PEL_BORDER_WRAP &&
        (!c->last_rows[0] || (radius_of(c) == 2 && !c->last_rows[1]))) {
        return PEL_ERR_ARG;
    }
    return PEL_OK;
}

static pel_status check_filter(const pel_filter_config *c)
{
    const pel_status status = c->work ? check_operator(c) : PEL_ERR_ARG;
    uint16_t least;

    if (status != PEL_OK) {
        return status;
    }
    least = (uint16_t)(c->border == PEL_BORDER_VALID ? 2 * radius_of(c) + 1 : 1);
    if (c->width < least || c->height < least || c->width > PEL_SIDE_MAX ||
        c->height > PEL_SIDE_MAX) {
        return PEL_ERR_RANGE;
    }
    return c->work_bytes < pel_filter_bytes(c->width, radius_of(c), c->border) ? PEL_ERR_SPACE
                                                                               : PEL_OK;
}

/* The way of its own that a kernel has, if it is still the kernel that has it: somebody may have
 * copied a named one and changed its taps. */
static uint8_t fast_way(const pel_kernel *kernel)
{
    unsigned same = 0;

    for (unsigned i = 0; i < NAMED_KERNELS && kernel->fast != FAST_NONE; i++) {
        const pel_kernel *const known = &named_kernels[i].kernel;
        if (known->fast == kernel->fast && known->radius == kernel->radius) {
            while (same < tap_count(kernel) && known->tap[same] == kernel->tap[same]) {
                same++;
            }
            return same == tap_count(kernel) ? kernel->fast : FAST_NONE;
        }
    }
    return FAST_NONE;
}

enum { STATE_IDLE, STATE_ROWS };

pel_status pel_filter_begin(pel_filter *f, const pel_filter_config *config)
{
    const pel_status status = f && config ? check_filter(config) : PEL_ERR_ARG;

    if (status != PEL_OK) {
        return status;
    }
    f->config = *config;
    f->radius = (uint16_t)radius_of(config);
    f->fast = config->op == PEL_FILTER_KERNEL ? fast_way(config->kernel) : FAST_NONE;
    f->pushed = 0;
    f->row = 0;
    f->state = STATE_ROWS;
    put_rows_above(f);
    return PEL_OK;
}

/* ---- Push and pull ------------------------------------------------------------------------- */

/* The row of the picture that the next row of the result lies on, and the last one that
 * it needs. */
static int32_t next_centre(const pel_filter *f)
{
    return f->config.border == PEL_BORDER_VALID ? f->row + f->radius : f->row;
}

static int is_ready(const pel_filter *f)
{
    const int32_t last = f->config.height - 1, needed = next_centre(f) + f->radius;

    return f->row < pel_filter_height(&f->config) && f->pushed > (needed < last ? needed : last);
}

pel_status pel_filter_push(pel_filter *f, const uint8_t *row)
{
    if (!f || !row) {
        return PEL_ERR_ARG;
    }
    if (f->state != STATE_ROWS || f->pushed >= f->config.height || is_ready(f)) {
        return PEL_ERR_ORDER;
    }
    put_row(f, row, row_slot(f, f->pushed));
    if (f->config.border == PEL_BORDER_WRAP && f->pushed < f->radius) {
        put_row(f, row, slot_at(f, 2u * f->radius + 1u + f->pushed));
    }
    f->pushed++;
    return PEL_OK;
}

static void correlate(const pel_filter *f, const uint8_t *const rows[], uint16_t count,
                      int32_t *sums)
{
    const pel_kernel *const kernel = f->config.kernel;

    switch (f->fast) {
    case FAST_GAUSS3:
        pel_row_gauss3(rows, count, sums);
        break;
    case FAST_BOX3:
        pel_row_box3(rows, count, sums);
        break;
    case FAST_SOBEL_X:
        pel_row_sobel_x(rows, count, sums);
        break;
    case FAST_SOBEL_Y:
        pel_row_sobel_y(rows, count, sums);
        break;
    case FAST_BINOMIAL5:
        pel_row_binomial5(rows, count, sums);
        break;
    default:
        if (kernel->radius == 1) {
            pel_row_correlate3(rows, kernel->tap, count, sums);
        } else {
            pel_row_correlate5(rows, kernel->tap, count, sums);
        }
    }
}

/* Whether an operator gives sums, to be scaled, and not bytes. */
static int gives_sums(pel_filter_op op)
{
    return op == PEL_FILTER_KERNEL || op == PEL_FILTER_GRADIENT_ABS || op == PEL_FILTER_GRADIENT;
}

static void sum_row(const pel_filter *f, const uint8_t *const rows[], uint16_t count, int32_t *sums)
{
    if (f->config.op == PEL_FILTER_KERNEL) {
        correlate(f, rows, count, sums);
    } else if (f->config.op == PEL_FILTER_GRADIENT_ABS) {
        pel_row_gradient_abs(rows, count, sums);
    } else {
        pel_row_gradient(rows, count, sums);
    }
}

static pel_row_scale scale_of(const pel_filter *f)
{
    const pel_kernel *const k = f->config.kernel;
    pel_row_scale scale = {0, 1, 0, 0};

    if (f->config.op == PEL_FILTER_KERNEL) {
        scale.bias = k->bias;
        scale.divisor = k->divisor == 0 ? 1 : k->divisor;
        scale.shift = k->shift;
        scale.absolute = k->absolute;
    }
    return scale;
}

enum { CHUNK = 16 }; /* sums kept at a time: 64 bytes of stack */

/* Sums in pieces, each scaled into `bytes` or, if that is NULL, into `words`. */
static void scale_row(const pel_filter *f, const uint8_t *rows[5], uint16_t count, uint8_t *bytes,
                      int16_t *words)
{
    const pel_row_scale scale = scale_of(f);
    const unsigned row_count = 2u * f->radius + 1u;

    for (uint16_t done = 0; done < count; done = (uint16_t)(done + CHUNK)) {
        int32_t sums[CHUNK];
        const uint16_t n = (uint16_t)(count - done < CHUNK ? count - done : CHUNK);
        sum_row(f, rows, n, sums);
        if (bytes) {
            pel_row_scale_u8(sums, &scale, n, bytes + done);
        } else {
            pel_row_scale_s16(sums, &scale, n, words + done);
        }
        for (unsigned i = 0; i < row_count; i++) {
            rows[i] += n;
        }
    }
}

static void byte_row(pel_filter_op op, const uint8_t *const rows[], uint16_t count, uint8_t *out)
{
    switch (op) {
    case PEL_FILTER_DIRECTION:
        pel_row_direction(rows, count, out);
        break;
    case PEL_FILTER_MEDIAN:
        pel_row_median3(rows, count, out);
        break;
    case PEL_FILTER_MIN:
        pel_row_min3(rows, count, out);
        break;
    case PEL_FILTER_MAX:
        pel_row_max3(rows, count, out);
        break;
    case PEL_FILTER_MAJORITY:
        pel_row_majority3(rows, count, out);
        break;
    case PEL_FILTER_ERODE_LABELS:
        pel_row_erode_labels3(rows, count, out);
        break;
    default:
        pel_row_dilate_labels3(rows, count, out);
    }
}

/* Into `bytes` or, if that is NULL, into `words`. */
static pel_status pull(pel_filter *f, uint8_t *bytes, int16_t *words)
{
    const uint8_t *rows[5];
    const int32_t centre = next_centre(f);
    const uint16_t count = pel_filter_width(&f->config);

    if (f->state != STATE_ROWS || !is_ready(f)) {
        return PEL_ERR_ORDER;
    }
    for (int32_t below = 1; below <= centre + f->radius - (f->config.height - 1); below++) {
        put_row_below(f, below);
    }
    window_at(f, centre, rows);
    if (f->config.border == PEL_BORDER_VALID) {
        for (unsigned i = 0; i < 2u * f->radius + 1u; i++) {
            rows[i] += f->radius;
        }
    }
    if (gives_sums(f->config.op)) {
        scale_row(f, rows, count, bytes, words);
    } else {
        byte_row(f->config.op, rows, count, bytes);
    }
    f->row++;
    return PEL_OK;
}

pel_status pel_filter_pull(pel_filter *f, uint8_t *out)
{
    return f && out ? pull(f, out, NULL) : PEL_ERR_ARG;
}

pel_status pel_filter_pull_s16(pel_filter *f, int16_t *out)
{
    if (!f || !out) {
        return PEL_ERR_ARG;
    }
    return f->state == STATE_ROWS && !gives_sums(f->config.op) ? PEL_ERR_FORMAT
                                                               : pull(f, NULL, out);
}
