/* settle.c: the objects of a batch among those of the scene. An array that has said nothing so far stays away as long
 * as the batch is like all objects before (scene.h). */
#include "scene/forms.h"
#include <string.h>

/** An optional array stays empty until an object is not like the default; then it tells of all. */
#define reserve_optional(a, array, wanted)                                                                             \
    (!((array)->count || (wanted)) ||                                                                                  \
     array_reserve(&(a)->scene->alloc, (array), ((array)->count ? 0 : (a)->scene->object_count) + (a)->batch->count))

/** Room for `extra` more items behind `count` that the array has or, so far, has not told of. */
#define reserve_told(a, array, told, extra)                                                                            \
    array_reserve(&(a)->scene->alloc, (array), ((array)->count ? 0 : (size_t)(told)) + (extra))

/** The ids of the batch are behind those of no corner so far; the corners before them get theirs. */
static bool tell_ids(scene_adding *a) {
    struct scene_store *store = a->scene->store;
    const uint32_t old = store->corner_count;
    const size_t room = a->corners + a->gap;
    if (!reserve_told(a, &store->vertex_of, old, room)) return false;
    uint32_t *data = store->vertex_of.data;
    if (!store->vertex_of.count) {
        if (!a->in_order) memmove(data + old, data, room * sizeof *data);
        for (uint32_t i = 0; i < old; i++) data[i] = i;
        store->vertex_of.count = old;
    }
    uint32_t *ids = scene_adding_ids(a);
    for (size_t i = 0; a->in_order && i < a->corners; i++) ids[i] = store->vertex_count + (uint32_t)i;
    a->in_order = false;
    return true;
}

froe_status scene_adding_settle(scene_adding *a) {
    const froe_scene *s = a->scene;
    const froe_objects *b = a->batch;
    struct scene_store *store = s->store;
    const bool empty = !store->object_count, like = empty || s->form == a->form, regular = empty || s->each == a->each;
    a->kinds = store->kind_of.count || !(empty || s->kind == b->kind);
    a->forms = store->form_of.count || !a->plain || !like;
    a->starts = store->start_of.count || !a->plain || !regular;
    a->ids = store->vertex_of.count || !a->plain || !a->in_order;
    bool room = array_reserve(&s->alloc, &store->radii, a->gap) && reserve_optional(a, &store->tags, b->tags) &&
                reserve_optional(a, &store->faces, b->faces) &&
                reserve_optional(a, &store->groups, b->groups || b->group != FROE_NONE);
    if (room && a->kinds) room = reserve_told(a, &store->kind_of, s->object_count, b->count);
    if (room && a->forms) room = reserve_told(a, &store->form_of, s->object_count, b->count);
    if (room && a->starts) room = reserve_told(a, &store->start_of, s->object_count + 1, b->count);
    if (room && a->ids) room = tell_ids(a);
    if (!room) return FROE_E_MEMORY;
    if (a->kinds && !store->kind_of.count) {
        memset(store->kind_of.data, (int)s->kind, s->object_count);
        store->kind_of.count = s->object_count;
    }
    if (a->forms && !store->form_of.count) {
        if (!empty) memset(store->form_of.data, (int)s->form, s->object_count);
        store->form_of.count = s->object_count;
    }
    if (a->starts && !store->start_of.count) {
        for (uint32_t i = 0; i <= s->object_count; i++) store->start_of.data[i] = i * s->each;
        store->start_of.count = (size_t)s->object_count + 1;
    }
    return FROE_OK;
}

static void commit_labels(const scene_adding *a) {
    const froe_objects *b = a->batch;
    struct scene_store *store = a->scene->store;
    uint32_t old = a->scene->object_count, all = old + (uint32_t)b->count;
    bool tags = store->tags.count || b->tags, faces = store->faces.count || b->faces;
    bool groups = store->groups.count || b->groups || b->group != FROE_NONE;
    for (size_t i = store->tags.count; tags && i < all; i++)
        store->tags.data[i] = b->tags && i >= old ? b->tags[i - old] : i;
    for (size_t i = store->faces.count; faces && i < all; i++)
        store->faces.data[i] = b->faces && i >= old ? b->faces[i - old] : (uint32_t)i;
    for (size_t i = store->groups.count; groups && i < all; i++)
        store->groups.data[i] = i < old ? FROE_NONE : b->groups ? b->groups[i - old] : b->group;
    store->tags.count = tags ? all : 0;
    store->faces.count = faces ? all : 0;
    store->groups.count = groups ? all : 0;
}

void scene_adding_commit(const scene_adding *a) {
    const froe_objects *b = a->batch;
    froe_scene *s = a->scene;
    struct scene_store *store = s->store;
    const uint32_t old = s->object_count, all = old + (uint32_t)b->count, first = store->corner_count;
    commit_labels(a);
    if (!old) s->kind = b->kind, s->form = a->form, s->each = (uint32_t)a->each;
    if (a->kinds) memset(store->kind_of.data + old, (int)b->kind, b->count), store->kind_of.count = all;
    if (a->forms && a->plain) memset(store->form_of.data + old, (int)a->form, b->count);
    for (uint32_t i = old; a->starts && a->plain && i < all; i++)
        store->start_of.data[i + 1] = first + (i - old + 1) * (uint32_t)a->each;
    if (a->forms) store->form_of.count = all;
    if (a->starts) store->start_of.count = (size_t)all + 1;
    if (a->ids) store->vertex_of.count += a->used;
    store->object_count = all;
    store->corner_count += (uint32_t)a->used;
    store->vertex_count = a->vertices;
    store->radii.count += a->gap;
    for (int k = 0; k < s->dim; k++) {
        if (a->lo[k] < s->lo[k]) s->lo[k] = a->lo[k];
        if (a->hi[k] > s->hi[k]) s->hi[k] = a->hi[k];
    }
}
