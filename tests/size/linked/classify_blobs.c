/*
 * The smallest firmware that is of use: rows of YUYV from a camera become blobs of one colour, with
 * area, box and the sums that give the centroid. What of the library it needs is counted.
 */
#include <pel.h>

enum { WIDTH = 320, HEIGHT = 240, OPEN = 32, RESULTS = 16 };

/* Where other hardware would be: a line buffer that the camera fills, a place for the target. */
volatile uint8_t camera_line_ready;
uint8_t camera_line[2 * WIDTH];
volatile uint16_t target_x, target_y;

void start(void);

static pel_boxes boxes;
static uint64_t work[PEL_BLOBS_WORDS(WIDTH, OPEN, 0)];
static pel_blob found[RESULTS];
static uint8_t labels[WIDTH];

static void one_frame(const pel_classifier *classifier, const pel_blobs_config *config)
{
    pel_blobs blobs;
    uint32_t count = 0;
    (void)pel_blobs_begin(&blobs, config);
    for (uint16_t y = 0; y < HEIGHT; y++) {
        while (camera_line_ready == 0) {
        }
        const pel_crow row = pel_crow_packed(camera_line, PEL_YUYV, PEL_RANGE_FULL, WIDTH);
        (void)pel_blobs_pixels(&blobs, y, classifier, &row, labels);
    }
    (void)pel_blobs_end(&blobs, &count);
    if (count != 0) {
        target_x = (uint16_t)(found[0].sum_x / found[0].area);
        target_y = (uint16_t)(found[0].sum_y / found[0].area);
    }
}

void start(void)
{
    static const pel_color_box orange = {100, 255, 0, 110, 150, 255};
    const pel_classifier classifier = {.boxes = &boxes};
    const pel_blobs_config config = {.width = WIDTH,
                                     .height = HEIGHT,
                                     .open_max = OPEN,
                                     .work = work,
                                     .work_bytes = sizeof work,
                                     .results = found,
                                     .results_max = RESULTS};
    (void)pel_boxes_set(&boxes, 0, &orange);
    for (;;) {
        one_frame(&classifier, &config);
    }
}
