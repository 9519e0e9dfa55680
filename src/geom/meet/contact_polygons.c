/* contact_polygons.c: do two convex polygons in space pierce each other, or touch?
 *
 * Polygons P and Q that both have corners strictly on both sides of the other's plane
 * meet the line where the planes meet, D = normal(P) x normal(Q), in an interval each:
 *
 *        P up        Q down        P down        Q up
 *     ----[=============[============]=============]----> D
 *
 * With corners turning left around the normal, P enters the line on its edge up, from
 * behind Q to the front, and leaves it on its edge down; Q the other way round. The order of
 * two such points on the line is an orientation of their edges' four ends (Devillers and
 * Guigue: Faster triangle-triangle intersection tests, 2002): nothing is constructed. */
#include "geom/meet/contact.h"
#include "geom/predicates.h"
#include "geom/turn.h"

/* A polygon, and on which side of the other's plane its corners lie. */
typedef struct polygon {
    num_context *context;
    const geom_body *body;
    uint32_t count;
    signed char *sides;
    bool front, behind, on; /* are there such corners? */
} polygon;

static const double *polygon_corner(const polygon *p, uint32_t i) {
    return geom_body_point(p->body, i < p->count ? i : 0);
}

static bool has_corner(const polygon *p, const double *x) {
    for (uint32_t i = 0; i < p->count; i++)
        if (geom_same_point(polygon_corner(p, i), x, 3)) return true;
    return false;
}

/* False: all corners are strictly on one side, and the polygons apart. */
static bool find_sides(polygon *p, const polygon *other) {
    geom_plane plane = geom_plane_points(
        3, (const double *const[]){polygon_corner(other, 0), polygon_corner(other, 1), polygon_corner(other, 2)});
    for (uint32_t i = 0; i < p->count; i++) {
        bool common = has_corner(other, polygon_corner(p, i));
        int side = common ? 0 : geom_side_vertex(p->context, &plane, polygon_corner(p, i));
        p->sides[i] = (signed char)side;
        p->front |= side > 0;
        p->behind |= side < 0;
        p->on |= side == 0;
    }
    return p->on || p->front == p->behind;
}

/* The one edge that goes from behind the other's plane to not behind it (up), or back (down): the end
 * behind it first. */
static void find_edge(const polygon *p, bool up, const double *ends[2]) {
    uint32_t i = 0;
    for (;; i++) { /* p has corners on both sides */
        bool from = p->sides[i] < 0, to = p->sides[i + 1 < p->count ? i + 1 : 0] < 0;
        if (up ? from && !to : !from && to) break;
    }
    ends[0] = polygon_corner(p, up ? i : i + 1);
    ends[1] = polygon_corner(p, up ? i + 1 : i);
}

/* Order along D of the points where edges of P and Q meet the line: 1 when Q's comes later. */
static int order(const polygon *p, bool p_up, const polygon *q, bool q_up) {
    const double *u[2], *w[2];
    find_edge(p, p_up, u);
    find_edge(q, q_up, w);
    geom_plane plane = geom_plane_points(3, (const double *const[]){u[0], u[1], w[0]});
    return geom_side_vertex(p->context, &plane, w[1]);
}

/* A projection that keeps the polygon's area, and which way it turns there. */
static int projection(const polygon *p, int *axis) {
    *axis = geom_projection_axis(p->context, polygon_corner(p, 0), polygon_corner(p, 1), polygon_corner(p, 2));
    return geom_projected_turn(p->context, *axis, polygon_corner(p, 0), polygon_corner(p, 1), polygon_corner(p, 2));
}

/* Is x, a point of the plane of p, in p? */
static bool contains(const polygon *p, const double *x) {
    int axis, way = projection(p, &axis);
    for (uint32_t i = 0; i < p->count; i++)
        if (geom_projected_turn(p->context, axis, polygon_corner(p, i), polygon_corner(p, i + 1), x) == -way)
            return false;
    return true;
}

static bool holds_corner(const polygon *p, const polygon *q) {
    for (uint32_t i = 0; i < q->count; i++)
        if (q->sides[i] == 0 && !has_corner(p, polygon_corner(q, i)) && contains(p, polygon_corner(q, i))) return true;
    return false;
}

/* Coplanar: is there an edge of p with no corner of q strictly on its inner side? */
static bool separates(const polygon *p, const polygon *q) {
    int axis, way = projection(p, &axis);
    for (uint32_t i = 0; i < p->count; i++) {
        uint32_t j = 0;
        while (j < q->count && geom_projected_turn(p->context, axis, polygon_corner(p, i), polygon_corner(p, i + 1),
                                                   polygon_corner(q, j)) != way)
            j++;
        if (j == q->count) return true;
    }
    return false;
}

/* Does the line uv, which crosses the plane of p, meet p? All edges go round it one way. */
static bool line_meets(const polygon *p, const double *u, const double *v) {
    int ways = 0;
    for (uint32_t i = 0; i < p->count; i++) {
        geom_plane plane = geom_plane_points(3, (const double *const[]){u, v, polygon_corner(p, i)});
        int side = geom_side_vertex(p->context, &plane, polygon_corner(p, i + 1));
        ways |= side > 0 ? 1 : side < 0 ? 2 : 0;
    }
    return ways != 3;
}

/* Is the line between two corners of p an edge of it? */
static bool is_edge(const polygon *p, const double *a, const double *b) {
    for (uint32_t i = 0; i < p->count; i++) {
        const double *c = polygon_corner(p, i), *d = polygon_corner(p, i + 1);
        if (geom_same_point(a, c, 3) && geom_same_point(b, d, 3)) return true;
        if (geom_same_point(a, d, 3) && geom_same_point(b, c, 3)) return true;
    }
    return false;
}

/* Does an edge of q touch p on its way, elsewhere than along an edge with the same ends? With no
 * corner of either in the other but common ones, this is the only way left to meet. */
static bool edge_touches(const polygon *p, const polygon *q) {
    for (uint32_t i = 0, j = q->count - 1; i < q->count; j = i++) {
        const double *a = polygon_corner(q, j), *b = polygon_corner(q, i);
        if (q->sides[j] * q->sides[i] < 0 && line_meets(p, a, b)) return true;
        if (!q->sides[j] && !q->sides[i] && has_corner(p, a) && has_corner(p, b) && !is_edge(p, a, b)) return true;
    }
    return false;
}

static uint32_t common_corners(const polygon *p, const polygon *q) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < p->count; i++) count += has_corner(q, polygon_corner(p, i));
    return count;
}

geom_contact geom_contact_polygons(num_context *context, const geom_body *a, const geom_body *b, signed char *sides) {
    polygon p = {.context = context, .body = a, .count = a->count, .sides = sides};
    polygon q = {.context = context, .body = b, .count = b->count, .sides = sides + a->count};
    geom_contact m = {GEOM_APART, GEOM_TOUCH_SOMEHOW};
    if (!find_sides(&q, &p) || !find_sides(&p, &q)) return m;
    bool coplanar = !q.front && !q.behind;
    if (coplanar && !separates(&p, &q) && !separates(&q, &p)) return (geom_contact){GEOM_OVERLAP, m.touch};
    const bool straddle = p.front && p.behind && q.front && q.behind; /* do their open intervals on the line meet? */
    if (straddle && order(&p, true, &q, true) > 0 && order(&p, false, &q, false) < 0)
        return (geom_contact){GEOM_CROSS, m.touch};
    m.kind = GEOM_TOUCH;
    if (holds_corner(&p, &q) || holds_corner(&q, &p))
        m.touch = GEOM_TOUCH_JUNCTION;
    else if (!coplanar && (edge_touches(&p, &q) || edge_touches(&q, &p)))
        m.touch = GEOM_TOUCH_EDGES;
    else if (!common_corners(&p, &q))
        m.kind = GEOM_APART;
    else
        m.touch = common_corners(&p, &q) == 1 ? GEOM_TOUCH_AT_CORNER : GEOM_TOUCH_ALONG;
    return m;
}
