/* overlay.c: does a region lie in another one?
 *
 *     edge p ----+=========+--------+------ q      of either region
 *     inner  left  1 1 1 1 1 0 0 0 0 0             Where the inner region lies on a side of the edge, the outer one has
 *     inner right  0 0 0 0 0 0 0 0 0 0             to lie there, too; and a point of the inner region's own edge
 *     outer  left  1 1 1 1 1 1 1 1 0 0             needs the outer one on one of its sides, or a segment of it there.
 *     outer right  1 1 0 0 0 0 0 1 0 0
 *
 * If some of the inner region were missing in the outer one, what is missing would be bounded by pieces of edges of the
 * two, and would lie on one side of such a piece. So it is enough to follow all edges of the inner region, and those of
 * the outer one near it (as overlays of maps do, but edge by edge: Kriegel, Brinkhoff, Schneider: An efficient map
 * overlay algorithm, 1992). Along an edge, sides change where borders cross the edge's copies that are shifted to the
 * left and to the right by an infinitesimal amount. Places on the edge are compared exactly, and never computed. */
#include "query/groups/region.h"
#include "query/heap.h"
#include "query/segment.h"
#include "support/fail.h"

enum { INNER, OUTER };
/* Flips of an event, and the state of an edge: two bits for each region. */
enum { SIDE_LEFT = 1, SIDE_RIGHT = 2, SIDES = 3, OUTER_SHIFT = 2 };

typedef struct overlay {
    const query_region *regions[2];
    query_groups_work *work;
    const froe_allocator *alloc;
    num_context *numbers;
    const double *p, *q; /* the edge that is followed */
    unsigned state;      /* SIDE_ bits of the inner region, those of the outer one above */
    int cover;           /* segments of the outer group that lie on the edge here */
} overlay;

/* ------------------------------------------------------------------ places -- */

static geom_plane line_of(const query_event *e) {
    return geom_plane_points(2, (const double *const[]){e->u, e->v});
}

/* Is x, on the line of the edge, further on than y (1), or less far (-1)? */
static int compare_points(const overlay *o, const double *x, const double *y) {
    const int k = o->p[0] == o->q[0];
    const int order = (x[k] > y[k]) - (x[k] < y[k]);
    return o->q[k] > o->p[k] ? order : -order;
}

/* The side of event a beside the line of b, 1 where what lies further along the edge than b is. */
static int side_of_event(const overlay *o, const query_event *a, const query_event *b) {
    const int ahead = query_turn(o->numbers, b->u, b->v, o->q);
    if (a->vertex) return ahead * query_turn(o->numbers, b->u, b->v, a->u);
    const geom_plane at = line_of(a), beside = line_of(b);
    return ahead * geom_side_crossing(o->numbers, &beside, o->p, o->q, &at);
}

/* Is event a further along the edge than b (1), less far (-1), or at one place with it? */
static int compare_events(const overlay *o, const query_event *a, const query_event *b) {
    if (!b->vertex) return side_of_event(o, a, b);
    return a->vertex ? compare_points(o, a->u, b->u) : -side_of_event(o, b, a);
}

static bool is_later(void *user, uint32_t a, uint32_t b) {
    const overlay *o = user;
    const query_event *events = o->work->events.data;
    return compare_events(o, events + a, events + b) > 0;
}

/* ------------------------------------------------------------------ events -- */

static bool put_event(overlay *o, const double *u, const double *v, unsigned flips, int cover) {
    query_event e = {.u = {u[0], u[1]}, .vertex = !v, .flips = (uint8_t)flips, .cover = (int8_t)cover};
    if (v) e.v[0] = v[0], e.v[1] = v[1];
    return array_push(o->alloc, &o->work->order, (uint32_t)o->work->events.count) &&
           array_push(o->alloc, &o->work->events, e);
}

/* A segment on the line of the edge covers it from one place to another. */
static bool add_overlap(overlay *o, const query_line *line) {
    const bool forward = compare_points(o, line->u, line->v) < 0;
    const double *first = forward ? line->u : line->v, *last = forward ? line->v : line->u;
    const bool begun = compare_points(o, first, o->p) <= 0;
    if (compare_points(o, last, o->p) <= 0 || compare_points(o, first, o->q) >= 0) return true;
    if (begun) o->cover++;
    return (begun || put_event(o, first, NULL, 0, 1)) &&
           (compare_points(o, last, o->q) >= 0 || put_event(o, last, NULL, 0, -1));
}

/* What happens between the ends of the edge where a segment that meets it does. What happens at p is known there. */
static bool add_line(overlay *o, const query_line *line, int which) {
    const int u = query_turn(o->numbers, o->p, o->q, line->u), v = query_turn(o->numbers, o->p, o->q, line->v);
    const double *const at = !u ? line->u : line->v;
    if (!u && !v) return which == INNER || add_overlap(o, line);
    if (!line->border) return true;
    const unsigned sides = ((u > 0) != (v > 0) ? SIDE_LEFT : 0) | ((u < 0) != (v < 0) ? SIDE_RIGHT : 0);
    const unsigned flips = which == OUTER ? sides << OUTER_SHIFT : sides;
    if (u && v) /* the line crosses that of the edge between u and v */
        return !query_turn(o->numbers, line->u, line->v, o->p) || !query_turn(o->numbers, line->u, line->v, o->q) ||
               put_event(o, line->u, line->v, flips, 0);
    return compare_points(o, at, o->p) <= 0 || compare_points(o, at, o->q) >= 0 || put_event(o, at, NULL, flips, 0);
}

/* --------------------------------------------------------------- following -- */

static froe_status enter_edge(overlay *o, int which) {
    const query_region *r = o->regions[which];
    bool sides[2];
    if (query_region_lines(r, o->work, o->alloc, o->numbers, which, o->p, o->q) ||
        query_region_sides(r, o->numbers, o->work->lines[which].data, o->work->lines[which].count, o->p, o->q, sides))
        return FROE_E_MEMORY;
    const unsigned bits = (sides[REGION_LEFT] ? SIDE_LEFT : 0) | (sides[REGION_RIGHT] ? SIDE_RIGHT : 0);
    o->state |= which == OUTER ? bits << OUTER_SHIFT : bits;
    return FROE_OK;
}

/* Is all of the inner region here in the outer one, too? */
static bool is_good(const overlay *o, bool own) {
    const unsigned inner = o->state & SIDES, outer = o->state >> OUTER_SHIFT;
    return !(inner & ~outer) && (!own || outer || o->cover);
}

/* Follows an edge, which is one of the inner region's own or not: *good, is nothing of the inner region missing along
 * it? */
static froe_status follow_edge(overlay *o, const double *p, const double *q, bool own, bool *good) {
    query_groups_work *w = o->work;
    o->p = p, o->q = q;
    o->state = 0, o->cover = 0;
    w->events.count = w->order.count = 0;
    *good = true;
    if (enter_edge(o, INNER)) return FROE_E_MEMORY;
    if (!own && !o->state && !w->lines[INNER].count) return FROE_OK; /* far away */
    if (enter_edge(o, OUTER)) return FROE_E_MEMORY;
    for (int which = INNER; which <= OUTER; which++)
        for (size_t i = 0; i < w->lines[which].count; i++)
            if (!add_line(o, w->lines[which].data + i, which)) return FROE_E_MEMORY;
    const uint32_t *order = w->order.data;
    const size_t count = w->order.count;
    query_heap_sort(w->order.data, count, is_later, o);
    for (size_t i = 0; (*good = is_good(o, own)) && i < count;) {
        const query_event *first = w->events.data + order[i];
        do {
            const query_event *e = w->events.data + order[i];
            o->state ^= e->flips;
            o->cover += e->cover;
        } while (++i < count && compare_events(o, w->events.data + order[i], first) == 0);
    }
    return FROE_OK;
}

/* ------------------------------------------------------------------ edges -- */

static bool is_solid(const query_region *r, uint32_t object) {
    return r->areas->roles[object] == AREA_SOLID;
}

static froe_status refuse_solid(const query_region *r, uint32_t object, froe_diagnostic *diag) {
    return support_fail_at(diag, FROE_E_UNSUPPORTED, object, FROE_NONE, FROE_NONE,
                           "group %u (%.80s): What it covers or lies in is told of segments and points only, and "
                           "object %u is neither.",
                           r->group, froe_scene_group(r->query->tree->scene, r->group).name, object);
}

static froe_status follow_inner(overlay *o, bool *good, froe_diagnostic *diag) {
    const query_region *r = o->regions[INNER];
    froe_status status = FROE_OK;
    for (uint32_t i = 0; !r->query && *good && !status && i < (r->count > 2 ? r->count : 1); i++) {
        const double *p = r->corners + 2 * (size_t)i, *q = r->corners + (i + 1 < r->count ? 2 * (size_t)(i + 1) : 0);
        status = follow_edge(o, p, q, true, good);
    }
    for (uint32_t i = 0; r->query && *good && !status && i < query_roster_size(r->roster, r->group); i++) {
        const froe_scene *s = r->query->tree->scene;
        const uint32_t object = query_roster_object(r->roster, r->group, i);
        if (is_solid(r, object)) return refuse_solid(r, object, diag);
        const double *p = scene_point(s, object, 0), *q = scene_point(s, object, scene_corners(s, object) - 1);
        status = p[0] == q[0] && p[1] == q[1] ? query_region_has(o->regions[OUTER], p, good, diag)
                                              : follow_edge(o, p, q, true, good);
    }
    return status;
}

/* Finds the objects of the outer group within the bounds of the inner one. */
static froe_status find_near(overlay *o) {
    const query_region *outer = o->regions[OUTER];
    o->work->near.count = 0;
    if (query_region_near(o->regions[INNER], outer->query, NULL)) return FROE_E_MEMORY;
    for (size_t i = 0; i < outer->query->found.count; i++) {
        const uint32_t object = outer->query->found.data[i];
        if (outer->query->tree->scene->groups[object] == outer->group && !array_push(o->alloc, &o->work->near, object))
            return FROE_E_MEMORY;
    }
    return FROE_OK;
}

static froe_status follow_outer(overlay *o, bool *good) {
    const query_region *r = o->regions[OUTER];
    const froe_scene *s = r->query->tree->scene;
    froe_status status = FROE_OK;
    for (size_t i = 0; *good && !status && i < o->work->near.count; i++) {
        const uint32_t object = o->work->near.data[i];
        if (r->areas->roles[object] != AREA_BORDER) continue;
        const double *p = scene_point(s, object, 0), *q = scene_point(s, object, 1);
        status = follow_edge(o, p, q, false, good); /* segments without length are points, and no borders */
    }
    return status;
}

froe_status query_region_inside(const query_region *inner, const query_region *outer, bool *out,
                                froe_diagnostic *diag) {
    froe_query *q = outer->query;
    overlay o = {.regions = {inner, outer}, .work = &q->work, .alloc = &q->alloc, .numbers = &q->numbers};
    *out = true;
    froe_status status = follow_inner(&o, out, diag);
    if (status == FROE_E_UNSUPPORTED) return status;
    if (!status) status = find_near(&o);
    if (!status) status = follow_outer(&o, out);
    if (status) return support_fail_memory(diag);
    for (size_t i = 0; !*out && i < q->work.near.count; i++)
        if (is_solid(outer, q->work.near.data[i])) return refuse_solid(outer, q->work.near.data[i], diag);
    return FROE_OK;
}
