/* sights.c: the instants at which what an eye sees of moving triangles may change.
 *
 *     from --+--------+----------------- to      between two knots: edges and corners with the boxes that they stay in,
 *            knot     knot                       as the eye sees them; those whose boxes meet are looked at (align.h)
 *
 * The picture changes first where something takes part that is seen just before: a corner passes an edge, and one of
 * both is seen; or a third edge passes the point where two edges that are seen cross. */
#include "base/floats.h"
#include "base/sort.h"
#include "kinetic/sight/align.h"
#include "support/fail.h"
#include <math.h>
#include <string.h>

enum { CORNERS = 4, FEW = 5 }; /* of the window; coefficients of what a box is made of */

typedef struct sight_box {
    double lo[2], hi[2];
} sight_box;

typedef struct sight_point {
    align_point at;
    sight_box box;
    bool there, seen, moves;
} sight_point;

typedef struct sight_edge {
    uint32_t v[2];
    sight_box box;
    bool seen, moves, window;
} sight_edge;

typedef struct sight_search {
    const froe_motion *m;
    const froe_sight_options *o;
    align_room room;
    align_edge lines[3];   /**< of the edges that are looked at: large, and so not on the stack */
    align_pair pairs[2];   /**< of the first two; in another order */
    int chart, side;       /**< boxes are quotients by this component of rays, which has this sign before the eye */
    sight_point *points;   /**< vertices of the motion, corners of the window, ends of crossings */
    uint32_t own, count;   /**< of them vertices, and all */
    crossing_end *crosses; /**< those of the i-th pair at 2 i; edge[0] NULL: it has none */
    ARRAY(sight_edge) edges;
    ARRAY(double) knots;
    ARRAY(meet_time) instants;
    froe_status status;
} sight_search;

/* ---------------------------------------------------------------------- boxes -- */

static const sight_box everywhere = {{-INFINITY, -INFINITY}, {INFINITY, INFINITY}};

static bool boxes_meet(const sight_box *a, const sight_box *b) {
    for (int k = 0; k < 2; k++)
        if (a->lo[k] > b->hi[k] || b->lo[k] > a->hi[k]) return false;
    return true;
}

/* Extends a box by a quotient of two numbers, of which the lower is not 0, rounded outwards. */
static void extend_by(sight_box *box, int axis, num_ball x, num_ball y) {
    for (int i = 0; i < 4; i++) {
        const double at = (x.x + (i & 1 ? x.e : -x.e)) / (y.x + (i & 2 ? y.e : -y.e)), margin = fabs(at) * 0x1p-50;
        box->lo[axis] = fmin(box->lo[axis], at - margin - 0x1p-1000);
        box->hi[axis] = fmax(box->hi[axis], at + margin + 0x1p-1000);
    }
}

/* Those of Bernstein of that degree, each times a number that is the same for all polynomials. */
static void between_numbers(const num_ball_poly *f, int degree, num_ball out[FEW]) {
    num_ball_poly raised = {.degree = degree};
    for (int i = 0; i <= f->degree; i++) raised.c[i] = f->c[i];
    for (int i = 0; i <= degree; i++) out[i] = num_ball_poly_bernstein(&raised, i);
}

/* Where a ray passes through the plane in which its component `chart` is 1. */
static sight_box box_of_ray(const sight_search *s, const num_ball_poly ray[3]) {
    sight_box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    num_ball way[FEW], at[FEW];
    int degree = 0;
    for (int k = 0; k < 3; k++) degree = ray[k].degree > degree ? ray[k].degree : degree;
    between_numbers(&ray[s->chart], degree, way);
    for (int i = 0; i <= degree; i++)
        if (num_ball_sign(way[i]) != s->side) return everywhere;
    for (int axis = 0; axis < 2; axis++) {
        between_numbers(&ray[(s->chart + 1 + axis) % 3], degree, at);
        for (int i = 0; i <= degree; i++) extend_by(&box, axis, at[i], way[i]);
    }
    return box;
}

static sight_box join_boxes(const sight_box *a, const sight_box *b) {
    sight_box box;
    for (int k = 0; k < 2; k++) box.lo[k] = fmin(a->lo[k], b->lo[k]), box.hi[k] = fmax(a->hi[k], b->hi[k]);
    return box;
}

/* ---------------------------------------------------------------------- scene -- */

static bool lives(const sight_search *s, const motion_object *o) {
    return o->birth <= s->room.from && o->death >= s->room.to;
}

/* Where all points are that are there, and how they move before the eye. */
static void place_points(sight_search *s) {
    const bool flies = s->room.gaze.rig && s->room.gaze.rig->bodies.data->plan.count > 1;
    for (uint32_t v = 0; v < s->count; v++) {
        sight_point *p = s->points + v;
        num_ball_poly ray[3];
        if (!p->there) continue;
        if (v < s->own) p->at.piece = motion_piece_at_time(s->m, v, s->room.from);
        p->moves = !p->at.carried && (flies || (v < s->own && p->at.piece.degree > 0));
        align_place(&s->room, &p->at);
        align_ray(&s->room, &p->at, ray);
        p->box = box_of_ray(s, ray);
    }
}

static int by_ends(const void *a, const void *b) {
    const sight_edge *p = a, *q = b;
    if (p->v[0] != q->v[0]) return p->v[0] < q->v[0] ? -1 : 1;
    return (p->v[1] > q->v[1]) - (p->v[1] < q->v[1]);
}

static int by_left_end(const void *a, const void *b) {
    const sight_edge *p = a, *q = b;
    if (p->box.lo[0] != q->box.lo[0]) return p->box.lo[0] < q->box.lo[0] ? -1 : 1;
    return by_ends(a, b);
}

static bool add_edge(sight_search *s, uint32_t a, uint32_t b, bool seen) {
    for (int i = 0; i < 2; i++) {
        sight_point *p = s->points + (i ? b : a);
        p->there = true;
        p->seen = p->seen || seen;
    }
    return array_push(
        &s->m->alloc, &s->edges,
        (sight_edge){.v = {a < b ? a : b, a < b ? b : a}, .seen = seen, .window = a >= s->own && a < s->own + CORNERS});
}

/* Those of triangles that live, of the window, and where triangles cross. */
static bool add_edges(sight_search *s) {
    const uint8_t *seen = s->o->seen;
    bool room = true;
    for (uint32_t i = 0; i < s->m->objects.count && room; i++) {
        const motion_object *o = s->m->objects.data + i;
        for (int k = 0; k < 3 && room && lives(s, o); k++)
            room = add_edge(s, o->vertices[k], o->vertices[(k + 1) % 3], !seen || seen[i]);
    }
    for (uint32_t k = 0; k < CORNERS && room && s->o->window; k++)
        room = add_edge(s, s->own + k, s->own + (k + 1) % CORNERS, true);
    for (uint32_t i = 0; i < s->o->pair_count && room; i++) {
        const uint32_t *pair = s->o->pairs + 2 * (size_t)i, first = s->own + CORNERS + 2 * i;
        const bool there = lives(s, s->m->objects.data + pair[0]) && lives(s, s->m->objects.data + pair[1]);
        if (there && s->crosses[2 * i].edge[0])
            room = add_edge(s, first, first + 1, !seen || seen[pair[0]] || seen[pair[1]]);
    }
    return room;
}

/* All edges that are there all the time, each once, in the order of their boxes. */
static bool list_edges(sight_search *s) {
    s->edges.count = 0;
    for (uint32_t v = 0; v < s->count; v++) s->points[v].there = s->points[v].seen = false;
    if (!add_edges(s)) return false;
    if (!s->edges.count) return true;
    place_points(s);
    base_sort(s->edges.data, s->edges.count, sizeof *s->edges.data, by_ends);
    size_t kept = 0;
    for (size_t i = 0; i < s->edges.count; i++) {
        sight_edge e = s->edges.data[i];
        const sight_point *a = s->points + e.v[0], *b = s->points + e.v[1];
        if (kept && !by_ends(&e, &s->edges.data[kept - 1])) {
            s->edges.data[kept - 1].seen |= e.seen;
            continue;
        }
        e.box = join_boxes(&a->box, &b->box);
        e.moves = a->moves || b->moves;
        s->edges.data[kept++] = e;
    }
    s->edges.count = kept;
    base_sort(s->edges.data, kept, sizeof *s->edges.data, by_left_end);
    return true;
}

/* --------------------------------------------------------------------- looking -- */

static const align_edge *edge_of(sight_search *s, const sight_edge *e, int place) {
    align_edge *out = s->lines + place;
    for (int i = 0; i < 2; i++) out->end[i] = &s->points[e->v[i]].at;
    align_line(&s->room, out);
    return out;
}

/* What was found, if two are not too close. */
static bool keep_found(sight_search *s, bool well, const meet_time *found, int count) {
    if (!well) s->status = FROE_E_LIMIT;
    for (int i = 0; i < count && !s->status; i++)
        if (!array_push(&s->m->alloc, &s->instants, found[i])) s->status = FROE_E_MEMORY;
    return !s->status;
}

static bool pass_edge(sight_search *s, const sight_edge *e, const align_edge *line, uint32_t v) {
    const sight_point *p = s->points + v;
    meet_time found[NUM_DEGREE + 1];
    int count;
    if (!p->there || v == e->v[0] || v == e->v[1] || !(p->seen || e->seen) || !(p->moves || e->moves)) return true;
    if (!boxes_meet(&p->box, &e->box)) return true;
    const bool well = align_pass(&s->room, &p->at, line, found, &count);
    return keep_found(s, well, found, count);
}

static bool share_end(const sight_edge *a, const sight_edge *b) {
    return a->v[0] == b->v[0] || a->v[0] == b->v[1] || a->v[1] == b->v[0] || a->v[1] == b->v[1];
}

static const align_pair *pair_of(sight_search *s, const align_edge *a, const align_edge *b, int place) {
    align_pair *out = s->pairs + place;
    out->edge[0] = a, out->edge[1] = b;
    align_two(&s->room, out);
    return out;
}

/* When an edge passes the crossing of two. That of the window comes last. */
static bool meet_edges(sight_search *s, const sight_edge *const e[3], const align_pair *pair, const align_edge *third) {
    meet_time found[NUM_DEGREE + 1];
    int count;
    bool well = true;
    if (e[0]->window + e[1]->window + e[2]->window > 1) return true; /* they have corners in common, or are apart */
    if (e[0]->window || e[1]->window) {
        const align_pair *others = pair_of(s, pair->edge[e[0]->window], third, 1);
        well = align_meet(&s->room, others, pair->edge[e[1]->window], found, &count);
    } else {
        well = align_meet(&s->room, pair, third, found, &count);
    }
    return keep_found(s, well, found, count);
}

/* All edges that pass the crossing of two. Where three of them are seen, one order of the three is enough. */
static bool pass_crossing(sight_search *s, size_t i, const align_edge *line, size_t j) {
    const sight_edge *edges = s->edges.data, *a = edges + i, *b = edges + j;
    const align_pair *pair = NULL;
    sight_box both;
    for (int k = 0; k < 2; k++)
        both.lo[k] = fmax(a->box.lo[k], b->box.lo[k]), both.hi[k] = fmin(a->box.hi[k], b->box.hi[k]);
    for (size_t n = 0; n < s->edges.count && edges[n].box.lo[0] <= both.hi[0]; n++) {
        const sight_edge *c = edges + n;
        if ((c->seen && n <= j) || n == i || n == j || !(a->moves || b->moves || c->moves)) continue;
        if (!boxes_meet(&both, &c->box) || share_end(a, c) || share_end(b, c)) continue;
        if (!pair) pair = pair_of(s, line, edge_of(s, b, 1), 0);
        if (!meet_edges(s, (const sight_edge *const[]){a, b, c}, pair, edge_of(s, c, 2))) return false;
    }
    return true;
}

/* All instants between two times between which no plan changes its piece, and nothing comes or goes. */
static froe_status look_between(sight_search *s, double from, double to) {
    align_go(&s->room, from, to);
    if (!list_edges(s)) return FROE_E_MEMORY;
    bool well = true;
    for (size_t i = 0; i < s->edges.count && well; i++) {
        const sight_edge *e = s->edges.data + i;
        const align_edge *line = edge_of(s, e, 0);
        for (uint32_t v = 0; v < s->count && well; v++) well = pass_edge(s, e, line, v);
        for (size_t j = i + 1; e->seen && well && j < s->edges.count; j++) {
            const sight_edge *other = s->edges.data + j;
            if (other->box.lo[0] > e->box.hi[0]) break;
            if (other->seen && !share_end(e, other) && boxes_meet(&e->box, &other->box))
                well = pass_crossing(s, i, line, j);
        }
    }
    return s->status;
}

/* ------------------------------------------------------------------------ time -- */

static int by_time(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static int by_begin(const void *a, const void *b) {
    const meet_time *p = a, *q = b;
    return p->low != q->low ? by_time(&p->low, &q->low) : by_time(&p->high, &q->high);
}

static bool add_knot(sight_search *s, double time, double from, double to) {
    return time <= from || time >= to || array_push(&s->m->alloc, &s->knots, time);
}

/* Those of all plans: of vertices, and of bodies. */
static bool add_knots(sight_search *s, const froe_motion *m, double from, double to) {
    bool room = true;
    for (size_t i = 0; i < m->knots.count && room; i++) room = add_knot(s, m->knots.data[i].time, from, to);
    return room;
}

/* The times at which a vertex or the eye changes its piece, or an object appears or ends. */
static bool list_knots(sight_search *s, double from, double to) {
    bool room = array_push(&s->m->alloc, &s->knots, from) && array_push(&s->m->alloc, &s->knots, to) &&
                add_knots(s, s->m, from, to) && (!s->room.gaze.rig || add_knots(s, s->room.gaze.rig, from, to));
    for (size_t i = 0; i < s->m->objects.count && room; i++)
        room = add_knot(s, s->m->objects.data[i].birth, from, to) && add_knot(s, s->m->objects.data[i].death, from, to);
    if (room) base_sort(s->knots.data, s->knots.count, sizeof *s->knots.data, by_time);
    return room;
}

static void tell(sight_search *s, froe_sight_fn *fn, void *user) {
    meet_time *at = s->instants.data;
    size_t kept = 0;
    if (s->instants.count) base_sort(at, s->instants.count, sizeof *at, by_begin);
    for (size_t i = 0; i < s->instants.count; i++)
        if (kept && at[i].low <= at[kept - 1].high)
            at[kept - 1].high = fmax(at[kept - 1].high, at[i].high);
        else
            at[kept++] = at[i];
    for (size_t i = 0; i < kept && base_callback(fn(user, at[i].low, at[i].high)); i++) {
    }
}

/* ------------------------------------------------------------------- crossings -- */

static bool is_at_rest(const froe_motion *m, uint32_t object) {
    bool all = object < m->objects.count;
    for (int k = 0; k < 3 && all; k++) {
        const motion_plan *plan = m->plans.data + m->objects.data[object].vertices[k];
        all = plan->count == 1 && plan->body == FROE_NONE;
    }
    return all;
}

static void resting_corners(const froe_motion *m, uint32_t object, const double *out[3]) {
    for (int k = 0; k < 3; k++) out[k] = m->knots.data[m->plans.data[m->objects.data[object].vertices[k]].first].at;
}

static froe_status find_crossings(sight_search *s, froe_diagnostic *diag) {
    const froe_motion *m = s->m;
    num_arena arena = {0};
    for (size_t i = 0; i < 2 * s->o->pair_count; i++)
        if (!is_at_rest(m, s->o->pairs[i]))
            return support_fail(diag, FROE_E_INPUT, "option 'pairs': Number %zu is no object that is at rest.", i);
    s->crosses = support_calloc(&m->alloc, 2 * s->o->pair_count + 1, sizeof *s->crosses);
    if (!s->crosses) return support_fail_memory(diag);
    if (!s->o->pair_count) return FROE_OK;
    if (num_arena_reserve(&m->alloc, &arena, crossing_arena(m->unit, m->top))) return support_fail_memory(diag);
    for (size_t i = 0; i < s->o->pair_count; i++) {
        const double *a[3], *b[3];
        resting_corners(m, s->o->pairs[2 * i], a), resting_corners(m, s->o->pairs[2 * i + 1], b);
        if (!crossing_find(&arena, a, b, s->crosses + 2 * i)) s->crosses[2 * i] = (crossing_end){{NULL}, {NULL}};
    }
    num_arena_free(&m->alloc, &arena);
    return FROE_OK;
}

/* --------------------------------------------------------------------- calling -- */

/* How high degrees become is in align.h. */
static froe_status check_motion(const sight_search *s, froe_diagnostic *diag) {
    const froe_motion *m = s->m;
    const gaze *g = &s->room.gaze;
    const int turn = gaze_turn(g), flight = gaze_flight(g), most = g->parallel ? 4 : 6;
    for (uint32_t i = 0; i < m->objects.count; i++)
        for (int k = 0; k < 3; k++) {
            const motion_plan *plan = m->plans.data + m->objects.data[i].vertices[k];
            if (plan->body != FROE_NONE)
                return support_fail_at(diag, FROE_E_UNSUPPORTED, i, FROE_NONE, FROE_NONE,
                                       "object %u: It is of a body, which may turn.", i);
            for (uint32_t n = 0; n < plan->count; n++) {
                const int degree = motion_knot_degree(m->knots.data + plan->first + n);
                if (degree * most + 2 * turn > NUM_DEGREE)
                    return support_fail_at(diag, FROE_E_UNSUPPORTED, i, FROE_NONE, FROE_NONE,
                                           "object %u: It flies along a %s can follow.", i,
                                           degree == 2 ? "parabola, which only a parallel eye or one that does not turn"
                                                       : "cubic, which only a parallel eye that does not turn");
            }
        }
    if (flight * most + 2 * turn <= NUM_DEGREE) return FROE_OK;
    return support_fail(diag, FROE_E_UNSUPPORTED,
                        "The eye turns and flies along a parabola, which only a parallel eye can do.");
}

/* Rays are quotients by the component in which the eye is farthest from a corner of the window; without a window, from
 * the centre of what carries the eye, or from where some vertex is at first. */
static void choose_chart(sight_search *s) {
    static const double centre[3] = {0};
    const double *eye = s->room.gaze.at, *before = s->o->window            ? s->o->window
                                                   : s->room.gaze.rig      ? centre
                                                   : s->m->knots.count > 0 ? s->m->knots.data[0].at
                                                                           : eye;
    int axis = 0;
    for (int k = 1; k < 3; k++)
        if (fabs(eye[k]) > fabs(eye[axis])) axis = k;
    s->chart = 2, s->side = eye[axis] > 0 ? 1 : -1;
    for (int k = 0; k < 3 && !s->room.gaze.parallel; k++)
        if (!k || fabs(eye[k] - before[k]) > fabs(eye[s->chart] - before[s->chart])) s->chart = k;
    if (!s->room.gaze.parallel) s->side = eye[s->chart] > before[s->chart] ? 1 : -1;
}

static froe_status make_points(sight_search *s, froe_diagnostic *diag) {
    s->own = (uint32_t)s->m->plans.count;
    s->count = s->own + CORNERS + 2 * (uint32_t)s->o->pair_count;
    s->points = support_calloc(&s->m->alloc, s->count, sizeof *s->points);
    if (!s->points) return support_fail_memory(diag);
    for (size_t k = 0; k < CORNERS && s->o->window; k++) {
        align_point *p = &s->points[s->own + k].at;
        p->rest = s->o->window + 3 * k, p->carried = s->room.gaze.rig != NULL;
    }
    for (size_t i = 0; i < 2 * s->o->pair_count; i++) s->points[s->own + CORNERS + i].at.cross = s->crosses + i;
    return FROE_OK;
}

static void free_search(sight_search *s) {
    const froe_allocator *alloc = &s->m->alloc;
    align_end(&s->room);
    array_free(alloc, &s->edges), array_free(alloc, &s->knots), array_free(alloc, &s->instants);
    if (s->points) support_free(alloc, s->points, s->count * sizeof *s->points);
    if (s->crosses) support_free(alloc, s->crosses, (2 * s->o->pair_count + 1) * sizeof *s->crosses);
    support_free(alloc, s, sizeof *s);
}

/* All instants, in any order. */
static froe_status search_sights(sight_search *s, double from, double to, froe_diagnostic *diag) {
    const bool crossings = s->o->pair_count > 0;
    froe_status status = gaze_begin(&s->room.gaze, s->m, s->o, diag);
    if (!status) status = check_motion(s, diag);
    if (!status) status = find_crossings(s, diag);
    if (!status) status = make_points(s, diag);
    if (status) return status;
    choose_chart(s);
    status = align_begin(&s->room, s->m, s->o->window, s->o->window ? 3 * CORNERS : 0, crossings);
    if (!status && !list_knots(s, from, to)) status = FROE_E_MEMORY;
    for (size_t i = 0; i + 1 < s->knots.count && !status; i++)
        if (s->knots.data[i] < s->knots.data[i + 1]) status = look_between(s, s->knots.data[i], s->knots.data[i + 1]);
    if (status == FROE_E_LIMIT) return support_fail(diag, status, "Two events happen too close to be told apart.");
    return status ? support_fail_memory(diag) : FROE_OK;
}

void froe_sight_defaults_into(froe_sight_options *out, size_t size) {
    const froe_sight_options all = {.size = size, .at = {NAN, NAN, NAN}, .from = NAN, .to = NAN};
    support_defaults(out, size, &all, sizeof all);
}

froe_status froe_motion_sights(const froe_motion *motion, const froe_sight_options *options, froe_sight_fn *fn,
                               void *user, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!motion || !options || !fn || (options->pair_count && !options->pairs))
        return support_fail_null(diag, __func__);
    if (options->size != sizeof *options) return support_fail_defaults(diag, "froe_sight_defaults");
    const double from = isnan(options->from) ? motion->begin : options->from,
                 to = isnan(options->to) ? motion->end : options->to;
    if (!(from >= motion->begin && from <= to && to <= motion->end))
        return support_fail(diag, FROE_E_OPTIONS, "The time from %g to %g is not within the window.", from, to);
    if (motion->dim != 3)
        return support_fail(diag, FROE_E_UNSUPPORTED, "The motion is of the plane, and has no hidden surfaces.");
    sight_search *s = support_calloc(&motion->alloc, 1, sizeof *s);
    if (!s) return support_fail_memory(diag);
    s->m = motion, s->o = options;
    const froe_status status = search_sights(s, from, to, diag);
    if (!status) tell(s, fn, user);
    free_search(s);
    return status;
}
