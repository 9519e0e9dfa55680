/* memory.c: the allocator in use: the caller's, or malloc. */
#define _DEFAULT_SOURCE 1 /* madvise */
#include "base/array.h"
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum { HUGE_FROM = 8 << 20 }; /* bytes from which huge pages are asked for */

/** Large arrays are read at random: pages of 2 MB spare most of the waiting for page tables, and of the faults. */
static void prefer_huge_pages(void *ptr, size_t size) {
#ifdef MADV_HUGEPAGE
    const uintptr_t page = (uintptr_t)1 << 21, start = ((uintptr_t)ptr + page - 1) & ~(page - 1);
    uintptr_t end = ((uintptr_t)ptr + size) & ~(page - 1);
    if (start < end)
        madvise((void *)start, end - start, MADV_HUGEPAGE); /* a wish: whether it is granted is no matter */
#else
    (void)ptr;
    (void)size;
#endif
}

static void *malloc_fn(void *user, void *ptr, size_t old_size, size_t new_size) {
    (void)user;
    (void)old_size;
    if (!new_size) {
        free(ptr);
        return NULL;
    }
    ptr = realloc(ptr, new_size);
    if (ptr && new_size >= HUGE_FROM) prefer_huge_pages(ptr, new_size);
    return ptr;
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
