/* near.c: what was rounded before froe saw it: walls that are flat, and ends that stop at a wall, up to a few last
 * places.
 *
 *      ______/______        b was meant to lie in the plane of a;          -------+-
 *        a      b           its far corner lies beside it by 1e-16        ends stick out by 1e-16
 *
 * A pair is looked at exactly only if distances in doubles say that it may count. */
#include "base/floats.h"
#include "base/radix.h"
#include "geom/predicates.h"
#include "measure/survey.h"
#include "support/fail.h"
#include <froe/measure.h>
#include <math.h>

typedef struct near_survey {
    measure_survey of;
    froe_near *found; /* by each worker */
    double within;
} near_survey;

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

/* Two objects, how far each reaches beside the plane of the other, and whether both are flat together. */
typedef struct near_pair {
    uint32_t a, b; /* a < b */
    geom_plane of_a;
    reach a_beside_b, b_beside_a;
    bool flat;
} near_pair;

static near_pair near_pair_of(const near_survey *v, uint32_t i, uint32_t j) {
    const froe_scene *s = v->of.scene;
    near_pair p = {.a = v->of.objects[i < j ? i : j], .b = v->of.objects[i < j ? j : i]};
    geom_plane of_b;
    scene_support(s, p.a, &p.of_a);
    scene_support(s, p.b, &of_b);
    p.a_beside_b = reach_beside(s, &of_b, p.a);
    p.b_beside_a = reach_beside(s, &p.of_a, p.b);
    p.flat = reach_is_near(p.a_beside_b, v->within) && reach_is_near(p.b_beside_a, v->within);
    return p;
}

/* Do two polygons have just two corners in common? */
static bool share_two_vertices(const froe_scene *s, uint32_t a, uint32_t b) {
    uint32_t common = 0;
    for (uint32_t i = 0; i < scene_corners(s, a); i++)
        for (uint32_t j = 0; j < scene_corners(s, b); j++) common += scene_corner(s, a, i) == scene_corner(s, b, j);
    return common == 2;
}

static bool in_one_plane(const froe_scene *s, num_context *context, const geom_plane *plane, uint32_t object) {
    bool flat = true;
    for (uint32_t i = 0; i < scene_corners(s, object) && flat; i++)
        flat = geom_side_vertex(context, plane, scene_point(s, object, i)) == 0;
    return flat;
}

/* ------------------------------------------------------------------ poking -- */

static bool look_at_poking(void *user, unsigned worker, uint32_t i, uint32_t j) {
    near_survey *v = user;
    froe_near *found = v->found + worker;
    if (measure_survey_are_aside(&v->of, v->of.objects[i], v->of.objects[j])) return true;
    const near_pair p = near_pair_of(v, i, j);
    if (p.flat && v->of.scene->dim == 3 && share_two_vertices(v->of.scene, p.a, p.b)) return true;
    if (!reach_pokes(p.a_beside_b, v->within) && !reach_pokes(p.b_beside_a, v->within)) return true;
    const geom_contact m = measure_survey_meet(&v->of, worker, p.a, p.b);
    if (m.kind == GEOM_CROSS || (m.kind == GEOM_TOUCH && m.touch == GEOM_TOUCH_EDGES))
        measure_note_pair(&found->poking, found->first_poking, p.a, p.b);
    return true;
}

/* ---------------------------------------------------------------- coplanar -- */

enum { EDGES = 256 }; /* looked at between two calls of progress */

static void look_at_common_edge(near_survey *v, uint32_t i, uint32_t j) {
    const near_pair p = near_pair_of(v, i, j);
    if (p.flat && share_two_vertices(v->of.scene, p.a, p.b) &&
        !in_one_plane(v->of.scene, &v->of.workers[0].context, &p.of_a, p.b))
        measure_note_pair(&v->found->coplanar, v->found->first_coplanar, p.a, p.b);
}

/* Writes the edges of all polygons, with the places of these in the list, in order. */
static void sort_edges(const near_survey *v, base_pair *edges, size_t count) {
    const froe_scene *s = v->of.scene;
    base_pair *edge = edges;
    for (uint32_t i = 0; i < v->of.count; i++) {
        const uint32_t object = v->of.objects[i], corners = scene_corners(s, object);
        for (uint32_t k = 0; k < corners; k++) {
            const uint32_t a = scene_corner(s, object, k), b = scene_corner(s, object, k + 1 < corners ? k + 1 : 0);
            *edge++ = (base_pair){(uint64_t)(a < b ? a : b) << 32 | (a < b ? b : a), i};
        }
    }
    base_radix_sort(edges, edges + count, count);
}

/* Looks at all pairs of polygons with a common edge. */
static froe_status look_at_common_edges(near_survey *v) {
    base_task *task = &v->of.task;
    size_t count = 0;
    for (uint32_t i = 0; i < v->of.count; i++) count += scene_corners(v->of.scene, v->of.objects[i]);
    base_pair *edges = support_calloc(&v->of.scene->alloc, 2 * count, sizeof *edges); /* and as many to sort them */
    froe_status status = edges ? FROE_OK : FROE_E_MEMORY;
    if (edges) sort_edges(v, edges, count);
    for (size_t first = 0, end = 1; end < count && !status; end++) {
        if (end % EDGES == 0 && !base_progress(task, task->done)) status = FROE_E_CANCELLED;
        if (edges[end].key != edges[first].key) first = end;
        for (size_t i = first; i < end; i++) look_at_common_edge(v, edges[i].value, edges[end].value);
    }
    support_free(&v->of.scene->alloc, edges, 2 * count * sizeof *edges);
    return status;
}

/* ------------------------------------------------------------------ report -- */

static froe_status look_at_near_pairs(near_survey *v) {
    if (v->of.count < 2) return base_progress(&v->of.task, 1) ? FROE_OK : FROE_E_CANCELLED;
    const froe_allocator *alloc = &v->of.scene->alloc;
    v->found = support_calloc(alloc, v->of.task.threads, sizeof *v->found);
    if (!v->found) return FROE_E_MEMORY;
    const measure_candidates of = measure_survey_candidates(&v->of);
    const froe_status status = of.scene->dim == 3 ? look_at_common_edges(v) : FROE_OK;
    return status ? status : measure_odd_pairs(&v->of.task, &v->of.workers[0].context, &of, look_at_poking, v);
}

/* The largest coordinate of the scene. */
static double largest_coordinate(const froe_scene *s) {
    double most = 0;
    for (uint32_t i = 0; i < s->vertex_count; i++)
        for (int k = 0; k < s->dim; k++) most = fmax(most, fabs(scene_vertex(s, i)[k]));
    return most;
}

froe_status froe_measure_near(const froe_scene *scene, double share, unsigned threads, froe_progress_fn *progress,
                              void *user, froe_near *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!scene || !out) return support_fail_null(diag, __func__);
    if (!(share >= 0 && share <= 1))
        return support_fail(diag, FROE_E_ARG, "The share within which objects are near is not from 0 to 1.");
    const froe_status settled = scene_settle(scene, diag);
    if (settled) return settled;
    froe_near found = {.first_coplanar = {FROE_NONE, FROE_NONE},
                       .first_poking = {FROE_NONE, FROE_NONE},
                       .within = share * largest_coordinate(scene)};
    near_survey v = {.within = found.within};
    froe_status status = measure_survey_begin(scene, threads, progress, user, &v.of);
    if (!status) status = look_at_near_pairs(&v);
    for (unsigned i = 0; v.found && i < v.of.task.threads; i++) {
        const froe_near *of = v.found + i;
        measure_add_pairs(&found.coplanar, found.first_coplanar, of->coplanar, of->first_coplanar);
        measure_add_pairs(&found.poking, found.first_poking, of->poking, of->first_poking);
    }
    support_free(&scene->alloc, v.found, v.of.task.threads * sizeof *v.found);
    measure_survey_end(&v.of);
    if (status == FROE_E_CANCELLED) return support_fail_cancelled(diag);
    if (status) return support_fail_memory(diag);
    *out = found;
    return FROE_OK;
}
