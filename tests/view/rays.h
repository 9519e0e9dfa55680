/* rays.h: rays from an eye in exact rationals, the oracle of what is seen and in which order. */
#ifndef FROE_TESTS_VIEW_RAYS_H
#define FROE_TESTS_VIEW_RAYS_H
#include "../tree/trees.h"
#include "support/rational.h"
#include <froe/view.h>
#include <stdlib.h>

/* Where is x, a point of the object's hyperplane? 1 strictly inside, 0 on the border, -1 outside: by its sides of
 * upright walls over the edges; of a segment in the plane, of its two ends. */
static inline int rays_inside(const froe_scene *s, uint32_t object, rational_plane *support, rational_point *x) {
    const uint32_t n = scene_corners(s, object);
    bool left = false, right = false, on = false;
    mpq_t a[3], b[3], cross[3], side;
    for (int k = 0; k < 3; k++) mpq_inits(a[k], b[k], cross[k], NULL);
    mpq_init(side);
    for (uint32_t i = 0; i < n && !(s->dim == 3 && left && right); i++) {
        const double *u = scene_point(s, object, i), *v = scene_point(s, object, i + 1 < n ? i + 1 : 0);
        for (int k = 0; k < s->dim; k++) {
            mpq_set_d(a[k], v[k]), mpq_set_d(b[k], u[k]);
            mpq_sub(a[k], a[k], b[k]);
            mpq_mul(b[k], b[k], x->w);
            mpq_sub(b[k], x->x[k], b[k]); /* w (x - u) */
        }
        if (s->dim == 3) rational_cross(cross, a, b);
        rational_dot(side, s->dim == 3 ? cross : a, s->dim == 3 ? support->n : b);
        left |= mpq_sgn(side) > 0;
        right |= mpq_sgn(side) < 0;
        on |= mpq_sgn(side) == 0;
    }
    for (int k = 0; k < 3; k++) mpq_clears(a[k], b[k], cross[k], NULL);
    mpq_clear(side);
    const bool outside = s->dim == 3 ? left && right : right;
    return outside ? -1 : on ? 0 : 1;
}

/* The place on the ray, from + t (to - from) or to - t from: 1 when the ray pierces the object there, 0 when it meets
 * its border, -1 when it misses it or runs along it. */
static inline int rays_meet(const froe_scene *s, rational_point *from, rational_point *to, uint32_t object, mpq_t t,
                            rational_point *x) {
    geom_plane plane;
    if (scene_form(s, object) != (s->dim == 2 ? FROE_SEGMENT : FROE_POLYGON)) return -1;
    scene_support(s, object, &plane);
    rational_plane support;
    rational_plane_init(&support);
    rational_plane_set(&support, &plane);
    mpq_t at_from, at_to, zero;
    mpq_inits(at_from, at_to, zero, NULL);
    rational_value(at_from, &support, from);
    rational_value(at_to, &support, to);
    const bool far = mpq_sgn(from->w) == 0;
    bool meets = true;
    if (far) { /* x = to - t from;  t from -infinity (at the eye) upwards */
        meets = mpq_sgn(at_from) != 0;
        if (meets) mpq_div(t, at_to, at_from);
    } else { /* x = from + t (to - from) */
        mpq_sub(at_to, at_from, at_to);
        meets = mpq_sgn(at_to) != 0;
        if (meets) mpq_div(t, at_from, at_to);
        meets = meets && mpq_sgn(t) > 0;
    }
    for (int k = 0; k < 3 && meets; k++) {
        mpq_set(x->x[k], far ? to->x[k] : from->x[k]);
        if (!far) mpq_sub(zero, to->x[k], from->x[k]);
        rational_add_product(x->x[k], far ? -1 : 1, t, far ? from->x[k] : zero);
    }
    mpq_set_ui(x->w, 1, 1);
    x->dim = s->dim;
    mpq_clears(at_from, at_to, zero, NULL);
    const int where = meets ? rays_inside(s, object, &support, x) : -1;
    rational_plane_clear(&support);
    return where;
}

static inline bool rays_hit(const froe_scene *s, rational_point *from, rational_point *to, uint32_t object, mpq_t t,
                            rational_point *x) {
    return rays_meet(s, from, to, object, t, x) > 0;
}

/* Eyes at random, at a vertex, in the plane of an object; directions at random and along an axis. */
static inline froe_eye rays_eye(const froe_tree *tree, uint32_t e) {
    const froe_scene *s = tree->scene;
    const double span = s->hi[0] - s->lo[0];
    froe_eye eye = {.parallel = e % 2};
    for (int k = 0; k < s->dim; k++) {
        const double unit = trees_unit(5, 3 * e + (uint32_t)k);
        eye.at[k] = eye.parallel ? unit - 0.5 : s->lo[k] + (2 * unit - 0.5) * span;
        if (e % 5 == 2) eye.at[k] = (double)(int)eye.at[k];
        if (e % 5 == 4) eye.at[k] = eye.parallel ? k == (int)e % s->dim : scene_vertex(s, e % s->vertex_count)[k];
    }
    if (eye.parallel && eye.at[0] == 0 && eye.at[1] == 0 && eye.at[2] == 0) eye.at[0] = -1;
    return eye;
}

#endif
