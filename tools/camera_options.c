#include "camera.h"

#include "say.h"

#ifdef PEL_HAS_CAMERAS

#include <string.h>

#include "decimal.h"
#include "options.h"
#include "whole.h"

static int take_backend(capture_wish *wish)
{
    if (strcmp(optarg, "v4l2") == 0) {
        wish->backend = CAPTURE_V4L2;
    } else if (strcmp(optarg, "libcamera") == 0) {
        wish->backend = CAPTURE_LIBCAMERA;
    } else {
        return say_error(NULL, "--backend is v4l2 or libcamera, not '%s'", optarg);
    }
    return 0;
}

/* A code of V4L2, or pel's name of a format. */
static int take_format(capture_wish *wish)
{
    static const char codes[][8] = {"YUYV", "UYVY", "YVYU", "VYUY", "NV12", "YU12", "GREY", "RGBP",
                                    "RGBR", "RGB3", "BGR3", "RGGB", "GRBG", "GBRG", "BA81"};
    pel_format format = PEL_GRAY8;
    pel_format coded = PEL_GRAY8;
    const char *word = options_same_word(optarg, "MJPEG") ? "MJPG" : optarg;
    wish->fourcc = capture_fourcc(word);
    if (wish->fourcc && capture_format_of(wish->fourcc, &coded)) {
        return 0;
    }
    for (size_t i = 0; i < sizeof codes / sizeof codes[0]; i++) {
        wish->fourcc = capture_fourcc(codes[i]);
        if (options_same_word(word, codes[i])) {
            return 0;
        }
        if (capture_format_of(wish->fourcc, &coded) &&
            options_same_word(word, pel_format_name(coded))) {
            return 0;
        }
    }
    return options_format(word, &format) /* lists the names */
               ? -1
               : say_error(NULL, "no camera sends %s", word);
}

static int take_rate(capture_wish *wish)
{
    int32_t milli;
    if (decimal_milli(NULL, "--rate", optarg, 1, 1000000, &milli)) {
        return -1;
    }
    wish->rate_num = (unsigned)milli;
    wish->rate_den = 1000;
    while (wish->rate_num % 10 == 0 && wish->rate_den > 1) {
        wish->rate_num /= 10;
        wish->rate_den /= 10;
    }
    return 0;
}

static int take_setting(const char *name, camera_setting *setting)
{
    if (strcmp(optarg, "auto") == 0) {
        setting->mode = CAMERA_AUTO;
        return 0;
    }
    setting->mode = CAMERA_MANUAL;
    return whole_number(NULL, name, optarg, INT32_MIN + 1, INT32_MAX, &setting->value);
}

/* V4L2's menu in words. */
static int take_power_line(camera_setting *setting)
{
    static const char words[][5] = {"off", "50", "60", "auto"};
    for (int i = 0; i < 4; i++) {
        if (strcmp(optarg, words[i]) == 0) {
            setting->mode = CAMERA_MANUAL;
            setting->value = i;
            return 0;
        }
    }
    return say_error(NULL, "--power-line is off, 50, 60 or auto, not '%s'", optarg);
}

static int take_seconds(camera_options *options)
{
    int32_t milli;
    if (decimal_milli(NULL, "--seconds", optarg, 1, INT32_MAX, &milli)) {
        return -1;
    }
    options->milli_s = (unsigned long)milli;
    return 0;
}

static int take_reconnect(capture_wish *wish)
{
    unsigned long seconds = 0;
    const int status = options_number("--reconnect", optarg, 1, 86400, &seconds);
    wish->return_ms = (unsigned)seconds * 1000;
    return status;
}

static int take_more(int option, camera_options *options)
{
    switch (option) {
    case CAMERA_OPTION_EXPOSURE:
        return take_setting("--exposure", &options->exposure);
    case CAMERA_OPTION_WHITE_BALANCE:
        return take_setting("--white-balance", &options->white_balance);
    case CAMERA_OPTION_GAIN:
        return take_setting("--gain", &options->gain);
    case CAMERA_OPTION_POWER_LINE:
        return take_power_line(&options->power_line);
    case CAMERA_OPTION_PATIENCE:
        return options_number("--patience", optarg, 1, 86400, &options->patience);
    case CAMERA_OPTION_RECONNECT:
        return take_reconnect(&options->wish);
    case CAMERA_OPTION_NEWEST:
        options->wish.newest = 1;
        return 0;
    default:
        options->lock = 1;
        return 0;
    }
}

static int take(int option, camera_options *options)
{
    switch (option) {
    case CAMERA_OPTION_DEVICE:
        options->wish.device = optarg;
        return 0;
    case CAMERA_OPTION_BACKEND:
        return take_backend(&options->wish);
    case CAMERA_OPTION_SIZE:
        return options_size(optarg, &options->wish.width, &options->wish.height);
    case CAMERA_OPTION_FORMAT:
        return take_format(&options->wish);
    case CAMERA_OPTION_RATE:
        return take_rate(&options->wish);
    case CAMERA_OPTION_COUNT:
        return options_number("--count", optarg, 1, UINT32_MAX, &options->count);
    case CAMERA_OPTION_SECONDS:
        return take_seconds(options);
    case CAMERA_OPTION_SETTLE:
        options->has_settle = 1;
        return options_number("--settle", optarg, 0, 100000, &options->settle);
    default:
        return take_more(option, options);
    }
}

int camera_option(int option, camera_options *options)
{
    if (option != CAMERA_OPTION_DEVICE &&
        (option < CAMERA_OPTION_FIRST || option > CAMERA_OPTION_NEWEST)) {
        return 0;
    }
    options->given++;
    return take(option, options) ? -1 : 1;
}

#else

int camera_option(int option, camera_options *options)
{
    options->given += option == CAMERA_OPTION_DEVICE;
    return option == CAMERA_OPTION_DEVICE;
}

int camera_walk(const camera_options *options, walk_visit *visit, void *user)
{
    (void)options;
    (void)visit;
    (void)user;
    camera_missing("camera");
    return -1;
}

int camera_missing(const char *command)
{
    say_error(command, "this build has no cameras: they need Linux, and a build with "
                       "-DPEL_BUILD_LINUX_PORT=ON");
    return EXIT_BAD_INPUT;
}

#endif
