/* What a V4L2 camera offers: formats, sizes, rates, and which of them serves a wish best. */
#include "v4l2_camera.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* No driver offers more of anything; one that never ends its list must not hold us for ever. */
enum { LIST_MAX = 256, WIDTH_DEFAULT = 640, HEIGHT_DEFAULT = 480 };

/* Sizes: one, or a range with steps. */
typedef struct size_range {
    unsigned width_min, width_max, width_step;
    unsigned height_min, height_max, height_step;
} size_range;

static int read_sizes(capture *camera, uint32_t fourcc, unsigned index, size_range *sizes)
{
    struct v4l2_frmsizeenum entry;

    memset(&entry, 0, sizeof entry);
    entry.index = index;
    entry.pixel_format = fourcc;
    if (v4l2_call(&v4l2_state(camera)->device, VIDIOC_ENUM_FRAMESIZES, &entry)) {
        return 0;
    }
    memset(sizes, 0, sizeof *sizes);
    if (entry.type == V4L2_FRMSIZE_TYPE_DISCRETE) {
        sizes->width_min = sizes->width_max = entry.discrete.width;
        sizes->height_min = sizes->height_max = entry.discrete.height;
    } else {
        sizes->width_min = entry.stepwise.min_width;
        sizes->width_max = entry.stepwise.max_width;
        sizes->width_step = entry.stepwise.step_width;
        sizes->height_min = entry.stepwise.min_height;
        sizes->height_max = entry.stepwise.max_height;
        sizes->height_step = entry.stepwise.step_height;
    }
    return sizes->width_min > 0 && sizes->height_min > 0 && sizes->width_min <= sizes->width_max &&
           sizes->height_min <= sizes->height_max;
}

/* The fastest rate at a size; 0/0 if the driver does not say. */
static void read_rate(capture *camera, uint32_t fourcc, unsigned width, unsigned height,
                      unsigned *num, unsigned *den)
{
    *num = *den = 0;
    for (unsigned index = 0; index < LIST_MAX; index++) {
        struct v4l2_frmivalenum entry;
        struct v4l2_fract interval;

        memset(&entry, 0, sizeof entry);
        entry.index = index;
        entry.pixel_format = fourcc;
        entry.width = width;
        entry.height = height;
        if (v4l2_call(&v4l2_state(camera)->device, VIDIOC_ENUM_FRAMEINTERVALS, &entry)) {
            return;
        }
        interval = entry.type == V4L2_FRMIVAL_TYPE_DISCRETE ? entry.discrete : entry.stepwise.min;
        if (interval.numerator > 0 && interval.denominator > 0 &&
            (*den == 0 ||
             (uint64_t)interval.denominator * *den > (uint64_t)*num * interval.numerator)) {
            *num = interval.denominator;
            *den = interval.numerator;
        }
        if (entry.type != V4L2_FRMIVAL_TYPE_DISCRETE) {
            return;
        }
    }
}

static int read_format(capture *camera, unsigned index, struct v4l2_fmtdesc *entry)
{
    v4l2_device *const device = &v4l2_state(camera)->device;

    memset(entry, 0, sizeof *entry);
    entry->index = index;
    entry->type = device->queue;
    return v4l2_call(device, VIDIOC_ENUM_FMT, entry) == 0;
}

/* ---- The list of modes --------------------------------------------------------------------- */

typedef struct mode_list {
    capture_mode *modes;
    size_t max, count;
} mode_list;

static void add_mode(capture *camera, mode_list *list, capture_mode *mode)
{
    read_rate(camera, mode->fourcc, mode->width_max, mode->height_max, &mode->rate_num,
              &mode->rate_den);
    if (list->count < list->max) {
        list->modes[list->count] = *mode;
    }
    list->count++;
}

static void add_modes_of(capture *camera, mode_list *list, const struct v4l2_fmtdesc *entry)
{
    const int kind = capture_format_of(entry->pixelformat, NULL);
    const size_t before = list->count;
    capture_mode mode;
    size_range sizes;

    memset(&mode, 0, sizeof mode);
    mode.fourcc = entry->pixelformat;
    mode.readable = kind == 1 || (kind == 2 && capture_can_decode());
    capture_copy_text(mode.description, sizeof mode.description, (const char *)entry->description,
                      sizeof entry->description);
    for (unsigned i = 0; i < LIST_MAX && read_sizes(camera, mode.fourcc, i, &sizes); i++) {
        mode.width_min = sizes.width_min;
        mode.width_max = sizes.width_max;
        mode.height_min = sizes.height_min;
        mode.height_max = sizes.height_max;
        add_mode(camera, list, &mode);
    }
    if (list->count == before) { /* sizes are not said */
        if (list->count < list->max) {
            list->modes[list->count] = mode;
        }
        list->count++;
    }
}

int v4l2_modes(capture *camera, capture_mode *modes, size_t max)
{
    mode_list list = {modes, max, 0};
    struct v4l2_fmtdesc entry;

    if (v4l2_state(camera)->device.fd < 0) {
        return capture_fail(camera, CAPTURE_ERR_GONE, "the camera is unplugged");
    }
    for (unsigned i = 0; i < LIST_MAX && read_format(camera, i, &entry); i++) {
        add_modes_of(camera, &list, &entry);
    }
    return (int)list.count;
}

/* ---- What serves best ---------------------------------------------------------------------- */

static unsigned distance(unsigned a, unsigned b)
{
    return a > b ? a - b : b - a;
}

/* How far a size is from the wish; a side that was not wished does not count, and without any wish
 * it is that of a plain webcam. */
static unsigned size_distance(const capture_wish *wish, unsigned width, unsigned height)
{
    if (wish->width == 0 && wish->height == 0) {
        return distance(width, WIDTH_DEFAULT) + distance(height, HEIGHT_DEFAULT);
    }
    return (wish->width ? distance(width, wish->width) : 0) +
           (wish->height ? distance(height, wish->height) : 0);
}

static unsigned nearest_step(unsigned wanted, unsigned min, unsigned max, unsigned step)
{
    unsigned steps;

    if (wanted <= min || step == 0) {
        return wanted <= min ? min : (wanted < max ? wanted : max);
    }
    if (wanted > max) {
        wanted = max;
    }
    steps = (wanted - min) / step;
    if (wanted - min - steps * step > step / 2 && max - min - steps * step >= step) {
        steps++;
    }
    return min + steps * step;
}

static int is_possible(uint32_t fourcc, unsigned width, unsigned height)
{
    pel_format format;

    return width <= PEL_SIDE_MAX && height <= PEL_SIDE_MAX && capture_format_of(fourcc, &format) &&
           pel_frame_bytes(format, (uint16_t)width, (uint16_t)height) > 0;
}

/* The nearest size of a range; where the format cannot have it (odd sides), the next one below. */
static int nearest_in(const capture_wish *wish, uint32_t fourcc, const size_range *sizes,
                      v4l2_candidate *best)
{
    const int any = wish->width == 0 && wish->height == 0;
    const unsigned width = any ? WIDTH_DEFAULT : wish->width;
    const unsigned height = any ? HEIGHT_DEFAULT : wish->height;

    best->width = nearest_step(width, sizes->width_min, sizes->width_max, sizes->width_step);
    best->height = nearest_step(height, sizes->height_min, sizes->height_max, sizes->height_step);
    for (int turn = 0; turn < 2 && !is_possible(fourcc, best->width, best->height); turn++) {
        const unsigned step = turn == 0 ? sizes->width_step : sizes->height_step;
        unsigned *const side = turn == 0 ? &best->width : &best->height;
        const unsigned min = turn == 0 ? sizes->width_min : sizes->height_min;

        if (step > 0 && *side % 2 == 1 && *side - min >= step) {
            *side -= step;
        }
    }
    return is_possible(fourcc, best->width, best->height);
}

static void find_size(capture *camera, v4l2_candidate *candidate)
{
    const capture_wish *const wish = &camera->wish;
    size_range sizes;
    int found = 0;

    for (unsigned i = 0; i < LIST_MAX && read_sizes(camera, candidate->fourcc, i, &sizes); i++) {
        v4l2_candidate here = *candidate;

        if (nearest_in(wish, candidate->fourcc, &sizes, &here) &&
            (!found || size_distance(wish, here.width, here.height) <
                           size_distance(wish, candidate->width, candidate->height))) {
            *candidate = here;
            found = 1;
        }
    }
    if (found) {
        read_rate(camera, candidate->fourcc, candidate->width, candidate->height,
                  &candidate->rate_num, &candidate->rate_den);
    } else { /* the driver will say */
        candidate->width = wish->width ? wish->width : WIDTH_DEFAULT;
        candidate->height = wish->height ? wish->height : HEIGHT_DEFAULT;
    }
}

static int reaches_rate(const capture_wish *wish, const v4l2_candidate *candidate)
{
    if (wish->rate_num == 0 || candidate->rate_den == 0) {
        return 1;
    }
    /* 29.97 is meant where 30 is said. */
    return (uint64_t)candidate->rate_num * wish->rate_den * 1001 >=
           (uint64_t)wish->rate_num * candidate->rate_den * 1000;
}

/* Negative if `a` serves better. */
static long compare(const capture_wish *wish, const v4l2_candidate *a, const v4l2_candidate *b)
{
    const int raw_a = capture_format_of(a->fourcc, NULL) == 1 || capture_can_decode();
    const int raw_b = capture_format_of(b->fourcc, NULL) == 1 || capture_can_decode();
    long order = (b->fourcc == wish->fourcc) - (a->fourcc == wish->fourcc);

    if (order == 0) {
        order = raw_b - raw_a;
    }
    if (order == 0) {
        order = (long)size_distance(wish, a->width, a->height) -
                (long)size_distance(wish, b->width, b->height);
    }
    if (order == 0) {
        order = reaches_rate(wish, b) - reaches_rate(wish, a);
    }
    if (order == 0) {
        order = capture_format_rank(a->fourcc) - capture_format_rank(b->fourcc);
    }
    return order;
}

typedef struct candidate_list {
    v4l2_candidate *entries;
    unsigned count;
} candidate_list;

static void add_candidate(capture *camera, candidate_list *list, uint32_t fourcc)
{
    v4l2_candidate made;
    unsigned at = list->count;

    if (!capture_format_of(fourcc, NULL) || list->count == V4L2_CANDIDATES_MAX) {
        return;
    }
    for (unsigned i = 0; i < list->count; i++) {
        if (list->entries[i].fourcc == fourcc) {
            return;
        }
    }
    memset(&made, 0, sizeof made);
    made.fourcc = fourcc;
    find_size(camera, &made);
    while (at > 0 && compare(&camera->wish, &made, &list->entries[at - 1]) < 0) {
        list->entries[at] = list->entries[at - 1];
        at--;
    }
    list->entries[at] = made;
    list->count++;
}

unsigned v4l2_candidates(capture *camera, v4l2_candidate candidates[V4L2_CANDIDATES_MAX])
{
    candidate_list list = {candidates, 0};
    struct v4l2_fmtdesc entry;
    unsigned index = 0;

    while (index < LIST_MAX && read_format(camera, index, &entry)) {
        add_candidate(camera, &list, entry.pixelformat);
        index++;
    }
    if (index == 0) { /* a driver that does not list its formats: ask for all that can be read */
        for (int rank = 0; capture_format_at(rank) != 0; rank++) {
            add_candidate(camera, &list, capture_format_at(rank));
        }
    }
    return list.count;
}
