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

typedef struct wire_tracer {
    froe_visibility *v;
    view_sightlines *sights;
    const view_screen *screen;
    view_stretches *out;
    ARRAY(pending_wire) pending;
    ARRAY(wire_task) tasks; /**< other sides of lines along which the current wire runs */
    ARRAY(uint32_t) nodes;
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
    const bool positive = view_side(s, line, &s->rays[front], front, 0, 0) > 0;
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
    const bool ok = next != FROE_NONE ? push_pending_wire(t, t->tasks.data[next], &at->part)
                                      : array_push(&t->sights->alloc, t->out, at->part);
    return ok ? FROE_OK : FROE_E_MEMORY;
}

static froe_status trace(wire_tracer *t, const view_stretch *whole, uint32_t own) {
    view_sightlines *s = t->sights;
    t->pending.count = t->tasks.count = 0;
    froe_status status = push_pending_wire(t, (wire_task){t->screen->root, FROE_NONE}, whole) ? FROE_OK : FROE_E_MEMORY;
    while (!status && t->pending.count) {
        pending_wire top = t->pending.data[--t->pending.count];
        const view_end *ends = top.part.end;
        if (top.at.node >= VIEW_OPEN) {
            status = end_in_leaf(t, own, &top);
            continue;
        }
        const view_screen_node n = t->screen->nodes.data[top.at.node];
        const int from = view_side(s, n.line, &ends[0].ray, ends[0].vertex, 2 * own, ends[0].way),
                  to = view_side(s, n.line, &ends[1].ray, ends[1].vertex, 2 * own, ends[1].way);
        wire_task at = {n.child[from > 0 || to > 0], top.at.next};
        bool ok;
        if (from * to < 0) {
            view_end middle = {.vertex = FROE_NONE, .way = 2 * n.line + (from < 0)}; /* leaving: wire x line */
            middle.ray = view_meeting(s, 2 * own, middle.way);
            const view_stretch first = {top.part.edge, {ends[0], middle}}, last = {top.part.edge, {middle, ends[1]}};
            ok = push_pending_wire(t, (wire_task){n.child[from > 0], at.next}, &first) &&
                 push_pending_wire(t, (wire_task){n.child[to > 0], at.next}, &last);
        } else {
            if (!from && !to) { /* along the line: first one side, then what is left on the other */
                if (!array_push(&s->alloc, &t->tasks, ((wire_task){n.child[1], at.next}))) return FROE_E_MEMORY;
                at.next = (uint32_t)t->tasks.count - 1;
            }
            ok = push_pending_wire(t, at, &top.part);
        }
        if (!ok) status = FROE_E_MEMORY;
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

static bool is_at_eye(const view_sightlines *s, const double *x) {
    return !s->eye.parallel && x[0] == s->eye.at[0] && x[1] == s->eye.at[1] && x[2] == s->eye.at[2];
}

/* What a leaf says of a point: 1 visible, 0 not on the page, -1 hidden. */
static int point_in_leaf(wire_tracer *t, uint32_t leaf, uint32_t vertex) {
    if (leaf == VIEW_OPEN) return 1;
    if (leaf == VIEW_OUTSIDE) return 0;
    return side_of_face(t, leaf - VIEW_COVERED, vertex) < 0 ? -1 : 1;
}

static froe_status look_at_point(wire_tracer *t, uint32_t point) {
    view_sightlines *s = t->sights;
    const uint32_t vertex = scene_corner(s->tree->scene, t->v->surface->points[point], 0);
    bool shown = false, hidden = is_at_eye(s, view_vertex(s, vertex));
    if (t->v->section && !hidden) {
        const geom_plane plane = view_plane_at(s, FROE_NONE);
        hidden = t->v->section * geom_side_vertex(&s->context, &plane, view_vertex(s, vertex)) < 0;
    }
    t->nodes.count = 0;
    if (!array_push(&s->alloc, &t->nodes, t->screen->root)) return FROE_E_MEMORY;
    while (t->nodes.count && !hidden) {
        uint32_t node = t->nodes.data[--t->nodes.count];
        while (node < VIEW_OPEN) { /* on a line: to both sides */
            const view_screen_node *n = t->screen->nodes.data + node;
            const int side = view_side(s, n->line, &s->rays[vertex], vertex, 0, 0);
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

/* ---------------------------------------------------------------------- calling -- */

froe_status view_look_at_wires(froe_visibility *v, const view_screen *screen, base_task *task,
                               view_stretches *stretches) {
    enum { PER_REPORT = 4096 };
    wire_tracer t = {.v = v, .sights = &v->sights, .screen = screen, .out = stretches};
    const uint32_t wires = v->surface->wire_count, points = v->surface->point_count;
    froe_status status = FROE_OK;
    for (uint32_t i = 0; i < wires && !status; i++) {
        status = look_at_wire(&t, i);
        if (!status && i % PER_REPORT == 0 && !base_progress(task, 0.9)) status = FROE_E_CANCELLED;
    }
    for (uint32_t i = 0; i < points && !status; i++) {
        status = look_at_point(&t, i);
        if (!status && i % PER_REPORT == 0 && !base_progress(task, 0.95)) status = FROE_E_CANCELLED;
    }
    const froe_allocator *alloc = &v->sights.alloc;
    array_free(alloc, &t.pending);
    array_free(alloc, &t.tasks);
    array_free(alloc, &t.nodes);
    return status;
}
