/*
 * The first blob: says on the output, once per frame, where the largest thing of one colour is.
 * Text for a terminal; ports/robot goes on from here.
 */
#include "port.h"

/* Orange, as Y, U and V from..to: measure yours with `pel classify` on a picture of your camera. */
static const pel_color_box orange = {50, 215, 30, 103, 160, 230};
#define CAMERA_RANGE PEL_RANGE_FULL

enum { OPEN_MAX = 32 };

static pel_boxes boxes;
static uint8_t labels[PORT_WIDTH];
static uint64_t work[PEL_BLOBS_WORDS(PORT_WIDTH, OPEN_MAX, 0)];
static pel_blob largest;
static pel_blobs blobs;

static uint32_t put_text(const char *text, char *to)
{
    uint32_t length = 0;
    while (text[length] != '\0') {
        to[length] = text[length];
        length++;
    }
    return length;
}

static uint32_t put_number(uint32_t number, char *to)
{
    char digits[10];
    uint32_t count = 0, length = 0;
    do {
        digits[count++] = (char)('0' + number % 10);
        number /= 10;
    } while (number > 0);
    while (count > 0) {
        to[length++] = digits[--count];
    }
    return length;
}

static void say(uint32_t found)
{
    char text[64];
    uint32_t length = 0;
    if (found == 0) {
        length += put_text("nothing", text);
    } else {
        length += put_text("x ", text);
        length += put_number(largest.sum_x / largest.area, text + length);
        length += put_text(" y ", text + length);
        length += put_number(largest.sum_y / largest.area, text + length);
        length += put_text(" area ", text + length);
        length += put_number(largest.area, text + length);
    }
    length += put_text("\r\n", text + length);
    (void)port_write((const uint8_t *)text, length);
}

static pel_status begin_frame(void)
{
    pel_blobs_config config = {0};
    config.width = PORT_WIDTH;
    config.height = PORT_HEIGHT;
    config.open_max = OPEN_MAX;
    config.work = work;
    config.work_bytes = sizeof work;
    config.results = &largest; /* room for one: the largest is kept */
    config.results_max = 1;
    return pel_blobs_begin(&blobs, &config);
}

/* Negative: a line is missing, or not what was promised. */
static pel_status take_line(const port_line_info *line)
{
    pel_classifier classifier = {0};
    const pel_status status = line->y == 0 ? begin_frame() : PEL_OK;
    classifier.boxes = &boxes;
    classifier.range = CAMERA_RANGE;
    classifier.reader = pel_crow_read_yuv; /* of any camera; not needed for YCbCr */
    classifier.pieces = pel_classify_pieces;
    return status < 0 ? status : pel_blobs_pixels(&blobs, line->y, &classifier, &line->row, labels);
}

int main(void)
{
    port_line_info line;
    int got = PORT_FAILED;

    if (port_begin() != PORT_READY || pel_boxes_set(&boxes, 0, &orange) != PEL_OK) {
        return port_end(1);
    }
    while ((got = port_line(&line)) == PORT_READY) {
        uint32_t count;
        /* After a lost line the rest of the frame is refused, until line 0 begins the next. */
        if (take_line(&line) >= 0 && line.y == PORT_HEIGHT - 1 &&
            pel_blobs_end(&blobs, &count) >= 0) {
            say(count);
        }
    }
    return port_end(got == PORT_END ? 0 : 1);
}
