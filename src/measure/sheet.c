/* sheet.c: edges with the objects on their two sides; the events; the sweep, over a splay tree (Sleator and Tarjan:
 * Self-adjusting binary search trees, 1985) of the edges on the line. */
#include "measure/sheet.h"
#include "base/radix.h"
#include "geom/turn.h"

enum { POLL = 1 << 12 };

/* Number 0 is no edge: the end of the list of neighbours, and of the tree. */
typedef struct sheet_edge {
    double p[2], q[2];     /* p before q: by the first coordinate, then by the second */
    uint32_t beside[2];    /* what lies below and above, or FROE_NONE; of a segment itself, twice */
    uint32_t neighbour[2]; /* on the line, below and above */
    uint32_t child[2];
    bool on; /* on the line */
} sheet_edge;

/* The edge of an object: vertices p and q, and what lies on one side, or on both. */
typedef struct sheet_side {
    uint32_t p, q, object;
    bool below, above;
} sheet_side;

typedef struct sheet_sweep {
    num_context *context;
    const froe_allocator *alloc;
    const froe_scene *scene;
    int axis;
    measure_sheet *sheet;
    ARRAY(sheet_side) sides;
    ARRAY(sheet_edge) edges;
    base_pair *events; /* where edges begin and end, in order: an edge, its lowest bit is the end */
    size_t event_room, event_count;
    uint32_t root;
} sheet_sweep;

/* ------------------------------------------------------------------- places -- */

static void shadow(const sheet_sweep *s, uint32_t vertex, double *out) {
    const double *x = scene_vertex(s->scene, vertex);
    out[0] = s->axis < 0 ? x[0] : x[(s->axis + 1) % 3];
    out[1] = s->axis < 0 ? x[1] : x[(s->axis + 2) % 3];
}

static bool before(const double *p, const double *q) {
    return p[0] < q[0] || (p[0] == q[0] && p[1] < q[1]);
}

static bool same_sheet_place(const double *p, const double *q) {
    return p[0] == q[0] && p[1] == q[1];
}

/* Where is f, of e? 1 above, -1 below, 0: on one line. Both meet the line of the sweep, and do not cross before it. f
 * may be a point. */
static int place_on_sheet(const sheet_sweep *s, const sheet_edge *e, const sheet_edge *f) {
    if (e == f) return 0;
    bool later = before(f->p, e->p);
    const sheet_edge *first = later ? f : e, *second = later ? e : f;
    int sign = same_sheet_place(first->p, second->p) ? 0 : geom_turn(s->context, first->p, first->q, second->p);
    if (!sign && !same_sheet_place(second->p, second->q)) sign = geom_turn(s->context, first->p, first->q, second->q);
    return later ? -sign : sign;
}

/* --------------------------------------------------------------------- edges -- */

static void condemn(sheet_sweep *s, uint32_t object) {
    if (object != FROE_NONE) s->sheet->crooked[object] = true;
}

static void condemn_edge(sheet_sweep *s, const sheet_edge *e) {
    condemn(s, e->beside[0]);
    condemn(s, e->beside[1]);
}

static froe_status add_object(sheet_sweep *s, uint32_t number, uint32_t object) {
    const froe_scene *scene = s->scene;
    uint32_t corners = scene_corners(scene, object), edges = s->axis < 0 ? 1 : corners;
    int way = s->axis < 0 ? 1
                          : geom_projected_turn(s->context, s->axis, scene_point(scene, object, 0),
                                                scene_point(scene, object, 1), scene_point(scene, object, 2));
    s->sheet->crooked[number] = !way; /* seen edge-on */
    for (uint32_t i = 0; way && i < edges; i++) {
        const uint32_t from = scene_corner(scene, object, i),
                       to = scene_corner(scene, object, i + 1 < corners ? i + 1 : 0);
        double p[2], q[2];
        shadow(s, from, p);
        shadow(s, to, q);
        const bool ascends = before(p, q), both = s->axis < 0;
        const sheet_side new = {ascends ? from : to, ascends ? to : from, number, both || ascends != (way > 0),
                                both || ascends == (way > 0)};
        if (!array_push(s->alloc, &s->sides, new)) return FROE_E_MEMORY;
    }
    return FROE_OK;
}

static void claim(sheet_sweep *s, sheet_edge *e, int which, uint32_t object) {
    if (e->beside[which] == FROE_NONE) {
        e->beside[which] = object;
    } else {
        condemn(s, e->beside[which]);
        condemn(s, object);
    }
}

/* One edge for all sides between the same vertices. */
static froe_status join_sides(sheet_sweep *s) {
    size_t count = s->sides.count;
    base_pair *pairs = support_calloc(s->alloc, 2 * count + 1, sizeof *pairs);
    bool room = pairs && array_reserve(s->alloc, &s->edges, count + 1);
    if (room) s->edges.data[s->edges.count++] = (sheet_edge){.beside = {FROE_NONE, FROE_NONE}};
    for (size_t i = 0; room && i < count; i++)
        pairs[i] = (base_pair){(uint64_t)s->sides.data[i].p << 32 | s->sides.data[i].q, (uint32_t)i};
    if (room) base_radix_sort(pairs, pairs + count, count);
    for (size_t i = 0; room && i < count; i++) {
        const sheet_side *from = s->sides.data + pairs[i].value;
        if (!i || pairs[i].key != pairs[i - 1].key) {
            sheet_edge *new = s->edges.data + s->edges.count++;
            *new = (sheet_edge){.beside = {FROE_NONE, FROE_NONE}};
            shadow(s, from->p, new->p);
            shadow(s, from->q, new->q);
        }
        sheet_edge *e = s->edges.data + s->edges.count - 1;
        if (from->below) claim(s, e, 0, from->object);
        if (from->above) claim(s, e, 1, from->object);
    }
    support_free(s->alloc, pairs, (2 * count + 1) * sizeof *pairs);
    return room ? FROE_OK : FROE_E_MEMORY;
}

static const double *event_place(const sheet_sweep *s, const base_pair *event) {
    const sheet_edge *e = s->edges.data + event->value / 2;
    return event->value % 2 ? e->p : e->q;
}

/* ---------------------------------------------------------------------- tree -- */

/* Brings an edge beside `key` to the top, top down. */
static uint32_t splay(const sheet_sweep *s, uint32_t top, const sheet_edge *key) {
    sheet_edge *e = s->edges.data;
    uint32_t parts[2] = {0, 0}, *tails[2] = {parts, parts + 1}; /* what lies below and above of all that was passed */
    for (int sign; (sign = place_on_sheet(s, e + top, key)) != 0;) {
        int towards = sign > 0;
        uint32_t child = e[top].child[towards];
        if (child && place_on_sheet(s, e + child, key) == sign) { /* rotate */
            e[top].child[towards] = e[child].child[!towards];
            e[child].child[!towards] = top;
            top = child;
            child = e[top].child[towards];
        }
        if (!child) break;
        *tails[!towards] = top;
        tails[!towards] = &e[top].child[towards];
        top = child;
    }
    for (int k = 0; k < 2; k++) {
        *tails[k] = e[top].child[k];
        e[top].child[k] = parts[k];
    }
    return top;
}

static void link_neighbours(sheet_sweep *s, uint32_t low, uint32_t high) {
    s->edges.data[low].neighbour[1] = high;
    s->edges.data[high].neighbour[0] = low;
}

/* An edge that runs along another one from its start on is not inserted. */
static void insert(sheet_sweep *s, uint32_t number) {
    sheet_edge *e = s->edges.data, *new = e + number;
    new->child[0] = new->child[1] = 0;
    if (s->root) {
        s->root = splay(s, s->root, new);
        int sign = place_on_sheet(s, e + s->root, new), towards = sign > 0;
        if (!sign) {
            condemn_edge(s, new);
            return;
        }
        new->child[towards] = e[s->root].child[towards];
        new->child[!towards] = s->root;
        e[s->root].child[towards] = 0;
        uint32_t other = e[s->root].neighbour[towards];
        link_neighbours(s, towards ? s->root : other, number);
        link_neighbours(s, number, towards ? other : s->root);
    } else {
        link_neighbours(s, 0, number);
        link_neighbours(s, number, 0);
    }
    new->on = true;
    s->root = number;
}

static void take_out(sheet_sweep *s, uint32_t number) {
    sheet_edge *e = s->edges.data, *old = e + number;
    splay(s, s->root, old);
    s->root = old->child[1];
    if (old->child[0]) {
        s->root = splay(s, old->child[0], old);
        e[s->root].child[1] = old->child[1];
    }
    link_neighbours(s, old->neighbour[0], old->neighbour[1]);
    old->on = false;
}

/* --------------------------------------------------------------------- sweep -- */

/* Do neighbours cross further on? The one that ends first does so on the wrong side of the other. */
static bool cross(const sheet_sweep *s, uint32_t low, uint32_t high) {
    const sheet_edge *a = s->edges.data + low, *b = s->edges.data + high;
    if (!low || !high) return false;
    return before(a->q, b->q) ? geom_turn(s->context, b->p, b->q, a->q) > 0
                              : geom_turn(s->context, a->p, a->q, b->q) < 0;
}

static bool condemned(const sheet_sweep *s, const sheet_edge *e) {
    for (int k = 0; k < 2; k++)
        if (e->beside[k] != FROE_NONE && !s->sheet->crooked[e->beside[k]]) return false;
    return true;
}

/* Tests all that are neighbours at a point now, before edges that begin there are in, or for good. */
static void settle(sheet_sweep *s, const sheet_edge *point, bool for_good) {
    sheet_edge *e = s->edges.data;
    uint32_t low = s->root ? s->root = splay(s, s->root, point) : 0;
    while (low && place_on_sheet(s, e + low, point) <= 0) low = e[low].neighbour[0];
    for (bool here = true; here;) {
        uint32_t high = e[low].neighbour[1];
        if (cross(s, low, high)) {
            /* An edge of crooked objects alone goes, or else the longer one, which may cross more. */
            const sheet_edge *a = e + low, *b = e + high;
            const bool one = condemned(s, a), longer = a->q[0] - a->p[0] > b->q[0] - b->p[0];
            const uint32_t gone = (one != condemned(s, b) ? one : longer) ? low : high;
            condemn_edge(s, e + gone);
            if (gone == low) low = e[low].neighbour[0];
            take_out(s, gone);
            continue;
        }
        if (for_good && s->axis >= 0 && e[low].beside[1] != e[high].beside[0]) { /* different objects between them */
            condemn(s, e[low].beside[1]);
            condemn(s, e[high].beside[0]);
        }
        here = high && !place_on_sheet(s, e + high, point);
        low = high;
    }
}

/* Handles all edges that end or begin at one point. Of edges that only pass, at most one is left before others begin,
 * since two would cross there. */
static froe_status pass(sheet_sweep *s, size_t first, size_t end) {
    sheet_edge *e = s->edges.data, point = {.on = true};
    for (int k = 0; k < 2; k++) point.p[k] = point.q[k] = event_place(s, s->events + first)[k];
    for (size_t i = first; i < end; i++) {
        uint32_t number = s->events[i].value / 2;
        if (s->events[i].value % 2 == 0 && e[number].on) take_out(s, number);
    }
    settle(s, &point, false);
    if (s->root) s->root = splay(s, s->root, &point);
    if (s->root && !place_on_sheet(s, e + s->root, &point)) {
        /* Objects with a corner at the point touch the objects beside the edge that passes. */
        for (size_t i = first; i < end; i++)
            for (int k = 0; k < 4; k++) {
                const measure_touch t = {e[s->root].beside[k / 2], e[s->events[i].value / 2].beside[k % 2]};
                if (t.a == FROE_NONE || t.b == FROE_NONE || t.a == t.b || s->sheet->crooked[t.a] ||
                    s->sheet->crooked[t.b])
                    continue;
                if (!array_push(s->alloc, &s->sheet->touches, t)) return FROE_E_MEMORY;
            }
    }
    for (size_t i = first; i < end; i++)
        if (s->events[i].value % 2) insert(s, s->events[i].value / 2);
    settle(s, &point, true);
    return FROE_OK;
}

froe_status measure_sheet_sweep(num_context *context, base_task *task, const froe_scene *scene, int axis,
                                const uint32_t *objects, uint32_t count, measure_sheet *sheet) {
    sheet_sweep s = {.context = context, .alloc = &scene->alloc, .scene = scene, .axis = axis, .sheet = sheet};
    froe_status status = FROE_OK;
    for (uint32_t i = 0; i < count && !status; i++) status = add_object(&s, i, objects[i]);
    if (!status) status = join_sides(&s);
    if (!status) {
        s.event_count = 2 * (s.edges.count - 1);
        s.event_room = 2 * s.event_count + 1;
        s.events = support_calloc(s.alloc, s.event_room, sizeof *s.events);
        if (!s.events) status = FROE_E_MEMORY;
    }
    for (size_t i = 0; i < s.event_count && !status; i++) s.events[i].value = (uint32_t)i + 2;
    for (int k = 2; k-- && !status;) { /* by the first coordinate, then by the second */
        for (size_t i = 0; i < s.event_count; i++) s.events[i].key = base_double_key(event_place(&s, s.events + i)[k]);
        base_radix_sort(s.events, s.events + s.event_count, s.event_count);
    }
    size_t looked = 0;
    for (size_t first = 0, end; first < s.event_count && !status; first = end) {
        const double *at = event_place(&s, s.events + first);
        for (end = first + 1; end < s.event_count && same_sheet_place(at, event_place(&s, s.events + end));) end++;
        status = pass(&s, first, end);
        if (first < looked) continue;
        looked = first + POLL;
        if (!base_progress(task, task->done)) status = FROE_E_CANCELLED;
    }
    array_free(s.alloc, &s.sides);
    array_free(s.alloc, &s.edges);
    support_free(s.alloc, s.events, s.event_room * sizeof *s.events);
    return status;
}
