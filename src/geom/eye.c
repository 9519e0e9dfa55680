/* eye.c: sides of eyes, and sides of points and meetings in a picture: filter, balls, dyadic numbers. */
#include "geom/eye.h"
#include "geom/formulas.h"
#include "geom/predicates.h"
#include "num/pair.h"
#include <string.h>

#include "num/ball_terms.inc"

#include "geom/eye_body.inc"

#include "num/dyadic_terms.inc"

#include "geom/eye_body.inc"

geom_eye geom_eye_make(bool parallel, const double *at, const double *origin) {
    geom_eye eye = {.parallel = parallel, .size = 1};
    memcpy(eye.at, at, sizeof eye.at);
    if (origin) memcpy(eye.origin, origin, sizeof eye.origin);
    for (int k = 1; k < 3; k++)
        if (fabs(at[k]) > fabs(at[eye.axis])) eye.axis = k;
    return eye;
}

void geom_eye_set_extent(geom_eye *eye, double extent) {
    int exponent;
    if (!(extent > 0)) return;
    frexp(fmin(extent, 0x1p1000), &exponent);
    eye->size = ldexp(1, exponent < -1000 ? -1000 : exponent > 1000 ? 1000 : exponent);
}

/* ------------------------------------------------------------ side of an eye -- */

int geom_side_of_eye(num_context *context, const geom_plane *plane, const geom_eye *eye) {
    static const double zero[3] = {0, 0, 0};
    int sign;
    if (!eye->parallel) return geom_side_vertex(context, plane, eye->at);
    context->stats.calls++;
    if (geom_is_sheared(plane)) { /* n = (1, eps, 0) */
        double d = eye->at[0] != 0 ? eye->at[0] : eye->at[1];
        return num_by_id(context, (d > 0) - (d < 0));
    }
    return NUM_DECIDE(context, sign, filter_sign(filter_slope(plane, zero, eye->at)), NUM_UNSURE, side_of_eye, plane,
                      eye);
}

/* Shewchuk's static bound for orient3d ("Adaptive precision floating-point arithmetic", 1997, table 4), plus what
 * underflows may cost; overflows make it infinite or NaN, and then nothing is sure. */
int geom_side_of_eye_filter(const double *p, const double *q, const double *r, const geom_eye *eye) {
    const double *e = eye->at;
    const double a0 = q[0] - p[0], a1 = q[1] - p[1], a2 = q[2] - p[2];
    const double b0 = r[0] - p[0], b1 = r[1] - p[1], b2 = r[2] - p[2];
    const double w0 = eye->parallel ? e[0] : e[0] - p[0], w1 = eye->parallel ? e[1] : e[1] - p[1],
                 w2 = eye->parallel ? e[2] : e[2] - p[2];
    const double p01 = a0 * b1, p10 = a1 * b0, p12 = a1 * b2, p21 = a2 * b1, p20 = a2 * b0, p02 = a0 * b2;
    const double value = w0 * (p12 - p21) + w1 * (p20 - p02) + w2 * (p01 - p10);
    const double size =
        fabs(w0) * (fabs(p12) + fabs(p21)) + fabs(w1) * (fabs(p20) + fabs(p02)) + fabs(w2) * (fabs(p01) + fabs(p10));
    const double bound = 8 * FILTER_U * size + NUM_BALL_TINY * (1 + fabs(w0) + fabs(w1) + fabs(w2));
    return filter_sign((num_ball){value, bound});
}

/* ------------------------------------------------------------------ images -- */

static filter_vector gather_vector(const num_ball x[3]) {
    filter_vector out = {.most = 0};
    for (int k = 0; k < 3; k++) {
        out.x[k] = x[k].x;
        out.most = filter_greater(out.most, fabs(x[k].x));
        out.e = filter_greater(out.e, x[k].e);
        if (!(x[k].e <= 0x1p1000)) out.e = INFINITY; /* NaN too */
    }
    return out;
}

filter_vector geom_ray_image(const geom_eye *eye, const double *x) {
    num_ball r[3];
    eye_ray_ball(NULL, eye, x, r);
    return gather_vector(r);
}

filter_vector geom_line_image(const geom_eye *eye, const geom_line *line) {
    num_ball n[3];
    line_of_sight_ball(NULL, eye, line, n);
    return gather_vector(n);
}

/* ------------------------------------------------------------------- sides -- */

static num_ball filter_at_eye(const geom_plane *plane, const geom_eye *eye) {
    static const double zero[3] = {0, 0, 0};
    return eye->parallel ? filter_slope(plane, zero, eye->at) : filter_value(plane, eye->at);
}

/* The filter of cut_at_point; edges have theirs in the image of the line. */
static int point_filter(const geom_eye *eye, const geom_line *h, const double *x) {
    if (h->kind != GEOM_SIGHT_CUT) return NUM_UNSURE;
    const num_ball left = filter_mul(filter_at_eye(h->a, eye), filter_value(h->s, x));
    const num_ball right = filter_mul(filter_at_eye(h->s, eye), filter_value(h->a, x));
    return filter_sign(filter_sub(left, right));
}

/* Is x one of the points that make the line? */
static bool line_holds(const geom_line *h, const double *x) {
    bool is_u = h->kind == GEOM_SIGHT_EDGE, is_v = is_u;
    for (int k = 0; k < 3 && (is_u || is_v); k++) is_u &= h->u[k] == x[k], is_v &= h->v[k] == x[k];
    return is_u || is_v;
}

int geom_line_side_point(num_context *context, const geom_eye *eye, const geom_line *h, const double *x) {
    int sign;
    context->stats.calls++;
    return NUM_DECIDE(context, sign, point_filter(eye, h, x), line_holds(h, x) ? num_by_id(context, 0) : NUM_UNSURE,
                      side_of_seen_point, eye, h, x);
}

int geom_line_side_meeting(num_context *context, const geom_eye *eye, const geom_line *h, const geom_line *a,
                           const geom_line *b) {
    int sign;
    context->stats.calls++;
    return NUM_DECIDE(context, sign, NUM_UNSURE, NUM_UNSURE, side_of_meeting, eye, h, a, b);
}

int geom_line_order(num_context *context, const geom_eye *eye, const geom_line *h, const double *x, const double *y) {
    int sign;
    context->stats.calls++;
    return NUM_DECIDE(context, sign, NUM_UNSURE, NUM_UNSURE, order_on_line, eye, h, x, y);
}

/* a_i / a_k against b_i / b_k, for i before and after k. */
int geom_line_compare(num_context *context, const geom_eye *eye, const geom_line *a, const geom_line *b, int k) {
    num_arena *arena = num_fresh(context);
    num_dyadic n_a[3], n_b[3];
    int sign = 0;
    line_of_sight_dyadic(arena, eye, a, n_a);
    line_of_sight_dyadic(arena, eye, b, n_b);
    for (int i = 0; i < 3 && !sign; i++)
        sign = num_dyadic_sub(arena, num_dyadic_mul(arena, n_a[i], n_b[k]), num_dyadic_mul(arena, n_b[i], n_a[k])).sign;
    context->stats.calls++;
    return num_exact(context, sign * n_a[k].sign * n_b[k].sign);
}

/* ------------------------------------------------------------------- output -- */

/* x / max |x|, rounded; false: x is zero. */
static bool round_vector(num_arena *arena, const num_dyadic x[3], double out[3]) {
    num_dyadic most = {0};
    for (int k = 0; k < 3; k++) {
        num_dyadic size = x[k];
        size.sign *= size.sign;
        if (num_dyadic_compare(size, most) > 0) most = size;
    }
    for (int k = 0; k < 3; k++) out[k] = most.sign ? num_dyadic_quotient(arena, x[k], most) : 0;
    return most.sign != 0;
}

bool geom_line_round(num_context *context, const geom_eye *eye, const geom_line *line, double out[3]) {
    num_dyadic n[3];
    num_arena *arena = num_fresh(context);
    line_of_sight_dyadic(arena, eye, line, n);
    return round_vector(arena, n, out);
}

void geom_meeting_round(num_context *context, const geom_eye *eye, const geom_line *a, const geom_line *b,
                        double out[3]) {
    num_arena *arena = num_fresh(context);
    num_dyadic n_a[3], n_b[3], ray[3];
    line_of_sight_dyadic(arena, eye, a, n_a);
    line_of_sight_dyadic(arena, eye, b, n_b);
    vector_cross_dyadic(arena, n_a, n_b, ray);
    (void)round_vector(arena, ray, out);
}

/* The share where an EDGE through p and q, seen from a point, meets uv, if pairs of doubles can tell how it is to be
 * rounded. With sizes as sums of coordinates, a product of three vectors is off by less than 2^-96 of theirs. The share
 * is from 0 to 1, and `low` is at most the product of the sizes, so the error is at least 2^-95, and shares of which it
 * leaves no digit open are above 2^-43. */
static bool round_share(const geom_eye *eye, const geom_line *line, const double *u, const double *v, double *out) {
    num_pair ray[4][3], n[3];
    const double *const points[4] = {line->u, line->v, u, v};
    double size[4];
    if (eye->parallel || line->kind != GEOM_SIGHT_EDGE) return false;
    for (int i = 0; i < 4; i++) {
        size[i] = num_pair_between(points[i], eye->at, ray[i]);
        if (!(size[i] > 0x1p-100 && size[i] < 0x1p200)) return false;
    }
    num_pair_cross(ray[0], ray[1], n);
    const num_pair top = num_pair_dot(n, ray[2]), bottom = num_pair_sub(top, num_pair_dot(n, ray[3])),
                   t = num_pair_div(top, bottom);
    const double low = fabs(bottom.hi);
    const double error = 0x1p-94 * size[0] * size[1] * (size[2] + size[3]) / low + 0x1p-96 * t.hi;
    *out = t.hi + (t.lo - error);
    return *out == t.hi + (t.lo + error);
}

double geom_share_round(num_context *context, const geom_eye *eye, const geom_line *line, const double *u,
                        const double *v) {
    double rounded;
    if (context->first < NUM_EXACT && round_share(eye, line, u, v, &rounded)) return rounded;
    num_arena *arena = num_fresh(context);
    num_dyadic at_u = line_at_point_dyadic(arena, eye, line, u), at_v = line_at_point_dyadic(arena, eye, line, v);
    return num_dyadic_quotient(arena, at_u, num_dyadic_sub(arena, at_u, at_v));
}
