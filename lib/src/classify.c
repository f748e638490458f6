#include "pel/classify.h"

#include "classifier.h"
#include "format.h"
#include "row/row_color_select.h"

/* ---- Boxes and tables ---------------------------------------------------------------------- */

static void set_interval(pel_class_mask table[256], pel_class_mask bit, unsigned min, unsigned max)
{
    for (unsigned i = 0; i < 256; i++) {
        const pel_class_mask others = (pel_class_mask)(table[i] & (pel_class_mask)~bit);
        table[i] = i >= min && i <= max ? (pel_class_mask)(others | bit) : others;
    }
}

pel_status pel_boxes_set(pel_boxes *boxes, unsigned class_index, const pel_color_box *box)
{
    pel_class_mask bit;

    if (!boxes || !box || class_index >= PEL_CLASS_MAX) {
        return PEL_ERR_ARG;
    }
    bit = (pel_class_mask)((uint32_t)1 << class_index);
    set_interval(boxes->y, bit, box->y_min, box->y_max);
    set_interval(boxes->u, bit, box->u_min, box->u_max);
    set_interval(boxes->v, bit, box->v_min, box->v_max);
    return PEL_OK;
}

uint32_t pel_lut_bytes(unsigned y_bits, unsigned u_bits, unsigned v_bits)
{
    return PEL_LUT_BYTES(y_bits, u_bits, v_bits);
}

static pel_row_lut row_lut(const pel_lut *lut)
{
    pel_row_lut out;

    out.cell = lut->cell;
    out.y_drop = (uint8_t)(8 - lut->y_bits);
    out.u_drop = (uint8_t)(8 - lut->u_bits);
    out.v_drop = (uint8_t)(8 - lut->v_bits);
    out.u_shift = lut->v_bits;
    out.y_shift = (uint8_t)(lut->u_bits + lut->v_bits);
    return out;
}

static pel_status check_classifier(const pel_classifier *classifier)
{
    const pel_lut *lut = &classifier->lut;

    if ((unsigned)classifier->range > PEL_RANGE_LIMITED) {
        return PEL_ERR_ARG;
    }
    if (classifier->boxes) {
        return PEL_OK;
    }
    return lut->cell && lut->y_bits <= 8 && lut->u_bits <= 8 && lut->v_bits <= 8 ? PEL_OK
                                                                                 : PEL_ERR_ARG;
}

/* ---- Rows ---------------------------------------------------------------------------------- */

static void classify_yuv(const pel_classifier *classifier, const uint8_t *y, const uint8_t *u,
                         const uint8_t *v, uint16_t count, uint8_t *labels)
{
    const uint8_t *const yuv[3] = {y, u, v};

    if (classifier->boxes) {
        const pel_classify_plan *const plan = classifier->plan;
        const pel_row_boxes boxes = pel_i_row_boxes(classifier);
        pel_i_row_classify(plan ? plan->backend : PEL_ROW_BUILT_IN, plan ? plan->nibbles : NULL,
                           &boxes, yuv, count, labels);
    } else {
        const pel_row_lut lut = row_lut(&classifier->lut);
        pel_i_row_classify_lut(pel_i_row_backend(PEL_BACKEND_AUTO), &lut, yuv, count, labels);
    }
}

/* Pixels read at a time: U and V lie on the stack, Y where the labels will. What converts many at
 * once wants many. */
#if defined(PEL_ROW_COLOR)
enum { CHUNK = 64 };
#else
enum { CHUNK = 8 };
#endif

/* Whatever the reader reads. */
void pel_classify_pieces(const pel_classifier *classifier, const pel_crow *row, uint16_t width,
                         uint8_t *labels)
{
    for (uint16_t x = 0; x < width; x = (uint16_t)(x + CHUNK)) {
        uint8_t u[CHUNK], v[CHUNK];
        const uint16_t n = (uint16_t)(width - x < CHUNK ? width - x : CHUNK);
        (void)classifier->reader(row, x, n, classifier->range, labels, u, v); /* checked before */
        classify_yuv(classifier, labels, u, v, n, labels);
        labels += n;
    }
}

/* Boxes need no reader where the row is YCbCr. */
static int works_in_place(const pel_classifier *classifier, const pel_crow *row)
{
    return classifier->boxes && pel_i_format_of(row)->layout == PEL_LAYOUT_PAIRS;
}

pel_status pel_i_classify_check(const pel_classifier *classifier, const pel_crow *row,
                                uint8_t *labels)
{
    pel_status status = classifier && labels ? pel_crow_check(row) : PEL_ERR_ARG;

    if (status == PEL_OK) {
        status = check_classifier(classifier);
    }
    if (status != PEL_OK) {
        return status;
    }
    if (pel_i_crow_overlaps(row, labels, pel_color_width(row->format, row->width))) {
        return PEL_ERR_ARG;
    }
    if (works_in_place(classifier, row)) {
        return row->range == classifier->range ? PEL_OK : PEL_ERR_FORMAT;
    }
    return classifier->reader && classifier->pieces
               ? classifier->reader(row, 0, 0, classifier->range, labels, labels, labels)
               : PEL_ERR_FORMAT;
}

static void classify_in_place(const pel_classifier *classifier, const pel_crow *row, uint16_t width,
                              uint8_t *labels)
{
    const pel_classify_plan *const plan = classifier->plan;
    const pel_row_boxes boxes = pel_i_row_boxes(classifier);
    const pel_row_pairs pairs = pel_i_pairs(pel_i_format_of(row), row);

    pel_i_row_classify_pairs(plan ? plan->backend : PEL_ROW_BUILT_IN, plan ? plan->nibbles : NULL,
                             &boxes, &pairs, width, labels);
}

static void classify(const pel_classifier *classifier, const pel_crow *row, uint16_t width,
                     uint8_t *labels)
{
    if (works_in_place(classifier, row)) {
        classify_in_place(classifier, row, width, labels);
    } else {
        classifier->pieces(classifier, row, width, labels);
    }
    if (classifier->relabel) {
        pel_row_map(labels, width, classifier->relabel, labels);
    }
}

pel_status pel_classify_row(const pel_classifier *classifier, const pel_crow *row, uint8_t *labels)
{
    const pel_status status = pel_i_classify_check(classifier, row, labels);

    if (status == PEL_OK) {
        classify(classifier, row, pel_color_width(row->format, row->width), labels);
    }
    return status;
}

/* What does both at once takes more code than one after the other. */
#if defined(__OPTIMIZE_SIZE__)
enum { AT_ONCE = 0 };
#else
enum { AT_ONCE = 1 };
#endif

uint16_t pel_i_classify_runs(const pel_classifier *classifier, const pel_crow *row, uint16_t width,
                             pel_backend backend, uint8_t *labels, uint16_t *edges)
{
    if (AT_ONCE && works_in_place(classifier, row) && !classifier->relabel) {
        const pel_row_pairs pairs = pel_i_pairs(pel_i_format_of(row), row);
        return pel_i_box_runs(classifier, &pairs, width, labels, edges);
    }
    classify(classifier, row, width, labels);
    return pel_i_row_find_runs(backend, labels, width, edges);
}

uint8_t pel_classify_color(const pel_classifier *classifier, uint8_t y, uint8_t u, uint8_t v)
{
    uint8_t label;

    if (!classifier || check_classifier(classifier) != PEL_OK) {
        return 0;
    }
    classify_yuv(classifier, &y, &u, &v, 1, &label);
    return classifier->relabel ? classifier->relabel[label] : label;
}

/* Whether two views share memory, if only between their rows. */
static int views_overlap(const pel_cview *a, const pel_cview *labels)
{
    const ptrdiff_t reach = (ptrdiff_t)labels->stride_bytes[0] * (labels->height - 1);
    const uint8_t *const lowest = labels->plane[0] + (reach < 0 ? reach : 0);
    return pel_i_view_overlaps(a, lowest, (size_t)(reach < 0 ? -reach : reach) + labels->width);
}

/* What pel_classify_frame refuses; what the first row is refused for, all are. */
PEL_I_APART static pel_status check_frame(const pel_classifier *classifier, const pel_cview *view,
                                          const pel_view *labels)
{
    const pel_cview out = pel_view_to_read(labels);
    pel_status status = classifier && view && labels ? pel_cview_check(view) : PEL_ERR_ARG;
    pel_crow row;

    if (status == PEL_OK) {
        status = pel_cview_check(&out);
    }
    if (status != PEL_OK) {
        return status;
    }
    if (out.format != PEL_GRAY8) {
        return PEL_ERR_FORMAT;
    }
    if (out.width != pel_color_width(view->format, view->width) ||
        out.height != pel_color_height(view->format, view->height)) {
        return PEL_ERR_SPACE;
    }
    if (views_overlap(view, &out)) {
        return PEL_ERR_ARG;
    }
    row = pel_cview_row(view, 0);
    return pel_i_classify_check(classifier, &row, labels->plane[0]);
}

pel_status pel_classify_frame(const pel_classifier *classifier, const pel_cview *view,
                              const pel_view *labels)
{
    const pel_status status = check_frame(classifier, view, labels);

    for (uint16_t y = 0; status == PEL_OK && y < labels->height; y++) {
        const pel_crow row = pel_cview_row(view, y);
        classify(classifier, &row, labels->width,
                 labels->plane[0] + (ptrdiff_t)labels->stride_bytes[0] * y);
    }
    return status;
}
