/* reads.c: what reads files, in a program whose calls of it are led here (--wrap). Streams of the C library read by
 * read() as well, so that ferror() says what it would. */
#define _GNU_SOURCE 1 /* fopencookie */
#include "faults.h"
#include <dirent.h>
#include <errno.h>
#include <stdint.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

int __real_close(int file);
ssize_t __real_read(int file, void *bytes, size_t count);
ssize_t __real_pread(int file, void *bytes, size_t count, off_t place);
int __real_fstat(int file, struct stat *about);
int __real_stat(const char *path, struct stat *about);
DIR *__real_opendir(const char *path);
ssize_t __wrap_read(int file, void *bytes, size_t count);
ssize_t __wrap_pread(int file, void *bytes, size_t count, off_t place);
int __wrap_fstat(int file, struct stat *about);
int __wrap_stat(const char *path, struct stat *about);
DIR *__wrap_opendir(const char *path);

/* How many bytes of `count` shall be read; -1: none, and errno. */
static ssize_t allowed(const char *name, size_t count) {
    if (fault_meets(&fault_reads, name)) return -1;
    if (fault_reads.calls != fault_reads.at || !count) return (ssize_t)count;
    return fault_reads.kind == FAULT_END ? 0 : fault_reads.kind == FAULT_SHORT ? 1 : (ssize_t)count;
}

ssize_t __wrap_read(int file, void *bytes, size_t count) {
    const ssize_t most = allowed("read", count);
    return most < 0 ? -1 : __real_read(file, bytes, (size_t)most);
}

ssize_t __wrap_pread(int file, void *bytes, size_t count, off_t place) {
    const ssize_t most = allowed("pread", count);
    return most < 0 ? -1 : __real_pread(file, bytes, (size_t)most, place);
}

int __wrap_fstat(int file, struct stat *about) {
    return fault_reading_fails("fstat") ? -1 : __real_fstat(file, about);
}

int __wrap_stat(const char *path, struct stat *about) {
    return fault_reading_fails("stat") ? -1 : __real_stat(path, about);
}

DIR *__wrap_opendir(const char *path) {
    return fault_reading_fails("opendir") ? NULL : __real_opendir(path);
}

static ssize_t read_stream(void *cookie, char *bytes, size_t count) {
    return __wrap_read((int)(intptr_t)cookie, bytes, count);
}

static int seek_stream(void *cookie, off64_t *place, int whence) {
    const off64_t at = lseek64((int)(intptr_t)cookie, *place, whence);
    if (at >= 0) *place = at;
    return at < 0 ? -1 : 0;
}

static int close_stream(void *cookie) {
    return __real_close((int)(intptr_t)cookie);
}

FILE *fault_stream(int file) {
    const cookie_io_functions_t functions = {.read = read_stream, .seek = seek_stream, .close = close_stream};
    return file < 0 ? NULL : fopencookie((void *)(intptr_t)file, "r", functions);
}
