/* vertices.c: the vertex table: equal coordinates get one id.
 *
 * A large scene misses the cache twice per corner, in the table and in the
 * coordinates; so a chunk of points first prefetches all the slots, then all the
 * candidates, and then compares. */
#include "base/random.h"
#include "scene/store.h"
#include <string.h>

uint32_t scene_vertex_tag(const double *point, int dim) {
    uint64_t hash = (uint64_t)dim;
    for (int k = 0; k < dim; k++) {
        uint64_t bits;
        memcpy(&bits, point + k, sizeof bits);
        hash = base_mix(hash ^ bits) + 0x9e3779b97f4a7c15u;
    }
    return (uint32_t)(hash >> 32);
}

/** Enters all vertices into the table, where it is not made. */
static bool make_vertex_table(froe_scene *s) {
    struct scene_store *store = s->store;
    const uint32_t count = store->vertex_count;
    uint32_t tags[SCENE_CHUNK];
    if (store->table.count >= count) return true; /* more: of a batch on its way */
    if (!scene_table_reserve(&s->alloc, &store->table, count)) return false;
    for (uint32_t done = 0; done < count; done += SCENE_CHUNK) {
        const uint32_t some = count - done < SCENE_CHUNK ? count - done : SCENE_CHUNK;
        for (uint32_t i = 0; i < some; i++) {
            tags[i] = scene_vertex_tag(store->coords.data + (size_t)(done + i) * (size_t)s->dim, s->dim);
            __builtin_prefetch(store->table.slots + scene_table_first(&store->table, tags[i]), 1);
        }
        for (uint32_t i = 0; i < some; i++) {
            size_t at = scene_table_first(&store->table, tags[i]);
            while (scene_table_find(&store->table, tags[i], &at) != FROE_NONE) at = (at + 1) & (store->table.size - 1);
            scene_table_put(&store->table, at, tags[i], done + i);
        }
    }
    return true;
}

froe_status scene_vertices_add(froe_scene *s, const double *points, size_t count, uint32_t *ids) {
    struct scene_store *store = s->store;
    size_t dim = (size_t)s->dim;
    uint32_t tags[SCENE_CHUNK];
    if (!make_vertex_table(s) || !scene_table_reserve(&s->alloc, &store->table, count)) return FROE_E_MEMORY;
    if (!array_reserve(&s->alloc, &store->coords, count * dim)) return FROE_E_MEMORY;
    for (size_t i = 0; i < count; i++) tags[i] = scene_vertex_tag(points + i * dim, s->dim);
    for (size_t i = 0; i < count; i++)
        __builtin_prefetch(store->table.slots + scene_table_first(&store->table, tags[i]));
    for (size_t i = 0; i < count; i++) {
        uint32_t next_id = store->table.slots[scene_table_first(&store->table, tags[i])].next_id;
        if (next_id) __builtin_prefetch(store->coords.data + (size_t)(next_id - 1) * dim);
    }
    for (size_t i = 0; i < count; i++) {
        const double *point = points + i * dim;
        size_t at = scene_table_first(&store->table, tags[i]);
        ids[i] = scene_table_find(&store->table, tags[i], &at);
        while (ids[i] != FROE_NONE &&
               memcmp(store->coords.data + (size_t)ids[i] * dim, point, dim * sizeof *point) != 0)
            ids[i] = scene_table_find_next(&store->table, tags[i], &at);
        if (ids[i] != FROE_NONE) continue;
        if (store->table.count == SCENE_LIMIT) return FROE_E_LIMIT; /* one way: so many take 60 GB */
        ids[i] = (uint32_t)store->table.count;
        scene_table_put(&store->table, at, tags[i], ids[i]);
        memcpy(store->coords.data + store->coords.count, points + i * dim, dim * sizeof *points);
        store->coords.count += dim;
    }
    return FROE_OK;
}

void scene_vertices_truncate(froe_scene *s, uint32_t count) {
    struct scene_store *store = s->store;
    size_t dim = (size_t)s->dim;
    while (store->table.count > count) {
        store->coords.count -= dim;
        const double *last = store->coords.data + store->coords.count;
        scene_table_remove(&store->table, scene_vertex_tag(last, s->dim), (uint32_t)store->table.count - 1);
    }
    store->coords.count = count * dim; /* where there is no table */
}
