/* inseparable.c: looking for a cut between the objects of a leaf that claims there is none. */
#include "tree/audit/inseparable.h"
#include "tree/audit/normals.h"
#include "tree/crowd.h"
#include <math.h>

typedef struct pair {
    num_context *context;
    base_task *task;
    const froe_scene *scene;
    normals *normals;
    uint32_t a, b;
} pair;

/* To be asked in long loops. */
static bool pair_may_go_on(const pair *p) {
    return base_progress(p->task, p->task->done);
}

/* ------------------------------------------------------------------- pairs -- */

static bool separates(const pair *p, const geom_plane *plane) {
    const froe_scene *s = p->scene;
    int a = geom_side_ball(p->context, plane, scene_point(s, p->a, 0), scene_radius(s, p->a));
    int b = geom_side_ball(p->context, plane, scene_point(s, p->b, 0), scene_radius(s, p->b));
    return a * b == -1;
}

static bool balls_separated(const pair *p) {
    const double *a = scene_point(p->scene, p->a, 0), *b = scene_point(p->scene, p->b, 0);
    double normal[3], length = 0, at = 0;
    for (int k = 0; k < p->scene->dim; k++) {
        normal[k] = b[k] - a[k];
        length += normal[k] * normal[k];
    }
    length = sqrt(length);
    double share = 0.5 + 0.5 * (scene_radius(p->scene, p->a) - scene_radius(p->scene, p->b)) / length;
    for (int k = 0; k < p->scene->dim; k++) at += normal[k] * (a[k] + share * normal[k]);
    if (!(length > 0) || !isfinite(length) || !isfinite(at)) return false;
    geom_plane plane = geom_plane_vector(p->scene->dim, normal, at);
    return separates(p, &plane);
}

static bool add_corners(normals *m, const froe_scene *s, uint32_t object) {
    uint32_t n = scene_corners(s, object);
    if (!array_reserve(&m->alloc, &m->points, n)) return false;
    for (uint32_t i = 0; i < n; i++) m->points.data[m->points.count++] = scene_point(s, object, i);
    return true;
}

static froe_status hulls_separated(const pair *p, bool *out) {
    normals *m = p->normals;
    m->points.count = 0;
    if (!add_corners(m, p->scene, p->a)) return FROE_E_MEMORY;
    m->first = (uint32_t)m->points.count;
    return add_corners(m, p->scene, p->b) ? normals_apart(m, out) : FROE_E_MEMORY;
}

static froe_status separated(const pair *p, bool *out) {
    froe_kind a = scene_form(p->scene, p->a), b = scene_form(p->scene, p->b);
    *out = a == FROE_BALL && b == FROE_BALL && balls_separated(p);
    return a == FROE_HULL && b == FROE_HULL ? hulls_separated(p, out) : FROE_OK;
}

/* --------------------------------------------------------------- the leaf -- */

static bool one_point(const froe_scene *s, const tree_objects *list) {
    for (uint32_t i = 0; i < list->count; i++)
        if (scene_form(s, tree_object(list, i)) != FROE_POINT ||
            scene_corner(s, tree_object(list, i), 0) != scene_corner(s, tree_object(list, 0), 0))
            return false;
    return true;
}

/* What objects are between on each axis: the first end of one, and the last beginning. */
typedef struct gauge {
    double least_hi[FROE_MAX_DIM], most_lo[FROE_MAX_DIM];
} gauge;

static void gauge_take(gauge *g, const froe_scene *s, uint32_t object, bool first) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    scene_object_bounds(s, object, lo, hi);
    for (int k = 0; k < s->dim; k++) {
        g->least_hi[k] = !first && g->least_hi[k] <= hi[k] ? g->least_hi[k] : hi[k];
        g->most_lo[k] = !first && g->most_lo[k] >= lo[k] ? g->most_lo[k] : lo[k];
    }
}

/* On some axis one object ends before, or where, one begins. */
static bool gauge_separates(const gauge *g, int dim) {
    for (int k = 0; k < dim; k++)
        if (g->least_hi[k] <= g->most_lo[k]) return true;
    return false;
}

static bool axis_separates(const froe_scene *s, const tree_objects *list) {
    gauge g;
    for (uint32_t i = 0; i < list->count; i++) gauge_take(&g, s, tree_object(list, i), !i);
    return gauge_separates(&g, s->dim);
}

static bool axis_separates_pair(const pair *p) {
    gauge g;
    gauge_take(&g, p->scene, p->a, true);
    gauge_take(&g, p->scene, p->b, false);
    return gauge_separates(&g, p->scene->dim);
}

/* Balls that all certainly hold one point inside cannot be separated two by two: the centre of the smallest is tried.
 */
static bool share_a_point(const froe_scene *s, const tree_objects *list) {
    uint32_t least = 0;
    for (uint32_t i = 0; i < list->count; i++) {
        if (scene_form(s, tree_object(list, i)) != FROE_BALL) return false;
        if (scene_radius(s, tree_object(list, i)) < scene_radius(s, tree_object(list, least))) least = i;
    }
    const double *x = scene_point(s, tree_object(list, least), 0);
    for (uint32_t i = 0; i < list->count; i++) {
        num_ball sum = num_ball_mul(num_ball_from(scene_radius(s, tree_object(list, i))),
                                    num_ball_from(scene_radius(s, tree_object(list, i))));
        for (int k = 0; k < s->dim; k++) {
            num_ball d = num_ball_sub(num_ball_from(scene_point(s, tree_object(list, i), 0)[k]), num_ball_from(x[k]));
            sum = num_ball_sub(sum, num_ball_mul(d, d));
        }
        if (num_ball_sign(sum) != 1) return false;
    }
    return true;
}

static froe_status any_pair_separated(pair *p, const tree_objects *list, bool *out) {
    *out = false;
    for (uint32_t i = 0; i < list->count && pair_may_go_on(p); i++) {
        p->a = tree_object(list, i);
        if (scene_form(p->scene, p->a) < FROE_BALL) continue; /* axis-parallel planes are complete for boxes */
        for (uint32_t j = 0; j < i && !*out; j++) {
            p->b = tree_object(list, j);
            froe_status status = separated(p, out);
            if (status) return status;
        }
        if (*out) break;
    }
    return FROE_OK;
}

froe_status inseparable_refuted(num_context *context, base_task *task, const froe_tree *tree, const tree_objects *list,
                                const char **why) {
    const froe_scene *s = tree->scene;
    *why = NULL;
    if (one_point(s, list)) return FROE_OK;
    *why = "the support of one of its objects would divide it";
    for (uint32_t i = 0; i < list->count; i++)
        if (scene_form(s, tree_object(list, i)) <= FROE_POLYGON) return FROE_OK;
    *why = "an axis-parallel plane separates two of its objects";
    if (axis_separates(s, list)) return FROE_OK;
    *why = NULL;
    if (s->dim > 3 || share_a_point(s, list)) return FROE_OK;
    normals m = {.context = context, .alloc = tree->alloc, .dim = s->dim};
    pair p = {.context = context, .task = task, .scene = s, .normals = &m};
    bool found;
    froe_status status = any_pair_separated(&p, list, &found);
    normals_free(&m);
    if (!status && found) *why = "a plane separates two of its objects";
    return status;
}

static froe_status count_crowd(pair *p, const tree_objects *list, tree_crowd *crowd) {
    while (!tree_crowd_known(crowd) && pair_may_go_on(p)) {
        p->a = tree_object(list, crowd->a);
        p->b = tree_object(list, crowd->b);
        bool apart = axis_separates_pair(p);
        froe_status status = apart || p->scene->dim > 3 ? FROE_OK : separated(p, &apart);
        if (status) return status;
        tree_crowd_tell(crowd, apart);
    }
    return FROE_OK;
}

froe_status crowded_refuted(num_context *context, base_task *task, const froe_tree *tree, const tree_objects *list,
                            const char **why) {
    const froe_scene *s = tree->scene;
    *why = "the support of one of its objects would divide it";
    for (uint32_t i = 0; i < list->count; i++)
        if (scene_form(s, tree_object(list, i)) <= FROE_POLYGON) return FROE_OK;
    normals m = {.context = context, .alloc = tree->alloc, .dim = s->dim};
    pair p = {.context = context, .task = task, .scene = s, .normals = &m};
    tree_crowd crowd = tree_crowd_of(list->count);
    froe_status status = count_crowd(&p, list, &crowd);
    normals_free(&m);
    *why = tree_crowd_is(&crowd) || base_cancelled(task) ? NULL : "most pairs of its objects can be separated";
    return status;
}
