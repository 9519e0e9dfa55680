/* memory.c: sizes that do not overflow, and arrays that grow. */
#include "base/array.h"
#include "base/floats.h"
#include <string.h>

void *base_realloc(const froe_allocator *alloc, void *ptr, size_t old_size, size_t new_size) {
    if (!ptr && !new_size) return NULL;
    return base_callback(alloc->fn(alloc->user, ptr, old_size, new_size));
}

void *base_calloc(const froe_allocator *alloc, size_t count, size_t item_size) {
    size_t size;
    if (__builtin_mul_overflow(count, item_size, &size)) return NULL;
    void *ptr = base_realloc(alloc, NULL, 0, size ? size : 1);
    if (ptr) memset(ptr, 0, size ? size : 1);
    return ptr;
}

void base_free(const froe_allocator *alloc, void *ptr, size_t size) {
    if (ptr)
        base_callback(alloc->fn(alloc->user, ptr, size ? size : 1, 0)); /* an empty array was one byte: base_calloc() */
}

bool array_grow(const froe_allocator *alloc, void **data, size_t *capacity, size_t count, size_t extra,
                size_t item_size) {
    size_t need, bytes, room = *capacity + *capacity / 2 + 16;
    if (__builtin_add_overflow(count, extra, &need)) return false;
    if (room < need) room = need;
    if (__builtin_mul_overflow(room, item_size, &bytes)) return false;
    void *grown = base_realloc(alloc, *data, *capacity * item_size, bytes);
    if (!grown) return false;
    *data = grown;
    *capacity = room;
    return true;
}
