/* sketch.c: down with every object, and once more with those that are divided. */
#include "build/index/sketch.h"
#include <string.h>

#define SKETCH_DIVIDED 0x80000000u /* of an id: cuts above divide the object */

enum { AHEAD = 8 };
/* gcc drops calls of functions that only prefetch, as if they had no effect */
#define INLINED __attribute__((always_inline)) static inline

typedef struct sketch_fall {
    space_item item;
    uint32_t node;
    bool divided;
} sketch_fall;

typedef struct sketching {
    const froe_scene *scene;
    space_sketch *sketch;
    dealing deal;
    uint32_t height;
    sketch_fall *falls; /* [thread][height + 1] */
    uint32_t *listed;   /* [thread][node] */
    bool tame;
} sketching;

/* Prefetches what the bounds of an object further on are made from. */
INLINED void ask_ahead(const froe_scene *s, uint32_t object) {
    const uint32_t start = scene_start(s, object), corners = scene_form(s, object) == FROE_POLYGON ? 3 : 1;
    for (uint32_t c = 0; c < corners; c++) {
        const double *x = scene_vertex(s, scene_corner_vertex(s, start + c));
        __builtin_prefetch(x);
        __builtin_prefetch(x + 2); /* the next line, perhaps */
    }
}

/* On which sides of a cut an item is: 2 positive, 3 both; else negative, in the cut too, where it touches both. */
static unsigned sides_at(const space_item *item, const tree_node *n) {
    return (item->lo[n->axis] < n->u.value) | (unsigned)(item->hi[n->axis] > n->u.value) << 1;
}

static void divide_at(const froe_scene *s, bool tame, const tree_node *n, const space_item *item, space_item part[2],
                      bool left[2]) {
    const surface_cut cut = {.axis = n->axis, .value = n->u.value};
    surface_divide(s, tame, &cut, false, item, (space_item *[2]){part, part + 1}, left);
}

/* Depth first, the negative side first. The stack has one entry for each level at most. */
static froe_status deal_object(sketching *k, deal_chunk *chunk, uint32_t object, sketch_fall *stack, uint32_t *listed) {
    uint32_t top = 0;
    stack[top++] = (sketch_fall){sketch_item(k->scene, object), 0, false};
    while (top) {
        sketch_fall at = stack[--top];
        bool there = true;
        for (const tree_node *n; n = k->sketch->nodes + at.node, there && n->child;) {
            const unsigned class = sides_at(&at.item, n);
            listed[at.node]++;
            at.node = n->child + (class == 2);
            if (class != 3) continue;
            space_item part[2];
            bool left[2];
            divide_at(k->scene, k->tame, n, &at.item, part, left);
            at.divided = true;
            there = left[0] || left[1];
            if (left[0] && left[1]) stack[top++] = (sketch_fall){part[1], n->child + 1, true};
            at.node = n->child + !left[0];
            at.item = part[!left[0]];
        }
        if (!there) continue;
        const uint32_t id = object | (at.divided ? SKETCH_DIVIDED : 0);
        if (!array_push(&k->deal.alloc, &chunk->entries, (deal_entry){at.node, id})) return FROE_E_MEMORY;
        chunk->parts[at.node]++;
        listed[at.node]++;
    }
    return FROE_OK;
}

static froe_status deal_objects(void *user, unsigned worker, size_t job) {
    sketching *k = user;
    deal_chunk *chunk = k->deal.chunks + job;
    sketch_fall *stack = k->falls + (size_t)worker * (k->height + 1);
    uint32_t *listed = k->listed + (size_t)worker * k->sketch->count;
    if (!array_reserve(&k->deal.alloc, &chunk->entries, (chunk->to - chunk->from) / 4 * 5)) return FROE_E_MEMORY;
    froe_status status = FROE_OK;
    for (uint32_t i = chunk->from; i < chunk->to && !status; i++) {
        if (i + AHEAD < chunk->to) ask_ahead(k->scene, i + AHEAD);
        status = deal_object(k, chunk, i, stack, listed);
    }
    return status;
}

/* Parents, and the height. Children come after their parents. */
static froe_status find_parents(sketching *k) {
    space_sketch *s = k->sketch;
    uint32_t *depths = support_calloc(&k->deal.alloc, s->count, sizeof *depths);
    s->parents = support_calloc(&k->deal.alloc, s->count, sizeof *s->parents);
    for (uint32_t i = 0; depths && s->parents && i < s->count; i++) {
        k->height = depths[i] > k->height ? depths[i] : k->height;
        for (uint32_t c = 0; s->nodes[i].child && c < 2; c++) {
            s->parents[s->nodes[i].child + c] = i;
            depths[s->nodes[i].child + c] = depths[i] + 1;
        }
    }
    support_free(&k->deal.alloc, depths, s->count * sizeof *depths);
    return depths && s->parents ? FROE_OK : FROE_E_MEMORY;
}

froe_status sketch_new(build_job *job, const tree_node *nodes, uint32_t count, space_sketch *out) {
    const froe_allocator *alloc = &job->alloc;
    const unsigned threads = job->task->threads;
    *out = (space_sketch){.nodes = nodes, .count = count};
    sketching k = {.scene = job->scene, .sketch = out, .tame = surface_is_tame(job->scene)};
    k.deal = (dealing){.alloc = *alloc, .task = job->task, .count = job->scene->object_count, .parts = count};
    froe_status status = find_parents(&k);
    const size_t falls = (size_t)threads * (k.height + 1), all = (size_t)threads * count;
    k.falls = support_calloc(alloc, falls, sizeof *k.falls);
    k.listed = support_calloc(alloc, all, sizeof *k.listed);
    out->listed = support_calloc(alloc, count, sizeof *out->listed);
    out->starts = support_calloc(alloc, (size_t)count + 1, sizeof *out->starts);
    if (!status && (!k.falls || !k.listed || !out->listed || !out->starts)) status = FROE_E_MEMORY;
    if (!status) status = deal_new(&k.deal);
    if (!status) status = deal_each(&k.deal, 0.2, deal_objects, &k);
    for (size_t i = 0; !status && i < all; i++) out->listed[i % count] += k.listed[i];
    if (!status) status = deal_starts(&k.deal, out->starts);
    if (!status) out->ids = support_realloc(alloc, NULL, 0, out->starts[count] * sizeof *out->ids);
    if (!status && !out->ids) status = FROE_E_MEMORY;
    if (!status) status = deal_out(&k.deal, 0.05, out->ids, NULL);
    deal_free(&k.deal);
    support_free(alloc, k.falls, falls * sizeof *k.falls);
    support_free(alloc, k.listed, all * sizeof *k.listed);
    return status;
}

void sketch_free(const build_job *job, space_sketch *s) {
    const froe_allocator *alloc = &job->alloc;
    if (s->ids) support_free(alloc, s->ids, s->starts[s->count] * sizeof *s->ids);
    support_free(alloc, s->parents, s->count * sizeof *s->parents);
    support_free(alloc, s->listed, s->count * sizeof *s->listed);
    support_free(alloc, s->starts, ((size_t)s->count + 1) * sizeof *s->starts);
    *s = (space_sketch){0};
}

froe_status sketch_fill(const build_job *job, const space_sketch *s, uint32_t node, space_item *out) {
    const bool tame = surface_is_tame(job->scene);
    const uint32_t from = s->starts[node], to = s->starts[node + 1];
    ARRAY(uint32_t) path = {0}; /* from the node upwards */
    for (uint32_t at = node; at; at = s->parents[at])
        if (!array_push(&job->alloc, &path, at)) return array_free(&job->alloc, &path), FROE_E_MEMORY;
    for (uint32_t i = from; i < to; i++) {
        const uint32_t object = s->ids[i] & ~SKETCH_DIVIDED;
        if (i + 2 * AHEAD < to) scene_ask_start(job->scene, s->ids[i + 2 * AHEAD] & ~SKETCH_DIVIDED);
        if (i + AHEAD < to) ask_ahead(job->scene, s->ids[i + AHEAD] & ~SKETCH_DIVIDED);
        space_item item = sketch_item(job->scene, object);
        for (size_t p = path.count; s->ids[i] & SKETCH_DIVIDED && p--;) {
            const tree_node *n = s->nodes + s->parents[path.data[p]];
            if (sides_at(&item, n) != 3) continue;
            space_item part[2];
            bool left[2];
            divide_at(job->scene, tame, n, &item, part, left);
            item = part[path.data[p] - n->child];
        }
        out[i - from] = item;
    }
    array_free(&job->alloc, &path);
    return FROE_OK;
}
