/* draft.c: a folder that appears whole or not at all.
 *
 *     fill PARENT/.NAME.building  ->  exchange it with PARENT/NAME, in one step  ->  remove the old one
 *
 * The draft is locked as long as its program lives. One without a lock was left by a program that was killed, and is
 * emptied and used again. The old folder is locked before it gets the name of the draft, so that nobody takes it for
 * one while it is removed. A lock is of a folder and not of its name: who has got one looks whether the name still
 * means that folder. What has come to its place is locked no more. Where the file system has no locks, a draft belongs
 * to the program that has made it, and one that is there already is refused. Where the system cannot exchange two
 * folders, the old one is moved aside before the new one takes its place; a kill between these two steps leaves the
 * old one as .NAME.building. */
#define _GNU_SOURCE 1 /* renameat2, realpath */
#include "manifest.h"
#include "support/fail.h"
#include "support/floats.h"
#include "support/writer.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { MORE_NAME = 16 };

struct froe_shard_draft {
    char target[PATH_MAX];             /* where the new folder is to be, behind all links */
    char folder[PATH_MAX + MORE_NAME]; /* the draft */
    int lock;                          /* a descriptor of it; -1: it is in its place */
    int old;                           /* of what was there; -1: there was nothing */
    froe_allocator alloc;
};

/* ------------------------------------------------------------------ folders -- */

/* May a folder of shards have a file of this name? */
static bool is_own_name(const char *name) {
    unsigned number;
    char again[32];
    if (!strcmp(name, SHARDS_MANIFEST)) return true;
    if (sscanf(name, "shard-%u.froe", &number) != 1) return false;
    snprintf(again, sizeof again, "shard-%04u.froe", number);
    return !strcmp(name, again);
}

/* Is this nothing but a folder of shards, or empty? `other`: the name of something else in it. */
static bool is_own_folder(const char *path, char other[NAME_MAX + 1]) {
    DIR *folder = opendir(path);
    bool own = folder != NULL;
    *other = '\0';
    for (struct dirent *entry; own && (entry = readdir(folder));) {
        if (!strcmp(entry->d_name, ".") || !strcmp(entry->d_name, "..")) continue;
        struct stat info;
        own = is_own_name(entry->d_name) || !strncmp(entry->d_name, ".froe-", 6);
        if (own && !fstatat(dirfd(folder), entry->d_name, &info, AT_SYMLINK_NOFOLLOW)) /* or it went away meanwhile */
            own = !S_ISDIR(info.st_mode);
        if (!own) snprintf(other, NAME_MAX + 1, "%s", entry->d_name);
    }
    if (folder) closedir(folder);
    return own;
}

/* Removes the files of a folder, all of which are its own. */
static void empty_folder(const char *path) {
    DIR *folder = opendir(path);
    for (struct dirent *entry; folder && (entry = readdir(folder));)
        if (is_own_name(entry->d_name) || !strncmp(entry->d_name, ".froe-", 6))
            unlinkat(dirfd(folder), entry->d_name, 0);
    if (folder) closedir(folder);
}

/* Is it the name of a shard of this part? */
static bool is_of_part(const char *name, uint32_t part, uint32_t parts) {
    unsigned number;
    return is_own_name(name) && sscanf(name, "shard-%u", &number) == 1 && number % parts == part;
}

void froe_shard_draft_clear(const char *path, uint32_t part, uint32_t parts) {
    SUPPORT_FLOATS_OWN;
    DIR *folder = path && parts ? opendir(path) : NULL;
    for (struct dirent *entry; folder && (entry = readdir(folder));)
        if (is_of_part(entry->d_name, part, parts)) unlinkat(dirfd(folder), entry->d_name, 0);
    if (folder) closedir(folder);
}

/* Waits until a file is on the disk; returns an errno. */
static int sync_file(int folder, const char *name) {
    const int file = openat(folder, name, O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
    int error = file < 0 ? errno : 0;
    while (!error && fsync(file)) error = errno == EINTR ? 0 : errno;
    if (file >= 0) close(file);
    return error == EINVAL || error == EROFS || error == ENOTSUP ? 0
                                                                 : error; /* a system that has nothing to wait for */
}

froe_status froe_shard_draft_sync(const char *path, uint32_t part, uint32_t parts, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!path || !parts) return support_fail_null(diag, __func__);
    DIR *folder = opendir(path);
    int error = folder ? 0 : errno;
    for (struct dirent *entry; !error && (entry = readdir(folder));)
        if (is_of_part(entry->d_name, part, parts)) error = sync_file(dirfd(folder), entry->d_name);
    if (folder) closedir(folder);
    return error ? support_fail_file(diag, "written", path, error) : FROE_OK;
}

static void sync_folder(const char *path) {
    const int folder = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return;
    (void)fsync(folder);
    close(folder);
}

/* -------------------------------------------------------------------- begin -- */

/* Finds where the new folder is to be, behind all links. Returns an errno. */
static int find_target(froe_shard_draft *d, const char *path) {
    char given[PATH_MAX];
    size_t length = strlen(path);
    while (length > 1 && path[length - 1] == '/') length--;
    if (!length || length >= sizeof given) return length ? ENAMETOOLONG : ENOENT;
    memcpy(given, path, length);
    given[length] = '\0';
    if (realpath(given, d->target)) return 0;
    if (errno != ENOENT) return errno;
    char *slash = strrchr(given, '/');
    const char *name = slash ? slash + 1 : given, *parent = !slash ? "." : slash == given ? "/" : given;
    if (!strcmp(name, "..") || !strcmp(name, ".")) return ENOENT;
    if (slash) *slash = '\0';
    if (!realpath(parent, d->target)) return errno;
    length = strlen(d->target);
    if (strlen(name) > NAME_MAX || length + strlen(name) + 2 > sizeof d->target) return ENAMETOOLONG;
    if (length > 1) d->target[length++] = '/';
    memcpy(d->target + length, name, strlen(name) + 1);
    return 0;
}

/* Is something at the place of the new folder? It may be a link to nothing. */
static bool is_taken(const froe_shard_draft *d) {
    struct stat info;
    return !lstat(d->target, &info);
}

/* May what is at the place of the new folder, if there is something, be replaced? `path` is for messages. */
static froe_status check_target(const froe_shard_draft *d, const char *path, froe_diagnostic *diag) {
    char other[NAME_MAX + 1] = "";
    if (!is_taken(d)) return FROE_OK;
    if (access(d->target, R_OK) && errno == EACCES) return support_fail_file(diag, "written", path, EACCES);
    if (is_own_folder(d->target, other)) /* who may not write it may not remove its files either */
        return access(d->target, W_OK | X_OK) ? support_fail_file(diag, "written", path, errno) : FROE_OK;
    return *other ? support_fail(diag, FROE_E_IO, "%s: The folder is not replaced, because it holds '%.60s'.",
                                 support_short(path), other)
                  : support_fail(diag, FROE_E_IO, "%s: What is there is no folder, and is not replaced.",
                                 support_short(path));
}

/* Is this folder still the one of that name? */
static bool is_at(int folder, const char *path) {
    struct stat one, other;
    return !fstat(folder, &one) && !lstat(path, &other) && one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

/* Makes the draft, or takes over one that a killed program left. Returns an errno; EWOULDBLOCK: it is in use,
 * ENOTEMPTY: it holds what no program of froe left there, ENOLCK: the file system has no locks, and one is there. */
static int make_draft(froe_shard_draft *d) {
    const char *slash = strrchr(d->target, '/');
    snprintf(d->folder, sizeof d->folder, "%.*s.%s.building", (int)(slash + 1 - d->target), d->target, slash + 1);
    while (true) {
        const bool made = !mkdir(d->folder, 0777);
        if (!made && errno != EEXIST) return errno;
        d->lock = open(d->folder, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
        if (d->lock < 0 && errno != ENOENT) return errno;
        if (d->lock < 0) continue; /* another program has just ended */
        const int error = flock(d->lock, LOCK_EX | LOCK_NB) ? errno : 0;
        if (error && !(support_no_locks(error) && made)) return support_no_locks(error) ? ENOLCK : error;
        if (is_at(d->lock, d->folder)) break;
        close(d->lock); /* it was brought to its place, or removed */
        d->lock = -1;
    }
    char other[NAME_MAX + 1];
    if (!is_own_folder(d->folder, other)) return ENOTEMPTY;
    empty_folder(d->folder);
    return 0;
}

froe_status froe_shard_draft_begin(const char *path, const froe_allocator *alloc, froe_shard_draft **out,
                                   froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!path || !out) return support_fail_null(diag, __func__);
    const froe_allocator own = support_allocator(alloc);
    froe_shard_draft *d = support_calloc(&own, 1, sizeof *d);
    if (!d) return support_fail_memory(diag);
    d->alloc = own;
    d->lock = d->old = -1;
    int error = find_target(d, path);
    froe_status status = error ? FROE_OK : check_target(d, path, diag);
    if (!error && !status) error = make_draft(d);
    if (error == EWOULDBLOCK)
        status = support_fail(diag, FROE_E_IO, "%s: Another program is building this folder.", support_short(path));
    else if (error == ENOLCK)
        status =
            support_fail(diag, FROE_E_IO,
                         "%s: Its draft beside it, whose name ends in .building, may be in use, as the file system "
                         "has no locks. Remove it if no program builds the folder.",
                         support_short(path));
    else if (error)
        status = support_fail_file(diag, "written", path, error);
    if (!status) {
        *out = d;
        return FROE_OK;
    }
    if (d->lock >= 0) close(d->lock);
    support_free(&own, d, sizeof *d);
    return status;
}

const char *froe_shard_draft_folder(const froe_shard_draft *d) {
    return d ? d->folder : NULL;
}

/* ---------------------------------------------------------------------- end -- */

/* The draft is at the place of the target, and what was there, if anything, at its own. Returns an errno. */
static int exchange(const froe_shard_draft *d) {
    if (!is_taken(d)) return rename(d->folder, d->target) ? errno : 0;
#ifdef RENAME_EXCHANGE
    if (!renameat2(AT_FDCWD, d->folder, AT_FDCWD, d->target, RENAME_EXCHANGE)) return 0;
    if (errno != ENOSYS && errno != EINVAL) return errno;
#endif
    char aside[sizeof d->folder + 4];
    snprintf(aside, sizeof aside, "%s.old", d->folder);
    if (rename(d->target, aside)) return errno;
    if (!rename(d->folder, d->target)) return rename(aside, d->folder) ? errno : 0;
    const int error = errno;
    (void)rename(aside, d->target);
    return error;
}

/* The process that holds a lock on a folder, as the system tells it; 0: it does not. */
static long holder_of(int folder) {
    struct stat info;
    FILE *locks = fstat(folder, &info) ? NULL : fopen("/proc/locks", "r");
    char line[256];
    long found = 0, process;
    for (unsigned long long number; locks && !found && fgets(line, sizeof line, locks);)
        if (sscanf(line, "%*s FLOCK %*s %*s %ld %*x:%*x:%llu", &process, &number) == 2 && number == info.st_ino)
            found = process;
    if (locks) fclose(locks);
    return found;
}

/* Locks what is at the place of the new folder. Its builder may be about to end, so a short time is waited. */
static froe_status lock_old(froe_shard_draft *d, froe_diagnostic *diag) {
    enum { TRIES = 200 };
    const struct timespec pause = {.tv_nsec = 10000000};
    d->old = open(d->target, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    for (int i = 0; d->old >= 0 && flock(d->old, LOCK_EX | LOCK_NB); i++) {
        if (errno != EWOULDBLOCK && errno != EINTR) return FROE_OK; /* a system without locks */
        if (i < TRIES) {
            nanosleep(&pause, NULL);
            continue;
        }
        char who[64] = "";
        const long process = holder_of(d->old);
        if (process) snprintf(who, sizeof who, " (process %ld)", process);
        close(d->old);
        d->old = -1;
        return support_fail(diag, FROE_E_IO,
                            "%s: Another program%s holds a lock on the folder, so that it is not replaced.",
                            support_short(d->target), who);
    }
    return FROE_OK;
}

/* The new name is on the disk, before anything of the old folder is removed: a loss of power may undo a name and keep
 * what was done afterwards. */
static void sync_name(froe_shard_draft *d) {
    char *end = strrchr(d->target, '/');
    end += end == d->target;
    const char kept = *end;
    *end = '\0';
    sync_folder(d->target);
    *end = kept;
}

froe_status froe_shard_draft_place(froe_shard_draft *d, bool *replaced, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!d || !replaced) return support_fail_null(diag, __func__);
    froe_status status = check_target(d, d->target, diag); /* another program may have built or put something there */
    if (!status) status = froe_shard_draft_sync(d->folder, 0, 1, diag);
    if (status) return status;
    sync_folder(d->folder);
    if ((status = lock_old(d, diag))) return status;
    const int error = exchange(d);
    if (error) {
        if (d->old >= 0) close(d->old);
        d->old = -1;
        return support_fail_file(diag, "written", d->target, error);
    }
    sync_name(d);
    close(d->lock);
    d->lock = -1;
    *replaced = d->old >= 0;
    return FROE_OK;
}

froe_status froe_shard_draft_end(froe_shard_draft *d, froe_status status, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!d) return status;
    const froe_allocator alloc = d->alloc;
    bool replaced;
    if (!status && d->lock >= 0) status = froe_shard_draft_place(d, &replaced, diag);
    if (d->lock >= 0 || d->old >= 0) { /* the draft, or what was there before */
        empty_folder(d->folder);
        rmdir(d->folder);
    }
    if (d->lock >= 0) close(d->lock);
    if (d->old >= 0) close(d->old);
    support_free(&alloc, d, sizeof *d);
    return status;
}
