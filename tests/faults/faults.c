/* faults.c: __wrap_NAME() takes the place of NAME(), which it reaches as __real_NAME(). */
#include "faults.h"
#include "power.h"
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

fault_plan faults = {.log = -1}, fault_reads = {.log = -1};
static uint64_t outputs, folders; /* descriptors below 64 that belong to an output */

void fault_plan_read(fault_plan *plan, const char *variable) {
    const char *text = getenv(variable);
    int kind = 0;
    if (text && sscanf(text, "%u %d", &plan->at, &kind) == 2) plan->kind = (fault_kind)kind;
}

static void read_environment(void) __attribute__((constructor));
static void read_environment(void) {
    const char *log = getenv("FROE_FAULT_LOG");
    fault_plan_read(&faults, "FROE_FAULT");
    if (log) faults.log = atoi(log);
}

static bool is_power(const fault_plan *plan) {
    return plan->kind == FAULT_POWER || plan->kind == FAULT_POWER_BACK;
}

static bool needs_room(const char *name) {
    return !strcmp(name, "open") || !strcmp(name, "write") || !strcmp(name, "fsync");
}

bool fault_meets(fault_plan *plan, const char *name) {
    unsigned number = ++plan->calls;
    if (number <= sizeof plan->names / sizeof *plan->names) plan->names[number - 1] = name;
    if (plan->log >= 0) dprintf(plan->log, "%s\n", name);
    const bool lasts = plan->kind == FAULT_FOREVER || plan->kind == FAULT_FULL;
    bool now = plan->at && (number == plan->at || (lasts && number > plan->at));
    if (!now) return false;
    if (is_power(plan)) power_lose(plan->kind == FAULT_POWER_BACK);
    if (plan->kind == FAULT_KILL || is_power(plan)) raise(SIGKILL);
    if (plan->kind == FAULT_INTERRUPT) raise(SIGINT);
    if (plan->kind == FAULT_TERMINATE) raise(SIGTERM);
    if (plan->kind == FAULT_FULL) return errno = ENOSPC, needs_room(name);
    if (plan->kind == FAULT_SHORT || plan->kind >= FAULT_INTERRUPT) return false;
    errno = plan->kind == FAULT_ENOSPC ? ENOSPC : plan->kind == FAULT_EINTR ? EINTR : EIO;
    return true;
}

bool fault_reading_fails(const char *name) {
    return fault_meets(&fault_reads, name) && fault_reads.kind != FAULT_EINTR;
}

static bool fails(const char *name) {
    return fault_meets(&faults, name);
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
    if (!output && !folder && fault_reading_fails("open")) return -1;
    int file = __real_open(path, flags, mode);
    if (output) outputs |= bit(file);
    if (output && file >= 0 && is_power(&faults)) power_wrote(file);
    if (folder) folders |= bit(file);
    return file;
}

ssize_t __real_write(int file, const void *bytes, size_t count);
ssize_t __wrap_write(int file, const void *bytes, size_t count);
ssize_t __wrap_write(int file, const void *bytes, size_t count) {
    if (!(outputs & bit(file))) return __real_write(file, bytes, count);
    if (fails("write")) return -1;
    if (is_power(&faults)) power_wrote(file);
    bool cut = faults.kind == FAULT_SHORT && faults.calls == faults.at && count > 1;
    return __real_write(file, bytes, cut ? 1 : count);
}

/* What is on the disk is what power.h says, so the disk itself is not waited for. */
int __wrap_fsync(int file);
int __wrap_fsync(int file) {
    if (fails(folders & bit(file) ? "fsync folder" : "fsync")) return -1;
    if (is_power(&faults)) power_synced(file);
    return 0;
}

int __real_fchmod(int file, mode_t mode);
int __wrap_fchmod(int file, mode_t mode);
int __wrap_fchmod(int file, mode_t mode) {
    return fails("fchmod") ? -1 : __real_fchmod(file, mode);
}

int __real_rename(const char *from, const char *to);
int __wrap_rename(const char *from, const char *to);
int __wrap_rename(const char *from, const char *to) {
    if (fails("rename")) return -1;
    if (is_power(&faults)) power_renames(to);
    const int result = __real_rename(from, to);
    if (!result && is_power(&faults)) power_renamed(from, to);
    return result;
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
