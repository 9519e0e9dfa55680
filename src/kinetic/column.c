/* column.c: questions to a partition in space, straight up and down: the triangles above and below a point, and all
 * fragments as seen from above.
 *
 *         __________ ceiling        The tree of the triangles' edges, as seen from above, leads to the cell of a
 *        |    o     |               point; its surfaces tell the triangles above and below the point. What the point
 *        |__________|               lies on at the tick is looked for in all cells that have it at their border.
 *                    floor
 */
#include "base/floats.h"
#include "kinetic/kinetic.h"
#include "support/fail.h"
#include <math.h>

static froe_status check_column(froe_kinetic *k, froe_diagnostic *diag) {
    if (now_is_in_space(&k->now)) return kinetic_begin(k, diag);
    return support_fail(diag, FROE_E_UNSUPPORTED, "The partition is one of the plane, and has no heights.");
}

/* In which part of a node's cell the point is. A point on a border is taken as moved up in y, and by much less to the
 * left: it is behind the wall and above the edge. */
static int part_of_column(ktree *tree, const ktree_node *n, name_point point) {
    for (int side = 0; side < 2; side++) {
        if (n->wall[side] == KTREE_NO_WALL) continue;
        const int order = now_compare(tree->now, point, ktree_wall_name(tree, n->segment, n->wall[side]));
        if ((order < 0) == (side == KTREE_LEFT)) return side;
    }
    const bool surface = now_is_surface(tree->now, n->segment);
    const int where = surface ? now_over(tree->now, now_object_of(tree->now, n->segment), point.a)
                              : now_side(tree->now, n->segment, point.a);
    return where < 0 ? KTREE_DOWN : KTREE_UP;
}

/* ------------------------------------------------------------------- at the tick -- */

/* Is coordinate `axis` of a point between those of the corners? */
static bool is_between(num_arena *arena, const exact_point v[4], int axis) {
    bool before = false, behind = false;
    for (int i = 0; i < 3; i++) {
        const poly_exact *const at[3] = {&v[i].x, &v[i].y, &v[i].z}, *const own[3] = {&v[3].x, &v[3].y, &v[3].z};
        const int order = num_dyadic_compare(num_dyadic_mul(arena, at[axis]->c[0], v[3].w.c[0]),
                                             num_dyadic_mul(arena, own[axis]->c[0], v[i].w.c[0]));
        before = before || order <= 0;
        behind = behind || order >= 0;
    }
    return before && behind;
}

/* Does a triangle contain a point at the tick? It does iff they are in one plane, and it does so as seen along each
 * axis: one of these views is faithful, even if the triangle has no area. */
static bool triangle_has_point(now_state *now, uint32_t object, uint32_t vertex) {
    num_arena *arena = &now->context.arena;
    exact_point v[4];
    arena->top = 0;
    for (int i = 0; i < 3; i++) now_exact_at(now, now->faces.data[object].vertex[i], v + i);
    now_exact_at(now, vertex, v + 3);
    if (exact_volume_sign(arena, v)) return false;
    for (int axis = 0; axis < 3; axis++) {
        bool left = false, right = false;
        if (!is_between(arena, v, axis)) return false;
        for (int i = 0; i < 4; i++) v[i] = (exact_point){v[i].y, v[i].z, v[i].x, v[i].w}; /* another view */
        for (int i = 0; i < 3; i++) {
            const int turn = exact_turn_sign(arena, (exact_point[]){v[i], v[(i + 1) % 3], v[3]});
            left = left || turn > 0;
            right = right || turn < 0;
        }
        if (left && right) return false;
    }
    return true;
}

/* A triangle with an edge that contains the point. */
static uint32_t touched_at_edge(froe_kinetic *k, uint32_t edge, uint32_t vertex) {
    now_state *now = &k->now;
    for (uint32_t c = now->segments.data[edge].origin; c != FROE_NONE; c = now_next_corner(now, c))
        if (ktree_segment_at(&k->tree, now->faces.data[c / 3].surface)->here && triangle_has_point(now, c / 3, vertex))
            return c / 3;
    return FROE_NONE;
}

/* The same of an edge and all that are in one line with it, and hidden by it. */
static uint32_t touched_in_line(froe_kinetic *k, uint32_t edge, uint32_t vertex) {
    uint32_t found = touched_at_edge(k, edge, vertex);
    collinear_find_partners(k, edge);
    for (size_t i = 0; i < k->collinear.partners.count && found == FROE_NONE; i++)
        found = touched_at_edge(k, k->collinear.partners.data[i], vertex);
    return found;
}

/* Pushes the parts of a node's cell that the point is in at the tick, borders included. Is one of them the middle? */
static bool push_touched_parts(froe_kinetic *k, const ktree_node *n, name_point point) {
    bool middle = true;
    for (int side = 0; side < 2; side++) {
        if (n->wall[side] == KTREE_NO_WALL) continue;
        const name_point wall = ktree_wall_name(&k->tree, n->segment, n->wall[side]);
        int order = now_judge_order(&k->now, point, wall, false, false);
        if (order == POLY_PARALLEL) order = 0;  /* such lines cross anywhere */
        if (side == KTREE_LEFT) order = -order; /* > 0: outside */
        if (order >= 0) ktree_push_node(&k->tree, n->child[side]);
        middle = middle && order <= 0;
    }
    return middle;
}

/* A triangle that contains the point at the tick; FROE_NONE: there is none. */
static uint32_t touched_triangle(froe_kinetic *k, name_point point) {
    ktree *tree = &k->tree;
    now_state *now = &k->now;
    uint32_t found = FROE_NONE;
    tree->stack.count = 0;
    ktree_push_node(tree, ktree_node_at(tree, KTREE_ROOT)->child[0]);
    while (tree->stack.count && found == FROE_NONE && !k->call.stopped) {
        const ktree_node *n = ktree_node_at(tree, tree->stack.data[--tree->stack.count]);
        if (!push_touched_parts(k, n, point)) continue;
        int where = 0;
        if (now_is_surface(now, n->segment)) {
            const uint32_t object = now_object_of(now, n->segment), *v = now->faces.data[object].vertex;
            where =
                now_judge_volume(now, (uint32_t[]){v[0], v[1], v[2], point.a}, false) * now_judge_turn(now, v, false);
            if (!where && triangle_has_point(now, object, point.a)) found = object;
        } else {
            where = now_judge_side(now, n->segment, point.a, false);
            if (!where) found = touched_in_line(k, n->segment, point.a);
        }
        if (where >= 0) ktree_push_node(tree, n->child[KTREE_UP]);
        if (where <= 0) ktree_push_node(tree, n->child[KTREE_DOWN]);
    }
    return found;
}

froe_status froe_kinetic_locate_in_space(froe_kinetic *k, const double at[3], froe_kinetic_place *out,
                                         froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!k || !at || !out) return support_fail_null(diag, __func__);
    for (int i = 0; i < 3; i++)
        if (!isfinite(at[i]))
            return support_fail(diag, FROE_E_ARG, "A coordinate of the question is not a finite number.");
    froe_status status = check_column(k, diag);
    if (status) return status;
    ktree *tree = &k->tree;
    const name_point point = {k->now.segments.data[now_ask(&k->now, at, at)].end[0], NAME_VERTEX};
    froe_kinetic_place place = {FROE_NONE, FROE_NONE, FROE_NONE};
    k->now.tied = false;
    for (uint32_t x = ktree_node_at(tree, KTREE_ROOT)->child[0]; x;) {
        const ktree_node *n = ktree_node_at(tree, x);
        const int part = part_of_column(tree, n, point);
        const bool surface = now_is_surface(&k->now, n->segment);
        if (surface) *(part == KTREE_UP ? &place.below : &place.above) = now_object_of(&k->now, n->segment);
        x = n->child[part];
    }
    if (k->now.tied) place.on = touched_triangle(k, point);
    if (place.on != FROE_NONE) place.above = place.below = place.on;
    if (k->call.stopped) {
        k->call.stopped = false;
        return support_fail_memory(diag);
    }
    *out = place;
    return FROE_OK;
}

/* -------------------------------------------------------------------- layers -- */

/* The corners of a cell under its ceiling, counterclockwise from the lower left. */
static void trapezoid_under(now_state *now, const ktree_cell *cell, double out[8]) {
    for (int i = 0; i < 4; i++) {
        const name_point wall = cell->wall[i == 1 || i == 2];
        double at[2];
        now_place_near(now, wall, at);
        out[2 * i] = at[0];
        out[2 * i + 1] = now_height_near(now, i < 2 ? cell->bottom : cell->top, wall);
    }
}

froe_status froe_kinetic_layers(froe_kinetic *k, froe_kinetic_layers_fn *visit, void *user, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!k || !visit) return support_fail_null(diag, __func__);
    froe_status status = check_column(k, diag);
    if (status) return status;
    ktree *tree = &k->tree;
    const ktree_cell plane = ktree_plane();
    tree->visits.count = 0;
    ktree_push_visit(tree, ktree_node_at(tree, KTREE_ROOT)->child[0], &plane, false);
    while (tree->visits.count && !k->call.stopped) {
        const ktree_visit v = tree->visits.data[--tree->visits.count];
        const ktree_node *n = ktree_node_at(tree, v.node);
        const bool surface = now_is_surface(&k->now, n->segment);
        if (v.back) {
            double corners[8];
            trapezoid_under(&k->now, &v.cell, corners);
            if (!base_callback(visit(user, now_object_of(&k->now, n->segment), corners))) break;
            continue;
        }
        for (int slot = KTREE_LEFT; slot <= KTREE_DOWN; slot++) { /* what is below is on top of the stack */
            if (slot == KTREE_DOWN && surface) ktree_push_visit(tree, v.node, &v.cell, true);
            if (!n->child[slot]) continue;
            const ktree_cell inner = ktree_child_cell(tree, &v.cell, v.node, slot);
            ktree_push_visit(tree, n->child[slot], &inner, false);
        }
    }
    tree->visits.count = 0;
    if (!k->call.stopped) return FROE_OK;
    k->call.stopped = false;
    return support_fail_memory(diag);
}
