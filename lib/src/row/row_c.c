/* All row kernels in plain C: the truth that every faster version must equal. */
#include "row/row.h"

#include "pel/fixed.h"

/* ---- Reading pixels ------------------------------------------------------------------------ */

void pel_row_read_pairs(const pel_row_pairs *src, uint16_t x, uint16_t count, uint8_t *y,
                        uint8_t *u, uint8_t *v)
{
    const uint8_t *src_y = src->y + (size_t)x * src->y_step;

    for (uint16_t i = 0; i < count; i++) {
        const size_t c = (size_t)((x + (size_t)i) >> 1) * src->c_step;
        y[i] = *src_y;
        u[i] = src->u[c];
        v[i] = src->v[c];
        src_y += src->y_step;
    }
}

void pel_row_read_rgb24(const uint8_t *src, uint16_t count, unsigned first, uint8_t *rgb)
{
    for (uint16_t i = 0; i < count; i++) {
        rgb[0] = src[first];
        rgb[1] = src[1];
        rgb[2] = src[2 - first];
        rgb += 3;
        src += 3;
    }
}

/* 5 or 6 bits become 8 by repeating the top bits below: 0 stays 0 and the maximum becomes 255. */
void pel_row_read_rgb565(const uint8_t *src, uint16_t count, unsigned low, uint8_t *rgb)
{
    for (uint16_t i = 0; i < count; i++) {
        const unsigned pixel = (unsigned)src[low] | (unsigned)src[1 - low] << 8;
        const unsigned r = pixel >> 11, g = pixel >> 5 & 63, b = pixel & 31;
        rgb[0] = (uint8_t)(r << 3 | r >> 2);
        rgb[1] = (uint8_t)(g << 2 | g >> 4);
        rgb[2] = (uint8_t)(b << 3 | b >> 2);
        rgb += 3;
        src += 2;
    }
}

void pel_row_read_bayer(const uint8_t *even, const uint8_t *odd, uint16_t count, unsigned red,
                        uint8_t *rgb)
{
    for (uint16_t i = 0; i < count; i++) {
        const uint8_t cell[4] = {even[0], even[1], odd[0], odd[1]};
        rgb[0] = cell[red];
        rgb[1] = (uint8_t)((cell[red ^ 1u] + cell[red ^ 2u] + 1) >> 1);
        rgb[2] = cell[red ^ 3u];
        rgb += 3;
        even += 2;
        odd += 2;
    }
}

/* ---- Colour spaces ------------------------------------------------------------------------- */

/*
 * The formulas of color.h as fractions, each with 1/2 added so that the division's floor rounds:
 * full:    Y = S / 1000, S = 299 R + 587 G + 114 B <= 255000
 *          U = 128 + P / 1772, P = 886 B - 299 R - 587 G, |P| <= 225930
 *          V = 128 + Q / 1402, Q = 701 R - 587 G - 114 B, |Q| <= 178755
 * limited: Y = 16 + 73 S / 85000, U = 128 + 56 P / 112965, V = 128 + 112 Q / 178755
 * The largest numerator is 224 * 178755 + 257 * 178755 < 2^27.
 */
static uint8_t luma(uint32_t s, int limited)
{
    return limited ? (uint8_t)((73 * s + 16 * UINT32_C(85000) + 42500) / 85000)
                   : (uint8_t)((s + 500) / 1000);
}

static uint8_t chroma_blue(int32_t p, int limited)
{
    return limited ? (uint8_t)((uint32_t)(112 * p + INT32_C(257) * 112965) / (2 * UINT32_C(112965)))
                   : pel_saturate_u8((p + INT32_C(128) * 1772 + 886) / 1772);
}

static uint8_t chroma_red(int32_t q, int limited)
{
    return limited ? (uint8_t)((uint32_t)(224 * q + INT32_C(257) * 178755) / (2 * UINT32_C(178755)))
                   : pel_saturate_u8((q + INT32_C(128) * 1402 + 701) / 1402);
}

void pel_row_rgb_to_ycbcr(const uint8_t *rgb, uint16_t count, int limited, uint8_t *y, uint8_t *u,
                          uint8_t *v, unsigned step)
{
    for (uint16_t i = 0; i < count; i++) {
        const int32_t r = rgb[0], g = rgb[1], b = rgb[2];
        *y = luma((uint32_t)(299 * r + 587 * g + 114 * b), limited);
        *u = chroma_blue(886 * b - 299 * r - 587 * g, limited);
        *v = chroma_red(701 * r - 587 * g - 114 * b, limited);
        rgb += 3;
        y += step;
        u += step;
        v += step;
    }
}

/* floor(n / d) for d > 0; *rest = what is left, 0..d-1. */
static int32_t floor_div(int32_t n, int32_t d, int32_t *rest)
{
    int32_t quotient = n / d;

    *rest = n % d;
    if (*rest < 0) {
        *rest += d;
        quotient--;
    }
    return quotient;
}

/* n / d to nearest, limited to 0..255. |n| < 2^30. */
static uint8_t round_div_u8(int32_t n, int32_t d)
{
    return pel_saturate_u8(pel_round_div(n, d));
}

/* y, cb, cr: Y 0..255, U - 128, V - 128. The largest numerator is 209599 * 128 + 101004 * 128 +
 * 256 * 293500 < 2^27. */
static void full_to_rgb(int32_t y, int32_t cb, int32_t cr, uint8_t *rgb)
{
    rgb[0] = round_div_u8(500 * y + 701 * cr, 500);
    rgb[1] = round_div_u8(293500 * y - 209599 * cr - 101004 * cb, 293500);
    rgb[2] = round_div_u8(250 * y + 443 * cb, 250);
}

/*
 * Limited: Y' = (Y - 16) * 85/73, R = Y' + 35751/22400 cr, B = Y' + 22593/11200 cb,
 * G = Y' - (10689549 cr + 5151204 cb) / 13148800. The common denominator of G does not fit 32 bits,
 * so its two fractions are rounded together from their remainders. Largest: 15840753 * 128 < 2^31.
 */
static void limited_to_rgb(int32_t y, int32_t cb, int32_t cr, uint8_t *rgb)
{
    const int32_t one = INT32_C(73) * 13148800; /* < 2^30 */
    int32_t luma_rest, chroma_rest, fraction, carry;
    const int32_t luma_whole = floor_div(85 * (y - 16), 73, &luma_rest);
    const int32_t chroma_whole = floor_div(10689549 * cr + 5151204 * cb, 13148800, &chroma_rest);

    fraction = luma_rest * 13148800 - chroma_rest * 73; /* between -one and one */
    carry = fraction >= one / 2 ? 1 : fraction < -(one / 2) ? -1 : 0;
    rgb[0] = round_div_u8(INT32_C(85) * 22400 * (y - 16) + INT32_C(35751) * 73 * cr,
                          INT32_C(73) * 22400);
    rgb[1] = pel_saturate_u8(luma_whole - chroma_whole + carry);
    rgb[2] = round_div_u8(INT32_C(85) * 11200 * (y - 16) + INT32_C(22593) * 73 * cb,
                          INT32_C(73) * 11200);
}

void pel_row_ycbcr_to_rgb(const uint8_t *y, const uint8_t *u, const uint8_t *v, unsigned step,
                          uint16_t count, int limited, uint8_t *rgb)
{
    for (uint16_t i = 0; i < count; i++) {
        const int32_t luma_value = *y, cb = *u - 128, cr = *v - 128;
        if (limited) {
            limited_to_rgb(luma_value, cb, cr, rgb);
        } else {
            full_to_rgb(luma_value, cb, cr, rgb);
        }
        rgb += 3;
        y += step;
        u += step;
        v += step;
    }
}

/* 255 n / d to nearest, halves upward; n <= d <= 765. */
static uint8_t part_of_255(uint32_t n, uint32_t d)
{
    return (uint8_t)((510 * n + d) / (2 * d));
}

void pel_row_rgb_to_nrgb(const uint8_t *rgb, uint16_t count, uint16_t sum_min, uint8_t *nrgb)
{
    for (uint16_t i = 0; i < count; i++) {
        const uint32_t r = rgb[0], g = rgb[1], b = rgb[2], sum = r + g + b;
        const int dark = sum == 0 || sum < sum_min;
        nrgb[0] = dark ? 85 : part_of_255(r, sum);
        nrgb[1] = dark ? 85 : part_of_255(g, sum);
        nrgb[2] = dark ? 85 : part_of_255(b, sum);
        rgb += 3;
        nrgb += 3;
    }
}

/* The hue of a colour whose channels lie `spread` apart: which channel is largest gives the third
 * of the circle, the difference of the other two the place in it, in sixths / spread. */
static uint8_t hue(int32_t r, int32_t g, int32_t b, int32_t max, int32_t spread)
{
    int32_t sixths;

    if (max == r) {
        sixths = g >= b ? g - b : g - b + 6 * spread;
    } else if (max == g) {
        sixths = 2 * spread + b - r;
    } else {
        sixths = 4 * spread + r - g;
    }
    return (uint8_t)((256 * sixths + 3 * spread) / (6 * spread));
}

void pel_row_rgb_to_hsv(const uint8_t *rgb, uint16_t count, uint8_t *hsv)
{
    for (uint16_t i = 0; i < count; i++) {
        const int32_t r = rgb[0], g = rgb[1], b = rgb[2];
        const int32_t max = r > g ? (r > b ? r : b) : (g > b ? g : b);
        const int32_t min = r < g ? (r < b ? r : b) : (g < b ? g : b);
        hsv[0] = max == min ? 0 : hue(r, g, b, max, max - min);
        hsv[1] = max == 0 ? 0 : part_of_255((uint32_t)(max - min), (uint32_t)max);
        hsv[2] = (uint8_t)max;
        rgb += 3;
        hsv += 3;
    }
}

/* ---- Classification ------------------------------------------------------------------------ */

/* The label of each 8-bit mask: 1 + the place of its lowest bit. */
#define L1(high) high, 1, 2, 1, 3, 1, 2, 1, 4, 1, 2, 1, 3, 1, 2, 1
static const uint8_t label_of_mask[256] = {L1(0), L1(5), L1(6), L1(5), L1(7), L1(5), L1(6), L1(5),
                                           L1(8), L1(5), L1(6), L1(5), L1(7), L1(5), L1(6), L1(5)};
#undef L1

static inline uint8_t label_of(pel_class_mask mask)
{
#if PEL_CLASS_MAX == 8
    return label_of_mask[mask];
#else
    uint8_t below = 0;
    uint32_t bits = mask;

    while (bits != 0 && (bits & 255) == 0) {
        bits >>= 8;
        below = (uint8_t)(below + 8);
    }
    return bits == 0 ? 0 : (uint8_t)(below + label_of_mask[bits & 255]);
#endif
}

uint8_t pel_row_label(pel_class_mask mask)
{
    return label_of(mask);
}

/* Two pairs at a time: most pixels are background, and most of those are told by their chroma
 * alone; then four of them are done after four look-ups. Called with constant steps, so that each
 * layout gets its own loop. */
static inline void classify_pairs(const pel_row_boxes *boxes, const pel_row_pairs *src,
                                  uint16_t count, uint8_t *labels, size_t y_step, size_t c_step)
{
    const pel_class_mask *const of_y = boxes->y, *const of_u = boxes->u, *const of_v = boxes->v;
    const uint8_t *const y = src->y, *const u = src->u, *const v = src->v;
    const size_t pairs = count / 2;
    size_t i = 0;

    for (; i + 2 <= pairs; i += 2) {
        const pel_class_mask left = of_u[u[i * c_step]] & of_v[v[i * c_step]];
        const pel_class_mask right = of_u[u[(i + 1) * c_step]] & of_v[v[(i + 1) * c_step]];
        if ((left | right) == 0) {
            labels[2 * i] = 0;
            labels[2 * i + 1] = 0;
            labels[2 * i + 2] = 0;
            labels[2 * i + 3] = 0;
        } else {
            labels[2 * i + 3] = label_of(right & of_y[y[(2 * i + 3) * y_step]]);
            labels[2 * i + 2] = label_of(right & of_y[y[(2 * i + 2) * y_step]]);
            labels[2 * i + 1] = label_of(left & of_y[y[(2 * i + 1) * y_step]]);
            labels[2 * i] = label_of(left & of_y[y[2 * i * y_step]]);
        }
    }
    for (i *= 2; i < count; i++) {
        const size_t c = i / 2 * c_step;
        labels[i] = label_of(of_u[u[c]] & of_v[v[c]] & of_y[y[i * y_step]]);
    }
}

void pel_row_classify_pairs(const pel_row_boxes *boxes, const pel_row_pairs *src, uint16_t count,
                            uint8_t *labels)
{
    if (src->y_step == 2) {
        classify_pairs(boxes, src, count, labels, 2, 4);
    } else {
        classify_pairs(boxes, src, count, labels, 1, src->c_step);
    }
}

void pel_row_classify(const pel_row_boxes *boxes, const uint8_t *y, const uint8_t *u,
                      const uint8_t *v, uint16_t count, uint8_t *labels)
{
    for (uint16_t i = 0; i < count; i++) {
        labels[i] = label_of(boxes->u[u[i]] & boxes->v[v[i]] & boxes->y[y[i]]);
    }
}

void pel_row_classify_lut(const pel_row_lut *lut, const uint8_t *y, const uint8_t *u,
                          const uint8_t *v, uint16_t count, uint8_t *labels)
{
    for (uint16_t i = 0; i < count; i++) {
        labels[i] = lut->cell[(uint32_t)(y[i] >> lut->y_drop) << lut->y_shift |
                              (uint32_t)(u[i] >> lut->u_drop) << lut->u_shift |
                              (uint32_t)(v[i] >> lut->v_drop)];
    }
}

void pel_row_map(const uint8_t *src, uint16_t count, const uint8_t *table, uint8_t *dst)
{
    for (uint16_t i = 0; i < count; i++) {
        dst[i] = table[src[i]];
    }
}

uint32_t pel_row_sum(const uint8_t *src, uint16_t count)
{
    uint32_t sum = 0;

    for (uint16_t i = 0; i < count; i++) {
        sum += src[i];
    }
    return sum;
}

/* ---- Runs ---------------------------------------------------------------------------------- */

/* A machine word of labels, to see at once that none of them differs from the run before. */
typedef size_t word;
enum { WORD_BYTES = sizeof(word) };

static inline word load_aligned(const uint8_t *labels)
{
#if defined(__GNUC__)
    word value;
    __builtin_memcpy(&value, __builtin_assume_aligned(labels, WORD_BYTES), WORD_BYTES);
    return value;
#else
    word value = 0;
    for (unsigned i = 0; i < WORD_BYTES; i++) {
        value |= (word)labels[i] << (8 * i);
    }
    return value;
#endif
}

/*
 * Runs lie in memory as x0, x1, x0, x1, ...: every change of the label writes one of these (a run
 * begins or ends) or two (a run ends and the next begins). `edge` is the place of the next one,
 * `label` the label so far, 0 outside runs.
 */
typedef struct run_writer {
    uint16_t *edge;
    word label;
} run_writer;

static inline run_writer change_label(run_writer writer, word label, unsigned x)
{
    writer.edge[0] = (uint16_t)x;
    writer.edge[1] = (uint16_t)x;
    writer.edge += (writer.label != 0) + (label != 0);
    writer.label = label;
    return writer;
}

static inline run_writer next_label(run_writer writer, word label, unsigned x)
{
    return label == writer.label ? writer : change_label(writer, label, x);
}

/* A word of labels that are not all equal to the one before it. Where finding the lowest set bit is
 * an instruction, only the changes are visited; elsewhere all labels are. */
#if defined(__GNUC__) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ &&                              \
    (defined(__x86_64__) || defined(__i386__) || defined(__aarch64__) ||                           \
     (defined(__ARM_ARCH) && __ARM_ARCH >= 7))

static inline unsigned lowest_byte(word bits)
{
    return (unsigned)(sizeof bits == 8 ? __builtin_ctzll(bits) : __builtin_ctz((unsigned)bits)) / 8;
}

/* The top bit of every byte that is not 0. */
static inline word nonzero_bytes(word w)
{
    const word low7 = (word)-1 / 255 * 0x7F;
    return (((w & low7) + low7) | w) & ~low7;
}

static inline run_writer scan_word(run_writer writer, const uint8_t *labels, unsigned x)
{
    const word here = load_aligned(labels + x), before = here << 8 | writer.label;
    const word both = nonzero_bytes(here) & nonzero_bytes(before);
    word changes = nonzero_bytes(here ^ before);

    if ((changes & both) == 0) { /* every change is a begin or an end: no label meets another */
        do {
            *writer.edge++ = (uint16_t)(x + lowest_byte(changes));
            changes &= changes - 1;
        } while (changes != 0);
        writer.label = here >> (8 * (WORD_BYTES - 1));
        return writer;
    }
    do {
        const unsigned place = x + lowest_byte(changes);
        writer = change_label(writer, labels[place], place);
        changes &= changes - 1;
    } while (changes != 0);
    return writer;
}
#else
static inline run_writer scan_word(run_writer writer, const uint8_t *labels, unsigned x)
{
    for (const unsigned end = x + WORD_BYTES; x < end; x++) {
        writer = next_label(writer, labels[x], x);
    }
    return writer;
}
#endif

uint16_t pel_row_find_runs(const uint8_t *labels, uint16_t count, uint16_t *edges)
{
    const word ones = (word)-1 / 255;
    run_writer writer = {edges, 0};
    const uint8_t *at = labels;
    const uint8_t *const end = labels + count, *words_end;

    for (; at != end && (uintptr_t)at % WORD_BYTES != 0; at++) {
        writer = next_label(writer, *at, (unsigned)(at - labels));
    }
    words_end = end - (size_t)(end - at) % WORD_BYTES;
    for (; at != words_end; at += WORD_BYTES) {
        if (load_aligned(at) != writer.label * ones) {
            writer = scan_word(writer, labels, (unsigned)(at - labels));
        }
    }
    for (; at != end; at++) {
        writer = next_label(writer, *at, (unsigned)(at - labels));
    }
    writer = next_label(writer, 0, count);
    return (uint16_t)((size_t)(writer.edge - edges) / 2);
}

uint16_t pel_row_classify_runs(const pel_row_boxes *boxes, const pel_row_pairs *src, uint16_t count,
                               uint8_t *labels, uint16_t *edges)
{
    pel_row_classify_pairs(boxes, src, count, labels);
    return pel_row_find_runs(labels, count, edges);
}
