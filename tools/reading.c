#include "reading.h"

#include <string.h>

#include "raw.h"

enum { SIDE_MIN = 16 };

int reading_common_size(unsigned width, unsigned height)
{
    static const uint16_t sizes[][2] = {
        {80, 60},     {96, 96},     {128, 96},    {128, 128},   {160, 120},   {176, 144},
        {240, 160},   {240, 176},   {240, 240},   {320, 180},   {320, 240},   {352, 288},
        {400, 296},   {400, 300},   {424, 240},   {480, 270},   {480, 320},   {640, 360},
        {640, 400},   {640, 480},   {720, 480},   {720, 576},   {800, 448},   {800, 600},
        {848, 480},   {960, 540},   {960, 720},   {1024, 576},  {1024, 768},  {1280, 720},
        {1280, 800},  {1280, 960},  {1280, 1024}, {1600, 896},  {1600, 900},  {1600, 1200},
        {1640, 1232}, {1920, 1080}, {2048, 1536}, {2304, 1296}, {2304, 1536}, {2560, 1440},
        {2592, 1944}, {3264, 2448}, {3280, 2464}, {3840, 2160}, {4056, 3040}, {4096, 2160},
        {4608, 2592},
    };
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        if (sizes[i][0] == width && sizes[i][1] == height) {
            return 1;
        }
    }
    return 0;
}

/* How many rows as long as those of plane 0 a frame takes. */
static uint32_t lines_of(pel_format format, unsigned width, unsigned height)
{
    return pel_frame_bytes(format, (uint16_t)width, (uint16_t)height) /
           pel_row_bytes(format, (uint16_t)width);
}

/* Bytes per line that use up all bytes, if there are: rows may be up to half as long again. */
static uint32_t guess_line(const reading_facts *facts, const reading *how, uint32_t row_bytes)
{
    const unsigned long frames = facts->frames ? facts->frames : 1;
    const uint64_t lines = (uint64_t)frames * lines_of(how->format, how->width, how->height);
    const uint64_t line = facts->bytes / lines;
    const int fits = facts->bytes % lines == 0 && line > row_bytes && line <= row_bytes * 3 / 2;
    return fits ? (uint32_t)line : 0;
}

/* Completes a reading whose format and size are set; 1 if the bytes can be that. */
static int complete(const reading_facts *facts, reading *how)
{
    const uint16_t width = (uint16_t)how->width;
    const uint32_t row_bytes = pel_row_bytes(how->format, width);
    const uint32_t tight = pel_frame_bytes(how->format, width, (uint16_t)how->height);
    if (tight == 0) {
        return 0;
    }
    how->line_bytes = facts->line_bytes ? facts->line_bytes : row_bytes;
    if (!facts->line_bytes && facts->bytes % tight != 0) {
        how->line_bytes = guess_line(facts, how, row_bytes);
    }
    if (how->line_bytes < row_bytes || (how->format == PEL_I420 && how->line_bytes % 2 != 0)) {
        return 0;
    }
    const uint64_t frame_bytes =
        (uint64_t)how->line_bytes * lines_of(how->format, how->width, how->height);
    if (frame_bytes > UINT32_MAX / 2 || facts->bytes % frame_bytes != 0) {
        return 0;
    }
    how->frame_bytes = (uint32_t)frame_bytes;
    how->frames = (unsigned long)(facts->bytes / frame_bytes);
    return how->frames > 0 && (facts->frames == 0 || how->frames == facts->frames);
}

static size_t add(const reading_facts *facts, pel_format format, unsigned width, unsigned height,
                  reading *list, size_t count)
{
    const int has_planes = format == PEL_NV12 || format == PEL_I420;
    reading how = {0};
    how.format = format;
    how.width = width;
    how.height = height;
    if (!complete(facts, &how)) {
        return count;
    }
    for (how.swapped = 0; how.swapped <= has_planes && count < READINGS_MAX; how.swapped++) {
        list[count++] = how;
    }
    return count;
}

/* Every size that uses up the bytes. */
static size_t add_sizes(const reading_facts *facts, pel_format format, reading *list, size_t count)
{
    const uint32_t square = pel_frame_bytes(format, SIDE_MIN, SIDE_MIN);
    const unsigned long frames = facts->frames ? facts->frames : 1;
    const uint64_t pixels = facts->bytes * SIDE_MIN * SIDE_MIN / square / frames;
    reading_facts one = *facts;
    one.frames = frames;
    for (unsigned width = SIDE_MIN; width <= PEL_SIDE_MAX; width++) {
        const uint64_t height = pixels / width;
        if (pixels % width == 0 && height >= SIDE_MIN && height <= PEL_SIDE_MAX &&
            height <= 2 * (uint64_t)width && width <= 3 * height) {
            count = add(&one, format, width, (unsigned)height, list, count);
        }
    }
    return count;
}

size_t reading_list(const reading_facts *facts, reading *list)
{
    size_t count = 0;
    for (int i = 0; i < PEL_FORMAT_COUNT; i++) {
        const pel_format format = (pel_format)i;
        count = facts->width ? add(facts, format, facts->width, facts->height, list, count)
                             : add_sizes(facts, format, list, count);
    }
    return count;
}

const char *reading_name(const reading *how)
{
    if (how->swapped) {
        return how->format == PEL_NV12 ? "NV21" : "YV12";
    }
    return pel_format_name(how->format);
}

static void append_row(void *user, const uint8_t *bytes, size_t count)
{
    uint8_t **end = user;
    memcpy(*end, bytes, count);
    *end += count;
}

static void swap_chroma(const pel_view *view)
{
    const size_t count = (size_t)view->width * view->height / 4;
    const size_t step = view->format == PEL_NV12 ? 2 : 1;
    uint8_t *u = view->plane[1];
    uint8_t *v = view->format == PEL_NV12 ? u + 1 : view->plane[2];
    for (size_t i = 0; i < count; i++) {
        const uint8_t sample = u[i * step];
        u[i * step] = v[i * step];
        v[i * step] = sample;
    }
}

int reading_frame(const reading *how, const uint8_t *bytes, unsigned long number, frame *out)
{
    pel_cview padded;
    if (frame_resize(out, how->format, PEL_RANGE_FULL, how->width, how->height) ||
        pel_cview_init(bytes + (size_t)number * how->frame_bytes, how->format, PEL_RANGE_FULL,
                       (uint16_t)how->width, (uint16_t)how->height, (int32_t)how->line_bytes,
                       &padded) != PEL_OK) {
        return -1;
    }
    uint8_t *end = out->bytes;
    raw_each_row(&padded, append_row, &end);
    if (how->swapped) {
        swap_chroma(&out->view);
    }
    return 0;
}
