#include "create.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "say.h"

static int refuse_kind(const char *path, const struct stat *about)
{
    if (S_ISLNK(about->st_mode)) {
        return say_error(path, "is a symbolic link, and those are not followed: write to the file "
                               "itself");
    }
    if (!S_ISREG(about->st_mode)) {
        return say_error(path, "is no regular file; '-' writes to standard output");
    }
    if (about->st_nlink > 1) {
        return say_error(path, "has a second name (hard link); remove it, or write to another");
    }
    return 0;
}

int create_check(const char *path, int force)
{
    struct stat about;
    if (lstat(path, &about) != 0) {
        return 0; /* not there, or what creating it will say */
    }
    if (!force) {
        return say_error(path, "exists already; --force overwrites it");
    }
    return refuse_kind(path, &about);
}

/* O_NONBLOCK: a pipe without a reader must not hold the program up. */
static int open_existing(const char *path)
{
    struct stat about;
    const int file = open(path, O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    if (file < 0) {
        return errno == ELOOP ? create_check(path, 1)
                              : say_error(path, "cannot write: %s", strerror(errno));
    }
    if (fstat(file, &about) != 0 || refuse_kind(path, &about) || ftruncate(file, 0) != 0) {
        close(file);
        return -1;
    }
    return file;
}

FILE *create_file(const char *path, int force)
{
    const mode_t mode = S_IRUSR | S_IWUSR | S_IRGRP | S_IROTH;
    int file = open(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
    if (file < 0 && errno == EEXIST) {
        if (create_check(path, force)) {
            return NULL;
        }
        file = open_existing(path);
        if (file < 0) {
            return NULL;
        }
    } else if (file < 0) {
        say_error(path, "cannot create: %s", strerror(errno));
        return NULL;
    }
    FILE *stream = fdopen(file, "wb");
    if (!stream) {
        say_error(path, "cannot write: %s", strerror(errno));
        close(file);
    }
    return stream;
}
