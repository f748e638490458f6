/* A user's program: what it prints shows that headers and library agree. */
#include <pel.h>
#include <stdio.h>
#include <string.h>

int main(void)
{
    static pel_boxes boxes;
    static uint64_t work[PEL_BLOBS_WORDS(4, 2, 0)];
    static pel_blobs blobs;
    static pel_blob found[1];
    const pel_color_box red = {0, 255, 0, 127, 200, 255};
    const uint8_t yuyv[8] = {90, 128, 90, 128, 90, 80, 90, 220};
    const pel_crow row = pel_crow_packed(yuyv, PEL_YUYV, PEL_RANGE_FULL, 4);
    pel_classifier classifier = {0};
    pel_blobs_config config = {0};
    uint8_t labels[4];
    uint32_t count = 0;

    classifier.boxes = &boxes;
    config.width = 4;
    config.height = 1;
    config.open_max = 2;
    config.work = work;
    config.work_bytes = sizeof work;
    config.results = found;
    config.results_max = 1;
    if (strcmp(pel_version(), PEL_VERSION) != 0 ||
        pel_boxes_set(&boxes, PEL_CLASS_MAX, &red) != PEL_ERR_ARG ||
        pel_boxes_set(&boxes, PEL_CLASS_MAX - 1, &red) != PEL_OK ||
        pel_blobs_begin(&blobs, &config) != PEL_OK ||
        pel_classify_row(&classifier, &row, labels) != PEL_OK ||
        pel_blobs_row(&blobs, 0, labels, NULL) != PEL_OK ||
        pel_blobs_end(&blobs, &count) != PEL_OK || count != 1) {
        return 1;
    }
    printf("pel %s: class %u of %u, %u px at x %u\n", pel_version(), found[0].class_index + 1u,
           (unsigned)PEL_CLASS_MAX, (unsigned)found[0].area, (unsigned)found[0].x0);
    return 0;
}
