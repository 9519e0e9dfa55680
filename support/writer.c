/* writer.c: links, names, bytes and the order of the system calls, which is what makes a file appear as a whole. */
#define _DEFAULT_SOURCE 1 /* getentropy, flock */
#include "support/writer.h"
#include "support/alloc.h"
#include "support/fail.h"
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { BUFFER = 1 << 16, LINKS = 40, TRIES = 100, SUFFIX = 32 };

struct support_writer_room {
    char target[PATH_MAX];             /* what lies behind all links; its folder, once it is in its place */
    char temporary[PATH_MAX + SUFFIX]; /* "": the target itself is written */
    unsigned char buffer[BUFFER];
};

/* ------------------------------------------------------------------- bytes -- */

/* Writes everything or returns an errno. */
static int write_all(int file, const unsigned char *at, size_t count) {
    while (count) {
        ssize_t wrote = write(file, at, count < SSIZE_MAX ? count : SSIZE_MAX);
        if (wrote < 0 && errno == EINTR) continue;
        if (wrote < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) { /* a descriptor that does not block: wait */
            struct pollfd one = {.fd = file, .events = POLLOUT};
            if (poll(&one, 1, -1) >= 0 || errno == EINTR) continue;
        }
        if (wrote <= 0) return wrote ? errno : ENOSPC;
        at += wrote;
        count -= (size_t)wrote;
    }
    return 0;
}

static bool flush(support_writer *w) {
    w->error = write_all(w->file, w->room->buffer, w->filled);
    w->filled = 0;
    return !w->error;
}

bool support_writer_put(support_writer *w, const void *bytes, size_t count) {
    if (w->error) return false;
    if (count > BUFFER - w->filled && !flush(w)) return false;
    if (count > BUFFER) return !(w->error = write_all(w->file, bytes, count));
    if (count) memcpy(w->room->buffer + w->filled, bytes, count);
    w->filled += count;
    return true;
}

/* Brings the bytes to the disk. Pipes and terminals have none, which is no failure. */
static int sync_file(int file) {
    int result;
    do result = fsync(file);
    while (result && errno == EINTR);
    return result && errno != EINVAL && errno != EROFS && errno != ENOTSUP ? errno : 0;
}

/* The rename lasts through a power cut once its folder is on the disk. Either file is whole without, so failing is no
 * failure. */
static void sync_folder(char *path) {
    char *slash = strrchr(path, '/');
    if (slash) slash[slash == path] = '\0';
    int folder = open(slash ? path : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return;
    (void)sync_file(folder);
    close(folder);
}

/* ------------------------------------------------------------------- names -- */

/* How many bytes of a path come before the name of the file itself. */
static size_t folder_length(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash + 1 - path) : 0;
}

/* The number of the descriptor of this process that a path stands for, -1 if it stands for none. */
static int descriptor_named(const char *path) {
    static const char *const folders[] = {"/dev/fd/", "/proc/self/fd/"};
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++) {
        size_t length = strlen(folders[i]);
        if (strncmp(path, folders[i], length) != 0) continue;
        const char *number = path + length;
        size_t digits = strspn(number, "0123456789");
        if (digits && digits < 10 && !number[digits]) return (int)strtol(number, NULL, 10);
    }
    return -1;
}

/* Replaces the name of a link by what it points to, until it is the name of no link, whether or not a file of that name
 * is there, or the name of a descriptor. Returns an errno. */
static int follow_links(char path[PATH_MAX]) {
    char link[PATH_MAX];
    for (int i = 0; i <= LINKS; i++) {
        if (descriptor_named(path) >= 0) return 0;
        ssize_t length = readlink(path, link, sizeof link);
        if (length < 0) return errno == EINVAL || errno == ENOENT ? 0 : errno;
        size_t kept = link[0] == '/' ? 0 : folder_length(path);
        if (kept + (size_t)length >= PATH_MAX) return ENAMETOOLONG;
        memcpy(path + kept, link, (size_t)length);
        path[kept + (size_t)length] = '\0';
    }
    return ELOOP;
}

/* A name nothing else has. Where the system gives no random number, the clock does: a name that is taken already is
 * never written, it is only tried in vain. */
static uint64_t draw_number(void) {
    uint64_t number;
    struct timespec now;
    if (!getentropy(&number, sizeof number)) return number;
    clock_gettime(CLOCK_REALTIME, &now);
    return ((uint64_t)now.tv_nsec << 32) ^ (uint64_t)now.tv_sec ^ ((uint64_t)getpid() << 16);
}

/* A new file beside the target. Returns its descriptor, or -1 and errno. */
static int create_beside(struct support_writer_room *room, mode_t mode) {
    size_t length = folder_length(room->target);
    memcpy(room->temporary, room->target, length);
    int file = -1;
    for (int i = 0; i < TRIES && file < 0; i++) {
        snprintf(room->temporary + length, SUFFIX, ".froe-%016llx.tmp", (unsigned long long)draw_number());
        file = open(room->temporary, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
        if (file < 0 && errno != EEXIST && errno != EINTR) break;
    }
    if (file < 0) room->temporary[0] = '\0';
    return file;
}

/* Is this file still the one of that name? */
static bool is_at(int file, const char *path) {
    struct stat one, other;
    return !fstat(file, &one) && !lstat(path, &other) && one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

/* A file of the user of this process, under one name only: what is written into it appears nowhere else. */
static bool is_own(int file) {
    struct stat info;
    return !fstat(file, &info) && S_ISREG(info.st_mode) && info.st_nlink == 1 && info.st_uid == geteuid();
}

/* Opens the file of that name, or makes it. Returns its descriptor, or -1 and errno. */
static int open_or_make(const char *path, mode_t mode, bool *made) {
    const int flags = O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
    int file = open(path, flags | O_CREAT | O_EXCL, mode);
    *made = file >= 0;
    if (file >= 0 || errno != EEXIST) return file;
    file = open(path, flags);
    if (file < 0 && errno == ENOENT) errno = EINTR; /* it went away meanwhile: once more */
    return file;
}

/* A file beside the target that other processes find, empty and locked. Returns its descriptor, or -1 and errno;
 * EWOULDBLOCK: another program writes it. EEXIST: something that is no file of this user's has its name. ENOLCK: the
 * file system has no locks, so that another program may write it. */
static int create_shared(struct support_writer_room *room, mode_t mode) {
    const size_t length = folder_length(room->target);
    snprintf(room->temporary, sizeof room->temporary, "%.*s.%s.writing", (int)length, room->target,
             room->target + length);
    while (true) {
        bool made;
        const int file = open_or_make(room->temporary, mode, &made);
        int error = file < 0 || flock(file, LOCK_EX | LOCK_NB) ? errno : 0;
        if (!error &&
            !is_at(file, room->temporary)) { /* another program has just brought it to its place, or removed it */
            close(file);
            continue;
        }
        if (file >= 0 && support_no_locks(error)) {
            error = ENOLCK;
            if (made) unlink(room->temporary);
        }
        if (!error && !is_own(file)) error = EEXIST;
        if (!error && ftruncate(file, 0)) error = errno;
        if (!error) return file;
        if (file >= 0) close(file);
        if (file < 0 && error == EINTR) continue;
        if (error == ENXIO || error == ELOOP) error = EEXIST; /* a pipe without a reader, a link */
        room->temporary[0] = '\0';
        errno = error;
        return -1;
    }
}

/* ------------------------------------------------------------------- files -- */

/* Gives a new file the mode of the old one, and its owner and group where that is allowed. A group that
 * differs from the old file's gets the rights of others. Returns an errno. */
static int keep_access(int file, const struct stat *old) {
    struct stat new;
    mode_t mode = old->st_mode & 0777;
    if (fstat(file, &new)) return errno;
    bool same = new.st_uid == old->st_uid &&new.st_gid == old->st_gid;
    if (!same && fchown(file, old->st_uid, old->st_gid) &&
        new.st_gid != old->st_gid &&fchown(file, (uid_t)-1, old->st_gid))
        mode = (mode & 0707) | (mode & 07) << 3;
    if ((new.st_mode & 0777) == mode) return 0;
    int result;
    do result = fchmod(file, mode);
    while (result && errno == EINTR);
    return result ? errno : 0;
}

/* Returns an errno. */
static int open_file(support_writer *w) {
    struct stat old;
    size_t length = strlen(w->path);
    if (!length || length >= PATH_MAX) return length ? ENAMETOOLONG : ENOENT;
    memcpy(w->room->target, w->path, length + 1);
    w->room->temporary[0] = '\0';
    int error = follow_links(w->room->target), named = descriptor_named(w->room->target);
    if (error) return error;
    bool exists = named < 0 && stat(w->path, &old) == 0;
    if (named < 0 && !exists && errno != ENOENT) return errno;
    if (exists && S_ISDIR(old.st_mode)) return EISDIR;
    const bool replaced = named < 0 && (!exists || S_ISREG(old.st_mode));
    const mode_t mode = exists ? old.st_mode & 0777 : 0666; /* open to no more readers than the old file was */
    if (replaced && w->shared) {
        w->file = create_shared(w->room, mode);
        w->shared = w->file >= 0 || errno != ENOLCK;
    }
    if (replaced && !w->shared) w->file = create_beside(w->room, mode);
    if (!replaced) w->file = exists ? open(w->path, O_WRONLY | O_NOCTTY | O_CLOEXEC) : fcntl(named, F_DUPFD_CLOEXEC, 0);
    if (w->file < 0) return errno;
    error = replaced && exists ? keep_access(w->file, &old) : 0;
    if (error) {
        unlink(w->room->temporary);
        close(w->file);
    }
    return error;
}

static froe_status open_writer(support_writer *w, const char *path, const froe_allocator *alloc, bool shared,
                               froe_diagnostic *diag) {
    *w = (support_writer){.path = path, .alloc = support_allocator(alloc), .diag = diag, .file = -1, .shared = shared};
    w->room = support_realloc(&w->alloc, NULL, 0, sizeof *w->room);
    if (!w->room) return support_fail_memory(diag);
    int error = open_file(w);
    if (!error) return FROE_OK;
    support_free(&w->alloc, w->room, sizeof *w->room);
    if (error == EWOULDBLOCK)
        return support_fail(diag, FROE_E_IO, "%s: Another program is writing this file.", support_short(path));
    if (shared && error == EEXIST)
        return support_fail(diag, FROE_E_IO,
                            "%s: Its draft beside it, whose name ends in .writing, is no file of yours. Remove it.",
                            support_short(path));
    return support_fail_file(diag, "written", path, error);
}

froe_status support_writer_open(support_writer *w, const char *path, const froe_allocator *alloc,
                                froe_diagnostic *diag) {
    return open_writer(w, path, alloc, false, diag);
}

froe_status support_writer_open_shared(support_writer *w, const char *path, const froe_allocator *alloc,
                                       froe_diagnostic *diag) {
    return open_writer(w, path, alloc, true, diag);
}

const char *support_writer_draft(const support_writer *w) {
    return w->shared && *w->room->temporary ? w->room->temporary : NULL;
}

froe_status support_writer_close(support_writer *w, froe_status status) {
    char *temporary = w->room->temporary, *target = w->room->target;
    if (!status && !w->error && flush(w)) w->error = sync_file(w->file);
    /* An interrupted close() has closed the file, whose bytes are on the disk. A shared file is closed, which ends its
     * lock, when nobody can take it for one that was left any more. */
    if (!w->shared && close(w->file) && errno != EINTR && !w->error) w->error = errno;
    if (!status && !w->error && *temporary && rename(temporary, target)) w->error = errno;
    if (!status && w->error) status = support_fail_file(w->diag, "written", w->path, w->error);
    if (*temporary && status) unlink(temporary);
    if (w->shared) close(w->file);
    if (*temporary && !status) sync_folder(target);
    support_free(&w->alloc, w->room, sizeof *w->room);
    return status;
}

froe_status support_write(const char *path, const void *bytes, size_t count, const froe_allocator *alloc,
                          froe_diagnostic *diag) {
    support_writer w;
    froe_status status = support_writer_open(&w, path, alloc, diag);
    if (status) return status;
    support_writer_put(&w, bytes, count);
    return support_writer_close(&w, FROE_OK);
}
