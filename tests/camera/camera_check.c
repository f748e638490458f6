/*
 * The checks that run inside the virtual machine, by groups:
 *     camera_check GROUP [ARGUMENT...]
 * Everything goes through capture.h, as a robot's program would use it; what the driver really does
 * is set and asked by a hand of our own (knob.h). Lines 'ok NAME', 'FAIL NAME: why', '# note'; the
 * exit status is 0 if all held, 1 if not, 2 if it was called wrongly.
 */
#include <dirent.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "check.h"

static unsigned failed;

/* ---- Reporting ----------------------------------------------------------------------------- */

static int say(int good, const char *group, const char *what, const char *format, va_list list)
{
    printf("%s %s%s%s: ", good ? "ok" : "FAIL", group, *what ? " " : "", what);
    vprintf(format, list);
    printf("\n");
    fflush(stdout);
    failed += good ? 0u : 1u;
    return good;
}

int check(int good, const char *name, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    const int result = say(good, name, "", format, list);
    va_end(list);
    return result;
}

int check_in(int good, const char *group, const char *what, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    const int result = say(good, group, what, format, list);
    va_end(list);
    return result;
}

const char *told(capture_status status, const capture *camera)
{
    static char text[320];
    snprintf(text, sizeof text, "%s (%s)", capture_status_name(status),
             camera ? capture_error(camera) : "no camera");
    return text;
}

/* ---- Cameras ------------------------------------------------------------------------------- */

capture_wish small_wish(const char *device)
{
    capture_wish wish;
    memset(&wish, 0, sizeof wish);
    wish.device = device;
    wish.fourcc = capture_fourcc("YUYV");
    wish.width = 320;
    wish.height = 180;
    wish.rate_num = 60;
    wish.rate_den = 1;
    return wish;
}

capture *opened(const capture_wish *wish, const char *name)
{
    capture *camera = NULL;
    capture_status status = capture_open(wish, NULL, &camera);
    if (status >= 0) {
        status = capture_start(camera);
    }
    if (status < 0) {
        check(0, name, "opens and starts: %s", told(status, camera));
        capture_close(camera);
        return NULL;
    }
    return camera;
}

series take(capture *camera, unsigned count, unsigned deadline_ms)
{
    series all;
    memset(&all, 0, sizeof all);
    while (all.frames < count) {
        capture_frame frame;
        all.status = capture_next(camera, deadline_ms, &frame);
        if (all.status != CAPTURE_OK) {
            break;
        }
        if (all.frames == 0) {
            all.first_sequence = frame.sequence;
            all.first_us = frame.timestamp_us;
        } else {
            all.missed += frame.missed;
            all.out_of_order += frame.sequence != all.last_sequence + 1 + frame.missed ||
                                frame.timestamp_us < all.last_us;
        }
        all.last_sequence = frame.sequence;
        all.last_us = frame.timestamp_us;
        all.frames++;
        (void)capture_give_back(camera, &frame);
    }
    return all;
}

uint64_t now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000u + (uint64_t)now.tv_nsec / 1000000u;
}

void pause_ms(unsigned ms)
{
    const struct timespec length = {(time_t)(ms / 1000u), (long)(ms % 1000u) * 1000000L};
    nanosleep(&length, NULL);
}

/* ---- What is left behind ------------------------------------------------------------------- */

static unsigned open_files(void)
{
    unsigned files = 0;
    DIR *folder = opendir("/proc/self/fd");
    while (folder && readdir(folder)) {
        files++;
    }
    if (folder) {
        closedir(folder);
    }
    return files;
}

/* Pieces of a camera's memory that this process still sees. */
static unsigned mapped_buffers(void)
{
    char line[512];
    unsigned maps = 0;
    FILE *file = fopen("/proc/self/maps", "r");
    while (file && fgets(line, sizeof line, file)) {
        maps += strstr(line, "/dev/video") || strstr(line, "dmabuf") ? 1u : 0u;
    }
    if (file) {
        fclose(file);
    }
    return maps;
}

/* ---- Main ---------------------------------------------------------------------------------- */

static const struct {
    const char *name;
    check_group *run;
    int arguments;
} groups[] = {
    {"list", group_list, 1},
    {"kinds", group_kinds, 1},
    {"access", group_access, 1},
    {"busy", group_busy, 1},
    {"pictures", group_pictures, 1},
    {"ranges", group_ranges, 1},
    {"sizes", group_sizes, 1},
    {"changed", group_changed, 1},
    {"controls", group_controls, 1},
    {"setup-errors", group_setup_errors, 1},
    {"stream-errors", group_stream_errors, 1},
    {"dropped", group_dropped, 1},
    {"wrap", group_wrap, 1},
    {"clock", group_clock, 2},
    {"stale", group_stale, 1},
    {"signals", group_signals, 1},
    {"unplugged", group_unplugged, 1},
    {"removed", group_removed, 2},
    {"feed", group_feed, 5},
    {"fed", group_fed, 2},
    {"stalled", group_stalled, 2},
};

int main(int count, char **arguments)
{
    for (size_t i = 0; count > 1 && i < sizeof groups / sizeof groups[0]; i++) {
        if (strcmp(groups[i].name, arguments[1]) == 0 && count == 2 + groups[i].arguments) {
            const unsigned files = open_files();
            groups[i].run(count - 2, arguments + 2);
            const unsigned files_now = open_files(), maps_now = mapped_buffers();
            check_in(files_now == files && maps_now == 0, groups[i].name, "leaves nothing open",
                     "%u files before, %u after, %u buffers mapped", files, files_now, maps_now);
            return failed > 0 ? 1 : 0;
        }
    }
    fprintf(stderr, "usage: camera_check GROUP [ARGUMENT...]\n");
    return 2;
}
