/*
 * The encoder of ports/robot/PROTOCOL.md against bytes written down by hand from that page. The two
 * bytes of each CRC come from Python's binascii.crc_hqx with initial value 0xFFFF.
 */
#include "unity.h"

#include "protocol.h"
#include "robot_target.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static pel_blob blob_at_the_right_edge(void)
{
    pel_blob blob = {0};
    blob.sum_xx = UINT64_C(0x0102030405060708);
    blob.sum_xy = UINT64_C(0x1112131415161718);
    blob.sum_yy = UINT64_C(0x2122232425262728);
    blob.area = 171;
    blob.sum_x = 52000;
    blob.sum_y = 600;
    blob.perimeter = 70;
    blob.holes = 1;
    blob.x0 = 300;
    blob.x1 = 320;
    blob.y0 = 0;
    blob.y1 = 9;
    blob.class_index = 1;
    blob.edges = PEL_EDGE_RIGHT | PEL_EDGE_TOP;
    blob.mean_y = 9;
    blob.mean_u = 8;
    blob.mean_v = 255;
    return blob;
}

static void test_crc_of_the_nine_digits(void)
{
    static const uint8_t digits[9] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
    TEST_ASSERT_EQUAL_HEX16(0x29B1, protocol_crc16(digits, 9));
    TEST_ASSERT_EQUAL_HEX16(0xFFFF, protocol_crc16(digits, 0));
}

static void test_frame_begin(void)
{
    static const uint8_t expected[19] = {0xA5, 0x01, 0x0E, 0x07, 0x00, 0x00, 0x00, 0xBA, 0xDC, 0xFE,
                                         0x00, 0x40, 0x01, 0xF0, 0x00, 0x05, 0x08, 0x80, 0x6A};
    const protocol_begin begin = {7, 0x00FEDCBA, 320, 240, 5, 8};
    uint8_t record[PROTOCOL_RECORD_MAX];
    TEST_ASSERT_EQUAL_UINT32(19, protocol_write_begin(&begin, record));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, record, 19);
}

static void test_smallest_blob(void)
{
    static const uint8_t expected[31] = {
        0xA5, 0x10, 0x1A, 0x02, 0x00, 0x00, 0x00, 0x01, 0x06,       /* frame, class, edges */
        0x2C, 0x01, 0x40, 0x01, 0x00, 0x00, 0x09, 0x00,             /* 300, 320, 0, 9 */
        0xAB, 0x00, 0x00, 0x00, 0x20, 0xCB, 0x00, 0x00, 0x58, 0x02, /* 171, 52000, 600 */
        0x00, 0x00, 0x2A, 0xE1};
    const pel_blob blob = blob_at_the_right_edge();
    uint8_t record[PROTOCOL_RECORD_MAX];
    TEST_ASSERT_EQUAL_UINT32(31, protocol_write_blob(2, 0, &blob, record));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, record, 31);
}

static void test_largest_blob(void)
{
    static const uint8_t expected[66] = {
        0xA5, 0x17, 0x3D, 0x02, 0x00, 0x00, 0x00, 0x01, 0x06,       /* frame, class, edges */
        0x2C, 0x01, 0x40, 0x01, 0x00, 0x00, 0x09, 0x00,             /* 300, 320, 0, 9 */
        0xAB, 0x00, 0x00, 0x00, 0x20, 0xCB, 0x00, 0x00, 0x58, 0x02, /* 171, 52000, 600 */
        0x00, 0x00, 0x08, 0x07, 0x06, 0x05, 0x04, 0x03, 0x02, 0x01, /* sum_xx */
        0x18, 0x17, 0x16, 0x15, 0x14, 0x13, 0x12, 0x11,             /* sum_xy */
        0x28, 0x27, 0x26, 0x25, 0x24, 0x23, 0x22, 0x21,             /* sum_yy */
        0x46, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00,             /* 70, 1 */
        0x09, 0x08, 0xFF, 0x93, 0x3F};
    const pel_blob blob = blob_at_the_right_edge();
    uint8_t record[PROTOCOL_RECORD_MAX];
    TEST_ASSERT_EQUAL_UINT32(66, protocol_write_blob(2, PEL_MEASURE_ALL, &blob, record));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, record, 66);
    TEST_ASSERT_EQUAL_UINT32(66, PROTOCOL_RECORD_MAX);
}

/* 26 bytes, and 24, 8, 3 more for moments, outline and colour; unknown bits are not sent. */
static void test_length_of_every_blob(void)
{
    static const uint8_t lengths[9] = {26, 50, 34, 58, 29, 53, 37, 61, 26};
    const pel_blob blob = blob_at_the_right_edge();
    uint8_t record[PROTOCOL_RECORD_MAX];
    for (unsigned measure = 0; measure < 9; measure++) {
        TEST_ASSERT_EQUAL_UINT32(lengths[measure] + 5u,
                                 protocol_write_blob(0, measure, &blob, record));
        TEST_ASSERT_EQUAL_UINT8(0x10 + measure % 8, record[1]);
        TEST_ASSERT_EQUAL_UINT8(lengths[measure], record[2]);
    }
}

static void test_target(void)
{
    static const uint8_t expected[18] = {0xA5, 0x03, 0x0D, 0x04, 0x03, 0x02, 0x01, 0x26, 0x0C,
                                         0x00, 0x00, 0xBC, 0x3F, 0x31, 0x20, 0x03, 0x4C, 0x7A};
    const protocol_target target = {0x01020304, 3110, 16316, 8241, 3};
    uint8_t record[PROTOCOL_RECORD_MAX];
    TEST_ASSERT_EQUAL_UINT32(18, protocol_write_target(&target, record));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, record, 18);
}

static void test_frame_end(void)
{
    static const uint8_t expected[48] = {
        0xA5, 0x02, 0x2B, 0x02, 0x00, 0x00, 0x00, 0x6A, 0x04, 0x01, 0x00, /* 2, 66666 us */
        0x01, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x03, 0x00, 0x00, 0x00, 0x04,
        0x00, 0x00, 0x00, 0x05, 0x00, 0x00, 0x00, 0x06, 0x00, 0x00, 0x00, 0x07, 0x00,
        0x00, 0x00, 0x08, 0x00, 0x09, 0x00, 0x00, 0x00, 0x01, 0xD5, 0x9E};
    const protocol_end end = {2, 66666, 9, PROTOCOL_TRUNCATED};
    const pel_blobs_counts counts = {1, 2, 3, 4, 5, 6, 7, 8};
    uint8_t record[PROTOCOL_RECORD_MAX];
    TEST_ASSERT_EQUAL_UINT32(48, protocol_write_end(&end, &counts, record));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, record, 48);
}

/* The middle of pixel x of a picture of width w is (x + 1/2) / w: of pixel 0 of 2, 1/4. */
static void test_target_of_a_blob(void)
{
    pel_blob blob = {0};
    robot_target target = robot_target_of(5, &blob, 320, 240);
    TEST_ASSERT_EQUAL_UINT32(0, target.area);
    TEST_ASSERT_EQUAL_UINT32(5, target.frame);
    blob.area = 1;
    blob.class_index = 4;
    target = robot_target_of(6, &blob, 2, 4);
    TEST_ASSERT_EQUAL_UINT16(8192, target.x_q15);
    TEST_ASSERT_EQUAL_UINT16(4096, target.y_q15);
    TEST_ASSERT_EQUAL_UINT8(4, target.class_index);
    blob.sum_x = 8191; /* the last pixel of the widest picture: 16383 / 16384 */
    blob.sum_y = 4095; /* 8191 / 16384 */
    target = robot_target_of(7, &blob, 8192, 8192);
    TEST_ASSERT_EQUAL_UINT16(32766, target.x_q15);
    TEST_ASSERT_EQUAL_UINT16(16382, target.y_q15);
}

static void test_the_control_loop_reads_the_newest(void)
{
    robot_target target = {9, 9, 9, 9, 9};
    TEST_ASSERT_EQUAL_UINT32(0, robot_target_read(&target));
    TEST_ASSERT_EQUAL_UINT32(0, target.area);
    for (uint32_t i = 1; i < 6; i++) {
        const robot_target newest = {i, 10 * i, (uint16_t)i, (uint16_t)(i + 1), 2};
        robot_target_write(&newest);
        TEST_ASSERT_EQUAL_UINT32(i, robot_target_read(&target));
        TEST_ASSERT_EQUAL_UINT32(i, robot_target_read(&target));
        TEST_ASSERT_EQUAL_UINT32(10 * i, target.area);
        TEST_ASSERT_EQUAL_UINT16(i + 1, target.y_q15);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_crc_of_the_nine_digits);
    RUN_TEST(test_frame_begin);
    RUN_TEST(test_smallest_blob);
    RUN_TEST(test_largest_blob);
    RUN_TEST(test_length_of_every_blob);
    RUN_TEST(test_target);
    RUN_TEST(test_frame_end);
    RUN_TEST(test_target_of_a_blob);
    RUN_TEST(test_the_control_loop_reads_the_newest);
    return UNITY_END();
}
