/* queue.c: a heap of four children a node, of numbers that fall due at ticks. */
#include "kinetic/certificate/queue.h"

void queue_free(const froe_allocator *alloc, queue_heap *queue) {
    array_free(alloc, &queue->entries);
    array_free(alloc, &queue->places);
    array_free(alloc, &queue->due);
}

bool queue_reserve(const froe_allocator *alloc, queue_heap *queue, size_t ids) {
    if (!array_reserve(alloc, &queue->entries, ids - queue->entries.count)) return false;
    while (queue->places.count < ids)
        if (!array_push(alloc, &queue->places, FROE_NONE)) return false;
    return true;
}

static void put_entry(queue_heap *queue, size_t place, queue_entry entry) {
    queue->entries.data[place] = entry;
    queue->places.data[entry.id] = (uint32_t)place;
}

/* False: it stays. */
static bool rise(queue_heap *queue, size_t place) {
    const queue_entry entry = queue->entries.data[place];
    const size_t before = place;
    for (; place && entry.tick < queue->entries.data[(place - 1) / 4].tick; place = (place - 1) / 4)
        put_entry(queue, place, queue->entries.data[(place - 1) / 4]);
    put_entry(queue, place, entry);
    return place < before;
}

/* The first of the earliest children, of which there are any. Of four, and so almost always, without a jump. */
static inline size_t earliest(const queue_entry *entries, size_t child, size_t count) {
    if (child + 4 <= count) {
        const queue_entry *e = entries + child;
        const size_t a = e[1].tick < e[0].tick, b = 2 + (size_t)(e[3].tick < e[2].tick);
        return child + (e[b].tick < e[a].tick ? b : a);
    }
    size_t best = child;
    while (++child < count)
        if (entries[child].tick < entries[best].tick) best = child;
    return best;
}

static void sink(queue_heap *queue, size_t place) {
    const queue_entry entry = queue->entries.data[place], *entries = queue->entries.data;
    const size_t count = queue->entries.count;
    for (size_t child = 4 * place + 1; child < count; child = 4 * place + 1) {
        const size_t best = earliest(entries, child, count);
        if (entries[best].tick >= entry.tick) break;
        put_entry(queue, place, entries[best]);
        place = best;
    }
    put_entry(queue, place, entry);
}

void queue_take_out(queue_heap *queue, uint32_t id) {
    const uint32_t place = queue->places.data[id];
    const queue_entry last = queue->entries.data[--queue->entries.count];
    queue->places.data[id] = FROE_NONE;
    if (last.id == id) return;
    put_entry(queue, place, last);
    if (!rise(queue, place)) sink(queue, place);
}

void queue_set(queue_heap *queue, uint32_t id, int64_t tick) {
    uint32_t *place = queue->places.data + id;
    if (*place == FROE_NONE) *place = (uint32_t)queue->entries.count++;
    queue->entries.data[*place] = (queue_entry){tick, id};
    if (!rise(queue, *place)) sink(queue, *place);
}

bool queue_find_due(const froe_allocator *alloc, queue_heap *queue, int64_t tick) {
    const size_t count = queue->entries.count;
    const queue_entry *entries = queue->entries.data;
    queue->due.count = 0;
    if (!array_reserve(alloc, &queue->due, count)) return false;
    uint32_t *due = queue->due.data;
    if (count && entries[0].tick <= tick) due[queue->due.count++] = entries[0].id;
    for (size_t i = 0; i < queue->due.count; i++) { /* breadth first: all above a due entry are due */
        size_t child = 4 * (size_t)queue->places.data[due[i]] + 1, end = child + 4;
        for (; child < end && child < count; child++)
            if (entries[child].tick <= tick) due[queue->due.count++] = entries[child].id;
    }
    return true;
}
