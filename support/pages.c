/* pages.c: mappings that begin at a multiple of 2 MB. */
#define _GNU_SOURCE 1 /* madvise, mremap, MAP_ANONYMOUS */
#include "support/pages.h"
#include <stdint.h>
#include <sys/mman.h>
#ifdef __linux__
#include <sys/syscall.h>
#endif
#include <unistd.h>

#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
#define WATCHED 1
#elif defined __has_feature
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || __has_feature(thread_sanitizer)
#define WATCHED 1
#endif
#endif

/* Emscripten has these names, but moves no mapping and gives no part of one back. */
#if defined __linux__ && defined MADV_HUGEPAGE && defined MREMAP_FIXED && !defined WATCHED

enum { HUGE_FROM = 4 << 20, HUGE_PAGE = 2 << 20 };

bool support_pages_serve(size_t size) {
    return size >= HUGE_FROM;
}

/* Bytes of whole pages; 0 where there are too many. */
static size_t whole_pages(size_t size) {
    const size_t page = (size_t)sysconf(_SC_PAGESIZE);
    return size > SIZE_MAX - HUGE_PAGE - page ? 0 : (size + page - 1) / page * page;
}

/* Addresses for so many bytes, from a multiple of HUGE_PAGE on. NULL: none are left. */
static void *map_aligned(size_t length) {
    if (!length) return NULL;
    char *at = mmap(NULL, length + HUGE_PAGE, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (at == MAP_FAILED) return NULL;
    const size_t before = (HUGE_PAGE - (uintptr_t)at % HUGE_PAGE) % HUGE_PAGE;
    if (before) munmap(at, before);
    munmap(at + before + length, HUGE_PAGE - before);
    return at + before;
}

/* Page tables of 2 MB move as they are, as both addresses are multiples of that. The system is called without the
 * function mremap(), in whose place some libraries put one of four arguments (UCX, for MPI): without the fifth the
 * mapping moves to any address, such as 0. Such a library is not told that memory has moved, so that bytes which a
 * program has let MPI send must not grow afterwards. */
static void *move(void *ptr, size_t old_length, size_t length) {
    void *to = map_aligned(length);
    if (!to) return NULL;
    if (syscall(SYS_mremap, ptr, old_length, length, MREMAP_MAYMOVE | MREMAP_FIXED, to) == (long)to) return to;
    munmap(to, length);
    return NULL;
}

void *support_pages_realloc(void *ptr, size_t old_size, size_t new_size) {
    const size_t old_length = whole_pages(old_size), length = whole_pages(new_size);
    if (!new_size) {
        munmap(ptr, old_length);
        return NULL;
    }
    if (ptr && length && length <= old_length) {
        if (length < old_length) munmap((char *)ptr + length, old_length - length);
        return ptr;
    }
    void *at = ptr ? move(ptr, old_length, length) : map_aligned(length);
    if (at) madvise(at, length, MADV_HUGEPAGE); /* a hint: a failure changes nothing */
    return at;
}

#else

bool support_pages_serve(size_t size) {
    (void)size;
    return false;
}

void *support_pages_realloc(void *ptr, size_t old_size, size_t new_size) {
    (void)ptr, (void)old_size, (void)new_size;
    return NULL;
}

#endif
