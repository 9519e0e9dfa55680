/* contact.c: see contact.h.
 *
 * Polytopes A and B meet iff 0 is in C, the hull of the differences of their corners (gap.h), and their relative
 * interiors meet iff 0 is in the relative interior of C (Rockafellar: Convex Analysis, 1970, Corollary 6.6.2). The
 * search for the gap tells a few differences around 0, which span a subspace L:
 *
 *            .  b           0 is inside C iff it is inside C modulo L: what L spans lies around 0 anyway.
 *        a -------- a'      So the differences outside L are looked at modulo L: if 0 is not in their hull,
 *            .              some plane has C on one side; if it is, L grows, at most to the whole space.
 *
 * They meet in one common corner x alone iff their cones there do: iff 0 is not in the hull of the generators a - x
 * and x - b, for then, and only then, a plane through x has A and B strictly on its two sides. */
#include "geom/meet/contact.h"
#include "geom/high/high.h"
#include "geom/meet/distance.h"
#include "geom/meet/gap.h"
#include "geom/turn.h"
#include <string.h>

static const geom_contact apart = {GEOM_APART, GEOM_TOUCH_SOMEHOW}, overlap = {GEOM_OVERLAP, GEOM_TOUCH_SOMEHOW};

static geom_contact contact_by_touch(geom_touch how) {
    return (geom_contact){GEOM_TOUCH, how};
}

/* ---------------------------------------------------------------- segments -- */

static bool less(const double *a, const double *b) {
    return a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]);
}

/* Two segments of one line. */
static geom_contact on_line(const double *const p[2], const double *const q[2]) {
    int i = less(p[0], p[1]) ? 0 : 1, j = less(q[0], q[1]) ? 0 : 1;
    if (less(p[i], q[1 - j]) && less(q[j], p[1 - i])) return overlap;
    bool common = geom_same_point(p[i], q[1 - j], 2) || geom_same_point(q[j], p[1 - i], 2);
    return common ? contact_by_touch(GEOM_TOUCH_AT_CORNER) : apart;
}

geom_contact geom_contact_segments(num_context *context, const geom_body *a, const geom_body *b) {
    const double *p[2] = {geom_body_point(a, 0), geom_body_point(a, 1)};
    const double *q[2] = {geom_body_point(b, 0), geom_body_point(b, 1)};
    int side[2], other[2];
    for (int i = 0; i < 2; i++) side[i] = geom_turn(context, p[0], p[1], q[i]);
    if (side[0] * side[1] > 0) return apart;
    if (!side[0] && !side[1]) return on_line(p, q);
    for (int i = 0; i < 2; i++) other[i] = geom_turn(context, q[0], q[1], p[i]);
    if (other[0] * other[1] > 0) return apart;
    bool across = side[0] * side[1] < 0, crossed = other[0] * other[1] < 0;
    if (across && crossed) return (geom_contact){GEOM_CROSS, GEOM_TOUCH_SOMEHOW};
    return contact_by_touch(across || crossed ? GEOM_TOUCH_JUNCTION : GEOM_TOUCH_AT_CORNER);
}

/* ------------------------------------------------------- boxes, points, balls -- */

/* The interval of a box or a point on one axis. */
static void interval(const geom_body *b, int axis, double out[2]) {
    out[0] = geom_body_point(b, 0)[axis];
    out[1] = b->form == FROE_BOX ? geom_body_point(b, 1)[axis] : out[0];
}

/* Axis by axis: everything about a box is the product of its intervals. */
static geom_contact meet_boxes(const geom_body *a, const geom_body *b) {
    int rank_a = 0, rank_b = 0, rank = 0;
    bool inner = true, corner = true;
    for (int k = 0; k < a->dim; k++) {
        double x[2], y[2];
        interval(a, k, x);
        interval(b, k, y);
        double lo = x[0] > y[0] ? x[0] : y[0], hi = x[1] < y[1] ? x[1] : y[1];
        bool flat_x = x[0] == x[1], flat_y = y[0] == y[1];
        if (lo > hi) return apart;
        rank_a += !flat_x, rank_b += !flat_y, rank += !flat_x && !flat_y;
        corner = corner && lo == hi && (lo == x[0] || lo == x[1]) && (lo == y[0] || lo == y[1]);
        inner = inner && (flat_x && flat_y ? true
                          : flat_x         ? y[0] < lo && lo < y[1]
                          : flat_y         ? x[0] < lo && lo < x[1]
                                           : lo < hi);
    }
    if (!inner) return contact_by_touch(corner ? GEOM_TOUCH_AT_CORNER : GEOM_TOUCH_SOMEHOW);
    int least = rank_a < rank_b ? rank_a : rank_b;
    return (geom_contact){rank == least ? GEOM_OVERLAP : GEOM_CROSS, GEOM_TOUCH_SOMEHOW};
}

/* An open ball that meets a convex body meets its relative interior, in a piece of its dimension. */
static geom_contact meet_ball(num_context *context, const geom_body *ball, const geom_body *b) {
    const double *centre = geom_body_point(ball, 0);
    geom_distance d = geom_distance_from(context, centre, b);
    int sign = geom_distance_compare_to(context, centre, &d, ball->radius);
    return sign > 0 ? apart : sign < 0 ? overlap : contact_by_touch(GEOM_TOUCH_SOMEHOW);
}

/* --------------------------------------------------------------- polytopes -- */

/* Two polytopes, and a subspace L of the directions around 0 in C. */
typedef struct contact_pair {
    num_context *context;
    const geom_body *a, *b;
    uint32_t i, j; /* corners whose difference is in L */
    int rank;      /* of L */
    double span[2][2][3];
} contact_pair;

static void add_directions(contact_pair *p, const geom_gap *gap) {
    for (int n = 0; n + 1 < gap->count; n++, p->rank++) {
        if (p->rank >= 2) continue;
        geom_body_corner(p->a, gap->a[n], p->span[p->rank][0]);
        geom_body_corner(p->b, gap->b[n], p->span[p->rank][1]);
    }
}

/* Bit 0: a corner lies behind the hyperplane L through corner `from`, bit 1: before it. */
static unsigned sides_reached(contact_pair *p, const geom_body *body, uint32_t from) {
    static const double zero[3] = {0, 0, 0}, up[3] = {0, 0, 1};
    double o[3], x[3];
    const geom_vector d = {p->span[0][0], p->span[0][1]}, v = {o, x};
    const geom_vector e = body->dim == 2 ? (geom_vector){zero, up} : (geom_vector){p->span[1][0], p->span[1][1]};
    unsigned reached = 0;
    geom_body_corner(body, from, o);
    for (uint32_t i = 0; i < geom_body_corners(body); i++) {
        geom_body_corner(body, i, x);
        const int side = geom_turn_of_vectors(p->context, &d, &e, &v);
        if (side) reached |= side > 0 ? 2 : 1;
    }
    return reached;
}

/* Is 0 in the relative interior of C? Then the rank of L is that of C. */
static bool inside(contact_pair *p) {
    int dim = p->a->dim;
    while (p->rank < dim - 1) {
        geom_differences rest = {.a = p->a, .b = p->b, .along = p->rank == 1, .nonzero = true};
        geom_gap gap;
        rest.star = p->rank == 0; /* then the corners i and j are one point */
        rest.star_a = p->i, rest.star_b = p->j;
        memcpy(rest.from, p->span[0][0], sizeof rest.from);
        memcpy(rest.to, p->span[0][1], sizeof rest.to);
        if (!geom_gap_among(p->context, &rest, &gap)) return true;
        if (!gap.zero) return false;
        add_directions(p, &gap);
    }
    if (p->rank >= dim) return true;
    /* L is a hyperplane: is C on both sides, or on none? */
    unsigned a = sides_reached(p, p->a, p->i), b = sides_reached(p, p->b, p->j);
    bool before = (a & 2) || (b & 1), behind = (a & 1) || (b & 2);
    p->rank += before || behind;
    return before == behind;
}

/* The first corner of both. */
static bool common_corner(const geom_body *a, const geom_body *b, uint32_t *i, uint32_t *j) {
    double p[3], q[3];
    uint32_t n = geom_body_corners(a), m = geom_body_corners(b);
    for (*i = 0; *i < n; ++*i) {
        geom_body_corner(a, *i, p);
        for (*j = 0; *j < m; ++*j) {
            geom_body_corner(b, *j, q);
            if (geom_same_point(p, q, 3)) return true;
        }
    }
    return false;
}

static geom_contact meet_polytopes(num_context *context, const geom_body *a, const geom_body *b) {
    geom_differences cone = {.a = a, .b = b, .star = true, .nonzero = true};
    geom_gap gap;
    if (common_corner(a, b, &cone.star_a, &cone.star_b)) { /* do they have more in common than this corner? */
        const bool elsewhere = !geom_gap_among(context, &cone, &gap) || gap.zero;
        if (!elsewhere) return contact_by_touch(GEOM_TOUCH_AT_CORNER);
    }
    gap = geom_gap_between(context, a, b);
    if (!gap.zero) return apart;
    contact_pair p = {.context = context, .a = a, .b = b, .i = gap.a[0], .j = gap.b[0]};
    add_directions(&p, &gap);
    if (!inside(&p)) return contact_by_touch(GEOM_TOUCH_SOMEHOW);
    int rank_a = geom_body_rank(context, a), rank_b = geom_body_rank(context, b);
    int most = rank_a > rank_b ? rank_a : rank_b; /* rank of the meet = rank_a + rank_b - rank of C */
    return (geom_contact){p.rank == most ? GEOM_OVERLAP : GEOM_CROSS, GEOM_TOUCH_SOMEHOW};
}

/* -------------------------------------------------------------------- both -- */

static bool is_box(const geom_body *b) {
    return b->form == FROE_BOX || b->form == FROE_POINT;
}

geom_contact geom_contact_of(num_context *context, const geom_body *a, const geom_body *b, signed char *sides) {
    if (a->form == FROE_BALL) return meet_ball(context, a, b);
    if (b->form == FROE_BALL) return meet_ball(context, b, a);
    if (is_box(a) && is_box(b)) return meet_boxes(a, b);
    if (a->form == FROE_POLYGON && b->form == FROE_POLYGON) return geom_contact_polygons(context, a, b, sides);
    if (a->dim == 2 && a->form == FROE_SEGMENT && b->form == FROE_SEGMENT) return geom_contact_segments(context, a, b);
    return a->dim > 3 ? geom_high_contact(context, a, b) : meet_polytopes(context, a, b);
}
