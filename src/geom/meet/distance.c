/* distance.c: see distance.h. */
#include "geom/meet/distance.h"
#include "geom/filter.h"
#include "geom/formulas.h"
#include "geom/high/high.h"
#include "geom/meet/feature.h"
#include "geom/meet/gap.h"
#include "num/pair.h"
#include "num/root.h"
#include <string.h>

#include "num/ball_terms.inc"

#include "geom/meet/distance_body.inc"

#include "num/dyadic_terms.inc"

#include "geom/meet/distance_body.inc"

/* Behind what the arena holds. */
static num_ratio exact_square(num_context *context, const double *point, const geom_distance *d) {
    num_ratio s;
    num_arena *arena = &context->arena;
    if (d->high.count) return geom_high_square(context, point, &d->high);
    s.top = distance_square_dyadic(arena, d, point, &s.bottom);
    return s;
}

/* Most triangles of space and segments of the plane, without a search. */
static bool find_feature(num_context *context, const double *point, const geom_body *body, geom_distance *d) {
    const bool flat = body->dim == 2 && body->count == 2;
    if (!flat && (body->dim != 3 || body->count != 3)) return false;
    if (context->first != NUM_FILTER || !num_rounding_trusted()) return false;
    const double *corner[3] = {geom_body_point(body, 0), geom_body_point(body, 1)};
    if (!flat) corner[2] = geom_body_point(body, 2);
    geom_feature f;
    const bool found = flat ? geom_feature_of_segment(point, corner, &f) : geom_feature_nearest(point, corner, &f);
    if (num_filtered_call(context, found ? 1 : NUM_UNSURE) == NUM_UNSURE) return false;
    d->count = f.count;
    d->square = f.square;
    memcpy(d->corner, f.corner, sizeof d->corner);
    return true;
}

bool geom_distance_shared(num_context *context, const double *point, const geom_body *body, const geom_distance *d) {
    if (d->lo || (d->count != 1 && d->count != 2)) return false;
    if (body->form != FROE_POLYGON || body->dim != 3 || body->count != 3) return false;
    if (context->first != NUM_FILTER) return false;
    const double *corner[3];
    for (uint32_t i = 0; i < 3; i++) corner[i] = geom_body_point(body, i);
    return num_filtered_call(context, geom_feature_shared(point, corner, d->corner, d->count) ? 1 : NUM_UNSURE) == 1;
}

geom_distance geom_distance_from(num_context *context, const double *point, const geom_body *body) {
    geom_distance d; /* not all of it matters, and zeroing it would take as long as the filter */
    d.lo = d.hi = d.corner[0] = NULL;
    d.dim = body->dim, d.count = 0, d.radius = body->form == FROE_BALL ? body->radius : 0;
    d.high.count = 0;
    if (body->form == FROE_POINT || body->form == FROE_BOX || body->form == FROE_BALL) {
        d.lo = geom_body_point(body, 0);
        d.hi = body->form == FROE_BOX ? geom_body_point(body, 1) : d.lo;
    } else if (body->dim > 3) {
        d.high = *body;
        context->stats.calls++;
        d.square = geom_high_square_image(context, point, body);
        return d;
    } else if (find_feature(context, point, body, &d)) {
        return d;
    } else {
        const geom_body at = geom_body_at(body->dim, point);
        const geom_gap gap = geom_gap_between(context, body, &at);
        d.count = gap.zero ? 0 : gap.count;
        for (int i = 0; i < d.count; i++) d.corner[i] = geom_body_point(body, gap.a[i]);
    }
    num_ball bottom, top = distance_square_ball(NULL, &d, point, &bottom);
    d.square = bottom.x == 1 && bottom.e == 0 ? top : filter_div(top, bottom);
    if (context->first == NUM_EXACT) d.square = (num_ball){0, INFINITY};
    return d;
}

num_ball geom_distance_image(const geom_distance *a) {
    num_ball d = num_ball_sqrt(a->square);
    return a->radius > 0 ? filter_sub(d, num_ball_from(a->radius)) : d;
}

/* -------------------------------------------------------- pairs of doubles -- */

/* A distance x without a radius, off by e at most. */
typedef struct pair_root {
    num_pair x;
    double e;
} pair_root;

/* sqrt(s) errs by 2^-94 of itself. */
static bool root_of_square(num_pair s, pair_root *out) {
    if (!(s.hi > 0x1p-400)) return false;
    out->x = num_pair_sqrt(s);
    out->e = 0x1p-94 * out->x.hi;
    return true;
}

/* The same for sqrt(top / bottom), which errs by `error`, too. */
static bool root_of_quotient(num_pair top, num_pair bottom, double error, pair_root *out) {
    if (!(top.hi > 0x1p-400 * bottom.hi)) return false;
    out->x = num_pair_root(top, bottom);
    out->e = error + 0x1p-94 * out->x.hi;
    return true;
}

/* From a point or a box. The sum of squares errs by less than 2^-96 of itself, and by underflows, which are nothing
 * beside 2^-400. */
static bool root_from_box(const double *point, const geom_distance *a, pair_root *out) {
    num_pair s = {0, 0};
    for (int k = 0; k < a->dim; k++) {
        const double x = point[k], nearest = x < a->lo[k] ? a->lo[k] : x > a->hi[k] ? a->hi[k] : x;
        const num_pair gap = num_pair_sum(nearest, -x);
        if (!(fabs(gap.hi) < 0x1p100)) return false;
        s = num_pair_add(s, num_pair_mul(gap, gap));
    }
    return root_of_square(s, out);
}

/* Are sizes such that pairs of doubles neither overflow nor underflow? */
static bool is_moderate(double size) {
    return size > 0x1p-100 && size < 0x1p100;
}

/* From a corner or the line of a segment of the plane: as root_from_simplex() below, without what is 0. */
static bool root_from_flat(const double *point, const geom_distance *a, pair_root *out) {
    const double *p = a->corner[0], *q = a->corner[1];
    const num_pair x = num_pair_sum(p[0], -point[0]), y = num_pair_sum(p[1], -point[1]);
    const double size = fabs(x.hi) + fabs(y.hi);
    if (!is_moderate(size)) return false;
    if (a->count == 1) return root_of_square(num_pair_add(num_pair_mul(x, x), num_pair_mul(y, y)), out);
    const num_pair ex = num_pair_sum(q[0], -p[0]), ey = num_pair_sum(q[1], -p[1]);
    if (!is_moderate(fabs(ex.hi) + fabs(ey.hi))) return false;
    const num_pair cross = num_pair_sub(num_pair_mul(ex, y), num_pair_mul(ey, x));
    const num_pair square = num_pair_add(num_pair_mul(ex, ex), num_pair_mul(ey, ey));
    return root_of_quotient(num_pair_mul(cross, cross), square, 0x1p-94 * size, out);
}

/* From a line along an axis only the other axes count: v is without this one then. Many models have such edges. */
static bool drop_axis(const num_pair e[3], num_pair v[3]) {
    int moved = 0, axis = 0;
    for (int k = 0; k < 3; k++) {
        axis = e[k].hi == 0 ? axis : k;
        moved += e[k].hi != 0;
    }
    if (moved == 1) v[axis] = (num_pair){0, 0};
    return moved == 1;
}

/* From a simplex: sqrt(S) errs by 2^-94 of itself and by what the numerator of S errs. With sizes as sums of
 * coordinates, |e|^2 at least a third of that: v x e by less than 2^-96 |v| |e|, and n v by less than 2^-95 |e| |f|
 * |v|, as n by 2^-96 |e| |f|. */
static bool root_from_simplex(const double *point, const geom_distance *a, pair_root *out) {
    num_pair v[3], e[3], f[3], n[3];
    double sizes[3] = {num_pair_between(point, a->corner[0], v), 1, 1};
    if (a->count > 1) sizes[1] = num_pair_between(a->corner[0], a->corner[1], e);
    if (a->count > 2) sizes[2] = num_pair_between(a->corner[0], a->corner[2], f);
    for (int i = 0; i < 3; i++)
        if (!is_moderate(sizes[i])) return false;
    if (a->count == 1) return root_of_square(num_pair_dot(v, v), out);
    if (a->count == 2 && drop_axis(e, v)) return root_of_square(num_pair_dot(v, v), out);
    if (a->count == 2) {
        num_pair_cross(v, e, n);
        return root_of_quotient(num_pair_dot(n, n), num_pair_dot(e, e), 0x1p-94 * sizes[0], out);
    }
    num_pair_cross(e, f, n);
    const num_pair height = num_pair_dot(n, v), bottom = num_pair_dot(n, n);
    if (!(bottom.hi > 0x1p-600) || !root_of_quotient(num_pair_mul(height, height), bottom, 0, out)) return false;
    out->e += 0x1p-93 * sizes[1] * sizes[2] * (sizes[0] + out->x.hi) / sqrt(bottom.hi);
    return true;
}

static bool root_by_pairs(const double *point, const geom_distance *a, pair_root *out) {
    if (a->radius > 0) return false;
    if (a->lo) return root_from_box(point, a, out);
    if (!a->count) return false; /* the point is in it, or it is a polytope above dimension 3 */
    return a->dim == 2 ? root_from_flat(point, a, out) : root_from_simplex(point, a, out);
}

/* ------------------------------------------------------------- comparisons -- */

/* S - r^2 */
static int beyond_radius(num_arena *arena, num_ratio s, double radius) {
    num_dyadic r = num_dyadic_from(arena, radius);
    return num_dyadic_compare(s.top, num_dyadic_mul(arena, num_dyadic_mul(arena, r, r), s.bottom));
}

/* sqrt(S) - r - x, x >= 0 */
static int beyond_both(num_arena *arena, num_ratio s, double radius, num_dyadic x) {
    num_dyadic sum = num_dyadic_add(arena, num_dyadic_from(arena, radius), x);
    return num_dyadic_compare(s.top, num_dyadic_mul(arena, num_dyadic_mul(arena, sum, sum), s.bottom));
}

/* Are both distances from simplices of as many corners? Only what has a lo has a radius. */
static bool same_kind(const geom_distance *a, const geom_distance *b) {
    return !a->lo && !b->lo && a->count == b->count && !a->high.count;
}

/* Do both come from the same corners? Objects of one scene share them. */
static bool same_source(const geom_distance *a, const geom_distance *b) {
    if (!same_kind(a, b)) return false;
    int shared = 0;
    for (int i = 0; i < a->count; i++)
        for (int j = 0; j < b->count; j++) shared += a->corner[i] == b->corner[j];
    return shared == a->count;
}

/* Along how many axes all corners of both have one coordinate; *last is the last of them. */
static int axes_shared(const geom_distance *a, const geom_distance *b, int *last) {
    int shared = 0;
    for (int k = 0; k < a->dim; k++) {
        const double x = a->corner[0][k];
        bool same = true;
        for (int i = 0; i < a->count; i++) same = same && a->corner[i][k] == x && b->corner[i][k] == x;
        if (same) shared++, *last = k;
    }
    return shared;
}

/* Do these coordinates say that both, which do not have the point inside, have one affine hull? Of walls, floors and
 * their edges along the axes many are equally near. */
static bool same_hull(const geom_distance *a, const geom_distance *b) {
    int axis;
    return same_kind(a, b) && axes_shared(a, b, &axis) == a->dim + 1 - a->count;
}

static int compare_images(const geom_distance *a, const geom_distance *b) {
    if (a->radius == 0 && b->radius == 0) return filter_sign(filter_sub(a->square, b->square));
    const num_ball x = geom_distance_image(a), y = geom_distance_image(b);
    const int sure = filter_sign(filter_sub(x, y)); /* images below 0 mean 0 */
    return sure != NUM_UNSURE && filter_sign(sure > 0 ? x : y) == 1 ? sure : NUM_UNSURE;
}

/* Edges of a turned model often lie on one line but for the last digits of their corners. */
static int compare_by_pairs(const double *point, const geom_distance *a, const geom_distance *b) {
    pair_root x, y;
    if (!root_by_pairs(point, a, &x) || !root_by_pairs(point, b, &y)) return NUM_UNSURE;
    const double gap = num_pair_sub(x.x, y.x).hi;
    const double error = 2 * (x.e + y.e); /* with what the difference errs, which is less */
    return gap > error ? 1 : gap < -error ? -1 : NUM_UNSURE;
}

static int compare_distances_exactly(num_context *context, const double *point, const geom_distance *a,
                                     const geom_distance *b) {
    num_arena *arena = num_fresh(context);
    num_ratio s = exact_square(context, point, a), t = exact_square(context, point, b);
    bool out_a = beyond_radius(arena, s, a->radius) > 0, out_b = beyond_radius(arena, t, b->radius) > 0;
    if (!out_a || !out_b) return out_a - out_b;
    num_dyadic e = num_dyadic_sub(arena, num_dyadic_from(arena, a->radius), num_dyadic_from(arena, b->radius));
    return num_roots_compare(arena, s, t, e);
}

int geom_distance_compare(num_context *context, const double *point, const geom_distance *a, const geom_distance *b) {
    int sign;
    context->stats.calls++;
    if (same_source(a, b)) return num_by_id(context, 0);
    return NUM_LADDER(context, sign, compare_images(a, b), same_hull(a, b) ? num_by_id(context, 0) : NUM_UNSURE,
                      compare_by_pairs(point, a, b), compare_distances_exactly(context, point, a, b));
}

/* Sure of no zero distance: there the bound decides. */
static int distance_image_beyond(const geom_distance *a, double bound) {
    const int sure = filter_sign(filter_sub(geom_distance_image(a), num_ball_from(bound)));
    return sure == -1 && bound == 0 ? NUM_UNSURE : sure;
}

static int distance_beyond_exactly(num_context *context, const double *point, const geom_distance *a, double bound) {
    num_arena *arena = num_fresh(context);
    num_ratio s = exact_square(context, point, a);
    const int sign = beyond_both(arena, s, a->radius, num_dyadic_from(arena, bound));
    return sign < 0 && bound == 0 ? 0 : sign;
}

int geom_distance_compare_to(num_context *context, const double *point, const geom_distance *a, double bound) {
    int sign;
    if (isinf(bound)) return -1;
    context->stats.calls++;
    return NUM_LADDER(context, sign, distance_image_beyond(a, bound), NUM_UNSURE, NUM_UNSURE,
                      distance_beyond_exactly(context, point, a, bound));
}

/* ---------------------------------------------------------------- rounding -- */

typedef struct rounding {
    num_ratio square;
    double radius;
} rounding;

static int against(void *user, num_arena *arena, num_dyadic x) {
    const rounding *r = user;
    return beyond_both(arena, r->square, r->radius, x);
}

/* The distance from a plane x[axis] = c: one difference, rounded once. Of numbers with few digits, such as those of
 * models in single precision, it is often halfway between two doubles, where pairs of doubles cannot tell. */
static bool round_wall(const double *point, const geom_distance *a, double *out) {
    int axis;
    if (a->count != 3 || axes_shared(a, a, &axis) != 1) return false;
    *out = fabs(a->corner[0][axis] - point[axis]);
    return *out < 0x1p1000;
}

/* If pairs of doubles can tell how it is to be rounded. */
static bool round_root(const double *point, const geom_distance *a, double *out) {
    pair_root root;
    if (!root_by_pairs(point, a, &root)) return false;
    *out = root.x.hi + (root.x.lo - root.e);
    return *out == root.x.hi + (root.x.lo + root.e);
}

double geom_distance_round(num_context *context, const double *point, const geom_distance *a) {
    num_arena *arena = num_fresh(context);
    double rounded;
    bool done = false; /* where pairs do not tell, exact numbers do */
    if (context->first != NUM_EXACT)
        done = (!a->lo && round_wall(point, a, &rounded)) || round_root(point, a, &rounded);
    if (done) return rounded;
    rounding r = {exact_square(context, point, a), a->radius};
    if (beyond_radius(arena, r.square, a->radius) <= 0) return 0;
    return num_nearest(arena, against, &r, geom_distance_image(a).x);
}
