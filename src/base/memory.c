/* memory.c: the allocator in use: the caller's, or malloc. */
#include "base/array.h"
#include <stdlib.h>
#include <string.h>

static void *malloc_fn(void *user, void *ptr, size_t old_size, size_t new_size) {
    (void)user;
    (void)old_size;
    if (new_size) return realloc(ptr, new_size);
    free(ptr);
    return NULL;
}

froe_allocator base_allocator(const froe_allocator *alloc) {
    return alloc && alloc->fn ? *alloc : (froe_allocator){malloc_fn, NULL};
}

void *base_realloc(const froe_allocator *alloc, void *ptr, size_t old_size, size_t new_size) {
    if (!ptr && !new_size) return NULL;
    return alloc->fn(alloc->user, ptr, old_size, new_size);
}

void *base_calloc(const froe_allocator *alloc, size_t count, size_t item_size) {
    size_t size;
    if (__builtin_mul_overflow(count, item_size, &size)) return NULL;
    void *ptr = base_realloc(alloc, NULL, 0, size ? size : 1);
    if (ptr) memset(ptr, 0, size ? size : 1);
    return ptr;
}

void base_free(const froe_allocator *alloc, void *ptr, size_t size) {
    if (ptr) alloc->fn(alloc->user, ptr, size, 0);
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
