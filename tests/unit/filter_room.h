/* What the suites of the filter's calls share: a picture, and work and results between guards. */
#ifndef FILTER_ROOM_H
#define FILTER_ROOM_H

#include "unity.h"

#include <pel.h>

enum { WIDTH = 6, HEIGHT = 5, PIXELS = WIDTH * HEIGHT, GUARD = 8, CANARY = 0xA5 };

static const uint8_t picture[PIXELS] = {
    3, 4, 20, 21, 20, 19, 3, 2,  3,  20, 20, 19, 2,  0, 3,
    9, 1, 20, 2,  1,  1,  5, 24, 19, 5,  10, 19, 20, 3, 255,
};

static uint8_t work_room[GUARD + PEL_FILTER_BYTES_WRAP(WIDTH, 2) + GUARD];
static uint8_t *const work = work_room + GUARD;
static uint8_t out_room[GUARD + PIXELS + GUARD];
static uint8_t *const out = out_room + GUARD;
static int16_t out_s16_room[GUARD + PIXELS + GUARD];
static int16_t *const out_s16 = out_s16_room + GUARD;

static void fill(uint8_t *bytes, uint8_t value, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        bytes[i] = value;
    }
}

void setUp(void)
{
    fill(work_room, CANARY, sizeof work_room);
    fill(out_room, CANARY, sizeof out_room);
    for (unsigned i = 0; i < GUARD + PIXELS + GUARD; i++) {
        out_s16_room[i] = CANARY;
    }
}

void tearDown(void)
{
}

static void expect_untouched(const uint8_t *bytes, size_t count)
{
    TEST_ASSERT_EACH_EQUAL_UINT8(CANARY, bytes, (uint16_t)count);
}

/* Nothing before `written` bytes of work and of the result, and nothing behind them. */
static void expect_guards(size_t work_bytes, size_t out_bytes)
{
    expect_untouched(work_room, GUARD);
    expect_untouched(work + work_bytes, sizeof work_room - GUARD - work_bytes);
    expect_untouched(out_room, GUARD);
    expect_untouched(out + out_bytes, sizeof out_room - GUARD - out_bytes);
}

static pel_filter_config config_of(pel_filter_op *op, const char *kernel, pel_border border)
{
    pel_filter_config config = {0};
    const unsigned radius = kernel == NULL ? 1 : pel_kernel_named(kernel)->radius;
    config.op = op;
    config.kernel = kernel == NULL ? NULL : pel_kernel_named(kernel);
    config.width = WIDTH;
    config.height = HEIGHT;
    config.border = border;
    config.work = work;
    config.work_bytes = pel_filter_bytes(WIDTH, radius, border);
    if (border == PEL_BORDER_WRAP) {
        config.last_rows[0] = picture + (HEIGHT - radius) * WIDTH;
        config.last_rows[1] = radius == 2 ? picture + (HEIGHT - 1) * WIDTH : NULL;
    }
    return config;
}

static pel_filter_config kernel_config(const char *kernel)
{
    return config_of(NULL, kernel, PEL_BORDER_REPLICATE);
}

#endif
