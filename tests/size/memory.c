/*
 * What a robot pays in RAM for blobs at 320x240: classes, label row, runs, open blobs, results. The
 * frame streams through row by row; the line that the camera is filling is not counted. The budget
 * is checked at compile time, for every target; on the host the program also finds blobs with it.
 */
#include <pel.h>

enum { WIDTH = 320, HEIGHT = 240, OPEN = 32, RESULTS = 16, BUDGET_BYTES = 8192 };

#define MEASURE (PEL_MEASURE_MOMENTS | PEL_MEASURE_OUTLINE)

struct robot_memory {
    pel_boxes boxes;
    uint64_t work[PEL_BLOBS_WORDS(WIDTH, OPEN, MEASURE)];
    pel_blob results[RESULTS];
    pel_blobs finder;
    uint8_t labels[WIDTH];
};

typedef char robot_memory_fits[sizeof(struct robot_memory) <= BUDGET_BYTES ? 1 : -1];

struct robot_memory robot_memory;

#if __STDC_HOSTED__
#include <stdio.h>

enum { COLUMNS = 8, ROWS = 3, SIDE = 16, PITCH = 40 };

static unsigned passed, failed;

static void check(int good, const char *what)
{
    if (good) {
        passed++;
    } else {
        failed++;
        printf("wrong: %s\n", what);
    }
}

/* Row y of a picture with COLUMNS x ROWS squares of the class on gray ground. */
static void draw_row(unsigned y, uint8_t *yuyv)
{
    for (unsigned x = 0; x < WIDTH; x++) {
        const int inside = x % PITCH < SIDE && y % PITCH < SIDE && y / PITCH < ROWS;
        yuyv[2 * x] = 128;
        yuyv[2 * x + 1] = inside ? 200 : 128;
    }
}

static uint32_t find_squares(void)
{
    struct robot_memory *const memory = &robot_memory;
    static const pel_color_box box = {100, 150, 180, 220, 180, 220};
    pel_classifier classifier = {0};
    pel_blobs_config config = {0};
    uint8_t yuyv[2 * WIDTH];
    uint32_t count = 0;

    check(pel_boxes_set(&memory->boxes, 7, &box) == PEL_OK, "pel_boxes_set");
    classifier.boxes = &memory->boxes;
    config.width = WIDTH;
    config.height = HEIGHT;
    config.open_max = OPEN;
    config.measure = MEASURE;
    config.measurer = pel_blobs_measure;
    config.work = memory->work;
    config.work_bytes = sizeof memory->work;
    config.results = memory->results;
    config.results_max = RESULTS;

    int rows_good = 1;
    check(pel_blobs_begin(&memory->finder, &config) == PEL_OK, "pel_blobs_begin");
    for (uint16_t y = 0; y < HEIGHT; y++) {
        draw_row(y, yuyv);
        const pel_crow row = pel_crow_packed(yuyv, PEL_YUYV, PEL_RANGE_FULL, WIDTH);
        rows_good &= pel_classify_row(&classifier, &row, memory->labels) == PEL_OK;
        rows_good &= pel_blobs_row(&memory->finder, y, memory->labels, NULL) == PEL_OK;
    }
    check(rows_good, "a row");
    check(pel_blobs_end(&memory->finder, &count) == PEL_TRUNCATED, "pel_blobs_end");
    return count;
}

int main(void)
{
    const uint32_t count = find_squares();
    const pel_blobs_counts *const counts = &robot_memory.finder.counts;

    check(count == RESULTS, "results");
    check(counts->found == COLUMNS * ROWS, "blobs found");
    check(counts->dropped == COLUMNS * ROWS - RESULTS, "blobs dropped");
    check(counts->open_peak == COLUMNS, "blobs open at once");
    check(counts->lost_px == 0, "nothing lost");
    for (uint32_t i = 0; i < count; i++) {
        check(robot_memory.results[i].area == SIDE * SIDE, "area");
        check(robot_memory.results[i].perimeter == 4 * SIDE, "perimeter");
        check(robot_memory.results[i].class_index == 7, "class");
    }
    printf("320x240 YUYV, 8 classes, 32 open blobs, 16 results: %u bytes of RAM, at most %u\n",
           (unsigned)sizeof robot_memory, (unsigned)BUDGET_BYTES);
    check(sizeof robot_memory <= BUDGET_BYTES, "memory");
    printf("%u passed, %u failed\n", passed, failed);
    return failed > 0 || passed == 0;
}
#endif
