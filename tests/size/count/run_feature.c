/* Corners, edges, spans and lines. */
#include "count.h"

static pel_corners corners;
static uint32_t kept;

static pel_corners_config corners_config(const job *j)
{
    const pel_corners_config config = {.method = (pel_corners_method)j->choice,
                                       .width = WIDTH,
                                       .height = HEIGHT,
                                       .threshold = j->other,
                                       .work = work,
                                       .work_bytes = WORK_BYTES,
                                       .results = (pel_corner *)results,
                                       .results_max = CORNERS_MAX};
    return config;
}

static void begin_corners(const job *j)
{
    const pel_corners_config config = corners_config(j);
    done(pel_corners_begin(&corners, &config));
}

static uint32_t push_corners(uint16_t y)
{
    done(pel_corners_row(&corners, y, row.bytes));
    return 0;
}

static uint32_t end_corners(const job *j)
{
    (void)j;
    done(pel_corners_end(&corners, &kept));
    return 0;
}

static uint32_t look_at_corners(void)
{
    return corners.found;
}

const family corner_rows = {
    .begin = begin_corners, .push = push_corners, .end = end_corners, .look = look_at_corners};

/* ---- Edges ---------------------------------------------------------------------------------- */

static pel_canny canny;

static void begin_canny(const job *j)
{
    const pel_canny_config config = {.width = WIDTH,
                                     .height = HEIGHT,
                                     .low = (uint16_t)j->choice,
                                     .high = (uint16_t)j->other,
                                     .work = work,
                                     .work_bytes = WORK_BYTES};
    done(pel_canny_begin(&canny, &config));
}

static uint32_t push_canny(uint16_t y)
{
    (void)y;
    done(pel_canny_push(&canny, row.bytes));
    return 0;
}

static uint32_t pull_canny(void)
{
    return pel_canny_pull(&canny, output_bytes()) == PEL_OK ? WIDTH : 0u;
}

static uint32_t look_at_canny(void)
{
    return canny.row;
}

const family canny_rows = {
    .begin = begin_canny, .push = push_canny, .pull = pull_canny, .look = look_at_canny};

static uint32_t push_link(uint16_t y)
{
    (void)y;
    done(pel_canny_link_row(NULL, NULL, WIDTH, output_bytes()));
    return WIDTH;
}

const family canny_link = {.push = push_link};

/* ---- Spans and lines ------------------------------------------------------------------------ */

static const pel_scan scan_label_1 = {.label = 1};
static pel_point_q4 *points;
static uint32_t point_count;

enum { POINTS_MAX = 120, SPANS_MAX = 16 };

static void begin_scan(const job *j)
{
    (void)j;
    points = (pel_point_q4 *)results;
    point_count = 0;
}

static uint32_t push_scan(uint16_t y)
{
    pel_span *const spans = (pel_span *)work;
    const uint16_t found = pel_scan_row(&scan_label_1, row.bytes, WIDTH, spans, SPANS_MAX);
    if (found != 0 && point_count < POINTS_MAX) {
        points[point_count].x_q4 = 8 * ((int32_t)spans[0].begin + spans[0].end - 1);
        points[point_count].y_q4 = 16 * y;
        point_count++;
    }
    output_row[0] = found;
    return sizeof output_row[0];
}

static uint32_t end_line(const job *j)
{
    pel_line *const line = (pel_line *)output_row;
    done(pel_line_fit(points, point_count, (uint32_t)j->choice, (unsigned)j->other, line));
    return 0;
}

static uint32_t look_at_points(void)
{
    return point_count;
}

const family scan_rows = {.begin = begin_scan, .push = push_scan};
const family line_fit = {
    .begin = begin_scan, .push = push_scan, .end = end_line, .look = look_at_points};

/* ---- Whole frames --------------------------------------------------------------------------- */

#if !COUNT_SMALL
static pel_view frame_view(void)
{
    pel_view view;
    done(pel_view_init(frame, PEL_GRAY8, PEL_RANGE_FULL, WIDTH, HEIGHT, 0, &view));
    return view;
}

static void prepare_refine(const job *j)
{
    const pel_view view = frame_view();
    const pel_cview source = pel_view_to_read(&view);
    const pel_corners_config config = corners_config(j);
    done(pel_corners_frame(&corners, &config, &source, &kept));
}

static uint32_t end_refine(const job *j)
{
    const pel_view view = frame_view();
    const pel_cview source = pel_view_to_read(&view);
    (void)j;
    done(pel_corners_refine(&source, 5, (pel_corner *)results, kept, &output_row[0]));
    return sizeof output_row[0];
}

const family corner_refine = {.between = prepare_refine, .end = end_refine};

static void prepare_hysteresis(const job *j)
{
    const pel_view view = frame_view();
    const pel_cview source = pel_view_to_read(&view);
    const pel_canny_config config = {.low = (uint16_t)j->choice,
                                     .high = (uint16_t)j->other,
                                     .work = work,
                                     .work_bytes = WORK_BYTES};
    done(pel_canny_frame(&config, &source, &view));
}

static uint32_t end_hysteresis(const job *j)
{
    const pel_view view = frame_view();
    (void)j;
    done(pel_canny_hysteresis(&view, (pel_place *)results, RESULTS_BYTES / sizeof(pel_place)));
    return 0;
}

const family canny_hysteresis = {.between = prepare_hysteresis, .end = end_hysteresis};
#endif
