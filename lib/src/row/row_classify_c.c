/*
 * Row kernels in plain C, the truth that every faster version must equal: from pixels to labels.
 * Compiled for size, pixels are taken one by one, otherwise by pairs.
 */
#include "row/row_label.h"

#if defined(__OPTIMIZE_SIZE__)
static inline uint8_t label_of(pel_class_mask mask)
{
    return mask != 0 ? pel_i_label(mask) : 0;
}
#else
/* The label of each 8-bit mask: 1 + the place of its lowest bit. Looking it up is faster than
 * finding the bit where every pixel's is wanted, but takes 256 bytes. */
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
#endif

uint8_t pel_row_label(pel_class_mask mask)
{
    return label_of(mask);
}

#if defined(__OPTIMIZE_SIZE__)
void pel_row_classify_pairs(const pel_row_boxes *boxes, const pel_row_pairs *src, uint16_t count,
                            uint8_t *labels)
{
    const pel_class_mask *const of_y = boxes->y, *const of_u = boxes->u, *const of_v = boxes->v;
    const uint8_t *y = src->y, *u = src->u, *v = src->v;
    const size_t y_step = src->y_step, c_step = src->c_step;
    pel_class_mask chroma = 0;

    for (uint16_t x = 0; x < count; x++) {
        if (x % 2 == 0) {
            chroma = of_u[*u] & of_v[*v];
            u += c_step;
            v += c_step;
        }
        labels[x] = label_of(chroma & of_y[*y]);
        y += y_step;
    }
}
#else
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
#endif

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
