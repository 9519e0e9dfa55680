/* near.c: what was rounded before froe saw it: walls that are flat, and ends that stop at a wall, up to a few last
 * places.
 *
 *      ______/______        b was meant to lie in the plane of a;          -------+-
 *        a      b           its far corner lies beside it by 1e-16        ends stick out by 1e-16
 *
 * A pair is looked at exactly only if distances in doubles say that it may count. Each worker has counts of its own.
 * They are added, and the least example pair is kept, so the result does not depend on the number of threads. */
#include "base/floats.h"
#include "geom/meet/box_pairs.h"
#include "geom/meet/contact.h"
#include "geom/predicates.h"
#include "geom/selftest.h"
#include "scene/scene.h"
#include "support/fail.h"
#include <froe/measure.h>
#include <math.h>

typedef struct near_counts {
    num_context context;
    bool ready;
    signed char *sides; /* of the corners of two polygons */
    froe_near found;
} near_counts;

typedef struct near_survey {
    const froe_scene *scene;
    const froe_allocator *alloc;
    base_task task;
    near_counts *counts; /* one for each worker */
    size_t side_count;
    uint32_t *objects;
    uint32_t count;
    double *boxes; /* low corners, then high corners */
    double within;
} near_survey;

static void note_pair(uint64_t *count, uint32_t first[2], uint32_t a, uint32_t b) {
    if (!(*count)++ || a < first[0] || (a == first[0] && b < first[1])) first[0] = a, first[1] = b;
}

/* How far the corners of an object reach to either side of the plane of another, in doubles. */
typedef struct reach {
    double negative, positive;
} reach;

static reach reach_beside(const froe_scene *s, const geom_plane *plane, uint32_t object) {
    const double length = filter_length(plane->n);
    reach out = {0, 0};
    for (uint32_t i = 0; i < scene_corners(s, object); i++) {
        const double d = filter_value(plane, scene_point(s, object, i)).x / length;
        out.negative = -d > out.negative ? -d : out.negative;
        out.positive = d > out.positive ? d : out.positive;
    }
    return out;
}

static bool reach_is_near(reach r, double within) {
    return r.negative <= within && r.positive <= within;
}

static bool reach_pokes(reach r, double within) {
    return r.negative <= within || r.positive <= within;
}

/* Do two polygons have just one edge, or pair of corners, in common? */
static bool share_two_vertices(const froe_scene *s, uint32_t a, uint32_t b) {
    uint32_t common = 0;
    for (uint32_t i = 0; i < scene_corners(s, a); i++)
        for (uint32_t j = 0; j < scene_corners(s, b); j++) common += scene_corner(s, a, i) == scene_corner(s, b, j);
    return common == 2;
}

static bool in_one_plane(near_survey *v, num_context *context, const geom_plane *plane, uint32_t object) {
    bool flat = true;
    for (uint32_t i = 0; i < scene_corners(v->scene, object) && flat; i++)
        flat = geom_side_vertex(context, plane, scene_point(v->scene, object, i)) == 0;
    return flat;
}

static bool cross(const near_survey *v, near_counts *t, uint32_t a, uint32_t b) {
    const geom_body p = scene_body(v->scene, a), q = scene_body(v->scene, b);
    const geom_contact m = v->scene->dim == 2 ? geom_contact_segments(&t->context, &p, &q)
                                              : geom_contact_polygons(&t->context, &p, &q, t->sides);
    return m.kind == GEOM_CROSS || (m.kind == GEOM_TOUCH && m.touch == GEOM_TOUCH_EDGES);
}

static bool look_at_near_pair(void *user, unsigned worker, uint32_t i, uint32_t j) {
    near_survey *v = user;
    near_counts *t = v->counts + worker;
    const uint32_t a = v->objects[i < j ? i : j], b = v->objects[i < j ? j : i];
    geom_plane of_a, of_b;
    scene_support(v->scene, a, &of_a);
    scene_support(v->scene, b, &of_b);
    const reach a_beside_b = reach_beside(v->scene, &of_b, a), b_beside_a = reach_beside(v->scene, &of_a, b);
    const bool flat = reach_is_near(a_beside_b, v->within) && reach_is_near(b_beside_a, v->within);
    if (flat && v->scene->dim == 3 && share_two_vertices(v->scene, a, b)) {
        if (!in_one_plane(v, &t->context, &of_a, b)) note_pair(&t->found.coplanar, t->found.first_coplanar, a, b);
    } else if (reach_pokes(a_beside_b, v->within) || reach_pokes(b_beside_a, v->within)) {
        if (cross(v, t, a, b)) note_pair(&t->found.poking, t->found.first_poking, a, b);
    }
    return true;
}

/* ------------------------------------------------------------------ report -- */

static void add_counts(uint64_t *sum, uint32_t first[2], uint64_t count, const uint32_t other[2]) {
    *sum += count;
    if (count && (other[0] < first[0] || (other[0] == first[0] && other[1] < first[1])))
        first[0] = other[0], first[1] = other[1];
}

static froe_status look_at_near_pairs(near_survey *v) {
    const size_t dim = (size_t)v->scene->dim, half = v->count * dim;
    if (v->count < 2) return base_progress(&v->task, 1) ? FROE_OK : FROE_E_CANCELLED;
    v->counts = support_calloc(v->alloc, v->task.threads, sizeof *v->counts);
    if (!v->counts) return FROE_E_MEMORY;
    for (unsigned i = 0; i < v->task.threads; i++) {
        near_counts *t = v->counts + i;
        t->ready = geom_context_new(v->alloc, &t->context) == FROE_OK;
        t->sides = support_calloc(v->alloc, v->side_count, 1);
        if (!t->ready || !t->sides) return FROE_E_MEMORY;
    }
    v->boxes = support_calloc(v->alloc, 2 * half, sizeof *v->boxes);
    if (!v->boxes) return FROE_E_MEMORY;
    for (size_t i = 0; i < v->count; i++)
        scene_object_bounds(v->scene, v->objects[i], v->boxes + i * dim, v->boxes + half + i * dim);
    return geom_box_pairs(v->alloc, &v->task, 1, (int)dim, v->count, v->boxes, v->boxes + half, look_at_near_pair, v);
}

/* The largest coordinate of the scene. */
static double largest_coordinate(const froe_scene *s) {
    double most = 0;
    for (uint32_t i = 0; i < s->vertex_count; i++)
        for (int k = 0; k < s->dim; k++) most = fmax(most, fabs(scene_vertex(s, i)[k]));
    return most;
}

static void end_survey(near_survey *v) {
    for (unsigned i = 0; v->counts && i < v->task.threads; i++) {
        if (v->counts[i].ready) num_context_free(&v->counts[i].context);
        support_free(v->alloc, v->counts[i].sides, v->side_count);
    }
    support_free(v->alloc, v->counts, v->task.threads * sizeof *v->counts);
    support_free(v->alloc, v->boxes, 2 * v->count * (size_t)v->scene->dim * sizeof *v->boxes);
    support_free(v->alloc, v->objects, (v->scene->object_count + (size_t)1) * sizeof *v->objects);
}

froe_status froe_measure_near(const froe_scene *scene, double share, unsigned threads, froe_progress_fn *progress,
                              void *user, froe_near *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!scene || !out) return support_fail_null(diag, __func__);
    if (!(share >= 0 && share <= 1))
        return support_fail(diag, FROE_E_ARG, "The share within which objects are near is not from 0 to 1.");
    near_survey v = {.scene = scene, .alloc = &scene->alloc, .side_count = 1};
    froe_near found = {0, 0, {FROE_NONE, FROE_NONE}, {FROE_NONE, FROE_NONE}, 0};
    base_task_init(&v.task, threads, progress, user);
    found.within = v.within = share * largest_coordinate(scene);
    v.objects = support_calloc(v.alloc, scene->object_count + (size_t)1, sizeof *v.objects);
    froe_status status = v.objects ? scene_originals(scene, v.alloc, v.objects) : FROE_E_MEMORY;
    const froe_kind form = scene->dim == 2 ? FROE_SEGMENT : FROE_POLYGON;
    for (uint32_t i = 0; i < scene->object_count && !status && scene->dim <= 3; i++) {
        if (v.objects[i] != i || scene->forms[i] != form) continue;
        v.objects[v.count++] = i; /* candidates take the place of originals */
        if (2 * (size_t)scene_corners(scene, i) > v.side_count) v.side_count = 2 * (size_t)scene_corners(scene, i);
    }
    if (!status) status = look_at_near_pairs(&v);
    for (unsigned i = 0; v.counts && i < v.task.threads; i++) {
        const froe_near *of = &v.counts[i].found;
        add_counts(&found.coplanar, found.first_coplanar, of->coplanar, of->first_coplanar);
        add_counts(&found.poking, found.first_poking, of->poking, of->first_poking);
    }
    end_survey(&v);
    if (status == FROE_E_CANCELLED) return support_fail_cancelled(diag);
    if (status) return support_fail_memory(diag);
    *out = found;
    return FROE_OK;
}
