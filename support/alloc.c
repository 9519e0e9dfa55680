/* alloc.c: the caller's allocator, or malloc. */
#define _DEFAULT_SOURCE 1 /* madvise, posix_memalign */
#include "support/alloc.h"
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
