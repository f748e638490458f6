#include "report.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>

#include "say.h"

/* ---- Files --------------------------------------------------------------------------------- */

FILE *report_open(const char *path)
{
    if (strcmp(path, "-") == 0) {
        return stdout;
    }
    FILE *file = fopen(path, "w");
    if (!file) {
        say_error(path, "cannot write: %s", strerror(errno));
    }
    return file;
}

int report_close(FILE *file, const char *path)
{
    int failed = ferror(file);
    errno = 0;
    if (file == stdout) {
        failed |= fflush(file);
    } else {
        failed |= fclose(file);
    }
    if (failed) {
        return say_error(file == stdout ? "standard output" : path, "cannot write%s%s",
                         errno ? ": " : "", errno ? strerror(errno) : "");
    }
    return 0;
}

/* ---- Numbers and texts --------------------------------------------------------------------- */

/* value / 10^digits as a decimal. */
static void print_decimal(FILE *file, int64_t value, unsigned digits, int width)
{
    char text[32];
    const char *sign = value < 0 ? "-" : "";
    const uint64_t size = (uint64_t)(value < 0 ? -value : value);
    uint64_t unit = 1;
    for (unsigned i = 0; i < digits; i++) {
        unit *= 10;
    }
    snprintf(text, sizeof text, "%s%" PRIu64 ".%0*" PRIu64, sign, size / unit, (int)digits,
             size % unit);
    fprintf(file, "%*s", width, text);
}

void report_ratio(FILE *file, uint64_t sum, uint64_t count)
{
    const uint64_t thousandths = count ? (2000 * sum + count) / (2 * count) : 0;
    print_decimal(file, (int64_t)thousandths, 3, 0);
}

static int64_t hundredths_of_degree(int16_t angle_turn16)
{
    return ((int64_t)angle_turn16 * 36000 + 32768) >> 16;
}

static int64_t thousandths_of_q16(int32_t value_q16)
{
    return ((int64_t)value_q16 * 1000 + 32768) >> 16;
}

static int64_t ten_thousandths_of_q15(uint16_t value_q15)
{
    return ((int64_t)value_q15 * 10000 + 16384) >> 15;
}

void report_csv_text(FILE *file, const char *text)
{
    if (!strpbrk(text, ",\"\r\n")) {
        fputs(text, file);
        return;
    }
    fputc('"', file);
    for (; *text; text++) {
        if (*text == '"') {
            fputc('"', file);
        }
        fputc(*text, file);
    }
    fputc('"', file);
}

/* How many bytes the UTF-8 character at `text` takes; 0 if it is none (RFC 3629). */
static size_t utf8_length(const unsigned char *text)
{
    const unsigned lead = text[0];
    const size_t length = lead < 0x80 ? 1 : lead < 0xc2 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    if (lead > 0xf4 || (lead == 0xe0 && text[1] < 0xa0) || (lead == 0xed && text[1] > 0x9f) ||
        (lead == 0xf0 && text[1] < 0x90) || (lead == 0xf4 && text[1] > 0x8f)) {
        return 0;
    }
    for (size_t i = 1; i < length; i++) {
        if ((text[i] & 0xc0) != 0x80) {
            return 0;
        }
    }
    return length;
}

/* Bytes that are no UTF-8 (a file name may have them) become U+FFFD: JSON has nothing else. */
void report_json_text(FILE *file, const char *text)
{
    fputc('"', file);
    while (*text) {
        const unsigned char *c = (const unsigned char *)text;
        const size_t length = utf8_length(c);
        if (length == 0) {
            fputs("\\ufffd", file);
        } else if (*c == '"' || *c == '\\') {
            fprintf(file, "\\%c", *c);
        } else if (*c < 0x20 || *c == 0x7f) {
            fprintf(file, "\\u%04x", (unsigned)*c);
        } else {
            fwrite(c, 1, length, file);
        }
        text += length ? length : 1;
    }
    fputc('"', file);
}

/* ---- Blobs --------------------------------------------------------------------------------- */

/* What is printed of a blob beside its fields, as integers. */
typedef struct shape {
    int64_t x_milli, y_milli;
    int64_t angle_centi;
    int64_t elongation, roundness, density, compactness; /* 1/10000 */
} shape;

static shape shape_of(const pel_blob *blob)
{
    int32_t x_q16;
    int32_t y_q16;
    shape numbers;
    pel_blob_centroid_q16(blob, &x_q16, &y_q16);
    numbers.x_milli = thousandths_of_q16(x_q16);
    numbers.y_milli = thousandths_of_q16(y_q16);
    numbers.angle_centi = hundredths_of_degree(pel_blob_angle_turn16(blob));
    numbers.elongation = ten_thousandths_of_q15(pel_blob_elongation_q15(blob));
    numbers.roundness = ten_thousandths_of_q15(pel_blob_roundness_q15(blob));
    numbers.density = ten_thousandths_of_q15(pel_blob_density_q15(blob));
    numbers.compactness = ten_thousandths_of_q15(pel_blob_compactness_q15(blob));
    return numbers;
}

static void print_csv(FILE *file, const report_frame *frame, const pel_blob *blob)
{
    const shape numbers = shape_of(blob);
    const struct {
        int64_t value;
        unsigned digits;
    } decimals[] = {{numbers.x_milli, 3},    {numbers.y_milli, 3},   {numbers.angle_centi, 2},
                    {numbers.elongation, 4}, {numbers.roundness, 4}, {numbers.density, 4},
                    {numbers.compactness, 4}};
    fprintf(file, "%lu,%u,", frame->frame, (unsigned)blob->class_index);
    report_csv_text(file, frame->list->entry[blob->class_index].name);
    fprintf(file, ",%" PRIu32 ",%u,%u,%u,%u,%" PRIu32 ",%" PRIu32, blob->area, (unsigned)blob->x0,
            (unsigned)blob->y0, (unsigned)blob->x1, (unsigned)blob->y1, blob->sum_x, blob->sum_y);
    for (size_t i = 0; i < sizeof decimals / sizeof decimals[0]; i++) {
        fputc(',', file);
        print_decimal(file, decimals[i].value, decimals[i].digits, 0);
    }
    fprintf(file, ",%" PRIu32 ",%" PRIu32 ",%u,%u,%u,%u\n", blob->perimeter, blob->holes,
            (unsigned)blob->edges, (unsigned)blob->mean_y, (unsigned)blob->mean_u,
            (unsigned)blob->mean_v);
}

static void print_json_decimal(FILE *file, const char *name, int64_t value, unsigned digits)
{
    fprintf(file, ",\"%s\":", name);
    print_decimal(file, value, digits, 0);
}

static void print_json(FILE *file, const report_frame *frame, const pel_blob *blob)
{
    const shape numbers = shape_of(blob);
    fprintf(file, "{\"class\":%u,\"name\":", (unsigned)blob->class_index);
    report_json_text(file, frame->list->entry[blob->class_index].name);
    fprintf(file,
            ",\"area\":%" PRIu32 ",\"x0\":%u,\"y0\":%u,\"x1\":%u,\"y1\":%u,\"sum_x\":%" PRIu32
            ",\"sum_y\":%" PRIu32,
            blob->area, (unsigned)blob->x0, (unsigned)blob->y0, (unsigned)blob->x1,
            (unsigned)blob->y1, blob->sum_x, blob->sum_y);
    print_json_decimal(file, "cx", numbers.x_milli, 3);
    print_json_decimal(file, "cy", numbers.y_milli, 3);
    print_json_decimal(file, "angle_deg", numbers.angle_centi, 2);
    print_json_decimal(file, "elongation", numbers.elongation, 4);
    print_json_decimal(file, "roundness", numbers.roundness, 4);
    print_json_decimal(file, "density", numbers.density, 4);
    print_json_decimal(file, "compactness", numbers.compactness, 4);
    fprintf(file,
            ",\"perimeter\":%" PRIu32 ",\"holes\":%" PRIu32
            ",\"edges\":%u,\"mean_y\":%u,\"mean_u\":%u,\"mean_v\":%u}",
            blob->perimeter, blob->holes, (unsigned)blob->edges, (unsigned)blob->mean_y,
            (unsigned)blob->mean_u, (unsigned)blob->mean_v);
}

static void print_row(FILE *file, const report_frame *frame, const pel_blob *blob)
{
    const shape numbers = shape_of(blob);
    fprintf(file, "  %-12s %7" PRIu32 "  %4u %4u %4u %4u",
            frame->list->entry[blob->class_index].name, blob->area, (unsigned)blob->x0,
            (unsigned)blob->y0, (unsigned)blob->x1, (unsigned)blob->y1);
    print_decimal(file, numbers.x_milli, 3, 10);
    print_decimal(file, numbers.y_milli, 3, 9);
    print_decimal(file, numbers.angle_centi, 2, 8);
    print_decimal(file, numbers.elongation, 4, 8);
    print_decimal(file, numbers.density, 4, 8);
    fprintf(file, " %6" PRIu32 " %5" PRIu32 "  %c%c%c%c  %3u %3u %3u\n", blob->perimeter,
            blob->holes, blob->edges & PEL_EDGE_LEFT ? 'L' : '-',
            blob->edges & PEL_EDGE_RIGHT ? 'R' : '-', blob->edges & PEL_EDGE_TOP ? 'T' : '-',
            blob->edges & PEL_EDGE_BOTTOM ? 'B' : '-', (unsigned)blob->mean_y,
            (unsigned)blob->mean_u, (unsigned)blob->mean_v);
}

static void print_table(FILE *file, const report_frame *frame)
{
    const pel_blobs_counts *counts = &frame->counts;
    fprintf(file, "%s: frame %lu, %ux%u, %" PRIu32 " blob%s\n", frame->file, frame->frame,
            frame->width, frame->height, frame->blob_count, frame->blob_count == 1 ? "" : "s");
    if (frame->blob_count > 0) {
        fputs("  class           area    x0   y0   x1   y1        cx       cy   angle   elong    "
              "dens  perim holes  edge    Y   U   V\n",
              file);
    }
    for (uint32_t i = 0; i < frame->blob_count; i++) {
        print_row(file, frame, &frame->blobs[i]);
    }
    if (counts->dropped > 0) {
        fprintf(file, "  dropped: %" PRIu32 " smaller blobs, %" PRIu32 " pixels\n", counts->dropped,
                counts->dropped_px);
    }
    if (counts->filtered > 0) {
        fprintf(file, "  filtered: %" PRIu32 " blobs, %" PRIu32 " pixels\n", counts->filtered,
                counts->filtered_px);
    }
    if (counts->lost_px > 0) {
        fprintf(file, "  lost: %" PRIu32 " pixels\n", counts->lost_px);
    }
}

static void print_json_frame(FILE *file, const report_frame *frame)
{
    const pel_blobs_counts *counts = &frame->counts;
    fprintf(file, "{\"frame\":%lu,\"file\":", frame->frame);
    report_json_text(file, frame->file);
    fprintf(file,
            ",\"width\":%u,\"height\":%u,\"found\":%" PRIu32 ",\"dropped\":%" PRIu32
            ",\"dropped_px\":%" PRIu32 ",\"filtered\":%" PRIu32 ",\"filtered_px\":%" PRIu32
            ",\"lost_px\":%" PRIu32 ",\"blobs\":[",
            frame->width, frame->height, counts->found, counts->dropped, counts->dropped_px,
            counts->filtered, counts->filtered_px, counts->lost_px);
    for (uint32_t i = 0; i < frame->blob_count; i++) {
        if (i > 0) {
            fputc(',', file);
        }
        print_json(file, frame, &frame->blobs[i]);
    }
    fputs("]}\n", file);
}

void report_begin(FILE *file, report_style style)
{
    if (style == REPORT_CSV) {
        fputs("frame,class,name,area,x0,y0,x1,y1,sum_x,sum_y,cx,cy,angle_deg,elongation,roundness,"
              "density,compactness,perimeter,holes,edges,mean_y,mean_u,mean_v\n",
              file);
    }
}

void report_blobs(FILE *file, report_style style, const report_frame *frame)
{
    if (style == REPORT_TABLE) {
        print_table(file, frame);
    } else if (style == REPORT_JSON) {
        print_json_frame(file, frame);
    } else {
        for (uint32_t i = 0; i < frame->blob_count; i++) {
            print_csv(file, frame, &frame->blobs[i]);
        }
    }
}
