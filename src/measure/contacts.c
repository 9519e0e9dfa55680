/* contacts.c: do two segments cross, do two convex polygons pierce each other?
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
#include "measure/contacts.h"
#include "geom/predicates.h"
#include "scene/polygon.h"

/* ---------------------------------------------------------------- segments -- */

static int turn(num_context *context, const double *a, const double *b, const double *c) {
    geom_plane line = geom_plane_points(2, (const double *const[]){a, b});
    return geom_side_vertex(context, &line, c);
}

static bool less(const double *a, const double *b) {
    return a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]);
}

/* Do two segments of one line share more than a point? */
static bool overlap_on_line(const double *const a[2], const double *const b[2]) {
    int i = less(a[0], a[1]) ? 0 : 1, j = less(b[0], b[1]) ? 0 : 1;
    return less(a[i], b[1 - j]) && less(b[j], a[1 - i]);
}

measure_contact measure_segments(num_context *context, const froe_scene *s, uint32_t a, uint32_t b) {
    const double *p[2] = {scene_point(s, a, 0), scene_point(s, a, 1)};
    const double *q[2] = {scene_point(s, b, 0), scene_point(s, b, 1)};
    int side[2], other[2];
    for (int i = 0; i < 2; i++) side[i] = turn(context, p[0], p[1], q[i]);
    if (side[0] * side[1] > 0) return MEASURE_APART;
    if (!side[0] && !side[1]) return overlap_on_line(p, q) ? MEASURE_OVERLAP : MEASURE_APART;
    for (int i = 0; i < 2; i++) other[i] = turn(context, q[0], q[1], p[i]);
    bool across = side[0] * side[1] < 0, crossed = other[0] * other[1] < 0;
    if (across && crossed) return MEASURE_CROSSING;
    bool touched = side[0] * side[1] == 0 && crossed, touching = other[0] * other[1] == 0 && across;
    return touched || touching ? MEASURE_T_JUNCTION : MEASURE_APART; /* else: a common corner, or nothing */
}

/* ---------------------------------------------------------------- polygons -- */

/* A polygon, and on which side of the other's plane its corners lie. */
typedef struct polygon {
    num_context *context;
    const froe_scene *scene;
    uint32_t object, count;
    signed char *sides;
    bool front, behind, on; /* are there such corners? */
} polygon;

static polygon polygon_of(num_context *context, const froe_scene *s, uint32_t object, signed char *sides) {
    return (polygon){
        .context = context, .scene = s, .object = object, .count = scene_corners(s, object), .sides = sides};
}

static const double *corner(const polygon *p, uint32_t i) {
    return scene_point(p->scene, p->object, i < p->count ? i : 0);
}

static bool has_corner(const polygon *p, uint32_t vertex) {
    for (uint32_t i = 0; i < p->count; i++)
        if (scene_corner(p->scene, p->object, i) == vertex) return true;
    return false;
}

/* False: all corners are strictly on one side, and the polygons apart. */
static bool find_sides(polygon *p, const polygon *other) {
    geom_plane plane;
    scene_support(other->scene, other->object, &plane);
    for (uint32_t i = 0; i < p->count; i++) {
        bool common = has_corner(other, scene_corner(p->scene, p->object, i));
        int side = common ? 0 : geom_side_vertex(p->context, &plane, corner(p, i));
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
    for (; i < p->count; i++) {
        bool from = p->sides[i] < 0, to = p->sides[i + 1 < p->count ? i + 1 : 0] < 0;
        if (up ? from && !to : !from && to) break;
    }
    ends[0] = corner(p, up ? i : i + 1);
    ends[1] = corner(p, up ? i + 1 : i);
}

/* Order along D of the points where edges of P and Q meet the line: 1 when Q's comes later. */
static int order(const polygon *p, bool p_up, const polygon *q, bool q_up) {
    const double *u[2], *w[2];
    find_edge(p, p_up, u);
    find_edge(q, q_up, w);
    geom_plane plane = geom_plane_points(3, (const double *const[]){u[0], u[1], w[0]});
    return geom_side_vertex(p->context, &plane, w[1]);
}

/* Both straddle the other's plane: do their open intervals on the line meet? */
static bool pierce(const polygon *p, const polygon *q) {
    return order(p, true, q, true) > 0 && order(p, false, q, false) < 0;
}

/* A projection that keeps the polygon's area, and which way it turns there. */
static int projection(const polygon *p, int *axis) {
    *axis = scene_projection_axis(p->context, corner(p, 0), corner(p, 1), corner(p, 2));
    return scene_projected_turn(p->context, *axis, corner(p, 0), corner(p, 1), corner(p, 2));
}

/* Is x, a point of the plane of p, in p? */
static bool contains(const polygon *p, const double *x) {
    int axis, way = projection(p, &axis);
    for (uint32_t i = 0; i < p->count; i++)
        if (scene_projected_turn(p->context, axis, corner(p, i), corner(p, i + 1), x) == -way) return false;
    return true;
}

static bool holds_corner(const polygon *p, const polygon *q) {
    for (uint32_t i = 0; i < q->count; i++)
        if (q->sides[i] == 0 && !has_corner(p, scene_corner(q->scene, q->object, i)) && contains(p, corner(q, i)))
            return true;
    return false;
}

/* Coplanar: is there an edge of p with no corner of q strictly on its inner side? */
static bool separates(const polygon *p, const polygon *q) {
    int axis, way = projection(p, &axis);
    for (uint32_t i = 0; i < p->count; i++) {
        uint32_t j = 0;
        while (j < q->count &&
               scene_projected_turn(p->context, axis, corner(p, i), corner(p, i + 1), corner(q, j)) != way)
            j++;
        if (j == q->count) return true;
    }
    return false;
}

/* Does the line uv, which crosses the plane of p, meet p? All edges go round it one way. */
static bool line_meets(const polygon *p, const double *u, const double *v) {
    int ways = 0;
    for (uint32_t i = 0; i < p->count; i++) {
        geom_plane plane = geom_plane_points(3, (const double *const[]){u, v, corner(p, i)});
        int side = geom_side_vertex(p->context, &plane, corner(p, i + 1));
        ways |= side > 0 ? 1 : side < 0 ? 2 : 0;
    }
    return ways != 3;
}

/* Is the line between two corners of p an edge of it? */
static bool is_edge(const polygon *p, uint32_t a, uint32_t b) {
    for (uint32_t i = 0, j = p->count - 1; i < p->count; j = i++) {
        uint32_t c = scene_corner(p->scene, p->object, i), d = scene_corner(p->scene, p->object, j);
        if ((a == c && b == d) || (a == d && b == c)) return true;
    }
    return false;
}

/* Does an edge of q touch p on its way, elsewhere than along an edge with the same ends? With no
 * corner of either in the other but common ones, this is the only way left to meet. */
static bool edge_touches(const polygon *p, const polygon *q) {
    for (uint32_t i = 0, j = q->count - 1; i < q->count; j = i++) {
        uint32_t a = scene_corner(q->scene, q->object, j), b = scene_corner(q->scene, q->object, i);
        if (q->sides[j] * q->sides[i] < 0 && line_meets(p, corner(q, j), corner(q, i))) return true;
        if (!q->sides[j] && !q->sides[i] && has_corner(p, a) && has_corner(p, b) && !is_edge(p, a, b)) return true;
    }
    return false;
}

measure_contact measure_polygons(num_context *context, const froe_scene *s, uint32_t a, uint32_t b,
                                 signed char *sides) {
    polygon p = polygon_of(context, s, a, sides), q = polygon_of(context, s, b, sides + scene_corners(s, a));
    if (!find_sides(&q, &p) || !find_sides(&p, &q)) return MEASURE_APART;
    bool coplanar = !q.front && !q.behind;
    if (coplanar && !separates(&p, &q) && !separates(&q, &p)) return MEASURE_OVERLAP;
    if (p.front && p.behind && q.front && q.behind && pierce(&p, &q)) return MEASURE_CROSSING;
    if (holds_corner(&p, &q) || holds_corner(&q, &p)) return MEASURE_T_JUNCTION;
    return !coplanar && (edge_touches(&p, &q) || edge_touches(&q, &p)) ? MEASURE_CROSSING : MEASURE_APART;
}
