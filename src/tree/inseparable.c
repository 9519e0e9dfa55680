/* inseparable.c: looking for a cut between the objects of a leaf that claims there is none. */
#include "tree/inseparable.h"
#include "tree/normals.h"
#include <math.h>

typedef struct pair {
    num_context *context;
    base_task *task;
    const froe_scene *scene;
    normals *normals;
    uint32_t a, b;
} pair;

/* To be asked in long loops. */
static bool go_on(const pair *p) {
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

/* On some axis one object ends before, or where, one begins. */
static bool axis_separates(const froe_scene *s, const tree_objects *list) {
    double least_hi[FROE_MAX_DIM], most_lo[FROE_MAX_DIM], lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    for (uint32_t i = 0; i < list->count; i++) {
        scene_object_bounds(s, tree_object(list, i), lo, hi);
        for (int k = 0; k < s->dim; k++) {
            least_hi[k] = i && least_hi[k] <= hi[k] ? least_hi[k] : hi[k];
            most_lo[k] = i && most_lo[k] >= lo[k] ? most_lo[k] : lo[k];
        }
    }
    for (int k = 0; k < s->dim; k++)
        if (least_hi[k] <= most_lo[k]) return true;
    return false;
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
    for (uint32_t i = 0; i < list->count && go_on(p); i++) {
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
