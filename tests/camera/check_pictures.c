/* Pictures by value: bars as they are defined against what arrives, in every format. */
#include <stdio.h>
#include <string.h>

#include "bars.h"
#include "check.h"
#include "knob.h"

static const char *const formats[] = {"YUYV", "UYVY", "YVYU", "VYUY", "NV12",
                                      "YU12", "RGBP", "RGBR", "RGB3", "BGR3",
                                      "GREY", "RGGB", "GRBG", "GBRG", "BA81"};

/* Still bars without text on them. */
static int show_bars(const char *device, unsigned percent)
{
    return knob_choose(device, "OSD Text Mode", "None") == 0 &&
           knob_choose(device, "Horizontal Movement", "No Movement") == 0 &&
           knob_choose(device, "Test Pattern", percent == 100 ? "100% Colorbar" : "75% Colorbar") ==
               0;
}

/* The port's word on what the driver is set to, against the driver's own. */
static int settings_agree(const capture_settings *set, const struct v4l2_pix_format *format)
{
    pel_format expected = PEL_FORMAT_COUNT;
    return set->fourcc == format->pixelformat && set->width == format->width &&
           set->height == format->height && set->bytes_per_line == format->bytesperline &&
           set->frame_bytes == format->sizeimage && !set->compressed &&
           capture_format_of(set->fourcc, &expected) == 1 && expected == set->format;
}

static void check_settings(const char *group, const char *what, const capture_settings *set,
                           const struct v4l2_pix_format *format)
{
    char text[16];
    capture_fourcc_text(set->fourcc, text);
    check_in(settings_agree(set, format), group, what,
             "the port says %s %ux%u, %u bytes a line, %u a frame; the driver %ux%u, %u, %u", text,
             set->width, set->height, set->bytes_per_line, set->frame_bytes, format->width,
             format->height, format->bytesperline, format->sizeimage);
}

static int view_is(const capture_frame *frame, const capture_settings *set)
{
    const pel_cview *view = &frame->view;
    return view->format == set->format && view->width == set->width &&
           view->height == set->height && view->plane[0] == frame->bytes &&
           pel_cview_check(view) == PEL_OK;
}

/* Streams, takes the second frame and compares it. */
static void check_bars(capture *camera, const char *device, const char *group, const char *what,
                       unsigned percent)
{
    struct v4l2_pix_format format;
    capture_settings set;
    capture_frame frame;
    char name[64];
    snprintf(name, sizeof name, "%s %u%% bars", what, percent);
    capture_get_settings(camera, &set);
    if (!show_bars(device, percent) || knob_format(device, &format) < 0) {
        check_in(0, group, name, "the driver does not do as it is told");
        return;
    }
    capture_status status = capture_start(camera);
    (void)take(camera, status < 0 ? 0 : 1, 2000);
    status = status < 0 ? status : capture_next(camera, 2000, &frame);
    if (status != CAPTURE_OK || !view_is(&frame, &set)) {
        check_in(0, group, name, "no picture: %s", told(status, camera));
        (void)capture_stop(camera);
        return;
    }
    const comparison bytes = compare_bytes(&frame, &format, percent);
    check_in(bytes.compared > 0 && bytes.wrong == 0, group, name, "%lu compared, %lu wrong %s",
             bytes.compared, bytes.wrong, bytes.first);
    /* Grey has no colours, and the library's are those of BT.601. */
    if (set.format != PEL_GRAY8 && format.ycbcr_enc != V4L2_YCBCR_ENC_709) {
        const comparison colors = compare_colors(&frame, percent);
        strcat(name, " as colours");
        check_in(colors.compared > 0 && colors.wrong == 0, group, name,
                 "%lu compared, %lu wrong %s", colors.compared, colors.wrong, colors.first);
    }
    (void)capture_give_back(camera, &frame);
    (void)capture_stop(camera);
}

/* Opens as wished, and says so if that fails. */
static capture *open_only(const capture_wish *wish, const char *group, const char *what)
{
    capture *camera = NULL;
    const capture_status status = capture_open(wish, NULL, &camera);
    if (status < 0) {
        check_in(0, group, what, "does not open: %s", told(status, camera));
        capture_close(camera);
        return NULL;
    }
    return camera;
}

static void check_picture(const capture_wish *wish, const char *group, const char *what)
{
    struct v4l2_pix_format format;
    capture_settings set;
    capture *camera = open_only(wish, group, what);
    if (!camera) {
        return;
    }
    capture_get_settings(camera, &set);
    if (knob_format(wish->device, &format) == 0 && format.width == wish->width &&
        format.height == wish->height && format.pixelformat == wish->fourcc) {
        check_settings(group, what, &set, &format);
        check_bars(camera, wish->device, group, what, 100);
        check_bars(camera, wish->device, group, what, 75);
    } else {
        check_in(0, group, what, "the driver is at %ux%u", format.width, format.height);
    }
    capture_close(camera);
}

void group_pictures(int count, char **arguments)
{
    (void)count;
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        capture_wish wish = small_wish(arguments[0]);
        wish.fourcc = capture_fourcc(formats[i]);
        check_picture(&wish, "pictures", formats[i]);
    }
}

/* Any size, of an input that scales. In pictures of 625 lines the first row holds other signals,
 * hence 525; without composing all of the frame is picture. */
void group_sizes(int count, char **arguments)
{
    static const unsigned sizes[][2] = {{322, 242}, {640, 480}, {720, 480}};
    static const char *const some[] = {"YUYV", "NV12", "RGBP"};
    (void)count;
    if (knob_standard(arguments[0], V4L2_STD_NTSC_M) < 0 ||
        knob_set(arguments[0], "Enable Capture Composing", 0) < 0) {
        check(0, "sizes", "the driver does not do as it is told");
        return;
    }
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        char what[32];
        capture_wish wish = small_wish(arguments[0]);
        wish.fourcc = capture_fourcc(some[i]);
        wish.width = sizes[i][0];
        wish.height = sizes[i][1];
        wish.rate_num = wish.rate_den = 0;
        snprintf(what, sizeof what, "%s %ux%u", some[i], wish.width, wish.height);
        check_picture(&wish, "sizes", what);
    }
}

/* The driver's encodings and ranges, one after the other: the view has to say which it is. */
void group_ranges(int count, char **arguments)
{
    static const char *const ranges[] = {"Full Range", "Limited Range", "Default"};
    static const char *const encodings[] = {"Rec. 709", "ITU-R 601", "Default"};
    const char *device = arguments[0];
    const capture_wish wish = small_wish(device);
    (void)count;
    for (size_t i = 0; i < 9; i++) {
        const char *range = ranges[i % 3], *encoding = encodings[i / 3];
        struct v4l2_pix_format format;
        capture_settings set;
        char what[64];
        snprintf(what, sizeof what, "%s, %s", range, encoding);
        if (knob_choose(device, "Quantization", range) < 0 ||
            knob_choose(device, "Y'CbCr Encoding", encoding) < 0) {
            check_in(0, "ranges", what, "the driver does not do as it is told");
            continue;
        }
        capture *camera = open_only(&wish, "ranges", what);
        if (camera && knob_format(device, &format) == 0) {
            capture_get_settings(camera, &set);
            const pel_range expected = full_range(&format) ? PEL_RANGE_FULL : PEL_RANGE_LIMITED;
            check_in(set.range == expected && (i % 3 == 2 || (i % 3 == 0) == full_range(&format)),
                     "ranges", what, "%s", set.range == PEL_RANGE_FULL ? "full" : "limited");
            /* Not 100 %: what a wrong range makes of it is cut off at 0 and 255, and so right. */
            check_bars(camera, device, "ranges", what, 75);
        }
        capture_close(camera);
    }
}

static int rate_is(const char *device, const capture_settings *set)
{
    struct v4l2_fract interval;
    return knob_interval(device, &interval) == 0 && set->rate_den > 0 &&
           (uint64_t)set->rate_num * interval.numerator ==
               (uint64_t)set->rate_den * interval.denominator;
}

/* What the driver took instead of what it was asked is said. */
void group_changed(int count, char **arguments)
{
    capture_wish wish = small_wish(arguments[0]);
    struct v4l2_pix_format format;
    capture_settings set;
    capture *camera;
    (void)count;
    wish.rate_num = 30;
    capture_status status = capture_open(&wish, NULL, &camera);
    capture_get_settings(camera, &set);
    check(status == CAPTURE_OK && *capture_changes(camera) == '\0', "changed nothing", "%s, '%s'",
          told(status, camera), capture_changes(camera));
    check(set.rate_num == 30 * set.rate_den && rate_is(arguments[0], &set), "changed no rate",
          "%u/%u frames per second", set.rate_num, set.rate_den);
    capture_close(camera);
    wish.width = 333;
    wish.height = 200;
    wish.rate_num = 33;
    status = capture_open(&wish, NULL, &camera);
    capture_get_settings(camera, &set);
    check(status == CAPTURE_CHANGED && strstr(capture_changes(camera), "320x180") != NULL,
          "changed size", "%s, '%s'", told(status, camera), capture_changes(camera));
    check(rate_is(arguments[0], &set) && set.rate_num != 33 * set.rate_den, "changed rate",
          "%u/%u frames per second", set.rate_num, set.rate_den);
    if (knob_format(arguments[0], &format) == 0) {
        check_settings("changed", "settings", &set, &format);
    }
    capture_close(camera);
}
