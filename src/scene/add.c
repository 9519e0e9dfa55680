/* add.c: a batch of objects enters the scene, all of it or nothing.
 *
 *     check        pointers, counts and offsets, before anything is touched
 *     corners      become vertices, all at once (bulk.c) or a chunk at a time (corners.c)
 *     settle       room for all objects, in the arrays that have to tell of them (settle.c)
 *     forms        the corners of each object's form, where any object differs from what was given (forms.c)
 *     commit       the new counts are published, the only step that readers see; or the new vertices are dropped */
#include "base/floats.h"
#include "scene/forms.h"
#include "support/fail.h"
#include <math.h>
#include <stddef.h>
#include <string.h>

/** Objects between two calls of the progress function. */
#define REPORT_EVERY 4096
/** Below so many corners the start of threads costs more than they gain. */
#define THREADS_FROM 100000

void froe_objects_defaults_into(froe_objects *out, size_t size) {
    const froe_objects all = {.size = size, .kind = FROE_POLYGON, .group = FROE_NONE};
    support_defaults(out, size, &all, sizeof all);
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

/** Where each object begins, and its group. Finds out whether all have equally many corners. */
static froe_status check_lists(scene_adding *a) {
    const froe_scene *s = a->scene;
    const froe_objects *b = a->batch;
    froe_diagnostic *diag = a->diag;
    bool regular = b->starts && b->count;
    size_t least = b->kind == FROE_POLYGON ? 3 : 1;
    for (size_t j = 0; b->starts && j < b->count; j++) {
        regular = regular && b->starts[j + 1] - b->starts[j] == b->starts[1] - b->starts[0];
        if (b->starts[j + 1] >= b->starts[j] && b->starts[j + 1] - b->starts[j] >= least) continue;
        return support_fail_at(diag, FROE_E_INPUT, (uint32_t)j, FROE_NONE, FROE_NONE,
                               "%s %zu: It needs at least %zu corners, and its starts go from %zu to %zu.",
                               froe_kind_name(b->kind), j, least, b->starts[j], b->starts[j + 1]);
    }
    if (regular) a->each = b->starts[1] - b->starts[0];
    if (b->group != FROE_NONE && b->group >= s->group_count)
        return support_fail(diag, FROE_E_INPUT, "There is no group %u.", b->group);
    for (size_t j = 0; b->groups && j < b->count; j++)
        if (b->groups[j] != FROE_NONE && b->groups[j] >= s->group_count)
            return support_fail_at(diag, FROE_E_INPUT, (uint32_t)j, FROE_NONE, FROE_NONE,
                                   "%s %zu: There is no group %u.", froe_kind_name(b->kind), j, b->groups[j]);
    return FROE_OK;
}

/* ------------------------------------------------------------------- forms -- */

froe_status scene_adding_progress(scene_adding *a, double share) {
    return base_progress(&a->task, share) ? FROE_OK : support_fail_cancelled(a->diag);
}

static froe_status take_forms(scene_adding *a) {
    struct scene_store *store = a->scene->store;
    uint32_t *corners = store->vertex_of.data + store->vertex_of.count;
    a->used = 0;
    for (size_t j = 0; j < a->batch->count; j++) {
        size_t begin = scene_adding_corner(a, j) - a->first, end = scene_adding_corner(a, j + 1) - a->first;
        uint32_t count = (uint32_t)(end - begin), *ring = corners + a->used; /* never ahead of what is read */
        memmove(ring, corners + a->gap + begin, count * sizeof *ring);
        froe_kind form = a->batch->kind;
        froe_status status = scene_form_object(a, j, ring, &count, &form);
        if (!status && j % REPORT_EVERY == 0)
            status = scene_adding_progress(a, 0.6 + 0.4 * (double)j / (double)a->batch->count);
        if (status) return status;
        a->used += count;
        store->form_of.data[store->form_of.count + j] = (uint8_t)form;
        store->start_of.data[store->start_of.count + j] = (uint32_t)(store->corner_count + a->used);
    }
    return FROE_OK;
}

/* ------------------------------------------------------------------- whole -- */

static froe_status take_batch(scene_adding *a) {
    bool done;
    froe_status status = scene_take_corners_at_once(a, &done);
    if (!status && !done) status = scene_take_corners(a);
    if (!status) status = scene_look_at_forms(a);
    if (!status && scene_adding_settle(a)) status = support_fail_memory(a->diag);
    if (!status && !a->plain) status = scene_adding_context(a);
    if (!status && !a->plain) status = take_forms(a);
    return status ? status : scene_adding_progress(a, 1);
}

froe_status froe_scene_add(froe_scene *scene, const froe_objects *batch, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    froe_objects grown;
    batch = whole_batch(batch, &grown);
    scene_adding a = {.scene = scene, .batch = batch, .diag = diag};
    froe_status status = check_batch(scene, batch, diag);
    if (!status) status = check_limits(&a);
    if (!status) status = check_lists(&a);
    if (status || !batch->count) return status;
    base_task_init(&a.task, a.corners < THREADS_FROM ? 1 : batch->threads, batch->progress, batch->user);
    for (int k = 0; k < FROE_MAX_DIM; k++) a.lo[k] = INFINITY, a.hi[k] = -INFINITY;
    status = take_batch(&a);
    if (status)
        scene_vertices_truncate(scene, scene->vertex_count);
    else
        scene_adding_commit(&a);
    scene_publish(scene);
    return status;
}
