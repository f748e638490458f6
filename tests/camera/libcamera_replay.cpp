/*
 * The libcamera backend against a libcamera of our own (fake_libcamera.hpp): each behaviour alone,
 * then random lives. Last line: N passed, N failed.
 */
#include "libcamera_replay.hpp"

#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace formats = libcamera::formats;
namespace ids = libcamera::controls;

static unsigned passed, failed;

bool check(bool good, const char *format, ...)
{
    if (!good) {
        va_list arguments;

        std::printf("FAIL ");
        va_start(arguments, format);
        std::vprintf(format, arguments);
        va_end(arguments);
        std::printf("\n");
    }
    passed += good;
    failed += !good;
    return good;
}

static libcamera::SizeRange fixed(unsigned width, unsigned height)
{
    return libcamera::SizeRange(libcamera::Size(width, height));
}

void reset()
{
    script = {};
    script.formats[formats::YUYV] = {fixed(320, 240), fixed(640, 480), fixed(1280, 720)};
    script.stride_step = 64;
}

capture_wish wish_of(unsigned width, unsigned height)
{
    capture_wish wish = {};

    wish.backend = CAPTURE_LIBCAMERA;
    wish.width = width;
    wish.height = height;
    return wish;
}

capture_counts counts_of(const capture *camera)
{
    capture_counts counts;

    capture_get_counts(camera, &counts);
    return counts;
}

static capture *opened(const capture_wish &wish, bool started)
{
    capture *camera = nullptr;
    capture_status status = capture_open(&wish, nullptr, &camera);

    if (status >= 0 && started) {
        status = capture_start(camera);
    }
    check(status >= 0, "opens: %s", capture_error(camera));
    return camera;
}

/* Nothing is left and nothing was done in a wrong order. */
static void closed(capture *camera, const char *what)
{
    capture_close(camera);
    check(account.managers == 0 && account.cameras == 0 && account.requests == 0 &&
              account.buffers == 0 && account.acquired == 0 && account.running == 0 &&
              account.faults == 0,
          "%s: left behind: %d managers, %d cameras, %d requests, %d buffers, %d faults", what,
          account.managers, account.cameras, account.requests, account.buffers, account.faults);
    account = {};
    fake_queue.clear();
}

/* ---- Opening ------------------------------------------------------------------------------- */

static void fails(const capture_wish &wish, capture_status expected, const char *what)
{
    capture *camera = nullptr;
    capture_status status = capture_open(&wish, nullptr, &camera);

    if (status >= 0) {
        status = capture_start(camera);
    }
    check(status == expected && capture_error(camera)[0] != '\0', "%s: %s (%s)", what,
          capture_status_name(status), capture_error(camera));
    closed(camera, what);
}

static void test_failures()
{
    const capture_wish wish = wish_of(640, 480);
    capture_wish other = wish;

    reset();
    script.manager_start = -EINVAL;
    fails(wish, CAPTURE_ERR_SYSTEM, "manager");
    reset();
    script.present = false;
    fails(wish, CAPTURE_ERR_NONE, "nobody");
    reset();
    other.device = "fake/camera.1";
    fails(other, CAPTURE_ERR_NONE, "another name");
    reset();
    script.acquire = -EBUSY;
    fails(wish, CAPTURE_ERR_BUSY, "busy");
    script.acquire = -EACCES;
    fails(wish, CAPTURE_ERR_ACCESS, "access");
    reset();
    script.configure = -EINVAL;
    fails(wish, CAPTURE_ERR_SYSTEM, "configure");
    reset();
    script.allocate = -ENOMEM;
    fails(wish, CAPTURE_ERR_SYSTEM, "allocate");
    reset();
    script.start = -EIO;
    fails(wish, CAPTURE_ERR_SYSTEM, "start");
    reset();
    script.queue = -EXDEV;
    fails(wish, CAPTURE_ERR_SYSTEM, "queue");
    reset();
    script.formats.clear();
    script.formats[formats::XRGB8888] = {fixed(640, 480)};
    fails(wish, CAPTURE_ERR_FORMAT, "unreadable");
}

static void test_negotiation()
{
    capture_settings settings;
    capture *camera;

    reset();
    script.formats[formats::NV12] = {fixed(1280, 720)};
    script.formats[formats::RGB565] = {fixed(640, 480)};
    camera = opened(wish_of(0, 0), false);
    capture_get_settings(camera, &settings);
    check(settings.fourcc == capture_fourcc("YUYV") && settings.width == 640 &&
              settings.height == 480 && settings.bytes_per_line == 1280 &&
              settings.range == PEL_RANGE_LIMITED && capture_changes(camera)[0] == '\0',
          "the best format, the size nearest to 640x480");
    closed(camera, "negotiation");

    capture_wish wish = wish_of(330, 250);
    wish.fourcc = capture_fourcc("RGBP");
    camera = opened(wish, false);
    capture_get_settings(camera, &settings);
    check(settings.format == PEL_RGB565_LE &&
              std::strcmp(capture_changes(camera), "size 330x250 became 640x480") == 0,
          "the wished format: %s", capture_changes(camera));
    closed(camera, "wished format");

    wish = wish_of(1280, 720);
    wish.fourcc = capture_fourcc("UYVY");
    camera = opened(wish, false);
    check(std::strcmp(capture_changes(camera), "format UYVY became YUYV") == 0,
          "another format: %s", capture_changes(camera));
    closed(camera, "another format");
}

/* Planes of one picture in one buffer, described as they are or as one. */
static void test_planes(const libcamera::PixelFormat &format, const char *fourcc, bool one_plane)
{
    capture_frame frame;

    reset();
    script.formats.clear();
    script.formats[format] = {fixed(318, 240)};
    script.one_plane = one_plane;
    capture_wish wish = wish_of(318, 240);
    wish.fourcc = capture_fourcc(fourcc);
    capture *const camera = opened(wish, true);
    const bool three = wish.fourcc == capture_fourcc("YU12");

    fake_deliver(0);
    if (check(capture_next(camera, 1000, &frame) == CAPTURE_OK, "%s", fourcc)) {
        const pel_cview &view = frame.view;
        const size_t luma = 320 * 240; /* 318 rounded up to 64 */

        check(view.stride_bytes[0] == 320 && view.plane[1] == view.plane[0] + luma &&
                  view.stride_bytes[1] == (three ? 160 : 320) &&
                  (!three ||
                   (view.plane[2] == view.plane[1] + luma / 4 && view.stride_bytes[2] == 160)) &&
                  frame.byte_count == luma * 3 / 2 && pel_cview_check(&view) == PEL_OK,
              "%s: planes and strides", fourcc);
        capture_give_back(camera, &frame);
    }
    closed(camera, fourcc);
}

/* ---- Frames -------------------------------------------------------------------------------- */

static void test_bad_frames()
{
    capture_frame frame;

    reset();
    capture *const camera = opened(wish_of(320, 240), true);
    fake_deliver(0, libcamera::FrameMetadata::FrameError);
    fake_deliver(1, libcamera::FrameMetadata::FrameSuccess, 1);
    fake_deliver(5);
    check(capture_next(camera, 1000, &frame) == CAPTURE_OK && frame.sequence == 5 &&
              frame.missed == 3 && frame.bytes[0] == 5,
          "damaged and short frames are dropped, gaps counted");
    const capture_counts counts = counts_of(camera);
    check(counts.damaged == 1 && counts.short_frames == 1 && counts.missed == 3 &&
              counts.frames == 1 && fake_queue.size() == 3,
          "and counted, and queued again: %zu", fake_queue.size());
    closed(camera, "bad frames");
}

static void test_wrap()
{
    capture_frame frame;

    reset();
    capture *const camera = opened(wish_of(320, 240), true);
    const uint32_t numbers[4] = {UINT32_MAX - 1, UINT32_MAX, 1, 2};
    const uint64_t expected[4] = {UINT64_C(0xFFFFFFFE), UINT64_C(0xFFFFFFFF), UINT64_C(0x100000001),
                                  UINT64_C(0x100000002)};
    for (int i = 0; i < 4; i++) {
        fake_deliver(numbers[i]);
        check(capture_next(camera, 1000, &frame) == CAPTURE_OK && frame.sequence == expected[i] &&
                  frame.missed == (i == 2),
              "sequence carried on past 2^32");
        capture_give_back(camera, &frame);
    }
    closed(camera, "wrap");
}

static void test_time_outs()
{
    capture_frame held;
    capture_frame frame;

    reset();
    capture *const camera = opened(wish_of(320, 240), true);
    fake_deliver(7);
    check(capture_next(camera, 1000, &held) == CAPTURE_OK, "a frame");
    for (int i = 0; i < 3; i++) {
        check(capture_next(camera, 1, &frame) == CAPTURE_TIMEOUT, "time-out");
    }
    check(counts_of(camera).timeouts == 3 && counts_of(camera).restarts == 1 &&
              account.starts == 2 && account.stops == 1 && fake_queue.size() == 3,
          "restarted after 3, with what is not held: %zu", fake_queue.size());
    check(held.bytes[0] == 7 && capture_give_back(camera, &held) == CAPTURE_OK &&
              fake_queue.size() == 4,
          "the held frame goes back");
    fake_deliver(0);
    check(capture_next(camera, 1, &frame) == CAPTURE_OK && frame.sequence == 8 && frame.missed == 0,
          "counted on");
    script.start = -EIO;
    capture_status status = CAPTURE_OK;
    for (int i = 0; i < 3; i++) {
        status = capture_next(camera, 1, &held);
    }
    check(status == CAPTURE_ERR_SYSTEM, "a restart that fails is said: %s", capture_error(camera));
    closed(camera, "time-outs");
}

static void test_unplugged(unsigned return_ms)
{
    capture_wish wish = wish_of(320, 240);
    capture_frame held;
    capture_frame frame;

    reset();
    wish.return_ms = return_ms;
    capture *const camera = opened(wish, true);
    fake_deliver(3);
    check(capture_next(camera, 1000, &held) == CAPTURE_OK, "a frame");
    fake_deliver(4); /* on its way when the camera goes */
    fake_unplug();
    capture_status status = capture_next(camera, return_ms ? 50 : 1000, &frame);
    check(status == (return_ms ? CAPTURE_TIMEOUT : CAPTURE_ERR_GONE), "unplugged: %s",
          capture_status_name(status));
    check(held.bytes[0] == 3, "the held frame stays readable");
    if (return_ms) {
        fake_return();
        check(capture_next(camera, 50, &frame) == CAPTURE_TIMEOUT, "back, no frame yet");
        fake_deliver(0);
        check(capture_next(camera, 1000, &frame) == CAPTURE_OK && frame.sequence == 4 &&
                  counts_of(camera).reopens == 1 && held.bytes[0] == 3,
              "frames go on: %lu", static_cast<unsigned long>(frame.sequence));
        capture_give_back(camera, &frame);
    } else {
        fake_return();
        check(capture_next(camera, 50, &frame) == CAPTURE_ERR_GONE, "gone for good");
    }
    check(capture_give_back(camera, &held) == CAPTURE_OK, "the held frame is taken");
    capture_stop(camera);
    closed(camera, "unplugged");
}

static void test_never_back()
{
    capture_wish wish = wish_of(320, 240);
    capture_frame frame;

    reset();
    wish.return_ms = 60;
    capture *const camera = opened(wish, true);
    fake_unplug();
    check(capture_next(camera, 20, &frame) == CAPTURE_TIMEOUT &&
              capture_next(camera, 1000, &frame) == CAPTURE_ERR_GONE,
          "patience ends");
    closed(camera, "never back");
}

/* ---- Controls ------------------------------------------------------------------------------ */

static libcamera::ControlInfo range(const libcamera::ControlValue &min,
                                    const libcamera::ControlValue &max,
                                    const libcamera::ControlValue &initial)
{
    return libcamera::ControlInfo(min, max, initial);
}

static void add_controls()
{
    script.controls[&ids::ExposureTime] = range(120, 66666, 20000);
    script.controls[&ids::AeEnable] = range(false, true, true);
    script.controls[&ids::AnalogueGain] = range(1.0f, 16.0f, 1.0f);
    script.controls[&ids::AwbEnable] = range(false, true, true);
    script.controls[&ids::Brightness] = range(-1.0f, 1.0f, 0.0f);
    script.controls[&ids::FrameDurationLimits] =
        range(INT64_C(16666), INT64_C(200000), INT64_C(33333));
}

static void test_controls()
{
    int32_t value = 0;
    capture_control list[8];
    char text[32];
    capture_frame frame;

    reset();
    add_controls();
    capture_wish wish = wish_of(320, 240);
    wish.rate_num = 100;
    wish.rate_den = 1;
    capture *const camera = opened(wish, false);
    const uint32_t exposure = capture_control_id(camera, CAPTURE_EXPOSURE);
    const uint32_t automatic = capture_control_id(camera, CAPTURE_AUTO_EXPOSURE);
    const uint32_t gain = capture_control_id(camera, CAPTURE_GAIN);
    const int count = capture_controls(camera, list, 8);

    check(std::strstr(capture_changes(camera), "rate 100/1 became 1000000/16666") != nullptr,
          "rate: %s", capture_changes(camera));
    check(count == 6 && exposure && automatic && gain &&
              capture_control_id(camera, CAPTURE_WHITE_BALANCE) == 0 &&
              capture_control_id(camera, CAPTURE_POWER_LINE) == 0,
          "what there is: %d", count);
    for (int i = 0; i < count && i < 8; i++) {
        if (list[i].id == exposure) {
            check(list[i].min == 1 && list[i].max == 667 && list[i].initial == 200 &&
                      list[i].known == CAPTURE_EXPOSURE && list[i].inactive,
                  "exposure in 100 us, without effect while automatic");
        }
    }
    check(capture_menu_item(camera, automatic, 0, text) == CAPTURE_OK &&
              !std::strcmp(text, "auto") &&
              capture_menu_item(camera, automatic, 1, text) == CAPTURE_OK &&
              !std::strcmp(text, "manual") &&
              capture_menu_item(camera, automatic, 2, text) == CAPTURE_ERR_ARG,
          "the menu of auto exposure");
    check(capture_set(camera, automatic, 1, &value) == CAPTURE_OK && value == 1 &&
              capture_set(camera, exposure, 50, &value) == CAPTURE_OK && value == 50 &&
              capture_set(camera, gain, 250, nullptr) == CAPTURE_OK,
          "set");
    check(capture_start(camera) == CAPTURE_OK &&
              fake_start_controls.at(ids::ExposureTime.id()).get<int32_t>() == 5000 &&
              !fake_start_controls.at(ids::AeEnable.id()).get<bool>() &&
              fake_start_controls.at(ids::AnalogueGain.id()).get<float>() == 2.5f &&
              fake_start_controls.count(ids::FrameDurationLimits.id()) == 1,
          "told at the start");
    libcamera::ControlList said(ids::controls);

    said.set(ids::ExposureTime, 4900); /* the sensor's lines are not as fine */
    for (uint32_t i = 0; i < 20; i++) {
        fake_deliver(i, libcamera::FrameMetadata::FrameSuccess, 0, &said);
        if (capture_next(camera, 1000, &frame) == CAPTURE_OK) {
            capture_give_back(camera, &frame);
        }
        capture_get(camera, exposure, &value);
        check(value == (i < 8 ? 50 : 49), "after %u frames: %d", i + 1, value);
    }
    check(capture_set(camera, exposure, 80, nullptr) == CAPTURE_OK, "set while it runs");
    fake_deliver(20);
    capture_next(camera, 1000, &frame);
    capture_give_back(camera, &frame);
    check(fake_request_controls.size() == 1 &&
              fake_request_controls.at(ids::ExposureTime.id()).get<int32_t>() == 8000,
          "told with the next request, once");
    closed(camera, "controls");
}

int main(int argc, char **argv)
{
    test_failures();
    test_negotiation();
    test_planes(formats::NV12, "NV12", false);
    test_planes(formats::NV12, "NV12", true);
    test_planes(formats::YUV420, "YU12", false);
    test_planes(formats::YUV420, "YU12", true);
    test_bad_frames();
    test_wrap();
    test_time_outs();
    test_unplugged(0);
    test_unplugged(10000);
    test_never_back();
    test_controls();
    test_random(argc > 1 ? static_cast<uint32_t>(std::atoi(argv[1])) : 1000);
    std::printf("%u passed, %u failed\n", passed, failed);
    return failed > 0 || passed == 0;
}
