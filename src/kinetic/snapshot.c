/* snapshot.c: the present of a kinetic partition as an ordinary tree. */
#include "base/sort.h"
#include "base/status.h"
#include "kinetic/live.h"

typedef struct picture {
    froe_kinetic *k;
    uint32_t *objects, *order; /* ids in the motion, by id; positions in it, the first to cut first */
    size_t count, rounded;
    double *coords;
    uint64_t *tags;
} picture;

static bool picture_new(froe_kinetic *k, picture *p) {
    size_t n = 0;
    for (uint32_t s = 0; s < k->segments.count; s++) n += segment_at(k, s)->alive;
    *p = (picture){.k = k, .count = n};
    p->objects = base_calloc(&k->alloc, n + 1, sizeof *p->objects);
    p->order = base_calloc(&k->alloc, 2 * n + 1, sizeof *p->order);
    p->coords = base_calloc(&k->alloc, 4 * n + 1, sizeof *p->coords);
    p->tags = base_calloc(&k->alloc, n + 1, sizeof *p->tags);
    return p->objects && p->order && p->coords && p->tags;
}

static void picture_free(picture *p) {
    const froe_allocator *alloc = &p->k->alloc;
    base_free(alloc, p->objects, (p->count + 1) * sizeof *p->objects);
    base_free(alloc, p->order, (2 * p->count + 1) * sizeof *p->order);
    base_free(alloc, p->coords, (4 * p->count + 1) * sizeof *p->coords);
    base_free(alloc, p->tags, (p->count + 1) * sizeof *p->tags);
}

static int by_key(void *user, uint32_t a, uint32_t b) {
    const picture *p = user;
    return comes_before(p->k, p->objects[a], p->objects[b]) ? -1 : 1;
}

static void take_objects(picture *p) {
    const froe_kinetic *k = p->k;
    uint32_t n = 0;
    for (uint32_t s = 0; s < k->segments.count; s++) {
        if (!segment_at(k, s)->alive) continue;
        p->objects[n] = s;
        p->tags[n] = k->now.motion->objects.data[s].tag;
        p->order[n] = n;
        n++;
    }
    if (n > 1) base_merge_sort(p->order, p->order + n, n, by_key, p);
}

/* A vertex that several segments share is rounded alike, and counted for each of its segments but the first no more. */
static void take_places(picture *p) {
    froe_kinetic *k = p->k;
    for (size_t i = 0; i < p->count; i++)
        for (uint32_t e = 0; e < 2; e++) {
            uint32_t vertex = k->now.segments.data[p->objects[i]].end[e];
            bool exact = now_round(&k->now, vertex, p->coords + 4 * i + 2 * e);
            p->rounded += !exact && k->vertices.data[vertex] == 2 * p->objects[i] + e;
        }
}

static froe_status build(const picture *p, froe_tree **tree, froe_diagnostic *diag) {
    froe_scene *scene = NULL;
    froe_status status = froe_scene_new(2, &p->k->alloc, &scene);
    if (status) return base_fail_memory(diag);
    froe_objects batch = froe_objects_defaults();
    batch.kind = FROE_SEGMENT;
    batch.count = p->count, batch.coords = p->coords, batch.tags = p->tags;
    froe_build_options o = froe_build_defaults();
    o.method = "cylindrical";
    o.leaf = 0;
    o.order = p->order, o.order_count = p->count;
    status = froe_scene_add(scene, &batch, diag);
    if (!status) status = froe_build(scene, &o, tree, diag);
    froe_scene_free(scene); /* the tree holds it */
    return status;
}

froe_status froe_kinetic_snapshot(froe_kinetic *k, froe_tree **tree, size_t *rounded, froe_diagnostic *diag) {
    if (!k || !tree) return base_fail(diag, FROE_E_ARG, "froe_kinetic_snapshot: NULL");
    picture p;
    froe_status status = FROE_E_MEMORY;
    if (picture_new(k, &p)) {
        take_objects(&p);
        take_places(&p);
        status = build(&p, tree, diag);
    } else {
        base_fail_memory(diag);
    }
    if (!status && rounded) *rounded = p.rounded;
    picture_free(&p);
    return status;
}
