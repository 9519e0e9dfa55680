/* gather.c: what shards have found, question by question; see ask.h. */
#include "shards/ask/ask.h"
#include <stdlib.h>

bool shards_gather_take(void *gather, size_t i, const froe_find *find) {
    shards_gather *g = gather;
    return array_push(&g->alloc, &g->list, (shards_placed){i, *find});
}

bool shards_add_count(void *counts, size_t i, const froe_find *find) {
    ((uint64_t *)counts)[i] += find->tag;
    return true;
}

static int by_tag(const void *a, const void *b) {
    const froe_find *x = a, *y = b;
    if (x->tag != y->tag) return x->tag < y->tag ? -1 : 1;
    if (x->shard != y->shard) return x->shard < y->shard ? -1 : 1;
    return (x->object > y->object) - (x->object < y->object);
}

void shards_sort_by_tag(froe_find *items, size_t count) {
    qsort(items, count, sizeof *items, by_tag);
}

/* Merges from below, which keeps the order of equal values: a shard tells them in their exact order. */
static void sort_by_value(froe_find *items, froe_find *room, size_t count) {
    for (size_t width = 1; width < count; width *= 2) {
        for (size_t first = 0; first < count; first += 2 * width) {
            const size_t middle = width < count - first ? first + width : count;
            const size_t end = width < count - middle ? middle + width : count;
            for (size_t to = first, a = first, b = middle; to < end; to++)
                room[to] = b == end || (a < middle && items[a].value <= items[b].value) ? items[a++] : items[b++];
        }
        memcpy(items, room, count * sizeof *items);
    }
}

froe_status shards_gather_finds(shards_gather *g, size_t questions, froe_finds *out) {
    froe_finds f = {.questions = questions, .alloc = g->alloc};
    const size_t starts = (questions + 2) * sizeof *f.starts, items = (g->list.count + 1) * sizeof *f.items;
    froe_find *room = g->values ? support_realloc(&g->alloc, NULL, 0, items) : NULL;
    f.starts = support_calloc(&g->alloc, 1, starts);
    f.items = support_calloc(&g->alloc, 1, items);
    const bool made = f.starts && f.items && (room || !g->values);
    if (made) {
        size_t *at = f.starts + 1; /* [i + 1] counts first; then it is where question i goes on */
        for (size_t i = 0; i < g->list.count; i++) at[g->list.data[i].question + 1]++;
        for (size_t i = 0; i < questions; i++) at[i + 1] += at[i];
        for (size_t i = 0; i < g->list.count; i++) f.items[at[g->list.data[i].question]++] = g->list.data[i].find;
        for (size_t i = 0; i < questions; i++) {
            const size_t count = f.starts[i + 1] - f.starts[i];
            if (g->values)
                sort_by_value(f.items + f.starts[i], room, count);
            else
                shards_sort_by_tag(f.items + f.starts[i], count);
        }
        *out = f;
    } else {
        if (f.starts) support_free(&g->alloc, f.starts, starts);
        if (f.items) support_free(&g->alloc, f.items, items);
    }
    if (room) support_free(&g->alloc, room, items);
    array_free(&g->alloc, &g->list);
    return made ? FROE_OK : FROE_E_MEMORY;
}

void froe_finds_free(froe_finds *f) {
    if (!f || !f->starts) return;
    const size_t items = f->starts[f->questions + 1] + 1; /* see shards_gather_finds() */
    support_free(&f->alloc, f->items, items * sizeof *f->items);
    support_free(&f->alloc, f->starts, (f->questions + 2) * sizeof *f->starts);
    *f = (froe_finds){.alloc = f->alloc};
}
