/* array.h: growable flat arrays of plain items, of any type.
 *
 *     ARRAY(uint32_t) ids = {0};
 *     if (!array_push(alloc, &ids, 7)) return FROE_E_MEMORY;
 *     array_free(alloc, &ids);
 *
 * Growth is by half, so n pushes cost O(n). A failed call leaves the array as it was. */
#ifndef FROE_SUPPORT_ARRAY_H
#define FROE_SUPPORT_ARRAY_H
#include "support/alloc.h"
#include <string.h>

#define ARRAY(T)                                                                                                       \
    struct {                                                                                                           \
        T *data;                                                                                                       \
        size_t count, capacity;                                                                                        \
    }

/** Room for `extra` more items. */
#define array_reserve(alloc, a, extra)                                                                                 \
    ((a)->capacity - (a)->count >= (size_t)(extra) ||                                                                  \
     support_array_grow((alloc), (void **)&(a)->data, &(a)->capacity, (a)->count, (size_t)(extra), sizeof *(a)->data))
/** Appends a copy of `item`. */
#define array_push(alloc, a, ...) (array_reserve((alloc), (a), 1) && ((a)->data[(a)->count++] = __VA_ARGS__, true))
/** Appends copies of `n` items, which may be none. */
#define array_append(alloc, a, items, n)                                                                               \
    (array_reserve((alloc), (a), (n)) &&                                                                               \
     ((n) == 0 || memcpy((a)->data + (a)->count, (items), (size_t)(n) * sizeof *(a)->data)) &&                         \
     ((a)->count += (size_t)(n), true))
#define array_free(alloc, a)                                                                                           \
    (support_free((alloc), (a)->data, (a)->capacity * sizeof *(a)->data), (a)->data = NULL,                            \
     (a)->count = (a)->capacity = 0)

/** Gives back most of the room behind its items, where that is an eighth of all or more. */
#define array_shrink(alloc, a)                                                                                         \
    support_array_shrink((alloc), (void **)&(a)->data, &(a)->capacity, (a)->count, sizeof *(a)->data)

bool support_array_grow(const froe_allocator *alloc, void **data, size_t *capacity, size_t count, size_t extra,
                        size_t item_size);
void support_array_shrink(const froe_allocator *alloc, void **data, size_t *capacity, size_t count, size_t item_size);
#endif
