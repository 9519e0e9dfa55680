/* neighbours.c: when two moving triangles that share vertices have more in common than these and what is between them.
 *
 *     one vertex                 two                    three
 *          a1                        a                  never: they are one triangle
 *         /|   b1                   /|
 *        / |  /|                   v-w    a folds onto b
 *       a2-v-+-b2                   \|
 *                                    b
 *
 * One vertex v, corners not in one plane: what they have in common begins in v, as that is a corner of both. It goes
 * along the line in which their planes meet, and ends in the edge opposite of v in one of them. So they meet elsewhere
 * iff one of these two edges crosses the other triangle, and not in v (where its own triangle has no area). Two
 * vertices, corners not in one plane: their planes meet in the line through both, and so do they.
 *
 * In a plane, at one vertex each triangle is an angle, and they meet elsewhere iff one angle contains a side of the
 * other. With two vertices they do iff the other two corners are on the same side of the common edge. Both are seen
 * along an axis along which not all is in one line. If all corners are, some axis shows the order along the line. */
#include "kinetic/contact/encounter.h"

void neighbours_find(const motion_object *p, const motion_object *q, encounter *g) {
    g->shared_count = 0;
    for (int i = 0; i < 9; i++)
        if (p->vertices[i / 3] == q->vertices[i % 3]) {
            g->shared[0][g->shared_count] = i / 3;
            g->shared[1][g->shared_count++] = i % 3;
        }
}

static bool edge_has(int edge, int corner) {
    return corner == edge || corner == (edge + 1) % 3;
}

void neighbours_signs(const encounter *g, signed char sign[WALK_POLYNOMIALS], bool may_cross[6]) {
    for (int n = 0; n < g->shared_count; n++) {
        const int a = g->shared[0][n], b = g->shared[1][n];
        sign[SIDES + b] = sign[SIDES + 3 + a] = 0;
        for (int i = 0; i < 9; i++)
            if (edge_has(i / 3, a) && edge_has(i % 3, b)) sign[PASSES + i] = 0;
    }
    for (int edge = 0; edge < 6 && g->shared_count; edge++) { /* the one opposite of a single vertex */
        const int of = edge / 3;
        may_cross[edge] = g->shared_count == 1 && !edge_has(edge % 3, g->shared[of][0]);
    }
}

/* ------------------------------------------------------------------- in a plane -- */

/* Seen along an axis: the side of edge e of triangle `of` that a corner of the other is on. */
static int turn_of(const encounter *g, const walk_moment *at, int axis, int of, int e, int corner) {
    return walk_sign(g->arena, g->w, at, TURNS + 18 * axis + 9 * of + 3 * e + corner);
}

/* Not all corners are in one line, seen along that axis. */
static bool is_faithful(const encounter *g, const walk_moment *at, int axis) {
    for (int i = 0; i < 18; i++)
        if (walk_sign(g->arena, g->w, at, TURNS + 18 * axis + i)) return true;
    return false;
}

/* The sign of how far a corner of triangle `of` is along an axis, from shared vertex n. */
static int way_from(const encounter *g, const walk_moment *at, int axis, int of, int corner, int n) {
    const int i = of ? g->shared[0][n] : corner, j = of ? corner : g->shared[1][n];
    const int sign = walk_sign(g->arena, g->w, at, GAPS + 9 * axis + 3 * i + j);
    return of ? sign : -sign;
}

/* All being in one line: do corner i of the first and j of the second lie on the same side of all that is shared? */
static bool go_one_way(const encounter *g, const walk_moment *at, int i, int j) {
    for (int axis = 0; axis < 3; axis++) {
        const int way = way_from(g, at, axis, 0, i, 0);
        bool one = way != 0;
        for (int n = 0; n < g->shared_count && one; n++)
            one = way_from(g, at, axis, 0, i, n) == way && way_from(g, at, axis, 1, j, n) == way;
        if (one) return true;
    }
    return false;
}

static bool is_shared(const encounter *g, int of, int corner) {
    for (int n = 0; n < g->shared_count; n++)
        if (g->shared[of][n] == corner) return true;
    return false;
}

static bool line_meets(const encounter *g, const walk_moment *at) {
    for (int i = 0; i < 9; i++)
        if (!is_shared(g, 0, i / 3) && !is_shared(g, 1, i % 3) && go_one_way(g, at, i / 3, i % 3)) return true;
    return false;
}

/* Is corner c of the other triangle within the angle of triangle `of` at the one vertex that they share, and not in
 * it? Without area the angle is two sides, of one line. */
static bool angle_has(const encounter *g, const walk_moment *at, int axis, int of, int c) {
    const int v = g->shared[of][0], next = (v + 1) % 3, last = (v + 2) % 3;
    const int area = turn_of(g, at, axis, of, next, g->shared[!of][0]);
    const int first = turn_of(g, at, axis, of, v, c), second = turn_of(g, at, axis, of, last, c);
    if (area) return area * first >= 0 && area * second >= 0 && (first || second);
    return (!first && go_one_way(g, at, of ? c : next, of ? next : c)) ||
           (!second && go_one_way(g, at, of ? c : last, of ? last : c));
}

static bool angles_meet(const encounter *g, const walk_moment *at, int axis) {
    for (int of = 0; of < 2; of++)
        for (int i = 1; i < 3; i++)
            if (angle_has(g, at, axis, of, (g->shared[!of][0] + i) % 3)) return true;
    return false;
}

/* With two vertices: are the third corners on one side of the edge between these? */
static bool are_folded(const encounter *g, const walk_moment *at, int axis) {
    const int own = 3 - g->shared[0][0] - g->shared[0][1], other = 3 - g->shared[1][0] - g->shared[1][1];
    const int area = turn_of(g, at, axis, 0, (g->shared[0][0] + 1) % 3, g->shared[1][0]);
    return area * turn_of(g, at, axis, 0, (own + 1) % 3, other) > 0;
}

static bool flat_ones_meet(const encounter *g, const walk_moment *at) {
    for (int axis = 0; axis < 3; axis++)
        if (is_faithful(g, at, axis)) return g->shared_count == 1 ? angles_meet(g, at, axis) : are_folded(g, at, axis);
    return line_meets(g, at);
}

/* --------------------------------------------------------------------- in space -- */

/* An edge that crosses: does it so in the vertex that they share? Then it passes through both edges there. */
static bool crosses_in_vertex(const encounter *g, const walk_moment *at, int edge) {
    const int of = edge / 3, e = edge % 3, v = g->shared[!of][0];
    for (int i = 0; i < 3; i++) {
        const int pass = of ? PASSES + 3 * i + e : PASSES + 3 * e + i;
        if (edge_has(i, v) && walk_sign(g->arena, g->w, at, pass)) return false;
    }
    return true;
}

bool neighbours_meet(const encounter *g, const walk_moment *at) {
    if (g->shared_count == 3) return false;
    for (int edge = 0; edge < 6; edge++)
        if (g->may_cross[edge] && encounter_edge_crosses(g, at, edge) && !crosses_in_vertex(g, at, edge)) return true;
    return encounter_is_flat(g, at) && flat_ones_meet(g, at);
}
