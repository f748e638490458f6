/* Cameras that cannot be had, are late, vanish and come back; programs that are. */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "check.h"
#include "knob.h"

/* ---- What there is ------------------------------------------------------------------------- */

/* Opens the camera of that name, and it is the one of that path; NULL: too many are called so. */
static void check_opened(const char *name, const char *path)
{
    capture *camera = NULL;
    capture_settings set;
    const capture_wish wish = {.device = name};
    const capture_status status = capture_open(&wish, NULL, &camera);
    capture_get_settings(camera, &set);
    check_in(path ? status >= 0 && strcmp(set.path, path) == 0 : status == CAPTURE_ERR_NONE,
             "list opens", name, "%s, %s", told(status, camera), set.path);
    capture_close(camera);
}

/* list COUNT: so many cameras of vivid are there; the last is opened under all its names. */
void group_list(int count, char **arguments)
{
    capture_device devices[16];
    int cameras = capture_list(CAPTURE_V4L2, NULL, devices, 16);
    int good = 0;
    (void)count;
    check(cameras == atoi(arguments[0]), "list counts", "%d cameras of %s", cameras, arguments[0]);
    for (int i = 0; i < cameras && i < 16; i++) {
        struct stat about;
        good += devices[i].status == CAPTURE_OK && strcmp(devices[i].driver, "vivid") == 0 &&
                stat(devices[i].path, &about) == 0 && S_ISCHR(about.st_mode) &&
                strstr(devices[i].bus, "vivid") && *devices[i].card;
    }
    check(good == cameras && good > 0, "list names", "%d of %d are described", good, cameras);
    check(capture_list(CAPTURE_V4L2, NULL, NULL, 0) == cameras, "list without room", "counts");
    if (cameras > 1 && cameras <= 16) {
        const capture_device *last = &devices[cameras - 1];
        check_opened(last->path, last->path);
        check_opened(last->bus, last->path);
        check_opened(last->card, NULL);
    }
}

static void check_not_opened(const char *device, capture_status expected, const char *what)
{
    capture *camera = NULL;
    const capture_wish wish = {.device = device};
    const capture_status status = capture_open(&wish, NULL, &camera);
    check_in(status == expected && camera && *capture_error(camera), "kinds", what, "%s",
             told(status, camera));
    capture_close(camera);
}

/* kinds OUTPUT: things that are no cameras; OUTPUT is a device of vivid that only shows. */
void group_kinds(int count, char **arguments)
{
    (void)count;
    check_not_opened("/dev/video99", CAPTURE_ERR_NONE, "no device");
    check_not_opened("/dev/null", CAPTURE_ERR_KIND, "no camera");
    check_not_opened("/init", CAPTURE_ERR_KIND, "no device but a file");
    check_not_opened(arguments[0], CAPTURE_ERR_KIND, "a screen");
    check_not_opened("no such camera", CAPTURE_ERR_NONE, "no name");
}

/* Another user, whom the device's mode keeps out. */
void group_access(int count, char **arguments)
{
    (void)count;
    if (chmod(arguments[0], 0600) < 0) {
        check(0, "access", "chmod: %s", strerror(errno));
        return;
    }
    fflush(stdout);
    const pid_t other = fork();
    if (other == 0) {
        capture *camera = NULL;
        capture_device devices[16];
        const capture_wish wish = {.device = arguments[0]};
        int listed = 0;
        if (setgid(65534) < 0 || setuid(65534) < 0) {
            _exit(3);
        }
        const capture_status status = capture_open(&wish, NULL, &camera);
        const int all = capture_list(CAPTURE_V4L2, NULL, devices, 16);
        for (int i = 0; i < all && i < 16; i++) {
            listed += strcmp(devices[i].path, arguments[0]) == 0 &&
                      devices[i].status == CAPTURE_ERR_ACCESS;
        }
        printf("# %s\n", told(status, camera));
        fflush(stdout);
        capture_close(camera);
        _exit((status == CAPTURE_ERR_ACCESS ? 0 : 1) + (listed == 1 ? 0 : 2));
    }
    int ended = -1;
    waitpid(other, &ended, 0);
    check(WIFEXITED(ended) && !(WEXITSTATUS(ended) & 1), "access refused", "status %d", ended);
    check(WIFEXITED(ended) && !(WEXITSTATUS(ended) & 2), "access listed", "status %d", ended);
    (void)chmod(arguments[0], 0660);
}

void group_busy(int count, char **arguments)
{
    const capture_wish wish = small_wish(arguments[0]);
    capture *first = opened(&wish, "busy"), *second = NULL;
    capture_mode modes[4];
    (void)count;
    if (!first) {
        return;
    }
    capture_status status = capture_open(&wish, NULL, &second);
    if (status >= 0) {
        status = capture_start(second);
    }
    check(status == CAPTURE_ERR_BUSY, "busy is said", "%s", told(status, second));
    check(capture_modes(second, modes, 4) > 4, "busy but to be looked at", "%d modes",
          capture_modes(second, modes, 4));
    const series undisturbed = take(first, 10, 2000);
    check(undisturbed.frames == 10 && undisturbed.out_of_order == 0, "busy disturbs nobody", "%s",
          told(undisturbed.status, first));
    capture_close(second);
    capture_close(first);
}

/* ---- Late programs ------------------------------------------------------------------------- */

/* A program that sleeps: the newest frame when it wishes so, the next one otherwise. */
void group_stale(int count, char **arguments)
{
    (void)count;
    for (int newest = 0; newest <= 1; newest++) {
        capture_wish wish = small_wish(arguments[0]);
        capture_counts counts;
        capture_frame frame;
        wish.newest = newest;
        wish.buffers = 4;
        capture *camera = opened(&wish, "stale");
        if (!camera) {
            return;
        }
        const series before = take(camera, 3, 2000);
        pause_ms(500); /* 30 frames at 60 a second: all four buffers are full */
        const capture_status status = capture_next(camera, 2000, &frame);
        capture_get_counts(camera, &counts);
        const uint64_t ahead = status == CAPTURE_OK ? frame.sequence - before.last_sequence : 0;
        if (newest) {
            check(counts.stale >= 1 && counts.stale <= 3 && ahead > counts.stale, "stale skipped",
                  "%u skipped, frame %u ahead", (unsigned)counts.stale, (unsigned)ahead);
        } else {
            check(counts.stale == 0 && ahead == 1 + frame.missed, "stale kept",
                  "%u skipped, frame %u ahead", (unsigned)counts.stale, (unsigned)ahead);
        }
        if (status == CAPTURE_OK) {
            (void)capture_give_back(camera, &frame);
        }
        const series after = take(camera, 10, 2000);
        check_in(after.frames == 10 && after.out_of_order == 0, "stale, then on",
                 newest ? "newest" : "next", "%u frames, %u wrong", after.frames,
                 after.out_of_order);
        capture_close(camera);
    }
}

static volatile sig_atomic_t alarms;

static void ring(int number)
{
    (void)number;
    alarms++;
}

/* Signals that end system calls early, three hundred a second. */
void group_signals(int count, char **arguments)
{
    const capture_wish wish = small_wish(arguments[0]);
    struct sigaction action = {.sa_handler = ring};
    const struct itimerval often = {{0, 3333}, {0, 3333}}, never = {{0, 0}, {0, 0}};
    (void)count;
    sigaction(SIGALRM, &action, NULL);
    setitimer(ITIMER_REAL, &often, NULL);
    capture *camera = opened(&wish, "signals");
    if (camera) {
        capture_counts counts;
        const series all = take(camera, 60, 2000);
        capture_get_counts(camera, &counts);
        check(all.frames == 60 && all.out_of_order == 0 && counts.timeouts == 0, "signals",
              "%u frames, %s, %d signals", all.frames, told(all.status, camera), (int)alarms);
        check(alarms > 0 && counts.interrupted > 0, "signals are counted", "%u",
              (unsigned)counts.interrupted);
        const uint64_t start = now_ms();
        capture_frame frame;
        (void)capture_stop(camera);
        check(capture_next(camera, 300, &frame) == CAPTURE_ERR_ORDER && now_ms() - start < 5000u,
              "signals and a stopped camera", "%s", told(CAPTURE_ERR_ORDER, camera));
    }
    setitimer(ITIMER_REAL, &never, NULL);
    capture_close(camera);
}

/* ---- Unplugged ----------------------------------------------------------------------------- */

static void check_gone_for_good(const char *device)
{
    const capture_wish wish = small_wish(device);
    capture *camera = opened(&wish, "unplugged");
    capture_frame frame;
    if (!camera) {
        return;
    }
    const series before = take(camera, 10, 2000);
    (void)knob_set(device, "Disconnect", 0);
    const series after = take(camera, 10, 2000);
    check(before.frames == 10 && after.status == CAPTURE_ERR_GONE, "unplugged is said",
          "%u frames, then %u, %s", before.frames, after.frames, told(after.status, camera));
    check(capture_next(camera, 100, &frame) == CAPTURE_ERR_GONE, "unplugged for good", "%s",
          told(CAPTURE_ERR_GONE, camera));
    capture_close(camera);
    camera = opened(&wish, "unplugged");
    if (camera) {
        const series again = take(camera, 5, 2000);
        check(again.frames == 5, "unplugged and opened anew", "%s", told(again.status, camera));
    }
    capture_close(camera);
}

/* unplugged DEVICE: the driver's own way, in which the device is back once all have closed it. */
void group_unplugged(int count, char **arguments)
{
    capture_wish wish = small_wish(arguments[0]);
    (void)count;
    check_gone_for_good(arguments[0]);
    wish.return_ms = 5000;
    capture *camera = opened(&wish, "unplugged");
    if (!camera) {
        return;
    }
    capture_counts counts;
    capture_settings before, after;
    capture_get_settings(camera, &before);
    (void)take(camera, 10, 2000);
    (void)knob_set(arguments[0], "Disconnect", 0);
    const series again = take(camera, 10, 5000);
    capture_get_counts(camera, &counts);
    capture_get_settings(camera, &after);
    check(again.frames == 10, "unplugged and back", "%u frames, %s", again.frames,
          told(again.status, camera));
    check(counts.reopens == 1 && counts.frames == 20, "unplugged is counted",
          "%u reopens, %u frames", (unsigned)counts.reopens, (unsigned)counts.frames);
    check(before.fourcc == after.fourcc && before.width == after.width &&
              before.rate_num == after.rate_num,
          "unplugged, same settings", "%ux%u, %u/%u", after.width, after.height, after.rate_num,
          after.rate_den);
    capture_close(camera);
}

static int write_name(const char *path, const char *name)
{
    const int file = open(path, O_WRONLY | O_CLOEXEC);
    const int good = file >= 0 && write(file, name, strlen(name)) == (ssize_t)strlen(name);
    if (file >= 0) {
        close(file);
    }
    return good;
}

#define DRIVER "/sys/bus/platform/drivers/vivid/"

/* A process that gives the driver its devices back, `ms` after it is told. It must not be a child
 * of one that has a camera open, or it would hold the old device. */
typedef struct returner {
    pid_t process;
    int tell;
} returner;

static returner prepare_return(unsigned ms)
{
    int ends[2] = {-1, -1};
    returner one = {-1, -1};
    char go;
    fflush(stdout);
    if (pipe(ends) == 0 && (one.process = fork()) == 0) {
        close(ends[1]);
        if (read(ends[0], &go, 1) == 1) {
            pause_ms(ms);
            _exit(write_name(DRIVER "bind", "vivid.0") ? 0 : 1);
        }
        _exit(2);
    }
    close(ends[0]);
    one.tell = ends[1];
    return one;
}

/* The driver lets go of its devices, and gets them back after a while. */
static int remove_devices(const returner *one)
{
    return write_name(DRIVER "unbind", "vivid.0") && write(one->tell, "g", 1) == 1;
}

static void end_return(const returner *one)
{
    close(one->tell);
    while (waitpid(one->process, NULL, 0) < 0 && errno == EINTR) {
    }
}

/* The driver begins anew with values of its own; rate and controls have to be set again. */
static void check_same(const char *what, const capture_settings *set)
{
    struct v4l2_fract interval = {0, 0};
    int brightness = -1;
    const int known = knob_interval(set->path, &interval) == 0 &&
                      knob_get(set->path, "Brightness", &brightness) == 0;
    check_in(known && interval.numerator * 60 == interval.denominator && brightness == 99,
             "removed, set as before", what, "1/%u s, brightness %d",
             interval.numerator > 0 ? interval.denominator / interval.numerator : 0, brightness);
}

/*
 * removed DEVICE WISHED: the node of DEVICE goes away under a stream and comes back 1.2 s later.
 * The camera was opened as WISHED, its path or its bus. By bus it is found under any path: somebody
 * else holds the old number, so that the new node gets another.
 */
void group_removed(int count, char **arguments)
{
    const int by_bus = arguments[1][0] != '/';
    const char *what = by_bus ? "by bus" : "by path";
    capture_wish wish = small_wish(arguments[1]);
    capture_counts counts;
    capture_settings set;
    (void)count;
    wish.return_ms = 10000;
    const returner helper = prepare_return(1200);
    capture *camera = opened(&wish, "removed");
    if (!camera) {
        end_return(&helper);
        return;
    }
    (void)capture_set(camera, V4L2_CID_BRIGHTNESS, 99, NULL);
    const int holder = by_bus ? open(arguments[0], O_RDWR | O_CLOEXEC) : -1;
    const series before = take(camera, 10, 2000);
    const int removed = remove_devices(&helper);
    struct stat about;
    const int node_gone = stat(arguments[0], &about) < 0 && errno == ENOENT;
    const uint64_t start = now_ms();
    const series after = take(camera, 10, 8000);
    const uint64_t waited = now_ms() - start;
    capture_get_counts(camera, &counts);
    capture_get_settings(camera, &set);
    end_return(&helper);
    check_in(removed && node_gone && before.frames == 10 && after.frames == 10 && waited > 1000,
             "removed and back", what, "%u frames, then %u after %u ms, %s", before.frames,
             after.frames, (unsigned)waited, told(after.status, camera));
    check_in(counts.reopens == 1 && (strcmp(set.path, arguments[0]) != 0) == by_bus,
             "removed, found", what, "%s, %u reopens", set.path, (unsigned)counts.reopens);
    check_same(what, &set);
    capture_close(camera);
    if (holder >= 0) {
        close(holder);
    }
}
