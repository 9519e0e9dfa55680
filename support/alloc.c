/* alloc.c: the caller's allocator, or malloc; sizes that do not overflow, and arrays that grow. */
#define _DEFAULT_SOURCE 1 /* madvise, posix_memalign */
#include "support/alloc.h"
#include "support/array.h"
#include "support/floats.h"
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum { HUGE_FROM = 4 << 20, HUGE_PAGE = 2 << 20 }; /* bytes from which huge pages are asked for */

/* Large arrays are read at random: pages of 2 MB spare most of the waiting for page tables, and of the faults. The
 * system gives them to memory that is aligned to one and was never touched. So an array that grows is copied: where it
 * is moved by changing page tables, the system splits them. NULL: there are none. */
static void *grow_in_huge_pages(void *ptr, size_t old_size, size_t new_size) {
#ifdef MADV_HUGEPAGE
    void *grown;
    if (posix_memalign(&grown, HUGE_PAGE, new_size)) return NULL;
    madvise(grown, new_size & ~(size_t)(HUGE_PAGE - 1), MADV_HUGEPAGE); /* a hint: a failure changes nothing */
    if (ptr) memcpy(grown, ptr, old_size);
    free(ptr);
    return grown;
#else
    (void)ptr, (void)old_size, (void)new_size;
    return NULL;
#endif
}

static void *malloc_fn(void *user, void *ptr, size_t old_size, size_t new_size) {
    (void)user;
    if (!new_size) {
        free(ptr);
        return NULL;
    }
    void *grown = NULL;
    if (new_size >= HUGE_FROM && new_size > old_size) grown = grow_in_huge_pages(ptr, old_size, new_size);
    return grown ? grown : realloc(ptr, new_size);
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
    if (ptr) memset(ptr, 0, size ? size : 1);
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
