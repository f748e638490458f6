/*
 * What is computed from finished blobs, by hand: shape, filter bounds, merged and sorted lists.
 */
#include "unity.h"

#include <pel.h>

static pel_blob found[2];

void setUp(void)
{
}

void tearDown(void)
{
}

/* The one blob of a picture drawn as text, '.' = background, into found[0]. */
static void find_one(const char *picture, uint16_t width, uint16_t height)
{
    static uint64_t work[PEL_BLOBS_WORDS(4, 4, PEL_MEASURE_ALL)];
    pel_blobs blobs;
    pel_blobs_config config = {0};
    uint32_t count = 0;
    uint16_t x, y;
    config.width = width;
    config.height = height;
    config.open_max = 4;
    config.measure = PEL_MEASURE_MOMENTS | PEL_MEASURE_OUTLINE;
    config.measurer = pel_blobs_measure;
    config.work = work;
    config.work_bytes = sizeof work;
    config.results = found;
    config.results_max = 2;
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_blobs_begin(&blobs, &config));
    for (y = 0; y < height; y++) {
        uint8_t labels[4];
        for (x = 0; x < width; x++) {
            labels[x] = picture[y * width + x] != '.';
        }
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_blobs_row(&blobs, y, labels, NULL));
    }
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_blobs_end(&blobs, &count));
    TEST_ASSERT_EQUAL_UINT32(1, count);
}

static void assert_box(unsigned x0, unsigned x1, unsigned y0, unsigned y1, const pel_blob *blob)
{
    TEST_ASSERT_EQUAL_UINT(x0, blob->x0);
    TEST_ASSERT_EQUAL_UINT(x1, blob->x1);
    TEST_ASSERT_EQUAL_UINT(y0, blob->y0);
    TEST_ASSERT_EQUAL_UINT(y1, blob->y1);
}

/* ---- Filter bounds --------------------------------------------------------------------------- */

/* A bar of 6 x 2 pixels at x 10..15, y 20..21; its centroid is (12.5, 20.5). */
static pel_blob bar_6_by_2(void)
{
    pel_blob blob = {0};
    blob.area = 12;
    blob.sum_x = 2 * (10 + 11 + 12 + 13 + 14 + 15);
    blob.sum_y = 6 * (20 + 21);
    blob.sum_xx = 2 * (100 + 121 + 144 + 169 + 196 + 225);
    blob.sum_yy = 6 * (400 + 441);
    blob.sum_xy = (10 + 11 + 12 + 13 + 14 + 15) * (20 + 21);
    blob.perimeter = 16;
    blob.x0 = 10;
    blob.x1 = 16;
    blob.y0 = 20;
    blob.y1 = 22;
    blob.class_index = 3;
    return blob;
}

static void test_bounds_belong_to_the_interval(void)
{
    const pel_blob blob = bar_6_by_2();
    pel_blob_filter filter = {0};
    TEST_ASSERT_EQUAL_INT(1, pel_blob_passes(&blob, NULL));
    TEST_ASSERT_EQUAL_INT(1, pel_blob_passes(&blob, &filter));
    filter.area_min = 12;
    filter.area_max = 12;
    filter.width_min = 6;
    filter.width_max = 6;
    filter.height_min = 2;
    filter.height_max = 2;
    filter.aspect_min_q16 = 3 * 65536;
    filter.aspect_max_q16 = 3 * 65536;
    filter.class_mask = 8;
    TEST_ASSERT_EQUAL_INT(1, pel_blob_passes(&blob, &filter));
    filter.aspect_max_q16--;
    TEST_ASSERT_EQUAL_INT(0, pel_blob_passes(&blob, &filter));
    filter.aspect_max_q16 = 0;
    filter.height_min = 3;
    TEST_ASSERT_EQUAL_INT(0, pel_blob_passes(&blob, &filter));
}

static void test_the_region_of_interest_is_half_open(void)
{
    const pel_blob blob = bar_6_by_2();
    pel_blob_filter filter = {0};
    filter.roi_x1 = 13;
    filter.roi_y1 = 21;
    TEST_ASSERT_EQUAL_INT(1, pel_blob_passes(&blob, &filter));
    filter.roi_x1 = 12; /* 12.5 is not less than 12 */
    TEST_ASSERT_EQUAL_INT(0, pel_blob_passes(&blob, &filter));
    filter.roi_x1 = 100;
    filter.roi_x0 = 12;
    TEST_ASSERT_EQUAL_INT(1, pel_blob_passes(&blob, &filter));
    filter.roi_x0 = 13;
    TEST_ASSERT_EQUAL_INT(0, pel_blob_passes(&blob, &filter));
}

static void test_density_bounds(void)
{
    const pel_blob full = bar_6_by_2();
    pel_blob hollow = full;
    pel_blob_shape shape = {.density_min_q15 = 32767, .density_max_q15 = 32767};
    TEST_ASSERT_EQUAL_INT(1, pel_blob_shape_passes(&shape, &full));
    hollow.area = 11; /* 11/12 = 30037.3 / 32768 */
    TEST_ASSERT_EQUAL_INT(0, pel_blob_shape_passes(&shape, &hollow));
    shape.density_min_q15 = 30037;
    shape.density_max_q15 = 30037;
    TEST_ASSERT_EQUAL_INT(1, pel_blob_shape_passes(&shape, &hollow));
    TEST_ASSERT_EQUAL_INT(0, pel_blob_shape_passes(&shape, &full));
}

static void test_elongation_bounds(void)
{
    const pel_blob blob = bar_6_by_2(); /* roundness sqrt((4-1)/(36-1)) = 0.2928: 9593 */
    pel_blob_shape shape = {0};
    shape.elongation_min_q15 = 23160; /* 32767 - 9593 = 23174 */
    shape.elongation_max_q15 = 23190;
    TEST_ASSERT_EQUAL_INT(1, pel_blob_shape_passes(&shape, &blob));
    shape.elongation_min_q15 = 23190;
    TEST_ASSERT_EQUAL_INT(0, pel_blob_shape_passes(&shape, &blob));
    TEST_ASSERT_EQUAL_INT(1, pel_blob_shape_passes(NULL, &blob));
    TEST_ASSERT_EQUAL_INT(0, pel_blob_shape_passes(&shape, NULL));
    TEST_ASSERT_EQUAL_INT(0, pel_blob_shape_passes(NULL, NULL));
}

/* ---- Shape ----------------------------------------------------------------------------------- */

static void test_shape_of_a_bar(void)
{
    const pel_blob blob = bar_6_by_2();
    int32_t x_q16 = 0;
    int32_t y_q16 = 0;
    pel_blob_centroid_q16(&blob, &x_q16, &y_q16);
    TEST_ASSERT_EQUAL_INT32(12 * 65536 + 32768, x_q16);
    TEST_ASSERT_EQUAL_INT32(20 * 65536 + 32768, y_q16);
    TEST_ASSERT_INT_WITHIN(1, 0, pel_blob_angle_turn16(&blob));
    TEST_ASSERT_UINT_WITHIN(4, 9593, pel_blob_roundness_q15(&blob));
    TEST_ASSERT_EQUAL_UINT(32767u - pel_blob_roundness_q15(&blob), pel_blob_elongation_q15(&blob));
    TEST_ASSERT_EQUAL_UINT(32767, pel_blob_density_q15(&blob));
    TEST_ASSERT_UINT_WITHIN(1, 19302, pel_blob_compactness_q15(&blob)); /* 4 pi 12 / 256 = .58905 */
}

static void test_a_line_at_45_degrees(void)
{
    static const char falling[] = "a..."
                                  ".a.."
                                  "..a."
                                  "...a";
    static const char rising[] = "...a"
                                 "..a."
                                 ".a.."
                                 "a...";
    find_one(falling, 4, 4);
    TEST_ASSERT_INT_WITHIN(1, 8192, pel_blob_angle_turn16(&found[0])); /* y points down */
    TEST_ASSERT_EQUAL_UINT(0, pel_blob_roundness_q15(&found[0]));
    TEST_ASSERT_EQUAL_UINT(32767, pel_blob_elongation_q15(&found[0]));
    TEST_ASSERT_EQUAL_UINT(8192, pel_blob_density_q15(&found[0])); /* 4 of 16 */
    TEST_ASSERT_EQUAL_UINT32(16, found[0].perimeter);
    find_one(rising, 4, 4);
    TEST_ASSERT_INT_WITHIN(1, -8192, pel_blob_angle_turn16(&found[0]));
}

static void test_lines_along_the_axes(void)
{
    int angle;
    find_one("aaaa", 4, 1);
    TEST_ASSERT_INT_WITHIN(1, 0, pel_blob_angle_turn16(&found[0]));
    TEST_ASSERT_EQUAL_UINT(0, pel_blob_roundness_q15(&found[0]));
    find_one("aaaa", 1, 4);
    angle = pel_blob_angle_turn16(&found[0]); /* upright: a quarter turn, either way round */
    TEST_ASSERT_TRUE(angle <= -16383 || angle >= 16383);
    TEST_ASSERT_EQUAL_UINT(0, pel_blob_roundness_q15(&found[0]));
}

static void test_a_square_and_a_pixel_have_no_axis(void)
{
    find_one("aaaaaaaaa", 3, 3);
    TEST_ASSERT_EQUAL_INT(0, pel_blob_angle_turn16(&found[0]));
    TEST_ASSERT_EQUAL_UINT(32767, pel_blob_roundness_q15(&found[0]));
    TEST_ASSERT_EQUAL_UINT(0, pel_blob_elongation_q15(&found[0]));
    TEST_ASSERT_EQUAL_UINT(32767, pel_blob_density_q15(&found[0]));
    TEST_ASSERT_UINT_WITHIN(1, 25736, pel_blob_compactness_q15(&found[0])); /* pi / 4 */
    find_one("a", 1, 1);
    TEST_ASSERT_EQUAL_INT(0, pel_blob_angle_turn16(&found[0]));
    TEST_ASSERT_EQUAL_UINT(32767, pel_blob_roundness_q15(&found[0]));
    TEST_ASSERT_UINT_WITHIN(1, 25736, pel_blob_compactness_q15(&found[0]));
}

static void test_centroids_round_to_nearest(void)
{
    pel_blob blob = {0};
    int32_t x_q16 = 7;
    int32_t y_q16 = 7;
    pel_blob_centroid_q16(&blob, &x_q16, &y_q16); /* no pixels, no centroid */
    TEST_ASSERT_EQUAL_INT32(0, x_q16);
    TEST_ASSERT_EQUAL_INT32(0, y_q16);
    blob.area = 3;
    blob.sum_x = 1;
    blob.sum_y = 2;
    pel_blob_centroid_q16(&blob, &x_q16, &y_q16);
    TEST_ASSERT_EQUAL_INT32(21845, x_q16); /* 65536 / 3 = 21845.33 */
    TEST_ASSERT_EQUAL_INT32(43691, y_q16); /* 43690.67 */
    blob.area = (uint32_t)1 << 17;
    blob.sum_x = 1;
    blob.sum_y = 3;
    pel_blob_centroid_q16(&blob, &x_q16, &y_q16);
    TEST_ASSERT_EQUAL_INT32(1, x_q16); /* a half goes upward */
    TEST_ASSERT_EQUAL_INT32(2, y_q16); /* 1.5 as well */
}

/* ---- Lists ----------------------------------------------------------------------------------- */

static pel_blob box_of(unsigned x0, unsigned x1, unsigned y0, unsigned y1)
{
    pel_blob blob = {0};
    blob.area = (x1 - x0) * (y1 - y0);
    blob.x0 = (uint16_t)x0;
    blob.x1 = (uint16_t)x1;
    blob.y0 = (uint16_t)y0;
    blob.y1 = (uint16_t)y1;
    return blob;
}

static void test_merging_two_blobs(void)
{
    pel_blob into = box_of(0, 3, 5, 6);
    pel_blob from = box_of(4, 5, 2, 3);
    into.class_index = 2;
    from.class_index = 1;
    into.sum_x = 3;
    from.sum_x = 4;
    into.mean_y = 10;
    from.mean_y = 20;
    pel_blob_merge(&into, &from);
    TEST_ASSERT_EQUAL_UINT32(4, into.area);
    TEST_ASSERT_EQUAL_UINT32(7, into.sum_x);
    TEST_ASSERT_EQUAL_UINT8(2, into.class_index);
    TEST_ASSERT_EQUAL_UINT8(13, into.mean_y); /* (3 * 10 + 20) / 4 = 12.5: halves upward */
    assert_box(0, 5, 2, 6, &into);
}

static void test_density_merge_on_one_row(void)
{
    /* Two bars of 20 pixels, 180 apart, fill 40 of 220: far from .95 (31130 / 32768). */
    pel_blob list[2];
    list[0] = box_of(0, 20, 0, 1);
    list[1] = box_of(200, 220, 0, 1);
    TEST_ASSERT_EQUAL_UINT32(2, pel_blobs_merge_density(list, 2, 31130));
    list[1] = box_of(21, 41, 0, 1); /* 40 of 41 = .976 */
    TEST_ASSERT_EQUAL_UINT32(1, pel_blobs_merge_density(list, 2, 31130));
    TEST_ASSERT_EQUAL_UINT32(40, list[0].area);
    assert_box(0, 41, 0, 1, &list[0]);
}

static void test_margin_merge(void)
{
    pel_blob list[3];
    list[0] = box_of(0, 4, 0, 4);
    list[1] = box_of(6, 9, 0, 3); /* two columns between */
    list[2] = box_of(0, 1, 20, 21);
    TEST_ASSERT_EQUAL_UINT32(3, pel_blobs_merge_margin(list, 3, 2));
    TEST_ASSERT_EQUAL_UINT32(2, pel_blobs_merge_margin(list, 3, 3));
    TEST_ASSERT_EQUAL_UINT32(25, list[0].area);
    TEST_ASSERT_EQUAL_UINT32(1, list[1].area);
}

static void test_sorting(void)
{
    pel_blob list[3];
    list[0] = box_of(5, 6, 3, 4);
    list[1] = box_of(4, 5, 3, 4);
    list[2] = box_of(0, 2, 9, 10);
    pel_blobs_sort(list, 3);
    TEST_ASSERT_EQUAL_UINT32(2, list[0].area); /* area first, */
    TEST_ASSERT_EQUAL_UINT16(4, list[1].x0);   /* then from the top and from the left */
    TEST_ASSERT_EQUAL_UINT16(5, list[2].x0);
    pel_blobs_sort(NULL, 3);
}

/* Without moments there is no axis: the answers are those of a disc. */
static void test_shapes_that_were_not_measured(void)
{
    const pel_blob_shape shape = {.elongation_min_q15 = 1};
    pel_blob bar = {0};

    bar.area = 12;
    bar.sum_x = 66;
    bar.x1 = 12;
    bar.y1 = 1;
    TEST_ASSERT_EQUAL_UINT16(32767, pel_blob_roundness_q15(&bar));
    TEST_ASSERT_EQUAL_UINT16(0, pel_blob_elongation_q15(&bar));
    TEST_ASSERT_EQUAL_INT16(0, pel_blob_angle_turn16(&bar));
    TEST_ASSERT_EQUAL_UINT16(0, pel_blob_compactness_q15(&bar));
    TEST_ASSERT_EQUAL_INT(0, pel_blob_shape_passes(&shape, &bar));
}

static void test_nothing_is_known_of_no_blob(void)
{
    int32_t x = 5, y = 5;

    pel_blob_centroid_q16(NULL, &x, &y);
    TEST_ASSERT_EQUAL_INT32(0, x);
    TEST_ASSERT_EQUAL_INT32(0, y);
    pel_blob_centroid_q16(NULL, NULL, NULL);
    TEST_ASSERT_EQUAL_INT16(0, pel_blob_angle_turn16(NULL));
    TEST_ASSERT_EQUAL_UINT16(32767, pel_blob_roundness_q15(NULL));
    TEST_ASSERT_EQUAL_UINT16(0, pel_blob_elongation_q15(NULL));
    TEST_ASSERT_EQUAL_UINT16(0, pel_blob_density_q15(NULL));
    TEST_ASSERT_EQUAL_UINT16(0, pel_blob_compactness_q15(NULL));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_bounds_belong_to_the_interval);
    RUN_TEST(test_the_region_of_interest_is_half_open);
    RUN_TEST(test_density_bounds);
    RUN_TEST(test_elongation_bounds);
    RUN_TEST(test_shape_of_a_bar);
    RUN_TEST(test_a_line_at_45_degrees);
    RUN_TEST(test_lines_along_the_axes);
    RUN_TEST(test_a_square_and_a_pixel_have_no_axis);
    RUN_TEST(test_centroids_round_to_nearest);
    RUN_TEST(test_merging_two_blobs);
    RUN_TEST(test_density_merge_on_one_row);
    RUN_TEST(test_margin_merge);
    RUN_TEST(test_sorting);
    RUN_TEST(test_shapes_that_were_not_measured);
    RUN_TEST(test_nothing_is_known_of_no_blob);
    return UNITY_END();
}
