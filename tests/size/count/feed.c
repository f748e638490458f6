/* From the YUYV rows that the host has to what an operator reads. */
#include "count.h"

#include "semihost.h"

input_row row;

static uint8_t camera[2 * WIDTH];
static uint8_t converted[3 * WIDTH];
static int32_t file;

static unsigned length_of(const char *text)
{
    unsigned length = 0;
    while (text[length] != '\0') {
        length++;
    }
    return length;
}

/* The host's file of the picture's name with an ending; -1 if there is none. */
static int32_t open_with(const char *name, const char *ending)
{
    char whole[24];
    const unsigned length = length_of(name);
    const unsigned more = length_of(ending);
    if (length + more >= sizeof whole) {
        return -1;
    }
    for (unsigned i = 0; i < length; i++) {
        whole[i] = name[i];
    }
    for (unsigned i = 0; i <= more; i++) {
        whole[length + i] = ending[i];
    }
    return pel_host_open(whole, PEL_HOST_READ);
}

static int read_classes(const char *picture)
{
    const int32_t size = (int32_t)sizeof picture_classes;
    const int32_t classes = open_with(picture, ".boxes");
    if (classes < 0) {
        return -1;
    }
    const int whole = pel_host_read(classes, &picture_classes, sizeof picture_classes) == size;
    (void)pel_host_close(classes);
    return whole ? 0 : -1;
}

int feed_open(const job *j)
{
    if (read_classes(j->picture) != 0) {
        return -1;
    }
    file = open_with(j->picture, ".yuyv");
    return file < 0 ? -1 : 0;
}

void feed_close(void)
{
    (void)pel_host_close(file);
}

static pel_crow camera_row(void)
{
    return pel_crow_packed(camera, PEL_YUYV, PEL_RANGE_FULL, WIDTH);
}

static void copy_gray(uint8_t *to)
{
    for (unsigned x = 0; x < WIDTH; x++) {
        to[x] = camera[2 * x];
    }
}

static void make_labels(void)
{
    const pel_classifier classifier = {.boxes = &picture_classes};
    const pel_crow crow = camera_row();
    done(pel_classify_row(&classifier, &crow, converted));
}

/* About as dense as edges are. */
static void make_edges(void)
{
    static const uint8_t kind[3] = {PEL_CANNY_NONE, PEL_CANNY_WEAK, PEL_CANNY_STRONG};
    make_labels();
    for (unsigned x = 0; x < WIDTH; x++) {
        output_bytes()[x] = kind[converted[x] % 3u];
    }
}

static void make_rgb(void)
{
    const pel_crow crow = camera_row();
    done(pel_crow_read_rgb(&crow, 0, WIDTH, converted));
}

/* ---- Camera formats ------------------------------------------------------------------------- */

static void swap_pairs(void)
{
    for (unsigned i = 0; i < 2 * WIDTH; i += 2) {
        converted[i] = camera[i + 1];
        converted[i + 1] = camera[i];
    }
}

/* The Y row, then its chroma: side by side for NV12, U before V for I420. */
static void make_planes(pel_format format)
{
    const int interleaved = format == PEL_NV12;
    uint8_t *const u = converted + WIDTH;
    uint8_t *const v = interleaved ? u + 1 : u + WIDTH / 2;
    const unsigned step = interleaved ? 2 : 1;
    copy_gray(converted);
    for (unsigned i = 0; i < WIDTH / 2; i++) {
        u[step * i] = camera[4 * i + 1];
        v[step * i] = camera[4 * i + 3];
    }
    row.crow.plane[1] = u;
    row.crow.plane[2] = v;
}

static void make_565(pel_format format)
{
    const unsigned low = format == PEL_RGB565_LE ? 0 : 1;
    make_rgb();
    /* In place, as two bytes are written where three were read. */
    for (unsigned x = 0; x < WIDTH; x++) {
        const unsigned r = converted[3 * x];
        const unsigned g = converted[3 * x + 1];
        const unsigned b = converted[3 * x + 2];
        const unsigned word = (r >> 3) << 11 | (g >> 2) << 5 | b >> 3;
        converted[2 * x + low] = (uint8_t)word;
        converted[2 * x + 1 - low] = (uint8_t)(word >> 8);
    }
}

static void make_bgr(void)
{
    make_rgb();
    for (unsigned x = 0; x < WIDTH; x++) {
        const uint8_t r = converted[3 * x];
        converted[3 * x] = converted[3 * x + 2];
        converted[3 * x + 2] = r;
    }
}

/* R G over G B, both rows of the pair from the same row of the picture. */
static void make_bayer(void)
{
    uint8_t pair[2][WIDTH];
    make_rgb();
    for (unsigned x = 0; x < WIDTH; x++) {
        const uint8_t *const rgb = converted + 3 * x;
        pair[0][x] = x % 2 == 0 ? rgb[0] : rgb[1];
        pair[1][x] = x % 2 == 0 ? rgb[1] : rgb[2];
    }
    for (unsigned x = 0; x < WIDTH; x++) {
        converted[x] = pair[0][x];
        converted[WIDTH + x] = pair[1][x];
    }
    row.crow.plane[1] = converted + WIDTH;
}

static void make_camera_row(pel_format format)
{
    row.crow = camera_row();
    row.crow.format = format;
    if (format == PEL_YUYV) {
        return;
    }
    row.crow.plane[0] = converted;
    if (format == PEL_UYVY) {
        swap_pairs();
    } else if (format == PEL_NV12 || format == PEL_I420) {
        make_planes(format);
    } else if (format == PEL_RGB565_LE || format == PEL_RGB565_BE) {
        make_565(format);
    } else if (format == PEL_RGB888) {
        make_rgb();
    } else if (format == PEL_BGR888) {
        make_bgr();
    } else if (format == PEL_BAYER8_RGGB) {
        make_bayer();
    } else {
        copy_gray(converted);
        row.crow.format = PEL_GRAY8;
    }
}

/* ---- Rows ----------------------------------------------------------------------------------- */

static void make_two_grays(void)
{
    copy_gray(converted);
    for (unsigned x = 0; x < WIDTH; x++) {
        converted[WIDTH + x] = converted[WIDTH - 1 - x];
    }
}

void feed_row(const job *j, uint16_t y)
{
    if (pel_host_read(file, camera, sizeof camera) != (int32_t)sizeof camera) {
        worst = PEL_ERR_SPACE;
    }
    row.bytes = converted;
    if (j->feed == FEED_GRAY) {
        copy_gray(converted);
    } else if (j->feed == FEED_TWO_GRAYS) {
        make_two_grays();
    } else if (j->feed == FEED_RGB) {
        make_rgb();
    } else if (j->feed == FEED_YCBCR) {
        make_rgb();
        done(pel_rgb_to_ycbcr_row(converted, converted, WIDTH, PEL_RANGE_FULL));
    } else if (j->feed == FEED_LABELS) {
        make_labels();
    } else if (j->feed == FEED_EDGES) {
        make_edges();
    } else if (j->feed == FEED_CAMERA) {
        make_camera_row((pel_format)j->choice);
    } else {
#if COUNT_SMALL
        (void)y;
        worst = PEL_ERR_SPACE;
#else
        copy_gray(frame + WIDTH * y);
        row.bytes = frame;
#endif
    }
}
