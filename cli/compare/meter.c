/* meter.c: malloc, realloc and free with a count of bytes. */
#include "compare/meter.h"
#include <stdlib.h>

static void count(meter *m, size_t old_size, size_t new_size) {
    const size_t now = atomic_fetch_add(&m->now, new_size - old_size) + new_size - old_size; /* modulo 2^64 */
    size_t most = atomic_load(&m->most);
    while (new_size > old_size && now > most && !atomic_compare_exchange_weak(&m->most, &most, now)) continue;
}

static void *allocate(void *user, void *ptr, size_t old_size, size_t new_size) {
    if (!ptr) old_size = 0;
    if (new_size == 0) {
        free(ptr);
        count(user, old_size, 0);
        return NULL;
    }
    void *block = realloc(ptr, new_size);
    if (block) count(user, old_size, new_size);
    return block;
}

froe_allocator meter_allocator(meter *m) {
    return (froe_allocator){allocate, m};
}

size_t meter_restart(meter *m) {
    const size_t now = atomic_load(&m->now);
    atomic_store(&m->most, now);
    return now;
}
