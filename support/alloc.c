/* alloc.c: the caller's allocator, or malloc; sizes that do not overflow, and arrays that grow. */
#include "support/alloc.h"
#include "support/array.h"
#include "support/floats.h"
#include "support/pages.h"
#include <stdlib.h>
#include <string.h>

/* An array that becomes large, or is large no more, is copied. */
static void *change_kind(void *ptr, size_t old_size, size_t new_size) {
    const bool large = support_pages_serve(new_size);
    void *to = large ? support_pages_realloc(NULL, 0, new_size) : malloc(new_size);
    if (!to || !ptr) return to;
    memcpy(to, ptr, old_size < new_size ? old_size : new_size);
    large ? free(ptr) : (void)support_pages_realloc(ptr, old_size, 0);
    return to;
}

static void *malloc_fn(void *user, void *ptr, size_t old_size, size_t new_size) {
    (void)user;
    const bool large = support_pages_serve(ptr ? old_size : new_size);
    if (new_size && (!ptr || large != support_pages_serve(new_size))) return change_kind(ptr, old_size, new_size);
    if (large) return support_pages_realloc(ptr, old_size, new_size);
    if (new_size) return realloc(ptr, new_size);
    free(ptr);
    return NULL;
}

froe_allocator support_allocator(const froe_allocator *alloc) {
    return alloc && alloc->fn ? *alloc : (froe_allocator){malloc_fn, NULL};
}

void *support_realloc(const froe_allocator *alloc, void *ptr, size_t old_size, size_t new_size) {
    if (!ptr && !new_size) return NULL;
    return support_callback(alloc->fn(alloc->user, ptr, old_size, new_size));
}

void *support_calloc(const froe_allocator *alloc, size_t count, size_t item_size) {
    size_t size;
    if (__builtin_mul_overflow(count, item_size, &size)) return NULL;
    void *ptr = support_realloc(alloc, NULL, 0, size ? size : 1);
    const bool fresh = alloc->fn == malloc_fn && support_pages_serve(size); /* such pages are zero */
    if (ptr && !fresh) memset(ptr, 0, size ? size : 1);
    return ptr;
}

void support_free(const froe_allocator *alloc, void *ptr, size_t size) {
    if (ptr)
        support_callback(
            alloc->fn(alloc->user, ptr, size ? size : 1, 0)); /* an empty array was one byte: support_calloc() */
}

bool support_array_grow(const froe_allocator *alloc, void **data, size_t *capacity, size_t count, size_t extra,
                        size_t item_size) {
    size_t need, bytes, room = *capacity + *capacity / 2 + 16;
    if (__builtin_add_overflow(count, extra, &need)) return false;
    if (room < need) room = need;
    if (__builtin_mul_overflow(room, item_size, &bytes)) return false;
    void *grown = support_realloc(alloc, *data, *capacity * item_size, bytes);
    if (!grown) return false;
    *data = grown;
    *capacity = room;
    return true;
}

void support_array_shrink(const froe_allocator *alloc, void **data, size_t *capacity, size_t count, size_t item_size) {
    if (!count || *capacity - count < *capacity / 8) return;
    void *shrunk = support_realloc(alloc, *data, *capacity * item_size, count * item_size);
    if (!shrunk) return; /* it stays as it is */
    *data = shrunk;
    *capacity = count;
}
