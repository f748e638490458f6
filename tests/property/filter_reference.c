#include "filter_reference.h"

#include <math.h>
#include <stdlib.h>

/* ---- The picture and what lies around it --------------------------------------------------- */

/* Mirrors are walked: what is outside is thrown back at the edge, until it is inside. */
int64_t ref_place(int64_t i, int64_t length, pel_border border)
{
    while (i < 0 || i >= length) {
        const int64_t beyond = i < 0 ? -i : i - (length - 1); /* steps from the outermost pixel */
        switch (border) {
        case PEL_BORDER_REPLICATE:
            i = i < 0 ? 0 : length - 1;
            break;
        case PEL_BORDER_SYMMETRIC:
            i = i < 0 ? beyond - 1 : length - beyond;
            break;
        case PEL_BORDER_REFLECT101:
            i = length == 1 ? 0 : i < 0 ? beyond : length - 1 - beyond;
            break;
        case PEL_BORDER_WRAP:
            i = i < 0 ? i + length : i - length;
            break;
        default:
            return -1;
        }
    }
    return i;
}

static uint8_t pixel_at(const pel_filter_config *config, const ref_picture *picture, int64_t x,
                        int64_t y)
{
    const int64_t column = ref_place(x, picture->width, config->border);
    const int64_t row = ref_place(y, picture->height, config->border);
    if (column < 0 || row < 0) {
        return config->constant;
    }
    return picture->pixels[row * picture->width + column];
}

/* ---- Operators ----------------------------------------------------------------------------- */

static const struct {
    const char *name;
    pel_filter_op *bytes;
    pel_filter_op_s16 *words;
} ops[REF_OPS] = {
    {"kernel", NULL, NULL},
    {"gradient_abs", pel_op_gradient_abs, pel_op_gradient_abs_s16},
    {"gradient", pel_op_gradient, pel_op_gradient_s16},
    {"direction", pel_op_direction, NULL},
    {"median", pel_op_median, NULL},
    {"min", pel_op_min, NULL},
    {"max", pel_op_max, NULL},
    {"majority", pel_op_majority, NULL},
    {"erode_labels", pel_op_erode_labels, NULL},
    {"dilate_labels", pel_op_dilate_labels, NULL},
    {"gauss3", pel_op_gauss3, NULL},
    {"box3", pel_op_box3, NULL},
    {"binomial5", pel_op_binomial5, NULL},
    {"sobel_x", NULL, pel_op_sobel_x_s16},
    {"sobel_y", NULL, pel_op_sobel_y_s16},
};

void ref_set_op(pel_filter_config *config, ref_op op)
{
    config->op = ops[op].bytes;
    config->op_s16 = ops[op].words;
}

ref_op ref_op_of(const pel_filter_config *config)
{
    int op = REF_OPS - 1;
    while (op > 0 && (ops[op].bytes != config->op || ops[op].words != config->op_s16)) {
        op--;
    }
    return (ref_op)op;
}

const char *ref_op_name(ref_op op)
{
    return ops[op].name;
}

int ref_has_bytes(const pel_filter_config *config)
{
    return config->op != NULL || config->op_s16 == NULL;
}

int ref_has_words(const pel_filter_config *config)
{
    return config->op_s16 != NULL || config->op == NULL;
}

unsigned ref_radius(const pel_filter_config *config)
{
    const ref_op op = ref_op_of(config);
    return op == REF_KERNEL ? config->kernel->radius : op == REF_BINOMIAL5 ? 2 : 1;
}

static uint16_t side_of(const pel_filter_config *config, uint16_t side)
{
    const unsigned lost = config->border == PEL_BORDER_VALID ? 2 * ref_radius(config) : 0;
    return (uint16_t)(side - lost);
}

uint16_t ref_width(const pel_filter_config *config, const ref_picture *picture)
{
    return side_of(config, picture->width);
}

uint16_t ref_height(const pel_filter_config *config, const ref_picture *picture)
{
    return side_of(config, picture->height);
}

/* ---- Kernels ------------------------------------------------------------------------------- */

static int64_t floor_divided(int64_t numerator, int64_t divisor)
{
    const int64_t quotient = numerator / divisor;
    return numerator % divisor < 0 ? quotient - 1 : quotient;
}

static int64_t kernel_sum(const pel_kernel *kernel, const uint8_t *around)
{
    const unsigned side = 2u * kernel->radius + 1;
    int64_t sum = 0;
    for (unsigned k = 0; k < side * side; k++) {
        sum += (int64_t)kernel->tap[k] * around[k];
    }
    return sum;
}

/* round(sum / d) with halves upward is floor((2 sum + d) / 2 d). */
static int64_t kernel_result(const pel_kernel *kernel, const uint8_t *around)
{
    const int64_t divisor = (int64_t)(kernel->divisor == 0 ? 1 : kernel->divisor) << kernel->shift;
    int64_t sum = kernel_sum(kernel, around);
    if (kernel->absolute && sum < 0) {
        sum = -sum;
    }
    return floor_divided(2 * sum + divisor, 2 * divisor) + kernel->bias;
}

/* ---- Gradients ----------------------------------------------------------------------------- */

typedef struct gradient {
    int64_t x, y;
} gradient;

static gradient gradient_of(const uint8_t *a)
{
    gradient g;
    g.x = (a[2] + 2 * a[5] + a[8]) - (a[0] + 2 * a[3] + a[6]);
    g.y = (a[6] + 2 * a[7] + a[8]) - (a[0] + 2 * a[1] + a[2]);
    return g;
}

static int64_t length_of(gradient g)
{
    const int64_t square = g.x * g.x + g.y * g.y;
    int64_t root = (int64_t)sqrt((double)square);
    while (root * root > square) {
        root--;
    }
    while ((root + 1) * (root + 1) <= square) {
        root++;
    }
    return root;
}

/* No angle of two whole numbers lies halfway between two 256ths of a turn. */
static int64_t direction_of(gradient g)
{
    const double turn = 8.0 * atan(1.0);
    const double angle = g.x == 0 && g.y == 0 ? 0.0 : atan2((double)g.y, (double)g.x);
    return (int64_t)floor(angle / turn * 256.0 + 0.5) & 255;
}

/* ---- Ranks and labels ---------------------------------------------------------------------- */

static int compare_bytes(const void *a, const void *b)
{
    return *(const uint8_t *)a - *(const uint8_t *)b;
}

static void sort9(const uint8_t *around, uint8_t *sorted)
{
    for (unsigned k = 0; k < 9; k++) {
        sorted[k] = around[k];
    }
    qsort(sorted, 9, 1, compare_bytes);
}

static int64_t majority_of(const uint8_t *around)
{
    unsigned count[256] = {0}, most = 0;
    for (unsigned k = 0; k < 9; k++) {
        count[around[k]]++;
    }
    for (unsigned label = 0; label < 256; label++) {
        most = count[label] > most ? count[label] : most;
    }
    if (count[around[4]] == most) {
        return around[4];
    }
    for (unsigned label = 0; label < 256; label++) {
        if (count[label] == most) {
            return label;
        }
    }
    return -1;
}

static int64_t eroded_label(const uint8_t *sorted)
{
    return sorted[0] == sorted[8] ? sorted[0] : 0;
}

static int64_t dilated_label(uint8_t own, const uint8_t *sorted)
{
    if (own != 0) {
        return own;
    }
    for (unsigned k = 0; k < 9; k++) {
        if (sorted[k] != 0) {
            return sorted[k];
        }
    }
    return 0;
}

/* ---- Results ------------------------------------------------------------------------------- */

static const pel_kernel gauss3 = {{1, 2, 1, 2, 4, 2, 1, 2, 1}, 1, 16, 0, 0, 0};
static const pel_kernel box3 = {{1, 1, 1, 1, 1, 1, 1, 1, 1}, 1, 9, 0, 0, 0};
static const pel_kernel binomial5 = {
    {1, 4, 6, 4, 1, 4, 16, 24, 16, 4, 6, 24, 36, 24, 6, 4, 16, 24, 16, 4, 1, 4, 6, 4, 1},
    2,
    256,
    0,
    0,
    0};

static int64_t result_of(const pel_filter_config *config, const uint8_t *around)
{
    const gradient g = gradient_of(around);
    uint8_t sorted[9];
    sort9(around, sorted);
    switch (ref_op_of(config)) {
    case REF_KERNEL:
        return kernel_result(config->kernel, around);
    case REF_GRADIENT_ABS:
        return llabs(g.x) + llabs(g.y);
    case REF_GRADIENT:
        return length_of(g);
    case REF_DIRECTION:
        return direction_of(g);
    case REF_MEDIAN:
        return sorted[4];
    case REF_MIN:
        return sorted[0];
    case REF_MAX:
        return sorted[8];
    case REF_MAJORITY:
        return majority_of(around);
    case REF_ERODE_LABELS:
        return eroded_label(sorted);
    case REF_DILATE_LABELS:
        return dilated_label(around[4], sorted);
    case REF_GAUSS3:
        return kernel_result(&gauss3, around);
    case REF_BOX3:
        return kernel_result(&box3, around);
    case REF_BINOMIAL5:
        return kernel_result(&binomial5, around);
    case REF_SOBEL_X:
        return g.x;
    case REF_SOBEL_Y:
        return g.y;
    default:
        return -1;
    }
}

int64_t ref_result(const pel_filter_config *config, const ref_picture *picture, uint16_t x,
                   uint16_t y)
{
    const int64_t radius = ref_radius(config);
    const int64_t offset = config->border == PEL_BORDER_VALID ? radius : 0;
    uint8_t around[25];
    unsigned k = 0;
    for (int64_t dy = -radius; dy <= radius; dy++) {
        for (int64_t dx = -radius; dx <= radius; dx++) {
            around[k++] = pixel_at(config, picture, x + offset + dx, y + offset + dy);
        }
    }
    return result_of(config, around);
}

static int64_t limited(int64_t value, int64_t least, int64_t most)
{
    return value < least ? least : value > most ? most : value;
}

void ref_filter_u8(const pel_filter_config *config, const ref_picture *picture, uint8_t *results)
{
    const uint16_t width = ref_width(config, picture), height = ref_height(config, picture);
    for (uint16_t y = 0; y < height; y++) {
        for (uint16_t x = 0; x < width; x++) {
            *results++ = (uint8_t)limited(ref_result(config, picture, x, y), 0, 255);
        }
    }
}

void ref_filter_s16(const pel_filter_config *config, const ref_picture *picture, int16_t *results)
{
    const uint16_t width = ref_width(config, picture), height = ref_height(config, picture);
    for (uint16_t y = 0; y < height; y++) {
        for (uint16_t x = 0; x < width; x++) {
            *results++ = (int16_t)limited(ref_result(config, picture, x, y), -32768, 32767);
        }
    }
}
