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

/* ------------------------------------------------------------ coincidences -- */

static int plane_point_count(const geom_plane *plane) {
    return plane->form == GEOM_POINTS ? plane->dim : plane->form == GEOM_VERTICAL ? 2 : 0;
}

/* Is x on h by definition? (False does not mean that it is not.) */
static bool plane_holds(const geom_plane *h, const double *x) {
    if (h->form == GEOM_AXIS) return x[h->axis] == h->c;
    if (h->form == GEOM_AT_VERTEX) return x[0] == h->p[0][0] && x[1] == h->p[0][1];
    for (int i = 0; i < plane_point_count(h); i++) {
        const double *p = h->p[i];
        if (p[0] == x[0] && p[1] == x[1] && (h->dim == 2 || h->form == GEOM_VERTICAL || p[2] == x[2])) return true;
    }
    return false;
}

/* How many of the defining points of a lie on b and c by definition? */
static int shared(const geom_plane *a, const geom_plane *b, const geom_plane *c) {
    int count = 0;
    for (int i = 0; i < plane_point_count(a); i++) count += plane_holds(b, a->p[i]) && plane_holds(c, a->p[i]);
    return count;
}

/* Are g and h walls through the crossing of the same two segments, named in the same order? */
static bool same_crossing(const geom_plane *g, const geom_plane *h) {
    bool same = true;
    for (int i = 0; i < 4; i++) same = same && g->p[i][0] == h->p[i][0] && g->p[i][1] == h->p[i][1];
    return same;
}

/* Are g and h the same plane by definition? */
static bool same_plane(const geom_plane *g, const geom_plane *h) {
    if (g == h) return true;
    if (g->form == GEOM_AXIS) return h->form == GEOM_AXIS && g->axis == h->axis && g->c == h->c;
    if (g->form == GEOM_POINTS) return shared(g, h, h) == g->dim;
    if (g->form == GEOM_AT_VERTEX) return h->form == GEOM_AT_VERTEX && plane_holds(h, g->p[0]);
    if (g->form == GEOM_AT_CROSSING) return h->form == GEOM_AT_CROSSING && same_crossing(g, h);
    if (g->form == GEOM_VERTICAL) return h->form == GEOM_VERTICAL && shared(g, h, h) == 2;
    return h->form == GEOM_VECTOR && g->c == h->c && g->p[0][0] == h->p[0][0] && g->p[0][1] == h->p[0][1] &&
           g->p[0][2] == h->p[0][2];
}

/* Does h contain the line where a and b meet, by definition? */
static bool holds_line(const geom_plane *h, const geom_plane *a, const geom_plane *b) {
    return same_plane(h, a) || same_plane(h, b) || shared(a, b, h) >= 2 || shared(b, a, h) >= 2;
}

/* ------------------------------------------------------------------ shear -- */

/* The order by x, then y. */
static int lexicographic(const double *p, const double *q) {
    return p[0] != q[0] ? sign_of(p[0], q[0]) : sign_of(p[1], q[1]);
}

/* Balls compute without the shear, so their zeros decide nothing about sheared planes. */
static int unless_zero(int sign, bool sheared) {
    return sheared && sign == 0 ? NUM_UNSURE : sign;
}

/* The vertical plane over line i (0, 1) of an AT_CROSSING; in the plane that line itself. */
static geom_plane crossing_line(const geom_plane *h, int i) {
    const double *points[2] = {h->p[2 * i], h->p[2 * i + 1]};
    return h->dim == 2 ? geom_plane_points(2, points) : geom_plane_vertical(points[0], points[1]);
}

/* Is x (as seen from above) an end of line i of an AT_CROSSING? */
static bool is_end(const geom_plane *h, int i, const double *x) {
    const double *p = h->p[2 * i], *q = h->p[2 * i + 1];
    return (p[0] == x[0] && p[1] == x[1]) || (q[0] == x[0] && q[1] == x[1]);
}

/* The side of a point of line i of an AT_CROSSING, given its side of the other line: the first line runs from the left
 * of the second to its right, the second from the right of the first to its left. */
static int along_line(const geom_plane *h, int i, int beside) {
    return beside * lexicographic(h->p[2 * i + 1], h->p[2 * i]) * (i ? 1 : -1);
}

/* ------------------------------------------------------------------ vertex -- */

/* All stages, not counted as a call; h is not sheared. */
static int plain_vertex(num_context *context, const geom_plane *h, const double *x) {
    if (context->first == NUM_FILTER) {
        if (h->form == GEOM_AXIS) return num_by_id(context, sign_of(x[h->axis], h->c));
        int sure = filter_sign(filter_value(h, x));
        if (sure != NUM_UNSURE) return num_filtered(context, sure);
        if (plane_holds(h, x)) return num_by_id(context, 0);
    }
    if (context->first <= NUM_BALL) {
        int sure = num_ball_sign(value_at_vertex_ball(NULL, h, x));
        if (sure != NUM_UNSURE) return num_refined(context, sure);
    }
    return num_exact(context, value_at_vertex_dyadic(num_fresh(context), h, x).sign);
}

/* The same for walls. */
static int wall_vertex(num_context *context, const geom_plane *h, const double *x) {
    if (context->first == NUM_FILTER) {
        if (h->form == GEOM_AT_VERTEX) return num_by_id(context, lexicographic(x, h->p[0]));
        int sure = filter_sign(filter_value(h, x));
        if (sure != NUM_UNSURE) return num_filtered(context, sure);
        for (int i = 0; i < 2; i++) {
            geom_plane other = crossing_line(h, 1 - i);
            if (is_end(h, i, x)) return along_line(h, i, plain_vertex(context, &other, x));
        }
    }
    if (context->first <= NUM_BALL) {
        int sure = unless_zero(num_ball_sign(value_at_vertex_ball(NULL, h, x)), true);
        if (sure != NUM_UNSURE) return num_refined(context, sure);
    }
    int plain = value_at_vertex_dyadic(num_fresh(context), h, x).sign;
    return num_exact(context, plain ? plain : num_sheared_sign(value_at_vertex_sheared(num_fresh(context), h, x)));
}

static int vertex_side(num_context *context, const geom_plane *h, const double *x) {
    return geom_is_sheared(h) ? wall_vertex(context, h, x) : plain_vertex(context, h, x);
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

static int crossing_ball(const geom_plane *h, const double *u, const double *v, const geom_plane *a) {
    num_ball divisor, value = value_at_crossing_ball(NULL, h, u, v, a, &divisor);
    return ratio_sign(num_ball_sign(value), num_ball_sign(divisor));
}

/* Exactly. Infinitesimals only where it depends on them. */
static int crossing_sheared(num_context *context, const geom_plane *h, const double *u, const double *v,
                            const geom_plane *a) {
    num_dyadic plain_divisor, plain = value_at_crossing_dyadic(num_fresh(context), h, u, v, a, &plain_divisor);
    if (plain.sign && plain_divisor.sign) return num_exact(context, plain.sign * plain_divisor.sign);
    num_sheared divisor, value = value_at_crossing_sheared(num_fresh(context), h, u, v, a, &divisor);
    return num_exact(context, num_sheared_sign(value) * num_sheared_sign(divisor));
}

/* What is known of the crossing by definition: its side in *side, or a vertex that it is. */
static const double *crossing_known(const geom_plane *h, const double *u, const double *v, const geom_plane *a,
                                    int *side) {
    *side = same_plane(h, a) || (plane_holds(h, u) && plane_holds(h, v)) ? 0 : NUM_UNSURE;
    return plane_holds(a, u) ? u : plane_holds(a, v) ? v : NULL;
}

/* Neither h nor a is sheared. */
static int plain_crossing(num_context *context, const geom_plane *h, const double *u, const double *v,
                          const geom_plane *a) {
    if (context->first == NUM_FILTER) {
        if (h->form == GEOM_AXIS && a->form == GEOM_AXIS && h->axis == a->axis)
            return num_by_id(context, sign_of(a->c, h->c));
        int sure = crossing_filter(h, u, v, a);
        if (sure != NUM_UNSURE) return num_filtered(context, sure);
        const double *vertex = crossing_known(h, u, v, a, &sure);
        if (sure != NUM_UNSURE) return num_by_id(context, sure);
        if (vertex) return plain_vertex(context, h, vertex);
    }
    if (context->first <= NUM_BALL) {
        int sure = crossing_ball(h, u, v, a);
        if (sure != NUM_UNSURE) return num_refined(context, sure);
    }
    num_dyadic divisor, value = value_at_crossing_dyadic(num_fresh(context), h, u, v, a, &divisor);
    return num_exact(context, value.sign * divisor.sign);
}

/* Does the crossing of uv and a lie on line i of the wall h by definition? */
static bool is_on_line(const geom_plane *h, int i, const double *u, const double *v, const geom_plane *a) {
    if (is_end(h, i, u) && is_end(h, i, v)) return true;
    return a->form == (h->dim == 2 ? GEOM_POINTS : GEOM_VERTICAL) && is_end(h, i, a->p[0]) && is_end(h, i, a->p[1]);
}

/* The side of h on which the point is that names the wall a, as seen from above. */
static int named_point(num_context *context, const geom_plane *h, const geom_plane *a) {
    if (a->form == GEOM_AT_VERTEX) return plain_vertex(context, h, a->p[0]);
    geom_plane second = crossing_line(a, 1);
    return plain_crossing(context, h, a->p[0], a->p[1], &second);
}

/* Where uv meets the wall a without the shear, it is on h. With it the meeting moves along uv, to the right by eps
 * times how far the wall's point is above uv. Of an upright uv it is the point with the height of the wall's. */
static int tie_at_wall(num_context *context, const geom_plane *h, const double *u, const double *v,
                       const geom_plane *a) {
    const double *ends[2] = {u, v};
    geom_plane line = h->dim == 2 ? geom_plane_points(2, ends) : geom_plane_vertical(u, v);
    if (u[0] == v[0] && a->form == GEOM_AT_VERTEX && a->p[0][0] == u[0]) {
        geom_plane level = geom_plane_axis(h->dim, 1, a->p[0][1]);
        return plain_crossing(context, h, u, v, &level);
    }
    if (u[0] == v[0]) return crossing_sheared(context, h, u, v, a);
    num_dyadic n[3];
    plane_normal_dyadic(num_fresh(context), h, n);
    int rises = plane_slope_dyadic(&context->arena, h, n, u, v).sign;
    return rises ? rises * named_point(context, &line, a) : num_exact(context, 0);
}

/* h is a wall, a is none. */
static int wall_crossing(num_context *context, const geom_plane *h, const double *u, const double *v,
                         const geom_plane *a) {
    if (context->first == NUM_FILTER) {
        int sure = crossing_filter(h, u, v, a);
        if (sure != NUM_UNSURE) return num_filtered(context, sure);
        const double *vertex = crossing_known(h, u, v, a, &sure);
        if (vertex) return wall_vertex(context, h, vertex);
        for (int i = 0; i < 2 && h->form == GEOM_AT_CROSSING; i++) {
            geom_plane other = crossing_line(h, 1 - i);
            if (is_on_line(h, i, u, v, a)) return along_line(h, i, plain_crossing(context, &other, u, v, a));
        }
        if (h->form == GEOM_AT_VERTEX && u[0] == v[0] && u[0] == h->p[0][0]) { /* only y can tell */
            geom_plane level = geom_plane_axis(h->dim, 1, h->p[0][1]);
            return plain_crossing(context, &level, u, v, a);
        }
    }
    if (context->first <= NUM_BALL) {
        int sure = unless_zero(crossing_ball(h, u, v, a), true);
        if (sure != NUM_UNSURE) return num_refined(context, sure);
    }
    return crossing_sheared(context, h, u, v, a);
}

/* Both are walls: what lies on the wall a is on the same side of h, wherever it is. */
static int wall_wall(num_context *context, const geom_plane *h, const geom_plane *a) {
    if (a->form == GEOM_AT_VERTEX) return wall_vertex(context, h, a->p[0]);
    if (same_plane(a, h)) return num_by_id(context, 0);
    geom_plane second = crossing_line(a, 1);
    return wall_crossing(context, h, a->p[0], a->p[1], &second);
}

/* a is a wall, h is none. */
static int crossing_at_wall(num_context *context, const geom_plane *h, const double *u, const double *v,
                            const geom_plane *a) {
    if (context->first == NUM_FILTER) {
        int sure = crossing_filter(h, u, v, a);
        if (sure != NUM_UNSURE) return num_filtered(context, sure);
        const double *vertex = crossing_known(h, u, v, a, &sure);
        if (sure != NUM_UNSURE) return num_by_id(context, sure);
        if (vertex) return plain_vertex(context, h, vertex);
        for (int i = 0; i < 2 && a->form == GEOM_AT_CROSSING; i++) { /* of the line uv itself */
            geom_plane other = crossing_line(a, 1 - i);
            if (is_end(a, i, u) && is_end(a, i, v)) return plain_crossing(context, h, u, v, &other);
        }
    }
    if (context->first <= NUM_BALL) {
        int sure = unless_zero(crossing_ball(h, u, v, a), true);
        if (sure != NUM_UNSURE) return num_refined(context, sure);
    }
    num_dyadic divisor, value = value_at_crossing_dyadic(num_fresh(context), h, u, v, a, &divisor);
    if (value.sign && divisor.sign) return num_exact(context, value.sign * divisor.sign);
    return context->first == NUM_FILTER ? tie_at_wall(context, h, u, v, a) : crossing_sheared(context, h, u, v, a);
}

static int crossing_side(num_context *context, const geom_plane *h, const double *u, const double *v,
                         const geom_plane *a) {
    if (geom_is_sheared(h)) return geom_is_sheared(a) ? wall_wall(context, h, a) : wall_crossing(context, h, u, v, a);
    return geom_is_sheared(a) ? crossing_at_wall(context, h, u, v, a) : plain_crossing(context, h, u, v, a);
}

int geom_side_crossing(num_context *context, const geom_plane *plane, const double *u, const double *v,
                       const geom_plane *a) {
    context->stats.calls++;
    return crossing_side(context, plane, u, v, a);
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
    if (!geom_has_origin(s)) sum = filter_sub(sum, filter_mul(filter_value(s, z), filter_dot(&n_h, &ab)));
    return ratio_sign(filter_sign(sum), filter_sign(divisor));
}

/* As crossing_known. */
static const double *corner_known(const geom_plane *h, const geom_plane *const planes[3], int *side) {
    const geom_plane *s = planes[0], *a = planes[1], *b = planes[2];
    *side = holds_line(h, s, a) || holds_line(h, s, b) || holds_line(h, a, b) ? 0 : NUM_UNSURE;
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < plane_point_count(planes[j]); i++) {
            const double *x = planes[j]->p[i];
            if (plane_holds(s, x) && plane_holds(a, x) && plane_holds(b, x)) return x;
        }
    return NULL;
}

/* The point z measures from is on planes[0], if that has an origin. */
static int sheared_corner_side(num_context *context, const geom_plane *h, const geom_plane *const planes[3],
                               const double z[3]) {
    num_dyadic plain_divisor,
        plain = value_at_corner_dyadic(num_fresh(context), h, planes[0], planes[1], planes[2], z, &plain_divisor);
    if (plain.sign && plain_divisor.sign) return num_exact(context, plain.sign * plain_divisor.sign);
    num_sheared divisor,
        value = value_at_corner_sheared(num_fresh(context), h, planes[0], planes[1], planes[2], z, &divisor);
    return num_exact(context, num_sheared_sign(value) * num_sheared_sign(divisor));
}

/* The planes that are seen from above as lines. */
static bool is_upright(const geom_plane *h) {
    return h->form == GEOM_VERTICAL || geom_is_sheared(h);
}

/* Where all but the support are upright, the corner is a crossing, as seen from above. */
static int upright_corner(num_context *context, const geom_plane *h, const geom_plane *a, const geom_plane *b) {
    const geom_plane *line = geom_is_sheared(b) ? a : b, *other = line == b ? a : b;
    return crossing_side(context, h, line->p[0], line->p[1], other);
}

/* Does s lie in h? Neither is sheared. */
static bool is_inside(num_context *context, const geom_plane *h, const geom_plane *s) {
    froe_predicate_stats before = context->stats;
    bool inside = s->form == GEOM_POINTS && !geom_is_sheared(h);
    for (int i = 0; i < 3 && inside; i++) inside = !plain_vertex(context, h, s->p[i]);
    context->stats = before; /* callers did not ask for these */
    return inside;
}

int geom_side_corner(num_context *context, const geom_plane *plane, const geom_plane *s, const geom_plane *a,
                     const geom_plane *b) {
    const geom_plane *planes[3] = {s, a, b};
    double z[3];
    bool sheared = geom_is_sheared(plane) || geom_is_sheared(s) || geom_is_sheared(a) || geom_is_sheared(b);
    geom_corner_origin(planes, plane, z);
    context->stats.calls++;
    if (context->first == NUM_FILTER) {
        int sure = corner_filter(plane, planes, z);
        if (sure != NUM_UNSURE) return num_filtered(context, sure);
        const double *vertex = corner_known(plane, planes, &sure);
        if (sure != NUM_UNSURE) return num_by_id(context, sure);
        if (vertex) return vertex_side(context, plane, vertex);
        if (is_upright(plane) && is_upright(a) && is_upright(b)) return upright_corner(context, plane, a, b);
        if (sheared && is_inside(context, plane, s)) return num_by_id(context, 0);
    }
    if (context->first <= NUM_BALL) {
        num_ball divisor, value = value_at_corner_ball(NULL, plane, planes[0], planes[1], planes[2], z, &divisor);
        int sure = unless_zero(ratio_sign(num_ball_sign(value), num_ball_sign(divisor)), sheared);
        if (sure != NUM_UNSURE) return num_refined(context, sure);
    }
    if (sheared) return sheared_corner_side(context, plane, planes, z);
    num_dyadic divisor,
        value = value_at_corner_dyadic(num_fresh(context), plane, planes[0], planes[1], planes[2], z, &divisor);
    return num_exact(context, value.sign * divisor.sign);
}

/* -------------------------------------------------------------------- ball -- */

/* The side from the signs of f(centre) and f(centre)^2 - r^2 |n|^2. *sure: are they? */
static int ball_side(int centre, int reach, bool *sure) {
    *sure = reach == -1 || (centre != NUM_UNSURE && reach != NUM_UNSURE);
    return reach == -1 ? 2 : centre;
}

/* A ball that touches a sheared plane has points on both sides of it, or nearly. */
static int reach_of(const geom_plane *h, int sign) {
    return geom_is_sheared(h) && sign == 0 ? -1 : sign;
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
    if (radius == 0) return vertex_side(context, plane, centre);
    if (context->first == NUM_FILTER) {
        int side = ball_filter(plane, centre, radius, &sure);
        if (sure) return num_filtered(context, side);
    }
    if (context->first <= NUM_BALL) {
        num_ball at, reach = reach_of_ball_ball(NULL, plane, centre, radius, &at);
        int side = ball_side(num_ball_sign(at), reach_of(plane, num_ball_sign(reach)), &sure);
        if (sure) return num_refined(context, side);
    }
    num_dyadic at, reach = reach_of_ball_dyadic(num_fresh(context), plane, centre, radius, &at);
    return num_exact(context, ball_side(at.sign, reach_of(plane, reach.sign), &sure));
}
