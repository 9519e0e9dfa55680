/* work.c: see work.h. */
#include "query/groups/work.h"
#include "query/heap.h"

void query_groups_work_free(query_groups_work *w, const froe_allocator *alloc) {
    for (int i = 0; i < 2; i++) array_free(alloc, &w->lines[i]);
    array_free(alloc, &w->events);
    array_free(alloc, &w->order);
    array_free(alloc, &w->near);
    array_free(alloc, &w->candidates);
    array_free(alloc, &w->points);
    array_free(alloc, &w->corners);
    array_free(alloc, &w->groups);
    support_free(alloc, w->tallies, w->tally_count * sizeof *w->tallies);
    *w = (query_groups_work){0};
}

/* A stamp that comes round again would find old counts. */
bool query_groups_begin(query_groups_work *w, const froe_allocator *alloc, uint32_t groups) {
    w->groups.count = 0;
    if (!w->tallies && groups) {
        w->tallies = support_calloc(alloc, groups, sizeof *w->tallies);
        if (!w->tallies) return false;
        w->tally_count = groups;
    }
    if (++w->stamp) return true;
    for (uint32_t i = 0; i < w->tally_count; i++) w->tallies[i] = (query_tally){0};
    w->stamp = 1;
    return true;
}

static bool is_higher(void *user, uint32_t a, uint32_t b) {
    (void)user;
    return a > b;
}

void query_groups_end(query_groups_work *w) {
    query_heap_sort(w->groups.data, w->groups.count, is_higher, NULL);
}
