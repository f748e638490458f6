/*
 * Runs every operator of the library on a picture of 320x240 and marks for plugin.c what belongs to
 * it. The table below is the only place that names them: a new operator is a new line.
 *
 * Writes `job NAME CHECKSUM NUMBER` lines, with tabs between, in the order of the plugin's sums.
 */
#include "count.h"

#include "semihost.h"

#if !defined(COUNT_SMALL)
#error "COUNT_SMALL is 1 for boards with 16 KiB of RAM, else 0"
#endif

uint64_t work[(WORK_BYTES + 7u) / 8u];
uint64_t results[(RESULTS_BYTES + 7u) / 8u];
uint32_t output_row[WIDTH + 1];
uint8_t labels[WIDTH];
pel_boxes picture_classes;
pel_status worst;
#if !COUNT_SMALL
uint8_t frame[WIDTH * HEIGHT];
#endif

enum { BASIC = 0, ALL = PEL_MEASURE_MOMENTS | PEL_MEASURE_OUTLINE };

/* Kernels that no named one is: with a shift, and with a divisor. */
static const pel_kernel generic3 = {
    .tap = {1, -2, 3, -4, 12, 5, -6, 7, -8}, .radius = 1, .shift = 3};
static const pel_kernel generic3_divided = {
    .tap = {1, -2, 3, -4, 12, 5, -6, 7, -8}, .radius = 1, .divisor = 9};
static const pel_kernel generic5 = {
    .tap = {1, -2, 3, -4, 5, -6, 7, -8, 9, -1, 2, -3, 30, 5, -6, 7, -8, 9, -1, 2, -3, 4, -5, 6, -7},
    .radius = 2,
    .shift = 5};

#define CLASSIFY(format) FEED_CAMERA, &classify_boxes, PEL_##format, 0, NULL
#define CLASSIFY_TABLE(format) FEED_CAMERA, &classify_table, PEL_##format, 0, NULL
#define READ_YUV(format) FEED_CAMERA, &read_yuv, PEL_##format, 0, NULL
#define READ_RGB(format) FEED_CAMERA, &read_rgb, PEL_##format, 0, NULL
#define CHAIN(measure) FEED_CAMERA, &chain, PEL_YUYV, measure, NULL
#define FILTER_OF(feed, family, ...)                                                               \
    feed, family, 0, PEL_BORDER_REPLICATE, &(const filter_choice)                                  \
    {                                                                                              \
        __VA_ARGS__                                                                                \
    }
#define KERNEL(taps) FILTER_OF(FEED_GRAY, &filter_row, .kernel = taps)
#define NAMED(by_name) FILTER_OF(FEED_GRAY, &filter_row, .name = by_name)
#define FILTER(of) FILTER_OF(FEED_GRAY, &filter_row, .op = pel_op_##of)
#define FILTER_S16(of) FILTER_OF(FEED_GRAY, &filter_row_s16, .op_s16 = pel_op_##of##_s16)
#define LABEL_FILTER(of) FILTER_OF(FEED_LABELS, &filter_row, .op = pel_op_##of)
#define BORDER(border)                                                                             \
    FEED_GRAY, &filter_row, 0, PEL_BORDER_##border, &(const filter_choice)                         \
    {                                                                                              \
        .kernel = &generic3                                                                        \
    }
#define COMBINE(op) FEED_TWO_GRAYS, &combine_row, PEL_COMBINE_##op, 0, NULL
#define RESIZE(method, width) FEED_GRAY, &resize_row, PEL_RESIZE_##method, width, NULL
#define CORNERS(method, least) FEED_GRAY, &corner_rows, PEL_CORNERS_##method, least, NULL

static const job jobs[] = {
    {"classify yuyv", "synth", CLASSIFY(YUYV)},
    {"classify uyvy", "synth", CLASSIFY(UYVY)},
    {"classify nv12", "synth", CLASSIFY(NV12)},
    {"classify i420", "synth", CLASSIFY(I420)},
    {"classify gray8", "synth", CLASSIFY(GRAY8)},
    {"classify rgb565-le", "synth", CLASSIFY(RGB565_LE)},
    {"classify rgb565-be", "synth", CLASSIFY(RGB565_BE)},
    {"classify rgb888", "synth", CLASSIFY(RGB888)},
    {"classify bgr888", "synth", CLASSIFY(BGR888)},
    {"classify bayer", "synth", CLASSIFY(BAYER8_RGGB)},
    {"classify table yuyv", "synth", CLASSIFY_TABLE(YUYV)},
    {"classify table rgb565-le", "synth", CLASSIFY_TABLE(RGB565_LE)},
    {"runs synth", "synth", FEED_LABELS, &runs_of_labels, 0, 0, NULL},
    {"classify and runs synth", "synth", FEED_CAMERA, &classify_runs, PEL_YUYV, 0, NULL},
    {"classify and runs china", "china", FEED_CAMERA, &classify_runs, PEL_YUYV, 0, NULL},

    {"blobs basic synth", "synth", CHAIN(BASIC)},
    {"blobs basic china", "china", CHAIN(BASIC)},
    {"blobs basic rand4", "rand4", CHAIN(BASIC)},
    {"blobs basic rand1", "rand1", CHAIN(BASIC)},
    {"blobs all synth", "synth", CHAIN(ALL)},
    {"blobs all china", "china", CHAIN(ALL)},
    {"blobs all rand4", "rand4", CHAIN(ALL)},
    {"blobs all rand1", "rand1", CHAIN(ALL)},
    {"blobs color synth", "synth", CHAIN(PEL_MEASURE_COLOR)},

    {"read yuv yuyv", "synth", READ_YUV(YUYV)},
    {"read yuv rgb565-le", "synth", READ_YUV(RGB565_LE)},
    {"read yuv bayer", "synth", READ_YUV(BAYER8_RGGB)},
    {"read rgb yuyv", "synth", READ_RGB(YUYV)},
    {"read rgb rgb565-le", "synth", READ_RGB(RGB565_LE)},
    {"color rgb to ycbcr", "synth", FEED_RGB, &color_row, 0, 0, NULL},
    {"color ycbcr to rgb", "synth", FEED_YCBCR, &color_row, 1, 0, NULL},
    {"color rgb to nrgb", "synth", FEED_RGB, &color_row, 2, 0, NULL},
    {"color rgb to hsv", "synth", FEED_RGB, &color_row, 3, 0, NULL},

    {"filter identity", "synth", NAMED("identity")},
    {"filter shift_left", "synth", NAMED("shift_left")},
    {"filter box3", "synth", FILTER(box3)},
    {"filter gauss3", "synth", FILTER(gauss3)},
    {"filter gauss5", "synth", NAMED("gauss5")},
    {"filter binomial5", "synth", FILTER(binomial5)},
    {"filter sobel_x", "synth", NAMED("sobel_x")},
    {"filter sobel_y", "synth", NAMED("sobel_y")},
    {"filter scharr_x", "synth", NAMED("scharr_x")},
    {"filter prewitt_x", "synth", NAMED("prewitt_x")},
    {"filter laplacian", "synth", NAMED("laplacian")},
    {"filter laplacian_negative", "synth", NAMED("laplacian_negative")},
    {"filter sharpen", "synth", NAMED("sharpen")},
    {"filter sharpen5", "synth", NAMED("sharpen5")},
    {"filter emboss", "synth", NAMED("emboss")},
    {"filter sobel_x, 16 bits", "synth", FILTER_S16(sobel_x)},
    {"filter sobel_y, 16 bits", "synth", FILTER_S16(sobel_y)},
    {"filter generic 3x3", "synth", KERNEL(&generic3)},
    {"filter generic 3x3, divisor", "synth", KERNEL(&generic3_divided)},
    {"filter generic 3x3, symmetric", "synth", BORDER(SYMMETRIC)},
    {"filter generic 3x3, reflect101", "synth", BORDER(REFLECT101)},
    {"filter generic 3x3, constant", "synth", BORDER(CONSTANT)},
    {"filter generic 3x3, valid", "synth", BORDER(VALID)},
    {"filter generic 5x5", "synth", KERNEL(&generic5)},
    {"filter gradient abs", "synth", FILTER(gradient_abs)},
    {"filter gradient", "synth", FILTER(gradient)},
    {"filter direction", "synth", FILTER(direction)},
    {"filter median", "synth", FILTER(median)},
    {"filter min", "synth", FILTER(min)},
    {"filter max", "synth", FILTER(max)},
    {"filter majority", "synth", LABEL_FILTER(majority)},
    {"filter erode labels", "synth", LABEL_FILTER(erode_labels)},
    {"filter dilate labels", "synth", LABEL_FILTER(dilate_labels)},

    {"table row", "synth", FEED_GRAY, &table_row, 0, 0, NULL},
    {"table linear", "synth", FEED_GRAY, &table_fill, 0, 0, NULL},
    {"table contrast", "synth", FEED_GRAY, &table_fill, 1, 0, NULL},
    {"table gamma", "synth", FEED_GRAY, &table_fill, 2, 0, NULL},
    {"combine add", "synth", COMBINE(ADD)},
    {"combine subtract", "synth", COMBINE(SUBTRACT)},
    {"combine absdiff", "synth", COMBINE(ABSDIFF)},
    {"combine min", "synth", COMBINE(MIN)},
    {"combine and", "synth", COMBINE(AND)},
    {"blend", "synth", FEED_TWO_GRAYS, &blend_row, 0, 0, NULL},
    {"histogram", "synth", FEED_GRAY, &histogram_row, 0, 0, NULL},
    {"histogram and otsu", "synth", FEED_GRAY, &otsu, 0, 0, NULL},
    {"histogram and equalize", "synth", FEED_GRAY, &equalize, 0, 0, NULL},
    {"integral", "synth", FEED_GRAY, &integral_row, 0, 0, NULL},
    {"adaptive threshold 15x15", "synth", FEED_GRAY, &adaptive_row, 7, 0, NULL},
    {"resize nearest to half", "synth", RESIZE(NEAREST, WIDTH / 2)},
    {"resize box to half", "synth", RESIZE(BOX, WIDTH / 2)},
    {"resize bilinear to 240x180", "synth", RESIZE(BILINEAR, 240)},
    {"white balance gray world", "synth", FEED_RGB, &sums_row, 0, 0, NULL},
    {"white balance apply", "synth", FEED_RGB, &balance_row, 0, 0, NULL},

    {"corners harris", "synth", CORNERS(HARRIS, 100000)},
    {"corners shi-tomasi", "synth", CORNERS(SHI_TOMASI, 100000)},
    {"corners fast9", "synth", CORNERS(FAST9, 20)},
    {"edges canny rows", "synth", FEED_GRAY, &canny_rows, 150, 300, NULL},
    {"edges link rows", "synth", FEED_EDGES, &canny_link, 0, 0, NULL},
    {"scan rows", "synth", FEED_LABELS, &scan_rows, 0, 0, NULL},
    {"scan rows and line fit", "synth", FEED_LABELS, &line_fit, 32, 3, NULL},
#if !COUNT_SMALL
    {"frame open", "synth", FEED_FRAME, &filter_two, 0, PEL_BORDER_REPLICATE,
     &(const filter_choice){.op = pel_op_min, .second = pel_op_max}},
    {"frame corners refine", "synth", FEED_FRAME, &corner_refine, 0, 100000, NULL},
    {"frame edges hysteresis", "synth", FEED_FRAME, &canny_hysteresis, 150, 300, NULL},
#endif
};

enum { JOBS = sizeof jobs / sizeof jobs[0] };

/* ---- Markers -------------------------------------------------------------------------------- */

/* One instruction each, the return; the empty statement keeps the calls. */
__attribute__((noinline)) void pel_count_on(void)
{
    __asm__ volatile("");
}

__attribute__((noinline)) void pel_count_off(void)
{
    __asm__ volatile("");
}

__attribute__((noinline)) void pel_count_next(void)
{
    __asm__ volatile("");
}

/* ---- Reports -------------------------------------------------------------------------------- */

static uint32_t checksum;

/* FNV-1a, Fowler, Noll, Vo. */
static void add_to_checksum(const uint8_t *bytes, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        checksum = (checksum ^ bytes[i]) * 16777619u;
    }
}

static void report(const char *name, uint32_t number)
{
    pel_count_next();
    pel_host_text("job\t");
    pel_host_text(name);
    pel_host_text("\t");
    pel_host_hexadecimal(checksum);
    pel_host_text("\t");
    pel_host_decimal(number);
    pel_host_text("\n");
}

#if defined(__riscv)
#define CALL "call "
#define LOOP "li t0, 250\n 1: addi t0, t0, -1\n bnez t0, 1b\n "
#define CHANGED "memory", "ra", "t0", "t1"
#else
#define CALL "bl "
#define LOOP ".syntax unified\n movs r0, #250\n 1: subs r0, r0, #1\n bne 1b\n "
#define CHANGED "memory", "cc", "lr", "r0"
#endif

/* What is known to the last instruction: nothing at all, and 501 more than that. In assembly, as a
 * compiler may move something of its own between the calls. */
static void count_the_known(void)
{
    __asm__ volatile(CALL "pel_count_on\n " CALL "pel_count_off" : : : CHANGED);
    report("(nothing)", 0);
    __asm__ volatile(CALL "pel_count_on\n " LOOP CALL "pel_count_off" : : : CHANGED);
    report("(501)", 0);
}

/* ---- Jobs ----------------------------------------------------------------------------------- */

static void begin(const job *j)
{
    if (j->run->begin != NULL) {
        pel_count_on();
        j->run->begin(j);
        pel_count_off();
    }
}

static void pull_all(const job *j)
{
    uint32_t bytes;
    do {
        pel_count_on();
        bytes = j->run->pull();
        pel_count_off();
        add_to_checksum(output_bytes(), bytes);
    } while (bytes != 0);
}

static void push(const job *j, uint16_t y)
{
    uint32_t bytes;
    feed_row(j, y);
    if (j->run->push == NULL) {
        return;
    }
    pel_count_on();
    bytes = j->run->push(y);
    pel_count_off();
    add_to_checksum(output_bytes(), bytes);
    if (j->run->pull != NULL) {
        pull_all(j);
    }
}

static void end(const job *j)
{
    uint32_t bytes;
    if (j->run->end == NULL) {
        return;
    }
    pel_count_on();
    bytes = j->run->end(j);
    pel_count_off();
    add_to_checksum(output_bytes(), bytes);
#if !COUNT_SMALL
    if (j->feed == FEED_FRAME) {
        add_to_checksum(frame, sizeof frame);
    }
#endif
}

/* The rows of a mosaic come in pairs, of which one row of the picture makes both. */
static int is_due(const job *j, uint16_t y)
{
    const int is_bayer = j->feed == FEED_CAMERA && j->choice == PEL_BAYER8_RGGB;
    return !is_bayer || y % 2u == 0;
}

static int run_job(const job *j)
{
    if (feed_open(j) != 0) {
        pel_host_text("no picture\t");
        pel_host_text(j->name);
        pel_host_text("\n");
        return 0;
    }
    worst = PEL_OK;
    checksum = 2166136261u;
    if (j->run->ready != NULL) {
        j->run->ready(j);
    }
    begin(j);
    for (uint16_t y = 0; y < HEIGHT; y++) {
        if (is_due(j, y)) {
            push(j, y);
        }
    }
    feed_close();
    if (j->run->between != NULL) {
        j->run->between(j);
    }
    end(j);
    report(j->name, j->run->look != NULL ? j->run->look() : 0);
    return worst < 0 ? -1 : 0;
}

int main(void)
{
    count_the_known();
    for (unsigned i = 0; i < JOBS; i++) {
        if (run_job(&jobs[i]) != 0) {
            pel_host_text("refused\t");
            pel_host_text(jobs[i].name);
            pel_host_text("\n");
            return 1;
        }
    }
    return 0;
}
