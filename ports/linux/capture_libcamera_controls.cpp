/*
 * Cameras through libcamera: controls.
 *
 * libcamera takes controls with a request and tells with the frames what it did. So a value that
 * was set counts as the camera's until frames that can know better have arrived: from then on what
 * they report is the value, be it the one asked for or not. Not every camera reports every control.
 *
 * They are found by their names, which stayed the same while numbers and symbols came and went from
 * release to release. All values are 32-bit integers here: fractions are given in hundredths.
 */
#include "capture_libcamera.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <optional>

namespace capture_libcamera
{

/* A sensor applies a value some frames after the request that carried it; none takes this many. */
static constexpr uint64_t frames_to_settle = 8;

enum class meaning {
    plain,
    exposure, /* microseconds <-> 100 us */
    inverted, /* 1 or true <-> 0 */
    flicker   /* off, manual with a period, auto <-> off, 50 Hz, 60 Hz, auto */
};

struct known_row {
    char name[20];
    capture_known known;
    meaning how;
    capture_control_kind kind;
    int32_t max; /* of switches and menus */
};

/* The first that a camera has is the one: newer releases split AeEnable into two modes. */
static const known_row known_rows[] = {
    {"ExposureTime", CAPTURE_EXPOSURE, meaning::exposure, CAPTURE_INTEGER, 0},
    {"ExposureTimeMode", CAPTURE_AUTO_EXPOSURE, meaning::plain, CAPTURE_MENU, 1},
    {"AeEnable", CAPTURE_AUTO_EXPOSURE, meaning::inverted, CAPTURE_MENU, 1},
    {"AnalogueGain", CAPTURE_GAIN, meaning::plain, CAPTURE_INTEGER, 0},
    {"AnalogueGainMode", CAPTURE_AUTO_GAIN, meaning::inverted, CAPTURE_SWITCH, 1},
    {"ColourTemperature", CAPTURE_WHITE_BALANCE, meaning::plain, CAPTURE_INTEGER, 0},
    {"AwbEnable", CAPTURE_AUTO_WHITE_BALANCE, meaning::plain, CAPTURE_SWITCH, 1},
    {"AeFlickerMode", CAPTURE_POWER_LINE, meaning::flicker, CAPTURE_MENU, 3},
};

/* AeFlickerMode as libcamera counts; the menu of CAPTURE_POWER_LINE; half periods of the lamps. */
static constexpr double flicker_off = 0;
static constexpr double flicker_manual = 1;
static constexpr double flicker_auto = 2;
enum { LINE_OFF = 0, LINE_50_HZ = 1, LINE_60_HZ = 2, LINE_AUTO = 3 };
static constexpr double period_50_hz_us = 10000;
static constexpr double period_60_hz_us = 8333;
static constexpr double period_between_us = 9167;

const libcamera::ControlId *find_control(const state *s, const char *name)
{
    for (const auto &each : s->camera->controls()) {
        if (each.first->name() == name) {
            return each.first;
        }
    }
    return nullptr;
}

static const known_row *row_of(const libcamera::ControlId &id)
{
    for (const known_row &row : known_rows) {
        if (id.name() == row.name) {
            return &row;
        }
    }
    return nullptr;
}

/* ---- Values -------------------------------------------------------------------------------- */

static std::optional<double> number_of(const libcamera::ControlValue &value)
{
    if (value.isArray()) {
        return std::nullopt;
    }
    switch (value.type()) {
    case libcamera::ControlTypeBool:
        return value.get<bool>() ? 1.0 : 0.0;
    case libcamera::ControlTypeByte:
        return value.get<uint8_t>();
    case libcamera::ControlTypeInteger32:
        return value.get<int32_t>();
    case libcamera::ControlTypeInteger64:
        return static_cast<double>(value.get<int64_t>());
    case libcamera::ControlTypeFloat:
        return static_cast<double>(value.get<float>());
    default:
        return std::nullopt;
    }
}

static libcamera::ControlValue value_of(libcamera::ControlType type, double number)
{
    switch (type) {
    case libcamera::ControlTypeBool:
        return libcamera::ControlValue(number != 0.0);
    case libcamera::ControlTypeByte:
        return libcamera::ControlValue(static_cast<uint8_t>(number));
    case libcamera::ControlTypeInteger64:
        return libcamera::ControlValue(static_cast<int64_t>(number));
    case libcamera::ControlTypeFloat:
        return libcamera::ControlValue(static_cast<float>(number));
    default:
        return libcamera::ControlValue(static_cast<int32_t>(number));
    }
}

static double scale_of(const libcamera::ControlId &id)
{
    const known_row *const row = row_of(id);

    if (row && row->how == meaning::exposure) {
        return 0.01;
    }
    return id.type() == libcamera::ControlTypeFloat ? 100.0 : 1.0;
}

static int32_t to_int32(double number)
{
    if (!(number > INT32_MIN)) { /* also what is not a number */
        return INT32_MIN;
    }
    return number >= INT32_MAX ? INT32_MAX : static_cast<int32_t>(std::lround(number));
}

static int32_t line_of(double mode, std::optional<double> period_us)
{
    if (mode == flicker_manual) {
        return period_us.value_or(period_50_hz_us) < period_between_us ? LINE_60_HZ : LINE_50_HZ;
    }
    return mode == flicker_auto ? LINE_AUTO : LINE_OFF;
}

static std::optional<double> reported_number(const state *s, const char *name)
{
    const libcamera::ControlId *const id = find_control(s, name);
    const auto report = id ? s->reported.find(id->id()) : s->reported.end();

    return report == s->reported.end() ? std::nullopt : number_of(report->second.value);
}

/* What a value of libcamera is called here. */
static std::optional<int32_t> from_camera(const state *s, const libcamera::ControlId &id,
                                          const libcamera::ControlValue &value)
{
    const known_row *const row = row_of(id);
    const std::optional<double> number = number_of(value);

    if (!number) {
        return std::nullopt;
    }
    if (row && row->how == meaning::inverted) {
        return *number == 0.0 ? 1 : 0;
    }
    if (row && row->how == meaning::flicker) {
        return line_of(*number, reported_number(s, "AeFlickerPeriod"));
    }
    return to_int32(*number * scale_of(id));
}

static void put(const state *s, libcamera::ControlList *list, const libcamera::ControlId &id,
                int32_t value)
{
    const known_row *const row = row_of(id);
    double number = value / scale_of(id);

    if (row && row->how == meaning::inverted) {
        number = value == 0 ? 1 : 0;
    } else if (row && row->how == meaning::flicker) {
        const libcamera::ControlId *const period = find_control(s, "AeFlickerPeriod");

        number = value == LINE_OFF ? flicker_off : flicker_manual;
        if (value == LINE_AUTO) {
            number = flicker_auto;
        } else if (value != LINE_OFF && period) {
            list->set(
                period->id(),
                value_of(period->type(), value == LINE_50_HZ ? period_50_hz_us : period_60_hz_us));
        }
    }
    list->set(id.id(), value_of(id.type(), number));
}

/* ---- Requests ------------------------------------------------------------------------------ */

void carry_controls(state *s, libcamera::ControlList *list, uint64_t number, bool all)
{
    const auto &infos = s->camera->controls();

    for (auto &asked : s->asked) {
        const auto info = infos.find(asked.first);

        if (info != infos.end() && (all || asked.second.carried_by == 0)) {
            put(s, list, *info->first, asked.second.value);
            asked.second.carried_by = all ? 0 : number;
        }
    }
    if (all && s->frame_duration_us > 0) {
        const libcamera::ControlId *const id = find_control(s, "FrameDurationLimits");

        if (id) {
            const int64_t both[2] = {s->frame_duration_us, s->frame_duration_us};

            list->set(id->id(), libcamera::ControlValue(libcamera::Span<const int64_t, 2>(both)));
        }
    }
}

void note_metadata(state *s, const libcamera::ControlList &metadata, uint64_t number)
{
    const auto &infos = s->camera->controls();

    for (const auto &each : metadata) {
        if (infos.count(each.first) > 0) {
            s->reported[each.first] = {each.second, number};
        }
    }
}

/* ---- Questions ----------------------------------------------------------------------------- */

static int32_t initial_of(const state *s, const libcamera::ControlId &id,
                          const libcamera::ControlInfo &info)
{
    const std::optional<int32_t> initial = from_camera(s, id, info.def());

    /* Where a camera does not say: automatic, or the lowest value. */
    return initial ? *initial : (row_of(id) && row_of(id)->kind == CAPTURE_MENU ? 0 : INT32_MIN);
}

static int32_t current(const state *s, const libcamera::ControlId &id, int32_t initial)
{
    const auto asked = s->asked.find(id.id());
    const auto report = s->reported.find(id.id());
    std::optional<int32_t> value;

    if (asked != s->asked.end()) {
        const uint64_t carried_by = asked->second.carried_by;

        if (carried_by == 0 || report == s->reported.end() ||
            report->second.number < carried_by + frames_to_settle) {
            return asked->second.value;
        }
    }
    if (report != s->reported.end()) {
        value = from_camera(s, id, report->second.value);
    }
    return value.value_or(initial);
}

static bool is_automatic(const state *s, capture_known which)
{
    for (const known_row &row : known_rows) {
        const libcamera::ControlId *const id =
            row.known == which ? find_control(s, row.name) : nullptr;

        if (id) {
            const int32_t value =
                current(s, *id, initial_of(s, *id, s->camera->controls().at(id->id())));

            return which == CAPTURE_AUTO_EXPOSURE ? value == 0 : value == 1;
        }
    }
    return false;
}

static bool has(const state *s, capture_known which)
{
    for (const known_row &row : known_rows) {
        if (row.known == which && find_control(s, row.name)) {
            return true;
        }
    }
    return false;
}

static bool is_inactive(const state *s, capture_known which)
{
    switch (which) {
    case CAPTURE_EXPOSURE:
        return is_automatic(s, CAPTURE_AUTO_EXPOSURE);
    case CAPTURE_GAIN:
        return is_automatic(s,
                            has(s, CAPTURE_AUTO_GAIN) ? CAPTURE_AUTO_GAIN : CAPTURE_AUTO_EXPOSURE);
    case CAPTURE_WHITE_BALANCE:
        return is_automatic(s, CAPTURE_AUTO_WHITE_BALANCE);
    default:
        return false;
    }
}

static bool is_the_known(const state *s, const libcamera::ControlId &id, const known_row &row)
{
    for (const known_row &other : known_rows) {
        if (other.known == row.known) {
            const libcamera::ControlId *const first = find_control(s, other.name);

            if (first) {
                return first->id() == id.id();
            }
        }
    }
    return false;
}

static void set_limits(const state *s, const libcamera::ControlId &id,
                       const libcamera::ControlInfo &info, capture_control *control)
{
    const known_row *const row = row_of(id);
    const std::optional<int32_t> min = from_camera(s, id, info.min());
    const std::optional<int32_t> max = from_camera(s, id, info.max());

    control->kind = CAPTURE_INTEGER;
    control->min = min.value_or(INT32_MIN);
    control->max = max.value_or(INT32_MAX);
    if (row && row->kind != CAPTURE_INTEGER) {
        control->kind = row->kind;
        control->min = 0;
        control->max = row->max;
    } else if (id.type() == libcamera::ControlTypeBool) {
        control->kind = CAPTURE_SWITCH;
        control->min = 0;
        control->max = 1;
    } else if (id.type() == libcamera::ControlTypeInteger32 && !info.values().empty()) {
        control->kind = CAPTURE_MENU;
    }
}

/* False for what has no number, such as rectangles and lists. */
static bool describe(const state *s, const libcamera::ControlId &id,
                     const libcamera::ControlInfo &info, capture_control *control)
{
    const known_row *const row = row_of(id);

    if (!number_of(info.min())) {
        return false;
    }
    std::memset(control, 0, sizeof *control);
    control->id = id.id();
    if (row && is_the_known(s, id, *row)) {
        control->known = row->known;
    }
    capture_copy_text(control->name, sizeof control->name, id.name().c_str(), id.name().size());
    set_limits(s, id, info, control);
    control->step = 1;
    control->initial = std::min(std::max(initial_of(s, id, info), control->min), control->max);
    control->value = current(s, id, control->initial);
    control->inactive = is_inactive(s, control->known);
    return true;
}

int controls(capture *camera, capture_control *controls, size_t max)
{
    const state *const s = state_of(camera);
    std::map<unsigned, capture_control> sorted;
    size_t count = 0;

    if (!s->camera) {
        return CAPTURE_ERR_GONE;
    }
    for (const auto &each : s->camera->controls()) {
        capture_control control;

        if (describe(s, *each.first, each.second, &control)) {
            sorted.emplace(control.id, control);
        }
    }
    for (const auto &each : sorted) {
        if (count < max) {
            controls[count] = each.second;
        }
        count++;
    }
    return static_cast<int>(count);
}

capture_status query(capture *camera, uint32_t id, capture_control *control)
{
    const state *const s = state_of(camera);

    if (!s->camera) {
        return CAPTURE_ERR_GONE;
    }
    const auto &infos = s->camera->controls();
    const auto info = infos.find(static_cast<unsigned>(id));

    if (info == infos.end() || !describe(s, *info->first, info->second, control)) {
        return capture_fail(camera, CAPTURE_ERR_NONE, "%s: no control %lu", s->id.c_str(),
                            static_cast<unsigned long>(id));
    }
    return CAPTURE_OK;
}

capture_status get(capture *camera, uint32_t id, int32_t *value)
{
    capture_control control;
    const capture_status status = query(camera, id, &control);

    if (status == CAPTURE_OK) {
        *value = control.value;
    }
    return status;
}

capture_status set(capture *camera, uint32_t id, int32_t value)
{
    state *const s = state_of(camera);
    char text[32];

    if (!s->acquired) {
        return capture_fail(camera, CAPTURE_ERR_BUSY, "%s: not ours to set", s->id.c_str());
    }
    capture_control control;
    const capture_status status = query(camera, id, &control);
    if (status != CAPTURE_OK) {
        return status;
    }
    if (control.kind == CAPTURE_MENU && menu_item(camera, id, value, text) != CAPTURE_OK) {
        return capture_fail(camera, CAPTURE_ERR_ARG, "%s has no item %ld", control.name,
                            static_cast<long>(value));
    }
    s->asked[id] = {value, 0};
    return CAPTURE_OK;
}

uint32_t known(capture *camera, capture_known known)
{
    const state *const s = state_of(camera);

    for (const known_row &row : known_rows) {
        const libcamera::ControlId *const id =
            s->camera && row.known == known ? find_control(s, row.name) : nullptr;

        if (id) {
            return id->id();
        }
    }
    return 0;
}

/* ---- Menus --------------------------------------------------------------------------------- */

/* Newer releases know the names of a menu's values. */
template <typename Id>
static auto name_of(const Id &id, int32_t value, int) -> decltype(id.enumerators(), std::string())
{
    const auto name = id.enumerators().find(value);

    return name == id.enumerators().end() ? std::to_string(value) : name->second;
}

template <typename Id> static std::string name_of(const Id &, int32_t value, long)
{
    return std::to_string(value);
}

static bool offers_value(const libcamera::ControlInfo &info, double number)
{
    const auto same = [&](const libcamera::ControlValue &value) {
        return number_of(value) == number;
    };

    return info.values().empty() || std::any_of(info.values().begin(), info.values().end(), same);
}

/* What libcamera's value of a known menu's item is, so that it can be looked up in its list. */
static double menu_number(const known_row &row, int32_t index)
{
    if (row.how == meaning::inverted) {
        return index == 0 ? 1 : 0;
    }
    if (row.how == meaning::flicker && index != LINE_OFF) {
        return index == LINE_AUTO ? flicker_auto : flicker_manual;
    }
    return index;
}

capture_status menu_item(capture *camera, uint32_t id, int32_t index, char text[32])
{
    static const char exposure_items[2][8] = {"auto", "manual"};
    static const char line_items[4][8] = {"off", "50 Hz", "60 Hz", "auto"};
    const state *const s = state_of(camera);
    capture_control control;
    const capture_status status = query(camera, id, &control);

    if (status != CAPTURE_OK) {
        return status;
    }
    const auto &each = *s->camera->controls().find(static_cast<unsigned>(id));
    const known_row *const row = row_of(*each.first);
    const double number = row ? menu_number(*row, index) : index;

    if (control.kind != CAPTURE_MENU || index < control.min || index > control.max ||
        !offers_value(each.second, number)) {
        return CAPTURE_ERR_ARG;
    }
    std::string name = row ? "" : name_of(*each.first, index, 0);
    if (row) {
        name = row->how == meaning::flicker ? line_items[index] : exposure_items[index];
    }
    capture_copy_text(text, 32, name.c_str(), name.size());
    return CAPTURE_OK;
}

} // namespace capture_libcamera
