/* memory.c: memory and messages for the pictures; the core's own functions for these are
 * not public. */
#include "memory.h"
#include "support/floats.h"
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void *from_malloc(void *user, void *ptr, size_t old_size, size_t new_size) {
    (void)user;
    (void)old_size;
    if (new_size) return realloc(ptr, new_size);
    free(ptr);
    return NULL;
}

froe_allocator draw_allocator(const froe_allocator *alloc) {
    return alloc && alloc->fn ? *alloc : (froe_allocator){from_malloc, NULL};
}

void *draw_calloc(const froe_allocator *alloc, size_t count, size_t item) {
    if (item && count > SIZE_MAX / item) return NULL;
    size_t size = count * item;
    if (!size) size = 1;
    void *ptr = support_callback(alloc->fn(alloc->user, NULL, 0, size));
    return ptr ? memset(ptr, 0, size) : NULL;
}

void draw_free(const froe_allocator *alloc, void *ptr, size_t size) {
    if (ptr) support_callback(alloc->fn(alloc->user, ptr, size, 0));
}

bool draw_grow(const froe_allocator *alloc, void **data, size_t *capacity, size_t count, size_t extra, size_t item) {
    if (extra > SIZE_MAX / item / 2 - count) return false;
    size_t room = *capacity + *capacity / 2 + 16;
    if (room < count + extra) room = count + extra;
    if (room > SIZE_MAX / item) return false;
    void *grown = support_callback(alloc->fn(alloc->user, *data, *capacity * item, room * item));
    if (!grown) return false;
    *data = grown;
    *capacity = room;
    return true;
}

froe_status draw_fail(froe_diagnostic *diag, froe_status status, const char *format, ...) {
    if (!diag) return status;
    *diag = (froe_diagnostic){.status = status, .object = FROE_NONE, .corner = FROE_NONE, .axis = FROE_NONE};
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(diag->message, sizeof diag->message, format, arguments);
    va_end(arguments);
    return status;
}

froe_status draw_fail_memory(froe_diagnostic *diag) {
    return draw_fail(diag, FROE_E_MEMORY, "Out of memory while drawing.");
}
