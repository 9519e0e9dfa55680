/* interleave.c: the places of lines in the order of painting, where not all lines go on top.
 *
 *      ____
 *     /   /|      The outer half of a wide line lies on faces beyond its edge. Where these are nearer than the line,
 *  --/---/ |      a line on top of all would cover them: the line is painted before all nearer faces that are visible
 *   /___/  |      within its reach, but after all else that is visible there, its own faces among it.
 *
 * So lines with something nearer within reach become nodes of the order graph. Where that closes cycles, lines are made
 * late, never faces: a late line goes on top of all, as lines without anything nearer do. All in doubles: visibility
 * has been decided before; this affects half a line's width. */
#include "support/clip.h"
#include "view/grid.h"
#include "view/picture/picture.h"
#include <math.h>

typedef struct line_sorter {
    view_painter *p;
    print_ring points;               /* of all visible pieces */
    ARRAY(uint32_t) starts;          /* of each, and their end */
    ARRAY(uint32_t) nearer, farther; /* nodes within reach of the current segment: in front of it, and the others */
    ARRAY(uint32_t) lines;           /* segments that are nodes: those of the picture come before */
    view_arcs arcs;
    view_grid grid;
} line_sorter;

static const print_point *line_points(const void *user, size_t i, size_t *points) {
    const line_sorter *s = user;
    *points = s->starts.data[i + 1] - s->starts.data[i];
    return s->points.data + s->starts.data[i];
}

/* --------------------------------------------------------------------- distances -- */

/* A place of the page on or near a segment: the share of the segment, and the distance. */
typedef struct near_place {
    print_point at;
    double share, square;
} near_place;

/* The point of ab nearest to q, as its share. */
static double share_along(print_point a, print_point b, print_point q) {
    const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
    const double t = square > 0 ? ((q.x - a.x) * dx + (q.y - a.y) * dy) / square : 0;
    return fmin(1, fmax(0, t));
}

static print_point point_at(print_point a, print_point b, double t) {
    return (print_point){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

/* Keeps the meeting of `at`, a point of the piece, with a share of the segment if it is the nearest. */
static void offer(near_place *best, print_point at, print_point on, double share) {
    const double x = at.x - on.x, y = at.y - on.y, square = x * x + y * y;
    if (square < best->square) *best = (near_place){at, share, square};
}

/* Where a segment and a convex ring are nearest to each other. */
static near_place nearest(const print_point *ring, size_t n, print_point a, print_point b) {
    const double turn = print_area(ring, n) > 0 ? 1 : -1;
    near_place best = {.square = INFINITY};
    double share[2] = {0, 1}; /* the part of ab inside the ring */
    bool inside = true;
    for (size_t i = 0; i < n && inside; i++) {
        const print_point p = ring[i], q = ring[i + 1 < n ? i + 1 : 0];
        const double at_a = turn * ((q.y - p.y) * (a.x - p.x) - (q.x - p.x) * (a.y - p.y)),
                     at_b = turn * ((q.y - p.y) * (b.x - p.x) - (q.x - p.x) * (b.y - p.y));
        inside = support_clip_shares(at_a, at_b, share);
    }
    if (inside && share[0] <= share[1]) {
        const double middle = 0.5 * (share[0] + share[1]);
        return (near_place){point_at(a, b, middle), middle, 0};
    }
    for (size_t i = 0; i < n; i++) {
        const print_point p = ring[i], q = ring[i + 1 < n ? i + 1 : 0];
        const double t = share_along(a, b, p);
        offer(&best, p, point_at(a, b, t), t);
        offer(&best, point_at(p, q, share_along(p, q, a)), a, 0);
        offer(&best, point_at(p, q, share_along(p, q, b)), b, 1);
    }
    return best;
}

/* ------------------------------------------------------------------------ depths -- */

/* How near the plane of an object is at a point of the page, as `near` of segments. */
static double near_at(const view_painter *p, uint32_t object, print_point page) {
    const froe_projection *view = p->options->view;
    double at[3][3], n[3], k = 0;
    for (uint32_t i = 0; i < 3; i++) view_camera_point(view, scene_point(p->v->tree->scene, object, i), at[i]);
    for (int c = 0; c < 3; c++) {
        const int i = (c + 1) % 3, j = (c + 2) % 3;
        n[c] = (at[1][i] - at[0][i]) * (at[2][j] - at[0][j]) - (at[1][j] - at[0][j]) * (at[2][i] - at[0][i]);
        k += n[c] * at[0][c];
    }
    const double x = (page.x - view->centre[0]) / view->scale, y = (view->centre[1] - page.y) / view->scale;
    if (view->eye.parallel) return (n[0] * x + n[1] * y - k) / n[2];
    return (n[0] * x + n[1] * y + n[2]) / k;
}

/* ------------------------------------------------------------------------- nodes -- */

/* Makes a segment a node if something nearer is visible within its reach: between the nodes in front and the others. */
static bool add_interleaved_line(line_sorter *s, uint32_t i) {
    const view_painter *p = s->p;
    const froe_allocator *alloc = &p->picture->alloc;
    const froe_projection *view = p->options->view;
    const view_segment *segment = p->segments.data + i;
    const uint32_t own = p->graph.count + (uint32_t)s->lines.count;
    if (segment->hidden) return true;
    const double reach = segment->kind == FROE_LINE_POINT ? p->options->interleave_points : p->options->interleave;
    s->nearer.count = s->farther.count = 0;
    view_grid_walk walk = view_grid_along(&s->grid, segment->at[0], segment->at[1], reach);
    for (uint32_t visible; view_grid_next(&walk, &visible);) {
        size_t n;
        const print_point *ring = line_points(s, visible, &n);
        const uint32_t node = p->parts.node_of[visible];
        if (n < 3) continue;
        const near_place m = nearest(ring, n, segment->at[0], segment->at[1]);
        if (m.square > reach * reach) continue;
        /* In front of the segment by more than a line is wide: less is what neighbours on a curved surface are. */
        const double near = segment->near[0] + m.share * (segment->near[1] - segment->near[0]);
        const double wide = 2 * reach / view->scale * (view->eye.parallel ? 1 : near);
        const bool nearer = near_at(p, p->v->pieces[visible].object, m.at) > near + wide;
        if (!(nearer ? array_push(alloc, &s->nearer, node) : array_push(alloc, &s->farther, node))) return false;
    }
    if (!s->nearer.count) return true;
    for (size_t k = 0; k < s->farther.count; k++)
        if (!array_push(alloc, &s->arcs, (graph_arc){s->farther.data[k], own})) return false;
    for (size_t k = 0; k < s->nearer.count; k++)
        if (!array_push(alloc, &s->arcs, (graph_arc){own, s->nearer.data[k]})) return false;
    return array_push(alloc, &s->lines, i);
}

/* ------------------------------------------------------------------------- order -- */

static froe_status sort_lines(line_sorter *s, view_graph *g) {
    const froe_allocator *alloc = &s->p->picture->alloc;
    const uint32_t faces = s->p->graph.count, n = faces + (uint32_t)s->lines.count;
    froe_status status = view_graph_new(alloc, n, s->arcs.data, s->arcs.count, g);
    uint8_t *fixed = support_calloc(alloc, (size_t)n + 1, 1);
    uint32_t *order = support_calloc(alloc, (size_t)n + 1, sizeof *order);
    s->p->breaks = support_calloc(alloc, (size_t)faces + 1, 1);
    if (!status && (!fixed || !order || !s->p->breaks)) status = FROE_E_MEMORY;
    for (uint32_t v = 0; !status && v < faces; v++) fixed[v] = 1;
    if (!status) status = view_graph_break(alloc, g, fixed);
    if (!status) status = view_sort_nodes(s->p, g, order);
    /* Parts the order of all nodes into that of the picture's and the places of lines in it. */
    view_painter *p = s->p;
    uint32_t place = 0;
    for (uint32_t i = 0; !status && i < g->count; i++) {
        const uint32_t v = order[i];
        if (v < faces) {
            p->order[place++] = v;
        } else if (!g->late[v] && place < faces) {
            p->segments.data[s->lines.data[v - faces]].place = place;
            p->breaks[place] = 1;
        }
    }
    support_free(alloc, fixed, (size_t)n + 1);
    support_free(alloc, order, ((size_t)n + 1) * sizeof *order);
    return status;
}

froe_status view_interleave(view_painter *p) {
    const froe_allocator *alloc = &p->picture->alloc;
    line_sorter s = {.p = p};
    view_graph g = {0};
    const uint32_t pieces = p->v->piece_count;
    bool ok = array_reserve(alloc, &s.starts, (size_t)pieces + 1);
    if (ok) s.starts.data[s.starts.count++] = 0;
    for (uint32_t i = 0; ok && i < pieces; i++) {
        ok = view_print_visible(&p->parts, i, &s.points);
        s.starts.data[s.starts.count++] = (uint32_t)s.points.count;
    }
    ok = ok && !view_grid_new(alloc, p->options->view, pieces, line_points, &s, &s.grid);
    for (uint32_t i = 0; ok && i < p->segments.count; i++) ok = add_interleaved_line(&s, i);
    const view_graph *faces = &p->graph; /* whose arcs still count */
    for (uint32_t v = 0; v < faces->count; v++)
        for (uint32_t e = faces->out_starts[v]; ok && e < faces->out_starts[v + 1] && !faces->late[v]; e++)
            ok = array_push(alloc, &s.arcs, (graph_arc){v, faces->outs[e]});
    const froe_status status = ok ? sort_lines(&s, &g) : FROE_E_MEMORY;
    view_graph_free(alloc, &g);
    view_grid_free(alloc, &s.grid);
    array_free(alloc, &s.points);
    array_free(alloc, &s.starts);
    array_free(alloc, &s.nearer);
    array_free(alloc, &s.farther);
    array_free(alloc, &s.lines);
    array_free(alloc, &s.arcs);
    return status;
}
