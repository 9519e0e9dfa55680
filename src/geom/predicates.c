/* predicates.c: sides of vertices, crossings, corners and balls, each by the stages of num/ladder.h. */
#include "geom/predicates.h"
#include "geom/filter.h"
#include "geom/formulas.h"

static int sign_of(double a, double b) {
    return (a > b) - (a < b);
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

/* Are g and h the same plane by definition? Crossings: those of the same two segments, named in the same order. */
static bool same_plane(const geom_plane *g, const geom_plane *h) {
    bool same = g->form == h->form;
    if (g == h) return true;
    if (g->form == GEOM_POINTS) return shared(g, h, h) == g->dim;
    if (g->form == GEOM_AXIS) return same && g->axis == h->axis && g->c == h->c;
    if (g->form == GEOM_AT_VERTEX) return same && plane_holds(h, g->p[0]);
    if (g->form == GEOM_VERTICAL) return same && shared(g, h, h) == 2;
    const bool crossing = g->form == GEOM_AT_CROSSING;
    same = same && (crossing || g->c == h->c);
    for (int i = 0; i < (crossing ? 4 : 1); i++)
        for (int k = 0; k < (crossing ? 2 : 3); k++) same = same && g->p[i][k] == h->p[i][k];
    for (int k = 3; k < g->dim; k++) same = same && g->normal[k] == h->normal[k];
    if (same && g->form == GEOM_FINE) return g->rows == h->rows && g->row_count == h->row_count;
    return same;
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
static int unless_zero(int sign) {
    return sign == 0 ? NUM_UNSURE : sign;
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
    int sign;
    if (context->first == NUM_FILTER && h->form == GEOM_AXIS) return num_by_id(context, sign_of(x[h->axis], h->c));
    return NUM_DECIDE(context, sign, filter_sign(filter_value(h, x)),
                      plane_holds(h, x) ? num_by_id(context, 0) : NUM_UNSURE, side_of_vertex, h, x);
}

/* The side of a wall at a crossing on which an end of the wall's own lines is, if x is one. */
static int known_wall_vertex(num_context *context, const geom_plane *h, const double *x) {
    for (int i = 0; i < 2; i++) {
        if (!is_end(h, i, x)) continue;
        geom_plane other = crossing_line(h, 1 - i);
        return along_line(h, i, plain_vertex(context, &other, x));
    }
    return NUM_UNSURE;
}

/* The same, exactly. Infinitesimals only where it depends on them. */
static int sheared_vertex(num_context *context, const geom_plane *h, const double *x) {
    const int plain = side_of_vertex_dyadic(num_fresh(context), h, x);
    return plain ? plain : side_of_vertex_sheared(num_fresh(context), h, x);
}

/* All stages for walls. */
static int wall_vertex(num_context *context, const geom_plane *h, const double *x) {
    int sign;
    if (context->first == NUM_FILTER && h->form == GEOM_AT_VERTEX) return num_by_id(context, lexicographic(x, h->p[0]));
    return NUM_LADDER(context, sign, filter_sign(filter_value(h, x)), known_wall_vertex(context, h, x),
                      unless_zero(side_of_vertex_ball(NULL, h, x)), sheared_vertex(context, h, x));
}

static int vertex_side(num_context *context, const geom_plane *h, const double *x) {
    return geom_is_sheared(h) ? wall_vertex(context, h, x) : plain_vertex(context, h, x);
}

int geom_side_vertex(num_context *context, const geom_plane *plane, const double *x) {
    context->stats.calls++;
    return vertex_side(context, plane, x);
}

/* ---------------------------------------------------------------- crossing -- */

/* Both are multiplied by one power of two where they are tiny, since products of two tiny numbers underflow. */
static void lift_both(num_ball *a, num_ball *b) {
    const double lift = filter_lift(filter_greater(fabs(a->x) + a->e, fabs(b->x) + b->e));
    if (lift == 1) return;
    a->x *= lift, a->e *= lift;
    b->x *= lift, b->e *= lift;
}

static int crossing_filter(const geom_plane *h, const double *u, const double *v, const geom_plane *a) {
    num_ball divisor = filter_slope(a, u, v), value = filter_value(a, u);
    lift_both(&divisor, &value);
    num_ball at_u = filter_mul(filter_value(h, u), divisor);
    num_ball along = filter_mul(filter_slope(h, u, v), value);
    return num_quotient_sign(filter_sign(filter_sub(at_u, along)), filter_sign(divisor));
}

/* Exactly. Infinitesimals only where it depends on them. */
static int sheared_crossing(num_context *context, const geom_plane *h, const double *u, const double *v,
                            const geom_plane *a) {
    const int plain = side_of_crossing_dyadic(num_fresh(context), h, u, v, a);
    return plain ? plain : side_of_crossing_sheared(num_fresh(context), h, u, v, a);
}

/* The end of uv that a contains by definition, or NULL. */
static const double *end_on_plane(const geom_plane *a, const double *u, const double *v) {
    return plane_holds(a, u) ? u : plane_holds(a, v) ? v : NULL;
}

/* What is known of the crossing by definition; h is not sheared. */
static int known_crossing(num_context *context, const geom_plane *h, const double *u, const double *v,
                          const geom_plane *a) {
    if (same_plane(h, a) || (plane_holds(h, u) && plane_holds(h, v))) return num_by_id(context, 0);
    const double *vertex = end_on_plane(a, u, v);
    return vertex ? plain_vertex(context, h, vertex) : NUM_UNSURE;
}

/* Neither h nor a is sheared. */
static int plain_crossing(num_context *context, const geom_plane *h, const double *u, const double *v,
                          const geom_plane *a) {
    int sign;
    if (context->first == NUM_FILTER && h->form == GEOM_AXIS && a->form == GEOM_AXIS && h->axis == a->axis)
        return num_by_id(context, sign_of(a->c, h->c));
    return NUM_DECIDE(context, sign, crossing_filter(h, u, v, a), known_crossing(context, h, u, v, a), side_of_crossing,
                      h, u, v, a);
}

/* What is known of the crossing by definition; h is a wall. */
static int known_wall_crossing(num_context *context, const geom_plane *h, const double *u, const double *v,
                               const geom_plane *a) {
    const double *vertex = end_on_plane(a, u, v);
    if (vertex) return wall_vertex(context, h, vertex);
    for (int i = 0; i < 2 && h->form == GEOM_AT_CROSSING; i++) { /* is it on line i of the wall? */
        const bool along =
            a->form == (h->dim == 2 ? GEOM_POINTS : GEOM_VERTICAL) && is_end(h, i, a->p[0]) && is_end(h, i, a->p[1]);
        if (!along && !(is_end(h, i, u) && is_end(h, i, v))) continue;
        geom_plane other = crossing_line(h, 1 - i);
        return along_line(h, i, plain_crossing(context, &other, u, v, a));
    }
    if (h->form != GEOM_AT_VERTEX || u[0] != v[0] || u[0] != h->p[0][0]) return NUM_UNSURE;
    geom_plane level = geom_plane_axis(h->dim, 1, h->p[0][1]); /* only y can tell */
    return plain_crossing(context, &level, u, v, a);
}

/* h is a wall, a is none. */
static int wall_crossing(num_context *context, const geom_plane *h, const double *u, const double *v,
                         const geom_plane *a) {
    int sign;
    return NUM_LADDER(context, sign, crossing_filter(h, u, v, a), known_wall_crossing(context, h, u, v, a),
                      unless_zero(side_of_crossing_ball(NULL, h, u, v, a)), sheared_crossing(context, h, u, v, a));
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
    if (u[0] == v[0]) return num_exact(context, sheared_crossing(context, h, u, v, a));
    num_dyadic n[FROE_MAX_DIM];
    plane_normal_dyadic(num_fresh(context), h, n);
    int rises = plane_slope_dyadic(&context->arena, h, n, u, v).sign;
    if (!rises) return num_exact(context, 0);
    /* the side of the line on which the point is that names the wall, as seen from above */
    if (a->form == GEOM_AT_VERTEX) return rises * plain_vertex(context, &line, a->p[0]);
    geom_plane second = crossing_line(a, 1);
    return rises * plain_crossing(context, &line, a->p[0], a->p[1], &second);
}

/* What is known of the crossing by definition; a is a wall. */
static int known_at_wall(num_context *context, const geom_plane *h, const double *u, const double *v,
                         const geom_plane *a) {
    const int known = known_crossing(context, h, u, v, a);
    if (known != NUM_UNSURE) return known;
    for (int i = 0; i < 2 && a->form == GEOM_AT_CROSSING; i++) { /* of the line uv itself */
        if (!is_end(a, i, u) || !is_end(a, i, v)) continue;
        geom_plane other = crossing_line(a, 1 - i);
        return plain_crossing(context, h, u, v, &other);
    }
    return NUM_UNSURE;
}

static int exactly_at_wall(num_context *context, const geom_plane *h, const double *u, const double *v,
                           const geom_plane *a) {
    const int plain = side_of_crossing_dyadic(num_fresh(context), h, u, v, a);
    if (plain) return num_exact(context, plain);
    return context->first == NUM_FILTER ? tie_at_wall(context, h, u, v, a)
                                        : num_exact(context, side_of_crossing_sheared(num_fresh(context), h, u, v, a));
}

static int crossing_side(num_context *context, const geom_plane *h, const double *u, const double *v,
                         const geom_plane *a) {
    int sign;
    const bool sheared = geom_is_sheared(a);
    if (sheared && geom_is_sheared(h)) { /* what lies on the wall a is on the same side of h, wherever it is */
        if (a->form == GEOM_AT_VERTEX) return wall_vertex(context, h, a->p[0]);
        if (same_plane(a, h)) return num_by_id(context, 0);
        geom_plane second = crossing_line(a, 1);
        return wall_crossing(context, h, a->p[0], a->p[1], &second);
    }
    if (geom_is_sheared(h)) return wall_crossing(context, h, u, v, a);
    if (!sheared) return plain_crossing(context, h, u, v, a);
    return NUM_STAGES(context, sign, crossing_filter(h, u, v, a), known_at_wall(context, h, u, v, a),
                      unless_zero(side_of_crossing_ball(NULL, h, u, v, a)), exactly_at_wall(context, h, u, v, a));
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
    return num_quotient_sign(filter_sign(sum), filter_sign(divisor));
}

/* The planes that are seen from above as lines. */
static bool is_upright(const geom_plane *h) {
    return h->form == GEOM_VERTICAL || geom_is_sheared(h);
}

/* Does s lie in h? Neither is sheared. */
static bool is_inside(num_context *context, const geom_plane *h, const geom_plane *s) {
    froe_predicate_stats before = context->stats;
    bool inside = s->form == GEOM_POINTS && !geom_is_sheared(h);
    for (int i = 0; i < 3 && inside; i++) inside = !plain_vertex(context, h, s->p[i]);
    context->stats = before; /* callers did not ask for these */
    return inside;
}

/* What is known of the corner of s, a and b by definition; `planes` are the same in another order. */
static int known_corner(num_context *context, const geom_plane *h, const geom_plane *const planes[3],
                        const geom_plane *s, const geom_plane *a, const geom_plane *b, bool sheared) {
    const geom_plane *p = planes[0], *q = planes[1], *r = planes[2];
    if (holds_line(h, p, q) || holds_line(h, p, r) || holds_line(h, q, r)) return num_by_id(context, 0);
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < plane_point_count(planes[j]); i++) {
            const double *x = planes[j]->p[i];
            if (plane_holds(p, x) && plane_holds(q, x) && plane_holds(r, x)) return vertex_side(context, h, x);
        }
    if (is_upright(h) && is_upright(a) && is_upright(b)) { /* seen from above, it is a crossing */
        const geom_plane *line = geom_is_sheared(b) ? a : b, *other = line == b ? a : b;
        return crossing_side(context, h, line->p[0], line->p[1], other);
    }
    return sheared && is_inside(context, h, s) ? num_by_id(context, 0) : NUM_UNSURE;
}

/* Exactly. Infinitesimals only where it depends on them. */
static int sheared_corner(num_context *context, const geom_plane *h, const geom_plane *const planes[3],
                          const double z[3]) {
    const int plain = side_of_corner_dyadic(num_fresh(context), h, planes[0], planes[1], planes[2], z);
    return plain ? plain : side_of_corner_sheared(num_fresh(context), h, planes[0], planes[1], planes[2], z);
}

int geom_side_corner(num_context *context, const geom_plane *plane, const geom_plane *s, const geom_plane *a,
                     const geom_plane *b) {
    const geom_plane *planes[3] = {s, a, b};
    double z[3];
    int sign;
    const bool sheared = geom_is_sheared(plane) || geom_is_sheared(s) || geom_is_sheared(a) || geom_is_sheared(b);
    geom_corner_origin(planes, plane, z);
    context->stats.calls++;
    if (sheared)
        return NUM_LADDER(context, sign, corner_filter(plane, planes, z),
                          known_corner(context, plane, planes, s, a, b, true),
                          unless_zero(side_of_corner_ball(NULL, plane, planes[0], planes[1], planes[2], z)),
                          sheared_corner(context, plane, planes, z));
    return NUM_DECIDE(context, sign, corner_filter(plane, planes, z),
                      known_corner(context, plane, planes, s, a, b, false), side_of_corner, plane, planes[0], planes[1],
                      planes[2], z);
}

/* -------------------------------------------------------------------- ball -- */

/* |n|^2 of a plane that is not parallel to an axis. */
static num_ball square_of_normal(const geom_plane *h) {
    if (h->dim <= 3) {
        const filter_vector n = filter_normal(h);
        return filter_dot(&n, &n);
    }
    num_ball sum = {0, 0};
    for (int k = 0; k < h->dim; k++) {
        const num_ball x = {h->normal[k], h->n_err};
        sum = filter_add(sum, filter_mul(x, x));
    }
    return sum;
}

static int ball_filter(const geom_plane *h, const double *centre, double radius) {
    if (h->form == GEOM_AXIS) { /* rounding is monotone: fl(x - c) < r or > r tells the same of x - c */
        const double distance = fabs(centre[h->axis] - h->c);
        if (distance == radius) return NUM_UNSURE;
        return distance > radius ? sign_of(centre[h->axis], h->c) : GEOM_CUTS;
    }
    num_ball at = filter_value(h, centre), r = num_ball_from(radius);
    num_ball reach = filter_sub(filter_mul(at, at), filter_mul(filter_mul(r, r), square_of_normal(h)));
    return geom_ball_side(h, filter_sign(at), filter_sign(reach));
}

int geom_side_ball(num_context *context, const geom_plane *plane, const double *centre, double radius) {
    int sign;
    context->stats.calls++;
    if (radius == 0) return vertex_side(context, plane, centre);
    sign =
        NUM_DECIDE(context, sign, ball_filter(plane, centre, radius), NUM_UNSURE, side_of_ball, plane, centre, radius);
    return sign == GEOM_CUTS ? 2 : sign;
}

/* --------------------------------------------------------------------- box -- */

/* Does a plane given by a normal rise along an axis? */
static bool rises(num_context *context, const geom_plane *plane, int axis) {
    if (plane->form == GEOM_VECTOR || fabs(plane->normal[axis]) > plane->n_err) return plane->normal[axis] > 0;
    return plane_coefficient_dyadic(num_fresh(context), plane, axis).sign > 0;
}

int geom_side_box(num_context *context, const geom_plane *plane, const double *lo, const double *hi) {
    const bool vector = geom_is_vector(plane), two = vector || plane->form == GEOM_AXIS;
    unsigned reached = 0, up = ~0u;
    for (int k = 0; k < plane->dim && vector; k++)
        if (!rises(context, plane, k)) up &= ~(1u << k);
    for (uint32_t i = 0; i < (two ? 2 : 1u << plane->dim) && reached != 3; i++) {
        const uint32_t corner = two ? (i ? up : ~up) : i; /* the furthest back, then the furthest along; or all */
        double x[FROE_MAX_DIM];
        for (int k = 0; k < plane->dim; k++) x[k] = corner >> k & 1 ? hi[k] : lo[k];
        const int side = geom_side_vertex(context, plane, x);
        if (side) reached |= side > 0 ? 2 : 1;
    }
    return reached == 3 ? 2 : reached == 2 ? 1 : -(int)reached;
}
