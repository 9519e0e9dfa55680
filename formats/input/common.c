/* common.c: memory, failures, locale and names of files for the io library. */
#include "formats/input/common.h"
#include "support/floats.h"
#include <errno.h>
#include <string.h>
#include <time.h>

void *formats_buffer_add(const froe_allocator *alloc, formats_buffer *buffer, size_t bytes) {
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

bool formats_buffer_put(const froe_allocator *alloc, formats_buffer *buffer, const void *item, size_t bytes) {
    void *added = formats_buffer_add(alloc, buffer, bytes);
    if (added && bytes) memcpy(added, item, bytes);
    return added != NULL;
}

void formats_buffer_free(const froe_allocator *alloc, formats_buffer *buffer) {
    if (buffer->data) support_callback(alloc->fn(alloc->user, buffer->data, buffer->capacity, 0));
    *buffer = (formats_buffer){0};
}

froe_status formats_fail_file(froe_diagnostic *diag, const char *path, int error) {
    if (error == ENOMEM) return support_fail_memory(diag);
    return support_fail(diag, FROE_E_IO, "%s: %s", support_short(path), support_errno(error).text);
}

bool formats_locale_enter(formats_locale *guard) {
    guard->own = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!guard->own) return false;
    guard->before = uselocale(guard->own);
    return true;
}

void formats_locale_leave(formats_locale *guard) {
    uselocale(guard->before);
    freelocale(guard->own);
}

double formats_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static char lower(char c) {
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

formats_extension formats_path_extension(const char *path) {
    formats_extension extension = {""};
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash + 1 : path, '.');
    if (!dot || strlen(dot + 1) >= sizeof extension.text) return extension;
    for (size_t i = 0; dot[i + 1]; ++i) extension.text[i] = lower(dot[i + 1]);
    return extension;
}

bool formats_equal_nocase(const char *a, const char *b) {
    while (*a && lower(*a) == lower(*b)) ++a, ++b;
    return !*a && !*b;
}
