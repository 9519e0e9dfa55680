/* ray_place.c: the point where a ray hits a body, how far it is, and the normal of the face there.
 *
 * With the parameter (p + q sqrt(r)) / s all of these are numbers of the same form, which are rounded once:
 *
 *     point      (o s + d p + d q sqrt(r)) / s
 *     distance   t |d|
 *     normal     n / |n| = n sqrt(n^2) / n^2 of a face; (point - centre) / radius of a ball
 */
#include "geom/formulas.h"
#include "geom/ray/ray.h"
#include <string.h>

/* o + t d - origin, along axis k. */
static num_surd hit_coordinate(num_arena *arena, const geom_ray *ray, const num_surd *t, int k, double origin) {
    const num_dyadic d = num_dyadic_from(arena, ray->d[k]);
    const num_dyadic from = num_dyadic_sub(arena, num_dyadic_from(arena, ray->o[k]), num_dyadic_from(arena, origin));
    num_surd x = *t;
    x.p = num_dyadic_add(arena, num_dyadic_mul(arena, from, t->s), num_dyadic_mul(arena, d, t->p));
    if (t->q.sign) x.q = num_dyadic_mul(arena, d, t->q);
    return x;
}

void geom_hit_point(num_context *context, const geom_ray *ray, const geom_hit *a, double *out) {
    num_arena *arena = num_fresh(context);
    const num_surd t = geom_hit_surd(arena, ray, a);
    const size_t mark = arena->top;
    for (int k = 0; k < ray->dim; k++, arena->top = mark)
        out[k] = num_surd_round(arena, hit_coordinate(arena, ray, &t, k, 0));
}

/* ---------------------------------------------------------------- distance -- */

/* b + sqrt(c) + sqrt(e), where b < 0, c >= 0, e > 0: by squares,  c + e - b^2 + 2 sqrt(c e). */
static int sign_of_two_roots(num_arena *arena, num_dyadic b, num_dyadic c, num_dyadic e) {
    const num_dyadic whole = num_dyadic_sub(arena, num_dyadic_add(arena, c, e), num_dyadic_mul(arena, b, b));
    return num_root_sign(arena, whole, num_dyadic_scaled(arena, 1, 2, 0), num_dyadic_mul(arena, c, e));
}

typedef struct sphere_path {
    num_dyadic b, root, a; /* of a sphere: the distance is (-b - sqrt(root)) / sqrt(a) */
} sphere_path;

/* Sign of the distance from a sphere minus x. */
static int sphere_path_against(void *user, num_arena *arena, num_dyadic x) {
    const sphere_path *f = user;
    const num_dyadic e = num_dyadic_mul(arena, num_dyadic_mul(arena, x, x), f->a);
    return -sign_of_two_roots(arena, f->b, f->root, e);
}

double geom_hit_distance(num_context *context, const geom_ray *ray, const geom_hit *a) {
    num_arena *arena = num_fresh(context);
    const num_surd t = geom_hit_surd(arena, ray, a);
    num_dyadic square = {0};
    for (int k = 0; k < ray->dim; k++) {
        const num_dyadic d = num_dyadic_from(arena, ray->d[k]);
        square = num_dyadic_add(arena, square, num_dyadic_mul(arena, d, d));
    }
    if (!t.q.sign) return num_surd_round(arena, (num_surd){.q = t.p, .r = square, .s = t.s});
    sphere_path f = {t.p, t.r, square};
    f.b.sign = -f.b.sign;
    const num_dyadic one = num_dyadic_scaled(arena, 1, 1, 0);
    const double length = sqrt(num_dyadic_quotient(arena, square, one));
    return num_nearest(arena, sphere_path_against, &f, a->t.x * length);
}

/* ------------------------------------------------------------------ normal -- */

static void between(num_arena *arena, int dim, const double *p, const double *q, num_dyadic out[3]) {
    for (int k = 0; k < 3; k++)
        out[k] = k < dim ? num_dyadic_sub(arena, num_dyadic_from(arena, q[k]), num_dyadic_from(arena, p[k]))
                         : (num_dyadic){0};
}

/* Across p .. q in the plane, to the left. */
static void across_line(num_arena *arena, const double *p, const double *q, num_dyadic n[3]) {
    num_dyadic e[3];
    between(arena, 2, p, q, e);
    n[0] = e[1], n[1] = e[0], n[2] = e[2];
    n[0].sign = -n[0].sign;
}

static void across_plane(num_arena *arena, const double *p, const double *q, const double *r, num_dyadic n[3]) {
    num_dyadic e[3], f[3];
    between(arena, 3, p, q, e);
    between(arena, 3, p, r, f);
    vector_cross_dyadic(arena, e, f, n);
}

/* The exact normal of a face, of any length; false: there is none. */
static bool face_normal(num_arena *arena, const geom_ray *ray, const geom_body *body, const geom_hit *a,
                        num_dyadic n[3]) {
    if (body->form == FROE_POLYGON) {
        across_plane(arena, geom_body_point(body, 0), geom_body_point(body, 1), geom_body_point(body, 2), n);
        return true;
    }
    if (body->form == FROE_SEGMENT && ray->dim == 2) {
        across_line(arena, geom_body_point(body, 0), geom_body_point(body, 1), n);
        return true;
    }
    if (body->form != FROE_HULL) return false;
    if (a->source == GEOM_PLANE)
        across_plane(arena, a->p, a->q, a->r, n);
    else if (a->source == GEOM_LINE && ray->dim == 2)
        across_line(arena, a->p, a->q, n);
    else
        return false;
    num_dyadic d[3]; /* hulls are entered against their normals */
    for (int k = 0; k < 3; k++) d[k] = num_dyadic_from(arena, ray->d[k]);
    const int along = vector_dot_dyadic(arena, n, d).sign;
    for (int k = 0; k < 3; k++) n[k].sign = along > 0 ? -n[k].sign : n[k].sign;
    return true;
}

static bool ball_normal(num_arena *arena, const geom_ray *ray, const geom_body *body, const geom_hit *a, double *out) {
    num_surd t = geom_hit_surd(arena, ray, a);
    const num_dyadic radius = num_dyadic_from(arena, body->radius);
    const size_t mark = arena->top;
    for (int k = 0; k < ray->dim; k++, arena->top = mark) {
        num_surd x = hit_coordinate(arena, ray, &t, k, geom_body_point(body, 0)[k]);
        x.s = num_dyadic_mul(arena, t.s, radius);
        out[k] = num_surd_round(arena, x);
    }
    return true;
}

bool geom_hit_normal(num_context *context, const geom_ray *ray, const geom_body *body, const geom_hit *a, double *out) {
    num_arena *arena = num_fresh(context);
    memset(out, 0, (size_t)ray->dim * sizeof *out);
    if (body->form == FROE_BOX && a->source == GEOM_COORDINATE) {
        out[a->axis] = ray->d[a->axis] > 0 ? -1 : 1;
        return true;
    }
    if (body->form == FROE_BALL && a->source == GEOM_SPHERE) return ball_normal(arena, ray, body, a, out);
    num_dyadic n[3];
    if (ray->dim > 3 || (body->form == FROE_HULL && !geom_hit_sign(context, ray, a))) return false;
    arena = num_fresh(context);
    if (!face_normal(arena, ray, body, a, n)) return false;
    const num_dyadic square = vector_dot_dyadic(arena, n, n);
    const size_t mark = arena->top;
    for (int k = 0; k < ray->dim; k++, arena->top = mark)
        out[k] = num_surd_round(arena, (num_surd){.q = n[k], .r = square, .s = square});
    return true;
}
