/* Nodes, handles, memory, faults and the clock. */
#include "replay.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/sysmacros.h>

enum { FIRST_FD = 1000 };

int replay_errno(int error)
{
    errno = error;
    return -1;
}

uint32_t replay_random(replay *world)
{
    world->random += UINT64_C(0x9E3779B97F4A7C15);
    uint64_t mixed = world->random;
    mixed = (mixed ^ (mixed >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    mixed = (mixed ^ (mixed >> 27)) * UINT64_C(0x94D049BB133111EB);
    return (uint32_t)(mixed >> 32);
}

int replay_chance(replay *world, unsigned per_mille)
{
    return per_mille > 0 && replay_random(world) % 1000 < per_mille;
}

static void misuse(replay *world, const char *what)
{
    printf("misuse: %s\n", what);
    world->misuse++;
}

void replay_fail(replay *world, unsigned long call, unsigned skip, unsigned times, int error)
{
    replay_fault *const fault = &world->faults[world->fault_count++ % REPLAY_FAULTS];

    fault->call = call;
    fault->skip = skip;
    fault->times = times;
    fault->error = error;
}

/* What may go wrong with a call at random: errors that drivers give. */
static int random_error(replay *world, unsigned long call)
{
    static const int errors[] = {EIO, EIO, EINVAL, EBUSY, ENOMEM, ENOSPC, EAGAIN, ENODEV};

    if (call == VIDIOC_DQBUF) {
        return replay_chance(world, 500) ? EIO : EAGAIN;
    }
    return errors[replay_random(world) % (sizeof errors / sizeof errors[0])];
}

/* The errno with which this call is to fail now; 0: not. */
static int fault_now(replay *world, unsigned long call)
{
    world->now_us += world->cost_us;
    world->last_call = call;
    for (unsigned i = 0; i < REPLAY_FAULTS; i++) {
        replay_fault *const fault = &world->faults[i];

        if (fault->call == call && fault->times > 0) {
            if (fault->skip > 0) {
                fault->skip--;
                continue;
            }
            fault->times--;
            world->counts.interrupted += fault->error == EINTR;
            return fault->error;
        }
    }
    if (call != REPLAY_STAT && call != REPLAY_FSTAT && call != REPLAY_MMAP &&
        replay_chance(world, world->interrupt)) {
        world->counts.interrupted++;
        return EINTR;
    }
    if (call != REPLAY_POLL && replay_chance(world, world->fail)) {
        return random_error(world, call);
    }
    return 0;
}

/* ---- Plugging ------------------------------------------------------------------------------ */

void replay_unplug(replay *world, replay_node *node)
{
    node->present = 0;
    node->instance++;
    node->streaming = 0;
    node->unplug_after = 0;
    node->back_us = node->back_after_us ? world->now_us + node->back_after_us : 0;
    replay_drop_buffers(world, node);
}

static void plug_back(replay *world)
{
    for (unsigned i = 0; i < REPLAY_NODES; i++) {
        replay_node *const node = &world->nodes[i];

        if (!node->present && node->back_us > 0 && world->now_us >= node->back_us) {
            node->present = 1;
            node->number = node->back_number;
            node->card = node->back_card ? node->back_card : node->card;
            node->force_width = node->back_force_width ? node->back_force_width : node->force_width;
            node->format_set = 0;
            node->taken = 0;
            node->stalled = node->broken = 0;
            node->back_us = 0;
            for (unsigned k = 0; k < node->control_count; k++) {
                node->controls[k].value = node->controls[k].initial;
            }
        }
    }
}

static replay_node *find_node(replay *world, const char *path)
{
    plug_back(world);
    for (unsigned i = 0; i < REPLAY_NODES; i++) {
        char name[32];

        snprintf(name, sizeof name, "/dev/video%u", world->nodes[i].number);
        if (world->nodes[i].present && strcmp(name, path) == 0) {
            return &world->nodes[i];
        }
    }
    return NULL;
}

static void describe_node(const replay_node *node, struct stat *status)
{
    memset(status, 0, sizeof *status);
    status->st_mode = node->not_a_device ? S_IFREG : S_IFCHR;
    status->st_rdev = makedev(node->device_major, node->number);
}

/* ---- Files --------------------------------------------------------------------------------- */

static int call_stat(void *user, const char *path, struct stat *status)
{
    replay *const world = (replay *)user;
    const int error = fault_now(world, REPLAY_STAT);
    const replay_node *const node = find_node(world, path);

    if (error) {
        return replay_errno(error);
    }
    if (!node) {
        return replay_errno(ENOENT);
    }
    describe_node(node, status);
    return 0;
}

static int call_open(void *user, const char *path, int flags)
{
    replay *const world = (replay *)user;
    const int error = fault_now(world, REPLAY_OPEN);
    const replay_node *const node = find_node(world, path);

    world->last_open_flags = flags;
    if (error) {
        return replay_errno(error);
    }
    if (!node) {
        return replay_errno(ENOENT);
    }
    if (node->open_error) {
        return replay_errno(node->open_error);
    }
    for (int i = 0; i < REPLAY_HANDLES; i++) {
        if (!world->handles[i].used) {
            world->handles[i].used = 1;
            world->handles[i].node = (int)(node - world->nodes);
            world->handles[i].instance = node->instance;
            world->handles[i].streamed = 0;
            return FIRST_FD + i;
        }
    }
    misuse(world, "more handles than anybody needs");
    return replay_errno(EMFILE);
}

static int handle_of(replay *world, int fd, const char *what)
{
    const int handle = fd - FIRST_FD;

    if (handle < 0 || handle >= REPLAY_HANDLES || !world->handles[handle].used) {
        misuse(world, what);
        return -1;
    }
    return handle;
}

static int is_alive(const replay *world, int handle)
{
    const replay_node *const node = &world->nodes[world->handles[handle].node];

    return node->present && node->instance == world->handles[handle].instance;
}

static int call_fstat(void *user, int fd, struct stat *status)
{
    replay *const world = (replay *)user;
    const int error = fault_now(world, REPLAY_FSTAT);
    const int handle = handle_of(world, fd, "fstat of a descriptor that is not open");

    if (error || handle < 0) {
        return replay_errno(error ? error : EBADF);
    }
    describe_node(&world->nodes[world->handles[handle].node], status);
    return 0;
}

static int call_close(void *user, int fd)
{
    replay *const world = (replay *)user;
    const int handle = handle_of(world, fd, "close of a descriptor that is not open");

    if (handle < 0) {
        return replay_errno(EBADF);
    }
    if (is_alive(world, handle) && world->nodes[world->handles[handle].node].owner == handle) {
        replay_drop_buffers(world, &world->nodes[world->handles[handle].node]);
    }
    world->handles[handle].used = 0;
    return 0;
}

static int call_ioctl(void *user, int fd, unsigned long request, void *argument)
{
    replay *const world = (replay *)user;
    const int error = fault_now(world, request);
    const int handle = handle_of(world, fd, "ioctl on a descriptor that is not open");
    replay_node *node;

    if (handle < 0) {
        return replay_errno(EBADF);
    }
    node = &world->nodes[world->handles[handle].node];
    replay_advance(world, node);
    if (!is_alive(world, handle)) {
        world->counts.interrupted -= error == EINTR;
        return replay_errno(ENODEV);
    }
    if (error == ENODEV) { /* who says that is away */
        replay_unplug(world, node);
    }
    if (error) {
        return replay_errno(error);
    }
    if (replay_ioctl_format(world, node, request, argument) == 0 ||
        (errno == ENOTTY && replay_ioctl_control(node, request, argument) == 0)) {
        return 0;
    }
    return errno == ENOTTY ? replay_ioctl_queue(world, handle, request, argument) : -1;
}

/* ---- Memory -------------------------------------------------------------------------------- */

void replay_release(replay *world, int memory)
{
    replay_memory *const piece = &world->memories[memory];

    if (!piece->owned && !piece->mapped) {
        free(piece->bytes);
        memset(piece, 0, sizeof *piece);
    }
}

static void *call_mmap(void *user, size_t length, int fd, off_t offset)
{
    replay *const world = (replay *)user;
    const int error = fault_now(world, REPLAY_MMAP);
    const int handle = handle_of(world, fd, "mmap of a descriptor that is not open");
    const replay_node *node;

    if (error || handle < 0 || !is_alive(world, handle)) {
        errno = error ? error : ENODEV;
        return MAP_FAILED;
    }
    node = &world->nodes[world->handles[handle].node];
    for (unsigned i = 0; i < node->buffer_count; i++) {
        replay_memory *const piece = &world->memories[node->buffers[i].memory];

        if (offset == (off_t)i * 1048576 && length == piece->length) {
            if (piece->mapped) {
                misuse(world, "a buffer is mapped twice");
            }
            piece->mapped = 1;
            return piece->bytes;
        }
    }
    misuse(world, "mmap of what is no buffer");
    errno = EINVAL;
    return MAP_FAILED;
}

static int call_munmap(void *user, void *address, size_t length)
{
    replay *const world = (replay *)user;

    for (int i = 0; i < REPLAY_MEMORIES; i++) {
        replay_memory *const piece = &world->memories[i];

        if (piece->mapped && piece->bytes == address && piece->length == length) {
            piece->mapped = 0;
            replay_release(world, i);
            return 0;
        }
    }
    misuse(world, "munmap of what is not mapped");
    return replay_errno(EINVAL);
}

/* ---- Time ---------------------------------------------------------------------------------- */

static short events_of(replay *world, int handle)
{
    replay_node *const node = &world->nodes[world->handles[handle].node];

    if (!is_alive(world, handle)) {
        return POLLERR | POLLHUP;
    }
    replay_advance(world, node);
    if (node->broken || !node->streaming || node->owner != handle) {
        return POLLERR;
    }
    if (node->filled_count > 0 || node->spurious) {
        return POLLIN;
    }
    return node->waiting_count == 0 ? POLLERR : 0;
}

/* Time passes until there is something or the wait is over. */
static int call_poll(void *user, struct pollfd *fds, nfds_t count, int timeout_ms)
{
    replay *const world = (replay *)user;
    const int error = fault_now(world, REPLAY_POLL);
    const uint64_t end_us = world->now_us + (uint64_t)(timeout_ms > 0 ? timeout_ms : 0) * 1000;
    int handle = -1;

    if (timeout_ms < 0) {
        misuse(world, "a wait without end");
        return replay_errno(EINVAL);
    }
    if (count > 0) {
        handle = handle_of(world, fds[0].fd, "poll of a descriptor that is not open");
        fds[0].revents = 0;
    }
    if (error) {
        const uint64_t third_us = (end_us - world->now_us) / 3;

        world->now_us += third_us < 5000 ? third_us : 5000;
        return replay_errno(error);
    }
    for (;;) {
        plug_back(world);
        if (handle >= 0 && (fds[0].revents = events_of(world, handle)) != 0) {
            return 1;
        }
        if (world->now_us >= end_us) {
            return 0;
        }
        world->now_us += end_us - world->now_us < 1000 ? end_us - world->now_us : 1000;
    }
}

static uint64_t call_now(void *user)
{
    const replay *const world = (const replay *)user;

    return world->now_us;
}

/* ---- The world ----------------------------------------------------------------------------- */

static unsigned count_where(const replay *world, int mapped)
{
    unsigned count = 0;

    for (unsigned i = 0; i < REPLAY_MEMORIES; i++) {
        count += mapped ? world->memories[i].mapped != 0 : world->memories[i].owned != 0;
    }
    return count;
}

unsigned replay_map_count(const replay *world)
{
    return count_where(world, 1);
}

unsigned replay_buffer_count(const replay *world)
{
    return count_where(world, 0);
}

unsigned replay_open_count(const replay *world)
{
    unsigned count = 0;

    for (unsigned i = 0; i < REPLAY_HANDLES; i++) {
        count += world->handles[i].used != 0;
    }
    return count;
}

unsigned replay_queued_count(const replay *world)
{
    unsigned count = 0;

    for (unsigned i = 0; i < REPLAY_NODES; i++) {
        count += world->nodes[i].waiting_count + world->nodes[i].filled_count;
    }
    return count;
}

static void add_control(replay_node *node, uint32_t id, uint32_t type, const char *name,
                        int32_t max)
{
    replay_control *const control = &node->controls[node->control_count++];

    memset(control, 0, sizeof *control);
    control->id = id;
    control->type = type;
    snprintf(control->name, sizeof control->name, "%s", name);
    control->max = max;
    control->step = 1;
    control->initial = control->value = max / 2;
}

replay_node *replay_add_camera(replay *world, unsigned number_of_node, unsigned number,
                               const char *card, const char *bus)
{
    static const replay_mode modes[3] = {
        {V4L2_PIX_FMT_YUYV, 32, 24, 30},
        {V4L2_PIX_FMT_YUYV, 16, 8, 30},
        {V4L2_PIX_FMT_MJPEG, 64, 48, 60},
    };
    replay_node *const node = &world->nodes[number_of_node];

    memset(node, 0, sizeof *node);
    node->present = 1;
    node->number = node->back_number = number;
    node->device_major = 81;
    node->caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
    node->driver = "replay";
    node->card = card;
    node->bus = bus;
    memcpy(node->modes, modes, sizeof modes);
    node->mode_count = 3;
    node->owner = -1;
    node->first_time_us = 1000000;
    add_control(node, V4L2_CID_GAIN, V4L2_CTRL_TYPE_INTEGER, "Gain", 100);
    add_control(node, V4L2_CID_POWER_LINE_FREQUENCY, V4L2_CTRL_TYPE_MENU, "Power Line", 2);
    node->controls[1].menu[0] = "Disabled";
    node->controls[1].menu[1] = "50 Hz";
    node->controls[1].menu[2] = "60 Hz";
    add_control(node, V4L2_CID_EXPOSURE_ABSOLUTE, V4L2_CTRL_TYPE_INTEGER, "Exposure", 5000);
    return node;
}

void replay_init(replay *world)
{
    const struct v4l2_calls calls = {
        world,      call_open, call_close,  call_stat, call_fstat,
        call_ioctl, call_mmap, call_munmap, call_poll, call_now,
    };

    memset(world, 0, sizeof *world);
    world->calls = calls;
    world->now_us = 5000000;
    world->cost_us = 3;
    world->next_id = 1;
    replay_add_camera(world, 0, 0, "Replayed Camera", "usb-replay-1");
}

void replay_free(replay *world)
{
    for (int i = 0; i < REPLAY_MEMORIES; i++) {
        world->memories[i].owned = world->memories[i].mapped = 0;
        replay_release(world, i);
    }
}
