/* near.c: what was rounded before froe saw it: walls that are flat, and ends that stop at a wall, up to a few last
 * places.
 *
 *      ______/______        b was meant to lie in the plane of a;          -------+-
 *        a      b           its far corner lies beside it by 1e-16        ends stick out by 1e-16
 *
 * A pair is looked at exactly only if distances in doubles say that it may count. */
#include "base/floats.h"
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

/* Do two polygons have just one edge, or pair of corners, in common? */
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

static bool look_at_near_pair(void *user, unsigned worker, uint32_t i, uint32_t j) {
    near_survey *v = user;
    froe_near *found = v->found + worker;
    const froe_scene *s = v->of.scene;
    const uint32_t a = v->of.objects[i < j ? i : j], b = v->of.objects[i < j ? j : i];
    geom_plane of_a, of_b;
    scene_support(s, a, &of_a);
    scene_support(s, b, &of_b);
    const reach a_beside_b = reach_beside(s, &of_b, a), b_beside_a = reach_beside(s, &of_a, b);
    const bool flat = reach_is_near(a_beside_b, v->within) && reach_is_near(b_beside_a, v->within);
    if (flat && s->dim == 3 && share_two_vertices(s, a, b)) {
        if (!in_one_plane(s, &v->of.workers[worker].context, &of_a, b))
            measure_note_pair(&found->coplanar, found->first_coplanar, a, b);
    } else if (reach_pokes(a_beside_b, v->within) || reach_pokes(b_beside_a, v->within)) {
        const geom_contact m = measure_survey_meet(&v->of, worker, a, b);
        if (m.kind == GEOM_CROSS || (m.kind == GEOM_TOUCH && m.touch == GEOM_TOUCH_EDGES))
            measure_note_pair(&found->poking, found->first_poking, a, b);
    }
    return true;
}

/* ------------------------------------------------------------------ report -- */

static froe_status look_at_near_pairs(near_survey *v) {
    if (v->of.count < 2) return base_progress(&v->of.task, 1) ? FROE_OK : FROE_E_CANCELLED;
    const froe_allocator *alloc = &v->of.scene->alloc;
    v->found = support_calloc(alloc, v->of.task.threads, sizeof *v->found);
    if (!v->found) return FROE_E_MEMORY;
    const measure_candidates of = measure_survey_candidates(&v->of);
    return geom_box_pairs(alloc, &v->of.task, 1, of.scene->dim, of.count, of.lo, of.hi, look_at_near_pair, v);
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
