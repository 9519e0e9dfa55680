/* inseparable.c: looking for a cut between the objects of a leaf that claims there is none. */
#include "tree/inseparable.h"
#include <math.h>

typedef struct pair {
    num_context *context;
    base_task *task;
    const froe_scene *scene;
    uint32_t a, b;
} pair;

/* ------------------------------------------------------------------- sides -- */

/* -1, 1: touching at most; 0: in the plane; 2: divided. */
static int hull_side(const pair *p, const geom_plane *plane, uint32_t object) {
    bool negative = false, positive = false;
    for (uint32_t i = 0; i < scene_corners(p->scene, object); i++) {
        int side = geom_side_vertex(p->context, plane, scene_point(p->scene, object, i));
        negative |= side < 0;
        positive |= side > 0;
    }
    return negative && positive ? 2 : positive - negative;
}

static int side_of(const pair *p, const geom_plane *plane, uint32_t object) {
    if (scene_form(p->scene, object) == FROE_HULL) return hull_side(p, plane, object);
    return geom_side_ball(p->context, plane, scene_point(p->scene, object, 0), scene_radius(p->scene, object));
}

/* To be asked in long loops. */
static bool go_on(const pair *p) {
    return base_progress(p->task, p->task->done);
}

static bool separates(const pair *p, const geom_plane *plane) {
    int a = side_of(p, plane, p->a), b = side_of(p, plane, p->b);
    return a * b == -1;
}

/* ------------------------------------------------------------------- pairs -- */

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

/* The i-th corner of both hulls taken together. */
static const double *joint_corner(const pair *p, uint32_t i) {
    uint32_t n = scene_corners(p->scene, p->a);
    return i < n ? scene_point(p->scene, p->a, i) : scene_point(p->scene, p->b, i - n);
}

static bool plane_separates(const pair *p, const double *const points[3]) {
    geom_plane plane = geom_plane_points(p->scene->dim, points);
    return geom_plane_valid(p->context, &plane) && separates(p, &plane);
}

static bool hulls_separated(const pair *p) {
    uint32_t n = scene_corners(p->scene, p->a) + scene_corners(p->scene, p->b);
    const double *x[3];
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = i + 1; j < n && go_on(p); j++) {
            x[0] = joint_corner(p, i);
            x[1] = joint_corner(p, j);
            if (p->scene->dim == 2 && plane_separates(p, x)) return true;
            for (uint32_t k = j + 1; k < n && p->scene->dim == 3; k++) {
                x[2] = joint_corner(p, k);
                if (plane_separates(p, x)) return true;
            }
        }
    return false;
}

static bool separated(const pair *p) {
    froe_kind a = scene_form(p->scene, p->a), b = scene_form(p->scene, p->b);
    if (a != b) return false;
    return a == FROE_BALL ? balls_separated(p) : a == FROE_HULL && hulls_separated(p);
}

/* --------------------------------------------------------------- the leaf -- */

static bool one_point(const froe_scene *s, const tree_piece *list, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        if (scene_form(s, list[i].object) != FROE_POINT ||
            scene_corner(s, list[i].object, 0) != scene_corner(s, list[0].object, 0))
            return false;
    return true;
}

/* On some axis one object ends before, or where, one begins. */
static bool axis_separates(const froe_scene *s, const tree_piece *list, uint32_t count) {
    double least_hi[FROE_MAX_DIM], most_lo[FROE_MAX_DIM], lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    for (uint32_t i = 0; i < count; i++) {
        scene_object_bounds(s, list[i].object, lo, hi);
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
static bool share_a_point(const froe_scene *s, const tree_piece *list, uint32_t count) {
    uint32_t least = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (scene_form(s, list[i].object) != FROE_BALL) return false;
        if (scene_radius(s, list[i].object) < scene_radius(s, list[least].object)) least = i;
    }
    const double *x = scene_point(s, list[least].object, 0);
    for (uint32_t i = 0; i < count; i++) {
        num_ball sum = num_ball_mul(num_ball_from(scene_radius(s, list[i].object)),
                                    num_ball_from(scene_radius(s, list[i].object)));
        for (int k = 0; k < s->dim; k++) {
            num_ball d = num_ball_sub(num_ball_from(scene_point(s, list[i].object, 0)[k]), num_ball_from(x[k]));
            sum = num_ball_sub(sum, num_ball_mul(d, d));
        }
        if (num_ball_sign(sum) != 1) return false;
    }
    return true;
}

static bool any_pair_separated(pair p, const tree_piece *list, uint32_t count) {
    for (uint32_t i = 0; i < count && go_on(&p); i++) {
        p.a = list[i].object;
        if (scene_form(p.scene, p.a) < FROE_BALL) continue; /* axis-parallel planes are complete for boxes */
        for (uint32_t j = 0; j < i; j++) {
            p.b = list[j].object;
            if (separated(&p)) return true;
        }
    }
    return false;
}

const char *inseparable_refuted(num_context *context, base_task *task, const froe_tree *tree, const tree_piece *list,
                                uint32_t count) {
    const froe_scene *s = tree->scene;
    if (one_point(s, list, count)) return NULL;
    for (uint32_t i = 0; i < count; i++)
        if (scene_form(s, list[i].object) <= FROE_POLYGON) return "the support of one of its objects would divide it";
    if (axis_separates(s, list, count)) return "an axis-parallel plane separates two of its objects";
    if (s->dim > 3 || share_a_point(s, list, count)) return NULL;
    pair p = {.context = context, .task = task, .scene = s};
    return any_pair_separated(p, list, count) ? "a plane separates two of its objects" : NULL;
}
