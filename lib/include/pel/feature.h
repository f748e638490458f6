/*
 * Corners, edges and lines, found while the rows stream by.
 *
 *   corners   Harris, Shi-Tomasi and FAST-9: non-maximum suppression, the strongest N, 1/16 pixel
 *   edges     Canny: thin edges row by row, hysteresis on the map or, approximated, on rows
 *   lines     spans of a label or of an edge per row or column, and the straight line through them
 *
 * Corners need 5 or 7 rows of gray and 3 of responses, whatever the height:
 *
 *     static uint32_t work[PEL_CORNERS_WORDS(320, PEL_CORNERS_HARRIS)];
 *     static pel_corner found[100];
 *     pel_corners corners;
 *     pel_corners_config config = {0};
 *     config.width = 320;
 *     config.height = 240;
 *     config.work = work;
 *     config.work_bytes = sizeof work;
 *     config.results = found;
 *     config.results_max = 100;
 *
 *     pel_corners_begin(&corners, &config);
 *     for (y = 0; y < 240; y++)
 *         pel_corners_row(&corners, y, gray_row(y));
 *     pel_corners_end(&corners, &count);          found[0..count-1], strongest first
 */
#ifndef PEL_FEATURE_H
#define PEL_FEATURE_H

#include "pel/backend.h"
#include "pel/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Corners ------------------------------------------------------------------------------- */

/*
 * How strong a corner is, as an integer; 0 or less is none.
 *
 * The first two come from the structure tensor: gx and gy are the sums of Sobel's 3x3 kernels, and
 *     a = sum of gx * gx,  b = sum of gx * gy,  c = sum of gy * gy     over the 3x3 pixels around.
 * Outside the picture its edge pixels repeat without end, so a response depends on the 5x5 pixels
 * around alone. As |gx| + |gy| <= 1530 and each is at most 1020, gx^2 + gy^2 <= 1300500 and
 * a + c <= 11704500 < 2^24; the determinant a c - b^2 is at most ((a + c) / 2)^2 < 2^45.
 *
 * HARRIS      floor((2^15 (a c - b^2) - k_q15 (a + c)^2) / 2^29): Harris's measure (Harris and
 *             Stephens 1988) in units of 2^14. Within 2^31 as k is at most 1/4.
 * SHI_TOMASI  floor((a + c - sqrt((a - c)^2 + 4 b^2)) / 2): the smaller eigenvalue (Shi and Tomasi
 *             1994), 0..5852250. A square root per pixel.
 * FAST9       of the 16 pixels on a circle of radius 3, at least 9 in a row are all brighter than
 *             the centre by more than t, or all darker (Rosten and Drummond 2006); the response is
 *             the largest t for which this holds, 1..254, or 0 if that is under the threshold. The
 *             three pixels at each border have no circle and are never corners. By far the fastest.
 */
typedef enum pel_corners_method {
    PEL_CORNERS_HARRIS = 0,
    PEL_CORNERS_SHI_TOMASI,
    PEL_CORNERS_FAST9,
    PEL_CORNERS_METHOD_COUNT
} pel_corners_method;

/*
 * Which of the pixels that reach the threshold are reported.
 *
 * FIRST   those stronger than their four neighbours that came before (left, and the three above)
 *         and at least as strong as the four to come: of two equal neighbours the first counts, so
 *         a flat top gives its first pixel, not none and not all. (A top that is not convex gives
 *         one for each of its upper tips.)
 * STRICT  those stronger than all eight: a flat top gives none. OpenCV's FAST does this.
 * NONE    all of them.
 * Neighbours outside the picture do not count.
 */
typedef enum pel_corners_suppress {
    PEL_SUPPRESS_FIRST = 0,
    PEL_SUPPRESS_STRICT,
    PEL_SUPPRESS_NONE
} pel_corners_suppress;

/*
 * A corner. dx and dy say in 1/16 pixel, -8..8, where the top of the response lies beside the
 * pixel: the vertex of the parabola through it and its two neighbours on the axis, rounded to
 * nearest, halves upward. 0 for FAST9, for PEL_SUPPRESS_NONE, and on an axis where a neighbour is
 * outside the picture. So x in 1/16 pixel is 16 * x + dx_q4.
 */
typedef struct pel_corner {
    int32_t response;
    uint16_t x, y;
    int8_t dx_q4, dy_q4;
} pel_corner;

/*
 * Bytes of working memory: 2r + 1 rows of gray with r pixels on either side (r = 2; FAST9: 3),
 * three rows of 32-bit responses with one on either side. PEL_CORNERS_WORDS is the same in elements
 * of uint32_t, which have the alignment that is needed.
 */
#define PEL_CORNERS_RADIUS(method) ((method) == PEL_CORNERS_FAST9 ? 3u : 2u)
#define PEL_CORNERS_BYTES(width, method)                                                           \
    (12u * ((uint32_t)(width) + 2u) + (2u * PEL_CORNERS_RADIUS(method) + 1u) *                     \
                                          ((uint32_t)(width) + 2u * PEL_CORNERS_RADIUS(method)))
#define PEL_CORNERS_WORDS(width, method) ((PEL_CORNERS_BYTES(width, method) + 3u) / 4u)
uint32_t pel_corners_bytes(uint16_t width, pel_corners_method method);

/* What to find. Only width, height, work and work_bytes must be set; zero is a sane value for the
 * rest. */
typedef struct pel_corners_config {
    pel_corners_method method;
    pel_corners_suppress suppress;
    pel_backend backend;    /* resolved by begin */
    uint16_t width, height; /* 1..PEL_SIDE_MAX */
    uint16_t k_q15;         /* HARRIS: 0..8191, under 1/4, where nothing would be left; 0 stands for
                               1311 (0.04) */
    int32_t threshold;      /* the least response of a corner, 1 or more; FAST9: at most 254. 0
                               stands for 1, for FAST9 for 20 */
    void *work;             /* PEL_CORNERS_BYTES(width, method), aligned to 4 bytes; in use from
                               begin to the last row */
    size_t work_bytes;
    pel_corner *results;  /* the strongest, for pel_corners_end; may be NULL if results_max is 0 */
    uint32_t results_max; /* 12 bytes each */

    /* Called for every corner, in raster order, from within pel_corners_row; may be NULL. */
    void (*on_corner)(void *user, const pel_corner *corner);
    /* Called with the `width` responses of every row, from the top; may be NULL. */
    void (*on_response)(void *user, uint16_t y, const int32_t *responses);
    void *user; /* handed to both */
} pel_corners_config;

/* The finder. The caller places it (under 150 bytes) and reads `found` and `dropped`; the rest is
 * private. */
typedef struct pel_corners {
    pel_corners_config config;
    uint32_t found;   /* corners */
    uint32_t dropped; /* of those, not in `results` because it was full of stronger ones. With
                         results_max 0 nothing counts as dropped */
    uint32_t kept;
    uint16_t pushed, responded, finished;
    uint8_t radius;
    uint8_t state;
} pel_corners;

/*
 * Starts a picture; any picture in progress is forgotten. The config is copied.
 * PEL_ERR_ARG: null pointer, misaligned work, unknown method, suppression or backend, k or
 * threshold out of range. PEL_ERR_RANGE: a side is 0 or over PEL_SIDE_MAX. PEL_ERR_SPACE:
 * work_bytes too small.
 */
pel_status pel_corners_begin(pel_corners *corners, const pel_corners_config *config);

/*
 * Adds row y, `width` bytes of gray, which may be overwritten afterwards. This finds the corners of
 * row y - 3 (FAST9: y - 4); the last row finds all that are left. PEL_ERR_ARG: null pointer.
 * PEL_ERR_ORDER: not the row that is due; the picture goes on unharmed.
 */
pel_status pel_corners_row(pel_corners *corners, uint16_t y, const uint8_t *gray);

/*
 * Ends the picture: sorts the results, strongest first, then by y, then by x, smallest first; the
 * same order decides which ones stay when there are too many. *count = how many there are.
 * PEL_TRUNCATED: some were dropped. PEL_ERR_ORDER: rows are missing; the picture goes on.
 * PEL_ERR_ARG: null pointer.
 */
pel_status pel_corners_end(pel_corners *corners, uint32_t *count);

/* A whole picture: begin, add every row of a GRAY8 view, end. config.width and height are filled
 * in. PEL_ERR_FORMAT: not GRAY8. Others as of the three calls. */
pel_status pel_corners_frame(pel_corners *corners, const pel_corners_config *config,
                             const pel_cview *view, uint32_t *count);

/*
 * Moves corners to where the edges around them cross, in 1/16 pixel: the point q for which the sum
 * over the (2 radius + 1)^2 pixels p around of (g (q - p))^2 is least, g Sobel's gradient at p,
 * rounded; again from the pixel that q lies in until it stays there, at most 10 times in all
 * (Foerstner and Guelch 1987). The top of a response lies a pixel or two beside such a crossing
 * where four fields meet, as on a chessboard, and there may be several around it: all move to the
 * same place. Typically within 0.1 pixel for radius 5.
 *
 * Sets x, y, dx_q4, dy_q4 (now -8..7); the response stays. A corner that would move by more than
 * `radius` or out of the view, or that is none, stays as it is; *refined = how many did not. The
 * view must hold the rows around the corners; outside it its edge pixels repeat. The cost is that
 * of (2 radius + 1)^2 gradients for each corner and step. radius 1..5: the sums of products are
 * then under 2^30, determinants under 2^53.
 *
 * PEL_ERR_ARG: null pointer, radius out of range. PEL_ERR_FORMAT: not GRAY8. PEL_ERR_RANGE: a
 * corner outside the view; nothing was moved.
 */
pel_status pel_corners_refine(const pel_cview *view, unsigned radius, pel_corner *corners,
                              uint32_t count, uint32_t *refined);

/* ---- Edges --------------------------------------------------------------------------------- */

/*
 * Canny's edges (Canny 1986) with Sobel's 3x3 kernels, edge pixels repeated outside, and the
 * magnitude m = |gx| + |gy|, 0..2040 (0 outside the picture). A pixel is on an edge if m > low and
 * m is a maximum across the edge, that is, with tan 22.5 degrees taken as 13573 / 32768:
 *     |gy| < tan 22.5 |gx|          m > left neighbour, m >= right neighbour
 *     |gy| > (2 + tan 22.5) |gx|    m > upper neighbour, m >= lower neighbour
 *     else, gx and gy of one sign   m > upper left and m > lower right neighbour
 *     else                          m > upper right and m > lower left neighbour
 * It is strong if also m > high, otherwise weak. Weak ones count where a chain of neighbours (of
 * all eight) leads to a strong one: the hysteresis, which looks at the whole picture. All of this
 * together is byte for byte what cv::Canny(src, dst, low, high, 3, false) gives.
 */
enum { PEL_CANNY_NONE = 0, PEL_CANNY_WEAK = 128, PEL_CANNY_STRONG = 255 };

/* Bytes of working memory: three rows of gray and three of 16-bit gradients, one more on either
 * side. PEL_CANNY_WORDS is the same in elements of uint16_t, which have the alignment that is
 * needed. */
#define PEL_CANNY_BYTES(width) (9u * ((uint32_t)(width) + 2u))
#define PEL_CANNY_WORDS(width) ((PEL_CANNY_BYTES(width) + 1u) / 2u)
uint32_t pel_canny_bytes(uint16_t width);

/* All but the backend must be set. */
typedef struct pel_canny_config {
    uint16_t width, height; /* 1..PEL_SIDE_MAX */
    uint16_t low, high;     /* low <= high; a low of 2040 or more leaves no edge at all */
    pel_backend backend;    /* resolved by begin */
    void *work;             /* PEL_CANNY_BYTES(width), aligned to 2 bytes; in use until the last row
                               is pulled */
    size_t work_bytes;
} pel_canny_config;

/* The detector at work. The caller places it (under 60 bytes); private but for `row`. */
typedef struct pel_canny {
    pel_canny_config config;
    uint16_t pushed, graded;
    uint16_t row; /* how many rows have been pulled */
    uint8_t state;
} pel_canny;

/*
 * Starts a picture. PEL_ERR_ARG: null pointer, misaligned work, low over high, unknown backend.
 * PEL_ERR_RANGE: a side is 0 or over PEL_SIDE_MAX. PEL_ERR_SPACE: work_bytes too small.
 */
pel_status pel_canny_begin(pel_canny *canny, const pel_canny_config *config);

/* Adds the next row of gray. PEL_ERR_ARG: null pointer. PEL_ERR_ORDER: no row is due, or a row that
 * is ready has not been pulled. */
pel_status pel_canny_push(pel_canny *canny, const uint8_t *gray);

/*
 * Writes the next row of the edge map, `width` bytes of PEL_CANNY_NONE, WEAK and STRONG, if the
 * rows that it needs are there: row y is ready when row y + 2 or the last one has been pushed, so
 * pull until it refuses. `out` may be the row that was just pushed. PEL_ERR_ORDER: not yet, or all
 * done; nothing is written. PEL_ERR_ARG: null pointer.
 */
pel_status pel_canny_pull(pel_canny *canny, uint8_t *out);

/* The edge map of a whole GRAY8 view, before hysteresis: a loop over push and pull. config.width
 * and height are filled in. `map` may be the same pixels as `src` (same plane and stride),
 * otherwise they must not overlap (PEL_ERR_ARG). PEL_ERR_FORMAT: not GRAY8. PEL_ERR_SPACE: map has
 * another size. */
pel_status pel_canny_frame(const pel_canny_config *config, const pel_cview *src,
                           const pel_view *map);

/* A place on a map. */
typedef struct pel_place {
    uint16_t x, y;
} pel_place;

/*
 * Hysteresis, exact, in place on a whole GRAY8 map: every WEAK pixel becomes STRONG where a chain
 * of WEAK neighbours leads to a STRONG one, else NONE; other values stay as they are. `stack` is
 * room for stack_max places and buys time only: the result is the same without any (NULL, 0), by
 * sweeps down and up over the map until nothing changes. Two sweeps serve most pictures; a spiral
 * needs one for every half turn, and width * height places always suffice for a single sweep.
 * PEL_ERR_ARG: null pointer. PEL_ERR_FORMAT: not GRAY8.
 */
pel_status pel_canny_hysteresis(const pel_view *map, pel_place *stack, uint32_t stack_max);

/*
 * What of hysteresis can be done without the map: links row y to the linked row above and to the
 * strong pixels of the row below, which is not linked yet. A stretch of WEAK and STRONG pixels
 * becomes all STRONG if it holds a STRONG one or touches (also diagonally) a STRONG one above or
 * below, else NONE. Edges grow downward without end, but upward by one row only: the result holds
 * all strong pixels and nothing that the exact hysteresis would not keep. NULL for `above` or
 * `below` at the first and last row.
 * PEL_ERR_ARG: row is NULL. PEL_ERR_RANGE: width is 0 or over PEL_SIDE_MAX.
 */
pel_status pel_canny_link_row(const uint8_t *above, const uint8_t *below, uint16_t width,
                              uint8_t *row);

/* ---- Spans --------------------------------------------------------------------------------- */

/* What to look for in rows of labels or of an edge map. Zero is a sane value for everything but
 * label. */
typedef struct pel_scan {
    uint8_t label;                   /* the value to look for */
    uint8_t columns;                 /* pel_scan_view: 1 = look along columns instead of rows */
    uint16_t length_min, length_max; /* of a span, pixels; a max of 0: no bound */
    uint16_t x0, x1, y0, y1;         /* where to look, half-open; all 0: everywhere. Spans end at
                                        the edge of it */
} pel_scan;

/* The stretch begin <= i < end of a row (or of a column) that has the label. */
typedef struct pel_span {
    uint16_t begin, end;
} pel_span;

/*
 * The spans of a row of `width` labels, from left to right, the first spans_max of them into
 * `spans`. Returns how many there are, which may be more. y0 and y1 are not looked at. A null
 * pointer or a region that is not inside the row: 0.
 */
uint16_t pel_scan_row(const pel_scan *scan, const uint8_t *labels, uint16_t width, pel_span *spans,
                      uint16_t spans_max);

/* ---- Lines --------------------------------------------------------------------------------- */

/* A point in 1/16 pixel; 16 * x is the centre of pixel x. */
typedef struct pel_point_q4 {
    int32_t x_q4, y_q4;
} pel_point_q4;

/*
 * The centres of all spans of a GRAY8 view of labels, row by row (with scan.columns column by
 * column), the first points_max of them into `points`; *count = how many those are. PEL_TRUNCATED:
 * there were more.
 * PEL_ERR_ARG: null pointer. PEL_ERR_FORMAT: not GRAY8. PEL_ERR_RANGE: the region is not inside the
 * view.
 */
pel_status pel_scan_view(const pel_scan *scan, const pel_cview *view, pel_point_q4 *points,
                         uint32_t points_max, uint32_t *count);

/*
 * A straight line in any direction: the points (x, y) with
 *     (y - y_q4) * dx_q16 = (x - x_q4) * dy_q16,
 * or -x dy_q16 + y dx_q16 = offset_q4 * 65536: offset is the distance from the origin, positive
 * where the origin lies above the line (left of an upright one).
 */
typedef struct pel_line {
    int32_t x_q4, y_q4;     /* the mean of the points it was fitted to, rounded */
    int32_t dx_q16, dy_q16; /* its direction, of length 65536 within 1; dx >= 0 */
    int32_t offset_q4;
    int32_t x0_q4, y0_q4; /* its ends: the outermost inliers, dropped onto it; x0 <= x1 */
    int32_t x1_q4, y1_q4;
    uint16_t inliers;     /* points within the distance */
    int16_t angle_turn16; /* its direction in 1/65536 of a turn, -16384..16383: 0 along x, 8192 = 45
                             degrees down to the right, -16384 upright; within 2 units */
} pel_line;

/* The most points that a line can be fitted to, and the largest coordinate: -131072..131071, that
 * is 8192 pixels. With both, sums of coordinates stay within 2^30, of squares within 2^48. */
#define PEL_LINE_POINTS_MAX 4096
#define PEL_LINE_COORDINATE_MAX_Q4 131071

/*
 * The line with the least sum of squared distances from the points, measured at right angles to it:
 * the long axis of their second moments (Pearson 1901). Then `rounds` times: points that are too
 * far away are left out and the line is fitted anew, in the last round to those within distance_q4,
 * in the one before within twice that, and so on, so that a poor first line does not lose the good
 * points; outliers that lie together beyond an end of the line, where they turn it most, can still
 * hold it. A round that would keep fewer than two points or no two different ones is not done.
 * `inliers` counts what lies within distance_q4 of the final line. Where no direction stands out
 * the angle is 0.
 *
 * The line is within 2/16 pixel of the exact one at the mean and turned against it by at most
 * 1/32768.
 * PEL_ERR_ARG: null pointer, rounds over 8, distance over 131071. PEL_ERR_RANGE: more than
 * PEL_LINE_POINTS_MAX points, fewer than two different ones, or a coordinate out of range.
 */
pel_status pel_line_fit(const pel_point_q4 *points, uint32_t count, uint32_t distance_q4,
                        unsigned rounds, pel_line *line);

/* The distance of a point from the line in 1/16 pixel, rounded to nearest, halves upward; positive
 * below it (right of an upright one). Coordinates within 2^29. */
int32_t pel_line_distance_q4(const pel_line *line, int32_t x_q4, int32_t y_q4);

#ifdef __cplusplus
}
#endif

#endif
