/*
 * The cameras of a `pel` that is linked with this file in place of the system's calls: replayed
 * ones (tests/replay), as the words of PEL_REPLAY say, such as
 *
 *     PEL_REPLAY="mode=YUYV:320x240:30 frames=scene.yuv unplug=7"
 *
 * When the program ends, everything must have been closed, unmapped and given back, and no call may
 * have been one that no right program makes: otherwise it ends with status 99.
 */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "replay.h"

enum { MISUSED = 99, JPEG_MAX = 16384 /* what a replayed buffer holds */ };

static replay world;
static struct v4l2_calls calls;
static int in_real_time;
static uint8_t *frames; /* what the first camera shows, without padding */
static size_t frames_bytes;
static uint8_t *jpeg;
static char *words_of_test; /* the cameras' names point into it */

static void give_up(const char *what, const char *word)
{
    fprintf(stderr, "replay: %s: %s\n", what, word);
    exit(MISUSED);
}

static uint8_t *read_whole(const char *path, size_t *bytes)
{
    FILE *file = fopen(path, "rb");
    uint8_t *memory = malloc((size_t)64 << 20);
    if (!file || !memory) {
        give_up("cannot read", path);
        return NULL;
    }
    *bytes = fread(memory, 1, (size_t)64 << 20, file);
    fclose(file);
    return memory;
}

/* ---- The account --------------------------------------------------------------------------- */

static void check_account(void)
{
    fflush(stdout);
    if (world.misuse || replay_open_count(&world) || replay_map_count(&world) ||
        replay_buffer_count(&world)) {
        fprintf(stderr, "replay: %d misuses, %u open, %u mapped, %u buffers\n", world.misuse,
                replay_open_count(&world), replay_map_count(&world), replay_buffer_count(&world));
        _exit(MISUSED);
    }
    replay_free(&world);
    free(frames);
    free(jpeg);
    free(words_of_test);
}

/* ---- Calls --------------------------------------------------------------------------------- */

static void show_frame(const replay_node *node, const struct v4l2_buffer *buffer)
{
    uint8_t *to = world.memories[node->buffers[buffer->index].memory].bytes;
    const size_t stride = replay_stride(node);
    const size_t row_bytes = stride - node->stride_extra;
    const size_t bytes = replay_frame_bytes(node) / stride * row_bytes;
    const uint8_t *from = frames + buffer->sequence % (frames_bytes / bytes) * bytes;
    for (size_t row = 0; row < bytes / row_bytes; row++) {
        memcpy(to + row * stride, from + row * row_bytes, row_bytes);
    }
}

static int call_ioctl(void *user, int fd, unsigned long request, void *argument)
{
    const int result = world.calls.ioctl(user, fd, request, argument);
    if (result == 0 && request == VIDIOC_DQBUF && frames && replay_stride(&world.nodes[0]) > 0) {
        show_frame(&world.nodes[0], argument);
    }
    return result;
}

/* The replayed clock runs as fast as it can, unless a test wants to have time for a signal. */
static int call_poll(void *user, struct pollfd *fds, nfds_t count, int timeout_ms)
{
    const uint64_t before = world.now_us;
    const int result = world.calls.poll(user, fds, count, timeout_ms);
    const uint64_t spent = world.now_us - before;
    const struct timespec pause = {(time_t)(spent / 1000000), (long)(spent % 1000000 * 1000)};
    if (in_real_time && nanosleep(&pause, NULL) != 0) {
        errno = EINTR;
        return -1;
    }
    return result;
}

/* ---- The words of PEL_REPLAY --------------------------------------------------------------- */

static replay_control *control_of(const char *name)
{
    for (unsigned i = 0; i < world.nodes[0].control_count; i++) {
        if (strcmp(world.nodes[0].controls[i].name, name) == 0) {
            return &world.nodes[0].controls[i];
        }
    }
    give_up("no control", name);
    return NULL;
}

static void add_control(uint32_t id, uint32_t type, const char *name, int32_t max, int32_t value)
{
    replay_node *node = &world.nodes[0];
    replay_control *control = &node->controls[node->control_count++];
    memset(control, 0, sizeof *control);
    control->id = id;
    control->type = type;
    snprintf(control->name, sizeof control->name, "%s", name);
    control->max = max;
    control->step = 1;
    control->initial = control->value = value;
}

/* What webcams have. */
static void add_automatics(void)
{
    add_control(V4L2_CID_EXPOSURE_AUTO, V4L2_CTRL_TYPE_MENU, "Auto Exposure", 3, 3);
    world.nodes[0].controls[world.nodes[0].control_count - 1].menu[1] = "Manual Mode";
    world.nodes[0].controls[world.nodes[0].control_count - 1].menu[3] = "Aperture Priority Mode";
    add_control(V4L2_CID_AUTO_WHITE_BALANCE, V4L2_CTRL_TYPE_BOOLEAN, "Auto White Balance", 1, 1);
    add_control(V4L2_CID_WHITE_BALANCE_TEMPERATURE, V4L2_CTRL_TYPE_INTEGER, "White Balance", 6500,
                4600);
}

static void add_mode(const char *value)
{
    replay_node *node = &world.nodes[0];
    replay_mode mode = {0};
    char code[5];
    if (sscanf(value, "%4[^:]:%ux%u:%u", code, &mode.width, &mode.height, &mode.rate) != 4) {
        give_up("no mode", value);
    }
    mode.fourcc =
        v4l2_fourcc((uint32_t)code[0], (uint32_t)code[1], (uint32_t)code[2], (uint32_t)code[3]);
    node->modes[node->mode_count++] = mode;
}

static int take_file(const char *name, const char *value)
{
    if (strcmp(name, "frames") == 0) {
        frames = read_whole(value, &frames_bytes);
    } else if (strcmp(name, "jpeg") == 0) {
        size_t bytes = 0;
        jpeg = read_whole(value, &bytes);
        world.nodes[0].jpeg = jpeg;
        world.nodes[0].jpeg_bytes = bytes;
        if (bytes > JPEG_MAX) {
            give_up("too large", value);
        }
    } else if (strcmp(name, "mode") == 0) {
        add_mode(value);
    } else if (strcmp(name, "ignore") == 0) {
        control_of(value)->ignored = 1;
    } else if (strcmp(name, "second") == 0) {
        replay_add_camera(&world, 1, 2, "Second Camera", value);
    } else {
        return -1;
    }
    return 0;
}

static int take_number(const char *name, unsigned number)
{
    replay_node *node = &world.nodes[0];
    const struct {
        const char *name;
        unsigned *value;
    } known[] = {{"stride", &node->stride_extra},
                 {"unplug", &node->unplug_after},
                 {"damage", &node->damage},
                 {"shorten", &node->shorten},
                 {"lose", &node->lose},
                 {"force_width", &node->force_width},
                 {"force_height", &node->force_height},
                 {"interrupt", &world.interrupt},
                 {"back_number", &node->back_number}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (strcmp(name, known[i].name) == 0) {
            *known[i].value = number;
            return 0;
        }
    }
    if (strcmp(name, "quantization") == 0) {
        node->quantization = number;
    } else if (strcmp(name, "open_error") == 0) {
        node->open_error = (int)number;
    } else if (strcmp(name, "busy") == 0) {
        replay_fail(&world, VIDIOC_S_FMT, 0, number, EBUSY);
    } else if (strcmp(name, "back_ms") == 0) {
        node->back_after_us = number * (uint64_t)1000;
    } else if (strcmp(name, "present") == 0) {
        node->present = (int)number;
    } else if (strcmp(name, "realtime") == 0) {
        in_real_time = (int)number;
    } else {
        return -1;
    }
    return 0;
}

static void take_words(char *words)
{
    if (strstr(words, "mode=")) {
        world.nodes[0].mode_count = 0;
    }
    for (char *word = strtok(words, " "); word; word = strtok(NULL, " ")) {
        char *value = strchr(word, '=');
        if (!value) {
            give_up("no value", word);
        }
        *value++ = '\0';
        if (take_file(word, value) && take_number(word, (unsigned)strtoul(value, NULL, 10))) {
            give_up("unknown", word);
        }
    }
}

const struct v4l2_calls *v4l2_system_calls(void)
{
    const char *words = getenv("PEL_REPLAY");
    if (calls.user) {
        return &calls;
    }
    replay_init(&world);
    add_automatics();
    words_of_test = malloc(words ? strlen(words) + 1 : 1);
    if (words_of_test && words) {
        take_words(strcpy(words_of_test, words));
    }
    calls = world.calls;
    calls.ioctl = call_ioctl;
    calls.poll = call_poll;
    atexit(check_account);
    return &calls;
}
