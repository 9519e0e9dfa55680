/* guards.c: the vertices of bounding boxes, counted first, then written, by many threads at once. */
#include "split/guard/guards.h"
#include <string.h>

enum { OBJECTS_PER_CHUNK = 1 << 14 };

typedef struct collection {
    const froe_scene *scene;
    const uint32_t *ids;
    size_t objects;
    size_t *starts; /* [chunk + 1] first its count, then its first guard */
    double *points;
} collection;

static void bounds_of(const collection *c, size_t at, double *lo, double *hi) {
    scene_object_bounds(c->scene, c->ids ? c->ids[at] : (uint32_t)at, lo, hi);
}

static size_t chunk_end(const collection *c, size_t chunk) {
    size_t end = (chunk + 1) * OBJECTS_PER_CHUNK;
    return end < c->objects ? end : c->objects;
}

static froe_status count_chunk(void *user, unsigned worker, size_t chunk) {
    (void)worker;
    collection *c = user;
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    size_t count = 0;
    for (size_t at = chunk * OBJECTS_PER_CHUNK; at < chunk_end(c, chunk); at++) {
        size_t vertices = 1;
        bounds_of(c, at, lo, hi);
        for (int i = 0; i < c->scene->dim; i++) vertices <<= lo[i] < hi[i];
        count += vertices;
    }
    c->starts[chunk + 1] = count;
    return FROE_OK;
}

size_t guards_of_box(int dim, const double *lo, const double *hi, double *out) {
    const size_t d = (size_t)dim;
    size_t count = 1;
    memcpy(out, lo, d * sizeof *out);
    /* Doubles the list of vertices for every axis on which the box is not flat. */
    for (size_t i = 0; i < d; i++) {
        if (!(lo[i] < hi[i])) continue;
        memcpy(out + count * d, out, count * d * sizeof *out);
        for (size_t v = count; v < 2 * count; v++) out[v * d + i] = hi[i];
        count *= 2;
    }
    return count;
}

static froe_status write_chunk(void *user, unsigned worker, size_t chunk) {
    (void)worker;
    collection *c = user;
    size_t dim = (size_t)c->scene->dim;
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], *to = c->points + c->starts[chunk] * dim;
    for (size_t at = chunk * OBJECTS_PER_CHUNK; at < chunk_end(c, chunk); at++) {
        bounds_of(c, at, lo, hi);
        to += dim * guards_of_box(c->scene->dim, lo, hi, to);
    }
    return FROE_OK;
}

static froe_status collect_guards(const froe_allocator *alloc, base_task *task, double span, collection *c,
                                  size_t chunks, split_guards *out) {
    froe_status status = base_run(task, 0.5 * span, chunks, count_chunk, c);
    if (status) return status;
    for (size_t chunk = 0; chunk < chunks; chunk++) c->starts[chunk + 1] += c->starts[chunk];
    size_t count = c->starts[chunks], size;
    if (__builtin_mul_overflow(count, (size_t)c->scene->dim * sizeof(double), &size)) return FROE_E_MEMORY;
    c->points = size ? support_realloc(alloc, NULL, 0, size) : NULL;
    if (size && !c->points) return FROE_E_MEMORY;
    status = base_run(task, 0.5 * span, chunks, write_chunk, c);
    if (status)
        support_free(alloc, c->points, size);
    else
        *out = (split_guards){.dim = c->scene->dim, .count = count, .capacity = count, .points = c->points};
    return status;
}

froe_status split_guards_of(const froe_allocator *alloc, base_task *task, double span, const froe_scene *scene,
                            const uint32_t *ids, size_t count, split_guards *out) {
    size_t chunks = (count + OBJECTS_PER_CHUNK - 1) / OBJECTS_PER_CHUNK;
    collection c = {.scene = scene, .ids = ids, .objects = count};
    c.starts = support_calloc(alloc, chunks + 1, sizeof *c.starts);
    if (!c.starts) return FROE_E_MEMORY;
    froe_status status = collect_guards(alloc, task, span, &c, chunks, out);
    support_free(alloc, c.starts, (chunks + 1) * sizeof *c.starts);
    return status;
}

void split_guards_free(const froe_allocator *alloc, split_guards *guards) {
    support_free(alloc, guards->points, guards->capacity * (size_t)guards->dim * sizeof *guards->points);
    *guards = (split_guards){.dim = guards->dim};
}
