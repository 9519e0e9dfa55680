/* common.c: memory, failures, locale and names of files for the io library. */
#include "common.h"
#include "support/floats.h"
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static void *malloc_fn(void *user, void *ptr, size_t old_size, size_t new_size) {
    (void)user;
    (void)old_size;
    if (new_size) return realloc(ptr, new_size);
    free(ptr);
    return NULL;
}

froe_allocator io_allocator(const froe_allocator *alloc) {
    return alloc && alloc->fn ? *alloc : (froe_allocator){malloc_fn, NULL};
}

void *io_buffer_add(const froe_allocator *alloc, io_buffer *buffer, size_t bytes) {
    if (!buffer->data || bytes > buffer->capacity - buffer->size) { /* room for nothing is room, too */
        size_t need, room = buffer->capacity + buffer->capacity / 2 + 256;
        if (__builtin_add_overflow(buffer->size, bytes, &need)) return NULL;
        if (room < need) room = need;
        void *grown = support_callback(alloc->fn(alloc->user, buffer->data, buffer->capacity, room));
        if (!grown) return NULL;
        buffer->data = grown;
        buffer->capacity = room;
    }
    void *added = (char *)buffer->data + buffer->size;
    buffer->size += bytes;
    return added;
}

bool io_buffer_put(const froe_allocator *alloc, io_buffer *buffer, const void *item, size_t bytes) {
    void *added = io_buffer_add(alloc, buffer, bytes);
    if (added && bytes) memcpy(added, item, bytes);
    return added != NULL;
}

void io_buffer_free(const froe_allocator *alloc, io_buffer *buffer) {
    if (buffer->data) support_callback(alloc->fn(alloc->user, buffer->data, buffer->capacity, 0));
    *buffer = (io_buffer){0};
}

froe_status io_fail(froe_diagnostic *diag, froe_status status, const char *format, ...) {
    if (!diag) return status;
    *diag = (froe_diagnostic){.status = status, .object = FROE_NONE, .corner = FROE_NONE, .axis = FROE_NONE};
    va_list args;
    va_start(args, format);
    vsnprintf(diag->message, sizeof diag->message, format, args);
    va_end(args);
    return status;
}

froe_status io_fail_memory(froe_diagnostic *diag) {
    return io_fail(diag, FROE_E_MEMORY, "out of memory");
}

froe_status io_fail_file(froe_diagnostic *diag, const char *path, int error) {
    if (error == ENOMEM) return io_fail_memory(diag);
    return io_fail(diag, FROE_E_IO, "%s: %s", io_short(path), io_errno(error).text);
}

const char *io_short(const char *path) {
    enum { KEPT = 96 };
    size_t length = strlen(path);
    return length <= KEPT ? path : path + length - KEPT;
}

io_reason io_errno(int error) {
    io_reason reason;
    if (strerror_r(error, reason.text, sizeof reason.text))
        snprintf(reason.text, sizeof reason.text, "error %d", error);
    return reason;
}

bool io_locale_enter(io_locale *guard) {
    guard->own = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!guard->own) return false;
    guard->before = uselocale(guard->own);
    return true;
}

void io_locale_leave(io_locale *guard) {
    uselocale(guard->before);
    freelocale(guard->own);
}

double io_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static char lower(char c) {
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

io_extension io_path_extension(const char *path) {
    io_extension extension = {""};
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash + 1 : path, '.');
    if (!dot || strlen(dot + 1) >= sizeof extension.text) return extension;
    for (size_t i = 0; dot[i + 1]; ++i) extension.text[i] = lower(dot[i + 1]);
    return extension;
}

bool io_equal_nocase(const char *a, const char *b) {
    while (*a && lower(*a) == lower(*b)) ++a, ++b;
    return !*a && !*b;
}
