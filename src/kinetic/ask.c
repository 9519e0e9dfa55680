/* ask.c: questions about the present: where a point is, what a ray meets first, the order from back to front. They
 * are about the segments just after the tick; but a point is also on those that it lies on at the tick itself.
 *
 *        :  UP   :           A ray meets what is in the near part of a cell first, then the segment that cuts it,
 *   LEFT : __s___: RIGHT     then what is in the far part. The ray is a segment that takes no part, so that it is
 *        :  DOWN :           clipped by the predicates of all others. */
#include "base/floats.h"
#include "kinetic/live.h"
#include "support/fail.h"
#include <math.h>

static froe_status check_question(froe_kinetic *k, const double *at, const double *to, const void *out,
                                  froe_diagnostic *diag) {
    if (!k || !at || !to || !out) return support_fail(diag, FROE_E_ARG, "a question to a kinetic partition: NULL");
    for (int i = 0; i < 2; i++)
        if (!isfinite(at[i]) || !isfinite(to[i]))
            return support_fail(diag, FROE_E_ARG, "a coordinate is NaN or infinite");
    return live_begin(k, diag);
}

static now_name end_name(const froe_kinetic *k, uint32_t segment, int end) {
    return (now_name){k->now.segments.data[segment].end[end], NAME_VERTEX};
}

/* In which part of a node's cell a point of the cell is: LEFT .. DOWN; -1: on the segment. */
static int part_of(froe_kinetic *k, const live_node *n, now_name point) {
    for (int side = 0; side < 2; side++) {
        if (n->wall[side] == END_NONE) continue;
        int order = now_compare(&k->now, point, wall_name(k, n->segment, n->wall[side]));
        if (!order) return -1;
        if ((order < 0) == (side == LEFT)) return side;
    }
    int where = now_side(&k->now, n->segment, point.a);
    return where ? (where > 0 ? UP : DOWN) : -1;
}

static froe_kinetic_place place_on(uint32_t segment) {
    return (froe_kinetic_place){segment, segment, segment};
}

/* Just after the tick. */
static froe_kinetic_place kinetic_place_of(froe_kinetic *k, now_name point) {
    froe_kinetic_place place = {FROE_NONE, FROE_NONE, FROE_NONE};
    for (uint32_t x = node_at(k, ROOT)->child[0]; x;) {
        const live_node *n = node_at(k, x);
        int part = part_of(k, n, point);
        if (part < 0) return place_on(n->segment);
        if (part == UP) place.below = n->segment;
        if (part == DOWN) place.above = n->segment;
        x = n->child[part];
    }
    return place;
}

/* ------------------------------------------------------------------- at the tick -- */

/* Of a point on the line of a segment. */
static bool reaches(froe_kinetic *k, uint32_t segment, now_name point) {
    return now_judge_order(&k->now, point, end_name(k, segment, 0), false, true) *
               now_judge_order(&k->now, point, end_name(k, segment, 1), false, true) <=
           0;
}

static void visit_node(froe_kinetic *k, uint32_t node) {
    if (node && !array_push(&k->alloc, &k->order, node)) k->short_of_memory = true;
}

/* The parts of a node's cell that the point is in at the tick, borders included, are to be visited. Lines that are
 * parallel at the tick cross anywhere. True: the point is on the segment of the node. */
static bool visit_parts(froe_kinetic *k, uint32_t node, now_name point) {
    const live_node *n = node_at(k, node);
    bool middle = true;
    for (int side = 0; side < 2; side++) {
        if (n->wall[side] == END_NONE) continue;
        int order = now_judge_order(&k->now, point, wall_name(k, n->segment, n->wall[side]), false, false);
        if (order == POLY_PARALLEL) order = 0;
        if (side == LEFT) order = -order; /* > 0: outside */
        if (order >= 0) visit_node(k, n->child[side]);
        middle = middle && order <= 0;
    }
    if (!middle) return false;
    const int where = now_judge_side(&k->now, n->segment, point.a, false);
    if (!where && reaches(k, n->segment, point)) return true;
    if (where >= 0) visit_node(k, n->child[UP]);
    if (where <= 0) visit_node(k, n->child[DOWN]);
    return false;
}

/* A segment that the point lies on at the tick. There may be other segments between the two just after it. */
static uint32_t touched(froe_kinetic *k, now_name point) {
    k->order.count = 0;
    visit_node(k, node_at(k, ROOT)->child[0]);
    while (k->order.count && !k->short_of_memory) {
        const uint32_t node = k->order.data[--k->order.count];
        if (visit_parts(k, node, point)) return node_at(k, node)->segment;
    }
    return FROE_NONE;
}

/* The status of an answer. Lack of memory leaves the tree as it was. */
static froe_status status_of_answer(froe_kinetic *k, froe_diagnostic *diag) {
    if (!k->short_of_memory) return FROE_OK;
    k->short_of_memory = false;
    return support_fail_memory(diag);
}

froe_status froe_kinetic_locate(froe_kinetic *k, const double at[2], froe_kinetic_place *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    froe_status status = check_question(k, at, at, out, diag);
    if (status) return status;
    now_name point = end_name(k, now_ask(&k->now, at, at), 0);
    k->now.tied = false;
    froe_kinetic_place place = kinetic_place_of(k, point);
    if (place.on == FROE_NONE && k->now.tied) {
        const uint32_t on = touched(k, point);
        if (on != FROE_NONE) place = place_on(on);
    }
    status = status_of_answer(k, diag);
    if (!status) *out = place;
    return status;
}

/* --------------------------------------------------------------------- rays -- */

/* What is left to be done, in a stack: a subtree, or the segment of a node. */
static void push_visit(froe_kinetic *k, uint32_t node, const live_cell *cell, bool segment) {
    live_visit v = {*cell, node, segment};
    if (node && !array_push(&k->alloc, &k->visits, v)) k->short_of_memory = true;
}

/* The way through the parts of a node's cell, from behind so that the first is on top. `order` holds children, and
 * -1 for the segment itself. */
static void push_parts(froe_kinetic *k, const live_visit *v, const int order[5]) {
    for (int i = 4; i >= 0; i--) {
        if (order[i] < 0) {
            push_visit(k, v->node, &v->cell, true);
            continue;
        }
        if (order[i] < UP && node_at(k, v->node)->wall[order[i]] == END_NONE) continue;
        live_cell inner = live_child_cell(k, &v->cell, v->node, order[i]);
        push_visit(k, node_at(k, v->node)->child[order[i]], &inner, false);
    }
}

/* Is p between the borders of the part of a cell where its segment is, borders included? */
static bool is_in_middle(froe_kinetic *k, const live_visit *v, now_name p) {
    live_cell middle = live_child_cell(k, &v->cell, v->node, UP);
    return (!name_exists(middle.wall[LEFT]) || now_compare(&k->now, p, middle.wall[LEFT]) >= 0) &&
           (!name_exists(middle.wall[RIGHT]) || now_compare(&k->now, p, middle.wall[RIGHT]) <= 0);
}

/* Two segments in one line: do they overlap in the middle? */
static bool overlaps(froe_kinetic *k, const live_visit *v, uint32_t ray, uint32_t segment) {
    const uint32_t both[2] = {ray, segment};
    for (int i = 0; i < 2; i++)
        for (int side = 0; side < 2; side++) {
            now_name p = {now_vertex(&k->now, both[i], side), NAME_VERTEX};
            now_name left = {now_vertex(&k->now, both[1 - i], 0), NAME_VERTEX};
            now_name right = {now_vertex(&k->now, both[1 - i], 1), NAME_VERTEX};
            if (now_compare(&k->now, left, p) <= 0 && now_compare(&k->now, p, right) <= 0 && is_in_middle(k, v, p))
                return true;
        }
    uint32_t end[2];
    live_cell line = live_child_cell(k, &v->cell, v->node, UP);
    line.top = line.bottom = FROE_NONE; /* it may pass from wall to wall */
    return live_clip(k, ray, &line, end) && live_clip(k, segment, &line, end);
}

/* Does the ray meet the segment of a node in the middle part of its cell? */
static bool ray_meets_cell(froe_kinetic *k, const live_visit *v, uint32_t ray) {
    uint32_t segment = node_at(k, v->node)->segment;
    int side[2], other[2];
    for (int i = 0; i < 2; i++) {
        side[i] = now_side(&k->now, segment, now_vertex(&k->now, ray, i));
        other[i] = now_side(&k->now, ray, now_vertex(&k->now, segment, i));
    }
    if (side[0] * side[1] > 0 || other[0] * other[1] > 0) return false;
    if (!side[0] && !side[1]) return overlaps(k, v, ray, segment);
    return is_in_middle(k, v, name_crossing(ray, segment));
}

/* The parts in the order in which the ray comes to them. */
static void follow_ray(froe_kinetic *k, const live_visit *v, uint32_t ray) {
    bool turned = k->now.segments.data[ray].turned;
    uint32_t segment = node_at(k, v->node)->segment;
    int from = now_side(&k->now, segment, k->now.segments.data[ray].end[0]);
    if (!from) from = -now_side(&k->now, segment, k->now.segments.data[ray].end[1]);
    int near = from > 0 ? UP : DOWN, far = UP + DOWN - near, in = turned ? RIGHT : LEFT, out = turned ? LEFT : RIGHT;
    uint32_t end = now_vertex(&k->now, segment, in);
    if (now_side(&k->now, ray, end)) /* else the ray comes to that end first of all */
        push_parts(k, v, (int[]){in, near, -1, far, out});
    else
        push_parts(k, v, (int[]){in, -1, near, far, out});
}

/* A ray without length: is the point on something? */
static bool is_point(froe_kinetic *k, uint32_t ray) {
    return !now_compare(&k->now, end_name(k, ray, 0), end_name(k, ray, 1));
}

froe_status froe_kinetic_ray(froe_kinetic *k, const double from[2], const double to[2], uint32_t *hit,
                             froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    froe_status status = check_question(k, from, to, hit, diag);
    if (status) return status;
    uint32_t ray = now_ask(&k->now, from, to), found = kinetic_place_of(k, end_name(k, ray, 0)).on, end[2];
    live_cell plane = live_plane();
    k->visits.count = 0;
    if (found == FROE_NONE && !is_point(k, ray)) push_visit(k, node_at(k, ROOT)->child[0], &plane, false);
    while (k->visits.count && found == FROE_NONE && !k->short_of_memory) {
        live_visit v = k->visits.data[--k->visits.count];
        if (v.back) {
            if (ray_meets_cell(k, &v, ray)) found = node_at(k, v.node)->segment;
        } else if (live_clip(k, ray, &v.cell, end)) {
            follow_ray(k, &v, ray);
        }
    }
    k->visits.count = 0;
    status = status_of_answer(k, diag);
    if (!status) *hit = found;
    return status;
}

/* -------------------------------------------------------------------- order -- */

static bool tell_fragments(froe_kinetic *k, const live_visit *v, froe_kinetic_order_fn *visit, void *user) {
    const live_node *n = node_at(k, v->node);
    double at[4];
    for (int side = 0; side < 2; side++) {
        const bool own = n->wall[side] != END_NONE;
        const now_name p = own ? wall_name(k, n->segment, n->wall[side]) : v->cell.wall[side];
        now_place_near(&k->now, p, at + 2 * side);
        if (!own) at[2 * side + 1] = now_height_near(&k->now, n->segment, p);
    }
    return base_callback(visit(user, n->segment, at));
}

froe_status froe_kinetic_order(froe_kinetic *k, const double eye[2], froe_kinetic_order_fn *visit, void *user,
                               froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    froe_status status = check_question(k, eye, eye, (const void *)&visit, diag);
    if (!status && !visit) status = support_fail(diag, FROE_E_ARG, "froe_kinetic_order: NULL");
    if (status) return status;
    now_name point = end_name(k, now_ask(&k->now, eye, eye), 0);
    live_cell plane = live_plane();
    k->visits.count = 0;
    push_visit(k, node_at(k, ROOT)->child[0], &plane, false);
    while (k->visits.count && !k->short_of_memory) {
        live_visit v = k->visits.data[--k->visits.count];
        if (v.back) {
            if (!tell_fragments(k, &v, visit, user)) break;
            continue;
        }
        int part = part_of(k, node_at(k, v.node), point);
        int side = now_side(&k->now, node_at(k, v.node)->segment, point.a);
        int near = side < 0 ? DOWN : UP, far = UP + DOWN - near, order[3] = {far, -1, near};
        if (!side) order[1] = near, order[2] = -1; /* the eye is in its line: it may hide what is on both sides of it */
        if (part == LEFT || part == RIGHT)
            push_parts(k, &v, (int[]){LEFT + RIGHT - part, order[0], order[1], order[2], part});
        else
            push_parts(k, &v, (int[]){LEFT, RIGHT, order[0], order[1], order[2]});
    }
    k->visits.count = 0;
    return status_of_answer(k, diag);
}
