/* queue.h: numbers that fall due at ticks, the earliest on top: a heap of four children a node (Johnson 1975). It knows
 * nothing of what the numbers are. */
#ifndef FROE_KINETIC_QUEUE_H
#define FROE_KINETIC_QUEUE_H
#include "support/array.h"

/** The heap holds the ticks, too, so that sorting reads nothing else. */
typedef struct queue_entry {
    int64_t tick;
    uint32_t id;
} queue_entry;

typedef struct queue_heap {
    ARRAY(queue_entry) entries;
    ARRAY(uint32_t) places; /**< [id]: in the heap, or FROE_NONE */
    ARRAY(uint32_t) due;    /**< what queue_find_due() has found */
} queue_heap;

void queue_free(const froe_allocator *alloc, queue_heap *queue);
/** Room for the numbers below `ids`. False: no memory. */
bool queue_reserve(const froe_allocator *alloc, queue_heap *queue, size_t ids);
/** A number falls due at a tick, from now on. REQUIRES: there is room for it. */
void queue_set(queue_heap *queue, uint32_t id, int64_t tick);
void queue_take_out(queue_heap *queue, uint32_t id);
static inline void queue_remove(queue_heap *queue, uint32_t id) {
    if (queue->places.data[id] != FROE_NONE) queue_take_out(queue, id);
}
/** The numbers that fall due until a tick, as queue->due. False: no memory. */
bool queue_find_due(const froe_allocator *alloc, queue_heap *queue, int64_t tick);
#endif
