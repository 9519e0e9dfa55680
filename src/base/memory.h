/* memory.h: the one way to get memory. Every object carries its allocator. */
#ifndef FROE_BASE_MEMORY_H
#define FROE_BASE_MEMORY_H
#include "support/alloc.h"

/** The caller's allocator, or malloc when `alloc` is NULL. */
#define base_allocator support_allocator
/** NULL when there is no memory (the old block stays) or when new_size is 0 (it is freed). */
void *base_realloc(const froe_allocator *alloc, void *ptr, size_t old_size, size_t new_size);
/** Zeroed memory for count items; NULL on overflow or without memory; count 0 gives one byte. */
void *base_calloc(const froe_allocator *alloc, size_t count, size_t item_size);
/** size: as it was allocated; 0 of a base_calloc() with count 0. */
void base_free(const froe_allocator *alloc, void *ptr, size_t size);
#endif
