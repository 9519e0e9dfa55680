/* predicates.c: sides of vertices, crossings, corners and balls: filter, then
 * coincidences that need no arithmetic, then balls, then dyadic numbers.
 *
 * Coincidences come second because they can only prove a zero (or lead to a simpler
 * point), and there the filter is never sure: so they cost nothing where it is. On
 * meshes they prove almost every zero: neighbours share corners. */
#include "geom/predicates.h"
#include "geom/filter.h"
#include "geom/formulas.h"

static int sign_of(double a, double b) {
    return (a > b) - (a < b);
}

/* Sign of value / divisor, where the divisor is known not to be 0. */
static int ratio_sign(int value, int divisor) {
    if (value == 0) return 0;
    bool sure = value != NUM_UNSURE && (divisor == 1 || divisor == -1);
    return sure ? value * divisor : NUM_UNSURE;
}

static int by_id(num_context *context, int sign) {
    context->stats.by_id++;
    return sign;
}

static int filtered(num_context *context, int sign) {
    context->stats.filtered++;
    return sign;
}

static int refined(num_context *context, int sign) {
    context->stats.refined++;
    return sign;
}

static int exact(num_context *context, int sign) {
    context->stats.exact++;
    context->stats.exact_zero += sign == 0;
    return sign;
}

static num_arena *fresh(num_context *context) {
    context->arena.top = 0;
    return &context->arena;
}

/* ------------------------------------------------------------ coincidences -- */

static int point_count(const geom_plane *plane) {
    return plane->form == GEOM_POINTS ? plane->dim : plane->form == GEOM_VERTICAL ? 2 : 0;
}

/* Is x on h by definition? (False does not mean that it is not.) */
static bool holds(const geom_plane *h, const double *x) {
    if (h->form == GEOM_AXIS) return x[h->axis] == h->c;
    for (int i = 0; i < point_count(h); i++) {
        const double *p = h->p[i];
        if (p[0] == x[0] && p[1] == x[1] && (h->dim == 2 || h->form == GEOM_VERTICAL || p[2] == x[2])) return true;
    }
    return false;
}

/* How many of the defining points of a lie on b and c by definition? */
static int shared(const geom_plane *a, const geom_plane *b, const geom_plane *c) {
    int count = 0;
    for (int i = 0; i < point_count(a); i++) count += holds(b, a->p[i]) && holds(c, a->p[i]);
    return count;
}

/* Are g and h the same plane by definition? */
static bool same_plane(const geom_plane *g, const geom_plane *h) {
    if (g == h) return true;
    if (g->form == GEOM_AXIS) return h->form == GEOM_AXIS && g->axis == h->axis && g->c == h->c;
    if (g->form == GEOM_POINTS) return shared(g, h, h) == g->dim;
    if (g->form == GEOM_VERTICAL) return h->form == GEOM_VERTICAL && shared(g, h, h) == 2;
    return h->form == GEOM_VECTOR && g->c == h->c && g->p[0][0] == h->p[0][0] && g->p[0][1] == h->p[0][1] &&
           g->p[0][2] == h->p[0][2];
}

/* Does h contain the line where a and b meet, by definition? */
static bool holds_line(const geom_plane *h, const geom_plane *a, const geom_plane *b) {
    return same_plane(h, a) || same_plane(h, b) || shared(a, b, h) >= 2 || shared(b, a, h) >= 2;
}

/* ------------------------------------------------------------------ vertex -- */

/* All stages, not counted as a call. */
static int vertex_side(num_context *context, const geom_plane *h, const double *x) {
    if (context->first == NUM_FILTER) {
        if (h->form == GEOM_AXIS) return by_id(context, sign_of(x[h->axis], h->c));
        int sure = filter_sign(filter_value(h, x));
        if (sure != NUM_UNSURE) return filtered(context, sure);
        if (holds(h, x)) return by_id(context, 0);
    }
    if (context->first <= NUM_BALL) {
        int sure = num_ball_sign(ball_vertex(NULL, h, x));
        if (sure != NUM_UNSURE) return refined(context, sure);
    }
    return exact(context, dyadic_vertex(fresh(context), h, x).sign);
}

int geom_side_vertex(num_context *context, const geom_plane *plane, const double *x) {
    context->stats.calls++;
    return vertex_side(context, plane, x);
}

/* ---------------------------------------------------------------- crossing -- */

static int crossing_filter(const geom_plane *h, const double *u, const double *v, const geom_plane *a) {
    num_ball divisor = filter_slope(a, u, v);
    num_ball at_u = filter_mul(filter_value(h, u), divisor);
    num_ball along = filter_mul(filter_slope(h, u, v), filter_value(a, u));
    return ratio_sign(filter_sign(filter_sub(at_u, along)), filter_sign(divisor));
}

/* What is known of the crossing by definition: its side in *side, or a vertex that it is. */
static const double *crossing_known(const geom_plane *h, const double *u, const double *v, const geom_plane *a,
                                    int *side) {
    *side = same_plane(h, a) || (holds(h, u) && holds(h, v)) ? 0 : NUM_UNSURE;
    return holds(a, u) ? u : holds(a, v) ? v : NULL;
}

int geom_side_crossing(num_context *context, const geom_plane *plane, const double *u, const double *v,
                       const geom_plane *a) {
    context->stats.calls++;
    if (context->first == NUM_FILTER) {
        if (plane->form == GEOM_AXIS && a->form == GEOM_AXIS && plane->axis == a->axis)
            return by_id(context, sign_of(a->c, plane->c));
        int sure = crossing_filter(plane, u, v, a);
        if (sure != NUM_UNSURE) return filtered(context, sure);
        const double *vertex = crossing_known(plane, u, v, a, &sure);
        if (sure != NUM_UNSURE) return by_id(context, sure);
        if (vertex) return vertex_side(context, plane, vertex);
    }
    if (context->first <= NUM_BALL) {
        num_ball divisor, value = ball_crossing(NULL, plane, u, v, a, &divisor);
        int sure = ratio_sign(num_ball_sign(value), num_ball_sign(divisor));
        if (sure != NUM_UNSURE) return refined(context, sure);
    }
    num_dyadic divisor, value = dyadic_crossing(fresh(context), plane, u, v, a, &divisor);
    return exact(context, value.sign * divisor.sign);
}

/* ------------------------------------------------------------------ corner -- */

static int corner_filter(const geom_plane *h, const geom_plane *const planes[3], const double z[3]) {
    const geom_plane *s = planes[0], *a = planes[1], *b = planes[2];
    filter_vector n_h = filter_normal(h), n_s = filter_normal(s), n_a = filter_normal(a), n_b = filter_normal(b);
    filter_vector ab = filter_cross(&n_a, &n_b), hb = filter_cross(&n_h, &n_b), ah = filter_cross(&n_a, &n_h);
    num_ball divisor = filter_dot(&n_s, &ab);
    num_ball sum = filter_mul(filter_value(h, z), divisor);
    sum = filter_sub(sum, filter_mul(filter_value(a, z), filter_dot(&n_s, &hb)));
    sum = filter_sub(sum, filter_mul(filter_value(b, z), filter_dot(&n_s, &ah)));
    if (s->form == GEOM_VECTOR) sum = filter_sub(sum, filter_mul(filter_value(s, z), filter_dot(&n_h, &ab)));
    return ratio_sign(filter_sign(sum), filter_sign(divisor));
}

/* As crossing_known. */
static const double *corner_known(const geom_plane *h, const geom_plane *const planes[3], int *side) {
    const geom_plane *s = planes[0], *a = planes[1], *b = planes[2];
    *side = holds_line(h, s, a) || holds_line(h, s, b) || holds_line(h, a, b) ? 0 : NUM_UNSURE;
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < point_count(planes[j]); i++) {
            const double *x = planes[j]->p[i];
            if (holds(s, x) && holds(a, x) && holds(b, x)) return x;
        }
    return NULL;
}

int geom_side_corner(num_context *context, const geom_plane *plane, const geom_plane *s, const geom_plane *a,
                     const geom_plane *b) {
    const geom_plane *planes[3] = {s, a, b};
    double z[3];
    geom_corner_origin(planes, plane, z);
    context->stats.calls++;
    if (context->first == NUM_FILTER) {
        int sure = corner_filter(plane, planes, z);
        if (sure != NUM_UNSURE) return filtered(context, sure);
        const double *vertex = corner_known(plane, planes, &sure);
        if (sure != NUM_UNSURE) return by_id(context, sure);
        if (vertex) return vertex_side(context, plane, vertex);
    }
    if (context->first <= NUM_BALL) {
        num_ball divisor, value = ball_corner(NULL, plane, planes[0], planes[1], planes[2], z, &divisor);
        int sure = ratio_sign(num_ball_sign(value), num_ball_sign(divisor));
        if (sure != NUM_UNSURE) return refined(context, sure);
    }
    num_dyadic divisor, value = dyadic_corner(fresh(context), plane, planes[0], planes[1], planes[2], z, &divisor);
    return exact(context, value.sign * divisor.sign);
}

/* -------------------------------------------------------------------- ball -- */

/* The side from the signs of f(centre) and f(centre)^2 - r^2 |n|^2. *sure: are they? */
static int ball_side(int centre, int reach, bool *sure) {
    *sure = reach == -1 || (centre != NUM_UNSURE && reach != NUM_UNSURE);
    return reach == -1 ? 2 : centre;
}

/* Against x[axis] = c. Rounding is monotone: fl(x - c) < r or > r tells the same of x - c. */
static int ball_axis_filter(const geom_plane *h, const double *centre, double radius, bool *sure) {
    double distance = fabs(centre[h->axis] - h->c);
    *sure = distance != radius;
    return distance > radius ? sign_of(centre[h->axis], h->c) : 2;
}

static int ball_filter(const geom_plane *h, const double *centre, double radius, bool *sure) {
    if (h->form == GEOM_AXIS) return ball_axis_filter(h, centre, radius, sure);
    filter_vector n = filter_normal(h);
    num_ball at = filter_value(h, centre), r = num_ball_from(radius);
    num_ball reach = filter_sub(filter_mul(at, at), filter_mul(filter_mul(r, r), filter_dot(&n, &n)));
    return ball_side(filter_sign(at), filter_sign(reach), sure);
}

int geom_side_ball(num_context *context, const geom_plane *plane, const double *centre, double radius) {
    context->stats.calls++;
    bool sure = false;
    if (context->first == NUM_FILTER) {
        if (radius == 0) return vertex_side(context, plane, centre);
        int side = ball_filter(plane, centre, radius, &sure);
        if (sure) return filtered(context, side);
    }
    if (context->first <= NUM_BALL) {
        num_ball at, reach = ball_ball(NULL, plane, centre, radius, &at);
        int side = ball_side(num_ball_sign(at), num_ball_sign(reach), &sure);
        if (sure) return refined(context, side);
    }
    num_dyadic at, reach = dyadic_ball(fresh(context), plane, centre, radius, &at);
    return exact(context, ball_side(at.sign, reach.sign, &sure));
}
