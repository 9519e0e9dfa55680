/* faults.c: __wrap_NAME() takes the place of NAME(), which it reaches as __real_NAME(). */
#include "faults.h"
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

fault_plan faults = {.log = -1};
static uint64_t outputs, folders; /* descriptors below 64 that belong to an output */

static void read_environment(void) __attribute__((constructor));
static void read_environment(void) {
    const char *plan = getenv("FROE_FAULT"), *log = getenv("FROE_FAULT_LOG");
    int kind = 0;
    if (plan && sscanf(plan, "%u %d", &faults.at, &kind) == 2) faults.kind = (fault_kind)kind;
    if (log) faults.log = atoi(log);
}

/* Counts a call; true when it shall fail, with errno. */
static bool fails(const char *name) {
    unsigned number = ++faults.calls;
    if (number <= sizeof faults.names / sizeof *faults.names) faults.names[number - 1] = name;
    if (faults.log >= 0) dprintf(faults.log, "%s\n", name);
    bool now = faults.at && (number == faults.at || (faults.kind == FAULT_FOREVER && number > faults.at));
    if (!now) return false;
    if (faults.kind == FAULT_KILL) raise(SIGKILL);
    if (faults.kind == FAULT_INTERRUPT) raise(SIGINT);
    if (faults.kind == FAULT_TERMINATE) raise(SIGTERM);
    if (faults.kind == FAULT_SHORT || faults.kind >= FAULT_INTERRUPT) return false;
    errno = faults.kind == FAULT_ENOSPC ? ENOSPC : faults.kind == FAULT_EINTR ? EINTR : EIO;
    return true;
}

static uint64_t bit(int file) {
    return file >= 0 && file < 64 ? (uint64_t)1 << file : 0;
}

int __real_open(const char *path, int flags, ...);
int __wrap_open(const char *path, int flags, ...);
int __wrap_open(const char *path, int flags, ...) {
    va_list args;
    va_start(args, flags);
    mode_t mode = flags & O_CREAT ? va_arg(args, mode_t) : 0;
    va_end(args);
    bool folder = flags & O_DIRECTORY, output = flags & O_WRONLY;
    if ((folder || output) && fails(folder ? "open folder" : "open")) return -1;
    int file = __real_open(path, flags, mode);
    if (output) outputs |= bit(file);
    if (folder) folders |= bit(file);
    return file;
}

ssize_t __real_write(int file, const void *bytes, size_t count);
ssize_t __wrap_write(int file, const void *bytes, size_t count);
ssize_t __wrap_write(int file, const void *bytes, size_t count) {
    if (!(outputs & bit(file))) return __real_write(file, bytes, count);
    if (fails("write")) return -1;
    bool cut = faults.kind == FAULT_SHORT && faults.calls == faults.at && count > 1;
    return __real_write(file, bytes, cut ? 1 : count);
}

int __real_fsync(int file);
int __wrap_fsync(int file);
int __wrap_fsync(int file) {
    return fails(folders & bit(file) ? "fsync folder" : "fsync") ? -1 : __real_fsync(file);
}

int __real_fchmod(int file, mode_t mode);
int __wrap_fchmod(int file, mode_t mode);
int __wrap_fchmod(int file, mode_t mode) {
    return fails("fchmod") ? -1 : __real_fchmod(file, mode);
}

int __real_rename(const char *from, const char *to);
int __wrap_rename(const char *from, const char *to);
int __wrap_rename(const char *from, const char *to) {
    return fails("rename") ? -1 : __real_rename(from, to);
}

int __real_unlink(const char *path);
int __wrap_unlink(const char *path);
int __wrap_unlink(const char *path) {
    return fails("unlink") ? -1 : __real_unlink(path);
}

ssize_t __real_readlink(const char *path, char *target, size_t size);
ssize_t __wrap_readlink(const char *path, char *target, size_t size);
ssize_t __wrap_readlink(const char *path, char *target, size_t size) {
    return fails("readlink") ? -1 : __real_readlink(path, target, size);
}

/* A descriptor is closed by a close() that fails, too. */
int __real_close(int file);
int __wrap_close(int file);
int __wrap_close(int file) {
    bool folder = folders & bit(file), ours = folder || (outputs & bit(file));
    folders &= ~bit(file), outputs &= ~bit(file);
    bool failed = ours && fails(folder ? "close folder" : "close");
    int error = errno, result = __real_close(file);
    if (failed) errno = error;
    return failed ? -1 : result;
}

int __real_getentropy(void *bytes, size_t count);
int __wrap_getentropy(void *bytes, size_t count);
int __wrap_getentropy(void *bytes, size_t count) {
    if (!faults.zeros) return __real_getentropy(bytes, count);
    faults.zeros--;
    memset(bytes, 0, count);
    return 0;
}
