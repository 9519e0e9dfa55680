/* guard_work.c: the loop that builds the guard tree, and the choice of steps.
 *
 * Credit (after Callahan and Kosaraju's phases): an item may move 8 guards for each that it has.
 * Steps spend it, one for each guard they read; parts of at most half the size get their own.
 * What has no credit left lies in a deep, lopsided place, and a phase deals with it in
 * O(d m) after sorting, whatever the depth. So all steps together take O(d n log n). */
#include "split/guard/guard_work.h"
#include <string.h>

enum { CREDIT = 8 };
enum { BUCKET_BITS = 10 }; /* of the largest histogram */

void guard_worker_free(guard_worker *w) {
    const froe_allocator *alloc = w->plan->alloc;
    array_free(alloc, &w->items);
    array_free(alloc, &w->cubes);
    array_free(alloc, &w->scratch);
}

void *guard_scratch(guard_worker *w, size_t bytes) {
    size_t words = bytes / sizeof(uint64_t) + 1;
    if (words > w->scratch.capacity) { /* nothing to keep: no copy */
        array_free(w->plan->alloc, &w->scratch);
        if (!array_reserve(w->plan->alloc, &w->scratch, words)) return NULL;
    }
    return w->scratch.data;
}

froe_status guard_stack(guard_worker *w, const guard_item *item, const guard_cube *cube) {
    const froe_allocator *alloc = w->plan->alloc;
    size_t dim = (size_t)w->plan->dim;
    if (!array_reserve(alloc, &w->items, 1) || !array_reserve(alloc, &w->cubes, 2 * dim)) return FROE_E_MEMORY;
    w->items.data[w->items.count++] = *item;
    double *room = w->cubes.data + w->cubes.count;
    for (size_t i = 0; i < dim; i++) {
        room[i] = cube->lo[i];
        room[dim + i] = cube->hi[i];
    }
    w->cubes.count += 2 * dim;
    return FROE_OK;
}

froe_status guard_push(guard_worker *w, const guard_item *whole, const guard_item *part, const guard_cube *cube) {
    if (part->count <= w->plan->k) {
        guard_leaf(w, part->node, part->count);
        return FROE_OK;
    }
    guard_item item = *part;
    if (whole && part->count > whole->ration / 2) {
        item.ration = whole->ration;
        item.credit = whole->credit - (whole->credit < whole->count ? whole->credit : whole->count);
    } else {
        item.ration = part->count;
        item.credit = CREDIT * (uint64_t)part->count;
    }
    return guard_stack(w, &item, cube);
}

void guard_pop(guard_worker *w, guard_item *item, guard_cube *cube) {
    size_t dim = (size_t)w->plan->dim;
    *item = w->items.data[--w->items.count];
    w->cubes.count -= 2 * dim;
    const double *room = w->cubes.data + w->cubes.count;
    for (size_t i = 0; i < dim; i++) {
        cube->lo[i] = room[i];
        cube->hi[i] = room[dim + i];
    }
}

froe_status guard_step(guard_worker *w, const guard_item *item, const guard_cube *cube) {
    split_guard_way way = w->plan->way;
    if (way == SPLIT_GUARD_PHASES || (way == SPLIT_GUARD_HYBRID && !item->credit)) return guard_phase(w, item, cube);
    bool one = way == SPLIT_GUARD_PLAIN || item->shrink;
    int levels = one ? 1 : guard_grid_levels(item->count, w->plan->dim, BUCKET_BITS);
    return levels > 1 ? guard_bucket(w, item, cube, levels) : guard_octree(w, item, cube);
}

froe_status guard_run(guard_worker *w) {
    while (w->items.count) {
        guard_item item;
        guard_cube cube;
        if (base_cancelled(w->plan->task)) return FROE_E_CANCELLED;
        guard_pop(w, &item, &cube);
        froe_status status = guard_step(w, &item, &cube);
        if (status) return status;
    }
    return FROE_OK;
}
