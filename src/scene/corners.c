/* corners.c: the corners of a batch become vertices, a chunk at a time. */
#include "scene/forms.h"
#include "support/fail.h"
#include <math.h>

/** Chunks between two calls of the progress function. */
#define REPORT_EVERY 4096

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
                               "corner %zu of %s %zu: There is no point %.0f.", i, kind, lo, value);
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

froe_status scene_take_corners(scene_adding *a) {
    struct scene_store *store = a->scene->store;
    double points[SCENE_CHUNK * FROE_MAX_DIM];
    const uint32_t old = store->corner_count;
    if (!scene_adding_room(a)) return support_fail_memory(a->diag);
    uint32_t *ids = scene_adding_ids(a);
    a->in_order = !store->vertex_of.count; /* then each vertex is its own corner */
    for (size_t done = 0, chunks = 0; done < a->corners; done += SCENE_CHUNK, chunks++) {
        size_t count = a->corners - done < SCENE_CHUNK ? a->corners - done : SCENE_CHUNK;
        froe_status status = gather_points(a, done, count, points);
        if (status) return status;
        status = scene_vertices_add(a->scene, points, count, ids + done);
        if (status == FROE_E_LIMIT) /* one way: so many vertices take 60 GB */
            return support_fail(a->diag, status, "There are more than %u vertices.", SCENE_LIMIT);
        if (status) return support_fail_memory(a->diag);
        for (size_t i = done; i < done + count; i++) a->in_order = a->in_order && ids[i] == old + i;
        if (chunks % REPORT_EVERY == 0) status = scene_adding_progress(a, 0.6 * (double)done / (double)a->corners);
        if (status) return status;
    }
    a->vertices = (uint32_t)store->table.count;
    return FROE_OK;
}
