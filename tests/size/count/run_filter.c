/* Neighbourhood filters. */
#include "count.h"

static pel_filter filter;
static pel_filter_config config;

static void take_filter(const job *j)
{
    const filter_choice *const choice = j->data;

    config.op = choice->op;
    config.op_s16 = choice->op_s16;
    config.kernel = choice->name ? pel_kernel_named(choice->name) : choice->kernel;
}

/* other: the border; data: a filter_choice. */
static void begin_filter(const job *j)
{
    config.border = (pel_border)j->other;
    config.constant = 90;
    config.width = WIDTH;
    config.height = HEIGHT;
    config.work = work;
    config.work_bytes = WORK_BYTES;
    done(pel_filter_begin(&filter, &config));
}

static uint32_t push_filter(uint16_t y)
{
    (void)y;
    done(pel_filter_push(&filter, row.bytes));
    return 0;
}

static uint32_t pull_filter(void)
{
    return pel_filter_pull(&filter, output_bytes()) == PEL_OK ? pel_filter_width(&config) : 0u;
}

static uint32_t pull_filter_s16(void)
{
    int16_t *const out = (int16_t *)output_row;
    return pel_filter_pull_s16(&filter, out) == PEL_OK ? 2u * pel_filter_width(&config) : 0u;
}

/* Rows that never came would otherwise count as fast. */
static uint32_t look_at_filter(void)
{
    return filter.row;
}

const family filter_row = {.ready = take_filter,
                           .begin = begin_filter,
                           .push = push_filter,
                           .pull = pull_filter,
                           .look = look_at_filter};
const family filter_row_s16 = {.ready = take_filter,
                               .begin = begin_filter,
                               .push = push_filter,
                               .pull = pull_filter_s16,
                               .look = look_at_filter};

#if !COUNT_SMALL
static uint32_t end_two(const job *j)
{
    pel_view view;
    config.border = PEL_BORDER_REPLICATE;
    config.work = work;
    config.work_bytes = WORK_BYTES;
    done(pel_view_init(frame, PEL_GRAY8, PEL_RANGE_FULL, WIDTH, HEIGHT, 0, &view));
    const pel_cview source = pel_view_to_read(&view);
    const filter_choice *const choice = j->data;
    done(pel_filter_twice(&config, choice->op, choice->second, &source, &view));
    return 0;
}

const family filter_two = {.end = end_two};
#endif
