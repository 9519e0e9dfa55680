/* heap.h: binary heaps of numbers that stand for items elsewhere (Williams: Heapsort, 1964). */
#ifndef FROE_QUERY_HEAP_H
#define FROE_QUERY_HEAP_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** Does item a go above item b? */
typedef bool query_above_fn(void *user, uint32_t a, uint32_t b);

/** Lets the item at place i rise. */
static inline void query_heap_rise(uint32_t *heap, size_t i, query_above_fn *above, void *user) {
    const uint32_t item = heap[i];
    for (; i && above(user, item, heap[(i - 1) / 2]); i = (i - 1) / 2) heap[i] = heap[(i - 1) / 2];
    heap[i] = item;
}

/** Lets the item at place i sink. */
static inline void query_heap_sink(uint32_t *heap, size_t count, size_t i, query_above_fn *above, void *user) {
    const uint32_t item = heap[i];
    for (size_t child = 2 * i + 1; child < count; child = 2 * i + 1) {
        if (child + 1 < count && above(user, heap[child + 1], heap[child])) child++;
        if (!above(user, heap[child], item)) break;
        heap[i] = heap[child];
        i = child;
    }
    heap[i] = item;
}

/** Sorts a heap, the top one last. */
static inline void query_heap_unwind(uint32_t *heap, size_t count, query_above_fn *above, void *user) {
    while (count-- > 1) {
        const uint32_t top = heap[0];
        heap[0] = heap[count];
        heap[count] = top;
        query_heap_sink(heap, count, 0, above, user);
    }
}

enum { QUERY_HEAP_FEW = 24 };

/** Sorts any numbers, those that go above others last; few by insertion, which is quick for what is nearly in order. */
static inline void query_heap_sort(uint32_t *items, size_t count, query_above_fn *above, void *user) {
    for (size_t i = 1; i < count && count <= QUERY_HEAP_FEW; i++) {
        const uint32_t item = items[i];
        size_t at = i;
        for (; at && above(user, items[at - 1], item); at--) items[at] = items[at - 1];
        items[at] = item;
    }
    if (count <= QUERY_HEAP_FEW) return;
    for (size_t i = count / 2; i-- > 0;) query_heap_sink(items, count, i, above, user);
    query_heap_unwind(items, count, above, user);
}
#endif
