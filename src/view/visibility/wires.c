/* wires.c: wires and points sent down the finished beam tree. */
#include "view/visibility/wires.h"
#include "geom/predicates.h"

/* Where a part goes when it is visible so far; FROE_NONE: nowhere else. */
typedef struct wire_task {
    uint32_t node, next;
} wire_task;

typedef struct pending_wire {
    wire_task at;
    view_stretch part;
} pending_wire;

/* Points on their way down: a part of `points` at a node. */
typedef struct point_batch {
    uint32_t node, first, count;
} point_batch;

typedef struct wire_tracer {
    froe_visibility *v;
    view_sightlines *sights;
    const view_screen *screen;
    view_runs *out;
    ARRAY(pending_wire) pending;
    ARRAY(wire_task) tasks; /**< other sides of lines along which the current wire runs */
    ARRAY(uint32_t) nodes;
    ARRAY(uint32_t) points;
    ARRAY(point_batch) batches;
} wire_tracer;

/* Side of a face's plane: 1 that of the eye, -1 the other. */
static int side_of_face(wire_tracer *t, uint32_t object, uint32_t vertex) {
    const geom_plane plane = view_plane_at(t->sights, object);
    return view_facing(t->sights, object) *
           geom_side_vertex(&t->sights->context, &plane, view_vertex(t->sights, vertex));
}

/* ------------------------------------------------------------------------ wires -- */

/* Cuts a part of a wire to what an object does not hide that is visible in front of or behind all of it. *left: there
 * is something. */
static froe_status cut_to_front(wire_tracer *t, uint32_t object, uint32_t own, view_stretch *part, bool *left) {
    view_sightlines *s = t->sights;
    const uint32_t *v = s->surface->vertices + 2 * (size_t)part->edge;
    const int side[2] = {side_of_face(t, object, v[0]), side_of_face(t, object, v[1])};
    *left = side[0] >= 0 && side[1] >= 0;
    if (side[0] * side[1] >= 0) return FROE_OK;
    const size_t lines = s->lines.count;
    view_mark stop;
    const froe_status status = view_stop_edge(s, part->edge, object, own, &stop);
    if (status) return status;
    const uint32_t line = stop.way >> 1, front = v[side[0] < 0];
    const bool positive = view_side_of_vertex(s, line, front) > 0;
    *left = view_cut_stretch(s, own, 2 * line + !positive, part);
    bool used = false;
    for (int e = 0; e < 2; e++) used = used || (part->end[e].vertex == FROE_NONE && part->end[e].way >> 1 == line);
    if (!*left || !used) s->lines.count = lines; /* nothing refers to it */
    return FROE_OK;
}

static bool push_pending_wire(wire_tracer *t, wire_task at, const view_stretch *part) {
    return array_push(&t->sights->alloc, &t->pending, ((pending_wire){at, *part}));
}

/* A part in a leaf: what is visible of it is kept, or goes on to the other side of a line along which it runs. */
static froe_status end_in_leaf(wire_tracer *t, uint32_t own, pending_wire *at) {
    bool left = at->at.node == VIEW_OPEN;
    if (at->at.node == VIEW_OUTSIDE) return FROE_OK;
    if (!left) {
        const froe_status status = cut_to_front(t, at->at.node - VIEW_COVERED, own, &at->part, &left);
        if (status || !left) return status;
    }
    const uint32_t next = at->at.next;
    const view_stretch *part = &at->part;
    const view_run run = {part->edge, {view_mark_of(&part->end[0]), view_mark_of(&part->end[1])}};
    const bool ok = next != FROE_NONE ? push_pending_wire(t, t->tasks.data[next], part)
                                      : array_push(&t->sights->alloc, t->out, run);
    return ok ? FROE_OK : FROE_E_MEMORY;
}

/* Sends a part down until it ends in a leaf, or a line divides it, or it runs along one. */
static froe_status send_part(wire_tracer *t, uint32_t own, pending_wire *part) {
    view_sightlines *s = t->sights;
    const view_end *ends = part->part.end;
    while (part->at.node < VIEW_OPEN) {
        const view_screen_node n = t->screen->nodes.data[part->at.node];
        const int from = view_side(s, n.line, &ends[0].ray, ends[0].vertex, 2 * own, ends[0].way),
                  to = view_side(s, n.line, &ends[1].ray, ends[1].vertex, 2 * own, ends[1].way);
        if (from * to < 0) {
            view_end middle = {.vertex = FROE_NONE, .way = 2 * n.line + (from < 0)}; /* leaving: wire x line */
            middle.ray = view_meeting(s, 2 * own, middle.way);
            const uint32_t edge = part->part.edge, next = part->at.next;
            const view_stretch first = {edge, {ends[0], middle}}, last = {edge, {middle, ends[1]}};
            /* one way: the first has the room of what it is a part of */
            const bool ok = push_pending_wire(t, (wire_task){n.child[from > 0], next}, &first) &&
                            push_pending_wire(t, (wire_task){n.child[to > 0], next}, &last);
            return ok ? FROE_OK : FROE_E_MEMORY;
        }
        if (!from && !to) { /* along the line: first one side, then what is left on the other */
            if (!array_push(&s->alloc, &t->tasks, ((wire_task){n.child[1], part->at.next}))) return FROE_E_MEMORY;
            part->at.next = (uint32_t)t->tasks.count - 1;
        }
        part->at.node = n.child[from > 0 || to > 0];
    }
    return end_in_leaf(t, own, part);
}

static froe_status trace(wire_tracer *t, const view_stretch *whole, uint32_t own) {
    t->pending.count = t->tasks.count = 0;
    froe_status status = push_pending_wire(t, (wire_task){t->screen->root, FROE_NONE}, whole) ? FROE_OK : FROE_E_MEMORY;
    while (!status && t->pending.count) {
        pending_wire top = t->pending.data[--t->pending.count];
        status = send_part(t, own, &top);
    }
    return status;
}

static froe_status look_at_wire(wire_tracer *t, uint32_t wire) {
    const uint32_t edge = t->v->surface->edge_count + wire;
    view_stretch whole;
    bool there;
    const froe_status status = view_rest_of_edge(t->v, edge, &whole, &there);
    return status || !there ? status : trace(t, &whole, view_line_of_edge(t->sights, edge));
}

/* ----------------------------------------------------------------------- points -- */

/* Is a point elsewhere than at the eye, and not cut away? */
static bool is_there(wire_tracer *t, uint32_t vertex) {
    view_sightlines *s = t->sights;
    const double *x = view_vertex(s, vertex), *eye = s->eye.at;
    if (!s->eye.parallel && x[0] == eye[0] && x[1] == eye[1] && x[2] == eye[2]) return false;
    if (!t->v->section) return true;
    const geom_plane plane = view_plane_at(s, FROE_NONE);
    return t->v->section * geom_side_vertex(&s->context, &plane, x) >= 0;
}

/* What a leaf says of a point: 1 visible, 0 not on the page, -1 hidden. */
static int point_in_leaf(wire_tracer *t, uint32_t leaf, uint32_t vertex) {
    if (leaf == VIEW_OPEN) return 1;
    if (leaf == VIEW_OUTSIDE) return 0;
    return side_of_face(t, leaf - VIEW_COVERED, vertex) < 0 ? -1 : 1;
}

static uint32_t vertex_of(const wire_tracer *t, uint32_t point) {
    return scene_corner(t->sights->tree->scene, t->v->surface->points[point], 0);
}

/* A point by itself, whatever lines it lies on. */
static froe_status look_at_point(wire_tracer *t, uint32_t point) {
    view_sightlines *s = t->sights;
    const uint32_t vertex = vertex_of(t, point);
    bool shown = false, hidden = false;
    t->nodes.count = 0;
    if (!array_push(&s->alloc, &t->nodes, t->screen->root)) return FROE_E_MEMORY;
    while (t->nodes.count && !hidden) {
        uint32_t node = t->nodes.data[--t->nodes.count];
        while (node < VIEW_OPEN) { /* on a line: to both sides */
            const view_screen_node *n = t->screen->nodes.data + node;
            const int side = view_side_of_vertex(s, n->line, vertex);
            if (!side && !array_push(&s->alloc, &t->nodes, n->child[0])) return FROE_E_MEMORY;
            node = n->child[side >= 0];
        }
        const int found = point_in_leaf(t, node, vertex);
        shown = shown || found > 0;
        hidden = found < 0;
    }
    t->v->points_seen[point] = shown && !hidden;
    return FROE_OK;
}

/* Parts a batch by a line: those on its negative side come first, and their number is returned. Points on the line go
 * on by themselves, and leave the batch. */
static froe_status part_batch(wire_tracer *t, uint32_t line, point_batch *b, uint32_t *negative) {
    uint32_t *points = t->points.data + b->first, lo = 0, hi = b->count;
    while (lo < hi) {
        const uint32_t point = points[lo], vertex = vertex_of(t, point);
        const int side = view_side_of_vertex(t->sights, line, vertex);
        if (side < 0) {
            lo++;
            continue;
        }
        points[lo] = points[--hi];
        points[hi] = point;
        if (side > 0) continue;
        points[hi] = points[--b->count];
        const froe_status status = look_at_point(t, point);
        if (status) return status;
    }
    *negative = lo;
    return FROE_OK;
}

/* Points go down together, so that each line is read once for all that come to it. */
static froe_status look_at_points(wire_tracer *t, base_task *task) {
    const froe_allocator *alloc = &t->sights->alloc;
    const uint32_t count = t->v->surface->point_count;
    if (!array_reserve(alloc, &t->points, count)) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < count; i++)
        if (is_there(t, vertex_of(t, i))) t->points.data[t->points.count++] = i;
    const point_batch all = {t->screen->root, 0, (uint32_t)t->points.count};
    froe_status status = array_push(alloc, &t->batches, all) ? FROE_OK : FROE_E_MEMORY;
    for (uint32_t done = 0; t->batches.count && !status; done++) {
        point_batch b = t->batches.data[--t->batches.count];
        while (b.node < VIEW_OPEN && b.count && !status) {
            const view_screen_node n = t->screen->nodes.data[b.node];
            uint32_t negative = 0;
            status = part_batch(t, n.line, &b, &negative);
            const point_batch positive = {n.child[1], b.first + negative, b.count - negative};
            if (!status && positive.count && !array_push(alloc, &t->batches, positive)) status = FROE_E_MEMORY;
            b = (point_batch){n.child[0], b.first, negative};
        }
        for (uint32_t i = b.first; i < b.first + b.count && !status; i++) {
            const uint32_t point = t->points.data[i];
            t->v->points_seen[point] = point_in_leaf(t, b.node, vertex_of(t, point)) > 0;
        }
        if (!status && done % 4096 == 0 && !base_progress(task, 0.95)) status = FROE_E_CANCELLED;
    }
    return status;
}

/* ---------------------------------------------------------------------- calling -- */

froe_status view_look_at_wires(froe_visibility *v, const view_screen *screen, base_task *task, view_runs *stretches) {
    enum { PER_REPORT = 4096 };
    wire_tracer t = {.v = v, .sights = &v->sights, .screen = screen, .out = stretches};
    const uint32_t wires = v->surface->wire_count;
    froe_status status = FROE_OK;
    for (uint32_t i = 0; i < wires && !status; i++) {
        status = look_at_wire(&t, i);
        if (!status && i % PER_REPORT == 0 && !base_progress(task, 0.9)) status = FROE_E_CANCELLED;
    }
    if (!status) status = look_at_points(&t, task);
    const froe_allocator *alloc = &v->sights.alloc;
    array_free(alloc, &t.pending);
    array_free(alloc, &t.tasks);
    array_free(alloc, &t.nodes);
    array_free(alloc, &t.points);
    array_free(alloc, &t.batches);
    return status;
}
