/* pair_lists.c: see pair_lists.h. */
#include "query/pairs/pair_lists.h"
#include "base/floats.h"
#include "query/heap.h"

enum { PAIRS_AT_ONCE = 1024 }; /* pairs that a thread takes from the common stock at a time */
#define PAIR_OBJECT ((1u << PAIR_KIND) - 1)

froe_status pair_lists_take(pair_lists *out, const froe_allocator *alloc, uint32_t objects, unsigned threads) {
    const uint64_t most = (uint64_t)objects * PAIRS_EACH + PAIRS_MORE;
    *out = (pair_lists){.alloc = alloc, .objects = objects, .threads = threads};
    atomic_init(&out->left, most < UINT32_MAX ? (unsigned)most : UINT32_MAX);
    while (objects >> out->shift >= PAIR_PARTS) out->shift++;
    out->lists = support_calloc(alloc, threads, sizeof *out->lists);
    return out->lists ? FROE_OK : FROE_E_MEMORY;
}

void pair_lists_give(pair_lists *l) {
    for (unsigned i = 0; l->lists && i < l->threads; i++)
        for (int part = 0; part < PAIR_PARTS; part++) array_free(l->alloc, &l->lists[i].parts[part]);
    support_free(l->alloc, l->lists, l->threads * sizeof *l->lists);
    support_free(l->alloc, l->starts, ((size_t)l->objects + 1) * sizeof *l->starts);
    support_free(l->alloc, l->sorted, (l->firsts[PAIR_PARTS] + 1) * sizeof *l->sorted);
}

froe_status pair_lists_add(pair_lists *l, unsigned thread, uint32_t a, uint32_t b, froe_meeting kind) {
    pair_list *list = l->lists + thread;
    const pair_item item = {a < b ? a : b, (a < b ? b : a) | (uint32_t)kind << PAIR_KIND};
    if (!list->room) { /* takes room for up to PAIRS_AT_ONCE pairs from what is left for all threads */
        unsigned left = atomic_load(&l->left), taken;
        do taken = left < PAIRS_AT_ONCE ? left : PAIRS_AT_ONCE;
        /* one way: another thread has to be faster between two lines */
        while (taken && !atomic_compare_exchange_weak(&l->left, &left, left - taken));
        list->room = taken;
        if (!taken) return FROE_E_LIMIT;
    }
    if (!array_push(l->alloc, &list->parts[item.a >> l->shift], item)) return FROE_E_MEMORY;
    list->room--;
    return FROE_OK;
}

/* ----------------------------------------------------------------- sorting -- */

static bool pair_is_later(void *user, uint32_t i, uint32_t j) {
    (void)user;
    return (i & PAIR_OBJECT) > (j & PAIR_OBJECT);
}

static froe_status sort_part(void *user, unsigned worker, size_t part) {
    const pair_lists *l = user;
    const uint64_t next = (uint64_t)(part + 1) << l->shift;
    const uint32_t from = (uint32_t)part << l->shift, to = next < l->objects ? (uint32_t)next : l->objects;
    (void)worker;
    if (from >= to) return FROE_OK;
    /* Counts the pairs of each first id; starts[id] is then where those of the next id begin. */
    for (unsigned t = 0; t < l->threads; t++)
        for (size_t i = 0; i < l->lists[t].parts[part].count; i++) l->starts[l->lists[t].parts[part].data[i].a]++;
    uint32_t sum = (uint32_t)l->firsts[part];
    for (uint32_t id = from; id < to; id++) l->starts[id] = sum += l->starts[id];
    /* Puts the pairs in their places, the last first: then starts[id] is where the pairs of id begin. */
    for (unsigned t = 0; t < l->threads; t++)
        for (size_t i = 0; i < l->lists[t].parts[part].count; i++) {
            const pair_item item = l->lists[t].parts[part].data[i];
            l->sorted[--l->starts[item.a]] = item.b;
        }
    for (uint32_t id = from; id < to; id++) {
        const size_t end = id + 1 < to ? l->starts[id + 1] : l->firsts[part + 1];
        query_heap_sort(l->sorted + l->starts[id], end - l->starts[id], pair_is_later, NULL);
    }
    return FROE_OK;
}

froe_status pair_lists_sort(pair_lists *l, base_task *task, double span) {
    size_t sum = 0;
    for (int part = 0; part < PAIR_PARTS; part++) {
        l->firsts[part] = sum;
        for (unsigned t = 0; t < l->threads; t++) sum += l->lists[t].parts[part].count;
    }
    l->starts = support_calloc(l->alloc, (size_t)l->objects + 1, sizeof *l->starts);
    l->sorted = support_calloc(l->alloc, sum + 1, sizeof *l->sorted);
    l->firsts[PAIR_PARTS] = sum;
    if (!l->starts || !l->sorted) return FROE_E_MEMORY;
    l->starts[l->objects] = (uint32_t)sum;
    return base_run(task, span, PAIR_PARTS, sort_part, l);
}

void pair_lists_tell(const pair_lists *l, froe_pair_fn *fn, void *user) {
    for (uint32_t a = 0; a < l->objects; a++)
        for (uint32_t i = l->starts[a]; i < l->starts[a + 1]; i++) {
            const uint32_t b = l->sorted[i];
            const froe_pair pair = {a, b & PAIR_OBJECT, (froe_meeting)(b >> PAIR_KIND)};
            if (!base_callback(fn(user, &pair))) return;
        }
}
