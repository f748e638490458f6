/* Compressed frames: decoded into the caller's memory, refused when damaged. */
#include "scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <unity.h>

#ifdef REPLAY_HAVE_JPEG
#include <jpeglib.h>
#endif

enum { WIDTH = 64, HEIGHT = 48, STRIDE = 3 * WIDTH + 5 };

static uint8_t pixels[HEIGHT * STRIDE + 1];
static pel_view view;

void setUp(void)
{
    scene_begin();
    wish.fourcc = V4L2_PIX_FMT_MJPEG;
    wish.width = WIDTH;
    wish.height = HEIGHT;
    memset(pixels, 0xA5, sizeof pixels);
    pel_view_init(pixels, PEL_RGB888, PEL_RANGE_FULL, WIDTH, HEIGHT, STRIDE, &view);
}

void tearDown(void)
{
    scene_end();
}

/* Takes a frame of the bytes given and decodes it; the status and *message are the decoder's. */
static capture_status decode(const uint8_t *bytes, size_t count, char message[200])
{
    capture_frame frame;
    capture_status status;

    world.nodes[0].jpeg = bytes;
    world.nodes[0].jpeg_bytes = count;
    if (!camera) {
        scene_start();
    }
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_next(camera, 1000, &frame));
    TEST_ASSERT_EQUAL_UINT(count, frame.byte_count);
    status = capture_decode(camera, &frame, &view);
    snprintf(message, 200, "%s", capture_error(camera));
    capture_give_back(camera, &frame);
    return status;
}

static void test_arguments(void)
{
    capture_frame frame;

    scene_start();
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, capture_next(camera, 1000, &frame));
    TEST_ASSERT_NULL(frame.view.plane[0]);
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_decode(NULL, &frame, &view));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_decode(camera, NULL, &view));
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_decode(camera, &frame, NULL));
    view.width--;
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_decode(camera, &frame, &view));
    view.width++;
    view.format = PEL_BGR888;
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_decode(camera, &frame, &view));
    view.format = PEL_RGB888;
    view.plane[0] = NULL;
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_decode(camera, &frame, &view));
}

static void test_frames_that_are_not_compressed_are_refused(void)
{
    capture_frame frame;

    wish.fourcc = V4L2_PIX_FMT_YUYV;
    wish.width = 32;
    wish.height = 24;
    scene_start();
    frame = scene_take();
    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_ARG, capture_decode(camera, &frame, &view));
}

#ifdef REPLAY_HAVE_JPEG

typedef struct jpeg {
    uint8_t *bytes;
    size_t count;
} jpeg;

/* Four fields of even colour. */
static const uint8_t colors[4][3] = {{200, 40, 30}, {30, 180, 60}, {20, 60, 210}, {240, 240, 240}};

static const uint8_t *color_at(unsigned x, unsigned y)
{
    return colors[(y >= HEIGHT / 2) * 2 + (x >= WIDTH / 2)];
}

static jpeg encode(unsigned width, unsigned height, int gray)
{
    struct jpeg_compress_struct encoder;
    struct jpeg_error_mgr errors;
    unsigned long count = 0;
    jpeg made = {NULL, 0};
    uint8_t row[3 * WIDTH];
    JSAMPROW rows = row;

    encoder.err = jpeg_std_error(&errors);
    jpeg_create_compress(&encoder);
    jpeg_mem_dest(&encoder, &made.bytes, &count);
    encoder.image_width = width;
    encoder.image_height = height;
    encoder.input_components = gray ? 1 : 3;
    encoder.in_color_space = gray ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_set_defaults(&encoder);
    jpeg_set_quality(&encoder, 95, TRUE);
    jpeg_start_compress(&encoder, TRUE);
    for (unsigned y = 0; y < height; y++) {
        for (unsigned x = 0; x < width; x++) {
            memcpy(row + (gray ? x : 3 * x), color_at(x, y), gray ? 1 : 3);
        }
        jpeg_write_scanlines(&encoder, &rows, 1);
    }
    jpeg_finish_compress(&encoder);
    jpeg_destroy_compress(&encoder);
    made.count = count;
    return made;
}

/* In the middle of each field, where no edge reaches; padding must be as it was. */
static void check_pixels(int gray)
{
    for (unsigned i = 0; i < 4; i++) {
        const unsigned x = i % 2 ? 48 : 16;
        const unsigned y = i / 2 ? 36 : 12;

        for (unsigned c = 0; c < 3; c++) {
            TEST_ASSERT_UINT8_WITHIN(3, color_at(x, y)[gray ? 0 : c],
                                     pixels[y * STRIDE + 3 * x + c]);
        }
    }
    for (unsigned y = 0; y < HEIGHT; y++) {
        TEST_ASSERT_EACH_EQUAL_HEX8(0xA5, pixels + y * STRIDE + 3 * WIDTH, STRIDE - 3 * WIDTH);
    }
}

static void test_decodes(void)
{
    char message[200];

    for (int gray = 0; gray < 2; gray++) {
        jpeg made = encode(WIDTH, HEIGHT, gray);

        memset(pixels, 0xA5, sizeof pixels);
        TEST_ASSERT_EQUAL_INT(CAPTURE_OK, decode(made.bytes, made.count, message));
        check_pixels(gray);
        free(made.bytes);
    }
}

/* Cameras leave out the tables that all have, the mark at the end, or add zeros behind it. */
static void test_what_cameras_leave_out(void)
{
    jpeg made = encode(WIDTH, HEIGHT, 0);
    uint8_t *const bare = (uint8_t *)malloc(made.count + 8);
    char message[200];
    size_t used = 2;

    memcpy(bare, made.bytes, 2);
    for (size_t at = 2; at < made.count;) {
        const size_t length = 2 + ((size_t)made.bytes[at + 2] << 8) + made.bytes[at + 3];
        const int is_scan = made.bytes[at + 1] == 0xDA;
        const size_t copied = is_scan ? made.count - at : length;

        if (made.bytes[at + 1] != 0xC4) {
            memcpy(bare + used, made.bytes + at, copied);
            used += copied;
        }
        at += copied;
    }
    TEST_ASSERT_TRUE(used + 400 < made.count); /* the four tables are gone */
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, decode(bare, used, message));
    check_pixels(0);
    memset(pixels, 0xA5, sizeof pixels);
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, decode(bare, used - 2, message));
    check_pixels(0);
    memset(bare + used, 0, 8);
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, decode(bare, used + 8, message));
    free(bare);
    free(made.bytes);
}

static void test_cut_short(void)
{
    jpeg made = encode(WIDTH, HEIGHT, 0);
    char message[200];

    for (size_t count = 4; count < made.count - 12; count += 7) {
        uint8_t *const cut = (uint8_t *)malloc(count);

        memcpy(cut, made.bytes, count);
        TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_FORMAT, decode(cut, count, message));
        TEST_ASSERT_EQUAL_STRING_LEN("damaged JPEG: ", message, 14);
        free(cut);
    }
    free(made.bytes);
}

static void test_flipped_bytes_do_no_harm(void)
{
    jpeg made = encode(WIDTH, HEIGHT, 0);
    char message[200];
    unsigned refused = 0;

    for (size_t at = 2; at < made.count; at++) {
        for (unsigned bit = 0; bit < 8; bit += 3) {
            made.bytes[at] ^= (uint8_t)(1u << bit);
            refused += decode(made.bytes, made.count, message) == CAPTURE_ERR_FORMAT;
            made.bytes[at] ^= (uint8_t)(1u << bit);
        }
    }
    TEST_ASSERT_TRUE(refused > 100);
    TEST_ASSERT_EQUAL_INT(CAPTURE_OK, decode(made.bytes, made.count, message));
    for (unsigned y = 0; y < HEIGHT; y++) {
        TEST_ASSERT_EACH_EQUAL_HEX8(0xA5, pixels + y * STRIDE + 3 * WIDTH, STRIDE - 3 * WIDTH);
    }
    free(made.bytes);
}

static void test_other_size(void)
{
    jpeg made = encode(WIDTH, HEIGHT - 8, 0);
    char message[200];

    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_FORMAT, decode(made.bytes, made.count, message));
    TEST_ASSERT_EQUAL_STRING("damaged JPEG: it is 64x40 and not 64x48", message);
    free(made.bytes);
}

#else

static void test_without_libjpeg(void)
{
    static const uint8_t bytes[600] = {0xFF, 0xD8, 0xFF};
    capture_mode modes[4];
    char message[200];

    TEST_ASSERT_EQUAL_INT(CAPTURE_ERR_FORMAT, decode(bytes, sizeof bytes, message));
    TEST_ASSERT_EQUAL_STRING("JPEG frames: this build has no libjpeg", message);
    TEST_ASSERT_EQUAL_HEX8(0xA5, pixels[0]);
    TEST_ASSERT_EQUAL_INT(3, capture_modes(camera, modes, 4));
    TEST_ASSERT_EQUAL_INT(1, modes[0].readable);
    TEST_ASSERT_EQUAL_INT(0, modes[2].readable);
}

/* What cannot be decoded is not chosen if there is anything else. */
static void test_raw_is_chosen_without_libjpeg(void)
{
    wish.fourcc = 0;
    TEST_ASSERT_EQUAL_INT(CAPTURE_CHANGED, capture_open(&wish, &world.calls, &camera));
    TEST_ASSERT_EQUAL_HEX32(V4L2_PIX_FMT_YUYV, scene_settings().fourcc);
}

#endif

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_arguments);
    RUN_TEST(test_frames_that_are_not_compressed_are_refused);
#ifdef REPLAY_HAVE_JPEG
    RUN_TEST(test_decodes);
    RUN_TEST(test_what_cameras_leave_out);
    RUN_TEST(test_cut_short);
    RUN_TEST(test_flipped_bytes_do_no_harm);
    RUN_TEST(test_other_size);
#else
    RUN_TEST(test_without_libjpeg);
    RUN_TEST(test_raw_is_chosen_without_libjpeg);
#endif
    return UNITY_END();
}
