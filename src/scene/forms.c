/* forms.c: what an object really is: a zero-length segment is a point, a hull is a set of vertices. Above dimension
 * 3 no cut runs along a segment, so that it is a hull as well: it is listed, and never cut. */
#include "scene/forms.h"
#include "geom/selftest.h"
#include "geom/turn.h"
#include "scene/polygon.h"
#include "support/fail.h"
#include <math.h>
#include <string.h>

static const double *store_vertex(const scene_adding *a, uint32_t vertex) {
    return a->scene->store->coords.data + (size_t)vertex * (size_t)a->scene->dim;
}

static froe_status ball_form(scene_adding *a, size_t j, uint32_t *ring, uint32_t *count) {
    struct scene_store *store = a->scene->store;
    double radius = a->batch->radii[j] + 0.0, lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    if (!(radius >= 0 && radius < INFINITY))
        return support_fail_at(a->diag, FROE_E_INPUT, (uint32_t)j, FROE_NONE, FROE_NONE,
                               "ball %zu: Its radius is %g, not a finite number >= 0.", j, radius);
    scene_ball_bounds(a->scene->dim, store_vertex(a, ring[0]), radius, lo, hi);
    for (int k = 0; k < a->scene->dim; k++) {
        if (isinf(lo[k]) || isinf(hi[k]))
            return support_fail_at(a->diag, FROE_E_INPUT, (uint32_t)j, 0, (uint32_t)k,
                                   "ball %zu: It reaches beyond the range of doubles.", j);
        a->lo[k] = fmin(a->lo[k], lo[k]);
        a->hi[k] = fmax(a->hi[k], hi[k]);
    }
    store->radii.data[store->radii.count + j] = radius;
    ring[1] = (uint32_t)(store->radii.count + j);
    *count = 2;
    return FROE_OK;
}

static froe_status polygon_form(scene_adding *a, size_t j, uint32_t *ring, uint32_t *count, froe_kind *form) {
    struct scene_store *store = a->scene->store;
    scene_fault fault;
    if (scene_polygon_form(&store->context, store->coords.data, ring, count, form, &fault)) return FROE_OK;
    const double *x = store_vertex(a, fault.vertex);
    uint32_t corner = FROE_NONE; /* of object j of the batch, that has become this vertex */
    size_t dim = (size_t)a->scene->dim, begin = scene_adding_corner(a, j), end = scene_adding_corner(a, j + 1);
    for (size_t c = begin; c < end && corner == FROE_NONE; c++) {
        const double *y = scene_adding_point(a, c);
        size_t same = 0;
        while (same < dim && x[same] == y[same]) same++;
        if (same == dim) corner = (uint32_t)(c - begin);
    }
    return support_fail_at(a->diag, FROE_E_INPUT, (uint32_t)j, corner, FROE_NONE,
                           "polygon %zu: It %s, as at its corner %u at (%.17g, %.17g, %.17g).", j, fault.reason, corner,
                           x[0], x[1], x[2]);
}

/** Restores the heap order below `root` of a heap with the largest on top. */
static void sift(uint32_t *ids, size_t root, size_t count) {
    uint32_t id = ids[root];
    size_t child;
    while ((child = 2 * root + 1) < count) {
        if (child + 1 < count && ids[child + 1] > ids[child]) child++;
        if (ids[child] <= id) break;
        ids[root] = ids[child];
        root = child;
    }
    ids[root] = id;
}

/** A hull has no order of its own: ascending vertex ids, each once, make equal hulls look equal. */
static void hull_form(uint32_t *ring, uint32_t *count) {
    uint32_t kept = 1;
    for (size_t i = *count / 2; i-- > 0;) sift(ring, i, *count); /* heapsort: in place, O(n log n) on any input */
    for (size_t end = *count; end-- > 1;) {
        uint32_t top = ring[0];
        ring[0] = ring[end];
        ring[end] = top;
        sift(ring, 0, end);
    }
    for (uint32_t i = 1; i < *count; i++)
        if (ring[i] != ring[kept - 1]) ring[kept++] = ring[i];
    *count = kept;
}

froe_status scene_form_object(scene_adding *a, size_t j, uint32_t *ring, uint32_t *count, froe_kind *form) {
    const double *lo, *hi;
    switch (a->batch->kind) {
    case FROE_SEGMENT:
        if (ring[0] == ring[1]) {
            *count = 1;
            *form = FROE_POINT;
        } else if (a->scene->dim > 3) {
            hull_form(ring, count);
            *form = FROE_HULL;
        }
        return FROE_OK;
    case FROE_POLYGON:
        return polygon_form(a, j, ring, count, form);
    case FROE_BOX:
        lo = store_vertex(a, ring[0]), hi = store_vertex(a, ring[1]);
        for (int k = 0; k < a->scene->dim; k++)
            if (lo[k] > hi[k])
                return support_fail_at(a->diag, FROE_E_INPUT, (uint32_t)j, 1, (uint32_t)k,
                                       "box %zu: Its low corner %g is above its high corner %g.", j, lo[k], hi[k]);
        return FROE_OK;
    case FROE_BALL:
        return ball_form(a, j, ring, count);
    default: /* FROE_HULL: points are plain */
        hull_form(ring, count);
        return FROE_OK;
    }
}

/* ------------------------------------------------------------------- plain -- */

enum { RING_MOST = 16, OBJECTS_A_JOB = 1 << 14 };

static bool are_different(const uint32_t *ids, size_t from, size_t to) {
    bool same = false;
    for (size_t j = from; ids && j < to; j++) same |= ids[2 * j] == ids[2 * j + 1];
    return !same;
}

static bool ascend(const scene_adding *a, const uint32_t *ids, size_t from, size_t to) {
    bool descends = false;
    for (size_t j = from; ids && j < to; j++)
        for (size_t i = j * a->each + 1; i < (j + 1) * a->each; i++) descends |= ids[i] <= ids[i - 1];
    return !descends;
}

static bool are_boxes(const scene_adding *a, size_t from, size_t to) {
    bool inside_out = false;
    for (size_t j = from; j < to; j++) {
        const double *lo = scene_adding_point(a, a->first + 2 * j), *hi = scene_adding_point(a, a->first + 2 * j + 1);
        for (int k = 0; k < a->scene->dim; k++) inside_out |= lo[k] > hi[k];
    }
    return !inside_out;
}

froe_status scene_adding_context(const scene_adding *a) {
    struct scene_store *store = a->scene->store;
    if (a->batch->kind != FROE_POLYGON || store->context_ready) return FROE_OK;
    if (geom_context_new(&a->scene->alloc, &store->context)) return support_fail_memory(a->diag);
    store->context_ready = true;
    return FROE_OK;
}

/** Polygons that are exactly what a scene keeps. */
static bool are_rings(const scene_adding *a, size_t from, size_t to) {
    if (a->batch->kind != FROE_POLYGON) return false;
    const uint32_t *ids = a->in_order ? NULL : scene_adding_ids(a);
    struct scene_store *store = a->scene->store;
    uint32_t ring[RING_MOST], given[RING_MOST];
    for (size_t j = from; j < to; j++) {
        uint32_t count = (uint32_t)a->each;
        for (uint32_t i = 0; i < count; i++)
            given[i] = ring[i] = ids ? ids[j * a->each + i] : store->vertex_count + (uint32_t)(j * a->each + i);
        froe_kind form = FROE_POLYGON;
        scene_fault fault;
        if (!scene_polygon_form(&store->context, store->coords.data, ring, &count, &form, &fault)) return false;
        if (form != FROE_POLYGON || count != a->each || memcmp(ring, given, count * sizeof *ring) != 0) return false;
    }
    return true;
}

/** Triangles for certain: then their corners differ, and no other order of them is better. */
static bool are_triangles(const scene_adding *a, size_t from, size_t to) {
    bool sure = a->each == 3 && a->scene->store->trusted; /* the rounding is froe's own: BASE_FLOATS_OWN */
    for (size_t j = from; sure && j < to; j++) {
        const size_t corner = a->first + 3 * j;
        sure = geom_surely_turns(scene_adding_point(a, corner), scene_adding_point(a, corner + 1),
                                 scene_adding_point(a, corner + 2));
    }
    return sure;
}

/** Do objects from .. to - 1 of the batch certainly keep their corners? a->form says as what. For all but polygons it
 * is certain that they do not, otherwise. */
static bool are_plain(const scene_adding *a, size_t from, size_t to) {
    const uint32_t *ids = a->in_order ? NULL : scene_adding_ids(a);
    switch (a->batch->kind) {
    case FROE_POINT:
        return true;
    case FROE_SEGMENT:
        return a->form == FROE_HULL ? ascend(a, ids, from, to) : are_different(ids, from, to);
    case FROE_POLYGON:
        return are_triangles(a, from, to);
    case FROE_BOX:
        return are_boxes(a, from, to);
    case FROE_HULL:
        return ascend(a, ids, from, to);
    default:
        return false;
    }
}

typedef struct plain_look {
    scene_adding *adding;
    uint8_t *doubt; /**< of jobs */
} plain_look;

static void job_objects(const scene_adding *a, size_t job, size_t *from, size_t *to) {
    *from = job * OBJECTS_A_JOB;
    *to = a->batch->count - *from < OBJECTS_A_JOB ? a->batch->count : *from + OBJECTS_A_JOB;
}

static froe_status look_at_some(void *user, unsigned worker, size_t job) {
    (void)worker;
    const plain_look *look = user;
    size_t from, to;
    job_objects(look->adding, job, &from, &to);
    look->doubt[job] = !are_plain(look->adding, from, to);
    return FROE_OK;
}

/** Objects in doubt are looked at by one thread, which has the context for exact numbers. */
static froe_status look_by_jobs(scene_adding *a, size_t jobs, uint8_t *doubt) {
    plain_look look = {.adding = a, .doubt = doubt};
    froe_status status = base_run(&a->task, 0.2, jobs, look_at_some, &look);
    for (size_t job = 0; !status && a->plain && job < jobs; job++) {
        size_t from, to;
        if (!doubt[job]) continue;
        if (scene_adding_context(a)) return FROE_E_MEMORY;
        job_objects(a, job, &from, &to);
        a->plain = are_rings(a, from, to);
        if (!base_progress(&a->task, 0.8 + 0.1 * (double)job / (double)jobs)) status = FROE_E_CANCELLED;
    }
    return status;
}

froe_status scene_look_at_forms(scene_adding *a) {
    const froe_allocator *alloc = &a->scene->alloc;
    const size_t count = a->batch->count, jobs = (count + OBJECTS_A_JOB - 1) / OBJECTS_A_JOB;
    a->form = a->batch->kind == FROE_SEGMENT && a->scene->dim > 3 ? FROE_HULL : a->batch->kind;
    a->plain = a->each > 0 && a->each <= RING_MOST;
    a->used = a->corners;
    if (!a->plain) return FROE_OK;
    if (jobs == 1) {
        a->plain = are_plain(a, 0, count);
        const froe_status status = a->plain ? FROE_OK : scene_adding_context(a);
        if (status) return status;
        a->plain = a->plain || are_rings(a, 0, count);
        return scene_adding_progress(a, 0.8);
    }
    uint8_t *doubt = support_calloc(alloc, jobs, 1);
    if (!doubt) return support_fail_memory(a->diag);
    const froe_status status = look_by_jobs(a, jobs, doubt);
    support_free(alloc, doubt, jobs);
    if (status == FROE_E_MEMORY) return support_fail_memory(a->diag);
    return status ? support_fail_cancelled(a->diag) : FROE_OK;
}
