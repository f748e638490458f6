/* Pictures of our own through the kernel: a program that plays the camera, and what arrives. */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "check.h"
#include "knob.h"

static volatile sig_atomic_t ended;

static void end(int number)
{
    (void)number;
    ended = 1;
}

/* The whole file, which the caller frees; NULL if it cannot be read. */
static uint8_t *read_file(const char *path, size_t *bytes)
{
    FILE *file = fopen(path, "rb");
    uint8_t *content = NULL;
    if (file && fseek(file, 0, SEEK_END) == 0) {
        const long size = ftell(file);
        rewind(file);
        content = size > 0 ? malloc((size_t)size) : NULL;
        *bytes = content ? fread(content, 1, (size_t)size, file) : 0;
    }
    if (file) {
        fclose(file);
    }
    return content;
}

/* Opens v4l2loopback's other end: YUYV whose Y, U and V have full range. */
static int open_feed(const char *device, unsigned width, unsigned height)
{
    struct v4l2_format format;
    const int file = open(device, O_RDWR | O_CLOEXEC);
    memset(&format, 0, sizeof format);
    format.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
    format.fmt.pix.width = width;
    format.fmt.pix.height = height;
    format.fmt.pix.pixelformat = V4L2_PIX_FMT_YUYV;
    format.fmt.pix.field = V4L2_FIELD_NONE;
    format.fmt.pix.bytesperline = 2 * width;
    format.fmt.pix.sizeimage = 2 * width * height;
    format.fmt.pix.colorspace = V4L2_COLORSPACE_SRGB;
    format.fmt.pix.priv = V4L2_PIX_FMT_PRIV_MAGIC;
    format.fmt.pix.quantization = V4L2_QUANTIZATION_FULL_RANGE;
    if (file >= 0 && ioctl(file, VIDIOC_S_FMT, &format) < 0) {
        close(file);
        return -1;
    }
    return file;
}

/* Shows the file's frames, over and over, until it is told to end. */
static int feed(int file, const uint8_t *frames, size_t frame_bytes, size_t count, unsigned rate)
{
    for (size_t i = 0; !ended; i = (i + 1) % count) {
        if (write(file, frames + i * frame_bytes, frame_bytes) != (ssize_t)frame_bytes) {
            return -1;
        }
        pause_ms(1000 / rate);
    }
    return 0;
}

/* feed DEVICE FILE WIDTH HEIGHT RATE: plays the YUYV frames of FILE until SIGTERM. */
void group_feed(int count, char **arguments)
{
    const unsigned width = (unsigned)atoi(arguments[2]), height = (unsigned)atoi(arguments[3]);
    const unsigned rate = (unsigned)atoi(arguments[4]);
    const size_t frame_bytes = (size_t)2 * width * height;
    const struct sigaction action = {.sa_handler = end};
    size_t bytes = 0;
    (void)count;
    sigaction(SIGTERM, &action, NULL);
    uint8_t *frames = read_file(arguments[1], &bytes);
    const int file = open_feed(arguments[0], width, height);
    if (!frames || bytes < frame_bytes || file < 0 || rate < 1) {
        check(0, "feed", "cannot play %s to %s: %s", arguments[1], arguments[0], strerror(errno));
    } else if (feed(file, frames, frame_bytes, bytes / frame_bytes, rate) < 0) {
        check(0, "feed", "%s: %s", arguments[0], strerror(errno));
    }
    if (file >= 0) {
        close(file);
    }
    free(frames);
}

/* Which of the file's frames this is, byte for byte; -1: none. */
static int which_frame(const capture_frame *frame, const capture_settings *set,
                       const uint8_t *frames, size_t count)
{
    const size_t row_bytes = (size_t)2 * set->width;
    for (size_t i = 0; i < count; i++) {
        unsigned same = 0;
        for (unsigned y = 0; y < set->height; y++) {
            same += memcmp(frame->view.plane[0] + (ptrdiff_t)frame->view.stride_bytes[0] * y,
                           frames + (i * set->height + y) * row_bytes, row_bytes) == 0;
        }
        if (same == set->height) {
            return (int)i;
        }
    }
    return -1;
}

/* fed DEVICE FILE: every frame that arrives is one of the file's, and each of those arrives. */
void group_fed(int count, char **arguments)
{
    const capture_wish wish = {.device = arguments[0], .newest = 1};
    capture_settings set;
    unsigned frames = 0, strange = 0, seen[8] = {0};
    size_t bytes = 0, different = 0;
    uint8_t *content = read_file(arguments[1], &bytes);
    capture *camera = opened(&wish, "fed");
    (void)count;
    if (camera && content) {
        capture_get_settings(camera, &set);
        check(set.format == PEL_YUYV && set.range == PEL_RANGE_FULL, "fed settings",
              "%ux%u, %s range", set.width, set.height,
              set.range == PEL_RANGE_FULL ? "full" : "limited");
        const size_t count_in_file = bytes / ((size_t)2 * set.width * set.height);
        capture_frame frame;
        while (frames < 30 && capture_next(camera, 2000, &frame) == CAPTURE_OK) {
            const int which = which_frame(&frame, &set, content, count_in_file);
            frames++;
            strange += which < 0 ? 1u : 0u;
            if (which >= 0 && which < 8) {
                different += seen[which]++ == 0;
            }
            (void)capture_give_back(camera, &frame);
        }
        check(frames == 30 && strange == 0, "fed by the byte",
              "%u frames, %u of them not the file's", frames, strange);
        check(different == count_in_file && different > 1, "fed all", "%u of %u frames",
              (unsigned)different, (unsigned)count_in_file);
    }
    capture_close(camera);
    free(content);
}

/* A camera that shows ten frames, nothing for three seconds, and then frames again. */
static pid_t stall(const char *device, const uint8_t *frame, size_t bytes)
{
    fflush(stdout);
    const pid_t feeder = fork();
    if (feeder == 0) {
        const int file = open_feed(device, 320, 240);
        for (unsigned i = 0; file >= 0 && i < 400; i++) {
            if (write(file, frame, bytes) != (ssize_t)bytes) {
                _exit(1);
            }
            pause_ms(i == 9 ? 3000 : 50);
        }
        _exit(0);
    }
    return feeder;
}

/* stalled DEVICE FILE: time-outs are said and counted, the stream restarts, and then goes on. */
void group_stalled(int count, char **arguments)
{
    const capture_wish wish = {.device = arguments[0], .restart_after = 3};
    capture_counts counts;
    size_t bytes = 0;
    unsigned timeouts = 0;
    uint8_t *content = read_file(arguments[1], &bytes);
    (void)count;
    if (!content || bytes < 153600) {
        check(0, "stalled", "no frame in %s", arguments[1]);
        free(content);
        return;
    }
    const pid_t feeder = stall(arguments[0], content, 153600);
    pause_ms(200);
    capture *camera = opened(&wish, "stalled");
    if (camera) {
        const uint64_t start = now_ms();
        series part = take(camera, 3, 2000);
        check(part.frames == 3, "stalled, at first", "%s", told(part.status, camera));
        while (now_ms() - start < 8000u) {
            part = take(camera, 1, 250);
            timeouts += part.status == CAPTURE_TIMEOUT ? 1u : 0u;
            if ((part.status != CAPTURE_OK && part.status != CAPTURE_TIMEOUT) ||
                (timeouts > 0 && part.status == CAPTURE_OK)) {
                break;
            }
        }
        capture_get_counts(camera, &counts);
        check(timeouts >= 3 && timeouts <= 12 && counts.timeouts == timeouts, "stalled is counted",
              "%u time-outs, %u counted", timeouts, (unsigned)counts.timeouts);
        /* Three time-outs take 0.75 s, but a second of silence has to pass for each restart. */
        check(counts.restarts >= 1 && counts.restarts <= 3, "stalled restarts", "%u restarts",
              (unsigned)counts.restarts);
        part = take(camera, 10, 2000);
        check(part.frames == 10, "stalled, then on", "%u frames, %s", part.frames,
              told(part.status, camera));
    }
    capture_close(camera);
    kill(feeder, SIGKILL);
    waitpid(feeder, NULL, 0);
    free(content);
}
