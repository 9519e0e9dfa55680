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

enum { CORNERS = 4 }; /* of the window */

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
    bool seen, moves;
} sight_edge;

typedef struct sight_search {
    const froe_motion *m;
    const double *window;
    const uint8_t *seen;
    align_room room;
    int chart, side;     /**< boxes are quotients by this component of rays, which has this sign before the eye */
    sight_point *points; /**< vertices of the motion, corners of the window */
    uint32_t point_count;
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

/* The coefficients of Bernstein of degree 2, among which the polynomial stays. */
static void between_numbers(const num_ball_poly *f, num_ball out[3]) {
    const num_ball zero = num_ball_from(0), first = f->degree > 0 ? f->c[1] : zero,
                   second = f->degree > 1 ? f->c[2] : zero;
    out[0] = f->c[0];
    out[1] = num_ball_add(f->c[0], num_ball_mul(first, num_ball_from(0.5)));
    out[2] = num_ball_add(num_ball_add(f->c[0], first), second);
}

/* Where a ray passes through the plane in which its component `chart` is 1. */
static sight_box box_of_ray(const sight_search *s, const num_ball_poly ray[3]) {
    sight_box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    num_ball way[3], at[3];
    between_numbers(&ray[s->chart], way);
    for (int i = 0; i < 3; i++)
        if (num_ball_sign(way[i]) != s->side) return everywhere;
    for (int axis = 0; axis < 2; axis++) {
        between_numbers(&ray[(s->chart + 1 + axis) % 3], at);
        for (int i = 0; i < 3; i++) extend_by(&box, axis, at[i], way[i]);
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

static void place_points(sight_search *s) {
    for (uint32_t v = 0; v < s->point_count; v++) {
        sight_point *p = s->points + v;
        if (!p->there) continue;
        if (!p->at.rest) p->at.piece = motion_piece_at_time(s->m, v, s->room.from);
        p->moves = !p->at.rest && p->at.piece.degree > 0;
        align_ray(&s->room, &p->at);
        p->box = box_of_ray(s, p->at.ray);
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
    const uint32_t own = s->point_count - CORNERS;
    for (int i = 0; i < 2; i++) {
        sight_point *p = s->points + (i ? b : a);
        p->at.rest = (i ? b : a) < own ? NULL : s->window + 3 * ((i ? b : a) - own);
        p->there = true;
        p->seen = p->seen || seen;
    }
    return array_push(&s->m->alloc, &s->edges, (sight_edge){.v = {a < b ? a : b, a < b ? b : a}, .seen = seen});
}

/* All edges that are there all the time, each once, in the order of their boxes. */
static bool list_edges(sight_search *s) {
    const uint32_t own = s->point_count - CORNERS;
    bool room = true;
    s->edges.count = 0;
    for (uint32_t v = 0; v < s->point_count; v++) s->points[v].there = s->points[v].seen = false;
    for (uint32_t i = 0; i < s->m->objects.count && room; i++) {
        const motion_object *o = s->m->objects.data + i;
        for (int k = 0; k < 3 && room && lives(s, o); k++)
            room = add_edge(s, o->vertices[k], o->vertices[(k + 1) % 3], !s->seen || s->seen[i]);
    }
    for (uint32_t k = 0; k < CORNERS && room && s->window; k++)
        room = add_edge(s, own + k, own + (k + 1) % CORNERS, true);
    if (!room || !s->edges.count) return room;
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

static bool look(sight_search *s, const align_point *const points[], int count) {
    meet_time found[NUM_DEGREE + 1];
    int found_count;
    if (!align_find(&s->room, points, count, found, &found_count)) s->status = FROE_E_LIMIT;
    for (int i = 0; i < found_count && !s->status; i++)
        if (!array_push(&s->m->alloc, &s->instants, found[i])) s->status = FROE_E_MEMORY;
    return !s->status;
}

static bool pass_edge(sight_search *s, const sight_edge *e, uint32_t v) {
    const sight_point *p = s->points + v, *a = s->points + e->v[0], *b = s->points + e->v[1];
    if (!p->there || v == e->v[0] || v == e->v[1] || !(p->seen || e->seen) || !(p->moves || e->moves)) return true;
    return !boxes_meet(&p->box, &e->box) || look(s, (const align_point *const[]){&p->at, &a->at, &b->at}, 3);
}

static bool share_end(const sight_edge *a, const sight_edge *b) {
    return a->v[0] == b->v[0] || a->v[0] == b->v[1] || a->v[1] == b->v[0] || a->v[1] == b->v[1];
}

/* All edges that pass the crossing of two. Where three of them are seen, one order of the three is enough. */
static bool pass_crossing(sight_search *s, size_t i, size_t j) {
    const sight_edge *edges = s->edges.data, *a = edges + i, *b = edges + j;
    sight_box both;
    for (int k = 0; k < 2; k++)
        both.lo[k] = fmax(a->box.lo[k], b->box.lo[k]), both.hi[k] = fmin(a->box.hi[k], b->box.hi[k]);
    for (size_t n = 0; n < s->edges.count && edges[n].box.lo[0] <= both.hi[0]; n++) {
        const sight_edge *c = edges + n;
        if ((c->seen && n <= j) || n == i || n == j || !(a->moves || b->moves || c->moves)) continue;
        if (!boxes_meet(&both, &c->box) || share_end(a, c) || share_end(b, c)) continue;
        const sight_edge *const three[3] = {a, b, c};
        const align_point *points[6];
        for (int k = 0; k < 6; k++) points[k] = &s->points[three[k / 2]->v[k % 2]].at;
        if (!look(s, points, 6)) return false;
    }
    return true;
}

/* All instants between two times between which no vertex changes its piece, and nothing comes or goes. */
static froe_status look_between(sight_search *s, double from, double to) {
    s->room.from = from, s->room.to = to;
    if (!list_edges(s)) return FROE_E_MEMORY;
    bool well = true;
    for (size_t i = 0; i < s->edges.count && well; i++) {
        const sight_edge *e = s->edges.data + i;
        for (uint32_t v = 0; v < s->point_count && well; v++) well = pass_edge(s, e, v);
        for (size_t j = i + 1; e->seen && well && j < s->edges.count; j++) {
            const sight_edge *other = s->edges.data + j;
            if (other->box.lo[0] > e->box.hi[0]) break;
            if (other->seen && !share_end(e, other) && boxes_meet(&e->box, &other->box)) well = pass_crossing(s, i, j);
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

/* The times at which a vertex changes its piece, or an object appears or ends. */
static bool list_knots(sight_search *s, double from, double to) {
    bool room = array_push(&s->m->alloc, &s->knots, from) && array_push(&s->m->alloc, &s->knots, to);
    for (size_t v = 0; v < s->m->plans.count && room; v++) {
        const motion_plan *plan = s->m->plans.data + v;
        for (uint32_t i = 0; i < plan->count && room; i++)
            room = add_knot(s, s->m->knots.data[plan->first + i].time, from, to);
    }
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

/* --------------------------------------------------------------------- calling -- */

static froe_status check_motion(const froe_motion *m, bool parallel, froe_diagnostic *diag) {
    if (m->dim != 3)
        return support_fail(diag, FROE_E_UNSUPPORTED, "The motion is of the plane, and has no hidden surfaces.");
    for (uint32_t i = 0; i < m->objects.count; i++)
        for (int k = 0; k < 3; k++) {
            const motion_plan *plan = m->plans.data + m->objects.data[i].vertices[k];
            if (plan->body != FROE_NONE)
                return support_fail_at(diag, FROE_E_UNSUPPORTED, i, FROE_NONE, FROE_NONE,
                                       "object %u: It is of a body, which may turn.", i);
            for (uint32_t n = 0; n < plan->count; n++) {
                const motion_knot *knot = m->knots.data + plan->first + n;
                if (knot->second != FROE_NONE)
                    return support_fail_at(diag, FROE_E_UNSUPPORTED, i, FROE_NONE, FROE_NONE,
                                           "object %u: It flies along a cubic, which no eye can follow exactly.", i);
                if (!isnan(knot->control[0]) && !parallel)
                    return support_fail_at(
                        diag, FROE_E_UNSUPPORTED, i, FROE_NONE, FROE_NONE,
                        "object %u: It flies along a parabola, which only a parallel eye can follow.", i);
            }
        }
    return FROE_OK;
}

/* A corner of the window is before an eye at a point; without a window, where some vertex is at first. */
static align_eye choose_eye(sight_search *s, const double eye[3], bool parallel) {
    align_eye out = {.parallel = parallel, .at = {eye[0], eye[1], eye[2]}};
    const double *before = s->window ? s->window : s->m->knots.count ? s->m->knots.data[0].at : eye;
    for (int k = 1; k < 3; k++)
        if (fabs(eye[k]) > fabs(eye[out.axis])) out.axis = k;
    s->chart = 2, s->side = eye[out.axis] > 0 ? 1 : -1;
    for (int k = 0; k < 3 && !parallel; k++)
        if (!k || fabs(eye[k] - before[k]) > fabs(eye[s->chart] - before[s->chart])) s->chart = k;
    if (!parallel) s->side = eye[s->chart] > before[s->chart] ? 1 : -1;
    return out;
}

static void free_search(sight_search *s) {
    align_end(&s->room);
    array_free(&s->m->alloc, &s->edges), array_free(&s->m->alloc, &s->knots), array_free(&s->m->alloc, &s->instants);
    support_free(&s->m->alloc, s->points, s->point_count * sizeof *s->points);
}

froe_status froe_motion_sights(const froe_motion *motion, const double eye[3], bool parallel, const double *window,
                               const uint8_t *seen, double from, double to, froe_sight_fn *fn, void *user,
                               froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!motion || !eye || !fn) return support_fail_null(diag, __func__);
    if (!(from >= motion->begin && from <= to && to <= motion->end))
        return support_fail(diag, FROE_E_ARG, "The time from %g to %g is not within the window.", from, to);
    froe_status status = check_motion(motion, parallel, diag);
    if (status) return status;
    sight_search s = {.m = motion, .window = window, .seen = seen};
    const align_eye at = choose_eye(&s, eye, parallel);
    s.point_count = (uint32_t)motion->plans.count + CORNERS;
    s.points = support_calloc(&motion->alloc, s.point_count, sizeof *s.points);
    status = s.points ? align_begin(&s.room, motion, &at) : FROE_E_MEMORY;
    if (!status && !list_knots(&s, from, to)) status = FROE_E_MEMORY;
    for (size_t i = 0; i + 1 < s.knots.count && !status; i++)
        if (s.knots.data[i] < s.knots.data[i + 1]) status = look_between(&s, s.knots.data[i], s.knots.data[i + 1]);
    if (!status) tell(&s, fn, user);
    if (s.room.motion) free_search(&s);
    if (status == FROE_E_LIMIT) return support_fail(diag, status, "Two events happen too close to be told apart.");
    return status ? support_fail_memory(diag) : FROE_OK;
}
