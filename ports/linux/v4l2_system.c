/* The system calls as they are, alone in this file so that a program can be linked without them. */
#include "v4l2_calls.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

static int system_open(void *user, const char *path, int flags)
{
    (void)user;
    return open(path, flags);
}

static int system_close(void *user, int fd)
{
    (void)user;
    return close(fd);
}

static int system_stat(void *user, const char *path, struct stat *status)
{
    (void)user;
    return stat(path, status);
}

static int system_fstat(void *user, int fd, struct stat *status)
{
    (void)user;
    return fstat(fd, status);
}

static int system_ioctl(void *user, int fd, unsigned long request, void *argument)
{
    (void)user;
#ifdef __GLIBC__
    return ioctl(fd, request, argument);
#else
    return ioctl(fd, (int)request, argument); /* as POSIX has it */
#endif
}

static void *system_mmap(void *user, size_t length, int fd, off_t offset)
{
    (void)user;
    return mmap(NULL, length, PROT_READ, MAP_SHARED, fd, offset);
}

static int system_munmap(void *user, void *address, size_t length)
{
    (void)user;
    return munmap(address, length);
}

static int system_poll(void *user, struct pollfd *fds, nfds_t count, int timeout_ms)
{
    (void)user;
    return poll(fds, count, timeout_ms);
}

static uint64_t system_now_us(void *user)
{
    struct timespec now = {0, 0};

    (void)user;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000u + (uint64_t)now.tv_nsec / 1000u;
}

const struct v4l2_calls *v4l2_system_calls(void)
{
    static const struct v4l2_calls calls = {
        NULL,         system_open, system_close,  system_stat, system_fstat,
        system_ioctl, system_mmap, system_munmap, system_poll, system_now_us,
    };

    return &calls;
}
