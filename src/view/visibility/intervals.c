/* intervals.c: the visible stretches of an edge or wire, in exact order, joined where they touch or overlap.
 *
 * The end X = l x m of a stretch of the edge with line l lies before Y = l x n, seen along the edge, when
 * det(l, m, n) > 0, that is when X is on the positive side of n. */
#include "base/sort.h"
#include "geom/predicates.h"
#include "view/visibility/visibility.h"
#include <string.h>

/* b is a meeting. */
int view_compare_along(view_sightlines *s, uint32_t line, const view_end *a, const view_end *b) {
    const int side = view_side(s, b->way >> 1, &a->ray, a->vertex, 2 * line, a->way);
    return b->way & 1 ? side : -side;
}

int view_compare_ends(view_sightlines *s, uint32_t line, const view_end *a, const view_end *b) {
    if (b->vertex == FROE_NONE) return view_compare_along(s, line, a, b);
    if (a->vertex == FROE_NONE) return -view_compare_along(s, line, b, a);
    return view_compare_vertices(s, line, a->vertex, b->vertex);
}

view_end view_end_at(view_sightlines *s, uint32_t line, view_mark mark) {
    if (mark.vertex != FROE_NONE) return (view_end){.ray = view_ray(s, mark.vertex), .vertex = mark.vertex};
    return (view_end){view_meeting(s, 2 * line, mark.way), FROE_NONE, mark.way};
}

froe_status view_rest_of_edge(froe_visibility *v, uint32_t edge, view_stretch *out, bool *there) {
    view_sightlines *s = &v->sights;
    const uint32_t *vertices = s->surface->vertices + 2 * (size_t)edge;
    view_mark mark[2] = {{.vertex = vertices[0]}, {.vertex = vertices[1]}};
    *there = false;
    if (view_is_point(s, edge)) return FROE_OK;
    const uint32_t line = view_line_of_edge(s, edge);
    if (line == FROE_NONE) return FROE_E_MEMORY;
    if (v->section) {
        const geom_plane plane = view_plane_at(s, FROE_NONE);
        int side[2];
        for (int e = 0; e < 2; e++)
            side[e] = v->section * geom_side_vertex(&s->context, &plane, view_vertex(s, vertices[e]));
        if (side[0] <= 0 && side[1] <= 0 && (side[0] || side[1])) return FROE_OK;
        if (side[0] * side[1] < 0 && view_stop_edge(s, edge, FROE_NONE, line, &mark[side[1] < 0])) return FROE_E_MEMORY;
    }
    *out = (view_stretch){edge, {view_end_at(s, line, mark[0]), view_end_at(s, line, mark[1])}};
    *there = view_cut_to_window(s, line, out);
    return FROE_OK;
}

/* ------------------------------------------------------------------- parameters -- */

/* t with h(u + t (v - u)) = 0: all rays of a picture have the same scale, so that h is linear along the edge. */
double view_share_of(view_sightlines *s, uint32_t edge, view_mark mark) {
    const uint32_t *v = s->surface->vertices + 2 * (size_t)edge;
    if (mark.vertex != FROE_NONE) return mark.vertex == v[1];
    const filter_vector *h = &s->lines.data[mark.way >> 1].image;
    const filter_vector u_ray = view_ray(s, v[0]), v_ray = view_ray(s, v[1]);
    const num_ball at_u = filter_dot(h, &u_ray), at_v = filter_dot(h, &v_ray);
    const num_ball t = filter_div(at_u, filter_sub(at_u, at_v));
    const double x = t.e <= 0x1p-40 ? t.x : view_share_round(s, mark.way >> 1, v[0], v[1]);
    return x < 0 ? 0 : x > 1 ? 1 : x;
}

/* ---------------------------------------------------------------------- joining -- */

/* Where a stretch of an edge ends: at a vertex of it, if that is there, however the end was found. Cuts of the tree go
 * through vertices, and lines are chained at these. */
static view_mark mark_on_edge(view_sightlines *s, uint32_t edge, uint32_t line, const view_end *end, int side) {
    const uint32_t vertex = s->surface->vertices[2 * (size_t)edge + (uint32_t)side];
    const view_end own = {.ray = view_ray(s, vertex), .vertex = vertex};
    const bool same = end->vertex == FROE_NONE && view_compare_along(s, line, &own, end) == 0;
    return view_mark_of(same ? &own : end);
}

typedef struct interval_joiner {
    froe_visibility *v;
    uint32_t edge, line;
    ARRAY(view_end) ends; /* of the stretches of the edge, two each */
    ARRAY(uint32_t) order;
} interval_joiner;

static int by_interval_start(void *user, uint32_t a, uint32_t b) {
    interval_joiner *j = user;
    return view_compare_ends(&j->v->sights, j->line, &j->ends.data[2 * (size_t)a], &j->ends.data[2 * (size_t)b]);
}

/* Appends an interval; rounding keeps the order. */
static void put_interval(interval_joiner *j, const view_end *from, const view_end *to, double *last) {
    froe_visibility *v = j->v;
    view_sightlines *s = &v->sights;
    const view_mark marks[2] = {mark_on_edge(s, j->edge, j->line, from, 0), mark_on_edge(s, j->edge, j->line, to, 1)};
    froe_interval x = {view_share_of(s, j->edge, marks[0]), view_share_of(s, j->edge, marks[1])};
    if (x.from < *last) x.from = *last;
    if (x.to < x.from) x.to = x.from;
    *last = x.to;
    memcpy(v->interval_marks + 2 * (size_t)v->interval_count, marks, sizeof marks);
    v->intervals[v->interval_count++] = x;
}

/* Appends the union of the stretches of an edge, which are numbered. */
static bool join_edge(interval_joiner *j, const view_runs *stretches, const uint32_t *items, uint32_t count) {
    view_sightlines *s = &j->v->sights;
    const froe_allocator *alloc = &j->v->alloc;
    j->ends.count = j->order.count = 0;
    if (!array_reserve(alloc, &j->ends, 2 * (size_t)count) || !array_reserve(alloc, &j->order, 2 * (size_t)count))
        return false;
    for (uint32_t i = 0; i < count; i++) {
        for (int e = 0; e < 2; e++)
            j->ends.data[j->ends.count++] = view_end_at(s, j->line, stretches->data[items[i]].end[e]);
        j->order.data[i] = i;
    }
    base_merge_sort(j->order.data, j->order.data + count, count, by_interval_start, j);
    double last = 0;
    for (uint32_t i = 0; i < count;) {
        const view_end *from = j->ends.data + 2 * (size_t)j->order.data[i], *to = from + 1;
        for (i++; i < count; i++) {
            const view_end *next = j->ends.data + 2 * (size_t)j->order.data[i];
            if (view_compare_ends(s, j->line, &next[0], to) > 0) break;
            if (view_compare_ends(s, j->line, &next[1], to) > 0) to = &next[1];
        }
        put_interval(j, from, to, &last);
    }
    return true;
}

froe_status view_join_intervals(froe_visibility *v, const view_runs *stretches) {
    const froe_allocator *alloc = &v->alloc;
    const size_t edges = surface_line_count(v->surface);
    const size_t n = stretches->count;
    if (n > INT32_MAX) return FROE_E_LIMIT;
    interval_joiner j = {.v = v};
    v->edge_starts = support_calloc(alloc, edges + 1, sizeof *v->edge_starts);
    v->interval_room = n + 1;
    v->intervals = support_calloc(alloc, n + 1, sizeof *v->intervals);
    v->interval_marks = support_calloc(alloc, 2 * (n + 1), sizeof *v->interval_marks);
    uint32_t *items = support_calloc(alloc, n + 1, sizeof *items), *starts = v->edge_starts;
    bool ok = starts && v->intervals && v->interval_marks && items;
    /* items[starts[e] .. starts[e+1]) become the stretches of edge e. */
    for (size_t i = 0; ok && i < n; i++) starts[stretches->data[i].line + 1]++;
    for (uint32_t e = 0; ok && e < edges; e++) starts[e + 1] += starts[e];
    for (size_t i = n; ok && i-- > 0;) items[--starts[stretches->data[i].line + 1]] = (uint32_t)i;
    for (uint32_t e = 0; ok && e < edges; e++) starts[e] = starts[e + 1]; /* ends were lowered to the starts */
    if (ok) starts[edges] = (uint32_t)n;
    for (uint32_t e = 0; ok && e < edges; e++) {
        const uint32_t count = starts[e + 1] - starts[e], first = starts[e];
        starts[e] = v->interval_count;
        if (!count) continue;
        j.edge = e;
        j.line = view_line_of_edge(&v->sights, e);
        ok = join_edge(&j, stretches, items + first, count);
    }
    if (ok) starts[edges] = v->interval_count;
    support_free(alloc, items, (n + 1) * sizeof *items);
    array_free(alloc, &j.ends);
    array_free(alloc, &j.order);
    return ok ? FROE_OK : FROE_E_MEMORY;
}

void view_drop_intervals(froe_visibility *v) {
    support_free(&v->alloc, v->intervals, v->interval_room * sizeof *v->intervals);
    support_free(&v->alloc, v->interval_marks, 2 * v->interval_room * sizeof *v->interval_marks);
    support_free(&v->alloc, v->edge_starts, (surface_line_count(v->surface) + 1) * sizeof *v->edge_starts);
    v->intervals = NULL;
    v->interval_marks = NULL;
    v->edge_starts = NULL;
    v->interval_room = v->interval_count = 0;
}
