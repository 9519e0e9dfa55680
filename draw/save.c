/* save.c: a file appears whole or not at all: written beside its place, flushed, moved there. */
#define _XOPEN_SOURCE 700 /* realpath */
#include "output.h"
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static froe_status refuse(froe_diagnostic *diag, const char *path, const char *doing, int error) {
    if (error == ENOMEM) return draw_fail_memory(diag);
    return draw_fail(diag, FROE_E_IO, "Cannot %s '%.140s': %s.", doing, path, strerror(error));
}

/* 0 or the error number. */
static int write_all(int fd, const unsigned char *bytes, size_t count) {
    while (count) {
        ssize_t done = write(fd, bytes, count < INT_MAX ? count : INT_MAX);
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) return errno;
        bytes += done;
        count -= (size_t)done;
    }
    return 0;
}

static froe_status save_in_place(const char *path, const void *bytes, size_t count, froe_diagnostic *diag) {
    int fd = open(path, O_WRONLY | O_CLOEXEC);
    if (fd < 0) return refuse(diag, path, "open", errno);
    int error = write_all(fd, bytes, count);
    if (close(fd) != 0 && !error) error = errno;
    return error ? refuse(diag, path, "write", error) : FROE_OK;
}

/* A new file beside the old one, with the access that any new file here gets
 * (mkstemp would make it private). The name is tried until it is free. */
static int create_beside(char *name, size_t length, size_t room) {
    int fd = -1;
    for (unsigned attempt = 0; attempt < 1000 && fd < 0; attempt++) {
        snprintf(name + length, room - length, ".%ld-%u", (long)getpid(), attempt);
        fd = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd < 0 && errno != EEXIST) break;
    }
    return fd;
}

static froe_status save_beside(const char *path, const struct stat *old, char *name, size_t length, size_t room,
                               const void *bytes, size_t count, froe_diagnostic *diag) {
    int fd = create_beside(name, length, room);
    if (fd < 0) return refuse(diag, path, "create", errno);
    int error = write_all(fd, bytes, count);
    if (!error && old && fchmod(fd, old->st_mode & 07777) != 0) error = errno;
    if (!error && fsync(fd) != 0) error = errno;
    if (close(fd) != 0 && !error) error = errno;
    if (!error && rename(name, path) != 0) error = errno;
    if (error) unlink(name);
    return error ? refuse(diag, path, "write", error) : FROE_OK;
}

froe_status draw_save(const char *path, const void *bytes, size_t count, const froe_allocator *alloc,
                      froe_diagnostic *diag) {
    struct stat old;
    bool exists = stat(path, &old) == 0;
    if (!exists && errno != ENOENT) return refuse(diag, path, "write", errno);
    if (exists && S_ISDIR(old.st_mode)) return refuse(diag, path, "write", EISDIR);
    if (exists && !S_ISREG(old.st_mode)) return save_in_place(path, bytes, count, diag);
    /* A link stays a link: what it points to is replaced. */
    char *real = exists ? realpath(path, NULL) : NULL;
    const char *target = real ? real : path;
    size_t length = strlen(target), room = length + 40;
    char *name = draw_calloc(alloc, room, 1);
    froe_status status = FROE_E_MEMORY;
    if (name) {
        memcpy(name, target, length + 1);
        status = save_beside(target, exists ? &old : NULL, name, length, room, bytes, count, diag);
    } else
        draw_fail_memory(diag);
    draw_free(alloc, name, room);
    free(real);
    return status;
}
