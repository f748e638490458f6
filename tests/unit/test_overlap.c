/*
 * "Must not overlap" is checked: an output that would overwrite an input that is still to be read
 * is refused, and both are left as they were. Neighbours that share no byte are fine.
 */
#include "unity.h"

#include <pel.h>

enum { BYTES = 128 };

static uint8_t memory[BYTES];

void setUp(void)
{
    for (unsigned i = 0; i < BYTES; i++) {
        memory[i] = (uint8_t)(7 * i + 3);
    }
}

void tearDown(void)
{
}

static void assert_untouched(void)
{
    for (unsigned i = 0; i < BYTES; i++) {
        TEST_ASSERT_EQUAL_UINT8((uint8_t)(7 * i + 3), memory[i]);
    }
}

/* Colour rows of 4 pixels, 12 bytes, at 32; the other row at every place around it. */
static void test_colour_rows_are_the_same_or_apart(void)
{
    for (unsigned at = 16; at <= 48; at++) {
        const int apart = at + 12 <= 32 || at >= 44;
        const pel_status wanted = apart || at == 32 ? PEL_OK : PEL_ERR_ARG;
        setUp();
        TEST_ASSERT_EQUAL_INT(wanted,
                              pel_rgb_to_ycbcr_row(memory + 32, memory + at, 4, PEL_RANGE_FULL));
        TEST_ASSERT_EQUAL_INT(wanted,
                              pel_ycbcr_to_rgb_row(memory + 32, memory + at, 4, PEL_RANGE_FULL));
        TEST_ASSERT_EQUAL_INT(wanted, pel_rgb_to_nrgb_row(memory + 32, memory + at, 4, 0));
        TEST_ASSERT_EQUAL_INT(wanted, pel_rgb_to_hsv_row(memory + 32, memory + at, 4));
        if (wanted != PEL_OK) {
            assert_untouched();
        }
    }
}

/* A YUYV row of 8 pixels, 16 bytes, at 32. */
static void test_what_is_read_from_a_row_goes_elsewhere(void)
{
    const pel_crow row = pel_crow_packed(memory + 32, PEL_YUYV, PEL_RANGE_FULL, 8);
    uint8_t a[8], b[8];

    for (unsigned at = 8; at <= 60; at++) {
        const pel_status planes = at + 8 <= 32 || at >= 48 ? PEL_OK : PEL_ERR_ARG;
        const pel_status rgb = at + 24 <= 32 || at >= 48 ? PEL_OK : PEL_ERR_ARG;
        TEST_ASSERT_EQUAL_INT(planes,
                              pel_crow_read_yuv(&row, 0, 8, PEL_RANGE_FULL, memory + at, a, b));
        TEST_ASSERT_EQUAL_INT(planes,
                              pel_crow_read_yuv(&row, 0, 8, PEL_RANGE_FULL, a, memory + at, b));
        TEST_ASSERT_EQUAL_INT(planes,
                              pel_crow_read_yuv(&row, 0, 8, PEL_RANGE_FULL, a, b, memory + at));
        TEST_ASSERT_EQUAL_INT(rgb, pel_crow_read_rgb(&row, 0, 8, memory + at));
    }
}

static void test_y_u_and_v_go_to_different_places(void)
{
    const pel_crow row = pel_crow_packed(memory, PEL_YUYV, PEL_RANGE_FULL, 8);
    uint8_t out[32];

    TEST_ASSERT_EQUAL_INT(PEL_OK,
                          pel_crow_read_yuv(&row, 0, 8, PEL_RANGE_FULL, out, out + 8, out + 16));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG,
                          pel_crow_read_yuv(&row, 0, 8, PEL_RANGE_FULL, out, out + 7, out + 16));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG,
                          pel_crow_read_yuv(&row, 0, 8, PEL_RANGE_FULL, out, out + 8, out + 15));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG,
                          pel_crow_read_yuv(&row, 0, 8, PEL_RANGE_FULL, out + 16, out, out + 9));
}

static void test_labels_do_not_overwrite_their_row(void)
{
    static pel_boxes boxes;
    const pel_classifier classifier = {&boxes,
                                       {NULL, 0, 0, 0},
                                       PEL_RANGE_FULL,
                                       NULL,
                                       .reader = pel_crow_read_yuv,
                                       .pieces = pel_classify_pieces};
    const pel_crow yuyv = pel_crow_packed(memory + 32, PEL_YUYV, PEL_RANGE_FULL, 8);
    const pel_crow nv12 = {{memory + 32, memory + 64, NULL}, 8, PEL_NV12, PEL_RANGE_FULL};
    const pel_crow bayer = {{memory + 32, memory + 64, NULL}, 8, PEL_BAYER8_RGGB, PEL_RANGE_FULL};

    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_classify_row(&classifier, &yuyv, memory + 24));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_classify_row(&classifier, &yuyv, memory + 48));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_classify_row(&classifier, &yuyv, memory + 25));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_classify_row(&classifier, &yuyv, memory + 47));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_classify_row(&classifier, &nv12, memory + 71));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_classify_row(&classifier, &nv12, memory + 72));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_classify_row(&classifier, &bayer, memory + 71));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_classify_row(&classifier, &bayer, memory + 72));
}

/* A YUYV picture of 4 x 4, rows of 8 bytes with padding to 12, upright and bottom up. */
static void test_frames_do_not_overwrite_themselves(void)
{
    static pel_boxes boxes;
    static uint64_t work[PEL_BLOBS_WORDS(4, 4, 0)];
    const pel_classifier classifier = {&boxes,
                                       {NULL, 0, 0, 0},
                                       PEL_RANGE_FULL,
                                       NULL,
                                       .reader = pel_crow_read_yuv,
                                       .pieces = pel_classify_pieces};
    pel_blobs_config config = {0};
    pel_blobs blobs;
    pel_cview view[2];
    pel_view labels;
    uint32_t count;

    config.width = config.height = 4;
    config.open_max = 4;
    config.work = work;
    config.work_bytes = sizeof work;
    pel_cview_init(memory + 32, PEL_YUYV, PEL_RANGE_FULL, 4, 4, 12, &view[0]);
    pel_cview_init(memory + 32 + 36, PEL_YUYV, PEL_RANGE_FULL, 4, 4, -12, &view[1]);
    for (unsigned i = 0; i < 2; i++) { /* the picture covers 32 .. 75 */
        pel_view_init(memory + 76, PEL_GRAY8, PEL_RANGE_FULL, 4, 4, 0, &labels);
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_classify_frame(&classifier, &view[i], &labels));
        pel_view_init(memory + 75, PEL_GRAY8, PEL_RANGE_FULL, 4, 4, 0, &labels);
        TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_classify_frame(&classifier, &view[i], &labels));
        pel_view_init(memory + 17, PEL_GRAY8, PEL_RANGE_FULL, 4, 4, 0, &labels);
        TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_classify_frame(&classifier, &view[i], &labels));
        TEST_ASSERT_EQUAL_INT(
            PEL_OK, pel_blobs_frame(&blobs, &config, &classifier, &view[i], memory + 28, &count));
        TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_blobs_frame(&blobs, &config, &classifier, &view[i],
                                                           memory + 29, &count));
        TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_blobs_frame(&blobs, &config, &classifier, &view[i],
                                                           memory + 75, &count));
    }
}

static void test_results_do_not_lie_in_the_working_memory(void)
{
    static uint64_t both[PEL_BLOBS_WORDS(8, 8, 0) + 16];
    pel_blobs_config config = {0};
    pel_blobs blobs;

    config.width = config.height = 8;
    config.open_max = 8;
    config.work = both;
    config.work_bytes = 8 * PEL_BLOBS_WORDS(8, 8, 0);
    config.results_max = 1;
    config.results = (pel_blob *)(void *)(both + PEL_BLOBS_WORDS(8, 8, 0));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_blobs_begin(&blobs, &config));
    config.results = (pel_blob *)(void *)(both + PEL_BLOBS_WORDS(8, 8, 0) - 1);
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_blobs_begin(&blobs, &config));
}

/* Labels and pixels are read while the finder writes its working memory and its results. */
static void test_a_finder_does_not_read_what_it_writes(void)
{
    static uint64_t work[PEL_BLOBS_WORDS(8, 8, 0)];
    static pel_blob results[2];
    static pel_boxes boxes;
    const pel_classifier classifier = {&boxes,
                                       {NULL, 0, 0, 0},
                                       PEL_RANGE_FULL,
                                       NULL,
                                       .reader = pel_crow_read_yuv,
                                       .pieces = pel_classify_pieces};
    pel_blobs_config config = {0};
    pel_blobs blobs = {0};
    pel_cview view;
    uint32_t count;

    config.width = 8;
    config.height = 1;
    config.open_max = 8;
    config.work = work;
    config.work_bytes = sizeof work;
    config.results = results;
    config.results_max = 2;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_blobs_begin(&blobs, &config));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_blobs_row(&blobs, 0, (uint8_t *)work + 16, NULL));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_blobs_row(&blobs, 0, (uint8_t *)results + 120, NULL));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_blobs_row(&blobs, 0, (uint8_t *)&blobs, NULL));
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_blobs_row(&blobs, 0, memory, NULL));

    pel_cview_init(memory, PEL_YUYV, PEL_RANGE_FULL, 8, 1, 0, &view);
    TEST_ASSERT_EQUAL_INT(
        PEL_ERR_ARG, pel_blobs_frame(&blobs, &config, &classifier, &view, (uint8_t *)work, &count));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_blobs_frame(&blobs, &config, &classifier, &view,
                                                       (uint8_t *)results, &count));
}

static void test_the_finder_itself_lies_elsewhere(void)
{
    static uint64_t work[PEL_BLOBS_WORDS(8, 8, 0)];
    static union {
        pel_blobs blobs;
        pel_blob results[8];
        uint64_t words[64];
    } place;
    pel_blobs_config config = {0};

    config.width = config.height = 8;
    config.open_max = 8;
    config.work = work;
    config.work_bytes = sizeof work;
    config.results = place.results;
    config.results_max = 8;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_blobs_begin(&place.blobs, &config));
    config.results_max = 0;
    config.results = NULL;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_blobs_begin(&place.blobs, &config));
    config.work = place.words;
    config.work_bytes = sizeof place.words;
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG, pel_blobs_begin(&place.blobs, &config));
}

/* Refused means that nothing was written, scratch included. */
static void test_a_refused_frame_leaves_the_labels_alone(void)
{
    static uint64_t work[PEL_BLOBS_WORDS(8, 8, 0)];
    static pel_boxes boxes;
    pel_classifier classifier = {&boxes,
                                 {NULL, 0, 0, 0},
                                 PEL_RANGE_FULL,
                                 NULL,
                                 .reader = pel_crow_read_yuv,
                                 .pieces = pel_classify_pieces};
    pel_blobs_config config = {0};
    pel_blobs blobs = {0};
    pel_cview view;
    uint32_t count = 77;

    config.width = 8;
    config.height = 1;
    config.open_max = 8;
    config.work = work;
    config.work_bytes = sizeof work - 8;
    pel_cview_init(memory, PEL_YUYV, PEL_RANGE_FULL, 8, 1, 0, &view);
    TEST_ASSERT_EQUAL_INT(
        PEL_ERR_SPACE, pel_blobs_frame(&blobs, &config, &classifier, &view, memory + 64, &count));
    config.work_bytes = sizeof work;
    classifier.range = PEL_RANGE_LIMITED;
    TEST_ASSERT_EQUAL_INT(
        PEL_ERR_FORMAT, pel_blobs_frame(&blobs, &config, &classifier, &view, memory + 64, &count));
    TEST_ASSERT_EQUAL_INT(PEL_ERR_ARG,
                          pel_blobs_frame(&blobs, &config, NULL, &view, memory + 64, &count));
    assert_untouched();
    TEST_ASSERT_EQUAL_UINT32(77, count);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_colour_rows_are_the_same_or_apart);
    RUN_TEST(test_what_is_read_from_a_row_goes_elsewhere);
    RUN_TEST(test_y_u_and_v_go_to_different_places);
    RUN_TEST(test_labels_do_not_overwrite_their_row);
    RUN_TEST(test_frames_do_not_overwrite_themselves);
    RUN_TEST(test_results_do_not_lie_in_the_working_memory);
    RUN_TEST(test_a_finder_does_not_read_what_it_writes);
    RUN_TEST(test_the_finder_itself_lies_elsewhere);
    RUN_TEST(test_a_refused_frame_leaves_the_labels_alone);
    return UNITY_END();
}
