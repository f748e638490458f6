/*
 * Rows of every width from 1 to 41, where faster row kernels change from many pixels at a time to
 * single ones: against sums over the nine neighbours, written from the definitions.
 */
#include "unity.h"

#include <pel.h>
#include <pel/filter.h>

enum { WIDTH_MAX = 41, HEIGHT = 3, GUARD = 16, CANARY = 0xC3 };

static uint8_t pixels[HEIGHT][WIDTH_MAX], work[PEL_FILTER_BYTES(WIDTH_MAX, 1) + 3];
static uint8_t room[GUARD + WIDTH_MAX + GUARD];
static uint32_t state;

void setUp(void)
{
    state = 12345;
}

void tearDown(void)
{
}

static uint32_t random_bits(void)
{
    state = state * UINT32_C(1664525) + UINT32_C(1013904223);
    return state >> 8;
}

/* Noise, or black and white. */
static void draw(unsigned style)
{
    for (unsigned y = 0; y < HEIGHT; y++) {
        for (unsigned x = 0; x < WIDTH_MAX; x++) {
            const uint32_t r = random_bits();
            pixels[y][x] = (uint8_t)(style % 2 == 0 ? r : r & 1 ? 255 : 0);
        }
    }
}

/* The edge repeats. */
static int32_t pixel_at(int x, int y, int width)
{
    x = x < 0 ? 0 : x >= width ? width - 1 : x;
    return pixels[y][x];
}

static int32_t sum_at(int x, int width, const int8_t *tap)
{
    int32_t sum = 0;
    for (int k = 0; k < 9; k++) {
        sum += tap[k] * pixel_at(x + k % 3 - 1, k / 3, width);
    }
    return sum;
}

static uint8_t limited(int32_t value)
{
    return (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : value);
}

/* floor((2 sum + d) / 2 d) + bias. */
static int32_t rounded(int32_t sum, const pel_kernel *kernel)
{
    const int32_t divisor = (int32_t)(kernel->divisor == 0 ? 1 : kernel->divisor) << kernel->shift;
    const int32_t size = kernel->absolute && sum < 0 ? -sum : sum;
    const int32_t twice = 2 * size + divisor, rest = twice % (2 * divisor);
    return (twice - rest) / (2 * divisor) - (rest < 0 ? 1 : 0) + kernel->bias;
}

/* The middle row of the three, at a place in memory that is `off` bytes off. */
static const uint8_t *filtered(pel_filter_config config, uint16_t width, unsigned off)
{
    pel_filter filter;
    config.width = width;
    config.height = HEIGHT;
    config.work = work + off;
    config.work_bytes = sizeof work - off;
    for (unsigned i = 0; i < sizeof room; i++) {
        room[i] = CANARY;
    }
    TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_begin(&filter, &config));
    for (unsigned y = 0; y < HEIGHT; y++) {
        TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_push(&filter, pixels[y]));
        if (y > 0) {
            TEST_ASSERT_EQUAL_INT(PEL_OK, pel_filter_pull(&filter, room + GUARD));
        }
    }
    TEST_ASSERT_EACH_EQUAL_UINT8(CANARY, room, GUARD);
    TEST_ASSERT_EACH_EQUAL_UINT8(CANARY, room + GUARD + width, GUARD);
    return room + GUARD;
}

static void expect_kernel(const pel_kernel *kernel, uint16_t width, unsigned off)
{
    uint8_t expected[WIDTH_MAX];
    pel_filter_config config = {0};
    config.kernel = kernel;
    for (int x = 0; x < width; x++) {
        expected[x] = limited(rounded(sum_at(x, width, kernel->tap), kernel));
    }
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, filtered(config, width, off), width);
}

static void test_gauss(void)
{
    static const pel_kernel gauss = {{1, 2, 1, 2, 4, 2, 1, 2, 1}, 1, 16, 0, 0, 0};
    pel_filter_config config = {0};
    config.op = pel_op_gauss3;
    for (uint16_t width = 1; width <= WIDTH_MAX; width++) {
        for (unsigned k = 0; k < 8; k++) {
            uint8_t expected[WIDTH_MAX];
            draw(k);
            for (int x = 0; x < width; x++) {
                expected[x] = (uint8_t)rounded(sum_at(x, width, gauss.tap), &gauss);
            }
            TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, filtered(config, width, k % 4), width);
        }
    }
}

static void test_gradient_sums(void)
{
    static const int8_t right[9] = {-1, 0, 1, -2, 0, 2, -1, 0, 1};
    static const int8_t down[9] = {-1, -2, -1, 0, 0, 0, 1, 2, 1};
    pel_filter_config config = {0};
    config.op = pel_op_gradient_abs;
    for (uint16_t width = 1; width <= WIDTH_MAX; width++) {
        for (unsigned k = 0; k < 8; k++) {
            uint8_t expected[WIDTH_MAX];
            draw(k);
            for (int x = 0; x < width; x++) {
                const int32_t gx = sum_at(x, width, right), gy = sum_at(x, width, down);
                expected[x] = limited((gx < 0 ? -gx : gx) + (gy < 0 ? -gy : gy));
            }
            TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, filtered(config, width, k % 4), width);
        }
    }
}

static void test_kernels_of_random_taps(void)
{
    static const int16_t biases[4] = {0, 128, -32768, 32767};
    static const uint16_t divisors[4] = {0, 1, 9, 32767};
    for (unsigned k = 0; k < 600; k++) {
        pel_kernel kernel = {{0}, 1, 1, 0, 0, 0};
        draw(k / 2);
        for (unsigned i = 0; i < 9; i++) {
            const uint32_t r = random_bits();
            kernel.tap[i] = (int8_t)(k % 3 == 0   ? (int)(r % 256) - 128
                                     : k % 3 == 1 ? (int)(r % 9) - 3
                                     : r & 1      ? 127
                                                  : -128);
        }
        kernel.shift = (uint8_t)(k % 5 == 0 ? random_bits() % 16 : k % 5);
        kernel.divisor = divisors[k % 7 == 0 ? random_bits() % 4 : 0];
        kernel.bias = biases[k % 6 == 0 ? random_bits() % 4 : 0];
        kernel.absolute = k % 11 == 0;
        expect_kernel(&kernel, (uint16_t)(1 + k % WIDTH_MAX), k % 4);
    }
}

/* All taps and all pixels at their limits, with the largest bias and shift. */
static void test_the_largest_sums(void)
{
    for (unsigned k = 0; k < 16; k++) {
        pel_kernel kernel = {{0}, 1, 1, 0, 0, 0};
        for (unsigned i = 0; i < 9; i++) {
            kernel.tap[i] = k & 1 ? 127 : -128;
        }
        for (unsigned x = 0; x < WIDTH_MAX; x++) {
            pixels[0][x] = pixels[1][x] = pixels[2][x] = 255;
        }
        kernel.shift = k & 2 ? 15 : 11;
        kernel.bias = (int16_t)(k & 4 ? k & 8 ? 32767 : -32768 : k & 8 ? 143 : 0);
        expect_kernel(&kernel, WIDTH_MAX, 0);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_gauss);
    RUN_TEST(test_gradient_sums);
    RUN_TEST(test_kernels_of_random_taps);
    RUN_TEST(test_the_largest_sums);
    return UNITY_END();
}
