/* Controls: what the port lists is what the driver has, and what it sets is what the driver does.
 */
#include <stdio.h>
#include <string.h>

#include "bars.h"
#include "check.h"
#include "knob.h"

#define CONTROLS_MAX 128

static const capture_control *named(const capture_control *controls, int all, const char *name)
{
    for (int i = 0; i < all && i < CONTROLS_MAX; i++) {
        if (strcmp(controls[i].name, name) == 0) {
            return &controls[i];
        }
    }
    return NULL;
}

/* As V4L2 and vivid define them: kind, range and first value. */
static void check_listed(const capture_control *controls, int all)
{
    const capture_control *brightness = named(controls, all, "Brightness");
    const capture_control *automatic = named(controls, all, "Gain, Automatic");
    const capture_control *pattern = named(controls, all, "Test Pattern");
    check(brightness && brightness->kind == CAPTURE_INTEGER && brightness->min == 0 &&
              brightness->max == 255 && brightness->step == 1 && brightness->initial == 128 &&
              !brightness->read_only && brightness->known == 0,
          "controls list a number", "Brightness %s", brightness ? "is there" : "is missing");
    check(automatic && automatic->kind == CAPTURE_SWITCH && automatic->min == 0 &&
              automatic->max == 1 && automatic->known == CAPTURE_AUTO_GAIN,
          "controls list a switch", "Gain, Automatic %s", automatic ? "is there" : "is missing");
    check(pattern && pattern->kind == CAPTURE_MENU && pattern->max > 15, "controls list a menu",
          "Test Pattern %s", pattern ? "is there" : "is missing");
    const capture_control *fixed = named(controls, all, "Read-Only Integer 32 Bits");
    check(fixed && fixed->read_only, "controls list what cannot be set", "Read-Only Integer");
}

static void check_set(capture *camera, const char *device, const capture_control *brightness)
{
    int32_t actual = -1, again = -1;
    int driver = -1;
    capture_status status = capture_set(camera, brightness->id, 77, &actual);
    (void)knob_get(device, "Brightness", &driver);
    check(status == CAPTURE_OK && actual == 77 && driver == 77, "controls set",
          "%s: read back %d, the driver has %d", told(status, camera), (int)actual, driver);
    (void)knob_set(device, "Brightness", 99);
    status = capture_get(camera, brightness->id, &again);
    check(status == CAPTURE_OK && again == 99, "controls get", "%s: %d", told(status, camera),
          (int)again);
    check(capture_set(camera, brightness->id, 256, &actual) == CAPTURE_ERR_ARG &&
              capture_set(camera, brightness->id, -1, &actual) == CAPTURE_ERR_ARG,
          "controls refuse what is outside", "%s", capture_error(camera));
    (void)knob_get(device, "Brightness", &driver);
    check(driver == 99, "controls leave it then", "the driver has %d", driver);
    check(capture_set(camera, 0x0098ffff, 1, NULL) == CAPTURE_ERR_NONE,
          "controls refuse no control", "%s", capture_error(camera));
    (void)capture_set(camera, brightness->id, brightness->initial, NULL);
}

/* While the gain is automatic the driver changes it by itself. */
static void check_automatic(capture *camera, const char *device)
{
    const uint32_t gain = capture_control_id(camera, CAPTURE_GAIN);
    const uint32_t automatic = capture_control_id(camera, CAPTURE_AUTO_GAIN);
    int32_t actual = -1;
    int driver = -1;
    check(gain && automatic && capture_control_id(camera, CAPTURE_WHITE_BALANCE) == 0,
          "controls known by name", "gain %#x, automatic %#x", (unsigned)gain, (unsigned)automatic);
    capture_status status = capture_set(camera, automatic, 0, &actual);
    check(status == CAPTURE_OK && actual == 0, "controls switch", "%s", told(status, camera));
    status = capture_set(camera, gain, 200, &actual);
    (void)knob_get(device, "Gain", &driver);
    check(status == CAPTURE_OK && actual == 200 && driver == 200, "controls by hand", "%s, %d",
          told(status, camera), driver);
    status = capture_set(camera, automatic, 1, &actual);
    check(status == CAPTURE_OK && actual == 1, "controls switch back", "%s", told(status, camera));
    /* Seconds since the start stand for the gain now: small, and not what is asked. */
    status = capture_set(camera, gain, 250, &actual);
    check(status != CAPTURE_OK, "controls ignored are not believed", "%s, reads %d",
          told(status, camera), (int)actual);
}

static void check_menu(capture *camera, const char *device, const capture_control *pattern)
{
    char text[32] = "";
    int32_t actual = -1;
    int driver = -1;
    int32_t white = -1;
    for (int32_t i = pattern->min; i <= pattern->max; i++) {
        if (capture_menu_item(camera, pattern->id, i, text) == CAPTURE_OK &&
            strcmp(text, "100% White") == 0) {
            white = i;
        }
    }
    const capture_status status = capture_set(camera, pattern->id, white, &actual);
    (void)knob_get(device, "Test Pattern", &driver);
    check(white > 0 && status == CAPTURE_OK && driver == white, "controls of a menu",
          "%s: item %d, the driver has %d", told(status, camera), (int)white, driver);
    check(capture_menu_item(camera, pattern->id, pattern->max + 1, text) == CAPTURE_ERR_ARG,
          "controls end of a menu", "%s", capture_error(camera));
}

/* What is set must be seen: without saturation there is no colour, and white stays white. */
static void check_seen(capture *camera, const char *device)
{
    capture_frame frame;
    int y = -1, cb = -1, cr = -1;
    (void)knob_choose(device, "OSD Text Mode", "None");
    (void)knob_choose(device, "Test Pattern", "100% Red");
    for (int colour = 1; colour >= 0; colour--) {
        const int expected = colour ? 240 : 128; /* Cr of red: 128 + 224/2, or none */
        capture_status status = capture_set(camera, V4L2_CID_SATURATION, colour ? 128 : 0, NULL);
        status = status == CAPTURE_OK ? capture_start(camera) : status;
        (void)take(camera, 2, 2000);
        if (status == CAPTURE_OK && capture_next(camera, 2000, &frame) == CAPTURE_OK) {
            const uint8_t *middle =
                frame.view.plane[0] + (ptrdiff_t)frame.view.stride_bytes[0] * 90 + 4 * 80;
            y = middle[0];
            cb = middle[1];
            cr = middle[3];
            (void)capture_give_back(camera, &frame);
        }
        (void)capture_stop(camera);
        check(cr >= expected - 2 && cr <= expected + 2 && y >= 79 && y <= 84,
              colour ? "controls seen: red" : "controls seen: no colour", "Y %d, Cb %d, Cr %d", y,
              cb, cr);
    }
    (void)capture_set(camera, V4L2_CID_SATURATION, 128, NULL);
}

void group_controls(int count, char **arguments)
{
    static capture_control controls[CONTROLS_MAX];
    const capture_wish wish = small_wish(arguments[0]);
    capture *camera = NULL;
    (void)count;
    const capture_status status = capture_open(&wish, NULL, &camera);
    const int all = status < 0 ? -1 : capture_controls(camera, controls, CONTROLS_MAX);
    check(all > 20 && all <= CONTROLS_MAX, "controls are there", "%d, %s", all,
          told(status, camera));
    if (all > 0) {
        check(capture_controls(camera, NULL, 0) == all, "controls counted without room", "%d", all);
        check_listed(controls, all);
        const capture_control *brightness = named(controls, all, "Brightness");
        const capture_control *pattern = named(controls, all, "Test Pattern");
        if (brightness && pattern) {
            check_set(camera, arguments[0], brightness);
            check_menu(camera, arguments[0], pattern);
        }
        check_automatic(camera, arguments[0]);
        check_seen(camera, arguments[0]);
    }
    capture_close(camera);
}
