/* region.c: what bounds a region near an edge, and on which sides of its first point the region lies. */
#include "query/groups/region.h"
#include "query/segment.h"
#include "support/fail.h"
#include <string.h>

/* ------------------------------------------------------------------- lines -- */

static bool keep_line(query_groups_work *work, const froe_allocator *alloc, int which, const double *u, const double *v,
                      bool border) {
    query_line line = {.border = border};
    memcpy(line.u, u, sizeof line.u);
    memcpy(line.v, v, sizeof line.v);
    return array_push(alloc, &work->lines[which], line);
}

static const double *region_corner(const query_region *r, uint32_t i) {
    return r->corners + 2 * (size_t)(i < r->count ? i : i - r->count);
}

froe_status query_region_lines(const query_region *r, query_groups_work *work, const froe_allocator *alloc,
                               num_context *numbers, int which, const double *p, const double *q) {
    const double ends[4] = {p[0], p[1], q[0], q[1]};
    froe_range edge = froe_range_defaults();
    work->lines[which].count = 0;
    for (uint32_t i = 0; !r->query && i < (r->count > 2 ? r->count : 1); i++) {
        const double *u = region_corner(r, i), *v = region_corner(r, i + 1);
        if (query_segments_meet(numbers, p, q, u, v) && !keep_line(work, alloc, which, u, v, r->count > 2))
            return FROE_E_MEMORY;
    }
    if (!r->query) return FROE_OK;
    edge.shape = FROE_SHAPE_SEGMENT;
    edge.points = ends;
    if (query_range_ask(r->query, &edge, false, NULL)) return FROE_E_MEMORY;
    const froe_scene *s = r->query->tree->scene;
    for (size_t i = 0; i < r->query->found.count; i++) {
        const uint32_t object = r->query->found.data[i];
        if (s->groups[object] != r->group || scene_form(s, object) != FROE_SEGMENT) continue;
        if (!keep_line(work, alloc, which, scene_point(s, object, 0), scene_point(s, object, 1),
                       r->areas->roles[object] == AREA_BORDER))
            return FROE_E_MEMORY;
    }
    return FROE_OK;
}

/* ------------------------------------------------------------------ points -- */

static void bound_point(double box[4], const double *x) {
    for (int k = 0; k < 2; k++) {
        box[k] = x[k] < box[k] ? x[k] : box[k];
        box[2 + k] = x[k] > box[2 + k] ? x[k] : box[2 + k];
    }
}

froe_status query_region_near(const query_region *r, froe_query *other, froe_diagnostic *diag) {
    double box[4];
    froe_range window = froe_range_defaults();
    for (int k = 0; k < 2; k++) box[k] = (double)INFINITY, box[2 + k] = -(double)INFINITY;
    for (uint32_t i = 0; !r->query && i < r->count; i++) bound_point(box, r->corners + 2 * (size_t)i);
    for (uint32_t i = 0; r->query && i < query_roster_size(r->roster, r->group); i++) {
        double lo[2], hi[2];
        scene_object_bounds(r->query->tree->scene, query_roster_object(r->roster, r->group, i), lo, hi);
        bound_point(box, lo), bound_point(box, hi);
    }
    window.points = box;
    return query_range_ask(other, &window, false, diag);
}

froe_status query_region_has(const query_region *r, const double *x, bool *out, froe_diagnostic *diag) {
    const froe_status status = query_groups_at(r->query, r->areas, x, diag);
    *out = !status && query_members_has(&r->query->groups.inside, r->group);
    return status;
}

/* ------------------------------------------------------------------- turns -- */

/* Does x, which is not p, lie ahead of p in the direction of a, all three on one line? */
static bool is_ahead(const double *p, const double *a, const double *x) {
    const int k = a[0] == p[0];
    return (x[k] > p[k]) == (a[k] > p[k]);
}

/* How far the direction from p to x is turned left from that to a: 0 not at all, 1 less than half, 2 half, 3 more. */
static int turned_by(num_context *numbers, const double *p, const double *a, const double *x) {
    const int turn = query_turn(numbers, p, a, x);
    return turn ? 2 - turn : is_ahead(p, a, x) ? 0 : 2;
}

/* Turning left round p from just past `from` to just past `to`: is x passed? */
static bool is_passed(num_context *numbers, const double *p, const double *from, const double *to, const double *x) {
    const int far = turned_by(numbers, p, from, x), most = turned_by(numbers, p, from, to);
    if (far == 0 || far != most) return far && far < most;
    return far == 2 || query_turn(numbers, p, x, to) >= 0;
}

static bool is_same(const double *a, const double *b) {
    return a[0] == b[0] && a[1] == b[1];
}

/* Is p, which is an end of an edge, on a line that meets the edge? */
static bool is_on(num_context *numbers, const query_line *line, const double *p) {
    return query_segments_meet(numbers, line->u, line->v, p, p);
}

/* -------------------------------------------------------------------- sides -- */

/* Beside the edges of a convex polygon. A germ on an edge's line lies on the side to which it leaves it. */
static void sides_in_polygon(const query_region *r, num_context *numbers, const double *p, const double *q,
                             bool sides[2]) {
    sides[REGION_LEFT] = sides[REGION_RIGHT] = r->count > 2;
    for (uint32_t i = 0; r->count > 2 && i < r->count; i++) {
        const double *a = region_corner(r, i), *b = region_corner(r, i + 1);
        int side = query_turn(numbers, a, b, p);
        if (!side) side = query_turn(numbers, a, b, q);
        const int k = a[0] == b[0]; /* along the edge, the inner side is on the left of its direction */
        const bool along = (q[k] > p[k]) == (b[k] > a[k]);
        sides[REGION_LEFT] &= side ? side > 0 : along;
        sides[REGION_RIGHT] &= side ? side > 0 : !along;
    }
}

/* From the germ beside `from` at p, on the same side or not as the groups know, to those beside q. */
static void turn_to_edge(num_context *numbers, const query_line *lines, size_t count, const double *from,
                         const double *p, const double *q, bool sides[2]) {
    bool left = false, along = false;
    for (size_t i = 0; i < count; i++) {
        if (!lines[i].border || !is_on(numbers, lines + i, p)) continue;
        const double *ends[2] = {lines[i].u, lines[i].v};
        for (int end = 0; end < 2; end++) {
            if (is_same(ends[end], p)) continue;
            left ^= is_passed(numbers, p, from, q, ends[end]);
            along ^= turned_by(numbers, p, q, ends[end]) == 0;
        }
    }
    sides[REGION_LEFT] ^= left;
    sides[REGION_RIGHT] ^= left ^ along;
}

froe_status query_region_sides(const query_region *r, num_context *numbers, const query_line *lines, size_t count,
                               const double *p, const double *q, bool sides[2]) {
    if (!r->query) return sides_in_polygon(r, numbers, p, q, sides), FROE_OK;
    froe_query *t = r->query;
    query_leaf leaf;
    bool touching = false;
    sides[REGION_LEFT] = sides[REGION_RIGHT] = false;
    if (!r->areas->borders) return FROE_OK;
    for (size_t i = 0; i < count && !touching; i++) touching = lines[i].border && is_on(numbers, lines + i, p);
    t->groups.inside.count = t->groups.touched.count = 0;
    /* one way: while areas were made leaves were found, and all that this needs is kept */
    if (query_leaf_find(t, p, &leaf)) return FROE_E_MEMORY;
    if (query_areas_enter(t, r->areas, &leaf, p)) return FROE_E_MEMORY;
    if (touching && !t->groups.from) { /* the set of a cell, which does not say from where */
        t->groups.inside.count = 0;
        t->groups.from = r->areas->outside;
        if (query_areas_travel(t, r->areas, r->areas->outside, p, NULL)) return FROE_E_MEMORY;
    }
    sides[REGION_LEFT] = sides[REGION_RIGHT] = query_members_has(&t->groups.inside, r->group);
    if (touching) turn_to_edge(numbers, lines, count, t->groups.from, p, q, sides);
    return FROE_OK;
}
