#include "pel/filter.h"

#include "filter_compute.h"
#include "filter_radius.h"

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

/* The slot `below` ones after that of the next row to be pushed; below: 0..2r. */
static unsigned slot_after(const pel_filter *f, unsigned below)
{
    const unsigned slots = 2u * f->radius + 1u, slot = f->slot + below;
    return slot < slots ? slot : slot - slots;
}

static void fill(uint8_t *row, uint8_t value, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        row[i] = value;
    }
}

/* Which pixels of a row stand on either side of it: the same ones in every row. */
static void find_sides(pel_filter *f)
{
    const int32_t width = f->config.width;

    for (int32_t i = 0; i < f->radius; i++) {
        f->left[i] = (int16_t)pel_border_index(-1 - i, width, f->config.border);
        f->right[i] = (int16_t)pel_border_index(width + i, width, f->config.border);
    }
}

static void put_row(const pel_filter *f, const uint8_t *src, uint8_t *row)
{
    uint8_t *left = row, *right = row + f->config.width;

    PEL_BEST_COPY(src, f->config.width, row);
    for (unsigned i = 0; i < f->radius; i++) {
        *--left = f->left[i] < 0 ? f->config.constant : row[f->left[i]];
        *right++ = f->right[i] < 0 ? f->config.constant : row[f->right[i]];
    }
}

/* The rows above the picture: those that are copies need nothing, the others go into the slots
 * before that of the first row. */
static void put_rows_above(const pel_filter *f)
{
    const unsigned r = f->radius;

    for (unsigned i = 0; i < r; i++) {
        uint8_t *const row = slot_at(f, r + 1 + i);
        if (f->config.border == PEL_BORDER_WRAP) {
            put_row(f, f->config.last_rows[i], row);
        } else {
            fill(row - r, f->config.constant, slot_bytes(f));
        }
    }
}

/* The row `below` rows under the last one, likewise; all rows have been pushed. */
static void put_row_below(const pel_filter *f, unsigned below)
{
    uint8_t *const row = slot_at(f, slot_after(f, below - 1));

    if (f->config.border == PEL_BORDER_WRAP) {
        const size_t kept = 2u * f->radius + 1u + (below - 1) % f->config.height;
        put_row(f, slot_at(f, kept), row);
    } else if (f->config.border == PEL_BORDER_CONSTANT) {
        fill(row - f->radius, f->config.constant, slot_bytes(f));
    }
}

/* Of the rows around row y of the picture those outside it: `below` ones under it go into their
 * slots, if they have not; those that are copies are where the copied ones are. */
void pel_i_filter_rows_outside(const pel_filter *f, unsigned y, unsigned below,
                               const uint8_t *rows[5])
{
    const int32_t r = f->radius, top = (int32_t)y - r;

    for (unsigned i = 1; i <= below; i++) {
        put_row_below(f, i);
    }
    for (int32_t i = 0; i <= 2 * r && f->config.border != PEL_BORDER_WRAP; i++) {
        const int32_t copy = pel_border_index(top + i, f->config.height, f->config.border);
        if (copy >= 0 && copy != top + i) {
            rows[i] = slot_at(f, (size_t)(copy % (2 * r + 1)));
        }
    }
}

/* The rows in the slots, at the first pixel that has a result, from the `below`th one on after that
 * of the next row to be pushed: at 0 the oldest one is the first. */
static void rows_of_slots(const pel_filter *f, unsigned below, const uint8_t *rows[5])
{
    const unsigned r = f->radius, slots = 2 * r + 1;
    const size_t bytes = slot_bytes(f), x = f->config.border == PEL_BORDER_VALID ? r : 0;
    unsigned until_last = slots - slot_after(f, below);
    const uint8_t *row = slot_at(f, slots - until_last) + x;

    for (unsigned i = 0; i < slots; i++) {
        rows[i] = row;
        row += bytes;
        if (--until_last == 0) {
            row -= slots * bytes;
        }
    }
}

/* ---- Begin --------------------------------------------------------------------------------- */

/* Whether it is the kernel, and no operator, that is to be computed. */
static int is_kernel(const pel_filter_config *c)
{
    return !c->op && !c->op_s16;
}

unsigned pel_i_filter_radius(const pel_filter_config *c)
{
    const unsigned words = c->op_s16 ? c->op_s16(NULL, 0, c, NULL) : 0;
    const unsigned radius = c->op       ? c->op(NULL, 0, c, NULL)
                            : c->op_s16 ? words
                            : c->kernel ? c->kernel->radius
                                        : 0;

    return radius > 2 || (c->op_s16 && words != radius) ? 0 : radius;
}

uint32_t pel_filter_bytes(uint16_t width, unsigned radius, pel_border border)
{
    return border == PEL_BORDER_WRAP ? PEL_FILTER_BYTES_WRAP(width, radius)
                                     : PEL_FILTER_BYTES(width, radius);
}

static uint16_t less_border(uint16_t side, const pel_filter_config *c, unsigned radius)
{
    return (uint16_t)(c->border == PEL_BORDER_VALID ? side - 2 * radius : side);
}

uint16_t pel_filter_width(const pel_filter_config *config)
{
    return less_border(config->width, config, pel_i_filter_radius(config));
}

uint16_t pel_filter_height(const pel_filter_config *config)
{
    return less_border(config->height, config, pel_i_filter_radius(config));
}

static pel_status check_operator(const pel_filter_config *c, unsigned radius)
{
    if (radius == 0 || (unsigned)c->border > PEL_BORDER_VALID ||
        (unsigned)c->backend >= PEL_BACKEND_COUNT ||
        (is_kernel(c) && (c->kernel->divisor > 32767 || c->kernel->shift > 15))) {
        return PEL_ERR_ARG;
    }
    return c->border == PEL_BORDER_WRAP && (!c->last_rows[0] || (radius == 2 && !c->last_rows[1]))
               ? PEL_ERR_ARG
               : PEL_OK;
}

static pel_status check_filter(const pel_filter_config *c, unsigned radius)
{
    const pel_status status = c->work ? check_operator(c, radius) : PEL_ERR_ARG;
    const unsigned least = c->border == PEL_BORDER_VALID ? 2 * radius + 1 : 1;

    if (status != PEL_OK) {
        return status;
    }
    if (c->width < least || c->height < least || c->width > PEL_SIDE_MAX ||
        c->height > PEL_SIDE_MAX) {
        return PEL_ERR_RANGE;
    }
    return c->work_bytes < pel_filter_bytes(c->width, radius, c->border) ? PEL_ERR_SPACE : PEL_OK;
}

pel_status pel_filter_begin(pel_filter *f, const pel_filter_config *config)
{
    const unsigned radius = f && config ? pel_i_filter_radius(config) : 0;
    const pel_status status = f && config ? check_filter(config, radius) : PEL_ERR_ARG;

    if (status != PEL_OK) {
        return status;
    }
    f->config = *config;
    f->config.backend = pel_i_row_backend(config->backend);
    f->radius = (uint8_t)radius;
    f->pushed = 0;
    f->row = 0;
    f->slot = 0;
    find_sides(f);
    put_rows_above(f);
    return PEL_OK;
}

/* ---- Push and pull ------------------------------------------------------------------------- */

/* A row of the result waits for the r rows below it, as long as there are some to come. A filter
 * of zeros, which has not begun, is never ready. */
static int is_ready(const pel_filter *f)
{
    const unsigned ahead = f->config.border == PEL_BORDER_VALID ? 2u * f->radius
                           : f->pushed < f->config.height       ? f->radius
                                                                : 0;
    return f->row + ahead < f->pushed;
}

pel_status pel_filter_push(pel_filter *f, const uint8_t *row)
{
    if (!f || !row) {
        return PEL_ERR_ARG;
    }
    if (f->pushed >= f->config.height || is_ready(f)) {
        return PEL_ERR_ORDER;
    }
    put_row(f, row, slot_at(f, f->slot));
    if (f->config.border == PEL_BORDER_WRAP && f->pushed < f->radius) {
        put_row(f, row, slot_at(f, 2u * f->radius + 1u + f->pushed));
    }
    f->slot = (uint8_t)slot_after(f, 1);
    f->pushed++;
    return PEL_OK;
}

/* The rows around the first pixel of the next result, whose turn it is; how many results there
 * are. */
static uint16_t next_window(pel_filter *f, const uint8_t *rows[5])
{
    const unsigned centre = f->row + (f->config.border == PEL_BORDER_VALID ? f->radius : 0u);
    const unsigned below = centre + f->radius + 1 - f->pushed;

    rows_of_slots(f, below, rows);
    if (below > 0 || centre < f->radius) {
        pel_i_filter_rows_outside(f, centre, below, rows);
    }
    f->row++;
    return less_border(f->config.width, &f->config, f->radius);
}

pel_status pel_filter_pull(pel_filter *f, uint8_t *out)
{
    const uint8_t *rows[5];
    uint16_t count;

    if (!f || !out) {
        return PEL_ERR_ARG;
    }
    if (f->config.op_s16 && !f->config.op) {
        return PEL_ERR_FORMAT;
    }
    if (!is_ready(f)) {
        return PEL_ERR_ORDER;
    }
    count = next_window(f, rows);
    pel_i_filter_compute(&f->config, f->radius, rows, count, out);
    return PEL_OK;
}

pel_status pel_filter_pull_s16(pel_filter *f, int16_t *out)
{
    const uint8_t *rows[5];
    uint16_t count;

    if (!f || !out) {
        return PEL_ERR_ARG;
    }
    if (f->config.op && !f->config.op_s16) {
        return PEL_ERR_FORMAT;
    }
    if (!is_ready(f)) {
        return PEL_ERR_ORDER;
    }
    count = next_window(f, rows);
    pel_i_filter_compute_s16(&f->config, f->radius, rows, count, out);
    return PEL_OK;
}
