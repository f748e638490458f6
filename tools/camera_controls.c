#include "camera_controls.h"

#ifdef PEL_HAS_CAMERAS

#include <stdio.h>
#include <string.h>

#include "say.h"

/* A value and the switch that would change it behind our back. */
typedef struct pair {
    const char *option;
    capture_known value, automatic;
    int32_t manual_state; /* of the switch */
} pair;

/* V4L2's menu of auto exposure: 0 auto, 1 manual, 3 aperture priority. The others are switches. */
enum { EXPOSURE_AUTO = 0, EXPOSURE_MANUAL = 1, EXPOSURE_APERTURE = 3 };

static const pair pairs[] = {
    {"--exposure", CAPTURE_EXPOSURE, CAPTURE_AUTO_EXPOSURE, EXPOSURE_MANUAL},
    {"--gain", CAPTURE_GAIN, CAPTURE_AUTO_GAIN, 0},
    {"--white-balance", CAPTURE_WHITE_BALANCE, CAPTURE_AUTO_WHITE_BALANCE, 0},
};
enum { PAIRS = sizeof pairs / sizeof pairs[0] };

/* Sets and says what came of it: 0, or -1 after a message. */
static int set(capture *device, const char *name, capture_known known, int32_t value)
{
    int32_t actual = 0;
    const capture_status status =
        capture_set(device, capture_control_id(device, known), value, &actual);
    if (status == CAPTURE_CHANGED) {
        say_error(name, "%s: %ld was asked for, the driver has %ld", capture_known_name(known),
                  (long)value, (long)actual);
        return 0;
    }
    return status < 0 ? say_error(name, "%s=%ld is refused: %s", capture_known_name(known),
                                  (long)value, capture_error(device))
                      : 0;
}

/* UVC cameras have aperture priority, others plain auto. */
static int32_t automatic_state(capture *device, const pair *of)
{
    char text[32];
    if (of->automatic != CAPTURE_AUTO_EXPOSURE) {
        return 1;
    }
    const uint32_t id = capture_control_id(device, of->automatic);
    return capture_menu_item(device, id, EXPOSURE_APERTURE, text) == CAPTURE_OK ? EXPOSURE_APERTURE
                                                                                : EXPOSURE_AUTO;
}

static int missing(const char *name, const char *option, capture_known known)
{
    return say_error(name,
                     "%s: the camera has no control '%s'; 'pel cameras -d %s' lists what it has",
                     option, capture_known_name(known), name);
}

static int apply(capture *device, const char *name, const pair *to, const camera_setting *setting)
{
    const int has_switch = capture_control_id(device, to->automatic) != 0;
    if (setting->mode == CAMERA_AUTO) {
        return has_switch ? set(device, name, to->automatic, automatic_state(device, to))
                          : missing(name, to->option, to->automatic);
    }
    if (!capture_control_id(device, to->value)) {
        return missing(name, to->option, to->value);
    }
    return has_switch && set(device, name, to->automatic, to->manual_state)
               ? -1
               : set(device, name, to->value, setting->value);
}

int camera_controls_apply(capture *device, const char *name, const camera_options *options)
{
    const camera_setting *const settings[PAIRS] = {&options->exposure, &options->gain,
                                                   &options->white_balance};
    for (int i = 0; i < PAIRS; i++) {
        if (settings[i]->mode != CAMERA_LEAVE && apply(device, name, &pairs[i], settings[i])) {
            return -1;
        }
    }
    if (options->power_line.mode == CAMERA_LEAVE) {
        return 0;
    }
    if (!capture_control_id(device, CAPTURE_POWER_LINE)) {
        return missing(name, "--power-line", CAPTURE_POWER_LINE);
    }
    return set(device, name, CAPTURE_POWER_LINE, options->power_line.value);
}

void camera_controls_lock(capture *device, const char *name)
{
    int found = 0;
    for (int i = 0; i < PAIRS; i++) {
        const uint32_t value_id = capture_control_id(device, pairs[i].value);
        int32_t reached = 0;
        const int known = value_id && capture_get(device, value_id, &reached) == CAPTURE_OK;
        if (!capture_control_id(device, pairs[i].automatic)) {
            continue;
        }
        found++;
        if (set(device, name, pairs[i].automatic, pairs[i].manual_state) == 0 && known) {
            set(device, name, pairs[i].value, reached);
        }
    }
    if (found == 0) {
        say_error(name, "--lock: the camera has no switch for its automatics, they may go on");
    }
}

void camera_controls_text(capture *device, char *text, size_t bytes)
{
    size_t used = 0;
    snprintf(text, bytes, "none");
    for (int i = CAPTURE_EXPOSURE; i < CAPTURE_KNOWN_COUNT; i++) {
        const uint32_t id = capture_control_id(device, (capture_known)i);
        int32_t value = 0;
        if (id && capture_get(device, id, &value) == CAPTURE_OK && used < bytes) {
            used += (size_t)snprintf(text + used, bytes - used, "%s%s=%ld", used ? ", " : "",
                                     capture_known_name((capture_known)i), (long)value);
        }
    }
}

#else

typedef int camera_controls_empty; /* ISO C wants something in a file */

#endif
