/* homes.c: one descent per object, then a counting sort of the objects by home. */
#include "split/homes.h"

enum { CHUNK = 8192, ABREAST = 8 }; /* objects per job, and going down together */

typedef struct box {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
} box;

typedef struct descent {
    const froe_scene *scene;
    const split_guard_node *nodes;
    base_task *task;
    uint32_t *home;
} descent;

/** For each box the lowest node whose cell holds it, or the first whose cut it lies across, or in. Several
 * boxes go down abreast, so that one waits for memory while others go on. */
static void find_homes(const split_guard_node *nodes, const box *boxes, size_t count, uint32_t *home) {
    for (size_t i = 0; i < count; i++) home[i] = 0;
    for (bool moving = true; moving;) {
        moving = false;
        for (size_t i = 0; i < count; i++) {
            const split_guard_node *n = nodes + home[i];
            bool below = boxes[i].lo[n->axis]<n->value, above = boxes[i].hi[n->axis]> n->value;
            bool step = n->child && below != above;
            home[i] = step ? n->child + above : home[i];
            moving |= step;
        }
    }
}

static froe_status descend_chunk(void *user, unsigned worker, size_t job) {
    const descent *d = user;
    size_t first = job * CHUNK, last = first + CHUNK;
    box boxes[ABREAST];
    (void)worker;
    if (base_cancelled(d->task)) return FROE_E_CANCELLED;
    if (last > d->scene->object_count) last = d->scene->object_count;
    for (size_t i = first; i < last; i += ABREAST) {
        size_t count = last - i < ABREAST ? last - i : ABREAST;
        for (size_t k = 0; k < count; k++) scene_object_bounds(d->scene, (uint32_t)(i + k), boxes[k].lo, boxes[k].hi);
        find_homes(d->nodes, boxes, count, d->home + i);
    }
    return FROE_OK;
}

/** Slices from the numbers of own homes: children come later than their parent, so two passes do. */
static void make_slices(const split_guard_node *nodes, const uint32_t *own, split_homes *h) {
    for (size_t v = h->node_count; v-- > 0;) { /* end: so many homes in the subtree */
        uint32_t child = nodes[v].child;
        h->end[v] = own[v] + (child ? h->end[child] + h->end[child + 1] : 0);
    }
    h->at[0] = 0;
    for (size_t v = 0; v < h->node_count; v++) {
        uint32_t child = nodes[v].child;
        if (child) {
            h->at[child] = h->at[v] + own[v];
            h->at[child + 1] = h->at[child] + h->end[child];
        }
        h->end[v] += h->at[v];
    }
}

/** Counting sort of the objects by home. `own` is zero. */
static void sort_by_home(const split_guard_node *nodes, const uint32_t *home, uint32_t *own, split_homes *h) {
    for (size_t i = 0; i < h->object_count; i++) own[home[i]]++;
    make_slices(nodes, own, h);
    for (size_t v = 0; v < h->node_count; v++) own[v] = h->at[v];
    for (uint32_t i = 0; i < h->object_count; i++) h->ids[own[home[i]]++] = i;
}

void split_homes_free(const froe_allocator *alloc, split_homes *h) {
    base_free(alloc, h->ids, h->object_count * sizeof *h->ids);
    base_free(alloc, h->at, h->node_count * sizeof *h->at);
    base_free(alloc, h->end, h->node_count * sizeof *h->end);
    *h = (split_homes){0};
}

/** Memory for count numbers, not cleared; one at least. */
static uint32_t *numbers(const froe_allocator *alloc, size_t count) {
    return base_realloc(alloc, NULL, 0, count * sizeof(uint32_t));
}

froe_status split_homes_make(const froe_allocator *alloc, base_task *task, const froe_scene *scene,
                             const split_guard_tree *guard, split_homes *out) {
    size_t n = scene->object_count, m = guard->nodes.count;
    if (!n) return FROE_OK;
    split_homes h = {.object_count = n, .node_count = m};
    h.ids = numbers(alloc, n);
    h.at = numbers(alloc, m);
    h.end = numbers(alloc, m);
    uint32_t *home = numbers(alloc, n), *own = base_calloc(alloc, m, sizeof *own);
    froe_status status = h.ids && h.at && h.end && home && own ? FROE_OK : FROE_E_MEMORY;
    descent d = {scene, guard->nodes.data, task, home};
    if (!status) status = base_run(task, 0, (n + CHUNK - 1) / CHUNK, descend_chunk, &d);
    if (!status) sort_by_home(guard->nodes.data, home, own, &h);
    base_free(alloc, home, n * sizeof *home);
    base_free(alloc, own, m * sizeof *own);
    if (status)
        split_homes_free(alloc, &h);
    else
        *out = h;
    return status;
}
