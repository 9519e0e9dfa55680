/* alloc.h: the one way to get memory. Every object carries its allocator. */
#ifndef FROE_SUPPORT_ALLOC_H
#define FROE_SUPPORT_ALLOC_H
#include "support/arithmetic.h"
#include <froe/froe.h>

/** The caller's allocator, or malloc where `alloc` or its function is NULL. */
froe_allocator support_allocator(const froe_allocator *alloc);
/** NULL when there is no memory (the old block stays) or when new_size is 0 (it is freed). */
void *support_realloc(const froe_allocator *alloc, void *ptr, size_t old_size, size_t new_size);
/** Zeroed memory for count items; NULL on overflow or without memory; count 0 gives one byte. */
void *support_calloc(const froe_allocator *alloc, size_t count, size_t item_size);
/** size: as it was allocated; 0 of a support_calloc() with count 0. */
void support_free(const froe_allocator *alloc, void *ptr, size_t size);
#endif
