/* ask.c: questions about the present: where a point is, what a ray meets first, the order from back to front. They
 * are about the segments just after the tick; but a point is also on those that it lies on at the tick itself.
 *
 *        :  UP   :           A ray meets what is in the near part of a cell first, then the segment that cuts it,
 *   LEFT : __s___: RIGHT     then what is in the far part. The ray is a segment that takes no part, so that it is
 *        :  DOWN :           clipped by the predicates of all others. */
#include "base/floats.h"
#include "kinetic/kinetic.h"
#include "support/fail.h"
#include <math.h>

static froe_status check_question(froe_kinetic *k, const double *at, const double *to, const void *out,
                                  froe_diagnostic *diag) {
    if (!k || !at || !to || !out) return support_fail_null(diag, "a question to a kinetic partition");
    if (k->now.motion->dim == 3) return kinetic_refuse_space(diag);
    for (int i = 0; i < 2; i++)
        if (!isfinite(at[i]) || !isfinite(to[i]))
            return support_fail(diag, FROE_E_ARG, "A coordinate of the question is not a finite number.");
    return kinetic_begin(k, diag);
}

static name_point end_name(const now_state *now, uint32_t segment, int end) {
    return (name_point){now->segments.data[segment].end[end], NAME_VERTEX};
}

/* In which part of a node's cell a point of the cell is: KTREE_LEFT .. KTREE_DOWN; -1: on the segment. */
static int part_of(ktree *tree, const ktree_node *n, name_point point) {
    for (int side = 0; side < 2; side++) {
        if (n->wall[side] == KTREE_NO_WALL) continue;
        int order = now_compare(tree->now, point, ktree_wall_name(tree, n->segment, n->wall[side]));
        if (!order) return -1;
        if ((order < 0) == (side == KTREE_LEFT)) return side;
    }
    int where = now_side(tree->now, n->segment, point.a);
    return where ? (where > 0 ? KTREE_UP : KTREE_DOWN) : -1;
}

static froe_kinetic_place place_on(uint32_t segment) {
    return (froe_kinetic_place){segment, segment, segment};
}

/* Just after the tick. */
static froe_kinetic_place kinetic_place_of(ktree *tree, name_point point) {
    froe_kinetic_place place = {FROE_NONE, FROE_NONE, FROE_NONE};
    for (uint32_t x = ktree_node_at(tree, KTREE_ROOT)->child[0]; x;) {
        const ktree_node *n = ktree_node_at(tree, x);
        int part = part_of(tree, n, point);
        if (part < 0) return place_on(n->segment);
        if (part == KTREE_UP) place.below = n->segment;
        if (part == KTREE_DOWN) place.above = n->segment;
        x = n->child[part];
    }
    return place;
}

/* ------------------------------------------------------------------- at the tick -- */

/* A segment that the point lies on at the tick: one in the parts of cells that it is in then, borders included. There
 * may be other segments between the two just after the tick. */
static uint32_t touched_segment(froe_kinetic *k, name_point point) {
    ktree *tree = &k->tree;
    now_state *now = &k->now;
    tree->stack.count = 0;
    ktree_push_node(tree, ktree_node_at(tree, KTREE_ROOT)->child[0]);
    while (tree->stack.count && !k->call.stopped) {
        const ktree_node *n = ktree_node_at(tree, tree->stack.data[--tree->stack.count]);
        const uint32_t s = n->segment;
        bool middle = true;
        for (int side = 0; side < 2; side++) {
            if (n->wall[side] == KTREE_NO_WALL) continue;
            int order = now_judge_order(now, point, ktree_wall_name(tree, s, n->wall[side]), false, false);
            if (order == POLY_PARALLEL) order = 0;  /* such lines cross anywhere */
            if (side == KTREE_LEFT) order = -order; /* > 0: outside */
            if (order >= 0) ktree_push_node(tree, n->child[side]);
            middle = middle && order <= 0;
        }
        if (!middle) continue;
        const int where = now_judge_side(now, s, point.a, false);
        if (!where && now_judge_order(now, point, end_name(now, s, 0), false, true) *
                              now_judge_order(now, point, end_name(now, s, 1), false, true) <=
                          0)
            return s;
        if (where >= 0) ktree_push_node(tree, n->child[KTREE_UP]);
        if (where <= 0) ktree_push_node(tree, n->child[KTREE_DOWN]);
    }
    return FROE_NONE;
}

/* The status of an answer. Lack of memory leaves the tree as it was. */
static froe_status status_of_answer(kinetic_call *call, froe_diagnostic *diag) {
    if (!call->stopped) return FROE_OK;
    call->stopped = false;
    return support_fail_memory(diag);
}

froe_status froe_kinetic_locate(froe_kinetic *k, const double at[2], froe_kinetic_place *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    froe_status status = check_question(k, at, at, out, diag);
    if (status) return status;
    name_point point = end_name(&k->now, now_ask(&k->now, at, at), 0);
    k->now.tied = false;
    froe_kinetic_place place = kinetic_place_of(&k->tree, point);
    if (place.on == FROE_NONE && k->now.tied) {
        const uint32_t on = touched_segment(k, point);
        if (on != FROE_NONE) place = place_on(on);
    }
    status = status_of_answer(&k->call, diag);
    if (!status) *out = place;
    return status;
}

/* --------------------------------------------------------------------- rays -- */

/* The way through the parts of a node's cell, from behind so that the first is on top. `order` holds children, and
 * -1 for the segment itself: a visit on the way back. */
static void push_parts(ktree *tree, const ktree_visit *v, const int order[5]) {
    for (int i = 4; i >= 0; i--) {
        if (order[i] < 0) {
            ktree_push_visit(tree, v->node, &v->cell, true);
            continue;
        }
        if (order[i] < KTREE_UP && ktree_node_at(tree, v->node)->wall[order[i]] == KTREE_NO_WALL) continue;
        ktree_cell inner = ktree_child_cell(tree, &v->cell, v->node, order[i]);
        ktree_push_visit(tree, ktree_node_at(tree, v->node)->child[order[i]], &inner, false);
    }
}

/* Is p between the borders of the part of a cell where its segment is, borders included? */
static bool is_in_middle(ktree *tree, const ktree_visit *v, name_point p) {
    ktree_cell middle = ktree_child_cell(tree, &v->cell, v->node, KTREE_UP);
    return (!name_exists(middle.wall[KTREE_LEFT]) || now_compare(tree->now, p, middle.wall[KTREE_LEFT]) >= 0) &&
           (!name_exists(middle.wall[KTREE_RIGHT]) || now_compare(tree->now, p, middle.wall[KTREE_RIGHT]) <= 0);
}

/* Two segments in one line: do they overlap in the middle? */
static bool overlaps(froe_kinetic *k, const ktree_visit *v, uint32_t ray, uint32_t segment) {
    const uint32_t both[2] = {ray, segment};
    for (int i = 0; i < 2; i++)
        for (int side = 0; side < 2; side++) {
            name_point p = {now_vertex(&k->now, both[i], side), NAME_VERTEX};
            name_point left = {now_vertex(&k->now, both[1 - i], 0), NAME_VERTEX};
            name_point right = {now_vertex(&k->now, both[1 - i], 1), NAME_VERTEX};
            if (now_compare(&k->now, left, p) <= 0 && now_compare(&k->now, p, right) <= 0 &&
                is_in_middle(&k->tree, v, p))
                return true;
        }
    uint32_t end[2];
    ktree_cell line = ktree_child_cell(&k->tree, &v->cell, v->node, KTREE_UP);
    line.top = line.bottom = FROE_NONE; /* it may pass from wall to wall */
    return surgery_clip(k, ray, &line, end) && surgery_clip(k, segment, &line, end);
}

/* Does the ray meet the segment of a node in the middle part of its cell? */
static bool ray_meets_cell(froe_kinetic *k, const ktree_visit *v, uint32_t ray) {
    uint32_t segment = ktree_node_at(&k->tree, v->node)->segment;
    int side[2], other[2];
    for (int i = 0; i < 2; i++) {
        side[i] = now_side(&k->now, segment, now_vertex(&k->now, ray, i));
        other[i] = now_side(&k->now, ray, now_vertex(&k->now, segment, i));
    }
    if (side[0] * side[1] > 0 || other[0] * other[1] > 0) return false;
    if (!side[0] && !side[1]) return overlaps(k, v, ray, segment);
    return is_in_middle(&k->tree, v, name_crossing(ray, segment));
}

/* The parts in the order in which the ray comes to them. */
static void follow_ray(ktree *tree, const ktree_visit *v, uint32_t ray) {
    bool turned = tree->now->segments.data[ray].turned;
    uint32_t segment = ktree_node_at(tree, v->node)->segment;
    int from = now_side(tree->now, segment, tree->now->segments.data[ray].end[0]);
    if (!from) from = -now_side(tree->now, segment, tree->now->segments.data[ray].end[1]);
    int near = from > 0 ? KTREE_UP : KTREE_DOWN, far = KTREE_UP + KTREE_DOWN - near,
        in = turned ? KTREE_RIGHT : KTREE_LEFT, out = turned ? KTREE_LEFT : KTREE_RIGHT;
    uint32_t end = now_vertex(tree->now, segment, in);
    if (now_side(tree->now, ray, end)) /* else the ray comes to that end first of all */
        push_parts(tree, v, (int[]){in, near, -1, far, out});
    else
        push_parts(tree, v, (int[]){in, -1, near, far, out});
}

froe_status froe_kinetic_ray(froe_kinetic *k, const double from[2], const double to[2], uint32_t *hit,
                             froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    froe_status status = check_question(k, from, to, hit, diag);
    if (status) return status;
    uint32_t ray = now_ask(&k->now, from, to), found = kinetic_place_of(&k->tree, end_name(&k->now, ray, 0)).on, end[2];
    ktree_cell plane = ktree_plane();
    k->tree.visits.count = 0;
    /* a ray without length meets what its point is on */
    const bool seeks = found == FROE_NONE && now_compare(&k->now, end_name(&k->now, ray, 0), end_name(&k->now, ray, 1));
    if (seeks) ktree_push_visit(&k->tree, ktree_node_at(&k->tree, KTREE_ROOT)->child[0], &plane, false);
    while (k->tree.visits.count && found == FROE_NONE && !k->call.stopped) {
        ktree_visit v = k->tree.visits.data[--k->tree.visits.count];
        if (v.back) {
            if (ray_meets_cell(k, &v, ray)) found = ktree_node_at(&k->tree, v.node)->segment;
        } else if (surgery_clip(k, ray, &v.cell, end)) {
            follow_ray(&k->tree, &v, ray);
        }
    }
    k->tree.visits.count = 0;
    status = status_of_answer(&k->call, diag);
    if (!status) *hit = found;
    return status;
}

/* -------------------------------------------------------------------- order -- */

froe_status froe_kinetic_order(froe_kinetic *k, const double eye[2], froe_kinetic_order_fn *visit, void *user,
                               froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    froe_status status = check_question(k, eye, eye, (const void *)&visit, diag);
    if (!status && !visit) status = support_fail_null(diag, __func__);
    if (status) return status;
    name_point point = end_name(&k->now, now_ask(&k->now, eye, eye), 0);
    ktree_cell plane = ktree_plane();
    k->tree.visits.count = 0;
    ktree_push_visit(&k->tree, ktree_node_at(&k->tree, KTREE_ROOT)->child[0], &plane, false);
    while (k->tree.visits.count && !k->call.stopped) {
        ktree_visit v = k->tree.visits.data[--k->tree.visits.count];
        const ktree_node *n = ktree_node_at(&k->tree, v.node);
        if (v.back) { /* the fragment of its segment */
            double at[4];
            for (int i = 0; i < 2; i++) {
                const bool own = n->wall[i] != KTREE_NO_WALL;
                const name_point p = own ? ktree_wall_name(&k->tree, n->segment, n->wall[i]) : v.cell.wall[i];
                now_place_near(&k->now, p, at + 2 * i);
                if (!own) at[2 * i + 1] = now_height_near(&k->now, n->segment, p);
            }
            if (!base_callback(visit(user, n->segment, at))) break;
            continue;
        }
        int part = part_of(&k->tree, n, point);
        int side = now_side(&k->now, n->segment, point.a);
        int near = side < 0 ? KTREE_DOWN : KTREE_UP, far = KTREE_UP + KTREE_DOWN - near, order[3] = {far, -1, near};
        if (!side) order[1] = near, order[2] = -1; /* the eye is in its line: it may hide what is on both sides of it */
        if (part == KTREE_LEFT || part == KTREE_RIGHT)
            push_parts(&k->tree, &v, (int[]){KTREE_LEFT + KTREE_RIGHT - part, order[0], order[1], order[2], part});
        else
            push_parts(&k->tree, &v, (int[]){KTREE_LEFT, KTREE_RIGHT, order[0], order[1], order[2]});
    }
    k->tree.visits.count = 0;
    return status_of_answer(&k->call, diag);
}
