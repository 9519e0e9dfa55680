/* add.c: a batch of objects enters the scene, all of it or nothing.
 *
 *     check        pointers, counts and offsets, before anything is touched
 *     reserve      room for all objects and corners, behind the published counts
 *     vertices     corners become vertex ids, a chunk at a time
 *     forms        ids become the corners of each object's form (forms.c)
 *     commit       the new counts are published, the only step that readers see; or the new vertices are dropped */
#include "base/floats.h"
#include "geom/selftest.h"
#include "scene/forms.h"
#include "support/fail.h"
#include <math.h>
#include <stddef.h>
#include <string.h>

/** Objects or chunks between two calls of the progress function. */
#define REPORT_EVERY 4096

froe_objects froe_objects_defaults(void) {
    return (froe_objects){.size = sizeof(froe_objects), .kind = FROE_POLYGON, .group = FROE_NONE};
}

/* ------------------------------------------------------------------- check -- */

/** The limits come before every loop over the batch: from here on a size_t count fits 31 bits. */
static froe_status check_limits(scene_adding *a) {
    static const size_t corners_of[FROE_KIND_COUNT] = {1, 2, 3, 2, 1, 3};
    const froe_objects *b = a->batch;
    const froe_scene *s = a->scene;
    if (b->count > SCENE_LIMIT - s->object_count)
        return support_fail(a->diag, FROE_E_LIMIT, "There are more than %u objects.", SCENE_LIMIT);
    if (b->starts && b->starts[b->count] < b->starts[0])
        return support_fail(a->diag, FROE_E_INPUT, "The starts end before they begin.");
    a->each = b->starts ? 0 : corners_of[b->kind];
    a->first = b->starts ? b->starts[0] : 0;
    a->corners = b->starts ? b->starts[b->count] - a->first : b->count * a->each;
    a->gap = b->kind == FROE_BALL ? b->count : 0;
    if (a->corners + a->gap > SCENE_CORNER_LIMIT - s->corner_count)
        return support_fail(a->diag, FROE_E_LIMIT, "There are more than %u corners.", SCENE_CORNER_LIMIT);
    return FROE_OK;
}

/** The batch of a caller that was compiled before batches had `threads`: with the default of that. */
static const froe_objects *whole_batch(const froe_objects *b, froe_objects *grown) {
    if (!b || b->size != offsetof(froe_objects, threads)) return b;
    *grown = froe_objects_defaults();
    memcpy(grown, b, b->size);
    grown->size = sizeof *grown;
    return grown;
}

/** The batch itself, and whether the scene can take such objects. */
static froe_status check_batch(const froe_scene *s, const froe_objects *b, froe_diagnostic *diag) {
    if (!s || !b) return support_fail_null(diag, "froe_scene_add");
    if (b->size != sizeof *b) return support_fail_defaults(diag, "froe_objects_defaults");
    froe_status status = scene_growable(s, diag);
    if (status) return status;
    if ((unsigned)b->kind >= FROE_KIND_COUNT)
        return support_fail(diag, FROE_E_ARG, "There is no kind %d.", (int)b->kind);
    if (b->kind == FROE_POLYGON && s->dim != 3)
        return support_fail(diag, FROE_E_UNSUPPORTED, "There are no %ss in dimension %d.", froe_kind_name(b->kind),
                            s->dim);
    if (b->count && !b->coords) return support_fail(diag, FROE_E_ARG, "The batch has no coordinates.");
    if (b->starts && b->kind != FROE_POLYGON && b->kind != FROE_HULL)
        return support_fail(diag, FROE_E_ARG, "Only polygons and hulls have starts.");
    if (b->count && (b->kind == FROE_BALL) != (b->radii != NULL))
        return support_fail(diag, FROE_E_ARG, "Balls need radii, and only they have them.");
    return FROE_OK;
}

/** Where each object begins, and its group. */
static froe_status check_lists(const froe_scene *s, const froe_objects *b, froe_diagnostic *diag) {
    size_t least = b->kind == FROE_POLYGON ? 3 : 1;
    for (size_t j = 0; b->starts && j < b->count; j++) {
        if (b->starts[j + 1] >= b->starts[j] && b->starts[j + 1] - b->starts[j] >= least) continue;
        return support_fail_at(diag, FROE_E_INPUT, (uint32_t)j, FROE_NONE, FROE_NONE,
                               "%s %zu: It needs at least %zu corners, and its starts go from %zu to %zu.",
                               froe_kind_name(b->kind), j, least, b->starts[j], b->starts[j + 1]);
    }
    if (b->group != FROE_NONE && b->group >= s->group_count)
        return support_fail(diag, FROE_E_INPUT, "There is no group %u.", b->group);
    for (size_t j = 0; b->groups && j < b->count; j++)
        if (b->groups[j] != FROE_NONE && b->groups[j] >= s->group_count)
            return support_fail_at(diag, FROE_E_INPUT, (uint32_t)j, FROE_NONE, FROE_NONE,
                                   "%s %zu: There is no group %u.", froe_kind_name(b->kind), j, b->groups[j]);
    return FROE_OK;
}

/* ----------------------------------------------------------------- reserve -- */

/** An optional array stays empty until an object is not like the default; then it tells of all. */
#define reserve_optional(a, array, wanted)                                                                             \
    (!((array)->count || (wanted)) ||                                                                                  \
     array_reserve(&(a)->scene->alloc, (array), ((array)->count ? 0 : (a)->scene->object_count) + (a)->batch->count))

static froe_status reserve(scene_adding *a) {
    const froe_allocator *alloc = &a->scene->alloc;
    const froe_objects *b = a->batch;
    struct scene_store *store = a->scene->store;
    if (b->kind == FROE_POLYGON && !store->context_ready) {
        froe_status status = geom_context_new(alloc, &store->context);
        if (status) return support_fail_memory(a->diag);
        store->context_ready = true;
    }
    bool room = array_reserve(alloc, &store->kinds, b->count) && array_reserve(alloc, &store->forms, b->count) &&
                array_reserve(alloc, &store->starts, b->count) &&
                array_reserve(alloc, &store->corners, a->corners + a->gap) &&
                array_reserve(alloc, &store->radii, a->gap) && reserve_optional(a, &store->tags, b->tags) &&
                reserve_optional(a, &store->faces, b->faces) &&
                reserve_optional(a, &store->groups, b->groups || b->group != FROE_NONE);
    return room ? FROE_OK : support_fail_memory(a->diag);
}

/* ---------------------------------------------------------------- vertices -- */

static froe_status progress(const scene_adding *a, size_t done, size_t work) {
    const froe_objects *b = a->batch;
    volatile const double share = (double)done / (double)work;
    if (!b->progress || base_callback(b->progress(b->user, share))) return FROE_OK;
    return support_fail_cancelled(a->diag);
}

/** Names the object and the corner of it that a corner of the batch is. axis -1: it names a point that is not there. */
static froe_status fail_at_corner(const scene_adding *a, size_t corner, int axis, double value) {
    size_t lo = 0, hi = a->batch->count; /* the object is in lo .. hi - 1 */
    while (hi - lo > 1) {
        size_t middle = lo + (hi - lo) / 2;
        if (scene_adding_corner(a, middle) <= corner)
            lo = middle;
        else
            hi = middle;
    }
    size_t i = corner - scene_adding_corner(a, lo);
    const char *kind = froe_kind_name(a->batch->kind);
    if (axis < 0)
        return support_fail_at(a->diag, FROE_E_INPUT, (uint32_t)lo, (uint32_t)i, FROE_NONE,
                               "corner %zu of %s %zu: There is no point %g.", i, kind, lo, value);
    return support_fail_at(a->diag, FROE_E_INPUT, (uint32_t)lo, (uint32_t)i, (uint32_t)axis,
                           "corner %zu of %s %zu: Coordinate %d is %g, not a finite number.", i, kind, lo, axis, value);
}

/** Copies a chunk of corners, checked; -0 becomes +0 by adding +0. */
static froe_status gather_points(scene_adding *a, size_t done, size_t count, double *points) {
    const froe_objects *b = a->batch;
    int dim = a->scene->dim;
    for (size_t i = 0; i < count; i++) {
        size_t corner = a->first + done + i, point = b->indices ? b->indices[corner] : corner;
        if (b->indices && point >= b->point_count) return fail_at_corner(a, corner, -1, (double)point);
        for (int k = 0; k < dim; k++) {
            double x = b->coords[point * (size_t)dim + (size_t)k] + 0.0;
            if (!isfinite(x)) return fail_at_corner(a, corner, k, x);
            if (x < a->lo[k]) a->lo[k] = x;
            if (x > a->hi[k]) a->hi[k] = x;
            points[i * (size_t)dim + (size_t)k] = x;
        }
    }
    return FROE_OK;
}

static froe_status take_vertices(scene_adding *a) {
    struct scene_store *store = a->scene->store;
    uint32_t *ids = store->corners.data + store->corners.count + a->gap;
    double points[SCENE_CHUNK * FROE_MAX_DIM];
    for (size_t done = 0, chunks = 0; done < a->corners; done += SCENE_CHUNK, chunks++) {
        size_t count = a->corners - done < SCENE_CHUNK ? a->corners - done : SCENE_CHUNK;
        froe_status status = gather_points(a, done, count, points);
        if (status) return status;
        status = scene_vertices_add(a->scene, points, count, ids + done);
        if (status == FROE_E_LIMIT)
            return support_fail(a->diag, status, "There are more than %u vertices.", SCENE_LIMIT);
        if (status) return support_fail_memory(a->diag);
        if (chunks % REPORT_EVERY == 0) status = progress(a, done, a->corners + a->batch->count);
        if (status) return status;
    }
    return FROE_OK;
}

/* ------------------------------------------------------------------- forms -- */

static froe_status take_forms(scene_adding *a) {
    struct scene_store *store = a->scene->store;
    uint32_t *corners = store->corners.data + store->corners.count;
    a->used = 0;
    for (size_t j = 0; j < a->batch->count; j++) {
        size_t begin = scene_adding_corner(a, j) - a->first, end = scene_adding_corner(a, j + 1) - a->first;
        uint32_t count = (uint32_t)(end - begin), *ring = corners + a->used; /* never ahead of what is read */
        memmove(ring, corners + a->gap + begin, count * sizeof *ring);
        froe_kind form = a->batch->kind;
        froe_status status = scene_form_object(a, j, ring, &count, &form);
        if (!status && j % REPORT_EVERY == 0) status = progress(a, a->corners + j, a->corners + a->batch->count);
        if (status) return status;
        a->used += count;
        store->kinds.data[store->kinds.count + j] = (uint8_t)a->batch->kind;
        store->forms.data[store->forms.count + j] = (uint8_t)form;
        store->starts.data[store->starts.count + j] = (uint32_t)(store->corners.count + a->used);
    }
    return progress(a, 1, 1);
}

/* ------------------------------------------------------------------ commit -- */

static void commit(const scene_adding *a) {
    const froe_objects *b = a->batch;
    froe_scene *s = a->scene;
    struct scene_store *store = s->store;
    uint32_t old = s->object_count, all = old + (uint32_t)b->count;
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
    store->kinds.count += b->count;
    store->forms.count += b->count;
    store->starts.count += b->count;
    store->corners.count += a->used;
    store->radii.count += a->gap;
    for (int k = 0; k < s->dim; k++) {
        if (a->lo[k] < s->lo[k]) s->lo[k] = a->lo[k];
        if (a->hi[k] > s->hi[k]) s->hi[k] = a->hi[k];
    }
}

froe_status froe_scene_add(froe_scene *scene, const froe_objects *batch, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    froe_objects grown;
    batch = whole_batch(batch, &grown);
    scene_adding a = {.scene = scene, .batch = batch, .diag = diag};
    froe_status status = check_batch(scene, batch, diag);
    if (!status) status = check_limits(&a);
    if (!status) status = check_lists(scene, batch, diag);
    if (status || !batch->count) return status;
    for (int k = 0; k < FROE_MAX_DIM; k++) a.lo[k] = INFINITY, a.hi[k] = -INFINITY;
    status = reserve(&a);
    if (!status) status = take_vertices(&a);
    if (!status) status = take_forms(&a);
    if (status)
        scene_vertices_truncate(scene, scene->vertex_count);
    else
        commit(&a);
    scene_publish(scene);
    return status;
}
