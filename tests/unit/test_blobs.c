/*
 * Blobs by hand: small pictures whose numbers anyone can count, which show what each field means
 * and what the finder does when memory is short.
 */
#include "unity.h"

#include <pel.h>

enum { WIDTH_MAX = 8, OPEN_MAX = 8, RESULTS_MAX = 8 };

static uint64_t work[PEL_BLOBS_WORDS(WIDTH_MAX, OPEN_MAX, PEL_MEASURE_ALL)];
static pel_blob found[RESULTS_MAX];
static pel_blobs blobs;
static pel_blobs_config config;

void setUp(void)
{
    const pel_blobs_config zero = {0};
    unsigned i;
    config = zero;
    config.open_max = OPEN_MAX;
    config.measure = PEL_MEASURE_MOMENTS | PEL_MEASURE_OUTLINE;
    config.measurer = pel_blobs_measure;
    config.work = work;
    config.work_bytes = sizeof work;
    config.results = found;
    config.results_max = RESULTS_MAX;
    for (i = 0; i < sizeof work / sizeof work[0]; i++) {
        work[i] = 0xA5A5A5A5A5A5A5A5u; /* what work holds before a frame is of no account */
    }
}

void tearDown(void)
{
}

/* A picture drawn as text, '.' = background, 'a' = class 0, 'b' = class 1, one row per `width`. */
static void labels_of_row(const char *picture, uint16_t y, uint8_t *labels)
{
    uint16_t x;
    for (x = 0; x < config.width; x++) {
        const char pixel = picture[y * config.width + x];
        labels[x] = (uint8_t)(pixel == '.' ? 0 : pixel - 'a' + 1);
    }
}

static void begin(uint16_t width, uint16_t height)
{
    config.width = width;
    config.height = height;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_blobs_begin(&blobs, &config));
}

/* Streams a picture through the finder; the status of the end. */
static pel_status find(const char *picture, uint16_t width, uint16_t height, uint32_t *count)
{
    uint8_t labels[WIDTH_MAX];
    uint16_t y;
    begin(width, height);
    for (y = 0; y < height; y++) {
        labels_of_row(picture, y, labels);
        TEST_ASSERT_TRUE(pel_blobs_row(&blobs, y, labels, NULL) >= 0);
    }
    return pel_blobs_end(&blobs, count);
}

static uint32_t find_all(const char *picture, uint16_t width, uint16_t height)
{
    uint32_t count = 0;
    TEST_ASSERT_EQUAL_INT(PEL_OK, find(picture, width, height, &count));
    return count;
}

static void assert_box(unsigned x0, unsigned x1, unsigned y0, unsigned y1, const pel_blob *blob)
{
    TEST_ASSERT_EQUAL_UINT(x0, blob->x0);
    TEST_ASSERT_EQUAL_UINT(x1, blob->x1);
    TEST_ASSERT_EQUAL_UINT(y0, blob->y0);
    TEST_ASSERT_EQUAL_UINT(y1, blob->y1);
}

/* ---- What a blob tells ----------------------------------------------------------------------- */

static void test_an_l_shape_and_all_its_numbers(void)
{
    static const char picture[] = ".a..."
                                  ".a..."
                                  ".aaa."
                                  ".....";
    TEST_ASSERT_EQUAL_UINT32(1, find_all(picture, 5, 4));
    TEST_ASSERT_EQUAL_UINT8(0, found[0].class_index);
    TEST_ASSERT_EQUAL_UINT32(5, found[0].area);
    TEST_ASSERT_EQUAL_UINT32(1 + 1 + 1 + 2 + 3, found[0].sum_x);
    TEST_ASSERT_EQUAL_UINT32(0 + 1 + 2 + 2 + 2, found[0].sum_y);
    TEST_ASSERT_EQUAL_UINT32(1 + 1 + 1 + 4 + 9, (uint32_t)found[0].sum_xx);
    TEST_ASSERT_EQUAL_UINT32(0 + 1 + 2 + 4 + 6, (uint32_t)found[0].sum_xy);
    TEST_ASSERT_EQUAL_UINT32(0 + 1 + 4 + 4 + 4, (uint32_t)found[0].sum_yy);
    assert_box(1, 4, 0, 3, &found[0]);
    TEST_ASSERT_EQUAL_UINT32(12, found[0].perimeter); /* as long as that of its 3x3 box */
    TEST_ASSERT_EQUAL_UINT32(0, found[0].holes);
    TEST_ASSERT_EQUAL_UINT8(PEL_EDGE_TOP, found[0].edges);
}

static void test_a_ring_has_a_hole_with_a_border(void)
{
    static const char picture[] = ".aaa."
                                  ".a.a."
                                  ".aaa.";
    TEST_ASSERT_EQUAL_UINT32(1, find_all(picture, 5, 3));
    TEST_ASSERT_EQUAL_UINT32(8, found[0].area);
    TEST_ASSERT_EQUAL_UINT32(1, found[0].holes);
    TEST_ASSERT_EQUAL_UINT32(12 + 4, found[0].perimeter); /* outside and around the hole */
    TEST_ASSERT_EQUAL_UINT8(PEL_EDGE_TOP | PEL_EDGE_BOTTOM, found[0].edges);
}

static void test_a_hole_may_hold_another_class(void)
{
    static const char picture[] = "aaaaa"
                                  "ab.aa"
                                  "aaaaa";
    TEST_ASSERT_EQUAL_UINT32(2, find_all(picture, 5, 3));
    TEST_ASSERT_EQUAL_UINT32(13, found[0].area);
    TEST_ASSERT_EQUAL_UINT32(1, found[0].holes); /* b and background are one region that is not a */
    TEST_ASSERT_EQUAL_UINT8(15, found[0].edges);
    TEST_ASSERT_EQUAL_UINT32(1, found[1].area);
    TEST_ASSERT_EQUAL_UINT8(1, found[1].class_index);
    TEST_ASSERT_EQUAL_UINT32(4, found[1].perimeter);
    TEST_ASSERT_EQUAL_UINT8(0, found[1].edges);
}

static void test_an_open_corner_lets_a_hole_out(void)
{
    /* With 8 neighbours the blob closes at its corner; what it encloses is connected by 4 only. */
    static const char picture[] = ".aa"
                                  "a.a"
                                  "aaa";
    TEST_ASSERT_EQUAL_UINT32(1, find_all(picture, 3, 3));
    TEST_ASSERT_EQUAL_UINT32(1, found[0].holes);
    config.connectivity = 4;
    TEST_ASSERT_EQUAL_UINT32(1, find_all(picture, 3, 3));
    TEST_ASSERT_EQUAL_UINT32(0, found[0].holes);
    TEST_ASSERT_EQUAL_UINT32(12 + 4, found[0].perimeter); /* edges count by either rule */
}

static void test_diagonal_pixels_touch_by_8_and_not_by_4(void)
{
    static const char picture[] = "a.."
                                  ".a."
                                  "..a";
    TEST_ASSERT_EQUAL_UINT32(1, find_all(picture, 3, 3));
    TEST_ASSERT_EQUAL_UINT32(3, found[0].area);
    config.connectivity = 8; /* the same by name */
    TEST_ASSERT_EQUAL_UINT32(1, find_all(picture, 3, 3));
    config.connectivity = 4;
    TEST_ASSERT_EQUAL_UINT32(3, find_all(picture, 3, 3));
    TEST_ASSERT_EQUAL_UINT16(0, found[0].y0); /* equal areas: the uppermost first */
    TEST_ASSERT_EQUAL_UINT16(1, found[1].y0);
    TEST_ASSERT_EQUAL_UINT16(2, found[2].y0);
}

static void test_classes_are_found_apart(void)
{
    static const char picture[] = "aabb"
                                  "bbba"
                                  "...a";
    TEST_ASSERT_EQUAL_UINT32(3, find_all(picture, 4, 3));
    TEST_ASSERT_EQUAL_UINT8(1, found[0].class_index);
    TEST_ASSERT_EQUAL_UINT32(5, found[0].area);
    TEST_ASSERT_EQUAL_UINT8(0, found[1].class_index);
    assert_box(0, 2, 0, 1, &found[1]); /* both have 2 pixels: the upper one first */
    assert_box(3, 4, 1, 3, &found[2]);
}

static void test_arms_that_meet_are_one_blob(void)
{
    static const char picture[] = "a.a.a.a"
                                  "a.a.a.a"
                                  "aaa.aaa"
                                  "..a.a.."
                                  "..aaa..";
    TEST_ASSERT_EQUAL_UINT32(1, find_all(picture, 7, 5));
    TEST_ASSERT_EQUAL_UINT32(4 + 4 + 6 + 2 + 3, found[0].area);
    TEST_ASSERT_EQUAL_UINT32(0, found[0].holes);
    TEST_ASSERT_EQUAL_UINT16(4, blobs.counts.open_peak);
}

static void test_what_is_not_measured_is_zero(void)
{
    config.measure = 0;
    TEST_ASSERT_EQUAL_UINT32(1, find_all(".aa.aa", 3, 2));
    TEST_ASSERT_EQUAL_UINT32(4, found[0].area);
    TEST_ASSERT_TRUE(found[0].sum_xx == 0 && found[0].sum_xy == 0 && found[0].sum_yy == 0);
    TEST_ASSERT_EQUAL_UINT32(0, found[0].perimeter);
    TEST_ASSERT_EQUAL_UINT32(0, found[0].holes);
    TEST_ASSERT_EQUAL_UINT8(0, found[0].mean_y);
    TEST_ASSERT_EQUAL_UINT16(0, pel_blob_compactness_q15(&found[0]));
}

static void test_an_empty_frame_has_no_blobs(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, find_all("......", 3, 2));
    TEST_ASSERT_EQUAL_UINT32(0, blobs.counts.found);
    TEST_ASSERT_EQUAL_UINT16(0, blobs.counts.open_peak);
}

/* ---- Streaming ------------------------------------------------------------------------------- */

typedef struct diary {
    uint32_t calls;
    uint32_t area[4];
} diary;

static void write_down(void *user, const pel_blob *blob)
{
    diary *book = user;
    if (book->calls < 4) {
        book->area[book->calls] = blob->area;
    }
    book->calls++;
}

static void test_a_blob_is_reported_with_the_row_below_it(void)
{
    static const char picture[] = "aa..b"
                                  "....b"
                                  "..a.b";
    static const uint32_t calls_after[] = {0, 1, 1};
    uint8_t labels[WIDTH_MAX];
    diary book = {0, {0, 0, 0, 0}};
    uint32_t count = 0;
    uint16_t y;
    config.on_blob = write_down;
    config.user = &book;
    begin(5, 3);
    for (y = 0; y < 3; y++) {
        labels_of_row(picture, y, labels);
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_blobs_row(&blobs, y, labels, NULL));
        TEST_ASSERT_EQUAL_UINT32(calls_after[y], book.calls);
        labels[0] = 0xFF; /* the row is the caller's again */
    }
    TEST_ASSERT_EQUAL_UINT32(2, book.area[0]);
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_blobs_end(&blobs, &count));
    TEST_ASSERT_EQUAL_UINT32(3, book.calls);
    TEST_ASSERT_EQUAL_UINT32(3, count);
    TEST_ASSERT_EQUAL_UINT32(3, found[0].area); /* results: the largest first */
    TEST_ASSERT_EQUAL_UINT32(2, found[1].area);
    TEST_ASSERT_EQUAL_UINT32(1, found[2].area);
}

static void test_rows_must_come_in_order(void)
{
    static const uint8_t labels[4] = {1, 1, 0, 0};
    uint32_t count = 77;
    begin(4, 2);
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ORDER, pel_blobs_row(&blobs, 1, labels, NULL));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_blobs_row(&blobs, 0, labels, NULL));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ORDER, pel_blobs_row(&blobs, 0, labels, NULL));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ORDER, pel_blobs_end(&blobs, &count));
    TEST_ASSERT_EQUAL_UINT32(77, count);
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_blobs_row(&blobs, 1, NULL, NULL));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_blobs_row(&blobs, 1, labels, NULL));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ORDER, pel_blobs_row(&blobs, 2, labels, NULL));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_blobs_end(&blobs, NULL));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_blobs_end(&blobs, &count));
    TEST_ASSERT_EQUAL_UINT32(1, count); /* no refusal harmed the frame */
    TEST_ASSERT_EQUAL_UINT32(4, found[0].area);
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ORDER, pel_blobs_end(&blobs, &count));
}

/* ---- When something does not fit ------------------------------------------------------------- */

static void test_a_short_result_list_keeps_the_largest(void)
{
    static const char picture[] = "a.aaa.aa"
                                  "........"
                                  "aaaa.aaa";
    uint32_t count = 0;
    config.results_max = 2;
    TEST_ASSERT_EQUAL_INT(PEL_TRUNCATED, find(picture, 8, 3, &count));
    TEST_ASSERT_EQUAL_UINT32(2, count);
    TEST_ASSERT_EQUAL_UINT32(4, found[0].area);
    TEST_ASSERT_EQUAL_UINT32(3, found[1].area);
    TEST_ASSERT_EQUAL_UINT16(0, found[1].y0); /* of two with 3 pixels the upper one */
    TEST_ASSERT_EQUAL_UINT32(5, blobs.counts.found);
    TEST_ASSERT_EQUAL_UINT32(3, blobs.counts.dropped);
    TEST_ASSERT_EQUAL_UINT32(1 + 2 + 3, blobs.counts.dropped_px);
    TEST_ASSERT_EQUAL_UINT32(0, blobs.counts.lost_px);
}

static void test_too_few_open_blobs_lose_whole_blobs_and_count_them(void)
{
    static const char picture[] = "a.a.a"
                                  "a.a.a"
                                  "....."
                                  "aaaaa";
    uint32_t count = 0;
    config.open_max = 2;
    TEST_ASSERT_EQUAL_INT(PEL_TRUNCATED, find(picture, 5, 4, &count));
    TEST_ASSERT_EQUAL_UINT32(3, count); /* two of the three bars, and the beam below */
    TEST_ASSERT_EQUAL_UINT32(5, found[0].area);
    TEST_ASSERT_EQUAL_UINT32(2, found[1].area);
    TEST_ASSERT_EQUAL_UINT32(2, found[2].area);
    TEST_ASSERT_EQUAL_UINT32(2, blobs.counts.lost_px);
    TEST_ASSERT_EQUAL_UINT16(2, blobs.counts.open_peak);
    config.open_max = 3;
    TEST_ASSERT_EQUAL_INT(PEL_OK, find(picture, 5, 4, &count));
    TEST_ASSERT_EQUAL_UINT32(4, count);
    TEST_ASSERT_EQUAL_UINT32(0, blobs.counts.lost_px);
    TEST_ASSERT_EQUAL_UINT32(0, blobs.counts.lost_opens);
}

static void test_a_blob_that_lost_an_arm_is_lost_whole(void)
{
    static const char picture[] = "a.a.b"
                                  "a.a.b"
                                  "aaa.b"
                                  "a....";
    uint32_t count = 0;
    config.open_max = 1;
    TEST_ASSERT_EQUAL_INT(PEL_TRUNCATED, find(picture, 5, 4, &count));
    TEST_ASSERT_EQUAL_UINT32(0, count); /* never half of the U, never two of it */
    TEST_ASSERT_EQUAL_UINT32(8 + 3, blobs.counts.lost_px);
    config.open_max = 3;
    TEST_ASSERT_EQUAL_INT(PEL_OK, find(picture, 5, 4, &count));
    TEST_ASSERT_EQUAL_UINT32(2, count);
    TEST_ASSERT_EQUAL_UINT32(8, found[0].area);
    TEST_ASSERT_EQUAL_UINT32(3, found[1].area);
}

static void test_the_never_lose_size_never_loses(void)
{
    /* Every pixel a blob, every row all new ones: the most that a row can need. */
    static const char picture[] = "abababab"
                                  "babababa"
                                  "abababab";
    uint32_t count = 0;
    config.connectivity = 4;
    config.open_max = PEL_BLOBS_OPEN_SAFE(8);
    config.results = NULL;
    config.results_max = 0;
    TEST_ASSERT_EQUAL_INT(PEL_OK, find(picture, 8, 3, &count));
    TEST_ASSERT_EQUAL_UINT32(0, count);
    TEST_ASSERT_EQUAL_UINT32(24, blobs.counts.found);
    TEST_ASSERT_EQUAL_UINT32(0, blobs.counts.lost_opens);
}

static void test_a_filter_counts_what_it_stops(void)
{
    static const char picture[] = "a..aaa"
                                  "......"
                                  "bb..bb"
                                  "bb..b.";
    static const pel_blob_shape full_boxes = {.density_min_q15 = 32767};
    pel_blob_filter filter = {0};
    uint32_t count = 0;
    config.filter = &filter;
    filter.area_min = 2;
    TEST_ASSERT_EQUAL_INT(PEL_OK, find(picture, 6, 4, &count));
    TEST_ASSERT_EQUAL_UINT32(3, count);
    TEST_ASSERT_EQUAL_UINT32(1, blobs.counts.filtered);
    TEST_ASSERT_EQUAL_UINT32(1, blobs.counts.filtered_px);
    filter.class_mask = 2; /* bit 1: class 1, the b */
    TEST_ASSERT_EQUAL_INT(PEL_OK, find(picture, 6, 4, &count));
    TEST_ASSERT_EQUAL_UINT32(2, count);
    TEST_ASSERT_EQUAL_UINT32(4, blobs.counts.filtered_px);
    config.accept = pel_blob_shape_passes;
    config.limits = &full_boxes;
    TEST_ASSERT_EQUAL_INT(PEL_OK, find(picture, 6, 4, &count));
    TEST_ASSERT_EQUAL_UINT32(1, count);
    assert_box(0, 2, 2, 4, &found[0]);
    TEST_ASSERT_EQUAL_UINT32(7, blobs.counts.filtered_px); /* a, aaa and the b with the gap */
}

/* ---- Runs ------------------------------------------------------------------------------------ */

static void test_runs_of_a_row(void)
{
    static const uint8_t labels[8] = {1, 1, 2, 0, 0, 2, 2, 1};
    pel_run runs[PEL_RUNS_MAX(8)];
    TEST_ASSERT_EQUAL_UINT(4, pel_find_runs(labels, 8, runs));
    TEST_ASSERT_EQUAL_UINT(0, runs[0].x0);
    TEST_ASSERT_EQUAL_UINT(2, runs[0].x1);
    TEST_ASSERT_EQUAL_UINT(2, runs[1].x0);
    TEST_ASSERT_EQUAL_UINT(3, runs[1].x1);
    TEST_ASSERT_EQUAL_UINT(5, runs[2].x0);
    TEST_ASSERT_EQUAL_UINT(7, runs[2].x1);
    TEST_ASSERT_EQUAL_UINT(7, runs[3].x0);
    TEST_ASSERT_EQUAL_UINT(8, runs[3].x1);
    TEST_ASSERT_EQUAL_UINT(0, pel_find_runs(NULL, 8, runs));
    TEST_ASSERT_EQUAL_UINT(0, pel_find_runs(labels, 8, NULL));
}

/* ---- Whole frames and colours ---------------------------------------------------------------- */

/* Four columns, two rows of YUYV: an orange 2 x 2 square on the left, gray on the right. */
static const uint8_t yuyv[2 * 8] = {150, 80, 151, 200, 120, 128, 120, 128,
                                    152, 80, 153, 202, 120, 128, 120, 128};

static void test_a_frame_from_pixels_to_mean_colour(void)
{
    const pel_color_box orange = {100, 255, 60, 100, 180, 255};
    static pel_boxes boxes;
    pel_classifier classifier = {0};
    pel_cview view;
    uint8_t labels[4];
    uint32_t count = 0;
    config.width = 4;
    config.height = 2;
    config.measure = PEL_MEASURE_ALL;
    config.measurer = pel_blobs_measure;
    config.reader = pel_crow_read_ycbcr;
    classifier.boxes = &boxes;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_boxes_set(&boxes, 2, &orange));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_cview_init(yuyv, PEL_YUYV, PEL_RANGE_FULL, 4, 2, 0, &view));
    TEST_ASSERT_EQUAL_INT(PEL_OK,
                          pel_blobs_frame(&blobs, &config, &classifier, &view, labels, &count));
    TEST_ASSERT_EQUAL_UINT32(1, count);
    TEST_ASSERT_EQUAL_UINT8(2, found[0].class_index);
    assert_box(0, 2, 0, 2, &found[0]);
    TEST_ASSERT_EQUAL_UINT8(152, found[0].mean_y); /* 151.5: halves upward */
    TEST_ASSERT_EQUAL_UINT8(80, found[0].mean_u);
    TEST_ASSERT_EQUAL_UINT8(201, found[0].mean_v);
    TEST_ASSERT_EQUAL_UINT8(PEL_EDGE_LEFT | PEL_EDGE_TOP | PEL_EDGE_BOTTOM, found[0].edges);

    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_blobs_begin(&blobs, &config)); /* row by row */
    for (uint16_t y = 0; y < 2; y++) {
        const pel_crow row = pel_cview_row(&view, y);
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_blobs_pixels(&blobs, y, &classifier, &row, labels));
        TEST_ASSERT_EQUAL_INT(PEL_ERR_ORDER,
                              pel_blobs_pixels(&blobs, y, &classifier, &row, labels));
    }
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_blobs_end(&blobs, &count));
    TEST_ASSERT_EQUAL_UINT32(1, count);
    TEST_ASSERT_EQUAL_UINT32(4, found[0].area);
    assert_box(0, 2, 0, 2, &found[0]);
    TEST_ASSERT_EQUAL_UINT8(152, found[0].mean_y);

    config.width = 3; /* not the size of the view */
    count = 77;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE,
                          pel_blobs_frame(&blobs, &config, &classifier, &view, labels, &count));
    config.width = 4;
    classifier.range = PEL_RANGE_LIMITED; /* not the range of the view */
    TEST_ASSERT_EQUAL_INT(PEL_ERR_FORMAT,
                          pel_blobs_frame(&blobs, &config, &classifier, &view, labels, &count));
    TEST_ASSERT_EQUAL_UINT32(77, count);
}

/* ---- What is refused ------------------------------------------------------------------------- */

static pel_status begin_with(uint16_t width, uint16_t height)
{
    config.width = width;
    config.height = height;
    return pel_blobs_begin(&blobs, &config);
}

/* Where nothing has to be aligned, as on AVR, no memory is misaligned. */
struct element {
    char before;
    uint64_t value;
};

static void test_begin_refuses_by_name(void)
{
    TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, begin_with(0, 4));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, begin_with(4, 0));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, begin_with(PEL_SIDE_MAX + 1, 4));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_RANGE, begin_with(2592, 1944)); /* a sum could wrap */
    TEST_ASSERT_EQUAL_INT(PEL_ERR_SPACE, begin_with(2048, 2048)); /* could not, but needs more */
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_blobs_begin(NULL, &config));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_blobs_begin(&blobs, NULL));
    config.connectivity = 6;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, begin_with(4, 4));
    config.connectivity = 0;
    config.measure = 8;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, begin_with(4, 4));
    config.measure = 0;
    config.open_max = 0;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, begin_with(4, 4));
    config.open_max = 2;
    if (offsetof(struct element, value) > 1) {
        config.work = (uint8_t *)work + 1;
        TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, begin_with(4, 4));
    }
    config.work = NULL;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, begin_with(4, 4));
    config.work = work;
    config.work_bytes = pel_blobs_bytes(4, 2, 0) - 1;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_SPACE, begin_with(4, 4));
    config.work_bytes++;
    TEST_ASSERT_EQUAL_INT(PEL_OK, begin_with(4, 4));
}

static void test_sizes_as_macro_and_function(void)
{
    /* 24 per open blob, 24 for moments, 8 for the outline, 16 for colour; 12 per column and one. */
    TEST_ASSERT_EQUAL_UINT(32 * 24 + 12 * 321, PEL_BLOBS_BYTES(320, 32, 0));
    TEST_ASSERT_EQUAL_UINT(32 * (24 + 24 + 8 + 16) + 12 * 321,
                           PEL_BLOBS_BYTES(320, 32, PEL_MEASURE_ALL));
    TEST_ASSERT_TRUE(pel_blobs_bytes(320, 32, PEL_MEASURE_ALL) ==
                     PEL_BLOBS_BYTES(320, 32, PEL_MEASURE_ALL));
    TEST_ASSERT_TRUE(pel_blobs_bytes(1, 1, 0) == PEL_BLOBS_BYTES(1, 1, 0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_an_l_shape_and_all_its_numbers);
    RUN_TEST(test_a_ring_has_a_hole_with_a_border);
    RUN_TEST(test_a_hole_may_hold_another_class);
    RUN_TEST(test_an_open_corner_lets_a_hole_out);
    RUN_TEST(test_diagonal_pixels_touch_by_8_and_not_by_4);
    RUN_TEST(test_classes_are_found_apart);
    RUN_TEST(test_arms_that_meet_are_one_blob);
    RUN_TEST(test_what_is_not_measured_is_zero);
    RUN_TEST(test_an_empty_frame_has_no_blobs);
    RUN_TEST(test_a_blob_is_reported_with_the_row_below_it);
    RUN_TEST(test_rows_must_come_in_order);
    RUN_TEST(test_a_short_result_list_keeps_the_largest);
    RUN_TEST(test_too_few_open_blobs_lose_whole_blobs_and_count_them);
    RUN_TEST(test_a_blob_that_lost_an_arm_is_lost_whole);
    RUN_TEST(test_the_never_lose_size_never_loses);
    RUN_TEST(test_a_filter_counts_what_it_stops);
    RUN_TEST(test_runs_of_a_row);
    RUN_TEST(test_a_frame_from_pixels_to_mean_colour);
    RUN_TEST(test_begin_refuses_by_name);
    RUN_TEST(test_sizes_as_macro_and_function);
    return UNITY_END();
}
