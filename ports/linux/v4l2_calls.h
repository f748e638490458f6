/*
 * Every system call of the V4L2 backend, as a table: a test program passes its own and replays any
 * device, well behaved or not. Each function answers like the call of its name: a result, or -1
 * (mmap: MAP_FAILED) with errno set. `user` is handed on unread.
 */
#ifndef V4L2_CALLS_H
#define V4L2_CALLS_H

#include <poll.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/stat.h>
#include <sys/types.h>

#ifdef __cplusplus
extern "C" {
#endif

struct v4l2_calls {
    void *user;
    int (*open)(void *user, const char *path, int flags);
    int (*close)(void *user, int fd);
    int (*stat)(void *user, const char *path, struct stat *status);
    int (*fstat)(void *user, int fd, struct stat *status);
    int (*ioctl)(void *user, int fd, unsigned long request, void *argument);
    void *(*mmap)(void *user, size_t length, int fd, off_t offset); /* shared, to read */
    int (*munmap)(void *user, void *address, size_t length);
    int (*poll)(void *user, struct pollfd *fds, nfds_t count, int timeout_ms);
    uint64_t (*now_us)(void *user); /* a clock that never goes back */
};

/* The system's own. */
const struct v4l2_calls *v4l2_system_calls(void);

#ifdef __cplusplus
}
#endif

#endif
