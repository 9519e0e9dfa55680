/* save.c: writing a tree file so that its name never stands for half a file.
 *
 *     write PATH.<random>.tmp  ->  fsync  ->  rename to PATH  ->  fsync the folder
 *
 * Whatever goes wrong before the rename, the old file is untouched and the new one is removed;
 * after it, the new one is whole. */
#define _XOPEN_SOURCE 700 /* realpath */
#include "base/random.h"
#include "base/status.h"
#include "tree/file.h"
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { TRIES = 100, SUFFIX = 24 };

static froe_status io_fail(froe_diagnostic *diag, const char *path, int error) {
    char reason[96] = "unknown error";
    strerror_r(error, reason, sizeof reason);
    return base_fail(diag, FROE_E_IO, "cannot write '%.120s': %s", path, reason);
}

/* ------------------------------------------------------------------- bytes -- */

/* Writes everything or returns an errno. */
static int write_all(int fd, const void *data, uint64_t size) {
    const char *at = data;
    while (size) {
        ssize_t wrote = write(fd, at, size < SSIZE_MAX ? (size_t)size : SSIZE_MAX);
        if (wrote < 0 && errno == EINTR) continue;
        if (wrote <= 0) return wrote ? errno : ENOSPC;
        at += wrote;
        size -= (uint64_t)wrote;
    }
    return 0;
}

typedef struct file_head {
    file_header header;
    file_section table[FILE_SECTIONS];
    uint8_t zeros[FILE_ALIGN]; /* at least up to the first section */
} file_head;

static void fill_head(const froe_tree *tree, file_head *head) {
    memset(head, 0, sizeof *head);
    file_header *h = &head->header;
    uint64_t offset = file_align(sizeof *h + sizeof head->table);
    for (uint32_t i = 0; i < FILE_SECTIONS; i++) {
        file_section *s = head->table + i;
        const void *data;
        s->id = i + 1;
        s->item_size = file_part(tree, (file_id)s->id, &data, &s->size);
        s->offset = offset;
        s->checksum = file_checksum(data, s->size, 0);
        offset = file_align(offset + s->size);
    }
    memcpy(h->magic, FILE_MAGIC, sizeof h->magic);
    h->version = FILE_VERSION;
    h->sections = FILE_SECTIONS;
    h->size = offset;
    h->dim = (uint32_t)tree->scene->dim;
    h->checksum = file_checksum(head->table, sizeof head->table, file_checksum(h, offsetof(file_header, checksum), 0));
}

static int write_tree(int fd, const froe_tree *tree) {
    static const uint8_t zeros[FILE_ALIGN];
    file_head head;
    fill_head(tree, &head);
    int error = write_all(fd, &head, head.table[0].offset);
    for (uint32_t i = 0; !error && i < FILE_SECTIONS; i++) {
        const void *data;
        uint64_t size;
        file_part(tree, (file_id)(i + 1), &data, &size);
        error = write_all(fd, data, size);
        if (!error) error = write_all(fd, zeros, file_align(size) - size);
    }
    return error;
}

/* ------------------------------------------------------------------- names -- */

/* Makes a new file beside `path`; its name goes to temp. Returns the descriptor, or -1 and errno. */
static int open_temp(const char *path, char *temp, size_t size) {
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    for (uint64_t i = 0; i < TRIES; i++) {
        uint64_t name = base_hash((uint64_t)getpid(), (uint64_t)now.tv_sec, (uint64_t)now.tv_nsec + i);
        snprintf(temp, size, "%s.%016llx.tmp", path, (unsigned long long)name);
        int fd = open(temp, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd >= 0 || errno != EEXIST) return fd;
    }
    return -1;
}

/* The rename lasts through a power cut once its folder is on disk. Either file is whole without, so failing is no
 * failure. */
static void sync_folder(char *temp) {
    char *slash = strrchr(temp, '/');
    if (slash) slash[slash == temp] = 0;
    int fd = open(slash ? temp : ".", O_RDONLY | O_CLOEXEC);
    if (fd < 0) return;
    (void)fsync(fd);
    close(fd);
}

static int replace(const froe_tree *tree, const char *path, const struct stat *old, char *temp, size_t size) {
    int fd = open_temp(path, temp, size), error = 0;
    if (fd < 0) return errno;
    if (old && fchmod(fd, old->st_mode & 07777)) error = errno;
    if (!error) error = write_tree(fd, tree);
    if (!error && fsync(fd)) error = errno;
    if (close(fd) && !error) error = errno;
    if (!error && rename(temp, path)) error = errno;
    if (error)
        unlink(temp);
    else
        sync_folder(temp);
    return error;
}

froe_status froe_tree_save(const froe_tree *tree, const char *path, froe_diagnostic *diag) {
    char resolved[PATH_MAX];
    struct stat old;
    if (!tree || !path) return base_fail(diag, FROE_E_ARG, "a required argument is NULL");
    if (!file_machine_fits())
        return base_fail(diag, FROE_E_UNSUPPORTED, "tree files are little-endian, this machine is not");
    bool exists = stat(path, &old) == 0;
    if (exists && !S_ISREG(old.st_mode))
        return base_fail(diag, FROE_E_IO, "cannot write '%.120s': it is not a regular file", path);
    const char *target = exists && realpath(path, resolved) ? resolved : path; /* a link is followed, not replaced */
    size_t size = strlen(target) + SUFFIX;
    char *temp = base_realloc(&tree->alloc, NULL, 0, size);
    if (!temp) return base_fail_memory(diag);
    int error = replace(tree, target, exists ? &old : NULL, temp, size);
    base_free(&tree->alloc, temp, size);
    return error ? io_fail(diag, path, error) : FROE_OK;
}
