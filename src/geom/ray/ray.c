/* ray.c: see ray.h. Each answer by the stages of num/ladder.h. */
#include "geom/ray/ray.h"
#include "geom/filter.h"
#include "geom/formulas.h"
#include "geom/high/high.h"
#include "geom/predicates.h"
#include "num/pair.h"
#include "num/root.h"

#include "num/ball_terms.inc"

#include "geom/ray/ray_body.inc"

#include "num/dyadic_terms.inc"

#include "geom/ray/ray_body.inc"

/* -------------------------------------------------------------- parameters -- */

static num_ratio exact_quotient(num_arena *arena, const geom_ray *ray, const geom_hit *h) {
    num_ratio t;
    if (h->source == GEOM_BASIS) return geom_high_parameter(arena, ray, h);
    t.top = ray_quotient_dyadic(arena, ray, h, &t.bottom);
    if (t.bottom.sign < 0) t.bottom.sign = 1, t.top.sign = -t.top.sign;
    return t;
}

void geom_hit_image(num_context *context, const geom_ray *ray, geom_hit *hit) {
    num_ball bottom, top;
    hit->t = (num_ball){0, hit->source == GEOM_START ? 0 : (double)INFINITY};
    if (hit->source == GEOM_START || context->first == NUM_EXACT) return;
    if (hit->source == GEOM_SPHERE) {
        num_ball a, b, c, root = num_ball_sqrt(ray_sphere_ball(NULL, ray, hit->p, hit->c, &a, &b, &c));
        hit->t = filter_div(c, filter_sub(root, b)); /* c / (-b + root): nothing cancels, b < 0 */
        return;
    }
    if (hit->source == GEOM_BASIS) { /* the nearest double */
        const num_ratio t = geom_high_parameter(num_fresh(context), ray, hit);
        const double x = num_dyadic_quotient(&context->arena, t.top, t.bottom);
        hit->t = (num_ball){x, 0x1p-52 * fabs(x) + 0x1p-1074};
        return;
    }
    top = ray_quotient_ball(NULL, ray, hit, &bottom);
    hit->t = filter_div(top, bottom);
}

int geom_hit_sign(num_context *context, const geom_ray *ray, const geom_hit *hit) {
    int sign;
    context->stats.calls++;
    return NUM_LADDER(context, sign, hit->source == GEOM_SPHERE ? 1 : num_ball_sign(hit->t), NUM_UNSURE, NUM_UNSURE,
                      hit->source == GEOM_SPHERE ? 1 : exact_quotient(num_fresh(context), ray, hit).top.sign);
}

typedef struct sphere {
    num_dyadic a, b, root;
} sphere;

static sphere exact_sphere(num_arena *arena, const geom_ray *ray, const geom_hit *h) {
    sphere s;
    num_dyadic c;
    s.root = ray_sphere_dyadic(arena, ray, h->p, h->c, &s.a, &s.b, &c);
    return s;
}

num_surd geom_hit_surd(num_arena *arena, const geom_ray *ray, const geom_hit *h) {
    if (h->source == GEOM_SPHERE) {
        sphere s = exact_sphere(arena, ray, h);
        s.b.sign = -s.b.sign;
        return (num_surd){s.b, num_dyadic_scaled(arena, -1, 1, 0), s.root, s.a};
    }
    const num_ratio t =
        h->source == GEOM_START ? (num_ratio){{0}, num_dyadic_scaled(arena, 1, 1, 0)} : exact_quotient(arena, ray, h);
    return (num_surd){.p = t.top, .s = t.bottom};
}

/* A quotient p / q against (-b - sqrt(root)) / a: the sign of  a p + b q + q sqrt(root). */
static int against_sphere(num_arena *arena, num_ratio t, const sphere *s) {
    num_dyadic sum = num_dyadic_add(arena, num_dyadic_mul(arena, s->a, t.top), num_dyadic_mul(arena, s->b, t.bottom));
    return num_root_sign(arena, sum, t.bottom, s->root);
}

static int compare_hits_exactly(num_arena *arena, const geom_ray *ray, const geom_hit *a, const geom_hit *b) {
    if (a->source != GEOM_SPHERE && b->source != GEOM_SPHERE)
        return num_ratio_compare(arena, exact_quotient(arena, ray, a), exact_quotient(arena, ray, b));
    if (a->source == GEOM_SPHERE && b->source == GEOM_SPHERE) {
        sphere s = exact_sphere(arena, ray, a), t = exact_sphere(arena, ray, b);
        num_dyadic one = num_dyadic_scaled(arena, 1, 1, 0);
        return num_roots_compare(arena, (num_ratio){t.root, one}, (num_ratio){s.root, one},
                                 num_dyadic_sub(arena, s.b, t.b));
    }
    sphere s = exact_sphere(arena, ray, a->source == GEOM_SPHERE ? a : b);
    int sign = against_sphere(arena, exact_quotient(arena, ray, a->source == GEOM_SPHERE ? b : a), &s);
    return a->source == GEOM_SPHERE ? -sign : sign;
}

/* The axis along which all corners of a PLANE in space have one coordinate; -1: there is none. Walls and floors of
 * models are such. */
static int wall_axis(const geom_hit *h) {
    for (int k = 0; h->source == GEOM_PLANE && k < 3; k++)
        if (h->p[k] == h->q[k] && h->p[k] == h->r[k]) return k;
    return -1;
}

/* Do the sources alone say that both are equal? Walls of two bodies that touch lie in one plane. */
static bool same_source(const geom_hit *a, const geom_hit *b) {
    if (a->source == GEOM_START && b->source == GEOM_START) return true;
    const int axis = wall_axis(a);
    return axis >= 0 && axis == wall_axis(b) && a->p[axis] == b->p[axis];
}

int geom_hit_compare(num_context *context, const geom_ray *ray, const geom_hit *a, const geom_hit *b) {
    int sign;
    context->stats.calls++;
    return NUM_LADDER(context, sign, filter_sign(filter_sub(a->t, b->t)),
                      same_source(a, b) ? num_by_id(context, 0) : NUM_UNSURE, NUM_UNSURE,
                      compare_hits_exactly(num_fresh(context), ray, a, b));
}

/* Sign of (-b - sqrt(root)) / a minus x. */
static int sphere_against(void *user, num_arena *arena, num_dyadic x) {
    num_ratio bound = {x, num_dyadic_scaled(arena, 1, 1, 0)};
    return -against_sphere(arena, bound, user);
}

static int hit_beyond_exactly(num_arena *arena, const geom_ray *ray, const geom_hit *a, double t) {
    if (a->source == GEOM_SPHERE) {
        sphere s = exact_sphere(arena, ray, a);
        return sphere_against(&s, arena, num_dyadic_from(arena, t));
    }
    num_ratio bound = {num_dyadic_from(arena, t), num_dyadic_scaled(arena, 1, 1, 0)};
    return num_ratio_compare(arena, exact_quotient(arena, ray, a), bound);
}

int geom_hit_compare_to(num_context *context, const geom_ray *ray, const geom_hit *a, double t) {
    int sign;
    if (isinf(t)) return -1;
    context->stats.calls++;
    return NUM_LADDER(context, sign, filter_sign(filter_sub(a->t, num_ball_from(t))), NUM_UNSURE, NUM_UNSURE,
                      hit_beyond_exactly(num_fresh(context), ray, a, t));
}

/* Are sizes such that pairs of doubles neither overflow nor underflow? */
static bool is_moderate(double size) {
    return size > 0x1p-300 && size < 0x1p200;
}

/* The parameter of a wall, (c - o) / d along its axis, by pairs of doubles: one difference, which is exact, and one
 * quotient, off by less than 2^-98 of itself. Triangles as thin as they may be do not matter here. */
static bool round_wall(const geom_ray *ray, const geom_hit *h, double *out) {
    const int axis = wall_axis(h);
    if (axis < 0) return false;
    const double d = ray->d[axis];
    const num_pair gap = num_pair_sum(h->p[axis], -ray->o[axis]), t = num_pair_div(gap, (num_pair){d, 0});
    const double error = 0x1p-96 * t.hi;
    *out = t.hi + (t.lo - error);
    return *out == t.hi + (t.lo + error) && t.hi > 0x1p-200 && is_moderate(fabs(gap.hi)) && is_moderate(fabs(d));
}

/* The parameter of a PLANE, if pairs of doubles can tell how it is to be rounded. With sizes as sums of coordinates, a
 * product of three vectors is off by less than 2^-96 |e| |f| |v|. Where products underflow, |n . d| is below 2^-600,
 * and so far below |e| |f| |d| that nothing can be told. */
static bool round_plane(const geom_ray *ray, const geom_hit *h, double *out) {
    num_pair e[3], f[3], v[3], n[3], d[3];
    const double zero[3] = {0}, e_size = num_pair_between(h->p, h->q, e), f_size = num_pair_between(h->p, h->r, f),
                 v_size = num_pair_between(ray->o, h->p, v), d_size = num_pair_between(zero, ray->d, d);
    num_pair_cross(e, f, n);
    const num_pair top = num_pair_dot(n, v), bottom = num_pair_dot(n, d), t = num_pair_div(top, bottom);
    const double sizes[4] = {e_size, f_size, v_size, d_size}, low = fabs(bottom.hi);
    for (int i = 0; i < 4; i++)
        if (!(sizes[i] > 0x1p-100 && sizes[i] < 0x1p200)) return false;
    const double error = 0x1p-95 * e_size * f_size * (v_size + fabs(t.hi) * d_size) / low + 0x1p-96 * fabs(t.hi);
    *out = t.hi + (t.lo - error);
    return *out == t.hi + (t.lo + error) && t.hi > 0x1p-200;
}

double geom_hit_round(num_context *context, const geom_ray *ray, const geom_hit *a) {
    num_arena *arena = num_fresh(context);
    double rounded;
    if (a->source == GEOM_START) return 0;
    if (a->source == GEOM_PLANE && context->first < NUM_EXACT &&
        (round_wall(ray, a, &rounded) || round_plane(ray, a, &rounded)))
        return rounded;
    if (a->source != GEOM_SPHERE) {
        num_ratio t = exact_quotient(arena, ray, a);
        return num_dyadic_quotient(arena, t.top, t.bottom);
    }
    sphere s = exact_sphere(arena, ray, a);
    return num_nearest(arena, sphere_against, &s, a->t.x);
}

/* ------------------------------------------------------------------- sides -- */

/* As filter_sum (geom/filter.h): two differences, two products, one more difference. */
static int beside_filter(const geom_ray *ray, const double *p) {
    double a = ray->d[0] * (p[1] - ray->o[1]), b = ray->d[1] * (p[0] - ray->o[0]);
    return filter_sign((num_ball){a - b, 8 * FILTER_U * (fabs(a) + fabs(b)) + NUM_BALL_TINY});
}

static int side_beside_ray(num_context *context, const geom_ray *ray, const double *p) {
    int sign;
    context->stats.calls++;
    return NUM_DECIDE(context, sign, beside_filter(ray, p), NUM_UNSURE, side_of_ray, ray, 0, 1, p);
}

/* The determinant of three vectors, two of them rounded once: at most 3 + 1 + 1 + 2 roundings on each of
 * its six terms. An underflow of an inner product is multiplied by a component of d. */
static int passes_filter(const geom_ray *ray, const double *p, const double *q) {
    double v[3], w[3], sum = 0, size = 0, spread = 1;
    for (int k = 0; k < 3; k++) v[k] = p[k] - ray->o[k], w[k] = q[k] - ray->o[k];
    for (int k = 0; k < 3; k++) {
        int i = k == 2 ? 0 : k + 1, j = k == 0 ? 2 : k - 1;
        double a = v[i] * w[j], b = v[j] * w[i];
        sum += ray->d[k] * (a - b);
        size += fabs(ray->d[k]) * (fabs(a) + fabs(b));
        spread += fabs(ray->d[k]);
    }
    return filter_sign((num_ball){sum, (16 * FILTER_U * size + NUM_BALL_TINY * spread) * FILTER_UP});
}

static int passes(num_context *context, const geom_ray *ray, const double *p, const double *q) {
    int sign;
    context->stats.calls++;
    return NUM_DECIDE(context, sign, passes_filter(ray, p, q), NUM_UNSURE, way_past_line, ray, p, q);
}

/* ------------------------------------------------------------------- boxes -- */

static geom_hit at_coordinate(num_context *context, const geom_ray *ray, int axis, double c) {
    geom_hit h = {.source = GEOM_COORDINATE, .axis = axis, .c = c};
    geom_hit_image(context, ray, &h);
    return h;
}

/* Between the last entry and the first exit over the axes; a point is a box, too. */
static bool meets_box(num_context *context, const geom_ray *ray, const double *lo, const double *hi, geom_hit *first) {
    geom_hit in = {.source = GEOM_START}, out = {.source = GEOM_START};
    bool bounded = false;
    for (int k = 0; k < ray->dim; k++) {
        bool up = ray->d[k] > 0;
        double o = ray->o[k], near = up ? lo[k] : hi[k], far = up ? hi[k] : lo[k];
        if (ray->d[k] == 0 && (o < lo[k] || o > hi[k])) return false;
        if (ray->d[k] == 0) continue;
        if (up ? far < o : far > o) return false;
        geom_hit exit = at_coordinate(context, ray, k, far);
        if (!bounded || geom_hit_compare(context, ray, &exit, &out) < 0) out = exit;
        bounded = true;
        if (up ? near <= o : near >= o) continue;
        geom_hit entry = at_coordinate(context, ray, k, near);
        if (geom_hit_compare(context, ray, &entry, &in) > 0) in = entry;
    }
    *first = in;
    return geom_hit_compare(context, ray, &in, &out) <= 0;
}

/* ------------------------------------------------------------------- balls -- */

static bool meets_ball(num_context *context, const geom_ray *ray, const geom_body *body, geom_hit *first) {
    const double *centre = geom_body_point(body, 0);
    bool inside = false;
    int meets;
    context->stats.calls++;
    meets = NUM_DECIDE(context, meets, NUM_UNSURE, NUM_UNSURE, ray_meets_sphere, ray, centre, body->radius, &inside);
    *first = (geom_hit){.source = inside ? GEOM_START : GEOM_SPHERE, .p = centre, .c = body->radius};
    if (meets) geom_hit_image(context, ray, first);
    return meets;
}

/* ---------------------------------------------------- segments and polygons -- */

/* Both ends are on the line of the ray: only coordinates along one axis matter. */
static bool meets_along(num_context *context, const geom_ray *ray, const double *p, const double *q, geom_hit *first) {
    int axis = ray->d[0] != 0 ? 0 : 1;
    bool up = ray->d[axis] > 0, p_first = up ? p[axis] < q[axis] : p[axis] > q[axis];
    double o = ray->o[axis], near = (p_first ? p : q)[axis], far = (p_first ? q : p)[axis];
    *first = (geom_hit){.source = GEOM_START};
    if (up ? far < o : far > o) return false;
    if (up ? near > o : near < o) *first = at_coordinate(context, ray, axis, near);
    return true;
}

static bool meets_segment_2d(num_context *context, const geom_ray *ray, const double *p, const double *q,
                             geom_hit *first) {
    int at_p = side_beside_ray(context, ray, p), at_q = side_beside_ray(context, ray, q);
    if (at_p * at_q > 0) return false;
    if (!at_p && !at_q) return meets_along(context, ray, p, q, first);
    geom_plane line = geom_plane_points(2, (const double *const[]){p, q});
    int origin =
        geom_side_vertex(context, &line, ray->o); /* t (d x e) = (p - o) x e, and d x e has the sign of q - p */
    if (origin * (at_q - at_p) < 0) return false;
    *first = (geom_hit){.source = origin ? GEOM_LINE : GEOM_START, .axis = 0, .other = 1, .p = p, .q = q};
    geom_hit_image(context, ray, first);
    return true;
}

/* All edges must be passed the same way; touching them will do. If the ray lies in the plane, it passes none. */
static bool meets_polygon(num_context *context, const geom_ray *ray, const geom_body *body, geom_hit *first) {
    int way = 0;
    const double *p = geom_body_point(body, body->count - 1);
    for (uint32_t i = 0; i < body->count; i++) {
        const double *q = geom_body_point(body, i);
        int sign = passes(context, ray, p, q);
        if (way * sign < 0) return false;
        way += way ? 0 : sign;
        p = q;
    }
    if (!way) return geom_ray_meets_hull(context, ray, body, first);
    const double *corner[3];
    for (uint32_t i = 0; i < 3; i++) corner[i] = geom_body_point(body, i);
    geom_plane plane = geom_plane_points(3, corner);
    int origin = geom_side_vertex(context, &plane, ray->o);
    if (origin * way > 0) return false; /* the ray goes on that way, away from the plane */
    *first = (geom_hit){.source = origin ? GEOM_PLANE : GEOM_START, .p = corner[0], .q = corner[1], .r = corner[2]};
    geom_hit_image(context, ray, first);
    return true;
}

geom_hit geom_ray_through(const geom_body *body) {
    return (geom_hit){.source = GEOM_PLANE,
                      .p = geom_body_point(body, 0),
                      .q = geom_body_point(body, 1),
                      .r = geom_body_point(body, 2),
                      .t = {0, INFINITY}};
}

/* A triangle of space, by filters: 1, 0, or NUM_UNSURE. A ray that passes all edges the same way crosses the plane
 * within them, at n . (p - o) / n . d. */
static int meets_triangle(const geom_ray *ray, const geom_body *body, geom_hit *first) {
    const double *p[3], *o = ray->o;
    int way[3];
    for (uint32_t i = 0; i < 3; i++) p[i] = geom_body_point(body, i);
    for (int i = 0; i < 3; i++) way[i] = passes_filter(ray, p[i], p[i == 2 ? 0 : i + 1]);
    if (way[0] * way[1] == -1 || way[1] * way[2] == -1 || way[2] * way[0] == -1) return 0;
    if (way[0] == NUM_UNSURE || way[1] == NUM_UNSURE || way[2] == NUM_UNSURE) return NUM_UNSURE;
    const filter_vector e = filter_between(p[0], p[1]), f = filter_between(p[0], p[2]), v = filter_between(o, p[0]);
    const filter_vector n = filter_cross(&e, &f), d = filter_exact(ray->d);
    const num_ball top = filter_dot(&n, &v), bottom = filter_dot(&n, &d);
    const int above = filter_sign(top), along = filter_sign(bottom);
    if (above == NUM_UNSURE || along == NUM_UNSURE) return NUM_UNSURE;
    if (above != along) return 0; /* it is behind */
    *first = geom_ray_through(body);
    first->t = filter_div(top, bottom);
    return 1;
}

bool geom_ray_meets(num_context *context, const geom_ray *ray, const geom_body *body, geom_hit *first) {
    if (body->count == 3 && body->form == FROE_POLYGON && context->first == NUM_FILTER && num_rounding_trusted()) {
        const int sure = num_filtered_call(context, meets_triangle(ray, body, first));
        if (sure != NUM_UNSURE) return sure;
    }
    const double *p = geom_body_point(body, 0);
    if (ray->dim > 3 && (body->form == FROE_SEGMENT || body->form == FROE_HULL))
        return geom_high_ray(context, ray, body, first);
    switch (body->form) {
    case FROE_POINT:
        return meets_box(context, ray, p, p, first);
    case FROE_BOX:
        return meets_box(context, ray, p, geom_body_point(body, 1), first);
    case FROE_BALL:
        return meets_ball(context, ray, body, first);
    case FROE_SEGMENT:
        if (ray->dim == 3)
            return !passes(context, ray, p, geom_body_point(body, 1)) && geom_ray_meets_hull(context, ray, body, first);
        return meets_segment_2d(context, ray, p, geom_body_point(body, 1), first);
    case FROE_POLYGON:
        return meets_polygon(context, ray, body, first);
    default:
        return geom_ray_meets_hull(context, ray, body, first);
    }
}
