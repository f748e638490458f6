/* What a user's program does with a package: classify two rows, find a blob, blur a picture. */
#include <pel.h>
#include <stdio.h>

static const uint8_t camera[2][8] = {{90, 128, 90, 128, 150, 70, 150, 190},
                                     {90, 128, 90, 128, 150, 70, 150, 190}};

static pel_status find_blobs(pel_blob *found, uint32_t *count)
{
    static uint64_t work[PEL_BLOBS_WORDS(4, 8, 0)];
    static pel_boxes boxes;
    const pel_color_box orange = {100, 255, 0, 110, 150, 255};
    const pel_classifier classifier = {.boxes = &boxes};
    const pel_blobs_config config = {.width = 4,
                                     .height = 2,
                                     .open_max = 8,
                                     .work = work,
                                     .work_bytes = sizeof work,
                                     .results = found,
                                     .results_max = 1};
    pel_blobs blobs;
    uint8_t labels[4];

    pel_boxes_set(&boxes, 0, &orange);
    pel_blobs_begin(&blobs, &config);
    for (uint16_t y = 0; y < 2; y++) {
        const pel_crow row = pel_crow_packed(camera[y], PEL_YUYV, PEL_RANGE_FULL, 4);
        pel_classify_row(&classifier, &row, labels);
        pel_blobs_row(&blobs, y, labels, NULL);
    }
    return pel_blobs_end(&blobs, count);
}

/* 1 2 1 / 2 4 2 / 1 2 1 over 16, of which a lone 16 in the middle meets the 4. */
static unsigned blur(void)
{
    static const uint8_t picture[3][3] = {{0, 0, 0}, {0, 16, 0}, {0, 0, 0}};
    static uint8_t work[PEL_FILTER_BYTES(3, 1)];
    const pel_filter_config config = {.kernel = pel_kernel_named("gauss3"),
                                      .width = 3,
                                      .height = 3,
                                      .work = work,
                                      .work_bytes = sizeof work};
    pel_filter filter;
    uint8_t rows[3][3] = {{0}};
    unsigned done = 0;

    pel_filter_begin(&filter, &config);
    for (int y = 0; y < 3; y++) {
        pel_filter_push(&filter, picture[y]);
        while (done < 3 && pel_filter_pull(&filter, rows[done]) == PEL_OK) {
            done++;
        }
    }
    return rows[1][1];
}

int main(void)
{
    pel_blob found[1];
    uint32_t count = 0;

    if (find_blobs(found, &count) != PEL_OK || count != 1) {
        return 1;
    }
    printf("pel %s: %u blob, %u px, blurred %u\n", pel_version(), (unsigned)count,
           (unsigned)found[0].area, blur());
    return 0;
}
