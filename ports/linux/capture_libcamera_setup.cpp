/* Cameras through libcamera: formats, sizes and rates, offered and agreed on. */
#include "capture_libcamera.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <linux/videodev2.h>

namespace capture_libcamera
{

enum { WIDTH_DEFAULT = 640, HEIGHT_DEFAULT = 480 };

/* ---- Codes --------------------------------------------------------------------------------- */

struct code_pair {
    uint32_t drm;
    uint32_t v4l2;
};

static constexpr uint32_t code(char a, char b, char c, char d)
{
    return static_cast<uint32_t>(a) | static_cast<uint32_t>(b) << 8 |
           static_cast<uint32_t>(c) << 16 | static_cast<uint32_t>(d) << 24;
}

/*
 * Where the two differ. DRM names a pixel as a little-endian number, highest bits first, so that
 * its BGR888 ("BG24") has the bytes R, G, B in memory: V4L2's RGB24 ("RGB3"). The highest bit of a
 * DRM code stands for a big-endian number.
 */
static const code_pair code_pairs[] = {
    {code('R', '8', ' ', ' '), V4L2_PIX_FMT_GREY},
    {code('B', 'G', '2', '4'), V4L2_PIX_FMT_RGB24},
    {code('R', 'G', '2', '4'), V4L2_PIX_FMT_BGR24},
    {code('R', 'G', '1', '6'), V4L2_PIX_FMT_RGB565},
    {code('R', 'G', '1', '6') | UINT32_C(0x80000000), V4L2_PIX_FMT_RGB565X},
    {code('Y', 'U', '1', '6'), V4L2_PIX_FMT_YUV422P},
};

uint32_t v4l2_code(const libcamera::PixelFormat &format)
{
    for (const code_pair &pair : code_pairs) {
        if (pair.drm == format.fourcc() && format.modifier() == 0) {
            return pair.v4l2;
        }
    }
    return format.fourcc();
}

/* A modifier stands for another packing under the same code: pel reads none of those. */
static int rank_of(const libcamera::PixelFormat &format)
{
    return format.modifier() == 0 ? capture_format_rank(v4l2_code(format)) : -1;
}

/* ---- What is offered ----------------------------------------------------------------------- */

struct offer {
    libcamera::StreamRole role;
    libcamera::PixelFormat format;
    int rank;
};

static const libcamera::StreamRole all_roles[] = {
    libcamera::StreamRole::Viewfinder, libcamera::StreamRole::VideoRecording,
    libcamera::StreamRole::StillCapture, libcamera::StreamRole::Raw};

static std::unique_ptr<libcamera::CameraConfiguration> configuration_for(const state *s,
                                                                         libcamera::StreamRole role)
{
    auto config = s->camera->generateConfiguration({role});

    if (config && config->empty()) {
        config.reset();
    }
    return config;
}

/* Every format once, with the first role that has it. */
static std::vector<offer> offers_of(const state *s)
{
    std::vector<offer> offers;

    for (const libcamera::StreamRole role : all_roles) {
        const auto config = configuration_for(s, role);

        if (!config) {
            continue;
        }
        std::vector<libcamera::PixelFormat> formats = config->at(0).formats().pixelformats();

        if (formats.empty()) { /* a camera that lists nothing has its default at least */
            formats.push_back(config->at(0).pixelFormat);
        }
        for (const libcamera::PixelFormat &format : formats) {
            const auto same = [&](const offer &o) { return o.format == format; };

            if (std::none_of(offers.begin(), offers.end(), same)) {
                offers.push_back({role, format, rank_of(format)});
            }
        }
    }
    return offers;
}

/* The wished format first, then the readable ones from the best on. */
static void sort_offers(std::vector<offer> *offers, uint32_t wanted)
{
    const auto unreadable = [](const offer &o) {
        return o.rank < 0 ||
               (capture_format_of(v4l2_code(o.format), nullptr) == 2 && !capture_can_decode());
    };
    const auto better = [wanted](const offer &a, const offer &b) {
        const bool a_wanted = v4l2_code(a.format) == wanted;
        const bool b_wanted = v4l2_code(b.format) == wanted;

        return a_wanted != b_wanted ? a_wanted : a.rank < b.rank;
    };

    offers->erase(std::remove_if(offers->begin(), offers->end(), unreadable), offers->end());
    std::stable_sort(offers->begin(), offers->end(), better);
}

/* ---- Agreeing ------------------------------------------------------------------------------ */

static libcamera::Size wanted_size(const capture_wish &wish)
{
    if (wish.width == 0 && wish.height == 0) {
        return {WIDTH_DEFAULT, HEIGHT_DEFAULT};
    }
    if (wish.height == 0) {
        return {wish.width, std::max(wish.width * HEIGHT_DEFAULT / WIDTH_DEFAULT, 1U)};
    }
    if (wish.width == 0) {
        return {std::max(wish.height * WIDTH_DEFAULT / HEIGHT_DEFAULT, 1U), wish.height};
    }
    return {wish.width, wish.height};
}

static unsigned distance(const libcamera::Size &a, const libcamera::Size &b)
{
    const auto apart = [](unsigned x, unsigned y) { return x > y ? x - y : y - x; };

    return apart(a.width, b.width) + apart(a.height, b.height);
}

/* Of a list of sizes the nearest; of a range the wished one, which validate() puts right. */
static libcamera::Size nearest_size(const libcamera::StreamConfiguration &stream,
                                    const libcamera::PixelFormat &format,
                                    const libcamera::Size &wanted)
{
    const libcamera::SizeRange range = stream.formats().range(format);
    libcamera::Size best = wanted;
    unsigned best_distance = UINT32_MAX;

    if (range.hStep != 0 && range.min != range.max) {
        return wanted;
    }
    for (const libcamera::Size &size : stream.formats().sizes(format)) {
        if (distance(size, wanted) < best_distance) {
            best_distance = distance(size, wanted);
            best = size;
        }
    }
    return best;
}

static bool usable(const libcamera::StreamConfiguration &stream)
{
    pel_format format;
    const int kind = capture_format_of(v4l2_code(stream.pixelFormat), &format);

    if (stream.pixelFormat.modifier() != 0 || kind == 0 || stream.size.width > PEL_SIDE_MAX ||
        stream.size.height > PEL_SIDE_MAX || stream.size.isNull()) {
        return false;
    }
    const auto width = static_cast<uint16_t>(stream.size.width);
    const auto height = static_cast<uint16_t>(stream.size.height);

    return kind == 2 ||
           (pel_frame_bytes(format, width, height) > 0 &&
            stream.stride >= pel_row_bytes(format, width) && stream.stride <= INT32_MAX / 2);
}

/* Asks the camera for one offer; what it makes of it is in s->config. */
static bool try_offer(state *s, const offer &tried, const libcamera::Size &wanted, unsigned buffers)
{
    auto config = configuration_for(s, tried.role);

    if (!config) {
        return false;
    }
    libcamera::StreamConfiguration &stream = config->at(0);

    stream.pixelFormat = tried.format;
    stream.size = nearest_size(stream, tried.format, wanted);
    stream.bufferCount = buffers;
    if (config->validate() == libcamera::CameraConfiguration::Invalid || !usable(config->at(0))) {
        return false;
    }
    s->config = std::move(config);
    s->role = tried.role;
    return true;
}

/* Notes the frame duration to ask for at start, within what the camera can do. */
static void choose_rate(capture *camera)
{
    state *const s = state_of(camera);
    const capture_wish &wish = camera->wish;
    const libcamera::ControlId *const id = find_control(s, "FrameDurationLimits");

    if (wish.rate_num == 0) {
        return;
    }
    if (!id || id->type() != libcamera::ControlTypeInteger64) {
        capture_note_change(camera, "rate %u/%u: this camera's rate cannot be chosen",
                            wish.rate_num, wish.rate_den);
        return;
    }
    const libcamera::ControlInfo &info = s->camera->controls().at(id->id());
    const int64_t wanted = (INT64_C(1000000) * wish.rate_den + wish.rate_num / 2) / wish.rate_num;
    int64_t duration = std::max<int64_t>(wanted, 1);

    if (info.min().type() == libcamera::ControlTypeInteger64 && !info.min().isArray() &&
        info.max().type() == libcamera::ControlTypeInteger64 && !info.max().isArray() &&
        info.max().get<int64_t>() > 0) {
        duration =
            std::min(std::max(duration, info.min().get<int64_t>()), info.max().get<int64_t>());
    }
    s->frame_duration_us = duration;
    camera->settings.rate_num = wish.rate_num;
    camera->settings.rate_den = wish.rate_den;
    if (duration != wanted) {
        camera->settings.rate_num = 1000000;
        camera->settings.rate_den = static_cast<unsigned>(std::min<int64_t>(duration, UINT32_MAX));
        capture_note_change(camera, "rate %u/%u became %u/%u", wish.rate_num, wish.rate_den,
                            camera->settings.rate_num, camera->settings.rate_den);
    }
}

static void note_settings(capture *camera)
{
    const state *const s = state_of(camera);
    const libcamera::StreamConfiguration &stream = s->config->at(0);
    capture_settings *const settings = &camera->settings;

    settings->fourcc = v4l2_code(stream.pixelFormat);
    settings->compressed = capture_format_of(settings->fourcc, &settings->format) == 2;
    settings->range = PEL_RANGE_FULL;
    if (capture_format_has_range(settings->fourcc) &&
        !(stream.colorSpace && stream.colorSpace->range == libcamera::ColorSpace::Range::Full)) {
        settings->range = PEL_RANGE_LIMITED;
    }
    settings->width = stream.size.width;
    settings->height = stream.size.height;
    settings->bytes_per_line = stream.stride;
    settings->frame_bytes = stream.frameSize;
    settings->buffers = stream.bufferCount;
}

static void note_changes(capture *camera)
{
    const capture_wish &wish = camera->wish;
    const capture_settings &settings = camera->settings;
    char from[16];
    char to[16];

    if (wish.fourcc != 0 && wish.fourcc != settings.fourcc) {
        capture_fourcc_text(wish.fourcc, from);
        capture_fourcc_text(settings.fourcc, to);
        capture_note_change(camera, "format %s became %s", from, to);
    }
    if ((wish.width != 0 && wish.width != settings.width) ||
        (wish.height != 0 && wish.height != settings.height)) {
        capture_note_change(camera, "size %ux%u became %ux%u", wish.width, wish.height,
                            settings.width, settings.height);
    }
}

/* Where the planes of the picture will lie in a buffer that has a plane for each of them. */
static void lay_out(state *s, const capture_settings &settings)
{
    const auto width = static_cast<uint16_t>(settings.width);
    const auto stride = static_cast<int32_t>(settings.bytes_per_line);
    const size_t rows = settings.height;
    const auto plane = [&](unsigned index, int32_t step, size_t row_bytes, size_t height) {
        s->planes.plane[index] = {index, 0, static_cast<size_t>(step) * (height - 1) + row_bytes,
                                  step};
    };

    s->planes = {};
    s->planes.planes = 1;
    if (settings.compressed) {
        s->planes.plane[0].needed_bytes = 1;
        return;
    }
    plane(0, stride, pel_row_bytes(settings.format, width), rows);
    if (settings.format == PEL_NV12) {
        s->planes.planes = 2;
        plane(1, stride, width, rows / 2);
    } else if (settings.format == PEL_I420) {
        s->planes.planes = 3;
        plane(1, stride / 2, width / 2U, rows / 2);
        plane(2, stride / 2, width / 2U, rows / 2);
    }
}

static capture_status configure(capture *camera)
{
    state *const s = state_of(camera);
    const int result = s->camera->configure(s->config.get());

    if (result < 0) {
        return fail_with(camera, "configure", result);
    }
    return CAPTURE_OK;
}

capture_status negotiate(capture *camera)
{
    state *const s = state_of(camera);
    const capture_wish &wish = camera->wish;

    if (wish.fourcc != 0 && !capture_format_of(wish.fourcc, nullptr)) {
        char text[16];

        capture_fourcc_text(wish.fourcc, text);
        return capture_fail(camera, CAPTURE_ERR_FORMAT, "format %s cannot be read here", text);
    }
    std::vector<offer> offers = offers_of(s);
    sort_offers(&offers, wish.fourcc);
    const auto taken = std::find_if(offers.begin(), offers.end(), [&](const offer &o) {
        return try_offer(s, o, wanted_size(wish), wish.buffers);
    });
    if (taken == offers.end()) {
        return capture_fail(camera, CAPTURE_ERR_FORMAT, "%s: no format that can be read here",
                            s->id.c_str());
    }
    const capture_status status = configure(camera);
    if (status != CAPTURE_OK) {
        return status;
    }
    note_settings(camera);
    lay_out(s, camera->settings);
    note_changes(camera);
    choose_rate(camera);
    return camera->changes[0] != '\0' ? CAPTURE_CHANGED : CAPTURE_OK;
}

capture_status configure_again(capture *camera)
{
    state *const s = state_of(camera);
    const capture_settings &settings = camera->settings;
    std::vector<offer> offers = offers_of(s);

    sort_offers(&offers, settings.fourcc);
    if (offers.empty() ||
        !try_offer(s, offers.front(), {settings.width, settings.height}, settings.buffers)) {
        return capture_fail(camera, CAPTURE_ERR_FORMAT, "%s: came back without its format",
                            s->id.c_str());
    }
    const libcamera::StreamConfiguration &stream = s->config->at(0);
    if (v4l2_code(stream.pixelFormat) != settings.fourcc || stream.size.width != settings.width ||
        stream.size.height != settings.height || stream.stride != settings.bytes_per_line) {
        return capture_fail(camera, CAPTURE_ERR_FORMAT, "%s: came back with other settings",
                            s->id.c_str());
    }
    return configure(camera);
}

/* ---- Listing ------------------------------------------------------------------------------- */

static void add_mode(std::vector<capture_mode> *list, const offer &o, const libcamera::Size &min,
                     const libcamera::Size &max)
{
    capture_mode mode = {};
    const std::string name = o.format.toString();

    mode.fourcc = v4l2_code(o.format);
    capture_copy_text(mode.description, sizeof mode.description, name.c_str(), name.size());
    mode.readable =
        o.rank >= 0 && (capture_format_of(mode.fourcc, nullptr) == 1 || capture_can_decode());
    mode.width_min = min.width;
    mode.width_max = max.width;
    mode.height_min = min.height;
    mode.height_max = max.height;
    list->push_back(mode);
}

int modes(capture *camera, capture_mode *modes, size_t max)
{
    const state *const s = state_of(camera);
    std::vector<capture_mode> list;

    for (const offer &o : offers_of(s)) {
        const auto config = configuration_for(s, o.role);

        if (!config) {
            continue;
        }
        const libcamera::StreamFormats &formats = config->at(0).formats();
        const libcamera::SizeRange range = formats.range(o.format);

        if (formats.pixelformats().empty()) {
            add_mode(&list, o, config->at(0).size, config->at(0).size);
        } else if (range.hStep != 0 || range.min == range.max) {
            add_mode(&list, o, range.min, range.max);
        } else {
            for (const libcamera::Size &size : formats.sizes(o.format)) {
                add_mode(&list, o, size, size);
            }
        }
    }
    std::copy_n(list.begin(), std::min(max, list.size()), modes);
    return static_cast<int>(list.size());
}

} // namespace capture_libcamera
