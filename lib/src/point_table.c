/* Tables of 256 entries. */
#include "pel/point.h"

#include "pel/fixed.h"
#include "frames.h"
#include "point_wide.h"
#include "row/row_point_select.h"

pel_status pel_table_linear(int32_t alpha, int32_t beta, int32_t divisor, uint8_t table[256])
{
    const int32_t alpha_max = (int32_t)1 << 21; /* * 255 < 2^29; with beta at most 2^30 */
    const int32_t beta_max = (int32_t)1 << 29;

    if (!table || alpha < -alpha_max || alpha > alpha_max || beta < -beta_max || beta > beta_max ||
        divisor < 1 || divisor > (int32_t)1 << 30) {
        return PEL_ERR_ARG;
    }
    for (int32_t i = 0; i < 256; i++) {
        table[i] = pel_saturate_u8(pel_round_div(i * alpha + beta, divisor));
    }
    return PEL_OK;
}

pel_status pel_table_contrast(int32_t alpha, int32_t divisor, uint8_t pivot, uint8_t table[256])
{
    const int32_t limit = (int32_t)1 << 21;

    if (!table || alpha < -limit || alpha > limit || divisor < 1 || divisor > limit) {
        return PEL_ERR_ARG;
    }
    for (int32_t i = 0; i < 256; i++) {
        table[i] = pel_saturate_u8(pivot + pel_round_div((i - pivot) * alpha, divisor));
    }
    return PEL_OK;
}

pel_status pel_table_brightness(int16_t offset, uint8_t table[256])
{
    return pel_table_linear(1, offset, 1, table);
}

pel_status pel_table_invert(uint8_t table[256])
{
    return pel_table_linear(-1, 255, 1, table);
}

pel_status pel_table_threshold(uint8_t threshold, uint8_t table[256])
{
    if (!table) {
        return PEL_ERR_ARG;
    }
    for (unsigned i = 0; i < 256; i++) {
        table[i] = i > threshold ? 255 : 0;
    }
    return PEL_OK;
}

/* ---- Power curves -------------------------------------------------------------------------- */

/* The largest number is 510^32 < 2^288. */
enum { GAMMA_LIMBS = 9 };

static void multiply_power(uint32_t *wide, uint32_t base, unsigned exponent)
{
    for (unsigned i = 0; i < exponent; i++) {
        pel_i_wide_multiply(wide, GAMMA_LIMBS, base);
    }
}

/*
 * out + 1 is reached when 255 (in / 255)^(n / d) >= out + 1/2, that is, when
 *     (2 out + 1)^d * 255^n <= 510^d * in^n.
 * Divided by 255^n or 255^d, whichever is smaller, these are the two sides.
 */
static void set_next(uint32_t *side, unsigned out, unsigned n, unsigned d)
{
    pel_i_wide_set(side, GAMMA_LIMBS, 1);
    multiply_power(side, 2 * (uint32_t)out + 1, d);
    multiply_power(side, 255, n > d ? n - d : 0);
}

static void set_reached(uint32_t *side, unsigned in, unsigned n, unsigned d)
{
    pel_i_wide_set(side, GAMMA_LIMBS, 1);
    multiply_power(side, 2, d);
    multiply_power(side, in, n);
    multiply_power(side, 255, d > n ? d - n : 0);
}

static int is_gamma_term(unsigned number)
{
    return number >= 1 && number <= PEL_GAMMA_TERM_MAX;
}

/* Both sides grow: one walk up finds the whole table. */
pel_status pel_table_gamma_exponent(unsigned numerator, unsigned denominator, uint8_t table[256])
{
    uint32_t reached[GAMMA_LIMBS], next[GAMMA_LIMBS];
    unsigned out = 0;

    if (!table || !is_gamma_term(numerator) || !is_gamma_term(denominator)) {
        return PEL_ERR_ARG;
    }
    set_next(next, 0, numerator, denominator);
    for (unsigned in = 0; in < 256; in++) {
        set_reached(reached, in, numerator, denominator);
        while (out < 255 && pel_i_wide_not_over(next, reached, GAMMA_LIMBS)) {
            out++;
            set_next(next, out, numerator, denominator);
        }
        table[in] = (uint8_t)out;
    }
    return PEL_OK;
}

static pel_status check_gamma(unsigned numerator, unsigned denominator)
{
    if (!is_gamma_term(numerator) || !is_gamma_term(denominator)) {
        return PEL_ERR_ARG;
    }
    return numerator < denominator ? PEL_ERR_RANGE : PEL_OK;
}

pel_status pel_table_gamma_brighten(unsigned numerator, unsigned denominator, uint8_t table[256])
{
    const pel_status status = check_gamma(numerator, denominator);
    return status != PEL_OK ? status : pel_table_gamma_exponent(denominator, numerator, table);
}

pel_status pel_table_gamma_darken(unsigned numerator, unsigned denominator, uint8_t table[256])
{
    const pel_status status = check_gamma(numerator, denominator);
    return status != PEL_OK ? status : pel_table_gamma_exponent(numerator, denominator, table);
}

/* ---- Using a table ------------------------------------------------------------------------- */

pel_status pel_table_row(const uint8_t table[256], const uint8_t *src, uint16_t count, uint8_t *dst)
{
    pel_backend backend;
    pel_row_curve curve;

    if (!table || !src || !dst) {
        return PEL_ERR_ARG;
    }
    backend = pel_i_row_backend(PEL_BACKEND_AUTO);
    curve = pel_i_row_curve(backend, table, count);
    pel_i_row_map(backend, &curve, src, count, dst);
    return PEL_OK;
}

pel_status pel_table_frame_with(const uint8_t table[256], const pel_cview *src, const pel_view *dst,
                                pel_backend backend)
{
    const pel_status status = table ? pel_i_check_pair(src, dst) : PEL_ERR_ARG;
    pel_row_curve curve;
    uint16_t count;

    if (status != PEL_OK) {
        return status;
    }
    count = (uint16_t)pel_row_bytes(src->format, src->width);
    backend = pel_i_row_backend(backend);
    curve = pel_i_row_curve(backend, table, (uint32_t)count * src->height);
    for (uint16_t y = 0; y < src->height; y++) {
        pel_i_row_map(backend, &curve, pel_i_row(src, y), count, pel_i_row_to_write(dst, y));
    }
    return PEL_OK;
}

pel_status pel_table_frame(const uint8_t table[256], const pel_cview *src, const pel_view *dst)
{
    return pel_table_frame_with(table, src, dst, PEL_BACKEND_AUTO);
}
